// holders.cpp — what stands at the end, and opposes motion.
#include "studies/answers/holders.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "engine/model/model.h"
#include "engine/numerics/index.h"

namespace kurbel {

std::vector<char> shafts_joined_to(const Model& m, std::size_t shaft, const std::function<bool(std::size_t)>& joins) {
  std::vector<char> joined(m.shafts.size());
  joined[shaft] = 1;
  bool more = true;
  const auto join = [&](int a, int b) {
    if (joined[at(a)] == joined[at(b)] || std::max(at(a), at(b)) >= m.free_shafts) return;
    joined[at(a)] = joined[at(b)] = 1, more = true;
  };
  while (std::exchange(more, false)) {
    for (const ShaftRelation& relation : m.relations)
      for (const ShaftGain& part : relation.motion) join(relation.motion.front().shaft, part.shaft);
    for (std::size_t j = 0; j < m.elastic.size(); ++j)
      if (joins(j)) join(m.elastic[j].shaft_a, m.elastic[j].shaft_b);
  }
  return joined;
}

double driving_torque(const Equations& equations, const Snapshot& now, std::size_t shaft) {
  const Model& m = equations.model();
  const auto slips = [&](std::size_t j) { return m.elastic[j].slips && equations.modes().slip[j] != 0; };
  const auto drives_any = [&](const std::vector<char>& far, const std::vector<char>& near) {
    return std::any_of(m.network.elements.begin(), m.network.elements.end(), [&](const Network::ShaftElement& e) {
      const std::size_t s = at(m.shaft_of_node[at(e.node)]);
      return e.element->account == Account::driving && far[s] != 0 && near[s] == 0;
    });
  };
  const std::vector<char> near = shafts_joined_to(m, shaft, [&](std::size_t j) { return !slips(j); });
  double torque = 0;
  for (std::size_t e = 0; e < m.network.elements.size(); ++e) {
    const Network::ShaftElement& element = m.network.elements[e];
    if (element.element->account == Account::driving && near[at(m.shaft_of_node[at(element.node)])] != 0)
      torque += now.sums.element_torque[e] * m.node_ratio[at(element.node)];
  }
  for (std::size_t j = 0; j < m.elastic.size(); ++j) {
    const ElasticJoint& joint = m.elastic[j];
    const auto [a, b] = std::pair(at(joint.shaft_a), at(joint.shaft_b));
    if (!slips(j) || near[a] == near[b]) continue;
    const bool on_b = near[b] != 0;
    const std::size_t here = on_b ? b : a, there = on_b ? a : b;
    if (!drives_any(shafts_joined_to(m, there, [&](std::size_t other) { return other != j; }), near)) continue;
    const std::size_t reference = at(m.shafts[here].reference);
    const double ratio = m.node_ratio[reference] / m.gain_of_node[reference];  // ω of the shaft / ω of the link
    torque += now.joint_torque[joint.joint] * (on_b ? joint.gain_b : -joint.gain_a) * ratio;
  }
  return torque;
}

Holders::Holders(const Equations& equations, double t, std::size_t shaft)
    : equations_(equations), m_(equations.model()), end_(t), joined_(shafts_joined_to(m_, shaft, [&](std::size_t j) {
        const ElasticJoint& joint = m_.elastic[j];
        return !joint.springless && !(joint.slips && equations_.modes().slip[j] != 0);
      })) {
  for (std::size_t c = 0; c < equations.ties().contacts().size(); ++c) torque_.push_back(equations.ties().torque(c));
}

bool Holders::stands(int node) const {
  const std::size_t shaft = at(m_.shaft_of_node[at(node)]);
  return joined_[shaft] != 0 && equations_.at_standstill(shaft);
}

double Holders::command_of(const std::string& component) const {
  const int c = m_.command_of(component);
  return c < 0 ? 1 : equations_.modes().command[at(c)].at(end_, m_.scene.sequence);
}

std::vector<const Network::ShaftElement*> Holders::brakes_on() const {
  std::vector<const Network::ShaftElement*> list;
  for (std::size_t e = 0; e < m_.network.elements.size(); ++e) {
    const Network::ShaftElement& element = m_.network.elements[e];
    if (m_.network.kind_of(element.component) == "brake" && equations_.modes().active[e] != 0 &&
        joined_[at(m_.shaft_of_node[at(element.node)])] != 0 && command_of(element.component) > 0)
      list.push_back(&element);
  }
  return list;
}

const std::string* Holders::brake(bool put_on) const {
  for (const Network::ShaftElement* element : brakes_on())
    if (stands(element->node) && (!put_on || element->window.first_on() > 0)) return &element->component;
  return nullptr;
}

const std::string* Holders::slipping_brake() const {
  for (const Network::ShaftElement* element : brakes_on())
    if (!stands(element->node)) return &element->component;
  return nullptr;
}

std::vector<std::size_t> Holders::gears() const {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < m_.relations.size(); ++k)
    if (m_.relations[k].loss_account >= 0 && equations_.modes().loss_direction[k] == 0) list.push_back(k);
  return list;
}

std::string Holders::components() const {
  std::set<std::string> names;
  for (const Network::ShaftElement* element : brakes_on())
    if (stands(element->node)) names.insert(element->component);
  if (names.empty()) {
    for (const Network::ShaftElement& e : m_.network.elements)
      if (e.element->is.directional && stands(e.node)) names.insert(e.component);
    for (const std::size_t gear : gears())
      names.insert(m_.network.relations[at(m_.relations[gear].relation)].component);
  }
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return text;
}

std::string Holders::beside(const char* load) const {
  const bool any_load = std::any_of(m_.network.elements.begin(), m_.network.elements.end(), [&](const auto& e) {
    return (e.element->account == Account::useful || e.element->cycle > 0) && stands(e.node);
  });
  const std::string names = any_load ? std::string() : components();
  return names.empty() ? load : names;
}

double Holders::torque() const {
  std::set<std::size_t> braked;  // shafts
  for (const Network::ShaftElement* element : brakes_on())
    if (stands(element->node)) braked.insert(at(m_.shaft_of_node[at(element->node)]));
  double sum = 0;
  for (std::size_t c = 0; c < torque_.size(); ++c) {
    const Contact& contact = equations_.ties().contacts()[c];
    if (contact.kind == Contact::Kind::connection || sense_of(contact, equations_.modes()) != 0) continue;
    if (!braked.empty() && (contact.kind != Contact::Kind::frame || !braked.contains(at(contact.index)))) continue;
    double motion = 0;  // of the contact, by that of the link
    for (const ShaftGain& part : contact.motion)
      if (const std::size_t reference = at(m_.shafts[at(part.shaft)].reference); joined_[at(part.shaft)] != 0)
        motion += part.gain * m_.node_ratio[reference] / m_.gain_of_node[reference];
    sum += torque_[c] * motion;
  }
  return sum;
}

bool Holders::any() const {
  for (std::size_t k = 0; k < m_.free_shafts; ++k)
    if (joined_[k] != 0 && equations_.at_standstill(k)) return true;
  return false;
}

}  // namespace kurbel
