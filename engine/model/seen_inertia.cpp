// seen_inertia.cpp — sums over rigidly connected nodes, continued through flanges without inertia.
#include "engine/model/seen_inertia.h"

#include <cmath>

#include "engine/model/compile_steps.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"

namespace kurbel {

SeenInertias::SeenInertias(const Network& network) : net_(network) {
  Merging finest = merge(
      net_, [](const Network::Joint& joint) { return !joint.element; }, Through::turning);
  group_ = std::move(finest.group), gain_ = std::move(finest.gain);
  inertia_.assign(at(finest.groups), 0.0);
  joints_at_.resize(at(finest.groups));
  const auto add = [&](int node, double inertia) {
    inertia_[at(group_[at(node)])] += inertia * gain_[at(node)] * gain_[at(node)];
  };
  std::vector<char> within(net_.nodes.size(), 0);
  for (const Network::Chain& chain : net_.chains)
    for (std::size_t i = 1; i + 1 < chain.nodes.size(); ++i) {
      within[at(chain.nodes[i])] = 1;
      for (const int end : {chain.nodes.front(), chain.nodes.back()})
        add(end, 0.5 * net_.nodes[at(chain.nodes[i])].inertia);
    }
  for (std::size_t n = 0; n < net_.nodes.size(); ++n)
    if (!within[n]) add(static_cast<int>(n), net_.nodes[n].prescribed >= 0 ? HUGE_VAL : net_.nodes[n].inertia);
  for (const Network::ShaftElement& e : net_.elements) add(e.node, e.element->mean_inertia);
  for (std::size_t j = 0; j < net_.joints.size(); ++j) {
    const Network::Joint& joint = net_.joints[j];
    if (!joint.element) continue;
    const auto [a, b] = ends_of(j);
    if (joint.chain >= 0 && joint.a != a) continue;  // a shaft once, by its first part
    joints_at_[at(group_[at(a)])].push_back(j);
    joints_at_[at(group_[at(b)])].push_back(j);
  }
}

std::array<int, 2> SeenInertias::ends_of(std::size_t j) const {
  const Network::Joint& joint = net_.joints[j];
  if (joint.chain < 0) return {joint.a, joint.b};
  const std::vector<int>& nodes = net_.chains[at(joint.chain)].nodes;
  return {nodes.front(), nodes.back()};
}

double SeenInertias::own(int node) const {
  return inertia_[at(group_[at(node)])] / (gain_[at(node)] * gain_[at(node)]);
}

double SeenInertias::on_side(std::size_t cut, int node) const {
  if (own(node) > 0) return own(node);
  const auto is_cut = [&](std::size_t j) {
    return j == cut || (net_.joints[j].chain >= 0 && net_.joints[j].chain == net_.joints[cut].chain);
  };
  struct Place {
    int group = 0;
    double speed = 1;  // of its first node over that of `node`
  };
  double sum = 0;
  std::vector<Place> queue = {{group_[at(node)], 1 / gain_[at(node)]}};
  std::vector<char> seen(inertia_.size(), 0);
  seen[at(queue.front().group)] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    Deadline::check();
    const Place here = queue[next];
    for (const std::size_t j : joints_at_[at(here.group)]) {
      if (is_cut(j)) continue;
      const auto [a, b] = ends_of(j);
      const bool from_a = group_[at(a)] == here.group;
      const int near = from_a ? a : b, far = from_a ? b : a, group = group_[at(far)];
      if (seen[at(group)]) continue;
      seen[at(group)] = 1;
      const double ratio = net_.joints[j].ratio, at_near = here.speed * gain_[at(near)];
      const double speed = (from_a ? at_near / ratio : at_near * ratio) / gain_[at(far)];
      if (inertia_[at(group)] > 0)
        sum += inertia_[at(group)] * speed * speed;
      else
        queue.push_back({group, speed});
    }
  }
  return sum;
}

double SeenInertias::reduced(std::size_t joint) const {
  const double ratio = net_.joints[joint].ratio, a = on_side_a(joint), b = on_side_b(joint);
  const double compliance = 1 / a + ratio * ratio / b;
  return compliance > 0 && std::isfinite(compliance) ? 1 / compliance : 0.0;
}

}  // namespace kurbel
