// work_equation_test.cpp — the machine over its angle: work diagrams, time by quadrature, stalls and starts from rest.
#include "engine/rigid/work_equation.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/rigid/work_stepper.h"
#include "engine/steppers/butcher_tables.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/published/published.h"

namespace kurbel::work_equation_test {
namespace {

using std::numbers::pi;
using test::figure;
using test::project_text;
using test::scene_from;
using test::with;

std::shared_ptr<const Model> rigid(const Scene& scene) { return compile(scene, Effects{}); }

RunOutcome run_by(const char* method, Equations& equations, double until, double tolerance) {
  RunOptions options;
  options.method = method;
  options.until = until;
  options.tolerance = tolerance;
  RunOutcome out = integrate(equations, options, {});
  EXPECT_TRUE(out.complete) << out.diagnosis;
  return out;
}

double angle(const Equations& equations, const RunOutcome& out) {
  return equations.angle_with_turns(static_cast<std::size_t>(equations.model().reduction_angle), out.state);
}
double speed(const Equations& equations, const RunOutcome& out) { return out.state[equations.speed_index(0)]; }

SliderCrankGeometry free_crank() {
  SliderCrankData d;
  d.radius = 0.1, d.rod_length = 0.35, d.crank_inertia = 0.55, d.rod_mass = 2, d.rod_com = 0.1225;
  d.rod_inertia = 0.02, d.slider_mass = 3;
  return SliderCrankGeometry(d);
}

// T = ∮ √(I_r/2E) dφ: the trapezium rule converges at once on a periodic function.
double period_of_free_crank(double omega0) {
  const SliderCrankGeometry geometry = free_crank();
  const long double energy = 0.5L * geometry.inertia(0.0L).value * omega0 * omega0;
  long double sum = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {
    const long double phi = 2 * std::numbers::pi_v<long double> * i / n;
    sum += std::sqrt(geometry.inertia(phi).value / (2 * energy));
  }
  return static_cast<double>(sum * 2 * std::numbers::pi_v<long double> / n);
}

// --- work diagram ---

TEST(WorkOverAngle, MotionOfTheFreeSliderCrankMatchesTheQuadratureInElevenDigits) {
  WorkTables tables(rigid(test::scene_file("scenes/free_slider_crank.toml")));
  const WorkOverAngle& diagram = tables.diagram(1);
  const WorkOverAngle::Motion end = diagram.advance(0, 30, 10);
  EXPECT_NEAR(static_cast<double>(end.cycles) * diagram.cycle() + end.s, 294.719373652657, 3e-12);
  EXPECT_NEAR(end.speed, 29.5167074225067, 3e-12);
  EXPECT_EQ(end.t, 10);
  EXPECT_FALSE(end.stalled);
}

// A machine that does no work over a cycle is after a million cycles where its period says: phase errors are those of
// the period times the number of cycles.
TEST(WorkOverAngle, PhaseErrorOverAMillionCyclesGrowsNoFasterThanTime) {
  WorkTables tables(rigid(test::scene_file("scenes/free_slider_crank.toml")));
  const WorkOverAngle& diagram = tables.diagram(1);
  EXPECT_EQ(diagram.work_per_cycle(), 0);
  const double period = period_of_free_crank(30);
  for (const double cycles : {1e3, 1e4, 1e5, 1e6}) {
    const WorkOverAngle::Motion end = diagram.advance(0, 30, (cycles + 0.25) * period);
    const WorkOverAngle::Motion first = diagram.advance(0, 30, 0.25 * period);
    EXPECT_EQ(static_cast<double>(end.cycles), cycles);
    EXPECT_NEAR(end.s, first.s, 1e-13 * cycles * 2 * pi);
    EXPECT_NEAR(end.speed, first.speed, 1e-13 * cycles * 30);
  }
}

// W(φ) = V(0) − V(φ): weights give back over a turn what they took.
TEST(WorkOverAngle, WorkOfWeightsIsTheLossOfPotentialEnergyInEitherDirection) {
  const Scene scene = scene_from(R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
offset = "20 mm"
crank_mass = "5 kg"
crank_com = "30 mm"
crank_inertia = "0.55 kg*m2"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
gravity = "9.80665 m/s2"
stroke_angle = "40 deg"
[run]
start = { speed = "20 rad/s" }
until = "1 s"
)");
  SliderCrankData d = free_crank().data();
  d.offset = 0.02, d.crank_mass = 5, d.crank_com = 0.03, d.gravity = 9.80665, d.stroke_angle = 40 * pi / 180;
  const SliderCrankGeometry geometry(d);
  WorkTables tables(rigid(scene));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 20 * pi);
  for (const int direction : {1, -1}) {
    const WorkOverAngle& diagram = tables.diagram(direction);
    EXPECT_EQ(diagram.work_per_cycle(), 0);
    for (int i = 0; i < 100; ++i) {
      const double s = any(random);
      EXPECT_NEAR(diagram.work(s), geometry.potential_energy(0.0) - geometry.potential_energy(direction * s), 3e-12);
      EXPECT_NEAR(diagram.inertia(s), geometry.inertia(direction * s).value, 1e-12);
    }
  }
}

std::string flywheel_with(const std::string& torque, const std::string& start) {
  return "line = [\"wheel\"]\n[wheel]\nkind = \"flywheel\"\ninertia = \"2 kg*m2\"\n" + torque + "[run]\nstart = { " +
         start + " }\nuntil = \"3 s\"\n";
}

// φ = ½ (M/I) t², ω = (M/I) t: 1/ω is singular at the start.
TEST(WorkOverAngle, StartFromRestUnderAConstantTorqueIsTheParabola) {
  const Scene scene = scene_from(
      flywheel_with("[drive]\nkind = \"torque source\"\non = \"wheel\"\ntorque = \"7 N*m\"\n", "speed = \"0 rad/s\""));
  WorkTables tables(rigid(scene));
  const WorkOverAngle& diagram = tables.diagram(1);
  for (const double t : {1e-3, 0.1, 1.0, 3.0, 30.0}) {
    const WorkOverAngle::Motion end = diagram.advance(0, 0, t);
    const double turned = static_cast<double>(end.cycles) * diagram.cycle() + end.s;
    EXPECT_NEAR(turned, 0.5 * 3.5 * t * t, 2e-13 * (1 + turned)) << t;
    EXPECT_NEAR(end.speed, 3.5 * t, 1e-13 + 1e-12 * 3.5 * t) << t;
  }
}

// Braked by a constant torque the wheel stops after I ω₀/M at ½ I ω₀²/M.
TEST(WorkOverAngle, StopUnderAConstantTorqueIsExact) {
  const Scene scene = scene_from(
      flywheel_with("[brake]\nkind = \"load\"\non = \"wheel\"\ntorque = \"7 N*m\"\n", "speed = \"10 rad/s\""));
  WorkTables tables(rigid(scene));
  const WorkOverAngle::Motion end = tables.diagram(1).advance(0, 10, 100);
  EXPECT_TRUE(end.stalled);
  EXPECT_EQ(end.speed, 0);
  EXPECT_NEAR(static_cast<double>(end.cycles) * 2 * pi + end.s, 100.0 / 7, 1e-12);
  EXPECT_NEAR(end.t, 20.0 / 7, 1e-12);
}

// A constant torque drives against a press force: the crank stops where T₀ + M φ = F (x_edge − x(φ)).
TEST(WorkOverAngle, StallUnderAPressLoadLiesWhereTheEnergyIsUsedUp) {
  const std::string text = with(with(project_text("scenes/driven_slider_crank.toml"), "\"20 rad/s\"", "\"10 rad/s\""),
                                "kind          = \"dc shunt motor\"\nstall_torque  = \"60 N*m\"          # torque at "
                                "standstill\nno_load_speed = \"40 rad/s\"        # speed without load\n",
                                "kind = \"torque source\"\ntorque = \"45 N*m\"\n");
  const Scene scene = scene_from(text);
  const auto model = rigid(scene);
  WorkTables tables(model);
  const WorkOverAngle::Motion end = tables.diagram(1).advance(0, 10, 10);
  ASSERT_TRUE(end.stalled);
  EXPECT_EQ(end.cycles, 0);
  const SliderCrankGeometry geometry = free_crank();
  const double kinetic = 0.5 * geometry.inertia(0.0).value * 100, edge = 0.35;  // the load begins at x = l
  EXPECT_NEAR(kinetic + 45 * end.s, 2000 * (edge - geometry.slider(end.s).value), 1e-10);
  // The run over time stops there, too.
  Equations equations(model, false);
  const RunOutcome out = run_by("dop853", equations, 10, 1e-12);
  EXPECT_NEAR(angle(equations, out), end.s, 1e-11);
  ASSERT_FALSE(out.events.empty());
  EXPECT_EQ(out.events.back().what, "comes to rest and is held");
  EXPECT_NEAR(out.events.back().t, end.t, 1e-11);
}

// --- stepper over the angle ---

TEST(WorkEquation, DrivenSliderCrankMatchesItsReferenceToElevenDigits) {
  Equations equations(rigid(test::scene_file("scenes/driven_slider_crank.toml")), false);
  const RunOutcome out = run_by("work", equations, 10, 1e-12);
  EXPECT_EQ(out.statistics.method, "work_equation");
  EXPECT_NEAR(angle(equations, out), 175.990300636005, 1e-11);
  EXPECT_NEAR(speed(equations, out), 22.9514530858349, 1e-11);
  EXPECT_EQ(out.t, 10);
  // One event an edge: dead centres at every half-turn passed, and where the load sets in.
  EXPECT_EQ(std::count_if(out.events.begin(), out.events.end(),
                          [](const Event& e) { return e.what.find("dead centre") != std::string::npos; }),
            56);
  EXPECT_EQ(std::count_if(out.events.begin(), out.events.end(), [](const Event& e) { return e.what == "load edge"; }),
            28);
}

TEST(WorkEquation, TooSlowTheCrankStopsUnderTheLoadAndTheStallIsReported) {
  const Result r = test::run(with(with(project_text("scenes/driven_slider_crank.toml"), "\"20 rad/s\"", "\"10 rad/s\""),
                                  "accuracy = 1e-7", "accuracy = 1e-9\nmethod = \"work\""));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_angle.crank"), 2.01784108852116, 1e-12);
  EXPECT_EQ(figure(r, "final_speed.crank"), 0);
  ASSERT_FALSE(r.events.empty());
  EXPECT_EQ(r.events.back().what, "comes to rest and is held");
  EXPECT_NEAR(r.events.back().t, 0.183369336380253, 1e-11);
  ASSERT_FALSE(r.claims.empty());
  EXPECT_NE(r.claims.front().text.find("stalls at 115.6° after 0.183 s"), std::string::npos) << r.claims.front().text;
}

// Energy from the work diagram: the speed lies on √(2E/I_r) to the last digits after 10⁴ turns, and the phase error
// grows by no more than the time.
TEST(WorkEquation, EnergyOfTheFreeCrankIsExactAndItsPhaseErrorLinearOverTenThousandTurns) {
  const auto model = rigid(test::scene_file("scenes/free_slider_crank.toml"));
  const double period = period_of_free_crank(30);
  const SliderCrankGeometry geometry = free_crank();
  const double energy = 0.5 * geometry.inertia(0.0).value * 900;
  const double per_turn = 1e-9;  // rad, a tenth of the tolerance
  for (const double turns : {1e2, 1e3, 1e4}) {
    Equations equations(model, false);
    const RunOutcome out = run_by("work", equations, turns * period, 1e-8);
    const double phi = angle(equations, out);
    EXPECT_NEAR(phi, 2 * pi * turns, per_turn * turns);
    EXPECT_NEAR(speed(equations, out), std::sqrt(2 * energy / geometry.inertia(phi).value), 1e-11);
  }
}

// A press from rest, a pump, a compressor, engines: the same figures as over time, within the errors both state.
TEST(WorkEquation, EveryRigidMachineMovesAsItDoesOverTime) {
  for (const char* file : {"crank_press", "piston_pump", "compressor", "single_cylinder_engine", "driven_slider_crank",
                           "free_slider_crank"}) {
    Scene scene = test::scene_file(fmt::format("scenes/{}.toml", file));
    scene.effects = {};
    scene.run.until = std::min(scene.run.until, 2.0);
    scene.run.accuracy = 1e-8;
    scene.run.method = "dop853";
    const Result time = test::run(scene);
    scene.run.method = "work";
    const Result over_angle = test::run(scene);
    ASSERT_TRUE(over_angle.complete) << over_angle.diagnosis;
    EXPECT_TRUE(over_angle.accuracy_confirmed) << file;
    EXPECT_LE(over_angle.energy.relative, 1e-8) << file;
    EXPECT_EQ(over_angle.events.size(), time.events.size()) << file;
    EXPECT_EQ(over_angle.cycles.size(), time.cycles.size()) << file;
    for (const Figure& f : over_angle.figures) {
      const Figure* other = time.find(f.name);
      ASSERT_NE(other, nullptr) << f.name;
      const double stated = f.error.value_or(0) + other->error.value_or(0);
      EXPECT_NEAR(f.value, other->value, 2 * stated + 2e-8 * f.scale) << file << " " << f.name;
    }
  }
}

// A heavy motor against a weight: thrown backwards first, through rest, then forwards. Nothing opposes motion, so
// nothing stops the passage through ω = 0.
TEST(WorkEquation, ReversalThroughRestIsTheSameAsOverTime) {
  const Scene scene = scene_from(R"(
line = ["motor", "crank"]
[motor]
kind = "dc shunt motor"
stall_torque = "30 N*m"
no_load_speed = "40 rad/s"
inertia = "0.1 kg*m2"
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.3 kg*m2"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
gravity = "9.80665 m/s2"
stroke_angle = "90 deg"
load = { kind = "medium", viscous = "20 N*s/m" }
[run]
start = { speed = "-25 rad/s" }
until = "3 s"
)");
  const auto model = rigid(scene);
  Equations by_time(model, false), by_angle(model, false);
  const RunOutcome time = run_by("dop853", by_time, 3, 1e-13), work = run_by("work", by_angle, 3, 1e-12);
  EXPECT_LT(run_by("work", by_angle, 0.2, 1e-9).state[by_angle.speed_index(0)], 0);  // still backwards
  EXPECT_NEAR(speed(by_time, time), speed(by_angle, work), 1e-9);
  Equations again(model, false);
  EXPECT_NEAR(angle(by_time, time), angle(again, run_by("work", again, 3, 1e-12)), 1e-9);
}

// Steps of equal angle: halving them divides the error by 2⁸.
TEST(WorkEquation, StepperOverTheAngleIsOfOrderEight) {
  const Scene scene =
      scene_from(with(project_text("scenes/driven_slider_crank.toml"),
                      "load = { kind = \"press\", nominal_force = \"2 kN\", nominal_travel = \"100 mm\", "
                      "working_end = \"folded\" }",
                      ""));
  const auto model = rigid(scene);
  const auto time_after_two_turns = [&](int steps) {
    Equations equations(model, false);
    WorkTables tables(model);
    MotionOverAngle motion(equations, tables);
    ErrorControl loose = motion.error_control(1e6);
    ExplicitRungeKutta stepper(dormand_prince_853(), motion, loose);
    const std::vector<double> y = equations.start(0);
    std::vector<double> x(motion.size());
    motion.start(0, y, x);
    stepper.start(0, x);
    while (stepper.t() < 4 * pi) stepper.step(4 * pi);  // finds that no step is too long
    stepper.start(0, x);
    for (int i = 1; i <= steps; ++i) {
      const double end = 4 * pi * i / steps;
      stepper.step(end);
      EXPECT_EQ(stepper.t(), end);
    }
    return stepper.y()[1];
  };
  const double exact = time_after_two_turns(512);
  const double e1 = std::abs(time_after_two_turns(12) - exact), e2 = std::abs(time_after_two_turns(24) - exact),
               e3 = std::abs(time_after_two_turns(48) - exact);
  EXPECT_GT(std::log2(e1 / e2), 7.5);
  EXPECT_GT(std::log2(e2 / e3), 7.5);
}

// --- choice ---

TEST(WorkEquation, IsChosenForRigidMachinesThatRunOverManyTurnsAndNotOtherwise) {
  const auto chosen = [](Scene scene, const Effects& effects) {
    scene.effects = effects;
    scene.run.until = std::min(scene.run.until, 4.0);
    return test::run(scene, false).statistics;
  };
  const Scene press = test::scene_file("scenes/crank_press.toml"),
              chain = test::scene_file("scenes/six_inertia_chain.toml");
  EXPECT_EQ(chosen(press, {}).method, "work_equation");
  EXPECT_NE(chosen(press, {}).reason.find("rigid"), std::string::npos);
  EXPECT_EQ(chosen(chain, {}).method, "dormand_prince_853");  // nothing varies with the angle
  EXPECT_NE(chosen(press, press.effects).method, "work_equation");
}

TEST(WorkEquation, RefusesInWordsWhatItCannotDo) {
  const auto refused = [](const std::string& text) -> std::string {
    Scene scene = scene_from(text);
    scene.run.method = "work";
    try {
      test::run(scene, false);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto wheel = [&](const std::string& more) { return refused(flywheel_with(more, "speed = \"1 rad/s\"")); };
  EXPECT_NE(refused(project_text("scenes/six_inertia_chain.toml")).find("the machine is elastic"), std::string::npos);
  const std::string harmonic =
      wheel("[shaker]\nkind = \"torque source\"\non = \"wheel\"\namplitude = \"5 N*m\"\nfrequency = \"3 Hz\"\n");
  EXPECT_NE(harmonic.find("\"shaker\" depends on time"), std::string::npos) << harmonic;
  const std::string window =
      wheel("[late]\nkind = \"torque source\"\non = \"wheel\"\ntorque = \"5 N*m\"\nstart = \"0.5 s\"\n");
  EXPECT_NE(window.find("\"late\" depends on time"), std::string::npos) << window;
  const std::string table = wheel(
      "[turbine]\nkind = \"motor\"\non = \"wheel\"\ninertia = \"0.1 kg*m2\"\ntorque = { over = \"speed\", unit = "
      "[\"rad/s\", \"N*m\"], points = [[0, 5], [10, 3], [20, 0]] }\n");
  EXPECT_NE(table.find("table over speed"), std::string::npos) << table;
  const std::string given = refused(
      "line = [\"drive\", \"wheel\"]\n[drive]\nkind = \"prescribed speed\"\nspeed = \"20 rad/s\"\n[wheel]\nkind = "
      "\"flywheel\"\ninertia = \"1 kg*m2\"\n[run]\nuntil = \"1 s\"\n");
  EXPECT_NE(given.find("prescribed speed"), std::string::npos) << given;
}

}  // namespace
}  // namespace kurbel::work_equation_test
