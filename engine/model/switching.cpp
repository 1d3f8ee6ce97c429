// switching.cpp — the network with the present effects: elastic, merged and omitted parts.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/elements/no_element.h"
#include "engine/model/compile_steps.h"
#include "engine/model/seen_inertia.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// Of a joint that could be.
bool stays_elastic(const Effects& effects, const Network::Joint& joint) {
  if (joint.element->is.slips || joint.element->is.springless) return !effects.locked;
  return effects.all_elastic ||
         std::find(effects.elastic.begin(), effects.elastic.end(), joint.component) != effects.elastic.end();
}

void refuse_undefined_damping(Compilation& c, const std::string& component, double a, double b) {
  const std::string why =
      a > 0 && b > 0 ? "both of its shafts turn at given speeds"
                     : fmt::format("on its {} side there is no inertia at all", a > 0   ? "driven"
                                                                                : b > 0 ? "driving"
                                                                                        : "driving and driven");
  c.refuse(component, fmt::format("\"{}\": its damping is given in relation to the natural frequency of the inertias "
                                  "that it joins, and {}; give damping in N*m*s/rad, or damping_frequency besides",
                                  component, why));
}

// Joints that stay elastic, and the descriptions of the others.
void switch_joints(Model& m) {
  for (Network::Joint& joint : m.network.joints) {
    if (joint.element && (joint.element->is.slips || joint.element->is.springless)) {
      joint.elastic = !m.effects.locked;
      if (!joint.elastic)
        m.merged.push_back(fmt::format("\"{}\" counts as locked; the shafts on either side are one", joint.component));
      continue;
    }
    joint.elastic = joint.element && stays_elastic(m.effects, joint);
    if (joint.element && !joint.elastic &&
        (m.merged.empty() || m.merged.back().find("\"" + joint.component + "\"") == std::string::npos))
      m.merged.push_back(fmt::format("\"{}\" is rigid because its elasticity is off; the shafts on either side are one",
                                     joint.component));
  }
}

// With clutches locked the machine runs: brakes of the operating sequence are released, and the sequence has
// ended.
void release_brakes(Model& m) {
  std::set<std::string> commanded;
  for (const SequenceStep& step : m.scene.sequence.steps) commanded.insert(step.set.begin(), step.set.end());
  m.scene.sequence.steps.clear();
  std::erase_if(m.network.elements, [&](const Network::ShaftElement& e) {
    const bool brake = commanded.count(e.component) && e.element->is.directional && e.element->is.commanded;
    if (brake) m.merged.push_back(fmt::format("\"{}\" counts as released", e.component));
    return brake;
  });
}

// Without elasticity motors follow their static curves, unless the machine is compared with an elastic one.
Effects effects_on_elements(const Model& m) {
  Effects effects = m.effects;
  if (effects.lags_rigid) return effects;
  effects.torque_lag = effects.torque_lag &&
                       std::any_of(m.network.joints.begin(), m.network.joints.end(), [](const Network::Joint& joint) {
                         return joint.elastic && joint.element->is.has_spring();
                       });
  return effects;
}

void remove_unconnected(Model& m) {
  std::vector<Network::ShaftElement>& elements = m.network.elements;
  for (std::size_t e = elements.size(); e-- > 0;)
    if (elements[e].element == no_element()) {
      elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(e));
      if (static_cast<int>(e) < m.reduction_element) --m.reduction_element;
    }
}

}  // namespace

// Connections in the form that the effects leave them.
void switch_connections(Compilation& c) {
  for (Network::Joint& joint : c.net().joints)
    if (joint.element)
      if (auto changed = joint.element->form_under(c.model.effects)) joint.element = std::move(changed);
}

// A damping ratio refers to the two inertias that the element joins when every elastic element is flexible, whatever
// effects are on: 1/J_red = 1/J_a + i²/J_b. Parts of a shaft have its damping as a whole, however many they are.
void settle_relative_damping(Compilation& c) {
  Network& net = c.net();
  const SeenInertias seen(net);
  std::set<std::string> refused;
  for (std::size_t j = 0; j < net.joints.size(); ++j) {
    Network::Joint& joint = net.joints[j];
    if (!joint.element) continue;
    const bool cut = joint.chain >= 0 && net.chains[at(joint.chain)].degree == 0;
    const double parts = cut ? static_cast<double>(net.chains[at(joint.chain)].nodes.size() - 1) : 1;
    const double reduced = seen.reduced(j);
    if (reduced == 0 && joint.element->damping_hangs_on_inertia() && stays_elastic(c.model.effects, joint) &&
        refused.insert(joint.component).second)
      refuse_undefined_damping(c, joint.component, seen.on_side_a(j), seen.on_side_b(j));
    // Each of n equal springs in a row is n times as stiff, and with n times the inertia n times as damped.
    if (auto settled = joint.element->settled(reduced * parts)) joint.element = std::move(settled);
  }
}

void switch_effects(Compilation& c) {
  Model& m = c.model;
  switch_joints(m);
  if (m.effects.locked) release_brakes(m);
  const Effects effects = effects_on_elements(m);
  bool any = false;
  for (Network::ShaftElement& e : m.network.elements) try {
      if (auto changed = e.element->form_under(effects)) {
        any = any || e.element->cycle > 0;
        e.element = std::move(changed);
      }
    } catch (const std::invalid_argument& cannot) {  // effects that it cannot have together
      c.refuse(e.component, fmt::format("\"{}\": {}", e.component, cannot.what()));
    }
  remove_unconnected(m);
  if (m.effects.joint_friction && !any)
    c.messages.add(c.place_of_line(),
                   "joint_friction is on, but no joint of a mechanism has friction; give one a coefficient: of a "
                   "slider-crank its main_bearing, crank_pin, slider_pin or guide, of another mechanism one of its "
                   "joints; or switch the effect off");
}

std::vector<char> standing_nodes(const Network& net) {
  const Merging merging = merge_shafts(net);
  std::vector<char> stands(at(merging.groups), 0), of_node;
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0 && net.prescribed[at(net.nodes[n].prescribed)].is_nothing())
      stands[at(merging.group[n])] = 1;
  for (std::size_t n = 0; n < net.nodes.size(); ++n) of_node.push_back(stands[at(merging.group[n])]);
  return of_node;
}

}  // namespace kurbel
