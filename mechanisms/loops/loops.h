// loops.h — the loops of the linkages as series in the crank's angle, through their change points.
//
// A link that closes a loop stands to one side or the other of a line, and a root says how far. Where what stands under
// it has a double zero, all links lie in one line: a change point. The motion goes on smoothly there only if the root
// changes its sign, so it is written as its simple zero times what is left: 1 + cos φ = 2 cos²(φ/2), of root
// √2 cos(φ/2). The tangent at the change point, 0/0 by the closures' first derivatives, then comes out of itself as it
// would of their second ones. A root of half the angle changes its sign from turn to turn, so that a cycle may take two.
//
// Lengths count as equal if rounding of their sums may be all that they differ by.
#pragma once

#include <cmath>
#include <optional>

#include "mechanisms/loops/taylor.h"

namespace kurbel {

inline bool same_length(long double a, long double b) {
  return std::fabs(a - b) <= 2e-14L * (std::fabs(a) + std::fabs(b));
}

// Angles within which a crank rocks that cannot turn fully: middle ± half [rad]. At its ends coupler and follower lie in
// one line, or a rod stands square to its slider's; the crank stands still while they go on, and I_r(φ) has no bound: it
// grows as 1/(distance to the end).
struct CrankArc {
  double middle = 0, half = 0;
  // What is computed of it. At its end I_r is some hundred times what it is in the middle.
  static constexpr double share = 0.999;
  double reach() const { return share * half; }
  // φ but for whole turns, within a half turn of the middle.
  double near(double phi) const { return middle + std::remainder(phi - middle, 2 * std::acos(-1.0)); }
};

// Crank a about O, coupler b, follower c about D = (d, 0). The pin B is reached while |b − c| ≤ AD ≤ b + c; a turn of the
// crank takes AD from |a − d| at φ = 0 to a + d at π.
struct FourBarLoop {
  long double a, b, c, d;  // [m], > 0

  bool in_line_at_zero() const { return same_length(a + b, c + d) || same_length(a + c, b + d); }
  bool in_line_at_half_turn() const { return same_length(a + d, b + c); }
  bool meets_bearing() const { return same_length(a, d) && same_length(b, c); }  // A comes to D at φ = 0
  bool changes() const { return in_line_at_zero() || in_line_at_half_turn(); }
  // Of a crank that does not turn fully, where AD cannot be all that a turn asks for; with stops on both sides of the
  // ground the arc of 0 < φ < π. Empty: it turns, or the loop cannot be closed at all.
  std::optional<CrankArc> arc() const;
  // Of a kite with its coupler on the crank and its follower on the ground for good, if B lies on that side.
  bool folds(bool left) const { return !left && same_length(a, b) && same_length(c, d); }
};

// Directions from A along the coupler and from D along the follower, which meet.
struct Meeting {
  Direction coupler, follower;
  long double sine = 0;  // of the angle from coupler to follower: 0 in a change point
};
// `left`: B lies left of the directed line A → D; of a linkage with change points, while 0 < φ < π.
Meeting meet(const FourBarLoop& loop, long double phi, bool left);

// A rod of length l from the pin of a crank r to the line y = e.
struct SliderLoop {
  long double r, l, e;                                               // r, l > 0 [m]
  bool changes() const { return same_length(l, r + std::fabs(e)); }  // at φ = ±π/2, where crank and rod stand upright
  // Of a rod too short for a turn: where −l ≤ e − r sin φ ≤ l; with stops on both sides of the line the arc about φ = 0.
  // Empty: the crank turns, or its pin comes nowhere within the rod's reach of the line.
  std::optional<CrankArc> arc() const;
};
// The rod's direction: towards +x or, `back`, towards −x; of one with change points, so at φ = 0.
// `crank`: its direction at φ.
Direction rod_to_line(const SliderLoop& loop, const Direction& crank, long double phi, bool back);

// The pin of a crank r in a slot that turns about D = (d, 0).
struct SlotLoop {
  long double r, d;                                   // [m], > 0
  bool changes() const { return same_length(r, d); }  // at φ = 0, where the pin passes over D
};
struct Slot {
  Direction along;  // from D to the pin, or once that has passed over D against it
  Taylor reach;     // of the pin along it [m]
};
Slot slot_to_pin(const SlotLoop& loop, long double phi);

// Direction of a link of this length from `joint` to the line y = height, towards +x or −x. Without change points.
Direction to_line(const Path& joint, long double height, long double length, bool backward);

}  // namespace kurbel
