// references.h — what is true, as two runs say that share as little as possible with the measured one.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/model/model.h"

namespace kurbel::coverage {

struct TrueValue {
  double value = 0, uncertainty = 0;
};

struct Reference {
  std::map<std::string, TrueValue> figures;
  std::string methods;  // "dop853 one cycle on, verner6"
  double tolerance = 0;
};

// Two methods other than the one given, at the tolerance given; the first takes other tables of the mechanisms and
// begins a cycle on where the machine repeats itself. Nothing where no two of them end within their budget.
std::optional<Reference> reference_of(const std::shared_ptr<const Model>& model, const std::string& method,
                                      double tolerance, double budget);

}  // namespace kurbel::coverage
