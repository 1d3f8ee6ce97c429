// run.cpp — the event loop: step, check the guards, return to the first event, change modes, continue.
#include "engine/run/run.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "engine/events/event_words.h"
#include "engine/numerics/deadline.h"
#include "engine/rigid/work_stepper.h"
#include "engine/run/checkpoint.h"
#include "engine/run/diagnosis.h"
#include "engine/run/event_location.h"
#include "engine/run/flush_denormals.h"
#include "engine/run/method_choice.h"
#include "engine/run/time_to_turn.h"

namespace kurbel {
namespace {

constexpr int most_events_at_once = 100;
// So many events at one instant without a continuation: the motion jams. Far more than contacts that change together.
constexpr int events_of_a_jam = 20;
// An implicit method stops before a jam; limit of explicit steps to reach it.
constexpr int steps_to_a_jam = 500;
// So many events while the machine turns by no more than this angle are chattering: decaying bouncing, a switching
// contact. Their elements then get laws without events.
constexpr std::size_t restless_events = 60;
constexpr double restless_angle = 1e-6;  // [rad] at the speed scale

class Loop {
 public:
  Loop(Equations& equations, const RunOptions& options, const std::vector<Observer*>& observers)
      : equations_(equations),
        options_(options),
        observers_(observers),
        system_(options.extension ? static_cast<OdeSystem&>(*options.extension) : equations),
        view_(equations, system_.size()),
        location_(equations, options, system_.size()),
        choice_(equations, options, memory_) {}

  RunOutcome run() {
    begin_ = processor_time();
    method_ = choice_.first();
    try {
      const Deadline deadline(options_.budget, options_.interrupted);
      start();
      while (!out_.stopped && stepper_->t() < options_.until && advance_or_jam()) {
      }
      out_.complete = !broken_;
    } catch (const OutOfTime& over) {
      stop_at(over);
    } catch (const StepFailure& failure) {
      broken_ = {failure.not_finite ? Breakdown::Kind::not_finite : Breakdown::Kind::collapse, failure.time,
                 failure.what(), failure.state};
    } catch (const std::runtime_error& error) {  // an element without solution, such as jamming joints
      broken_ = {.t = stepper_ ? stepper_->t() : 0, .why = error.what()};
    }
    finish();
    return std::move(out_);
  }

 private:
  void start() {
    if (options_.checkpoint) return go_on(*options_.checkpoint);
    const double t = options_.from ? options_.from->t : 0;
    const std::vector<double> y = options_.from ? options_.from->y : equations_.start(0);
    out_.limits.begin(system_.size(), location_.guard_count());
    make(method_, t, y);
    for (Observer* observer : observers_) observer->begin(t, stepper_->y(), equations_);
  }

  void go_on(const Checkpoint& checkpoint) {
    const double first_two_turns = equations_.modes().first_two_turns;
    equations_.bind(checkpoint.state.modes);
    equations_.keep_angles_from(first_two_turns);
    std::vector<double> y = checkpoint.state.y;
    y.insert(y.end(), checkpoint.integrals.begin(), checkpoint.integrals.end());
    y.resize(system_.size());
    equations_.wrap(y);  // the base of angles may have changed
    memory_ = checkpoint.loop;
    method_ = choice_.resumed(method_);
    out_.limits.begin(system_.size(), location_.guard_count());
    make(method_, checkpoint.state.t, y);
    recall(observers_, checkpoint.observers);
    for (Observer* observer : observers_) observer->begin(checkpoint.state.t, stepper_->y(), equations_);
  }

  Checkpoint checkpoint() const {
    Checkpoint here{{out_.t, out_.state, equations_.modes()}, {}, memory_, {}};
    if (options_.to_go_on) here.observers = memory_of(observers_);
    const std::size_t states = equations_.size() - (equations_.audit() ? equations_.integral_count() : 0);
    here.integrals.assign(out_.state.begin() + static_cast<std::ptrdiff_t>(states), out_.state.end());
    here.state.y.resize(states);
    here.loop.implicit = choice_.is_implicit(before_jam_.value_or(method_));
    return here;
  }

  void make(Method method, double t, std::span<const double> y) {
    if (stepper_) add_statistics();
    ErrorControl control = options_.extension ? options_.extension->error_control(options_.tolerance)
                                              : equations_.error_control(options_.tolerance);
    if (is_of_library(method)) control_quadratures(control);
    stepper_ = method == Method::work_equation ? make_work_stepper(equations_, control, options_.work_tables)
                                               : make_stepper(method, system_, control);
    method_ = method;
    view_.watch(*stepper_);
    location_.watch(*stepper_, is_of_library(method));
    restart(t, y);
  }

  void go_on_with(Method method) { make(method, stepper_->t(), reached()); }

  // Newton's iteration ends when the controlled states are constant, with quadratures one iterate behind; and a method that
  // starts at order 1 integrates uniform acceleration without an error estimate of its work.
  void control_quadratures(ErrorControl& control) const {
    if (!equations_.audit()) return;
    const Model& m = equations_.model();
    const auto control_at = [&](std::size_t k, double scale) {
      if (control.scale[k] == 0) control.scale[k] = scale;
    };
    for (std::size_t k = 0; k < m.accounts.size(); ++k)
      control_at(equations_.work_index(k), m.torque_scale);  // per radian
    const double a_radian = 100 / m.speed_scale;  // squares grow far beyond that of the rated torque, as in resonance
    for (std::size_t i = 0; i < m.torque_joints.size(); ++i)
      for (const bool spring : {false, true})
        control_at(equations_.square_index(i, spring), a_radian * std::pow(m.torque_joints[i].torque_scale, 2));
    for (std::size_t i = 0; i < m.motors.size(); ++i)
      for (const bool squared : {false, true})
        control_at(equations_.motor_index(i, squared), a_radian * std::pow(m.motors[i].rated_torque, squared ? 2 : 1));
  }

  void restart(double t, std::span<const double> y) {
    state_.assign(y.begin(), y.end());
    stepper_->start(t, state_);
    view_.set_anew(true);
    location_.begin(t, state_);
    edge_ = equations_.next_edge(t);
    if (edge_ <= t) broken_clock(t);
  }

  std::vector<double> reached() const { return {stepper_->y().begin(), stepper_->y().end()}; }

  // Continues after the changes at this time; the events after the known ones belong to them.
  bool go_on_from(double t, std::vector<double>& y, std::size_t known) {
    note_angle(known, y);
    equations_.wrap(y);
    restart(t, y);
    return true;
  }

  // Steps of a repeated sequence that never wait.
  [[noreturn]] static void broken_clock(double t) {
    throw std::runtime_error(
        fmt::format("the operating sequence repeats without a pause at {:.9g} s: all its steps are due at once, and "
                    "the first one again; let one of them wait for a time, an angle or a speed",
                    t));
  }

  // A step may end at a jam without failing; it is then detected by the evaluation after the step.
  bool advance_or_jam() {
    try {
      return advance();
    } catch (const Jam&) {
      if (stop_by_jam()) return true;
      const std::vector<double> before(stepper_->y_previous().begin(), stepper_->y_previous().end());
      restart(stepper_->t_previous(), before);
      throw;
    }
  }

  // One step with all changes at its end. False: the run ends here.
  bool advance() {
    look_at_time();
    const double until = memory_.shortened > 0 ? std::min(limit(), stepper_->t() + memory_.shortened) : limit();
    if (!(until > stepper_->t()))
      throw std::runtime_error("the motion is too fast: a quarter turn takes less than the rounding of the time");
    try {
      stepper_->step(until);
    } catch (const StepFailure& failure) {
      if (equations_.jam() && pass_jam()) return true;
      if (failure.not_finite && equations_.jam()) throw Jam(*equations_.jam());  // a prescribed motion does not stop
      if (failure.not_finite) throw;
      const auto other = choice_.after_failure(stepper_->t(), method_, failure.what());
      if (!other) throw;
      go_on_with(*other);
      return true;
    }
    if (equations_.jam()) equations_.forget_jam();  // only a trial step was too long
    const StepLimit limited_by = stepper_->limited_by();
    memory_.last_step = stepper_->t() - stepper_->t_previous();
    const std::vector<std::size_t> fired = location_.find();
    if (fired.empty()) {
      memory_.shortened = 0;
      out_.limits.count(limited_by, stepper_->at_edge() ? StepLimits::Bound::edge : bound_);
    } else {
      out_.limits.count_event(fired.front());
    }
    if (!location_.at_begin() && stepper_->t() > stepper_->t_previous()) {  // a discarded step is not observed
      for (Observer* observer : observers_) observer->step(view_);
      view_.set_anew(false);
    }
    const double t = stepper_->t();
    if (!fired.empty()) return pass_event(t, fired);
    if (t < until && !stepper_->at_edge()) note_step(t - stepper_->t_previous());
    if (t >= edge_) {
      std::vector<double> y = reached();
      const std::size_t known = out_.events.size();
      equations_.pass_edge(t, y, out_.events);
      return go_on_from(t, y, known);
    }
    if (equations_.needs_wrap(stepper_->y())) {
      std::vector<double> y = reached();
      return go_on_from(t, y, out_.events.size());
    }
    location_.go_on();
    if (before_jam_ && ++steps_to_jam_ > steps_to_a_jam) return resume();
    if (const auto other = choice_.after(*stepper_, method_)) go_on_with(*other);
    return true;
  }

  void note_step(double h) {
    if (double& smallest = out_.statistics.smallest_step; smallest == 0 || h < smallest) smallest = h;
  }

  // Steps end at known edges and rotate mechanisms by at most a quarter turn, so that no guard falls and rises
  // undetected.
  double limit() {
    double t = std::min(options_.until, edge_);
    bound_ = edge_ <= options_.until ? StepLimits::Bound::edge : StepLimits::Bound::until;
    if (stepper_->ends_on_edges()) return t;
    const Model& m = equations_.model();
    for (const TrackedAngle& angle : m.angles) {
      const auto shaft = static_cast<std::size_t>(angle.shaft);
      if (equations_.guard_count() == 0 && (!m.shafts[shaft].variable || shaft >= m.free_shafts)) continue;
      const double turned =
          stepper_->t() + time_to_turn(equations_, angle, (options_.elsewhere ? 0.4 : 0.5) * M_PI, *stepper_);
      if (!(turned < t)) continue;
      t = turned;
      bound_ = StepLimits::Bound::turn;
    }
    return t;
  }

  bool pass_event(double t, std::vector<std::size_t> fired) {
    const bool at_begin = location_.take_at_begin();
    if (options_.stop && fired.back() == equations_.guard_count()) {
      out_.stopped = true;
      if (at_begin) {
        const std::vector<double> before(stepper_->y_previous().begin(), stepper_->y_previous().end());
        restart(stepper_->t_previous(), before);
      }
      return false;
    }
    const double time = at_begin ? stepper_->t_previous() : t;
    const std::span<const double> source = at_begin ? stepper_->y_previous() : stepper_->y();
    std::vector<double> y(source.begin(), source.end());
    memory_.events_here =
        time - memory_.last_event <= 1e-13 * std::max(1.0, std::abs(time)) ? memory_.events_here + 1 : 0;
    memory_.last_event = time;
    const bool at_knots =
        std::all_of(fired.begin(), fired.end(), [&](std::size_t guard) { return equations_.is_knot(guard); });
    ++(at_knots ? out_.statistics.knots : out_.statistics.events);
    // A motion that ends at its begin may be missed by a coarse step: it is repeated with a shorter one.
    if (at_begin && memory_.events_here >= 2)
      memory_.shortened = std::max(0.1 * memory_.last_step, 1e-12 * std::max(1.0, std::abs(time)));
    if (memory_.events_here == events_of_a_jam && !options_.extension) {
      const std::size_t known = out_.events.size();
      if (equations_.stop_jam(time, y, fired, out_.events)) return go_on_from(time, y, known);
    }
    if (memory_.events_here > most_events_at_once) {
      const std::string owner = fired.front() < equations_.guard_count() ? equations_.guard_owner(fired.front()) : "";
      broken_ = {.kind = Breakdown::Kind::restless,
                 .t = time,
                 .why = fmt::format("\"{}\" can neither stay as it is nor change: no set of pieces and senses of "
                                    "motion fits its laws here. Smooth the load's edge (rise) or its friction",
                                    owner),
                 .element = owner};
      return false;
    }
    if (options_.extension) options_.extension->before_event(time, y, fired);
    if (is_restless(time, fired)) calm(time, fired);
    const std::size_t known = out_.events.size();
    if (!fired.empty()) equations_.fire(time, y, fired, out_.events);
    note_angle(known, y);
    if (options_.extension) options_.extension->after_event(time, y);
    equations_.wrap(y);
    restart(time, y);
    return true;
  }

  // The friction laws of joints allow no continuation. The jam is within round-off of the begin of an explicit step; a
  // library's method fails earlier, and explicit steps integrate the rest.
  bool pass_jam() {
    if (options_.extension) return false;
    if (is_of_library(method_)) {
      before_jam_ = method_;
      steps_to_jam_ = 0;
      go_on_with(Method::dormand_prince_853);
      return true;
    }
    return stop_by_jam();
  }

  bool stop_by_jam() {
    const double t = stepper_->t();
    std::vector<double> y = reached();
    memory_.jams_here = t - memory_.last_jam <= 1e-13 * std::max(1.0, std::abs(t)) ? memory_.jams_here + 1 : 0;
    memory_.last_jam = t;
    const std::size_t known = out_.events.size();
    if (options_.extension || memory_.jams_here > events_of_a_jam) return false;
    if (!equations_.stop_jam(t, y, {}, out_.events)) return false;
    equations_.forget_jam();
    ++out_.statistics.events;
    go_on_from(t, y, known);
    return before_jam_ ? resume() : true;
  }

  // Returns to the requested method.
  bool resume() {
    go_on_with(*std::exchange(before_jam_, std::nullopt));
    return true;
  }

  void note_angle(std::size_t first, std::span<const double> y) {
    const auto link = static_cast<std::size_t>(equations_.model().reduction_angle);
    for (std::size_t k = first; k < out_.events.size(); ++k)
      out_.events[k].angle = equations_.angle_with_turns(link, y);
  }

  bool is_restless(double time, const std::vector<std::size_t>& fired) {
    memory_.recent.push_back({time, fired});
    if (memory_.recent.size() <= restless_events) return false;
    memory_.recent.pop_front();
    return (time - memory_.recent.front().time) * equations_.model().speed_scale < restless_angle;
  }

  // The guards that fired most often while chattering lose their events, including those that fire now.
  void calm(double time, std::vector<std::size_t>& fired) {
    constexpr int most_for_one = static_cast<int>(restless_events / 10);
    std::map<std::size_t, int> times;
    for (const LoopMemory::Recent& event : memory_.recent)
      for (const std::size_t guard : event.fired)
        if (guard < equations_.guard_count()) ++times[guard];
    std::vector<std::size_t> restless;
    for (const auto& [guard, count] : times)
      if (count > most_for_one) restless.push_back(guard);
    const double span = time - memory_.recent.front().time;
    memory_.recent.clear();
    const std::string what = equations_.regularise(restless);
    if (what.empty()) return;
    out_.events.push_back(restless_event(time, what, restless_events, span));
    out_.regularised.push_back(what);
    std::erase_if(fired, [&](std::size_t guard) { return times.count(guard) && times.at(guard) > most_for_one; });
  }

  // Between steps; long computations within a step check themselves.
  void look_at_time() {
    if (options_.interrupted && options_.interrupted->load()) throw OutOfTime(0);
    if (++checks_ % 64 != 0) return;
    if (options_.most_flow_calls > 0 && flow_calls() > options_.most_flow_calls)
      throw std::runtime_error(fmt::format("more than {} evaluations of the equations", options_.most_flow_calls));
    if (options_.progress) options_.progress(stepper_->t() / options_.until);
    Deadline::check();
  }
  void stop_at(const OutOfTime& over) {
    const double t = stepper_ ? stepper_->t() : 0;
    if (over.interrupted())
      broken_ = {.t = t, .why = over.what()};
    else
      broken_ = {
          .kind = Breakdown::Kind::budget,
          .t = t,
          .why = fmt::format("{}{}. Raise `budget`, loosen `accuracy`, or switch an effect off", over.what(),
                             memory_.last_step > 0 ? fmt::format(" (steps of {:.3g} s at the end)", memory_.last_step)
                                                   : " before any step")};
  }

  std::int64_t flow_calls() const { return out_.statistics.stepper.flow_calls + stepper_->statistics().flow_calls; }

  void add_statistics() {
    const StepperStatistics& s = stepper_->statistics();
    StepperStatistics& sum = out_.statistics.stepper;
    sum.steps += s.steps;
    sum.rejected += s.rejected;
    sum.flow_calls += s.flow_calls;
    sum.jacobian_calls += s.jacobian_calls;
    sum.factorisations += s.factorisations;
    sum.restarts += s.restarts;
  }

  void finish() {
    if (stepper_) {
      add_statistics();
      out_.t = stepper_->t();
      out_.state.assign(stepper_->y().begin(), stepper_->y().end());
    }
    if (out_.complete && !options_.extension && method_ != Method::work_equation) out_.checkpoint = checkpoint();
    if (out_.complete && !options_.extension) out_.held = equations_.held(out_.t, out_.state);
    out_.statistics.method = choice_.describe();
    out_.statistics.reason = choice_.reason();
    out_.statistics.cpu_seconds = processor_time() - begin_;
    if (broken_) out_.diagnosis = diagnosis(*broken_, equations_, options_, out_);
  }

  Equations& equations_;
  const RunOptions& options_;
  const std::vector<Observer*>& observers_;
  OdeSystem& system_;
  StepView view_;
  EventLocation location_;
  std::unique_ptr<Stepper> stepper_;
  Method method_ = Method::dormand_prince_853;
  RunOutcome out_;
  std::optional<Breakdown> broken_;
  StepLimits::Bound bound_ = StepLimits::Bound::until;
  std::vector<double> state_;
  LoopMemory memory_;
  MethodChoice choice_;
  double begin_ = 0, edge_ = 0;
  std::optional<Method> before_jam_;  // method that continues after explicit steps to the jam
  int steps_to_jam_ = 0;
  std::int64_t checks_ = 0;
};

}  // namespace

std::span<const double> StepView::at(double time) {
  if (time >= stepper_->t()) return stepper_->y();
  if (time <= stepper_->t_previous()) return stepper_->y_previous();
  scratch_.resize(size_);
  stepper_->interpolate(time, scratch_);
  return scratch_;
}

double StepView::at(double time, std::size_t state) {
  if (time >= stepper_->t()) return stepper_->y()[state];
  if (time <= stepper_->t_previous()) return stepper_->y_previous()[state];
  return stepper_->interpolate(time, state);
}

RunOutcome integrate(Equations& equations, const RunOptions& options, const std::vector<Observer*>& observers) {
  const FlushDenormals flush;
  return Loop(equations, options, observers).run();
}

}  // namespace kurbel
