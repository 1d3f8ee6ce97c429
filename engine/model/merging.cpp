// merging.cpp — rigidly connected nodes, the connection of all nodes, and their speed ratios.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "engine/model/compile_steps.h"
#include "engine/model/relations.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// A clutch, or a viscous film: its sides need not turn at its ratio.
bool may_slip(const Network::Joint& joint) {
  return joint.element && (joint.element->is.slips || joint.element->is.springless);
}

// Breadth-first search over the nodes, with the speed of each relative to the first.
class Traversal {
 public:
  Traversal(const Network& network, const std::function<bool(const Network::Joint&)>& is_rigid, Through relations)
      : network_(network), through_(relations), joints_at_(network.nodes.size()), relations_at_(network.nodes.size()) {
    for (std::size_t j = 0; j < network.joints.size(); ++j)
      if (is_rigid(network.joints[j])) {
        joints_at_[at(network.joints[j].a)].push_back(j);
        joints_at_[at(network.joints[j].b)].push_back(j);
        any_slips_ = any_slips_ || may_slip(network.joints[j]);
      }
    for (const Network::Relation& relation : network.relations)
      for (int k = 0; k < relation.members(); ++k)
        if (is_followed(relation, k)) relations_at_[at(relation.node[at(k)])].push_back(&relation);
  }

  Merging merging() {
    const std::size_t n = network_.nodes.size();
    merging_ = {std::vector<int>(n, -1), std::vector<double>(n, 1.0), 0};
    for (std::size_t first = 0; first < n; ++first) {
      if (merging_.group[first] >= 0) continue;
      Deadline::check();
      queue_ = {first};
      merging_.group[first] = merging_.groups;
      // Joints that may slip come last: they follow the ratios of gears on their sides and define none.
      for (std::size_t next = 0, late = 0; next < queue_.size() || (any_slips_ && late < queue_.size());) {
        if (next == queue_.size()) {
          visit_joints(queue_[late++], true);
          continue;
        }
        visit_joints(queue_[next], false);
        visit_relations(queue_[next++]);
      }
      ++merging_.groups;
    }
    return std::move(merging_);
  }

 private:
  bool is_followed(const Network::Relation& relation, int k) const {
    return through_ == Through::all || (through_ == Through::turning && relation.usual[at(k)] != 0);
  }
  void visit_joints(std::size_t node, bool slipping) {
    for (const std::size_t j : joints_at_[node]) {
      const Network::Joint& joint = network_.joints[j];
      if (may_slip(joint) != slipping) continue;
      const bool from_a = at(joint.a) == node;
      const std::size_t other = at(from_a ? joint.b : joint.a);
      if (merging_.group[other] >= 0) continue;
      merging_.group[other] = merging_.groups;
      merging_.gain[other] = from_a ? merging_.gain[node] / joint.ratio : merging_.gain[node] * joint.ratio;
      queue_.push_back(other);
    }
  }
  void visit_relations(std::size_t node) {
    for (const Network::Relation* relation : relations_at_[node]) {
      const auto own = static_cast<std::size_t>(
          std::find(relation->node.begin(), relation->node.end(), static_cast<int>(node)) - relation->node.begin());
      for (int k = 0; k < relation->members(); ++k) {
        const std::size_t other = at(relation->node[at(k)]);
        if (merging_.group[other] >= 0 || !is_followed(*relation, k)) continue;
        merging_.group[other] = merging_.groups;
        const double usual = relation->usual[own];
        merging_.gain[other] =
            usual == 0 ? relation->usual[at(k)] : merging_.gain[node] * relation->usual[at(k)] / usual;
        queue_.push_back(other);
      }
    }
  }

  const Network& network_;
  Through through_;
  std::vector<std::vector<std::size_t>> joints_at_;
  std::vector<std::vector<const Network::Relation*>> relations_at_;
  Merging merging_;
  std::vector<std::size_t> queue_;
  bool any_slips_ = false;
};

bool any_joint(const Network::Joint&) { return true; }

// Compiling takes time in proportion to the shafts, and to the cube of the relations between their speeds.
void check_sizes(Compilation& c) {
  constexpr std::size_t most_shafts = 1'000'000, most_relations = 1000;
  const Network& net = c.net();
  const auto refuse = [&](const std::string& component, const std::string& text) {
    throw SceneError({{c.messages.file(), c.place_of(component), text}});
  };
  if (net.nodes.size() > most_shafts)
    refuse(net.nodes[most_shafts].component,
           fmt::format("the machine has {} shaft ends; must be at most {}; give fewer segments or components",
                       net.nodes.size(), most_shafts));
  if (net.relations.size() > most_relations)
    refuse(net.relations[most_relations].component,
           fmt::format("the machine has {} gears with losses, planetary gears and gears in housings; must be at most "
                       "{}; give some of the gears without losses",
                       net.relations.size(), most_relations));
}

// Parts of one shaft start at one speed and one angle, whichever effects are on.
void check_start(Compilation& c, const Merging& firm) {
  const struct {
    std::optional<double> ComponentStart::*of;
    const char *words, *unit;
  } given[] = {{&ComponentStart::speed, "speeds", "rad/s"}, {&ComponentStart::angle, "angles", "rad"}};
  for (const auto& what : given) {
    std::map<int, std::pair<std::string, double>> first;  // per shaft: the component that gives it, value at first node
    for (const auto& [component, start] : c.model.scene.run.start.components) {
      const auto port = c.net().ports.find(component);
      if (!(start.*what.of) || port == c.net().ports.end()) continue;
      const std::size_t node = at(port->second.in);
      const double gain = firm.gain[node], value = *(start.*what.of) / gain;
      const auto [known, is_first] = first.try_emplace(firm.group[node], component, value);
      const auto& [other, said] = known->second;
      if (is_first || std::abs(value - said) <= 1e-9 * std::max(std::abs(value), std::abs(said))) continue;
      throw SceneError({{c.messages.file(), start.at,
                         fmt::format("[run]: start: {} of \"{}\" and \"{}\" contradict each other: they are parts of "
                                     "one shaft, {:.6g} and {:.6g} {} of \"{}\"; leave one of them out",
                                     what.words, other, component, said * gain, value * gain, what.unit, component)}});
    }
  }
}

}  // namespace

Merging merge(const Network& network, const std::function<bool(const Network::Joint&)>& is_rigid, Through relations) {
  return Traversal(network, is_rigid, relations).merging();
}

Merging merge_shafts(const Network& network) {
  return merge(network, [](const Network::Joint& joint) { return !joint.elastic; });
}

void check_shafts(Compilation& c) {
  const Network& net = c.net();
  const auto refuse = [&](const std::string& text) {
    throw SceneError({{c.messages.file(), c.place_of_line(), text}});
  };
  if (net.nodes.empty()) refuse("the machine has no shaft");
  check_sizes(c);
  if (merge(net, any_joint, Through::all).groups > 1)
    refuse("a part of the machine is unconnected; check the lines and branches");
  const Merging firm = merge(net, [](const Network::Joint& joint) { return !joint.element; });
  if (!relations_are_independent(net, firm.group, firm.gain))
    refuse(
        "gears with losses, planetary gears or gears in housings tie the same shafts twice; check the lines and "
        "branches");
  check_start(c, firm);
}

// The reduction link is the crank of the first mechanism, else the first shaft of the line.
void choose_reduction_link(Compilation& c) {
  Model& m = c.model;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e)
    if (m.network.elements[e].element->cycle > 0) {
      m.reduction_node = m.network.elements[e].node;
      m.cycle = m.network.elements[e].element->cycle;
      m.reduction_element = static_cast<int>(e);
      return;
    }
}

void find_node_ratios(Compilation& c) {
  Model& m = c.model;
  const Network& net = c.net();
  m.node_ratio = usual_motion(c);
  const double reduction = m.node_ratio[at(m.reduction_node)];
  for (double& ratio : m.node_ratio) ratio /= reduction == 0 ? 1 : reduction;
  for (const double ratio : m.node_ratio) m.scale_ratio.push_back(ratio == 0 ? 1 : std::abs(ratio));
  // Inertias count by their squares.
  constexpr double farthest = 1e30;
  for (std::size_t n = 0; n < net.nodes.size(); ++n) {
    const double ratio = m.scale_ratio[n];
    if (ratio <= farthest && ratio >= 1 / farthest) continue;
    const std::string& component = net.nodes[n].component;
    c.refuse(component,
             fmt::format("\"{}\" turns {:.3g} times as fast as \"{}\"; must be within {:g} … {:g}; check the "
                         "ratios between them",
                         component, ratio, net.nodes[at(m.reduction_node)].component, 1 / farthest, farthest));
    c.messages.throw_if_any();
  }
}

}  // namespace kurbel
