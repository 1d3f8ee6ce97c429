// formulas.h — formulas with numbers inserted, in sequence.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "studies/findings/report.h"

namespace kurbel {

class Formulas {
 public:
  // The formula "δ = (ω_max − ω_min)/ω_m"; the same with numbers inserted, and the result.
  template <class... Values>
  Formulas& add(std::string title, std::string symbols, fmt::format_string<Values...> numbers, Values&&... values) {
    cards_.push_back({.title = std::move(title),
                      .symbols = std::move(symbols),
                      .numbers = fmt::format(numbers, std::forward<Values>(values)...)});
    return *this;
  }
  // A note below the last one.
  Formulas& note(std::string words) { return cards_.back().note = std::move(words), *this; }

  const std::vector<FormulaCard>& cards() const { return cards_; }

 private:
  std::vector<FormulaCard> cards_;
};

}  // namespace kurbel
