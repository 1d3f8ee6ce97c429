// output_test.cpp — results as files: the JSON that programs read, the CSV, and a run against the full multibody.
#include "studies/run/run_findings.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "studies/report/render.h"
#include "studies/report/write_output.h"
#include "tests/support/scenes.h"

namespace kurbel::output_test {
namespace {

using test::figure;
using test::run;

// The press at working speed, its torques in balance.
Scene press_at_speed() {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.start.speed = 59 * M_PI / 30;
  scene.run.start.equilibrium = true;
  scene.run.until = 2.5;
  return scene;
}

Comparison press_comparison() {
  const Scene scene = press_at_speed();
  return compare(scene, {{}, scene.effects, "rigid", "elastic"}, {});
}

TEST(Summary, HoldsModelFiguresFinalStatesEventsBalanceAndStatistics) {
  const Scene scene = press_at_speed();
  const auto j = nlohmann::json::parse(output_of(run(scene)).json());
  EXPECT_EQ(j.at("title"), "Crank press, 630 kN");
  EXPECT_EQ(j.at("model").at("coordinates"), 5);
  EXPECT_TRUE(j.at("model").at("effects").is_string());
  bool found = false;
  for (const auto& f : j.at("figures")) {
    for (const char* key : {"name", "value", "unit", "error", "at"}) ASSERT_TRUE(f.contains(key)) << key;
    if (f.at("name") == "peak_torque.main_coupling") {
      found = true;
      EXPECT_EQ(f.at("unit"), "N*m");
      EXPECT_GT(f.at("error").get<double>(), 0);
      EXPECT_LT(f.at("error").get<double>(), 1e-3);
    }
  }
  EXPECT_TRUE(found);
  for (const char* component : {"motor", "motor_coupling", "gearbox", "main_coupling", "flywheel", "press"}) {
    EXPECT_TRUE(j.at("final").at(component).at("angle").is_number());
    EXPECT_TRUE(j.at("final").at(component).at("speed").is_number());
  }
  // From 90° on in 2.5 s: two working strokes with four knees of the force each, two extended, three folded dead
  // centres.
  EXPECT_EQ(j.at("events").size(), 13u);
  EXPECT_LE(j.at("energy_balance").at("relative").get<double>(), 1e-5);
  EXPECT_GT(j.at("statistics").at("steps").get<int>(), 0);
}

TEST(Summary, OfAComparisonHoldsBothModels) {
  const Comparison c = press_comparison();
  const auto j = nlohmann::json::parse(output_of(c).json());
  EXPECT_EQ(j.at("models").at("rigid").at("model").at("coordinates"), 1);
  EXPECT_EQ(j.at("models").at("elastic").at("model").at("coordinates"), 5);
  for (const auto& factor : j.at("amplification")) EXPECT_GT(factor.at("value").get<double>(), 0);
  EXPECT_NE(c.conclusion.find("peak torque in"), std::string::npos);
}

TEST(Figures, AreListedBeforeTheyAreRun) {
  const Scene scene = press_at_speed();
  std::vector<std::string> listed;
  for (const Figure& f : figure_list(*compile(scene, scene.effects))) listed.push_back(f.name);
  for (const Figure& f : run(scene).figures)
    EXPECT_NE(std::find(listed.begin(), listed.end(), f.name), listed.end()) << f.name;
}

TEST(Trajectory, NamesUnitsAndEndsAtTheEnd) {
  Scene scene = test::scene_file("scenes/driven_slider_crank.toml");
  scene.run.samples = 11;
  const std::string folder =
      (std::filesystem::path(::testing::TempDir()) / ("kurbel_trajectory_" + std::to_string(getpid()))).string();
  const Result result = run(scene, false);
  write_output(output_of(result), folder);
  std::ifstream in(folder + "/trajectory.csv");
  std::string header, line, last;
  std::getline(in, header);
  EXPECT_TRUE(header.starts_with("time [s],angle.motor [rad],speed.motor [rad/s],torque.motor [N*m]")) << header;
  EXPECT_NE(header.find("force.crank [N]"), std::string::npos);
  int rows = 0;
  while (std::getline(in, line)) {
    rows += std::stod(line) == std::round(std::stod(line));  // at whole seconds; at peaks there are others
    last = line;
  }
  EXPECT_EQ(rows, 11);
  EXPECT_TRUE(last.starts_with("10,"));
  std::filesystem::remove_all(folder);
}

// A run that broke off because its motion had lost all values: none of them is reported, anywhere.
TEST(Output, WhatHasNoValueInARunThatBrokeOffIsOmitted) {
  Result r = run(press_at_speed(), false);
  const std::string lost = r.figures.front().name, kept = r.figures.back().name;
  for (const double none : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    r.complete = false;
    r.diagnosis = "the motion lost its values";
    r.figures.front().value = none;
    r.energy.by_line["driving"] = r.energy.relative = none;
    const StudyOutput output = output_of(r);
    const auto json = nlohmann::json::parse(output.json());
    for (const auto& figure : json["figures"]) EXPECT_TRUE(figure["value"].is_number()) << figure;
    const std::string page = html_of(output.report());
    for (const std::string& text : {output.text(), output.conclusion(), page.substr(page.find("id=\"data\""))}) {
      EXPECT_EQ(text.find("nan"), std::string::npos)
          << text.substr(std::max<std::size_t>(text.find("nan"), 60) - 60, 99);
      EXPECT_EQ(text.find("inf "), std::string::npos);
    }
    EXPECT_EQ(output.text().find(lost), std::string::npos);
    EXPECT_NE(output.text().find(kept), std::string::npos);
  }
}

// The work of one press stroke is the area under its force: rise 0.5 mm, 2.5 mm full, drop 0.2 mm.
TEST(Press, UsefulWorkPerCycleIsTheAreaOfItsProfile) {
  const Result r = run(press_at_speed());
  EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -630e3 * (0.5e-3 / 2 + 2.5e-3 + 0.2e-3 / 2), 1e-6);
}

// Switched on at rest with the crank exactly on a dead centre, where nothing pushes it yet: it starts all the same,
// rigid and elastic, and the run-up raises the elastic torque far above the rigid one.
TEST(Press, StartsFromRestOnADeadCentre) {
  for (const double angle : {0.0, M_PI}) {
    Scene scene = test::scene_file("scenes/crank_press.toml");
    scene.run.start.angle = angle;
    scene.run.until = 3;
    const Comparison c = compare(scene, {{}, scene.effects, "rigid", "elastic"}, {});
    ASSERT_TRUE(c.a.complete) << c.a.diagnosis;
    ASSERT_TRUE(c.b.complete) << c.b.diagnosis;
    EXPECT_GT(figure(c.a, "final_speed.press"), 5);
    EXPECT_NEAR(figure(c.a, "final_speed.press"), figure(c.b, "final_speed.press"), 0.5);
    EXPECT_LE(c.b.energy.relative, 1e-5);
    // The rigid motor sees Kloss' starting torque at once; with the lag of its fluxes the elastic coupling is loaded more
    // gently, and on the curve alone it rings to more than twice its share.
    EXPECT_GT(c.amplification[0].b->value, 1);
    scene.effects.torque_lag = false;
    const Comparison curve = compare(scene, {{}, scene.effects, "rigid", "elastic"}, {});
    EXPECT_GT(curve.amplification[0].b->value, 1.5);
  }
}

// The reduced machine against Simbody's closed loop, weight and slider load included.
TEST(ReducedMachine, RunsAsTheFullMultibody) {
  Scene scene = test::scene_from(R"(
line = ["motor", "gearbox", "pump"]
[motor]
kind = "dc shunt motor"
stall_torque = "20 N*m"
no_load_speed = "80 rad/s"
inertia = "0.02 kg*m2"
[gearbox]
kind = "gearbox"
stages = [{ teeth = [20, 50], inertia = ["0.001 kg*m2", "0.01 kg*m2"] }]
[pump]
kind = "slider-crank"
radius = "50 mm"
rod = "180 mm"
offset = "10 mm"
crank_mass = "4 kg"
crank_com = "12 mm"
crank_inertia = "0.05 kg*m2"
rod_mass = "1.5 kg"
rod_com = "60 mm"
rod_inertia = "0.006 kg*m2"
slider_mass = "2.5 kg"
gravity = "9.81 m/s2"
stroke_angle = "60 deg"
load = { kind = "medium", viscous = "120 N*s/m", quadratic = "30 N*s2/m2" }
[run]
start = { speed = "15 rad/s", angle = "30 deg" }
until = "0.6 s"
accuracy = 1e-7
)");
  const Result reduced = run(scene);
  scene.run.model = "multibody";
  const Result multibody = run(scene);
  ASSERT_TRUE(multibody.complete) << multibody.diagnosis;
  const double error = *multibody.find("final_angle.pump")->error + 2e-8;
  EXPECT_LT(error, 1e-6);
  EXPECT_NEAR(figure(reduced, "final_angle.pump"), figure(multibody, "final_angle.pump"), error);
  EXPECT_NEAR(figure(reduced, "final_speed.pump"), figure(multibody, "final_speed.pump"), 100 * error);
}

TEST(Periods, RunUpSteadyRunDownAndStandstillAreRecognised) {
  const Result r = run(R"(
line = ["motor", "rotor"]
[motor]
kind = "dc shunt motor"
stall_torque = "100 N*m"
no_load_speed = "100 rad/s"
inertia = "1 kg*m2"
stop = "20 s"
[rotor]
kind = "load"
torque = "20 N*m"
inertia = "1 kg*m2"
[run]
until = "30 s"
accuracy = 1e-7
)");
  // ω = 80 (1 − e^(−t/2)): within 1 % of ω(20) at t = −2 ln(1 − 0.99 (1 − e^(−10))); then 2 ω̇ = −20 from 80 rad/s:
  // stops 8 s after the motor.
  ASSERT_TRUE(r.periods.run_up_end && r.periods.run_down_begin && r.periods.standstill);
  EXPECT_NEAR(*r.periods.run_up_end, -2 * std::log(1 - 0.99 * (1 - std::exp(-10.0))), 1e-6);
  EXPECT_LT(*r.find("run_up_time")->error, 1e-4);
  EXPECT_EQ(*r.periods.run_down_begin, 20);
  EXPECT_NEAR(*r.periods.standstill, 20 + 80 * (1 - std::exp(-10.0)) / 10, 1e-6);
}

}  // namespace
}  // namespace kurbel::output_test
