// operating_sequence.h — the operating sequence at work: steps that wait for a time, an angle or a speed, and set what
// motors, clutches and brakes are told. Where it has got to stands in Modes; here is only what it does.
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

  // The first step is armed, and no command given. True: it is due at once.
  bool begin(Modes& modes, double t, std::span<const double> y) const;
  // The step that is due, and those that follow it at once.
  void take(Modes& modes, double t, std::span<const double> y, EventLog* log) const;
  // Positive until the armed step's angle or speed is reached; of order one. `speed` per shaft [rad/s].
  double guard(const Modes& modes, std::span<const double> y, const double* speed) const;

  // When next a ramp ends, or a step is due [s].
  double next_edge(const Modes& modes) const;
  void end_ramps(Modes& modes, double t) const;

 private:
  void arm(Modes& modes, double t, std::span<const double> y) const;
  void begin_round(Modes& modes, double t, EventLog* log) const;

  const Model* model_;
};

}  // namespace kurbel
