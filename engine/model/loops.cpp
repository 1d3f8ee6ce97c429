// loops.cpp — closed loops of shafts: the motion that they allow, and contradictory ratios.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/matrices/linear_algebra.h"
#include "engine/model/compile_steps.h"
#include "engine/model/relations.h"
#include "engine/numerics/index.h"
#include "engine/numerics/load_paths.h"

namespace kurbel {
namespace {

constexpr double fits = 1e-9;  // of the speeds: tolerance for the closure of a loop

bool is_firm(const Network::Joint& joint) {
  return !joint.element || !(joint.element->is.slips || joint.element->is.springless);
}

// Location of messages on loops: the first branch with an end.
Location place_of_loop(const Compilation& c) {
  for (const Line& line : c.model.scene.lines)
    if (!line.to.empty()) return line.to_at;
  return c.place_of_line();
}

// Difference of the speeds of a joint's ends, at these speeds of its nodes.
double gap(const Network::Joint& joint, const std::vector<double>& speed) {
  return speed[at(joint.a)] - joint.ratio * speed[at(joint.b)];
}
bool closes(const Network::Joint& joint, const std::vector<double>& speed) {
  return std::abs(gap(joint, speed)) <=
         fits * std::max(std::abs(speed[at(joint.a)]), std::abs(joint.ratio * speed[at(joint.b)]));
}
bool holds(const Network::Relation& relation, const std::vector<double>& speed) {
  double sum = 0, size = 0;
  for (int k = 0; k < relation.members(); ++k) {
    const double term = relation.gain[at(k)] * speed[at(relation.node[at(k)])];
    sum += term, size = std::max(size, std::abs(term));
  }
  return std::abs(sum) <= fits * size;
}

std::string node_words(const Network& net, int node) {
  const Network::Node& n = net.nodes[at(node)];
  return n.label.empty() ? n.component : n.component + "." + n.label;
}

[[noreturn]] void refuse_clash(const Compilation& c, const Network& net, const std::vector<double>& speed) {
  std::string text = "a closed loop of shafts ties more speeds than can turn together";
  for (const Network::Joint& joint : net.joints)
    if (is_firm(joint) && !closes(joint, speed)) {
      text = fmt::format(
          "a closed loop of shafts cannot turn: \"{}\" would turn {:.6g} times as fast as \"{}\" by one way round and "
          "{:.6g} times by the other",
          node_words(net, joint.a), speed[at(joint.a)] / speed[at(joint.b)], node_words(net, joint.b), joint.ratio);
      break;
    }
  throw SceneError({{c.messages.file(), place_of_loop(c),
                     text + "; check the ratios, or put a clutch or a viscous coupling into the loop"}});
}

// Nearest to a first guess of all motions that firm joints and relations allow.
std::vector<double> allowed_motion(const Compilation& c, const Network& net, const std::vector<double>& guess) {
  constexpr int most_parts = 3000;
  const Merging parts = merge(net, is_firm);
  if (parts.groups > most_parts)
    throw SceneError(
        {{c.messages.file(), place_of_loop(c),
          fmt::format(
              "a closed loop with planetary gears or gears with losses, in a machine of {} parts; must be at most {}",
              parts.groups, most_parts)}});
  std::vector<Eigen::RowVectorXd> rows;
  const auto add = [&](std::initializer_list<std::pair<int, double>> terms) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(parts.groups);
    double size = 0;
    for (const auto& [node, gain] : terms) {
      if (node < 0) continue;
      row[parts.group[at(node)]] += gain * parts.gain[at(node)];
      size = std::max(size, std::abs(gain * parts.gain[at(node)]));
    }
    if (row.cwiseAbs().maxCoeff() > fits * size) rows.push_back(row / row.cwiseAbs().maxCoeff());
  };
  for (const Network::Joint& joint : net.joints)
    if (is_firm(joint) && !closes(joint, parts.gain)) add({{joint.a, 1}, {joint.b, -joint.ratio}});
  for (const Network::Relation& r : net.relations)
    add({{r.node[0], r.gain[0]}, {r.node[1], r.gain[1]}, {r.node[2], r.gain[2]}});
  Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()), parts.groups);
  for (std::size_t k = 0; k < rows.size(); ++k) all.row(static_cast<Eigen::Index>(k)) = rows[k];
  const Eigen::MatrixXd kernel = FullLu(all, fits).kernel();
  if (kernel.cols() == 0) refuse_clash(c, net, guess);
  Eigen::VectorXd wanted(parts.groups);
  for (std::size_t n = net.nodes.size(); n-- > 0;) wanted[parts.group[n]] = guess[n] / parts.gain[n];
  const Eigen::VectorXd motion = kernel * least_squares(kernel, wanted);
  std::vector<double> speed(net.nodes.size());
  for (std::size_t n = 0; n < speed.size(); ++n) speed[n] = parts.gain[n] * motion[parts.group[n]];
  return speed;
}

}  // namespace

std::vector<double> usual_motion(Compilation& c) {
  const Network& net = c.net();
  const auto any = [](const Network::Joint&) { return true; };
  std::vector<double> speed = merge(net, any, Through::all).gain;
  const bool said = std::any_of(c.model.scene.lines.begin(), c.model.scene.lines.end(),
                                [](const Line& line) { return !line.to.empty(); });
  if (!said && net.joints.size() + at(merge(net, any).groups) == net.nodes.size()) return speed;  // a tree
  const auto fitting = [&] {
    return std::all_of(net.joints.begin(), net.joints.end(),
                       [&](const auto& joint) { return !is_firm(joint) || closes(joint, speed); }) &&
           std::all_of(net.relations.begin(), net.relations.end(), [&](const auto& r) { return holds(r, speed); });
  };
  if (fitting()) return speed;
  const std::vector<double> guess = speed;
  speed = allowed_motion(c, net, guess);
  if (!fitting() || std::abs(speed[at(c.model.reduction_node)]) < fits) refuse_clash(c, net, guess);
  return speed;
}

void check_rigid_loops(Compilation& c, const Merging& merging) {
  Model& m = c.model;
  const Network& net = m.network;
  std::size_t rigid = 0;
  for (const Network::Joint& joint : net.joints) {
    rigid += !joint.elastic;
    if (joint.elastic || is_firm(joint) || closes(joint, m.node_ratio)) continue;
    c.refuse(joint.component,
             fmt::format("\"{}\" counts as locked here, but it closes a loop in which its sides usually turn at {:.6g} "
                         ": {:.6g}; this study takes every clutch as locked, and the machine cannot turn so",
                         joint.component, m.node_ratio[at(joint.a)], m.node_ratio[at(joint.b)]));
    c.messages.throw_if_any();
  }
  if (!relations_are_independent(net, merging.group, merging.gain))
    throw SceneError({{c.messages.file(), place_of_loop(c),
                       "a closed loop of shafts with a gear that has losses, or a planetary gear, is rigid all round: "
                       "how it shares its torque is not determined, for friction in its teeth keeps whatever share it "
                       "was loaded with; let a shaft or a coupling of the loop be elastic, or leave the losses of its "
                       "gears out (--effects none; kurbel compare --against none)"}});
  if (rigid + at(merging.groups) == net.nodes.size()) return;
  std::vector<LoadLink> links;
  std::vector<const Network::Joint*> joints;
  for (const Network::Joint& joint : net.joints) {
    if (joint.elastic) continue;
    if (!closes(joint, merging.gain)) refuse_clash(c, net, merging.gain);
    links.push_back({joint.a, joint.b, joint.ratio,
                     joint.element && joint.element->stiffness > 0 ? 1 / joint.element->stiffness : 0});
    joints.push_back(&joint);
  }
  LoadPaths paths(std::move(links), net.nodes.size());
  std::vector<LoadStep> steps;
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (!paths.reached(n))
      for (const LoadStep& step : paths.from(static_cast<int>(n))) steps.push_back(step);
  const LoadLoops loops(paths, steps, net.nodes.size());
  if (loops.undetermined() >= 0)
    throw SceneError({{c.messages.file(), place_of_loop(c),
                       fmt::format("the loop that is closed at \"{}\" is rigid all round: how it shares its torque is "
                                   "not determined; put a shaft or a coupling with a stiffness into it",
                                   node_words(net, joints[at(loops.undetermined())]->b))}});
  m.merged.push_back(fmt::format(
      "{} closed {} all round: what is passed each way goes by the stiffnesses that are given (least energy)",
      loops.size(), loops.size() == 1 ? "loop is rigid" : "loops are rigid"));
}

}  // namespace kurbel
