// forced_vibration.cpp — torques at equal times of a period, and their orders.
#include "tests/agreement/forced_vibration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/index.h"
#include "engine/run/run.h"

namespace kurbel::agreement {
namespace {

constexpr int looks = 4096;  // a period

class Torques final : public Observer {
 public:
  Torques(double from, double step) : from_(from), step_(step) {}
  void step(StepView& view) override {
    const Model& m = view.equations().model();
    if (of_.empty()) of_.resize(m.elastic.size());
    while (of_.empty() || static_cast<int>(of_.front().size()) < looks) {
      if (of_.empty()) return;
      const double t = from_ + step_ * static_cast<double>(of_.front().size());
      if (t > view.t()) break;
      const Snapshot& s = view.snapshot(t);
      for (std::size_t j = 0; j < of_.size(); ++j) of_[j].push_back(s.joint_torque[at(m.elastic[j].joint)]);
      for (const TorqueJoint& joint : m.torque_joints)
        if (joint.elastic >= 0) of_[at(joint.elastic)].back() = joint.torque(s.joint_torque);
    }
  }
  const std::vector<std::vector<double>>& of() const { return of_; }

 private:
  double from_, step_;
  std::vector<std::vector<double>> of_;  // per joint
};

std::vector<std::vector<double>> torques_of(const SettledRun& run, double tolerance) {
  Equations equations(run.model, false);
  Torques torques(run.at.state.t, run.period / looks);
  RunOptions options{.tolerance = tolerance,
                     .method = "auto",
                     .until = run.at.state.t + run.period,
                     .budget = 20,
                     .interrupted = nullptr,
                     .progress = {}};
  options.to_go_on = true;
  options.checkpoint = &run.at;
  const RunOutcome outcome = integrate(equations, options, {&torques});
  if (!outcome.complete) throw std::runtime_error(outcome.diagnosis);
  return torques.of();
}

std::complex<double> harmonic(const std::vector<double>& values, std::size_t h) {
  std::complex<double> sum = 0;
  const std::size_t n = values.size();
  for (std::size_t k = 0; k < n; ++k)
    sum +=
        values[k] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>((h * k) % n) / static_cast<double>(n));
  return (h == 0 ? 1.0 : 2.0) / static_cast<double>(n) * sum;
}

}  // namespace

std::vector<JointVibration> joint_vibrations_of(const SettledRun& run, std::size_t harmonics) {
  std::vector<JointVibration> list;
  if (run.kind != Motion::repeats || run.model->elastic.empty()) return list;
  const std::vector<std::vector<double>> close = torques_of(run, 1e-10), loose = torques_of(run, 1e-8);
  for (std::size_t j = 0; j < close.size(); ++j) {
    const std::vector<double>& values = close[j];
    JointVibration vibration;
    vibration.component = run.model->network.joints[at(run.model->elastic[j].joint)].component;
    vibration.elastic = j;
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    vibration.least = *least, vibration.greatest = *greatest;
    vibration.scale = std::max(std::abs(*least), std::abs(*greatest));
    for (std::size_t h = 0; h <= std::min<std::size_t>(harmonics, looks / 8); ++h)
      vibration.harmonic.push_back(harmonic(values, h));
    vibration.mean = vibration.harmonic.front().real();
    for (std::size_t k = 0; k < std::min(values.size(), loose[j].size()); ++k)
      vibration.error = std::max(vibration.error, std::abs(values[k] - loose[j][k]));
    // Between looks an extreme may lie higher, at an edge by half of the second difference.
    double between = 0;
    for (std::size_t k = 2; k < values.size(); ++k)
      between = std::max(between, std::abs(values[k] - 2 * values[k - 1] + values[k - 2]));
    vibration.extremes_error = vibration.error + 0.5 * between;
    list.push_back(std::move(vibration));
  }
  return list;
}

}  // namespace kurbel::agreement
