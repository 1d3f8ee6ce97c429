// forces_test.cpp — the two problems over a cycle against conservation laws, Fourier series and balancing by hand.
#include "studies/forces/forces.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "studies/forces/forces_findings.h"
#include "studies/report/render.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/support/scenes.h"

namespace kurbel::forces_test {
namespace {

constexpr double pi = std::numbers::pi;

Forces forces_of(const std::string& text, ForcesOptions options = {}) {
  return find_forces(test::scene_from(text), options);
}

const CycleWork& work_of(const ForceCycle& c, const std::string& name) {
  for (const CycleWork& w : c.work)
    if (w.name == name) return w;
  throw std::runtime_error("no work of " + name);
}

// Massless rod and crank: what shakes is the slider alone.
const char* const slider_alone = R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "300 mm"
slider_mass = "2 kg"
crank_inertia = "1 kg*m2"
[run]
start = { speed = "20 rad/s" }
until = "2 s"
accuracy = 1e-9
)";

// x″/r = −(cos φ + A₂ cos 2φ + A₄ cos 4φ + …), λ = r/l (Dresig and Holzweißig, Maschinendynamik).
TEST(ShakingForce, HasTheOrdersOfTheSlidersAcceleration) {
  const Forces f = forces_of(slider_alone);
  const double u = 2 * 0.1 * 20 * 20, k = 1.0 / 3;
  const double a2 = k + std::pow(k, 3) / 4 + 15 * std::pow(k, 5) / 128 + 35 * std::pow(k, 7) / 512;
  const double a4 = std::pow(k, 3) / 4 + 3 * std::pow(k, 5) / 16 + 35 * std::pow(k, 7) / 256;
  const std::vector<ForceHarmonic>& x = f.prescribed->shaking_x;
  EXPECT_NEAR(x[0].amplitude.value, u, 1e-12 * u);
  EXPECT_NEAR(x[1].amplitude.value, u * a2, 1e-5 * u);  // the series' next term is 2205 λ⁹/65536 ≈ 2e-6
  EXPECT_NEAR(x[3].amplitude.value, u * a4, 2e-5 * u);
  for (const int odd : {2, 4, 6})
    EXPECT_NEAR(x[static_cast<std::size_t>(odd)].amplitude.value, 0, 1e-11 * u) << odd + 1;
  EXPECT_NEAR(x[0].phase, 0, 1e-12);
  for (const ForceHarmonic& h : f.prescribed->shaking_y) EXPECT_NEAR(h.amplitude.value, 0, 1e-11 * u);
}

TEST(ShakingForce, ShareOfTheFirstOrderThatIsBalancedAppearsAcross) {
  const Forces f = forces_of(slider_alone);
  const double u = 2 * 0.1 * 20 * 20;
  ASSERT_EQ(f.balancing->counterweights.size(), 4u);
  const Counterweight& half = f.balancing->counterweights[2];
  EXPECT_NEAR(half.moment, 0.5 * 2 * 0.1, 1e-14);
  EXPECT_NEAR(half.first_x.value, 0.5 * u, 1e-10 * u);
  EXPECT_NEAR(half.first_y.value, 0.5 * u, 1e-10 * u);
}

TEST(ShakingForce, CounterweightOfLeastPeakIsBetterThanItsNeighbours) {
  const Forces f = forces_of(slider_alone);
  const Counterweight& best = f.balancing->counterweights[3];
  const double w2 = 20.0 * 20.0;
  for (const double other : {0.99, 1.01, 0.9, 1.1}) {
    double peak = 0;
    for (const PositionForces& p : f.prescribed->positions)
      peak = std::max(peak,
                      std::hypot(p.forces.shaking_force.x - other * best.moment * w2 * std::cos(p.forces.state.phi),
                                 p.forces.shaking_force.y - other * best.moment * w2 * std::sin(p.forces.state.phi)));
    EXPECT_GT(peak, best.peak_force.value) << other;
  }
  EXPECT_LT(best.peak_force.value, f.balancing->counterweights[2].peak_force.value);
  EXPECT_LT(best.peak_force.value, 0.7 * f.balancing->counterweights[0].peak_force.value);
}

// A rotating counterweight leaves nothing of masses that only rotate.
TEST(ShakingForce, RotatingMassesAreBalancedCompletely) {
  const Forces f = forces_of(R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "300 mm"
crank_mass = "4 kg"
crank_com = "60 mm"
crank_inertia = "0.05 kg*m2"
rod_mass = "1 kg"
rod_com = "0 mm"
[run]
start = { speed = "50 rad/s" }
until = "0.01 s"
)");
  EXPECT_NEAR(f.balancing->counterweights[0].peak_force.value, (4 * 0.06 + 1 * 0.1) * 2500, 1e-9);
  EXPECT_NEAR(f.balancing->counterweights[1].peak_force.value, 0, 1e-9);
}

// --- second problem ---

// A flywheel gives and takes all that the crank needs: M = −J ε, and ½ (J + I_r) ω² stays.
TEST(SimulatedForces, BalancingTorqueIsWhatTheFlywheelGives) {
  const Forces f = forces_of(R"(
line = ["wheel", "crank"]
[wheel]
kind = "flywheel"
inertia = "0.4 kg*m2"
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.15 kg*m2"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
[run]
start = { speed = "30 rad/s" }
until = "1 s"
accuracy = 1e-10
)");
  ASSERT_TRUE(f.simulated);
  const ForceCycle& c = *f.simulated;
  EXPECT_EQ(c.positions.size(), 721u);
  const SliderCrankGeometry g(f.balancing->data);
  const double energy = 0.5 * (0.4 + g.inertia(0.0).value) * 900;
  for (const PositionForces& p : c.positions) {
    EXPECT_NEAR(p.forces.torque, -0.4 * p.forces.state.alpha, 1e-7 * std::abs(c.torque.value));
    EXPECT_NEAR(0.5 * (0.4 + g.inertia(p.forces.state.phi).value) * p.forces.state.omega * p.forces.state.omega, energy,
                1e-8 * energy);
  }
  EXPECT_NEAR(c.closure.value, 0, 1e-9);
  EXPECT_LT(c.power_residual, 1e-12);
  ASSERT_TRUE(c.torque.error);
  EXPECT_LT(*c.torque.error, 1e-6 * std::abs(c.torque.value));
}

const char* const pump = R"(
line = ["motor", "crank"]
[motor]
kind = "dc shunt motor"
stall_torque = "400 N*m"
no_load_speed = "33 rad/s"
inertia = "2 kg*m2"
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
offset = "20 mm"
crank_inertia = "0.15 kg*m2"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
phase = "{} deg"
load = {{ kind = "opposing", force = "500 N" }}
{}
[run]
start = {{ speed = "{} rad/s" }}
until = "3 s"
accuracy = 1e-8
)";
const char* const rough =
    R"(main_bearing = { radius = "40 mm", friction = 0.05, static_friction = 0.1, stribeck_speed = "0.3 m/s" }
crank_pin = { radius = "30 mm", friction = 0.05 }
slider_pin = { radius = "15 mm", friction = 0.08 }
guide = { friction = 0.1, length = "60 mm", width = "80 mm" })";

TEST(SimulatedForces, WorkOfTheCycleIsThatOfTheLoads) {
  const Forces f = forces_of(fmt::format(fmt::runtime(pump), 0, "", 30));
  ASSERT_TRUE(f.simulated);
  // Twice the stroke against 500 N.
  const SliderCrankGeometry g(f.balancing->data);
  const double work = 2 * 500 * (g.x_max() - g.x_min());
  for (const ForceCycle* c : {&*f.prescribed, &*f.simulated}) {
    EXPECT_NEAR(work_of(*c, "crank.load").work.value, -work, 1e-9 * work) << c->label;
    EXPECT_NEAR(work_of(*c, "balancing torque").work.value, work + c->kinetic_change.value, 1e-7 * work) << c->label;
    EXPECT_NEAR(c->efficiency->value, 1, 1e-6) << c->label;
    EXPECT_LT(c->power_residual, 1e-12);
  }
}

TEST(SimulatedForces, FrictionTakesItsShareOfTheWorkThatGoesIn) {
  const Forces f = forces_of(fmt::format(fmt::runtime(pump), 0, rough, 30));
  ASSERT_TRUE(f.simulated);
  for (const ForceCycle* c : {&*f.prescribed, &*f.simulated}) {
    EXPECT_NEAR(c->input.value, c->useful.value + c->harmful.value + c->kinetic_change.value, 1e-7 * c->input.value)
        << c->label;
    EXPECT_GT(c->harmful.value, 0.02 * c->input.value);
    EXPECT_NEAR(c->efficiency->value, c->useful.value / c->input.value, 1e-15);
    EXPECT_LT(c->friction_residual, 1e-12);
    EXPECT_LT(c->power_residual, 1e-12);
    for (const PositionForces& p : c->positions)
      if (p.power.efficiency()) {
        EXPECT_GE(*p.power.efficiency(), 0);
        EXPECT_LE(*p.power.efficiency(), 1);
      }
  }
}

// A crank keyed at another angle of its shaft moves and loads its joints as before.
TEST(SimulatedForces, DoNotDependOnThePhaseOfTheCrankOnItsShaft) {
  const Forces a = forces_of(fmt::format(fmt::runtime(pump), 0, rough, 30)),
               b = forces_of(fmt::format(fmt::runtime(pump), 100, rough, 30));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(a.simulated->reaction(k).value, b.simulated->reaction(k).value,
                2e-6 * std::abs(a.simulated->reaction(k).value));
}

TEST(SimulatedForces, CrankThatTurnsBackwardsIsLoadedAsItsMirrorImage) {
  const std::string central = R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.5 kg*m2"
slider_mass = "3 kg"
load = {{ kind = "medium", viscous = "20 N*s/m" }}
guide = {{ friction = 0.1 }}
[run]
start = {{ speed = "{} rad/s" }}
until = "1.2 s"
accuracy = 1e-9
)";
  const Forces a = forces_of(fmt::format(fmt::runtime(central), 30)),
               b = forces_of(fmt::format(fmt::runtime(central), -30));
  for (const auto& [one, other] :
       {std::pair{&*a.prescribed, &*b.prescribed}, std::pair{&*a.simulated, &*b.simulated}}) {
    // On the scale of the main bearing's load at the radius: undriven, the simulated crank needs no torque at all.
    EXPECT_NEAR(one->torque.value, -other->torque.value, 1e-7 * 0.1 * one->reaction(0).value) << one->label;
    EXPECT_NEAR(one->reaction(0).value, other->reaction(0).value, 1e-7 * one->reaction(0).value);
    EXPECT_NEAR(one->mean_speed.value, -other->mean_speed.value, 1e-8 * one->mean_speed.value);
    EXPECT_NEAR(work_of(*one, "crank.load").work.value, work_of(*other, "crank.load").work.value, 1e-7);
    EXPECT_NEAR(one->closure.value, other->closure.value, 1e-7);
  }
}

TEST(SimulatedForces, AreOmittedInWordsWhereTheCrankDoesNotRotate) {
  std::string stopped = slider_alone;  // 200 J against 5 kN
  stopped.replace(stopped.find("[run]"), 5, "load = { kind = \"opposing\", force = \"5 kN\" }\n[run]");
  const Forces f = forces_of(stopped);
  EXPECT_FALSE(f.simulated);
  ASSERT_EQ(f.notes.size(), 1u);
  EXPECT_NE(f.notes[0].find("less than a whole cycle of 360°"), std::string::npos) << f.notes[0];
}

// --- options and scenes ---

TEST(ForcesStudy, FourStrokeEngineHasACycleOfTwoTurns) {
  ForcesOptions options;
  options.simulate = false;
  const Forces f = find_forces(test::scene_file("scenes/single_cylinder_engine.toml"), options);
  EXPECT_NEAR(f.prescribed->cycle, 4 * pi, 1e-12);
  EXPECT_EQ(f.prescribed->rows.size() - 1, 24u);
  EXPECT_EQ(work_of(*f.prescribed, "engine.load").kind, "driving");
  EXPECT_EQ(work_of(*f.prescribed, "balancing torque").kind, "useful");
  // Gas force on the piston and the weights aside, the frame's loads are the shaking force.
  const PositionForces& p = f.prescribed->positions[100];
  EXPECT_NEAR(-p.forces.joints[0].force.x, p.forces.state.load + p.forces.shaking_force.x - 9.81 * (5 + 0.62 + 0.48),
              1e-8);
}

TEST(ForcesStudy, PressCarriesItsNominalForceThroughTheSliderPin) {
  ForcesOptions options;
  options.speed = 2 * pi;
  options.simulate = false;
  const Forces f = find_forces(test::scene_file("scenes/crank_press.toml"), options);
  const LinkageForces& s = f.prescribed->positions.front().forces;
  EXPECT_TRUE(std::isfinite(s.torque));
  EXPECT_NEAR(f.prescribed->reaction(2).value, 630e3, 0.01 * 630e3);
}

TEST(ForcesStudy, SenselessRequestsAreRefused) {
  ForcesOptions options;
  options.mechanism = "pump";
  EXPECT_THROW(forces_of(slider_alone, options), std::invalid_argument);
  EXPECT_THROW(forces_of("line = [\"wheel\"]\n[wheel]\nkind = \"flywheel\"\ninertia = \"1 kg*m2\"\n"),
               std::invalid_argument);
}

TEST(ForcesStudy, JammingJointsAreSaidWithTheirPosition) {
  std::string text = slider_alone;
  text.replace(text.find("[run]"), 5, "guide = { friction = 4 }\n[run]");
  try {
    forces_of(text);
    FAIL() << "no jam";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("its joints jam at phi = "), std::string::npos) << error.what();
  }
}

TEST(ForcesStudy, OutputHoldsBothProblemsAndIsValidJson) {
  const Forces f = forces_of(fmt::format(fmt::runtime(pump), 0, rough, 30));
  const StudyOutput output = output_of(f);
  const auto json = nlohmann::json::parse(output.json());
  EXPECT_EQ(json["prescribed"]["positions"].size(), 13u);
  EXPECT_EQ(json["simulated"]["peaks"].size(), 7u);
  EXPECT_EQ(json["counterweights"].size(), 4u);
  EXPECT_NE(output.text().find(conclusion_text(output)), std::string::npos);
  ASSERT_EQ(output.tables.size(), 4u);  // forces and links of both problems
  const std::string csv = csv_text(output.tables[0].table());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 722);
  const Report report = output.report();
  EXPECT_GE(report.sections.size(), 6u);
  EXPECT_NE(html_of(report).find("Friction circle"), std::string::npos);
}

// A four-stroke engine's cycle has half orders, too; here by a load of one sine of order 1½ over two turns.
TEST(ShakingForce, OfTwoTurnsHasHalfOrders) {
  std::vector<double> values;
  constexpr int cells = 720;
  for (int i = 0; i <= cells; ++i)
    values.push_back(3 * std::cos(1.5 * 4 * pi * i / cells - 0.4) + std::cos(4 * pi * i / cells));
  const std::vector<ForceHarmonic> orders = harmonics(values, 2);
  ASSERT_EQ(orders.size(), 2u * highest_order);
  for (const ForceHarmonic& h : orders)
    EXPECT_NEAR(h.amplitude.value, h.order == 1.5 ? 3 : h.order == 1 ? 1 : 0, 1e-12) << h.order;
  EXPECT_NEAR(orders[2].phase, 0.4, 1e-12);
  EXPECT_EQ(orders.front().order, 0.5);
  EXPECT_EQ(harmonics(values, 3).size(), std::size_t{highest_order});
}

}  // namespace
}  // namespace kurbel::forces_test
