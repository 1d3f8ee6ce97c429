// judged_by_hand_test.cpp — what studies conclude from numbers that are known here: the cheapest setting, the cycle
// that a start leads to, a motor's speed seen from the link.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/accuracy/accuracy.h"
#include "studies/reduce/reduce.h"
#include "studies/response/forced_response.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"
#include "tests/support/steady_simulation.h"

namespace kurbel::judged_by_hand_test {
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
  EXPECT_NE(study.findings[1].find("From 1 % to 1e-07 (relative) each further digit costs 1.0 … 5.0 × the time;"),
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
    const Figure *most = c.find("cycle_max_speed.drive"), *least = c.find("cycle_min_speed.drive");
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
  const test::SteadySimulation s = test::simulate_steady(scene, Effects{}, 11.3, 2 * pi, motor, {}, 10);
  ASSERT_TRUE(s.complete) << s.diagnosis;
  ASSERT_EQ(s.motor.size(), s.link.size());
  for (std::size_t k = 0; k < s.link.size(); ++k) EXPECT_NEAR(s.motor[k], s.link[k], 1e-12 * s.link[k]);
  EXPECT_NEAR(s.motor_delta, s.link_delta, 1e-12);
  const auto [least, most] = std::minmax_element(s.link.begin(), s.link.end());
  EXPECT_NEAR(s.link_delta, (*most - *least) / (0.5 * (*most + *least)), 1e-6);
}

// ½ I ω² gains M · 2π a turn for ever: the speed changes by π M/T₀ of itself, and tends nowhere.
TEST(SteadySimulation, RunawayIsNotSettledHoweverStillItsFluctuation) {
  const Scene scene = test::scene_from(R"(
line = ["drive", "crank"]
drive = { kind = "torque source", torque = "2e-3 N*m" }
crank = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", crank_inertia = "0.3 kg*m2", slider_mass = "30 kg" }
)");
  const auto model = compile(scene, Effects{});
  const test::SteadySimulation s = test::simulate_steady(scene, Effects{}, 10, 2 * pi, model->reduction_node, {}, 10);
  ASSERT_TRUE(s.complete) << s.diagnosis;
  EXPECT_FALSE(s.settled);
  EXPECT_TRUE(std::isinf(s.speed_to_come));
  EXPECT_NEAR(s.speed_change, pi * 2e-3 / (0.5 * 0.3 * 100), 0.01 * s.speed_change);
}

// --- forced response ---

// Two orders and a fixed frequency on two inertias: τ = s f/J₁/(s/J − ω²), s = k + iωc, each by itself.
TEST(ForcedResponse, PeaksLieOnTheSideOfTheLargerAmplitude) {
  const Scene scene = test::scene_from(R"(
line = ["a", "c", "b"]
a = { kind = "inertia", inertia = "0.3 kg*m2" }
c = { kind = "coupling", stiffness = "2500 N*m/rad", damping = "4 N*m*s/rad" }
b = { kind = "inertia", inertia = "0.9 kg*m2" }
push = { kind = "torque source", on = "a", torque = "7 N*m" }
pull = { kind = "load", on = "b", torque = "7 N*m", acts = "always" }
effects = { elasticity = true }
run = { start = { speed = "30 rad/s" }, until = "1 s" }
)");
  const LinearDrive drive = linearise(compile(scene, scene.effects), {.speed = 30});
  const auto a = static_cast<std::size_t>(drive.model->network.ports.at("a").in);
  const auto on_a = static_cast<int>(std::find(drive.shaft.begin(), drive.shaft.end(), drive.model->shaft_of_node[a]) -
                                     drive.shaft.begin());
  const auto torque = [](double omega, Complex force) {
    const Complex spring(2500, omega * 4);
    return spring * force / 0.3 / (spring / 0.225 - omega * omega);
  };
  for (const double side : {1.0, -1.0}) {
    Excitations x;
    x.harmonics = 2;
    x.by_order.push_back({"push", LeftOver::torque, on_a, nullptr, {{0, 20 * side, 11 * side}}});
    x.by_frequency.push_back({"hum", LeftOver::torque, on_a, 51, Complex(3, -4)});
    const Complex first = torque(30, 20 * side), second = torque(60, 11 * side);
    const double beside = std::abs(torque(51, Complex(3, -4)));
    double greatest = -HUGE_VAL, least = HUGE_VAL;
    for (int k = 0; k < 200000; ++k) {
      const double s = 2 * pi * k / 200000,
                   here = (first * std::polar(1.0, s) + second * std::polar(1.0, 2 * s)).real();
      greatest = std::max(greatest, here), least = std::min(least, here);
    }
    EXPECT_GT(side * (greatest + least), 5);
    const JointResponse joint = respond(drive, x).joints.at(0);
    EXPECT_NEAR(joint.mean, 7, 1e-9);
    EXPECT_NEAR(joint.upper, 7 + greatest + beside, 1e-7);
    EXPECT_NEAR(joint.lower, 7 + least - beside, 1e-7);
    EXPECT_NEAR(joint.peak, std::max(greatest, -least) + beside, 1e-7);
    EXPECT_NEAR(joint.amplitude_sum, std::abs(first) + std::abs(second) + beside, 1e-9);
    EXPECT_NEAR(joint.rms, std::sqrt(0.5 * (std::norm(first) + std::norm(second) + beside * beside)), 1e-9);
    double power = 0;
    for (const auto& [omega, tau] : {std::pair(30.0, std::abs(first)), {60.0, std::abs(second)}, {51.0, beside}})
      power += 0.5 * 4 * std::pow(omega * tau / std::hypot(2500, omega * 4), 2);
    EXPECT_NEAR(joint.power, power, 1e-9);
  }
}

// --- reduction, starts, runs ---

// Each inertia of the chain on its own shaft and on the link's: J/i².
TEST(Chain, InertiasKeepTheirOwnShafts) {
  const MachineReduction r = reduce(test::scene_from(R"(
line = ["a", "c", "gear", "b"]
a = { kind = "inertia", inertia = "0.2 kg*m2" }
c = { kind = "coupling", stiffness = "900 N*m/rad", damping = "3 N*m*s/rad", inertia_out = "0.07 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }] }
shaft = { kind = "shaft", stiffness = "700 N*m/rad" }
b = { kind = "inertia", inertia = "3 kg*m2" }
[[branch]]
from = "b"
line = ["shaft", "fan"]
[fan]
kind = "inertia"
inertia = "1.1 kg*m2"
[run]
start = { speed = "20 rad/s" }
)"),
                                    {.positions = 4, .to = "a", .speed = 20.0, .orders = 1});
  double sum = 0;
  bool fan = false;
  for (const ChainInertia& i : r.chain.inertias) {
    EXPECT_NEAR(i.reduced, i.own * i.ratio * i.ratio, 1e-12) << i.name;
    sum += i.reduced;
    if (i.name.find("fan") == std::string::npos) continue;
    fan = true;
    EXPECT_NEAR(i.own, 1.1, 1e-12);
    EXPECT_NEAR(i.reduced, 1.1 / 6.25, 1e-12);
  }
  EXPECT_TRUE(fan);
  EXPECT_NEAR(sum, 0.27 + 4.1 / 6.25, 1e-12);
}

// t = ω i (J_m + J/i²)/M to a speed ω of the driven shaft: least at i = √(J/J_m).
TEST(FastestRatios, DrivenShaftReachesTheSpeedThatItHasNow) {
  const auto found = fastest_ratios(test::scene_from(R"(
line = ["motor", "gear", "fan"]
motor = { kind = "torque source", torque = "40 N*m", inertia = "0.2 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 30] }, { teeth = [25, 50] }] }
fan = { kind = "inertia", inertia = "5 kg*m2" }
)"),
                                    rigid_effects(), 60, 100);
  ASSERT_EQ(found.size(), 1u);
  const auto time = [](double i) { return 60 / 3.0 * i * (0.2 + 5 / (i * i)) / 40; };  // the fan turns at 60/3 now
  EXPECT_NEAR(found[0].present, 3, 1e-12);
  EXPECT_NEAR(found[0].present_time, time(3), 1e-6);
  EXPECT_NEAR(found[0].best, 5, 1e-2);
  EXPECT_NEAR(found[0].best_time, time(5), 1e-6);
}

// Losses of a stage leave the other one to be changed, and the ratio is that of both; losses that join the ends of the gearbox
// leave none, for the shaft between them alone would turn otherwise.
TEST(FastestRatios, AreOfTheWholeGearbox) {
  const auto search = [](const char* keys) {
    return fastest_ratios(test::scene_from(fmt::format(R"(
line = ["motor", "gear", "fan"]
motor = {{ kind = "torque source", torque = "40 N*m", inertia = "0.2 kg*m2" }}
gear = {{ kind = "gearbox", {} }}
fan = {{ kind = "inertia", inertia = "5 kg*m2" }}
)",
                                                       keys)),
                          rigid_effects(), 60, 100);
  };
  const auto of_one = search("stages = [{ teeth = [20, 30], efficiency = 1 }, { teeth = [25, 50] }]");
  ASSERT_EQ(of_one.size(), 1u);
  EXPECT_NEAR(of_one[0].present, 3, 1e-12);
  EXPECT_NEAR(of_one[0].best, 5, 1e-2);
  EXPECT_TRUE(search("stages = [{ teeth = [20, 30] }, { teeth = [25, 50] }], efficiency = 1").empty());
}

// √(∫τ² dt/t) over the time that it ran, when set to run shorter than its scene: J₂/(J₁ + J₂) M, constant.
TEST(Figures, RootMeanSquareIsOverTheTimeThatWasRun) {
  const Scene scene = test::scene_from(R"(
line = ["a", "c", "b"]
a = { kind = "inertia", inertia = "0.3 kg*m2" }
c = { kind = "coupling", stiffness = "2500 N*m/rad" }
b = { kind = "inertia", inertia = "0.9 kg*m2" }
push = { kind = "torque source", on = "a", torque = "8 N*m" }
run = { until = "2 s" }
)");
  const Result r =
      simulate(scene, scene.effects, "short", {.measure_error = false, .method = {}, .accuracy = {}, .until = 0.3});
  EXPECT_NEAR(test::figure(r, "rms_torque.c"), 6, 1e-8);
}

}  // namespace
}  // namespace kurbel::judged_by_hand_test
