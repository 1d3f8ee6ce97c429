// clutch.h — friction clutch, torque limiter, one-way clutch, friction brake.
//
//     slipping:  τ = p M(|v|) sgn v,  M(v) = M_k + M′ v  ≥ 0,   v = θ̇
//     locked:    |τ| ≤ p M_s,  M_s ≥ M_k
// p is the command of the operating sequence (pressure over rated pressure); M_s static, M_k kinetic capacity.
#pragma once

#include <limits>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Friction clutch and torque limiter. Capacity of n plates: M_k = n μ_k F r_m, r_m = ⅔ (r_o³ − r_i³)/(r_o² − r_i²)
// (uniform pressure) — clutch_kinds.cpp.
struct FrictionClutch {
  static constexpr ConnectionTraits is{.slips = true, .commanded = true};
  double kinetic = 0;    // M_k at v → 0 [N·m], ≥ 0
  double breakaway = 0;  // M_s [N·m], ≥ M_k
  double slope = 0;      // M′, change of the kinetic capacity with the speed of slip [N·m·s/rad]

  template <class T>
  T torque(const Twist<T>& x) const {
    const T speed = static_cast<double>(x.direction) * x.rate;
    const T capacity = kinetic + slope * speed;
    if (value_of(capacity) < 0) return T(0.0);
    return x.command * static_cast<double>(x.direction) * capacity;
  }
  Hold hold(const Twist<double>& x) const { return {-x.command * breakaway, x.command * breakaway}; }
  double capacity() const { return breakaway; }
};

// One-way clutch: transmits only τ ≥ 0; b may run ahead of a (v < 0), dragging with M_k.
struct OneWayClutch {
  static constexpr ConnectionTraits is{.slips = true};
  double drag = 0;  // M_k while overrunning [N·m], ≥ 0

  template <class T>
  T torque(const Twist<T>& x) const {
    return T(drag * x.direction);
  }
  Hold hold(const Twist<double>&) const { return {-drag, std::numeric_limits<double>::infinity()}; }
  double capacity() const { return std::numeric_limits<double>::infinity(); }
};

// Brake on one shaft: M = −p M_k(|ω|) sgn ω, holds up to p M_s.
struct FrictionBrake {
  static constexpr ShaftTraits is{.account = Account::harmful, .directional = true, .commanded = true};
  double kinetic = 0, breakaway = 0;  // M_k, M_s [N·m]
  double slope = 0;                   // M′ [N·m·s/rad]

  template <class T>
  T torque(const ShaftState<T>& x) const {
    const T capacity = kinetic + slope * (static_cast<double>(x.direction) * x.rate);
    if (value_of(capacity) < 0) return T(0.0);
    return -x.command * static_cast<double>(x.direction) * capacity;
  }
  Hold hold(const ShaftState<double>& x) const { return {-x.command * breakaway, x.command * breakaway}; }
  bool opens_at_zero() const { return false; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return slope != 0; }
  Rated rated() const { return {breakaway, 0}; }
};

}  // namespace kurbel
