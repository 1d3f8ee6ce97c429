// Steady cycles and operating points as a user requests them: closed forms, families, stalls, runaways.
#include "studies/steady/steady.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "studies/question/option.h"
#include "studies/report/render.h"
#include "tests/published/published.h"
#include "tests/support/conclusions.h"
#include "tests/support/files.h"

namespace kurbel::test::steady_test {
namespace {

constexpr double pi = std::numbers::pi;

std::string thrown_by(const Scene& scene, const SteadyOptions& options = {}) {
  try {
    steady(scene, {Effects{}}, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}
double value_of(const SteadyCycle& cycle, const std::string& name) {
  const Figure* f = cycle.find(name);
  EXPECT_NE(f, nullptr) << name;
  return f ? f->value : std::nan("");
}

const std::string crank =
    "crank = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", crank_inertia = \"0.55 kg*m2\", "
    "rod_mass = "
    "\"2 kg\", rod_com = \"122.5 mm\", rod_inertia = \"0.020 kg*m2\", slider_mass = \"3 kg\"";
const std::string press_load =
    ", load = { kind = \"press\", nominal_force = \"2 kN\", nominal_travel = \"100 mm\", working_end = \"folded\" } "
    "}\n";

std::string dc_against(const std::string& load) {
  return "line = [\"motor\", \"load\"]\n"
         "motor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"40 rad/s\", rated_torque = "
         "\"20 N*m\", inertia = \"0.5 kg*m2\" }\n" +
         load;
}
std::string induction_against(double load) {  // breakdown torque 3 · 4000/95 = 126.316 N·m
  return "line = [\"motor\", \"load\"]\n"
         "motor = { kind = \"induction motor\", rated_power = \"4 kW\", rated_speed = \"95 rad/s\", synchronous_speed "
         "= "
         "\"100 rad/s\", breakdown_ratio = 3, inertia = \"2 kg*m2\" }\n"
         "load = { kind = \"load\", torque = \"" +
         digits(load) + " N*m\" }\n";
}

// --- the steady cycle's figures ---

// A residual of the return map is 1 − μ of the distance to its fixed point: here a thousandth, and the motor's no-load speed,
// which scales it, a hundred times the machine's own.
TEST(Steady, WhatSettlesSlowlyIsFoundWithinItsErrorFromAnyStart) {
  const std::string text = R"(
line  = ["motor", "wheel", "press"]
motor = { kind = "dc shunt motor", stall_torque = "86.7436692696 N*m", no_load_speed = "867.436692696 rad/s", inertia = "2.5 kg*m2" }
wheel = { kind = "flywheel", inertia = "72.7 kg*m2" }
press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", slider_mass = "80 kg", load = { kind = "press", nominal_force = "60 kN", nominal_travel = "10 mm", rise = "2 mm" } }
)";
  std::vector<Figure> speeds;
  for (const char* start : {"8 rad/s", "7 rad/s", "7.9 rad/s", "8.1 rad/s"}) {
    const Scene scene = scene_from(text + "run = { start = { speed = \"" + start + "\" } }\n");
    const SteadyStudy study = steady(scene, {Effects{}}, {.start_search = false});
    ASSERT_TRUE(study.complete) << study.diagnosis;
    const Figure* speed = study.cycles[0].find("mid_speed.press");
    ASSERT_TRUE(speed && speed->error);
    EXPECT_LT(*speed->error, 1e-6 * speed->value);
    for (const Figure& other : speeds) EXPECT_NEAR(speed->value, other.value, *speed->error + *other.error) << start;
    speeds.push_back(*speed);
  }
}

TEST(Steady, PressTurnsAsTheLastCycleOfALongRun) {
  const Scene scene = scene_file("scenes/crank_press.toml");
  const SteadyStudy study = steady(scene, {Effects{}, scene.effects}, {.start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  for (const SteadyCycle& c : study.cycles) {
    SimulateOptions options;
    options.measure_error = false;
    options.accuracy = 1e-10;
    const Result long_run = simulate(compile(scene, c.model->effects), "long", options);
    for (const char* name : {"delta.press", "mid_speed.press", "mean_speed.press", "cycle_time.press"}) {
      const double found = value_of(c, name);
      EXPECT_NEAR(found, figure(long_run, name), 1e-8 * std::abs(found)) << c.label << " " << name;
    }
    EXPECT_NEAR(value_of(c, "driving_work_per_cycle"), figure(long_run, "driving_work_per_cycle"), 1e-5);
    EXPECT_LT(c.work_residual, 1e-9);
  }
}

// The steady press turns its load's work per stroke, whatever its speed.
TEST(Steady, WorkOfALoadEdgeIsForceTimesTravel) {
  const Scene scene = scene_file("scenes/driven_slider_crank.toml");
  const SteadyStudy study = steady(scene, {Effects{}}, {.start_search = false});
  EXPECT_NEAR(value_of(study.cycles[0], "useful_work_per_cycle"), -200, 1e-7);
  EXPECT_NEAR(value_of(study.cycles[0], "driving_work_per_cycle"), 200, 1e-7);
}

// A table and a damping are two torques of one load, and one account: all that the motor gives.
TEST(Steady, LoadOfSeveralPartsHasOneWork) {
  const SteadyCycle cycle =
      steady(scene_from(dc_against("load = { kind = \"load\", damping = \"0.1 N*m*s/rad\", table = "
                                   "{ over = \"angle\", formula = \"5 [N*m] + 2 [N*m]*sin(phi)\" } }\n"
                                   "run = { accuracy = 1e-9 }\n")),
             {Effects{}}, {})
          .cycles.at(0);
  ASSERT_TRUE(cycle.found) << cycle.why;
  EXPECT_EQ(std::ranges::count(cycle.figures, "work_per_cycle.load (useful)", &Figure::name), 1);
  const Figure* const work = cycle.find("work_per_cycle.load (useful)");
  ASSERT_NE(work, nullptr);
  EXPECT_NEAR(work->value, -value_of(cycle, "work_per_cycle.motor (driving)"), 1e-6);
  EXPECT_LT(-work->value, 2 * pi * (5 + 0.1 * value_of(cycle, "cycle_max_speed.motor")));
  EXPECT_GT(-work->value, 2 * pi * (5 + 0.1 * value_of(cycle, "cycle_min_speed.motor")));
  ASSERT_TRUE(work->error);
  EXPECT_LT(*work->error, 1e-6);
}

// J dω/dt = −(M_s/ω₀)(ω − ω_steady): a deviation halves in J ω₀/M_s ln 2.
TEST(Steady, StabilityOfAnEquilibriumIsStatedInSeconds) {
  const SteadyStudy study =
      steady(scene_from(dc_against("load = { kind = \"load\", torque = \"15 N*m\" }\n")), {Effects{}}, {});
  const SteadyCycle& c = study.cycles[0];
  ASSERT_EQ(c.kind, Orbit::Kind::equilibrium);
  EXPECT_TRUE(has(c.stability, "halves in 0.231 s")) << c.stability;  // 0.5 kg·m² · 40 rad/s / 60 N·m · ln 2
}

// All speeds are constant: a δ would be rounding. Beside it a motion that fluctuates has one.
TEST(SteadyOutput, AnEquilibriumHasNoSpeedFluctuation) {
  const SteadyStudy study =
      steady(scene_from(dc_against("load = { kind = \"load\", torque = \"15 N*m\" }\n")), {Effects{}}, {});
  ASSERT_EQ(study.cycles[0].kind, Orbit::Kind::equilibrium);
  EXPECT_FALSE(has(html_of(output_of(study).report()), "δ, rigid"));
  EXPECT_FALSE(has(html_of(output_of(study).report()), "Speed fluctuation"));
  const Scene turning = scene_file("scenes/driven_slider_crank.toml");
  const std::string page = html_of(output_of(steady(turning, {Effects{}}, {.start_search = false})).report());
  EXPECT_TRUE(has(page, "δ, rigid"));
  EXPECT_TRUE(has(page, "Speed fluctuation δ at every shaft"));
}

// The mean of M = M_s (1 − ω/ω₀) over time is that of ω: 2π/T.
TEST(Steady, MeanTorqueOfAShuntMotorFollowsFromTheMeanSpeed) {
  const SteadyStudy study = steady(scene_file("scenes/driven_slider_crank.toml"), {Effects{}}, {.start_search = false});
  const SteadyCycle& c = study.cycles[0];
  ASSERT_EQ(c.motors.size(), 1u);
  EXPECT_NEAR(c.motors[0].mean, 60 * (1 - 2 * pi / c.cycle_time / 40), 1e-9);
  EXPECT_GT(c.motors[0].rms, c.motors[0].mean);
}

TEST(Steady, RmsOfAMotorUnderConstantLoadIsTheLoadAndItsThermalUseTheRatio) {
  const SteadyStudy study =
      steady(scene_from(dc_against("load = { kind = \"load\", torque = \"15 N*m\" }\n")), {Effects{}}, {});
  const MotorUse& motor = study.cycles[0].motors[0];
  EXPECT_NEAR(motor.rms, 15, 1e-10);
  ASSERT_TRUE(motor.thermal());
  EXPECT_NEAR(*motor.thermal(), 0.75, 1e-11);
}

TEST(Steady, StabilityIsReportedInCyclesOfHalving) {
  std::optional<double> halving;
  EXPECT_TRUE(has(stability_text({{0.5, 0}}, &halving, 1e-9), "stable: the slowest deviation halves in 1 cycles"));
  EXPECT_NEAR(*halving, 1, 1e-12);
  EXPECT_TRUE(has(stability_text({{2, 0}}, nullptr, 1e-9), "unstable: a deviation doubles in 1 cycles"));
  EXPECT_TRUE(has(stability_text({{0.25, 0}}, &halving, 1e-9, 2), "stable: the slowest deviation halves in 1 cycles"));
  EXPECT_NEAR(*halving, 1, 1e-12);
  EXPECT_TRUE(has(stability_text({{1e-6, 0}}, nullptr, 1e-9, 2), "stable: 2 cycles leave less than 0.1 %"));
  EXPECT_TRUE(has(stability_text({{1, 0}, {0.2, 0}}, nullptr, 1e-9), "neutral"));
  EXPECT_TRUE(has(stability_text({{0.3, 0.4}, {0.3, -0.4}}, nullptr, 1e-9), "oscillating"));
}

// --- families ---

TEST(Steady, FamilyNeedsTheMeanSpeedAndSaysWhy) {
  const std::string why = thrown_by(scene_file("scenes/free_slider_crank.toml"));
  EXPECT_TRUE(has(why, "--mid-speed")) << why;
  EXPECT_TRUE(has(why, "depends on the speed")) << why;
  EXPECT_TRUE(has(why, "multiplier exactly 1")) << why;
}

// T = ½ I ω² stays: ω_max/ω_min = √(I_max/I_min) = √(0.6028418696/0.5600826531), and the mean is the one demanded.
TEST(Steady, MemberOfTheFreeCranksFamilyKeepsItsEnergy) {
  const SteadyStudy study =
      steady(scene_file("scenes/free_slider_crank.toml"), {Effects{}}, {.mid_speed = 25, .start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const SteadyCycle& c = study.cycles[0];
  const double max = value_of(c, "cycle_max_speed.crank"), min = value_of(c, "cycle_min_speed.crank");
  EXPECT_NEAR(max / min, std::sqrt(0.6028418696 / 0.5600826531), 1e-9);
  EXPECT_NEAR(0.5 * (max + min), 25, 1e-9);
  EXPECT_NEAR(c.added_torque, 0, 1e-9);
  EXPECT_TRUE(c.neutral);
  EXPECT_NEAR(c.point.largest(), 1, 1e-8);
}

// 2 kN over 100 mm a turn take 200 J/2π = 31.831 N·m on average; the source gives 20.
TEST(Steady, DemandedSpeedOfAFamilyNeedsTheMeanLoadTorque) {
  const Scene scene =
      scene_from("line = [\"source\", \"crank\"]\nsource = { kind = \"torque source\", torque = \"20 N*m\" }\n" +
                 crank + press_load);
  const std::string why = thrown_by(scene);
  EXPECT_TRUE(has(why, "slows down")) << why;
  for (const double speed : {18.0, 30.0}) {
    const SteadyStudy study = steady(scene, {Effects{}}, {.mid_speed = speed, .start_search = false});
    ASSERT_TRUE(study.complete) << study.diagnosis;
    EXPECT_NEAR(study.cycles[0].added_torque, 200 / (2 * pi) - 20, 1e-8);
    EXPECT_TRUE(study.cycles[0].neutral);
    EXPECT_NEAR(value_of(study.cycles[0], "mid_speed.crank"), speed, 1e-8);
  }
}

TEST(Steady, DemandedSpeedOfAnElasticMachineIsReached) {
  const Scene scene = scene_file("scenes/compressor.toml");
  const SteadyStudy study = steady(scene, {scene.effects}, {.mid_speed = 70, .start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  EXPECT_NEAR(value_of(study.cycles[0], "mid_speed.compressor"), 70, 1e-8);
  EXPECT_LE(study.cycles[0].cost, study.cycles[0].cost_limit);
}

TEST(Steady, MeanSpeedOfAMachineThatTimeDrivesIsRefused) {
  const Scene scene = scene_from(
      "line = [\"drive\", \"crank\"]\ndrive = { kind = \"prescribed speed\", speed = \"20 "
      "rad/s\" }\n" +
      crank + " }\n");
  EXPECT_TRUE(has(thrown_by(scene, {.mid_speed = 10}), "time drives"));
}

// --- no steady cycle ---

TEST(Steady, LoadBeyondBreakdownIsAStallByTheDifference) {
  const SteadyStudy study = steady(scene_from(induction_against(150)), {Effects{}}, {});
  EXPECT_FALSE(study.complete);
  EXPECT_TRUE(has(study.diagnosis, "stall")) << study.diagnosis;
  EXPECT_TRUE(has(study.diagnosis, "(150 N·m against 126.32 N·m at 70.858 rad/s). ")) << study.diagnosis;
}

TEST(Steady, DriveThatAlwaysWinsIsARunaway) {
  const SteadyStudy study =
      steady(scene_from("line = [\"turbine\", \"load\"]\n"
                        "turbine = { kind = \"torque source\", inertia = \"1 kg*m2\", table = { over = \"speed\", "
                        "beyond = \"hold\", unit = [\"rad/s\", \"N*m\"], points = [[0, 50], [100, 20]] } }\n"
                        "load = { kind = \"load\", torque = \"5 N*m\" }\n"),
             {Effects{}}, {});
  EXPECT_FALSE(study.complete);
  EXPECT_TRUE(has(study.diagnosis, "runaway")) << study.diagnosis;
  EXPECT_TRUE(has(study.diagnosis, "15 N·m")) << study.diagnosis;
}

TEST(Steady, PeakLoadThatStopsALightMachineIsAStallWithinTheCycle) {
  const Scene scene = scene_from(
      "line = [\"motor\", \"crank\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = "
      "\"10 rad/s\", inertia = \"0 kg*m2\" }\n" +
      crank + press_load);
  const SteadyStudy study = steady(scene, {Effects{}}, {});
  EXPECT_FALSE(study.complete);
  EXPECT_TRUE(has(study.diagnosis, "stall: on average the drive would hold")) << study.diagnosis;
  EXPECT_TRUE(has(study.diagnosis, "comes to rest at")) << study.diagnosis;
}

TEST(Steady, InterruptedStudyIsMarked) {
  const std::atomic<bool> interrupted = true;
  const SteadyStudy study =
      steady(scene_file("scenes/crank_press.toml"), {Effects{}}, {.watch = {.interrupted = &interrupted}});
  EXPECT_FALSE(study.complete);
  EXPECT_EQ(study.diagnosis, "interrupted");
}

// 60 (1 − ω/40) = M: the load that keeps a speed instead of a torque beside the drive.
TEST(Steady, SpeedIsHeldByAQuantityOfTheScene) {
  const Scene scene = scene_from(dc_against("load = { kind = \"load\", torque = \"15 N*m\" }\n"));
  for (const double speed : {10.0, 25.0, 38.0}) {
    SteadyOptions options{.mean_speed = speed, .hold_by = "load.torque", .start_search = false};
    const SteadyStudy study = steady(scene, {Effects{}}, options);
    ASSERT_TRUE(study.complete) << study.diagnosis;
    ASSERT_TRUE(study.cycles[0].held_quantity);
    EXPECT_NEAR(study.cycles[0].held_quantity->value, 60 * (1 - speed / 40), 1e-7);
    EXPECT_NEAR(value_of(study.cycles[0], "mean_speed.motor"), speed, 1e-8);
  }
  EXPECT_TRUE(has(thrown_by(scene, {.mean_speed = 10, .hold_by = "load.mass"}), "must name a quantity"));
  EXPECT_TRUE(has(thrown_by(scene, {.hold_by = "load.torque"}), "which speed")) << "nothing is ignored";
  const Scene viscous = scene_from(dc_against("load = { kind = \"load\", damping = \"0.5 N*m*s/rad\" }\n"));
  const SteadyStudy beyond =
      steady(viscous, {Effects{}}, {.mean_speed = 45, .hold_by = "load.damping", .start_search = false});
  EXPECT_FALSE(beyond.complete) << "above no load a load would have to drive";
  EXPECT_TRUE(has(beyond.diagnosis, "load.damping")) << beyond.diagnosis;
}

// Mean over time and middle of the extremes are two demands: a press turns differently by each.
TEST(Steady, MeanSpeedAndMidSpeedAreTwoDemands) {
  const Scene scene = scene_from(
      "line = [\"motor\", \"crank\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"600 N*m\", no_load_speed = "
      "\"10 rad/s\", inertia = \"20 kg*m2\" }\n" +
      crank + press_load);
  for (const bool mean : {false, true}) {
    SteadyOptions options{.start_search = false};
    (mean ? options.mean_speed : options.mid_speed) = 8;
    const SteadyStudy study = steady(scene, {Effects{}}, options);
    ASSERT_TRUE(study.complete) << study.diagnosis;
    const double mid = value_of(study.cycles[0], "mid_speed.crank"),
                 over_time = value_of(study.cycles[0], "mean_speed.crank");
    EXPECT_NEAR(mean ? over_time : mid, 8, 1e-8);
    EXPECT_GT(std::abs(over_time - mid), 1e-4) << "the two must differ for this test to tell";
  }
}

// The motor goes off at 2 s, and the machine comes to rest; until then it turns at 40 (1 − 15/60).
TEST(Steady, WhatIsSwitchedIsSwitched) {
  const Scene scene = scene_from(with(dc_against("load = { kind = \"load\", torque = \"15 N*m\" }\n"),
                                      "inertia = \"0.5", "stop = \"2 s\", inertia = \"0.5"));
  const SteadyStudy after = steady(scene, {Effects{}}, {});
  ASSERT_TRUE(after.complete) << after.diagnosis;
  EXPECT_TRUE(has(after.conclusion, "comes to rest")) << after.conclusion;
  EXPECT_NEAR(value_of(after.cycles[0], "mean_speed.motor"), 30, 1e-8);
  SteadyOptions before;
  before.at.time = 0.5;
  const SteadyStudy running = steady(scene, {Effects{}}, before);
  ASSERT_TRUE(running.complete) << running.diagnosis;
  EXPECT_NEAR(value_of(running.cycles[0], "mean_speed.motor"), 30, 1e-8);
}

// A clutch that is let go and put in again once a second: the period is that of the sequence, and its figures are sure.
TEST(Steady, SequenceThatRepeatsGivesThePeriod) {
  const Scene scene = scene_from(
      "line = [\"motor\", \"clutch\", \"load\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", "
      "no_load_speed = \"40 rad/s\", inertia = \"0.5 kg*m2\" }\nclutch = { kind = \"clutch\", torque = \"30 N*m\" }\n"
      "load = { kind = \"load\", torque = \"15 N*m\", inertia = \"0.3 kg*m2\" }\n[sequence]\nrepeat = true\nsteps = [{ "
      "after = \"0.5 s\", set = \"clutch\", to = 0 }, { after = \"0.5 s\", set = \"clutch\", to = 1 }]\n");
  const SteadyStudy study = steady(scene, {Effects{}}, {.start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const SteadyCycle& c = study.cycles[0];
  EXPECT_NEAR(c.cycle_time, 1, 1e-9);
  for (const Figure& f : c.figures)
    EXPECT_LT(f.error.value_or(HUGE_VAL), 1e-6 * std::max(f.scale, std::abs(f.value))) << f.name;
}

// A heavy press that strikes every third stroke settles slowly: its period is three turns, whatever it is accepted by.
TEST(Steady, SequenceOfAHeavyPressHasTheFewestStrokesAsItsPeriod) {
  for (const char* inertia : {"1.5 kg*m2", "6 kg*m2"}) {
    const std::string text = test::text_of(test::source_path("tests/agreement/press_every_third.toml"));
    const SteadyStudy study = steady(scene_from(with(text, "\"1.5 kg*m2\"", fmt::format("\"{}\"", inertia))),
                                     {Effects{}}, {.start_search = false});
    ASSERT_TRUE(study.complete) << study.diagnosis;
    const SteadyCycle& c = study.cycles[0];
    EXPECT_NEAR(c.cycle_time * value_of(c, "mean_speed.crank"), 3 * 2 * pi, 1e-6) << inertia;
  }
}

// By the clock: 2 s at full voltage, 3 s at a fifth; ω_high = 100 + (ω_low − 100) e^{−2/10}, ω_low = 20 + (ω_high − 20) e^{−3/10}.
TEST(Steady, SequenceByTheClockHasItsPeriod) {
  const Scene scene = scene_from(
      "line = [\"motor\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"20 N*m\", no_load_speed = \"100 "
      "rad/s\", inertia = "
      "\"2 kg*m2\" }\n[sequence]\nevery = \"5 s\"\nsteps = [{ set = \"motor\" }, { after = \"2 s\", set = \"motor\", "
      "to = 0.2 }]\n");
  const SteadyStudy study = steady(scene, {Effects{}}, {.start_search = false});
  ASSERT_TRUE(study.complete) << study.diagnosis;
  const SteadyCycle& c = study.cycles[0];
  EXPECT_NEAR(c.cycle_time, 5, 1e-12);
  const double a = std::exp(-0.2), b = std::exp(-0.3);
  const double high = (100 * (1 - a) + 20 * (1 - b) * a) / (1 - a * b), low = 20 + (high - 20) * b;
  const double mean = (100 * 2 + 20 * 3) / 5.0;  // the change of speed over a cycle is zero
  EXPECT_NEAR(value_of(c, "mid_speed.motor"), 0.5 * (high + low), 1e-7);
  EXPECT_NEAR(value_of(c, "mean_speed.motor"), mean, 1e-7);
}

TEST(Steady, StepsOfASequenceAreCountedFromOne) {
  const Scene scene = scene_file("scenes/dc_hoist.toml");
  SteadyOptions options;
  options.start_search = false;
  EXPECT_TRUE(has(steady(scene, {Effects{}}, options).conclusion, "after step ")) << "the hoist is held in the end";
  options.at.after_step = scene.sequence.steps.size() + 1;
  EXPECT_THROW(steady(scene, {Effects{}}, options), std::invalid_argument);
}

TEST(Steady, AMomentIsAStepATimeOrASpeed) {
  std::optional<double> speed;
  EXPECT_EQ(moment_of("--at", "step 2", speed).after_step, std::optional<std::size_t>(2));
  EXPECT_EQ(moment_of("--at", "step 0", speed).describe(), "before step 1");
  EXPECT_EQ(moment_of("--at", "1.5 s", speed).time, 1.5);
  EXPECT_FALSE(speed);
  EXPECT_FALSE(moment_of("--at", "60 rpm", speed).any());
  EXPECT_NEAR(*speed, 2 * pi, 1e-15);
  for (const char* wrong : {"step", "step -1", "step two", "2", "-1 s", "0 rpm"})
    EXPECT_THROW(moment_of("--at", wrong, speed), std::invalid_argument) << wrong;
}

// --- operating points ---

OperatingDiagram diagram_of(const std::string& text, int direction = 1) {
  RigidMachine machine(scene_from(text));
  return operating_diagram(machine, direction);
}

// 60 (1 − ω/40) = b ω
TEST(OperatingPoints, ShuntMotorMeetsAViscousLoadWhereTheLinesCross) {
  const OperatingDiagram d = diagram_of(dc_against("load = { kind = \"load\", damping = \"0.5 N*m*s/rad\" }\n"));
  ASSERT_EQ(d.points.size(), 1u);
  EXPECT_NEAR(d.points[0].speed.value, 30, 1e-10);
  EXPECT_NEAR(d.points[0].torque.value, 15, 1e-10);
  EXPECT_NEAR(d.points[0].drive_slope, -1.5, 1e-7);
  EXPECT_NEAR(d.points[0].load_slope, 0.5, 1e-7);
  EXPECT_TRUE(d.points[0].stable());
  EXPECT_NEAR(d.margin(d.points[0]).value, 4, 1e-5);
}

// A weight gives back over a turn what it takes: no load speed, and no torque but rounding's.
TEST(OperatingPoints, OfALoadThatOnlyStoresHasNoTorque) {
  const OperatingDiagram d = diagram_of(R"(
line = ["motor", "crank"]
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "1 kg*m2" }
crank = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", crank_inertia = "0.5 kg*m2", slider_mass = "3 kg", gravity = "9.81 m/s2", stroke_angle = "90 deg" }
)");
  ASSERT_EQ(d.points.size(), 1u);
  EXPECT_NEAR(d.points[0].speed.value, 40, 1e-9);
  EXPECT_EQ(d.points[0].torque.value, 0);
  EXPECT_TRUE(std::isinf(d.margin(d.points[0]).value));
}

// Kloss: M_c/M_b = 2/(s/s_b + s_b/s) at s/s_b = q ± √(q² − 1), q = M_b/M_c: the higher speed is stable.
TEST(OperatingPoints, InductionMotorUnderConstantLoadHasAStableAndAnUnstablePoint) {
  const double rated = 4000 / 95.0, breakdown = 3 * rated, load = 80, sb = 0.05 * (3 + std::sqrt(8.0));
  const OperatingDiagram d = diagram_of(induction_against(load));
  ASSERT_EQ(d.points.size(), 2u);
  const double q = breakdown / load, root = std::sqrt(q * q - 1);
  EXPECT_NEAR(d.points[0].speed.value, 100 * (1 - sb * (q + root)), 1e-9);
  EXPECT_FALSE(d.points[0].stable());
  EXPECT_NEAR(d.points[1].speed.value, 100 * (1 - sb * (q - root)), 1e-9);
  EXPECT_TRUE(d.points[1].stable());
  EXPECT_EQ(d.working_point(), &d.points[1]);
  EXPECT_NEAR(d.strongest.value, breakdown, 1e-9);
  EXPECT_NEAR(d.strongest_at, 100 * (1 - sb), 1e-4);
}

// Behind i = 12 with η = 0.9 the drive keeps any speed by M₀/(i η) + c ω/(i² η), whatever the inertias are.
TEST(OperatingPoints, OfALoadBehindLossesAreThoseOfSpeedsThatAreKept) {
  for (const char* inertia : {"0.012 kg*m2", "0.4 kg*m2"})
    for (const double damping : {0.0, 2.0}) {
      const Scene scene = scene_from(fmt::format(
          "line = [\"motor\", \"gearbox\", \"drum\"]\nmotor = {{ kind = \"induction motor\", rated_power = \"4 kW\", "
          "rated_speed = \"1430 rpm\", synchronous_speed = \"1500 rpm\", breakdown_ratio = 2.8, inertia = \"{}\" }}\n"
          "gearbox = {{ kind = \"gearbox\", stages = [{{ teeth = [20, 60] }}, {{ teeth = [20, 80] }}], efficiency = "
          "0.9 }}\n"
          "drum = {{ kind = \"load\", torque = \"200 N*m\", damping = \"{} N*m*s/rad\", inertia = \"2 kg*m2\" }}\n",
          inertia, damping));
      const SteadyStudy study = steady(scene, {scene.effects}, {});
      ASSERT_TRUE(study.diagram && !study.diagram->estimate);
      for (const MeanTorques& at : study.diagram->curve)
        EXPECT_NEAR(at.load, 200 / (12 * 0.9) + damping * at.omega / (144 * 0.9), 1e-9) << inertia << at.omega;
      const OperatingPoint* point = study.diagram->working_point();
      ASSERT_NE(point, nullptr);
      EXPECT_NEAR(point->load_slope, damping / (144 * 0.9), 1e-7) << inertia;
    }
}

// The press force does 200 J a turn: mean torque 200/2π at any speed.
TEST(OperatingPoints, MeanLoadTorqueIsWorkPerTurnOverTheTurn) {
  RigidMachine machine(scene_file("scenes/driven_slider_crank.toml"));
  MeanCharacteristic mean(machine, 1);
  for (const double omega : {1.0, 17.0, 39.0}) {
    EXPECT_NEAR(mean.at(omega).load, 200 / (2 * pi), 1e-10);
    EXPECT_NEAR(mean.at(omega).drive, 60 * (1 - omega / 40), 1e-10);
  }
}

// Everything reversed: the same diagram of the other direction, whose torques drive and brake as before.
TEST(OperatingPoints, OfTheOtherDirectionAreTheSameMirrored) {
  const auto machine = [](int sense) {
    return fmt::format(
        "line = [\"motor\", \"wheel\"]\nmotor = {{ kind = \"torque source\", table = {{ over = \"speed\", unit = "
        "[\"rad/s\", \"N*m\"], points = [[{}, {}], [{}, {}]] }} }}\nwheel = {{ kind = \"load\", inertia = \"1 kg*m2\", "
        "damping = \"0.5 N*m*s/rad\" }}\n",
        sense > 0 ? -40 : -80, sense > 0 ? 120 : 60, sense > 0 ? 80 : 40, sense > 0 ? -60 : -120);
  };
  for (const int sense : {1, -1}) {  // 60 (1 − ω/40) forwards, −60 (1 + ω/40) backwards
    RigidMachine rigid(scene_from(machine(sense)));
    MeanCharacteristic mean(rigid, sense);
    const MeanTorques at = mean.at(10);
    EXPECT_EQ(at.omega, 10 * sense);
    EXPECT_NEAR(at.drive, 45, 1e-10) << sense;
    EXPECT_NEAR(at.load, 5, 1e-10) << sense;
    const OperatingDiagram d = operating_diagram(rigid, sense);
    ASSERT_EQ(d.points.size(), 1u) << sense;
    EXPECT_NEAR(d.points[0].speed.value, 30 * sense, 1e-9);
    EXPECT_NEAR(d.points[0].torque.value, 15, 1e-9);
    EXPECT_TRUE(d.points[0].stable());
  }
  // Started against its drive: the diagram is of the direction in which the drive turns it.
  for (const int sense : {1, -1}) {
    const SteadyStudy study =
        steady(scene_from(machine(sense) + fmt::format("run = {{ start = {{ speed = \"{} rad/s\" }} }}\n", -5 * sense)),
               {Effects{}}, {});
    ASSERT_TRUE(study.diagram && study.diagram->working_point()) << sense;
    EXPECT_NEAR(study.diagram->working_point()->speed.value, 30 * sense, 1e-9);
  }
}

// --- starts ---

// τ = J ω₀/M_s, ω = ω_∞ (1 − e^{−t/τ}): 95 % after τ ln 20.
TEST(Starts, ShuntMotorReaches95PercentAfterItsTimeConstantTimesLn20) {
  const SteadyStudy study =
      steady(scene_from(dc_against("load = { kind = \"load\", torque = \"15 N*m\" }\n")), {Effects{}}, {});
  ASSERT_TRUE(study.start && study.start->reached);
  EXPECT_NEAR(study.start->time.value, 0.5 * 40 / 60 * std::log(20.0), 1e-7);
}

// mo02 fan_start: M = 50 N·m, k = 0.04, J = 2: ω = ω_∞ tanh(t √(M k)/J), t_95 = 2.5905292832732227 s
TEST(Starts, FanReaches95PercentAsPublished) {
  const SteadyStudy study = steady(
      scene_from(
          "line = [\"source\", \"fan\"]\nsource = { kind = \"torque source\", torque = \"50 N*m\", inertia = \"2 "
          "kg*m2\" }\nfan = { kind = \"load\", quadratic = \"0.04 N*m*s2/rad2\" }\n"),
      {Effects{}}, {});
  ASSERT_TRUE(study.start && study.start->reached) << study.diagnosis;
  EXPECT_NEAR(value_of(study.cycles[0], "mid_speed.source"), 35.35533905932738, 1e-9);
  EXPECT_NEAR(study.start->time.value, 2.5905292832732227, 1e-7);
}

// Ratio of the gearbox with which the machine's shaft starts fastest under constant torques:
//     α = (η i T_m − T_c)/(J + η i² J_m)  is greatest at  i = [T_c + √(T_c² + η T_m² J/J_m)]/(η T_m)
double fastest_start_ratio(double motor_torque, double motor_inertia, double load_torque, double load_inertia,
                           double efficiency = 1) {
  const double root =
      std::sqrt(load_torque * load_torque + efficiency * motor_torque * motor_torque * load_inertia / motor_inertia);
  return (load_torque + root) / (efficiency * motor_torque);
}

TEST(Starts, RatioThatStartsFastestIsThatOfKhurmisExamples) {
  EXPECT_NEAR(fastest_start_ratio(100, 2, 0, 32), 4.0, 1e-12);                  // khurmi_3_14
  EXPECT_NEAR(fastest_start_ratio(30, 0.6, 100, 45, 0.95), 13.06172168, 1e-8);  // khurmi_3_17: G_optimal
}

// Whatever the torques, no ratio accelerates the load faster than the closed form's.
TEST(Starts, ClosedFormRatioIsTheGreatestAcceleration) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.05, 1);
  for (int i = 0; i < 200; ++i) {
    const double tm = 50 * uniform(random), jm = uniform(random), tc = 100 * uniform(random), j = 50 * uniform(random);
    const double eta = uniform(random), best = fastest_start_ratio(tm, jm, tc, j, eta);
    const auto acceleration = [&](double r) { return (eta * r * tm - tc) / (j + eta * r * r * jm); };
    for (const double other : {0.99, 1.01}) EXPECT_LT(acceleration(other * best), acceleration(best));
  }
}

// khurmi_3_14 simulated: 100 N·m on 2 kg·m², 32 kg·m² behind the gear; the load hardly brakes.
TEST(Starts, SimulatedSearchFindsTheClosedFormsRatio) {
  const Scene scene = scene_from(
      "line = [\"motor\", \"gear\", \"load\"]\n"
      "motor = { kind = \"torque source\", torque = \"100 N*m\", inertia = \"2 kg*m2\" }\n"
      "gear = { kind = \"gearbox\", stages = [{ teeth = [20, 60] }] }\n"
      "load = { kind = \"load\", torque = \"1e-6 N*m\", inertia = \"32 kg*m2\" }\n");
  const std::vector<RatioSearch> found = fastest_ratios(scene, rigid_effects(), 10, 1000);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].present, 3, 1e-12);
  EXPECT_NEAR(found[0].best, 4, 1e-3);
  EXPECT_FALSE(found[0].at_bound);
}

// --- output ---

TEST(SteadyOutput, JsonHoldsFiguresMultipliersAndOperatingPoints) {
  const Scene scene = scene_file("scenes/compressor.toml");
  const SteadyStudy study = steady(scene, {Effects{}, scene.effects}, {.traces = true, .start_search = false});
  const StudyOutput output = output_of(study);
  const auto json = nlohmann::json::parse(output.json());
  ASSERT_EQ(json["cycles"].size(), 2u);
  EXPECT_EQ(json["cycles"][1]["multipliers"].size(), 4u);  // two shafts, a twist, the lag of the motor's torque
  EXPECT_EQ(json["operating_points"].size(), study.diagram->points.size());
  for (const auto& f : json["cycles"][1]["figures"]) EXPECT_TRUE(f["error"].is_number()) << f["name"];
  const Report report = output.report();
  int equal_axes = 0, over_angle = 0;
  for (const ReportSection& section : report.sections)
    for (const Card& card : section.cards)
      if (const Plot* plot = std::get_if<Plot>(&card)) {
        EXPECT_FALSE(plot->title.empty());
        EXPECT_FALSE(plot->x.label.empty());
        equal_axes += plot->equal_axes;
        over_angle += plot->x.unit == "°";
      }
  EXPECT_EQ(equal_axes, 1);
  EXPECT_GE(over_angle, 3);
  ASSERT_EQ(output.tables.size(), 3u);
  EXPECT_TRUE(csv_text(output.tables[0].table()).starts_with("speed [rad/s],drive_torque"));
}

// What weights take is not lost: a screw and a wedge that lift. As `run` has it (theory 1.3).
TEST(Steady, EfficiencyCountsWeightsWithTheDrivingWork) {
  const Scene scene = scene_file("tests/agreement/vibrations/screw_wedge_slide.toml");
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(study.cycles.size() == 1 && study.cycles[0].found);
  const SteadyCycle& cycle = study.cycles[0];
  const double driving = value_of(cycle, "driving_work_per_cycle"), weight = value_of(cycle, "weight_work_per_cycle");
  ASSERT_LT(weight, -0.1 * driving);
  EXPECT_NEAR(value_of(cycle, "machine_efficiency"), -value_of(cycle, "useful_work_per_cycle") / (driving + weight),
              1e-12);
  const Result run = simulate(scene, scene.effects, "elastic", {});
  EXPECT_NEAR(value_of(cycle, "machine_efficiency"), figure(run, "machine_efficiency"), 1e-8);
}

// Works over a cycle whose area is known in closed form: of a press 630 kN · 2.85 mm; of a compressor, with n = m = 1.3,
// n/(n − 1) p₁ λ V (r^((n − 1)/n) − 1). What is stated as their error covers what they are off.
TEST(Steady, WorksOfACycleAreWithinTheirErrors) {
  const double n = 1.3, volume = pi / 4 * 0.08 * 0.08 * 0.12, drawn = 1 - 0.06 * (std::pow(6, 1 / n) - 1);
  const double gas = n / (n - 1) * 1e5 * drawn * volume * (std::pow(6, (n - 1) / n) - 1);
  for (const auto& [file, expected] :
       {std::pair("scenes/crank_press.toml", -1795.5), {"docs/tasks/flywheel_sheet.toml", -gas}}) {
    const Scene scene = scene_file(file);
    const SteadyStudy s = steady(scene, {rigid_effects(), scene.effects}, {.start_search = false});
    for (const SteadyCycle& c : s.cycles) {
      const Figure* work = c.find("useful_work_per_cycle");
      ASSERT_TRUE(work && work->error) << file;
      EXPECT_LE(std::abs(work->value - expected), *work->error) << file << ", " << c.label;
      EXPECT_LT(*work->error, 1e-8 * std::abs(expected)) << file << ", " << c.label;
    }
  }
}

// A screw has one shaft, whose node is labelled "in" all the same; its figures are named after the component.
TEST(Steady, OfALinkThatIsAScrew) {
  const SteadyStudy s = steady(test::scene_from(R"(
    line = ["screw", "motor"]
    screw = { kind = "screw", lead = "10 mm" }
    motor = { kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }
    load = { kind = "load", on = "motor", torque = "30 N*m" }
    run = { until = "10 s" }
  )"),
                               {Effects{}}, {});
  ASSERT_TRUE(s.complete) << s.conclusion;
  EXPECT_EQ(s.link, "screw");
  EXPECT_NEAR(value_of(s.cycles.back(), "mean_speed.screw"), 70, 1e-6);
  EXPECT_NE(s.conclusion.find("mean speed 70"), std::string::npos) << s.conclusion;
}

}  // namespace
}  // namespace kurbel::test::steady_test
