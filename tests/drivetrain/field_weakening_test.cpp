// field_weakening_test.cpp — a DC motor with weakened field: steady speeds and exponentials in closed form, constant power
// over the speed, and its circuit against equations of motion written out here in long double (theory 4.20).
#include <fmt/format.h>

#include <cmath>

#include "tests/published/published.h"
#include "tests/support/jacobians.h"
#include "tests/support/validation.h"

namespace kurbel::field_weakening_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::series;
using test::Validation;
using Real = long double;

constexpr Real voltage = 220, resistance = 0.4L, constant = 1.4L, inertia = 3, load = 40;

std::string motor(const std::string& more, const std::string& settings) {
  return fmt::format(R"(
line = ["motor", "load"]
[motor]
kind = "dc shunt motor"
voltage = "220 V"
resistance = "0.4 Ohm"
constant = "1.4 N*m/A"
inertia = "1 kg*m2"
{}
[load]
kind = "flywheel"
inertia = "2 kg*m2"
[weight]
kind = "torque source"
on = "load"
torque = "-40 N*m"
[run]
{}
)",
                     more, settings);
}

// ω_∞ = U/(f k) − M R/(f k)², T = J R/(f k)²: before and behind a step of the field at 6 s.
TEST(FieldWeakening, StepOfTheFieldLeadsToTheNextExponential) {
  const Result r =
      run(motor("field = { over = \"time\", unit = [\"s\", \"1\"], points = [[0, 1], [6, 1], [6, 0.6], [20, 0.6]] }",
                "until = \"10 s\"\nsamples = 1001\naccuracy = 1e-10"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto limit = [](Real f) {
    return voltage / (f * constant) - load * resistance / (f * f * constant * constant);
  };
  const auto lag = [](Real f) { return inertia * resistance / (f * f * constant * constant); };
  const Real at_step = limit(1) * (1 - std::exp(-6 / lag(1)));
  const std::vector<double> speed = series(r, "speed.motor");
  for (std::size_t row = 0; row < speed.size(); ++row) {
    const Real t = 0.01L * static_cast<Real>(row);
    const Real expected = t <= 6 ? limit(1) * (1 - std::exp(-t / lag(1)))
                                 : limit(0.6L) + (at_step - limit(0.6L)) * std::exp(-(t - 6) / lag(0.6L));
    EXPECT_NEAR(speed[row], static_cast<double>(expected), 1e-8) << static_cast<double>(t);
  }
  const Validation is(Against::closed_form,
                      "DC shunt motor with its field weakened to 60 %: ω∞ = U/(f k) − M R/(f k)²");
  is.near("speed 4 s behind the step", "rad/s", speed.back(),
          static_cast<double>(limit(0.6L) + (at_step - limit(0.6L)) * std::exp(-4 / lag(0.6L))), 1e-8);
}

// f = ω_b/ω keeps the counter-voltage: from ω_b on the torque goes with 1/ω, the power is constant. Either sense.
TEST(FieldWeakening, ByTheSpeedItKeepsThePower) {
  for (const double speed : {60.0, 110.0, 180.0, 300.0}) {
    for (const int sense : {1, -1}) {
      const std::string text = fmt::format(R"~(
line = ["drive", "motor"]
drive = {{ kind = "prescribed speed", speed = "{} rad/s" }}
sequence = {{ steps = [{{ at = "0 s", set = "motor", to = {} }}] }}
run = {{ until = "0.1 s", samples = 3 }}
[motor]
kind = "dc shunt motor"
voltage = "220 V"
resistance = "0.4 Ohm"
constant = "1.4 N*m/A"
inertia = "1 kg*m2"
field = {{ over = "speed", formula = "min(1, 140 [rad/s]/(speed + 0.001 [rad/s]))", range = ["1 rad/s", "400 rad/s"] }}
)~",
                                           sense * speed, sense);
      const Result r = run(text, false);
      ASSERT_TRUE(r.complete) << r.diagnosis;
      const double f = std::min(1.0, 140 / (speed + 0.001)), k = 1.4 * f;
      const double power = k * (220 - k * speed) / 0.4 * speed;
      EXPECT_NEAR(r.energy.by_account.at("motor") / 0.1, power, 1e-8 * std::abs(power)) << speed;
    }
  }
}

// The circuit with a field that falls in a ramp: J ω̇ = f k i − M, L di/dt = U − R i − f k ω by Runge and Kutta.
TEST(FieldWeakening, CircuitFollowsItsEquations) {
  const Result r =
      run(motor("inductance = \"20 mH\"\nfield = { over = \"time\", unit = [\"s\", \"1\"], points = [[0, 1], "
                "[1, 1], [1.5, 0.55], [9, 0.55]] }",
                "start = { speed = \"100 rad/s\" }\nuntil = \"3 s\"\nsamples = 301\naccuracy = 1e-10"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto field = [](Real t) { return t <= 1 ? 1 : t >= 1.5L ? 0.55L : 1 - 0.9L * (t - 1); };
  struct State {
    Real speed, current;
  };
  const auto rate = [&](Real t, State s) {
    const Real k = field(t) * constant;
    return State{(k * s.current - load) / inertia, (voltage - resistance * s.current - k * s.speed) / 0.02L};
  };
  const auto moved = [](State s, State d, Real h) { return State{s.speed + h * d.speed, s.current + h * d.current}; };
  State s{100, (voltage - constant * 100) / resistance};
  const std::vector<double> speed = series(r, "speed.motor"), current = series(r, "current.motor");
  constexpr int steps = 20;  // of 0.5 ms between rows: kinks fall on rows
  for (std::size_t row = 0; row < speed.size(); ++row) {
    EXPECT_NEAR(speed[row], static_cast<double>(s.speed), 1e-8) << row;
    EXPECT_NEAR(current[row], static_cast<double>(s.current), 1e-6) << row;
    const Real h = 0.01L / steps;
    for (int k = 0; k < steps; ++k) {
      const Real t = 0.01L * static_cast<Real>(row) + h * k;
      const State a = rate(t, s), b = rate(t + h / 2, moved(s, a, h / 2)), c = rate(t + h / 2, moved(s, b, h / 2)),
                  d = rate(t + h, moved(s, c, h));
      s.speed += h / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed);
      s.current += h / 6 * (a.current + 2 * b.current + 2 * c.current + d.current);
    }
  }
  EXPECT_LT(std::abs(r.energy.relative), 1e-9);
}

TEST(FieldWeakening, DerivativesAreExact) {
  for (const char* inductance : {"", "inductance = \"20 mH\"\n"})
    for (const char* field : {"field = { over = \"time\", unit = [\"s\", \"1\"], points = [[0, 1], [1, 0.5]] }",
                              "field = { over = \"speed\", unit = [\"rad/s\", \"1\"], interpolation = \"smooth\", "
                              "points = [[0, 1], [90, 0.9], [200, 0.5]] }"})
      test::expect_exact_jacobian_near_start(
          motor(std::string(inductance) + field, "start = { speed = \"95 rad/s\" }\nuntil = \"1 s\""), {}, 1e-6);
}

// Without transients the circuit is its static line: the same steady speed.
TEST(FieldWeakening, WithoutTransientsIsItsLine) {
  const std::string text = motor(
      "inductance = \"20 mH\"\nfield = { over = \"speed\", unit = [\"rad/s\", \"1\"], points = [[0, 1], [140, 1], "
      "[300, 0.5]] }",
      "until = \"30 s\"\naccuracy = 1e-9");
  const Result full = run(text, false), line = run(text + "[effects]\ntransients = false\n", false);
  ASSERT_TRUE(full.complete && line.complete);
  EXPECT_NEAR(figure(full, "final_speed.motor"), figure(line, "final_speed.motor"), 1e-6);
}

}  // namespace
}  // namespace kurbel::field_weakening_test
