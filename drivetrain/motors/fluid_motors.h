// fluid_motors.h — hydraulic and pneumatic motors by their static characteristics.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/elements/element.h"
#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"
#include "engine/numerics/roots.h"

namespace kurbel {

// Hydraulic motor of displacement V (per radian) on a pump of constant flow Q with a relief valve set to Δp_r:
//     M = η_hm Δp V,    Q = V ω + G Δp + Q_relief,    G Δp_r = (1 − η_v) Q   (leakage, proportional to the pressure)
//
//     M |----.____                  ω₁ = η_v Q/V   flow-limited speed: up to here the relief valve is open
//       |         '\                ω₂ = Q/V       the motor takes the whole flow: zero pressure
//       +-----------\________ ω     between them Δp = Δp_r (ω₂ − ω)/(ω₂ − ω₁)
//                 ω₁ ω₂
// Relief line: for a valve with the pressure rise δp at the whole flow, Q_relief = (Δp − Δp_r) Q/δp,
//     Δp = (Q (1 + Δp_r/δp) − V ω)/(G + Q/δp)  below ω₁, also where the motor is driven backwards.
// Above ω₂ an anti-cavitation valve keeps Δp at zero. η_hm is that of motoring everywhere. Sources: ISO 4391
// (efficiencies); Findeisen, Ölhydraulik.
struct HydraulicMotor {
  double displacement = 0;                // V [m³/rad], > 0
  double relief_pressure = 0;             // Δp_r [Pa], > 0
  double flow = 0;                        // Q [m³/s], > 0
  double volumetric_efficiency = 0;       // η_v at Δp_r and ω₁, 0 < η_v < 1
  double hydromechanical_efficiency = 1;  // η_hm, 0 … 1
  double relief_rise = 0;                 // δp [Pa], ≥ 0

  double no_load_speed() const { return flow / displacement; }                               // ω₂
  double flow_limited_speed() const { return volumetric_efficiency * flow / displacement; }  // ω₁
  double torque_at(double pressure) const { return hydromechanical_efficiency * pressure * displacement; }
  double pressure_on_relief_line(double speed) const {
    if (relief_rise == 0) return relief_pressure;
    const double over = relief_pressure / relief_rise;
    return (1 + over - displacement * speed / flow) / ((1 - volumetric_efficiency) / relief_pressure + 1 / relief_rise);
  }
  Curve curve() const {  // linear between the points; constant below −ω₂
    const double far = -no_load_speed();
    return Curve({far, flow_limited_speed(), no_load_speed()},
                 {torque_at(pressure_on_relief_line(far)), torque_at(relief_pressure), 0}, Curve::Form::linear);
  }
};

// Pneumatic (vane or piston) motor at constant supply pressure: nearly a straight line from the stall torque to the
// free speed, with x = ω/ω₀
//     M = M_s (1 − x)(1 + b x),  P = M ω: for b = 0 greatest at half the free speed, P_max = M_s ω₀/4
// b (−1 … 1) is the curvature that fits P_max, M_s and ω₀ of the catalogue. Outside 0 … ω₀ the tangents continue the line.
// Source: Atlas Copco, Pocket Guide to Air Motors (performance curves).
struct PneumaticMotor {
  static constexpr ShaftTraits is{.account = Account::driving, .guards = 2};
  double stall_torque = 0;  // M_s [N·m], > 0
  double free_speed = 0;    // ω₀ [rad/s], > 0
  double bend = 0;          // b, −1 … 1

  // Maximum of x (1 − x)(1 + b x): P_max/(M_s ω₀). From 4/27 (b = −1) to 2/√27 (b = 1).
  static double power_number(double b) {
    const double x = speed_of_greatest_power(b);
    return x * (1 - x) * (1 + b * x);
  }
  // Root of 1 + 2 (b − 1) x − 3 b x² in 0 … 1, without cancellation.
  static double speed_of_greatest_power(double b) { return 1 / ((1 - b) + std::sqrt((1 - b) * (1 - b) + 3 * b)); }
  // b for a given power number, by bisection.
  static double bend_for(double power_number_wanted) {
    return halved({-1, 1}, 60, [&](double b) { return power_number(b) < power_number_wanted; }).middle();
  }

  template <class T>
  T torque(const ShaftState<T>& x) const {
    const T part = x.rate / free_speed;
    if (x.mode == 0) return stall_torque * (1.0 + (bend - 1) * part);
    if (x.mode == 2) return stall_torque * (1 + bend) * (1.0 - part);
    return stall_torque * (1.0 - part) * (1.0 + bend * part);
  }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return {stall_torque, free_speed}; }
  // Modes: driven backwards, motor, driven beyond its free speed.
  void guard(const ShaftState<double>& x, double* g) const {
    const double part = x.rate / free_speed;
    g[0] = x.mode == 0 ? 1 : x.mode == 1 ? std::min(1.0, part) : std::min(1.0, part - 1);
    g[1] = x.mode == 0 ? std::min(1.0, -part) : x.mode == 1 ? std::min(1.0, 1 - part) : 1;
  }
  int first_mode(const ShaftState<double>& x) const { return x.rate < 0 ? 0 : x.rate < free_speed ? 1 : 2; }
  int next_mode(const ShaftState<double>& x, int which) const { return x.mode + (which == 0 ? -1 : 1); }
  std::string mode_name(int) const { return {}; }
};

}  // namespace kurbel
