// modes_conclusion.cpp — the first modes, and what swings at the operating speed, in a sentence.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "studies/modes/drive_limits.h"
#include "studies/modes/modes_plots.h"

namespace kurbel::modes {
namespace {

// With its damping; and what springs and inertias alone would say, where states of elements make much of the frequency.
std::string first_mode(const Mode& mode) {
  constexpr double much = 0.005;
  std::string text = fmt::format("First mode at {:.6g} Hz", hertz(mode.natural()));
  if (!(mode.lambda.imag() > 0)) return text + " undamped (it does not swing: ζ ≥ 1)";
  text += fmt::format(" (ζ = {:.3g}", mode.ratio);
  if (std::abs(mode.natural() - mode.omega) > much * mode.omega)
    text += fmt::format("; springs and inertias alone: {:.4g} Hz", hertz(mode.omega));
  return text + ")";
}

// The joint that bears most of its limits; the one that swings most where none has any.
std::size_t joint_to_tell(const ModesStudy& m, const SpeedResponse& said) {
  std::size_t joint = joint_with_largest_swing(said);
  double most = 0;
  for (std::size_t j = 0; j < said.joints.size() && j < m.limited.size(); ++j) {
    if (!m.limited[j].limits.any()) continue;
    const double use = share_of_bearable(m.limited[j], load_of(said.joints[j]), std::abs(m.drive.at.speed), 1);
    if (use > most * (1 + 1e-9)) most = use, joint = j;
  }
  return joint;
}

// "at 1500 rpm "coupling" swings by 9.893 N·m about 153.9 N·m"
std::string swing_at_that_speed(const ModesStudy& m) {
  const SpeedResponse& said = m.cycle ? *m.cycle : m.here;
  const std::size_t j = joint_to_tell(m, said);
  const JointResponse& joint = said.joints[j];
  std::string text = fmt::format("at {} \"{}\" swings by {}", m.speed_unit.text(std::abs(m.drive.at.speed), 5),
                                 m.joint_names[j], torque_text(joint.peak));
  if (std::abs(joint.mean) > 1e-6 * joint.peak) text += " about " + torque_text(joint.mean);
  const double linear = m.here.joints[j].peak;
  if (m.cycle && std::abs(linear - joint.peak) > 0.1 * joint.peak)
    text += fmt::format(" (the linear drive says {}: {:+.0f} %)", torque_text(linear), 100 * (linear / joint.peak - 1));
  return text;
}

}  // namespace

bool is_forced(const ModesStudy& m) {
  return !m.joint_names.empty() && (!m.excitations.by_order.empty() || !m.excitations.by_frequency.empty());
}

std::string conclusion_of(const ModesStudy& m) {
  std::string text;
  const std::string rest =
      m.rests_at ? fmt::format("about its rest at {:.4g}° of {}", *m.rests_at * 180 / std::numbers::pi, m.link) : "";
  if (m.modes.empty()) {
    text = m.rests_at ? "The machine does not swing " + rest : "The drive has no mode with twist";
  } else {
    text = first_mode(m.modes.front());
    if (m.rests_at) text += ", " + rest;
    if (m.modes.size() > 1) text += fmt::format(", second at {:.6g} Hz", hertz(m.modes[1].natural()));
  }
  if (is_forced(m)) text += "; " + swing_at_that_speed(m);
  return text;
}

}  // namespace kurbel::modes
