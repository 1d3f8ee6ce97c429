// deforming_directions_test.cpp — clearance and a flexible rod where the stroke is not level: weights, and a slider
// that falls upwards.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/scenes.h"

namespace kurbel::deforming_directions_test {
namespace {

std::string crank(const std::string& more, const std::string& run) {
  return R"(
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "150 mm"
crank_mass = "1.5 kg"
crank_com = "30 mm"
crank_inertia = "0.02 kg*m2"
rod_mass = "0.3 kg"
rod_com = "75 mm"
rod_inertia = "5.625e-4 kg*m2"
slider_mass = "0.5 kg"
gravity = "9.81 m/s2"
)" + more +
         "\n[run]\n" + run + "\n";
}
const std::string wrist_pin = "clearance = { kind = \"wrist pin\", gap = \"0.1 mm\", stiffness = \"20 MN/m\" }";
const std::string bending =
    "rod_flexibility = { modulus = \"200 GPa\", height = \"8 mm\", width = \"8 mm\", modes = 2, damping_ratio = 0.02 }";

// Power of the weights and their forces in the equations of motion, along the stroke and across.
TEST(DeformingDirections, EnergyIsInBalanceOnASlope) {
  for (const std::string& what : {wrist_pin, bending})
    for (const double slope : {0.7, -1.3}) {
      const Result r = test::run(
          "line = [\"crank\"]\n" + crank(fmt::format("stroke_angle = \"{} rad\"\n{}", slope, what),
                                         "start = { speed = \"25 rad/s\" }\nuntil = \"60 ms\"\naccuracy = 1e-8"),
          false);
      ASSERT_TRUE(r.complete) << r.diagnosis;
      EXPECT_LT(r.energy.relative, 1e-7) << slope;
      EXPECT_GT(std::abs(r.energy.by_line.at("weight")), 0.1);
    }
}

// All weights do Σ m g (h₀ − h): with the rod's and the slider's gaps far smaller than their travel.
TEST(DeformingDirections, WeightsWorkByTheHeightsOfTheCentresOfMass) {
  const double slope = 0.7, r0 = 0.05, l = 0.15;
  const Result r = test::run("line = [\"crank\"]\n" + crank("stroke_angle = \"0.7 rad\"\n" + bending,
                                                            "start = { speed = \"25 rad/s\" }\nuntil = \"60 ms\"\n"
                                                            "accuracy = 1e-8"),
                             false);
  const auto height = [&](double phi) {  // Σ m h
    const double ax = r0 * std::cos(phi), ay = r0 * std::sin(phi), bx = ax + std::sqrt(l * l - ay * ay);
    const double x = 1.5 * 0.6 * ax + 0.3 * 0.5 * (ax + bx) + 0.5 * bx, y = 1.5 * 0.6 * ay + 0.3 * 0.5 * ay;
    return x * std::sin(slope) + y * std::cos(slope);
  };
  EXPECT_NEAR(r.energy.by_line.at("weight"), 9.81 * (height(0) - height(test::figure(r, "final_angle.crank"))), 1e-3);
}

// A machine upside down is its mirror image: whichever corners of the slider are hit, the guide is hit as hard.
TEST(DeformingDirections, SliderThatFallsUpwardsHitsItsGuideAsHard) {
  const auto hit = [](const char* angle) {
    const Result r =
        test::run("line = [\"drive\", \"crank\"]\ndrive = { kind = \"prescribed speed\", speed = \"0 rad/s\" }\n" +
                      crank(fmt::format("stroke_angle = \"{}\"\nclearance = {{ kind = \"guide\", gap = \"0.1 mm\", "
                                        "stiffness = \"1 MN/m\", damping = \"1 s/m\", length = \"60 mm\", height = "
                                        "\"40 mm\", inertia = \"3e-4 kg*m2\" }}",
                                        angle),
                            "until = \"20 ms\"\naccuracy = 1e-8"),
                  false);
    EXPECT_TRUE(r.complete) << r.diagnosis;
    return std::pair(test::figure(r, "peak_guide_force.crank"), test::figure(r, "impacts.crank"));
  };
  const auto [down, downs] = hit("0 deg");
  const auto [up, ups] = hit("180 deg");
  EXPECT_GT(downs, 0);
  EXPECT_EQ(downs, ups);
  EXPECT_GT(down, 4);  // of a slider of 5 N
  EXPECT_NEAR(down, up, 1e-4 * down);
}

}  // namespace
}  // namespace kurbel::deforming_directions_test
