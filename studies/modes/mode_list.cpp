// mode_list.cpp — undamped modes, the corresponding damped ones, and their range of validity.
#include "studies/modes/mode_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/linear/shaft_waves.h"
#include "engine/model/cycle_of.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "studies/findings/result.h"

namespace kurbel {
namespace {

constexpr int frozen_angles = 24;
constexpr double hardly_moves = 0.999;    // share of a mode in internal states
constexpr double like_enough = 0.3;       // of two shapes: less is another motion
constexpr double carried = 0.1;           // of the frequency: an element that is off by more carries no such mode
constexpr Eigen::Index most_frozen = 60;  // coordinates

// The link is held at rest.
bool stands(const LinearDrive& drive) { return drive.at.angle && drive.at.speed == 0; }

// Pairs each undamped mode with the damped mode of most similar shape whose energy is mechanical, each used once;
// shapes are compared with M.
std::vector<char> pair_damped(ModesStudy& found) {
  std::vector<char> used(found.damped.size(), 0);
  // A mode shifted far by the slopes of motors and loads keeps its shape.
  for (const bool near : {true, false})
    for (Mode& mode : found.modes) {
      if (mode.lambda.imag() > 0) continue;
      double best = 0;
      std::size_t which = found.damped.size();
      for (std::size_t i = 0; i < found.damped.size(); ++i) {
        const DampedMode& d = found.damped[i];
        if (used[i] || d.lambda.imag() <= 0) continue;
        const Eigen::VectorXcd moved = found.drive.inertia.cwiseProduct(mode.shape).cast<Complex>();
        const double norm = std::sqrt((found.drive.inertia.array() * d.shape.array().abs2()).sum());
        const double off = std::min(1.0, std::abs(std::abs(d.lambda) - mode.omega) / mode.omega);
        const double like = std::abs(moved.dot(d.shape)) / norm * (near ? 1 - off : 1);
        const double mechanical = like * (1 - d.energy.in_internal_states());
        if (like >= like_enough && mechanical > best) best = mechanical, which = i;
      }
      if (which == found.damped.size()) continue;
      used[which] = 1;
      mode.lambda = found.damped[which].lambda;
      // Rounding errors of an undamped drive are no damping.
      const double rounding = 1e-12 * std::abs(mode.lambda);
      mode.ratio = std::abs(mode.lambda.real()) > rounding ? found.damped[which].ratio() : 0;
      mode.lambda_error = found.damped[which].error;
      mode.energy = found.damped[which].energy;
    }
  return used;
}

// A complex shape at the moment of largest motion of its inertias, M-normalised, its heaviest part positive.
Eigen::VectorXd principal_shape(const LinearDrive& drive, const Eigen::VectorXcd& shape) {
  Complex together = 0;
  for (Eigen::Index i = 0; i < shape.size(); ++i) together += drive.inertia[i] * shape[i] * shape[i];
  Eigen::VectorXd real = (shape * std::polar(1.0, -0.5 * std::arg(together))).real();
  Eigen::Index heaviest = 0;
  drive.inertia.cwiseProduct(real.cwiseAbs2()).maxCoeff(&heaviest);
  return real / std::copysign(std::sqrt(drive.inertia.dot(real.cwiseAbs2())), real[heaviest]);
}

// Of springs and inertias.
std::vector<Mode> modes_of_springs(const ModesStudy& found) {
  std::vector<Mode> modes;
  const UndampedModes& u = found.undamped;
  for (Eigen::Index i = u.rigid; i < u.omega.size(); ++i) {
    Mode& mode = modes.emplace_back();
    mode.omega = mode.least = mode.greatest = u.omega[i];
    mode.shape = u.shapes.col(i);
    mode.shares = energy_shares(found.drive, mode.shape);
    mode.error = u.error[i];
  }
  return modes;
}

// Of springs, weights and inertias, with K = −∂M/∂φ among the stiffnesses: without damping and internal states.
std::vector<Mode> modes_at_rest(const ModesStudy& found) {
  LinearDrive undamped = found.drive;
  undamped.damping.setZero();
  undamped.internal_scale.resize(0);
  std::vector<Mode> modes;
  for (const DampedMode& d : damped_modes(undamped, found.undamped)) {
    if (d.lambda.imag() <= 1e-6 * std::abs(d.lambda)) continue;
    Mode& mode = modes.emplace_back();
    mode.omega = mode.least = mode.greatest = std::abs(d.lambda);
    mode.shape = principal_shape(found.drive, d.shape);
    mode.shares = energy_shares(found.drive, mode.shape);
    mode.error = d.error;
  }
  return modes;
}

void number_in_order(std::vector<Mode>& modes) {
  for (std::size_t k = 0; k < modes.size(); ++k) modes[k].number = static_cast<int>(k) + 1;
}

// Modes by internal states of elements, and modes of springs and internal states together that correspond to no
// undamped mode. By |λ|, like damped modes. Those above all listed ones are ignored, unless internal states have
// energy in them.
void add_modes_of_internal_states(int count, const std::vector<char>& used, ModesStudy& found) {
  const std::size_t most = found.modes.size() + at(count);
  const double highest = found.modes.empty() ? HUGE_VAL : found.modes.back().omega;
  for (std::size_t i = 0; i < found.damped.size(); ++i) {
    const DampedMode& d = found.damped[i];
    if (used[i] || d.lambda.imag() <= 1e-6 * std::abs(d.lambda) || found.modes.size() == most) continue;
    if (std::abs(d.lambda) > highest && !(d.energy.in_internal_states() > 0)) continue;
    Mode mode;
    mode.omega = std::abs(d.lambda);
    mode.lambda = d.lambda;
    mode.ratio = std::abs(d.lambda.real()) > d.error ? d.ratio() : 0;
    mode.error = mode.lambda_error = d.error;
    mode.energy = d.energy;
    mode.of_internal_states = true;
    mode.least = mode.greatest = mode.omega;
    mode.shape = principal_shape(found.drive, d.shape);
    mode.shares = energy_shares(found.drive, d.shape.cwiseAbs());  // parts vibrate in different phases
    if (d.in_internal_states > hardly_moves)  // where the machine stands still to rounding, no share means anything
      for (std::vector<double>* shares : {&mode.shares.joint, &mode.shares.shaft})
        std::fill(shares->begin(), shares->end(), 0.0);
    found.modes.push_back(std::move(mode));
  }
  number_in_order(found.modes);
}

// Distance relative to ω within which the drive with continuous shafts has a mode: one step of Newton's method and,
// if the exact stiffness can count modes, doubled until a mode is counted there. Empty: none within a tenth of ω.
std::optional<double> distance_of_wave_mode(const ModesStudy& found, const Mode& mode, bool countable) {
  double within = wave_error(found.drive, mode.shape, mode.omega);
  for (; within <= carried * mode.omega; within *= 2) {
    if (!countable) return within;
    Deadline::check();
    within = std::max(within, 1e-12 * mode.omega);
    const double reach = within + mode.error;
    if (continuous_modes_below(found.drive, mode.omega + reach) >
        continuous_modes_below(found.drive, mode.omega - reach))
      return within;
  }
  return std::nullopt;
}

// The discretisation error of continuous shafts is part of each mode's error; modes that the elements cannot
// represent are omitted, and missing modes are counted by the exact stiffness.
void add_wave_errors(ModesStudy& found) {
  constexpr Eigen::Index most_confirmed = 120, most_counted = 300;  // coordinates
  const bool springs_alone =
      std::none_of(found.modes.begin(), found.modes.end(), [](const Mode& mode) { return mode.of_internal_states; });
  const bool countable = springs_alone && found.drive.is_symmetric();
  std::vector<Mode> kept;
  for (Mode& mode : found.modes) {
    const std::optional<double> within =
        distance_of_wave_mode(found, mode, countable && found.drive.size() <= most_confirmed);
    if (!within && !kept.empty()) continue;
    const double open =
        within.value_or(std::max(carried * mode.omega, wave_error(found.drive, mode.shape, mode.omega)));
    mode.error += open, mode.lambda_error += open;
    kept.push_back(std::move(mode));
  }
  found.modes = std::move(kept);
  number_in_order(found.modes);
  if (found.modes.empty() || !countable || found.drive.size() > most_counted) return;
  const Mode& last = found.modes.back();
  const double above = last.omega + last.error + 1e-9 * last.omega;
  const int really = continuous_modes_below(found.drive, above) - found.undamped.rigid;
  if (really > static_cast<int>(found.modes.size()))
    found.notes.push_back(fmt::format(
        "up to {:.5g} Hz the exact dynamic stiffness of continuous shafts gives {} modes; {} are listed. The others "
        "are waves within shafts that are modelled by too few elements: give those shafts more segments",
        above / (2 * pi), really, found.modes.size()));
}

}  // namespace

void list_modes(int count, ModesStudy& found) {
  const ModesWanted wanted{.count = count};
  found.undamped = undamped_modes(found.drive, wanted);
  found.damped = damped_modes(found.drive, found.undamped, wanted);
  const bool held_at_rest = stands(found.drive) && found.drive.size() <= wanted.dense_below;
  found.modes = held_at_rest ? modes_at_rest(found) : modes_of_springs(found);
  const std::vector<char> used = pair_damped(found);
  if (found.modes.size() > at(count)) found.modes.resize(at(count));
  add_modes_of_internal_states(count, used, found);
  if (found.drive.model->has_continuous_shafts()) add_wave_errors(found);
  for (const DampedMode& d : found.damped)
    if (d.lambda.real() > 1e-9 * std::abs(d.lambda) && d.lambda.real() > 0) {
      found.notes.push_back(
          fmt::format("{} grows by itself at this point (λ = {:.4g} 1/s): the operating point is unstable: the torques "
                      "there feed it more than they damp it (as those of a motor below its breakdown speed)",
                      d.lambda.imag() > 0 ? fmt::format("the vibration at {:.5g} Hz", d.lambda.imag() / (2 * pi))
                                          : "the motion as a whole",
                      d.lambda.real()));
      break;
    }
}

// Undamped frequencies with the link held at angles all over the cycle.
void find_frozen_range(int count, ModesStudy& found) {
  if (found.drive.size() > most_frozen) return;
  const Model& m = *found.drive.model;
  const bool variable = std::any_of(m.shafts.begin(), m.shafts.end(), [](const Shaft& s) { return s.variable; });
  if (!variable) return;
  const double cycle = cycle_of(m).angle;
  std::vector<Mode*> springs;
  for (Mode& mode : found.modes)
    if (!mode.of_internal_states) springs.push_back(&mode);
  for (int i = 0; i < frozen_angles; ++i) {
    LinearisationPoint point = found.drive.at;
    point.angle = cycle * (i + 0.5) / frozen_angles;
    const UndampedModes held = undamped_modes(linearise(found.drive.model, point), {.count = count});
    for (std::size_t k = 0; k < springs.size(); ++k) {
      const Eigen::Index place = held.rigid + static_cast<Eigen::Index>(k);
      if (place >= held.omega.size()) break;
      springs[k]->least = std::min(springs[k]->least, held.omega[place]);
      springs[k]->greatest = std::max(springs[k]->greatest, held.omega[place]);
    }
  }
}

bool changes_contact(const Event& event) {
  switch (event.kind) {
    case EventKind::rest:
    case EventKind::held:
    case EventKind::motion:
    case EventKind::lock:
    case EventKind::slip:
    case EventKind::flight:
    case EventKind::touch:
    case EventKind::impact:
      return true;
    default:
      return false;
  }
}

void note_changes(const CycleSamples& samples, ModesStudy& found) {
  std::map<std::string, int> changes;
  for (const Event& event : samples.events)
    if (changes_contact(event)) ++changes[event.component];
  if (changes.empty()) return;
  std::string list;
  for (const auto& [component, count] : changes)
    list += fmt::format("{}{} ({} times)", list.empty() ? "" : ", ", component, count);
  found.notes.push_back(
      fmt::format("within a cycle of the steady motion contacts change: {}. Modes and forced response have them as "
                  "they are at {:.4g}° of {}; what the joints do in the steady motion is that of the full equations",
                  list, (samples.link_angle - turn * std::floor(samples.link_angle / turn)) * in_degrees, found.link));
}

void note_missing_modes(ModesStudy& found) {
  constexpr double hardly = 0.01;
  if (!found.cycle) return;
  for (std::size_t j = 0; j < found.joint_names.size(); ++j) {
    const double linear = found.here.joints[j].peak, really = found.cycle->joints[j].peak;
    if (!(really > 1e-6 * std::abs(found.cycle->joints[j].mean) && linear < hardly * really)) continue;
    found.notes.push_back(fmt::format(
        "the linear response says {} of {}, which has an amplitude of {} in the steady motion: its critical speeds, "
        "barred ranges and curves over the speed do not hold{}",
        with_unit(linear, "N*m", 3), found.joint_names[j], with_unit(really, "N*m", 3),
        found.drive.model->effects.joint_clearance
            ? ". With clearance the linear drive takes the pin at its mean place, inside the gap, where nothing touches"
            : ""));
  }
}

// Joints whose pieces change within the period, with the equivalent linear spring.
void find_rattles(const CycleSamples& samples, int count, ModesStudy& found) {
  const Model& m = *found.drive.model;

  LinearDrive alike = found.drive;
  for (std::size_t j = 0; j < m.elastic.size(); ++j) {
    const Network::Joint& joint = m.network.joints[at(m.elastic[j].joint)];
    if (joint.element->is.guards == 0 || !joint.element->is.has_spring()) continue;
    Rattle rattle;
    rattle.joint = j;
    rattle.linear = found.drive.joints[j].stiffness;
    for (const Event& event : samples.events) rattle.changes += event.component == joint.component;
    if (rattle.changes == 0) continue;
    const double twist = samples.mean->mean[m.angle_count() + j], torque = samples.mean->joint_torque[j];
    double both = 0, square = 0;
    for (std::size_t k = 0; k < samples.torque[j].size(); ++k) {
      both += (samples.torque[j][k] - torque) * (samples.twist[j][k] - twist);
      square += std::pow(samples.twist[j][k] - twist, 2);
    }
    rattle.stiffness = square > 0 ? both / square : 0;
    const double more = rattle.stiffness - rattle.linear;
    const SparseMatrix row = SparseMatrix(found.drive.twists.row(static_cast<Eigen::Index>(j)));
    alike.stiffness += more * SparseMatrix(row.transpose()) * row;
    alike.joints[j].stiffness = rattle.stiffness;
    found.rattles.push_back(rattle);
  }
  if (found.rattles.empty()) return;
  const UndampedModes modes = undamped_modes(alike, {.count = count});
  for (Rattle& rattle : found.rattles) {
    for (Eigen::Index i = modes.rigid; i < modes.omega.size(); ++i) rattle.omega.push_back(modes.omega[i]);
    found.notes.push_back(
        fmt::format("\"{}\" rattles: its law changes piece {} times in a cycle of the steady motion, so that its "
                    "stiffness depends on the amplitude. At the mean twist it is {:.5g} N·m/rad, over the actual cycle "
                    "{:.5g} N·m/rad; with that the first mode lies at {:.5g} Hz",
                    found.joint_names[rattle.joint], rattle.changes, rattle.linear, rattle.stiffness,
                    rattle.omega.empty() ? 0.0 : rattle.omega.front() / (2 * pi)));
  }
}

Eigen::VectorXd shaft_shape(const ModesStudy& study, const Mode& mode) { return study.drive.motion * mode.shape; }

std::size_t natural_modes(const ModesStudy& study) {
  return static_cast<std::size_t>(
      std::count_if(study.modes.begin(), study.modes.end(), [](const Mode& mode) { return !mode.of_internal_states; }));
}

Effects effects_of_modes(const Scene& scene) {
  Effects effects = scene.effects;
  if (effects.elastic.empty() && !effects.all_elastic) effects.all_elastic = true;
  return effects;
}

// In an equilibrium nothing vibrates: the samples contain rounding errors only.
void remove_vibrations(SpeedResponse& response) {
  for (JointResponse& joint : response.joints) {
    JointResponse still;
    still.mean = still.upper = still.lower = joint.mean;
    joint = still;
  }
  for (std::vector<Complex>& orders : response.orders) std::fill(orders.begin() + 1, orders.end(), Complex{});
}

std::vector<Figure> figures_of(const ModesStudy& study) {
  std::vector<Figure> figures;
  const auto frequency = [&](const char* name, const std::string& number, double omega, double error) {
    constexpr double hertz = 0.5 / pi;
    figures.push_back({{omega * hertz, error * hertz}, name + number, "Hz"});
  };
  for (const Mode& mode : study.modes) {
    const std::string number = std::to_string(mode.number);
    frequency(mode.of_internal_states ? "internal_frequency." : "natural_frequency.", number, mode.omega, mode.error);
    if (mode.lambda.imag() <= 0) continue;
    frequency("damped_frequency.", number, mode.lambda.imag(), mode.lambda_error);
    figures.push_back({{mode.ratio}, "damping_ratio." + number});
  }
  return figures;
}

}  // namespace kurbel
