// balanced_joints.cpp — torques of the joints of a whole network that stands, or accelerates together.
#include <fmt/format.h>

#include <stdexcept>

#include "engine/events/start.h"
#include "engine/numerics/index.h"

namespace kurbel {

std::vector<double> balanced_joints(const Model& m, std::vector<double> need) {
  const Network& net = m.network;
  struct Link {
    int a, b;
    double ratio;
  };
  std::vector<Link> links;
  for (const Network::Joint& joint : net.joints) links.push_back({joint.a, joint.b, joint.ratio});
  for (const Network::Relation& relation : net.relations) {
    if (relation.members() == 3 && relation.usual[2] != 0)
      throw std::runtime_error(
          fmt::format("the three shafts of \"{}\" are free, so it is not known which torques balance each other; start "
                      "without equilibrium",
                      relation.component));
    links.push_back({relation.node[0], relation.node[1], -relation.gain[1]});
  }
  std::vector<std::vector<int>> links_at(net.nodes.size());
  for (std::size_t j = 0; j < links.size(); ++j) {
    links_at[at(links[j].a)].push_back(static_cast<int>(j));
    links_at[at(links[j].b)].push_back(static_cast<int>(j));
  }
  struct Step {  // leaves last
    int link, child, parent;
    bool child_is_b;
  };
  std::vector<double> torque(links.size(), 0.0);
  std::vector<char> seen(net.nodes.size(), 0);
  const auto sum_to = [&](int root) {
    std::vector<Step> steps;
    std::vector<int> queue = {root};
    seen[at(root)] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const int j : links_at[at(queue[next])]) {
        const int other = links[at(j)].a == queue[next] ? links[at(j)].b : links[at(j)].a;
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        steps.push_back({j, other, queue[next], other == links[at(j)].b});
        queue.push_back(other);
      }
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      const double ratio = links[at(step->link)].ratio, wanted = need[at(step->child)];
      torque[at(step->link)] = step->child_is_b ? wanted / ratio : -wanted;
      need[at(step->parent)] += step->child_is_b ? wanted / ratio : ratio * wanted;
    }
  };
  int root = m.reduction_node;
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0 && m.node_ratio[n] != 0) root = static_cast<int>(n);
  sum_to(root);
  // Housings bear the reactions of their gears, towards the frame.
  for (std::size_t r = 0; r < net.relations.size(); ++r)
    if (net.relations[r].members() == 3)
      need[at(net.relations[r].node[2])] += net.relations[r].gain[2] * torque[net.joints.size() + r];
  for (std::size_t n = 0; n < net.nodes.size(); ++n)
    if (net.nodes[n].prescribed >= 0 && !seen[n]) sum_to(static_cast<int>(n));
  torque.resize(net.joints.size());
  return torque;
}

}  // namespace kurbel
