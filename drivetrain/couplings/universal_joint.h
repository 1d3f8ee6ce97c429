// universal_joint.h — Hooke's (universal, Cardan) joint between two shafts at an angle β, on an elastic shaft.
//
//     tan φ₂ = tan φ₁/cos β,   ω₂/ω₁ = g′(φ₁) = cos β/(1 − sin² β cos² φ₁),   φ₂ = g(φ₁) = φ₁ + δ(φ₁)
//     u = g(φ_a) − φ_b = θ + δ,  τ = k u + c u̇ on b,  −g′ τ on a: power in = power out + loss
// δ has the period π and the maximum tan δ = ½ (1/√cos β − √cos β). φ₁ = φ_a + phase; without load φ_b = 0 at φ_a = 0.
// The driven shaft is fastest at φ₁ = 0: ω₂ = ω₁/cos β.
// Source: Shigley, Uicker: Theory of Machines and Mechanisms, "Universal joints"; Dubbel, G3.
#pragma once

#include <cmath>
#include <string>

#include "drivetrain/couplings/coupling.h"
#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Kinematics of the joint at shaft angle β, 0 ≤ β < 90°.
struct HookeJoint {
  double angle = 0;  // β [rad]

  template <class T>
  T ratio(const T& phi) const {  // g′
    using std::cos;
    const T c = cos(phi);
    return std::cos(angle) / (1.0 - std::sin(angle) * std::sin(angle) * (c * c));
  }
  double advance(double phi) const {  // δ
    const double s = std::sin(phi), c = std::cos(phi);
    return std::atan2((1 - std::cos(angle)) * s * c, std::cos(angle) * c * c + s * s);
  }
  template <int N>
  Dual<N> advance(const Dual<N>& phi) const {
    return phi.chain(advance(phi.value), ratio(phi.value) - 1);
  }
  double ratio_slope(double phi) const {  // g″; the driven shaft has the acceleration g″ ω₁² + g′ ε₁
    const double s2 = std::pow(std::sin(angle), 2), c = std::cos(phi);
    return -std::cos(angle) * s2 * std::sin(2 * phi) / std::pow(1 - s2 * c * c, 2);
  }
  double greatest_ratio() const { return 1 / std::cos(angle); }
  double least_ratio() const { return std::cos(angle); }
};

struct UniversalJoint {
  static constexpr ConnectionTraits is{.uses_angle = true,
                                       .uses_speeds = true,
                                       .turns_unevenly = true,
                                       .spring_takes_motion = true,
                                       .reports_loss = true,
                                       .described = true};
  double stiffness = 0;  // k [N·m/rad], > 0
  double damping = 0;    // c [N·m·s/rad], ≥ 0
  HookeJoint joint;
  double phase = 0;  // [rad]

  template <class T>
  T torque(const Twist<T>& x) const {
    return stiffness * twist(x) + damping * twist_rate(x);
  }
  template <class T>
  T turning_torque(const Twist<T>& x) const {
    return -(torque(x) * (joint.ratio(x.turn + phase) - 1.0));
  }
  double spring_torque(const Twist<double>& x) const { return stiffness * twist(x); }
  double energy(const Twist<double>& x) const { return 0.5 * stiffness * std::pow(twist(x), 2); }
  double loss_power(const Twist<double>& x) const { return damping * std::pow(twist_rate(x), 2); }
  double twist_at(double torque) const { return torque / stiffness; }
  double stiffness_at_rest() const { return stiffness; }
  double rest_twist(double turn) const { return joint.advance(phase) - joint.advance(turn + phase); }
  double rest_ratio(double turn) const { return joint.ratio(turn + phase); }
  double rest_ratio_slope(double turn) const { return joint.ratio_slope(turn + phase); }
  std::string describe() const;

 private:
  template <class T>
  T twist(const Twist<T>& x) const {  // u
    return x.angle + joint.advance(x.turn + phase) - joint.advance(phase);
  }
  template <class T>
  T twist_rate(const Twist<T>& x) const {  // u̇
    return x.rate + (joint.ratio(x.turn + phase) - 1.0) * x.turn_rate;
  }
};

// Data of the scene.
struct UniversalJointData {
  using Element = UniversalJoint;
  CouplingData spring;
  HookeJoint joint;
  double phase = 0;

  bool damping_hangs_on_inertia() const { return spring.damping_hangs_on_inertia(); }
  UniversalJoint settled(double inertia) const {
    const Coupling plain = spring.settled(inertia);
    return {plain.stiffness, plain.damping, joint, phase};
  }
};

}  // namespace kurbel
