// static_curve.cpp — the fastest oscillations of a motor's speed, and the response of its static curve.
#include "studies/validity/static_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivetrain/induction/induction_law.h"
#include "engine/orbit/follow_period.h"
#include "engine/run/run.h"
#include "studies/findings/trace.h"

namespace kurbel {
namespace {

// The motor has neither the flux lag nor its circuit in the model.
bool follows_at_once(const Model& model, const std::string& motor) {
  return std::none_of(model.internal_states.begin(), model.internal_states.end(),
                      [&](const PlacedInternalState& own) { return own.component == motor; });
}

// Motors with static curves directly at the mains, excluding those on a frequency converter.
std::vector<std::pair<std::string, InductionData>> static_motors(const Model& model) {
  std::vector<std::pair<std::string, InductionData>> list;
  for (const auto& [component, motor] : model.network.data.all<InductionData>())
    if (!motor.by_converter && follows_at_once(model, component)) list.emplace_back(component, motor);
  return list;
}

// An oscillation between two extremes of the speed and back.
struct TorqueOscillation {
  double frequency = 0, torque = 0, at = 0;  // [Hz], from least to largest [N·m], [s]
  double followed = 1;                       // part of a torque's oscillation that the fluxes let through
  double missed() const { return torque * (1 - followed); }
};

double part_followed(double oscillation, const InductionData& motor) {
  return 1 / std::hypot(1, oscillation / (motor.breakdown_slip * motor.mains));
}

// The oscillation with the largest excess of the curve's torque over a real motor's, above least_share of the frequency.
TorqueOscillation worst_oscillation(const MotorMotion& m, const InductionData& motor, double least_share) {
  TorqueOscillation worst;
  const auto change = [&](std::size_t k) { return m.speed[k + 1] - m.speed[k]; };
  std::vector<std::size_t> turns;
  for (std::size_t k = 1; k + 1 < m.time.size(); ++k) {
    if (!(change(k - 1) * change(k) < 0)) continue;
    turns.push_back(k);
    if (turns.size() < 3) continue;
    const std::size_t begin = turns[turns.size() - 3];
    TorqueOscillation oscillation{.frequency = 1 / (m.time[k] - m.time[begin]), .at = m.time[begin]};
    const auto [least, most] = std::minmax_element(m.torque.begin() + static_cast<std::ptrdiff_t>(begin),
                                                   m.torque.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    oscillation.torque = *most - *least;
    oscillation.followed = part_followed(oscillation.frequency, motor);
    if (oscillation.frequency >= least_share * motor.mains && oscillation.missed() > worst.missed())
      worst = oscillation;
  }
  return worst;
}

}  // namespace

std::vector<std::string> static_curve_notes(const Model& model,
                                            const std::function<MotorMotion(const std::string&)>& motion_of) {
  constexpr double least_share = 0.03, least_torque = 0.05;  // of the mains' frequency, of the rated torque
  std::vector<std::string> notes;
  for (const auto& [name, motor] : static_motors(model)) {
    const TorqueOscillation oscillation = worst_oscillation(motion_of(name), motor, least_share);
    if (!(oscillation.missed() > least_torque * motor.rated_torque)) continue;
    notes.push_back(fmt::format(
        "the drive \"{}\" oscillates at about {:.2g} Hz, {:.2g} % of the mains' {:g} Hz, from {:.3g} s on, and its "
        "static torque-speed curve makes its torque oscillate by {:.3g} N·m: too fast for the curve, which assumes "
        "that the fluxes follow without delay. Estimated by its breakdown slip {:.2g}, a real motor's torque follows "
        "such an oscillation by {:.0f} %; {}{}",
        name, oscillation.frequency, 100 * oscillation.frequency / motor.mains, motor.mains, oscillation.at,
        oscillation.torque, motor.breakdown_slip, 100 * oscillation.followed,
        model.effects.torque_lag ? "" : "the effect torque_lag reckons with that; ",
        motor.has_circuit ? "the scene has the data of the two-axis model, which computes it: --effects with transients"
                          : fmt::format("the two-axis model computes it: keys frequency = \"{:g} Hz\" and "
                                        "resistance_ratio > 0 (cage motors: about 1) instead of starting_ratio or a "
                                        "starter, and the effect transients",
                                        motor.mains)));
  }
  return notes;
}

std::vector<std::string> static_curve_notes(const Model& model, const TrajectoryRecorder& trajectory) {
  return static_curve_notes(model, [&](const std::string& motor) {
    const auto column = [&](const std::string& name) {
      const auto& channels = trajectory.channels();
      return static_cast<std::size_t>(
          std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name.text == name; }) -
          channels.begin());
    };
    const std::size_t speed = column("speed." + motor), torque = column("torque." + motor);
    MotorMotion motion;
    if (std::max(speed, torque) >= trajectory.channels().size()) return motion;
    motion.time = trajectory.time();
    for (std::size_t row = 0; row < motion.time.size(); ++row) {
      motion.speed.push_back(trajectory.value(row, speed));
      motion.torque.push_back(trajectory.value(row, torque));
    }
    return motion;
  });
}

std::vector<std::string> static_curve_notes(const ReturnMap& map, const SteadyPoint& point) {
  if (static_motors(map.model()).empty()) return {};
  constexpr double periods = 2.05;  // an oscillation of one period reverses three times within them
  Equations equations(map.shared_model(), true);
  TraceRecorder recorder(map.model());
  follow_period(map, point, equations, {.tolerance = 1e-9, .periods = periods}, {&recorder});
  const auto traces = recorder.traces();
  return static_curve_notes(map.model(), [&](const std::string& motor) {
    const Trace *speed = traces->find("speed." + motor), *torque = traces->find("torque." + motor);
    if (!speed || !torque || speed->y.size() != torque->y.size()) return MotorMotion{};
    return MotorMotion{speed->x, speed->y, torque->y};
  });
}

}  // namespace kurbel
