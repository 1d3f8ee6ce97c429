// paper.h — sheets of paper with frame and title block, and the page that contains them, printed at true size.
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

// Text in the title block of every sheet.
struct TitleBlock {
  std::string title, study, author = {};
};

class Sheets {
 public:
  Sheets(Paper paper, TitleBlock block) : paper_(std::move(paper)), block_(std::move(block)) {}

  // Adds a sheet; `what` is its content, for the title block. The reference to the canvas stays valid.
  Canvas& add(const std::string& what, const std::string& scales = {});
  // Area between frame and title block.
  Box room() const;
  // Area beside the title block.
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
