// angle_laws_test.cpp — no step jumps over a part of a law over the angle.
//
//     ½ J (ω² − ω₀²) = ∫ M dφ: a wheel that only this torque acts on; between the points the law is linear
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>
#include <utility>

#include "engine/numerics/period.h"
#include "engine/run/run.h"
#include "tests/published/published.h"
#include "tests/support/scenes.h"

namespace kurbel::angle_laws_test {
namespace {

using std::numbers::pi;

constexpr double degree = pi / 180;

// A pulse on a base, with steep sides, over a period; its mean is zero.
struct Pulse {
  double period, begin, width, side = 0.01 * degree, height, base;

  Pulse(double period_, double begin_, double width_, double height_)
      : period(period_), begin(begin_), width(width_), height(height_), base(-height_ * (width_ + side) / period_) {}
  std::string points() const {
    const auto point = [this](double x, bool up) {
      return fmt::format("[{}, {}]", test::digits(x / degree), test::digits(up ? base + height : base));
    };
    return fmt::format("[{}, {}, {}, {}, {}, {}]", point(0, false), point(begin, false), point(begin + side, true),
                       point(begin + side + width, true), point(begin + width + 2 * side, false), point(period, false));
  }
  // ∫ M dφ from 0; over whole periods zero.
  double work(double phi) const {
    const double x = place_within(phi, period), in = x - begin;
    const auto ramp = [this](double s) { return s <= 0 ? 0.0 : 0.5 * s * s / side; };
    const auto rise = [&](double s) { return s < side ? ramp(s) : s - 0.5 * side; };
    return base * x + height * (rise(in) - rise(in - width - side));
  }
};

TEST(AngleLaws, DoTheWorkOfTheirAreaHoweverNarrowTheirPulseIs) {
  constexpr double inertia = 400, omega = 20;
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int k = 0; k < 60; ++k) {
    const double period = std::array{60, 90, 120, 180, 360, 720}[static_cast<std::size_t>(k % 6)] * degree;
    const double width = period * std::pow(10, uniform(-2.5, -0.3));
    const Pulse pulse(period, uniform(0.01, 0.45) * period, width, uniform(-300, 300) / (width / degree));
    const double start = uniform(0, 1) < 0.3 ? 0 : uniform(0, 4 * pi), sense = k % 4 == 3 ? -1 : 1;
    const Scene scene = test::scene_from(fmt::format(R"(
line = ["wheel"]
wheel = {{ kind = "flywheel", inertia = "{} kg*m2" }}
push = {{ kind = "torque source", on = "wheel", table = {{ over = "angle", unit = ["deg", "N*m"], points = {}, period = "{} deg" }} }}
run = {{ until = "3 s", start = {{ speed = "{} rad/s", angle = "{} rad" }} }}
)",
                                                     inertia, pulse.points(), test::digits(period / degree),
                                                     sense * omega, test::digits(start)));
    for (const char* method : {"dopri5", "dop853", "esdirk5", "work"}) {
      Equations equations(compile(scene, scene.effects), false);
      RunOptions options;
      options.tolerance = 1e-6, options.method = method, options.until = uniform(2.5, 3);
      const RunOutcome out = integrate(equations, options, {});
      ASSERT_TRUE(out.complete) << out.diagnosis;
      const double speed = out.state[equations.speed_index(0)];
      const double work = pulse.work(equations.angle_with_turns(0, out.state)) - pulse.work(start);
      EXPECT_NEAR(0.5 * inertia * (speed * speed - omega * omega), work, 2e-2)
          << method << ", period " << period / degree << ", pulse " << width / degree << " deg of " << pulse.height;
    }
  }
}

// M = 100 (φ/π − 1): a saw tooth, whose jump lies where the period closes; ∫M dφ = 100 (φ²/(2π) − φ). A sine that closes
// without a kink has no event there.
TEST(AngleLaws, OfOnePieceJumpWhereTheirPeriodCloses) {
  for (const auto& [law, jumps] :
       {std::pair{"100 [N*m]*(angle/(pi*1 [rad]) - 1)", true}, std::pair{"100 [N*m]*sin(angle/1 [rad])", false}}) {
    const Scene scene = test::scene_from(fmt::format(R"(
line = ["wheel"]
wheel = {{ kind = "flywheel", inertia = "40 kg*m2" }}
push = {{ kind = "torque source", on = "wheel", table = {{ over = "angle", formula = "{}", period = "360 deg" }} }}
run = {{ until = "3 s", start = {{ speed = "20 rad/s", angle = "1 rad" }} }}
)",
                                                     law));
    for (const char* method : {"dop853", "work"}) {
      Equations equations(compile(scene, scene.effects), false);
      RunOptions options;
      options.tolerance = 1e-9, options.method = method, options.until = 3;
      const RunOutcome out = integrate(equations, options, {});
      ASSERT_TRUE(out.complete) << out.diagnosis;
      const auto work = [jumps = jumps](double phi) {
        const double x = place_within(phi, 2 * pi);
        return jumps ? 100 * (x * x / (2 * pi) - x) : -100 * std::cos(x);
      };
      const double speed = out.state[equations.speed_index(0)];
      EXPECT_NEAR(20 * (speed * speed - 400), work(equations.angle_with_turns(0, out.state)) - work(1), 1e-5)
          << law << ", " << method;
      if (std::string_view(method) == "dop853") {
        EXPECT_EQ(out.statistics.knots, jumps ? 9 : 0);
      }
    }
  }
}

// A pulse by a formula, in time, alone or on a rising torque, or over the angle: J Δω = ∫ M dt = √π M₀ τ, and J (ω² − ω₀²)/2 = n √π M₀ σ after n pulses.
TEST(Formulas, NarrowPulsesAreSeenByEveryMethod) {
  struct Law {
    const char *text, *extra;
    double momentum, work;  // of all pulses within 60 rad [N·m·s], [N·m]
  };
  const double root = std::sqrt(pi);
  for (const Law& law :
       {Law{"5000 [N*m]*exp(-((t - 1.2345 [s])/0.001 [s])^2)", ", over = \"time\", range = [\"0 s\", \"3 s\"]",
            root * 5, 0},
        Law{"1000 [N*m]*t/1 [s] + 58 [N*m]*exp(-((t - 1.2341 [s])/0.002 [s])^2)",
            ", over = \"time\", range = [\"0 s\", \"3 s\"]", 4500 + root * 0.116, 0},
        Law{"500 [N*m]*exp(-((angle - 1 [rad])/0.01 [rad])^2)", ", over = \"angle\"", 0, 10 * root * 5},
        Law{"500 [N*m]*exp(-((angle - 5 [rad])/0.05 [rad])^2)", ", over = \"angle\"", 0, 9 * root * 25}})
    for (const char* method : {"dopri5", "dop853", "esdirk5", "bdf"}) {
      const Scene scene = test::scene_from(fmt::format(R"(
line = ["wheel"]
wheel = {{ kind = "flywheel", inertia = "400 kg*m2" }}
push = {{ kind = "torque source", on = "wheel", table = {{ formula = "{}"{} }} }}
run = {{ until = "3 s", start = {{ speed = "20 rad/s", angle = "0.1 rad" }} }}
)",
                                                       law.text, law.extra));
      Equations equations(compile(scene, scene.effects), false);
      RunOptions options;
      options.tolerance = 1e-10, options.method = method, options.until = 3;
      const RunOutcome out = integrate(equations, options, {});
      ASSERT_TRUE(out.complete) << out.diagnosis;
      const double speed = out.state[equations.speed_index(0)];
      const double exact = law.work > 0 ? std::sqrt(400 + 2 * law.work / 400) : 20 + law.momentum / 400;
      EXPECT_NEAR(speed, exact, 1e-6) << law.text << ", " << method;
    }
}

}  // namespace
}  // namespace kurbel::angle_laws_test
