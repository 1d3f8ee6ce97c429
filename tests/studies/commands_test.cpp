// commands_test.cpp — what an operating sequence may tell a component: for every kind of component and every command either
// the run changes, or the scene is refused with what would be allowed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "drivetrain/kinds.h"
#include "mechanisms/kinds/kinds.h"
#include "tests/agreement/agreement.h"
#include "tests/support/scenes.h"

namespace kurbel {
namespace {

struct CommandGiven {
  const char* name;
  double to = 1, over = 0;
  bool law = false;
};
const CommandGiven commands[] = {
    {"off", 0}, {"half", 0.5}, {"reversed", -1}, {"off by a ramp", 0, 0.4}, {"by a law", 1, 0, true}};

struct Machine {
  std::string file, component;
};

// For each kind the machines of the matrix that have one.
std::map<std::string, std::vector<Machine>> machines_by_kind() {
  std::map<std::string, std::vector<Machine>> list;
  for (const char* folder : {"tests/agreement", "tests/agreement/swings", "scenes"})
    for (const std::string& file : agreement::scene_files(test::source_path(folder)))
      for (const Section& s : read_scene(file, all_kinds()).components) list[s.kind->name].push_back({file, s.name});
  return list;
}

// A short run, and the same with the command given 50 ms after the start, once in motion.
Scene short_scene(const std::string& file) {
  Scene scene = read_scene(file, all_kinds());
  scene.sequence = {};
  scene.run.until = std::min(scene.run.until, 0.5);
  return scene;
}
Scene told(Scene scene, const std::string& component, const CommandGiven& command) {
  SequenceStep step{.when = SequenceStep::When::at, .value = 0.05, .set = {component}};
  step.to = command.to;
  step.over = command.over;
  if (command.law) {
    step.law = Curve({0, 0.1, 10}, {1, 0.3, 0.3}, Curve::Form::linear);
    step.to = 0.3;
  }
  scene.sequence.steps = {step};
  return scene;
}

// Nothing: it is refused. Its message names the component and what to do instead.
std::optional<Result> run_unless_refused(const Scene& scene, const std::string& component) try {
  return simulate(scene, scene.effects, "told", {.measure_error = false, .method = {}, .accuracy = 1e-6, .until = {}});
} catch (const SceneError& error) {
  const std::string text = error.what();
  EXPECT_NE(text.find("[sequence]: \"" + component + "\""), std::string::npos) << text;
  EXPECT_TRUE(text.find("must be") != std::string::npos || text.find("name a motor") != std::string::npos ||
              text.find("leave \"over\" out") != std::string::npos ||
              text.find("in its own table") != std::string::npos)
      << text;
  return std::nullopt;
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

// A machine in which the command does nothing says little (a brake that is worn to nothing, a load that comes later):
// one in which it does something is looked for. Where none is found, a user's step would be lost.
TEST(Commands, ChangeTheRunOrAreRefused) {
  std::map<std::string, Result> plain;
  for (const auto& [kind, machines] : machines_by_kind())
    for (const CommandGiven& command : commands) {
      bool heard = false, accepted = false;
      for (const Machine& machine : machines) {
        const Scene scene = short_scene(machine.file);
        const std::optional<Result> with =
            run_unless_refused(told(scene, machine.component, command), machine.component);
        if (!with) continue;
        accepted = true;
        if (!plain.count(machine.file))
          plain[machine.file] = simulate(scene, scene.effects, "plain",
                                         {.measure_error = false, .method = {}, .accuracy = 1e-6, .until = {}});
        heard = differ(plain[machine.file], *with);
        if (heard) break;
      }
      EXPECT_TRUE(heard || !accepted) << kind << " told " << command.name;
    }
}

}  // namespace
}  // namespace kurbel
