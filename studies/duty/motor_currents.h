// motor_currents.h — currents of induction motors that are states (two-axis model), squared and integrated over the run.
//
//     effective current of a line:  i² = ½ |i_s|²,  of the rotor, referred to the stator: ½ |i_r|²
#pragma once

#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

class MotorCurrents final : public Observer {
 public:
  struct Motor {
    std::string component;
    std::vector<std::size_t> stator, rotor;   // internal states: components of the space vectors
    double usual = 1;                         // order of magnitude [A]
    std::vector<double> on_stator, on_rotor;  // ∫ i² dt up to the end of each step [A²·s]
    void remember(Tape& tape) { tape(on_stator, on_rotor); }
    double stator_square() const { return on_stator.empty() ? 0 : on_stator.back(); }
    double rotor_square() const { return on_rotor.empty() ? 0 : on_rotor.back(); }
  };
  explicit MotorCurrents(const Model& model);
  bool empty() const { return motors_.empty(); }
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(time_, motors_); }

  const std::vector<Motor>& motors() const { return motors_; }
  // ∫ i² dt of a line between two times, interpolated linearly within steps.
  double stator_square(const Motor& motor, double begin, double end) const;

 private:
  std::size_t internal_begin_ = 0;
  std::vector<double> time_;
  std::vector<Motor> motors_;
};

}  // namespace kurbel
