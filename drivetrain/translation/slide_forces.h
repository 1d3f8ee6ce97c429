// slide_forces.h — forces on a slide, as torques on the shaft that moves it.
//
//     s = k φ,   M = k F,   J = m k²;   k [m/rad]: P/(2π) of a screw of lead P, r of a pinion or drum       (theory 7.12)
// s and the force F [N] are positive in the direction of drive.
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/elements/piece_guard.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// F = −m g sin β, β: inclination of the direction of drive. Needs the effect "gravity".
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

// F = −μ m g cos β sgn v, and the same static friction. Needs the effect "gravity".
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

// F = −f(s), and in backward motion −f_back(s) if given. The travel since the start is an internal state, so that s
// counts full turns. At standstill the force is that of the backward branch plus a static friction up to the difference of
// the branches: the actual force lies between the branches.
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
  InternalState state(int) const { return {"travelled", "m", span()}; }
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
  std::string mode_name(int) const { return {}; }  // passing a point of a table is not reported
  bool uses_time() const { return false; }
  bool uses_speed() const { return false; }
  Rated rated() const { return {per_radian * forwards.max_abs(), 0}; }
};

ShaftForm under(const SlideWeight&, const Effects& effects);
ShaftForm under(const SlideFriction&, const Effects& effects);

}  // namespace kurbel
