// shared_holds_test.cpp — a brake and a gear with losses that hold together: they let go together, where both are at their
// limits, however the load came there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/scenes.h"

namespace kurbel::shared_holds_test {
namespace {

struct Machine {
  double brake = 20, ratio = 30, efficiency = 0.8;
  std::string load = {}, drive = {};  // torques on the drum and on the motor, over time
  std::string effects = "";           // those that are on beside the losses
  std::string coupling = "2 kN*m/rad";
};

std::string over_time(double from, double to) {
  return fmt::format("table = {{ over = \"time\", unit = [\"s\", \"N*m\"], points = [[0, {}], [10, {}]] }}", from, to);
}

std::string text_of(const Machine& m) {
  return fmt::format(R"(
    line = ["motor", "coupling", "gearbox", "drum"]
    motor = {{ kind = "inertia", inertia = "0.05 kg*m2" }}
    brake = {{ kind = "brake", on = "motor", torque = "{} N*m", static_torque = "{} N*m" }}
    coupling = {{ kind = "coupling", stiffness = "{}", damping_ratio = 0.1 }}
    gearbox = {{ kind = "gearbox", stages = [{{ teeth = [100, {}] }}], efficiency = {} }}
    drum = {{ kind = "inertia", inertia = "3 kg*m2" }}
    load = {{ kind = "torque source", on = "drum", {} }}
    drive = {{ kind = "torque source", on = "motor", {} }}
    effects = {{ gear_losses = true{} }}
    run = {{ start = "rest", until = "10 s" }}
  )",
                     0.7 * m.brake, m.brake, m.coupling, std::lround(100 * m.ratio), m.efficiency, m.load, m.drive,
                     m.effects);
}

// Times at which the contacts with these names begin to move in this direction.
std::vector<double> releases(const Result& r, const std::string& component, const std::string& what) {
  std::vector<double> times;
  for (const Event& e : r.events)
    if (e.component == component && e.kind == EventKind::motion) {
      EXPECT_EQ(e.what, what);
      times.push_back(e.t);
    }
  return times;
}

// Both let go at this time, once, and in this direction.
void expect_release(const Result& r, double t, bool forwards) {
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const std::string what = forwards ? "moves forwards" : "moves backwards";
  for (const char* component : {"motor", "gearbox"}) {
    const std::vector<double> times = releases(r, component, what);
    ASSERT_EQ(times.size(), 1u) << component;
    EXPECT_NEAR(times[0], t, 1e-9 * t) << component;
  }
}

bool moves(const Result& r) {
  for (const Event& e : r.events)
    if (e.kind == EventKind::motion) return true;
  return false;
}

// The load that grows drives backwards through the gear, λ = η W/i: the brake's 20 N·m hold W = 750 N·m.
TEST(SharedHolds, ALoadThatGrowsIsHeldAsOneThatActsFromTheStart) {
  EXPECT_FALSE(moves(test::run(text_of({.load = over_time(0, -740), .drive = over_time(0, 0)}), false)));
  EXPECT_FALSE(moves(test::run(text_of({.load = over_time(-740, -740), .drive = over_time(0, 0)}), false)));
  expect_release(test::run(text_of({.load = over_time(0, -1000), .drive = over_time(0, 0)}), false), 7.5, false);
}

// Random hoists whose load, or what drives them, changes slowly: backwards where brake and losses are used up,
// i (H + M) = η W, forwards at M = H + W/(i η). With a spring before the gear a load that grows is held just below that, and not above.
TEST(SharedHolds, RandomHoistsLetGoAtTheSumOfWhatHolds) {
  std::mt19937 random(20261129);
  const auto some = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int n = 0; n < 40; ++n) {
    SCOPED_TRACE(n);
    Machine m{.brake = some(5, 50), .ratio = std::round(100 * some(1.5, 9)) / 100, .efficiency = some(0.55, 0.97)};
    const double t = some(2, 9), part = some(0.1, 0.9), side = some(0, 1) < 0.5 ? -1 : 1;
    const int kind = n % 3;
    double load = 0, drive = 0;  // at the release
    std::string *changing = &m.load, *kept = &m.drive;
    double changes = 0, keeps = 0;
    if (kind == 0) {  // the load grows
      load = m.brake * m.ratio / m.efficiency, changes = load, keeps = 0;
    } else {  // a weight, and a drive that grows downwards or upwards
      load = part * m.brake * m.ratio / m.efficiency;
      drive = kind == 1 ? m.efficiency * load / m.ratio - m.brake : m.brake + load / (m.ratio * m.efficiency);
      changing = &m.drive, kept = &m.load, changes = drive, keeps = -load;
    }
    const double sign = kind == 0 ? -side : side;
    *changing = over_time(0, sign * changes * 10 / t), *kept = over_time(side * keeps, side * keeps);
    expect_release(test::run(text_of(m), false), t, (kind == 2) == (side > 0));
    // With a load that grows until 1 % below and above, and a spring.
    if (kind != 0) continue;
    for (const double level : {0.99, 1.01}) {
      Machine elastic = m;
      elastic.effects = ", elasticity = true";
      elastic.load = over_time(0, sign * changes * level);
      const Result r = test::run(text_of(elastic), false);
      EXPECT_EQ(releases(r, "motor", side < 0 ? "moves forwards" : "moves backwards").empty(), level < 1);
    }
  }
}

// A screw jack under a load that grows: k F η₂ = 10 N·m with k = P/2π, η₂ = tan(α − ρ)/tan α with ρ of a trapezoidal thread.
TEST(SharedHolds, AScrewJackLetsGoWhereItsBrakeDoes) {
  const Result r = test::run(R"(
    line = ["motor", "jack"]
    motor = { kind = "inertia", inertia = "0.01 kg*m2" }
    brake = { kind = "brake", on = "motor", torque = "2 N*m", static_torque = "10 N*m" }
    jack = { kind = "screw", lead = "20 mm", mean_diameter = "40 mm", friction_coefficient = 0.08, mass = "100 kg", inclination = "90 deg", table = { over = "time", unit = ["s", "N"], points = [[0, 0], [10, 10000]] } }
    run = { start = "rest", until = "7 s" }
  )",
                             false);
  const double lead = std::atan(0.02 / (std::numbers::pi * 0.04)),
               friction = std::atan(0.08 / std::cos(std::numbers::pi / 12));
  const double force = 10 * 2 * std::numbers::pi / 0.02 * std::tan(lead) / std::tan(lead - friction);
  const std::vector<double> motor = releases(r, "motor", "moves backwards");
  ASSERT_EQ(motor.size(), 1u);
  EXPECT_NEAR(motor[0], (force - 100 * 9.80665) / 1000, 1e-8);
}

// A self-locking worm and a brake hold any load that grows; nothing moves, and no event says so.
TEST(SharedHolds, ABrakeBesideASelfLockingWormHoldsAnyLoad) {
  const Result r = test::run(R"(
    line = ["motor", "worm", "drum"]
    motor = { kind = "inertia", inertia = "0.01 kg*m2" }
    brake = { kind = "brake", on = "motor", torque = "1 N*m", static_torque = "1.5 N*m" }
    worm = { kind = "worm gear", starts = 1, teeth = 40, lead_angle = "4.6 deg", friction_coefficient = 0.12 }
    drum = { kind = "torque source", inertia = "3 kg*m2", table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [10, -600], [20, 600]] } }
    run = { start = "rest", until = "20 s" }
  )",
                             false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_TRUE(r.events.empty()) << r.events.front().what;
}

// 690 N·m at the drum and 20 N·m of brake: 20 − 0.8 · 690/30 = 1.6 N·m more downwards, 20 + 690/(0.8 · 30) upwards.
TEST(SharedHolds, WhatIsMissingIsThatOfAllThatHold) {
  const Result r = test::run(text_of({.load = over_time(-690, -690), .drive = over_time(0, 0)}), false);
  int found = 0;
  for (const std::string& note : r.notes)
    if (note.find("is held at the end") != std::string::npos) {
      ++found;
      EXPECT_NE(note.find("48.75 N·m more would move it"), std::string::npos) << note;
      EXPECT_NE(note.find(" 1.6 N·m more would move it"), std::string::npos) << note;
    }
  EXPECT_EQ(found, 2);
}

}  // namespace
}  // namespace kurbel::shared_holds_test
