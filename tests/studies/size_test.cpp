// size_test.cpp — the flywheel for a demanded δ: what was sized is what runs, rigid and elastic; the motor's slope; bad
// input.
#include "studies/size/size.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "studies/cycle/orbit_cycle.h"
#include "studies/report/render.h"
#include "studies/run/compare.h"
#include "tests/published/published.h"
#include "tests/support/steady_simulation.h"

namespace kurbel::size_test {
namespace {

constexpr double pi = std::numbers::pi;

// A press on a straight motor; the slope of the motor is stall torque over no-load speed.
std::string press(const std::string& motor, const std::string& flywheel = "60 kg*m2", const std::string& start = "") {
  return R"(
title = "press"
line  = ["motor", "coupling", "wheel", "press"]
motor    = { )" +
         motor + R"(, inertia = "2 kg*m2" }
coupling = { kind = "coupling", stiffness = "90 kN*m/rad", damping_ratio = 0.05, inertia_in = "0.2 kg*m2", inertia_out = "0.3 kg*m2" }
wheel    = { kind = "flywheel", inertia = ")" +
         flywheel + R"(" }
press    = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", rod_mass = "8 kg", rod_com = "70 mm", rod_inertia = "0.05 kg*m2", slider_mass = "80 kg", load = { kind = "press", nominal_force = "60 kN", nominal_travel = "10 mm", rise = "2 mm" } }
effects  = { elasticity = ["coupling"] }
)" + start;
}
std::string straight(double stall, double no_load) {
  return fmt::format("kind = \"dc shunt motor\", stall_torque = \"{} N*m\", no_load_speed = \"{} rad/s\"", stall,
                     no_load);
}

SizeOptions demand(double delta, bool simulate = false) {
  SizeOptions options;
  options.delta = delta;
  options.simulate = simulate;
  return options;
}

const DeltaReached& reached(const Sizing& s, const std::string& model, const std::string& by) {
  for (const DeltaReached& r : s.reached)
    if (name_of(r.model) == model && r.sized_by == by) return r;
  throw std::runtime_error("not simulated: " + model + ", " + by);
}

// δ of the rigid machine with this flywheel, by a run until its cycles repeat.
double simulated_delta(const Scene& scene, const Sizing& s, double flywheel) {
  const Scene sized = with_flywheel(scene, s.flywheel, flywheel, s.link);
  const test::SteadySimulation run =
      test::simulate_steady(sized, rigid_twin(*compile(sized, scene.effects)), s.soft_speed, 2 * pi, 0, {});
  EXPECT_TRUE(run.complete && run.settled) << run.diagnosis;
  return run.link_delta;
}

std::string refusal(const std::string& scene, const SizeOptions& options) {
  try {
    size_flywheel(test::scene_from(scene), options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Size, ConstantDriveTorqueGivesTheDemandedDeltaInSimulation) {
  SizeOptions options = demand(0.06, true);
  options.mid_speed = 8.0;
  // The torque that balances the load, from a first sizing; then the same scene with it.
  const std::string source = "kind = \"torque source\", torque = \"{} N*m\"";
  options.simulate = false;
  const Sizing first = size_flywheel(test::scene_from(press(fmt::format(fmt::runtime(source), 1e4))), options);
  options.simulate = true;
  const std::string torque = test::digits(first.diagram.mean_torque());
  const Sizing s = size_flywheel(test::scene_from(press(fmt::format(fmt::runtime(source), torque))), options);
  EXPECT_NEAR(*s.methods[0].delta, 0.06, 1e-12);
  const DeltaReached& rigid = reached(s, "rigid, simulated", "Wittenbauer");
  EXPECT_NEAR(rigid.crank.value, 0.06, 1e-7);
  EXPECT_NEAR(rigid.crank.value, 0.06, 3 * *rigid.crank.error + 1e-9);
  EXPECT_NEAR(rigid.mid_speed, 8.0, 1e-6);
  // The inertia by hand: work of the blow from the constant torque, neglecting I_em, is near.
  EXPECT_NEAR(s.methods[2].drive_inertia * 64 * 0.06, s.diagram.fluctuation(), 1e-9);
  EXPECT_NEAR(s.diagram.work, 60e3 * (0.010 - 0.001), 1e-6);  // the force rises over 2 mm: half of them count
}

TEST(Size, SimulatedPressReachesWhatTheSlopeOfItsMotorLeavesOfDelta) {
  const Scene scene = test::scene_from(press(straight(1200, 9)));
  const Sizing s = size_flywheel(scene, demand(0.1, true));
  ASSERT_TRUE(s.soft);
  const DeltaReached& exact = reached(s, "rigid, simulated", "Wittenbauer");
  EXPECT_LT(exact.crank.value, 0.1);  // a motor that gives way helps
  const DeltaReached& soft = reached(s, "rigid, simulated", "motor's slope counted");
  EXPECT_NEAR(simulated_delta(scene, s, soft.flywheel), 0.1, 1e-6);
  EXPECT_LT(soft.flywheel, exact.flywheel);
  const DeltaReached& elastic = reached(s, "elastic, simulated", "Wittenbauer");
  EXPECT_NE(elastic.crank.value, elastic.motor.value);
}

TEST(Size, SteadyCycleAgreesWithALongSimulation) {
  const Scene scene = test::scene_from(press(straight(900, 9)));
  const OrbitCycle cycle = orbit_cycle(find_orbit(compile(scene, {}), {}));
  const test::SteadySimulation run = test::simulate_steady(scene, Effects{}, 0.8 * cycle.mid_speed(), 2 * pi, 0, {});
  ASSERT_TRUE(run.complete && run.settled);
  EXPECT_NEAR(run.link_delta, cycle.delta(), 1e-5 * cycle.delta());
  EXPECT_NEAR(run.mid_speed, cycle.mid_speed(), 1e-5 * cycle.mid_speed());
  // Energy of the cycle: the motor's work is the blow's.
  EXPECT_NEAR(cycle.cycle.drive.total(), 540, 1e-7);
}

// The torque of an induction motor lags by its fluxes, in the flywheel that its slope leaves as in the motion of it.
TEST(Size, FlywheelWithTheMotorsSlopeHasTheDemandedDeltaWithTheLagOfItsFluxes) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  const Sizing s = size_flywheel(scene, demand(0.1, true));
  ASSERT_TRUE(s.soft) << s.soft_why;
  EXPECT_NEAR(s.soft->flywheel.value, 385, 0.5);
  EXPECT_NEAR(simulated_delta(scene, s, s.soft->flywheel.value), 0.1, 1e-6);
  ASSERT_TRUE(s.soft->flywheel.error);
  EXPECT_LT(*s.soft->flywheel.error, 1e-6 * s.soft->flywheel.value);
}

// A motor that does most of the blow's work itself: without any flywheel δ is below the demanded one.
TEST(Size, MotorThatIsSteepEnoughNeedsNoFlywheel) {
  const Scene scene = test::scene_from(press(straight(30000, 9)));
  const Sizing s = size_flywheel(scene, demand(0.2, true));
  ASSERT_TRUE(s.needed);
  ASSERT_TRUE(s.soft) << s.soft_why;
  EXPECT_TRUE(s.soft->none_needed);
  EXPECT_EQ(s.soft->flywheel.value, 0);
  EXPECT_FALSE(s.soft->flywheel.error);  // of a bound, not of a result
  EXPECT_NEAR(*s.soft->delta, simulated_delta(scene, s, 0), *s.reached.back().crank.error + 1e-5 * *s.soft->delta);
  EXPECT_LT(*s.soft->delta, 0.2);
  const std::string page = html_of(output_of(s).report());
  EXPECT_EQ(page.find("Inertia that gives δ"), std::string::npos);
  EXPECT_NE(page.find("none is needed"), std::string::npos);
  EXPECT_NE(output_of(s).conclusion().find("considered none is needed"), std::string::npos);
}

// A motor that gives way beyond its breakdown stalls with the flywheel of the constant torque: heavier ones are searched.
TEST(Size, PressThatStallsWithTheFlywheelOfTheWorkEquationGetsAHeavierOne) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "press"]
motor = { kind = "motor", torque = { over = "speed", unit = ["rad/s", "N*m"], points = [[0, 60], [6, 120], [8, 160], [9, 0]] }, inertia = "1 kg*m2" }
press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", slider_mass = "80 kg", load = { kind = "press", nominal_force = "60 kN", nominal_travel = "10 mm", rise = "2 mm" } }
)");
  for (const double delta : {0.65, 1.0}) {
    const Sizing s = size_flywheel(scene, demand(delta, true));
    EXPECT_TRUE(s.stalls && s.complete);
    ASSERT_TRUE(s.soft) << s.soft_why;
    EXPECT_GT(s.soft->flywheel.value, s.methods.front().flywheel.value);
    EXPECT_NEAR(simulated_delta(scene, s, s.soft->flywheel.value), delta, 1e-5 * delta);
    EXPECT_EQ(s.chosen().flywheel.value, s.soft->flywheel.value);
    EXPECT_EQ(s.reached.size(), 1u);  // one search, one row
    EXPECT_NE(output_of(s).conclusion().find("the machine stalls with it"), std::string::npos);
  }
}

// A press on a motor of this slope whose operating speed is 8 rad/s.
Scene press_with_slope(double slope) {
  const double mean = 540 / (2 * pi);
  return test::scene_from(press(straight(slope * 8 + mean, 8 + mean / slope)));
}
Sizing sized_with_slope(double slope) { return size_flywheel(press_with_slope(slope), demand(0.1, true)); }

// Ever steeper characteristics: the motor does more of the blow's work itself.
TEST(Size, TheSteeperTheMotorTheSmallerTheFlywheel) {
  double last = HUGE_VAL;
  for (const double slope : {100.0, 200.0, 400.0}) {  // N·m·s/rad
    const Sizing s = sized_with_slope(slope);
    ASSERT_TRUE(s.operating);
    EXPECT_NEAR(s.mid_speed, 8, 1e-9);
    EXPECT_NEAR(s.operating->slope, -slope, 1e-4 * slope);
    ASSERT_TRUE(s.soft) << s.soft_why;
    EXPECT_LT(s.soft->drive_inertia, std::min(last, s.exact.inertia));
    EXPECT_NEAR(simulated_delta(press_with_slope(slope), s, s.soft->flywheel.value), 0.1, 1e-6);
    last = s.soft->drive_inertia;
  }
}

// The limit of a characteristic without slope is the classical case at the mean speed that the machine then has.
TEST(Size, MotorWithoutSlopeNeedsTheFlywheelOfWittenbauer) {
  const auto difference = [](double slope) {
    const Sizing s = sized_with_slope(slope);
    EXPECT_TRUE(s.soft) << s.soft_why;
    const double classical = wittenbauer(s.diagram, s.cycle.mechanism, s.soft_speed, 0.1).inertia;
    return std::abs(s.soft->drive_inertia / classical - 1);
  };
  const double steep = difference(1), half = difference(0.5), soft = difference(0.1);
  EXPECT_LT(steep, 1e-3);
  EXPECT_LT(half, 0.6 * steep + 1e-9);
  EXPECT_LT(soft, 0.3 * half + 1e-9);
}

TEST(Size, FlywheelOnAFasterShaftIsSmallerByTheSquareOfTheRatio) {
  const auto scene = [](const std::string& line) {
    return test::scene_from(R"(
line = )" + line + R"(
motor = { kind = "dc shunt motor", stall_torque = "300 N*m", no_load_speed = "36 rad/s", inertia = "0.1 kg*m2" }
gear  = { kind = "gearbox", stages = [{ teeth = [20, 80], inertia = ["0.02 kg*m2", "0.5 kg*m2"] }] }
wheel = { kind = "flywheel", inertia = "1 kg*m2" }
press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "1 kg*m2", slider_mass = "80 kg", load = { kind = "press", nominal_force = "60 kN", nominal_travel = "10 mm" } }
)");
  };
  const Sizing slow = size_flywheel(scene(R"(["motor", "gear", "wheel", "press"])"), demand(0.1));
  const Sizing fast = size_flywheel(scene(R"(["motor", "wheel", "gear", "press"])"), demand(0.1));
  EXPECT_NEAR(fast.flywheel_ratio, 4, 1e-14);
  EXPECT_NEAR(fast.exact.inertia, slow.exact.inertia, 1e-9 * slow.exact.inertia);
  EXPECT_NEAR(16 * fast.methods[0].flywheel.value, slow.methods[0].flywheel.value, 1e-9 * slow.exact.inertia);
  // theory 3.1 on the flywheel's shaft: the motor by 1.1, the gearbox with both wheels.
  EXPECT_NEAR(slow.methods[0].flywheel_by_parts, slow.exact.inertia - 1.1 * 16 * 0.1 - (0.5 + 16 * 0.02), 1e-10);
  EXPECT_NEAR(fast.methods[0].flywheel_by_parts, slow.exact.inertia / 16 - 1.1 * 0.1 - (0.5 / 16 + 0.02), 1e-11);
  EXPECT_NEAR(slow.methods[0].flywheel.value, slow.exact.inertia - 16 * 0.12 - 0.5, 1e-10);
}

TEST(Size, SceneWithoutAFlywheelGetsOneOnItsCrank) {
  std::string text = press(straight(1200, 9));
  const Sizing with = size_flywheel(test::scene_from(text), demand(0.1, true));
  text =
      test::with(test::with(text, "\"wheel\", ", ""), "wheel    = { kind = \"flywheel\", inertia = \"60 kg*m2\" }", "");
  const Sizing without = size_flywheel(test::scene_from(text), demand(0.1, true));
  EXPECT_TRUE(without.flywheel_added);
  EXPECT_NEAR(without.methods[0].flywheel.value, with.methods[0].flywheel.value, 1e-9 * with.methods[0].flywheel.value);
  EXPECT_NEAR(reached(without, "elastic, simulated", "Wittenbauer").crank.value,
              reached(with, "elastic, simulated", "Wittenbauer").crank.value, 1e-7);
}

TEST(Size, StartAtADeadCentreUnderLoadDoesNotMatterToSteadyMotion) {
  const Sizing at_rest =
      size_flywheel(test::scene_from(press(straight(1200, 9), "60 kg*m2",
                                           "run = { start = { speed = \"0 rpm\", angle = \"0 deg\" } }")),
                    demand(0.1, true));
  const Sizing running = size_flywheel(test::scene_from(press(straight(1200, 9))), demand(0.1, true));
  EXPECT_NEAR(at_rest.methods[0].flywheel.value, running.methods[0].flywheel.value, 1e-9);
  EXPECT_NEAR(reached(at_rest, "elastic, simulated", "Wittenbauer").crank.value,
              reached(running, "elastic, simulated", "Wittenbauer").crank.value, 1e-8);
  ASSERT_FALSE(at_rest.notes.empty());
  EXPECT_NE(at_rest.notes.front().find("steady motion"), std::string::npos);
}

TEST(Size, EngineIsSizedByItsTurningMoment) {
  const Sizing s = size_flywheel(test::scene_file("scenes/single_cylinder_engine.toml"), demand(0.02));
  EXPECT_TRUE(s.engine);
  EXPECT_NEAR(s.cycle.drive.length(), 4 * pi, 1e-12);  // four strokes
  EXPECT_NEAR(*s.methods[0].delta, 0.02, 1e-11);
  EXPECT_GT(s.methods[0].drive_inertia, 0);
}

TEST(Size, EverySceneThatDrivesACycleCanBeSized) {
  for (const char* scene :
       {"crank_press", "piston_pump", "compressor", "knuckle_press", "shaper", "driven_slider_crank"}) {
    const Sizing s = size_flywheel(test::scene_file(fmt::format("scenes/{}.toml", scene)), demand(0.03));
    if (s.methods[0].drive_inertia <= 0) continue;
    ASSERT_TRUE(s.methods[0].delta) << scene;
    EXPECT_NEAR(*s.methods[0].delta, 0.03, 1e-10) << scene;
    const StudyOutput output = output_of(s);
    EXPECT_TRUE(nlohmann::json::accept(output.json())) << scene;
    EXPECT_NE(html_of(output.report()).find("Wittenbauer"), std::string::npos) << scene;
  }
}

TEST(Size, FlywheelThatIsNotNeededIsSaidSo) {
  const std::string heavy =
      test::with(press(straight(1200, 9)), "crank_inertia = \"1 kg*m2\"", "crank_inertia = \"9 kg*m2\"");
  const Sizing s = size_flywheel(test::scene_from(heavy), demand(1.5));
  EXPECT_FALSE(s.needed);
  EXPECT_LE(s.methods[0].flywheel.value, 0);
  EXPECT_NE(output_of(s).conclusion().find("No flywheel is needed"), std::string::npos);
  const Sizing light =
      size_flywheel(test::scene_file("scenes/shaper.toml"), demand(0.3));  // its flywheel is one on the crank
  const double suffices = light.methods[0].drive_inertia;
  EXPECT_NE(output_of(light).conclusion().find(
                fmt::format("of the drive's {:.4g} kg·m² on the shaft of \"shaper\" {:.4g} kg·m² suffice",
                            suffices - light.methods[0].flywheel.value, suffices)),
            std::string::npos)
      << output_of(light).conclusion();
  const Sizing large = size_flywheel(test::scene_from(press(straight(1200, 9), "5000 kg*m2")), demand(0.1));
  EXPECT_NE(output_of(large).text().find(fmt::format("; {:.4g} kg·m² are needed.", large.methods[0].flywheel.value)),
            std::string::npos);
}

// By the work equation 356.8 kg·m² do, simulated elastic 438.1 are needed: what is to be built is the latter, and the
// scene's 420 are too small.
TEST(Size, DimensionsAreThoseOfTheFlywheelThatMeetsTheDemand) {
  const Sizing s = size_flywheel(test::scene_file("scenes/crank_press.toml"), demand(0.1, true));
  ASSERT_TRUE(s.meeting && s.dimensions);
  ASSERT_LT(s.methods.front().flywheel.value, s.flywheel_now);
  ASSERT_GT(s.meeting->flywheel.value, s.flywheel_now);
  EXPECT_NEAR(s.dimensions->inertia, s.meeting->flywheel.value, 1e-9 * s.meeting->flywheel.value);
  EXPECT_NE(output_of(s).text().find(
                fmt::format("; {:.4g} kg·m² are needed with the torques as they are", s.meeting->flywheel.value)),
            std::string::npos);
}

TEST(Size, RefusesAPrescribedSpeed) {
  try {
    size_flywheel(test::scene_file("scenes/stick_slip.toml"), demand(0.025));
    FAIL() << "sized";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("the speed of \"drive\" is prescribed"), std::string::npos)
        << error.what();
  }
}

// The work equation requires none; the elastic shaft does. A flywheel of -48900 kg·m² was stated.
TEST(Size, NoNegativeFlywheelIsStated) {
  const Sizing s = size_flywheel(test::scene_file("scenes/ship_propulsion.toml"), demand(0.025, true));
  const std::string said = output_of(s).conclusion();
  EXPECT_EQ(said.find(" -"), std::string::npos) << said;
  EXPECT_NE(said.find("requires no flywheel"), std::string::npos) << said;
}

TEST(Size, RefusesInWords) {
  const std::string valid = press(straight(1200, 9));
  for (const double delta : {0.0, -0.05, 2.0, 3.0})
    EXPECT_NE(refusal(valid, demand(delta)).find("must be > 0 and < 2"), std::string::npos) << delta;
  EXPECT_NE(refusal(valid, SizeOptions{}).find("--delta 0.05"), std::string::npos);
  // Too weak: 540 J a turn are 85.94 N·m; this motor's best mean torque is its stall torque of 20.
  const std::string weak = refusal(press(straight(20, 9)), demand(0.1));
  EXPECT_NE(weak.find("too weak"), std::string::npos) << weak;
  EXPECT_NE(weak.find("85.94"), std::string::npos) << weak;
  const std::string constant = refusal(press("kind = \"torque source\", torque = \"80 N*m\""), [] {
    SizeOptions o = demand(0.1);
    o.mid_speed = 5.0;
    return o;
  }());
  EXPECT_NE(constant.find("5.94"), std::string::npos) << constant;  // N·m missing
  EXPECT_NE(refusal(press("kind = \"torque source\", torque = \"100 N*m\""), demand(0.1)).find("--mid-speed"),
            std::string::npos);
  // No net resistance: a spring-like force along the stroke gives back what it takes.
  SizeOptions at_speed = demand(0.1);
  at_speed.mid_speed = 5.0;
  const std::string idle = test::with(
      valid, "load = { kind = \"press\", nominal_force = \"60 kN\", nominal_travel = \"10 mm\", rise = \"2 mm\" }",
      "load = { kind = \"constant\", force = \"100 N\" }");
  const std::string none =
      refusal(test::with(idle, straight(1200, 9), "kind = \"torque source\", torque = \"0 N*m\""), at_speed);
  EXPECT_NE(none.find("no net resistance"), std::string::npos) << none;
  SizeOptions named = demand(0.1);
  named.flywheel = "motor";
  EXPECT_NE(refusal(valid, named).find("allowed: \"wheel\""), std::string::npos) << refusal(valid, named);
}

// No part of the scene is named where the scene has none.
TEST(Size, AFlywheelThatTheSceneDoesNotHaveHasNoName) {
  std::string text = press(straight(9000, 10));
  const std::string wheel = "\"wheel\", ";
  text.erase(text.find(wheel), wheel.size());
  text.erase(text.find("wheel    ="), text.find("press    =") - text.find("wheel    ="));
  const Scene scene = test::scene_from(text);
  for (const double delta : {0.02, 1.9}) {
    const Sizing s = size_flywheel(scene, demand(delta));
    ASSERT_TRUE(s.flywheel_added);
    EXPECT_EQ(s.needed, delta == 0.02);
    const std::string conclusion = findings_of(s).conclusion();
    EXPECT_NE(conclusion.find("kg·m² on the shaft of \"press\""), std::string::npos) << conclusion;
    EXPECT_EQ(conclusion.find("\"flywheel\""), std::string::npos) << conclusion;
  }
}

// A clutch that holds less than the stroke's peak: it slips, so that the flywheel before it does not even out δ.
TEST(Size, NamesTheClutchThatSlips) {
  for (const auto& [torque, slips] : {std::pair(100, true), std::pair(20'000, false)}) {
    const Scene scene = test::scene_from(fmt::format(R"(
line = ["motor", "flywheel", "clutch", "press"]
motor = {{ kind = "dc shunt motor", stall_torque = "900 N*m", no_load_speed = "12 rad/s", inertia = "2 kg*m2" }}
flywheel = {{ kind = "flywheel", inertia = "60 kg*m2" }}
clutch = {{ kind = "clutch", torque = "{} N*m" }}
press = {{ kind = "slider-crank", radius = "60 mm", rod = "300 mm", crank_inertia = "8 kg*m2", slider_mass = "60 kg", load = {{ kind = "press", nominal_force = "20 kN", nominal_travel = "10 mm", rise = "0.5 mm", breakthrough = "3 mm", drop = "0.2 mm" }} }}
run = {{ start = {{ speed = "10 rad/s" }}, until = "10 s" }}
)",
                                                     torque));
    const Sizing s = size_flywheel(scene, demand(0.05, true));
    const std::string said = fmt::format("\"clutch\" slips, as the torque reaches the {} N·m that it holds", torque);
    EXPECT_EQ(findings_of(s).conclusion().find(said) != std::string::npos, slips) << findings_of(s).conclusion();
    EXPECT_EQ(s.meeting_words.find(said) != std::string::npos, slips);
  }
}

}  // namespace
}  // namespace kurbel::size_test
