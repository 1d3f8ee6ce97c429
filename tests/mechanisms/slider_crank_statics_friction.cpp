// slider_crank_statics_friction.cpp — the friction laws, solved together with the reactions; acceleration under a torque, implicit
// through the friction; torques at rest.
#include "tests/mechanisms/slider_crank_statics_friction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/equations/jam.h"

namespace kurbel {
SliderCrankStatics::Law::Loads SliderCrankStatics::Law::value(const Column& r) const {
  Loads q;
  for (int k = 0; k < 3; ++k) q[k] = circle[k] * size(r, k);
  q[3] = guide * bearing_sum(r);
  q[4] = guide * half_width * r[guide_n];
  return q;
}

SliderCrankStatics::Law::Slopes SliderCrankStatics::Law::slope(const Column& r) const {
  Slopes d;
  for (int k = 0; k < 3; ++k) {
    const double force = size(r, k);
    if (force == 0) continue;
    d.on[k][0] = {2 * k, circle[k] * r[2 * k] / force};
    d.on[k][1] = {2 * k + 1, circle[k] * r[2 * k + 1] / force};
  }
  if (at_edges(r)) {
    const int side = sign(moment(r));
    d.on[3][0] = {guide_m, guide * side * 2 / length};
    d.on[3][1] = {guide_n, -guide * side * 2 / length * middle};
  } else {
    d.on[3][0] = {guide_n, guide * sign(r[guide_n])};
  }
  d.on[4][0] = {guide_n, guide * half_width};
  return d;
}

double SliderCrankStatics::Law::bearing_sum(const Column& r) const {
  return at_edges(r) ? 2 * std::abs(moment(r)) / length : std::abs(r[guide_n]);
}

SliderCrankStatics::Law SliderCrankStatics::law_at(const CrankState& state) const {
  const int direction = state.direction != 0 ? state.direction : sign(state.omega);
  const Rates unit = rates(state.phi, direction);  // for the signs, also at standstill
  const double speed = std::abs(state.omega);
  const auto coefficient = [&](const FrictionCoefficient& f, double sliding_speed) {
    return state.at_rest ? f.resting : f.in_motion(sliding_speed);
  };
  const auto revolute = [&](const RevoluteJoint& joint, double rate) {
    return -sign(rate) * friction_circle_radius(joint.radius, coefficient(joint.friction, rate * speed * joint.radius));
  };
  const SliderGuide& g = joints_.guide;
  Law law{};
  law.circle[0] = revolute(joints_.main_bearing, unit.main_bearing);
  law.circle[1] = revolute(joints_.crank_pin, unit.crank_pin);
  law.circle[2] = revolute(joints_.slider_pin, unit.slider_pin);
  law.guide = -sign(unit.slider) * (coefficient(g.friction, unit.slider * speed) +
                                    (g.rolling_arm > 0 ? g.rolling_arm / g.roller_radius : 0.0));
  law.length = g.length;
  law.middle = g.middle;
  law.half_width = 0.5 * g.width;
  return law;
}

bool SliderCrankStatics::Solution::settle(const Law& law, double share, const Influence& influence,
                                          const Column& base) {
  double last = HUGE_VAL;
  Law::Loads before = q;
  for (int i = 0; i < 40; ++i) {
    const Column r = base + influence * q;
    const Law::Loads wanted = share * law.value(r);
    const Law::Loads error = q - wanted;
    const double scale = std::max(wanted.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
    const double left = error.cwiseAbs().maxCoeff() / scale;
    if (!std::isfinite(left)) return false;
    // At the rounding floor a step no longer helps.
    if (last < 1e-12 && left >= last) {
      q = before;
      return lu.determinant() > 0;
    }
    ++iterations;
    residual = left;
    law_slope = share * law.slope(r);
    lu = FrictionLu(FrictionLu::Matrix::Identity() - law_slope * influence);
    if (!std::isfinite(lu.determinant())) return false;
    if (left <= 4e-15) return lu.determinant() > 0;
    if (lu.determinant() == 0) return false;
    before = q;
    last = left;
    q -= lu.solve(error);
  }
  return false;
}

// q = s · law(base + U q), led from s = 0 to 1. The solution wanted is the one connected with the
// frictionless one: along it the determinant of 1 − s ∂law/∂q keeps its sign; where it would vanish the joints jam.
SliderCrankStatics::Solution SliderCrankStatics::solve_friction(const Table& unit, const Column& base, const Law& law,
                                                                double phi) const {
  Solution solution;
  if (law.none()) return solution;
  const Solution::Influence influence = unit.rightCols<frictions>();
  double share = 0, step = 1;
  constexpr double least_step = 1.0 / 4096;
  while (share < 1) {
    const double next = std::min(1.0, share + step);
    Solution trial = solution;
    if (trial.settle(law, next, influence, base)) {
      solution = trial;
      share = next;
      step *= 2;
      continue;
    }
    solution.iterations = trial.iterations;
    step /= 2;
    if (step < least_step)
      throw Jam(
          fmt::format("slider-crank: its joints jam at phi = {:.6g} deg: from {:.3g} % of the given friction on no "
                      "finite reactions satisfy the friction laws; lower the coefficients, lengthen the rod, or "
                      "lengthen the guide",
                      phi * 180 / std::acos(-1.0), 100 * share));
  }
  return solution;
}

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
