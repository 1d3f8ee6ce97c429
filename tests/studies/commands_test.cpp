// commands_test.cpp — what an operating sequence may command: for every kind of component and every command either
// the run changes, or the scene is refused with what would be allowed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/model/model.h"
#include "tests/agreement/agreement.h"
#include "tests/support/scenes.h"

namespace kurbel::commands_test {
namespace {

struct CommandGiven {
  const char* name;
  double to = 1, over = 0;
  bool law = false;
};
const CommandGiven commands[] = {
    {"off", 0}, {"half", 0.5}, {"reversed", -1}, {"off by a ramp", 0, 0.15}, {"by a law", 1, 0, true}};

// A short run, and the same with the command given once it is in motion.
Scene short_scene(const std::string& file) {
  Scene scene = read_scene(file, all_kinds());
  scene.sequence = {};
  scene.run.until = std::min(scene.run.until, 0.25);
  return scene;
}
SequenceStep step_of(const std::string& component, const CommandGiven& command) {
  SequenceStep step{.when = SequenceStep::When::at, .value = 0.05, .set = {component}};
  step.to = command.to;
  step.over = command.over;
  if (command.law) {
    step.law = Curve({0, 0.1, 10}, {1, 0.3, 0.3}, Curve::Form::linear);
    step.to = 0.3;
  }
  return step;
}
Result run_of(const Scene& scene) {
  return simulate(scene, scene.effects, "short", {.measure_error = false, .method = {}, .accuracy = 1e-5, .until = {}});
}

// Steps that are refused, all reported at once: by the line that each is said to stand on. A message names the
// component and what to do instead.
std::set<int> refused_steps(Scene scene) {
  for (const Section& s : scene.components)
    for (const CommandGiven& command : commands) {
      scene.sequence.steps.push_back(step_of(s.name, command));
      scene.sequence.steps.back().at.line = static_cast<int>(scene.sequence.steps.size());
    }
  std::set<int> refused;
  try {
    compile(scene, scene.effects);
  } catch (const SceneError& error) {
    for (const Message& message : error.messages) {
      const std::string& text = message.text;
      const SequenceStep& step = scene.sequence.steps.at(static_cast<std::size_t>(message.at.line - 1));
      EXPECT_EQ(text.find("[sequence]: \"" + step.set.front() + "\""), 0U) << text;
      bool helps = false;
      for (const char* words : {"must be", "name a motor", "leave \"over\" out", "in its own table"})
        helps = helps || text.find(words) != std::string::npos;
      EXPECT_TRUE(helps) << text;
      refused.insert(message.at.line);
    }
  }
  return refused;
}

// For each kind and command the machines that take it.
struct Taken {
  std::string file, component;
};
std::map<std::pair<std::string, int>, std::vector<Taken>> machines_that_take() {
  std::map<std::pair<std::string, int>, std::vector<Taken>> list;
  for (const char* folder : {"tests/agreement", "tests/agreement/vibrations", "scenes"})
    for (const std::string& file : agreement::scene_files(test::source_path(folder))) {
      const Scene scene = short_scene(file);
      const std::set<int> refused = refused_steps(scene);
      int line = 0;
      for (const Section& s : scene.components)
        for (int command = 0; command < static_cast<int>(std::size(commands)); ++command)
          if (!refused.count(++line)) list[{s.kind->name, command}].push_back({file, s.name});
    }
  return list;
}

bool differ(const Result& a, const Result& b) {
  for (const Figure& figure : a.figures) {
    const Figure* other = b.find(figure.name);
    if (!other ||
        std::abs(other->value - figure.value) > 1e-4 * std::max(std::abs(figure.value), std::abs(other->value)))
      return true;
  }
  return a.figures.size() != b.figures.size();
}

// A machine in which a command does nothing says little (a load that comes later): one in which it does something is
// looked for. Where none is found, a user's step would be lost.
TEST(Commands, ChangeTheRunOrAreRefused) {
  std::map<std::string, Result> plain;
  const auto taken = machines_that_take();
  EXPECT_TRUE(taken.count({"hydraulic motor", 0}));
  EXPECT_FALSE(taken.count({"hydraulic motor", 1}));  // half of it: on or off
  EXPECT_FALSE(taken.count({"gearbox", 0}));
  for (const auto& [what, machines] : taken) {
    const CommandGiven& command = commands[what.second];
    const auto is_heard = [&](const Taken& machine) {
      Scene scene = short_scene(machine.file);
      if (!plain.count(machine.file)) plain[machine.file] = run_of(scene);
      scene.sequence.steps = {step_of(machine.component, command)};
      return differ(plain[machine.file], run_of(scene));
    };
    EXPECT_TRUE(std::any_of(machines.begin(), machines.end(), is_heard)) << what.first << " told " << command.name;
  }
}

}  // namespace
}  // namespace kurbel::commands_test
