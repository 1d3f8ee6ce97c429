// orbit_cycle.cpp — integrates one more period, records it step by step, and cuts it into pieces between its events.
#include "studies/cycle/orbit_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/orbit/follow_period.h"

namespace kurbel {
namespace {

constexpr double map_tolerance = 1e-12, looser_tolerance = 1e-10;
constexpr double sampled_within = 300;     // times the tolerance: what the solution between steps is good for
constexpr double shortest = 1e-11;         // way of a step that is worth a piece [rad]
constexpr double slowest_of_rated = 1e-6;  // below that the link stands

// Channels: time shares … of the accounts, then speed, kinetic energy, speeds of nodes; nodes of a piece per step.
class PeriodRecorder final : public Observer {
 public:
  // `origin`: angle from which the way counts [rad].
  PeriodRecorder(const Model& m, double sense, double origin, const std::vector<int>& nodes)
      : m_(m), sense_(sense), origin_(origin), nodes_(nodes), samples_(m.accounts.size() + 2 + nodes.size()) {}

  void begin(double, std::span<const double> y, Equations& equations) override { breaks_ = {way(equations, y)}; }
  void step(StepView& view) override {
    Equations& equations = view.equations();
    const double from = breaks_.back(), to = way(equations, view.y());
    if (view.begins_anew()) edges_.push_back(from);
    if (to - from < shortest) {  // it stands, or turns back
      if (to - from < slowest_of_rated * m_.speed_scale * (view.t() - view.t_previous())) {
        y_.assign(view.y().begin(), view.y().end());
        refuse(equations, to - from < -shortest ? -m_.speed_scale : 0);
      }
      return;
    }
    breaks_.push_back(to);
    for (std::size_t k = 0; k < Piecewise::nodes; ++k) {
      const double s = from + 0.5 * (to - from) * (1 + Piecewise::node(k));
      record(view, time_at(view, s));
    }
  }

  double begin_way() const { return breaks_.front(); }
  const std::vector<double>& edges() const { return edges_; }
  const std::string& singular() const { return singular_; }
  std::vector<Piecewise> functions() const {
    std::vector<Piecewise> all;
    for (const std::vector<double>& samples : samples_) all.push_back(Piecewise::through(breaks_, samples));
    return all;
  }

 private:
  double way(Equations& equations, std::span<const double> y) const {
    return sense_ * (equations.angle_with_turns(at(m_.reduction_angle), y) - origin_);
  }
  // Travel of the link so far, within the step.
  double time_at(StepView& view, double s) const {
    const double a = view.t_previous(), b = view.t();
    const auto beyond = [&](double t) { return way(view.equations(), view.at(t)) - s; };
    const double at_a = beyond(a), at_b = beyond(b);
    if (at_a >= 0) return a;
    if (at_b <= 0) return b;
    return find_root(beyond, a, at_a, b, at_b);
  }
  void record(StepView& view, double t) {
    Equations& equations = view.equations();
    const std::span<const double> now = view.at(t).first(equations.size());
    y_.assign(now.begin(), now.end());
    rate_.resize(y_.size());
    equations.flow(t, y_, rate_);
    const double speed = sense_ * rate_[at(m_.reduction_angle)];
    if (!(speed > slowest_of_rated * m_.speed_scale)) refuse(equations, speed);
    std::size_t channel = 0;
    for (std::size_t a = 0; a < m_.accounts.size(); ++a)
      samples_[channel++].push_back(rate_[equations.work_index(a)] / speed);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const std::size_t n = at(nodes_[i]);
      samples_[channel + 2 + i].push_back(m_.gain_of_node[n] * equations.now().speed[m_.shaft_of_node[n]]);
    }
    samples_[channel].push_back(speed);
    samples_[channel + 1].push_back(2 * equations.kinetic_energy(t, y_) / (speed * speed));
  }
  static double to_turn(double angle) {
    const double within = std::fmod(angle, 2 * std::numbers::pi);
    return within < 0 ? within + 2 * std::numbers::pi : within;
  }
  void refuse(Equations& equations, double speed) {
    if (!singular_.empty()) return;
    singular_ = fmt::format("\"{}\" {} within its steady motion, at {:.4g}°", m_.node_label(m_.reduction_node),
                            speed < -slowest_of_rated * m_.speed_scale ? "turns back" : "stands",
                            to_turn(sense_ * way(equations, y_) + origin_) * 180 / std::numbers::pi);
  }

  const Model& m_;
  double sense_, origin_;
  const std::vector<int>& nodes_;
  std::vector<double> breaks_, edges_, y_, rate_;
  std::vector<std::vector<double>> samples_;
  std::string singular_;
};

// Σ i² I_own(i φ + ψ) with i = ω_own/ω in the usual motion, and its derivative.
AnyShaftElement::InertiaAt mechanism_inertia(const Model& m, double phi) {
  AnyShaftElement::InertiaAt sum;
  for (const Network::ShaftElement& e : m.network.elements) {
    if (!(e.element->cycle > 0)) continue;
    const double i = m.node_ratio[at(e.node)];
    if (!m.effects.variable_inertia) {
      sum.value += i * i * e.element->mean_inertia;
      continue;
    }
    const auto own = e.element->inertia_at(i * phi + e.phase);
    sum.value += i * i * own.value;
    sum.slope += i * i * i * own.slope;
  }
  return sum;
}

// The part of the travel within [begin, begin + length), modulo whole periods.
double within(double s, double begin, double length) { return s - length * std::floor((s - begin) / length); }

std::vector<double> edges_of_period(const PeriodRecorder& recorder, double length) {
  std::vector<double> edges = {within(recorder.begin_way(), 0, length)};
  for (const double edge : recorder.edges()) edges.push_back(within(edge, 0, length));
  std::sort(edges.begin(), edges.end());
  const double apart = 1e-9 * length;
  std::vector<double> result = {0};
  for (const double edge : edges)
    if (edge > result.back() + apart && edge < length - apart) result.push_back(edge);
  result.push_back(length);
  return result;
}

OrbitCycle assembled(const Model& m, const PeriodRecorder& recorder, double sense, double tolerance,
                     std::size_t nodes) {
  const std::vector<Piecewise> raw = recorder.functions();
  const double begin = recorder.begin_way(), length = raw.front().length();
  const std::size_t accounts = m.accounts.size(), own = raw.size();
  // What was recorded, then drive and load, I_em and I_em′.
  const auto sampler = [&](double x, std::span<double> out) {
    const double s = within(x, begin, length);
    for (std::size_t k = 0; k < own; ++k) out[k] = raw[k].value(s);
    double drive = 0, load = 0;
    for (std::size_t a = 0; a < accounts; ++a) (m.accounts[a].kind == Account::driving ? drive : load) += out[a];
    const auto inertia = mechanism_inertia(m, sense * x);
    out[own] = drive, out[own + 1] = -load, out[own + 2] = inertia.value, out[own + 3] = sense * inertia.slope;
  };
  std::vector<Piecewise> all = Piecewise::sample(
      edges_of_period(recorder, length), own + 4, sampler, [](double) { Deadline::check(); }, tolerance);
  OrbitCycle c;
  c.sense = sense;
  c.cycle.drive = all[own], c.cycle.load = all[own + 1];
  c.cycle.mechanism = {all[own + 2], all[own + 3]};
  c.speed = all[accounts], c.inertia = all[accounts + 1];
  for (std::size_t i = 0; i < nodes; ++i) c.others.push_back(all[accounts + 2 + i]);
  all.resize(accounts);
  c.cycle.share = std::move(all);
  c.fastest = c.speed.maximum(), c.slowest = c.speed.minimum();
  c.cycle.speed = c.mid_speed();
  return c;
}

OrbitCycle follow(const ReturnMap& map, const SteadyPoint& point, const std::vector<int>& nodes, double tolerance) {
  const Model& m = map.model();
  Equations equations(map.shared_model(), true);
  const std::vector<double> y = map.place(equations, point.z);
  const TrackedAngle& link = m.angles[at(m.reduction_angle)];
  const double omega = link.gain * equations.snapshot(map.start_time(), y).now.speed[link.shaft];
  const double sense = omega < 0 ? -1 : 1;
  // If only time drives, the link may be at any angle when a period begins: its travel is 0 there.
  const bool anywhere = map.periodicity().by_time && !map.periodicity().angle_matters;
  const double origin = anywhere ? equations.angle_with_turns(at(m.reduction_angle), y) : 0;
  PeriodRecorder recorder(m, sense, origin, nodes);
  const RunOutcome outcome = follow_period(map, point, equations, {.tolerance = tolerance}, {&recorder});
  if (!outcome.diagnosis.empty()) throw std::invalid_argument(outcome.diagnosis);
  if (!recorder.singular().empty())
    throw std::invalid_argument(
        fmt::format("{}: its angle does not determine where the machine is in its cycle, and torques reduced to it are "
                    "infinite there; {}simulate the machine with kurbel run",
                    recorder.singular(),
                    m.scene.sequence.steps.empty() ? ""
                                                   : "choose the machine in the state after a step of its sequence, as "
                                                     "with its clutch engaged, by --at \"step 2\", or "));
  OrbitCycle c = assembled(m, recorder, sense, sampled_within * tolerance, nodes.size());
  c.time = outcome.t - map.start_time();
  return c;
}

}  // namespace

OrbitCycle orbit_cycle(const Orbit& orbit, const std::vector<int>& nodes) {
  if (!orbit.repeats()) throw std::invalid_argument(orbit.words);
  return follow(*orbit.map, orbit.point, nodes, map_tolerance);
}

std::optional<OrbitCycle> looser_orbit_cycle(const Orbit& orbit, const std::vector<int>& nodes) {
  try {
    const SteadyTwin twin = looser_twin(*orbit.map, orbit.point, looser_tolerance);
    if (!twin.point.found) return {};
    return follow(*twin.map, twin.point, nodes, looser_tolerance);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

double constant_inertia(const Model& m) {
  double sum = 0;
  for (std::size_t n = 0; n < m.network.nodes.size(); ++n)
    sum += m.network.nodes[n].inertia * m.node_ratio[n] * m.node_ratio[n];
  return sum;
}

}  // namespace kurbel
