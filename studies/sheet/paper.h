// paper.h — sheets of paper with frame and title block, and the page that holds them: printed, a millimetre is one.
#pragma once

#include <deque>
#include <string>

#include "studies/sheet/canvas.h"

namespace kurbel {

// Landscape.
struct Paper {
  std::string name = "A4";
  double width = 297, height = 210;  // [mm]
};
// "A4" or "A3"; throws std::invalid_argument for others.
Paper paper_named(const std::string& name);

// What stands in the title block of every sheet.
struct TitleBlock {
  std::string title, study, author = {};
};

class Sheets {
 public:
  Sheets(Paper paper, TitleBlock block) : paper_(std::move(paper)), block_(std::move(block)) {}

  // A further sheet; what it shows, in its title block. The canvas stays where it is.
  Canvas& add(const std::string& what, const std::string& scales = {});
  // Between frame and title block.
  Box room() const;
  // Beside the title block.
  Box foot() const;
  std::string html() const;

 private:
  struct Sheet {
    std::string what, scales;
    Canvas canvas;
  };
  void draw_block(Canvas& canvas, const Sheet& sheet, std::size_t number) const;

  Paper paper_;
  TitleBlock block_;
  std::deque<Sheet> sheets_;
};

}  // namespace kurbel
