// orders_test.cpp — orders of speeds and torques in steady motion: closed forms, halves of a four-stroke cycle, Parseval.
#include "studies/steady/orders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>

#include "studies/dictionary/dictionary.h"
#include "studies/findings/output.h"
#include "studies/steady/steady.h"
#include "studies/variants/machine.h"
#include "tests/support/scenes.h"

namespace kurbel::test::orders_test {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

const OrdersOf& orders_of(const SteadyCycle& c, const std::string& channel) {
  for (const OrdersOf& of : c.orders)
    if (of.channel == channel) return of;
  ADD_FAILURE() << "no orders of " << channel;
  static const OrdersOf none;
  return none;
}

SteadyCycle cycle_of(const Scene& scene, const Effects& effects, const SteadyOptions& options = {}) {
  SteadyOptions given = options;
  given.start_search = false;
  const SteadyStudy study = steady(scene, {effects}, given);
  EXPECT_TRUE(study.complete) << study.diagnosis;
  return study.cycles.front();
}

// A wheel on a spring and damper behind a shaft that turns at 10 1/s; two torques shake it 2 and 3 times a turn.
struct Shaken {
  static constexpr double speed = 20 * pi, inertia = 0.4, stiffness = 9000, damping = 3, angle = 40 * pi / 180;
  struct Torque {
    int order;
    double amplitude, phase;  // of A sin(r ω t + ψ)
  };
  static constexpr Torque torques[] = {{2, 50, 0.3}, {3, 20, -1.1}};

  static std::string text() {
    return fmt::format(
        R"(line = ["drive", "coupling", "wheel"]
drive = {{ kind = "prescribed speed", speed = "{:.17g} rad/s" }}
coupling = {{ kind = "coupling", stiffness = "{:.17g} N*m/rad", damping = "{:.17g} N*m*s/rad" }}
wheel = {{ kind = "torque source", inertia = "{:.17g} kg*m2", amplitude = "{:.17g} N*m", frequency = "{} Hz", phase = "{:.17g} rad" }}
shake = {{ on = "wheel", kind = "torque source", amplitude = "{:.17g} N*m", frequency = "{} Hz", phase = "{:.17g} rad" }}
effects = {{ elasticity = true }}
run = {{ start = {{ angle = "40 deg" }}, until = "1 s" }}
)",
        speed, stiffness, damping, inertia, torques[0].amplitude, 10 * torques[0].order, torques[0].phase,
        torques[1].amplitude, 10 * torques[1].order, torques[1].phase);
  }
  // a e^(−iψ) over the angle φ = ω t + 40°: of the wheel's speed, and of what the coupling transmits.
  static Complex shift(int order) { return std::polar(1.0, -order * angle); }
  static Complex twist(const Torque& t) {
    const double nu = t.order * speed;
    const Complex driven = Complex(0, -t.amplitude) * std::polar(1.0, t.phase);
    return driven / Complex(stiffness - nu * nu * inertia, nu * damping);
  }
  static Complex wave_of_speed(const Torque& t) { return Complex(0, t.order * speed) * twist(t) * shift(t.order); }
  static Complex wave_of_torque(const Torque& t) {
    return -Complex(stiffness, t.order * speed * damping) * twist(t) * shift(t.order);
  }
};

TEST(Orders, AreThoseOfAShakenWheelInClosedForm) {
  const Scene scene = scene_from(Shaken::text());
  const SteadyCycle c = cycle_of(scene, scene.effects);
  for (const Shaken::Torque& t : Shaken::torques)
    for (const auto& [channel, owner, exact] :
         {std::tuple("speed", "wheel", Shaken::wave_of_speed(t)), {"torque", "coupling", Shaken::wave_of_torque(t)}}) {
      const std::string name = fmt::format("{}_order.{}.{}", channel, t.order, owner);
      const Figure *amplitude = c.find(name),
                   *phase = c.find(fmt::format("{}_order_phase.{}.{}", channel, t.order, owner));
      ASSERT_TRUE(amplitude && phase) << name;
      EXPECT_NEAR(amplitude->value, std::abs(exact), 1e-8 * std::abs(exact)) << name;
      EXPECT_NEAR(std::remainder(phase->value + std::arg(exact) * 180 / pi, 360), 0, 1e-6) << name;
      ASSERT_TRUE(amplitude->error && phase->error) << name;
      EXPECT_LE(std::abs(amplitude->value - std::abs(exact)), *amplitude->error + 1e-11 * std::abs(exact)) << name;
      EXPECT_LT(*amplitude->error, 1e-7 * std::abs(exact)) << name;
      EXPECT_EQ(amplitude->of, owner);
      EXPECT_EQ(phase->unit, "deg");
    }
  // Two orders, and no others; the drive's speed is given and has none.
  for (const char* channel : {"speed.wheel", "torque.coupling"})
    EXPECT_EQ(orders_of(c, channel).reporting().size(), 2u);
  EXPECT_TRUE(orders_of(c, "speed.drive").reporting().empty());
}

// The drive's speed is given: the part of its vibration that orders contain would be one of rounding.
TEST(Orders, OfWhatDoesNotVibrateContainNothing) {
  const Scene scene = scene_from(Shaken::text());
  const auto json = nlohmann::json::parse(output_of(steady(scene, {scene.effects}, {})).json());
  int still = 0;
  for (const auto& of : json.at("cycles").at(0).at("orders")) {
    EXPECT_EQ(of.at("captured_of_amplitude").is_null(), of.at("orders").empty()) << of.at("name");
    still += of.at("orders").empty() ? 1 : 0;
  }
  EXPECT_GE(still, 1);
}

// Σ ½ a² is the mean square less the mean's; at a constant speed of the link means over angle and time are the same.
TEST(Orders, ConserveTheMeanSquare) {
  const Scene scene = scene_from(Shaken::text());
  const SteadyCycle c = cycle_of(scene, scene.effects);
  const OrdersOf& torque = orders_of(c, "torque.coupling");
  EXPECT_NEAR(torque.captured(torque.reporting()), 1, 1e-9);
  EXPECT_NEAR(std::sqrt(torque.mean_square), c.find("cycle_rms_torque.coupling")->value, 1e-8 * torque.mean_square);
  double sum = torque.mean * torque.mean;
  for (const Order& o : torque.orders) sum += 0.5 * std::norm(o.wave);
  EXPECT_NEAR(sum, torque.mean_square, 1e-9 * torque.mean_square);
}

TEST(Orders, OfAFourStrokeCycleComeInHalves) {
  const Scene scene = scene_file("tests/agreement/indicator_diagram.toml");
  const SteadyCycle c = cycle_of(scene, scene.effects);
  for (const char* channel : {"torque.coupling", "speed.crank", "speed.fan"}) {
    const OrdersOf& of = orders_of(c, channel);
    ASSERT_GE(of.reporting().size(), 3u) << channel;
    for (std::size_t n = 0; n < of.orders.size(); ++n) EXPECT_EQ(of.orders[n].order, 0.5 * static_cast<double>(n + 1));
    EXPECT_EQ(of.reporting().front().order, 0.5) << channel;
    EXPECT_NEAR(of.captured(of.orders), 1, 1e-4) << channel;  // what is above the 24th order
  }
  for (const char* name : {"torque_order.0.5.coupling", "torque_order.1.coupling", "torque_order.1.5.coupling",
                           "speed_order.0.5.crank", "torque_order_phase.0.5.coupling"}) {
    const Figure* f = c.find(name);
    ASSERT_TRUE(f) << name;
    EXPECT_TRUE(f->error) << name;
    ASSERT_TRUE(definition_of(f->name)) << name;
    EXPECT_EQ(definition_of(f->name), definition_of(f->what)) << name;
    EXPECT_EQ(definition_of(f->name)->unit, f->unit) << name;
  }
}

// Greatest where r φ = ψ, whichever way the link turns: the load 10 (1 + cos(2φ − 0.7 rad)) behind a rigid coupling.
TEST(Orders, PhasesCountFromTheLinksZeroInEitherSense) {
  for (const char* speed : {"20 rad/s", "-20 rad/s"}) {
    const Scene scene = scene_from(fmt::format(
        R"scene(line = ["drive", "coupling", "mixer"]
drive = {{ kind = "prescribed speed", speed = "{}" }}
coupling = {{ kind = "coupling", stiffness = "1 kN*m/rad" }}
mixer = {{ kind = "torque source", inertia = "0.1 kg*m2", table = {{ over = "angle", formula = "10 [N*m] * (1 + cos(2*phi - 0.7 [rad]))" }} }}
run = {{ start = {{ angle = "33 deg" }}, until = "1 s" }}
)scene",
        speed));
    const SteadyCycle c = cycle_of(scene, Effects{});
    const OrdersOf& of = orders_of(c, "torque.coupling");
    ASSERT_EQ(of.reporting().size(), 1u) << speed;
    EXPECT_NEAR(of.mean, -10, 1e-9);
    const Order order = of.reporting().front();
    EXPECT_EQ(order.order, 2);
    EXPECT_NEAR(std::abs(order.wave), 10, 1e-9);
    ASSERT_TRUE(order.phase());
    EXPECT_NEAR(order.phase()->value, 0.7 - pi, 1e-9) << speed;  // of −10 cos(2φ − 0.7)
  }
}

// A wheel with a drag b to which nothing gives a mean speed, shaken at Ω and 2Ω: ω_n = A/(b + i nΩ J), φ_n = ω_n/(i nΩ).
TEST(Orders, OfAnAngleAreThoseOfItsSpeedEachOverItsOwnFrequency) {
  const Scene scene = scene_from(R"(line = ["wheel", "drag"]
wheel = { kind = "torque source", inertia = "0.4 kg*m2", amplitude = "5 N*m", frequency = "4 Hz" }
shake = { kind = "torque source", on = "wheel", amplitude = "3 N*m", frequency = "8 Hz" }
drag = { kind = "load", damping = "2 N*m*s/rad" }
run = { until = "1 s" }
)");
  const SteadyCycle c = cycle_of(scene, Effects{});
  const OrdersOf &speed = orders_of(c, "speed.wheel"), &angle = orders_of(c, "angle.wheel");
  ASSERT_GE(angle.orders.size(), 2u);
  for (const int n : {1, 2}) {
    const double frequency = 8 * pi * n, swing = (n == 1 ? 5 : 3) / std::hypot(2, frequency * 0.4);
    const auto k = static_cast<std::size_t>(n - 1);
    ASSERT_EQ(angle.orders[k].order, n);
    EXPECT_NEAR(std::abs(speed.orders[k].wave), swing, 1e-8 * swing) << n;
    EXPECT_NEAR(std::abs(angle.orders[k].wave), swing / frequency, 1e-8 * swing / frequency) << n;
    EXPECT_NEAR(std::abs(angle.orders[k].wave * Complex(0, frequency) - speed.orders[k].wave), 0, 1e-8 * swing) << n;
  }
}

TEST(Orders, WithoutAnAngleThereAreNone) {
  const Scene scene = scene_from(R"(line = ["motor", "wheel"]
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", rated_torque = "20 N*m", inertia = "0.5 kg*m2" }
wheel = { kind = "torque source", inertia = "0.4 kg*m2", torque = "-5 N*m", amplitude = "3 N*m", frequency = "4 Hz" }
run = { until = "1 s" }
)");
  const SteadyCycle c = cycle_of(scene, Effects{});
  EXPECT_TRUE(c.orders.empty());
  ASSERT_FALSE(c.notes.empty());
  EXPECT_NE(c.notes.front().find("no orders: "), std::string::npos) << c.notes.front();
}

TEST(Orders, AreFiguresOfASweepInEveryRow) {
  MachineQuestion question;
  question.text = Shaken::text(), question.file = "shaken.toml", question.of = SweepStudy::steady;
  const std::vector<SweptFigure> known = figures_of(question);
  const std::vector<SweptFigure> asked =
      chosen(known, {"torque_order.3.coupling", "torque_order_phase.2.coupling", "torque_order_phase.3.coupling"});
  ASSERT_EQ(asked.size(), 3u);
  EXPECT_GT(chosen(known, {"torque_order"}).size(), 3u);  // of all torques
  EXPECT_EQ(asked.front().name, "torque_order.3.coupling");
  // With a hundredth of the third order it no longer matters beside the second; the row has it all the same.
  question.settings = {"shake.amplitude=0.1 N*m"};
  const VariedScene scene(question, {});
  SweepRow row;
  ASSERT_TRUE(machine_evaluator(question, scene, asked)(row));
  ASSERT_EQ(row.figures.size(), 3u);
  EXPECT_NEAR(row.figures.front().value, std::abs(Shaken::wave_of_torque(Shaken::torques[1])) / 200, 1e-7);
}

}  // namespace
}  // namespace kurbel::test::orders_test
