// instance.cpp — an exported machine between its importer's calls is a checkpoint; every way is a run from there.
#include "library/fmi/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "engine/events/event_words.h"
#include "engine/run/checkpoint.h"
#include "engine/run/event_location.h"
#include "library/fmi/ports.h"

namespace kurbel {
namespace {

// Of the scene's accuracy: local errors grow on the way.
constexpr double tolerance_of_accuracy = 1e-3;
// Indicators pass zero just below where guards do: what stands at its root is not one that has fired.
constexpr double below_root = 2e-11;
constexpr double same_time = 1e-9;  // of the time [s], at least of 1 s
constexpr int most_events = 100, events_of_a_jam = 20, events_without_rest = 60;

// A step goes over the time, and begins anew at every communication point, which multistep methods are made for least.
std::string method_of(const RunSettings& run) {
  return run.method == "work" || run.method == "bdf" || run.method == "adams" ? "auto" : run.method;
}

// Passes steps of the integrator on.
class StepCallback final : public Observer {
 public:
  explicit StepCallback(std::function<void(StepView&)> look) : look_(std::move(look)) {}
  void step(StepView& view) override { look_(view); }

 private:
  std::function<void(StepView&)> look_;
};

}  // namespace

Instance::Instance(ExportedMachine machine, std::string folder)
    : machine_(std::move(machine)), folder_(std::move(folder)) {
  reset();
}

void Instance::set_up(double begin, std::optional<double> tolerance) {
  s_.begin = begin;
  tolerance_ = tolerance;
  s_.stale = true;
}

void Instance::reset() {
  s_ = {};
  for (const ExportedParameter& parameter : machine_.parameters) s_.parameters.push_back(parameter.start);
  for (const ExportedInput& input : machine_.inputs) s_.inputs.push_back(input.start);
  s_.slopes.assign(s_.inputs.size(), 0);
  tolerance_.reset();
  moment_.reset();
  events_.clear();
  compile();
}

void Instance::compile() {
  const Scene scene = scene_of(machine_, folder_, s_.parameters);
  auto equations = std::make_unique<Equations>(model_of(machine_, scene, s_.inputs), false);
  auto view = std::make_unique<ExportedView>(machine_, *equations);
  commands_ = commands_of(machine_, equations->model());
  equations_ = std::move(equations), view_ = std::move(view);
  compiled_ = s_.parameters;
}

void Instance::start() {
  compile();
  s_.here = {};
  s_.here.state.t = s_.begin;
  s_.here.state.y = equations_->start(s_.begin);
  s_.here.state.modes = equations_->modes();
  s_.applied = s_.inputs;
  s_.peaks.clear();
  s_.stale = false;
}

Equations& Instance::made() {
  if (s_.stale) start();
  return *equations_;
}

void Instance::begin() {
  made();
  s_.started = true;
}

// A machine with other parameters goes on in the same state.
void Instance::follow_parameters() {
  if (compiled_ == s_.parameters) return;
  const std::string text = text_of(s_.here, *equations_);
  compile();
  try {
    checkpoint_from(text, *equations_);
  } catch (const UnfitCheckpoint& error) {
    throw std::runtime_error(fmt::format("with these parameters the machine {}", error.what()));
  }
  equations_->bind(s_.here.state.modes);
}

const ExportedVariable& Instance::variable(std::uint32_t reference) const {
  if (reference >= view_->variables.size())
    throw std::invalid_argument(
        fmt::format("there is no value reference {}; they are 0 … {}", reference, view_->variables.size() - 1));
  return view_->variables[reference];
}

const Snapshot& Instance::now() {
  Equations& equations = made();
  return moment_ ? equations.snapshot(moment_->t, moment_->y) : equations.snapshot(s_.here.state.t, s_.here.state.y);
}

double Instance::value(std::uint32_t reference) {
  using enum ExportedVariable::Role;
  made();
  const ExportedVariable& v = variable(reference);
  switch (v.role) {
    case time:
      return this->time();
    case input:
      return s_.inputs[v.place];
    case parameter:
      return s_.parameters[v.place];
    case output:
      return view_->outputs[v.place].value(now());
    case peak:
      return s_.peaks.empty() ? view_->peaks[v.place].value(now()) : s_.peaks[v.place];
    case state:
      return (moment_ ? moment_->y : s_.here.state.y)[v.place];
    case indicator: {
      std::vector<double> z(equations_->guard_count());
      equations_->guards(this->time(), moment_ ? moment_->y : s_.here.state.y, z);
      return z[v.place] + below_root;
    }
    case derivative:
      break;
  }
  std::vector<double> rate(equations_->size());
  equations_->flow(this->time(), moment_ ? moment_->y : s_.here.state.y, rate);
  return rate[v.place];
}

void Instance::check_input(std::size_t k, double value) const {
  const ExportedInput& input = machine_.inputs[k];
  if (!(value >= input.low && value <= input.high) || !std::isfinite(value))
    throw std::invalid_argument(
        fmt::format("{} = {:g}; must be {:g} … {:g}", input.name, value, input.low, input.high));
  if (input.whole && value != 0 && value != 1)
    throw std::invalid_argument(fmt::format("{} = {:g}; it is on or off, must be 0 or 1", input.name, value));
}

void Instance::set(std::uint32_t reference, double value, bool before_start) {
  using enum ExportedVariable::Role;
  const ExportedVariable& v = variable(reference);
  if (moment_) throw std::invalid_argument("nothing can be set while a step is on its way");
  if (v.role == input) {
    check_input(v.place, value);
    s_.inputs[v.place] = value;
  } else if (v.role == parameter) {
    const ExportedParameter& parameter = machine_.parameters[v.place];
    if (!before_start && !parameter.tunable)
      throw std::invalid_argument(fmt::format("{} is fixed: it can be set before the start only", parameter.path));
    if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("{} is no number", parameter.path));
    s_.parameters[v.place] = value;
  } else if (v.role == state && s_.started) {
    s_.here.state.y[v.place] = value;
  } else {
    throw std::invalid_argument(fmt::format("{} is calculated and cannot be set", v.name));
  }
  if (before_start) s_.stale = true;
}

void Instance::set_slope(std::uint32_t reference, double slope) {
  const ExportedVariable& v = variable(reference);
  if (v.role != ExportedVariable::Role::input || machine_.inputs[v.place].whole || !std::isfinite(slope))
    throw std::invalid_argument(fmt::format("{} has no derivative that could be set", v.name));
  s_.slopes[v.place] = slope;
}

// What has changed since the machine followed it last; ramps end at `until`.
void Instance::put_commands(double until) {
  const double t = s_.here.state.t;
  for (std::size_t k = 0; k < s_.inputs.size(); ++k) {
    Command& command = equations_->changing_modes().command[commands_[k]];
    if (machine_.inputs[k].what == ExportedInput::What::speed) {
      // A speed cannot jump: it goes from where it is to what was set, within the step; at its end it is still on the way.
      const double now = command.at(t, equations_->model().scene.sequence);
      const double end = s_.inputs[k] + s_.slopes[k] * (until - t);
      command = {.value = now, .to = now};
      if (until > t && end != now)
        command = {.value = now, .rate = (end - now) / (until - t), .from = t, .until = 1e300};
    } else if (s_.slopes[k] != 0 && until > t) {
      const double end = s_.inputs[k] + s_.slopes[k] * (until - t);
      check_input(k, end);
      command = {.value = s_.inputs[k], .rate = s_.slopes[k], .from = t, .until = until, .to = end};
    } else if (s_.inputs[k] != s_.applied[k] || !command.holds_still()) {
      command = {.value = s_.inputs[k], .to = s_.inputs[k]};
    }
  }
}

// Switches follow what was set, as at a step of the operating sequence. Importers stop at an edge but for round-off: one
// that is ahead by no more than that is passed now. The time of what was passed.
double Instance::apply_inputs() {
  State& state = s_.here.state;
  const double edge = equations_->next_edge(state.t);
  const bool here = edge - state.t <= same_time * std::max(1.0, std::abs(state.t));
  const double t = here ? std::max(edge, state.t) : state.t;
  const std::size_t known = events_.size();
  equations_->pass_edge(t, state.y, events_);
  for (std::size_t k = 0; k < s_.inputs.size(); ++k) {
    const ExportedInput& in = machine_.inputs[k];
    const auto reported = [&](const Event& event) { return event.component == in.of; };
    if (in.what == ExportedInput::What::command && s_.inputs[k] != s_.applied[k] &&
        std::none_of(events_.begin() + static_cast<std::ptrdiff_t>(known), events_.end(), reported))
      events_.push_back(command_event(t, in.of, s_.applied[k], s_.inputs[k], 0));
  }
  equations_->wrap(state.y);
  state.modes = equations_->modes();
  s_.applied = s_.inputs;
  return t;
}

double Instance::go(double step, const std::function<bool(double t)>& look) {
  made();
  const InstanceState before = s_;
  const std::size_t events_before = events_.size();
  const double from = s_.here.state.t, until = from + step;
  RunOptions options;
  options.tolerance = std::max(
      1e-13, tolerance_of_accuracy * std::min(equations_->model().scene.run.accuracy, tolerance_.value_or(1.0)));
  options.method = method_of(equations_->model().scene.run);
  options.budget = HUGE_VAL;
  options.to_go_on = true;
  std::atomic<bool> interrupted{false};
  double ended = until;
  const auto way = [&](double to, bool seen) {
    RunOptions mine = options;
    const Checkpoint begin = s_.here;
    mine.checkpoint = &begin;
    mine.until = to;
    mine.interrupted = &interrupted;
    ExtremeRecorder extremes(view_->peaks);
    StepCallback onlooker([&](StepView& view) {
      if (!seen || interrupted || view.t() >= to) return;
      moment_ = Moment{view.t(), {view.y().begin(), view.y().end()}};
      const bool on = look(view.t());
      moment_.reset();
      if (on) return;
      ended = view.t();
      interrupted = true;
    });
    std::vector<Observer*> observers;
    if (!view_->peaks.empty()) observers.push_back(&extremes);
    if (look && seen) observers.push_back(&onlooker);
    RunOutcome outcome = integrate(*equations_, mine, observers);
    if (outcome.complete) {
      s_.here = std::move(outcome.checkpoint);
      s_.here.observers.clear();
      s_.peaks.clear();
      for (const auto& found : extremes.found()) s_.peaks.push_back(found.value);
      events_.insert(events_.end(), outcome.events.begin(), outcome.events.end());
    }
    return outcome;
  };
  try {
    follow_parameters();
    equations_->bind(s_.here.state.modes);
    put_commands(until);
    apply_inputs();
    if (step > 0) {
      RunOutcome outcome = way(until, true);
      if (!outcome.complete && interrupted) {  // somebody has seen enough: exactly to there
        interrupted = false;
        equations_->bind(s_.here.state.modes);
        outcome = way(ended, false);
      }
      if (!outcome.complete) throw std::runtime_error(outcome.diagnosis);
    }
  } catch (...) {
    moment_.reset();
    events_.resize(events_before);
    restore(before);
    throw;
  }
  equations_->bind(s_.here.state.modes);
  // What rose along the step is where it came to.
  for (std::size_t k = 0; k < s_.inputs.size(); ++k)
    if (s_.slopes[k] != 0) {
      s_.inputs[k] += s_.slopes[k] * (s_.here.state.t - from);
      s_.applied[k] = s_.inputs[k];
      s_.slopes[k] = 0;
    }
  return s_.here.state.t;
}

void Instance::set_time(double t) {
  made();
  s_.here.state.t = t;
}

void Instance::set_states(std::span<const double> y) {
  made();
  if (y.size() != equations_->state_count())
    throw std::invalid_argument(fmt::format("{} states given; there are {}", y.size(), equations_->state_count()));
  s_.here.state.y.assign(y.begin(), y.end());
}

void Instance::states(std::span<double> y) {
  made();
  std::copy_n(s_.here.state.y.begin(), std::min(y.size(), s_.here.state.y.size()), y.begin());
}

void Instance::nominals(std::span<double> scale) {
  const ErrorControl control = made().error_control(1);
  for (std::size_t k = 0; k < scale.size(); ++k) scale[k] = control.scale[k] > 0 ? control.scale[k] : 1;
}

bool Instance::derivatives(std::span<double> rate) {
  made();
  put_commands(s_.here.state.t);
  equations_->flow(s_.here.state.t, s_.here.state.y, rate);
  return std::all_of(rate.begin(), rate.end(), [](double r) { return std::isfinite(r); });
}

void Instance::indicators(std::span<double> z) {
  made();
  put_commands(s_.here.state.t);
  equations_->guards(s_.here.state.t, s_.here.state.y, z);
  for (double& value : z) value += below_root;
}

Instance::Discrete Instance::pass_events() {
  made();
  follow_parameters();
  State& state = s_.here.state;
  const std::vector<double> before = state.y;
  put_commands(state.t);
  const double passed = apply_inputs();
  std::vector<double> guard(equations_->guard_count());
  for (int round = 0;; ++round) {
    equations_->guards(state.t, state.y, guard);
    std::vector<std::size_t> fired;
    for (std::size_t k = 0; k < guard.size(); ++k)
      if (guard[k] < fired_below) fired.push_back(k);
    if (fired.empty() && round < events_of_a_jam) fired = fall_at_once(*equations_, state.t, state.y);
    if (fired.empty()) break;
    if (round > most_events)
      throw std::runtime_error(
          fmt::format("\"{}\" can neither stay as it is nor change", equations_->guard_owner(fired.front())));
    if (round == events_of_a_jam && equations_->stop_jam(state.t, state.y, fired, events_)) continue;
    if (round == events_without_rest) equations_->regularise(fired);
    equations_->fire(state.t, state.y, fired, events_);
  }
  equations_->wrap(state.y);
  state.modes = equations_->modes();
  const double next = equations_->next_edge(passed);
  return {state.y != before, next < 1e299 ? std::optional(next) : std::nullopt};
}

bool Instance::wants_event() { return made().needs_wrap(s_.here.state.y); }

}  // namespace kurbel
