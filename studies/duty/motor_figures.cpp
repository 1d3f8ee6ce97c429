// motor_figures.cpp — quadratures of the motors' torques as figures.
#include "studies/duty/motor_figures.h"

#include <algorithm>
#include <cmath>

#include "drivetrain/induction/induction_law.h"
#include "drivetrain/motors/motors.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

// Synchronous speed of an induction motor at the mains that follows its static curve, and whose field nothing reverses;
// none: no heat of slip is told.
std::optional<double> synchronous_speed(const Model& m, const MotorTorque& motor) {
  const auto* data = m.network.data.find<InductionData>(motor.component);
  const bool transient = std::any_of(m.own_states.begin(), m.own_states.end(),
                                     [&](const OwnStatePlace& own) { return own.component == motor.component; });
  const bool commanded = std::any_of(m.commands.begin(), m.commands.end(),
                                     [&](const CommandTarget& c) { return c.component == motor.component; });
  return data && !data->by_converter && !transient && !commanded ? std::optional(data->synchronous_speed)
                                                                 : std::nullopt;
}

// Null: no law gives the current by the torque, whose sign a reversed series motor turns round.
const ArmatureCurrent* armature_current(const Model& m, const MotorTorque& motor) {
  const auto* current = m.network.data.find<ArmatureCurrent>(motor.component);
  const bool reversed = std::any_of(m.scene.sequence.steps.begin(), m.scene.sequence.steps.end(),
                                    [](const SequenceStep& step) { return step.to < 0 || !step.law.empty(); });
  return current && current->by_mean > 0 && reversed ? nullptr : current;
}

std::optional<double> rated_torque(const Model& m, const MotorTorque& motor) {
  const auto* rating = m.network.data.find<MotorRating>(motor.component);
  return rating ? rating->torque : std::nullopt;
}

double driving_work(const Model& m, const std::string& component, const std::vector<double>& work) {
  double sum = 0;
  for (std::size_t k = 0; k < work.size(); ++k)
    if (m.accounts[k].name == component && m.accounts[k].kind == Account::driving) sum += work[k];
  return sum;
}

double root_mean_square(double square, double time) { return std::sqrt(std::max(0.0, square) / time); }

Figure figure(const char* words, const MotorTorque& motor, double value, const char* unit, double scale) {
  return Figure::of_name(Name::own(words, motor.component), value, unit, scale);
}

// The cycle by which a motor's heating is judged: the last one of a motion that repeats. Where commands change it, the
// last may be the lightest: then the one that heats the most of all that come again, in speed and in heat, so that
// neither a start nor what a switching leaves behind counts. Null: none comes again.
const CycleRecord* cycle_that_heats(const MotorRun& run, std::size_t i) {
  if (run.equations.model().commands.empty()) return run.last;
  constexpr double alike = 0.02;
  const auto heat = [i](const CycleRecord& c) { return c.of_motors[2 * i + 1] / (c.end - c.begin); };
  const CycleRecord* most = run.last;
  for (const CycleRecord* c : run.repeating) {
    const bool settled = std::abs(heat(*(c - 1)) - heat(*c)) <= alike * heat(*c) &&
                         std::abs(heat(*(c - 2)) - heat(*c)) <= alike * heat(*c);
    if (settled && (!most || heat(*c) > heat(*most))) most = c;
  }
  return most;
}

// RMS current and heat of the windings of a motor whose currents are states.
void add_currents(const MotorRun& run, const MotorTorque& motor, std::size_t i, std::vector<Figure>& out) {
  const auto* windings = run.equations.model().network.data.find<InductionWindings>(motor.component);
  if (!windings || !run.currents) return;
  const double heat = std::max(run.energy_scale, std::abs(motor.rated_torque * motor.rated_speed) * run.duration);
  for (const MotorCurrents::Motor& m : run.currents->motors()) {
    if (m.component != motor.component) continue;
    out.push_back(figure("motor_rms_current", motor, root_mean_square(m.stator_square(), run.duration), "A", m.usual));
    out.push_back(figure("motor_slip_heat", motor, 3 * windings->rotor_resistance * m.rotor_square(), "J", heat));
    out.push_back(figure("motor_stator_heat", motor, 3 * windings->stator_resistance * m.stator_square(), "J", heat));
    const CycleRecord* cycle = cycle_that_heats(run, i);
    if (!cycle || !(windings->rated_current > 0)) continue;
    const double square = run.currents->stator_square(m, cycle->begin, cycle->end);
    out.push_back(figure("current_use", motor,
                         root_mean_square(square, cycle->end - cycle->begin) / windings->rated_current, "", 1));
    out.back().at = cycle->end;
  }
}

// Of an armature, by its greatest torque.
void add_peak_current(const MotorRun& run, const MotorTorque& motor, const ArmatureCurrent& law,
                      std::vector<Figure>& out) {
  if (!run.known) return;
  for (const Figure& peak : *run.known)
    if (peak.name == "motor_peak_torque." + motor.component) {
      const auto current = [&](double torque) {
        return std::sqrt(law.by_mean * std::abs(torque) + law.by_square * torque * torque);
      };
      out.push_back(figure("motor_peak_current", motor, current(peak.value), "A", current(motor.rated_torque)));
      out.back().at = peak.at;
      return;
    }
}

double torque_at_end(const MotorRun& run, const MotorTorque& motor) {
  return motor.torque(run.equations.snapshot(run.end, run.y));
}

// Of a machine in steady motion that knows no cycle, by the torque at the end: all that varies has faded.
void add_steady_use(const MotorRun& run, const MotorTorque& motor, double rated, std::vector<Figure>& out) {
  out.push_back(figure("thermal_use", motor, std::abs(torque_at_end(run, motor)) / rated, "", 1));
  out.back().at = run.end;
}

// Heat of slip that steady motion makes in a second: by its last cycle, without one by the torque at the end.
double steady_slip_power(const MotorRun& run, const MotorTorque& motor, std::size_t i, double synchronous) {
  const Model& m = run.equations.model();
  if (run.last)
    return (synchronous * run.last->of_motors[2 * i] - driving_work(m, motor.component, run.last->work)) /
           (run.last->end - run.last->begin);
  const double torque = torque_at_end(run, motor);
  const Snapshot& s = run.equations.snapshot(run.end, run.y);
  return torque * (synchronous - m.gain_of_node[at(motor.node)] * s.now.speed[m.shaft_of_node[at(motor.node)]]);
}

// Heat of slip up to run-up's end: that of the run less what steady motion makes of it.
void add_start_heat(const MotorRun& run, const MotorTorque& motor, std::size_t i, double synchronous,
                    std::vector<Figure>& out) {
  if (!run.after_run_up || (!run.last && !run.steady)) return;
  const double work = driving_work(run.equations.model(), motor.component, run.work);
  const double all = synchronous * run.y[run.equations.motor_index(i, false)] - work;
  const double steady =
      steady_slip_power(run, motor, i, synchronous) * (run.after_run_up->end - run.after_run_up->begin);
  out.push_back(figure("start_heat", motor, all - steady, "J",
                       std::max(run.energy_scale, motor.rated_torque * synchronous * run.duration)));
}

void add_thermal_use(const MotorRun& run, const MotorTorque& motor, std::size_t i, double rated,
                     std::vector<Figure>& out) {
  const CycleRecord* cycle = cycle_that_heats(run, i);
  if (!cycle) return;
  const double rms = root_mean_square(cycle->of_motors[2 * i + 1], cycle->end - cycle->begin);
  out.push_back(figure("thermal_use", motor, rms / rated, "", 1));
  out.back().at = cycle->end;
}

}  // namespace

std::vector<Figure> motor_figures(const MotorRun& run) {
  const Model& m = run.equations.model();
  std::vector<Figure> figures;
  if (!(run.duration > 0) || run.work.empty()) return figures;
  for (std::size_t i = 0; i < m.motors.size(); ++i) {
    const MotorTorque& motor = m.motors[i];
    const double mean = run.y[run.equations.motor_index(i, false)], square = run.y[run.equations.motor_index(i, true)];
    const double work = driving_work(m, motor.component, run.work);
    figures.push_back(
        figure("motor_rms_torque", motor, root_mean_square(square, run.duration), "N*m", motor.rated_torque));
    figures.push_back(figure("motor_mean_power", motor, work / run.duration, "W", run.energy_scale / run.duration));
    if (const auto* current = armature_current(m, motor)) {
      const auto rms = [&](double torque, double of_square) {
        return std::sqrt(std::max(0.0, current->by_mean * torque + current->by_square * of_square));
      };
      figures.push_back(figure("motor_rms_current", motor, rms(mean / run.duration, square / run.duration), "A",
                               rms(motor.rated_torque, motor.rated_torque * motor.rated_torque)));
      add_peak_current(run, motor, *current, figures);
    }
    if (const std::optional<double> synchronous = synchronous_speed(m, motor)) {
      const double usual = motor.rated_torque * *synchronous * run.duration;
      figures.push_back(
          figure("motor_slip_heat", motor, *synchronous * mean - work, "J", std::max(run.energy_scale, usual)));
      add_start_heat(run, motor, i, *synchronous, figures);
    }
    add_currents(run, motor, i, figures);
    const std::optional<double> rated = rated_torque(m, motor);
    if (!run.last && run.steady && m.cycle == 0 && rated && *rated > 0) add_steady_use(run, motor, *rated, figures);
    if (rated && *rated > 0 && m.cycle > 0) add_thermal_use(run, motor, i, *rated, figures);
    if (!run.last) continue;
    const double time = run.last->end - run.last->begin;
    const double of_cycle = driving_work(m, motor.component, run.last->work);
    figures.push_back(
        figure("cycle_motor_power", motor, of_cycle / time, "W", std::abs(motor.rated_torque * motor.rated_speed)));
    figures.back().at = run.last->end;
  }
  return figures;
}

std::vector<ExtremeOf> motor_extremes_of(const Model& m) {
  std::vector<ExtremeOf> wanted;
  const auto want = [&](const std::string& words, const MotorTorque& motor, const char* unit, double scale,
                        auto value) {
    const Name name{quantity::peak_other, motor.component, words + "." + motor.component};  // by magnitude
    wanted.push_back({.name = name, .unit = unit, .scale = scale, .value = value, .rate = {}});
  };
  for (const MotorTorque& motor : m.motors) {
    want("motor_peak_torque", motor, "N*m", motor.rated_torque, [motor](const Snapshot& s) { return motor.torque(s); });
    if (!motor.prescribed) continue;
    const int shaft = m.shaft_of_node[at(motor.node)];
    const double gain = m.gain_of_node[at(motor.node)];
    want("motor_peak_power", motor, "W", std::abs(motor.rated_torque * motor.rated_speed),
         [=](const Snapshot& s) { return motor.torque(s) * gain * s.now.speed[shaft]; });
  }
  const MotorCurrents currents(m);
  for (const MotorTorque& motor : m.motors)
    for (const MotorCurrents::Motor& of : currents.motors())
      if (of.component == motor.component)
        want("motor_peak_current", motor, "A", of.usual, [parts = of.stator](const Snapshot& s) {
          double square = 0;
          for (const std::size_t k : parts) square += s.now.own[k] * s.now.own[k];
          return std::sqrt(square);
        });
  return wanted;
}

std::vector<Figure> motor_figure_list(const Model& m) {
  std::vector<Figure> list;
  for (const ExtremeOf& e : motor_extremes_of(m)) list.push_back(Figure::of_name(e.name, 0, e.unit));
  for (const MotorTorque& motor : m.motors) {
    list.push_back(figure("motor_rms_torque", motor, 0, "N*m", 0));
    list.push_back(figure("motor_mean_power", motor, 0, "W", 0));
    if (armature_current(m, motor))
      for (const char* words : {"motor_rms_current", "motor_peak_current"})
        list.push_back(figure(words, motor, 0, "A", 0));
    if (synchronous_speed(m, motor))
      for (const char* words : {"motor_slip_heat", "start_heat"}) list.push_back(figure(words, motor, 0, "J", 0));
    const MotorCurrents currents(m);
    for (const MotorCurrents::Motor& of : currents.motors())
      if (of.component == motor.component) {
        list.push_back(figure("motor_rms_current", motor, 0, "A", 0));
        for (const char* words : {"motor_slip_heat", "motor_stator_heat"})
          list.push_back(figure(words, motor, 0, "J", 0));
        if (m.cycle > 0) list.push_back(figure("current_use", motor, 0, "", 0));
      }
    if (m.cycle > 0) list.push_back(figure("cycle_motor_power", motor, 0, "W", 0));
    if (rated_torque(m, motor)) list.push_back(figure("thermal_use", motor, 0, "", 0));
  }
  return list;
}

}  // namespace kurbel
