// linkage_forces_test.cpp — forces in every mechanism over a cycle: against closed forms, energy, and each other.
#include "studies/forces/linkage_cycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "studies/forces/forces_findings.h"
#include "tests/mechanisms/slider_crank_statics.h"
#include "tests/support/scenes.h"

namespace kurbel::linkage_forces_test {
namespace {

constexpr double pi = std::numbers::pi;

const char* const rocker = R"(
line = ["motor", "gear", "rocker"]
[motor]
kind = "motor"
torque = { over = "speed", unit = ["rad/s", "N*m"], points = [[0, 40], [300, 0]] }
inertia = "0.02 kg*m2"
[gear]
kind = "gearbox"
stages = [{ teeth = [20, 100] }]
[rocker]
kind = "four-bar"
crank = "80 mm"
coupler = "250 mm"
rocker = "200 mm"
ground = "260 mm"
crank_mass = "2 kg"
coupler_mass = "1.5 kg"
coupler_inertia = "0.01 kg*m2"
rocker_mass = "3 kg"
rocker_com = "100 mm"
rocker_inertia = "0.05 kg*m2"
load = { kind = "opposing", torque = "30 N*m" }
[run]
start = { speed = "30 rad/s" }
until = "3 s"
accuracy = 1e-8
)";

// Joints that turn without friction take no power: what the balancing torque does in a cycle is what the load takes.
void expect_balance(const ForceCycle& c) {
  EXPECT_LT(c.power_residual, 1e-11);
  EXPECT_LT(c.equation_residual, 1e-16);
  double sum = -c.kinetic_change.value, largest = 0;
  for (const CycleWork& w : c.work) sum += w.work.value, largest = std::max(largest, w.turnover);
  EXPECT_NEAR(sum, 0, 1e-7 * largest);
  double inertia = 0, energy = 0;
  for (const LinkOfCycle& l : c.links) inertia += l.inertia_share.value, energy += l.energy_share.value;
  EXPECT_NEAR(inertia, 1, 1e-12);
  EXPECT_NEAR(energy, 1, 1e-12);
}

TEST(ForcesInALinkage, BalanceOverTheCycleInEveryMechanism) {
  ForcesOptions options;
  options.simulate = false;
  for (const char* scene : {"scenes/four_bar_rocker.toml", "scenes/shaper.toml", "scenes/knuckle_press.toml"}) {
    SCOPED_TRACE(scene);
    const Forces f = find_forces(test::scene_file(scene), options);
    expect_balance(*f.prescribed);
    for (const NamedPeak& r : f.prescribed->reactions) {
      ASSERT_TRUE(r.peak.error) << r.name;
      EXPECT_LT(*r.peak.error, 1e-8 * std::abs(f.prescribed->reactions.front().peak.value) + 1e-9) << r.name;
    }
  }
}

// Links that pass through one line: there what the crank needs is that of a place beside it, and the machine's own torque
// is held against the links' everywhere else. A parallelogram, and a kite of two turns, whose pin passes over a bearing.
TEST(ForcesInALinkage, GoThroughChangePointsWithTheMachine) {
  for (const char* lengths : {"crank = \"100 mm\"\ncoupler = \"300 mm\"\nrocker = \"100 mm\"\nground = \"300 mm\"",
                              "crank = \"100 mm\"\ncoupler = \"250 mm\"\nrocker = \"250 mm\"\nground = \"100 mm\""}) {
    SCOPED_TRACE(lengths);
    const Forces f = find_forces(
        test::scene_from(
            std::string("line = [\"motor\", \"bars\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = "
                        "\"400 N*m\", no_load_speed = \"12 rad/s\", inertia = \"2 kg*m2\" }\n[bars]\nkind = "
                        "\"four-bar\"\n") +
            lengths +
            "\ncrank_inertia = \"1 kg*m2\"\ncoupler_mass = \"2 kg\"\ncoupler_inertia = \"0.02 kg*m2\"\n"
            "rocker_mass = \"8 kg\"\nrocker_inertia = \"0.4 kg*m2\"\nload = { kind = \"medium\", viscous = "
            "\"8 N*m*s/rad\" }\n[run]\nstart = { speed = \"9 rad/s\" }\nuntil = \"6 s\"\n"),
        {});
    ASSERT_TRUE(f.simulated) << f.diagnosis;
    EXPECT_LT(*f.simulated->machine_residual, 1e-6);
    EXPECT_LT(f.simulated->power_residual, 1e-8);
  }
}

// The crank turns evenly: ω_i of the rocker over its sweep. Its motion has no mean, its greatest speeds are those of
// the geometry; a link of the mechanism that turns with the shaft has its speed.
TEST(ForcesInALinkage, GivesSpeedsOfTheLinks) {
  ForcesOptions options;
  options.simulate = false;
  options.speed = 10;
  const Forces f = find_forces(test::scene_from(rocker), options);
  const ForceCycle& c = *f.prescribed;
  EXPECT_DOUBLE_EQ(c.links[0].omega.value, 10);
  EXPECT_EQ(c.links[0].alpha.value, 0);
  const auto& positions = c.positions;
  double turned = 0;  // trapezium rule over the rocker's speed: it comes back
  for (std::size_t i = 0; i + 1 < positions.size(); ++i) turned += positions[i].forces.links[2].omega;
  EXPECT_NEAR(turned, 0, 1e-9 * std::abs(c.links[2].omega.value) * static_cast<double>(positions.size()));
  // dψ/dφ by differences against ω of the rocker.
  for (std::size_t i = 1; i + 1 < positions.size(); i += 60) {
    const double h = 2 * (positions[1].forces.state.phi - positions[0].forces.state.phi);
    const double ratio = (positions[i + 1].forces.output - positions[i - 1].forces.output) / h;
    EXPECT_NEAR(positions[i].forces.links[2].omega, 10 * ratio, 1e-3 * std::abs(c.links[2].omega.value));
  }
}

// The first order of the ground's forces of a balanced crank alone: with nothing but the crank's mass at its pin the
// shaking force is m r ω², turning with it.
TEST(ForcesInALinkage, ShakesAsATurningMass) {
  std::string text = rocker;
  const auto replace = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  replace("coupler_mass = \"1.5 kg\"\ncoupler_inertia = \"0.01 kg*m2\"\n", "");
  replace("rocker_mass = \"3 kg\"\nrocker_com = \"100 mm\"\nrocker_inertia = \"0.05 kg*m2\"\n", "");
  replace("crank_mass = \"2 kg\"\n",
          "crank_mass = \"2 kg\"\ncrank_com = \"80 mm\"\ncrank_inertia = \"0.0128 kg*m2\"\n");
  ForcesOptions options;
  options.simulate = false;
  options.speed = 10;
  const Forces f = find_forces(test::scene_from(text), options);
  const ForceCycle& c = *f.prescribed;
  EXPECT_NEAR(c.shaking_force.value, 2 * 0.08 * 100, 1e-12 * 16);
  EXPECT_NEAR(c.shaking_x[0].amplitude.value, 16, 1e-11);
  EXPECT_NEAR(c.shaking_x[1].amplitude.value, 0, 1e-10);
  EXPECT_EQ(c.shaking_moment.value, 0);
  EXPECT_DOUBLE_EQ(c.links[0].inertia_share.value, 1);
}

// --positions chooses rows of a table and nothing else.
TEST(ForcesInALinkage, HasPeaksThatNoPositionsMove) {
  ForcesOptions coarse, fine;
  coarse.simulate = fine.simulate = false;
  coarse.positions = 5, fine.positions = 77;
  const Scene scene = test::scene_from(rocker);
  const ForceCycle a = *find_forces(scene, coarse).prescribed, b = *find_forces(scene, fine).prescribed;
  EXPECT_EQ(a.rows.size(), 6);
  EXPECT_EQ(b.rows.size(), 78);
  for (std::size_t k = 0; k < a.reactions.size(); ++k) {
    EXPECT_EQ(a.reactions[k].peak.value, b.reactions[k].peak.value) << a.reactions[k].name;
    EXPECT_EQ(a.reactions[k].peak.phi, b.reactions[k].peak.phi);
  }
  EXPECT_EQ(a.torque.value, b.torque.value);
  // A peak is none of the samples': the search finds no less than any position shows.
  for (const PositionForces& p : b.rows)
    EXPECT_LE(p.forces.joints[0].force.magnitude(), b.reactions[0].peak.value * (1 + 1e-12));
}

// What a looser run finds otherwise is in the error: a run at a tenth of the tolerance lies within it.
TEST(ForcesInALinkage, HasErrorsThatHoldTheSimulatedFigures) {
  Scene scene = test::scene_from(rocker);
  const Forces f = find_forces(scene, {});
  scene.run.accuracy = 1e-10;
  const Forces truth = find_forces(scene, {});
  ASSERT_TRUE(f.simulated && truth.simulated);
  expect_balance(*f.simulated);
  for (std::size_t k = 0; k < f.simulated->reactions.size(); ++k) {
    const Peak &got = f.simulated->reactions[k].peak, &right = truth.simulated->reactions[k].peak;
    EXPECT_NEAR(std::abs(got.value), std::abs(right.value), *got.error + *right.error)
        << f.simulated->reactions[k].name;
  }
  EXPECT_NEAR(f.simulated->torque.value, truth.simulated->torque.value,
              *f.simulated->torque.error + *truth.simulated->torque.error);
}

TEST(ForcesInALinkage, NamesJointsSensesAndAxes) {
  ForcesOptions options;
  options.simulate = false;
  const Forces f = find_forces(test::scene_from(rocker), options);
  const Findings findings = findings_of(f);
  const auto json = nlohmann::json::parse(json_text(summary_of(findings)));
  EXPECT_NE(json.at("signs").get<std::string>().find("crank pin: crank on coupler"), std::string::npos);
  ASSERT_EQ(findings.tables.size(), 2U);
  const std::string csv = csv_text(findings.tables[0].table());
  EXPECT_NE(csv.find("rocker_bearing_of_frame_on_rocker_x [N]"), std::string::npos) << csv.substr(0, 400);
}

// With friction in all joints, an offset, a guide that the reaction leaves, mass and force beside the pin: against the closed
// form, which shares neither the links' equations nor the laws' solution.
TEST(ForcesInALinkage, AreThoseOfTheSliderCranksClosedForm) {
  ForcesOptions options;
  options.simulate = false;
  const Scene scene = test::scene_from(R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
offset = "20 mm"
crank_mass = "4 kg"
crank_com = "30 mm"
crank_inertia = "0.15 kg*m2"
rod_mass = "2 kg"
rod_com = "122.5 mm"
rod_inertia = "0.02 kg*m2"
slider_mass = "3 kg"
stroke_angle = "35 deg"
load = { kind = "opposing", force = "500 N" }
main_bearing = { radius = "40 mm", friction = 0.05, static_friction = 0.1, stribeck_speed = "0.3 m/s" }
crank_pin = { radius = "30 mm", friction = 0.05 }
slider_pin = { radius = "15 mm", friction = 0.08, viscous_friction = "0.02 s/m" }
guide = { friction = 0.1, length = "60 mm", middle = "5 mm", width = "80 mm", slider_com = "30 mm", force_offset = "12 mm" }
[run]
start = { speed = "30 rad/s" }
)");
  const Forces f = find_forces(scene, options);
  const ForceCycle& c = *f.prescribed;
  const SliderCrankStatics statics(f.balancing->data, slider_crank_joints(f.joints));
  const double scale = c.reaction(1).value, arm = 0.1;
  int edges = 0;
  for (const PositionForces& p : c.curve) {
    const LinkageForces& l = p.forces;
    // There friction of the guide, or of the pin of a rod that does not turn, is either way.
    if (std::abs(l.output_velocity) < 1e-6 || std::abs(std::cos(l.state.phi)) < 1e-12) continue;
    const SliderCrankForces own = statics.solve({l.state.phi, l.state.omega, l.state.alpha, l.state.load});
    const Force2 pins[] = {own.main_bearing, own.crank_pin, own.slider_pin};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR((l.joints[k].force - pins[k]).magnitude(), 0, 1e-11 * scale) << l.state.phi << " joint " << k;
      EXPECT_NEAR(l.joints[k].friction, own.friction_torque[k], 1e-12 * scale * arm) << l.state.phi << " joint " << k;
    }
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(l.joints[k].friction_power, own.friction_power[k], 1e-11 * scale * arm * 30) << k;
    const JointForces& guide = l.joints[3];
    EXPECT_NEAR(guide.normal, own.guide, 1e-11 * scale);
    EXPECT_NEAR(guide.moment, own.guide_moment, 1e-11 * scale * arm);
    EXPECT_NEAR(guide.friction, own.guide_friction, 1e-11 * scale);
    EXPECT_EQ(guide.both_edges, own.both_edges);
    EXPECT_NEAR(guide.edge_front, own.edge_front, 1e-10 * scale);
    EXPECT_NEAR(guide.edge_back, own.edge_back, 1e-10 * scale);
    EXPECT_NEAR(l.torque, own.torque, 1e-11 * scale * arm);
    EXPECT_NEAR(l.links[1].inertia_force.x, own.rod_inertia.x, 1e-12 * scale);
    EXPECT_NEAR(l.shaking_moment, own.shaking_moment, 1e-11 * scale * arm);
    edges += own.both_edges;
  }
  EXPECT_GT(edges, 100);
  EXPECT_LT(edges, 700);
  EXPECT_LT(c.friction_residual, 1e-12);
  EXPECT_LT(c.power_residual, 1e-12);
}

// A pump's barrel rocks about C, the oil acts along A C. On rod and barrel it goes through the pins A and C, on crank
// and frame, the first bodies there, through none of them.
TEST(ForcesInALinkage, ActOnTheLinksThatAreNamedAtAPin) {
  const auto reaction_of_the_rods_pin = [](const char* between) {
    const Scene scene = test::scene_from(fmt::format(R"(
line = ["motor", "pump"]
[motor]
kind = "motor"
torque = {{ over = "speed", unit = ["rad/s", "N*m"], points = [[0, 400], [30, -400]] }}
inertia = "1 kg*m2"
[pump]
kind = "linkage"
unit = "mm"
points = {{ O = [0, 0], A = [40, 0], C = [200, 0], P = [60, 0], Q = [180, 0] }}
frame = "O C"
slides = {{ rod = {{ on = "barrel", through = "A C" }} }}
output = "A"
[pump.links]
crank = {{ points = "O A", mass = "1 g", inertia = "1 g*m2" }}
rod = {{ points = "A P", mass = "1e-6 kg", inertia = "1e-9 kg*m2" }}
barrel = {{ points = "C Q", mass = "1e-6 kg", inertia = "1e-9 kg*m2" }}
[pump.forces]
oil = {{ between = "{}", load = {{ kind = "constant", force = "2 kN" }} }}
[run]
start = {{ speed = "1 rad/s" }}
until = "1 s"
)",
                                                     between));
    ForcesOptions options;
    options.simulate = false, options.speed = 1;
    const Forces forces = find_forces(scene, options);
    for (const auto& reaction : forces.front().reactions)
      if (reaction.name.starts_with("pin A")) return reaction.peak.value;
    ADD_FAILURE() << "no pin A";
    return 0.0;
  };
  EXPECT_NEAR(reaction_of_the_rods_pin("rod A barrel C"), 2000, 1e-3);
  EXPECT_NEAR(reaction_of_the_rods_pin("P Q"), 2000, 1e-3);  // points on the slide's line
  EXPECT_LT(reaction_of_the_rods_pin("A C"), 1e-3);
}

// Friction in the joints of a four-bar: the machine moves as its links need it, and what goes in is used or lost.
TEST(ForcesInALinkage, HaveTheFrictionOfTheJoints) {
  std::string rough = rocker;
  rough.replace(rough.find("[run]"), 5,
                "joints = { main_bearing = { radius = \"20 mm\", friction = 0.1 }, crank_pin = { radius = \"15 mm\", "
                "friction = 0.1 }, coupler_pin = { radius = \"12 mm\", friction = 0.08 }, rocker_bearing = { radius = "
                "\"20 mm\", friction = 0.05 } }\n[run]");
  const Forces f = find_forces(test::scene_from(rough), {}), ideal = find_forces(test::scene_from(rocker), {});
  ASSERT_TRUE(f.friction && f.simulated);
  EXPECT_LT(*f.simulated->machine_residual, 1e-7);
  for (const ForceCycle* c : f.problems()) {
    EXPECT_LT(c->power_residual, 1e-11);
    EXPECT_LT(c->friction_residual, 1e-12);
    double lost = 0;
    for (const CycleWork& w : c->work)
      if (w.name.starts_with("friction of ")) lost -= w.work.value;
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(c->harmful.value, lost, 1e-9 * lost);
    EXPECT_NEAR(c->input.value, c->useful.value + lost + c->kinetic_change.value, 1e-7 * c->input.value);
    EXPECT_NEAR(c->efficiency->value, c->useful.value / c->input.value, 1e-9);
    // ρ |R| of each pin, against its turning.
    for (const PositionForces& p : c->positions)
      for (const JointForces& j : p.forces.joints)
        if (std::string(j.name) == "crank pin") {
          EXPECT_NEAR(std::abs(j.friction), 0.015 * 0.1 / std::sqrt(1.01) * j.force.magnitude(),
                      1e-12 * c->reaction(1).value);
        }
  }
  EXPECT_NEAR(ideal.prescribed->efficiency->value, 1, 1e-9);
  EXPECT_NE(output_of(f).conclusion().find("efficiency of the cycle"), std::string::npos);
  Effects off;
  ForcesOptions options;
  options.effects = off;
  const Forces omitted = find_forces(test::scene_from(rough), options);
  EXPECT_EQ(omitted.prescribed->torque.value, ideal.prescribed->torque.value);
  EXPECT_NE(omitted.notes.back().find("friction in the joints is omitted"), std::string::npos);
}

}  // namespace
}  // namespace kurbel::linkage_forces_test
