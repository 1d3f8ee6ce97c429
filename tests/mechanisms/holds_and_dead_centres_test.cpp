// holds_and_dead_centres_test.cpp — what loads on the output do where the crank stands still or starts on a dead
// centre, at either end and either way round; by the forces in the rod.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mechanisms/loads/rounded_profile.h"
#include "mechanisms/loads/slider_loads.h"
#include "tests/mechanisms/slider_crank_statics.h"
#include "tests/support/scenes.h"

namespace kurbel::holds_and_dead_centres_test {
namespace {

using test::figure;
using test::run;

constexpr double pi = std::numbers::pi, radius = 0.05, rod = 0.2;

double position(double phi) {
  return radius * std::cos(phi) + std::sqrt(rod * rod - std::pow(radius * std::sin(phi), 2));
}
double ratio(double phi) {  // x′
  const double y = radius * std::sin(phi);
  return -y - y * radius * std::cos(phi) / std::sqrt(rod * rod - y * y);
}

std::string crank(const std::string& more, const std::string& rest) {
  return fmt::format(R"(
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "200 mm"
crank_inertia = "0.1 kg*m2"
slider_mass = "2 kg"
{}
{}
)",
                     more, rest);
}
// A crank at rest that a torque pushes: does it move within a tenth of a second?
bool moves(double phi, double push, const std::string& more, const std::string& effects = "") {
  const Result r = run(
      fmt::format("line = [\"push\", \"crank\"]\npush = {{ kind = \"torque source\", torque = \"{:.17g} N*m\" }}\n",
                  push) +
          crank(more, fmt::format("{}\n[run]\nuntil = \"0.1 s\"\nstart = {{ angle = \"{:.17g} rad\" }}", effects, phi)),
      false);
  EXPECT_TRUE(r.complete) << r.diagnosis;
  return std::abs(figure(r, "final_speed.crank")) > 1e-6;
}

// Within its travel it holds F |x′| against motion towards its end, and nothing away from it.
TEST(PressAtRest, HoldsTheCrankOnTheWayToItsEndAlone) {
  for (const bool extended : {true, false})
    for (const int sense : {1, -1})  // of the crank towards the end
      for (const bool rounded : {false, true}) {
        const double phi = (extended ? 0 : pi) - 0.5 * sense, held = 4000 * std::abs(ratio(phi));
        const std::string load = fmt::format(
            "load = {{ kind = \"press\", nominal_force = \"4 kN\", nominal_travel = \"40 mm\", working_end = \"{}\"{} "
            "}}",
            extended ? "extended" : "folded", rounded ? ", rounding = \"1 mm\"" : "");
        const std::string effects = rounded ? "[effects]\nload_edges = false" : "";
        const std::string text =
            fmt::format("{} end, {}, {}", extended ? "extended" : "folded", sense, rounded ? "rounded" : "sharp");
        EXPECT_FALSE(moves(phi, 0.97 * sense * held, load, effects)) << text;
        EXPECT_TRUE(moves(phi, 1.03 * sense * held, load, effects)) << text;
        EXPECT_TRUE(moves(phi, -0.05 * sense * held, load, effects)) << text;
      }
}

// Guide and load together hold the slider: S u_x = F + f S |u_y| in the rod, M = S (A_x u_y − A_y u_x) at the crank.
TEST(JointFrictionAtRest, GuideHoldsMoreWhereALoadPressesOnIt) {
  const double force = 900, f = 0.3;
  for (const double phi : {5.3, 2.2}) {
    for (const int sense : {1, -1}) {
      const double ax = radius * std::cos(phi), ay = radius * std::sin(phi), ux = (position(phi) - ax) / rod,
                   uy = -ay / rod;
      const double way = sense * ratio(phi) > 0 ? 1 : -1;  // of the slider; in tension where it is drawn
      const double tension = way * force / (ux - f * std::abs(uy)), torque = tension * (ax * uy - ay * ux);
      ASSERT_GT(torque * sense, 0);
      const std::string rough =
          "load = { kind = \"opposing\", force = \"900 N\" }\nguide = { friction = 0.1, static_friction = 0.3 }\n";
      EXPECT_FALSE(moves(phi, 0.99 * torque, rough, "[effects]\njoint_friction = true")) << phi << ", " << sense;
      EXPECT_TRUE(moves(phi, 1.01 * torque, rough, "[effects]\njoint_friction = true")) << phi << ", " << sense;
    }
  }
}

// A main bearing's friction moves no reaction: it holds ρ |R| either way, ρ = r sin(atan f) with the static f.
TEST(JointFrictionAtRest, BearingHoldsByItsStaticCoefficient) {
  SliderCrankData d;
  d.radius = radius, d.rod_length = rod, d.slider_mass = 2, d.crank_inertia = 0.1;
  SliderCrankJoints j;
  j.main_bearing = {0.03, {0.05, 0.16, 0, 0}};
  const SliderCrankStatics statics(d, j);
  for (const double phi : {0.7, 2.2, 4.9}) {
    const auto free = statics.solve_frictionless({.phi = phi, .slider_force = -2000});
    const double holds = 0.03 * std::sin(std::atan(0.16)) * free.main_bearing.magnitude();
    const auto range = statics.resting_torque(phi, -2000);
    EXPECT_NEAR(range.high, free.torque + holds, 1e-9);
    EXPECT_NEAR(range.low, free.torque - holds, 1e-9);
  }
}

const std::string bending =
    "rod_mass = \"0.5 kg\"\nrod_inertia = \"0.0017 kg*m2\"\nrod_flexibility = { modulus = \"200 GPa\", height = \"20 "
    "mm\", "
    "width = \"20 mm\", modes = 1, stretching = false, damping_ratio = 0.5 }\n";

// From a dead centre the loads act by the stroke that begins there, whichever way it turns.
TEST(DeadCentreStart, LoadsActByTheStrokeThatBegins) {
  for (const bool flexible : {false, true})
    for (const double begin : {0.0, pi})
      for (const double omega : {10.0, -10.0}) {
        const double end = begin + omega * 0.3;  // 3 rad: nearly half a turn
        const std::string more = fmt::format(
            "load = {{ kind = \"press\", nominal_force = \"50 N\", nominal_travel = \"30 mm\", working_end = \"{}\" "
            "}}\n{}",
            begin == 0 ? "folded" : "extended", flexible ? bending : "");
        const Result r =
            run(fmt::format("line = [\"drive\", \"crank\"]\ndrive = {{ kind = \"prescribed speed\", speed = \"{} "
                            "rad/s\" }}\n",
                            omega) +
                    crank(more, fmt::format("[run]\nuntil = \"0.3 s\"\naccuracy = 1e-7\nstart = {{ angle = \"{:.17g} "
                                            "rad\" }}",
                                            begin)),
                false);
        ASSERT_TRUE(r.complete) << r.diagnosis;
        const double left = std::abs(position(end) - position(begin + pi));  // to the working end
        EXPECT_NEAR(figure(r, "work.useful"), -50 * (0.03 - left), 1e-5)
            << begin << ", " << omega << (flexible ? ", flexible" : "");
      }
}
TEST(DeadCentreStart, OpposingForceTakesTheWayThatIsGone) {
  for (const double begin : {0.0, pi})
    for (const double omega : {10.0, -10.0}) {
      const Result r =
          run(fmt::format("line = [\"drive\", \"crank\"]\ndrive = {{ kind = \"prescribed speed\", speed = \"{} rad/s\" "
                          "}}\n",
                          omega) +
                  crank("load = { kind = \"opposing\", force = \"50 N\" }",
                        fmt::format("[run]\nuntil = \"0.2 s\"\naccuracy = 1e-7\nstart = {{ angle = \"{:.17g} rad\" }}",
                                    begin)),
              false);
      ASSERT_TRUE(r.complete) << r.diagnosis;
      EXPECT_TRUE(r.events.empty()) << r.events.front().what;
      EXPECT_NEAR(figure(r, "work.useful"), -50 * std::abs(position(begin + 0.2 * omega) - position(begin)), 1e-7)
          << begin << ", " << omega;
    }
}

// The branch is that of the stroke to come from the first moment on.
TEST(DeadCentreStart, TableHasTheBranchOfTheStrokeThatBegins) {
  const std::string table =
      "load = { kind = \"table\", force = { over = \"travel\", unit = [\"mm\", \"N\"], points = [[0, 900], [40, 500], "
      "[100, 400]], return_points = [[0, 300], [100, 100]] } }\n";
  for (const bool flexible : {false, true})
    for (const double begin : {0.0, pi})
      for (const double omega : {10.0, -10.0}) {
        const Result r =
            run(fmt::format(
                    "line = [\"drive\", \"crank\"]\ndrive = {{ kind = \"prescribed speed\", speed = \"{} rad/s\" }}\n",
                    omega) +
                    crank(table + (flexible ? bending : ""),
                          fmt::format("[run]\nuntil = \"1 ms\"\nstart = {{ angle = \"{:.17g} rad\" }}", begin)),
                false);
        ASSERT_TRUE(r.complete) << r.diagnosis;
        const auto& channels = r.trajectory->channels();
        const auto force =
            std::find_if(channels.begin(), channels.end(), [](const Channel& c) { return c.name == "force.crank"; });
        ASSERT_NE(force, channels.end());
        EXPECT_NEAR(r.trajectory->value(0, static_cast<std::size_t>(force - channels.begin())),
                    begin == 0 ? -300 : -400, 1e-6)
            << begin << ", " << omega << (flexible ? ", flexible" : "");
      }
}

// F = −(c v + q v |v|), both ways.
TEST(MediumResistance, ResistsBothWays) {
  const MediumResistance law{.viscous = 3, .quadratic = 7};
  for (const double v : {1.7, -1.7}) {
    const SliderState<double> s{0, 0, v, 0, 0};
    EXPECT_DOUBLE_EQ(law.value(s), -std::copysign(3 * 1.7 + 7 * 1.7 * 1.7, v));
  }
}

// Its seam is an edge as any other: ∫ f(x − w u) κ(u) du, by Simpson's rule between the edges, with the table repeated.
TEST(RoundedProfile, RepeatedTableIsRoundedAtItsSeamToo) {
  const double period = 3, w = 0.4;
  const Curve table({0, 1, 2.2, 3}, {5, 8, 4, 5}, Curve::Form::linear, period);
  const RoundedProfile rounded(table, w);
  const auto kernel = [](double u) { return 35.0 / 32 * std::pow(1 - u * u, 3); };
  for (double x = -1; x < 4; x += 0.0373) {
    std::vector<double> cuts = {-1, 1};
    for (const double edge : {-3.0, -2.0, -0.8, 0.0, 1.0, 2.2, 3.0, 4.0, 5.2})
      if (std::abs(x - edge) < w) cuts.push_back((x - edge) / w);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      constexpr int n = 400;
      const double h = (cuts[c + 1] - cuts[c]) / n;
      for (int i = 0; i <= n; ++i) {
        const double u = cuts[c] + h * i;
        double d = std::fmod(x - w * u + 2 * period, period);
        const double f = d < 1 ? 5 + 3 * d : d < 2.2 ? 8 - 4 * (d - 1) / 1.2 : 4 + (d - 2.2) / 0.8;
        sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * h / 3 * f * kernel(u);
      }
    }
    EXPECT_NEAR(rounded.value(x), sum, 1e-8) << x;
  }
}

}  // namespace
}  // namespace kurbel::holds_and_dead_centres_test
