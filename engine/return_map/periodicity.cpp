// periodicity.cpp — common multiples of the periods of a machine's elements.
#include "engine/return_map/periodicity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/model/cycle_of.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

struct NamedPeriod {
  double period;
  std::string component;
};

// The smallest multiple of the first period that is a multiple of all.
double common_multiple(const std::vector<NamedPeriod>& periods, const std::string& unit) {
  std::vector<double> lengths;
  for (const NamedPeriod& p : periods) lengths.push_back(p.period);
  const CommonPeriod common = common_period(lengths);
  if (common.value > 0) return common.value;
  const NamedPeriod& odd = periods[common.odd];
  throw std::invalid_argument(fmt::format(
      "there is no steady cycle: what repeats after {:.9g} {} (\"{}\") and after {:.9g} {} (\"{}\") never meets within "
      "1000 periods. Make the ratio of the two a fraction, or simulate a long time with kurbel run",
      periods.front().period, unit, periods.front().component, odd.period, unit, odd.component));
}

// Of the law that a component follows once the sequence is over; 0: none that repeats.
double lasting_period(const Sequence& sequence, const std::string& component) {
  double period = 0;
  for (const SequenceStep& step : sequence.steps)
    if (std::find(step.set.begin(), step.set.end(), component) != step.set.end())
      period = step.law.empty() ? 0 : step.law.period();
  return period;
}

}  // namespace

int prescribed_node(const Model& m) {
  const Network& net = m.network;
  int found = -1;
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    if (net.nodes[n].prescribed < 0) continue;
    if (m.node_ratio[n] == 0 && net.prescribed[at(net.nodes[n].prescribed)].is_nothing()) continue;  // the frame
    if (found >= 0)
      throw std::invalid_argument(
          fmt::format("\"{}\" and \"{}\" both prescribe a speed; a steady cycle is sought for one prescribed speed at "
                      "most: simulate with kurbel run",
                      net.nodes[at(found)].component, net.nodes[n].component));
    found = static_cast<int>(n);
  }
  return found;
}

Periodicity periodicity_of(const Model& m, bool clocked) {
  Periodicity result;
  std::vector<NamedPeriod> angles, times;
  for (const Network::ShaftElement& e : m.network.elements) {
    if (e.element->is.uses_angle && e.element->angle_period > 0)
      angles.push_back({e.element->angle_period / m.scale_ratio[at(e.node)], e.component});
    if (e.element->time_period > 0) times.push_back({e.element->time_period, e.component});
    const double begins = e.element->is.starts_anew ? e.window.first_on() : 0;
    result.settled_from = std::max(result.settled_from, begins + e.element->settled_from);
  }
  for (const CommandTarget& target : m.commands)
    if (const double period = lasting_period(m.scene.sequence, target.component); period > 0)
      times.push_back({period, target.component});
  if (m.scene.sequence.every > 0 && clocked) times.push_back({least_repetition(m.scene.sequence), "sequence"});
  for (const ElasticJoint& e : m.elastic) {
    const Network::Joint& joint = m.network.joints[at(e.joint)];
    if (joint.element->is.uses_angle) angles.push_back({turn / m.scale_ratio[at(joint.a)], joint.component});
  }
  result.angle_matters = !angles.empty();
  result.angle = angles.empty() ? turn : common_multiple(angles, "rad");
  result.clocked = !times.empty();
  if (const int node = prescribed_node(m); node >= 0) {
    const PrescribedSpeed& given = m.network.prescribed[at(m.network.nodes[at(node)].prescribed)];
    const std::string& name = m.network.nodes[at(node)].component;
    const double link_speed = std::abs(given.settled_speed() / m.node_ratio[at(node)]);
    if (given.amplitude != 0) times.push_back({1 / std::abs(given.frequency), name});
    if (given.period() > 0) times.push_back({given.period(), name});
    result.clocked = !times.empty();
    // On average nothing turns at a speed of 0: what depends on an angle sees one place of its cycle.
    if (link_speed > 0 && (result.angle_matters || times.empty())) times.push_back({result.angle / link_speed, name});
    result.settled_from = std::max(result.settled_from, given.settled_from());
  }
  result.by_time = !times.empty();
  if (result.by_time) result.time = common_multiple(times, "s");
  return result;
}

double least_repetition(const Sequence& sequence) {
  if (sequence.every == 0) return 0;
  double waits = 0;
  for (std::size_t i = 1; i < sequence.steps.size(); ++i)
    if (sequence.steps[i].when == SequenceStep::When::after) waits += sequence.steps[i].value;
  return std::max(sequence.every, waits);
}

double clock_of(const Model& m) try {
  const Periodicity p = periodicity_of(m);
  return p.clocked ? p.time : 0;
} catch (const std::invalid_argument&) {
  return 0;
}

}  // namespace kurbel
