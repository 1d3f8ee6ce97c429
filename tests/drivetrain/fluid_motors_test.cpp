// fluid_motors_test.cpp — hydraulic and pneumatic drives: flow balance, power, settling speeds.
#include "drivetrain/motors/fluid_motors.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "tests/support/scenes.h"

namespace kurbel::fluid_motors_test {
namespace {

using test::figure;
using test::run;

HydraulicMotor some_hydraulic(unsigned seed) {
  std::mt19937 random(seed);
  const auto some = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  return {some(1e-6, 1e-4), some(5e6, 3e7), some(1e-4, 5e-3),
          some(0.8, 0.99),  some(0.8, 1),   seed % 2 ? some(1e5, 3e6) : 0};
}

// The flow of the pump is what the motor, its leakage and the relief valve take.
TEST(HydraulicMotor, FlowsBalanceOnBothLines) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const HydraulicMotor m = some_hydraulic(seed);
    const Curve curve = m.curve();
    const double leakage = (1 - m.volumetric_efficiency) * m.flow / m.relief_pressure;
    for (int i = -20; i <= 40; ++i) {
      const double speed = m.no_load_speed() * i / 40;
      const double pressure = curve.value(speed) / (m.hydromechanical_efficiency * m.displacement);
      const double surplus = m.flow - m.displacement * speed - leakage * pressure;
      if (speed >= m.flow_limited_speed()) {
        EXPECT_NEAR(surplus, 0, 1e-12 * m.flow);  // the valve is shut
        EXPECT_LE(pressure, m.relief_pressure * (1 + 1e-12));
      } else if (m.relief_rise > 0) {
        EXPECT_NEAR(surplus, (pressure - m.relief_pressure) / m.relief_rise * m.flow, 1e-11 * m.flow);
      } else {
        EXPECT_NEAR(pressure, m.relief_pressure, 1e-12 * m.relief_pressure);
      }
    }
    EXPECT_EQ(curve.value(m.no_load_speed()), 0);
    EXPECT_EQ(curve.value(2 * m.no_load_speed()), 0);  // anti-cavitation valve
  }
}

// At the flow-limited speed the shaft power is η_v η_hm of the hydraulic power Q Δp.
TEST(HydraulicMotor, PowerIsTheProductOfItsEfficiencies) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const HydraulicMotor m = some_hydraulic(seed);
    const double speed = m.flow_limited_speed();
    EXPECT_NEAR(m.curve().value(speed) * speed / (m.flow * m.relief_pressure),
                m.volumetric_efficiency * m.hydromechanical_efficiency, 1e-12);
  }
}

// 80 cm³/rev, 200 bar, 40 l/min, η_v = 0.95, η_hm = 0.9: M = Δp V/2π η_hm = 229.2 N·m; against inertia the motor runs
// up at M/J to 475 rpm, then J dω/dt = M (ω₂ − ω)/(ω₂ − ω₁) towards 500 rpm.
TEST(HydraulicMotor, RunsUpAtConstantTorqueToItsFlowLimitedSpeed) {
  const double torque = 200e5 * 80e-6 / (2 * M_PI) * 0.9, w1 = 475 * M_PI / 30, w2 = 500 * M_PI / 30, inertia = 12;
  const double t1 = inertia * w1 / torque, tau = inertia * (w2 - w1) / torque;
  for (const double t : {0.5 * t1, t1 + 2 * tau}) {
    const Result r = run(fmt::format(R"(
line = ["motor"]
[motor]
kind = "hydraulic motor"
displacement = "80 cm3/rev"
pressure_difference = "200 bar"
flow = "40 l/min"
inertia = "12 kg*m2"
[run]
until = "{:.17g} s"
accuracy = 1e-10
)",
                                     t));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double expected = t < t1 ? torque * t / inertia : w2 - (w2 - w1) * std::exp(-(t - t1) / tau);
    EXPECT_NEAR(figure(r, "final_speed.motor"), expected, 1e-9 * expected);
    EXPECT_LE(r.energy.relative, 1e-9);
  }
}

TEST(PneumaticMotor, StraightLineHasItsGreatestPowerAtHalfTheFreeSpeed) {
  const PneumaticMotor m{20, 600, 0};
  double greatest = 0, at = 0;
  for (int i = 0; i <= 6000; ++i) {
    const double speed = 0.1 * i, power = m.torque(ShaftState<double>{0, 0, speed, 1, 1}) * speed;
    if (power > greatest) greatest = power, at = speed;
  }
  EXPECT_NEAR(greatest, 20 * 600 / 4.0, 1e-9);
  EXPECT_NEAR(at, 300, 0.1);
}

// Whatever the bend: M_s at standstill, none at the free speed, falling between, and the greatest power is the
// requested one.
TEST(PneumaticMotor, BendPassesTheCataloguesPower) {
  for (const double number : {0.15, 0.2, 0.25, 0.3, 0.38}) {
    const PneumaticMotor m{20, 600, PneumaticMotor::bend_for(number)};
    const auto torque = [&](double speed) {
      ShaftState<double> x{0, 0, speed, 0, 1};
      x.mode = m.first_mode(x);
      return m.torque(x);
    };
    EXPECT_EQ(torque(0), 20);
    EXPECT_NEAR(torque(600), 0, 1e-12);
    double greatest = 0;
    for (int i = 1; i <= 60000; ++i) {
      EXPECT_LE(torque(0.01 * i), torque(0.01 * (i - 1)));
      greatest = std::max(greatest, torque(0.01 * i) * 0.01 * i);
    }
    EXPECT_NEAR(greatest, number * 20 * 600, 1e-7 * 20 * 600);
    // Its tangents go on: no jump of torque or slope at either end, and it never drives beyond its free speed.
    for (const double end : {0.0, 600.0}) {
      const double h = 1e-3;
      EXPECT_NEAR(torque(end + h) - 2 * torque(end) + torque(end - h), 0, 1e-9);
    }
    EXPECT_LE(torque(2500), 0);
    EXPECT_GT(torque(-300), 20);
  }
  EXPECT_NEAR(PneumaticMotor::bend_for(0.25), 0, 1e-12);
}

// No load, straight line: ω = ω₀ (1 − e^{−t/τ}), τ = J ω₀/M_s.
TEST(PneumaticMotor, RunsUpExponentiallyToItsFreeSpeed) {
  const double w0 = 6000 * M_PI / 30, stall = 4 * 800 / w0, tau = 0.05 * w0 / stall;
  const Result r = run(fmt::format(R"(
line = ["motor"]
[motor]
kind = "pneumatic motor"
max_power = "800 W"
free_speed = "6000 rpm"
inertia = "0.05 kg*m2"
[run]
until = "{:.17g} s"
accuracy = 1e-10
)",
                                   1.5 * tau));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_speed.motor"), w0 * (1 - std::exp(-1.5)), 1e-9 * w0);
}

}  // namespace
}  // namespace kurbel::fluid_motors_test
