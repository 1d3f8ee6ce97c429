// linkage_scenes_test.cpp — linkages in scenes: energy, published dimensions, keys and what is said of wrong ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/model/model.h"
#include "mechanisms/reduced/mechanism.h"
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
    const double y = leg->bodies->joints(2 * pi * i / 720)[7].y;
    least = std::min(least, y), greatest = std::max(greatest, y);
  }
  EXPECT_NEAR(greatest - least, 0.22456940550562853, 1e-6);
}

}  // namespace
}  // namespace kurbel::linkage_scenes_test
