// gear_losses_test.cpp — efficiency by the direction of power: stuck phases, self-locking, power, energy.
#include "drivetrain/gears/gear_losses.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/published/published.h"
#include "tests/support/jacobians.h"
#include "tests/support/validation.h"

namespace kurbel::gear_losses_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::series;
using test::Validation;

constexpr double two_pi = 2 * std::numbers::pi;

// The first event of a component with this text after a time, or −1.
double time_of(const Result& result, const std::string& component, const std::string& what, double after = 0) {
  for (const Event& event : result.events)
    if (event.component == component && event.what == what && event.t > after) return event.t;
  return -1;
}

double zero_of(const std::function<double(double)>& f, double a, double b) {
  for (int i = 0; i < 200; ++i) {
    const double c = 0.5 * (a + b);
    ((f(a) > 0) == (f(c) > 0) ? a : b) = c;
  }
  return a;
}

// Two inertias with constant torques and a gear between them.
std::string two_masses(double first_torque, double second_torque, double ratio, const std::string& gear, double speed,
                       double until, const std::string& more = "") {
  return fmt::format(R"(
line = ["first", "gear", "second"]
first = {{ kind = "torque source", torque = "{:.17g} N*m", inertia = "0.02 kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [10, {}] }}]{} }}
second = {{ kind = "torque source", torque = "{:.17g} N*m", inertia = "0.3 kg*m2" }}
run = {{ start = {{ speed = "{} rad/s" }}, until = "{} s", accuracy = 1e-9, samples = 11 }}
{})",
                     first_torque, std::lround(10 * ratio), gear, second_torque, speed, until, more);
}

// Modelica.Mechanics.Rotational.Examples.LossyGearDemo1 (tests/cases/fr06_lossygear.toml, reference results of
// MAP-LIB): J = 1 and 1.5 kg·m², i = 2, η = 0.5 either way, 10 sin 2πt on the first, −10 + 2.5 t on the second.
TEST(GearLosses, LossyGearDemoSticksAndMovesAsPublished) {
  const Validation is(Against::published, "Modelica.Mechanics.Rotational.Examples.LossyGearDemo1 (case fr06)");
  const Result result = run(R"(
line = ["first", "gear", "second"]
first = { kind = "torque source", amplitude = "10 N*m", frequency = "1 Hz", inertia = "1 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [10, 20] }], efficiency = 0.5 }
second = { kind = "torque source", inertia = "1.5 kg*m2", table = { over = "time", unit = ["s", "N*m"], points = [[0, -10], [10, 15]] } }
run = { until = "0.5 s", accuracy = 1e-9, samples = 51 }
)");
  ASSERT_TRUE(result.complete) << result.diagnosis;
  const double stuck_1 = time_of(result, "gear", "is held by its losses");
  const double forward = time_of(result, "gear", "moves forwards");
  const double stuck_2 = time_of(result, "gear", "is held by its losses", forward);
  const double back = time_of(result, "gear", "moves backwards", forward);
  is.near("first held by its losses", "s", stuck_1, 0.080476, 5e-4);
  is.near("moves forwards", "s", forward, 0.199520, 5e-4);
  is.near("held again", "s", stuck_2, 0.371342, 5e-4);
  is.near("moves backwards", "s", back, 0.464540, 5e-4);
  // Exactly: it moves forwards when η M₁ i + M₂ > 0, backwards when M₁ i + η M₂ < 0.
  const auto first = [](double t) { return 10 * std::sin(two_pi * t); };
  const auto second = [](double t) { return -10 + 2.5 * t; };
  EXPECT_NEAR(forward, zero_of([&](double t) { return 0.5 * 2 * first(t) + second(t); }, 0.1, 0.25), 1e-10);
  EXPECT_NEAR(back, zero_of([&](double t) { return 2 * first(t) + 0.5 * second(t); }, 0.4, 0.5), 1e-10);
  is.near("angle of the second shaft at 0.5 s", "rad", 1, result.find("final_angle.second"), 1.65918e-5, 1e-6);
  is.near("speed of the second shaft at 0.5 s", "rad/s", 1, result.find("final_speed.second"), -0.01626377, 2e-4);
  is.near("largest difference to the series, angle", "rad",
          test::largest_difference(result, "angle.second", test::published_series("fr06_lossygear.csv", 1, 2)), 0,
          1e-6);
  is.near("largest difference to the series, speed", "rad/s",
          test::largest_difference(result, "speed.second", test::published_series("fr06_lossygear.csv", 1, 3)), 0,
          2e-4);
  EXPECT_LT(result.energy.relative, 1e-9);
}

// J ω̇ = −λ on the first, λ − L on the second, L = (1 − η) λ + b: λ = b/(1 + η) = 0.5 N·m, ω̇ = −500 rad/s².
TEST(GearLosses, RunsDownByItsOwnLossesAndStays) {
  const Validation is(Against::closed_form, "Lossy gear that runs down by its own losses: λ = b/(1 + η)");
  const Result result = run(R"(
line = ["first", "gear", "second"]
first = { kind = "flywheel", inertia = "0.001 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [10, 10] }], efficiency = 0.25, bearing_torque = "0.625 N*m", bearing_torque_backwards = "2.5 N*m" }
second = { kind = "flywheel", inertia = "0.001 kg*m2" }
run = { start = { speed = "10 rad/s" }, until = "0.1 s", accuracy = 1e-9 }
)");
  ASSERT_TRUE(result.complete) << result.diagnosis;
  is.near("time to standstill", "s", time_of(result, "gear", "is held by its losses"), 0.02, 1e-13);
  EXPECT_EQ(result.events.size(), 1u);
  is.near("angle of the first shaft", "rad", 1, result.find("final_angle.first"), 0.1, 1e-13);
  is.near("angle of the second shaft", "rad", 1, result.find("final_angle.second"), 0.1, 1e-13);
  EXPECT_EQ(figure(result, "final_speed.first"), 0.0);
  EXPECT_EQ(figure(result, "final_speed.second"), 0.0);
  is.near("work of the losses", "J", result.energy.by_account.at("gear"), -0.1, 1e-12);  // all that was in motion
}

// With no torque on the input the output is held up to b₂ i; beyond it λ = η₂ (μ + b₂).
TEST(GearLosses, HoldsAnOutputTorqueUpToItsBearings) {
  const double ratio = 3, bearing = 2.5, back = 0.25, limit = bearing * ratio;
  const std::string gear = ", efficiency = 0.25, bearing_torque = \"2.5 N*m\"";
  for (const double sign : {1.0, -1.0}) {
    const Result held = run(two_masses(0, sign * limit * (1 - 1e-6), ratio, gear, 0, 0.1));
    EXPECT_EQ(figure(held, "final_speed.second"), 0.0);
    const double torque = 1.5 * limit;
    const Result moves = run(two_masses(0, sign * torque, ratio, gear, 0, 0.1));
    // On the input: J₁ α = −λ, J₂ α = T + μ, λ = η₂ (μ + b).
    const double j1 = 0.02, j2 = 0.3 / (ratio * ratio), t = torque / ratio;
    const double alpha = back * (t - bearing) / (j1 + back * j2);
    EXPECT_NEAR(figure(moves, "final_speed.first"), sign * alpha * 0.1, 1e-10 * alpha);
    EXPECT_NEAR(figure(moves, "final_speed.second"), sign * alpha * 0.1 / ratio, 1e-10 * alpha);
  }
  const Result starts = run(two_masses(0, limit * (1 + 1e-6), ratio, gear, 0, 0.1));
  EXPECT_GT(figure(starts, "final_speed.second"), 0.0);
}

// Output over input power is η₁ when the input drives, input over output η₂ when the output does; either sense.
TEST(GearLosses, PowerRatioIsTheEfficiencyOfItsDirection) {
  for (const double ratio : {0.4, 1.0, 7.3})
    for (const double forwards : {0.3, 0.9})
      for (const double backwards : {0.2, 0.85})
        for (const double sense : {1.0, -1.0})
          for (const bool driving : {true, false}) {
            const double first = sense * (driving ? 8 : -0.1), second = sense * ratio * (driving ? -0.05 : 6);
            const std::string gear =
                fmt::format(", efficiency_forwards = {}, efficiency_backwards = {}", forwards, backwards);
            const Result r = run(two_masses(first, second, ratio, gear, 100 * sense, 0.05), false);
            const auto in = series(r, "torque.gear.in"), out = series(r, "torque.gear.out");
            const auto w_in = series(r, "speed.first"), w_out = series(r, "speed.second");
            for (std::size_t k = 0; k < in.size(); ++k) {
              const double p_in = in[k] * w_in[k], p_out = out[k] * w_out[k];
              ASSERT_EQ(p_in > 0, driving);
              if (driving) {
                EXPECT_NEAR(p_out / p_in, forwards, 1e-12);
              } else {
                EXPECT_NEAR(p_in / p_out, backwards, 1e-12);
              }
              EXPECT_NEAR(w_in[k], std::round(10 * ratio) / 10 * w_out[k], 1e-11 * std::abs(w_in[k]));
            }
            EXPECT_LT(r.energy.relative, 1e-11);
            EXPECT_LT(r.energy.by_account.at("gear"), 0);
          }
}

// Torques oscillate, so that power changes sides while it runs: every switch is an event, and energies still balance.
TEST(GearLosses, EnergyBalancesWhileThePowerChangesSides) {
  for (const double bearing : {0.0, 0.3}) {
    const Result r = run(fmt::format(R"(
line = ["first", "gear", "second"]
first = {{ kind = "torque source", torque = "1 N*m", amplitude = "20 N*m", frequency = "7 Hz", inertia = "0.02 kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [10, 30] }}], efficiency_forwards = 0.8, efficiency_backwards = 0.6, bearing_torque = "{0} N*m", bearing_torque_backwards = "{1} N*m" }}
second = {{ kind = "load", damping = "0.2 N*m*s/rad", inertia = "0.1 kg*m2" }}
run = {{ start = {{ speed = "40 rad/s" }}, until = "2 s", accuracy = 1e-8 }}
)",
                                     bearing, 1.5 * bearing));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_TRUE(r.accuracy_confirmed);
    EXPECT_LT(r.energy.relative, 1e-8);
    EXPECT_LT(r.energy.by_account.at("gear"), -1.0);
  }
}

// η₂ < 0: no torque on the output moves it; with help of |η₂| T/i on the input it does.
TEST(GearLosses, SelfLockingGearHoldsAnyLoadAndWantsHelpToLowerIt) {
  const double ratio = 5, back = -0.2;
  const std::string gear = ", efficiency_forwards = 0.4, efficiency_backwards = -0.2";
  const std::string scene = two_masses(0, 1e4, ratio, gear, 0, 0.1);
  const Result held = run(scene);
  EXPECT_EQ(figure(held, "final_speed.second"), 0.0);
  EXPECT_EQ(figure(held, "final_angle.second"), 0.0);
  EXPECT_NE(held.explanation.find("self-locking"), std::string::npos) << held.explanation;
  EXPECT_NE(held.explanation.find("0.04 N·m on the input per N·m"), std::string::npos) << held.explanation;

  const double torque = 50, help = -back * torque / ratio;
  EXPECT_EQ(figure(run(two_masses(0.999 * help, torque, ratio, gear, 0, 0.1)), "final_speed.second"), 0.0);
  const Result lowered = run(two_masses(1.5 * help, torque, ratio, gear, 0, 0.1));
  // J₁ α = M − λ, J₂ α = T/i + μ, λ = η₂ μ.
  const double j1 = 0.02, j2 = 0.3 / (ratio * ratio);
  ASSERT_LT(-back * j2, 0.5 * j1);  // nothing is bounded
  const double alpha = (1.5 * help + back * torque / ratio) / (j1 + back * j2);
  EXPECT_NEAR(figure(lowered, "final_speed.first"), alpha * 0.1, 1e-10 * alpha);
  EXPECT_LT(lowered.energy.relative, 1e-11);
}

// A self-locking drive that is left alone under load stops and stays, however heavy what it drives.
// While the load drives forwards, λ = 0.2 |μ| is what the gear wants of its input:
//     I₁ i ε = −0.5 − λ,  I₂ ε = 40 − i |μ|,  |μ| = 5 λ:   (I₂ − 25 I₁ i) ε = 40 + 25 · 0.5.
// A light load comes to rest so; from |η₂| I₂ > I₁ i² on, none of its accelerations will do: it jams and stops at once.
TEST(GearLosses, SelfLockingGearStopsAnOverhaulingLoad) {
  for (const double inertia : {0.3, 300.0}) {
    const Result r = run(fmt::format(R"(
line = ["first", "gear", "second"]
first = {{ kind = "load", torque = "0.5 N*m", inertia = "0.02 kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ teeth = [10, 50] }}], efficiency_forwards = 0.4, efficiency_backwards = -0.2 }}
second = {{ kind = "torque source", torque = "40 N*m", inertia = "{} kg*m2" }}
run = {{ start = {{ speed = "100 rad/s" }}, until = "10 s", accuracy = 1e-8 }}
)",
                                     inertia));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_EQ(figure(r, "final_speed.second"), 0.0);
    EXPECT_LT(r.energy.relative, 1e-8);
    const double acceleration = (40 + 25 * 0.5) / (inertia - 25 * 0.1);  // of the second shaft; < 0 for the light one
    if (acceleration < 0) {
      EXPECT_GT(time_of(r, "gear", "is held by its losses") + time_of(r, "first", "comes to rest and is held"), 0.0);
      EXPECT_NEAR(figure(r, "final_angle.second"), 20.0 * 20 / 2 / -acceleration, 1e-7);
    } else {
      EXPECT_EQ(time_of(r, "gear", "jams: no acceleration satisfies its friction; it stops at once", -1), 0.0);
      EXPECT_EQ(figure(r, "final_angle.second"), 0.0);
      EXPECT_NEAR(test::figure(r, "work.harmful"), -0.5 * (0.02 * 100 * 100 + inertia * 20 * 20), 1e-6);
    }
  }
}

// Without the effect the gear is the ideal one: the same states, Jacobian, guards and bits.
TEST(GearLosses, OffLeaveNoTrace) {
  const std::string gear = ", efficiency_forwards = 0.8, efficiency_backwards = 0.7, bearing_torque = \"0.1 N*m\"";
  const Scene off = test::scene_from(two_masses(3, -20, 4, gear, 10, 1, "effects = { gear_losses = false }\n"));
  const Scene absent = test::scene_from(two_masses(3, -20, 4, "", 10, 1));
  test::expect_same_model(off, absent);
  EXPECT_EQ(figure(run(off), "final_speed.second"), figure(run(absent), "final_speed.second"));
  const Scene on = test::scene_from(two_masses(3, -20, 4, gear, 10, 1));
  EXPECT_EQ(compile(on, on.effects)->free_shafts, 2u);
}

TEST(GearLosses, JacobianEqualsDifferencesInEveryMode) {
  const std::string scene = R"(
line = ["motor", "gear", "coupling", "pump"]
motor = { kind = "load", damping = "0.3 N*m*s/rad", inertia = "0.02 kg*m2" }
drive = { kind = "torque source", torque = "FIRST N*m", on = "motor" }
gear = { kind = "gearbox", stages = [{ teeth = [10, 25], inertia = ["0.001 kg*m2", "0.01 kg*m2"] }], efficiency_forwards = 0.8, efficiency_backwards = BACK, bearing_torque = "0.1 N*m" }
coupling = { kind = "coupling", stiffness = "500 N*m/rad", damping = "2 N*m*s/rad" }
pump = { kind = "load", damping = "1 N*m*s/rad", inertia = "0.1 kg*m2" }
pull = { kind = "torque source", torque = "SECOND N*m", on = "pump" }
effects = { elasticity = true, gear_losses = true }
run = { start = { equilibrium = true, speed = "SPEED rad/s" }, until = "1 s" }
)";
  const auto with = [&](double first, double second, double speed, double back) {
    return test::with(
        test::with(test::with(test::with(scene, "FIRST", test::digits(first)), "SECOND", test::digits(second)), "SPEED",
                   test::digits(speed)),
        "BACK", test::digits(back));
  };
  for (const double back : {0.6, -0.1})
    for (const double speed : {50.0, -50.0, 0.0})
      for (const double first : {40.0, -40.0})
        for (const double second : {300.0, -300.0}) {
          SCOPED_TRACE(fmt::format("η₂ {}, {} rad/s, {} and {} N·m", back, speed, first, second));
          test::expect_exact_jacobian_near_start(with(first, second, speed, back), {}, 1e-6);
        }
}

// Several stages, each with its losses: the efficiency of the whole is the product.
TEST(GearLosses, EfficienciesOfStagesMultiply) {
  const Result r = run(R"(
line = ["first", "gear", "second"]
first = { kind = "torque source", torque = "8 N*m", inertia = "0.02 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [10, 20], efficiency = 0.9, inertia = ["0 kg*m2", "1e-5 kg*m2"] }, { teeth = [10, 30], efficiency = 0.8 }] }
second = { kind = "load", torque = "10 N*m", inertia = "20000 kg*m2" }
run = { start = { speed = "60 rad/s" }, until = "0.01 s", samples = 3 }
)",
                       false);
  const auto in = series(r, "torque.gear.in"), out = series(r, "torque.gear.out");
  EXPECT_NEAR(out.back() / in.back(), 6 * 0.9 * 0.8, 1e-6);  // the wheels between accelerate next to nothing
}

TEST(WormGear, EfficienciesFollowFromLeadAndFrictionAngle) {
  const double lead = 10 * std::numbers::pi / 180;
  for (const double friction : {0.05, 0.3}) {
    const double angle = std::atan(friction / std::cos(20 * std::numbers::pi / 180));
    const auto worm = [&](double torque, double load, double speed) {
      return run(fmt::format(R"(
line = ["motor", "worm", "drum"]
motor = {{ kind = "torque source", torque = "{:.17g} N*m", inertia = "0.02 kg*m2" }}
worm = {{ kind = "worm gear", starts = 2, teeth = 40, lead_angle = "10 deg", friction_coefficient = {} }}
drum = {{ kind = "torque source", torque = "{:.17g} N*m", inertia = "1 kg*m2" }}
run = {{ start = {{ speed = "{} rad/s" }}, until = "0.1 s", samples = 3, accuracy = 1e-9 }}
)",
                             torque, friction, load, speed));
    };
    const Result lifts = worm(10, -20, 100);
    const double up = series(lifts, "torque.worm.out").back() / (20 * series(lifts, "torque.worm.in").back());
    EXPECT_NEAR(up, std::tan(lead) / std::tan(lead + angle), 1e-12);
    const Result left = worm(0, 100, 0);
    if (lead > angle) {
      const double down = 20 * series(left, "torque.worm.in").back() / series(left, "torque.worm.out").back();
      EXPECT_NEAR(down, std::tan(lead - angle) / std::tan(lead), 1e-12);
      EXPECT_GT(figure(left, "final_speed.drum"), 0.0);
    } else {
      EXPECT_EQ(figure(left, "final_speed.drum"), 0.0);
      EXPECT_NE(left.explanation.find("self-locking"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace kurbel::gear_losses_test
