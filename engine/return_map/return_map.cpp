// return_map.cpp — one period from section to section, and its derivative.
#include "engine/return_map/return_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/index.h"
#include "engine/numerics/period.h"
#include "engine/return_map/sensitivities.h"

namespace kurbel {
namespace {

constexpr std::size_t most_unknowns = 400;   // the derivative is full
constexpr double overlap = 0.02;             // of a period, added to the first run
constexpr double slowest = 20;               // limit of a period's duration over that at the guessed speed
constexpr double difference_step = 2e-5;     // of unknowns of order one
constexpr std::int64_t dearest = 300;        // limit of a period's evaluations over those of the cheapest one
constexpr std::int64_t least_effort = 1000;  // evaluations; fewer are not representative of a period
constexpr double safely = 20;                // times a tolerance: error of a period
constexpr double loose_directions = 100;     // times the tolerance of the motion: that of variational equations
constexpr double grazes = 0.05;              // difference of one-sided differences, over their maximum

Eigen::Index entry(std::size_t i) { return static_cast<Eigen::Index>(i); }

// Positions of events: angles of the link at the ends of steps; and contacts that stick over the whole period.
class PeriodLog final : public Observer {
 public:
  explicit PeriodLog(const Model& m) : contacts_(contacts_of(m)), sticks_(contacts_.size(), 1) {}
  void begin(double t, std::span<const double> y, Equations& equations) override { see(t, y, equations); }
  void step(StepView& view) override { see(view.t(), view.y(), view.equations()); }
  double angle_at(double t) const {
    const auto after = std::lower_bound(time_.begin(), time_.end(), t - 1e-13 * std::max(1.0, t));
    return after == time_.end() ? angle_.back() : angle_[static_cast<std::size_t>(after - time_.begin())];
  }
  const std::vector<char>& sticks() const { return sticks_; }

 private:
  void see(double t, std::span<const double> y, Equations& e) {
    time_.push_back(t);
    angle_.push_back(e.angle_with_turns(at(e.model().reduction_angle), y));
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (sense_of(contacts_[c], e.modes()) != 0) sticks_[c] = 0;
  }
  std::vector<Contact> contacts_;
  std::vector<double> time_, angle_;
  std::vector<char> sticks_;
};

// Middle of the widest gap between angles on a circle.
double quiet_angle(std::vector<double> angles, double cycle, double without_events) {
  if (angles.empty()) return without_events;
  for (double& a : angles) a = place_within(a, cycle);
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles.front() + cycle);
  std::size_t widest = 0;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i)
    if (angles[i + 1] - angles[i] > angles[widest + 1] - angles[widest] + 1e-9) widest = i;
  return place_within(0.5 * (angles[widest] + angles[widest + 1]), cycle);
}

// A jam at a state that is not reached by integration.
ReturnMap::Image broken(const Jam& jam) {
  ReturnMap::Image image;
  image.why = jam.what();
  return image;
}

}  // namespace

ReturnMap::ReturnMap(std::shared_ptr<const Model> model, ReturnMapOptions options)
    : shared_(std::move(model)), options_(std::move(options)), equations_(shared_, false) {
  take_period(periodicity_of(*shared_, options_.clocked));
}

ReturnMap::ReturnMap(std::shared_ptr<const Model> model, ReturnMapOptions options, double own_period)
    : shared_(std::move(model)), options_(std::move(options)), equations_(shared_, false), own_period_(true) {
  Periodicity own;
  own.by_time = own.angle_matters = true;
  own.angle = 2 * std::numbers::pi;
  own.time = own_period / options_.cycles;
  take_period(own);
}

void ReturnMap::take_period(const Periodicity& periodicity) {
  if (options_.cycles < 1) throw std::invalid_argument(fmt::format("{} cycles; must be ≥ 1", options_.cycles));
  const Model& m = *shared_;
  if (const std::size_t unknowns = m.state_count() - m.angle_count(); unknowns > most_unknowns)
    throw std::invalid_argument(
        fmt::format("a steady cycle is sought for up to {} twists, speeds and internal states; this model has {}. "
                    "Switch elasticity off where it matters least (--effects), or simulate with kurbel run",
                    most_unknowns, unknowns));
  periodicity_ = periodicity;
  // The Jacobian of joints with friction is accurate enough for steps, not for derivatives.
  variational_ = contacts_of(m).empty() && m.scene.sequence.steps.empty() && !m.effects.joint_friction;
  set_pace(m.speed_scale);
}

void ReturnMap::set_pace(double link_speed) {
  sense_ = link_speed < 0 ? -1 : 1;
  const double pace = std::max(std::abs(link_speed), 0.02 * shared_->speed_scale);
  time_limit_ = slowest * periodicity_.angle * options_.cycles / pace;
}

void ReturnMap::go_through(State state, std::vector<char> sticks_throughout, double link_speed) {
  set_pace(link_speed);
  section_angle_ =
      place_within(kurbel::angle_with_turns(state.modes, at(shared_->reduction_angle), state.y), periodicity_.angle);
  section_.emplace(equations_, std::move(state), SectionOptions{!periodicity_.by_time, std::move(sticks_throughout)});
}

void ReturnMap::follow(const ReturnMap& other) {
  periodicity_ = other.periodicity_;  // which may be that of its own motion
  own_period_ = other.own_period_;
  section_ = other.section_;
  section_angle_ = other.section_angle_;
  sense_ = other.sense_;
  time_limit_ = other.time_limit_;
  most_flow_calls_ = other.most_flow_calls_;
}

// A trial far from any motion may take unlimited steps. The cheapest completed period defines the limit.
void ReturnMap::learn_effort(const RunOutcome& outcome) {
  const std::int64_t most = dearest * std::max(least_effort, outcome.statistics.stepper.flow_calls);
  most_flow_calls_ = most_flow_calls_ == 0 ? most : std::min(most_flow_calls_, most);
}

std::function<double(double, std::span<const double>)> ReturnMap::period_end(Equations& equations,
                                                                             std::span<const double> y,
                                                                             double periods) const {
  const std::size_t link = at(shared_->reduction_angle);
  if (periodicity_.by_time) return {};
  const double target = equations.angle_with_turns(link, y) + sense_ * periodicity_.angle * options_.cycles * periods;
  return [&equations, link, target, sense = sense_](double, std::span<const double> state) {
    return std::min(1.0, sense * (target - equations.angle_with_turns(link, state)));
  };
}

// Result of a period.
ReturnMap::Image ReturnMap::judge(const RunOutcome& outcome, double from, double link_begin,
                                  Equations& equations) const {
  const Model& m = *shared_;
  const std::size_t link = at(m.reduction_angle);
  Image image;
  image.time = outcome.t - from;
  if (outcome.state.empty()) {
    image.why = outcome.diagnosis;
    return image;
  }
  const std::span<const double> y(outcome.state.data(), equations.size());
  image.link_angle = equations.angle_with_turns(link, y);
  image.turned = image.link_angle - link_begin;
  if (section_) {
    image.z = section_->read(equations.modes(), y);
    image.missed = section_->missed(equations, image.z, y);
  }
  const std::string name = m.node_label(m.reduction_node);
  const double phi = place_within(image.link_angle, periodicity_.angle);
  const double speed = m.angles[link].gain * equations.snapshot(outcome.t, y).now.speed[m.angles[link].shaft] * sense_;
  if (!outcome.diagnosis.empty()) {
    image.end = options_.interrupted && options_.interrupted->load() ? End::interrupted : End::failed;
    image.why = outcome.diagnosis;
  } else if (outcome.stopped || periodicity_.by_time) {
    image.end = End::returned;
  } else if (std::abs(speed) < 1e-6 * m.speed_scale) {
    image.end = End::stands;
    image.why = fmt::format("\"{}\" comes to rest at {:.2f}° of its cycle and does not complete it", name,
                            phi * 180 / std::numbers::pi);
  } else if (sense_ * (image.link_angle - link_begin) < 0 || speed < 0) {
    image.end = End::turns_back;
    image.why = fmt::format("\"{}\" is stopped within the cycle and driven backwards", name);
  } else {
    image.end = End::too_slow;
    image.why = fmt::format("\"{}\" does not complete a cycle within {:.4g} s; it is at {:.2f}° of its cycle", name,
                            image.time, phi * 180 / std::numbers::pi);
  }
  return image;
}

RunOptions ReturnMap::run_options(double from, double until) const {
  RunOptions run{.tolerance = options_.tolerance,
                 .method = options_.method,
                 .until = until,
                 .budget = options_.budget,
                 .most_flow_calls = most_flow_calls_,
                 .interrupted = options_.interrupted,
                 .progress = {}};
  run.from = {from, {}};
  return run;
}

ReturnMap::Image ReturnMap::image(const Eigen::VectorXd& z, bool with_derivative,
                                  const std::vector<Observer*>& observers) {
  try {
    return image_of(z, with_derivative, observers);
  } catch (const Jam& jam) {
    return broken(jam);
  }
}

ReturnMap::Image ReturnMap::image_of(const Eigen::VectorXd& z, bool with_derivative,
                                     const std::vector<Observer*>& observers) {
  const std::vector<double> y = place(equations_, z);
  const double begin = equations_.angle_with_turns(at(shared_->reduction_angle), y), from = start_time();
  const bool variational = with_derivative && variational_;
  Sensitivities sensitivities(equations_, variational ? size() : 0, loose_directions);
  RunOptions run = run_options(from, from + (periodicity_.by_time ? periodicity_.time * options_.cycles : time_limit_));
  run.stop = period_end(equations_, y);
  run.from->y = variational ? sensitivities.start(y, section_->directions()) : y;
  if (variational) run.extension = &sensitivities;
  const RunOutcome outcome = integrate(equations_, run, observers);
  cost_ += options_.cycles * (variational ? derivative_cost() : 1.0);
  Image image = judge(outcome, from, begin, equations_);
  if (image.end != End::returned) return image;
  learn_effort(outcome);
  in_step_with_sequence(outcome, image);
  if (!with_derivative) return image;
  if (!variational) {
    differentiate(z, image);
    return image;
  }
  std::vector<double> rate(equations_.size());
  equations_.flow(outcome.t, std::span(outcome.state).first(equations_.size()), rate);
  image.derivative = section_->read_at_end(sensitivities.matrix(outcome.state), rate, image.slowing);
  image.uncertain = safely * loose_directions * options_.tolerance;
  image.grazed = sensitivities.grazed();
  return image;
}

// A repeated sequence defines the end of a period: at the same time after a command as its begin. If a step waits for the
// motion, the period is known only approximately; the motion is followed back by the excess time.
void ReturnMap::in_step_with_sequence(const RunOutcome& outcome, Image& image) {
  const Modes &now = equations_.modes(), &then = section_->state().modes;
  if (!own_period_ || !repeats_freely(shared_->scene.sequence, options_.clocked) || now.next_step != then.next_step)
    return;
  const double late = (outcome.t - now.last_step_time) - (section_->state().t - then.last_step_time);
  std::vector<double> rate(equations_.size());
  equations_.flow(outcome.t, std::span(outcome.state).first(equations_.size()), rate);
  image.z -=
      late * section_->read_directions(Eigen::Map<const Eigen::VectorXd>(rate.data(), section_->directions().rows()));
  image.time -= late;
}

// If contacts stick and slip within the period, time edges depend on the state, or a jam ends the motion, central
// differences of the map include all of this. Without an image of a neighbouring point there is no derivative.
void ReturnMap::differentiate(const Eigen::VectorXd& z, Image& image) {
  const Eigen::VectorXd here = image.z;
  image.derivative = Eigen::MatrixXd::Zero(z.size(), z.size());
  image.slowing = Eigen::RowVectorXd::Zero(z.size());
  double bend = 0;
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const Image above = this->image(z + difference_step * Eigen::VectorXd::Unit(z.size(), j), false);
    const Image below = this->image(z - difference_step * Eigen::VectorXd::Unit(z.size(), j), false);
    for (const Image* beside : {&above, &below})
      if (beside->end != End::returned) {
        image.end = beside->end;
        image.why = "beside it: " + beside->why;
        return;
      }
    image.derivative.col(j) = (above.z - below.z) / (2 * difference_step);
    image.slowing[j] = (above.time - below.time) / (2 * difference_step);
    bend = std::max(bend, (above.z - 2 * here + below.z).cwiseAbs().maxCoeff() / difference_step);
  }
  image.uncertain = safely * options_.tolerance / difference_step + bend * difference_step;
  image.grazed = bend > grazes * std::max(1.0, image.derivative.cwiseAbs().maxCoeff());
}

ReturnMap::Image ReturnMap::approach(double link_speed) {
  const Model& m = *shared_;
  const StartSettings& start = m.scene.run.start;
  const int on = start.on.empty() ? m.reduction_node : m.network.ports.at(start.on).in;
  StartSettings settings{};
  settings.equilibrium = true;
  settings.angle = start.angle / m.node_ratio[at(on)];
  settings.speed = link_speed;
  const double from = std::max(0.0, periodicity_.settled_from);
  if (prescribed_node(m) >= 0) return approach_as_given(from);
  std::vector<double> y = equations_.start(from, settings);
  return approach_from({from, std::move(y), equations_.modes()});
}

// A prescribed speed defines the rotation of the machine over the period of its law.
ReturnMap::Image ReturnMap::approach_as_given(double from) {
  RunOptions run = run_options(0, from);
  run.tolerance = std::max(options_.tolerance, 1e-9);
  run.from->y = equations_.start(0);
  if (from == 0) return approach_from({0, run.from->y, equations_.modes()});
  const RunOutcome outcome = integrate(equations_, run, {});
  if (!outcome.complete) return judge(outcome, 0, 0, equations_);
  return approach_from({outcome.t, outcome.state, equations_.modes()});
}

ReturnMap::Image ReturnMap::approach_from(State state) {
  try {
    return period_from(std::move(state));
  } catch (const Jam& jam) {
    return broken(jam);
  }
}

Eigen::VectorXd ReturnMap::along_the_motion(const Eigen::VectorXd& z) {
  const bool clocked = shared_->scene.sequence.repeat || periodicity_of(*shared_).by_time;
  if (!own_period_ || clocked) return Eigen::VectorXd::Zero(z.size());
  const std::vector<double> y = place(equations_, z);
  std::vector<double> rate(equations_.size());
  equations_.flow(start_time(), y, rate);
  return section_->read_directions(Eigen::Map<const Eigen::VectorXd>(rate.data(), section_->directions().rows()));
}

ReturnMap::Image ReturnMap::period_from(State state) {
  const Model& m = *shared_;
  equations_.bind(state.modes);
  const auto link_speed = [&](double t, std::span<const double> y) {
    const TrackedAngle& link = m.angles[at(m.reduction_angle)];
    return link.gain * equations_.snapshot(t, y).now.speed[link.shaft];
  };
  set_pace(link_speed(state.t, state.y));
  section_.reset();
  const double round = periodicity_.time * options_.cycles;
  const double begin = equations_.angle_with_turns(at(m.reduction_angle), state.y);
  PeriodLog log(m);
  RunOptions run = run_options(state.t, state.t + (periodicity_.by_time ? round : time_limit_));
  run.tolerance = std::max(options_.tolerance, 1e-9);
  run.from->y = state.y;
  run.stop = period_end(equations_, state.y, 1 + overlap);  // detects an event at the begin
  const RunOutcome first = integrate(equations_, run, {&log});
  cost_ += options_.cycles;
  Image image = judge(first, state.t, begin, equations_);
  if (image.end != End::returned) return image;
  learn_effort(first);
  const double pace = link_speed(first.t, first.state);
  if (periodicity_.by_time) {
    go_through({first.t, first.state, equations_.modes()}, log.sticks(), pace);
  } else {
    std::vector<double> angles;
    for (const Event& e : first.events) angles.push_back(log.angle_at(e.t));
    const double here = image.link_angle,
                 quiet = quiet_angle(angles, periodicity_.angle, place_within(begin, periodicity_.angle));
    double way = std::fmod(sense_ * (quiet - here), periodicity_.angle);  // on to the section
    if (way < 1e-6) way += periodicity_.angle;
    run = run_options(first.t, first.t + time_limit_);
    run.tolerance = std::max(options_.tolerance, 1e-9);
    run.from->y = first.state;
    run.stop = period_end(equations_, first.state, way / (periodicity_.angle * options_.cycles));
    const RunOutcome second = integrate(equations_, run, {});
    cost_ += way / periodicity_.angle;
    image = judge(second, first.t, here, equations_);
    if (image.end != End::returned) return image;
    go_through({second.t, second.state, equations_.modes()}, log.sticks(), pace);
  }
  image.z = Eigen::VectorXd::Zero(entry(size()));
  return image;
}

}  // namespace kurbel
