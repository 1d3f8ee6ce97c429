// duty_recorder.h — an observer of motors: the square of their torque over time.
#pragma once

#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// ∫ M² dt by three Gauss points a step, of the continuous solution. Of named components only.
class DutyRecorder final : public Observer {
 public:
  struct Motor {
    std::string component;
    double rated_torque = 0;                 // M_N [N·m]
    std::vector<std::size_t> elements = {};  // that make its torque
    double square = 0;                       // ∫ M² dt [(N·m)²·s]
    void remember(Tape& tape) { tape(square); }
  };
  explicit DutyRecorder(std::vector<Motor> motors) : motors_(std::move(motors)) {}
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(motors_); }
  const std::vector<Motor>& motors() const { return motors_; }

 private:
  std::vector<Motor> motors_;
};

}  // namespace kurbel
