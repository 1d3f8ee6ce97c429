// event_location.cpp — guards at both ends of a step, dips within it, and location of the first event.
#include "engine/run/event_location.h"
#include "engine/numerics/roots.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace kurbel {
namespace {

// Guards of speeds and torques: those of angles cannot come back within a quarter turn.
bool guards_beyond_angles(const Equations& equations) {
  std::size_t of_angle = 0;
  for (const auto& pool : equations.model().pools)
    if (pool->guards_are_of_angle() && !pool->reacts()) of_angle += pool->guard_count();
  return equations.guard_count() > of_angle;
}

}  // namespace

EventLocation::EventLocation(Equations& equations, const RunOptions& options, std::size_t states)
    : equations_(equations),
      options_(options),
      states_(states),
      guard_(equations.guard_count() + (options.stop ? 1 : 0)),
      guard_before_(guard_.size()),
      may_dip_(guards_beyond_angles(equations)) {}

void EventLocation::begin(double t, std::span<const double> y) {
  slopes_known_ = false;
  find_guards(t, y, guard_before_);
}

std::vector<std::size_t> EventLocation::find() {
  if (guard_.empty()) return {};
  find_guards(stepper_->t(), stepper_->y(), guard_);
  std::vector<std::size_t> fired = locate();
  if (fired.empty() && stepper_->at_edge()) fired = fired_at_edge();
  return fired;
}

void EventLocation::go_on() {
  std::swap(guard_, guard_before_);
  std::swap(guard_slope_, guard_slope_before_);
}

// The guards of the equations, followed by the end of the run.
void EventLocation::find_guards(double t, std::span<const double> y, std::span<double> g) {
  equations_.guards(t, y, g);
  if (options_.stop) g.back() = options_.stop(t, y);
}

double EventLocation::guard_at(double t, std::size_t which) {
  work_.resize(states_);
  stepper_->interpolate(t, work_);
  probe_.resize(guard_.size());
  if (which == equations_.guard_count()) return options_.stop(t, work_);
  return equations_.guard(t, work_, which, probe_);
}

// dg/dt from a small step along the slope.
void EventLocation::find_guard_slopes(double t, std::span<const double> y, std::span<const double> ydot,
                                      std::span<const double> g, double delta, std::vector<double>& slopes) {
  work_.resize(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) work_[i] = y[i] + delta * ydot[i];
  slopes.resize(guard_.size());
  find_guards(t + delta, work_, slopes);
  for (std::size_t i = 0; i < guard_.size(); ++i) slopes[i] = (slopes[i] - g[i]) / delta;
}

EventLocation::Cubic EventLocation::cubic_of(std::size_t guard) const {
  const double h = stepper_->t() - stepper_->t_previous(), rise = guard_[guard] - guard_before_[guard];
  const double down = h * guard_slope_before_[guard], up = h * guard_slope_[guard];
  return {guard_before_[guard], down, 3 * rise - 2 * down - up, down + up - 2 * rise};
}

// Guards that are positive at both ends of the step but negative in between: if the cubic through values and slopes
// approaches zero, the dense output is evaluated. False: the slopes are not known.
bool EventLocation::add_dips(std::vector<Below>& below) {
  if (!may_dip_ || stepper_->ends_on_edges()) return false;
  const double t0 = stepper_->t_previous(), h = stepper_->t() - t0;
  if (!(h > 1e-9 * std::abs(t0))) return false;
  if (!slopes_known_)
    find_guard_slopes(t0, stepper_->y_previous(), stepper_->ydot_previous(), guard_before_, 1e-5 * h,
                      guard_slope_before_);
  find_guard_slopes(stepper_->t(), stepper_->y(), stepper_->ydot(), guard_, -1e-5 * h, guard_slope_);
  slopes_known_ = true;
  for (std::size_t i = 0; i < guard_.size(); ++i) {
    const double g0 = guard_before_[i], g1 = guard_[i];
    if (!(g0 > at_root && g1 > at_root && guard_slope_before_[i] < 0 && guard_slope_[i] > 0)) continue;
    const Cubic cubic = cubic_of(i);
    const double root = std::sqrt(std::max(0.0, cubic.b * cubic.b - 3 * cubic.c * cubic.slope));
    double x = -cubic.slope / (cubic.b + root);  // of its minimum
    if (!(x > 0 && x < 1)) continue;
    const double lowest = cubic.at(x);
    if (lowest > 0.2 * (std::max(g0, g1) - lowest)) continue;  // far off, even for a step that the cubic is poor at
    double value = guard_at(t0 + x * h, i);
    // Towards the true minimum by parabolas.
    for (int k = 0; k < 3 && value > fired_below; ++k) {
      constexpr double dx = 1e-2;
      const double before = guard_at(t0 + (x - dx) * h, i), after = guard_at(t0 + (x + dx) * h, i);
      const double bend = before - 2 * value + after;
      if (!(bend > 0)) break;
      const double better = std::clamp(x + 0.5 * dx * (before - after) / bend, dx, 1 - dx);
      if (std::abs(better - x) < 1e-6) break;
      x = better;
      value = guard_at(t0 + x * h, i);
    }
    if (value < fired_below) below.push_back({i, t0 + x * h, value});
  }
  return true;
}

// Goes back to the first guard that fired within the step; returns all that fire there, none if the step was smooth.
std::vector<std::size_t> EventLocation::locate() {
  std::vector<std::size_t> fired;
  for (int round = 0; round < 8; ++round) {
    std::vector<Below> below;
    for (std::size_t i = 0; i < guard_.size(); ++i)
      if (guard_[i] < fired_below) below.push_back({i, stepper_->t(), guard_[i]});
    const bool sloped = add_dips(below);
    if (below.empty()) return fired;
    const double t0 = stepper_->t_previous(), t1 = stepper_->t();
    // A guard that starts at its root either rises first, and its next root is searched from there; or the mode was wrong
    // from the start of the step, which is then discarded.
    fired.clear();
    std::vector<double> from(below.size(), t0), value(below.size());
    for (std::size_t k = 0; k < below.size(); ++k) {
      value[k] = guard_before_[below[k].guard];
      for (const double part : {1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.6}) {
        if (value[k] > at_root) break;
        from[k] = t0 + part * (t1 - t0);
        value[k] = guard_at(from[k], below[k].guard);
      }
      if (value[k] <= 0) fired.push_back(below[k].guard);
    }
    if (!fired.empty()) {
      at_begin_ = true;
      return fired;
    }
    // Of each only until it is known to be later than another.
    const double at_once = 1e-12 * (t1 - t0);
    double first = t1;
    std::vector<double> root(below.size(), HUGE_VAL);
    for (std::size_t k = 0; k < below.size(); ++k) {
      const std::size_t i = below[k].guard;
      double end = below[k].t, value_at_end = below[k].value;
      if (const double behind = first + 1e-6 * (t1 - t0); behind < end && behind > from[k]) {
        end = behind, value_at_end = guard_at(end, i);
        if (value_at_end > 0) continue;
      }
      if (sloped && from[k] == t0 && end == t1) {  // near to where its cubic has it
        const Cubic cubic = cubic_of(i);
        const double near =
            t0 + find_root([&](double x) { return cubic.at(x); }, 0, value[k], 1, value_at_end) * (t1 - t0);
        const double there = guard_at(near, i);
        if (there > 0) from[k] = near, value[k] = there;
        if (there <= 0) end = near, value_at_end = there;
      }
      root[k] = find_root([&](double t) { return guard_at(t, i); }, from[k], value[k], end, value_at_end, 1e-14);
      first = std::min(first, root[k]);
    }
    for (std::size_t k = 0; k < below.size(); ++k)
      if (root[k] <= first + at_once) fired.push_back(below[k].guard);
    if (!try_to_land_on(first, fired.front())) return {};
    // What is at its root now counts as fired; another guard may have fired before it.
    for (std::size_t k = 0; k < below.size(); ++k)
      if (root[k] > first + at_once && std::abs(guard_[below[k].guard]) <= at_root) fired.push_back(below[k].guard);
    std::sort(fired.begin(), fired.end());
    for (const std::size_t i : fired) guard_[i] = std::max(guard_[i], 0.0);
  }
  return fired;
}

// The step ended on an edge of the angle: what is zero there and negative a little further on.
std::vector<std::size_t> EventLocation::fired_at_edge() {
  constexpr double here = 1e-9, further = 1e-7;  // guards are of order one per radian
  std::vector<std::size_t> fired;
  if (std::none_of(guard_.begin(), guard_.end(), [](double g) { return g < here; })) return fired;
  work_.assign(stepper_->y().begin(), stepper_->y().end());
  const Model& m = equations_.model();
  for (std::size_t i = 0; i < m.angles.size(); ++i)
    work_[i] += std::copysign(further, work_[equations_.speed_index(m.angles[i].shaft)]) * m.angles[i].gain;
  probe_.resize(guard_.size());
  equations_.guards(stepper_->t(), work_, probe_);
  for (std::size_t i = 0; i < guard_.size(); ++i)
    if (guard_[i] < here && probe_[i] < fired_below) fired.push_back(i);
  return fired;
}

// False: a library's method finds no step that ends on the event at a kink of a law; the step is then shortened to a part
// before it, and the event is searched again afterwards.
bool EventLocation::try_to_land_on(double t, std::size_t guard) {
  const double t0 = stepper_->t_previous();
  std::exception_ptr failure;
  try {
    land_on(t, guard);
    return true;
  } catch (const StepFailure&) {
    if (!of_library_) throw;
    failure = std::current_exception();
  }
  for (double part = 0.7; part > 1e-3; part *= 0.5) {
    try {
      stepper_->retake(t0 + part * (t - t0));
      find_guards(stepper_->t(), stepper_->y(), guard_);
      return false;
    } catch (const StepFailure&) {  // shorter, then
    }
  }
  std::rethrow_exception(failure);
}

// An exact step onto the event, corrected by the secant method until the guard is zero to round-off.
void EventLocation::land_on(double t, std::size_t guard) {
  const double t0 = stepper_->t_previous(), t1 = stepper_->t();
  const double delta = 1e-4 * (t1 - t0);
  const double slope = (guard_at(std::min(t + delta, t1), guard) - guard_at(std::max(t - delta, t0), guard)) /
                       (std::min(t + delta, t1) - std::max(t - delta, t0));
  double last = HUGE_VAL;
  for (int i = 0; i < 4; ++i) {
    if (!(t > t0)) t = std::nextafter(t0, t1);
    stepper_->retake(t);
    find_guards(stepper_->t(), stepper_->y(), guard_);
    const double residual = guard_[guard];
    if (std::abs(residual) < 1e-14 || std::abs(residual) > 0.1 * last || slope == 0) return;
    last = std::abs(residual);
    const double better = t - residual / slope;
    if (!(better > t0) || better > t1) return;
    t = better;
  }
}

std::vector<std::size_t> fall_at_once(Equations& equations, double t, std::span<const double> y) {
  constexpr double tolerance = 1e-9, longest = 1e-4;  // [s]
  std::vector<double> guard(equations.guard_count());
  equations.guards(t, y, guard);
  if (std::none_of(guard.begin(), guard.end(), [](double g) { return g <= at_root; })) return {};
  try {
    const auto stepper = make_stepper(Method::dormand_prince_54, equations, equations.error_control(tolerance));
    const RunOptions options;
    EventLocation location(equations, options, equations.size());
    location.watch(*stepper, false);
    stepper->start(t, y);
    location.begin(t, y);
    stepper->step(std::min(t + longest, equations.next_edge(t)));
    const std::vector<std::size_t> fired = location.find();
    return location.take_at_begin() ? fired : std::vector<std::size_t>();
  } catch (const std::runtime_error&) {  // no motion can be computed from here
    equations.forget_jam();
    return {};
  }
}

}  // namespace kurbel
