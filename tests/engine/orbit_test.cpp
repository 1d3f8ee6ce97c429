// orbit_test.cpp — where a machine's own start leads to, against closed forms: what slips, what is switched, what stands.
#include "engine/orbit/orbit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

#include "engine/orbit/follow_period.h"
#include "engine/orbit/held_speeds.h"
#include "engine/orbit/link_speeds.h"
#include "engine/orbit/moment.h"
#include "engine/orbit/settling.h"
#include "tests/support/scenes.h"

namespace kurbel::test::orbit_test {
namespace {

constexpr double pi = std::numbers::pi;

Orbit orbit_of(const Scene& scene, OrbitOptions options = {}) {
  return find_orbit(compile(scene, scene.effects), options);
}
Orbit orbit_of(const std::string& text) { return orbit_of(scene_from(text)); }

// Of a component's shaft, at the steady motion's state [rad/s].
double speed_of(const Scene& scene, const Orbit& orbit, const std::string& component, bool out = false) {
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  equations.bind(orbit.state.modes);
  const Network::Ports& ports = model->network.ports.at(component);
  const auto node = static_cast<std::size_t>(out ? ports.out : ports.in);
  return model->gain_of_node[node] *
         equations.snapshot(orbit.state.t, orbit.state.y).now.speed[model->shaft_of_node[node]];
}

const char* const dc_motor =
    "motor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"40 rad/s\", inertia = \"0.5 "
    "kg*m2\" }\n";

// A limiter of 10 N·m before a load of 15: the load stands, the motor turns at ω₀ (1 − 10/60).
TEST(Orbit, TorqueLimiterThatSlipsLeavesItsLoadStanding) {
  const Scene scene = scene_from(std::string("line = [\"motor\", \"limiter\", \"load\"]\n") + dc_motor +
                                 "limiter = { kind = \"torque limiter\", torque = \"10 N*m\" }\n"
                                 "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::equilibrium) << orbit.words;
  EXPECT_NEAR(speed_of(scene, orbit, "motor"), 40 * (1 - 10 / 60.0), 1e-7);
  EXPECT_EQ(speed_of(scene, orbit, "load"), 0);
}

// A fan behind it turns where 10 N·m = k ω².
TEST(Orbit, SlippingLimiterDrivesAFanAtItsTorque) {
  const Scene scene =
      scene_from(std::string("line = [\"motor\", \"limiter\", \"fan\"]\n") + dc_motor +
                 "limiter = { kind = \"torque limiter\", torque = \"10 N*m\" }\n"
                 "fan = { kind = \"load\", quadratic = \"0.04 N*m*s2/rad2\", inertia = \"0.3 kg*m2\" }\n");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::equilibrium) << orbit.words;
  EXPECT_NEAR(speed_of(scene, orbit, "fan"), std::sqrt(10 / 0.04), 1e-7);
  EXPECT_NEAR(speed_of(scene, orbit, "motor"), 40 * (1 - 10 / 60.0), 1e-7);
}

// At half of the motor's no-load speed it gives 30 N·m, the load takes 15: a torque of −15 N·m holds that speed.
TEST(Orbit, SpeedIsHeldByTheTorqueThatIsMissing) {
  const Scene scene = scene_from(std::string("line = [\"motor\", \"load\"]\n") + dc_motor +
                                 "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n");
  const auto machine = [&scene](double torque) {
    Network network = build_network(scene);
    network.put(network.ports.at("motor").in, "motor", HoldingTorque{torque});
    return compile_network(std::move(network), scene, scene.effects);
  };
  ReturnMap like(machine(0), {});
  const ReturnMap::Image guess = like.approach(20);
  ASSERT_EQ(guess.end, ReturnMap::End::returned) << guess.why;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(guess.z.size() + 1);
  x.head(guess.z.size()) = guess.z;
  std::optional<LinkSpeeds> speeds;
  for (const bool by_differences : {false, true}) {
    const HeldSpeeds held{.machine = [&](const Eigen::VectorXd& a) { return machine(10 * a[0]); },
                          .record = [&](const Model& m) { return &speeds.emplace(m); },
                          .miss =
                              [](const ReturnMap::Image& round) {
                                return Eigen::VectorXd::Constant(1, round.turned / round.time / 20 - 1);
                              },
                          .by_differences = by_differences};
    HeldMotion motion;
    find_held_orbit(held, like, x, {}, motion);
    ASSERT_TRUE(motion.orbit.repeats()) << motion.orbit.words;
    EXPECT_NEAR(10 * motion.by[0], -15, 1e-8);
    EXPECT_NEAR(motion.orbit.point.time, 2 * pi / 20, 1e-10);
    EXPECT_NEAR(speeds->greatest(), 20, 1e-8);
    EXPECT_GT(motion.cost, 0);
  }
}

// The brake holds until 0.5 s; then the motor runs as if it had never been.
TEST(Orbit, SequenceIsCarriedOut) {
  const Scene scene = scene_from(std::string("line = [\"motor\", \"brake\", \"load\"]\n") + dc_motor +
                                 "brake = { kind = \"brake\", torque = \"100 N*m\" }\n"
                                 "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n"
                                 "[sequence]\nsteps = [{ at = \"0.5 s\", set = \"brake\", to = 0 }]\n");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::equilibrium) << orbit.words;
  EXPECT_NEAR(speed_of(scene, orbit, "motor"), 30, 1e-8);
}

// The brake gives way along a law, to a fifth: the motor runs at ω₀ (1 − 20/60), not as the law's first instant leaves it.
TEST(Orbit, LawOfACommandIsFollowedToItsEnd) {
  const Scene scene = scene_from(std::string("line = [\"motor\", \"brake\"]\n") + dc_motor +
                                 "brake = { kind = \"brake\", torque = \"100 N*m\" }\n"
                                 "[sequence]\nsteps = [{ at = \"0.5 s\", set = \"brake\", law = { over = \"time\", "
                                 "formula = \"1 - 0.4*t/(1 s)\", range "
                                 "= [\"0 s\", \"2 s\"] } }]\n");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::equilibrium) << orbit.words;
  EXPECT_GE(orbit.state.t, 2.5);
  EXPECT_NEAR(speed_of(scene, orbit, "motor"), 40 * (1 - 20 / 60.0), 1e-8);
}

// A step waits for a speed of the run-up, the next one for a time after it: what Newton's method finds on the way, with
// steps still to come, is not kept. In the end half the voltage drives against nothing: ω₀/2.
TEST(Orbit, StepsThatWaitForTheMotionAreCarriedOut) {
  const Orbit orbit = orbit_of(
      std::string("line = [\"motor\", \"crank\"]\n") + dc_motor +
      "brake = { kind = \"brake\", on = \"crank\", torque = \"20 N*m\" }\n"
      "[crank]\nkind = \"slider-crank\"\nradius = \"50 mm\"\nrod = \"0.2 m\"\nslider_mass = \"2 kg\"\ncrank_inertia = "
      "\"0.3 kg*m2\"\n"
      "[sequence]\nsteps = [{ at = \"0 s\", set = \"brake\", to = 0 }, { speed_above = \"39 rad/s\", of = \"motor\", "
      "set = "
      "\"brake\" }, { after = \"1 s\", set = \"brake\", to = 0 }, { after = \"0 s\", set = \"motor\", to = 0.5 }]\n");
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_NEAR(orbit.point.time, 2 * pi / 20, 1e-5 * 2 * pi / 20);
}

// One that repeats sets the period: J ω̇ = 60 (c(t) − ω/40) − 15 with c = 1 + 0.1 sin(2π t/T), by its mean and phasor.
// A motor that is off is brought to the speed of a flywheel by the drag of its freewheel: the motion repeats from the cycle on
// in which it arrives, between two trials of Newton's method (at powers of two), and before the last cycle allowed.
TEST(Orbit, WhatRepeatsBetweenTwoTrialsIsFound) {
  const Scene scene = scene_from(R"(
line = ["motor", "freewheel", "flywheel", "press"]
[motor]
kind = "induction motor"
rated_power = "30528 W"
rated_speed = "113.21 rad/s"
synchronous_speed = "117.47 rad/s"
breakdown_ratio = 2.56
inertia = "0.28697 kg*m2"
starting_ratio = 1.33
stop = "2.0583 s"
[freewheel]
kind = "one-way clutch"
drag = "0.42934 N*m"
[flywheel]
kind = "flywheel"
inertia = "1.1473 kg*m2"
[press]
kind = "slider-crank"
radius = "0.064083 m"
rod = "0.29004 m"
crank_inertia = "0.6696 kg*m2"
slider_mass = "10.271 kg"
gravity = "9.81 m/s2"
stroke_angle = "90 deg"
load = { kind = "table", force = { over = "angle", unit = ["deg", "N"], period = "360 deg", points = [[0, 0], [180, 0], [200, 4737.5], [330, 4737.5], [360, 0]] } }
[second]
kind = "induction motor"
rated_power = "54598 W"
rated_speed = "202.47 rad/s"
synchronous_speed = "217.33 rad/s"
breakdown_ratio = 1.88
inertia = "0.28697 kg*m2"
starting = "star-delta"
switch_time = "0.20902 s"
start = "0.029508 s"
on = "flywheel"
)");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_TRUE(orbit.stable);
  EXPECT_NEAR(speed_of(scene, orbit, "motor"), speed_of(scene, orbit, "flywheel"),
              0.01 * speed_of(scene, orbit, "flywheel"));
}

TEST(Orbit, LawThatRepeatsSetsThePeriod) {
  const Orbit orbit = orbit_of(std::string("line = [\"motor\", \"load\"]\n") + dc_motor +
                               "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n"
                               "[sequence]\nsteps = [{ at = \"0.25 s\", set = \"motor\", law = { over = \"time\", "
                               "formula = \"1 + 0.1*sin(2*pi*t/T)\", "
                               "period = \"0.4 s\", with = { T = \"0.4 s\" } } }]\n");
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_NEAR(orbit.point.time, 0.4, 1e-12);
}

// A belt that sticks where the period begins and, once the machine is fast, slips there in every turn: the motion is that of
// the run, and what drives covers what is taken out.
TEST(Orbit, BeltThatSlipsWhereThePeriodBeginsIsOfTheMotion) {
  const Scene scene = scene_from(R"(
line = ["motor", "flywheel", "joint", "press"]
[motor]
kind = "pneumatic motor"
max_power = "848.31 W"
free_speed = "92.141 rad/s"
inertia = "0.055769 kg*m2"
[flywheel]
kind = "flywheel"
inertia = "0.40531 kg*m2"
[joint]
kind = "belt"
diameter_in = "200 mm"
diameter_out = "200 mm"
friction_coefficient = 0.4
wrap_angle = "160 deg"
pretension = "170.75 N"
[press]
kind = "slider-crank"
radius = "0.15369 m"
rod = "0.47117 m"
crank_inertia = "0.033193 kg*m2"
slider_mass = "0.14626 kg"
load = { kind = "medium", viscous = "17.299 N*s/m" }
[run]
until = "25 s"
)");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  const Result r = run(scene, false);
  const double mean = figure(r, "mean_speed.press");
  EXPECT_NEAR(2 * pi / orbit.point.time, mean, 1e-5 * mean);
}

TEST(Orbit, LoadThatActsForAWhileActsNoMore) {
  const Scene scene =
      scene_from(std::string("line = [\"motor\", \"load\", \"blow\"]\n") + dc_motor +
                 "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n"
                 "blow = { kind = \"load\", torque = \"20 N*m\", start = \"1 s\", stop = \"1.2 s\" }\n");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::equilibrium) << orbit.words;
  EXPECT_GT(orbit.state.t, 1.2);
  EXPECT_NEAR(speed_of(scene, orbit, "motor"), 30, 1e-8);
}

TEST(Orbit, MotorThatIsSwitchedOffComesToRest) {
  const Orbit orbit = orbit_of(
      "line = [\"motor\", \"load\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = "
      "\"40 rad/s\", inertia = \"0.5 kg*m2\", stop = \"2 s\" }\n"
      "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n");
  EXPECT_EQ(orbit.kind, Orbit::Kind::at_rest) << orbit.words;
  EXPECT_NE(orbit.words.find("held"), std::string::npos) << orbit.words;
}

TEST(Orbit, DriveThatAlwaysWinsRunsAway) {
  const Orbit orbit = orbit_of(
      "line = [\"turbine\", \"load\"]\n"
      "turbine = { kind = \"torque source\", torque = \"20 N*m\", inertia = \"1 kg*m2\" }\n"
      "load = { kind = \"load\", torque = \"5 N*m\" }\n");
  EXPECT_EQ(orbit.kind, Orbit::Kind::runaway) << orbit.words;
}

// The scene's own start decides which of two motions is kept: a Kloss motor under a constant load that it cannot start.
TEST(Orbit, TheStartDecidesWhatIsKept) {
  const auto scene = [](const char* speed) {
    return scene_from(
        std::string("line = [\"motor\", \"load\"]\nmotor = { kind = \"induction motor\", rated_power = \"4 kW\", "
                    "rated_speed = \"95 rad/s\", synchronous_speed = \"100 rad/s\", breakdown_ratio = 3, "
                    "inertia = \"0.5 kg*m2\" }\nload = { kind = \"load\", torque = \"80 N*m\" }\n") +
        "[run]\nstart = { speed = \"" + speed + "\" }\n");
  };
  const Orbit running = orbit_of(scene("95 rad/s"));
  EXPECT_EQ(running.kind, Orbit::Kind::equilibrium) << running.words;
  const Orbit standing = orbit_of(scene("0 rad/s"));
  EXPECT_EQ(standing.kind, Orbit::Kind::at_rest) << standing.words;
}

// Every example scene: what is found repeats, and the run does not leave it.
TEST(Orbit, OfExampleScenesRepeats) {
  for (const char* name : {"crank_press", "compressor", "single_cylinder_engine", "piston_pump"}) {
    SCOPED_TRACE(name);
    const Scene scene = scene_file(std::string("scenes/") + name + ".toml");
    const Orbit orbit = orbit_of(scene);
    ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
    EXPECT_TRUE(orbit.polished);
    EXPECT_LT(orbit.point.largest(), 1);
    const ReturnMap::Image again = orbit.map->image(orbit.point.z, false);
    EXPECT_LT((again.z - orbit.point.z).cwiseAbs().maxCoeff(), 1e-10);
  }
}

// From where a machine starts decides no more than on which cycle it ends: here there is one.
TEST(Orbit, IsTheSameFromDifferentStarts) {
  Scene scene = scene_file("scenes/crank_press.toml");
  const double rated = scene.run.start.speed;
  double time = 0;
  for (const double part : {1.0, 0.7, 0.95, 1.05}) {
    scene.run.start.speed = part * rated;
    const Orbit orbit = orbit_of(scene);
    ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
    if (time == 0) time = orbit.point.time;
    EXPECT_NEAR(orbit.point.time, time, 1e-9 * time) << part;
  }
}

// Rubber's branches are states: their creep is among the unknowns, with the multiplier that a disturbed cycle has.
TEST(Orbit, InternalStatesAreAmongTheUnknowns) {
  const Scene scene = scene_from(std::string("line = [\"motor\", \"rubber\", \"crank\"]\n") + dc_motor +
                                 "rubber = { kind = \"rubber coupling\", stiffness = \"2 kN*m/rad\", branches = [{ "
                                 "stiffness = \"0.8 kN*m/rad\", relaxation_time = \"20 ms\" }] }\n"
                                 "crank = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", "
                                 "crank_inertia = \"0.5 kg*m2\", slider_mass = \"3 kg\" }\n"
                                 "[effects]\nelasticity = true\nrelaxation = true\n"
                                 "[run]\nstart = { speed = \"30 rad/s\" }\n");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_EQ(orbit.map->size(), 4u);  // twist, creep, two speeds
  constexpr double h = 1e-4;
  const Eigen::VectorXd step = h * Eigen::VectorXd::Ones(4);
  const Eigen::VectorXd above = orbit.map->image(orbit.point.z + step, false).z;
  const Eigen::VectorXd below = orbit.map->image(orbit.point.z - step, false).z;
  EXPECT_LT(((above - below) / 2 - orbit.point.derivative * step).cwiseAbs().maxCoeff(), 3e-5 * h);
}

// A creep is measured by the twist under the rated torque, at any stiffness; a slow approach (J/c = 4.6 s) leaves much of it
// for Newton's method. Speed and mean torque are those of the balance c ω = T.
TEST(Orbit, OfSoftRubberIsFoundFromAfar) {
  for (const double stiffness : {30.0, 100.0, 3000.0, 1e5}) {
    const Scene scene = scene_from(fmt::format(R"(
      line = ["disc", "rubber", "fan"]
      disc = {{ kind = "inertia", inertia = "4.3 kg*m2" }}
      fan = {{ kind = "inertia", inertia = "0.22 kg*m2" }}
      drag = {{ kind = "bearing drag", on = "fan", damping = "0.98 N*m*s/rad" }}
      effects = {{ elasticity = true, relaxation = true }}
      run = {{ start = {{ speed = "76 rad/s" }} }}
      [rubber]
      kind = "rubber coupling"
      stiffness = "{} N*m/rad"
      damping_ratio = 0.05
      branches = [{{ stiffness = "{} N*m/rad", relaxation_time = "10 ms" }}]
      [source]
      kind = "torque source"
      on = "disc"
      [source.table]
      over = "angle"
      unit = ["deg", "N*m"]
      period = "180 deg"
      points = [[0, 0], [60, 1152], [120, 0], [180, 0]]
    )",
                                               stiffness, 0.4 * stiffness));
    const Orbit orbit = orbit_of(scene);
    ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << stiffness << ": " << orbit.words;
    EXPECT_LT(orbit.cycles, 100) << stiffness;
  }
}

// A load that comes and goes by a repeated sequence: the run alone comes to it, each cycle by a ratio nearer. What is
// left of the way is reported.
TEST(Orbit, WhatTheRunAloneCameToIsTheFartherOffTheSlowerItSettles) {
  const Orbit orbit = orbit_of(
      "line = [\"motor\", \"clutch\", \"load\"]\n"
      "motor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"40 rad/s\", inertia = \"6 "
      "kg*m2\" }\nclutch = { kind = \"clutch\", torque = \"30 N*m\" }\n"
      "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n[sequence]\nrepeat = true\nsteps = [{ "
      "after = \"0.5 s\", set = \"clutch\", to = 0 }, { after = \"0.5 s\", set = \"clutch\", to = 1 }]\n");
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_FALSE(orbit.polished);
  ASSERT_EQ(orbit.point.to_come.size(), orbit.point.z.size());
  Eigen::VectorXd z = orbit.point.z;
  for (int i = 0; i < 200; ++i) z = orbit.map->image(z, false).z;
  const double off = (z - orbit.point.z).cwiseAbs().maxCoeff();
  EXPECT_GT(off, 2 * orbit.point.residual);  // a cycle's change is not the error
  EXPECT_LT(off, 1.2 * orbit.point.still_to_come() + 1e-11);
  EXPECT_LT((z - orbit.point.z - orbit.point.to_come).cwiseAbs().maxCoeff(), 0.2 * off + 1e-11);
}

// However many events a cycle holds: a brake of 5 N·m grips 150 times a cycle of 3.1 s, 10 ms on, 10 ms off, and 0.1 s
// off at its end. A DC motor behind it is linear, so its periodic speed is a sum of exponentials.
// A sequence that takes 2 s repeats by itself, a load over time each p: the motion repeats after their common period.
TEST(Orbit, ASequenceAndALawOverTimeRepeatTogether) {
  for (const auto& [law, common] : {std::pair{1.0, 2.0}, {2.0, 2.0}, {2.5, 10.0}, {3.0, 6.0}, {4.0, 4.0}, {6.0, 6.0}}) {
    const Orbit orbit = orbit_of(scene_from(fmt::format(
        "line = [\"motor\", \"mill\"]\nmotor = {{ kind = \"dc shunt motor\", stall_torque = \"100 N*m\", no_load_speed "
        "= "
        "\"20 rad/s\", inertia = \"1 kg*m2\" }}\nmill = {{ kind = \"load\", inertia = \"2 kg*m2\", table = {{ over = "
        "\"time\", unit = [\"s\", \"N*m\"], period = \"{0} s\", points = [[0, 10], [0.3, 50], [{0}, 10]] }} }}\n"
        "[sequence]\nrepeat = true\nsteps = [{{ at = \"0 s\", set = \"motor\", to = 1 }}, {{ after = \"1 s\", set = "
        "\"motor\", to = 0.5 }}, {{ after = \"1 s\", set = \"motor\", to = 1 }}]\n",
        law)));
    ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << law << ": " << orbit.words;
    EXPECT_NEAR(orbit.point.time, common, 1e-6) << law;
  }
}

TEST(Orbit, ASequenceOfManyStepsRepeats) {
  constexpr int strokes = 150;
  constexpr double pulse = 0.01, pause = 0.1, fades = 60.0 / 40 / 6, gripped = 40 * (1 - 5 / 60.0);
  std::string steps;
  for (int i = 0; i < strokes; ++i)
    steps += fmt::format(
        "{{ after = \"{} s\", set = \"brake\", to = 1 }}, {{ after = \"{} s\", set = \"brake\", to = 0 }}, ",
        i == 0 ? pulse + pause : pulse, pulse);
  const Scene scene = scene_from(
      "line = [\"motor\", \"brake\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = "
      "\"40 rad/s\", inertia = \"6 kg*m2\" }\nbrake = { kind = \"brake\", torque = \"5 N*m\" }\n[sequence]\nrepeat = "
      "true\nsteps = [" +
      steps + "]\n");
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_NEAR(orbit.point.time, strokes * 2 * pulse + pause, 1e-9);
  EXPECT_LT(orbit.cycles, 390);  // turns until e^(-κ t) is 1e-7
  // Speed at the section, in the middle of the widest gap: of its cycle from there on, in which each interval brings it
  // nearer to where the motor balances, e^(-κ t).
  double factor = 1, offset = 0;
  const auto go = [&](double time, double towards) {
    const double left = std::exp(-fades * time);
    factor *= left, offset = left * offset + (1 - left) * towards;
  };
  go((pause + pulse) / 2, 40);
  for (int i = 0; i < strokes; ++i) go(pulse, gripped), go(i + 1 < strokes ? pulse : (pause + pulse) / 2, 40);
  EXPECT_NEAR(speed_of(scene, orbit, "motor"), offset / (1 - factor), 1e-7);
}

// Steps that wait for the motion: a brake grips over each turn's first quarter. A DC motor is linear, so each part is an
// exponential in time, φ(t) = ω_b t + (ω_a − ω_b)(1 − e^(−κt))/κ; cycle by cycle from any speed. Its cycle is one turn,
// with the elasticity of a shaft, too: not two or three of them, whatever the run left unsettled.
std::string gripped_each_turn(const std::string& shaft) {
  return "line = [\"motor\", " + std::string(shaft.empty() ? "" : "\"shaft\", ") +
         "\"brake\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"40 rad/s\", "
         "inertia = \"0.4 kg*m2\" }\n" +
         shaft +
         "brake = { kind = \"brake\", torque = \"8 N*m\", inertia = \"0.1 kg*m2\" }\n[sequence]\nrepeat = true\nsteps "
         "= [{ "
         "angle = \"0 deg\", of = \"motor\", set = \"brake\", to = 1 }, { angle = \"90 deg\", of = \"motor\", set = "
         "\"brake\", to = 0 }]\n";
}
TEST(Orbit, ASequenceThatWaitsForTheMotionHasItsShortestPeriod) {
  const Scene rigid = scene_from(gripped_each_turn(""));
  constexpr long double rate = 60.0L / 40 / 0.5L;
  long double speed = 30, period = 0;
  const auto go = [&](long double way, long double towards) {
    long double t = way / speed;
    for (int i = 0; i < 30; ++i) {
      const long double left = std::exp(-rate * t);
      t -= (towards * t + (speed - towards) * (1 - left) / rate - way) / (towards + (speed - towards) * left);
    }
    speed = towards + (speed - towards) * std::exp(-rate * t), period += t;
  };
  for (int round = 0; round < 200; ++round) {
    period = 0;
    go(static_cast<long double>(pi) / 2, 40 * (1 - 8.0L / 60));
    go(3 * static_cast<long double>(pi) / 2, 40);
  }
  const Orbit orbit = orbit_of(rigid);
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_NEAR(orbit.point.time, static_cast<double>(period), 1e-9);

  const Scene elastic =
      scene_from(gripped_each_turn("shaft = { kind = \"shaft\", stiffness = \"2 kN*m/rad\", damping_ratio = 0.05 "
                                   "}\neffects = { elasticity = true }\n"));
  const Orbit twisted = orbit_of(elastic);
  ASSERT_EQ(twisted.kind, Orbit::Kind::cycle) << twisted.words;
  const auto model = compile(elastic, elastic.effects);
  Equations equations(model, false);
  RunOptions run;
  run.tolerance = 1e-11, run.until = 12;
  run.from = {0, equations.start(0)};
  const RunOutcome outcome = integrate(equations, run, {});
  std::vector<double> grips;
  for (const Event& e : outcome.events)
    if (e.kind == EventKind::command) grips.push_back(e.t);
  ASSERT_GT(grips.size(), 100U);
  EXPECT_NEAR(twisted.point.time, grips[grips.size() - 1] - grips[grips.size() - 3], 1e-8);
}

// A period that is taken for 1e-4 too long ends late after the last grip: its time is less by just that.
TEST(Orbit, APeriodIsInStepWithWhatItsSequenceWaitsFor) {
  const Scene scene = scene_from(gripped_each_turn(""));
  const Orbit orbit = orbit_of(scene);
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  ReturnMap map(compile(scene, scene.effects), {}, orbit.point.time * (1 + 1e-4));
  const ReturnMap::Image way = map.approach_from(orbit.state);
  ASSERT_EQ(way.end, ReturnMap::End::returned) << way.why;
  const ReturnMap::Image round = map.image(way.z, false);
  ASSERT_EQ(round.end, ReturnMap::End::returned) << round.why;
  EXPECT_NEAR(round.time, orbit.point.time, 1e-7 * orbit.point.time);
}

// A crank's speed falls by some 8 % within its turn: a step that waits for less than it has at the section is carried out in
// the period, one that waits for half of it is not.
TEST(Orbit, ASequenceGoesOnWhereAPeriodTriggersItsStep) {
  const auto machine = [](double waited_for) {
    return scene_from(
        std::string("line = [\"motor\", \"crank\"]\n") + dc_motor +
        fmt::format("sequence = {{ steps = [{{ speed_below = \"{} rad/s\", of = \"crank\", set = \"motor\", "
                    "to = 0.5 }}] }}\nrun = {{ start = {{ speed = \"38 rad/s\" }} }}\n",
                    waited_for) +
        "[crank]\nkind = \"slider-crank\"\nradius = \"50 mm\"\nrod = \"0.2 m\"\nslider_mass = \"60 "
        "kg\"\ncrank_inertia = \"0.3 kg*m2\"\n");
  };
  const Orbit orbit = orbit_of(machine(1));
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_FALSE(sequence_goes_on(*orbit.map, orbit.point.z));
  const double begin = speed_of(machine(1), orbit, "crank");
  const auto goes_on = [&](double waited_for) {
    const Scene scene = machine(waited_for);
    ReturnMap map(compile(scene, scene.effects), map_options({}));
    map.follow(*orbit.map);
    return sequence_goes_on(map, orbit.point.z);
  };
  EXPECT_TRUE(goes_on(1.01 * begin)) << "it is so already";
  EXPECT_TRUE(goes_on(0.97 * begin));
  EXPECT_FALSE(goes_on(0.5 * begin));
}

// A soft start of 2 s that begins when its motor is switched on at 3 s ends at 5 s.
TEST(Orbit, WhatStartsAnewIsSwitchedUntilItsOwnEnd) {
  const Scene scene = scene_from(R"(
line = ["motor"]
motor = { kind = "induction motor", rated_power = "4 kW", rated_speed = "1440 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 2.8, inertia = "0.2 kg*m2", starting = "soft start", ramp = "2 s" }
)");
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  const std::vector<double> y = equations.start(0);
  Modes modes = equations.modes();
  bool is_there = false;
  for (std::size_t i = 0; i < model->network.elements.size(); ++i)
    if (model->network.elements[i].element->is.starts_anew) modes.on_since[i] = 3, is_there = true;
  ASSERT_TRUE(is_there);
  EXPECT_EQ(switched_until(*model, {}, {3, y, modes}), 5);
}

// What time drives repeats in its time, and three periods take three; no period of its own is sought for it, whether
// a torque oscillates or a prescribed speed.
TEST(Orbit, PeriodsOfWhatTimeDrivesAreItsOwn) {
  const auto shaken = [](const char* by) {
    return scene_from(std::string("line = [\"drive\", \"spring\", \"wheel\"]\n") + by +
                      "spring = { kind = \"coupling\", stiffness = \"300 N*m/rad\", damping = \"2 N*m*s/rad\" }\n"
                      "wheel = { kind = \"load\", inertia = \"1 kg*m2\", damping = \"0.5 N*m*s/rad\" }\n"
                      "effects = { elasticity = true }\n");
  };
  const Scene torque = shaken(
      "drive = { kind = \"torque source\", torque = \"5 N*m\", amplitude = \"3 N*m\", frequency = \"4 Hz\", inertia = "
      "\"1 "
      "kg*m2\" }\n");
  const Scene speed = shaken(
      "drive = { kind = \"prescribed speed\", speed = \"10 rad/s\", amplitude = \"1 rad/s\", frequency = \"4 Hz\" }\n");
  for (const Scene& scene : {torque, speed}) {
    const auto model = compile(scene, scene.effects);
    EXPECT_FALSE(has_own_period(*model, periodicity_of(*model)));
  }
  const Orbit orbit = orbit_of(torque);
  ASSERT_TRUE(orbit.repeats()) << orbit.words;
  Equations equations(orbit.map->shared_model(), false);
  const RunOutcome outcome = follow_period(*orbit.map, orbit.point, equations, {.tolerance = 1e-9, .periods = 3}, {});
  EXPECT_NEAR(outcome.t - orbit.map->start_time(), 0.75, 1e-12);
}

// At 2 s: one of two windows is on for good, one is over, one never comes.
TEST(Orbit, OfAMomentWindowsStayAsTheyAre) {
  const Scene scene = scene_from(R"(
line = ["wheel"]
wheel = { kind = "flywheel", inertia = "1 kg*m2" }
over = { kind = "torque source", on = "wheel", torque = "1 N*m", stop = "1 s" }
on = { kind = "torque source", on = "wheel", torque = "1 N*m", start = "1 s", stop = "3 s" }
later = { kind = "torque source", on = "wheel", torque = "1 N*m", start = "3 s", stop = "4 s" }
)");
  const Network network = network_as_of(scene, {.after_step = {}, .time = 2});
  const double never = Window{}.stop;
  for (const auto& [name, start, stop] :
       {std::tuple("over", Window{}.start, 1.0), std::tuple("on", 1.0, never), std::tuple("later", never, never)}) {
    const auto e = std::find_if(network.elements.begin(), network.elements.end(),
                                [&name = name](const Network::ShaftElement& of) { return of.component == name; });
    ASSERT_NE(e, network.elements.end()) << name;
    EXPECT_EQ(e->window.start, start) << name;
    EXPECT_EQ(e->window.stop, stop) << name;
  }
}

// A flywheel so heavy that a turn takes off 1e-7 of a deviation: that is slow, not a family of motions.
TEST(Orbit, AMachineThatIsMerelySlowIsNoFamily) {
  const Orbit orbit = orbit_of(
      "line = [\"motor\", \"load\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = "
      "\"40 rad/s\", inertia = \"4e6 kg*m2\" }\nload = { kind = \"load\", damping = \"0.5 N*m*s/rad\" }\n"
      "[run]\nstart = { speed = \"30.01 rad/s\" }\n");
  ASSERT_TRUE(orbit.repeats()) << orbit.words;
  const double steady = 30, fades = (60 / 40.0 + 0.5) / 4e6 * 2 * pi / steady;  // κ T
  EXPECT_LT(fades, 1.1e-7);
  EXPECT_FALSE(orbit.point.neutral());
  EXPECT_NEAR(1 - orbit.point.largest(), fades, 0.05 * fades);
  EXPECT_NEAR(orbit.point.time, 2 * pi / steady, 1e-5);
}

// While the link waits for a speed to be reached, no cycles are run through.
TEST(Orbit, WaitingIsNoCycle) {
  const Orbit orbit = orbit_of(
      "line = [\"motor\", \"brake\", \"load\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", "
      "no_load_speed = \"40 rad/s\", inertia = \"0.5 kg*m2\" }\nbrake = { kind = \"brake\", torque = \"100 N*m\" }\n"
      "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\", stop = \"200 s\" }\n");
  EXPECT_EQ(orbit.kind, Orbit::Kind::at_rest) << orbit.words;
  EXPECT_GT(orbit.cycles, 1);
  EXPECT_LT(orbit.cost, 1);
}

// A press on a belt that slips: a turn is not like the one before, but like the one before that. The machine itself, run for
// 300 turns, gives the time of its last ones.
TEST(Orbit, AMotionThatRepeatsAfterTwoCyclesOnly) {
  const Scene scene = scene_from(R"(
line = ["motor", "flywheel", "belt", "press"]
motor = { kind = "induction motor", rated_power = "101.15 W", rated_speed = "11.463 rad/s", synchronous_speed = "12.068 rad/s", breakdown_ratio = 2.38, inertia = "0.070837 kg*m2" }
flywheel = { kind = "flywheel", inertia = "0.20879 kg*m2" }
belt = { kind = "belt", diameter_in = "200 mm", diameter_out = "200 mm", friction_coefficient = 0.4, wrap_angle = "160 deg", pretension = "547.03 N", stiffness = "557.73 N*m/rad", damping_ratio = 0.05 }
press = { kind = "slider-crank", radius = "0.08235 m", rod = "0.40675 m", crank_inertia = "0.045247 kg*m2", slider_mass = "0.45907 kg", load = { kind = "press", nominal_force = "895.01 N", nominal_travel = "0.02738 m", rise = "0.002738 m" } }
[effects]
elasticity = true
)");
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  std::array<double, 4> passed{};  // turns 297 … 300
  State state{0, equations.start(0), equations.modes()};
  for (std::size_t k = 0; k < passed.size(); ++k) {
    RunOptions run{
        .tolerance = 1e-9, .method = "auto", .until = 1000, .budget = 60, .interrupted = nullptr, .progress = {}};
    run.from = {state.t, state.y};
    run.stop = [&](double, std::span<const double> y) {
      return 2 * pi * (297.0 + static_cast<double>(k)) -
             equations.angle_with_turns(static_cast<std::size_t>(model->reduction_angle), y);
    };
    const RunOutcome outcome = integrate(equations, run, {});
    ASSERT_TRUE(outcome.stopped);
    state = {outcome.t, outcome.state, equations.modes()};
    passed[k] = outcome.t;
  }
  const double first = passed[1] - passed[0], second = passed[2] - passed[1], third = passed[3] - passed[2];
  ASSERT_GT(std::abs(second - first), 1e-3 * first);
  ASSERT_NEAR(third, first, 1e-6 * first);
  const Orbit orbit = find_orbit(model, {});
  ASSERT_EQ(orbit.kind, Orbit::Kind::cycle) << orbit.words;
  EXPECT_TRUE(orbit.polished);
  EXPECT_EQ(orbit.map->options().cycles, 2);
  EXPECT_NEAR(orbit.point.turned, 4 * pi, 1e-9);
  EXPECT_NEAR(orbit.point.time, first + second, 1e-6 * first);
  // With two cycles requested, it is the same motion, in the same number of cycles.
  EXPECT_NEAR(orbit.point.time, find_orbit(model, {.cycles = 2}).point.time, 1e-9);
  EXPECT_EQ(find_orbit(model, {.cycles = 3, .most_periods = 40}).cycles, 120);  // no multiple of two
}

}  // namespace
}  // namespace kurbel::test::orbit_test
