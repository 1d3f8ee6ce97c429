// kloss.h — induction motor by Kloss' static characteristic M(ω) (theory 4.1).
#pragma once

#include <cmath>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Induction motor after Kloss, written without dividing by the slip:
//   M = 2 M_b (1 + a s_b) s s_b/(s² + s_b² + 2 a s_b² s),   s = (ω_s − ω)/ω_s              (theory 4.1)
// M_b scales with the squares of the voltage factor and of the command c of an operating sequence; c < 0 reverses the
// field: M = sgn c · c² M(ω sgn c). 0 is off.
struct InductionMotor {
  static constexpr ShaftTraits is{.account = Account::driving, .commanded = true, .reversible = true};
  double breakdown_torque = 0;   // M_b [N·m], > 0
  double synchronous_speed = 0;  // ω_s [rad/s], > 0
  double breakdown_slip = 0;     // s_b [1], > 0
  double resistance_ratio = 0;   // a = R_s/R_r′ [1], ≥ 0
  double rated_torque = 0;       // M_n [N·m]

  template <class T>
  T torque(const ShaftState<T>& x) const {
    const double sense = x.command < 0 ? -1 : 1;
    return sense * x.command * x.command * torque_in(0, sense * x.rate);
  }
  bool opens_at_zero() const { return true; }
  // One smooth piece, for starters.
  static constexpr int pieces = 1;
  template <class T>
  T torque_in(int, const T& speed) const {
    const T slip = (synchronous_speed - speed) / synchronous_speed;
    const double sb = breakdown_slip, a = resistance_ratio;
    return 2 * breakdown_torque * (1 + a * sb) * sb * slip / (slip * slip + sb * sb + 2 * a * sb * sb * slip);
  }
  int piece_at(double) const { return 0; }
  void guard_piece(int, double, double*) const {}
  int next_piece(int piece, int) const { return piece; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return {rated_torque, synchronous_speed}; }

  // The denominator s² + 2 a s_b² s + s_b² has no real root: a s_b < 1.
  bool has_no_pole() const { return breakdown_slip > 0 && resistance_ratio * breakdown_slip < 1; }

  // Catalogue data: M_n = P_n/ω_n, s_n = (ω_s − ω_n)/ω_s, s_b = s_n (ν + √(ν² − 1)), ν = M_b/M_n (exact for a = 0).
  // With a > 0 the same ν and s_n give s_b from M(s_n) = M_n, a quadratic in s_b.
  static InductionMotor from_catalogue(double rated_power, double rated_speed, double synchronous_speed,
                                       double breakdown_ratio, double resistance_ratio, double voltage_factor);
};

inline InductionMotor InductionMotor::from_catalogue(double rated_power, double rated_speed, double synchronous_speed,
                                                     double breakdown_ratio, double resistance_ratio,
                                                     double voltage_factor) {
  const double rated_torque = rated_power / rated_speed;
  const double s = (synchronous_speed - rated_speed) / synchronous_speed;
  const double nu = breakdown_ratio, a = resistance_ratio;
  // s² + s_b² + 2 a s_b² s = 2 ν (1 + a s_b) s s_b  ⇔  A s_b² − 2 ν s s_b + s² = 0 with A = 1 + 2 a s − 2 ν a s
  const double A = 1 + 2 * a * s * (1 - nu);
  const double root = std::sqrt(nu * nu - A);
  const double breakdown_slip = s * (nu + root) / A;
  return {nu * rated_torque * voltage_factor * voltage_factor, synchronous_speed, breakdown_slip, a, rated_torque};
}

}  // namespace kurbel
