// switched_loads_test.cpp — an operating sequence switches the loads of a mechanism: a press that strikes every third time, a
// compressor whose valves are held open, held against energies in closed form and against the machine without loads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/find_by.h"
#include "studies/forces/forces.h"
#include "tests/published/published.h"
#include "tests/support/files.h"

namespace kurbel::switched_loads_test {
namespace {

using test::figure;
using test::run;
using test::with;

constexpr double pi = std::numbers::pi;

// A flywheel alone moves a slider against 200 N, both ways.
const std::string crank = R"(
line = ["wheel", "crank"]
[wheel]
kind = "flywheel"
inertia = "2 kg*m2"
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.5 kg*m2"
slider_mass = "3 kg"
load = { kind = "opposing", force = "200 N" }
[run]
start = { speed = "30 rad/s" }
until = "2 s"
accuracy = 1e-9
)";

double inertia(double phi) {
  const double s = std::sin(phi), c = std::cos(phi), sin_b = 0.1 / 0.35 * s;
  const double slope = -0.1 * s - 0.35 * sin_b * (0.1 * c / (0.35 * std::sqrt(1 - sin_b * sin_b)));
  return 2.5 + 3 * slope * slope;
}
double position(double phi) { return 0.1 * std::cos(phi) + std::sqrt(0.35 * 0.35 - std::pow(0.1 * std::sin(phi), 2)); }

// Way of the slider from 270° on, both strokes counted.
double way_from_270(double phi) {
  double way = 0;
  for (double end = 2 * pi, from = 1.5 * pi; from < phi; from = end, end += pi)
    way += std::abs(position(std::min(phi, end)) - position(from));
  return way;
}

// Loaded from 270° for one turn, then off for two: ½ I ω² + F·(way under load) stays.
TEST(SwitchedLoads, EveryThirdStrokeTakesItsWork) {
  const Result r = run(crank + R"(
[sequence]
repeat = true
steps = [
  { angle = "270 deg", of = "crank", set = "crank", to = 1 },
  { angle = "270 deg", of = "crank", set = "crank", to = 0 },
  { angle = "270 deg", of = "crank", set = "crank", to = 0 },
]
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double phi = figure(r, "final_angle.crank"), speed = figure(r, "final_speed.crank");
  // On from the start until the first step that switches off: the first at 270° changes nothing.
  double way = way_from_270(1.5 * pi + 2 * pi);                                               // 270° … 630°
  way += std::abs(position(pi) - position(0)) + std::abs(position(1.5 * pi) - position(pi));  // 0 … 270°
  for (double begin = (270 + 3 * 360) * pi / 180; begin < phi; begin += 6 * pi)
    way += way_from_270(1.5 * pi + std::min(2 * pi, phi - begin));
  EXPECT_GT(phi, (270 + 4 * 360) * pi / 180);
  const double energy = 0.5 * inertia(0) * 900;
  EXPECT_NEAR(0.5 * inertia(phi) * speed * speed, energy - 200 * way, 1e-7 * energy);
  EXPECT_NEAR(figure(r, "work.useful"), -200 * way, 1e-6 * 200 * way);
  EXPECT_LT(r.energy.relative, 1e-9);
}

// Off from the start it is the machine without loads.
TEST(SwitchedLoads, OffTheyAreNotThere) {
  const std::string off = crank + "[sequence]\nsteps = [{ at = \"0 s\", set = \"crank\", to = 0 }]\n";
  const std::string none = with(crank, "load = { kind = \"opposing\", force = \"200 N\" }\n", "");
  const Result a = run(off), b = run(none);
  ASSERT_TRUE(a.complete && b.complete) << a.diagnosis << b.diagnosis;
  EXPECT_NEAR(figure(a, "final_speed.crank"), figure(b, "final_speed.crank"), 1e-10 * 30);
  EXPECT_EQ(figure(a, "work.useful"), 0);
}

// What `forces` says of a crank whose load is left off is what it says of one without.
TEST(SwitchedLoads, ForcesAreThoseOfTheMachineAsItIsLeft) {
  const std::string driven = with(crank, "[wheel]\nkind = \"flywheel\"",
                                  "[wheel]\nkind = \"dc shunt motor\"\nstall_torque = \"60 N*m\"\nno_load_speed = "
                                  "\"40 rad/s\"");
  const std::string none = with(driven, "load = { kind = \"opposing\", force = \"200 N\" }\n", "");
  ForcesOptions options;
  options.speed = 20;  // else each takes the speed that it runs at
  const Forces off = find_forces(
      test::scene_from(driven + "[sequence]\nsteps = [{ at = \"1 s\", set = \"crank\", to = 0 }]\n"), options);
  const Forces without = find_forces(test::scene_from(none), options);
  ASSERT_TRUE(off.simulated && without.simulated);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(off.prescribed->reaction(k).value, without.prescribed->reaction(k).value, 1e-9 * 3000);
    EXPECT_NEAR(off.simulated->reaction(k).value, without.simulated->reaction(k).value, 1e-6 * 3000);
  }
  EXPECT_NE(off.notes.front().find("switched off"), std::string::npos);
}

// Of 70 loads the last is off: whatever a word of the machine holds, none stands for another.
TEST(SwitchedLoads, OfManyEachIsSwitchedByItself) {
  const std::string one = "load = { kind = \"opposing\", force = \"200 N\" }";
  std::string list;
  for (int k = 1; k <= 70; ++k)
    list += fmt::format("{{ kind = \"constant\", force = \"{} N\" }}, ", k == 6 ? 1000 : k == 70 ? 500 : 10);
  const Scene many = test::scene_from(with(crank, one, "load = [" + list + "]") +
                                      "[sequence]\nsteps = [{ at = \"0 s\", set = \"crank.load70\", to = 0 }]\n");
  const Scene sum = test::scene_from(with(crank, one, "load = { kind = \"constant\", force = \"1680 N\" }"));
  const Forces as_many = find_forces(many, {}), as_one = find_forces(sum, {});
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(as_many.prescribed->reaction(k).value, as_one.prescribed->reaction(k).value, 1e-9 * 3000);
  ASSERT_TRUE(as_many.simulated && as_one.simulated);
  EXPECT_NEAR(as_many.simulated->torque.value, as_one.simulated->torque.value, 1e-6 * 200);
}

// A motor that starts against them, or without: valves held open for half a second.
TEST(SwitchedLoads, StartWithoutThemIsFaster) {
  const std::string text = with(with(crank, "[wheel]\nkind = \"flywheel\"",
                                     "[wheel]\nkind = \"dc shunt motor\"\nstall_torque = \"60 N*m\"\nno_load_speed = "
                                     "\"40 rad/s\""),
                                "start = { speed = \"30 rad/s\" }", "start = \"rest\"");
  const Result against = run(text);
  const Result without =
      run(text +
          "[sequence]\nsteps = [{ at = \"0 s\", set = \"crank\", to = 0 }, { at = \"1 s\", set = \"crank\", to = 1 "
          "}]\n");
  ASSERT_TRUE(against.complete && without.complete);
  const auto speed_at = [](const Result& r, double t) {
    const auto w = test::series(r, "speed.crank");
    return w[static_cast<std::size_t>(std::lround(t / 2 * static_cast<double>(w.size() - 1)))];
  };
  EXPECT_GT(speed_at(without, 0.9), 1.05 * speed_at(against, 0.9));
  const Result never = run(text + "[sequence]\nsteps = [{ at = \"0 s\", set = \"crank\", to = 0 }]\n");
  EXPECT_EQ(speed_at(without, 0.9), speed_at(never, 0.9));
  EXPECT_LT(speed_at(without, 2), 0.97 * speed_at(never, 2));
}

// One of two loads goes at 270° for good: ½ I ω² + Σ F·(way under it) stays.
TEST(SwitchedLoads, OneByOneTheyTakeTheirOwnWork) {
  const std::string two = with(crank, "load = { kind = \"opposing\", force = \"200 N\" }",
                               "load = [{ kind = \"opposing\", force = \"200 N\" }, { kind = \"opposing\", force = "
                               "\"90 N\", work = \"harmful\" }]");
  const Result r = run(two + R"(
[sequence]
steps = [
  { angle = "270 deg", of = "crank", set = "crank.load2", to = 0 },
  { angle = "270 deg", of = "crank", set = "crank.load1", to = 0 },
  { angle = "270 deg", of = "crank", set = "crank.load1", to = 1 },
]
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double phi = figure(r, "final_angle.crank"), speed = figure(r, "final_speed.crank");
  EXPECT_GT(phi, (270 + 3 * 360) * pi / 180);
  const double until_270 = std::abs(position(pi) - position(0)) + std::abs(position(1.5 * pi) - position(pi));
  const double turn = way_from_270(1.5 * pi + 2 * pi);
  const double way1 = until_270 + turn + way_from_270(phi - 4 * pi), way2 = until_270;
  const double energy = 0.5 * inertia(0) * 900;
  EXPECT_NEAR(0.5 * inertia(phi) * speed * speed, energy - 200 * way1 - 90 * way2, 1e-8 * energy);
  EXPECT_NEAR(figure(r, "work.useful"), -200 * way1, 1e-8 * 200 * way1);
  EXPECT_NEAR(figure(r, "work.harmful"), -90 * way2, 1e-8 * 90 * way2);
  EXPECT_LT(r.energy.relative, 1e-9);
}

// A load acts where neither its mechanism nor itself was commanded off.
TEST(SwitchedLoads, TheMechanismsCommandAndTheLoadsOwnBothCount) {
  const std::string two = with(crank, "load = { kind = \"opposing\", force = \"200 N\" }",
                               "load = [{ kind = \"opposing\", force = \"200 N\" }, { kind = \"medium\", viscous = "
                               "\"30 N*s/m\" }]");
  const auto speed = [](const std::string& text) {
    const Result r = run(text);
    EXPECT_TRUE(r.complete) << r.diagnosis;
    return figure(r, "final_speed.crank");
  };
  const auto reported = [&](const std::string& steps) { return speed(two + "[sequence]\nsteps = [" + steps + "]\n"); };
  const std::string off = R"({ at = "0 s", set = "crank", to = 0 }, )";
  const double none = speed(with(crank, "load = { kind = \"opposing\", force = \"200 N\" }\n", ""));
  const double second = speed(with(crank, "load = { kind = \"opposing\", force = \"200 N\" }",
                                   "load = { kind = \"medium\", viscous = \"30 N*s/m\" }"));
  EXPECT_NEAR(reported(off + R"({ at = "0.1 s", set = "crank.load1" })"), none, 1e-9 * 30);
  EXPECT_NEAR(reported(R"({ at = "0 s", set = ["crank.load1", "crank.load2"], to = 0 })"), none, 1e-9 * 30);
  EXPECT_NEAR(reported(R"({ at = "0 s", set = "crank.load1", to = 0 })"), second, 1e-9 * 30);
  EXPECT_NEAR(reported(off + R"({ at = "0 s", set = "crank.load1", to = 0 }, { at = "0 s", set = "crank" })"), second,
              1e-9 * 30);
}

// With a rod that bends the element is another one.
TEST(SwitchedLoads, OneByOneUnderARodThatBends) {
  const std::string briefly = with(crank, "until = \"2 s\"", "until = \"0.5 s\"");  // two turns and a half
  const std::string bends = with(briefly, "load = { kind = \"opposing\", force = \"200 N\" }", R"(rod_mass = "2 kg"
rod_flexibility = { modulus = "206 GPa", height = "12 mm", width = "20 mm", modes = 1, damping_ratio = 0.02 }
load = [LOADS])");
  const std::string
      two = with(
          bends, "LOADS",
          R"({ kind = "constant", force = "150 N" }, { kind = "medium", viscous = "30 N*s/m", work = "harmful" })"),
      second = with(bends, "LOADS", R"({ kind = "medium", viscous = "30 N*s/m", work = "harmful" })");
  const Result off = run(two + "[sequence]\nsteps = [{ at = \"0 s\", set = \"crank.load1\", to = 0 }]\n"),
               without = run(second);
  ASSERT_TRUE(off.complete && without.complete) << off.diagnosis << without.diagnosis;
  EXPECT_NEAR(figure(off, "final_speed.crank"), figure(without, "final_speed.crank"), 1e-8 * 30);
  EXPECT_EQ(figure(off, "work.useful"), 0);
}

// A press that strikes every third time: the reactions of the machine's own motion are those with the load only where it
// is on. Work of the stroke in closed form; the torque on the crank by the machine's own equations.
TEST(SwitchedLoads, ForcesOfARepeatedSequenceHaveTheLoadsAsTheyCome) {
  const Scene scene = read_scene(test::source_path("tests/agreement/press_every_third.toml"), all_kinds());
  const Forces f = find_forces(scene, {});
  ASSERT_TRUE(f.simulated) << f.diagnosis;
  EXPECT_NEAR(f.simulated->cycle, 6 * pi, 1e-9);
  const double stroke = 1500 * (0.060 - 0.5 * 0.005);
  const auto* const load = find_by(f.simulated->work, &CycleWork::name, "crank.load");
  ASSERT_NE(load, nullptr);
  EXPECT_NEAR(load->work.value, -stroke, 1e-6 * stroke);
  EXPECT_LT(*f.simulated->machine_residual, 1e-7);
  EXPECT_NE(f.notes.front().find("within its repetition"), std::string::npos) << f.notes.front();
}

}  // namespace
}  // namespace kurbel::switched_loads_test
