// result.cpp — figures of a run by name, and its accuracy in words.
#include "studies/findings/result.h"

#include <fmt/format.h>

#include <algorithm>

namespace kurbel {

const Figure* Result::find(const std::string& name) const {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.name == name; });
  return found == figures.end() ? nullptr : &*found;
}

const Figure* Result::find(const QuantityKind& what, const std::string& of) const {
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.what == what && f.of == of; });
  return found == figures.end() ? nullptr : &*found;
}

std::string Result::accuracy_in_words() const {
  return fmt::format(
      "accuracy {:.1e} was asked for, {}", accuracy,
      errors_measured ? fmt::format("{:.1e} measured", measured_accuracy) : "errors could not be measured");
}

}  // namespace kurbel
