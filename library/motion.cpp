// motion.cpp — a machine stepped by its user: each advance is a run from the checkpoint where the last one ended.
#include <kurbel/state.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "engine/run/checkpoint.h"
#include "engine/run/recorders.h"
#include "library/machine_parts.h"

namespace kurbel {

struct SavedParts {
  Checkpoint checkpoint;
  std::string text;
};

struct MotionParts {
  MotionParts(std::shared_ptr<const Model> model, double step_tolerance)
      : equations(std::move(model), false),
        channels(channels_of(equations.model(), {})),
        tolerance(step_tolerance),
        method(equations.model().scene.run.method) {
    here.state.t = 0;
    here.state.y = equations.start(0);
    here.state.modes = equations.modes();
  }

  void go_to(double time, const Watcher& watcher) {
    RunOptions options;
    options.tolerance = tolerance, options.method = method, options.until = time;
    options.budget = equations.model().scene.run.budget;
    options.checkpoint = &here;
    options.to_go_on = true;
    options.interrupted = watcher.interrupted;
    if (watcher.progress)
      options.progress = [&watcher, from = here.state.t, time](double fraction) {
        watcher.progress("on the way", (fraction * time - from) / (time - from));
      };
    const RunOutcome outcome = integrate(equations, options, {});
    if (outcome.complete) here = outcome.checkpoint;
    stand();
    if (!outcome.complete) throw std::runtime_error(outcome.diagnosis);
  }

  // Sets the equations' modes to those of the current state.
  void stand() { equations.bind(here.state.modes); }

  const Snapshot& now() { return equations.snapshot(here.state.t, here.state.y); }

  Equations equations;
  std::vector<Channel> channels;
  double tolerance;
  std::string method;
  Checkpoint here;
};

namespace {

std::unique_ptr<MotionParts> begun(const Machine& machine, const std::string& effects, double tolerance) {
  if (!(tolerance >= 1e-14 && tolerance <= 0.1)) throw std::invalid_argument("tolerance must be 1e-14 … 0.1");
  return asked_of(machine.parts(), [&] {
    const Scene& scene = machine.parts().scene;
    if (scene.run.model != "reduced")
      throw std::invalid_argument("a motion belongs to the reduced model; set run.model = \"reduced\"");
    return std::make_unique<MotionParts>(
        compile(scene, effects.empty() ? scene.effects : parse_effects(effects, scene)), tolerance);
  });
}

}  // namespace

double SavedState::time() const { return parts_->checkpoint.state.t; }
const std::vector<double>& SavedState::y() const { return parts_->checkpoint.state.y; }
std::string SavedState::text() const { return parts_->text; }
bool operator==(const SavedState& a, const SavedState& b) { return a.parts_->checkpoint == b.parts_->checkpoint; }

Motion::Motion(const Machine& machine, const std::string& effects, double tolerance)
    : parts_(begun(machine, effects, tolerance)) {}
Motion::~Motion() = default;
Motion::Motion(Motion&&) noexcept = default;
Motion& Motion::operator=(Motion&&) noexcept = default;

MotionParts& Motion::parts() const {
  if (!parts_) throw std::logic_error("this Motion was moved from; assign another one to it first");
  return *parts_;
}

double Motion::time() const { return parts().here.state.t; }

void Motion::go_to(double time, const Watcher& watcher) {
  if (!(time >= this->time()))
    throw std::invalid_argument(
        fmt::format("go_to({:g}): the motion is at {:g} s; restore an earlier state to go back", time, this->time()));
  if (time > this->time()) parts().go_to(time, watcher);
}

SavedState Motion::state() const {
  return SavedState(
      std::make_shared<const SavedParts>(SavedParts{parts().here, text_of(parts().here, parts().equations)}));
}

void Motion::restore(const SavedState& state) {
  // Through its text, which is checked against this machine.
  parts().here = checkpoint_from(state.parts().text, parts().equations);
  parts().stand();
}

SavedState Motion::state_from(const std::string& text) const {
  return SavedState(std::make_shared<const SavedParts>(SavedParts{checkpoint_from(text, parts().equations), text}));
}

std::vector<std::string> Motion::names() const {
  std::vector<std::string> names;
  for (const Channel& channel : parts().channels) names.push_back(channel.name.text);
  return names;
}

std::vector<std::string> Motion::units() const {
  std::vector<std::string> units;
  for (const Channel& channel : parts().channels) units.push_back(channel.unit);
  return units;
}

double Motion::operator[](const std::string& name) const {
  const auto found = std::find_if(parts().channels.begin(), parts().channels.end(),
                                  [&](const Channel& channel) { return channel.name.text == name; });
  if (found == parts().channels.end()) refuse_name("the machine", name, names());
  return found->value(parts().now());
}

std::vector<double> Motion::values() const {
  const Snapshot& now = parts().now();
  std::vector<double> values;
  for (const Channel& channel : parts().channels) values.push_back(channel.value(now));
  return values;
}

std::vector<std::string> Motion::state_names() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parts().equations.size(); ++i) names.push_back(parts().equations.state_name(i));
  return names;
}

}  // namespace kurbel
