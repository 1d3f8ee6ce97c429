// run_words.cpp — sentences about one run.
#include "studies/run/run_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivetrain/induction/induction_law.h"
#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"

namespace kurbel {
namespace {

// The time of a period's end from the figure that has it, if one has.
std::string time_text(const Result& r, double t) {
  for (const Figure& f : r.figures)
    if (f.at && *f.at == t && (f.name == "run_up_time" || f.name == "run_down_time"))
      return with_error(t, f.error, "s");
  return with_unit(t, "s", 6);
}

// What the figures of a cycle belong to, where there are any.
std::string of_last_cycle(const Result& r) {
  return first_of(r, QuantityKind::cycle_fluctuation) ? " (figures of a cycle are those of the last whole one)" : "";
}

// --- validity of the static curve of induction motors (theory 4.1) ---

// A motor on its static curve, and its supply.
struct StaticMotor {
  std::string name;
  double rated_torque = 0, breakdown_slip = 0, mains = 0;  // [N·m], [1], [Hz]
  bool has_circuit = false;                                // data of the two-axis model
};

// Of a frequency converter the supply is no mains.
std::vector<StaticMotor> static_motors(const Model& model) {
  std::vector<StaticMotor> list;
  for (const Section& s : model.scene.components) {
    const auto motor = induction_data(s);
    if (!motor || motor->by_converter || (motor->has_circuit && model.effects.transients)) continue;
    list.push_back({s.name, motor->rated_torque, motor->breakdown_slip, motor->mains, motor->has_circuit});
  }
  return list;
}

// Between two turning points of its speed and back.
struct DriveSwing {
  double frequency = 0, torque = 0, at = 0;  // [Hz], from least to largest [N·m], [s]
  double followed = 1;                       // part of a torque's swing that the fluxes let through
  double missed() const { return torque * (1 - followed); }
};

// Fluxes follow the curve as T dM/dt + M = M_static(ω), T = 1/(2π s_b f), for small slips: T is the rotor's transient
// time constant, by which Kloss' curve has its breakdown at s_b.
double part_followed(double swing, const StaticMotor& motor) {
  return 1 / std::hypot(1, swing / (motor.breakdown_slip * motor.mains));
}

// The swing of which the curve gives most that a real motor would not, above the least share of the mains' frequency.
DriveSwing worst_swing(const TrajectoryRecorder& trajectory, const StaticMotor& motor, double least_share) {
  const auto column = [&](const std::string& name) {
    const auto& channels = trajectory.channels();
    return static_cast<std::size_t>(
        std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name.text == name; }) -
        channels.begin());
  };
  const std::size_t speed = column("speed." + motor.name), torque = column("torque." + motor.name);
  DriveSwing worst;
  if (std::max(speed, torque) >= trajectory.channels().size()) return worst;
  const std::vector<double>& t = trajectory.time();
  const auto change = [&](std::size_t k) { return trajectory.value(k + 1, speed) - trajectory.value(k, speed); };
  std::vector<std::size_t> turns;
  for (std::size_t k = 1; k + 1 < t.size(); ++k) {
    if (!(change(k - 1) * change(k) < 0)) continue;
    turns.push_back(k);
    if (turns.size() < 3) continue;
    const std::size_t begin = turns[turns.size() - 3];
    DriveSwing swing{.frequency = 1 / (t[k] - t[begin]), .at = t[begin]};
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (std::size_t row = begin; row <= k; ++row) {
      least = std::min(least, trajectory.value(row, torque));
      most = std::max(most, trajectory.value(row, torque));
    }
    swing.torque = most - least;
    swing.followed = part_followed(swing.frequency, motor);
    if (swing.frequency >= least_share * motor.mains && swing.missed() > worst.missed()) worst = swing;
  }
  return worst;
}

}  // namespace

std::vector<std::string> static_curve_notes(const Model& model, const TrajectoryRecorder& trajectory) {
  constexpr double least_share = 0.03, least_torque = 0.05;  // of the mains' frequency, of the rated torque
  std::vector<std::string> notes;
  for (const StaticMotor& motor : static_motors(model)) {
    const DriveSwing swing = worst_swing(trajectory, motor, least_share);
    if (!(swing.missed() > least_torque * motor.rated_torque)) continue;
    notes.push_back(fmt::format(
        "the drive \"{}\" swings at about {:.2g} Hz, {:.2g} % of the mains' {:g} Hz, from {:.3g} s on, and its static "
        "torque-speed curve lets its torque swing by {:.3g} N·m with that: too fast for the curve, whose fluxes follow "
        "at once. Estimated by its breakdown slip {:.2g}, a real motor's torque follows such a swing by {:.0f} %; {}",
        motor.name, swing.frequency, 100 * swing.frequency / motor.mains, motor.mains, swing.at, swing.torque,
        motor.breakdown_slip, 100 * swing.followed,
        motor.has_circuit ? "the scene has the data of the two-axis model, which computes it: --effects with transients"
                          : fmt::format("the two-axis model computes it: keys frequency = \"{:g} Hz\" and "
                                        "resistance_ratio > 0 (cage motors: about 1) instead of starting_ratio or a "
                                        "starter, and the effect transients",
                                        motor.mains)));
  }
  return notes;
}

bool nothing_turned_over(const EnergyBalance& e) {
  return e.kinetic_start == e.kinetic_end && e.stored_start == e.stored_end &&
         std::all_of(e.by_account.begin(), e.by_account.end(), [](const auto& account) { return account.second == 0; });
}

bool is_told(const Figure& f, const Result& r) { return r.complete || std::isfinite(f.value); }

bool has_works(const Result& r) {
  const auto finite = [](const auto& line) { return std::isfinite(line.second); };
  return r.energy.checks > 0 && (r.complete || (!nothing_turned_over(r.energy) && std::isfinite(r.energy.relative) &&
                                                std::all_of(r.energy.by_line.begin(), r.energy.by_line.end(), finite)));
}

std::string told(const EnergyBalance& e) {
  if (!nothing_turned_over(e))
    return fmt::format("energy balance closed to {:.1e} of the energy turned over", e.relative);
  return e.kinetic_end > 0
             ? fmt::format("no work is done and the kinetic energy stays {}: no balance of energy to prove anything by",
                           with_unit(e.kinetic_end, "J", 5))
             : std::string("nothing moves and no work is done: no balance of energy to prove anything by");
}

std::string in_words(const Figure& f) {
  std::string words = f.of.empty() ? f.name : f.name.substr(0, f.name.size() - f.of.size() - 1);
  std::replace(words.begin(), words.end(), '_', ' ');
  if (f.what == QuantityKind::delta) words = "speed fluctuation δ";
  if (f.what == QuantityKind::cycle_fluctuation) words = "fluctuation in the last cycle";
  return f.of.empty() ? words : words + ", " + f.of;
}

std::string sure(const Figure& f) { return with_error(f.value, f.error, f.unit); }
std::string sure(const Figure& f, const SpeedUnit& speed) {
  if (f.unit != "rad/s") return sure(f);
  return with_error(speed.of(f.value), f.error ? std::optional(speed.of(*f.error)) : std::nullopt, speed.name);
}
SpeedUnit speed_unit_of(const Result& r) { return r.model ? r.model->scene.speed_unit : SpeedUnit{}; }
std::string at_time(const Figure& f) { return f.at ? "at " + with_error(*f.at, f.at_error, "s") : ""; }

const Figure* largest_peak(const Result& r) {
  const Figure* peak = nullptr;
  for (const Figure& f : r.figures)
    if (f.what == QuantityKind::peak_torque && is_told(f, r) && (!peak || std::abs(f.value) > std::abs(peak->value)))
      peak = &f;
  return peak;
}

const Figure* first_of(const Result& r, QuantityKind what) {
  for (const Figure& f : r.figures)
    if (f.what == what && is_told(f, r)) return &f;
  return nullptr;
}

std::string one_line(const Result& r) {
  if (!r.complete) return fmt::format("{}: INCOMPLETE: {}", r.title, r.diagnosis);
  const std::string accuracy = r.unconfirmed()     ? "NOT confirmed: " + r.accuracy_in_words()
                               : r.errors_measured ? fmt::format("accuracy {:.1e} measured", r.measured_accuracy)
                                                   : "errors not measured";
  std::string peak;
  for (const Figure& f : r.figures)
    if (peak.empty() && f.what == QuantityKind::peak_torque)
      peak = fmt::format("peak torque in {} {}, ", f.of, with_error(f.value, f.error, "N*m"));
  std::string balance;
  if (r.energy.checks > 0)
    balance = nothing_turned_over(r.energy) ? ", no energy turned over"
                                            : fmt::format(", energy balance {:.1e}", r.energy.relative);
  const std::string span = r.begins_at > 0
                               ? fmt::format("{} … {}", with_unit(r.begins_at, "s", 6), with_unit(r.until, "s", 6))
                               : with_unit(r.until, "s", 6);
  return fmt::format("{}: {} simulated, {}, {}{}{}", r.title, span, r.label, peak, accuracy, balance);
}

std::string conclusion_of(const Result& r) {
  if (!r.complete) return fmt::format("The run is incomplete: {}", r.diagnosis);
  std::string text;
  if (r.unconfirmed()) text = fmt::format("NOT confirmed: {}. ", r.accuracy_in_words());
  const std::size_t begin = text.size();
  if (const Figure* peak = largest_peak(r))
    text += fmt::format("The torque in {} reaches {}{}", peak->of, sure(*peak), peak->at ? " " + at_time(*peak) : "");
  if (const Figure* delta = first_of(r, QuantityKind::delta))
    text += fmt::format("{} speed of {} fluctuates by δ = {}", text.size() == begin ? "The" : "; the", delta->of,
                        sure(*delta));
  if (const Figure* cycle = first_of(r, QuantityKind::cycle_fluctuation))
    text += fmt::format("{} speed of {} changes by {} of its middle in the last cycle, which is not steady",
                        text.size() == begin ? "The" : "; the", cycle->of, sure(*cycle));
  if (text.size() == begin)
    if (const Figure* speed = first_of(r, QuantityKind::final_speed))
      text += fmt::format("{} ends at {}", speed->of, sure(*speed, speed_unit_of(r)));
  if (has_works(r) && nothing_turned_over(r.energy))
    text += fmt::format("{}o work is done and no energy changes its form", text.size() == begin ? "N" : "; n");
  else if (has_works(r))
    text += fmt::format("{}he energy balance closes to {:.1e}", text.size() == begin ? "T" : "; t", r.energy.relative);
  return text + ".";
}

std::vector<std::string> model_words(const Result& r) {
  std::vector<std::string> lines = {
      fmt::format("{}: {} coordinate{}, {} — {}", r.label, r.coordinates, r.coordinates == 1 ? "" : "s",
                  r.effects == "none" ? "no effects on" : "effects: " + r.effects, r.statistics.method),
      fmt::format("  {}; {} steps, {:.3g} ms of processor time a run, {} run{}", r.statistics.reason,
                  r.statistics.stepper.steps, 1e3 * r.statistics.cpu_seconds, r.runs, r.runs == 1 ? "" : "s")};
  if (const std::string limits = told(r.statistics.limits); !limits.empty())
    lines.push_back("  what kept the steps short: " + limits);
  if (!r.complete) lines.push_back("  INCOMPLETE: " + r.diagnosis);
  return lines;
}

std::vector<std::string> balance_words(const Result& r) {
  std::vector<std::string> lines;
  const EnergyBalance& e = r.energy;
  if (has_works(r)) {
    std::string works;
    for (const auto& [line, work] : e.by_line)
      works += fmt::format("{} {} {}", works.empty() ? "" : ",", line, with_unit(work, "J", 5));
    lines.push_back("  work:" + works);
    lines.push_back(
        "  " + told(e) +
        (e.reduction_residual > 0 ? fmt::format("; bodies against reduced inertia {:.1e}", e.reduction_residual) : ""));
  }
  if (r.errors_measured)
    lines.push_back(fmt::format("  accuracy: {:.1e} asked for, {:.1e} measured{}", r.accuracy, r.measured_accuracy,
                                r.accuracy_confirmed ? "" : " — NOT confirmed"));
  else if (r.complete)
    lines.push_back(r.unconfirmed() ? "  accuracy: errors could not be measured — NOT confirmed"
                                    : "  errors were not measured (--no-error): digits are not what is sure");
  const Periods& p = r.periods;
  if (p.run_up_end)
    lines.push_back(fmt::format("  run-up to {}", time_text(r, *p.run_up_end)) +
                    (p.run_down_begin
                         ? fmt::format(", steady to {}, then run-down{}", with_unit(*p.run_down_begin, "s", 6),
                                       p.standstill ? " to standstill at " + time_text(r, *p.standstill) : "")
                         : ", then steady motion"));
  if (r.complete && r.trajectory)
    lines.push_back(fmt::format("  {}{}: {}", p.steady ? "steady motion" : "no steady motion within the time simulated",
                                of_last_cycle(r), p.verdict));
  for (const std::string& note : r.notes) lines.push_back("  note: " + note);
  return lines;
}

}  // namespace kurbel
