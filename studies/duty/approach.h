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

// Where a speed without a cycle goes, from its angle at equal intervals. `speed`: where it is at the end, without vibration.
struct SpeedLimit {
  enum class Kind { known, grows, unknown };  // grows: its change does not decrease
  Kind kind = Kind::unknown;
  double limit = 0, speed = 0;  // per interval
  double unsure = 0;            // of both, at most
  double change = 0;            // of the mean from the last but one part to the last one
};

// Three means of the speed in steps of t, weighted by sin² over 2 t each, change by D₁ and D₂: of an exponential approach D₂ q/(1 − q)
// lacks from the last to the limit, q = D₂/D₁. Over 4 t = the last 1/1, 1/2, 1/4 … of the angles these limits are equal, where
// the approach is exponential; where the start, or a fast vibration, is among them, they are not. The longest parts of which
// three successive ones agree count, or the two shortest; if none do, no limit is known. At the crest of an overshoot that is
// longer than the parts, the limit is the crest: a later return does not show in them. Changes below `noise` are none.
SpeedLimit limit_of_speed(std::span<const double> angles, double noise);

// Greatest less least.
double range_of(std::span<const double> values);

}  // namespace kurbel
