// contacts_backwards_test.cpp — contacts that hold, creep and let go backwards, behind gears, many at once, and where
// more of them hold than are needed; with the reactions and squares reported of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/equations/constraints.h"
#include "tests/published/published.h"
#include "tests/support/elements.h"
#include "tests/support/jacobians.h"

namespace kurbel::contacts_backwards_test {
namespace {

using test::figure;
using test::run;
using test::scene_from;
using test::series;

std::string body(const std::string& name, double inertia) {
  return fmt::format("{} = {{ kind = \"inertia\", inertia = \"{} kg*m2\" }}\n", name, inertia);
}
std::string source(const std::string& name, const std::string& on, double torque) {
  return fmt::format("{} = {{ kind = \"torque source\", on = \"{}\", torque = \"{} N*m\" }}\n", name, on, torque);
}
std::string brake(const std::string& name, const std::string& on, double torque) {
  return fmt::format("{} = {{ kind = \"brake\", on = \"{}\", torque = \"{} N*m\" }}\n", name, on, torque);
}

// ∂α/∂M is what solve() does, also where rows with losses say the same twice, so that what is shared accelerates.
TEST(Constraints, MobilityWithLossesAndARepeatingRowIsTheDerivativeOfTheAccelerations) {
  Constraints constraints(3);
  constraints.set({{{{0, 1}, {1, -2}}, {{0, -1}, {1, 1.4}}, 3},
                   {{{1, 1}, {2, -0.5}}, {{1, -1}, {2, 0.5}}, 2},
                   {{{0, 1}, {2, -1}}, {{0, -1}, {2, 0.8}}, 1.5}});
  const std::vector<double> inertia = {0.3, 0.7, 0.2};
  const std::vector<int> shafts = {0, 1, 2};
  const std::vector<double> w = constraints.mobility(inertia, shafts);
  for (int k = 0; k < 3; ++k) {
    std::vector<double> torque(3, 0.0), alpha(3), multiplier(3);
    torque[static_cast<std::size_t>(k)] = 1;
    constraints.solve(inertia, torque, alpha, multiplier);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(w[static_cast<std::size_t>(3 * i + k)], alpha[static_cast<std::size_t>(i)], 1e-13);
    EXPECT_GT(std::abs(alpha[0]), 0.01);
  }
}

// Pushed backwards a one-way clutch between two brakes holds its drag and no more: of all torques that hold the machine
// those of least Σ λ²/capacity, A/30 = B (1/10 + 1/20) with A + B = 24.
TEST(ContactsBackwards, AOneWayClutchSharesByItsDrag) {
  const Result r =
      run("line = [\"a\", \"wheel\", \"b\"]\n" + body("a", 0.3) + body("b", 0.9) +
              "wheel = { kind = \"one-way clutch\", drag = \"10 N*m\" }\n" + brake("brake1", "a", 30) +
              brake("brake2", "b", 20) + source("push", "a", -24) + "run = { until = \"0.1 s\", samples = 2 }\n",
          false);
  EXPECT_NEAR(series(r, "torque.wheel").back(), -24 / (1 + 30 * (1.0 / 10 + 1.0 / 20)), 1e-9);
  EXPECT_EQ(figure(r, "final_speed.a"), 0);
}

// Pushed forwards it goes with whatever comes: brakes of static 40 and 20 N·m to either side of it hold 60 N·m
// together, in proportion, A/40 = B/20; with a drag and without, and mirrored. Beyond they slip.
TEST(ContactsBackwards, AOneWayClutchPassesOnWhatTheBrakesBehindItCanHold) {
  for (const char* drag : {"", "drag = \"10 N*m\", "})
    for (const double push : {39.0, 41.0, 50.0, 59.9, 60.1}) {
      const Result r =
          run(fmt::format("line = [\"a\", \"wheel\", \"b\"]\n{}{}wheel = {{ {}kind = \"one-way clutch\" }}\n{}{}{}",
                          body("a", 0.3), body("b", 0.9), drag, brake("brake1", "a", 40), brake("brake2", "b", 20),
                          source("push", "a", push)) +
                  "run = { until = \"0.1 s\", samples = 2 }\n",
              false);
      if (push < 60) {
        EXPECT_EQ(figure(r, "final_speed.b"), 0) << push;
        EXPECT_NEAR(series(r, "torque.wheel").back(), push / 3, 5e-4 * push / 3) << drag;
      } else {
        EXPECT_NEAR(figure(r, "final_speed.b"), 0.1 * (push - 60) / 1.2, 1e-9) << drag;
      }
    }
}

// Nine drums, each braked with 10 N·m and pushed with ±(12 … 20) N·m; what joins them is not yet twisted. More contacts
// than are enumerated: each is let go the way it is pushed.
TEST(ContactsBackwards, ManyOverloadedAtOnceAreLetGoTheirOwnWay) {
  for (const double sense : {1.0, -1.0}) {
    std::string line = "line = [", text;
    constexpr int drums = 9;
    for (int k = 0; k < drums; ++k) {
      const std::string name = fmt::format("d{}", k);
      line += fmt::format("{}\"{}\"{}", k ? ", " : "", name, k + 1 < drums ? fmt::format(", \"c{}\"", k) : "");
      text += body(name, 0.5) + brake("b" + name, name, 10) + source("p" + name, name, sense * (12 + k));
      if (k + 1 < drums) text += fmt::format("c{} = {{ kind = \"coupling\", stiffness = \"50 N*m/rad\" }}\n", k);
    }
    const Scene scene =
        scene_from(line + "]\n" + text + "effects = { elasticity = true }\nrun = { until = \"1 s\" }\n");
    Equations equations(compile(scene, scene.effects), false);
    const std::vector<double> y = equations.start(0);
    std::vector<double> rate(y.size());
    equations.flow(0, y, rate);
    for (int k = 0; k < drums; ++k) EXPECT_NEAR(rate[equations.speed_index(k)], sense * (2 + k) / 0.5, 1e-9);
  }
}

// A drum that is set moving as prescribed is braked from the first instant on.
TEST(ContactsBackwards, APrescribedStartIsBrakedAtOnceEitherWay) {
  for (const double speed : {5.0, -5.0}) {
    const Result r =
        run(fmt::format("line = [\"drive\", \"c\", \"drum\"]\ndrive = {{ kind = \"prescribed speed\", speed "
                        "= \"{} rad/s\", ramp = \"2 s\" }}\nc = {{ kind = \"coupling\", stiffness = \"1 "
                        "kN*m/rad\" }}\n",
                        speed) +
                body("drum", 0.8) + brake("shoe", "drum", 30) +
                "run = { until = \"1 s\", samples = 11, accuracy = 1e-9 }\n",
            false);
    for (const double torque : series(r, "torque.c"))
      EXPECT_NEAR(torque, 0.8 * speed / 2 + std::copysign(30, speed), 1e-9);
    EXPECT_NEAR(r.energy.by_account.at("shoe"), -30 * 5 * 0.25, 1e-7);
  }
}

// Without events a contact creeps: its Jacobian is exact also where the shafts on either side turn at ratios.
TEST(ContactsBackwards, JacobianOfACreepingClutchBehindGearsEqualsDifferences) {
  const Scene scene =
      scene_from("line = [\"a\", \"first\", \"clutch\", \"second\", \"b\"]\n" + body("a", 0.4) +
                 "first = { kind = \"gearbox\", stages = [{ teeth = [20, 50] }] }\nsecond = { kind = "
                 "\"gearbox\", stages = [{ teeth = [30, 45] }] }\nclutch = { kind = \"clutch\", torque = "
                 "\"40 N*m\" }\n" +
                 "b = { kind = \"prescribed speed\", speed = \"2 rad/s\", inertia = \"1 kg*m2\" }\n"
                 "run = { until = \"1 s\", start = { speed = \"7.5 rad/s\", on = \"a\" } }\n");
  const Scene both =
      scene_from("line = [\"a\", \"first\", \"clutch\", \"second\", \"crank\"]\n" + body("a", 0.4) +
                 "first = { kind = \"gearbox\", stages = [{ teeth = [20, 50] }] }\nsecond = { kind = "
                 "\"gearbox\", stages = [{ teeth = [30, 45] }] }\nclutch = { kind = \"clutch\", torque = "
                 "\"40 N*m\" }\ncrank = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", "
                 "crank_inertia = \"0.9 kg*m2\" }\nrun = { until = \"1 s\", start = { speed = \"2 rad/s\" } }\n");
  for (const Scene& s : {scene, both})
    for (const double slip : {0.4, -0.7}) {
      Equations equations(compile(s, s.effects), false);
      std::vector<double> y = equations.start(0), g(equations.guard_count());
      ASSERT_FALSE(equations.regularise({0}).empty());
      const Model& m = equations.model();
      const double creep =
          1e-4 * std::abs(m.elastic[0].gain_a) * m.shafts[static_cast<std::size_t>(m.elastic[0].shaft_a)].speed_scale;
      y[equations.speed_index(m.elastic[0].shaft_a)] += slip * creep / m.elastic[0].gain_a;
      const test::Slopes slopes = test::slopes_of(equations, 0, y, std::vector<double>(y.size(), 1e-4 * creep));
      for (std::size_t shaft = 0; shaft < m.free_shafts; ++shaft)
        for (std::size_t other = 0; other < m.free_shafts; ++other) {
          const std::size_t column = equations.speed_index(static_cast<int>(shaft)),
                            row = equations.speed_index(static_cast<int>(other));
          const double difference = slopes.difference_at(row, column);
          EXPECT_GT(std::abs(difference), 1);
          EXPECT_NEAR(slopes.exact_at(row, column), difference, 1e-5 * std::abs(difference));
        }
    }
}

// Where all torques balance, what crept moves on at the speed and in the sense in which it left its creep.
TEST(ContactsBackwards, WithoutEventsInBalanceItMovesOnAsItGoes) {
  for (const double sense : {1.0, -1.0}) {
    const Scene scene = scene_from("line = [\"a\"]\n" + body("a", 2) + brake("shoe", "a", 30) +
                                   source("push", "a", sense * 30) + "run = { until = \"2 s\" }\n");
    Equations equations(compile(scene, scene.effects), false);
    std::vector<double> y = equations.start(0), g(equations.guard_count()), rate(y.size());
    equations.regularise({0});
    y[equations.speed_index(0)] = sense * 2.1e-3 * equations.model().shafts[0].speed_scale;
    std::vector<Event> log;
    equations.fire(0, y, {0}, log);
    ASSERT_EQ(log.size(), 1u);
    EXPECT_EQ(log[0].what, sense > 0 ? "moves forwards" : "moves backwards");
    equations.guards(0, y, g);
    EXPECT_NEAR(g[0], 2.1e-3, 1e-9);
    equations.flow(0, y, rate);
    EXPECT_NEAR(rate[equations.speed_index(0)], 0, 1e-12);
  }
}

// --- reactions and squares -------------------------------------------------------------------------------------------

// With its sun held: M_ring of the input, (z_s + z_r)/z_r of it at the carrier, and the sun carries the difference.
TEST(Reactions, AHeldSunCarriesTheDifferenceOfRingAndCarrier) {
  const Result r = run(R"(
line = ["drive", "gear", "fan"]
drive = { kind = "torque source", torque = "8 N*m", inertia = "0.1 kg*m2" }
gear = { kind = "planetary gear", sun = 24, ring = 74, in = "ring", out = "carrier", fixed = "sun" }
fan = { kind = "load", damping = "2 N*m*s/rad", inertia = "0.05 kg*m2" }
run = { until = "5 s", samples = 3, accuracy = 1e-9 }
)",
                       false);
  const double out = 8 * 98.0 / 74;
  EXPECT_NEAR(figure(r, "final_speed.fan"), out / 2, 1e-7);
  EXPECT_NEAR(series(r, "torque.gear.ring").back(), 8, 1e-6);
  EXPECT_NEAR(series(r, "torque.gear.carrier").back(), out, 1e-6);
  EXPECT_NEAR(series(r, "torque.gear.sun").back(), 8 - out, 1e-6);
}

// θ̇ = a sin ωt between two given motions: rms of k θ alone, and of k θ + c θ̇, over half a period.
TEST(Squares, RmsOfTheSpringTorqueLeavesTheDamperOut) {
  const Result r = run(R"(
line = ["drive", "c", "frame"]
drive = { kind = "prescribed speed", speed = "10 rad/s", amplitude = "3 rad/s", frequency = "4 Hz", inertia = "0.5 kg*m2" }
frame = { kind = "prescribed speed", speed = "10 rad/s" }
c = { kind = "coupling", stiffness = "700 N*m/rad", damping = "20 N*m*s/rad" }
effects = { elasticity = true }
run = { until = "0.125 s", accuracy = 1e-9, start = { speed = "10 rad/s" } }
)",
                       false);
  const double omega = 8 * std::numbers::pi, k = 700 * 3 / omega, c = 20 * 3.0;
  EXPECT_NEAR(figure(r, "rms_spring_torque.c"), k * std::sqrt(1.5), 1e-6);
  // (k (1 − cos) + c sin)² over half a turn: 3/2 k² + ½ c² + 2 k c · 2/π
  EXPECT_NEAR(figure(r, "rms_torque.c"), std::sqrt(1.5 * k * k + 0.5 * c * c + 4 * k * c / std::numbers::pi), 1e-6);
}

}  // namespace
}  // namespace kurbel::contacts_backwards_test
