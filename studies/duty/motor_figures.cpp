// motor_figures.cpp — quadratures of the motors' torques as figures.
#include "studies/duty/motor_figures.h"

#include "drivetrain/induction/induction_law.h"
#include "drivetrain/motors/motors.h"
#include "engine/numerics/index.h"
#include "engine/return_map/periodicity.h"

namespace kurbel {
namespace {

// Synchronous speed of an induction motor at the mains with a static curve whose field is never reversed; empty: no
// heat of slip is given.
std::optional<double> synchronous_speed(const Model& m, const MotorTorque& motor) {
  const auto* data = m.network.data.find<InductionData>(motor.component);
  const bool transient =
      std::any_of(m.internal_states.begin(), m.internal_states.end(),
                  [&](const PlacedInternalState& own) { return own.component == motor.component && !own.state.lags; });
  return data && !data->by_converter && !transient && m.command_of(motor.component) < 0
             ? std::optional(data->synchronous_speed)
             : std::nullopt;
}

// Null: no law gives the current from the torque, whose sign changes for a reversed series motor.
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

// The cycle for a motor's heating: the last one of a periodic motion. If commands change the motion, the last may be
// the lightest: then the one with most heating among the repeated ones (in speed and in heat), so that starts and
// transients after switching do not count. Null: none repeats.
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

// The figures of one motor, the i-th; `run`: null for a list.
class OneMotor {
 public:
  OneMotor(const Model& m, std::size_t i, const MotorRun* run, FigureReporter& report)
      : m_(m), motor_(m.motors[i]), i_(i), run_(run), report_(report) {}

  void of_run() {
    report("motor_rms_torque", [&] { return Found{root_mean_square(square(), run_->duration), motor_.rated_torque}; });
    report("motor_mean_power", [&] { return Found{work() / run_->duration, run_->energy_scale / run_->duration}; });
    if (const auto* current = armature_current(m_, motor_)) armature_currents(*current);
    if (const std::optional<double> synchronous = synchronous_speed(m_, motor_)) {
      const double usual = motor_.rated_torque * *synchronous * (run_ ? run_->duration : 0);
      report("motor_slip_heat", [&] {
        return Found{*synchronous * mean() - work(), std::max(run_->energy_scale, usual)};
      });
      report("start_heat", [&]() -> std::optional<Found> {
        const std::optional<double> heat = start_heat(*synchronous);
        if (!heat) return {};
        return Found{*heat, std::max(run_->energy_scale, usual)};
      });
    }
    if (run_) return phase_currents(*run_->currents);
    phase_currents(MotorCurrents(m_));
  }
  void thermal_use() {
    const std::optional<double> rated = rated_torque(m_, motor_);
    if (!rated) return;
    report("thermal_use", [&]() -> std::optional<Found> {
      if (!(*rated > 0)) return {};
      // Without a cycle, in steady motion, by the final torque: all that varies has decayed.
      if (m_.cycle == 0 && !run_->last && run_->steady) return Found{std::abs(torque_at_end()) / *rated, 1, run_->end};
      const CycleRecord* cycle = cycle_that_heats(*run_, i_);
      if (!cycle) return {};
      const double rms = root_mean_square(cycle->of_motors[2 * i_ + 1], cycle->end - cycle->begin);
      return Found{rms / *rated, 1, cycle->end};
    });
  }
  void cycle_power() {
    if (!has_cycle()) return;
    report("cycle_motor_power", [&]() -> std::optional<Found> {
      const CycleRecord* last = run_->last;
      if (!last) return {};
      return Found{driving_work(m_, motor_.component, last->work) / (last->end - last->begin),
                   std::abs(motor_.rated_torque * motor_.rated_speed), last->end};
    });
  }

 private:
  bool has_cycle() const { return m_.cycle > 0 || clock_of(m_) > 0; }
  template <class Find>
  void report(const char* words, const Find& find) {
    report_(words, motor_.component, find);
  }
  double mean() const { return run_->y[run_->equations.motor_index(i_, false)]; }   // ∫M dt
  double square() const { return run_->y[run_->equations.motor_index(i_, true)]; }  // ∫M² dt
  double work() const { return driving_work(m_, motor_.component, run_->work); }
  double torque_at_end() const { return motor_.torque(run_->equations.snapshot(run_->end, run_->y)); }

  // For an armature: the RMS value from the torque's integrals, the peak from its greatest torque.
  void armature_currents(const ArmatureCurrent& law) {
    const auto rms = [&law](double torque, double of_square) {
      return std::sqrt(std::max(0.0, law.by_mean * torque + law.by_square * of_square));
    };
    const auto peak = [&law](double torque) {
      return std::sqrt(law.by_mean * std::abs(torque) + law.by_square * torque * torque);
    };
    const double rated = motor_.rated_torque;
    report("motor_rms_current", [&] {
      return Found{rms(mean() / run_->duration, square() / run_->duration), rms(rated, rated * rated)};
    });
    report("motor_peak_current", [&]() -> std::optional<Found> {
      const Figure* torque = report_.find("motor_peak_torque." + motor_.component);
      if (!torque) return {};
      return Found{peak(torque->value), peak(rated), torque->at};
    });
  }

  // RMS current and heat of the windings of a motor whose currents are states.
  void phase_currents(const MotorCurrents& currents) {
    const auto* windings = m_.network.data.find<InductionWindings>(motor_.component);
    if (run_ && !windings) return;
    for (const MotorCurrents::Motor& m : currents.motors()) {
      if (m.component != motor_.component) continue;
      const auto heat = [&](double resistance, double square) {
        const double usual = std::abs(motor_.rated_torque * motor_.rated_speed) * run_->duration;
        return Found{3 * resistance * square, std::max(run_->energy_scale, usual)};
      };
      report("motor_rms_current", [&] { return Found{root_mean_square(m.stator_square(), run_->duration), m.usual}; });
      report("motor_slip_heat", [&] { return heat(windings->rotor_resistance, m.rotor_square()); });
      report("motor_stator_heat", [&] { return heat(windings->stator_resistance, m.stator_square()); });
      if (has_cycle())
        report("current_use", [&]() -> std::optional<Found> {
          const CycleRecord* cycle = cycle_that_heats(*run_, i_);
          if (!cycle || !(windings->rated_current > 0)) return {};
          const double square = currents.stator_square(m, cycle->begin, cycle->end);
          return Found{root_mean_square(square, cycle->end - cycle->begin) / windings->rated_current, 1, cycle->end};
        });
    }
  }

  // Power of slip heat in steady motion: from the last cycle, without one from the final torque.
  double steady_slip_power(double synchronous) const {
    if (run_->last)
      return (synchronous * run_->last->of_motors[2 * i_] - driving_work(m_, motor_.component, run_->last->work)) /
             (run_->last->end - run_->last->begin);
    const double torque = torque_at_end();
    const Snapshot& s = run_->equations.snapshot(run_->end, run_->y);
    return torque * (synchronous - m_.gain_of_node[at(motor_.node)] * s.now.speed[m_.shaft_of_node[at(motor_.node)]]);
  }
  // Heat of slip until the end of run-up: that of the run minus that of steady motion.
  std::optional<double> start_heat(double synchronous) const {
    if (!run_->after_run_up || (!run_->last && !run_->steady)) return {};
    const double all = synchronous * mean() - work();
    return all - steady_slip_power(synchronous) * (run_->after_run_up->end - run_->after_run_up->begin);
  }

  const Model& m_;
  const MotorTorque& motor_;
  std::size_t i_;
  const MotorRun* run_;
  FigureReporter& report_;
};

// Between events.
bool is_of_speed_alone(const Model& m, const MotorTorque& motor) {
  return !motor.prescribed && m.command_of(motor.component) < 0 &&
         std::all_of(motor.elements.begin(), motor.elements.end(), [&](std::size_t e) {
           const AnyShaftElement& law = *m.network.elements[e].element;
           return law.is.states == 0 && !law.is.uses_angle && !law.uses_time;
         });
}

}  // namespace

double driving_work(const Model& m, const std::string& component, std::span<const double> work) {
  double sum = 0;
  for (std::size_t k = 0; k < work.size(); ++k)
    if (m.accounts[k].name == component && m.accounts[k].kind == Account::driving) sum += work[k];
  return sum;
}

void report_motors(const MotorRun& run, FigureReporter& report) {
  const Model& m = run.equations.model();
  if (!(run.duration > 0) || run.work.empty()) return;
  for (std::size_t i = 0; i < m.motors.size(); ++i) {
    OneMotor motor(m, i, &run, report);
    motor.of_run(), motor.thermal_use(), motor.cycle_power();
  }
}

void list_motors(const Model& m, FigureReporter& report) {
  for (std::size_t i = 0; i < m.motors.size(); ++i) {
    OneMotor motor(m, i, nullptr, report);
    motor.of_run(), motor.cycle_power(), motor.thermal_use();
  }
}

std::vector<ExtremeOf> motor_extremes_of(const Model& m) {
  std::vector<ExtremeOf> wanted;
  const auto want = [&](const std::string& words, const MotorTorque& motor, const char* unit, double scale,
                        auto value) {
    const Name name{quantities::peak_other, motor.component, words + "." + motor.component};  // by magnitude
    wanted.push_back({.name = name, .unit = unit, .scale = scale, .value = value, .rate = {}});
  };
  for (const MotorTorque& motor : m.motors) {
    want("motor_peak_torque", motor, "N*m", motor.rated_torque, [motor](const Snapshot& s) { return motor.torque(s); });
    if (is_of_speed_alone(m, motor)) {
      const int shaft = m.shaft_of_node[at(motor.node)];
      wanted.back().argument = [shaft](const Snapshot& s) { return s.now.speed[shaft]; };
      wanted.back().slope = [shaft](const Snapshot& s) { return s.alpha[shaft]; };
    }
    if (!motor.prescribed) continue;
    want("motor_peak_power", motor, "W", std::abs(motor.rated_torque * motor.rated_speed), power_of(m, motor).value);
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

}  // namespace kurbel
