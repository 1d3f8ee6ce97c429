// approach.h — how far a sequence of speeds still is from its limit.
#pragma once

#include <optional>
#include <span>

namespace kurbel {

// Distance of the last of a sequence of equally spaced values to its limit.
struct Approach {
  double last_change = 0;           // from the last but one value
  std::optional<double> remaining;  // |limit − last value|; empty: no limit is recognisable, or fewer than three values
  bool alternates = false;          // changes of both senses: the limit may be on either side
};

// From the later half of the values. One-sided changes are evaluated over short and long parts of it, and the worse
// result counts: two halves that change by D₁, D₂ leave D₂ q/(1 − q), q = D₂/D₁ < 1. For alternating changes it is
// their range, increased if it grows. Changes below `noise` are not extrapolated and count by themselves.
Approach approach_of(std::span<const double> values, double noise);

// Greatest less least.
double range_of(std::span<const double> values);

}  // namespace kurbel
