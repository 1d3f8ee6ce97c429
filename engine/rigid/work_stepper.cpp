// work_stepper.cpp — steps over the angle, landing on edges and on times; over time near rest.
#include "engine/rigid/work_stepper.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/numerics/period.h"
#include "engine/steppers/butcher_tables.h"

namespace kurbel {
namespace {

// T/|M| is the angle within which the torque would bring the machine to rest, or brought it out of rest.
constexpr double enter_angle = 0.2, leave_angle = 0.1;  // [rad]
constexpr double least_speed = 1e-4;                    // of the speed's scale
constexpr double quarter = 0.5 * std::numbers::pi;      // longest step over time [rad]
// And over the angle: an estimate of the error that vanishes by chance would let a step of this machine grow to half a turn.
constexpr double sixth_turn = std::numbers::pi / 3;
constexpr double two_turns = 4 * std::numbers::pi;
constexpr double same_place = 1e-10;  // [rad]

std::shared_ptr<WorkTables> made(std::shared_ptr<WorkTables> tables, const Equations& equations) {
  return tables ? tables : std::make_shared<WorkTables>(equations.shared_model());
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------------------
// The machine over its angle

MotionOverAngle::MotionOverAngle(Equations& equations, WorkTables& tables)
    : equations_(equations),
      tables_(tables),
      model_(equations.model()),
      quadratures_(equations.size() - model_.state_count()),
      speed_index_(equations.speed_index(0)),
      link_(static_cast<std::size_t>(model_.reduction_angle)),
      begin_(equations.size()),
      looked_up_(model_.angle_count()),
      y_(equations.size()),
      ydot_(equations.size()) {}

// Turns are apart from the remainder by two turns each; a longer cycle needs them all.
double MotionOverAngle::place_of(std::span<const double> y) const {
  const double cycle = tables_.machine().cycle();
  const bool within_two_turns = cycle < 4.5 * std::numbers::pi;
  const double phi = within_two_turns ? y[link_] : equations_.angle_with_turns(link_, y);
  return place_within(direction_ * phi, cycle);
}

double MotionOverAngle::inertia(double turned) const {
  if (diagram_) return diagram_->inertia(place(turned));
  return tables_.machine().constant_inertia() + tables_.machine().mechanism_inertia(direction_ * place(turned)).value;
}

void MotionOverAngle::start(double t, std::span<const double> y, std::span<double> x) {
  std::copy(y.begin(), y.end(), begin_.begin());
  // Every element repeats after two turns of its own: small angles are quicker to look up.
  for (std::size_t i = 0; i < model_.angles.size(); ++i) looked_up_[i] = place_within(begin_[i], two_turns);
  const double omega = y[speed_index_];
  direction_ = omega >= 0 ? 1 : -1;
  const WorkOverAngle* before = diagram_;
  diagram_ = tables_.of_angle_alone() ? &tables_.diagram(direction_) : nullptr;
  place_ = place_of(y);
  const double kinetic = 0.5 * inertia(0) * omega * omega;
  if (diagram_) {
    const double cycles = std::round((end_place_ - place_) / diagram_->cycle());
    const bool goes_on = diagram_ == before && omega == end_speed_ &&
                         std::abs(end_place_ - cycles * diagram_->cycle() - place_) < same_place;
    energy_ = goes_on ? energy_ + cycles * diagram_->work_per_cycle() : kinetic - diagram_->work(place_);
  }
  x[0] = diagram_ ? 0 : kinetic;
  x[1] = t;
  std::copy(y.end() - static_cast<std::ptrdiff_t>(quadratures_), y.end(), x.begin() + 2);
}

void MotionOverAngle::end(double turned, std::span<const double> y) {
  end_place_ = place(turned);
  end_speed_ = y[speed_index_];
}

double MotionOverAngle::kinetic(double turned, std::span<const double> x) const {
  return diagram_ ? energy_ + diagram_->work(place(turned)) : x[0];
}

double MotionOverAngle::speed(double turned, std::span<const double> x) const {
  return std::sqrt(2 * kinetic(turned, x) / inertia(turned));
}

void MotionOverAngle::state(double turned, std::span<const double> x, std::span<double> y) const {
  for (std::size_t i = 0; i < model_.angles.size(); ++i) y[i] = begin_[i] + model_.angles[i].gain * direction_ * turned;
  y[speed_index_] = direction_ * speed(turned, x);
  std::copy(x.begin() + 2, x.end(), y.begin() + static_cast<std::ptrdiff_t>(model_.state_count()));
}

// dT/ds = ±(I_r ε + ½ I_r′ ω²), dt/ds = 1/|ω|, dq/ds = q̇/|ω|
void MotionOverAngle::flow(double turned, std::span<const double> x, std::span<double> rate) {
  for (std::size_t i = 0; i < model_.angles.size(); ++i)
    y_[i] = looked_up_[i] + model_.angles[i].gain * direction_ * turned;
  if (diagram_) {
    const double omega = std::sqrt(2 * (energy_ + diagram_->work(place(turned))) / diagram_->inertia(place(turned)));
    rate[0] = 0;
    rate[1] = 1 / omega;
    y_[speed_index_] = direction_ * omega;
    if (quadratures_ > 0) equations_.flow(x[1], y_, ydot_);
  } else {
    const RigidMachine& machine = tables_.machine();
    const auto [em, slope] = machine.mechanism_inertia(direction_ * place(turned));
    const double inertia = machine.constant_inertia() + em, omega = std::sqrt(2 * x[0] / inertia);
    y_[speed_index_] = direction_ * omega;
    equations_.flow(x[1], y_, ydot_);
    rate[0] = direction_ * (inertia * ydot_[speed_index_] + 0.5 * slope * omega * omega);
    rate[1] = 1 / omega;
  }
  for (std::size_t q = 0; q < quadratures_; ++q) rate[2 + q] = ydot_[model_.state_count() + q] * rate[1];
}

// An error of ω in its scale, and of t in that of an angle of 1 rad.
ErrorControl MotionOverAngle::error_control(double tolerance) const {
  ErrorControl control{tolerance, {}};
  const double omega = model_.speed_scale;
  control.scale.push_back(tables_.of_angle_alone() ? 0 : model_.shafts[0].mean_inertia * omega * omega);
  control.scale.push_back(1 / omega);
  control.scale.resize(size(), 0.0);
  return control;
}

// ---------------------------------------------------------------------------------------------------------------------
// Steps

WorkStepper::WorkStepper(Equations& equations, const ErrorControl& control, std::shared_ptr<WorkTables> tables)
    : equations_(equations),
      tables_(made(std::move(tables), equations)),
      motion_(equations, *tables_),
      over_time_(dormand_prince_853(), equations, control),
      over_angle_(dormand_prince_853(), motion_, motion_.error_control(control.tolerance)),
      y_(equations.size()),
      y_previous_(equations.size()),
      x_(motion_.size()) {}

void WorkStepper::start(double t, std::span<const double> y) {
  t_ = t_previous_ = t;
  std::copy(y.begin(), y.end(), y_.begin());
  y_previous_ = y_;
  at_edge_ = begun_ = false;
}

// T > angle · |M|, and not so slow that 1/ω is meaningless.
bool WorkStepper::regular(double least_angle) {
  const Model& m = equations_.model();
  const double omega = y_[equations_.speed_index(0)];
  if (!(std::abs(omega) > least_speed * m.speed_scale)) return false;
  if (by_angle_ && begun_ && !tables_->of_angle_alone())  // known from the step's end
    return over_angle_.y()[0] > least_angle * std::abs(over_angle_.ydot()[0]);
  const auto [torque, inertia] = equations_.shaft_balance(0, t_, y_);
  const double phi = y_[static_cast<std::size_t>(m.reduction_angle)];
  const double slope = m.shafts[0].variable ? tables_->machine().mechanism_inertia(phi).slope : 0;
  return 0.5 * inertia * omega * omega > least_angle * std::abs(torque + 0.5 * slope * omega * omega);
}

void WorkStepper::step(double t_limit) {
  const bool angle = regular(by_angle_ ? leave_angle : enter_angle);
  if (angle != by_angle_) begun_ = false;
  by_angle_ = angle;
  std::copy(y_.begin(), y_.end(), y_previous_.begin());
  t_previous_ = t_;
  at_edge_ = landed_ = false;
  try {
    if (by_angle_) step_over_angle(t_limit);
  } catch (const StepFailure&) {  // a torque so steep that it brings the machine to rest within the step
    by_angle_ = begun_ = false;
  }
  if (!by_angle_) step_over_time(t_limit);
  begun_ = true;
  count();
}

// At most a quarter turn, as in a step over the angle, so that no guard falls and rises undetected.
void WorkStepper::step_over_time(double t_limit) {
  if (!begun_) over_time_.start(t_, y_);
  const double omega = std::abs(y_[equations_.speed_index(0)]);
  over_time_.step(omega > 0 ? std::min(t_limit, t_ + quarter / omega) : t_limit);
  t_ = over_time_.t();
  std::copy(over_time_.y().begin(), over_time_.y().end(), y_.begin());
}

void WorkStepper::step_over_angle(double t_limit) {
  if (!begun_) {
    motion_.start(t_, y_, x_);
    over_angle_.start(0, x_);
    edge_ = 0;
  }
  const double stop = next_stop();
  over_angle_.step(stop);
  if (over_angle_.y()[1] > t_limit) return land(t_limit);
  t_ = over_angle_.y()[1];
  at_edge_ = over_angle_.t() == edge_;
  motion_.state(over_angle_.t(), over_angle_.y(), y_);
  motion_.end(over_angle_.t(), y_);
}

// The next edge; at most half a turn ahead, for the search of extremes within a step.
double WorkStepper::next_stop() {
  const double turned = over_angle_.t(), cycle = tables_->machine().cycle();
  if (turned >= edge_) {
    const std::vector<double>& edges = tables_->edges(motion_.direction());
    double s = std::fmod(motion_.place(turned), cycle);
    if (s > cycle - same_place) s -= cycle;
    const auto next = std::upper_bound(edges.begin(), edges.end(), s + same_place);
    edge_ = edges.empty() ? HUGE_VAL : turned + (next == edges.end() ? edges.front() + cycle : *next) - s;
  }
  return std::min(edge_, turned + sixth_turn);
}

// The angle turned at a time within the step: Hermite's cubic through the ends, then Newton's method on the dense
// output with the speed on the chord of the last two points.
double WorkStepper::turned_at(double t) {
  double low = over_angle_.t_previous(), high = over_angle_.t();
  const double t0 = over_angle_.y_previous()[1], h = over_angle_.y()[1] - t0, turn = high - low;
  const double v0 = h / over_angle_.ydot_previous()[1], v1 = h / over_angle_.ydot()[1], x = (t - t0) / h;
  double turned = low + x * (turn + (1 - x) * (v0 - turn + x * (2 * turn - v0 - v1)));
  double speed = (v0 + x * (v1 - v0)) / h;
  turned = std::clamp(turned, low, high);
  double error = over_angle_.interpolate(turned, 1) - t;
  for (int i = 0; i < 50; ++i) {
    (error > 0 ? high : low) = turned;
    double better = turned - error * speed;
    if (!(better >= low && better <= high)) better = 0.5 * (low + high);
    if (std::abs(better - turned) <= 4e-16 * std::max(1.0, turned)) return better;
    const double error_there = over_angle_.interpolate(better, 1) - t;
    if (error_there == 0) return better;
    if (std::abs(error_there) < 0.1 * std::abs(error)) speed = (better - turned) / (error_there - error);
    turned = better;
    error = error_there;
  }
  return turned;
}

// An exact step that ends at the time t.
void WorkStepper::land(double t) {
  const double last = over_angle_.t();
  double turned = turned_at(t);
  for (int i = 0; i < 4; ++i) {
    over_angle_.retake(std::clamp(turned, over_angle_.t_previous(), last));
    const double error = t - over_angle_.y()[1];
    if (std::abs(error) <= 4e-16 * std::max(std::abs(t), 1e-3)) break;
    turned = over_angle_.t() + error * motion_.speed(over_angle_.t(), over_angle_.y());
  }
  t_ = t;
  at_edge_ = false;
  landed_ = true;
  motion_.state(over_angle_.t(), over_angle_.y(), y_);
  motion_.end(over_angle_.t(), y_);
}

void WorkStepper::retake(double t) {
  if (by_angle_) return land(t);
  over_time_.retake(t);
  t_ = over_time_.t();
  std::copy(over_time_.y().begin(), over_time_.y().end(), y_.begin());
}

void WorkStepper::interpolate(double t, std::span<double> y) {
  if (t >= t_) return void(std::copy(y_.begin(), y_.end(), y.begin()));
  if (t <= t_previous_) return void(std::copy(y_previous_.begin(), y_previous_.end(), y.begin()));
  if (!by_angle_) return over_time_.interpolate(t, y);
  const double turned = turned_at(t);
  over_angle_.interpolate(turned, x_);
  motion_.state(turned, x_, y);
}

// Over the angle the states are T and t; an error of either is one of the speed.
StepLimit WorkStepper::limited_by() {
  if (!by_angle_) return over_time_.limited_by();
  if (landed_) return {};
  return {over_angle_.limited_by().by, equations_.speed_index(0)};
}

void WorkStepper::count() {
  const StepperStatistics &a = over_angle_.statistics(), &t = over_time_.statistics();
  statistics_.steps = a.steps + t.steps;
  statistics_.rejected = a.rejected + t.rejected;
  statistics_.flow_calls = a.flow_calls + t.flow_calls;
  statistics_.restarts = a.restarts + t.restarts;
}

std::span<const double> WorkStepper::slope(double t, std::span<const double> y, std::vector<double>& ydot) const {
  ydot.resize(y.size());
  equations_.flow(t, y, ydot);
  return ydot;
}

std::unique_ptr<Stepper> make_work_stepper(Equations& equations, const ErrorControl& control,
                                           std::shared_ptr<WorkTables> tables) {
  return std::make_unique<WorkStepper>(equations, control, std::move(tables));
}

}  // namespace kurbel
