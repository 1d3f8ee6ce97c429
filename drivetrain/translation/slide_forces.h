// slide_forces.h — forces on what a shaft moves in a straight line, as torques on that shaft.
//
//     s = k φ,   M = k F,   J = m k²;   k [m/rad]: P/(2π) of a screw of lead P, r of a pinion or drum       (theory 7.12)
// s counts in the direction of drive, F [N] is positive along it.
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/elements/piece_guard.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// F = −m g sin β on a line that rises at β. Gone with the effect "gravity".
struct SlideWeight {
  static constexpr ShaftTraits is{.account = Account::weight, .other_forms = true};
  double torque_back = 0;  // k m g sin β [N·m]

  template <class T>
  T torque(const ShaftState<T>&) const {
    return T(-torque_back);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {std::abs(torque_back), 0}; }
};

// F = −μ m g cos β sgn v, and holds as much at standstill. Gone with the effect "gravity".
struct SlideFriction {
  static constexpr ShaftTraits is{.account = Account::harmful, .directional = true, .other_forms = true};
  double dry = 0;  // k μ m g cos β [N·m], ≥ 0

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return T(-dry * x.direction);
  }
  Hold hold(const ShaftState<double>&) const { return {-dry, dry}; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {dry, 0}; }
};

// F = −f(s), and on the way back −f_back(s) where that is given. What has been travelled since the start is a state of
// its own, so that s counts every turn. At standstill it has the value of the way back and holds what the way forwards resists more: the true
// force then lies anywhere between the branches.
struct ForceOverTravel {
  static constexpr ShaftTraits is{.directional = true, .guards = 2, .states = 1};
  Account work_account = Account::useful;
  Curve forwards, back;   // [m] → resisting force [N]; back may be empty
  double per_radian = 1;  // k [m/rad], > 0
  double start = 0;       // s at the start [m]

  const Curve& branch(int direction) const { return back.empty() || direction > 0 ? forwards : back; }
  template <class T>
  T torque(const ShaftState<T>& x) const {
    return -per_radian * branch(x.direction).value_in(x.mode, travel(x));
  }
  Hold hold(const ShaftState<double>& x) const {
    if (back.empty()) return {};
    const double more = forwards.value(travel(x)) - back.value(travel(x));
    return more > 0 ? Hold{-per_radian * more, 0} : Hold{};
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const {
    rate[0] = per_radian * x.rate;
  }
  void first_states(const ShaftState<double>&, double* own) const { own[0] = 0; }
  OwnState state(int) const { return {"travelled", "m", span()}; }
  template <class T>
  T travel(const ShaftState<T>& x) const {
    return start + x.own[0];
  }
  double span() const { return forwards.x().back() - forwards.x().front(); }
  void guard(const ShaftState<double>& x, double* g) const {
    PieceGuard::guard(branch(x.direction), x.mode, travel(x), span(), g);
  }
  int first_mode(const ShaftState<double>& x) const { return branch(x.direction).piece(travel(x)); }
  int next_mode(const ShaftState<double>& x, int which) const {
    return PieceGuard::next(branch(x.direction), x.mode, which);
  }
  std::string mode_name(int) const { return {}; }  // a table's knots are no events worth telling
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {per_radian * forwards.max_abs(), 0}; }
};

ShaftForm under(const SlideWeight&, const Effects& effects);
ShaftForm under(const SlideFriction&, const Effects& effects);

}  // namespace kurbel
