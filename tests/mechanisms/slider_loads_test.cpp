// slider_loads_test.cpp — forces on the slider: work per cycle in closed form, modes, holding at standstill.
#include "mechanisms/loads/slider_loads.h"

#include <cmath>

#include "engine/base/find_by.h"
#include "tests/support/scenes.h"

namespace kurbel::slider_loads_test {
namespace {

using test::figure;
using test::run;

// A crank at prescribed speed, r = 50 mm, stroke 100 mm; useful work of one turn.
Result turning(const std::string& load, const std::string& more = "") {
  return run(
      "line = [\"drive\", \"crank\"]\n[drive]\nkind = \"prescribed speed\"\nspeed = \"10 rad/s\"\n[crank]\nkind = "
      "\"slider-crank\"\nradius = \"50 mm\"\n"
      "rod = \"200 mm\"\nslider_mass = \"2 kg\"\n" +
      more + "load = " + load + "\n[run]\nuntil = \"3 s\"\naccuracy = 1e-8\n");
}

TEST(SliderLoads, ConstantForceDoesNoWorkInATurn) {
  EXPECT_NEAR(figure(turning("{ kind = \"constant\", force = \"700 N\" }"), "useful_work_per_cycle"), 0, 1e-6);
}
TEST(SliderLoads, OpposingForceTakesTwiceTheStroke) {
  EXPECT_NEAR(figure(turning("{ kind = \"opposing\", force = \"700 N\" }"), "useful_work_per_cycle"), -700 * 0.2, 1e-7);
}
// ∮ c v dx = c ω ∫ x′² dφ; x′² integrated by the trapezium rule, which is exact to round-off here.
TEST(SliderLoads, MediumTakesTheIntegralOfSpeedSquared) {
  const int n = 720;
  double square = 0;
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * M_PI * i / n, lambda = 0.25, s = std::sin(phi), c = std::cos(phi);
    const double ratio = -0.05 * (s + lambda * s * c / std::sqrt(1 - lambda * lambda * s * s));
    square += ratio * ratio * 2 * M_PI / n;
  }
  EXPECT_NEAR(figure(turning("{ kind = \"medium\", viscous = \"90 N*s/m\" }"), "useful_work_per_cycle"),
              -90 * 10 * square, 1e-7);
}
// Ends: with the force on the working stroke only, either end may be the working one; the area is the same.
TEST(SliderLoads, PressTakesItsAreaAtEitherEnd) {
  for (const char* end : {"extended", "folded"}) {
    const Result r =
        turning(std::string("{ kind = \"press\", nominal_force = \"8 kN\", nominal_travel = \"20 mm\", rise = \"4 "
                            "mm\", breakthrough = \"6 mm\", drop = \"2 mm\", working_end = \"") +
                end + "\" }");
    EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -8e3 * (0.002 + 0.010 + 0.001), 1e-6) << end;
    const Result sharp = turning(
        std::string("{ kind = \"press\", nominal_force = \"8 kN\", nominal_travel = \"20 mm\", working_end = \"") +
        end + "\" }");
    EXPECT_NEAR(figure(sharp, "useful_work_per_cycle"), -8e3 * 0.020, 1e-6) << end;
  }
}
// The loop of two branches over travel: area between them.
TEST(SliderLoads, TravelTableWithTwoBranchesTakesTheAreaBetween) {
  const Result r = turning(
      "{ kind = \"table\", force = { over = \"travel\", unit = [\"mm\", \"N\"], points = [[0, 900], [40, 500], [100, "
      "100]], return_points = [[0, 300], [100, 100]] } }");
  const double approach = 0.04 * 700 + 0.06 * 300, retreat = 0.1 * 200;
  EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -(approach - retreat), 1e-7);
}
// One branch for both strokes is a spring: no work in a turn.
TEST(SliderLoads, TravelTableWithOneBranchDoesNoWork) {
  const Result r = turning(
      "{ kind = \"table\", force = { over = \"travel\", unit = [\"mm\", \"N\"], points = [[0, 900], [40, 500], [100, "
      "100]] } }");
  EXPECT_NEAR(figure(r, "useful_work_per_cycle"), 0, 1e-6);
}
// Four-stroke: a cycle is two turns, and a force over 0…720° works over its own branch in each turn:
// 1 kN away from the extended end from 0 to 180° (outwards expansion) drives with 1 kN · stroke.
TEST(SliderLoads, FourStrokeCycleIsTwoTurns) {
  const Result r = turning(
      "{ kind = \"table\", work = \"driving\", force = { over = \"angle\", unit = [\"deg\", \"N\"], points = [[0, "
      "1000], [180, 1000], [180.001, 0], [719.999, 0]] } }");
  EXPECT_NEAR(figure(r, "cycle_time.crank"), 4 * M_PI / 10, 1e-9);
  // The driving account also holds the prescribed motion, which takes what the gas gives.
  // 30 rad hold the first halves of three such turns whole.
  EXPECT_NEAR(r.energy.by_account.at("crank.load"), 3 * 1000 * 0.1, 1e-6);
}
// The load edge lies where the slider is 20 mm before its end, to round-off: φ from the closed form.
TEST(SliderLoads, PressEdgeIsLocatedOnItsTravel) {
  const Result r = turning("{ kind = \"press\", nominal_force = \"8 kN\", nominal_travel = \"20 mm\" }");
  const auto* const edge = find_by(r.events, &Event::what, "load edge");
  ASSERT_NE(edge, nullptr);
  const double phi = 10 * edge->t;
  EXPECT_NEAR(0.05 * std::cos(phi) + std::sqrt(0.04 - std::pow(0.05 * std::sin(phi), 2)), 0.25 - 0.02, 1e-12);
}
// A press stopped under its load stays there: the force only resists.
TEST(SliderLoads, PressHoldsTheCrankThatItStopped) {
  const Result r = run(R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "200 mm"
crank_inertia = "0.1 kg*m2"
slider_mass = "2 kg"
load = { kind = "press", nominal_force = "2 kN", nominal_travel = "60 mm" }
[run]
start = { speed = "20 rad/s", angle = "200 deg" }
until = "1 s"
accuracy = 1e-8
)");
  ASSERT_FALSE(r.events.empty());
  EXPECT_EQ(r.events.back().what, "comes to rest and is held");
  EXPECT_EQ(figure(r, "final_speed.crank"), 0);
  EXPECT_LE(r.energy.relative, 1e-8);
  // Its energy went into the work: T₀ = F · distance since the edge.
  EXPECT_NEAR(r.energy.kinetic_start, -figure(r, "work.useful"), 1e-7);
}

}  // namespace
}  // namespace kurbel::slider_loads_test
