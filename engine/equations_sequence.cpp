// equations_sequence.cpp — the operating sequence: steps that wait for a time, an angle or a speed, and set what
// motors, clutches and brakes are told.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/equations.h"

namespace kurbel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

constexpr double never = 1e300;

std::string value_text(double to) { return to == 0 ? "off" : to == 1 ? "on" : fmt::format("{:.4g}", to); }

}  // namespace

// Steps that wait for nothing have happened when the machine starts.
void Equations::begin_sequence(double t, std::span<double> y, std::vector<Event>* log) {
  std::fill(modes_.command.begin(), modes_.command.end(), Command{});
  modes_.next_step = 0;
  modes_.last_step_time = t;
  modes_.armed_time = never;
  if (model_->scene.sequence.steps.empty()) return;
  arm_step(t, y);
  if (modes_.armed_time <= t) take_steps(t, y, log);
}

void Equations::arm_step(double t, std::span<const double> y) {
  const Sequence& sequence = model_->scene.sequence;
  modes_.armed_time = never;
  if (modes_.next_step >= sequence.steps.size()) return;
  const SequenceStep& step = sequence.steps[modes_.next_step];
  if (step.when == SequenceStep::When::at) modes_.armed_time = std::max(t, step.value);
  if (step.when == SequenceStep::When::after) modes_.armed_time = modes_.last_step_time + step.value;
  if (step.when == SequenceStep::When::angle) {
    const double now = angle_with_turns(at(model_->trigger_angle[modes_.next_step]), y);
    const double turn = 2 * std::numbers::pi, slack = 1e-9;
    modes_.armed_angle = step.value + turn * std::ceil((now + slack - step.value) / turn);
  }
}

// The step that is due, and those that follow it at once.
void Equations::take_steps(double t, std::span<double> y, std::vector<Event>* log) {
  const std::vector<char> before = modes_.active;
  const Sequence& sequence = model_->scene.sequence;
  for (std::size_t taken = 0; taken <= sequence.steps.size() && modes_.next_step < sequence.steps.size(); ++taken) {
    const SequenceStep& step = sequence.steps[modes_.next_step];
    for (const std::string& component : step.set) {
      const auto is = [&](const CommandTarget& target) { return target.component == component; };
      const auto c = std::find_if(model_->commands.begin(), model_->commands.end(), is) - model_->commands.begin();
      Command& command = modes_.command[static_cast<std::size_t>(c)];
      const double value = command.at(t);
      if (step.over > 0 && value != step.to)
        command = {value, (step.to - value) / step.over, t, t + step.over, step.to};
      else
        command = {.value = step.to, .to = step.to};
      if (log)
        log->push_back({t, component,
                        step.over > 0 ? fmt::format("goes to {} within {:.4g} s", value_text(step.to), step.over)
                                      : fmt::format("is set {}", value_text(step.to)),
                        value_text(value)});
    }
    modes_.last_step_time = t;
    ++modes_.next_step;
    if (modes_.next_step == sequence.steps.size() && sequence.repeat) modes_.next_step = 0;
    arm_step(t, y);
    if (modes_.armed_time > t) break;
  }
  set_timed_modes(t);
  tell_switched(t, y, before);
}

// A circuit that opens or closes changes its currents at once.
void Equations::tell_switched(double t, std::span<double> y, const std::vector<char>& before) {
  if (modes_.active == before) return;
  for (const auto& pool : model_->pools) pool->switched(instant(t, y), before.data(), y.data() + own_begin());
}

double Equations::sequence_guard(std::span<const double> y) const {
  const Sequence& sequence = model_->scene.sequence;
  if (modes_.next_step >= sequence.steps.size()) return 1;
  const SequenceStep& step = sequence.steps[modes_.next_step];
  if (step.when == SequenceStep::When::angle)
    return std::min(1.0, modes_.armed_angle - angle_with_turns(at(model_->trigger_angle[modes_.next_step]), y));
  if (step.when != SequenceStep::When::speed_above && step.when != SequenceStep::When::speed_below) return 1;
  const std::size_t node = at(model_->network.ports.at(step.of).in);
  const auto shaft = at(model_->shaft_of_node[node]);
  const double speed = shaft < model_->free_shafts ? y[speed_index(static_cast<int>(shaft))] : speed_[shaft];
  const double over = model_->gain_of_node[node] * speed - step.value;
  return (step.when == SequenceStep::When::speed_above ? -over : over) /
         (model_->speed_scale * model_->scale_ratio[node]);
}

}  // namespace kurbel
