// canvas.h — a drawing in millimetres of the paper, as SVG: lines, curves, circles, words, symbols with their indices.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

struct Spot {
  double x = 0, y = 0;  // from the paper's upper left corner, to the right and down [mm]
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;  // [mm]
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

// Classes of lines in sheet.css: how thick, dashed, in which colour.
enum class Pen { grid, thin, body, path, dashed, thick, drive, load, main, accent, letter, edge };

struct Lettering {
  double size = 3;                // height of the line [mm]
  std::string_view at = "start";  // "start", "middle", "end": what of the words stands at the spot
  bool bold = false;
  double turned = 0;  // clockwise [°]
  Pen pen = Pen::body;
  bool ground = false;  // the paper shines through under the words
};

class Canvas {
 public:
  void line(Spot a, Spot b, Pen pen);
  void curve(const std::vector<Spot>& spots, Pen pen, bool closed = false);
  void arrow(Spot from, Spot to, Pen pen);
  void box(const Box& box, Pen pen);
  void block(Spot centre, double width, double height, double turned, Pen pen);  // a slider
  void circle(Spot centre, double radius, Pen pen, bool filled = false);
  // A circle of which programs can be told what it is: more attributes, data-position="3".
  void mark(Spot centre, Pen pen, std::string_view attributes);
  void words(Spot at, std::string_view text, const Lettering& how = {}, std::string_view attributes = {});
  // "M_c", "μ_l = 0.002 m/mm": what follows "_" up to a blank or sign is an index.
  void symbols(Spot at, std::string_view text, const Lettering& how = {});
  void begin_group(std::string_view attributes);
  void end_group();

  const std::string& svg() const { return svg_; }

 private:
  void put_words(Spot at, const std::string& content, const Lettering& how, std::string_view attributes);
  std::string svg_;
};

// As it may stand between tags and in attributes, on one line.
std::string xml_text(std::string_view text);
// [mm], about.
double width_of(std::string_view text, double size);

// Words within a box, wrapped, a line feed beginning a line; smaller where they are many.
void add_lines(Canvas& canvas, const Box& box, const std::string& text, double size = 2.8);

}  // namespace kurbel
