// motor_currents.cpp — Gauss's rule within every step, on its dense output.
#include "studies/duty/motor_currents.h"

#include <algorithm>

#include "engine/base/gauss.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

double half_square(std::span<const double> y, std::size_t own, const std::vector<std::size_t>& parts) {
  double sum = 0;
  for (const std::size_t k : parts) sum += y[own + k] * y[own + k];
  return 0.5 * sum;
}

}  // namespace

MotorCurrents::MotorCurrents(const Model& m) : internal_begin_(m.state_count() - m.internal_states.size()) {
  for (const MotorTorque& motor : m.motors) {
    Motor found;
    found.component = motor.component;
    for (std::size_t k = 0; k < m.internal_states.size(); ++k) {
      const InternalState& state = m.internal_states[k].state;
      if (m.internal_states[k].component != motor.component) continue;
      if (state.name.starts_with("stator_current")) found.stator.push_back(k), found.usual = state.scale;
      if (state.name.starts_with("rotor_current")) found.rotor.push_back(k);
    }
    if (!found.stator.empty()) motors_.push_back(std::move(found));
  }
}

void MotorCurrents::begin(double t, std::span<const double> /*y*/, Equations& /*equations*/) {
  if (!time_.empty()) return;
  time_.push_back(t);
  for (Motor& motor : motors_) motor.on_stator.push_back(0), motor.on_rotor.push_back(0);
}

void MotorCurrents::step(StepView& view) {
  time_.push_back(view.t());
  for (Motor& motor : motors_)
    motor.on_stator.push_back(motor.on_stator.back()), motor.on_rotor.push_back(motor.on_rotor.back());
  gauss<4>.over(view.t_previous(), view.t() - view.t_previous(), [&](double t, double weight) {
    const std::span<const double> y = view.at(t);
    for (Motor& motor : motors_) {
      motor.on_stator.back() += weight * half_square(y, internal_begin_, motor.stator);
      motor.on_rotor.back() += weight * half_square(y, internal_begin_, motor.rotor);
    }
  });
}

double MotorCurrents::stator_square(const Motor& motor, double begin, double end) const {
  const auto up_to = [&](double t) {
    const auto after = static_cast<std::size_t>(std::upper_bound(time_.begin(), time_.end(), t) - time_.begin());
    if (after == 0) return motor.on_stator.front();
    if (after == time_.size()) return motor.on_stator.back();
    const double part = (t - time_[after - 1]) / (time_[after] - time_[after - 1]);
    return motor.on_stator[after - 1] + part * (motor.on_stator[after] - motor.on_stator[after - 1]);
  };
  return up_to(end) - up_to(begin);
}

}  // namespace kurbel
