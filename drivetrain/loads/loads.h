// loads.h — resistances on a shaft: dry, viscous, quadratic.
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// M = −(M₀ sgn ω + b ω + q ω |ω|). The dry part opposes the motion and holds at standstill up to M₀.
struct OpposingLoad {
  static constexpr ShaftTraits is{.directional = true};
  Account work_account = Account::useful;
  double dry = 0;          // M₀ [N·m], ≥ 0
  double viscous = 0;      // b [N·m·s/rad], ≥ 0
  double quadratic = 0;    // q [N·m·s²/rad²], ≥ 0
  double rated_speed = 0;  // [rad/s], for error scales

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return -dry * x.direction - (viscous + quadratic * (x.direction * x.rate)) * x.rate;
  }
  Hold hold(const ShaftState<double>&) const { return {-dry, dry}; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return viscous != 0 || quadratic != 0; }
  Rated rated() const { return {dry, rated_speed}; }
};

// M = −(b ω + q ω |ω|): smooth through standstill, no static torque. The sign of q ω |ω| is that of ω itself, not a mode.
struct SpeedLoad {
  static constexpr ShaftTraits is{};
  Account work_account = Account::useful;
  double viscous = 0;    // b [N·m·s/rad], ≥ 0
  double quadratic = 0;  // q [N·m·s²/rad²], ≥ 0

  template <class T>
  T torque(const ShaftState<T>& x) const {
    using std::abs;
    return -(viscous + quadratic * abs(x.rate)) * x.rate;
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return viscous != 0 || quadratic != 0; }
  Rated rated() const { return {}; }
};

}  // namespace kurbel
