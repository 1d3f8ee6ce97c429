// Steady motion as a fixed point of the return map: against closed forms, differences, and waiting for it.
#include "engine/return_map/return_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"

namespace kurbel::test::return_map_test {
namespace {

constexpr double pi = std::numbers::pi;

std::shared_ptr<const Model> model_of_scene(const std::string& file, bool elastic) {
  const Scene scene = scene_file("scenes/" + file + ".toml");
  return compile(scene, elastic ? scene.effects : Effects{});
}

SteadyPoint steady_of(ReturnMap& map, double link_speed) {
  const ReturnMap::Image guess = map.approach(link_speed);
  EXPECT_EQ(guess.end, ReturnMap::End::returned) << guess.why;
  if (guess.end != ReturnMap::End::returned) return {};
  const SteadyPoint point = find_steady(map, guess.z, 1e-11);
  EXPECT_TRUE(point.found) << point.why;
  return point;
}

void expect_same_set(std::vector<std::complex<double>> found, const std::vector<std::complex<double>>& expected,
                     double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (const std::complex<double>& e : expected) {
    const auto nearest =
        std::min_element(found.begin(), found.end(), [&](auto a, auto b) { return std::abs(a - e) < std::abs(b - e); });
    EXPECT_NEAR(std::abs(*nearest - e), 0, tolerance) << e;
    found.erase(nearest);
  }
}

// J ω̇ = M_s (1 − ω/ω₀) − M_c: a deviation fades with κ = M_s/(ω₀ J), and a turn takes 2π/ω*.
TEST(ReturnMap, MultiplierOfAShuntMotorUnderConstantLoadIsExpMinusKappaT) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20; ++i) {
    const double stall = 20 + 80 * uniform(random), no_load = 20 + 100 * uniform(random);
    const double load = stall * (0.1 + 0.7 * uniform(random)), inertia = 0.3 + 3 * uniform(random);
    const auto model = model_of(
        "line = [\"motor\", \"load\"]\n"
        "motor = { kind = \"dc shunt motor\", stall_torque = \"" +
        digits(stall) + " N*m\", no_load_speed = \"" + digits(no_load) + " rad/s\", inertia = \"" + digits(inertia) +
        " kg*m2\" }\n" + "load = { kind = \"load\", torque = \"" + digits(load) + " N*m\" }\n");
    const double steady = no_load * (1 - load / stall), kappa = stall / (no_load * inertia);
    ReturnMap map(model, {});
    const SteadyPoint p = steady_of(map, 1.1 * steady);
    ASSERT_EQ(p.multipliers.size(), 1u);
    EXPECT_NEAR(p.multipliers[0].real(), std::exp(-kappa * 2 * pi / steady), 1e-9);
    EXPECT_NEAR(p.time, 2 * pi / steady, 1e-10 * p.time);
  }
}

// Motor – coupling – viscous load is linear: the multipliers are exp(λ T) of its state matrix in θ, ω₁, ω₂.
TEST(ReturnMap, MultipliersOfALinearChainAreExpOfItsEigenvalues) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20; ++i) {
    const double stall = 50 + 50 * uniform(random), no_load = 50 + 50 * uniform(random), b = 0.3 + uniform(random);
    const double j1 = 0.1 + uniform(random), j2 = 0.1 + uniform(random);
    const double k = 200 * std::pow(10, 2 * uniform(random)), c = 0.002 * std::sqrt(k) * (1 + 20 * uniform(random));
    const auto model = model_of(
        "line = [\"motor\", \"c\", \"load\"]\n"
        "motor = { kind = \"dc shunt motor\", stall_torque = \"" +
        digits(stall) + " N*m\", no_load_speed = \"" + digits(no_load) + " rad/s\", inertia = \"" + digits(j1) +
        " kg*m2\" }\n" + "c = { kind = \"coupling\", stiffness = \"" + digits(k) + " N*m/rad\", damping = \"" +
        digits(c) + " N*m*s/rad\" }\nload = { kind = \"load\", damping = \"" + digits(b) +
        " N*m*s/rad\", inertia = \"" + digits(j2) + " kg*m2\" }\neffects = { elasticity = true }\n");
    const double slope = stall / no_load, steady = stall / (slope + b), time = 2 * pi / steady;
    Eigen::Matrix3d a;
    a << 0, 1, -1, -k / j1, -(c + slope) / j1, c / j1, k / j2, c / j2, -(c + b) / j2;
    std::vector<std::complex<double>> expected;
    for (const Eigen::VectorXcd values = test::eigen_solution(a).values; const std::complex<double>& lambda : values)
      expected.push_back(std::exp(lambda * time));
    ReturnMap map(model, {});
    const SteadyPoint p = steady_of(map, 0.9 * steady);
    expect_same_set(p.multipliers, expected, 1e-8);
  }
}

// Below breakdown an induction motor under constant load runs away from its operating point: exp(+κ T), κ = M′(ω)/J.
TEST(ReturnMap, CycleBelowBreakdownIsUnstableByTheMotorsSlope) {
  const double breakdown = 100, synchronous = 100, load = 80, inertia = 20;
  const auto model = model_of(
      "line = [\"motor\", \"load\"]\nmotor = { kind = \"induction motor\", rated_power = \"4 kW\", rated_speed = \"95 "
      "rad/s\", synchronous_speed = \"100 rad/s\", breakdown_ratio = " +
      digits(breakdown / (4000 / 95.0)) + ", inertia = \"" + digits(inertia) + " kg*m2\" }\n" +
      "load = { kind = \"load\", torque = \"80 N*m\" }\n");
  const double nu = breakdown / (4000 / 95.0), sb = 0.05 * (nu + std::sqrt(nu * nu - 1));
  // M = 2 M_b s s_b/(s² + s_b²) = M_c: s/s_b = M_b/M_c + √((M_b/M_c)² − 1) on the branch below breakdown
  const double s = sb * (breakdown / load + std::sqrt(std::pow(breakdown / load, 2) - 1));
  const double omega = synchronous * (1 - s);
  const double slope = -2 * breakdown * sb * (sb * sb - s * s) / std::pow(s * s + sb * sb, 2) / synchronous;
  ASSERT_GT(slope, 0);
  ReturnMap map(model, {});
  const SteadyPoint p = steady_of(map, omega);
  EXPECT_NEAR(p.time, 2 * pi / omega, 1e-9);
  EXPECT_NEAR(p.largest(), std::exp(slope / inertia * 2 * pi / omega), 1e-8);
  EXPECT_GT(p.largest(), 1);
}

TEST(ReturnMap, FreeSliderCrankIsAFamilyWithMultiplierOne) {
  ReturnMap map(model_of_scene("free_slider_crank", false), {});
  const ReturnMap::Image guess = map.approach(30);
  const ReturnMap::Image image = map.image(guess.z, true);
  EXPECT_NEAR(image.z[0], guess.z[0], 1e-11);
  EXPECT_NEAR(image.derivative(0, 0), 1, 1e-9);
}

// Sensitivities with their jumps at load edges, dead centres and tables' knots against central differences of the map.
TEST(ReturnMap, DerivativeEqualsDifferencesOfTheMap) {
  for (const char* name : {"crank_press", "compressor", "single_cylinder_engine", "driven_slider_crank", "piston_pump",
                           "six_inertia_chain"}) {
    SCOPED_TRACE(name);
    ReturnMap map(model_of_scene(name, true), {});
    const ReturnMap::Image guess = map.approach(0.9 * map.model().speed_scale);
    ASSERT_EQ(guess.end, ReturnMap::End::returned) << guess.why;
    const ReturnMap::Image image = map.image(guess.z, true);
    EXPECT_FALSE(image.grazed);
    const double h = 1e-5;
    for (Eigen::Index j = 0; j < guess.z.size(); ++j) {
      Eigen::VectorXd above = guess.z, below = guess.z;
      above[j] += h;
      below[j] -= h;
      const ReturnMap::Image a = map.image(above, false), b = map.image(below, false);
      const Eigen::VectorXd difference = (a.z - b.z) / (2 * h);
      EXPECT_LT((difference - image.derivative.col(j)).cwiseAbs().maxCoeff(),
                3e-7 * std::max(1.0, image.derivative.cwiseAbs().maxCoeff()));
      EXPECT_NEAR((a.time - b.time) / (2 * h), image.slowing[j], 1e-6 * std::max(1.0, std::abs(image.slowing[j])));
    }
  }
}

// One uninterrupted run from the quasi-static start until every deviation has fallen below the tolerance.
Eigen::VectorXd waited_for(ReturnMap& map, double link_speed, double cycles) {
  Equations equations(map.shared_model(), false);
  StartSettings settings{};
  settings.equilibrium = true;
  settings.angle = map.section_angle();
  settings.speed = link_speed;
  const std::vector<double> y = equations.start(0, settings);
  RunOptions run{
      .tolerance = 1e-12, .method = "auto", .until = 1e6, .budget = 100, .interrupted = nullptr, .progress = {}};
  run.from = {0, y};
  run.stop = map.period_end(equations, y, cycles);
  const RunOutcome outcome = integrate(equations, run, {});
  EXPECT_TRUE(outcome.stopped) << outcome.diagnosis;
  return map.section().read(equations.modes(), outcome.state);
}

TEST(ReturnMap, SteadyCyclesAreWhatLongSimulationsEndIn) {
  struct Case {
    const char* name;
    bool elastic;
  };
  for (const Case c : {Case{"crank_press", false}, Case{"crank_press", true}, Case{"compressor", false},
                       Case{"compressor", true}, Case{"single_cylinder_engine", false},
                       Case{"single_cylinder_engine", true}, Case{"driven_slider_crank", false}}) {
    SCOPED_TRACE(std::string(c.name) + (c.elastic ? ", elastic" : ", rigid"));
    ReturnMap map(model_of_scene(c.name, c.elastic), {});
    const double speed = 0.98 * map.model().speed_scale;
    const SteadyPoint p = steady_of(map, speed);
    ASSERT_TRUE(p.found);
    const double cycles = std::ceil(10 + std::log(1e-10) / std::log(std::max(p.largest(), 1e-10)));
    EXPECT_LT((waited_for(map, speed, cycles) - p.z).cwiseAbs().maxCoeff(), 1e-8) << cycles << " cycles";
  }
}

TEST(ReturnMap, SearchCostsAtMostSixCyclesPerUnknownAndOne) {
  for (const char* name :
       {"crank_press", "compressor", "single_cylinder_engine", "piston_pump", "four_cylinder_engine"})
    for (const bool elastic : {false, true}) {
      SCOPED_TRACE(name);
      ReturnMap map(model_of_scene(name, elastic), {});
      steady_of(map, 0.97 * map.model().speed_scale);
      EXPECT_LE(map.cost(), 6 * (static_cast<double>(map.size()) + 1));
    }
}

TEST(ReturnMap, FourStrokeEngineRepeatsAfterTwoTurns) {
  ReturnMap map(model_of_scene("single_cylinder_engine", true), {});
  EXPECT_NEAR(map.periodicity().angle, 4 * pi, 1e-12);
  const SteadyPoint p = steady_of(map, 314);
  EXPECT_NEAR(p.time, 2 * 60 / 2997.0, 1e-4);
}

const char* const forced_chain =
    "line = [\"source\", \"c\", \"load\"]\n"
    "source = { kind = \"torque source\", torque = \"10 N*m\", amplitude = \"4 N*m\", frequency = \"3 Hz\", inertia = "
    "\"0.2 kg*m2\" }\n"
    "c = { kind = \"coupling\", stiffness = \"150 N*m/rad\", damping = \"0.3 N*m*s/rad\" }\n"
    "load = { kind = \"load\", damping = \"0.5 N*m*s/rad\", inertia = \"0.4 kg*m2\" }\n"
    "effects = { elasticity = true }\n";

// (J₁ p + Z) ω₁ − Z ω₂ = M̂, (J₂ p + b + Z) ω₂ − Z ω₁ = 0 with Z = k/p + c, p = iΩ; the start is at phase 0 of a sine.
TEST(ReturnMap, ForcedChainSettlesToItsHarmonicResponse) {
  ReturnMap map(model_of(forced_chain), {});
  EXPECT_TRUE(map.periodicity().by_time);
  EXPECT_NEAR(map.periodicity().time, 1 / 3.0, 1e-12);
  const SteadyPoint p = steady_of(map, 15);
  using Complex = std::complex<double>;
  const Complex s(0, 6 * pi), spring = 150.0 / s + 0.3;
  const Complex w2_over_w1 = spring / (0.4 * s + 0.5 + spring);
  const Complex w1 = 4.0 / (0.2 * s + spring * (1.0 - w2_over_w1)), w2 = w2_over_w1 * w1;
  Equations equations(map.shared_model(), false);
  const std::vector<double> y = map.place(equations, p.z);
  EXPECT_NEAR(y[equations.twist_index(0)], 10 / 150.0 + ((w1 - w2) / s).imag(), 1e-10);
  EXPECT_NEAR(y[equations.speed_index(0)], 20 + w1.imag(), 1e-9);
  EXPECT_NEAR(y[equations.speed_index(1)], 20 + w2.imag(), 1e-9);
  Eigen::Matrix3d a;
  a << 0, 1, -1, -150 / 0.2, -0.3 / 0.2, 0.3 / 0.2, 150 / 0.4, 0.3 / 0.4, -0.8 / 0.4;
  std::vector<Complex> expected;
  for (const Eigen::VectorXcd values = test::eigen_solution(a).values; const Complex& lambda : values)
    expected.push_back(std::exp(lambda / 3.0));
  expect_same_set(p.multipliers, expected, 1e-9);
}

// A crank on an elastic shaft behind a prescribed speed that oscillates once a turn.
TEST(ReturnMap, PrescribedSpeedGivesThePeriodAndItsCrankFollows) {
  const auto model = model_of(
      "line = [\"drive\", \"c\", \"crank\"]\n"
      "drive = { kind = \"prescribed speed\", speed = \"20 rad/s\", amplitude = \"1 rad/s\", frequency = \"" +
      digits(20 / (2 * pi)) + " Hz\" }\n" +
      "c = { kind = \"coupling\", stiffness = \"2 kN*m/rad\", damping = \"8 N*m*s/rad\" }\n"
      "crank = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", crank_inertia = \"0.5 kg*m2\", "
      "slider_mass = \"3 kg\" }\neffects = { elasticity = true }\n");
  ReturnMap map(model, {});
  EXPECT_NEAR(map.periodicity().time, 2 * pi / 20, 1e-12);
  const SteadyPoint p = steady_of(map, 20);
  ASSERT_TRUE(p.found);
  EXPECT_LT(p.largest(), 1);
  const ReturnMap::Image again = map.image(p.z, true);
  EXPECT_LT((again.z - p.z).cwiseAbs().maxCoeff(), 1e-10);
  const double h = 1e-5;
  for (Eigen::Index j = 0; j < p.z.size(); ++j) {
    Eigen::VectorXd above = p.z, below = p.z;
    above[j] += h;
    below[j] -= h;
    const Eigen::VectorXd difference = (map.image(above, false).z - map.image(below, false).z) / (2 * h);
    EXPECT_LT((difference - again.derivative.col(j)).cwiseAbs().maxCoeff(), 3e-7);
  }
}

// A shaft with dry friction behind a spring sticks and slips once a period of the torque that shakes it.
TEST(ReturnMap, DerivativeHoldsThroughStandstill) {
  const auto model = model_of(
      "line = [\"source\", \"c\", \"load\"]\n"
      "source = { kind = \"torque source\", torque = \"5 N*m\", amplitude = \"9 N*m\", frequency = \"0.7 Hz\", inertia "
      "= "
      "\"0.2 kg*m2\" }\n"
      "c = { kind = \"coupling\", stiffness = \"60 N*m/rad\", damping = \"0.8 N*m*s/rad\" }\n"
      "load = { kind = \"load\", torque = \"5 N*m\", damping = \"0.2 N*m*s/rad\", inertia = \"0.1 kg*m2\" }\n"
      "effects = { elasticity = true }\n");
  ReturnMap map(model, {});
  SteadyPoint p = find_steady(map, map.approach(5).z, 1e-11);
  EXPECT_FALSE(p.found) << "the load sticks there at first, and in its steady motion slips";
  for (int k = 0; k < 8 && !p.found; ++k) p = find_steady(map, map.approach_from(map.section().state()).z, 1e-11);
  ASSERT_TRUE(p.found) << p.why;
  Equations equations(model, false);
  RunOptions run{
      .tolerance = 1e-10, .method = "auto", .until = 1 / 0.7, .budget = 10, .interrupted = nullptr, .progress = {}};
  run.from = {0, map.place(equations, p.z)};
  int rests = 0;
  for (const Event& e : integrate(equations, run, {}).events) rests += e.what == "comes to rest and is held";
  EXPECT_EQ(rests, 1);
  const double h = 1e-5;
  for (Eigen::Index j = 0; j < p.z.size(); ++j) {
    Eigen::VectorXd above = p.z, below = p.z;
    above[j] += h;
    below[j] -= h;
    const Eigen::VectorXd difference = (map.image(above, false).z - map.image(below, false).z) / (2 * h);
    EXPECT_LT((difference - p.derivative.col(j)).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(ReturnMap, IncommensurablePeriodsAreRefusedInWords) {
  const auto model = model_of(
      "line = [\"a\", \"b\"]\n"
      "a = { kind = \"torque source\", amplitude = \"4 N*m\", frequency = \"1 Hz\", inertia = \"0.2 kg*m2\" }\n"
      "b = { kind = \"torque source\", amplitude = \"4 N*m\", frequency = \"" +
      digits(std::sqrt(2.0)) + " Hz\" }\n");
  try {
    periodicity_of(*model);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("never meets"), std::string::npos) << error.what();
  }
}

TEST(ReturnMap, PeriodsThatMeetMakeTheirCommonMultiple) {
  const auto model = model_of(
      "line = [\"a\", \"b\"]\n"
      "a = { kind = \"torque source\", amplitude = \"4 N*m\", frequency = \"2 Hz\", inertia = \"0.2 kg*m2\" }\n"
      "b = { kind = \"torque source\", amplitude = \"4 N*m\", frequency = \"3 Hz\" }\n");
  EXPECT_NEAR(periodicity_of(*model).time, 1, 1e-12);
}

TEST(ReturnMap, InterruptedSearchSaysSo) {
  const std::atomic<bool> interrupted = true;
  ReturnMap map(model_of_scene("crank_press", true), {.interrupted = &interrupted});
  EXPECT_EQ(map.approach(6).end, ReturnMap::End::interrupted);
}

TEST(ReturnMap, MachineThatStopsUnderItsLoadIsReportedWithTheAngle) {
  // R2stick: from 10 rad/s the crank stops at 2.01784108852116 rad, for ever.
  ReturnMap map(model_of_scene("driven_slider_crank", false), {});
  const ReturnMap::Image image = map.approach(10);
  EXPECT_EQ(image.end, ReturnMap::End::stands);
  EXPECT_NEAR(image.link_angle, 2.01784108852116, 1e-7);
  EXPECT_NE(image.why.find("115.61"), std::string::npos) << image.why;
}

// The guide's friction jams from φ = 239° on: a section that lies there has no image, and says why.
TEST(ReturnMap, ASectionWhereJointsJamHasNoImage) {
  const auto model = model_of(R"(
line = ["wheel", "crank"]
wheel = { kind = "flywheel", inertia = "0.4 kg*m2" }
crank = { kind = "slider-crank", radius = "100 mm", rod = "110 mm", crank_inertia = "0.1 kg*m2", slider_mass = "1 kg", guide = { friction = 0.8 }, load = { kind = "constant", force = "-100 N" } }
effects = { joint_friction = true }
run = { start = { angle = "250 deg", speed = "20 rad/s" }, until = "0.3 s", accuracy = 1e-4 }
)");
  ReturnMap map(model, {});
  State state;
  Equations equations(model, false);
  StartSettings start;
  start.angle = 185 * pi / 180, start.speed = 20;
  state.y = equations.start(0, start);
  state.modes = equations.modes();
  state.y[static_cast<std::size_t>(model->reduction_angle)] = 255 * pi / 180;
  ReturnMap::Image image;
  EXPECT_NO_THROW(image = map.approach_from(state));
  EXPECT_NE(image.end, ReturnMap::End::returned);
  EXPECT_FALSE(image.why.empty());
}

// Two laws on one shaft, one of a third of a turn and one of half a turn: together they repeat after a turn.
TEST(ReturnMap, LawsOfOneShaftRepeatAfterTheirCommonPeriod) {
  const auto model = model_of(
      "line = [\"drive\", \"c\", \"a\"]\n"
      "drive = { kind = \"torque source\", torque = \"40 N*m\", amplitude = \"4 N*m\", frequency = \"3 Hz\", inertia = "
      "\"0.2 kg*m2\" }\n"
      "c = { kind = \"coupling\", stiffness = \"150 N*m/rad\", damping = \"0.3 N*m*s/rad\" }\n"
      "a = { kind = \"load\", damping = \"2 N*m*s/rad\", inertia = \"0.4 kg*m2\" }\n"
      "b = { on = \"a\", kind = \"load\", table = { over = \"angle\", unit = [\"deg\", \"N*m\"], points = [[0, 1], "
      "[60, 3], "
      "[120, 1]], period = \"120 deg\" } }\n"
      "d = { on = \"a\", kind = \"load\", table = { over = \"angle\", unit = [\"deg\", \"N*m\"], points = [[0, 1], "
      "[90, 2], "
      "[180, 1]], period = \"180 deg\" } }\n"
      "effects = { elasticity = true }\n");
  Equations equations(model, false);
  State state;
  state.y = equations.start(0);
  state.modes = equations.modes();
  const PoincareSection section(equations, state, SectionOptions{false, {}});
  std::size_t angle = section.size();
  for (std::size_t j = 0; j < section.size(); ++j)
    if (section.is_angle(j)) angle = j;
  ASSERT_LT(angle, section.size());
  // Half a turn on, the law of a third of a turn is not where it was.
  std::vector<double> y = section.place(equations, pi * Eigen::VectorXd::Unit(static_cast<Eigen::Index>(section.size()),
                                                                              static_cast<Eigen::Index>(angle)));
  EXPECT_NEAR(std::abs(section.read(equations.modes(), y)[static_cast<Eigen::Index>(angle)]), pi, 1e-9);
}

}  // namespace
}  // namespace kurbel::test::return_map_test
