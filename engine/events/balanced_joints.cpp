// balanced_joints.cpp — torques of the joints of a whole network that stands, or accelerates together.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "engine/events/start.h"
#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/index.h"
#include "engine/numerics/load_paths.h"

namespace kurbel {

namespace {

// All joints, then all relations as links of two; what slips in the usual motion leads nowhere. A link's torque is that
// on a, `share` τ; its twist counts over the share, so that their product is that of τ and θ.
std::vector<LoadLink> links_of(const Model& m, std::span<const double> share) {
  const Network& net = m.network;
  std::vector<LoadLink> links;
  for (std::size_t j = 0; j < net.joints.size(); ++j) {
    const Network::Joint& joint = net.joints[j];
    const double a = m.node_ratio[at(joint.a)], b = joint.ratio * m.node_ratio[at(joint.b)];
    const bool slips = joint.element && (joint.element->is.slips || joint.element->is.springless) &&
                       std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b));
    links.push_back(
        {joint.a, slips ? joint.a : joint.b, joint.ratio / share[j],
         joint.element && joint.element->stiffness > 0 ? 1 / (joint.element->stiffness * share[j] * share[j]) : 0});
  }
  for (const Network::Relation& relation : net.relations) {
    if (relation.members() == 3 && relation.usual[2] != 0)
      throw std::runtime_error(
          fmt::format("the three shafts of \"{}\" are free, so it is not known which torques balance each other; start "
                      "without equilibrium",
                      relation.component));
    links.push_back({relation.node[0], relation.node[1], -relation.gain[1]});
  }
  return links;
}

// Which circling torques make springs that are not straight gape by what was locked in: Newton, from their share as
// straight ones.
void close_loops(const Model& m, std::span<const double> share, const LoadLoops& loops, const std::vector<double>& gape,
                 std::vector<double>& torque) {
  const auto n = static_cast<Eigen::Index>(loops.size());
  const auto twist = [&](int link, double tau) {
    if (at(link) >= m.network.joints.size()) return 0.0;
    const Network::Joint& joint = m.network.joints[at(link)];
    if (joint.elastic) return joint.element->twist_at(tau / share[at(link)]) / share[at(link)];
    return joint.element && joint.element->stiffness > 0 ? tau / joint.element->stiffness : 0.0;
  };
  constexpr int most_steps = 50;
  for (int step = 0; step < most_steps; ++step) {
    Eigen::VectorXd off(n);
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      off[i] = -gape[static_cast<std::size_t>(i)];
      for (const auto& [k, part] : loops.loops()[static_cast<std::size_t>(i)]) {
        const double tau = torque[at(k)], by = 1e-6 * std::max(1.0, std::abs(tau));
        off[i] += part * twist(k, tau);
        const double compliance = (twist(k, tau + by) - twist(k, tau - by)) / (2 * by);
        for (Eigen::Index j = 0; j < n; ++j)
          for (const auto& [other, share] : loops.loops()[static_cast<std::size_t>(j)])
            if (other == k) slope(i, j) += part * compliance * share;
      }
    }
    const Eigen::VectorXd change = FullLu(slope).solve(off).col(0);
    double size = 0, largest = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      for (const auto& [k, part] : loops.loops()[static_cast<std::size_t>(i)]) {
        torque[at(k)] -= part * change[i];
        size = std::max(size, std::abs(part * change[i])), largest = std::max(largest, std::abs(torque[at(k)]));
      }
    if (!(size > 1e-13 * largest)) return;
  }
}

}  // namespace

std::vector<double> balanced_joints(const Model& m, std::vector<double> need, std::span<const double> twist,
                                    std::span<const double> share) {
  const Network& net = m.network;
  LoadPaths paths(links_of(m, share), net.nodes.size());
  std::vector<double> torque(paths.links().size(), 0.0);
  std::vector<LoadStep> all;
  const auto sum_to = [&](int root) {
    const std::vector<LoadStep> steps = paths.from(root);
    for (const LoadStep& step : steps) pass_on(step, need.data(), torque.data());
    all.insert(all.end(), steps.begin(), steps.end());
  };
  int root = m.reduction_node;
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0 && m.node_ratio[n] != 0) root = static_cast<int>(n);
  sum_to(root);
  // The housings carry the reactions of their gears, towards the frame.
  for (std::size_t r = 0; r < net.relations.size(); ++r)
    if (net.relations[r].members() == 3)
      need[at(net.relations[r].node[2])] += net.relations[r].gain[2] * torque[net.joints.size() + r];
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0 && !paths.reached(n)) sum_to(static_cast<int>(n));
  const LoadLoops loops(paths, all, net.nodes.size());
  if (loops.undetermined() >= 0)
    throw std::runtime_error(fmt::format(
        "the closed loop at \"{}\" has no spring all round, so it is not known how it shares its torque; start without "
        "equilibrium",
        m.node_label(paths.links()[at(loops.undetermined())].b)));
  if (loops.any()) {
    loops.share(torque.data());
    std::vector<double> gape(loops.size(), 0.0);
    for (std::size_t i = 0; i < loops.size(); ++i)
      for (const auto& [k, part] : loops.loops()[i])
        for (std::size_t e = 0; e < m.elastic.size(); ++e)
          if (m.elastic[e].joint == k) gape[i] += part * twist[e] / share[at(k)];
    close_loops(m, share, loops, gape, torque);
  }
  torque.resize(net.joints.size());
  for (std::size_t j = 0; j < torque.size(); ++j) torque[j] /= share[j];
  return torque;
}

}  // namespace kurbel
