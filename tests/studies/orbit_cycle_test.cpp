// orbit_cycle_test.cpp — size and reduce by the steady cycle that a machine really has: closed forms, agreement with
// the rigid machine where nothing goes beyond it, and the demanded δ in the steady motion of the sized machine.
#include "studies/cycle/orbit_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "engine/return_map/periodicity.h"
#include "studies/cycle/classical.h"
#include "studies/reduce/reduce.h"
#include "studies/size/size.h"
#include "studies/steady/steady.h"
#include "tests/published/published.h"

namespace kurbel::orbit_cycle_test {
namespace {

constexpr double pi = std::numbers::pi;

OrbitCycle cycle_of_scene(const Scene& scene, const std::vector<int>& nodes = {}) {
  return orbit_cycle(find_orbit(compile(scene, scene.effects), {}), nodes);
}

// A motor drives a fan through a limiter that slips for ever: each side has a speed of its own.
const char* const slipping = R"(
line    = ["motor", "limiter", "fan"]
motor   = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.5 kg*m2" }
limiter = { kind = "torque limiter", torque = "10 N*m", slipping_part = 0.9 }
fan     = { kind = "load", quadratic = "0.05 N*m*s2/rad2", inertia = "0.6 kg*m2" }
)";

// The motor: 60 (1 − ω/40) = 9, the fan: 0.05 ω² = 9.
TEST(OrbitCycle, LoadBehindASlippingLimiterIsItsLimit) {
  const MachineReduction r = reduce(test::scene_from(slipping), {});
  EXPECT_EQ(r.basis, CycleBasis::steady);
  const double motor = 34, fan = std::sqrt(9 / 0.05);
  EXPECT_NEAR(r.speed, motor, 1e-9 * motor);
  EXPECT_NEAR(r.mean_drive.value, 9, 1e-9);
  EXPECT_NEAR(r.mean_load.value, 9, 1e-9);  // of which the limiter takes the slip's share
  for (const ReducedPosition& p : r.positions) {
    EXPECT_NEAR(p.inertia, 0.5 + 0.6 * fan * fan / (motor * motor), 1e-9);
    EXPECT_NEAR(p.slope, 0, 1e-9);
  }
  ReduceOptions to_the_fan;
  to_the_fan.to = "fan";
  const MachineReduction behind = reduce(test::scene_from(slipping), to_the_fan);
  EXPECT_NEAR(behind.to_ratio, fan / motor, 1e-9);
  EXPECT_NEAR(behind.positions[3].drive, 9 * motor / fan, 1e-8);
  EXPECT_NEAR(behind.positions[3].inertia, 0.6 + 0.5 * motor * motor / (fan * fan), 1e-8);
}

// dω/dφ = (M − ½ I′ ω²)/(I ω) and dt = dφ/ω by Runge and Kutta's fourth order from edge to edge, on the rigid machine's own
// functions: a second source, with no step of the engine's.
struct CycleOfEnergy {
  double end, time = 0, fastest, slowest;
};
CycleOfEnergy cycle_of_energy(RigidMachine& machine, double speed) {
  constexpr int steps = 8000;  // from edge to edge; extremes at the steps
  CycleOfEnergy r{.end = speed, .fastest = speed, .slowest = speed};
  const std::vector<double> edges = cycle_edges(machine);
  for (std::size_t piece = 0; piece + 1 < edges.size(); ++piece) {
    const double h = (edges[piece + 1] - edges[piece]) / steps;
    machine.set_modes(0.5 * (edges[piece] + edges[piece + 1]), r.end);
    const auto slope = [&](double phi, double w) {
      const RigidMachine::At at = machine.at(phi, w);
      return (at.torque - 0.5 * at.slope * w * w) / (at.inertia * w);
    };
    for (int k = 0; k < steps; ++k) {
      const double phi = edges[piece] + h * k, w = r.end;
      const double a = slope(phi, w), b = slope(phi + h / 2, w + h / 2 * a), c = slope(phi + h / 2, w + h / 2 * b),
                   d = slope(phi + h, w + h * c);
      r.end = w + h / 6 * (a + 2 * b + 2 * c + d);
      r.time += h / 6 * (1 / w + 2 / (w + h / 2 * a) + 2 / (w + h / 2 * b) + 1 / (w + h * c));
      r.fastest = std::max(r.fastest, r.end), r.slowest = std::min(r.slowest, r.end);
    }
  }
  return r;
}

// A press on a motor, all rigid: along its cycle the reduced inertia is that of the rigid machine, and the works of
// drive and load are equal.
TEST(OrbitCycle, OfARigidMachineHasItsInertiaAndItsLoad) {
  const Scene scene = test::scene_from(R"(
line  = ["motor", "press"]
motor = { kind = "dc shunt motor", stall_torque = "1200 N*m", no_load_speed = "9 rad/s", inertia = "40 kg*m2" }
press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", rod_mass = "8 kg", rod_com = "70 mm", rod_inertia = "0.05 kg*m2", slider_mass = "80 kg", load = { kind = "press", nominal_force = "60 kN", nominal_travel = "10 mm", rise = "2 mm" } }
)");
  EXPECT_TRUE(beyond_the_rigid_machine(scene).empty());
  const OrbitCycle c = cycle_of_scene(scene);
  EXPECT_NEAR(c.way(), 2 * pi, 1e-12);
  RigidMachine machine(scene);
  for (const double phi : {0.1, 1.3, 2.9, 3.6, 5.2, 6.1}) {
    const double inertia = machine.constant_inertia() + machine.mechanism_inertia(phi).value;
    EXPECT_NEAR(c.inertia.value(phi), inertia, 1e-9 * inertia);
    machine.set_modes(phi, 8);
    double load = 0;
    const RigidMachine::At at = machine.at(phi, 8, true);
    for (std::size_t a = 0; a < at.share.size(); ++a)
      if (machine.model().accounts[a].kind != Account::driving) load -= at.share[a];
    EXPECT_NEAR(c.cycle.load.value(phi), load, 1e-7 * 5000) << phi;
  }
  EXPECT_NEAR(c.cycle.load.total(), 60e3 * (0.010 - 0.001), 1e-6);
  EXPECT_NEAR(c.cycle.drive.total(), c.cycle.load.total(), 1e-6);
  const CycleOfEnergy exact = cycle_of_energy(machine, c.speed.value(0));
  EXPECT_NEAR(exact.end, c.speed.value(0), 1e-9 * exact.end);
  EXPECT_NEAR(c.fastest.value, exact.fastest, 1e-8 * exact.fastest);
  EXPECT_NEAR(c.slowest.value, exact.slowest, 1e-8 * exact.slowest);
  const double delta = 2 * (exact.fastest - exact.slowest) / (exact.fastest + exact.slowest);
  EXPECT_NEAR(c.delta(), delta, 1e-8 * delta);
  EXPECT_NEAR(c.time, exact.time, 1e-9 * exact.time);
}

// A steady cycle takes ∮dφ/ω.
TEST(OrbitCycle, TakesTheTimeOfItsSpeed) {
  const OrbitCycle cycle = cycle_of_scene(test::scene_from(R"(
line = ["motor", "pump"]
motor = { kind = "dc shunt motor", stall_torque = "300 N*m", no_load_speed = "12 rad/s", inertia = "3 kg*m2" }
pump = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", slider_mass = "60 kg", load = { kind = "opposing", force = "300 N" } }
)"));
  constexpr int n = 4000;
  double time = 0;
  for (int k = 0; k < n; ++k) time += 2 * pi / n / cycle.speed.value(2 * pi * (k + 0.5) / n);
  EXPECT_NEAR(cycle.time, time, 1e-5 * time);
  // The work of the load: 4 r F a turn; the motor's mean torque over time is that of the mean speed over time.
  EXPECT_NEAR(cycle.cycle.drive.total(), 120, 1e-7);
}

// Either basis gives the same flywheel where the motor's slope is next to nothing: a rectangular load over angle needs
// ΔA/(ω² δ) with ΔA = (M_1 − M_m) φ_1.
TEST(OrbitCycle, RectangularLoadNeedsTheFlywheelOfItsArea) {
  const double high = 300, low = 60, part = 1.0, mean = (high * part + low * (2 * pi - part)) / (2 * pi);
  const std::string text = fmt::format(R"(
line   = ["motor", "wheel", "work"]
motor  = {{ kind = "dc shunt motor", stall_torque = "{2} N*m", no_load_speed = "{3} rad/s", inertia = "0.1 kg*m2" }}
wheel  = {{ kind = "flywheel", inertia = "40 kg*m2" }}
work   = {{ kind = "load", table = {{ over = "angle", unit = ["rad", "N*m"], points = [[0, {1}], [0.5, {1}], [0.5001, {0}], [1.5, {0}], [1.5001, {1}], [{4}, {1}]], period = "360 deg" }} }}
)",
                                       high, low, mean + 20 * 4.0, 20 + mean / 4, test::digits(2 * pi));
  SizeOptions options;
  options.delta = 0.05, options.simulate = false, options.basis = CycleBasis::steady;
  const Sizing s = size_flywheel(test::scene_from(text), options);
  EXPECT_EQ(s.basis, CycleBasis::steady);
  const double area = (high - mean) * part;
  EXPECT_NEAR(s.diagram.fluctuation(), area, 3e-4 * area);
  EXPECT_NEAR(s.exact.inertia, area / (s.mid_speed * s.mid_speed * 0.05), 3e-4 * s.exact.inertia);
  ASSERT_TRUE(s.methods.front().flywheel.error);
  EXPECT_LT(*s.methods.front().flywheel.error, 1e-5 * s.exact.inertia);
}

// What is said to meet the demanded δ has it: the steady motion of the scene with that flywheel, from the scene's own start.
TEST(OrbitCycle, FlywheelThatMeetsTheDemandHasItInTheSteadyCycle) {
  for (const char* name : {"gearbox_losses_crank", "rubber_branches_crank", "governor_crank"}) {
    const Scene scene = test::scene_file(fmt::format("tests/agreement/{}.toml", name));
    SizeOptions options;
    options.delta = 0.012;
    const Sizing s = size_flywheel(scene, options);
    ASSERT_TRUE(s.complete) << name << s.diagnosis;
    ASSERT_TRUE(s.meeting) << name << s.meeting_words;
    ASSERT_TRUE(s.meeting->flywheel.error && s.reached.back().crank.error) << name;
    const Scene sized = with_flywheel(scene, s.flywheel, s.meeting->flywheel.value, s.link);
    const OrbitCycle c = cycle_of_scene(sized);
    EXPECT_NEAR(c.delta(), 0.012, 2e-5 * 0.012) << name;
    EXPECT_NEAR(c.delta(), *s.meeting->delta, *s.reached.back().crank.error + 1e-8 * 0.012) << name;
    // What the work equation omits is said with its size.
    EXPECT_NE(s.notes.back().find("omits"), std::string::npos) << name << s.notes.back();
    // A simulation is said with the flywheel that it had, not with the one that meets the demand.
    const DeltaReached& first = s.reached.front();
    EXPECT_NE(first.flywheel, s.meeting->flywheel.value) << name;
    const std::string said = output_of(s).conclusion();
    const std::size_t at = said.find("Simulated ");
    ASSERT_NE(at, std::string::npos) << said;
    EXPECT_NEAR(std::stod(said.substr(said.find(" with ", at) + 6)), first.flywheel, 1e-3 * first.flywheel) << said;
  }
}

// The vibration of an elastic belt is none of the work equation's, which requires no flywheel.
TEST(OrbitCycle, FlywheelThatOnlyTheElasticMachineNeedsIsProposed) {
  const Scene scene = test::scene_file("tests/agreement/belt_elastic_crank.toml");
  SizeOptions options;
  options.delta = 0.0317775;
  const Sizing s = size_flywheel(scene, options);
  EXPECT_LE(s.methods.front().flywheel.value, 0);
  EXPECT_TRUE(s.needed);
  ASSERT_TRUE(s.meeting) << s.meeting_words;
  EXPECT_GT(s.meeting->flywheel.value, 0);
  EXPECT_NEAR(*s.meeting->delta, *options.delta, 2e-5 * *options.delta);
  EXPECT_NE(output_of(s).conclusion().find("By the work equation no flywheel is needed"), std::string::npos);
}

// A crank far behind a soft shaft vibrates however heavy the flywheel at the motor is.
TEST(OrbitCycle, DemandThatNoFlywheelMeetsIsReportedWithTheLeast) {
  Scene scene = test::scene_from(R"(
line  = ["motor", "wheel", "shaft", "press"]
motor = { kind = "dc shunt motor", stall_torque = "1200 N*m", no_load_speed = "9 rad/s", inertia = "2 kg*m2" }
wheel = { kind = "flywheel", inertia = "60 kg*m2" }
shaft = { kind = "coupling", stiffness = "9 kN*m/rad", damping_ratio = 0.2 }
press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", slider_mass = "40 kg", load = { kind = "press", nominal_force = "30 kN", nominal_travel = "10 mm", rise = "2 mm" } }
effects = { elasticity = true }
)");
  SizeOptions options;
  options.delta = 0.02;
  const Sizing s = size_flywheel(scene, options);
  EXPECT_FALSE(s.meeting);
  EXPECT_NE(s.meeting_words.find("no flywheel was found"), std::string::npos) << s.meeting_words;
  EXPECT_NE(s.meeting_words.find("the least"), std::string::npos);
}

// Where no search comes to an end, nothing is known of any flywheel, and none of them counts as too light.
TEST(OrbitCycle, ASearchThatFailsProvesNothingOfAFlywheel) {
  const Scene scene = test::scene_file("tests/agreement/rubber_branches_crank.toml");
  SizeOptions options;
  options.delta = 0.012;
  const Sizing s = size_flywheel(scene, options);
  SizedOrbits::Parts parts{s.flywheel, s.link, s.motor, {}};
  const Watch watch = {};
  const SizedOrbit first =
      SizedOrbits(scene, parts, watch).at(s.methods.front().flywheel.value, scene.effects, {}, false);
  ASSERT_TRUE(first.found) << first.why;
  parts.most_periods = 0;
  const SizedOrbits::Meeting m =
      SizedOrbits(scene, parts, watch).meeting(0.5 * first.crank.value, first, s.motor_inertia, scene.effects, 1e-5);
  EXPECT_FALSE(m.orbit);
  EXPECT_NE(m.unknown.find("kg·m²: after 0 cycles"), std::string::npos) << m.unknown;
  EXPECT_EQ(m.least, first.crank.value);
}

// A press that is declutched in the end: while the clutch is in, it has a cycle, which is taken if none is requested.
TEST(OrbitCycle, PressWithItsClutchInIsSizedAsItIsThen) {
  const Scene scene = test::scene_file("scenes/press_drive.toml");
  SizeOptions sizing;
  sizing.delta = 0.03, sizing.simulate = false;
  const Sizing by_itself = size_flywheel(scene, sizing);
  EXPECT_FALSE(by_itself.notes.empty());
  sizing.at.after_step = 3;
  const Sizing s = size_flywheel(scene, sizing);
  EXPECT_EQ(s.methods.front().flywheel.value, by_itself.methods.front().flywheel.value);
  EXPECT_EQ(s.basis, CycleBasis::steady);
  EXPECT_TRUE(s.needed);
  ReduceOptions reducing;
  reducing.at.after_step = 3;
  const MachineReduction r = reduce(scene, reducing);
  EXPECT_EQ(r.basis, CycleBasis::steady);
  EXPECT_NEAR(r.mean_drive.value, r.mean_load.value, 1e-6 * r.mean_load.value);
}

TEST(OrbitCycle, RefusalsAreOfPhysics) {
  // Held by nothing: the fan's brake is stronger than the motor.
  const std::string held = test::with(slipping, "quadratic = \"0.05 N*m*s2/rad2\"", "torque = \"20 N*m\"");
  const Scene stands =
      test::scene_from(test::with(held, "torque = \"10 N*m\", slipping_part = 0.9", "torque = \"90 N*m\""));
  SizeOptions options;
  options.delta = 0.05;
  options.basis = CycleBasis::steady;
  // It turns steadily, and a smooth load needs no flywheel.
  EXPECT_FALSE(size_flywheel(stands, options).needed);
  const Scene stalled = test::scene_from(test::with(
      test::with(held, "torque = \"10 N*m\", slipping_part = 0.9", "torque = \"90 N*m\""), "20 N*m", "70 N*m"));
  try {
    size_flywheel(stalled, options);
    ADD_FAILURE() << "a machine at rest has no cycle";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("stands from its start on"), std::string::npos) << error.what();
  }
  // Its inertia is what it is.
  const MachineReduction r = reduce(stalled, {});
  EXPECT_EQ(r.basis, CycleBasis::classical);
  EXPECT_NEAR(r.positions.front().inertia, 1.1, 1e-12);
  EXPECT_NE(r.notes.front().find("no steady cycle"), std::string::npos);
}

// The classical basis is one option, and says what it omits.
TEST(OrbitCycle, ClassicalBasisSaysWhatItLeavesOut) {
  const Scene scene = test::scene_file("tests/agreement/gearbox_losses_crank.toml");
  SizeOptions options;
  options.delta = 0.012, options.basis = CycleBasis::classical;
  const Sizing s = size_flywheel(scene, options);
  EXPECT_EQ(s.basis, CycleBasis::classical);
  const auto said = [&](const char* words) {
    return std::any_of(s.notes.begin(), s.notes.end(),
                       [&](const std::string& note) { return note.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(said("classical: gear losses"));
}

// Four cylinders without a mechanism, rigid: what run reports of its last cycle is what steady finds by Newton's
// method. Mean speed by the governor: 1500 1/min where nothing is left to regulate.
TEST(OrbitCycle, OfAnEngineWithoutAMechanismIsThatOfTheRun) {
  Scene scene = test::scene_file("docs/tasks/genset.toml");
  scene.effects = without_elasticity(scene.effects);
  scene.run.until = 20;
  const Result r = test::run(scene);
  SteadyOptions options;
  options.start_search = false;
  const SteadyStudy study = steady(scene, {scene.effects}, options);
  ASSERT_TRUE(r.complete && !study.cycles.empty() && study.cycles.front().found);
  const auto& found = study.cycles.front().figures;
  for (const std::string name : {"mean_speed.damper", "delta.damper"}) {
    const Figure* const figure = find(found, name);
    ASSERT_NE(figure, nullptr) << name;
    ASSERT_NE(r.find(name), nullptr) << name;
    EXPECT_NEAR(r.find(name)->value, figure->value, *r.find(name)->error + *figure->error + 1e-7 * figure->value)
        << name;
  }
  EXPECT_TRUE(r.periods.steady);
}

// A machine has a cycle where, and only where, some law of it depends on an angle.
TEST(OrbitCycle, IsThatOfTheLawsOverAnAngleInEveryScene) {
  int with = 0, without = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes"))) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = read_scene(entry.path().string(), all_kinds());
    const auto model = compile(scene, scene.effects);
    Periodicity period;
    try {
      period = periodicity_of(*model);
    } catch (const std::invalid_argument&) {
      continue;  // what never meets
    }
    EXPECT_EQ(model->cycle > 0, period.angle_matters) << scene.file;
    if (period.angle_matters && model->cycle > 0) {
      const double rounds = model->cycle / period.angle;
      EXPECT_NEAR(rounds, std::round(rounds), 1e-8) << scene.file << ": whole rounds of the laws";
    }
    ++(period.angle_matters ? with : without);
  }
  EXPECT_GT(with, 15);
  EXPECT_GT(without, 5);
}

}  // namespace
}  // namespace kurbel::orbit_cycle_test
