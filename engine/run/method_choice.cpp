// method_choice.cpp — the first method, and the trials of implicit steps.
#include "engine/run/method_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "engine/rigid/work_stepper.h"

namespace kurbel {
namespace {

// Explicit steps limited by stability are replaced if implicit ones are longer by this factor (measured: an ESDIRK step
// costs 2 to 3 steps of DOP853). An unsuccessful trial is repeated after four times as many limited steps. Counted in
// steps, not in seconds, so that a run is reproducible bit for bit.
const int held_steps_before_trial = LoopMemory{}.held_needed;
constexpr int trial_warm_up = 30, trial_length = 60;
constexpr double implicit_step_cost = 3;

// Number of turns from which the work equation is faster in spite of its search for edges.
constexpr double turns_to_pay = 3;

}  // namespace

bool is_of_library(Method method) {
  return method == Method::esdirk_32 || method == Method::esdirk_43 || method == Method::esdirk_54 ||
         method == Method::bdf || method == Method::adams;
}

MethodChoice::MethodChoice(const Equations& equations, const RunOptions& options, LoopMemory& memory)
    : equations_(equations), options_(options), memory_(memory) {
  if (options.elsewhere) explicit_ = Method::verner_65, implicit_ = Method::esdirk_54;
}

Method MethodChoice::first() {
  const Model& m = equations_.model();
  if (!automatic()) {
    first_ = as_asked();
    reason_ = "requested";
  } else if (work_equation_pays()) {
    first_ = Method::work_equation;
    reason_ = "rigid, torques of angle and speed: load edges lie at known angles";
  } else {
    first_ = explicit_;
    reason_ = m.elastic.empty() && m.own_states.empty()
                  ? "rigid: not stiff, and a method of high order takes the longest steps"
                  : "explicit, as accuracy limits its steps and not stability";
  }
  return now_ = first_;
}

Method MethodChoice::as_asked() {
  const Method method = method_named(options_.method);
  std::string why;
  if (method == Method::work_equation) {
    if (options_.checkpoint || options_.to_go_on) refuse("it goes over the angle, and keeps no state to go on from");
    why = WorkTables::refusal(equations_.shared_model());
  }
  if (method == Method::fehlberg_87) why = rates_of_time_alone();
  if (!why.empty()) refuse(why);
  return method;
}

// With its location if the scene requests it.
void MethodChoice::refuse(const std::string& why) const {
  const Scene& scene = equations_.model().scene;
  const std::string text = fmt::format("method \"{}\": {}", options_.method, why);
  if (scene.run.method != options_.method || scene.run.method_at.line == 0) throw std::invalid_argument(text);
  throw SceneError({{scene.file, scene.run.method_at, text}});
}

// Fehlberg's error estimate is identically zero where the rates depend on time alone. Where and why, in words.
std::string MethodChoice::rates_of_time_alone() const {
  const Model& m = equations_.model();
  const char* blind = "its error estimate is blind to what depends on time alone; choose dop853 or verner6";
  if (m.free_shafts < m.shafts.size()) return fmt::format("a speed is prescribed over time, and {}", blind);
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.element->uses_time) return fmt::format("the torque of \"{}\" depends on time, and {}", e.component, blind);
  return {};
}

// Where inertia or torques vary with the angle, over more than a few turns.
bool MethodChoice::work_equation_pays() const {
  const Model& m = equations_.model();
  if (options_.from || options_.checkpoint || options_.to_go_on) return false;
  if (options_.stop || options_.extension || options_.elsewhere) return false;
  if (!m.elastic.empty() || m.free_shafts != 1) return false;
  if (!m.shafts[0].variable && equations_.guard_count() == 0) return false;
  if (m.speed_scale * options_.until < turns_to_pay * 2 * std::numbers::pi) return false;
  return options_.work_tables || WorkTables::refusal(equations_.shared_model()).empty();
}

std::optional<Method> MethodChoice::after(const Stepper& stepper, Method now) {
  const Model& m = equations_.model();
  if (!automatic() || (m.elastic.empty() && m.own_states.empty()) || now == Method::work_equation) return {};
  const double t = stepper.t(), h = t - stepper.t_previous(), left = options_.until - t;
  if (now == explicit_) {
    held_ = stepper.held_by_stability() ? held_ + 1 : std::max(0, held_ - 3);
    if (held_ < memory_.held_needed || left < 5 * held_steps_before_trial * h) return {};
    explicit_step_ = h;
    implicit_steps_ = held_ = 0;
    return change(implicit_, t,
                  fmt::format("stability held explicit steps at {:.3g} s; implicit ones are free of that", h));
  }
  // After the trial the check continues with new windows of steps.
  if (++implicit_steps_ == trial_warm_up) trial_begin_ = t;
  if (implicit_steps_ < trial_warm_up + trial_length) return {};
  const double mean = (t - trial_begin_) / trial_length;
  trial_begin_ = t;
  implicit_steps_ = trial_warm_up;
  if (mean >= implicit_step_cost * explicit_step_) return {};
  memory_.held_needed *= 4;
  return change(explicit_, t,
                fmt::format("implicit steps of {:.3g} s did not pay for themselves against explicit ones of {:.3g} s",
                            mean, explicit_step_));
}

std::optional<Method> MethodChoice::after_failure(double t, Method now, const std::string& why) {
  if (!is_implicit(now)) return {};
  memory_.held_needed = std::numeric_limits<int>::max();
  return change(explicit_, t, fmt::format("implicit steps failed: {}", why));
}

Method MethodChoice::change(Method to, double t, const std::string& why) {
  ++changes_;
  reason_ = fmt::format("at {:.4g} s: {}", t, why);
  return now_ = to;
}

std::string MethodChoice::describe() const {
  if (changes_ == 0) return std::string(name_of(first_));
  return fmt::format("{}, at the end {} ({} change{})", name_of(explicit_), name_of(now_), changes_,
                     changes_ == 1 ? "" : "s");
}

}  // namespace kurbel
