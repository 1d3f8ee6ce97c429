// operating_sequence.h — execution of the operating sequence: steps wait for a time, an angle or a speed, and set the
// commands of motors, clutches and brakes. Its progress is stored in Modes.
//
//   armed ──time, angle or speed reached──▶ take: commands jump or begin a ramp ──▶ the next step is armed
#pragma once

#include <span>

#include "engine/equations/state.h"
#include "engine/events/event.h"
#include "engine/model/model.h"

namespace kurbel {

class OperatingSequence {
 public:
  explicit OperatingSequence(const Model& model) : model_(&model) {}
  bool any() const { return !model_->scene.sequence.steps.empty(); }

  // Arms the first step; no commands are given. True: it is due at once.
  bool begin(Modes& modes, double t, std::span<const double> y) const;
  // Executes the step that is due, and the steps that follow it at once.
  void take(Modes& modes, double t, std::span<const double> y, EventLog* log) const;
  // Positive until the armed step's angle or speed is reached; of order one. `speed` per shaft [rad/s].
  double guard(const Modes& modes, std::span<const double> y, const double* speed) const;

  // Time of the next end of a ramp or the next step [s].
  double next_edge(const Modes& modes) const;
  void end_ramps(Modes& modes, double t) const;

 private:
  void arm(Modes& modes, double t, std::span<const double> y) const;
  void begin_cycle(Modes& modes, double t, EventLog* log) const;

  const Model* model_;
};

}  // namespace kurbel
