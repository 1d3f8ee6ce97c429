// step_limits_test.cpp — a run says which elements kept its steps short, and a run that breaks off says why in words.
#include "engine/run/step_limits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/run/diagnosis.h"
#include "tests/support/scenes.h"

namespace kurbel::step_limits_test {
namespace {

// Five masses in a row that vibrate; the spring `stiff` is ten thousand times as stiff as the others.
std::string chain(const std::string& stiff, const std::string& method) {
  std::string text = "line = [\"m0\"", tables;
  for (int i = 0; i < 5; ++i) {
    const std::string c = fmt::format("c{}", i);
    if (i > 0) {
      text += fmt::format(", \"{}\", \"m{}\"", c, i);
      tables += fmt::format("{} = {{ kind = \"coupling\", stiffness = \"{} N*m/rad\", damping_ratio = 1e-4 }}\n", c,
                            c == stiff ? "1e6" : "100");
    }
    tables += fmt::format("m{} = {{ kind = \"inertia\", inertia = \"0.1 kg*m2\" }}\n", i);
  }
  return text + "]\n" + tables +
         "shaker = { on = \"m2\", kind = \"torque source\", amplitude = \"20 N*m\", frequency = \"3 Hz\" }\n"
         "effects = { elasticity = true }\nrun = { start = { m1 = { speed = \"4 rad/s\" }, m3 = { speed = \"2 rad/s\" "
         "} }, "
         "until = \"0.2 s\", accuracy = 1e-5, method = \"" +
         method + "\" }\n";
}

class StiffSpring : public ::testing::TestWithParam<const char*> {};

TEST_P(StiffSpring, AmongSoftOnesIsTheOneThatIsNamed) {
  for (const char* stiff : {"c1", "c3", "c4"}) {
    const Result r = test::run(chain(stiff, GetParam()), false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const std::vector<LimitedSteps>& limits = r.statistics.limits;
    ASSERT_FALSE(limits.empty());
    EXPECT_EQ(limits[0].element, stiff) << reported(limits);
    double share = 0, of_stiff = 0;
    std::int64_t steps = 0;
    for (const LimitedSteps& l : limits) {
      share += l.share;
      steps += l.steps;
      if (l.element == stiff) of_stiff += l.share;
    }
    EXPECT_NEAR(share, 1, 1e-12);
    EXPECT_EQ(steps, r.statistics.stepper.steps);
    EXPECT_GT(of_stiff, 0.8) << reported(limits);
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, StiffSpring,
                         ::testing::Values("auto", "dopri5", "verner6", "dop853", "esdirk", "bdf", "adams"),
                         [](const auto& info) { return std::string(info.param); });

// Each load edge of a stiff press excites a vibration that rings for a tenth of the cycle: explicit steps resolve it, and
// the rest passes in implicit ones. By explicit steps alone stability holds all of them.
TEST(StepLimits, OfAStiffPressAreShortOnlyWhileItRings) {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  for (Section& section : scene.components)
    for (Setting& setting : section.settings)
      if (setting.key == "stiffness") setting.number *= 1000;
  scene.run.until = 4;
  scene.run.accuracy = 1e-4;
  const Result chosen = test::run(scene, false);
  scene.run.method = "dop853";
  const Result explicit_only = test::run(scene, false);
  ASSERT_TRUE(chosen.complete && explicit_only.complete);
  EXPECT_LT(4 * chosen.statistics.stepper.steps, explicit_only.statistics.stepper.steps);
  for (const char* name : {"peak_torque.motor_coupling", "peak_torque.main_coupling", "final_speed.press"})
    EXPECT_NEAR(test::figure(chosen, name) / test::figure(explicit_only, name), 1, 1e-5) << name;
}

// A fast circuit among slow masses; a motor with a steep characteristic on a light rotor.
TEST(StepLimits, OfACircuitAndOfASteepMotorAreTheirs) {
  const std::string machine =
      "line = [\"motor\", \"c\", \"fan\"]\nc = {{ kind = \"coupling\", stiffness = \"100 N*m/rad\", damping_ratio = "
      "0.1 }}\n"
      "fan = {{ kind = \"load\", quadratic = \"1e-3 N*m*s2/rad2\", inertia = \"1 kg*m2\" }}\n"
      "motor = {{ kind = \"dc shunt motor\", voltage = \"100 V\", resistance = \"1 Ohm\", constant = \"0.5 N*m/A\", "
      "inertia = \"{}\"{} }}\neffects = {{ elasticity = true }}\nrun = {{ until = \"0.5 s\", method = \"dop853\" }}\n";
  const Result circuit = test::run(fmt::format(fmt::runtime(machine), "0.05 kg*m2", ", inductance = \"20 uH\""), false);
  EXPECT_EQ(circuit.statistics.limits[0].element, "motor") << reported(circuit.statistics.limits);
  EXPECT_EQ(circuit.statistics.limits[0].states[0], "current of motor");
  const Result steep = test::run(fmt::format(fmt::runtime(machine), "5e-6 kg*m2", ""), false);
  EXPECT_EQ(steep.statistics.limits[0].element, "motor") << reported(steep.statistics.limits);
  EXPECT_EQ(steep.statistics.limits[0].by, "stability");
}

// Load edges end the steps of a drive that is smooth otherwise.
TEST(StepLimits, OfEventsAndEdgesAreReported) {
  const Result r = test::run(
      "line = [\"disc\"]\ndisc = { kind = \"inertia\", inertia = \"1 kg*m2\" }\n"
      "push = { on = \"disc\", kind = \"torque source\", table = { over = \"time\", unit = [\"s\", \"N*m\"], period = "
      "\"0.1 "
      "s\", points = [[0, 0], [0.05, 1], [0.1, 0]] } }\nrun = { until = \"2 s\", method = \"dop853\" }\n",
      false);
  EXPECT_EQ(r.statistics.limits[0].by, "edges in time") << reported(r.statistics.limits);
  EXPECT_GT(r.statistics.limits[0].share, 0.6);
}

// A pulse of 1° a turn: its formula has knots that steps end on, and nothing happens there.
TEST(StepLimits, OfKnotsOfAFormulaAreNoEvents) {
  const Result r = test::run(
      "line = [\"disc\"]\ndisc = { kind = \"flywheel\", inertia = \"10 kg*m2\" }\npush = { on = \"disc\", kind = "
      "\"torque source\", table = { over = \"angle\", formula = \"10 [N*m]*exp(-((angle - 2 [rad])/0.01 [rad])^2)\", "
      "period = \"360 deg\" } }\nrun = { start = { speed = \"20 rad/s\" }, until = \"2 s\", method = \"dop853\" }\n",
      false);
  EXPECT_TRUE(r.events.empty());
  EXPECT_EQ(r.statistics.events, 0);
  EXPECT_GT(r.statistics.knots, 12);  // six turns
  EXPECT_EQ(r.statistics.limits[0].by, "knots");
  EXPECT_NE(reported(r.statistics.limits).find("knots of \"push\""), std::string::npos)
      << reported(r.statistics.limits);
}

// --- words for a run that breaks off ---

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Diagnosis, OfASpentBudgetNamesTheElementAndWhatToTry) {
  Scene scene = test::scene_from(chain("c3", "dop853"));
  scene.run.until = 1000;
  scene.run.budget = 0.05;
  const Result r = test::run(scene, false);
  ASSERT_FALSE(r.complete);
  for (const char* part :
       {"stopped at t = ", "the budget of 0.05 s", "\"c3\"", "no events before", "accuracy = 0.0001 (now 1e-05)",
        "method = \"esdirk\" (now \"dop853\")", "stiffness = 1e+06 N·m/rad", "effects.elasticity"})
    EXPECT_TRUE(has(r.diagnosis, part)) << part << "\n" << r.diagnosis;
}

TEST(Diagnosis, OfALostValueNamesTheStateItsElementAndTheLastEvents) {
  const Scene scene = test::scene_from(chain("c3", "dop853"));
  Equations equations(compile(scene, scene.effects), false);
  RunOutcome outcome;
  outcome.state = equations.start(0);
  for (int i = 0; i < 5; ++i) outcome.events.push_back({0.1 * i, "clutch", fmt::format("event {}", i)});
  const Breakdown broken{Breakdown::Kind::not_finite, 0.5, "a value was lost", equations.speed_index(3)};
  const std::string text = diagnosis(broken, equations, {.method = "dop853", .progress = {}}, outcome);
  EXPECT_EQ(text.find("stopped at t = 0.5 s: a value was lost; the speed of "), 0u) << text;
  for (const char* part : {"lost its value, by \"c3\"", "event 2 at 0.2 s", "event 4 at 0.4 s",
                           "other values of \"c3\" (now stiffness = 1e+06 N·m/rad, damping_ratio = "})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  EXPECT_FALSE(has(text, "event 1"));
  EXPECT_FALSE(has(text, "accuracy ="));  // a looser one brings no value back
}

}  // namespace
}  // namespace kurbel::step_limits_test
