// judged_by_hand_test.cpp — what studies conclude from numbers that are known here: the cheapest setting, the cycle
// that a start leads to, a motor's speed seen from the link.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/accuracy.h"
#include "studies/steady.h"
#include "studies/steady_simulation.h"
#include "tests/support/scenes.h"

namespace kurbel {
namespace {

constexpr double pi = std::numbers::pi;

// --- what accuracy costs ---

MeasuredSetting setting(double tolerance, double error, double seconds) {
  MeasuredSetting s;
  s.method = "dop853", s.tolerance = tolerance;
  s.trajectory_error = error, s.numerical_error = {error}, s.total_error = {error};
  s.seconds = seconds;
  return s;
}
AccuracyStudy three_settings() {
  AccuracyStudy study;
  study.figures = {{"delta.crank", ""}};
  study.levels = {{.name = "rigid", .first = "dop853", .second = "esdirk", .value = {1}, .floor = {0}}};
  study.levels[0].model_error = {0};
  study.settings = {setting(1e-8, 1e-7, 0.5), setting(1e-4, 3e-3, 0.02), setting(1e-6, 2e-5, 0.1)};
  return study;
}

TEST(Accuracy, AnswersNameTheCheapestAndTheMostExact) {
  AccuracyStudy study = three_settings();
  AccuracyOptions options;
  options.within = 1e-2, options.budget = 0.2;
  judge_accuracy(study, options);
  ASSERT_EQ(study.answers.size(), 2u);
  EXPECT_NE(study.answers[0].find("dop853 at 1e-04"), std::string::npos) << study.answers[0];
  EXPECT_NE(study.answers[0].find("20 ms, measured 0.3 %"), std::string::npos) << study.answers[0];
  EXPECT_NE(study.answers[1].find("dop853 at 1e-06"), std::string::npos) << study.answers[1];
  EXPECT_NE(study.findings.front().find("For 1 % in delta.crank"), std::string::npos) << study.findings.front();
  EXPECT_NE(study.findings.front().find("dop853 at 1e-04"), std::string::npos) << study.findings.front();
  // 1e-3: 0.1 s, five times as much; 1e-4 the same; 1e-5 … 1e-7: 0.5 s.
  EXPECT_NE(study.findings[1].find("from 1 % to 1e-07 (relative) the time grows by 5 ×, 1 ×, 5 ×, 1 ×, 1 ×;"),
            std::string::npos)
      << study.findings[1];
  for (const MeasuredSetting& s : study.settings) EXPECT_TRUE(s.on_front && s.on_level_front);
}

// --- steady motion ---

// A drive that holds 10 as well as 40 rad/s, shaken a little over time: the start says which.
TEST(Steady, CycleOfATimedMachineIsTheOneThatTheStartIsNearTo) {
  for (const double link : {11.0, 38.0}) {
    const SteadyStudy study = steady(test::scene_from(fmt::format(R"(
line = ["drive", "gear", "mill"]
drive = {{ kind = "torque source", table = {{ over = "speed", unit = ["rad/s", "N*m"], points = [[0, 50], [10, 0], [20, -50], [25, 0], [30, 50], [40, 0], [50, -50]] }}, inertia = "0.8 kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [20, 50] }}] }}
mill = {{ kind = "inertia", inertia = "1.5 kg*m2" }}
hum = {{ kind = "torque source", on = "drive", amplitude = "3 N*m", frequency = "4 Hz" }}
run = {{ until = "1 s", start = {{ on = "mill", speed = "{} rad/s" }} }}
)",
                                                                  link / 2.5)),
                                     {Effects{}}, {.start_search = false});
    ASSERT_TRUE(study.complete) << study.diagnosis;
    const SteadyCycle& c = study.cycles[0];
    // About either point −5 N·m·s/rad: a linear machine under a sine.
    const double middle = link < 25 ? 10 : 40, inertia = 0.8 + 1.5 / 6.25, omega = 8 * pi;
    const double swing = 3 / std::hypot(5, omega * inertia);
    const Figure *most = c.find("max_speed.drive"), *least = c.find("min_speed.drive");
    ASSERT_TRUE(most && least);
    EXPECT_NEAR(most->value, middle + swing, 1e-8);
    EXPECT_NEAR(least->value, middle - swing, 1e-8);
  }
}

// Rigid, the motor's speed reduced to the link is the link's, its δ the same.
TEST(SteadySimulation, MotorBehindAGearTurnsWithTheLink) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "gear", "pump"]
motor = { kind = "dc shunt motor", stall_torque = "300 N*m", no_load_speed = "40 rad/s", inertia = "0.6 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 70] }] }
pump = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", slider_mass = "60 kg", load = { kind = "opposing", force = "300 N" } }
)");
  const auto model = compile(scene, Effects{});
  const int motor = model->network.ports.at("motor").in;
  const SteadySimulation s = simulate_steady(scene, Effects{}, 11.3, 2 * pi, motor, {}, 10);
  ASSERT_TRUE(s.complete) << s.diagnosis;
  ASSERT_EQ(s.motor.size(), s.link.size());
  for (std::size_t k = 0; k < s.link.size(); ++k) EXPECT_NEAR(s.motor[k], s.link[k], 1e-12 * s.link[k]);
  EXPECT_NEAR(s.motor_delta, s.link_delta, 1e-12);
  const auto [least, most] = std::minmax_element(s.link.begin(), s.link.end());
  EXPECT_NEAR(s.link_delta, (*most - *least) / (0.5 * (*most + *least)), 1e-6);
}

}  // namespace
}  // namespace kurbel
