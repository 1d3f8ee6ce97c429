// contact.h — two sides that stick together or slip: a shaft against the frame with all that brakes it, the sides of a
// clutch, a gear against its own losses.
#pragma once

#include <string>
#include <vector>

#include "engine/equations/state.h"
#include "engine/model/model.h"

namespace kurbel {

struct Contact {
  enum class Kind { frame, connection, loss };
  Kind kind = Kind::frame;
  int index = 0;                  // shaft, elastic joint, relation
  std::vector<ShaftGain> motion;  // speed of slip v = Σ gain ω
  std::vector<ShaftGain> torque;  // what one unit of its torque λ, which opposes v > 0, does to the shafts
  double speed_scale = 1, torque_scale = 1;
  std::string name;
};

// All that a model has: shafts against the frame first, then clutches, then gears with losses.
std::vector<Contact> contacts_of(const Model& model);

// Modes as many as a model needs, before a start has found them: everything goes forwards and is on.
Modes unset_modes(const Model& model, std::size_t contacts);

// Sense of slip in these modes; 0: stuck.
template <class SomeModes>
auto& sense_of(const Contact& contact, SomeModes& modes) {
  const auto index = static_cast<std::size_t>(contact.index);
  if (contact.kind == Contact::Kind::frame) return modes.direction[index];
  return contact.kind == Contact::Kind::connection ? modes.slip[index] : modes.loss_direction[index];
}

// Its motion is given on every side: it sticks or slips as it is told.
bool is_prescribed(const Contact& contact, const Model& model);

// Σ gain · value over the shafts of a row.
double sum_over(const std::vector<ShaftGain>& row, const double* per_shaft);
// What a torque on the row does to the shafts.
void add_over(const std::vector<ShaftGain>& row, double torque, double* per_shaft);
std::vector<ShaftGain> minus(std::vector<ShaftGain> row);

// Speed and acceleration of a shaft whose motion is given over time.
inline double prescribed_speed(const Model& model, const Modes& modes, std::size_t shaft, double t) {
  const auto p = static_cast<std::size_t>(model.shafts[shaft].prescribed);
  const PrescribedSpeed& given = model.network.prescribed[p];
  if (given.command >= 0) return modes.command[static_cast<std::size_t>(given.command)].at(t, model.scene.sequence);
  return given.value(t, modes.prescribed_piece[p]);
}
inline double prescribed_acceleration(const Model& model, const Modes& modes, std::size_t shaft, double t) {
  const auto p = static_cast<std::size_t>(model.shafts[shaft].prescribed);
  const PrescribedSpeed& given = model.network.prescribed[p];
  if (given.command >= 0) return modes.command[static_cast<std::size_t>(given.command)].rate;
  return given.slope(t, modes.prescribed_piece[p]);
}

}  // namespace kurbel
