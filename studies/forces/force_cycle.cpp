// force_cycle.cpp — d'Alembert position by position, peaks, orders, powers and works of one cycle.
#include "studies/forces/force_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/model/model.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/roots.h"
#include "engine/scene/units.h"
#include "mechanisms/reduced/newton_euler.h"

namespace kurbel {
// --- one problem ---

CycleBuilder::CycleBuilder(const SliderCrankStatics& statics, OutputLoads& loads, ForceCycle& cycle)
    : statics_(statics), data_(statics.data()), loads_(loads), cycle_(cycle) {
  for (const WorkAccount& account : loads.model().accounts)
    cycle_.work.push_back({account.name, name_of(account.kind)});
  cycle_.work.push_back({"balancing torque", "driving"});
  for (std::size_t k = 0; k < joint_count; ++k)
    cycle_.work.push_back({std::string("friction of ") + name_of(static_cast<Joint>(k)), "harmful"});
}

CyclePosition CycleBuilder::at(double phi, CrankMotion motion) const {
  if (statics_.data().changes()) phi = beside_change_point(data_, phi);
  CyclePosition p;
  p.loads = motion.loads;
  p.state = {phi, motion.omega, motion.alpha, loads_.force(phi, motion)};
  const PlanarLinkage links = data_.linkage(phi);
  const ReducedSample reduced = rounded(closed_form_of(links));
  p.position = reduced.output_position;
  p.velocity = reduced.output_velocity_ratio * motion.omega;
  p.rod_angle = static_cast<double>(links.bodies[1].direction.angle());
  p.forces = statics_.solve(p.state);
  const double w = motion.omega;
  p.power = {.crank = p.forces.torque * w,
             .load = p.state.slider_force * p.velocity,
             .weight = reduced.gravity_torque * w,
             .kinetic_rate = (reduced.inertia * motion.alpha + 0.5 * reduced.inertia_slope * w * w) * w,
             .friction = p.forces.friction_loss()};
  return p;
}

void CycleBuilder::add(const Abscissa& where, CrankMotion motion) {
  Deadline::check();
  CyclePosition p = at(where.place(), motion);
  p.state.phi = where.phi;
  if (where.row) cycle_.rows.push_back(p);
  if (where.grid) cycle_.positions.push_back(p);
  if (where.row && !where.grid) return;
  samples_.push_back(p);
  if (where.weight == 0) return;
  // dA = M dφ, in the sense of the motion.
  const double dt = where.weight / std::abs(motion.omega);
  const auto share = loads_.shares(where.place(), motion);
  std::size_t k = 0;
  const auto account = [&](double power) {
    cycle_.work[k].work.value += power * dt;
    cycle_.work[k++].turnover += std::abs(power) * dt;
  };
  for (const double torque : share) account(torque * motion.omega);
  account(p.power.crank);
  for (const double lost : p.forces.friction_power) account(-lost);
  time_ += dt;
}

void CycleBuilder::finish() {
  const double mean_speed = std::copysign(cycle_.cycle / time_, cycle_.positions.front().state.omega);
  cycle_.mean_speed = {mean_speed, rounding_of_forces * std::abs(mean_speed)};
  // Speeds at both ends in the order of time.
  cycle_.first_speed = cycle_.positions.front().state.omega;
  cycle_.last_speed = cycle_.positions.back().state.omega;
  cycle_.closure = {(cycle_.last_speed - cycle_.first_speed) / mean_speed, 2 * rounding_of_forces};
  const auto kinetic = [&](const CyclePosition& p) {
    return 0.5 * closed_sample(data_, p.state.phi).inertia * p.state.omega * p.state.omega;
  };
  cycle_.kinetic_change = {kinetic(cycle_.positions.back()) - kinetic(cycle_.positions.front()), 0.0};
  for (const CyclePosition& p : cycle_.positions) cycle_.kinetic_most = std::max(cycle_.kinetic_most, kinetic(p));
  const auto by_angle = [](const CyclePosition& a, const CyclePosition& b) { return a.state.phi < b.state.phi; };
  for (auto* list : {&samples_, &cycle_.positions, &cycle_.rows}) std::sort(list->begin(), list->end(), by_angle);
  for (const CyclePosition& p : samples_) motion_.push_back({p.state.phi, {p.state.omega, p.state.alpha, p.loads}});
  find_extremes();
  collect_curves();
  find_harmonics();
  balance_powers();
  find_errors_of_works();
  judge_works(cycle_);
}

void CycleBuilder::find_extremes() {
  std::vector<double> phi;
  for (const CyclePosition& p : samples_) phi.push_back(p.state.phi);
  const auto largest = [&](auto&& value) {
    std::vector<double> values;
    for (const CyclePosition& p : samples_) values.push_back(value(p));
    return measured_peak_of(
        phi, values, [&](double x) { return value(at(x)); }, 0);
  };
  cycle_.reaction[0] = largest([](const CyclePosition& p) { return p.forces.main_bearing.magnitude(); });
  cycle_.reaction[1] = largest([](const CyclePosition& p) { return p.forces.crank_pin.magnitude(); });
  cycle_.reaction[2] = largest([](const CyclePosition& p) { return p.forces.slider_pin.magnitude(); });
  cycle_.reaction[3] = largest([](const CyclePosition& p) { return p.forces.guide; });
  cycle_.torque = largest([](const CyclePosition& p) { return p.forces.torque; });
  cycle_.shaking_force = largest([](const CyclePosition& p) { return p.forces.shaking_force.magnitude(); });
  cycle_.shaking_moment = largest([](const CyclePosition& p) { return p.forces.shaking_moment; });
  call_rounding_zero();
  cycle_.at_torque_peak = at(cycle_.torque.phi);
  std::tie(cycle_.least_speed, cycle_.greatest_speed) = speed_range(motion_);
  for (const CyclePosition& p : samples_) {
    cycle_.friction_residual = std::max(cycle_.friction_residual, p.forces.residual);
    cycle_.most_iterations = std::max(cycle_.most_iterations, p.forces.iterations);
  }
  for (const CyclePosition& p : cycle_.positions) cycle_.both_edges += p.forces.both_edges ? 1 : 0;
}

// A balancing torque that none is needed of, a shaking force that is balanced.
void CycleBuilder::call_rounding_zero() {
  constexpr double rounding = rounding_of_forces;
  double force = std::abs(cycle_.shaking_force.value);
  for (const Peak& p : cycle_.reaction) force = std::max(force, std::abs(p.value));
  const double torque = force * (statics_.data().radius + statics_.data().rod_length);
  const auto clean = [](Peak& p, double scale) {
    if (std::abs(p.value) <= rounding * scale) p = {};
    p.widen(rounding * scale), p.scale = scale;
  };
  for (Peak& p : cycle_.reaction) clean(p, force);
  clean(cycle_.shaking_force, force);
  clean(cycle_.torque, torque);
  clean(cycle_.shaking_moment, torque);
}

// The grid, both sides of every edge, and the peaks: a curve through them shows what the table says.
void CycleBuilder::collect_curves() {
  cycle_.curve = cycle_.positions;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    if (samples_[i].state.phi - samples_[i - 1].state.phi > 2.5 * beside) continue;
    cycle_.curve.push_back(samples_[i - 1]);
    cycle_.curve.push_back(samples_[i]);
  }
  for (const Peak& p : cycle_.reaction) cycle_.curve.push_back(at(p.phi));
  for (const Peak& p : {cycle_.torque, cycle_.shaking_force, cycle_.shaking_moment}) cycle_.curve.push_back(at(p.phi));
  std::stable_sort(cycle_.curve.begin(), cycle_.curve.end(),
                   [](const CyclePosition& a, const CyclePosition& b) { return a.state.phi < b.state.phi; });
}

void CycleBuilder::find_harmonics() {
  const auto orders_of = [&](auto&& value, Estimate* mean = nullptr) {
    std::vector<double> values;
    for (const CyclePosition& p : cycle_.positions) values.push_back(value(p));
    const int turns = static_cast<int>(std::lround(cycle_.cycle / turn));
    if (mean) {
      std::vector<double> half;
      for (std::size_t k = 0; k < values.size(); k += 2) half.push_back(values[k]);
      double fine = 0, other = 0;
      harmonics(values, turns, &fine), harmonics(half, turns, &other);
      *mean = estimate_from(fine, other, rounding_of_forces * std::abs(cycle_.torque.value));
    }
    double largest = 0;
    for (const double v : values) largest = std::max(largest, std::abs(v));
    return measured_harmonics(values, turns, largest);
  };
  cycle_.shaking_x = orders_of([](const CyclePosition& p) { return p.forces.shaking_force.x; });
  cycle_.shaking_y = orders_of([](const CyclePosition& p) { return p.forces.shaking_force.y; });
  cycle_.shaking_couple = orders_of([](const CyclePosition& p) { return p.forces.shaking_moment; });
  cycle_.torque_orders = orders_of([](const CyclePosition& p) { return p.forces.torque; }, &cycle_.torque_mean);
}

void CycleBuilder::balance_powers() {
  constexpr double nothing = 1e-9;
  double scale = 0;
  for (const CyclePosition& p : cycle_.positions)
    for (const double power : {p.power.crank, p.power.load, p.power.weight, p.power.kinetic_rate, p.power.friction})
      scale = std::max(scale, std::abs(power));
  for (auto* list : {&cycle_.positions, &cycle_.rows, &cycle_.curve})
    for (CyclePosition& p : *list) {
      const double left = p.power.crank + p.power.load + p.power.weight - p.power.friction - p.power.kinetic_rate;
      p.power.residual = scale > 0 ? left / scale : 0;
      p.power.nothing = nothing * scale;
      cycle_.power_residual = std::max(cycle_.power_residual, std::abs(p.power.residual));
    }
}

// The works of a cycle make its change of kinetic energy: what is left over is every work's error.
void CycleBuilder::find_errors_of_works() {
  double left = -cycle_.kinetic_change.value;
  for (const CycleWork& w : cycle_.work) left += w.work.value;
  for (CycleWork& w : cycle_.work) w.work.error = std::abs(left) + rounding_of_forces * w.turnover;
}

void widen_peak(Peak& peak, const Peak& other, double times) {
  peak.widen(times * std::abs(std::abs(other.value) - std::abs(peak.value)));
}

void CycleOfForces::widen_to(const CycleOfForces& other, double times) {
  using C = CycleOfForces;
  for (auto figure :
       {&C::mean_speed, &C::least_speed, &C::greatest_speed, &C::closure, &C::torque_mean, &C::kinetic_change})
    (this->*figure).widen_to(other.*figure, times);
  for (auto peak : {&C::torque, &C::shaking_force, &C::shaking_moment}) widen_peak(this->*peak, other.*peak, times);
  for (auto orders : {&C::shaking_x, &C::shaking_y, &C::shaking_couple, &C::torque_orders})
    for (std::size_t k = 0; k < (this->*orders).size(); ++k)
      (this->*orders)[k].amplitude.widen_to((other.*orders)[k].amplitude, times);
  for (std::size_t k = 0; k < work.size(); ++k) work[k].work.widen_to(other.work[k].work, times);
}

void ForceCycle::widen_to(const ForceCycle& other, double times) {
  CycleOfForces::widen_to(other, times);
  for (std::size_t k = 0; k < joint_count; ++k) widen_peak(reaction[k], other.reaction[k], times);
  for (auto flow : {&ForceCycle::input, &ForceCycle::useful, &ForceCycle::harmful})
    (this->*flow).widen_to(other.*flow, times);
  if (efficiency && other.efficiency) efficiency->widen_to(*other.efficiency, times);
}

void CycleOfForces::drop_errors(bool of_motion) {
  const auto drop = [](auto&... figures) { (figures.error.reset(), ...); };
  const auto drop_all = [](auto&... lists) {
    for (auto* orders : {&lists...})
      for (ForceHarmonic& h : *orders) h.amplitude.error.reset();
  };
  drop(torque, torque_mean), drop_all(torque_orders);
  for (CycleWork& w : work) w.work.error.reset();
  if (!of_motion) return;
  drop(mean_speed, least_speed, greatest_speed, closure, kinetic_change, shaking_force, shaking_moment);
  drop_all(shaking_x, shaking_y, shaking_couple);
}

void ForceCycle::drop_errors(bool of_motion) {
  CycleOfForces::drop_errors(of_motion);
  for (Peak& p : reaction) p.error.reset();
  for (Estimate* flow : {&input, &useful, &harmful}) flow->error.reset();
  if (efficiency) efficiency->error.reset();
}

// --- works ---

namespace {

// Of what goes to and fro in a cycle: what quadrature and rounding leave of works that cancel.
constexpr double nothing_left = 1e-9;

// Why the works of a cycle make no efficiency; empty: they do.
std::string why_no_efficiency(const ForceCycle& c, double spent, double uncertain) {
  constexpr double nothing = 0.5, enough = 0.05;  // of what is spent: an efficiency is not to be less certain
  if (!(uncertain <= nothing * spent))
    return "no work goes through the mechanism in a cycle beyond its error: what its parts take they give back";
  if (uncertain > enough * spent)
    return fmt::format("the works of the cycle, {} spent, are only known to within {} together",
                       with_unit(spent, "J", 4), with_unit(uncertain, "J", 2));
  if (!(c.useful.value > uncertain))
    return c.harmful.value > 0 ? "no useful work is done: what goes in is lost" : "no useful work is done";
  return "";
}

}  // namespace

// What goes in on balance over the cycle is input, what comes out is useful unless its account says harmful. What the
// motion itself stores or gives up is neither: η = A_useful/(A_in − ΔT), which lies within 0 … 1 by the balance.
void judge_works(ForceCycle& c) {
  constexpr double rounding = 1e-12;  // of what goes to and fro
  constexpr double steady = 1e-6;     // of the input: less is no change of the motion's energy
  double largest = c.kinetic_most;
  for (const CycleWork& w : c.work) largest = std::max(largest, w.turnover);
  double uncertain = c.kinetic_change.error.value_or(0), input = 0, useful = 0, harmful = 0;
  c.efficiency.reset();
  for (CycleWork& w : c.work) {
    double& work = w.work.value;
    uncertain += *w.work.error;
    if (std::abs(work) <= rounding * largest) work = 0;  // of weights round a cycle
    if (w.name == "balancing torque") w.kind = work < 0 ? "useful" : "driving";
    if (std::abs(work) <= *w.work.error + nothing_left * largest) continue;
    if (work > 0) input += work;
    if (work < 0) (w.kind == "harmful" ? harmful : useful) -= work;
  }
  uncertain += nothing_left * largest;
  c.input = {input, uncertain}, c.useful = {useful, uncertain}, c.harmful = {harmful, uncertain};
  c.spent = std::abs(c.kinetic_change.value) <= steady * input ? input : input - c.kinetic_change.value;
  c.no_efficiency = why_no_efficiency(c, c.spent, uncertain);
  if (!c.no_efficiency.empty()) return;
  const double ratio = useful / c.spent;
  if (ratio > 1 + uncertain / c.spent + steady)
    c.no_efficiency = fmt::format("the works do not balance: {} come out of {}", with_unit(useful, "J", 4),
                                  with_unit(c.spent, "J", 4));
  else
    c.efficiency = {std::min(1.0, ratio), (1 + ratio) * uncertain / c.spent};
}

}  // namespace kurbel
