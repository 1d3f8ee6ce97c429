// contacts_test.cpp — what sticks and what slips: tied shafts, breakaway, sets of modes, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/equations/constraints.h"
#include "engine/events/equations.h"
#include "engine/model/model.h"
#include "tests/support/jacobians.h"
#include "tests/support/scenes.h"
#include "tests/support/validation.h"

namespace kurbel::contacts_test {
namespace {

using test::Against;
using test::figure;
using test::Validation;

double some(double low, double high) {
  static std::mt19937 random(20261121);
  return std::uniform_real_distribution<double>(low, high)(random);
}

std::vector<Event> of(const Result& result, const std::string& component) {
  std::vector<Event> own;
  for (const Event& e : result.events)
    if (e.component == component) own.push_back(e);
  return own;
}

// --- constraints -----------------------------------------------------------------------------------------------------

// Two shafts tied with a ratio move as one inertia J₁ + J₂ i²; the tie carries what the second one lacks.
TEST(Constraints, TiedShaftsMoveAsOneInertia) {
  for (int n = 0; n < 200; ++n) {
    const double j1 = some(0.01, 10), j2 = some(0.01, 10), i = some(0.1, 8), m1 = some(-50, 50), m2 = some(-50, 50);
    Constraints constraints(2);
    constraints.set({{{{0, 1}, {1, -i}}, {{0, -1}, {1, i}}, 1}});
    const std::vector<double> inertia = {j1, j2}, torque = {m1, m2};
    std::vector<double> alpha(2), multiplier(1);
    constraints.solve(inertia, torque, alpha, multiplier);
    const double expected = (m1 + m2 / i) / (j1 + j2 / (i * i));
    const double scale = (std::abs(m1) + std::abs(m2) / i) / (j1 + j2 / (i * i));
    EXPECT_NEAR(alpha[0], expected, 1e-12 * scale);
    EXPECT_NEAR(alpha[0], i * alpha[1], 1e-12 * scale);
    EXPECT_NEAR(multiplier[0], m1 - j1 * expected, 1e-10 * (std::abs(m1) + j1 * scale));
  }
}

// Two brakes hold one coordinate, on either side of a locked clutch: each carries its share in proportion to capacity.
TEST(Constraints, RowsThatSayTheSameShareInProportionToCapacity) {
  for (int n = 0; n < 100; ++n) {
    const double m1 = some(-50, 50), m2 = some(-50, 50), c1 = some(1, 100), c2 = some(1, 100);
    Constraints constraints(2);
    constraints.set(
        {{{{0, 1}}, {{0, -1}}, c1}, {{{1, 1}}, {{1, -1}}, c2}, {{{0, 1}, {1, -1}}, {{0, -1}, {1, 1}}, 1e9}});
    const std::vector<double> inertia = {some(0.1, 2), some(0.1, 2)}, torque = {m1, m2};
    std::vector<double> alpha(2), multiplier(3);
    constraints.solve(inertia, torque, alpha, multiplier);
    EXPECT_NEAR(alpha[0], 0, 1e-9);
    EXPECT_NEAR(alpha[1], 0, 1e-9);
    EXPECT_NEAR(multiplier[0] / multiplier[1], c1 / c2, 1e-5 * c1 / c2);
    EXPECT_NEAR(multiplier[0] + multiplier[1], m1 + m2, 1e-9 * 100);
  }
}

// ∂α/∂M is what solve() does.
TEST(Constraints, MobilityIsTheDerivativeOfTheAccelerations) {
  Constraints constraints(3);
  constraints.set({{{{0, 1}, {1, -2}, {2, 0.5}}, {{0, -1}, {1, 1.4}, {2, -0.5}}, 1}, {{{2, 1}}, {{2, -1}}, 1}});
  const std::vector<double> inertia = {0.3, 0.7, 0.2};
  const std::vector<int> shafts = {0, 1, 2};
  const std::vector<double> w = constraints.mobility(inertia, shafts);
  for (int k = 0; k < 3; ++k) {
    std::vector<double> torque(3, 0.0), alpha(3), multiplier(2);
    torque[static_cast<std::size_t>(k)] = 1;
    constraints.solve(inertia, torque, alpha, multiplier);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(w[static_cast<std::size_t>(3 * i + k)], alpha[static_cast<std::size_t>(i)], 1e-13);
  }
}

// --- clutches --------------------------------------------------------------------------------------------------------

// Two flywheels, a clutch of constant torque: t = J Δω/M with J = J₁J₂/(J₁ + J₂), heat ½ J Δω², common speed by
// momentum (Dubbel, G3).
TEST(Clutch, EngagesInTheTimeAndWithTheHeatOfTheClosedForm) {
  for (const double m : {5.0, 40.0, 300.0}) {
    const double j1 = 1.7, j2 = 0.6, w1 = 120, w2 = -30, j = j1 * j2 / (j1 + j2);
    const Result r = test::run(fmt::format(R"(
      line = ["a", "clutch", "b"]
      a = {{ kind = "inertia", inertia = "1.7 kg*m2" }}
      b = {{ kind = "inertia", inertia = "0.6 kg*m2" }}
      clutch = {{ kind = "clutch", torque = "{} N*m" }}
      run = {{ until = "20 s", accuracy = 1e-9, start = {{ a = {{ speed = "120 rad/s" }}, b = {{ speed = "-30 rad/s" }} }} }}
    )",
                                           m));
    const auto events = of(r, "clutch");
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].what, "locks");
    EXPECT_EQ(events[0].from, "slipping forwards");
    EXPECT_NEAR(events[0].t, j * (w1 - w2) / m, 1e-12 * events[0].t);
    EXPECT_NEAR(figure(r, "slip_heat.clutch"), 0.5 * j * (w1 - w2) * (w1 - w2), 1e-6);
    EXPECT_NEAR(figure(r, "final_speed.a"), (j1 * w1 + j2 * w2) / (j1 + j2), 1e-10);
    EXPECT_EQ(figure(r, "final_speed.a"), figure(r, "final_speed.b"));
  }
}

// A torque that grows with time breaks a locked clutch where M J₂/(J₁ + J₂) reaches the static limit; from there the
// kinetic torque acts.
TEST(Clutch, BreaksAwayAtTheStaticLimit) {
  const Result r = test::run(R"(
    line = ["a", "clutch", "b"]
    a = { kind = "inertia", inertia = "2 kg*m2" }
    b = { kind = "inertia", inertia = "3 kg*m2" }
    clutch = { kind = "clutch", torque = "20 N*m", static_torque = "30 N*m" }
    drive = { kind = "torque source", on = "a", torque = "100 N*m", ramp = "10 s" }
    run = { until = "8 s", accuracy = 1e-9 }
  )");
  const auto events = of(r, "clutch");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].what, "slips forwards");
  EXPECT_NEAR(events[0].t, 5, 1e-11);  // 10 t · 3/5 = 30
  const double w = 10 * 25 / 2.0 / 5;  // both turn as 5 kg m² up to there
  EXPECT_NEAR(figure(r, "final_speed.b"), w + 20.0 / 3 * 3, 1e-9);
  EXPECT_NEAR(figure(r, "final_speed.a"), w + (10 * (64 - 25) / 2.0 - 20 * 3) / 2, 1e-9);
}

// Published: six switch times of a dry clutch and a brake under a harmonic torque (tests/cases/torsional.toml,
// stick_slip_clutch_brake); static and sliding friction equal.
TEST(Clutch, SwitchTimesOfThePublishedClutchAndBrake) {
  const Validation is(Against::published,
                      "Dry clutch and brake under a harmonic torque, published switch times (case torsional)");
  const Result r = test::run(R"(
    line = ["j3", "clutch", "j2", "spring", "j1", "brake"]
    j3 = { kind = "inertia", inertia = "1 kg*m2" }
    drive = { kind = "torque source", on = "j3", amplitude = "200 N*m", frequency = "15.915494309189533 Hz", stop = "0.5 s" }
    clutch = { kind = "clutch", torque = "80 N*m" }
    j2 = { kind = "inertia", inertia = "0.05 kg*m2" }
    spring = { kind = "coupling", stiffness = "160 N*m/rad", damping = "1 N*m*s/rad" }
    j1 = { kind = "inertia", inertia = "1 kg*m2" }
    brake = { kind = "brake", torque = "800 N*m", start = "0.5 s" }
    effects = { elasticity = true }
    [run]
    until = "3 s"
    accuracy = 1e-9
    start = { j3 = { speed = "100 rad/s" }, j2 = { speed = "90 rad/s" }, j1 = { speed = "90 rad/s" } }
  )");
  std::vector<double> times;
  for (const Event& e : r.events)
    if (e.component != "drive" && e.component != "brake") times.push_back(e.t);
  ASSERT_EQ(times.size(), 6u);
  const double published[] = {0.0067797089, 0.0593392840, 0.1092898268, 0.5342483362, 0.6406139411, 1.6636414588};
  for (std::size_t k = 0; k < 6; ++k) is.near(fmt::format("switch {}", k + 1), "s", times[k], published[k], 1e-6);
  is.near("speed of the first inertia at 3 s", "rad/s", 1, r.find("final_speed.j3"), 2.289871029, 1e-6);
  EXPECT_EQ(figure(r, "final_speed.j1"), 0.0);
}

// The driven side runs ahead while the driving side slows down, and is caught again: J₁ sinusoidal, J₂ braked by b ω.
TEST(OneWayClutch, DrivesForwardsOnly) {
  const Result r = test::run(R"(
    line = ["a", "freewheel", "b"]
    a = { kind = "inertia", inertia = "1 kg*m2" }
    b = { kind = "inertia", inertia = "2 kg*m2" }
    freewheel = { kind = "one-way clutch" }
    drive = { kind = "torque source", on = "a", amplitude = "60 N*m", frequency = "1 Hz" }
    drag = { kind = "bearing drag", on = "b", damping = "0.5 N*m*s/rad" }
    run = { until = "1.9 s", accuracy = 1e-9 }
  )");
  // Tied: 3 ω̇ + ω/2 = 60 sin 2πt from rest; released where the torque in the clutch, 2 ω̇ + ω/2, has fallen to 0.
  const auto tied = [](double t) {
    const double a = 1.0 / 6, b = 2 * M_PI, m = 20 / (a * a + b * b);
    return m * (a * std::sin(b * t) - b * std::cos(b * t) + b * std::exp(-a * t));
  };
  const auto torque = [&](double t) {
    const double w = tied(t), alpha = (60 * std::sin(2 * M_PI * t) - 0.5 * w) / 3;
    return 2 * alpha + 0.5 * w;
  };
  double low = 0.3, high = 0.9;
  for (int i = 0; i < 200; ++i) (torque(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  const auto events = of(r, "freewheel");
  ASSERT_GE(events.size(), 2u);
  EXPECT_EQ(events[0].what, "slips backwards");
  EXPECT_NEAR(events[0].t, low, 1e-9);
  EXPECT_EQ(events[1].what, "locks");
  // Free: b decays by e^(−t/4), a follows its torque alone; they meet where the speeds are equal.
  const auto free_a = [&](double t) {
    return tied(low) + 60 / (2 * M_PI) * (std::cos(2 * M_PI * low) - std::cos(2 * M_PI * t));
  };
  const auto free_b = [&](double t) { return tied(low) * std::exp(-(t - low) / 4); };
  double begin = 1, end = 1.75;
  for (int i = 0; i < 200; ++i)
    (free_a(0.5 * (begin + end)) < free_b(0.5 * (begin + end)) ? begin : end) = 0.5 * (begin + end);
  EXPECT_NEAR(events[1].t, begin, 1e-9);
}

// Several brakes on one shaft hold together, and the list of events says in which proportion.
TEST(Brakes, ShareInProportionToCapacity) {
  const Result r = test::run(R"(
    line = ["a", "brake1", "brake2"]
    a = { kind = "inertia", inertia = "2 kg*m2" }
    brake1 = { kind = "brake", torque = "30 N*m" }
    brake2 = { kind = "brake", torque = "10 N*m" }
    run = { until = "2 s", start = { speed = "8 rad/s" } }
  )");
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_NEAR(r.events[0].t, 0.4, 1e-12);
  EXPECT_EQ(r.events[1].what, "is held in proportion to capacity: brake1 75 %, brake2 25 %");
}

// A gear with losses and a dry load, both at rest on one coordinate (rows that say the same): pushed beyond what both
// hold they move with α = (i η M − F)/(J_b + η i² J_a), else they stay.
TEST(Contacts, AGearWithLossesAndADryLoadBreakAwayTogether) {
  const auto end = [](double torque) {
    const Result r = test::run(fmt::format(R"(
      line = ["a", "gear", "b"]
      a = {{ kind = "inertia", inertia = "0.1 kg*m2" }}
      drive = {{ kind = "torque source", on = "a", torque = "{} N*m" }}
      gear = {{ kind = "gearbox", efficiency = 0.95, stages = [{{ teeth = [19, 95], inertia = ["0.004 kg*m2", "0.35 kg*m2"] }}] }}
      b = {{ kind = "inertia", inertia = "4 kg*m2" }}
      dry = {{ kind = "load", on = "b", torque = "20 N*m" }}
      run = {{ until = "1 s", accuracy = 1e-9 }}
    )",
                                           torque));
    return figure(r, "final_speed.b");
  };
  EXPECT_NEAR(end(50), (5 * 0.95 * 50 - 20) / (4.35 + 0.95 * 25 * 0.104), 1e-9);
  EXPECT_NEAR(end(4.22), (5 * 0.95 * 4.22 - 20) / (4.35 + 0.95 * 25 * 0.104), 1e-9);  // 20/(i η) = 4.2105
  EXPECT_EQ(end(4.2), 0.0);
  EXPECT_EQ(end(3), 0.0);
}

// Four contacts stop in one instant, by symmetry; a set of modes is found at once and the run goes on.
TEST(Contacts, StopsAtOneInstantAreOneEvent) {
  const Result r = test::run(R"(
    line = ["a", "c1", "b", "c2", "c", "c3", "d"]
    a = { kind = "inertia", inertia = "1 kg*m2" }
    b = { kind = "inertia", inertia = "1 kg*m2" }
    c = { kind = "inertia", inertia = "1 kg*m2" }
    d = { kind = "inertia", inertia = "1 kg*m2" }
    c1 = { kind = "clutch", torque = "10 N*m" }
    c2 = { kind = "clutch", torque = "20 N*m" }
    c3 = { kind = "clutch", torque = "10 N*m" }
    [run]
    until = "2 s"
    accuracy = 1e-9
    start = { a = { speed = "10 rad/s" }, b = { speed = "10 rad/s" }, c = { speed = "0 rad/s" }, d = { speed = "0 rad/s" } }
  )");
  // c1 and c3 are stuck at first: the pairs (a b), (c d) would need 20/2 = 10 N·m in c1 and c3: just held.
  EXPECT_NEAR(figure(r, "final_speed.a"), 5, 1e-10);
  EXPECT_NEAR(figure(r, "final_speed.d"), 5, 1e-10);
  const auto locked = of(r, "c2");
  ASSERT_FALSE(locked.empty());
  EXPECT_NEAR(locked.back().t, 0.5, 1e-10);
}

// --- derivatives, methods, energy ------------------------------------------------------------------------------------

const char* const clutched = R"(
  line = ["a", "gap", "b", "clutch", "c", "spring", "d"]
  a = { kind = "inertia", inertia = "0.4 kg*m2" }
  b = { kind = "inertia", inertia = "0.1 kg*m2" }
  c = { kind = "inertia", inertia = "0.2 kg*m2" }
  d = { kind = "inertia", inertia = "0.5 kg*m2" }
  gap = { kind = "coupling", stiffness = "2 kN*m/rad", damping = "3 N*m*s/rad", backlash = "1 deg" }
  clutch = { kind = "clutch", torque = "20 N*m", static_torque = "25 N*m", slope = "-0.05 N*m*s/rad" }
  spring = { kind = "coupling", stiffness = "900 N*m/rad", damping = "1 N*m*s/rad" }
  brake = { kind = "brake", on = "d", torque = "9 N*m" }
  drive = { kind = "torque source", on = "a", torque = "6 N*m", amplitude = "45 N*m", frequency = "4 Hz" }
  drag = { kind = "bearing drag", on = "c", damping = "0.4 N*m*s/rad" }
  effects = { elasticity = true }
  run = { until = "3 s", accuracy = 1e-7 }
)";

// The exact Jacobian against central differences of the flow, wherever a run with clutch, brake and gap comes along.
TEST(Contacts, JacobianEqualsDifferencesInEveryMode) {
  const Scene scene = test::scene_from(clutched);
  Equations equations(compile(scene, scene.effects), false);
  equations.start(0);
  for (const auto& [clutch, brake] :
       {std::pair(1.0, 1.0), std::pair(0.0, 1.0), std::pair(0.0, 0.0), std::pair(1.0, 0.0)}) {
    // Modes are set by speeds: equal speeds tie, rest holds.
    const std::vector<double> speed = {30, 30, clutch ? 30 - 7 : 30.0, brake ? 20 : 0.0}, twist = {0.02, 0, 0.004};
    const std::vector<double> y = equations.state_of(0, 0, twist, speed);
    const test::Slopes slopes = test::slopes_of(equations, 0.01, y, 1e-6);
    for (std::size_t column = 0; column < y.size(); ++column)
      for (std::size_t row = equations.speed_index(0); row < y.size(); ++row)
        EXPECT_NEAR(slopes.exact_at(row, column), slopes.difference_at(row, column),
                    1e-6 * (1 + std::abs(slopes.exact_at(row, column))))
            << "clutch slips " << clutch << " brake slips " << brake << " row " << row << " column " << column;
  }
}

// Explicit and implicit methods agree through all events, and the energy balance closes.
TEST(Contacts, MethodsAgreeThroughAllEvents) {
  Scene scene = test::scene_from(clutched);
  const Result one = test::run(scene);
  scene.run.method = "esdirk";
  const Result other = test::run(scene);
  EXPECT_GT(one.events.size(), 20u);
  ASSERT_EQ(one.events.size(), other.events.size());
  for (std::size_t k = 0; k < one.events.size(); ++k) EXPECT_NEAR(one.events[k].t, other.events[k].t, 1e-5);
  for (const char* name : {"final_speed.a", "final_speed.d", "final_angle.c", "peak_torque.gap"})
    EXPECT_NEAR(figure(one, name), figure(other, name), 2e-5 * std::max(1.0, std::abs(figure(one, name)))) << name;
  EXPECT_LT(one.energy.relative, 1e-7);
  EXPECT_LT(other.energy.relative, 1e-6);
}

// Regularised contacts follow the exact ones but for their creep.
TEST(Contacts, WithoutEventsTheyCreepAndSaySo) {
  const Scene scene = test::scene_from(R"(
    line = ["a", "brake"]
    a = { kind = "inertia", inertia = "2 kg*m2" }
    brake = { kind = "brake", torque = "30 N*m" }
    push = { kind = "torque source", on = "a", torque = "15 N*m" }
    run = { until = "2 s", start = { speed = "8 rad/s" } }
  )");
  Equations equations(compile(scene, scene.effects), false);
  std::vector<double> y = equations.start(0), ydot(y.size());
  const std::string said = equations.regularise({0});
  EXPECT_NE(said.find("creeps"), std::string::npos);
  // At rest it gives way; where tanh(v/v₀) = ½ the torques balance.
  const double v0 = 1e-4 * equations.model().shafts[0].speed_scale;
  y[equations.speed_index(0)] = v0 * std::atanh(0.5);
  equations.flow(0, y, ydot);
  EXPECT_NEAR(ydot[equations.speed_index(0)], 0, 1e-9);
  y[equations.speed_index(0)] = 1;
  equations.flow(0, y, ydot);
  EXPECT_NEAR(ydot[equations.speed_index(0)], -7.5, 1e-12);
}

// What moves on all the same, far beyond its creep, has a direction and its own law again.
TEST(Contacts, WithoutEventsTheyMoveOnByTheirOwnLaw) {
  const Scene scene = test::scene_from(R"(
    line = ["a", "brake"]
    a = { kind = "inertia", inertia = "2 kg*m2" }
    brake = { kind = "brake", torque = "30 N*m" }
    push = { kind = "torque source", on = "a", torque = "-45 N*m" }
    run = { until = "2 s" }
  )");
  Equations equations(compile(scene, scene.effects), false);
  std::vector<double> y = equations.start(0), g(equations.guard_count());
  equations.regularise({0});
  const double scale = equations.model().shafts[0].speed_scale;
  double& speed = y[equations.speed_index(0)];
  speed = -1.9e-3 * scale;
  equations.guards(0, y, g);
  EXPECT_GT(g[0], 0);
  EXPECT_TRUE(equations.at_standstill(0));
  speed = -2.1e-3 * scale;
  equations.guards(0, y, g);
  EXPECT_LT(g[0], 0);
  std::vector<Event> log;
  equations.fire(0, y, {0}, log);
  EXPECT_FALSE(equations.at_standstill(0));
  equations.guards(0, y, g);
  EXPECT_NEAR(g[0], 2.1e-3, 1e-9);  // until it comes to rest
  ASSERT_EQ(log.size(), 1u);
  EXPECT_EQ(log[0].what, "moves backwards");
}

}  // namespace
}  // namespace kurbel::contacts_test
