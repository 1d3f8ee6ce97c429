// counterweights.cpp — orders of the shaking force, and counterweights by what they leave of it.
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "engine/numerics/angles.h"
#include "engine/numerics/roots.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {
namespace {

Force2 direction_of(double phi) { return {std::cos(phi), std::sin(phi)}; }

// What a counterweight opposite to the pin adds to the shaking force at constant speed: −U ω² r̂.
Force2 added(double moment, const PositionForces& p) {
  const double w = p.forces.state.omega;
  return -moment * w * w * direction_of(p.forces.state.phi);
}

// Half orders are of four-stroke engines; of longer cycles there would be many.
int parts_of_order(int turns) { return turns == 2 ? 2 : 1; }

}  // namespace

// a_k = 2/n Σ f cos kφ over whole turns; both ends are given, so the last one is omitted.
std::vector<ForceHarmonic> harmonics(const std::vector<double>& values, int turns, double* mean) {
  const std::size_t n = values.size() - 1;
  std::vector<ForceHarmonic> orders;
  const int parts = parts_of_order(turns);
  for (int k = 0; k <= highest_order * parts; ++k) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < n; ++i)
      sum += values[i] * std::polar(1.0, -k * turn * (turns / parts) * static_cast<double>(i) / static_cast<double>(n));
    sum /= static_cast<double>(n);
    if (k == 0 && mean) *mean = sum.real();
    if (k > 0) orders.push_back({static_cast<double>(k) / parts, {2 * std::abs(sum)}, -std::arg(sum)});
  }
  return orders;
}

std::vector<ForceHarmonic> measured_harmonics(const std::vector<double>& values, int turns, double scale) {
  std::vector<ForceHarmonic> orders = harmonics(values, turns);
  std::vector<double> half;
  for (std::size_t i = 0; i < values.size(); i += 2) half.push_back(values[i]);
  const std::vector<ForceHarmonic> other = harmonics(half, turns);
  for (std::size_t k = 0; k < orders.size(); ++k)
    orders[k].amplitude =
        estimate_from(orders[k].amplitude.value, other[k].amplitude.value, rounding_of_forces * scale);
  return orders;
}

// None; rotating masses; half of the reciprocating first order besides; and what makes the largest shaking force least
// (convex in the counterweight, as the largest of norms of affine functions is; by the golden section).
std::optional<Balancing> balancing_of(const MechanismData& data, const ForceCycle& turn_of_crank,
                                      const std::vector<PositionForces>& samples,
                                      const std::function<PositionForces(double phi)>& at) {
  const auto* const crank = data.as<SliderCrankData>();
  if (!crank) return {};
  const SliderCrankData& d = *crank;
  const double share = d.rod_com / d.rod_length;  // of the rod's mass that goes with the slider
  Balancing out{.data = d,
                .rotating_moment = d.crank_mass * d.crank_com + d.rod_mass * (1 - share) * d.radius,
                .reciprocating_mass = d.slider_mass + d.rod_mass * share,
                .counterweights = {}};
  const double rotating = out.rotating_moment, reciprocating = out.reciprocating_mass * d.radius;
  const auto shaking = [](double moment, const PositionForces& p) {
    return (p.forces.shaking_force + added(moment, p)).magnitude();
  };
  const auto on_grid = [&](double moment) {
    double largest = 0;
    for (const PositionForces& p : turn_of_crank.positions) largest = std::max(largest, shaking(moment, p));
    return largest;
  };
  const double best = find_maximum([&](double moment) { return -on_grid(moment); }, rotating - 2 * reciprocating,
                                   rotating + 2 * reciprocating, 100)
                          .at;
  std::vector<double> phi;
  for (const PositionForces& p : samples) phi.push_back(p.forces.state.phi);
  const auto peak = [&](auto&& value) -> Estimate {
    std::vector<double> values;
    for (const PositionForces& p : samples) values.push_back(value(p));
    double largest = 0;
    for (const double v : values) largest = std::max(largest, v);
    return measured_peak_of(
        phi, values, [&](double x) { return value(at(x)); }, largest);
  };
  const int turns = static_cast<int>(std::lround(turn_of_crank.cycle / turn));
  const auto first = static_cast<std::size_t>(parts_of_order(turns) - 1);  // order 1
  const auto propose = [&](const std::string& name, double moment) {
    Counterweight c;
    c.name = name;
    c.moment = moment;
    c.reciprocating_share = reciprocating > 0 ? (moment - rotating) / reciprocating : 0;
    std::vector<double> x, y;
    for (const PositionForces& p : turn_of_crank.positions) {
      c.shaking.push_back(p.forces.shaking_force + added(moment, p));
      x.push_back(c.shaking.back().x);
      y.push_back(c.shaking.back().y);
    }
    c.peak_force = peak([&](const PositionForces& p) { return shaking(moment, p); });
    // The bearing carries it: the frame's force on the crank is less by the counterweight's inertia force.
    c.peak_bearing =
        peak([&](const PositionForces& p) { return (p.forces.joints[0].force - added(moment, p)).magnitude(); });
    c.first_x = measured_harmonics(x, turns, c.peak_force.value)[first].amplitude;
    c.first_y = measured_harmonics(y, turns, c.peak_force.value)[first].amplitude;
    out.counterweights.push_back(std::move(c));
  };
  propose("as it is", 0);
  propose("rotating masses", rotating);
  propose("rotating masses and half the reciprocating ones", rotating + 0.5 * reciprocating);
  propose("least peak of the shaking force", best);
  return out;
}

}  // namespace kurbel
