// operating_sequence.cpp — steps are armed, fall due, and set commands.
#include "engine/events/operating_sequence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/events/event_words.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double never = 1e300;

// A ramp that ends at the moment at which it begins is a jump.
bool takes_time(double over, double t) { return over > 1e-13 * std::max(1.0, std::abs(t)); }

// The law of a step from t on.
Command follow(int step, const Curve& law, double t) {
  Command command{.from = t, .law = step, .piece = law.piece(0)};
  if (law.period() > 0) command.from = t - law.within(0);
  command.until = command.from + law.piece_end(command.piece);
  return command;
}

// Behind its last piece it begins again, or stays what it is.
void pass_piece(Command& command, const Curve& law) {
  const int pieces = static_cast<int>(law.x().size()) - 1;
  if (++command.piece == pieces && law.period() == 0) {
    command = {.value = law.y().back(), .to = law.y().back()};
    return;
  }
  if (command.piece == pieces) {
    command.piece = 0;
    command.from += law.period();
  }
  command.until = command.from + law.piece_end(command.piece);
}

}  // namespace

bool OperatingSequence::begin(Modes& modes, double t, std::span<const double> y) const {
  std::fill(modes.command.begin(), modes.command.end(), Command{});
  modes.next_step = 0;
  modes.last_step_time = t;
  modes.armed_time = modes.cycle_began = never;
  if (!any()) return false;
  arm(modes, t, y);
  return modes.armed_time <= t;
}

void OperatingSequence::arm(Modes& modes, double t, std::span<const double> y) const {
  const Sequence& sequence = model_->scene.sequence;
  modes.armed_time = never;
  if (modes.next_step >= sequence.steps.size()) return;
  if (sequence.every > 0 && modes.next_step == 0 && modes.cycle_began < never) {  // the clock begins the next cycle
    modes.armed_time = std::max(t, modes.cycle_began + sequence.every);
    return;
  }
  const SequenceStep& step = sequence.steps[modes.next_step];
  if (step.when == SequenceStep::When::at) modes.armed_time = std::max(t, step.value);
  if (step.when == SequenceStep::When::after) modes.armed_time = modes.last_step_time + step.value;
  if (step.when == SequenceStep::When::angle) {
    const double now = angle_with_turns(modes, at(model_->trigger_angle[modes.next_step]), y);
    const double turn = 2 * std::numbers::pi, slack = 1e-9;
    modes.armed_angle = step.value + turn * std::ceil((now + slack - step.value) / turn);
  }
}

void OperatingSequence::take(Modes& modes, double t, std::span<const double> y, EventLog* log) const {
  const Sequence& sequence = model_->scene.sequence;
  for (std::size_t taken = 0; taken <= sequence.steps.size() && modes.next_step < sequence.steps.size(); ++taken) {
    const SequenceStep& step = sequence.steps[modes.next_step];
    for (const std::string& component : step.set) {
      Command& command = modes.command[at(model_->command_of(component))];
      const double value = command.at(t, sequence);
      if (!step.law.empty())
        command = follow(static_cast<int>(modes.next_step), step.law, t);
      else if (takes_time(step.over, t) && value != step.to)
        command = {value, (step.to - value) / step.over, t, t + step.over, step.to};
      else
        command = {.value = step.to, .to = step.to};
      const double to = step.law.empty() ? step.to : step.law.y().back();
      const double over = step.law.empty() ? step.over : step.law.x().back();
      if (log) log->push_back(command_event(t, component, value, to, over));
    }
    if (modes.next_step == 0) begin_cycle(modes, t, log);
    modes.last_step_time = t;
    ++modes.next_step;
    if (modes.next_step == sequence.steps.size() && sequence.repeat) modes.next_step = 0;
    arm(modes, t, y);
    if (modes.armed_time > t) break;
  }
}

void OperatingSequence::begin_cycle(Modes& modes, double t, EventLog* log) const {
  const double every = model_->scene.sequence.every;
  if (every == 0) return;
  const double took = t - modes.cycle_began;
  if (log && modes.cycle_began < never && took > every * (1 + 1e-12)) log->push_back(late_cycle_event(t, took, every));
  modes.cycle_began = t;
}

double OperatingSequence::guard(const Modes& modes, std::span<const double> y, const double* speed) const {
  const Sequence& sequence = model_->scene.sequence;
  if (modes.next_step >= sequence.steps.size()) return 1;
  const SequenceStep& step = sequence.steps[modes.next_step];
  if (step.when == SequenceStep::When::angle)
    return std::min(1.0, modes.armed_angle - angle_with_turns(modes, at(model_->trigger_angle[modes.next_step]), y));
  if (step.when != SequenceStep::When::speed_above && step.when != SequenceStep::When::speed_below) return 1;
  const std::size_t node = at(model_->network.ports.at(step.of).in);
  const double over = model_->gain_of_node[node] * speed[model_->shaft_of_node[node]] - step.value;
  return (step.when == SequenceStep::When::speed_above ? -over : over) /
         (model_->speed_scale * model_->scale_ratio[node]);
}

double OperatingSequence::next_edge(const Modes& modes) const {
  double next = modes.armed_time;
  for (const Command& command : modes.command)
    if (!command.holds_still()) next = std::min(next, command.until);
  return next;
}

void OperatingSequence::end_ramps(Modes& modes, double t) const {
  for (Command& command : modes.command) {
    if (command.holds_still() || command.until > t) continue;
    if (command.law < 0)
      command = {.value = command.to, .to = command.to};
    else
      pass_piece(command, model_->scene.sequence.steps[at(command.law)].law);
  }
}

}  // namespace kurbel
