// slider_crank_acceleration.cpp — acceleration under a torque, implicit through the friction; torques at rest.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "mechanisms/slider_crank/slider_crank_friction.h"

namespace kurbel {

// dq/dε = (1 − ∂law/∂q)⁻¹ (∂law/∂R) R_ε.
SliderCrankStatics::FrictionTorque SliderCrankStatics::torque_of(const Table& unit, const Solution& solution) const {
  const auto row = unit.rightCols<frictions>().row(torque_m);
  const Law::Loads dq = solution.lu.solve(solution.law_slope * unit.col(acceleration_case));
  return {row.dot(solution.q), row.dot(dq)};
}

double SliderCrankStatics::acceleration(CrankState state, double torque, double shaft_inertia) const {
  const Table unit = unit_cases(state.phi);
  const Law law = law_at(state);
  const double inertia = unit(torque_m, acceleration_case) + shaft_inertia;
  if (!(inertia > 0))
    throw std::invalid_argument(
        fmt::format("slider-crank: reduced inertia at phi = {:g} rad is {:g} kg m2 with the shaft's {:g}; must be > 0 "
                    "for a torque to accelerate it: give crank or slider a mass",
                    state.phi, inertia, shaft_inertia));
  const auto excess = [&](double alpha, double& slope) {  // M(ε) + J ε − torque
    state.alpha = alpha;
    const FrictionTorque friction = torque_of(unit, solve_friction(unit, load_column(unit, state), law, state.phi));
    slope = inertia + friction.slope;
    return load_column(unit, state)[torque_m] + friction.torque + shaft_inertia * alpha - torque;
  };
  state.alpha = 0;
  double alpha = (torque - load_column(unit, state)[torque_m]) / inertia;  // frictionless
  double low = -HUGE_VAL, high = HUGE_VAL, slope = 0;
  for (int i = 0; i < 200; ++i) {
    const double error = excess(alpha, slope);
    (error < 0 ? low : high) = alpha;
    if (error == 0) return alpha;
    double next = alpha - error / slope;
    // Newton's step where the slope is that of an inertia and leads into the bracket; else the bracket's middle.
    if (!(slope > 0) || !(next > low && next < high)) {
      if (!std::isfinite(low) || !std::isfinite(high))
        next = alpha - 2 * error / inertia;
      else
        next = 0.5 * (low + high);
    }
    if (std::abs(next - alpha) <= 4e-16 * std::abs(next) || high - low <= 4e-16 * std::abs(alpha)) return next;
    alpha = next;
  }
  return alpha;
}

SliderCrankStatics::Range SliderCrankStatics::resting_torque(double phi, double slider_force) const {
  const auto limit = [&](int direction) {
    try {
      return solve({.phi = phi, .slider_force = slider_force, .direction = direction, .at_rest = true}).torque;
    } catch (const std::runtime_error&) {  // locks itself
      return direction * HUGE_VAL;
    }
  };
  return {limit(-1), limit(1)};
}

}  // namespace kurbel
