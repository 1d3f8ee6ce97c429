// placement.cpp — elements into their pools, each with the indices that it needs: angles, modes, states, commands,
// accounts.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/find_by.h"
#include "engine/model/compile_steps.h"
#include "engine/model/relations.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/lobatto_element.h"

namespace kurbel {
namespace {

// The place of a node's angle among those that are tracked.
int tracked(Model& m, int node) {
  const int shaft = m.shaft_of_node[at(node)];
  const double gain = m.gain_of_node[at(node)];
  for (std::size_t i = 0; i < m.angles.size(); ++i)
    if (m.angles[i].shaft == shaft && m.angles[i].gain == gain) return static_cast<int>(i);
  m.angles.push_back({node, shaft, gain});
  return static_cast<int>(m.angles.size()) - 1;
}

// Loads of a mechanism by name: parts of a component that can be switched separately.
std::vector<std::string> parts_of(const Network& net, const std::string& component) {
  std::vector<std::string> parts;
  for (const Network::ShaftElement& e : net.elements)
    if (e.component == component && e.element->cycle != 0)
      for (const auto& [name, account] : e.element->further_accounts)
        if (name.starts_with(component + ".load")) parts.push_back(name);
  return parts;
}

std::string component_of(const std::string& said) { return said.substr(0, said.find('.')); }

// The command of a mechanism is followed by those of its loads, in their order, as its element expects.
void list_commands(Model& m) {
  for (const SequenceStep& step : m.scene.sequence.steps)
    for (const std::string& said : step.set) {
      const std::string component = component_of(said);
      if (m.command_of(component) >= 0) continue;
      m.commands.push_back({component, {}, {}});
      for (const std::string& part : parts_of(m.network, component)) m.commands.push_back({part, {}, {}});
    }
}

// A load of several chambers is set whole: "press.load2.behind" with "press.load2".
void set_whole_loads(Model& m) {
  for (SequenceStep& step : m.scene.sequence.steps)
    for (std::size_t k = step.set.size(); k-- > 0;) {
      const std::string said = step.set[k];
      if (said == component_of(said)) continue;
      for (const std::string& part : parts_of(m.network, component_of(said)))
        if (part.starts_with(said + ".")) step.set.push_back(part);
    }
}

int place_internal_states(Model& m, const std::string& component, const std::vector<InternalState>& states,
                          double twist = 0) {
  const int first = static_cast<int>(m.internal_states.size());
  for (const InternalState& state : states) {
    m.internal_states.push_back({component, state});
    if (state.scale == 0) m.internal_states.back().state.scale = twist;
  }
  return first;
}

int account(Model& m, const std::string& name, Account kind) {
  m.accounts.push_back({name, kind});
  return static_cast<int>(m.accounts.size()) - 1;
}

void place_connections(Model& m, PoolSet& pools) {
  std::string last;
  int loss = -1;
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    Deadline::check();
    ElasticJoint& e = m.elastic[i];
    const Network::Joint& joint = m.network.joints[at(e.joint)];
    if (joint.component != last || loss < 0) loss = account(m, joint.component, Account::harmful);
    last = joint.component;
    e.loss_account = loss;
    ConnectionExtras extras{
        .own = place_internal_states(m, joint.component, joint.element->internal_states, e.twist_scale),
        .component = joint.component};
    if (joint.element->is.guards > 0) extras.mode = static_cast<int>(m.mode_slots++);
    if (joint.element->is.commanded) extras.command = m.command_of(joint.component);
    if (joint.element->is.uses_angle) extras.angle = tracked(m, joint.a);
    joint.element->place(pools, {static_cast<int>(i), e.shaft_a, e.shaft_b, e.gain_a, e.gain_b, loss}, extras);
  }
}

void account_for_relations(Model& m) {
  for (ShaftRelation& relation : m.relations)
    if (m.network.relations[at(relation.relation)].lossy)
      relation.loss_account = account(m, m.network.relations[at(relation.relation)].component, Account::harmful);
}

void place_on_shafts(Model& m, PoolSet& pools) {
  for (std::size_t i = 0; i < m.network.elements.size(); ++i) {
    Deadline::check();
    Network::ShaftElement& e = m.network.elements[i];
    ShaftPorts ports{.id = static_cast<int>(i),
                     .node = e.node,
                     .shaft = m.shaft_of_node[at(e.node)],
                     .gain = m.gain_of_node[at(e.node)]};
    if (e.element->is.uses_angle) {
      ports.angle = tracked(m, e.node);
      ports.phase = e.phase;
    }
    ports.mode = static_cast<int>(m.mode_slots);
    m.mode_slots += at(e.element->modes);
    ports.own = place_internal_states(m, e.component, e.element->internal_states);
    ports.command = m.command_of(e.component);
    if (ports.command >= 0 && !e.element->is.commanded)
      m.commands[at(ports.command)].switched.push_back(static_cast<int>(i));
    if (ports.command >= 0 && e.element->opens_at_zero)
      m.commands[at(ports.command)].opened.push_back(static_cast<int>(i));
    ports.account = e.account = account(m, e.component, e.element->account);
    for (const auto& [name, kind] : e.element->further_accounts) account(m, name, kind);
    e.element->place(pools, ports, {e.window, e.component});
  }
}

// Of a mechanism its loads are switched; one without any has nothing to be switched.
bool can_be_set(const Network& net, const Network::ShaftElement& e) {
  return e.element->cycle == 0 || !parts_of(net, e.component).empty();
}

// Commands that a component accepts from a sequence.
struct Commandable {
  bool any = false, reversible = true;
  bool switched = false;  // some part of it is only on or off
  std::string why_not = {};
};

// A load of a mechanism, by its name: on or off.
Commandable commandable_part(const Network& net, const std::string& said) {
  const std::string component = component_of(said);
  const std::vector<std::string> parts = parts_of(net, component);
  Commandable is{.reversible = false, .switched = true};
  is.any = std::find(parts.begin(), parts.end(), said) != parts.end();
  is.why_not = parts.empty()
                   ? fmt::format("\"{}\" has no loads that could be set apart; name the component alone", component)
                   : fmt::format("\"{}\" is no load of \"{}\"{}; allowed: {}", said, component, suggestion(said, parts),
                                 shortened_list(parts));
  return is;
}

Commandable commandable(const Network& net, const std::string& component) {
  if (component.find('.') != std::string::npos) return commandable_part(net, component);
  Commandable is;
  for (const Network::ShaftElement& e : net.elements)
    if (e.component == component && can_be_set(net, e)) {
      is.any = true, is.reversible = is.reversible && e.element->is.reversible;
      is.switched = is.switched || !e.element->is.commanded;
    }
  for (const Network::Joint& joint : net.joints)
    if (joint.component == component && joint.element && joint.element->is.commanded)
      is.any = true, is.reversible = false;
  return is;
}

// Reason why this step has no effect on the component, or another one than stated; empty: it is valid.
std::string fault_of(const SequenceStep& step, const std::string& component, const Commandable& is) {
  if (!is.any && !is.why_not.empty()) return is.why_not;
  if (!is.any)
    return fmt::format(
        "\"{}\" has nothing that can be set; name a motor, a load, a mechanism with loads, a clutch or a brake",
        component);
  if (is.switched && !step.law.empty())
    return fmt::format("\"{}\" is on or off and can follow no law; give its torque over time in its own table",
                       component);
  if (step.to < 0 && !is.reversible)
    return fmt::format("\"{}\" cannot be reversed, to = {:g}; must be ≥ 0 (only electric motors without a starter can)",
                       component, step.to);
  if (is.switched && step.to != 0 && step.to != 1)
    return fmt::format(
        "\"{}\" is on or off, to = {:g}; must be 0 or 1 (clutches, brakes and electric motors without a starter can be "
        "set in part)",
        component, step.to);
  if (is.switched && step.over > 0)
    return fmt::format(
        "\"{}\" is on or off and goes through no ramp, over = {:g} s; leave \"over\" out, or give its torque over time "
        "in its own table",
        component, step.over);
  return {};
}

// Rejects commands that a component does not accept.
void check_sequence(Compilation& c) {
  for (const SequenceStep& step : c.model.scene.sequence.steps)
    for (const std::string& component : step.set) {
      const std::string fault = fault_of(step, component, commandable(c.net(), component));
      if (!fault.empty()) c.messages.add(step.at, "[sequence]: " + fault);
    }
}

}  // namespace

int Model::command_of(const std::string& component) const {
  for (std::size_t c = 0; c < commands.size(); ++c)
    if (commands[c].component == component) return static_cast<int>(c);
  return -1;
}

void track_angles(Compilation& c) {
  Model& m = c.model;
  m.reduction_angle = tracked(m, m.reduction_node);
  for (const int node : loose_trees(m)) tracked(m, node);
  for (const SequenceStep& step : m.scene.sequence.steps)
    m.trigger_angle.push_back(step.when == SequenceStep::When::angle ? tracked(m, m.network.ports.at(step.of).in) : -1);
}

void place_elements(Compilation& c) {
  Model& m = c.model;
  set_whole_loads(m);
  list_commands(m);
  for (PrescribedSpeed& given : m.network.prescribed)
    if (!given.follows.empty()) given.command = m.command_of(given.follows);
  PoolSet pools;
  place_connections(m, pools);
  account_for_relations(m);
  place_on_shafts(m, pools);
  for (const Network::Node& node : m.network.nodes)
    if (node.prescribed >= 0) account(m, node.component, Account::driving);
  check_sequence(c);
  m.pools = pools.release();
  for (const auto& pool : m.pools) pool->add_channels(m.pool_channels);
}

void list_torque_joints(Compilation& c) {
  Model& m = c.model;
  std::map<std::string, int> segments, seen;
  for (const Network::Joint& joint : m.network.joints)
    if (joint.element) ++segments[joint.component];
  int elastic = 0;
  for (std::size_t j = 0; j < m.network.joints.size(); ++j) {
    const Network::Joint& joint = m.network.joints[j];
    if (!joint.element && !joint.reported) continue;
    TorqueJoint listed{.component = joint.component,
                       .joint = static_cast<int>(j),
                       .torque_scale = m.torque_scale / m.scale_ratio[at(joint.a)]};
    if (!joint.label.empty()) listed.component += "." + joint.label;
    if (joint.element) {
      if (joint.elastic) listed.first = listed.last = listed.elastic = elastic++;
      const int total = segments[joint.component], k = ++seen[joint.component];
      if (joint.chain >= 0 && m.network.chains[at(joint.chain)].degree > 0) {
        if (2 * k != total + 1) continue;  // the torque of a continuous shaft is that in its middle
        if (joint.elastic) listed.first -= k - 1, listed.last += total - k;
        listed.reported = {lobatto_element(total).middle};
      } else if (total > 20 && k != 1 && k != total) {
        continue;  // both ends of a long chain
      } else if (joint.label.empty() && total > 1) {
        listed.component += fmt::format(".{}", k);
      }
    }
    m.torque_joints.push_back(std::move(listed));
  }
}

void list_motors(Model& m) {
  for (std::size_t e = 0; e < m.network.elements.size(); ++e) {
    const Network::ShaftElement& element = m.network.elements[e];
    const Rated rated = element.element->rated;
    if (element.element->account != Account::driving || !(rated.torque > 0) || rated.speed == 0) continue;
    auto* const known = find_by(m.motors, &MotorTorque::component, element.component);
    if (known)
      known->elements.push_back(e);
    else
      m.motors.push_back({element.component, {e}, element.node, rated.torque, rated.speed});
  }
  for (std::size_t n = 0; n < m.network.nodes.size(); ++n) {
    const Network::Node& node = m.network.nodes[n];
    if (node.prescribed >= 0 && !m.network.prescribed[at(node.prescribed)].is_nothing())
      m.motors.push_back({node.component,
                          {},
                          static_cast<int>(n),
                          m.torque_scale / m.scale_ratio[n],
                          m.speed_scale * m.scale_ratio[n],
                          true});
  }
}

}  // namespace kurbel
