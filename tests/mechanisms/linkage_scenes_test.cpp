// linkage_scenes_test.cpp — linkages in scenes: energy, published dimensions, keys and what is said of wrong ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "engine/model/model.h"
#include "engine/scene/quantity_place.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/forces/forces_findings.h"
#include "studies/forces/linkage_cycle.h"
#include "tests/support/scenes.h"

namespace kurbel::linkage_scenes_test {
namespace {

using std::numbers::pi;

TEST(Linkage, AFreeLinkageKeepsItsEnergy) {
  const Result r = test::run(test::scene_from(R"(
line = ["sieve"]
[sieve]
kind    = "linkage"
unit    = "mm"
points  = { O = [0, 0], A = [50, 0], B = [190, 140], C = [240, 0], D = [150, 220], E = [340, 260], G = [420, 80] }
frame   = "O C G"
gravity = "9.81 m/s2"
[sieve.links]
crank   = { points = "O A", mass = "2 kg", inertia = "0.4 kg*m2" }
coupler = { points = "A B D", mass = "3 kg", inertia = "0.03 kg*m2" }
rocker  = { points = "C B", mass = "1.6 kg", inertia = "0.006 kg*m2" }
rod     = { points = "D E", mass = "1.8 kg", inertia = "0.008 kg*m2" }
lever   = { points = "G E", mass = "5 kg", inertia = "0.9 kg*m2" }
[run]
start    = { speed = "90 rpm" }
until    = "4 s"
accuracy = 1e-12
)"));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-12);
  EXPECT_LT(r.energy.reduction_residual, 1e-12);
}

// Jansen's eleven lengths; the foot's step and lift by a program of its own (circles cut by complex numbers).
TEST(Linkage, JansensLegWalks) {
  const auto model = compile(test::scene_file("scenes/walking_leg.toml"), Effects{});
  const Mechanism* leg = find_mechanism(model->network, "leg");
  ASSERT_NE(leg, nullptr);
  EXPECT_NEAR(leg->stroke(), 0.67908233175, 1e-5);
  double least = 1, greatest = -1;
  for (int i = 0; i < 720; ++i) {
    const double y = leg->data.places(2 * pi * i / 720)[7].y;
    least = std::min(least, y), greatest = std::max(greatest, y);
  }
  EXPECT_NEAR(greatest - least, 0.22456940550562853, 1e-6);
}

// --- keys ---

const char* const four_bar_drawn = R"(
line = ["m"]
[m]
kind   = "linkage"
unit   = "mm"
points = { O = [0, 0], A = [50, 0], B = [190, 140], C = [240, 0] }
frame  = "O C"
links  = { crank = { points = "O A", mass = "2 kg", inertia = "0.1 kg*m2" }, coupler = "A B", rocker = { points = "C B", mass = "3 kg" } }
torque = { kind = "constant", torque = "20 N*m" }
[run]
start = { speed = "90 rpm" }
until = "0.5 s"
)";

const Mechanism& mechanism_in(const Model& model, const std::string& name) {
  const Mechanism* found = find_mechanism(model.network, name);
  EXPECT_NE(found, nullptr);
  return *found;
}

// The same by numbers in metres, by tables for what is short above, and by lengths.
TEST(LinkageKeys, ShortAndLongFormsAreOneMachine) {
  const auto model = compile(test::scene_from(four_bar_drawn), Effects{});
  const std::vector<double> values = mechanism_in(*model, "m").data.values();
  std::string text = four_bar_drawn;
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  };
  replace("\"A B\"", "{ points = \"A  B\" }");
  replace("A = [50, 0]", "A = { at = [50, 0] }");
  replace("unit   = \"mm\"", "unit   = \"mm\"\ndriver = \"crank\"\noutput = \"rocker\"");
  EXPECT_EQ(mechanism_in(*compile(test::scene_from(text), Effects{}), "m").data.values(), values);
  replace("frame ",
          "lengths = { OA = \"50 mm\", \"C-B\" = { value = \"148.66 mm\", tolerance = \"0.1 mm\" } }\nframe ");
  const Scene given = test::scene_from(text);
  EXPECT_DOUBLE_EQ(quantity_place(given.components, "m.lengths.C-B").setting->number, 0.14866);
  EXPECT_DOUBLE_EQ(quantity_place(given.components, "m.links.rocker.mass").setting->number, 3);
  EXPECT_EQ(quantity_place(given.components, "m.links.lever.mass").setting, nullptr);
  const auto moved = compile(given, Effects{});
  const Linkage& linkage = *mechanism_in(*moved, "m").data.as<LinkageData>()->linkage;
  EXPECT_NEAR(static_cast<double>(length(linkage.spot_of(2) - linkage.spot_of(3))), 0.14866, 1e-15);
}

TEST(LinkageKeys, LoadsActOnWhatTheOutputDoes) {
  const Result r = test::run(test::scene_from(four_bar_drawn));
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-5);
  EXPECT_NE(r.energy.by_account.at("m.load"), 0);
}

// --- forces ---

TEST(LinkageForcesInScenes, BalanceOverTheCycle) {
  ForcesOptions options;
  options.simulate = false;
  for (const char* scene : {"scenes/six_link_press.toml", "scenes/stephenson.toml", "scenes/scotch_yoke.toml",
                            "scenes/straight_line.toml", "scenes/walking_leg.toml"}) {
    SCOPED_TRACE(scene);
    const Forces study = find_forces(test::scene_file(scene), options);
    EXPECT_LT(study.prescribed->power_residual, 1e-11);
    EXPECT_LT(study.prescribed->equation_residual, 1e-15);
  }
}

TEST(LinkageForcesInScenes, AreNotAssessedOfARedundantRod) {
  const Scene scene = test::scene_from(R"(
line = ["m"]
[m]
kind   = "linkage"
unit   = "mm"
points = { O = [0, 0], A = [100, 20], B = [500, 20], C = [400, 0], D = [300, 120], E = [200, 100] }
frame  = "O C E"
[m.links]
crank   = { points = "O A", mass = "2 kg", inertia = "0.01 kg*m2" }
coupler = { points = "A B D", mass = "4 kg" }
third   = "E D"
rocker  = "C B"
[run]
start = { speed = "60 rpm" }
until = "1 s"
)");
  EXPECT_EQ(mechanism_in(*compile(scene, Effects{}), "m").travel.winding, 1);
  EXPECT_TRUE(test::run(scene).complete);
  const Forces forces = find_forces(scene, {});
  EXPECT_TRUE(forces.front().reactions.empty());
  // What does not depend on the reactions: all cranks turn alike, and the centres of mass move on circles.
  const double w = forces.front().mean_speed.value, r = std::hypot(0.1, 0.02);
  EXPECT_NEAR(forces.front().shaking_force.value, (2 * r / 2 + 4 * r) * w * w, 1e-9);
  EXPECT_LT(std::abs(forces.front().torque.value), 1e-9);
  const Findings findings = findings_of(forces);
  EXPECT_NE(findings.conclusion().find("reactions in its joints are not assessed"), std::string::npos);
  EXPECT_TRUE(std::any_of(forces.notes.begin(), forces.notes.end(), [](const std::string& note) {
    return note.find("reactions are not assessed: the links coupler, third, rocker have 1 closure more") !=
           std::string::npos;
  }));
}

}  // namespace
}  // namespace kurbel::linkage_scenes_test
