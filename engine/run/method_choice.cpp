// method_choice.cpp — the first method, and the trials of implicit steps.
#include "engine/run/method_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "engine/rigid/work_stepper.h"

namespace kurbel {
namespace {

// Explicit steps limited by stability are replaced by implicit ones while those are longer by this factor (measured on a
// press with recorders: an ESDIRK step costs 2 to 3 steps of DOP853). So a vibration that rings after an edge is resolved
// by explicit steps, and what follows its decay passes in long implicit ones. Counted in steps, not in seconds, so that a
// run is reproducible bit for bit.
constexpr double implicit_step_cost = 3;
// Implicit steps whose mean length counts. A visit that does not pay for them doubles the wait before the next, one that
// failed makes it sixteen times as long.
constexpr int window = 8, most_held_needed = 1 << 20, longer_after_failure = 16;

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
    reason_ = m.elastic.empty() && m.internal_states.empty()
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
  const char* blind = "its error estimate misses what depends on time alone; choose dop853 or verner6";
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
  if (!automatic() || (m.elastic.empty() && m.internal_states.empty()) || now == Method::work_equation) return {};
  const double t = stepper.t(), h = t - stepper.t_previous(), left = options_.until - t;
  double& explicit_step = memory_.explicit_step;
  int& implicit_steps = memory_.implicit_steps;
  if (now == explicit_) {
    const bool is_held = stepper.held_by_stability();
    memory_.held = std::max(0, memory_.held + (is_held ? 1 : -1));
    if (is_held && memory_.held == 1) explicit_step = h;
    if (is_held) explicit_step += (h - explicit_step) / window;
    if (memory_.held < memory_.held_needed || left < 5.0 * memory_.held_needed * h) return {};
    implicit_steps = memory_.held = 0;
    return change(
        implicit_, t,
        fmt::format("stability held explicit steps at {:.3g} s; implicit ones are free of that", explicit_step));
  }
  if (implicit_steps == 0) memory_.implicit_since = memory_.window_begin = stepper.t_previous();
  if (++implicit_steps % window != 0) return {};
  const double mean = (t - std::exchange(memory_.window_begin, t)) / window;
  if (implicit_steps == window || mean >= implicit_step_cost * explicit_step) return {};  // the first ones grow
  const double worth = (t - memory_.implicit_since) / (implicit_step_cost * explicit_step);
  memory_.held_needed =
      worth > implicit_steps + window ? LoopMemory{}.held_needed : 2 * std::min(memory_.held_needed, most_held_needed);
  return change(explicit_, t,
                fmt::format("implicit steps of {:.3g} s do not pay for themselves against explicit ones of {:.3g} s",
                            mean, explicit_step));
}

std::optional<Method> MethodChoice::after_failure(double t, Method now, const std::string& why) {
  if (!is_implicit(now)) return {};
  memory_.held_needed = longer_after_failure * std::min(memory_.held_needed, most_held_needed);
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
