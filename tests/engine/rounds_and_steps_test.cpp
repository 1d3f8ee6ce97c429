// rounds_and_steps_test.cpp — cycles of a machine whose speed is given behind a gear, events that time brings, steps
// whatever the unit of time, and machines over their angle that turn backwards.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/numerics/curve.h"
#include "engine/return_map/return_map.h"
#include "engine/return_map/sensitivities.h"
#include "engine/rigid/work_equation.h"
#include "engine/run/recorders.h"
#include "studies/modes/modes.h"
#include "tests/published/published.h"

namespace kurbel::rounds_and_steps_test {
namespace {

using std::numbers::pi;
using test::figure;
using test::model_of;
using test::run;
using test::scene_from;
using test::series;

const std::string gear_2_5 = "gear = { kind = \"gearbox\", stages = [{ teeth = [20, 50] }] }\n";
std::string crank(const std::string& more = "") {
  return "crank = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", crank_inertia = \"0.2 kg*m2\", "
         "slider_mass = \"4 kg\"" +
         more + " }\n";
}
double slope_of_travel(double phi) {
  const double r = 0.1, l = 0.35, s = std::sin(phi), c = std::cos(phi);
  return -r * s - r * r * s * c / std::sqrt(l * l - r * r * s * s);
}
double crank_inertia(double phi) { return 0.2 + 4 * std::pow(slope_of_travel(phi), 2); }

// --- cycles ----------------------------------------------------------------------------------------------------------

// A law over the angle of a shaft that turns 2.5 times slower repeats after 2.5 turns of the link; with a crank there,
// too, after five.
TEST(Periodicity, OfALawBehindAGear) {
  const std::string load =
      "load = { kind = \"load\", inertia = \"0.3 kg*m2\", table = { over = \"angle\", unit = [\"deg\", \"N*m\"], "
      "points = "
      "[[0, 3], [90, 5], [200, 1]] } }\n";
  const auto turned = model_of("line = [\"motor\", \"gear\", \"load\"]\n" + load + gear_2_5 +
                               "motor = { kind = \"dc shunt motor\", stall_torque = \"50 N*m\", no_load_speed = \"60 "
                               "rad/s\", inertia = \"0.4 kg*m2\" }\n");
  EXPECT_NEAR(periodicity_of(*turned).angle, 2.5 * 2 * pi, 1e-12);
  const auto both = model_of("line = [\"crank\", \"gear\", \"load\"]\n" + crank() + load + gear_2_5);
  EXPECT_NEAR(periodicity_of(*both).angle, 5 * 2 * pi, 1e-12);
}

// 7 rad/s behind 2.5:1 turn the crank with 17.5 rad/s.
TEST(Periodicity, OfASpeedThatIsGivenBehindAGear) {
  const auto model = model_of("line = [\"crank\", \"c\", \"gear\", \"drive\"]\n" + crank() + gear_2_5 +
                              "c = { kind = \"coupling\", stiffness = \"900 N*m/rad\" }\ndrive = { kind = \"prescribed "
                              "speed\", speed = \"-7 rad/s\" }\neffects = { elasticity = true }\n");
  const Periodicity p = periodicity_of(*model);
  EXPECT_TRUE(p.by_time);
  EXPECT_NEAR(p.time, 2 * pi / 17.5, 1e-12);
}

// Until the given speed repeats, φ = φ₀ + i ∫ω dt: a straight run-up and a ripple; from there the crank stands off by
// the twist alone.
TEST(ReturnMap, BeginsWhereTheGivenSpeedHasTurnedTheMachine) {
  const auto model = model_of(
      "line = [\"crank\", \"c\", \"gear\", \"drive\"]\n" + crank() + gear_2_5 +
      "c = { kind = \"coupling\", stiffness = \"900 N*m/rad\", damping = \"3 N*m*s/rad\" }\n"
      "drive = { kind = \"prescribed speed\", amplitude = \"1.5 rad/s\", frequency = \"2.228169203286535 Hz\", phase = "
      "\"0.7 rad\", table = { over = \"time\", unit = [\"s\", \"rad/s\"], points = [[0, 0], [0.4, 3], [1, 7]] } }\n"
      "effects = { elasticity = true }\nrun = { start = { angle = \"0.6 rad\" } }\n");
  ReturnMap map(model, {});
  ASSERT_EQ(map.approach(7 * 2.5).end, ReturnMap::End::returned);
  ASSERT_EQ(map.size(), 2u);
  const double omega = 2 * pi * 2.228169203286535, t = map.start_time();
  ASSERT_GE(t, 1);
  const double turned =
      0.5 * 0.4 * 3 + 0.6 * 5 + 7 * (t - 1) - 1.5 / omega * (std::cos(omega * t + 0.7) - std::cos(0.7));
  Equations equations(model, false);
  const int drive = model->network.ports.at("drive").in, link = model->network.ports.at("crank").in;
  const auto in_two_turns = [](double angle) { return std::remainder(angle, 4 * pi); };
  const double twist_there = map.section().state().y[equations.twist_index(0)];
  for (const double twist : {0.0, 0.05, -0.08}) {
    Eigen::VectorXd z(2);
    z << twist / model->elastic[0].twist_scale, 0.3;
    const std::vector<double> y = map.place(equations, z);
    const Snapshot& s = equations.snapshot(t, y);
    EXPECT_NEAR(in_two_turns(s.node_angle[drive] - 0.6 / 2.5 - turned), 0, 1e-8) << twist;
    EXPECT_NEAR(in_two_turns(s.node_angle[link] - 2.5 * s.node_angle[drive]), twist_there + twist, 1e-9) << twist;
  }
}

// --- events that time brings -----------------------------------------------------------------------------------------

// A torque that grows with time breaks a clutch away earlier where its load is faster: directions of motion through
// that event against differences of the motion itself.
TEST(Sensitivities, ThroughABreakawayThatTimeBrings) {
  const Scene scene = scene_from(R"(
line = ["a", "clutch", "b"]
a = { kind = "inertia", inertia = "0.7 kg*m2" }
b = { kind = "load", damping = "1.5 N*m*s/rad", inertia = "1.1 kg*m2" }
clutch = { kind = "clutch", torque = "20 N*m", static_torque = "60 N*m" }
push = { kind = "torque source", on = "a", table = { over = "time", unit = ["s", "N*m"], points = [[0, 10], [2, 190]] } }
run = { until = "1.4 s", start = { speed = "6 rad/s" } }
)");
  Equations equations(compile(scene, scene.effects), false);
  RunOptions options;
  options.tolerance = 1e-12, options.until = 1.4;
  const std::size_t first = equations.speed_index(0);
  double broke = 0;
  const auto end = [&](double faster, RunExtension* extension, const std::vector<double>* extended) {
    std::vector<double> y = equations.start(0);
    y[first] += faster, y[first + 1] += faster;
    options.from = {0, extended ? *extended : y};
    options.extension = extension;
    const RunOutcome out = integrate(equations, options, {});
    EXPECT_TRUE(out.complete) << out.diagnosis;
    EXPECT_EQ(out.events.size(), 1u);
    if (!out.events.empty()) broke = out.events[0].t;
    return out.state;
  };
  Sensitivities sensitivities(equations, 1, 100);
  Eigen::MatrixXd direction = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(equations.size()), 1);
  direction(static_cast<Eigen::Index>(first), 0) = direction(static_cast<Eigen::Index>(first) + 1, 0) = 1;
  const std::vector<double> extended = sensitivities.start(equations.start(0), direction);
  const Eigen::MatrixXd moved = sensitivities.matrix(end(0, &sensitivities, &extended));
  EXPECT_GT(broke, 0.3);
  EXPECT_LT(broke, 1.2);
  const double h = 1e-4;
  const std::vector<double> above = end(h, nullptr, nullptr), below = end(-h, nullptr, nullptr);
  for (const std::size_t i : {first, first + 1}) {
    const double difference = (above[i] - below[i]) / (2 * h);
    EXPECT_NEAR(moved(static_cast<Eigen::Index>(i), 0), difference, 1e-6 * std::abs(difference)) << i;
  }
}

// --- steps -----------------------------------------------------------------------------------------------------------

class Explicit final : public OdeSystem {
 public:
  using Flow = std::function<void(double, std::span<const double>, std::span<double>)>;
  explicit Explicit(Flow flow) : flow_(std::move(flow)) { pattern_ = {2, {0, 1, 2}, {0, 1}}; }
  std::size_t size() const override { return 2; }
  void flow(double t, std::span<const double> y, std::span<double> f) override { flow_(t, y, f); }
  const SparsityPattern& jacobian_pattern() override { return pattern_; }
  void jacobian(double, std::span<const double>, std::span<double>) override {}

 private:
  Flow flow_;
  SparsityPattern pattern_;
};

// What holds the steps does not depend on the unit of time.
TEST(ExplicitRungeKutta, DistinguishesStabilityFromAccuracyInAnyUnitOfTime) {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    Explicit stiff([unit](double t, auto y, auto f) {
      f[0] = -1e4 * (y[0] - std::cos(t / unit)) / unit;
      f[1] = -y[1] / unit;
    });
    Explicit lively([unit](double, auto y, auto f) {
      f[0] = y[1] / unit;
      f[1] = -y[0] / unit;
    });
    const std::vector<double> from = {0, 1};
    const auto held = make_stepper(Method::dormand_prince_853, stiff, {1e-6, {1, 1}});
    held->start(0, from);
    int steps = 0, reported = 0;
    while (held->t() < unit) {
      held->step(unit);
      if (held->t() < 0.5 * unit) continue;
      ++steps;
      reported += held->held_by_stability();
    }
    EXPECT_GT(reported, 0.8 * steps) << unit;
    const auto free = make_stepper(Method::dormand_prince_853, lively, {1e-10, {1, 1}});
    free->start(0, from);
    while (free->t() < 50 * unit) {
      free->step(50 * unit);
      EXPECT_FALSE(free->held_by_stability()) << unit;
    }
  }
}

// --- over the angle, backwards ---------------------------------------------------------------------------------------

// Without torques I ω² stays as it is, from wherever it starts, either way.
TEST(WorkStepper, FreeCrankKeepsItsEnergyBackwardsFromAnyAngle) {
  for (const double omega : {20.0, -20.0})
    for (const std::string& drag :
         {std::string(), std::string("fan = { kind = \"load\", on = \"crank\", quadratic = \"0 "
                                     "N*m*s2/rad2\" }\n")}) {
      const Result r = run(
          "line = [\"crank\"]\n" + crank() + drag +
              fmt::format("run = {{ until = \"0.31 s\", method = \"work\", accuracy = 1e-9, samples = 32, start = {{ "
                          "angle = \"1.1 rad\", speed = \"{} rad/s\" }} }}\n",
                          omega),
          false);
      const auto angle = series(r, "angle.crank"), speed = series(r, "speed.crank");
      for (std::size_t row = 0; row < angle.size(); ++row)
        EXPECT_NEAR(speed[row], omega * std::sqrt(crank_inertia(1.1) / crank_inertia(angle[row])), 1e-6);
      EXPECT_LT(std::abs(angle.back() - 1.1 - 0.31 * omega), 2);
    }
}

// M over the angle by a table and q ω²: dT/ds = M − (2 q/J) T, forwards over the table as backwards over its mirror
// image: the same motion by the same steps.
TEST(WorkStepper, RunsBackwardsAsItsMirrorImageForwards) {
  const auto machine = [](bool mirrored) {
    const char* const points = mirrored ? "[[108.71, -9], [246.23, 3], [293.59, -6], [352.87, -4]]"
                                        : "[[7.13, 4], [66.41, 6], [113.77, -3], [251.29, 9]]";
    return scene_from(fmt::format(R"(
line = ["wheel", "gear", "slow"]
wheel = {{ kind = "inertia", inertia = "0.5 kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [20, 50] }}] }}
slow = {{ kind = "torque source", inertia = "2 kg*m2", table = {{ over = "angle", unit = ["deg", "N*m"], points = {} }} }}
fan = {{ kind = "load", on = "wheel", quadratic = "0.002 N*m*s2/rad2" }}
run = {{ until = "1.7 s", method = "work", accuracy = 1e-9, samples = 18, start = {{ angle = "{} rad", speed = "{} rad/s" }} }}
)",
                                  points, mirrored ? -0.8 : 0.8, mirrored ? -25 : 25));
  };
  const Scene forwards = machine(false), backwards = machine(true);
  std::vector<double> ends[2];
  RunStatistics statistics[2];
  std::size_t events[2];
  for (const bool mirrored : {false, true}) {
    const Scene& scene = mirrored ? backwards : forwards;
    WorkTables tables(compile(scene, scene.effects));
    ends[mirrored] = tables.edges(mirrored ? -1 : 1);
    Equations equations(compile(scene, scene.effects), false);
    RunOptions options;
    options.method = "work", options.until = 1.7, options.tolerance = 1e-10;
    const RunOutcome out = integrate(equations, options, {});
    ASSERT_TRUE(out.complete) << out.diagnosis;
    statistics[mirrored] = out.statistics;
    events[mirrored] = out.events.size();
  }
  ASSERT_EQ(ends[0].size(), ends[1].size());
  ASSERT_GE(ends[0].size(), 4u);
  for (std::size_t k = 0; k < ends[0].size(); ++k) EXPECT_NEAR(ends[1][k], ends[0][k], 1e-11);
  EXPECT_EQ(statistics[0].stepper.steps, statistics[1].stepper.steps);
  EXPECT_EQ(statistics[0].stepper.restarts, statistics[1].stepper.restarts);
  EXPECT_EQ(statistics[0].stepper.rejected, statistics[1].stepper.rejected);
  EXPECT_EQ(events[0], events[1]);
  const Result a = run(forwards, false), b = run(backwards, false);
  const auto speed = series(a, "speed.wheel"), back = series(b, "speed.wheel");
  for (std::size_t row = 0; row < speed.size(); ++row) EXPECT_NEAR(back[row], -speed[row], 1e-8);
}

// A mean torque within rounding of the tables is taken away everywhere: the work closes after the cycle, and on the way
// it is that of the sine alone.
TEST(WorkOverAngle, WhatRoundingLeavesIsTakenAwayAllAlongTheCycle) {
  const Scene scene = scene_from(R"(
line = ["wheel"]
wheel = { kind = "inertia", inertia = "2 kg*m2" }
wave = { kind = "torque source", on = "wheel", table = { over = "angle", unit = ["rad", "N*m"], points = [[0, 0], [1.5707963267948966, 1.0], [4.71238898038469, -1.0], [6.283185307179586, 0]] } }
mean = { kind = "torque source", on = "wheel", torque = "2.0e-13 N*m" }
)");
  WorkTables tables(compile(scene, scene.effects));
  const WorkOverAngle& diagram = tables.diagram(1);
  ASSERT_EQ(diagram.work_per_cycle(), 0);
  const double top = pi / 4 * 2;  // ∫ up to π
  for (double s = 0.01; s < 2 * pi; s += 0.05) {
    const double x = std::abs(std::remainder(s - pi, 2 * pi));  // symmetric about π
    const double exact = x < 0.5 * pi ? top - x * x / pi : std::pow(pi - x, 2) / pi;
    EXPECT_NEAR(diagram.work(s), exact, 3e-14) << s;
  }
}

// --- curves, lines, mean inertias ------------------------------------------------------------------------------------

// Fritsch and Butland: 1/y′ = α/d₀ + (1 − α)/d₁ with α = (h₀ + 2 h₁)/(3 (h₀ + h₁)), and Hermite's cubic between.
TEST(Curve, SmoothBetweenUnevenPointsIsThatOfFritschAndButland) {
  const std::vector<double> x = {0, 1, 4, 4.5, 9}, y = {0, 2, 3, 5, 11};
  const Curve curve(x, y, Curve::Form::smooth);
  const auto slope = [&](std::size_t i) {
    const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i], d0 = (y[i] - y[i - 1]) / h0, d1 = (y[i + 1] - y[i]) / h1;
    const double part = (h0 + 2 * h1) / (3 * (h0 + h1));
    return 1 / (part / d0 + (1 - part) / d1);
  };
  for (const std::size_t i : {1u, 2u}) {
    const double h = x[i + 1] - x[i];
    for (const double u : {0.2, 0.5, 0.9}) {
      const double hermite = (1 + 2 * u) * (1 - u) * (1 - u) * y[i] + u * (1 - u) * (1 - u) * h * slope(i) +
                             u * u * (3 - 2 * u) * y[i + 1] - u * u * (1 - u) * h * slope(i + 1);
      EXPECT_NEAR(curve.value(x[i] + u * h), hermite, 1e-12);
    }
  }
}

// What stands at the input of a gear is driven by its input, what stands at its output by its output.
TEST(Branches, BeginAtTheShaftTheyAreGivenFor) {
  for (const std::string& from : {std::string("gear.in"), std::string("gear.out")}) {
    const Result r =
        run("line = [\"drive\", \"gear\", \"load\"]\n" + gear_2_5 +
                "drive = { kind = \"torque source\", torque = \"20 N*m\", inertia = \"0.3 kg*m2\" }\nload = { "
                "kind = \"inertia\", inertia = \"2 kg*m2\" }\nside = { kind = \"inertia\", inertia = \"0.7 "
                "kg*m2\" }\nrun = { until = \"0.5 s\", accuracy = 1e-9 }\n[[branch]]\nfrom = \"" +
                from + "\"\nline = [\"side\"]\n",
            false);
    const bool fast = from == "gear.in";
    const double inertia = 0.3 + (2 + (fast ? 0 : 0.7)) / (2.5 * 2.5) + (fast ? 0.7 : 0);
    EXPECT_NEAR(figure(r, "final_speed.drive"), 20 * 0.5 / inertia, 1e-7);
    EXPECT_NEAR(figure(r, "final_speed.side"), 20 * 0.5 / inertia / (fast ? 1 : 2.5), 1e-7);
  }
}

// Modes see the mean of a mechanism's inertia over its turn, behind a gear by the square of the ratio.
TEST(Modes, OfAMechanismBehindAGearCountItsMeanInertia) {
  const Scene scene =
      scene_from("line = [\"motor\", \"c\", \"crank\", \"gear\", \"slow\"]\n" + crank() + gear_2_5 +
                 "motor = { kind = \"inertia\", inertia = \"0.4 kg*m2\" }\nc = { kind = \"coupling\", stiffness "
                 "= \"5 kN*m/rad\" }\nslow = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", "
                 "crank_inertia = \"0.9 kg*m2\", slider_mass = \"60 kg\", phase = \"0.5 rad\" }\neffects = { "
                 "elasticity = true }\nrun = { start = { speed = \"20 rad/s\" } }\n");
  double fast = 0, slow = 0;
  constexpr int n = 2000;
  for (int k = 0; k < n; ++k) {
    const double phi = 2 * pi * (k + 0.5) / n;
    fast += crank_inertia(phi) / n;
    slow += (0.9 + 60 * std::pow(slope_of_travel(phi), 2)) / n;
  }
  const ModesStudy modes = find_modes(scene, scene.effects, {});
  ASSERT_EQ(modes.modes.size(), 1u);
  EXPECT_NEAR(modes.modes[0].omega, std::sqrt(5000 * (1 / 0.4 + 1 / (fast + slow / (2.5 * 2.5)))), 1e-6);
}

}  // namespace
}  // namespace kurbel::rounds_and_steps_test
