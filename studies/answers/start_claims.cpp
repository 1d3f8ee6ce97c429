// start_claims.cpp — starts in an equilibrium, and at speeds that disagree.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "engine/numerics/index.h"
#include "engine/run/run.h"
#include "studies/answers/motion_claims.h"

namespace kurbel {
namespace {

// Something else than rounding moves the shaft until then; it is held by then; or it cannot be decided.
bool is_moved_before(double time, std::size_t angle, const std::shared_ptr<const Model>& model) try {
  constexpr double moved = 1e-7;  // [rad]
  Equations equations(model, false);
  const double begin = equations.angle_with_turns(angle, equations.start(0));
  const RunOutcome outcome = integrate(equations,
                                       {.tolerance = 1e-9,
                                        .method = "auto",
                                        .until = std::min(time, model->scene.run.until),
                                        .budget = 10,
                                        .progress = {}},
                                       {});
  return !outcome.complete || equations.at_standstill(at(model->angles[angle].shaft)) ||
         std::abs(equations.angle_with_turns(angle, outcome.state) - begin) > moved;
} catch (const std::exception&) {
  return true;
}

// Shafts that springs, belts or closed clutches join, with the ratios at which they turn together without a twist.
using JoinedShafts = std::vector<std::pair<std::size_t, double>>;

std::vector<JoinedShafts> joined_shafts(const Model& m, const std::vector<int>& slip) {
  std::vector<std::vector<std::pair<std::size_t, double>>> beside(m.shafts.size());  // shaft, and its ratio to this one
  for (std::size_t j = 0; j < m.elastic.size(); ++j) {
    const ElasticJoint& e = m.elastic[j];
    if (e.springless || (e.slips && slip[j] != 0)) continue;
    beside[at(e.shaft_a)].emplace_back(at(e.shaft_b), e.gain_a / e.gain_b);
    beside[at(e.shaft_b)].emplace_back(at(e.shaft_a), e.gain_b / e.gain_a);
  }
  std::vector<JoinedShafts> groups;
  std::vector<char> seen(m.shafts.size());
  for (std::size_t first = 0; first < m.shafts.size(); ++first) {
    if (std::exchange(seen[first], 1)) continue;
    JoinedShafts group{{first, 1}};
    for (std::size_t k = 0; k < group.size(); ++k)
      for (const auto& [other, ratio] : beside[group[k].first])
        if (!std::exchange(seen[other], 1)) group.emplace_back(other, group[k].second * ratio);
    groups.push_back(std::move(group));
  }
  return groups;
}

// dω/dt = λ² δφ beside a start at rest without acceleration; of joined shafts as if they were rigid.
void add_unstable_starts(const std::shared_ptr<const Model>& model, Equations& equations, Claims& claims) {
  const Model& m = *model;
  constexpr double aside = 1e-4;     // [rad]
  constexpr double rounding = 1e-9;  // of the accelerations beside it
  constexpr double matters = 1e-9;   // a deviation [rad]
  const std::vector<double> y = equations.start(0);
  std::vector<double> beside(y.size()), rate(y.size());
  for (const JoinedShafts& group : joined_shafts(m, equations.modes().slip)) {
    const auto rests = [&](const auto& joined) {
      const std::size_t shaft = joined.first;
      return shaft < m.free_shafts && y[equations.speed_index(static_cast<int>(shaft))] == 0 &&
             equations.modes().direction[shaft] != 0;
    };
    if (!std::all_of(group.begin(), group.end(), rests)) continue;
    std::vector<double> ratio(m.shafts.size());
    for (const auto& [shaft, turns] : group) ratio[shaft] = turns;
    const auto acceleration = [&](double by) {
      beside = y;
      for (std::size_t i = 0; i < m.angles.size(); ++i)
        beside[i] += m.angles[i].gain * ratio[at(m.angles[i].shaft)] * by;
      equations.flow(0, beside, rate);
      const std::span<const double> inertia = equations.effective_inertia();
      double torque = 0, sum = 0;
      for (const auto& [shaft, turns] : group) {
        torque += turns * inertia[shaft] * rate[equations.speed_index(static_cast<int>(shaft))];
        sum += turns * turns * inertia[shaft];
      }
      return torque / sum;
    };
    const double ahead = acceleration(aside), behind = acceleration(-aside), here = acceleration(0);
    if (!(ahead > 0 && behind < 0 && std::abs(here) <= rounding * std::min(ahead, -behind))) continue;
    // Of the shaft whose inertia varies, if there is one.
    const auto rank = [&](const TrackedAngle& angle) {
      return ratio[at(angle.shaft)] == 0 ? 0 : 1 + m.shafts[at(angle.shaft)].variable;
    };
    const auto tracked =
        std::max_element(m.angles.begin(), m.angles.end(),
                         [&](const TrackedAngle& a, const TrackedAngle& b) { return rank(a) < rank(b); });
    const double growth = std::sqrt((ahead - behind) / (2 * aside));
    const double decides = std::log(matters / (rounding * aside)) / growth;
    if (is_moved_before(decides, at(tracked - m.angles.begin()), model)) continue;
    const std::string& name = m.network.nodes[at(tracked->node)].component;
    add(claims,
        claimed(Predicate::start_unstable,
                fmt::format("\"{}\" starts in an unstable equilibrium: rounding decides when it leaves it, and to "
                            "which side; a deviation grows tenfold in {:.2g} s. Start it at another angle",
                            name, std::log(10) / growth),
                name, {.at = decides, .value = growth, .limit = 0, .unit = "1/s"}));
  }
}

}  // namespace

Claims start_claims(const std::shared_ptr<const Model>& model) {
  constexpr double disagree = 0.1;  // of the usual speed
  Claims claims;
  const Model& m = *model;
  std::set<int> given;
  for (const auto& [component, start] : m.scene.run.start.components)
    if (start.speed) given.insert(m.shaft_of_node[at(m.network.ports.at(component).in)]);
  Equations first(model, false);
  add_unstable_starts(model, first, claims);
  if (given.empty()) return claims;
  const std::vector<double> y = first.start(0);
  const Snapshot& s = first.snapshot(0, y);
  for (const ElasticJoint& joint : m.elastic) {
    const double a = joint.gain_a * s.now.speed[joint.shaft_a], b = joint.gain_b * s.now.speed[joint.shaft_b];
    if (joint.slips || joint.springless || given.count(joint.shaft_a) == given.count(joint.shaft_b)) continue;
    if (!(std::abs(a - b) > disagree * std::abs(joint.gain_a * m.shafts[at(joint.shaft_a)].speed_scale))) continue;
    const std::string& name = m.network.joints[at(joint.joint)].component;
    add(claims,
        claimed(Predicate::start_shafts_disagree,
                fmt::format("\"{}\" joins shafts that start at {} and {}: [run] start gives a speed to one side alone, "
                            "and the start is a shock",
                            name, m.scene.speed_unit.text(a), m.scene.speed_unit.text(b)),
                name, {.at = 0, .value = std::abs(a - b), .limit = 0, .unit = "rad/s"}));
  }
  return claims;
}

std::string words_of_balance(const Equations& at_end, const RunOutcome& outcome) {
  constexpr double moved = 1e-6;  // [rad], [rad/s]
  if (!outcome.complete) return {};
  const Model& m = at_end.model();
  for (std::size_t k = 0; k < m.free_shafts; ++k)
    if (std::abs(outcome.state[at_end.speed_index(static_cast<int>(k))]) > moved) return {};
  Equations equations(at_end.shared_model(), false);
  const std::vector<double> y = equations.start(0);
  for (std::size_t i = 0; i < m.angles.size(); ++i)
    if (std::abs(at_end.angle_with_turns(i, outcome.state) - equations.angle_with_turns(i, y)) > moved) return {};
  const Snapshot& s = equations.snapshot(0, y);
  bool any_mechanism = false;
  for (std::size_t k = 0; k < m.free_shafts; ++k) {
    const Shaft& shaft = m.shafts[k];
    if (s.now.speed[k] != 0 || std::abs(s.sums.torque[k]) > 1e-9 * shaft.torque_scale || equations.at_standstill(k))
      return {};
    any_mechanism = any_mechanism || shaft.variable;
  }
  if (!any_mechanism || m.free_shafts < m.shafts.size() || equations.next_edge(0) < outcome.t) return {};
  return fmt::format(
      "the machine starts at rest where no torque moves it, and stays there ({:.4g}° of \"{}\"): a dead centre or a "
      "balance. Start it a little off, or with a speed",
      s.node_angle[m.reduction_node] * 180 / std::numbers::pi, m.network.nodes[at(m.reduction_node)].component);
}

}  // namespace kurbel
