// equations_start.cpp — the state that a scene starts from: angles, twists in balance with the loads, modes.
#include "engine/equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

constexpr double at_rest = 1e-14;  // of the speed scale

}  // namespace

// Angles of all shafts from the twists, outwards from the reduction link: φ_b = (gain_a φ_a − θ)/gain_b.
void Equations::set_shaft_angles(const double* twists, std::vector<double>& angles) const {
  for (const ElasticStep& step : elastic_steps_) {
    const ElasticJoint& e = model_->elastic[at(step.elastic)];
    if (step.forward) {
      angles[at(e.shaft_b)] = (e.gain_a * angles[at(e.shaft_a)] - twists[step.elastic]) / e.gain_b;
    } else {
      angles[at(e.shaft_a)] = (e.gain_b * angles[at(e.shaft_b)] + twists[step.elastic]) / e.gain_a;
    }
  }
}

std::vector<double> Equations::start_angles(const StartSettings& start, std::vector<double>& twists) {
  const Model& m = *model_;
  const int on = start.on.empty() ? m.reduction_node : m.network.ports.at(start.on).in;
  const double reduction_angle = start.angle / m.node_ratio[at(on)];
  std::vector<double> angles(m.shafts.size());
  for (std::size_t s = 0; s < m.shafts.size(); ++s)
    angles[s] = m.node_ratio[at(m.shafts[s].reference)] * reduction_angle;
  bool given = false;
  for (const auto& [component, c] : start.components) {
    if (!c.angle) continue;
    const int node = m.network.ports.at(component).in;
    angles[at(m.shaft_of_node[at(node)])] = *c.angle / m.gain_of_node[at(node)];
    given = true;
  }
  if (given)
    for (std::size_t i = 0; i < twists.size(); ++i) {
      const ElasticJoint& e = m.elastic[i];
      twists[i] = e.gain_a * angles[at(e.shaft_a)] - e.gain_b * angles[at(e.shaft_b)];
    }
  for (std::size_t i = 0; i < twists.size(); ++i) {
    const auto c = start.components.find(m.network.joints[at(m.elastic[i].joint)].component);
    if (c != start.components.end() && c->second.twist) twists[i] = *c->second.twist;
  }
  set_shaft_angles(twists.data(), angles);
  return angles;
}

std::vector<double> Equations::start(double t, const StartSettings& settings) {
  const Model& m = *model_;
  std::vector<double> y(size(), 0.0);
  std::vector<double> twists(m.elastic.size(), 0.0);
  const std::vector<double> angles = start_angles(settings, twists);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * angles[at(m.angles[i].shaft)];
  for (std::size_t i = 0; i < twists.size(); ++i) y[twists_begin() + i] = twists[i];
  const int on = settings.on.empty() ? m.reduction_node : m.network.ports.at(settings.on).in;
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    y[speed_index(static_cast<int>(s))] =
        settings.speed * m.node_ratio[at(m.shafts[s].reference)] / m.node_ratio[at(on)];
  std::vector<char> given(m.shafts.size(), 0);
  for (const auto& [component, c] : settings.components) {
    if (!c.speed) continue;
    const int node = m.network.ports.at(component).in;
    const int s = m.shaft_of_node[at(node)];
    if (at(s) < m.free_shafts) y[speed_index(s)] = *c.speed / m.gain_of_node[at(node)];
    given[at(s)] = 1;
  }
  free_member_follows(y, given);
  settle_modes(t, y, settings.equilibrium);
  return y;
}

std::vector<double> Equations::state_of(double t, double link_angle, std::span<const double> twists,
                                        std::span<const double> speeds) {
  const Model& m = *model_;
  std::vector<double> y(size(), 0.0), angles(m.shafts.size(), 0.0);
  const TrackedAngle& link = m.angles[at(m.reduction_angle)];
  angles[at(link.shaft)] = link_angle / link.gain;
  set_shaft_angles(twists.data(), angles);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * angles[at(m.angles[i].shaft)];
  std::copy(twists.begin(), twists.end(), y.begin() + static_cast<std::ptrdiff_t>(twists_begin()));
  std::copy(speeds.begin(), speeds.end(), y.begin() + static_cast<std::ptrdiff_t>(speed_index(0)));
  settle_modes(t, y, false);
  return y;
}

std::vector<double> Equations::shaft_angles_by_twist(std::size_t elastic) const {
  std::vector<double> twists(model_->elastic.size(), 0.0), angles(model_->shafts.size(), 0.0);
  twists[elastic] = 1;
  set_shaft_angles(twists.data(), angles);
  return angles;
}

// All modes anew for a state; turns are counted from here.
void Equations::settle_modes(double t, std::span<double> y, bool equilibrium) {
  const Model& m = *model_;
  std::fill(turns_.begin(), turns_.end(), 0.0);
  wrap(y);
  begin_sequence(t, y, nullptr);
  set_timed_modes(t);
  std::vector<std::size_t> still;
  const Instant now = instant(t, y);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const double v = slip_speed(contacts_[c], now);
    sense(c) = std::abs(v) <= at_rest * contacts_[c].speed_scale ? 0 : v > 0 ? 1 : -1;
    contacts_[c].regularised = false;
    if (sense(c) == 0 && !is_prescribed(contacts_[c])) still.push_back(c);
  }
  for (const auto& pool : m.pools) pool->first_modes(instant(t, y), mode_.data());
  for (const auto& pool : m.pools) pool->first_states(instant(t, y), y.data() + own_begin());
  if (equilibrium) balance_twists(y, t);
  for (const auto& pool : m.pools) pool->first_states(instant(t, y), y.data() + own_begin());
  settle_contacts(t, y, still, {}, nullptr);
  refuse_impossible_slip(t, y);
  for (const auto& pool : m.pools) pool->first_modes(instant(t, y), mode_.data());
}

// A contact that can only ever hold in the sense in which it slips: the sides would have to hit each other.
void Equations::refuse_impossible_slip(double t, std::span<const double> y) {
  if (contacts_.empty()) return;
  snapshot_.now = instant(t, y);
  find_holds();
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    if (contacts_[c].kind == Contact::Kind::connection && sense(c) != 0 &&
        std::isinf(sense(c) > 0 ? limits(c).high : limits(c).low))
      throw std::runtime_error(
          fmt::format("\"{}\" cannot slip in the sense in which the machine starts ({:.6g} rad/s): its driving side "
                      "would have to be "
                      "no faster than its driven side. Start both sides at one speed",
                      contacts_[c].name, slip_speed(contacts_[c], snapshot_.now)));
}

// Speeds that a relation demands of members whose speeds are not given.
void Equations::free_member_follows(std::span<double> y, const std::vector<char>& given) {
  const Model& m = *model_;
  for (std::size_t pass = 0; pass < m.relations.size(); ++pass)
    for (const ShaftRelation& relation : m.relations) {
      double sum = 0;
      const ShaftGain* open = nullptr;
      for (const ShaftGain& g : relation.motion) {
        const bool is_free = at(g.shaft) < m.free_shafts;
        sum += g.gain * (is_free ? y[speed_index(g.shaft)] : prescribed_speed(at(g.shaft), 0));
        if (is_free && !given[at(g.shaft)]) open = &g;
      }
      if (open) {
        y[speed_index(open->shaft)] -= sum / open->gain;
      } else if (std::abs(sum) > 1e-9 * m.speed_scale) {
        throw std::runtime_error(
            fmt::format("the start speeds contradict \"{}\", which ties them; leave one of them out",
                        m.network.relations[at(relation.relation)].component));
      }
    }
}

std::vector<double> Equations::modes_from_scratch(double t, double reduction_angle, double reduction_speed) {
  const Model& m = *model_;
  std::vector<double> y(size(), 0.0);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] = m.angles[i].gain * reduction_angle;
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    y[speed_index(static_cast<int>(s))] = reduction_speed * m.node_ratio[at(m.shafts[s].reference)];
  std::fill(turns_.begin(), turns_.end(), 0.0);
  wrap(y);
  set_timed_modes(t);
  for (const int s : directional_) direction_[at(s)] = reduction_speed > 0 ? 1 : reduction_speed < 0 ? -1 : 0;
  for (std::size_t i = 0; i < m.elastic.size(); ++i) slip_[i] = m.elastic[i].slips ? 0 : 1;  // clutches locked
  std::fill(loss_direction_.begin(), loss_direction_.end(), reduction_speed >= 0 ? 1 : -1);
  for (const auto& pool : m.pools) pool->first_modes(instant(t, y), mode_.data());
  for (const auto& pool : m.pools) pool->first_states(instant(t, y), y.data() + own_begin());
  tie_stuck_contacts();
  return y;
}

// Twists that carry the torques which the rigid machine would have in this position: no artificial ring at the start.
// The machine as a whole may accelerate; all shafts then do so together.
void Equations::balance_twists(std::span<double> y, double t) {
  const Model& m = *model_;
  if (m.elastic.empty()) return;
  const Network& net = m.network;
  for (std::size_t i = 0; i < m.elastic.size(); ++i) y[twists_begin() + i] = 0;
  evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr);
  // Without twists the elements' torques alone remain; sum them over the whole machine.
  double torque = 0, inertia = 0;
  bool free = true;
  std::vector<double> need(net.nodes.size(), 0.0);
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    inertia += net.nodes[n].inertia * m.node_ratio[n] * m.node_ratio[n];
    free = free && net.nodes[n].prescribed < 0;
  }
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const double ratio = m.node_ratio[at(net.elements[e].node)];
    torque += element_torque_[e] * ratio;
    inertia += element_inertia_[e] * ratio * ratio;
  }
  // At standstill the opposing elements may hold the machine.
  double hold_low = 0, hold_high = 0;
  std::fill(shaft_hold_.begin(), shaft_hold_.end(), Hold{});
  std::fill(element_hold_.begin(), element_hold_.end(), Hold{});
  for (const auto& pool : m.pools) pool->add_holds(snapshot_.now, shaft_hold_.data(), element_hold_.data());
  const bool still = std::all_of(y.begin() + static_cast<std::ptrdiff_t>(speed_index(0)),
                                 y.begin() + static_cast<std::ptrdiff_t>(states_), [](double w) { return w == 0; });
  if (still)
    for (std::size_t e = 0; e < net.elements.size(); ++e) {
      hold_low += element_hold_[e].low * m.node_ratio[at(net.elements[e].node)];
      hold_high += element_hold_[e].high * m.node_ratio[at(net.elements[e].node)];
    }
  const double held = std::clamp(-torque, hold_low, hold_high);
  const double capacity = held > 0 ? hold_high : hold_low;
  const double acceleration = free ? (torque + held) / inertia : 0;  // of the reduction link
  for (std::size_t n = 0; n < net.nodes.size(); ++n) need[n] = net.nodes[n].inertia * m.node_ratio[n] * acceleration;
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const std::size_t n = at(net.elements[e].node);
    need[n] += element_inertia_[e] * m.node_ratio[n] * acceleration - element_torque_[e];
    if (still && capacity != 0) need[n] -= held / capacity * (held > 0 ? element_hold_[e].high : element_hold_[e].low);
  }
  // Sum from the leaves of the whole tree to a root that can take the rest (a prescribed motion, if there is one).
  std::vector<std::vector<int>> joints_at(net.nodes.size());
  for (std::size_t j = 0; j < net.joints.size(); ++j) {
    joints_at[at(net.joints[j].a)].push_back(static_cast<int>(j));
    joints_at[at(net.joints[j].b)].push_back(static_cast<int>(j));
  }
  int root = m.reduction_node;
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0) root = static_cast<int>(n);
  std::vector<RigidStep> steps;
  std::vector<char> seen(net.nodes.size(), 0);
  std::vector<int> queue = {root};
  seen[at(root)] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const int j : joints_at[at(queue[next])]) {
      const Network::Joint& joint = net.joints[at(j)];
      const int other = joint.a == queue[next] ? joint.b : joint.a;
      if (seen[at(other)]) continue;
      seen[at(other)] = 1;
      steps.push_back({j, other, queue[next], other == joint.b});
      queue.push_back(other);
    }
  std::vector<double> joint_torque(net.joints.size(), 0.0);
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const double ratio = net.joints[at(step->joint)].ratio, wanted = need[at(step->child)];
    joint_torque[at(step->joint)] = step->child_is_b ? wanted / ratio : -wanted;
    need[at(step->parent)] += step->child_is_b ? wanted / ratio : ratio * wanted;
  }
  std::vector<double> twists(m.elastic.size());
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    const int j = m.elastic[i].joint;
    twists[i] = net.joints[at(j)].element->twist_at(joint_torque[at(j)]);
    y[twists_begin() + i] = twists[i];
  }
  // Shafts away from the reduction link stand turned by the twists.
  std::vector<double> angles(m.shafts.size(), 0.0);
  set_shaft_angles(twists.data(), angles);
  for (std::size_t i = 0; i < m.angles.size(); ++i) y[i] += m.angles[i].gain * angles[at(m.angles[i].shaft)];
  wrap(y);
}

}  // namespace kurbel
