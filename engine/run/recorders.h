// recorders.h — observers of a run: the trajectory, extremes of chosen quantities, cycles, and the energy balance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// All channels of a model, with dotted names. `components` restrict the list; empty: all of a small machine, both ends of a
// long one.
std::vector<Channel> channels_of(const Model& model, const std::vector<std::string>& components);

// Power of the drive of a prescribed shaft [W].
Channel power_of(const Model& model, const MotorTorque& drive);

// Values of channels at equidistant times.
class TrajectoryRecorder final : public Observer {
 public:
  TrajectoryRecorder(std::vector<Channel> channels, double until, int rows);
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(begin_, time_, values_); }

  const std::vector<Channel>& channels() const { return channels_; }
  const std::vector<double>& time() const { return time_; }
  // Row-major: one row per time, one column per channel.
  const std::vector<double>& values() const { return values_; }
  double value(std::size_t row, std::size_t channel) const { return values_[row * channels_.size() + channel]; }

  // Additional rows at times between, with the same columns.
  struct Row {
    double time = 0;
    std::vector<double> values;
  };
  void add_peaks(std::vector<Row> rows) { peaks_ = std::move(rows); }
  const std::vector<Row>& peaks() const { return peaks_; }  // by time

 private:
  void record(double t, const Snapshot& snapshot);
  std::vector<Channel> channels_;
  double begin_ = 0, until_;
  int rows_;
  std::vector<double> time_, values_;
  std::vector<Row> peaks_;
};

// A quantity whose extreme is located on the continuous solution by a root of its rate.
struct ExtremeOf {
  Name name;
  std::string unit;
  double scale = 0;                          // for its error
  Functional functional = Functional::peak;  // peak, greatest or least
  std::function<double(const Snapshot&)> value;
  std::function<double(const Snapshot&)> rate;  // vanishes at the extreme; empty: by central differences of the value
  // d value/dt, if it bounds the value between two points of a step; empty: unknown.
  std::function<double(const Snapshot&)> slope = {};
  // Between events the value is a smooth law of this alone, and `slope` is the one of this.
  std::function<double(const Snapshot&)> argument = {};
};

// Peaks of torques in all couplings, of the reduction link's speed, and of the mechanisms' motion and force.
std::vector<ExtremeOf> extremes_of(const Model& model);

class ExtremeRecorder final : public Observer {
 public:
  struct Found {
    double value = 0, time = 0;
    bool any = false;
    double merit_then = 0;  // at that time; slightly larger later values belong to the same peak
    double size = 0;        // greatest magnitude so far: what is rounding of it makes no other peak
    std::vector<double> row = {};
    double row_time = 0;   // time of `row`, if there is one
    double steepness = 0;  // of a law of an argument, the greatest between two samples; 0: not known yet
    double hidden = 0;     // of a value without slopes: by how much it exceeded both ends of a step within it
    void remember(Tape& tape) { tape(value, time, any, merit_then, size, row, row_time, steepness, hidden); }
  };
  explicit ExtremeRecorder(std::vector<ExtremeOf> wanted) : wanted_(std::move(wanted)), found_(wanted_.size()) {}
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(found_); }
  const std::vector<ExtremeOf>& wanted() const { return wanted_; }
  const std::vector<Found>& found() const { return found_; }
  // Also records the values of these channels at the time of each extreme.
  void take_rows_of(std::vector<Channel> channels) { channels_ = std::move(channels); }
  std::vector<TrajectoryRecorder::Row> rows() const;  // by time, without duplicates

 private:
  struct Sample {
    double t;
    std::vector<double> value, rate, slope, argument;
  };
  double merit(std::size_t i, double value) const;
  void consider(std::size_t i, double t, double value);
  void sample(const Snapshot& snapshot, double t, Sample& out) const;
  void learn_steepness(std::size_t i);
  bool may_be_beaten(std::size_t i) const;
  void look_beside(StepView& view);
  void search(StepView& view, std::size_t i);
  void take_row(Found& found, const Snapshot& snapshot) const;

  std::vector<ExtremeOf> wanted_;
  std::vector<Channel> channels_;
  std::vector<Found> found_;
  Sample first_, middle_, last_;
  // Beside them, behind the first, on both sides of the middle, before the last: values alone, for rates by differences.
  std::array<std::vector<double>, 4> beside_;
};

// A motion that repeats after more cycles of the link is not recognised: its period would need 3 · 12 of them to show, and
// 12 contains every second, third, fourth and sixth.
inline constexpr int most_cycles_of_a_period = 12;

// One cycle of the reduction link, several in a row, or a period of time.
struct CycleRecord {
  double begin = 0, end = 0;             // [s]
  double omega_max = 0, omega_min = 0;   // of the reduction link [rad/s]
  std::vector<double> work;              // per account [J]
  std::vector<double> of_motors = {};    // per motor ∫M dt [N·m·s], then ∫M² dt [(N·m)²·s]
  std::vector<double> work_before = {};  // per account, from the start to the cycle's begin [J]
  double energy_before = 0;              // kinetic and stored, at its begin [J]
  double energy_after = 0;               // and at its end
  double turned = 0;                     // by the link [rad]
  double mid_speed() const { return 0.5 * (omega_max + omega_min); }
  // δ (theory 2.6) of a periodic motion, for both directions
  double fluctuation() const { return (omega_max - omega_min) / std::abs(mid_speed()); }
  double mean_speed() const { return turned / (end - begin); }  // theory 2.7
  void append(const CycleRecord& next);                         // which begins where this ends
  void remember(Tape& tape) {
    tape(begin, end, omega_max, omega_min, work, of_motors, work_before, energy_before, energy_after, turned);
  }
};

// A cycle lies between two successive multiples of its angle passed in the same direction; if the link reverses, a new
// cycle begins. Or, with a `period` [s], between two multiples of that, or between the begins of two repetitions of a clocked
// sequence, which may be late.
class CycleRecorder final : public Observer {
 public:
  explicit CycleRecorder(double period = 0, bool of_sequence = false) : of_sequence_(of_sequence), period_(period) {}
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override;
  const std::vector<CycleRecord>& cycles() const { return cycles_; }
  double begin_of_current() const { return open_ ? begin_ : HUGE_VAL; }  // of the one under way; infinite: none [s]

 private:
  void see_speed(double omega);
  void pass(double t, int sense, StepView& view);
  bool idle() const { return cycle_ == 0 && period_ == 0; }
  std::vector<CycleRecord> cycles_;
  bool goes_on_ = false, of_sequence_ = false;
  double repetition_ = 1e300;              // begin of the one under way [s]
  double cycle_ = 0, low_ = 0, high_ = 0;  // the multiples below and above, including the last one passed [rad]
  int sense_ = 0;                          // direction of that passage; 0: none yet
  bool open_ = false;                      // a cycle began at a multiple of its angle
  double period_ = 0;                      // of time [s]; 0: cycles of the angle
  double begin_ = 0, max_ = 0, min_ = 0, angle_at_begin_ = 0;
  std::vector<double> work_at_begin_, motors_at_begin_;
  double energy_at_begin_ = 0;
};

// Checks T + V − (T₀ + V₀) = Σ work along the run, with T by the mechanisms' bodies, not by I_r; and that the torque of
// every joint is equal from both of its sides (theory 5.18).
class EnergyAudit final : public Observer {
 public:
  EnergyAudit(double until, int checks) : until_(until), checks_(checks) {}
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override {
    tape(kinetic_start, kinetic_end, stored_start, stored_end, largest_residual, reduction_residual, turnover,
         largest_kinetic, checked, work, start_, open_body.part, open_body.shaft);
  }

  double kinetic_start = 0, kinetic_end = 0, stored_start = 0, stored_end = 0;
  double largest_residual = 0;    // [J]
  double reduction_residual = 0;  // largest relative difference of T from bodies and from I_r
  double turnover = 0;            // Σ |work| between checks [J]
  double largest_kinetic = 0;
  int checked = 0;
  std::vector<double> work;           // per account at the last check [J]
  JointTorques::Open open_body = {};  // with the largest difference of free bodies
  // Residual over max(turnover, largest T, 1e-9 of the rated torque over 1 rad: below it energies are rounding).
  double relative() const;
  // Measure to be compared with an accuracy: the residual, and the difference of free bodies if it exceeds the accuracy.
  double largest(double accuracy) const {
    return open_body.part > accuracy ? std::max(relative(), open_body.part) : relative();
  }
  bool closes(double accuracy) const { return largest(accuracy) <= accuracy; }
  const char* where(double largest) const {
    return relative() < largest ? " in the torques of joints by both sides" : " in the energy balance";
  }

 private:
  void check(double t, std::span<const double> y, Equations& equations);
  double until_;
  int checks_;
  double start_ = 0, least_scale_ = 0;
};

}  // namespace kurbel
