// theory.h — what a report's citations of docs/theory mean, in words: a report is one file and must say it itself.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

struct TheoryPage {
  std::string_view title, file;  // "Flywheel", "docs/theory/03-flywheel.md"
};
// Of pages 1 …; null: there is none.
const TheoryPage* theory_page(int number);

// A note for every "theory 3.2" or "theory 2.1, 2.2" in a text, each once, by number:
//     theory 3.2: Flywheel, equation … in docs/theory/03-flywheel.md
// Pages that do not exist are left out: a scene's text may cite other books.
std::vector<std::string> theory_notes(std::string_view text);

}  // namespace kurbel
