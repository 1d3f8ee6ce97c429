// loops.h — loop equations of the linkages as series in the crank's angle, through their change points.
//
// The link that closes a loop lies on one side of a line, at a distance given by a square root. If the radicand has a
// double zero, all links lie in one line: a change point. The motion is continued smoothly there if the root changes its
// sign, so it is written as a function with a simple zero: 1 + cos φ = 2 cos²(φ/2) has the root √2 cos(φ/2). This gives
// the tangent at the change point explicitly, where the first derivatives of the closures give 0/0 and the second ones
// would be needed. A function of half the angle changes its sign each turn, so that a cycle may be two turns.
//
// Lengths are equal if their difference is within the rounding errors of their sums.
#pragma once

#include <cmath>
#include <optional>

#include "mechanisms/loops/taylor.h"

namespace kurbel {

inline bool same_length(long double a, long double b) {
  return std::fabs(a - b) <= 2e-14L * (std::fabs(a) + std::fabs(b));
}

// Range of a crank that cannot turn fully: middle ± half [rad]. At its ends coupler and follower lie in one line, or the
// rod is perpendicular to the line of the slider; the crank is at rest while they move, and I_r(φ) is unbounded: it grows
// as 1/(distance to the end).
struct CrankArc {
  double middle = 0, half = 0;
  // The computed part of the range. At its ends I_r is some hundred times its value in the middle.
  static constexpr double share = 0.999;
  double reach() const { return share * half; }
  // φ modulo a turn, within half a turn of the middle.
  double near(double phi) const { return middle + std::remainder(phi - middle, 2 * std::acos(-1.0)); }
};

// Crank a about O, coupler b, follower c about D = (d, 0). The pin B exists while |b − c| ≤ AD ≤ b + c; over a turn of the
// crank AD varies from |a − d| at φ = 0 to a + d at π.
struct FourBarLoop {
  long double a, b, c, d;  // [m], > 0

  bool in_line_at_zero() const { return same_length(a + b, c + d) || same_length(a + c, b + d); }
  bool in_line_at_half_turn() const { return same_length(a + d, b + c); }
  bool meets_bearing() const { return same_length(a, d) && same_length(b, c); }  // A = D at φ = 0
  bool changes() const { return in_line_at_zero() || in_line_at_half_turn(); }
  // Range of a crank that cannot turn fully because AD is limited; if it is limited at both sides of the ground, the range
  // in 0 < φ < π. Empty: the crank turns fully, or the loop cannot be closed.
  std::optional<CrankArc> arc() const;
  // A kite on this branch has its coupler always on the crank and its follower on the ground.
  bool folds(bool left) const { return !left && same_length(a, b) && same_length(c, d); }
};

// Directions from A along the coupler and from D along the follower, which intersect in B.
struct Meeting {
  Direction coupler, follower;
  long double sine = 0;  // of the angle from coupler to follower: 0 in a change point
};
// `left`: B lies left of the directed line A → D; for linkages with change points: in 0 < φ < π.
Meeting meet(const FourBarLoop& loop, long double phi, bool left);

// A rod of length l from the pin of a crank r to the line y = e.
struct SliderLoop {
  long double r, l, e;                                               // r, l > 0 [m]
  bool changes() const { return same_length(l, r + std::fabs(e)); }  // at φ = ±π/2, with crank and rod upright
  // Range with a rod too short for a full turn: −l ≤ e − r sin φ ≤ l; if limited on both sides of the line, the range about
  // φ = 0. Empty: the crank turns fully, or the rod cannot reach the line at any φ.
  std::optional<CrankArc> arc() const;
};
// The rod's direction: towards +x or, if `back`, towards −x; with change points: at φ = 0. `crank`: direction of the crank
// at φ.
Direction rod_to_line(const SliderLoop& loop, const Direction& crank, long double phi, bool back);

// The pin of a crank r in a slot that turns about D = (d, 0).
struct SlotLoop {
  long double r, d;                                   // [m], > 0
  bool changes() const { return same_length(r, d); }  // at φ = 0: the pin passes over D
};
struct Slot {
  Direction along;  // from D to the pin, or opposite after the pin has crossed D
  Taylor reach;     // coordinate of the pin along it [m]
};
Slot slot_to_pin(const SlotLoop& loop, long double phi);

// Direction of a link of this length from `joint` to the line y = height, towards +x or −x; without change points.
Direction to_line(const Path& joint, long double height, long double length, bool backward);

}  // namespace kurbel
