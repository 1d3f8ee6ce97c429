// tolerances.h — quantities that a scene gives with a tolerance:
//
//     stiffness = { value = "900 kN*m/rad", tolerance = "10 %", distribution = "normal", k = 2 }
//     inertia   = { value = "420 kg*m2", from = "400 kg*m2", to = "450 kg*m2", distribution = "triangular" }
//
// A run computes with the value; kurbel uncertainty asks what the tolerances make of the figures. A normal one's
// deviation is tolerance/k.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/document.h"
#include "engine/scene/messages.h"

namespace kurbel {

struct Tolerance {
  enum class Distribution { normal, uniform, triangular };
  std::string path;          // "main_coupling.stiffness"
  std::string unit;          // of the value: "kN*m/rad"; those below are in it
  double value = 0;          // the mode of a triangular one
  double low = 0, high = 0;  // ends; of a normal one value ∓ tolerance
  Distribution distribution = Distribution::uniform;
  double k = 2;  // of a normal one
  Location at;
};

// Of its distribution as given, in its unit: standard deviation, share below a value, value above that share.
double deviation(const Tolerance& tolerance);
double share_below(const Tolerance& tolerance, double value);
double quantile(const Tolerance& tolerance, double share);

// A table that gives a value with a tolerance.
bool has_tolerance(const DocumentValue& table);
// What such a table says; faults go into the messages.
Tolerance read_tolerance(const DocumentValue& table, const std::string& path, Messages& messages);
// All of a scene's text, in its order. Throws SceneError.
std::vector<Tolerance> tolerances_of(const std::string& text, const std::string& file);

}  // namespace kurbel
