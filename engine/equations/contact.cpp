// contact.cpp — which contacts a model has, and how each of them moves.
#include "engine/equations/contact.h"

#include <algorithm>
#include <cmath>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

Contact against_the_frame(const Model& m, int s) {
  const Shaft& shaft = m.shafts[at(s)];
  return {.kind = Contact::Kind::frame,
          .index = s,
          .motion = {{s, 1}},
          .torque = {{s, -1}},
          .speed_scale = shaft.speed_scale,
          .torque_scale = shaft.torque_scale,
          .name = m.node_label(shaft.reference)};
}

Contact of_clutch(const Model& m, std::size_t elastic) {
  const ElasticJoint& e = m.elastic[elastic];
  const Shaft& a = m.shafts[at(e.shaft_a)];
  const std::vector<ShaftGain> motion = {{e.shaft_a, e.gain_a}, {e.shaft_b, -e.gain_b}};
  return {.kind = Contact::Kind::connection,
          .index = static_cast<int>(elastic),
          .motion = motion,
          .torque = minus(motion),
          .speed_scale = std::abs(e.gain_a) * a.speed_scale,
          .torque_scale = a.torque_scale / std::abs(e.gain_a),
          .name = m.network.joints[at(e.joint)].component};
}

Contact of_losses(const Model& m, std::size_t r) {
  const Network::Relation& relation = m.network.relations[at(m.relations[r].relation)];
  const auto node = at(relation.node[0]);
  const double gain = std::abs(m.gain_of_node[node]);
  const Shaft& shaft = m.shafts[at(m.shaft_of_node[node])];
  return {.kind = Contact::Kind::loss,
          .index = static_cast<int>(r),
          .motion = m.relations[r].sliding,
          .torque = m.relations[r].loss,
          .speed_scale = gain * shaft.speed_scale,
          .torque_scale = shaft.torque_scale / gain,
          .name = relation.component};
}

}  // namespace

std::vector<Contact> contacts_of(const Model& m) {
  std::vector<Contact> contacts;
  for (std::size_t s = 0; s < m.shafts.size(); ++s)
    if (m.shafts[s].directional) contacts.push_back(against_the_frame(m, static_cast<int>(s)));
  for (std::size_t i = 0; i < m.elastic.size(); ++i)
    if (m.elastic[i].slips) contacts.push_back(of_clutch(m, i));
  for (std::size_t r = 0; r < m.relations.size(); ++r)
    if (m.network.relations[at(m.relations[r].relation)].lossy) contacts.push_back(of_losses(m, r));
  return contacts;
}

Modes unset_modes(const Model& m, std::size_t contacts) {
  Modes modes;
  modes.piece.assign(m.mode_slots, 0);
  modes.prescribed_piece.assign(m.network.prescribed.size(), 0);
  modes.active.assign(m.network.elements.size(), 1);
  for (const Network::ShaftElement& e : m.network.elements) modes.on_since.push_back(e.window.first_on());
  modes.direction.assign(m.shafts.size(), 1);
  modes.slip.assign(m.elastic.size(), 1);
  modes.loss_direction.assign(m.relations.size(), 1);
  modes.loss_sign.assign(m.relations.size(), 1);
  modes.regularised.assign(contacts, 0);
  modes.capacity.assign(contacts, 0);
  modes.turns.assign(m.angles.size(), 0);
  modes.command.assign(m.commands.size(), {});
  return modes;
}

bool is_prescribed(const Contact& contact, const Model& model) {
  return std::all_of(contact.motion.begin(), contact.motion.end(),
                     [&](const ShaftGain& g) { return at(g.shaft) >= model.free_shafts; });
}

double sum_over(const std::vector<ShaftGain>& row, const double* per_shaft) {
  double sum = 0;
  for (const ShaftGain& g : row) sum += g.gain * per_shaft[g.shaft];
  return sum;
}

void add_over(const std::vector<ShaftGain>& row, double torque, double* per_shaft) {
  for (const ShaftGain& g : row) per_shaft[g.shaft] += g.gain * torque;
}

std::vector<ShaftGain> minus(std::vector<ShaftGain> row) {
  for (ShaftGain& g : row) g.gain = -g.gain;
  return row;
}

}  // namespace kurbel
