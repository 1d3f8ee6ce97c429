// theory.cpp — the pages of docs/theory (tests/docs/theory_test.cpp compares them with the folder), and citations of them.
#include "studies/report/theory.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <set>
#include <utility>

namespace kurbel {
namespace {

constexpr std::array<TheoryPage, 15> pages = {{
    {"Conventions", "docs/theory/01-conventions.md"},
    {"Reduction and the equation of work", "docs/theory/02-reduction.md"},
    {"Flywheel", "docs/theory/03-flywheel.md"},
    {"Motors and other drives", "docs/theory/04-motors.md"},
    {"Elastic drive", "docs/theory/05-elastic.md"},
    {"Gear pairs", "docs/theory/06-gear-pairs.md"},
    {"Gear trains", "docs/theory/07-gear-trains.md"},
    {"Friction and contacts", "docs/theory/08-friction.md"},
    {"Crank mechanisms", "docs/theory/09-crank-mechanisms.md"},
    {"Loads", "docs/theory/10-loads.md"},
    {"Steady motion", "docs/theory/11-steady-motion.md"},
    {"Modes", "docs/theory/12-modes.md"},
    {"Clearance and a flexible rod", "docs/theory/13-clearance-and-flexible-rod.md"},
    {"Effects and validity", "docs/theory/14-effects-and-validity.md"},
    {"Errors of figures", "docs/theory/15-errors-of-figures.md"},
}};

// Page and equation; equation 0: the whole page.
using Place = std::pair<int, int>;

// A whole number that begins here and moves on behind it; 0: none.
int take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 0) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

// "2.1, 2.2 and 5" from here on.
void take_list(std::string_view text, std::set<Place>& places) {
  for (;;) {
    const int page = take_number(text);
    if (page == 0) return;
    int equation = 0;
    if (text.size() > 1 && text[0] == '.' && text[1] >= '1' && text[1] <= '9') {
      text.remove_prefix(1);
      equation = take_number(text);
    }
    if (theory_page(page)) places.emplace(page, equation);
    if (text.starts_with(", "))
      text.remove_prefix(2);
    else if (text.starts_with(" and "))
      text.remove_prefix(5);
    else
      return;
  }
}

}  // namespace

const TheoryPage* theory_page(int number) {
  return number >= 1 && number <= static_cast<int>(pages.size()) ? &pages[static_cast<std::size_t>(number - 1)]
                                                                 : nullptr;
}

std::vector<std::string> theory_notes(std::string_view text) {
  constexpr std::string_view word = "theory ";
  std::set<Place> places;
  for (std::size_t here = text.find(word); here != std::string_view::npos; here = text.find(word, here + 1))
    take_list(text.substr(here + word.size()), places);
  std::vector<std::string> notes;
  for (const auto& [number, equation] : places) {
    const TheoryPage& page = *theory_page(number);
    notes.push_back(equation > 0 ? fmt::format("theory {0}.{1}: {2}, equation ({0}.{1}) in {3}", number, equation,
                                               page.title, page.file)
                                 : fmt::format("theory {}: {}, {}", number, page.title, page.file));
  }
  return notes;
}

}  // namespace kurbel
