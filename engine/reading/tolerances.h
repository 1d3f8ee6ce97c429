// tolerances.h — quantities that a scene gives with a tolerance:
//
//     stiffness = { value = "900 kN*m/rad", tolerance = "10 %", distribution = "normal", k = 2 }
//     inertia   = { value = "420 kg*m2", from = "400 kg*m2", to = "450 kg*m2", distribution = "triangular" }
//
// A run uses the value; kurbel uncertainty computes the effect of the tolerances on the figures. The standard deviation of
// a normal distribution is tolerance/k.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/messages.h"

namespace kurbel {

struct Tolerance {
  enum class Distribution { normal, uniform, triangular };
  std::string path;          // "main_coupling.stiffness"
  std::string unit;          // of the value: "kN*m/rad"; used for the following members
  double value = 0;          // the mode of a triangular distribution
  double low = 0, high = 0;  // limits; for a normal distribution value ∓ tolerance
  Distribution distribution = Distribution::uniform;
  double k = 2;  // of a normal distribution
  Location at;
};

// Of its distribution, in its unit: standard deviation, distribution function, quantile.
double deviation(const Tolerance& tolerance);
double share_below(const Tolerance& tolerance, double value);
double quantile(const Tolerance& tolerance, double share);

// A table that gives a value with a tolerance.
bool has_tolerance(const DocumentValue& table);
// Reads such a table; faults go into the messages.
Tolerance read_tolerance(const DocumentValue& table, const std::string& path, Messages& messages);
// All tolerances of a scene's text, in order. Throws SceneError.
std::vector<Tolerance> tolerances_of(const std::string& text, const std::string& file);

}  // namespace kurbel
