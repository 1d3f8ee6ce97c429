// recorders.cpp — records of a run: trajectory, extremes, cycles, energy balance.
#include "engine/run/recorders.h"

#include <functional>

#include "engine/numerics/deadline.h"
#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"
#include "engine/numerics/straight.h"

namespace kurbel {
namespace {

// Peaks that differ by less are repetitions of the same peak: the time of the first one counts.
constexpr double same_peak = 1e-9, rounding = 1e-13;
constexpr double beside = 1e-3;  // of a step: rates by differences

}  // namespace

// ---------------------------------------------------------------------------------------------------------------------

TrajectoryRecorder::TrajectoryRecorder(std::vector<Channel> channels, double until, int rows)
    : channels_(std::move(channels)), until_(until), rows_(rows) {
  time_.reserve(at(rows));
  values_.reserve(at(rows) * channels_.size());
}

void TrajectoryRecorder::record(double t, const Snapshot& snapshot) {
  time_.push_back(t);
  for (const Channel& channel : channels_) values_.push_back(channel.value(snapshot) + 0.0);  // no −0
}

void TrajectoryRecorder::begin(double t, std::span<const double> y, Equations& equations) {
  if (!time_.empty()) return;  // continuation
  begin_ = t;
  record(t, equations.snapshot(t, y));
}

void TrajectoryRecorder::step(StepView& view) {
  while (time_.size() < at(rows_)) {
    const double next = time_.size() + 1 == at(rows_)
                            ? until_
                            : begin_ + (until_ - begin_) * static_cast<double>(time_.size()) / (rows_ - 1);
    if (next > view.t()) return;
    record(next, view.snapshot(next));
  }
}

// ---------------------------------------------------------------------------------------------------------------------

double ExtremeRecorder::merit(std::size_t i, double value) const {
  if (wanted_[i].functional == Functional::peak) return std::abs(value);
  return wanted_[i].functional == Functional::least ? -value : value;
}

void ExtremeRecorder::consider(std::size_t i, double t, double value) {
  Found& found = found_[i];
  const double merit_now = merit(i, value);
  found.size = std::max(found.size, std::abs(value));
  if (found.any && merit_now <= merit(i, found.value)) return;
  const double same = rounding * found.size + (found.time < first_.t ? same_peak * std::abs(value) : 0);
  if (found.any && found.time <= first_.t && merit_now <= found.merit_then + same) {
    // Of either sign where magnitudes count: the sign is that of the time.
    found.value = wanted_[i].functional == Functional::peak ? std::copysign(value, found.value) : value;
    return;
  }
  found.value = value, found.time = t, found.any = true, found.merit_then = merit_now;
}

void ExtremeRecorder::take_row(Found& found, const Snapshot& snapshot) const {
  found.row_time = found.time;
  found.row.clear();
  for (const Channel& channel : channels_) found.row.push_back(channel.value(snapshot));
}

std::vector<TrajectoryRecorder::Row> ExtremeRecorder::rows() const {
  std::vector<TrajectoryRecorder::Row> rows;
  for (const Found& found : found_)
    if (found.any && !found.row.empty()) rows.push_back({found.row_time, found.row});
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  rows.erase(std::unique(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.time == b.time; }),
             rows.end());
  return rows;
}

void ExtremeRecorder::sample(const Snapshot& snapshot, double t, Sample& out) const {
  out.t = t;
  out.value.resize(wanted_.size());
  out.rate.resize(wanted_.size());
  out.slope.resize(wanted_.size());
  out.argument.resize(wanted_.size());
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    out.value[i] = wanted_[i].value(snapshot);
    out.rate[i] = wanted_[i].rate ? wanted_[i].rate(snapshot) : 0;
    out.slope[i] = wanted_[i].slope ? wanted_[i].slope(snapshot) : HUGE_VAL;
    if (wanted_[i].argument) out.argument[i] = wanted_[i].argument(snapshot);
  }
}

void ExtremeRecorder::begin(double t, std::span<const double> y, Equations& equations) {
  const Snapshot& snapshot = equations.snapshot(t, y);
  sample(snapshot, t, last_);
  for (std::size_t i = 0; i < wanted_.size(); ++i) consider(i, t, last_.value[i]);
  if (channels_.empty()) return;
  for (Found& found : found_)
    if (found.time == t) take_row(found, snapshot);
}

void ExtremeRecorder::step(StepView& view) {
  const double t0 = view.t_previous(), t1 = view.t();
  const bool anew = view.begins_anew() || last_.t != t0;
  if (anew)
    sample(view.snapshot(t0), t0, first_);  // after an event the values may have jumped
  else
    std::swap(first_, last_);
  const Snapshot& end = view.snapshot(t1);
  sample(end, t1, last_);
  bool any = false;
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    if (wanted_[i].argument) learn_steepness(i);
    if (!wanted_[i].slope) last_.slope[i] = (last_.value[i] - first_.value[i]) / (t1 - t0);
    if (anew) consider(i, t0, first_.value[i]);
    consider(i, t1, last_.value[i]);
    any = any || may_be_beaten(i);
    if (!channels_.empty() && found_[i].time == t1) take_row(found_[i], end);
  }
  if (any) {
    sample(view.snapshot(0.5 * (t0 + t1)), 0.5 * (t0 + t1), middle_);
    for (std::vector<double>& values : beside_) values.clear();
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      if (may_be_beaten(i)) search(view, i);
  }
  if (channels_.empty()) return;
  for (Found& found : found_)
    if (found.any && (found.row.empty() || found.row_time != found.time) && found.time >= t0)
      take_row(found, view.snapshot(found.time));
}

// A change of the size of round-off has no meaning.
void ExtremeRecorder::learn_steepness(std::size_t i) {
  constexpr double above_rounding = 1e-9;
  const double change = std::abs(last_.value[i] - first_.value[i]);
  double& steepness = found_[i].steepness;
  if (change > above_rounding * std::abs(last_.value[i]))
    steepness = std::max(steepness, change / std::abs(last_.argument[i] - first_.argument[i]));
}

// A cubic through both ends with these slopes exceeds them by at most 4/27 h (|slope| + |slope|), half a sine wave between
// two zeros by 1/(2π) of h (|slope| + |slope|); the limit used is some seven times as large. A law
// rises by its argument's; twice as steeply as it did between samples, for one that is steeper between them. A value
// without slopes has the mean ones of this step and of the one before: infinite where it begins anew. Those of a wave that
// all steps meet at the same phase are none: it may exceed the ends by a quarter more than when it was examined.
bool ExtremeRecorder::may_be_beaten(std::size_t i) const {
  const double h = last_.t - first_.t, first = first_.slope[i], last = last_.slope[i];
  double reach = h * (std::abs(first) + std::abs(last));
  if (wanted_[i].argument)
    reach = found_[i].steepness > 0 ? 2 * found_[i].steepness * reach : HUGE_VAL;
  else if (!wanted_[i].slope)
    reach = std::max(reach, 1.25 * found_[i].hidden);
  else if (runs_straight(first, last, (last_.value[i] - first_.value[i]) / h))
    return false;
  return std::max(merit(i, first_.value[i]), merit(i, last_.value[i])) + reach > merit(i, found_[i].value);
}

// First at both ends; asked again, beside the middle.
void ExtremeRecorder::look_beside(StepView& view) {
  const double delta = beside * (last_.t - first_.t);
  const double time[] = {first_.t + delta, middle_.t - delta, middle_.t + delta, last_.t - delta};
  for (const std::size_t k : beside_[0].empty() ? std::array<std::size_t, 2>{0, 3} : std::array<std::size_t, 2>{1, 2}) {
    const Snapshot& snapshot = view.snapshot(time[k]);
    for (const ExtremeOf& wanted : wanted_) beside_[k].push_back(wanted.rate ? 0 : wanted.value(snapshot));
  }
}

// Searches an extreme within the step, only if it could exceed the known one.
void ExtremeRecorder::search(StepView& view, std::size_t i) {
  const double h = last_.t - first_.t;
  const double a = first_.value[i], m = middle_.value[i], b = last_.value[i];
  const double bend = a - 2 * m + b, tilt = b - a;
  // The parabola through the three samples reaches at most this far beyond the middle one.
  const double reach = std::abs(bend) + std::abs(tilt), at_ends = std::max(merit(i, a), merit(i, b));
  double& hidden = found_[i].hidden;
  hidden = std::max(0.5 * hidden, merit(i, m) - at_ends);
  if (std::max(at_ends, merit(i, m)) + reach <= merit(i, found_[i].value)) return;
  const auto rate = [&](double t) {
    if (wanted_[i].rate) return wanted_[i].rate(view.snapshot(t));
    const double after = wanted_[i].value(view.snapshot(std::min(t + beside * h, last_.t)));
    return after - wanted_[i].value(view.snapshot(std::max(t - beside * h, first_.t)));
  };
  double r0 = first_.rate[i], rm = middle_.rate[i], r1 = last_.rate[i];
  if (!wanted_[i].rate) {
    if (beside_[0].empty()) look_beside(view);
    r0 = beside_[0][i] - a, r1 = b - beside_[3][i];
    const bool is_law = static_cast<bool>(wanted_[i].argument);  // it may be steeper between the samples
    if (!is_law && runs_straight(r0 / beside, r1 / beside, tilt) && runs_straight(2 * (m - a), 2 * (b - m), tilt))
      return;
    if (beside_[1].empty()) look_beside(view);
    rm = beside_[2][i] - beside_[1][i];
  }
  for_each_turn(rate, {first_.t, r0}, {middle_.t, rm}, {last_.t, r1}, [&](double t) {
    const double value = wanted_[i].value(view.snapshot(t));
    hidden = std::max(hidden, merit(i, value) - at_ends);
    consider(i, t, value);
  });
}

// ---------------------------------------------------------------------------------------------------------------------

namespace {

// Done so far, per account [J].
std::vector<double> works(const Model& m, const Snapshot& s) {
  std::vector<double> work(m.accounts.size(), 0.0);
  if (s.quadrature) std::copy(s.quadrature, s.quadrature + work.size(), work.begin());
  return work;
}

// Of the motors' torques so far: ∫M dt and ∫M² dt each.
std::vector<double> motor_integrals(const Model& m, const Snapshot& s) {
  std::vector<double> integrals(2 * m.motors.size(), 0.0);
  const std::size_t begin = m.accounts.size() + 2 * m.torque_joints.size();
  if (s.quadrature) std::copy(s.quadrature + begin, s.quadrature + begin + integrals.size(), integrals.begin());
  return integrals;
}

double energy_of(Equations& equations, double t, std::span<const double> y) {
  return equations.kinetic_energy(t, y) + equations.stored_energy(t, y);
}

double link_speed(const Model& m, const Snapshot& s) {
  return m.angles[at(m.reduction_angle)].gain * s.now.speed[m.shaft_of_node[at(m.reduction_node)]];
}

}  // namespace

void CycleRecord::append(const CycleRecord& next) {
  const auto add = [](std::vector<double>& sum, const std::vector<double>& more) {
    std::transform(sum.begin(), sum.end(), more.begin(), sum.begin(), std::plus());
  };
  add(work, next.work), add(of_motors, next.of_motors);
  end = next.end, energy_after = next.energy_after, turned += next.turned;
  omega_max = std::max(omega_max, next.omega_max), omega_min = std::min(omega_min, next.omega_min);
}

void CycleRecorder::remember(Tape& tape) {
  tape(cycles_, low_, high_, sense_, open_, begin_, max_, min_, work_at_begin_, motors_at_begin_, energy_at_begin_,
       angle_at_begin_, repetition_);
  goes_on_ = tape.reading();
}

void CycleRecorder::begin(double t, std::span<const double> y, Equations& equations) {
  const Model& m = equations.model();
  cycle_ = m.cycle;
  if (idle() || goes_on_) return;
  const Snapshot& s = equations.snapshot(t, y);
  const double angle = equations.angle_with_turns(at(m.reduction_angle), y);
  const double place = period_ > 0 ? t : angle, length = period_ > 0 ? period_ : cycle_;
  const double nearest = length * std::round(place / length);
  if (std::abs(nearest - place) < 1e-9 && !of_sequence_) {  // starts on the boundary
    open_ = true;
    begin_ = t;
    angle_at_begin_ = angle;
    work_at_begin_ = works(m, s);
    motors_at_begin_ = motor_integrals(m, s);
    low_ = nearest - length;
    high_ = nearest + length;
  } else {
    low_ = length * std::floor(place / length);
    high_ = low_ + length;
  }
  max_ = min_ = link_speed(m, s);
  if (open_) energy_at_begin_ = energy_of(equations, t, y);
}

void CycleRecorder::see_speed(double omega) {
  max_ = std::max(max_, omega);
  min_ = std::min(min_, omega);
}

void CycleRecorder::pass(double t, int sense, StepView& view) {
  const Model& m = view.equations().model();
  const Snapshot& s = view.snapshot(t);
  std::vector<double> work = works(m, s), integrals = motor_integrals(m, s);
  const double omega = link_speed(m, s);
  see_speed(omega);
  const double energy = energy_of(view.equations(), t, view.at(t));
  const double angle = view.equations().angle_with_turns(at(m.reduction_angle), view.at(t));
  if (open_ && (sense_ == 0 || sense == sense_)) {
    CycleRecord record{begin_,         t,
                       max_,           min_,
                       work,           integrals,
                       work_at_begin_, energy_at_begin_,
                       energy,         period_ > 0 ? angle - angle_at_begin_ : sense * cycle_};
    for (std::size_t k = 0; k < work.size(); ++k) record.work[k] -= work_at_begin_[k];
    for (std::size_t k = 0; k < integrals.size(); ++k) record.of_motors[k] -= motors_at_begin_[k];
    cycles_.push_back(std::move(record));
  }
  open_ = true;
  begin_ = t;
  max_ = min_ = omega;
  work_at_begin_ = std::move(work);
  motors_at_begin_ = std::move(integrals);
  energy_at_begin_ = energy;
  angle_at_begin_ = angle;
  sense_ = sense;
  const double here = sense > 0 ? high_ : low_;
  low_ = sense > 0 ? here : here - cycle_;
  high_ = period_ > 0 ? period_ * (std::round(t / period_) + 1) : low_ + cycle_;
}

void CycleRecorder::step(StepView& view) {
  if (idle()) return;
  Equations& equations = view.equations();
  const Model& m = equations.model();
  const std::size_t tracked = at(m.reduction_angle);
  const int shaft = m.shaft_of_node[at(m.reduction_node)];
  const double gain = m.angles[tracked].gain;
  double from = view.t_previous();
  // The speed's slope is that of the steps' dense output, whose extremes are sought: at its ends what the stepper knows,
  // between them by differences. Only a prescribed speed is computed by the equations.
  const bool free = at(shaft) < m.free_shafts;
  const std::size_t state = free ? equations.speed_index(shaft) : 0;
  const auto speed = [&](double time) {
    return gain * (free ? view.at(time, state) : view.snapshot(time).now.speed[shaft]);
  };
  const auto alpha = [&](double time) {
    if (!free) return gain * view.snapshot(time).alpha[shaft];
    if (time == view.t_previous()) return gain * view.ydot_previous()[state];
    if (time == view.t()) return gain * view.ydot()[state];
    const double delta = 1e-3 * (view.t() - view.t_previous());
    const double before = std::max(time - delta, view.t_previous()), after = std::min(time + delta, view.t());
    return (speed(after) - speed(before)) / (after - before);
  };
  // An even number of extremes does not change the signs at the ends: points between are evaluated if the speed could exceed
  // the known range of the cycle (a cubic exceeds its ends by at most 4/27 h (|α₀| + |α₁|)).
  const auto extreme_until = [&](double t) {
    see_speed(speed(t));
    if (t > from) {
      const double a0 = alpha(from), a1 = alpha(t), w0 = speed(from), w1 = speed(t);
      const double reach = (t - from) * (std::abs(a0) + std::abs(a1));
      if ((std::max(w0, w1) + reach > max_ || std::min(w0, w1) - reach < min_) &&
          !runs_straight(a0, a1, (w1 - w0) / (t - from), closely)) {
        const int parts = free ? 8 : 2;  // samples of one state are cheap
        double before = a0;
        for (int k = 1; k <= parts; ++k) {
          const double begin = from + (t - from) * (k - 1) / parts, end = k < parts ? from + (t - from) * k / parts : t;
          const double now = k < parts ? alpha(end) : a1;
          see_speed(speed(end));
          if (before * now < 0) see_speed(speed(find_root(alpha, begin, before, end, now)));
          before = now;
        }
      }
    }
    from = t;
  };
  if (const double began = equations.modes().cycle_began; of_sequence_ && began <= view.t_previous()) {
    if (std::exchange(repetition_, began) != began) pass(from, 1, view);
    return extreme_until(view.t());
  }
  for (; period_ > 0 && !of_sequence_ && high_ <= view.t(); Deadline::check()) {
    const double border = high_;
    extreme_until(border);
    pass(border, 1, view);
  }
  if (period_ > 0) return extreme_until(view.t());
  // The multiple passed last is passed again, backwards, only after a reversal.
  constexpr double left_behind = 1e-9;
  const auto beyond = [&](double t, int sense) {
    const double angle = equations.angle_with_turns(tracked, view.at(t));
    return sense > 0 ? angle - high_ - (sense_ < 0 ? left_behind : 0) : low_ - angle - (sense_ > 0 ? left_behind : 0);
  };
  for (const int sense : {1, -1})
    while (beyond(view.t(), sense) >= 0) {
      Deadline::check();
      const auto above = [&](double t) { return beyond(t, sense); };
      const double b0 = above(from), b1 = above(view.t());
      const double crossing = b0 < 0 ? find_root(above, from, b0, view.t(), b1) : from;
      extreme_until(crossing);
      pass(crossing, sense, view);
    }
  extreme_until(view.t());
}

// ---------------------------------------------------------------------------------------------------------------------

void EnergyAudit::check(double t, std::span<const double> y, Equations& equations) {
  const double reduced = equations.kinetic_energy(t, y), bodies = equations.kinetic_energy_of_bodies(t, y);
  const double stored = equations.stored_energy(t, y);
  const std::size_t accounts = equations.model().accounts.size();
  std::vector<double> now(accounts, 0.0);
  for (std::size_t k = 0; k < accounts && equations.audit(); ++k) now[k] = y[equations.work_index(k)];
  double sum = 0;
  for (std::size_t k = 0; k < accounts; ++k) {
    sum += now[k];
    turnover += std::abs(now[k] - (work.empty() ? 0.0 : work[k]));
  }
  if (checked == 0) {
    kinetic_start = bodies;
    stored_start = stored;
    start_ = bodies + stored;
  }
  kinetic_end = bodies;
  stored_end = stored;
  largest_kinetic = std::max(largest_kinetic, bodies);
  least_scale_ = 1e-9 * equations.model().torque_scale;
  largest_residual = std::max(largest_residual, std::abs(bodies + stored - start_ - sum));
  equations.snapshot(t, y);
  if (const JointTorques::Open open = equations.open_bodies(); open.part > open_body.part) open_body = open;
  if (bodies > 1e-9 * largest_kinetic)
    reduction_residual = std::max(reduction_residual, std::abs(reduced / bodies - 1));
  work = std::move(now);
  ++checked;
}

void EnergyAudit::begin(double t, std::span<const double> y, Equations& equations) {
  if (checked == 0) check(t, y, equations);  // else it is a continuation
}

// At the end of the step in which checks fall due: dense output is of a lower order than the steps it lies between.
void EnergyAudit::step(StepView& view) {
  const auto due = [&](int k) { return k + 1 == checks_ ? until_ : until_ * k / (checks_ - 1); };
  int next = checked;
  while (next < checks_ && due(next) <= view.t()) ++next;
  if (next == checked) return;
  check(view.t(), view.y(), view.equations());
  checked = next;  // counts those that fell due together
}

double EnergyAudit::relative() const {
  const double scale = std::max({turnover, largest_kinetic, least_scale_});
  return scale > 0 ? largest_residual / scale : 0;
}

}  // namespace kurbel
