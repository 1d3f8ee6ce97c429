// result.cpp — figures of a run by name, and its accuracy in words.
#include "studies/findings/result.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/find_by.h"
#include "studies/dictionary/dictionary.h"

namespace kurbel {

Figure Figure::defined(Name name, double value, double scale) {
  const Definition* definition = definition_of(name);
  return of_name(std::move(name), value, definition ? std::string(definition->unit) : "", scale);
}

const Figure* find(const std::vector<Figure>& figures, std::string_view name) {
  return find_by(figures, &Figure::name, name);
}

void FigureReporter::add(Name name, const Found& found) {
  Figure figure = Figure::defined(std::move(name), found.value, found.scale);
  figure.at = found.at, figure.exact = found.exact, figure.resolution = found.resolution;
  figures_.push_back(std::move(figure));
}

const Figure* Result::find(const QuantityKind& what, const std::string& of) const {
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.what == what && f.of == of; });
  return found == figures.end() ? nullptr : &*found;
}

std::string Result::accuracy_in_words() const {
  return fmt::format(
      "accuracy {:.1e} requested, {}", accuracy,
      errors_measured ? fmt::format("{:.1e} measured", measured_accuracy) : "errors could not be measured");
}

std::string Result::unconfirmed_in_words() const {
  if (!unconfirmed()) return {};
  const bool unstable = std::any_of(claims.begin(), claims.end(),
                                    [](const Claim& c) { return c.predicate == Predicate::start_unstable; });
  return accuracy_in_words() + (unstable ? ". No accuracy helps where rounding decides: start it at another angle"
                                         : ". Loosen --accuracy, or take --no-error if no error is wanted");
}

}  // namespace kurbel
