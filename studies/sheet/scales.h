// scales.h — scales of drawings as in textbooks on mechanisms: μ, the value represented by a millimetre on paper.
//
//     length drawn [mm] = value/μ,      μ = 1, 2, 2.5, 4 or 5 · 10ⁿ
#pragma once

#include <string>

namespace kurbel {

// The next of 1, 2, 2.5, 4, 5, 10 … that is not smaller; value > 0.
double round_scale(double value);

// Degrees of a link per millimetre, so that a cycle [rad] fits a width [mm]: 1, 1.5, 2, 3, 4, 5, 6, 7.5 or 9, times
// powers of ten.
double round_degrees(double cycle, double width);

struct Scale {
  std::string symbol;  // "μ_M"
  double per_mm = 1;   // value in SI per millimetre, > 0
  std::string unit;    // of the value, in readable form: "N·m"

  double mm(double value) const { return value / per_mm; }
  std::string words() const;  // "μ_M = 2.5 N·m/mm"
};
// The finest scale of round numbers in which `largest` fits the given length [mm]; 1 if all values are zero.
Scale scale_for(const std::string& symbol, const std::string& unit, double largest, double room);

}  // namespace kurbel
