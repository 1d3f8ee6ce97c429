// contact.h — contacts that stick or slip: a shaft against the frame with all its brakes, the sides of a clutch, a gear
// against its own losses.
#pragma once

#include <string>
#include <vector>

#include "engine/equations/state.h"
#include "engine/model/model.h"

namespace kurbel {

struct Contact {
  enum class Kind { frame, connection, loss };
  Kind kind = Kind::frame;
  int index = 0;                  // of the shaft, elastic joint or relation
  std::vector<ShaftGain> motion;  // speed of slip v = Σ gain ω
  std::vector<ShaftGain> torque;  // torques on the shafts by a unit of its torque λ, which opposes v > 0
  double speed_scale = 1, torque_scale = 1;
  std::string name;
};

// All contacts of a model: shafts against the frame first, then clutches, then gears with losses.
std::vector<Contact> contacts_of(const Model& model);

// Modes of a model before the start has found them: everything moves forwards and is on.
Modes unset_modes(const Model& model, std::size_t contacts);

// Direction of slip in these modes; 0: stuck.
template <class SomeModes>
auto& sense_of(const Contact& contact, SomeModes& modes) {
  const auto index = static_cast<std::size_t>(contact.index);
  if (contact.kind == Contact::Kind::frame) return modes.direction[index];
  return contact.kind == Contact::Kind::connection ? modes.slip[index] : modes.loss_direction[index];
}

// Its motion is prescribed on all sides, so that it sticks or slips as prescribed.
bool is_prescribed(const Contact& contact, const Model& model);

// Σ gain · value over the shafts of a row.
double sum_over(const std::vector<ShaftGain>& row, const double* per_shaft);
// Adds the torques on the shafts by a torque on the row.
void add_over(const std::vector<ShaftGain>& row, double torque, double* per_shaft);
std::vector<ShaftGain> minus(std::vector<ShaftGain> row);

// Speed and acceleration of a shaft with prescribed motion.
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
