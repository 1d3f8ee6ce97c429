// mechanism_loads_test.cpp — four-bar, quick-return and knuckle press in motion: energy, work of loads per cycle.
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "engine/events/equations.h"
#include "engine/model/model.h"
#include "mechanisms/reduced/mechanism.h"
#include "tests/mechanisms/linkage_truth.h"
#include "tests/support/scenes.h"

namespace kurbel::mechanism_loads_test {
namespace {

using std::numbers::pi;
using test::figure;
using test::run;

FourBarData four_bar() {
  FourBarData d;
  d.crank = 0.06, d.coupler = 0.2, d.rocker = 0.15, d.ground = 0.22;
  d.crank_body.inertia = 0.05;
  d.coupler_body = {1, 0.1, 0.004};
  d.rocker_body = {2, 0.08, 0.02};
  d.gravity = 9.81, d.ground_angle = 0.3;
  return d;
}
const std::string four_bar_text = R"(
kind = "four-bar"
crank = "60 mm"
coupler = "200 mm"
rocker = "150 mm"
ground = "220 mm"
crank_inertia = "0.05 kg*m2"
coupler_mass = "1 kg"
coupler_inertia = "0.004 kg*m2"
rocker_mass = "2 kg"
rocker_com = "80 mm"
rocker_inertia = "0.02 kg*m2"
gravity = "9.81 m/s2"
ground_angle = "0.3 rad"
)";

QuickReturnData shaper() {
  QuickReturnData d;
  d.radius = 0.1, d.pivot_distance = 0.25, d.lever = 0.5, d.link = 0.25, d.guide_height = 0.48, d.backward = true;
  d.crank_body = {3, -0.02, 2};
  d.lever_body = {10, 0.24, 0.9};
  d.block_mass = 1, d.block_inertia = 0.001;
  d.link_body = {4, 0.125, 0.03};
  d.ram_mass = 60;
  d.gravity = 9.81, d.stroke_angle = 0.2;
  return d;
}
const std::string shaper_text = R"(
kind = "quick-return"
radius = "100 mm"
pivot_distance = "250 mm"
lever = "500 mm"
link = "250 mm"
guide_height = "480 mm"
branch = "backward"
crank_mass = "3 kg"
crank_com = "-20 mm"
crank_inertia = "2 kg*m2"
lever_mass = "10 kg"
lever_com = "240 mm"
lever_inertia = "0.9 kg*m2"
block_mass = "1 kg"
block_inertia = "0.001 kg*m2"
link_mass = "4 kg"
link_inertia = "0.03 kg*m2"
ram_mass = "60 kg"
gravity = "9.81 m/s2"
stroke_angle = "0.2 rad"
)";

KnucklePressData toggle() {
  KnucklePressData d;
  d.radius = 0.04, d.rod = 0.36;
  d.bearing_x = -0.35, d.bearing_y = 0.38, d.guide = 0.38;
  d.upper = d.lower = 0.35;
  d.knee_right = true;
  d.crank_body = {40, 0.01, 3};
  d.rod_body = {30, 0.18, 0.5};
  d.upper_body = {20, 0.17, 0.9};
  d.lower_body = {20, 0.175, 0.3};
  d.ram_mass = 400;
  d.gravity = 9.81, d.stroke_angle = -pi / 2;
  return d;
}
const std::string toggle_text = R"(
kind = "knuckle press"
radius = "40 mm"
rod = "360 mm"
bearing_x = "-350 mm"
bearing_y = "380 mm"
upper = "350 mm"
lower = "350 mm"
branch = "right"
crank_mass = "40 kg"
crank_com = "10 mm"
crank_inertia = "3 kg*m2"
rod_mass = "30 kg"
rod_inertia = "0.5 kg*m2"
upper_mass = "20 kg"
upper_com = "170 mm"
upper_inertia = "0.9 kg*m2"
lower_mass = "20 kg"
lower_inertia = "0.3 kg*m2"
ram_mass = "400 kg"
gravity = "9.81 m/s2"
stroke_angle = "-90 deg"
)";

// Runs free from 12 rad/s; ½ I_r ω² + V of the loop equations is the same at the end as at the start.
template <class Data>
void expect_free_run_keeps_its_energy(const Data& data, const std::string& text) {
  const Result r = run("line = [\"m\"]\n[m]" + text +
                       "[run]\nstart = { speed = \"12 rad/s\", angle = \"40 deg\" }\nuntil = \"8 s\"\naccuracy = "
                       "1e-10\n");
  const auto energy = [&](double phi, double omega) {
    const test::LinkageTruth truth = test::truth_of(data, phi);
    return static_cast<double>(truth.value[0] * omega * omega / 2 + truth.potential_energy);
  };
  const double phi = figure(r, "final_angle.m"), omega = figure(r, "final_speed.m");
  const double start = energy(40 * pi / 180, 12);
  EXPECT_GT(phi, 12);  // several turns
  EXPECT_NEAR(energy(phi, omega) / start, 1, 1e-9);
  EXPECT_NEAR(r.energy.kinetic_start, static_cast<double>(test::truth_of(data, 40 * pi / 180).value[0]) * 72, 1e-10);
  EXPECT_LE(r.energy.relative, 1e-9);
  EXPECT_LE(r.energy.reduction_residual, 1e-11);  // ½ I_r ω² against Simbody's bodies
  EXPECT_TRUE(r.accuracy_confirmed);
}

TEST(FourBar, FreeRunKeepsItsEnergy) { expect_free_run_keeps_its_energy(four_bar(), four_bar_text); }
TEST(QuickReturn, FreeRunKeepsItsEnergy) { expect_free_run_keeps_its_energy(shaper(), shaper_text); }
TEST(KnucklePress, FreeRunKeepsItsEnergy) { expect_free_run_keeps_its_energy(toggle(), toggle_text); }

// At prescribed speed; useful work of one turn.
Result turning(const std::string& text, const std::string& load) {
  return run("line = [\"drive\", \"m\"]\n[drive]\nkind = \"prescribed speed\"\nspeed = \"10 rad/s\"\n[m]" + text +
             "load = " + load + "\n[run]\nuntil = \"3 s\"\naccuracy = 1e-8\n");
}

double swing() {
  const Mechanism m("m", four_bar());
  return m.stroke();
}

TEST(FourBar, OpposingTorqueTakesTwiceTheSwing) {
  const Result r = turning(four_bar_text, "{ kind = \"opposing\", torque = \"30 N*m\" }");
  EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -30 * 2 * swing(), 1e-8);
  // It reverses at each dead centre that the crank passes in 30 rad.
  const Mechanism m("m", four_bar());
  std::map<std::string, int> expected, met;
  for (const double phi : m.travel.reversals) {
    const bool greatest = m.reduced->output_position(phi).value > m.travel.least + 0.1;
    expected[greatest ? "greatest angle" : "least angle"] = static_cast<int>(std::floor((30 - phi) / (2 * pi))) + 1;
  }
  for (const Event& e : r.events) ++met[e.what];
  EXPECT_EQ(expected.size(), 2u);
  for (const auto& [what, times] : expected) EXPECT_EQ(met[what], times) << what;
}
TEST(FourBar, ConstantTorqueDoesNoWorkInATurn) {
  EXPECT_NEAR(figure(turning(four_bar_text, "{ kind = \"constant\", torque = \"30 N*m\" }"), "useful_work_per_cycle"),
              0, 1e-8);
}
// ∮ c ω dψ = c Ω ∫ ψ′² dφ, by the trapezium rule from the loop equations; quadratic: q Ω² ∫ |ψ′|³ dφ.
TEST(FourBar, MediumTakesTheIntegralOfSpeedSquared) {
  const int n = 2000;
  double square = 0, cube = 0;
  for (int i = 0; i < n; ++i) {
    const auto ratio = static_cast<double>(test::truth_of(four_bar(), 2 * pi * i / n).value[4]);
    square += ratio * ratio * 2 * pi / n;
    cube += std::fabs(ratio * ratio * ratio) * 2 * pi / n;
  }
  EXPECT_NEAR(
      figure(turning(four_bar_text, "{ kind = \"medium\", viscous = \"3 N*m*s/rad\" }"), "useful_work_per_cycle"),
      -3 * 10 * square, 1e-8);
  EXPECT_NEAR(
      figure(turning(four_bar_text, "{ kind = \"medium\", quadratic = \"0.4 N*m*s2/rad2\" }"), "useful_work_per_cycle"),
      -0.4 * 100 * cube, 1e-7);
}
// The loop of two branches over the swing: area between them, at either end.
TEST(FourBar, SwingTableWithTwoBranchesTakesTheAreaBetween) {
  for (const char* end : {"greatest", "least"}) {
    const Result r = turning(four_bar_text, std::string("{ kind = \"table\", working_end = \"") + end +
                                                "\", torque = { over = \"swing\", unit = [\"deg\", \"N*m\"], points = "
                                                "[[0, 90], [90, 0]], return_points = [[0, 30], [90, 30]] } }");
    const double s = swing(), quarter = pi / 2;
    const double approach = 90 * (s - s * s / 2 / quarter), retreat = 30 * s;
    EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -(approach - retreat), 1e-8) << end;
  }
}
// A torque over the crank angle alone: its work is ∮ M ψ′ dφ. 20 N·m away from the greatest angle while 0 < φ < 180°.
TEST(FourBar, TableOverTheCrankAngleWorksOverTheSwingOfThatHalfTurn) {
  const Result r = turning(four_bar_text,
                           "{ kind = \"table\", torque = { over = \"angle\", unit = [\"deg\", \"N*m\"], points = [[0, "
                           "20], [180, 20], [180.0001, 0], [359.9999, 0]] } }");
  const auto angle = [](double phi) { return static_cast<double>(test::truth_of(four_bar(), phi).value[3]); };
  EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -20 * (angle(pi) - angle(0)), 1e-4);
}
TEST(FourBar, OpposingTorqueHoldsTheMachineThatItStopped) {
  const Result r =
      run("line = [\"m\"]\n[m]" + four_bar_text +
          "load = { kind = \"opposing\", torque = \"30 N*m\" }\n[run]\nstart = { speed = \"5 rad/s\", angle "
          "= \"60 deg\" }\nuntil = \"2 s\"\naccuracy = 1e-8\n");
  ASSERT_FALSE(r.events.empty());
  EXPECT_EQ(r.events.back().what, "comes to rest and is held");
  EXPECT_EQ(figure(r, "final_speed.m"), 0);
  EXPECT_LE(r.energy.relative, 1e-8);
}

// The ram's stroke is 2 L r/d = 400 mm.
TEST(QuickReturn, OpposingForceTakesTwiceTheStroke) {
  EXPECT_NEAR(figure(turning(shaper_text, "{ kind = \"opposing\", force = \"700 N\" }"), "useful_work_per_cycle"),
              -700 * 0.8, 1e-7);
}
TEST(QuickReturn, CutTakesItsAreaAtEitherEnd) {
  for (const char* end : {"extended", "folded"}) {
    const Result r =
        turning(shaper_text,
                std::string("{ kind = \"press\", nominal_force = \"2 kN\", nominal_travel = \"350 mm\", rise = \"4 "
                            "mm\", breakthrough = \"40 mm\", drop = \"2 mm\", working_end = \"") +
                    end + "\" }");
    EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -2e3 * (0.002 + 0.306 + 0.001), 1e-6) << end;
  }
}

// The links fall in line twice a turn, and the press works on each of the two working strokes; between them the ram
// comes back less than the nominal travel, and works again over what it came back.
TEST(KnucklePress, WorksTwiceATurnWhereTheKneeCrossesTheLine) {
  const Mechanism m("m", toggle());
  std::vector<double> ends;
  for (const double phi : m.travel.reversals) ends.push_back(m.reduced->output_position(phi).value);
  ASSERT_EQ(ends.size(), 4u);
  std::sort(ends.begin(), ends.end());
  const double back = m.travel.greatest - ends[1];  // between the two working ends
  EXPECT_LT(back, 5e-3);
  EXPECT_GT(back, 1e-4);
  const Result r = turning(toggle_text, "{ kind = \"press\", nominal_force = \"900 kN\", nominal_travel = \"5 mm\" }");
  EXPECT_NEAR(figure(r, "useful_work_per_cycle") / (-900e3 * (0.005 + back)), 1, 1e-9);
}

// What Simbody's integrators would pass over without a word: steps of a sequence, friction in the joints.
TEST(SliderLoads, MultibodyRunIsRefusedWhereItWouldLeaveSomethingOut) {
  const std::string crank =
      "line = [\"m\"]\n[run]\nmodel = \"multibody\"\nuntil = \"0.1 s\"\nstart = { speed = \"10 rad/s\" }\n[m]\nkind = "
      "\"slider-crank\"\nradius = \"100 mm\"\nrod = \"350 mm\"\ncrank_inertia = \"0.5 kg*m2\"\nslider_mass = \"3 kg\"\n"
      "load = { kind = \"medium\", viscous = \"60 N*s/m\" }\nguide = { friction = 0.1 }\n";
  EXPECT_TRUE(run(test::scene_from(crank)).complete);
  for (const auto& [more, why] : {std::pair("[sequence]\nsteps = [{ at = \"50 ms\", set = \"m\", to = 0 }]\n",
                                            "no operating sequence is carried out"),
                                  std::pair("[effects]\njoint_friction = true\n", "joint_friction must be off")})
    try {
      run(test::scene_from(crank + more));
      FAIL() << "ran";
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
}

// Simbody's own integrators over the closed loop, with a load on the output, end where the reduced machine ends.
TEST(Linkages, MultibodyRunOfAnyMechanismIsTheReducedRun) {
  for (const auto& [mechanism, load] :
       {std::pair(four_bar_text, "load = { kind = \"medium\", viscous = \"3 N*m*s/rad\" }\n"),
        std::pair(shaper_text, "load = { kind = \"medium\", viscous = \"200 N*s/m\" }\n"),
        std::pair(toggle_text, "load = { kind = \"constant\", force = \"-900 N\" }\n")}) {
    const std::string text = "line = [\"m\"]\n[m]" + mechanism + load +
                             "[run]\nuntil = \"0.3 s\"\naccuracy = 1e-8\nstart = { speed = \"20 rad/s\" }\n";
    const Result reduced = run(test::scene_from(text));
    const Result closed = run(test::scene_from(text + "model = \"multibody\"\n"));
    EXPECT_NEAR(figure(closed, "final_angle.m"), figure(reduced, "final_angle.m"), 1e-6);
    EXPECT_NEAR(figure(closed, "final_speed.m"), figure(reduced, "final_speed.m"), 1e-5);
  }
}

TEST(Linkages, MultibodyRunOfTwoMechanismsIsRefusedInWords) {
  const Scene scene = test::scene_from("line = [\"m\", \"n\"]\n[m]" + four_bar_text + "[n]" + four_bar_text +
                                       "[run]\nmodel = \"multibody\"\nuntil = \"1 s\"\n");
  try {
    run(scene);
    FAIL() << "ran";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("needs exactly one mechanism; use model = \"reduced\""), std::string::npos)
        << error.what();
  }
}

// A study asks the mechanism for what the equations apply: the same pieces, the same terms, to the bit.
TEST(MechanismLoad, ByAngleAndSpeedIsTheForceThatTheEquationsApply) {
  const std::string crank = R"(
line = ["m", "wheel"]
[wheel]
kind = "flywheel"
inertia = "1 kg*m2"
[m]
kind = "slider-crank"
radius = "100 mm"
rod = "400 mm"
offset = "10 mm"
slider_mass = "5 kg"
load = )";
  for (
      const char* load : {
          R"({ kind = "press", nominal_force = "100 kN", nominal_travel = "20 mm", rise = "2 mm" })",
          R"({ kind = "opposing", force = "1 kN" })",
          R"([{ kind = "medium", viscous = "100 N*s/m" }, { kind = "constant", force = "-50 N" }])",
          R"({ kind = "compressor", bore = "80 mm", suction_pressure = "1 bar", delivery_pressure = "6 bar", clearance = 0.06 })",
      }) {
    const Scene scene = test::scene_from(crank + load + "\n");
    for (const bool load_edges : {true, false}) {
      Effects effects;
      effects.load_edges = load_edges;
      const auto model = compile(scene, effects);
      const Mechanism* const mechanism = find_mechanism(model->network, "m");
      ASSERT_NE(mechanism, nullptr);
      EXPECT_EQ(find_mechanism(model->network, "wheel"), nullptr);
      Equations equations(model, false);
      for (const Channel& channel : model->pool_channels) {
        if (channel.name.what != quantities::force || channel.name.of != "m") continue;
        for (const double omega : {30.0, -30.0})
          for (int k = 0; k < 400; ++k) {
            const double phi = pi * k / 100;
            const std::vector<double> y = equations.modes_from_scratch(0, phi, omega);
            EXPECT_EQ(mechanism->load(phi, omega), channel.value(equations.snapshot(0, y))) << load << " at " << phi;
          }
      }
      double sum = 0;
      std::vector<bool> none(mechanism->loads.size(), false);
      for (std::size_t k = 0; k < mechanism->loads.size(); ++k) {
        std::vector<bool> one = none;
        one[k] = true;
        sum += mechanism->load(1, 30, one);
      }
      EXPECT_DOUBLE_EQ(sum, mechanism->load(1, 30));
      EXPECT_EQ(mechanism->load(1, 30, none), 0);
    }
  }
}

}  // namespace
}  // namespace kurbel::mechanism_loads_test
