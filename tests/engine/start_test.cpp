// start_test.cpp — a start keeps every tie of the machine: relations, and what turns unloaded through elastic joints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "engine/events/equations.h"
#include "engine/numerics/index.h"
#include "engine/run/run.h"
#include "tests/support/scenes.h"

namespace kurbel::start_test {
namespace {

constexpr double degree = M_PI / 180;

std::string joint(const std::string& name, double angle, double phase) {
  return fmt::format(
      "{} = {{ kind = \"universal joint\", angle = \"{} deg\", phase = \"{} deg\", stiffness = \"5 kN*m/rad\" }}\n",
      name, angle, phase);
}
std::string body(const std::string& name) { return name + " = { kind = \"inertia\", inertia = \"0.4 kg*m2\" }\n"; }

// A joint before a differential, joints behind both of its outputs; a planetary gear behind one of them.
std::string axle() {
  return "line = [\"drive\", \"front\", \"axle\", \"left_joint\", \"left\", \"soft\", \"far\"]\n" + body("drive") +
         joint("front", 35, 10) + joint("left_joint", 20, 0) + joint("right_joint", 50, -25) + body("left") +
         body("right") + body("far") +
         "axle = { kind = \"differential\", ratio = 2.5, inertia_in = \"0.1 kg*m2\", cage_inertia = \"0.1 kg*m2\", "
         "output_inertia = \"0.05 kg*m2\" }\n"
         "soft = { kind = \"coupling\", stiffness = \"300 N*m/rad\" }\n"
         "effects = { elasticity = true }\nrun = { until = \"1 s\" }\n"
         "[[branch]]\nfrom = \"axle.second\"\nline = [\"right_joint\", \"right\"]\n";
}
std::string planetary() {
  return "line = [\"drive\", \"front\", \"gear\", \"behind\", \"load\"]\n" + body("drive") + joint("front", 40, 0) +
         joint("behind", 25, 30) + joint("side", 30, 5) + body("load") + body("ring") +
         "gear = { kind = \"planetary gear\", sun = 30, ring = 80, sun_inertia = \"0.01 kg*m2\", carrier_inertia = "
         "\"0.02 kg*m2\", ring_inertia = \"0.03 kg*m2\" }\n"
         "effects = { elasticity = true }\nrun = { until = \"1 s\" }\n"
         "[[branch]]\nfrom = \"gear.ring\"\nline = [\"side\", \"ring\"]\n";
}
std::string lossy() {
  return "line = [\"drive\", \"front\", \"box\", \"behind\", \"load\"]\n" + body("drive") + joint("front", 70, 20) +
         joint("behind", 25, 30) + body("load") +
         "box = { kind = \"gearbox\", stages = [{ teeth = [17, 41], inertia = [\"1e-3 kg*m2\", \"0.02 kg*m2\"], "
         "efficiency = 0.97 }] }\n"
         "effects = { elasticity = true, gear_losses = true }\nrun = { until = \"1 s\" }\n";
}

void expect_ties_kept(const Scene& scene, const StartSettings& start) {
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  const std::vector<double> y = equations.start(0, start);
  const Snapshot& now = equations.snapshot(0, y);
  const auto angle = [&](int shaft) { return now.node_angle[model->shafts[at(shaft)].reference]; };
  for (const ShaftRelation& relation : model->relations) {
    double speed = 0, speeds = 0, turn = 0, turns = 0;
    for (const ShaftGain& g : relation.motion) {
      speed += g.gain * now.now.speed[g.shaft], speeds += std::abs(g.gain * now.now.speed[g.shaft]);
      turn += g.gain * angle(g.shaft), turns += std::abs(g.gain * angle(g.shaft));
    }
    EXPECT_LE(std::abs(speed), 1e-14 * speeds);
    EXPECT_LE(std::abs(turn), 1e-14 * (turns + 1));
  }
  for (const ElasticJoint& e : model->elastic) {
    const AnyConnection& element = *model->network.joints[at(e.joint)].element;
    const double a = e.gain_a * angle(e.shaft_a), b = e.gain_b * angle(e.shaft_b);
    EXPECT_NEAR(a - b, element.rest_twist(a), 1e-14 * (1 + std::abs(a)));
    const double in = e.gain_a * now.now.speed[e.shaft_a], out = e.gain_b * now.now.speed[e.shaft_b];
    EXPECT_NEAR(out, element.rest_ratio(a) * in, 2e-13 * std::abs(in)) << model->network.joints[at(e.joint)].component;
  }
  const int on = start.on.empty() ? model->reduction_node : model->network.ports.at(start.on).in;
  EXPECT_NEAR(now.node_angle[on], start.angle, 1e-14 * (1 + std::abs(start.angle)));
  EXPECT_NEAR(model->gain_of_node[at(on)] * now.now.speed[model->shaft_of_node[at(on)]], start.speed,
              1e-14 * std::abs(start.speed));
}

TEST(Start, KeepsEveryTieAtAnyAngleOnAnyComponent) {
  for (const std::string& text : {axle(), planetary(), lossy()}) {
    const Scene scene = test::scene_from(text);
    for (const char* on : {"", "drive", "front", "left", "right", "far", "load", "ring"}) {
      if (*on && !scene.find(on)) continue;
      for (const double angle : {0.0, 17.0, 90.0, -133.0, 3000.0})
        for (const double speed : {0.0, 12.0, -70.0}) {
          SCOPED_TRACE(fmt::format("on \"{}\" at {} deg with {} rad/s", on, angle, speed));
          StartSettings start;
          start.on = on, start.angle = angle * degree, start.speed = speed;
          expect_ties_kept(scene, start);
        }
    }
  }
}

// Behind a differential a universal joint at φ = 0 starts at 1/cos β, not at its mean ratio of 1.
TEST(Start, BehindADifferentialTurnsAUniversalJointByItsRatioThere) {
  const Scene scene =
      test::scene_from("line = [\"drive\", \"axle\", \"joint\", \"left\"]\n" + body("drive") + body("left") +
                       body("right") + joint("joint", 60, 0) +
                       "axle = { kind = \"differential\", output_inertia = \"0.05 kg*m2\" }\n"
                       "effects = { elasticity = true }\nrun = { until = \"1 ms\", start = { speed = \"10 rad/s\" } }\n"
                       "[[branch]]\nfrom = \"axle.second\"\nline = [\"right\"]\n");
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  const std::vector<double> y = equations.start(0);
  const auto speed = [&](const char* name) {
    const int node = model->network.ports.at(name).in;
    return model->gain_of_node[at(node)] * y[equations.speed_index(model->shaft_of_node[at(node)])];
  };
  EXPECT_NEAR(speed("right"), 10, 1e-13);
  EXPECT_NEAR(speed("left"), 20, 1e-13);
}

// What is given for a member of a relation the others make up for.
TEST(Start, GivenSpeedsOfMembersKeepTheRelation) {
  const Scene scene = test::scene_from(planetary());
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  for (const double sun : {-40.0, 0.0, 55.0}) {
    StartSettings start;
    start.speed = 8;
    start.components["gear"].speed = sun;
    const std::vector<double> y = equations.start(0, start);
    const Snapshot& now = equations.snapshot(0, y);
    for (const ShaftRelation& relation : model->relations) {
      double sum = 0, size = 0;
      for (const ShaftGain& g : relation.motion)
        sum += g.gain * now.now.speed[g.shaft], size += std::abs(g.gain * now.now.speed[g.shaft]);
      EXPECT_LE(std::abs(sum), 1e-14 * size);
    }
    const int s = model->shaft_of_node[at(model->network.ports.at("gear").in)];
    EXPECT_EQ(now.now.speed[s], sun);
  }
}

// A start knows nothing of an earlier start, nor of a run that ended elsewhere: states and modes are the same to the bit.
TEST(Start, IsTheSameWheneverItIsMade) {
  std::size_t scenes = 0;
  for (const char* folder : {"scenes", "tests/agreement", "tests/agreement/vibrations"})
    for (const auto& file : std::filesystem::directory_iterator(test::source_path(folder))) {
      if (file.path().extension() != ".toml") continue;
      SCOPED_TRACE(file.path().filename());
      Scene scene = read_scene(file.path(), all_kinds());
      for (const bool balanced : {false, true}) {
        scene.run.start.equilibrium = balanced;
        try {
          Equations equations(compile(scene, scene.effects), false);
          std::vector<double> y;
          const auto made_anew = [&](const char* after) {
            const std::vector<double> again = equations.start(0);
            Equations fresh(equations.shared_model(), false);
            y = fresh.start(0);
            EXPECT_EQ(y, again) << after;
            // Shares of redundant contacts are weighed by the torques of the evaluation before.
            Modes modes = equations.modes();
            modes.capacity = fresh.modes().capacity;
            EXPECT_TRUE(fresh.modes() == modes) << after;
          };
          equations.start(0);
          made_anew("a start");
          integrate(equations, {.tolerance = 1e-5, .method = "auto", .until = 0.02, .budget = 2, .progress = {}}, {});
          made_anew("a run");
          ++scenes;
        } catch (const std::exception&) {  // no start in equilibrium, or one that needs a file
        }
      }
    }
  EXPECT_GT(scenes, 150);
}

// Deforming parts stand in balance with the accelerations of a machine that they load themselves: another balance leaves
// every state where it is.
TEST(Start, BalancesDeformingPartsWithTheMachine) {
  const Scene scene = read_scene(test::source_path("scenes/flexible_rod.toml"), all_kinds());
  ASSERT_TRUE(scene.run.start.equilibrium);
  Equations equations(compile(scene, scene.effects), false);
  const std::vector<double> y = equations.start(0);
  ASSERT_TRUE(equations.has_followers());
  equations.evaluate(0, y);
  std::vector<double> again = y;
  equations.balance_followers(again.data() + equations.internal_begin());
  std::size_t deformed = 0;
  for (std::size_t i = equations.internal_begin(); i < equations.state_count(); ++i) {
    EXPECT_NEAR(again[i], y[i], 1e-13 * std::abs(y[i])) << i;
    deformed += y[i] != 0;
  }
  EXPECT_GT(deformed, 0u);
}

}  // namespace
}  // namespace kurbel::start_test
