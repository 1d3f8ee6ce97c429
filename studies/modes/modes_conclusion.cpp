// modes_conclusion.cpp — the first modes, vibration at the operating speed, and the energy of modes, in words.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/text.h"
#include "studies/findings/figure_text.h"
#include "studies/modes/drive_limits.h"
#include "studies/modes/modes_plots.h"
#include "studies/shafts/stress_findings.h"

namespace kurbel::modes {
namespace {

constexpr double of_weight = 0.1;  // share of a mode's energy that makes its nature

constexpr double much = 0.005;  // of a frequency

// With its damping; and its damped frequency if damping and internal states change the frequency much.
std::string first_mode(const ModesStudy& m, const Mode& mode) {
  std::string text = fmt::format("First mode at {:.6g} Hz", hertz(mode.omega));
  if (!(mode.lambda.imag() > 0)) return text + " undamped (it does not oscillate: ζ ≥ 1)";
  text += fmt::format(" (ζ = {:.3g}", mode.ratio);
  if (std::abs(mode.lambda.imag() - mode.omega) > much * mode.omega)
    text += fmt::format("; damped {:.4g} Hz{}", hertz(mode.lambda.imag()), why_shifted(m, mode, mode.lambda.imag()));
  return text + ")";
}

// "mechanical and electrical: 0.86 Hz (ζ = 0.78)"
std::string internal_mode(const ModesStudy& m, const Mode& mode) {
  return fmt::format("internal mode ({}) at {:.4g} Hz (ζ = {:.3g})", nature_of(m, mode), hertz(mode.omega), mode.ratio);
}

EnergyStore::Kind kind_of(const InternalState& state) {
  if (state.unit == "A") return EnergyStore::Kind::electrical;
  const bool moves = state.unit == "rad" || state.unit == "m" || state.unit == "rad/s" || state.unit == "m/s";
  return moves ? EnergyStore::Kind::mechanical : EnergyStore::Kind::control;
}

// The joint with the highest utilisation; without limits the one with the largest amplitude.
std::size_t most_loaded_joint(const ModesStudy& m, const SpeedResponse& said) {
  std::size_t joint = joint_with_largest_amplitude(said);
  double most = 0;
  for (std::size_t j = 0; j < said.joints.size() && j < m.limited.size(); ++j) {
    if (!m.limited[j].limits.any()) continue;
    const double use = share_of_bearable(m.limited[j], load_of(said.joints[j]), std::abs(m.drive.at.speed), 1);
    if (use > most * (1 + 1e-9)) most = use, joint = j;
  }
  return joint;
}

// The headline has four digits: of five they would be rounded a second time.
std::string rounded_once(double torque) { return std::isfinite(torque) ? short_text(torque, "N*m") : "unbounded"; }

// "oscillates by ± 9.893 N·m about 153.9 N·m", "varies from 326.8 kN·m to 490.2 kN·m about its mean of 410.5 kN·m"
std::string oscillation(const JointResponse& joint) {
  constexpr double alike = 0.01;
  const bool has_mean = std::abs(joint.mean) > 1e-6 * joint.peak;
  const double above = joint.upper - joint.mean, below = joint.mean - joint.lower;
  if (has_mean && std::isfinite(joint.peak) && std::abs(above - below) > alike * joint.peak)
    return fmt::format("varies from {} to {} about its mean of {}", rounded_once(joint.lower),
                       rounded_once(joint.upper), rounded_once(joint.mean));
  return "oscillates by ± " + rounded_once(joint.peak) + (has_mean ? " about " + rounded_once(joint.mean) : "");
}

// "at 1500 rpm the torque in "coupling" oscillates by ± 9.893 N·m about 153.9 N·m"
std::string amplitude_at_that_speed(const ModesStudy& m) {
  const SpeedResponse& said = m.cycle ? *m.cycle : m.here;
  const std::size_t j = most_loaded_joint(m, said);
  const JointResponse& joint = said.joints[j];
  std::string text = fmt::format("at {} the torque in \"{}\" {}", m.speed_unit.text(m.drive.at.speed, 5),
                                 m.joint_names[j], oscillation(joint));
  const double linear = m.here.joints[j].peak;
  if (m.cycle && std::abs(linear - joint.peak) > 0.1 * joint.peak)
    text += fmt::format(" (linear model: ± {}, {:+.0f} %)", rounded_once(linear), 100 * (linear / joint.peak - 1));
  return text;
}

// The joint without a spring that takes most of what the mode dissipates; empty: none does. Undamped, the drive moves
// without what is behind it.
std::string damper_of(const ModesStudy& m, const Mode& mode) {
  constexpr double most = 0.8;
  const Eigen::VectorXd rate = m.drive.twists * mode.shape;
  const Eigen::VectorXcd torque = m.drive.damper_torques(rate.cast<Complex>());
  const double all = mode.shape.dot(m.drive.damping * mode.shape);
  for (std::size_t j = 0; j < m.joint_names.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    if (m.drive.joints[j].stiffness == 0 && rate[row] * torque[row].real() > most * all) return m.joint_names[j];
  }
  return "";
}

}  // namespace

bool is_forced(const ModesStudy& m) {
  return !m.joint_names.empty() && (!m.excitations.by_order.empty() || !m.excitations.by_frequency.empty());
}

std::vector<EnergyStore> energy_stores(const ModesStudy& m, const Mode& mode) {
  std::vector<EnergyStore> stores;
  const EnergyParts& energy = mode.energy;
  if (energy.springs + energy.inertias + energy.in_internal_states() == 0) return stores;
  stores.push_back(
      {m.drive.at.angle ? "springs and weights" : "springs", EnergyStore::Kind::mechanical, energy.springs});
  stores.push_back({"inertias", EnergyStore::Kind::mechanical, energy.inertias});
  const std::vector<PlacedInternalState>& places = m.drive.model->internal_states;
  for (std::size_t k = 0; k < energy.own.size(); ++k) {
    const std::string& component = places[k].component;
    if (k > 0 && places[k - 1].component == component) {  // its states stand together
      stores.back().name = "states of " + component;
      stores.back().share += energy.own[k];
      continue;
    }
    stores.push_back({places[k].state.name + " of " + component, kind_of(places[k].state), energy.own[k]});
  }
  for (EnergyStore& store : stores) store.name = as_words(store.name);
  const auto in_order = [](double share) {
    return std::round(1e6 * share);
  };  // halves are halves, whatever rounding says
  std::stable_sort(stores.begin(), stores.end(),
                   [&](const EnergyStore& a, const EnergyStore& b) { return in_order(a.share) > in_order(b.share); });
  return stores;
}

std::string energy_text(const ModesStudy& m, const Mode& mode) {
  constexpr double shown = 0.005;
  std::string text;
  for (const EnergyStore& store : energy_stores(m, mode))
    if (store.share >= shown)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", store.name, 100 * store.share);
  return text.empty() ? "—" : text;
}

std::string why_shifted(const ModesStudy& m, const Mode& mode, double f) {
  const double lambda = mode.magnitude(), by_damping = f == mode.lambda.imag() ? f / lambda : 1;
  if (std::abs(lambda - mode.omega) <= much * mode.omega || std::abs(f - mode.omega * by_damping) <= much * mode.omega)
    return "";
  constexpr double nearly_all = 0.9, negligible = 0.001;
  double all = 0;
  const EnergyStore* most = nullptr;
  const std::vector<EnergyStore> stores = energy_stores(m, mode);
  for (const EnergyStore& store : stores) {
    if (store.name.starts_with("springs") || store.name == "inertias") continue;
    all += store.share;
    if (!most || store.share > most->share) most = &store;
  }
  const char* const way = f > mode.omega ? "raised" : "lowered";
  if (!most || most->share < negligible) {
    const std::string damper = damper_of(m, mode);
    return damper.empty() ? "" : fmt::format(", {} by the inertia that \"{}\" couples by damping alone", way, damper);
  }
  return most->share > nearly_all * all ? fmt::format(", {} by the {}", way, most->name) : "";
}

std::string nature_of(const ModesStudy& m, const Mode& mode) {
  double share[3] = {};
  for (const EnergyStore& store : energy_stores(m, mode)) share[static_cast<int>(store.kind)] += store.share;
  std::string text = mode.of_internal_states                     ? ""
                     : m.drive.at.angle && m.drive.at.speed == 0 ? "about the rest"
                                                                 : "torsional";
  static const char* const words[] = {"mechanical", "electrical", "of control"};
  for (int kind = mode.of_internal_states ? 0 : 1; kind < 3; ++kind)
    if (share[kind] >= of_weight) text += fmt::format("{}{}", text.empty() ? "" : " and ", words[kind]);
  return text.empty() ? "of internal states" : text;
}

std::string conclusion_of(const ModesStudy& m) {
  std::string text;
  const std::string rest =
      m.rests_at ? fmt::format("about its rest at {:.4g}° of {}", *m.rests_at * 180 / std::numbers::pi, m.link) : "";
  const std::size_t natural = natural_modes(m);
  if (natural == 0) {
    text = m.rests_at ? "The machine does not oscillate " + rest : "The drive has no mode with twist";
  } else {
    text = first_mode(m, m.modes.front());
    if (m.rests_at) text += ", " + rest;
    if (natural > 1) text += fmt::format(", second at {:.6g} Hz", hertz(m.modes[1].omega));
  }
  if (m.modes.size() > natural) text += "; " + internal_mode(m, m.modes[natural]);
  if (is_forced(m)) text += "; " + amplitude_at_that_speed(m);
  return text;
}

std::optional<Claim> motion_claim(const ModesStudy& m) {
  if (!m.comes_to_rest && !m.runs_away) return {};
  return claimed(m.comes_to_rest ? Predicate::at_rest : Predicate::not_steady_yet,
                 capitalised(fmt::format("{}; what follows is of the machine held at {}", m.orbit,
                                         m.speed_unit.text(std::abs(m.drive.at.speed), 4))),
                 m.link);
}

void name_condition_of_limits(Claims& claims) {
  std::string condition;
  for (const Claim& claim : claims) {
    if (claim.predicate != Predicate::limit_exceeded) continue;
    const std::string by = !claim.variant.empty()                    ? "without the scene's cases"
                           : claim.load_case.starts_with(misfire_of) ? "with every cylinder firing"
                                                                     : "at its operating speeds";
    if (condition.find(by) == std::string::npos) condition += (condition.empty() ? "" : ", ") + by;
  }
  if (!condition.empty()) hold_under(condition, claims);
}

}  // namespace kurbel::modes
