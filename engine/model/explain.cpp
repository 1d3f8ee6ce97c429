// explain.cpp — description of a model: merged joints with reasons, coordinates, their inertias.
#include <fmt/format.h>

#include <map>

#include <algorithm>

#include "engine/model/model.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

constexpr std::size_t shown = 40;  // shafts and connections listed one by one

std::string shaft_line(const Model& m, std::size_t s) {
  const Shaft& shaft = m.shafts[s];
  std::string names;
  for (std::size_t i = 0; i < shaft.nodes.size() && i < 24; ++i) {
    const double gain = m.gain_of_node[static_cast<std::size_t>(shaft.nodes[i])];
    names += (i ? ", " : "") + m.node_label(shaft.nodes[i]) + (gain == 1 ? "" : fmt::format(" (×{:.6g})", gain));
  }
  std::string text =
      fmt::format("  shaft {}: {}{}; on {}: {}\n", s + 1, with_unit(shaft.mean_inertia, "kg*m2"),
                  shaft.variable ? " (mean; varies with the crank angle)" : "", m.node_label(shaft.reference), names);
  if (shaft.prescribed >= 0) text += "    its speed is prescribed\n";
  return text;
}

std::string connection_line(const Model& m, const ElasticJoint& e) {
  const Network::Joint& joint = m.network.joints[static_cast<std::size_t>(e.joint)];
  std::string text;
  if (e.slips) {
    text = fmt::format("  slip of {}: carries {} before it slips\n", joint.component,
                       with_unit(joint.element->capacity, "N*m"));
  } else if (e.springless) {
    text = fmt::format("  slip of {}\n", joint.component);
  } else {
    text = fmt::format("  twist of {}: k = {}, c = {}\n", joint.component,
                       with_unit(joint.element->stiffness, "N*m/rad"), with_unit(joint.element->damping, "N*m*s/rad"));
  }
  if (const std::string words = joint.element->describe(); !words.empty()) text += "    " + words + "\n";
  return text;
}

std::string merged_lines(const Model& m) {
  std::string text;
  for (const std::string& line : m.merged) text += "  merged: " + line + "\n";
  std::map<std::string, std::pair<int, int>> stages;  // of each component: in all, and named so far
  const auto is_gear = [](const Network::Joint& joint) { return !joint.element && joint.ratio != 1; };
  for (const Network::Joint& joint : m.network.joints)
    if (is_gear(joint)) ++stages[joint.component].first;
  for (const Network::Joint& joint : m.network.joints) {
    if (!is_gear(joint)) continue;
    auto& [all, named] = stages[joint.component];
    text += fmt::format("  merged: {} of \"{}\", ratio {:.6g}; inertias behind it count by the square of the ratio\n",
                        all > 1 ? fmt::format("stage {}", ++named) : "gear", joint.component, joint.ratio);
  }
  return text;
}

}  // namespace

bool Model::has_continuous_shafts() const {
  return std::any_of(elastic.begin(), elastic.end(), [this](const ElasticJoint& e) {
    const int chain = network.joints[static_cast<std::size_t>(e.joint)].chain;
    return chain >= 0 && network.chains[static_cast<std::size_t>(chain)].degree > 0;
  });
}

std::vector<std::string> Model::joint_names() const {
  std::map<std::string, int> total, seen;
  const auto joint_of = [this](const ElasticJoint& e) -> const Network::Joint& {
    return network.joints[static_cast<std::size_t>(e.joint)];
  };
  for (const ElasticJoint& e : elastic) ++total[joint_of(e).component];
  std::vector<std::string> names;
  for (const ElasticJoint& e : elastic) {
    const std::string& component = joint_of(e).component;
    const int parts = total[component], part = ++seen[component];
    const bool middle = joint_of(e).element->row && 2 * part == parts + 1;
    names.push_back(parts == 1 || middle ? component : fmt::format("{}.{}", component, part));
  }
  return names;
}

std::string Model::node_label(int node) const {
  const Network::Node& n = network.nodes[static_cast<std::size_t>(node)];
  return n.label.empty() ? n.component : n.component + "." + n.label;
}

bool Model::has_contacts() const {
  return !relations.empty() ||
         std::any_of(elastic.begin(), elastic.end(), [](const ElasticJoint& e) { return e.slips; });
}

bool Model::has_memory() const {
  return std::any_of(internal_states.begin(), internal_states.end(),
                     [](const PlacedInternalState& own) { return !own.state.lags; });
}

std::string Model::explain() const {
  const std::size_t twists = elastic.size();
  const bool lags = std::any_of(internal_states.begin(), internal_states.end(),
                                [](const PlacedInternalState& own) { return own.state.lags; });
  // An elastic machine has it without mention.
  const bool mentioned = effects.torque_lag && effects.lags_rigid;
  std::string text =
      fmt::format("effects on: {}{}\n", effects.describe(), lags && !mentioned ? ", with torque lag" : "");
  text += fmt::format("coordinates: {} = {} shaft speed{}{}; angles kept: {} (turns apart from the remainder)\n",
                      free_shafts + twists, free_shafts, free_shafts == 1 ? "" : "s",
                      twists ? fmt::format(" + {} twist{}", twists, twists == 1 ? "" : "s") : "", angles.size());
  text += fmt::format("reduction link: {}\n", node_label(reduction_node));
  for (std::size_t s = 0; s < shafts.size() && s < shown; ++s) text += shaft_line(*this, s);
  if (shafts.size() > shown) text += fmt::format("  … and {} more shafts\n", shafts.size() - shown);
  for (std::size_t i = 0; i < elastic.size() && i < shown; ++i) text += connection_line(*this, elastic[i]);
  for (const Network::Relation& relation : network.relations) {
    text += fmt::format("  \"{}\" ties {} speeds at run time{}\n", relation.component, relation.members(),
                        relation.lossy ? ", with losses" : "");
    if (relation.lossy && !relation.words.empty()) text += "    " + relation.words + "\n";
  }
  for (const PlacedInternalState& own : internal_states)
    text += fmt::format("  internal state: {} of {}\n", own.state.name, own.component);
  for (const Network::ShaftElement& e : network.elements)
    if (const std::string words = e.element->describe(); !words.empty()) text += "  " + words + "\n";
  return text + merged_lines(*this);
}

}  // namespace kurbel
