// force_cycle.cpp — d'Alembert position by position, peaks, orders, powers and works of one cycle.
#include "studies/forces/force_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/model/model.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/roots.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int grid_of_turn = 720;  // peaks are sought on this grid, work is integrated between its points
constexpr double beside = 1e-9;    // rad: either side of an edge

std::size_t index(int i) { return static_cast<std::size_t>(i); }

std::shared_ptr<const Model> alone(const Scene& scene, const std::string& component) {
  const Network whole = build_network(scene);
  Network network;
  const int node = network.add_node(component, "", 1);  // kg·m²; forces do not see it
  network.ports[component] = {node, node};
  network.components = {component};
  network.put(node, component, slider_crank_element(whole, component).element, {}, 0);
  Scene bare;
  bare.file = scene.file;
  return compile_network(std::move(network), bare, rigid_effects());
}

}  // namespace

// --- loads ---

const Network::ShaftElement& slider_crank_element(const Network& network, const std::string& component) {
  for (const Network::ShaftElement& e : network.elements)
    if (e.component == component && e.element->cycle > 0) return e;
  throw std::logic_error("slider-crank without an element");
}

SliderLoads::SliderLoads(const Scene& scene, const std::string& component) : SliderLoads(alone(scene, component)) {
  for (std::size_t k = 0; k < model().pool_channels.size(); ++k)
    if (model().pool_channels[k].name.what == QuantityKind::force && model().pool_channels[k].name.of == component)
      channel_ = static_cast<int>(k);
}

double SliderLoads::force(double phi, double omega) {
  if (channel_ < 0) return 0;
  const std::vector<double> y = equations_.modes_from_scratch(0, phi, omega);
  return model().pool_channels[index(channel_)].value(equations_.snapshot(0, y));
}

std::span<const double> SliderLoads::shares(double phi, double omega) {
  machine_.set_modes(phi, omega);
  return machine_.at(phi, omega, true).share;
}

// --- where the cycle is looked at ---

std::vector<Abscissa> abscissae(double cycle, const std::vector<double>& edges, int rows_of_turn) {
  const int turns = static_cast<int>(std::lround(cycle / turn)), cells = grid_of_turn * turns;
  std::vector<double> knots;
  for (int i = 0; i <= cells; ++i) knots.push_back(cycle * i / cells);
  knots.insert(knots.end(), edges.begin(), edges.end());
  std::sort(knots.begin(), knots.end());
  std::vector<Abscissa> all;
  for (int i = 0; i <= cells; ++i) all.push_back({.phi = cycle * i / cells, .grid = true});
  const int rows = rows_of_turn * turns;
  for (int i = 0; i <= rows; ++i) {
    if (i * cells % rows == 0)
      all[index(i * cells / rows)].row = true;
    else
      all.push_back({.phi = cycle * i / rows, .row = true});
  }
  const double node = std::sqrt(0.6);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double half = 0.5 * (knots[i + 1] - knots[i]), middle = 0.5 * (knots[i + 1] + knots[i]);
    if (half <= 1e-12) continue;
    all.push_back({.phi = middle - node * half, .weight = half * 5 / 9});
    all.push_back({.phi = middle, .weight = half * 8 / 9});
    all.push_back({.phi = middle + node * half, .weight = half * 5 / 9});
  }
  for (const double edge : edges)
    for (const double phi : {edge - beside, edge + beside}) {
      const double within = phi < 0 ? phi + cycle : phi > cycle ? phi - cycle : phi;
      if (within > 0 && within < cycle) all.push_back({.phi = within});
    }
  std::stable_sort(all.begin(), all.end(), [](const Abscissa& a, const Abscissa& b) { return a.phi < b.phi; });
  return all;
}

// --- peaks ---

Peak peak_of(const std::vector<double>& phi, const std::vector<double>& values,
             const std::function<double(double)>& value) {
  constexpr double same_peak = 1e-9;  // of its value
  constexpr double may_grow = 1e-3;   // of its value: by more no peak between samples so close rises above them
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  Peak peak{values.front(), phi.front(), {}};
  if (largest == 0) return peak;
  const auto consider = [&](double v, double where) {
    if (std::abs(v) > (1 + same_peak) * std::abs(peak.value)) peak = {v, where, {}};
  };
  constexpr int most_refined = 16;  // a force that stays the same has a peak of rounding at every other sample
  int refined = 0;
  const std::size_t n = values.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double here = std::abs(values[i]);
    if (here < (1 - may_grow) * largest) continue;
    if ((i > 0 && std::abs(values[i - 1]) > here) || (i + 1 < n && std::abs(values[i + 1]) > here)) continue;
    Peak local{values[i], phi[i], {}};
    const double sense = values[i] < 0 ? -1 : 1;
    const bool refine = ++refined <= most_refined;
    for (const std::size_t k : {i, i + 1}) {  // the pieces before and after it
      if (!refine) break;
      if (k == 0 || k >= n || !(phi[k] > phi[k - 1])) continue;
      const auto [where, found] = find_maximum([&](double x) { return sense * value(x); }, phi[k - 1], phi[k], 40);
      if (found > sense * local.value) local = {sense * found, where, {}};
    }
    consider(local.value, local.phi);
  }
  return peak;
}

// --- one problem ---

CycleBuilder::CycleBuilder(const SliderCrankStatics& statics, SliderLoads& loads, ForceCycle& cycle)
    : statics_(statics), geometry_(statics.data()), loads_(loads), cycle_(cycle) {
  for (const WorkAccount& account : loads.model().accounts)
    cycle_.work.push_back({account.name, name_of(account.kind), 0, 0, 0});
  cycle_.work.push_back({"balancing torque", "driving", 0, 0, 0});
  for (std::size_t k = 0; k < joint_count; ++k)
    cycle_.work.push_back({std::string("friction of ") + name_of(static_cast<Joint>(k)), "harmful", 0, 0, 0});
}

CyclePosition CycleBuilder::at(double phi, CrankMotion motion) const {
  CyclePosition p;
  p.state = {phi, motion.omega, motion.alpha, loads_.force(phi, motion.omega)};
  const auto slider = geometry_.slider(phi);
  p.position = slider.value;
  p.velocity = slider.slope * motion.omega;
  p.rod_angle = geometry_.rod(phi).value;
  p.forces = statics_.solve(p.state);
  const auto inertia = geometry_.inertia(phi);
  const double w = motion.omega;
  p.power = {.crank = p.forces.torque * w,
             .load = p.state.slider_force * p.velocity,
             .weight = geometry_.gravity_torque(phi).value * w,
             .kinetic_rate = (inertia.value * motion.alpha + 0.5 * inertia.slope * w * w) * w,
             .friction = p.forces.friction_loss()};
  return p;
}

void CycleBuilder::add(const Abscissa& where, CrankMotion motion) {
  Deadline::check();
  const CyclePosition p = at(where.phi, motion);
  if (where.row) cycle_.rows.push_back(p);
  if (where.grid) cycle_.positions.push_back(p);
  if (where.row && !where.grid) return;
  samples_.push_back(p);
  if (where.weight == 0) return;
  // dA = M dφ, in the sense of the motion.
  const double dt = where.weight / std::abs(motion.omega);
  const auto share = loads_.shares(where.phi, motion.omega);
  std::size_t k = 0;
  const auto account = [&](double power) {
    cycle_.work[k].work += power * dt;
    cycle_.work[k++].turnover += std::abs(power) * dt;
  };
  for (const double torque : share) account(torque * motion.omega);
  account(p.power.crank);
  for (const double lost : p.forces.friction_power) account(-lost);
  time_ += dt;
}

void CycleBuilder::finish() {
  cycle_.mean_speed = std::copysign(cycle_.cycle / time_, cycle_.positions.front().state.omega);
  // Speeds at both ends in the order of time.
  cycle_.first_speed = cycle_.positions.front().state.omega;
  cycle_.last_speed = cycle_.positions.back().state.omega;
  cycle_.closure = (cycle_.last_speed - cycle_.first_speed) / cycle_.mean_speed;
  const auto kinetic = [&](const CyclePosition& p) {
    return 0.5 * geometry_.inertia(p.state.phi).value * p.state.omega * p.state.omega;
  };
  cycle_.kinetic_change = kinetic(cycle_.positions.back()) - kinetic(cycle_.positions.front());
  for (const CyclePosition& p : cycle_.positions) cycle_.kinetic_most = std::max(cycle_.kinetic_most, kinetic(p));
  const auto by_angle = [](const CyclePosition& a, const CyclePosition& b) { return a.state.phi < b.state.phi; };
  for (auto* list : {&samples_, &cycle_.positions, &cycle_.rows}) std::sort(list->begin(), list->end(), by_angle);
  find_extremes();
  collect_curves();
  find_harmonics();
  balance_powers();
  judge_works(cycle_);
}

// Motion between the samples: z = ω²/2 by Hermite's interpolation, its slope being ε, through the samples on either
// side and, where no load edge lies between, the next ones: of degree 3 … 7, which leaves rounding.
CrankMotion CycleBuilder::motion_at(double phi) const {
  const auto after = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, phi,
                                      [](double x, const CyclePosition& p) { return x < p.state.phi; });
  const auto i = static_cast<std::size_t>(after - samples_.begin());
  const auto smooth = [&](std::size_t k) {  // the piece that ends there
    return samples_[k].state.phi - samples_[k - 1].state.phi > 2.5 * beside;
  };
  std::size_t from = i - 1, to = i;
  const double begin = samples_[from].state.phi, h = samples_[to].state.phi - begin;
  if (!(h > 0)) return {samples_[from].state.omega, samples_[from].state.alpha};
  if (smooth(i) && from > 0 && smooth(from)) --from;
  if (smooth(i) && to + 1 < samples_.size() && smooth(to + 1)) ++to;
  // Divided differences over doubled nodes, the angle counted in h.
  constexpr std::size_t most = 8;
  std::array<double, most> x{}, c{};
  std::size_t n = 0;
  for (std::size_t k = from; k <= to; ++k)
    for (int twice = 0; twice < 2; ++twice) {
      x[n] = (samples_[k].state.phi - begin) / h;
      c[n++] = 0.5 * samples_[k].state.omega * samples_[k].state.omega;
    }
  for (std::size_t order = 1; order < n; ++order)
    for (std::size_t k = n - 1; k >= order; --k)
      c[k] = order == 1 && k % 2 ? h * samples_[from + k / 2].state.alpha : (c[k] - c[k - 1]) / (x[k] - x[k - order]);
  const double u = (phi - begin) / h;
  double z = c[n - 1], slope = 0;
  for (std::size_t k = n - 1; k-- > 0;) {
    slope = slope * (u - x[k]) + z;
    z = z * (u - x[k]) + c[k];
  }
  return {std::copysign(std::sqrt(2 * std::max(0.0, z)), samples_[i].state.omega), slope / h};
}

void CycleBuilder::find_extremes() {
  std::vector<double> phi;
  for (const CyclePosition& p : samples_) phi.push_back(p.state.phi);
  const auto largest = [&](auto&& value) {
    std::vector<double> values;
    for (const CyclePosition& p : samples_) values.push_back(value(p));
    return peak_of(phi, values, [&](double x) { return value(at(x)); });
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
  cycle_.least_speed = cycle_.greatest_speed = samples_.front().state.omega;
  for (const CyclePosition& p : samples_) {
    cycle_.least_speed = std::min(cycle_.least_speed, p.state.omega);
    cycle_.greatest_speed = std::max(cycle_.greatest_speed, p.state.omega);
    cycle_.friction_residual = std::max(cycle_.friction_residual, p.forces.residual);
    cycle_.most_iterations = std::max(cycle_.most_iterations, p.forces.iterations);
  }
  for (const CyclePosition& p : cycle_.positions) cycle_.both_edges += p.forces.both_edges ? 1 : 0;
}

// A balancing torque that none is needed of, a shaking force that is balanced.
void CycleBuilder::call_rounding_zero() {
  constexpr double rounding = 1e-12;
  double force = std::abs(cycle_.shaking_force.value);
  for (const Peak& p : cycle_.reaction) force = std::max(force, std::abs(p.value));
  const double torque = force * (statics_.data().radius + statics_.data().rod_length);
  const auto clean = [](Peak& p, double scale) {
    if (std::abs(p.value) <= rounding * scale) p = {};
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
  const auto orders_of = [&](auto&& value, double* mean = nullptr) {
    std::vector<double> values;
    for (const CyclePosition& p : cycle_.positions) values.push_back(value(p));
    return harmonics(values, static_cast<int>(std::lround(cycle_.cycle / turn)), mean);
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

// --- works ---

namespace {

// Of what goes to and fro in a cycle: what quadrature and rounding leave of works that cancel.
constexpr double nothing_left = 1e-9;

// Why the works of a cycle make no efficiency; empty: they do.
std::string why_no_efficiency(const ForceCycle& c, double spent, double uncertain) {
  constexpr double enough = 1e-3;  // of what is spent: an efficiency is not to be less certain
  if (!(uncertain <= enough * spent))
    return "no work goes through the mechanism in a cycle beyond its error: what its parts take they give back";
  if (!(c.useful > uncertain))
    return c.harmful > 0 ? "no useful work is done: what goes in is lost" : "no useful work is done";
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
  c.input = c.useful = c.harmful = 0;
  c.efficiency.reset();
  double uncertain = c.kinetic_error;
  for (CycleWork& w : c.work) {
    uncertain += w.error;
    if (std::abs(w.work) <= rounding * largest) w.work = 0;  // of weights round a cycle
    if (w.name == "balancing torque") w.kind = w.work < 0 ? "useful" : "driving";
    if (std::abs(w.work) <= w.error + nothing_left * largest) continue;
    if (w.work > 0) c.input += w.work;
    if (w.work < 0) (w.kind == "harmful" ? c.harmful : c.useful) -= w.work;
  }
  uncertain += nothing_left * largest;
  c.spent = std::abs(c.kinetic_change) <= steady * c.input ? c.input : c.input - c.kinetic_change;
  c.no_efficiency = why_no_efficiency(c, c.spent, uncertain);
  if (!c.no_efficiency.empty()) return;
  const double ratio = c.useful / c.spent;
  if (ratio > 1 + uncertain / c.spent + steady)
    c.no_efficiency = fmt::format("the works do not balance: {} come out of {}", with_unit(c.useful, "J", 4),
                                  with_unit(c.spent, "J", 4));
  else
    c.efficiency = std::min(1.0, ratio);
}

}  // namespace kurbel
