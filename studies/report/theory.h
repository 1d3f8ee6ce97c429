// theory.h — explanation of a report's citations of docs/theory: a report is one file and must be self-contained.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kurbel {

struct TheoryPage {
  std::string_view title, file;  // "Flywheel", "docs/theory/03-flywheel.md"
};
// Pages from 1 on; null: there is none.
const TheoryPage* theory_page(int number);

// A note for every "theory 3.2" or "theory 2.1, 2.2" in a text, each once, by number:
//     theory 3.2: Flywheel, equation … in docs/theory/03-flywheel.md
// Pages that do not exist are omitted: a scene's text may cite other books.
std::vector<std::string> theory_notes(std::string_view text);

}  // namespace kurbel
