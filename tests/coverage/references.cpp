// references.cpp — the truth is the first reference; what the second one differs by is its uncertainty.
#include "tests/coverage/references.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mechanisms/reduced/mechanism.h"
#include "tests/coverage/measure.h"
#include "tests/coverage/single_run.h"
#include "tests/coverage/variant.h"

namespace kurbel::coverage {
namespace {

// By their price at tight tolerances; implicit ones for what is stiff.
std::vector<std::string> other_methods(const std::string& method) {
  std::vector<std::string> others = {"dop853", "verner6", "esdirk5", "adams"};
  const std::string own = method == "auto" ? "dop853" : method;
  std::erase(others, own);
  return others;
}

// A reference is itself a sum of rounded numbers.
double rounding_of(double value) { return 4 * std::numeric_limits<double>::epsilon() * std::abs(value); }

Reference joined(const Result& first, const Result& second, const std::map<std::string, double>& shifts) {
  Reference reference;
  for (const Figure& f : first.figures) {
    const Figure* other = second.find(f.name);
    if (!other) continue;
    const auto shift = shifts.find(f.name);
    const double value = f.value - (shift == shifts.end() ? 0 : shift->second);
    // Exactly alike counts as exact, unless the angle lost digits to whole turns.
    const double rounding = value == other->value ? 0 : rounding_of(std::max(std::abs(f.value), std::abs(value)));
    reference.figures[f.name] = {value, std::max(difference(f.name, value, other->value), rounding)};
  }
  std::map<std::string, double> times;
  for (const ReportedTime& t : times_of(second)) times[t.name] = t.value;
  for (const ReportedTime& t : times_of(first))
    if (const auto other = times.find(t.name); other != times.end())
      reference.figures[t.name] = {t.value, std::max(std::abs(t.value - other->second), rounding_of(t.value))};
  return reference;
}

// The machine with tables that share nothing with those of the measured runs.
std::shared_ptr<const Model> with_other_tables(const Scene& scene) {
  return compile_network(extracted_from(build_network(scene), Extraction::second), scene, scene.effects);
}

}  // namespace

std::optional<Reference> reference_of(const std::shared_ptr<const Model>& model, const std::string& method,
                                      double tolerance, double budget) {
  const std::optional<Scene> a_cycle_on = started_a_cycle_on(*model);
  const std::shared_ptr<const Model> elsewhere = with_other_tables(a_cycle_on.value_or(model->scene));
  const std::map<std::string, double> shifts =
      a_cycle_on ? shifts_of_angles(model, elsewhere) : std::map<std::string, double>{};
  std::optional<Result> first;
  std::string first_words;
  for (const std::string& other : other_methods(method)) {
    Result r = single_run(first ? model : elsewhere, {other, tolerance, budget});
    if (!r.complete) continue;
    if (!first) {
      first = std::move(r);
      first_words = other + (a_cycle_on ? " one cycle on" : "");
      continue;
    }
    Reference reference = joined(*first, r, shifts);
    reference.methods = first_words + ", " + other;
    reference.tolerance = tolerance;
    return reference;
  }
  return {};
}

}  // namespace kurbel::coverage
