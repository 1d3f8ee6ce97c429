// joint_torques.cpp — needs of the nodes, summed from the leaves of each merged shaft to its root.
#include "engine/equations/joint_torques.h"

#include <algorithm>
#include <cmath>

#include "engine/numerics/index.h"

namespace kurbel {
JointTorques::JointTorques(const Model& model) : model_(&model) {
  torque_.assign(model.network.joints.size(), 0);
  balance_.assign(model.network.nodes.size(), 0);
  hold_torque_.assign(model.network.elements.size(), 0);
  list_trees();
  list_places();
}

// Data read at every step are contiguous.
void JointTorques::list_places() {
  const Model& m = *model_;
  for (std::size_t n = 0; n < m.network.nodes.size(); ++n)
    nodes_.push_back({m.network.nodes[n].inertia * m.gain_of_node[n], m.shaft_of_node[n]});
  for (const Network::ShaftElement& e : m.network.elements)
    elements_.push_back({e.node, m.shaft_of_node[at(e.node)], m.gain_of_node[at(e.node)]});
}

// The rigid joints within each merged shaft, leaves first, seen from its reference node.
void JointTorques::list_trees() {
  const Network& net = model_->network;
  std::vector<LoadLink> links;
  std::vector<int> joint_of;
  for (std::size_t j = 0; j < net.joints.size(); ++j) {
    const Network::Joint& joint = net.joints[j];
    if (joint.elastic) continue;
    links.push_back({joint.a, joint.b, joint.ratio,
                     joint.element && joint.element->stiffness > 0 ? 1 / joint.element->stiffness : 0});
    joint_of.push_back(static_cast<int>(j));
  }
  LoadPaths paths(std::move(links), net.nodes.size());
  for (const Shaft& shaft : model_->shafts) {
    const std::vector<LoadStep> steps = paths.from(shaft.reference);
    steps_.insert(steps_.end(), steps.rbegin(), steps.rend());
  }
  std::reverse(steps_.begin(), steps_.end());
  loops_ = LoadLoops(paths, steps_, net.nodes.size(), joint_of);
  for (LoadStep& step : steps_) step.link = joint_of[at(step.link)];
  if (loops_.any()) lock_in_twists_of_the_start();
}

// A completely rigid loop keeps its initial preload.
void JointTorques::lock_in_twists_of_the_start() {
  const Network& net = model_->network;
  const auto& start = model_->scene.run.start.components;
  std::vector<double> twist(net.joints.size(), 0.0);
  for (std::size_t j = 0; j < net.joints.size(); ++j) {
    const auto given = start.find(net.joints[j].component);
    if (given != start.end() && net.joints[j].element && !net.joints[j].elastic)
      twist[j] = given->second.twist.value_or(0) * net.share_of_twist(net.joints[j]);
  }
  loops_.lock_in(twist);
}

void JointTorques::find(const Given& given, std::span<const Held> held, const Hold* shaft_hold,
                        const Hold* element_hold) {
  add_inertia_and_elements(given);
  add_connections(given);
  if (holds_) std::fill(hold_torque_.begin(), hold_torque_.end(), 0.0);
  holds_ = !held.empty();
  for (const Held& one : held) add_held(one, shaft_hold[one.shaft], element_hold);
  // Links that close loops are no steps of the trees: their torques are zero until the loops share.
  for (const auto& loop : loops_.loops())
    for (const auto& [link, part] : loop) torque_[at(link)] = 0;
  eliminate_leaves();
  bear_reactions();
  if (loops_.any()) loops_.share(torque_.data());
}

void JointTorques::add_inertia_and_elements(const Given& given) {
  // Local copies that are not changed by writes, so that the compiler need not reload them.
  const double *const alpha = given.alpha, *const torque = given.element_torque, *const inertia = given.element_inertia;
  double* const need = balance_.data();
  const NodeInertia* const node = nodes_.data();
  for (std::size_t n = 0, count = nodes_.size(); n < count; ++n) need[n] = node[n].inertia_gain * alpha[node[n].shaft];
  const ElementPlace* const element = elements_.data();
  for (std::size_t e = 0, count = elements_.size(); e < count; ++e)
    need[element[e].node] += inertia[e] * element[e].gain * alpha[element[e].shaft] - torque[e];
}

void JointTorques::add_connections(const Given& given) {
  const Model& m = *model_;
  const Network& net = m.network;
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    const Network::Joint& joint = net.joints[at(m.elastic[i].joint)];
    torque_[at(m.elastic[i].joint)] = given.connection_torque[i];
    balance_[at(joint.a)] += given.connection_torque[i] - given.turning_torque[i];
    balance_[at(joint.b)] -= joint.ratio * given.connection_torque[i];
  }
  for (std::size_t r = 0; r < m.relations.size(); ++r) {
    const Network::Relation& relation = net.relations[at(m.relations[r].relation)];
    const double taken = given.relation_torque[r], lost = given.relation_loss[r];
    for (int k = 0; k < relation.members(); ++k) balance_[at(relation.node[at(k)])] += relation.gain[at(k)] * taken;
    balance_[at(relation.node[1])] -= relation.gain[1] * lost;
    if (relation.members() == 3) balance_[at(relation.node[2])] -= (1 + relation.gain[2]) * lost;
  }
}

void JointTorques::add_held(const Held& held, const Hold& shaft_hold, const Hold* element_hold) {
  const Model& m = *model_;
  const double capacity = held.rest > 0 ? shaft_hold.high : shaft_hold.low;
  if (capacity == 0) return;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e) {
    const std::size_t n = at(m.network.elements[e].node);
    if (m.shaft_of_node[n] != held.shaft) continue;
    const bool upwards = (held.rest > 0) == (m.gain_of_node[n] > 0);  // on the element's own shaft
    hold_torque_[e] = held.rest / capacity * (upwards ? element_hold[e].high : element_hold[e].low);
    balance_[n] -= hold_torque_[e];
  }
}

JointTorques::Open JointTorques::open(const Given& given) const {
  const Model& m = *model_;
  std::vector<double> meeting(m.shafts.size(), 0.0);
  const auto meet = [&](int node, double torque) {
    meeting[at(m.shaft_of_node[at(node)])] += std::abs(m.gain_of_node[at(node)] * torque);
  };
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    meet(static_cast<int>(n), nodes_[n].inertia_gain * given.alpha[nodes_[n].shaft]);
  for (std::size_t e = 0; e < elements_.size(); ++e) meet(elements_[e].node, given.element_torque[e]);
  for (std::size_t i = 0; i < m.elastic.size(); ++i) {
    const Network::Joint& joint = m.network.joints[at(m.elastic[i].joint)];
    meet(joint.a, given.connection_torque[i]);
    meet(joint.b, joint.ratio * given.connection_torque[i]);
  }
  for (std::size_t r = 0; r < m.relations.size(); ++r) {
    const Network::Relation& relation = m.network.relations[at(m.relations[r].relation)];
    for (int k = 0; k < relation.members(); ++k)
      meet(relation.node[at(k)], relation.gain[at(k)] * given.relation_torque[r]);
  }
  constexpr double small = 1e-3;  // of the torque scale: relative to less, rounding would matter
  Open worst;
  for (std::size_t s = 0; s < m.free_shafts; ++s) {
    const double left = std::abs(balance_[at(m.shafts[s].reference)]);
    const double part = left / std::max(meeting[s], small * m.shafts[s].torque_scale);
    if (part > worst.part) worst = {part, static_cast<int>(s)};
  }
  return worst;
}

void JointTorques::eliminate_leaves() {
  double *const torque = torque_.data(), *const balance = balance_.data();
  for (const LoadStep& step : std::span<const LoadStep>(steps_)) pass_on(step, balance, torque);
}

// Gears that became joints of two shafts still load the third one at rest: their torque is passed to the frame.
void JointTorques::bear_reactions() {
  const Model& m = *model_;
  for (const GearTorque& gear : m.gear_torques) {
    if (m.shafts[at(m.shaft_of_node[at(gear.node)])].prescribed < 0) continue;
    double need = 0;
    for (const GearTorque::Term& term : gear.terms)
      if (term.joint >= 0) need -= term.taken * torque_[at(term.joint)];
    if (need == 0) continue;
    int node = gear.node;
    for (const LoadStep& step : steps_) {  // leaves first: the way to the root is in order
      if (step.child != node) continue;
      const double ratio = step.ratio;
      torque_[at(step.link)] += step.child_is_b ? need / ratio : -need;
      need = step.child_is_b ? need / ratio : ratio * need;
      node = step.parent;
    }
    balance_[at(node)] += need;
  }
}

}  // namespace kurbel
