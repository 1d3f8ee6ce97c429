// flywheel_test.cpp — synthesis against the speed that it promises, limits, tangents, dimensions, bad input.
#include "studies/size/flywheel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace kurbel::flywheel_test {
namespace {

constexpr double pi = std::numbers::pi;

// A random cycle with constant drive: a load with jumps and harmonics, and an inertia that varies strongly.
struct RandomMachine {
  WorkDiagram diagram;
  MechanismInertia mechanism;

  explicit RandomMachine(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1, 1);
    const double a1 = u(random), a2 = u(random), b1 = u(random), b2 = u(random), from = 2 + u(random),
                 to = from + 1 + 0.5 * u(random), blow = 20 * (2 + u(random)), c1 = 0.4 * u(random),
                 c2 = 0.4 * u(random);
    const auto all = Piecewise::sample({0, from, to, 2 * pi}, 3, [=](double x, std::span<double> out) {
      out[0] = 8 + 3 * (a1 * std::sin(x) + a2 * std::cos(2 * x) + b1 * std::sin(3 * x + b2)) +
               (x > from && x < to ? blow : 0);
      out[1] = 1 + c1 * std::cos(2 * x) + c2 * std::sin(x);
      out[2] = -2 * c1 * std::sin(2 * x) + c2 * std::cos(x);
    });
    diagram = with_constant_drive(all[0]);
    mechanism = {all[1], all[2]};
  }
  // ω(φ) straight from the equation of work, for checks.
  double speed(double phi, double inertia, double energy) const {
    return std::sqrt(2 * (energy + diagram.excess.value(phi)) / (inertia + mechanism.value.value(phi)));
  }
};

// Largest value of f on a turn by sampling and golden section, independent of the study's roots.
template <class F>
double largest_of(F f) {
  constexpr int n = 20000;
  int best = 0;
  for (int i = 1; i < n; ++i)
    if (f(2 * pi * i / n) > f(2 * pi * best / n)) best = i;
  double lo = 2 * pi * (best - 1) / n, hi = 2 * pi * (best + 1) / n;
  const double g = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 100; ++i) {
    const double x = hi - g * (hi - lo), y = lo + g * (hi - lo);
    (f(x) > f(y) ? hi : lo) = f(x) > f(y) ? y : x;
  }
  return f(0.5 * (lo + hi));
}

TEST(Wittenbauer, SpeedOfTheSizedMachineFluctuatesByTheDemandedDelta) {
  std::mt19937 random(20);
  for (int i = 0; i < 40; ++i) {
    const RandomMachine machine(random);
    const double delta = std::pow(10.0, -0.3 - 2.2 * i / 40), mean = 7;
    const Wittenbauer w = wittenbauer(machine.diagram, machine.mechanism, mean, delta);
    if (w.inertia < 0.05) continue;
    const auto speed = [&](double x) { return machine.speed(x, w.inertia, w.kinetic_energy); };
    const double most = largest_of(speed), least = -largest_of([&](double x) { return -speed(x); });
    EXPECT_NEAR((most - least) / (0.5 * (most + least)), delta, 1e-9) << "machine " << i;
    EXPECT_NEAR(0.5 * (most + least), mean, 1e-9 * mean) << "machine " << i;
    // The speed found from the inertia alone is the same.
    const SpeedCycle cycle(machine.diagram, machine.mechanism, w.inertia, mean);
    EXPECT_NEAR(cycle.delta(), delta, 1e-12) << "machine " << i;
    EXPECT_NEAR(cycle.speed(cycle.fastest().x), cycle.fastest().value, 1e-13 * mean);
  }
}

TEST(Wittenbauer, TangentsTouchTheCurveAndLeaveItOnOneSide) {
  std::mt19937 random(21);
  for (int i = 0; i < 10; ++i) {
    const RandomMachine m(random);
    const Wittenbauer w = wittenbauer(m.diagram, m.mechanism, 5, 0.1);
    for (int k = 0; k <= 3000; ++k) {
      const double phi = 2 * pi * k / 3000, inertia = m.mechanism.value.value(phi),
                   excess = m.diagram.excess.value(phi);
      EXPECT_LE(excess, w.upper.intercept() + w.upper.slope * inertia + 1e-10);
      EXPECT_GE(excess, w.lower.intercept() + w.lower.slope * inertia - 1e-10);
    }
    EXPECT_NEAR(m.diagram.excess.value(w.upper.phi), w.upper.excess, 1e-12);
  }
}

TEST(Flywheel, TheThreeMethodsAgreeWhereTheMechanismHasConstantInertia) {
  const Piecewise load =
      Piecewise::of({0, 3, 2 * pi}, [](double x) { return 50 + 30 * std::sin(x) + 10 * std::cos(3 * x); });
  const WorkDiagram d = with_constant_drive(load);
  const MechanismInertia constant{load.constant(2.5), load.constant(0)};
  const double exact = wittenbauer(d, constant, 12, 0.04).inertia;
  // (a − b) = ω_mid² δ exactly, and the constant part shifts I₀.
  EXPECT_NEAR(exact, inertia_by_fluctuation(d.fluctuation(), 12, 0.04) - 2.5, 1e-11);
  EXPECT_NEAR(mertsalov(d, constant, 12, 0.04).inertia, exact + 2.5, 1e-11);
}

TEST(Flywheel, MertsalovApproachesWittenbauerAsDeltaShrinks) {
  std::mt19937 random(22);
  const RandomMachine m(random);
  double last = 1;
  for (const double delta : {0.1, 0.01, 0.001}) {
    const double exact = wittenbauer(m.diagram, m.mechanism, 5, delta).inertia;
    const double difference = std::abs(mertsalov(m.diagram, m.mechanism, 5, delta).inertia / exact - 1);
    EXPECT_LT(difference, 0.2 * last);
    last = difference;
  }
}

// δ of a given inertia without I_em, in closed form: ω² varies by 2 ΔA/I.
TEST(SpeedCycle, MatchesTheClosedFormOfASine) {
  const Piecewise load = Piecewise::of({0, 2.5, 2 * pi}, [](double x) { return 10 + 4 * std::sin(x); });
  const WorkDiagram d = with_constant_drive(load);  // ΔT = 4 (cos φ − 1)
  const MechanismInertia none{load.constant(0), load.constant(0)};
  const double inertia = 0.5, mean = 9;
  const SpeedCycle cycle(d, none, inertia, mean);
  EXPECT_NEAR(cycle.delta(), 8 / (inertia * mean * mean), 1e-13);
  EXPECT_NEAR(cycle.slowest().x, pi, 1e-7);
  EXPECT_THROW(SpeedCycle(d, none, 0.01, mean), std::invalid_argument);  // would stop
}

TEST(FlywheelDimensions, PartsAddUpToTheInertiaDemanded) {
  for (const FlywheelMaterial& material : flywheel_materials())
    for (const double inertia : {0.01, 3.0, 420.0})
      for (const double diameter : {0.0, 0.8 * std::pow(inertia, 0.2)}) {
        const auto rim = flywheel_dimensions({FlywheelForm::rim, material, inertia, 6.5, diameter});
        // The rim alone by the ring's formula; spokes and hub bring the rest.
        const double outer = rim.diameter, inner = outer - 2 * rim.thickness;
        const double ring = material.density * rim.breadth * pi / 32 * (std::pow(outer, 4) - std::pow(inner, 4));
        EXPECT_NEAR(ring, rim.rim_share * inertia, 1e-10 * inertia);
        EXPECT_GT(rim.rim_share, 0.5);
        const auto disc = flywheel_dimensions({FlywheelForm::disc, material, inertia, 6.5, diameter});
        EXPECT_NEAR(disc.mass * disc.diameter * disc.diameter / 8, inertia, 1e-10 * inertia);
        EXPECT_LT(rim.mass, disc.mass * (diameter > 0 ? 1 : 10));
      }
}

TEST(FlywheelDimensions, DiscIsStressedByLessThanHalfOfAFreeRing) {
  const FlywheelMaterial& steel = flywheel_material("steel");
  const auto disc = flywheel_dimensions({FlywheelForm::disc, steel, 2, 100, 0.8});
  EXPECT_NEAR(disc.rim_speed, 40, 1e-12);
  EXPECT_NEAR(disc.stress, (3 + 0.3) / 8 * 7850 * 1600, 1e-6);
  EXPECT_NEAR(disc.energy, 10000, 1e-9);
  EXPECT_TRUE(disc.within_limit);
  EXPECT_FALSE(flywheel_dimensions({FlywheelForm::disc, steel, 2, 250, 0.8}).within_limit);
  // Without a diameter the limit of rim speed holds by itself.
  EXPECT_TRUE(flywheel_dimensions({FlywheelForm::rim, steel, 0.05, 1000}).within_limit);
}

TEST(Flywheel, RefusesWhatMakesNoSense) {
  EXPECT_THROW(check_delta(0), std::invalid_argument);
  EXPECT_THROW(check_delta(-0.1), std::invalid_argument);
  EXPECT_THROW(check_delta(2), std::invalid_argument);
  EXPECT_THROW(check_delta(std::nan("")), std::invalid_argument);
  EXPECT_NO_THROW(check_delta(1.999));
  const std::vector<double> edges = {0, 2 * pi};
  EXPECT_THROW(with_constant_drive(Piecewise::of(edges, [](double x) { return 5 * std::sin(x); })),
               std::invalid_argument);
  EXPECT_THROW(with_constant_drive(Piecewise::of(edges, [](double) { return -3.0; })), std::invalid_argument);
  EXPECT_THROW(flywheel_dimensions({FlywheelForm::rim, flywheel_material("steel"), 1000, 10, 0.2}),
               std::invalid_argument);
  EXPECT_THROW(flywheel_dimensions({FlywheelForm::rim, flywheel_material("steel"), 20, 1000}), std::invalid_argument);
  EXPECT_THROW(flywheel_material("stel"), std::invalid_argument);
  EXPECT_THROW(customary_delta("pres"), std::invalid_argument);
  EXPECT_EQ(customary_delta("press").low, 0.10);
}

}  // namespace
}  // namespace kurbel::flywheel_test
