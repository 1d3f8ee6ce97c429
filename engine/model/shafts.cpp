// shafts.cpp — the coordinates: shafts with their inertias, free ones first, and the elastic joints between them.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/model/compile_steps.h"
#include "engine/model/relations.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// One shaft per group, with its reference node: a prescribed one, else the crank, else the first.
std::vector<Shaft> gather_shafts(Compilation& c, const Merging& merging) {
  const Network& net = c.net();
  std::vector<Shaft> groups(at(merging.groups));
  for (std::size_t n = 0; n < net.nodes.size(); ++n) groups[at(merging.group[n])].nodes.push_back(static_cast<int>(n));
  for (Shaft& shaft : groups) {
    shaft.reference = shaft.nodes.front();
    for (const int n : shaft.nodes) {
      if (net.nodes[at(n)].prescribed < 0) continue;
      if (shaft.prescribed >= 0)
        c.refuse(net.nodes[at(n)].component,
                 fmt::format("\"{}\" prescribes the speed of a shaft whose speed \"{}\" prescribes already; "
                             "keep one, or put an elastic coupling between them",
                             net.nodes[at(n)].component, net.nodes[at(shaft.reference)].component));
      shaft.prescribed = net.nodes[at(n)].prescribed;
      shaft.reference = n;
    }
  }
  for (const Network::ShaftElement& e : net.elements) {
    Shaft& shaft = groups[at(merging.group[at(e.node)])];
    if (e.element->cycle > 0 && !shaft.variable) {
      shaft.variable = true;
      if (shaft.prescribed < 0) shaft.reference = e.node;
    }
    shaft.directional = shaft.directional || e.element->is.directional;
  }
  return groups;
}

void add_inertias(const Model& m, const Merging& merging, std::vector<Shaft>& groups) {
  for (Shaft& shaft : groups) {
    if (shaft.prescribed < 0 && std::count(shaft.nodes.begin(), shaft.nodes.end(), m.reduction_node))
      shaft.reference = m.reduction_node;
    const double reference = merging.gain[at(shaft.reference)];
    for (const int n : shaft.nodes) {
      const double gain = merging.gain[at(n)] / reference;
      shaft.inertia += m.network.nodes[at(n)].inertia * gain * gain;
    }
  }
}

// Free shafts first, so that their speeds are contiguous in the state.
void put_in_order(Model& m, const Merging& merging, std::vector<Shaft>& groups) {
  std::vector<std::size_t> order(groups.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return groups[i].prescribed < 0; });
  m.shaft_of_node.assign(m.network.nodes.size(), 0);
  m.gain_of_node.assign(m.network.nodes.size(), 1);
  for (const std::size_t i : order) {
    if (groups[i].prescribed < 0) ++m.free_shafts;
    for (const int n : groups[i].nodes) {
      m.shaft_of_node[at(n)] = static_cast<int>(m.shafts.size());
      m.gain_of_node[at(n)] = merging.gain[at(n)] / merging.gain[at(groups[i].reference)];
    }
    m.shafts.push_back(std::move(groups[i]));
  }
}

// Reason why the connections of a shaft without inertia do not define its motion: no inertia either, or slip.
std::string ties_of_massless(const Model& m, int shaft) {
  std::string text;
  for (const ShaftRelation& relation : m.relations)
    if (std::any_of(relation.motion.begin(), relation.motion.end(),
                    [&](const ShaftGain& g) { return g.shaft == shaft && g.gain != 0; }))
      text += fmt::format("\"{}\" ties it to a shaft without inertia, ",
                          m.network.relations[at(relation.relation)].component);
  for (const ElasticJoint& e : m.elastic)
    if (e.slips && (e.shaft_a == shaft || e.shaft_b == shaft))
      text += fmt::format("\"{}\" may slip, ", m.network.joints[at(e.joint)].component);
  return text;
}

// A mechanism whose crank is massless may have no inertia to offer it at a dead centre, where its acceleration is
// infinite.
void check_dead_centres(Compilation& c, const Shaft& shaft) {
  const Network::ShaftElement* mechanism = nullptr;
  double least = shaft.inertia;
  for (const Network::ShaftElement& e : c.net().elements) {
    if (!std::count(shaft.nodes.begin(), shaft.nodes.end(), e.node) || e.element->cycle == 0) continue;
    if (mechanism) return;  // several mechanisms are at different angles
    mechanism = &e;
    const double gain = c.model.gain_of_node[at(e.node)];
    least += e.element->least_inertia * gain * gain;
  }
  if (mechanism && least < 1e-9 * shaft.mean_inertia)
    c.refuse(mechanism->component,
             fmt::format("\"{}\" has no inertia {}, so the crank's motion is undefined; give it a crank_inertia",
                         mechanism->component,
                         mechanism->element->internal_states.empty()
                             ? "at a dead centre (its output stands still there)"
                             : "while its rod flies free of the crank or stands at a dead centre"));
}

}  // namespace

void make_shafts(Compilation& c) {
  Model& m = c.model;
  const Merging merging = merge_shafts(m.network);
  check_rigid_loops(c, merging);
  std::vector<Shaft> groups = gather_shafts(c, merging);
  add_inertias(m, merging, groups);
  put_in_order(m, merging, groups);
  for (Shaft& shaft : m.shafts) shaft.mean_inertia = shaft.inertia;
  for (const Network::ShaftElement& e : m.network.elements) {
    const double gain = m.gain_of_node[at(e.node)];
    m.shafts[at(m.shaft_of_node[at(e.node)])].mean_inertia += e.element->mean_inertia * gain * gain;
  }
}

void make_elastic_joints(Compilation& c) {
  Model& m = c.model;
  for (std::size_t j = 0; j < m.network.joints.size(); ++j) {
    const Network::Joint& joint = m.network.joints[j];
    if (!joint.elastic) continue;
    m.elastic.push_back({static_cast<int>(j), m.shaft_of_node[at(joint.a)], m.shaft_of_node[at(joint.b)],
                         m.gain_of_node[at(joint.a)], joint.ratio * m.gain_of_node[at(joint.b)], 1e-4,
                         joint.element->is.slips, joint.element->is.springless});
  }
}

void check_inertias(Compilation& c) {
  const Model& m = c.model;
  const std::vector<int> undefined = shafts_without_motion(m);
  for (std::size_t s = 0; s < m.free_shafts; ++s) {
    const Shaft& shaft = m.shafts[s];
    if (shaft.variable && shaft.mean_inertia > 0) check_dead_centres(c, shaft);
  }
  for (const int s : undefined) {
    const Shaft& shaft = m.shafts[at(s)];
    std::set<std::string> names;
    for (const int n : shaft.nodes) names.insert(m.node_label(n));
    c.refuse(m.network.nodes[at(shaft.nodes.front())].component,
             fmt::format("the shaft at {} has no inertia (0 kg·m²), {}so its motion is undefined; give a "
                         "component there an inertia (a coupling: inertia_in, inertia_out){}",
                         listed({names.begin(), names.end()}, "and"), ties_of_massless(m, s),
                         m.elastic.empty() ? "" : ", or switch the elasticity beside it off"));
  }
  c.messages.throw_if_any();
}

}  // namespace kurbel
