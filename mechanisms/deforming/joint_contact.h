// joint_contact.h — contact of two surfaces in a joint with clearance: force over depth and approach speed.
//
//     N = k c (δ/c)ⁿ (1 + λ δ̇), ≥ 0                      δ depth > 0, c the joint's gap       (Hunt and Crossley,
//     T = μ N tanh(v_t/v₀)                               v_t sliding speed                    J. Appl. Mech. 42, 1975)
// k refers to the depth c, so that its unit is N/m for every n (Hertz: n = 3/2, line contact: n = 1).
// In a normal impact with the speed v before and v′ after it, both > 0, for any n, k and mass:
//     λ v − ln(1 + λ v) = −λ v′ − ln(1 − λ v′)                                                                     (1)
// Modes: in flight, touching, parting (the surfaces separate faster than they recover: zero force, no pulling).
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/numerics/dual.h"
#include "engine/numerics/roots.h"

namespace kurbel {

struct JointContact {
  enum Mode : int { flight = 0, touching = 1, parting = 2, without_events = 3 };
  static constexpr int guards = 2;
  double gap = 0;             // c [m], > 0
  double stiffness = 0;       // k [N/m], > 0
  double exponent = 1.5;      // n, ≥ 1
  double damping = 0;         // λ [s/m], ≥ 0
  double friction = 0;        // μ, ≥ 0
  double friction_speed = 0;  // v₀ [m/s], > 0 where μ > 0

  // k c (δ/c)ⁿ
  template <class T>
  T elastic(const T& depth) const {
    if (exponent == 1) return stiffness * depth;
    if (value_of(depth) <= 0) return T(0.0);
    using std::pow;
    return stiffness * gap * pow(depth / gap, exponent);
  }
  template <class T>
  T normal(int mode, const T& depth, const T& rate) const {
    if (mode == without_events) mode = value_of(depth) > 0 && 1 + damping * value_of(rate) > 0 ? touching : flight;
    if (mode != touching) return T(0.0);
    return elastic(depth) * (1.0 + damping * rate);
  }
  template <class T>
  T tangential(const T& normal, const T& sliding) const {
    if (friction == 0) return T(0.0);
    using std::tanh;
    return friction * normal * tanh(sliding / friction_speed);
  }
  double stored(int mode, double depth) const {
    return mode == flight || depth <= 0 ? 0 : elastic(depth) * depth / (exponent + 1);
  }

  int first_mode(double depth, double rate) const {
    if (depth <= 0) return flight;
    return 1 + damping * rate < 0 ? parting : touching;
  }
  void guard(int mode, double depth, double rate, double* g) const {
    g[0] = g[1] = 1;
    if (mode == without_events) return;
    g[0] = mode == flight ? -depth / gap : depth / gap;
    if (mode != flight && damping > 0) g[1] = mode == touching ? 1 + damping * rate : -(1 + damping * rate);
  }
  int next_mode(int mode, int which) const {
    if (mode == flight) return touching;
    if (which == 0) return flight;
    return mode == touching ? parting : touching;
  }

  // λ for v′ = e v at the speed v: bisection of (1) over λ v.
  static double damping_for(double restitution, double speed) {
    if (restitution >= 1) return 0;
    const auto surplus = [&](double u) { return u - std::log1p(u) + restitution * u + std::log1p(-restitution * u); };
    const double most = 1 / std::max(restitution, 1e-9) * (1 - 1e-15);
    return halved({0, most}, 200, [&](double u) { return surplus(u) > 0; }).middle() / speed;
  }
};

}  // namespace kurbel
