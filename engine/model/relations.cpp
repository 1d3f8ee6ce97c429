// relations.cpp — relations removed by compilation, and the others over the merged shafts.
#include "engine/model/relations.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/find_by.h"
#include "engine/matrices/elimination.h"
#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

std::string torque_name(const Network& network, const Network::Relation& relation, int k) {
  const Network::Node& node = network.nodes[at(relation.node[at(k)])];
  return relation.component + "." + node.label;
}

// The member by which the component is driven: its port "in", or what a gear of its own ties to it; else the first.
int driving_member(const Network& network, const Network::Relation& relation) {
  const auto ports = network.ports.find(relation.component);
  if (ports == network.ports.end()) return 0;
  const int in = ports->second.in;
  for (int k = 0; k < relation.members(); ++k)
    if (relation.node[at(k)] == in) return k;
  for (const Network::Joint& joint : network.joints)
    for (int k = 0; k < relation.members(); ++k)
      if (joint.component == relation.component && joint.a == in && joint.b == relation.node[at(k)]) return k;
  return 0;
}

// The torques of a relation by their shafts: taken from the driving one, given to the others.
void list_torques(const Network& network, const Network::Relation& relation, int driving,
                  const GearTorque::Term& source, double taken_per_source, std::vector<GearTorque>& torques) {
  for (int k = 0; k < relation.members(); ++k) {
    GearTorque::Term term = source;
    const double gain = relation.gain[at(k)], sense = k == driving ? -1 : 1;
    term.taken = -sense * gain * taken_per_source;
    term.lost = k == 0 ? 0 : sense * (k == 1 ? gain : 1 + gain);
    const std::string name = torque_name(network, relation, k);
    auto* const known = find_by(torques, &GearTorque::name, name);
    if (!known)
      torques.push_back({name, relation.node[at(k)], {term}});
    else if (k == 2)
      known->terms.push_back(term);  // the housing carries the reaction of every stage
  }
}

}  // namespace

bool relations_are_independent(const Network& network, const std::vector<int>& group, const std::vector<double>& gain) {
  if (network.relations.empty()) return true;
  const int groups = 1 + *std::max_element(group.begin(), group.end());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(network.relations.size()), groups);
  for (std::size_t r = 0; r < network.relations.size(); ++r) {
    const Network::Relation& relation = network.relations[r];
    for (int k = 0; k < relation.members(); ++k)
      rows(static_cast<Eigen::Index>(r), group[at(relation.node[at(k)])]) +=
          relation.gain[at(k)] * gain[at(relation.node[at(k)])];
  }
  return rank_by_columns(rows) == rows.rows();
}

std::vector<GearTorque> simplify_relations(Network& network, const Effects& effects, const std::vector<char>& stands) {
  std::vector<GearTorque> torques;
  std::vector<Network::Relation> kept;
  std::vector<Network::Joint> joints;
  std::vector<int> drives;
  for (const Network::Relation& relation : network.relations) drives.push_back(driving_member(network, relation));
  std::size_t next = 0;
  for (std::size_t r = 0; r < network.relations.size(); ++r) {
    Network::Relation& relation = network.relations[r];
    while (next < relation.joints_before) joints.push_back(std::move(network.joints[next++]));
    relation.lossy = relation.lossy && effects.gear_losses;
    const int driving = drives[r];
    std::vector<int> moving;
    for (int k = 0; k < relation.members(); ++k)
      if (!stands[at(relation.node[at(k)])]) moving.push_back(k);
    if (relation.lossy || moving.size() != 2) {
      list_torques(network, relation, driving, {.relation = static_cast<int>(kept.size())}, 1, torques);
      kept.push_back(relation);
      continue;
    }
    const std::size_t a = at(moving[0]), b = at(moving[1]);
    list_torques(network, relation, driving, {.joint = static_cast<int>(joints.size())}, 1 / relation.gain[a], torques);
    joints.push_back({.a = relation.node[a],
                      .b = relation.node[b],
                      .ratio = -relation.gain[b] / relation.gain[a],
                      .component = relation.component});
  }
  while (next < network.joints.size()) joints.push_back(std::move(network.joints[next++]));
  network.joints = std::move(joints);
  network.relations = std::move(kept);
  return torques;
}

std::vector<ShaftRelation> relations_over_shafts(const Model& model) {
  const Network& net = model.network;
  const auto add = [&](std::vector<ShaftGain>& row, int node, double gain) {
    const int shaft = model.shaft_of_node[at(node)];
    gain *= model.gain_of_node[at(node)];
    for (ShaftGain& entry : row)
      if (entry.shaft == shaft) {
        entry.gain += gain;
        return;
      }
    row.push_back({shaft, gain});
  };
  std::vector<ShaftRelation> relations;
  for (std::size_t r = 0; r < net.relations.size(); ++r) {
    const Network::Relation& given = net.relations[r];
    ShaftRelation relation;
    relation.relation = static_cast<int>(r);
    for (int k = 0; k < given.members(); ++k) add(relation.motion, given.node[at(k)], given.gain[at(k)]);
    if (given.lossy) {
      relation.in_motion = given.loss;
      // L brakes the driving side against the frame of the gear: v = ω₀ − ω₂, felt at 1 and 2.
      add(relation.loss, given.node[1], given.gain[1]);
      add(relation.sliding, given.node[0], 1);
      if (given.members() == 3) {
        add(relation.loss, given.node[2], 1 + given.gain[2]);
        add(relation.sliding, given.node[2], -1);
      }
    }
    relations.push_back(std::move(relation));
  }
  return relations;
}

std::vector<int> shafts_without_motion(const Model& model) {
  std::vector<int> massless;
  for (std::size_t s = 0; s < model.free_shafts; ++s)
    if (!(model.shafts[s].mean_inertia > 0)) massless.push_back(static_cast<int>(s));
  if (massless.empty()) return massless;
  const std::size_t relations = model.relations.size();
  Eigen::MatrixXd rows =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(relations), static_cast<Eigen::Index>(massless.size()));
  std::vector<std::size_t> order;
  for (std::size_t r = 0; r < relations; ++r) {
    order.push_back(r);
    for (const ShaftGain& g : model.relations[r].motion)
      for (std::size_t k = 0; k < massless.size(); ++k)
        if (massless[k] == g.shaft) rows(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) += g.gain;
  }
  const Eliminated given = eliminate(rows, order, Eigen::VectorXd::Ones(rows.cols()));
  // A motion of shafts without inertia alone that the relations allow: those that it moves are undefined.
  std::vector<int> undefined;
  for (std::size_t k = 0; k < massless.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const auto pivot = std::find(given.column.begin(), given.column.end(), column);
    bool moves = pivot == given.column.end();
    if (!moves) {
      const Eigen::Index row = given.row[static_cast<std::size_t>(pivot - given.column.begin())];
      for (Eigen::Index j = 0; j < rows.cols(); ++j) moves = moves || (j != column && given.rows(row, j) != 0);
    }
    if (moves || model.shafts[at(massless[k])].mean_inertia < 0) undefined.push_back(massless[k]);
  }
  return undefined;
}

std::vector<int> loose_trees(const Model& model) {
  if (model.relations.empty()) return {};
  // Groups of shafts joined by twists: each points towards the first of its group.
  std::vector<std::size_t> towards(model.shafts.size());
  for (std::size_t s = 0; s < towards.size(); ++s) towards[s] = s;
  const auto first_of = [&](std::size_t s) {
    while (towards[s] != s) s = towards[s] = towards[towards[s]];
    return s;
  };
  for (const ElasticJoint& e : model.elastic) towards[first_of(at(e.shaft_a))] = first_of(at(e.shaft_b));
  std::vector<char> known(model.shafts.size(), 0);  // of groups, by their first
  known[first_of(at(model.angles.front().shaft))] = 1;
  std::vector<int> loose;
  // Prescribed shafts first, the last before the others: vibrations relative to the frame have its angle as zero.
  for (std::size_t s = model.shafts.size(); s-- > 0;) {
    if (std::exchange(known[first_of(s)], 1)) continue;
    loose.push_back(model.shafts[s].reference);
  }
  return loose;
}

double MotorTorque::torque(const Snapshot& s) const {
  if (prescribed) return s.reaction[node];
  double sum = 0;
  for (const std::size_t e : elements) sum += s.sums.element_torque[e];
  return sum;
}

double GearTorque::value(const double* joint_torque, const double* relation_torque, const double* relation_loss) const {
  double sum = 0;
  for (const Term& term : terms) {
    if (term.joint >= 0)
      sum += term.taken * joint_torque[term.joint];
    else
      sum += term.taken * relation_torque[term.relation] + term.lost * relation_loss[term.relation];
  }
  return sum;
}

}  // namespace kurbel
