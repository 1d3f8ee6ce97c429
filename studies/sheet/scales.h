// scales.h — scales of drawings as books of mechanisms write them: μ, what a millimetre of the paper stands for.
//
//     length drawn [mm] = value/μ,      μ = 1, 2, 2.5, 4 or 5 · 10ⁿ
#pragma once

#include <string>

namespace kurbel {

// The next of 1, 2, 2.5, 4, 5, 10 … that is not below; value > 0.
double round_scale(double value);

// Degrees of a link to a millimetre, so that a cycle [rad] goes into a width [mm]: 1, 1.5, 2, 3, 4, 5, 6, 7.5 or 9,
// and their decades.
double round_degrees(double cycle, double width);

struct Scale {
  std::string symbol;  // "μ_M"
  double per_mm = 1;   // value in SI that a millimetre stands for, > 0
  std::string unit;    // of the value, as it is to be read: "N·m"

  double mm(double value) const { return value / per_mm; }
  std::string words() const;  // "μ_M = 2.5 N·m/mm"
};
// The finest round one in which `largest` goes into `room` [mm]; of nothing but zeros 1.
Scale scale_for(const std::string& symbol, const std::string& unit, double largest, double room);

}  // namespace kurbel
