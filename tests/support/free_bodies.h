// free_bodies.h — free-body check of every node of a network: inertia, elements, torques of its joints and gears. If
// all nodes are in balance, every joint's torque is the same from either side (theory 5.18).
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/numerics/index.h"

namespace kurbel::test {

struct OpenNode {
  double part = 0;  // residual over the sum of magnitudes at the node
  std::string words = {};
};

// Uses only the published quantities of a state, node by node, independently of the tree traversal that determines the
// torques. Omitted are nodes at which a standing shaft is held, since holding torques of elements are not published;
// nodes of gears reduced to one joint by a standing member, whose torque meets no node of its own; and the frame.
inline OpenNode most_open_node(Equations& equations, double t, std::span<const double> y) {
  const Snapshot& s = equations.snapshot(t, y);
  const Model& m = equations.model();
  const Network& net = m.network;
  std::vector<double> left(net.nodes.size(), 0.0), size(net.nodes.size(), 0.0);
  const auto act = [&](int node, double torque) {
    left[at(node)] += torque;
    size[at(node)] += std::abs(torque);
  };
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    act(static_cast<int>(n), -net.nodes[n].inertia * m.gain_of_node[n] * s.alpha[m.shaft_of_node[n]]);
  std::vector<char> is_omitted(net.nodes.size(), 0);
  for (const GearTorque& gear : m.gear_torques)
    for (const GearTorque::Term& term : gear.terms)
      if (term.joint >= 0) is_omitted[at(gear.node)] = 1;
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const int node = net.elements[e].node, shaft = m.shaft_of_node[at(node)];
    const double alpha = m.gain_of_node[at(node)] * s.alpha[shaft];
    act(node, s.sums.element_torque[e] - s.sums.element_inertia[e] * alpha);
    if (net.elements[e].element->is.directional && equations.at_standstill(at(shaft))) is_omitted[at(node)] = 1;
  }
  std::vector<double> turning(net.joints.size(), 0.0);
  for (std::size_t i = 0; i < m.elastic.size(); ++i) turning[at(m.elastic[i].joint)] = s.sums.turning_torque[i];
  for (std::size_t j = 0; j < net.joints.size(); ++j) {
    act(net.joints[j].a, -s.joint_torque[j] + turning[j]);
    act(net.joints[j].b, net.joints[j].ratio * s.joint_torque[j]);
  }
  for (std::size_t r = 0; r < m.relations.size(); ++r) {
    const Network::Relation& relation = net.relations[at(m.relations[r].relation)];
    const double taken = s.relation_torque[r], lost = s.relation_loss[r];
    act(relation.node[0], -taken);
    act(relation.node[1], -relation.gain[1] * (taken - lost));
    if (relation.members() == 3) act(relation.node[2], -relation.gain[2] * taken + (1 + relation.gain[2]) * lost);
  }
  OpenNode worst;
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    if (is_omitted[n]) continue;
    const int p = m.shafts[at(m.shaft_of_node[n])].prescribed;
    if (p >= 0 && net.prescribed[at(p)].is_nothing()) continue;
    if (net.nodes[n].prescribed >= 0) act(static_cast<int>(n), s.reaction[n]);
    const double part = std::abs(left[n]) / std::max(size[n], 1e-3 * m.torque_scale / m.scale_ratio[n]);
    if (!(part <= worst.part))
      worst = {part, fmt::format("at {:.9g} s {} N·m are left of {} N·m at \"{}\"", t, left[n], size[n],
                                 m.node_label(static_cast<int>(n)))};
  }
  return worst;
}

}  // namespace kurbel::test
