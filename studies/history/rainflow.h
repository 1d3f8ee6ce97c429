// rainflow.h — cycles of a load history after ASTM E1049-85, rainflow counting (5.4.4).
#pragma once

#include <vector>

namespace kurbel {

struct LoadCycle {
  double range = 0, mean = 0, count = 0;  // count ½ or 1
};

// Ranges in the order in which the rules close them. Values between reversals have no effect. Reversals up to `least`
// are ignored: otherwise rounding errors about a settled load would count as cycles, the more the finer the sampling.
std::vector<LoadCycle> rainflow(const std::vector<double>& history, double least = 0);

// Amplitude of the same number of equal full cycles with the same damage at a Wöhler exponent m > 0: (Σ n
// (range/2)^m/Σ n)^(1/m); 0 without cycles.
double equivalent_amplitude(const std::vector<LoadCycle>& cycles, double exponent);

}  // namespace kurbel
