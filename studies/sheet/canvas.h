// canvas.h — a drawing in millimetres on paper, as SVG: lines, curves, circles, texts, symbols with indices.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

struct Spot {
  double x = 0, y = 0;  // from the upper left corner of the paper, to the right and down [mm]
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;  // [mm]
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

// Line styles in sheet.css: thickness, dashes, colour.
enum class Pen { grid, thin, body, path, dashed, thick, drive, load, main, accent, letter, edge };

struct Lettering {
  double size = 3;                // height of the line [mm]
  std::string_view at = "start";  // "start", "middle", "end": the part of the text at the spot
  bool bold = false;
  double turned = 0;  // clockwise [°]
  Pen pen = Pen::body;
  bool ground = false;  // with a background in the colour of the paper
};

class Canvas {
 public:
  void line(Spot a, Spot b, Pen pen);
  void curve(const std::vector<Spot>& spots, Pen pen, bool closed = false);
  void arrow(Spot from, Spot to, Pen pen);
  void box(const Box& box, Pen pen);
  void block(Spot centre, double width, double height, double turned, Pen pen);  // a slider
  void circle(Spot centre, double radius, Pen pen, bool filled = false);
  // A circle with attributes for programs: data-position="3".
  void mark(Spot centre, Pen pen, std::string_view attributes);
  void words(Spot at, std::string_view text, const Lettering& how = {}, std::string_view attributes = {});
  // "M_c", "μ_l = 0.002 m/mm": text after "_" up to a blank or sign is an index.
  void symbols(Spot at, std::string_view text, const Lettering& how = {});
  void begin_group(std::string_view attributes);
  void end_group();

  const std::string& svg() const { return svg_; }

 private:
  void put_words(Spot at, const std::string& content, const Lettering& how, std::string_view attributes);
  std::string svg_;
};

// Escaped for XML text and attributes, on one line.
std::string xml_text(std::string_view text);
// Approximate width [mm].
double width_of(std::string_view text, double size);

// Text within a box, wrapped, with line feeds; smaller if it is long.
void add_lines(Canvas& canvas, const Box& box, const std::string& text, double size = 2.8);

}  // namespace kurbel
