// mechanism_words_test.cpp — what forces and reduce say of a mechanism's structure and travel, against closed forms.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "engine/scene/units.h"
#include "studies/forces/forces_findings.h"
#include "studies/reduce/reduce.h"
#include "tests/support/scenes.h"

namespace kurbel::mechanism_words_test {
namespace {

constexpr double pi = std::numbers::pi;

Scene scene_of(const std::string& mechanism) {
  const bool drawn = mechanism.find("\"linkage\"") != std::string::npos;  // its crank has its inertia there
  return test::scene_from("line = [\"m\"]\n[m]\n" + std::string(drawn ? "" : "crank_inertia = \"0.5 kg*m2\"\n") +
                          mechanism + "\n[run]\nstart = { speed = \"60 rpm\" }\n");
}

// With these dead centres.
std::string travel(const std::string& begin, double first, double second) {
  for (double* phi : {&first, &second}) *phi -= 2 * pi * std::floor(*phi / (2 * pi));
  if (first > second) std::swap(first, second);
  const double one = second - first, slow = std::max(one, 2 * pi - one), quick = 2 * pi - slow;
  return fmt::format(
      "m: {}, dead centres at φ = {:.4g}°, {:.4g}°; one stroke takes {:.4g}°, the other {:.4g}°: time "
      "ratio {:.4g}",
      begin, first * 180 / pi, second * 180 / pi, slow * 180 / pi, quick * 180 / pi, slow / quick);
}
std::string stroke(double way) { return "stroke " + with_unit(way, "m", 4); }
std::string swing(double angle) { return fmt::format("swing {:.4g}°", angle * 180 / pi); }

// That both commands say these, of so many in all.
void expect_words(const std::string& mechanism, std::ptrdiff_t count, const std::vector<std::string>& words) {
  const Scene scene = scene_of(mechanism);
  for (const std::string& json : {output_of(reduce(scene, {})).json(), output_of(find_forces(scene, {})).json()}) {
    const auto said = nlohmann::json::parse(json).at("notes").get<std::vector<std::string>>();
    EXPECT_EQ(std::count_if(said.begin(), said.end(), [](const std::string& s) { return s.starts_with("m: "); }),
              count);
    for (const std::string& line : words)
      EXPECT_NE(std::find(said.begin(), said.end(), line), said.end()) << line << "; but it says\n"
                                                                       << fmt::format("{}", fmt::join(said, "\n"));
  }
}

std::string transmission(const std::string& group, double angle, double phi) {
  return fmt::format("m: transmission angle of {} at least {:.4g}°, at φ = {:.4g}°", group, angle * 180 / pi,
                     phi * 180 / pi);
}

// Of an output x(φ) that reverses at these angles: where it is a hundredth of the stroke away, by bisection.
template <class Output>
std::string dwell(const Output& x, std::vector<double> ends, const std::string& what = "stroke") {
  std::sort(ends.begin(), ends.end());
  const double share = 0.01 * std::abs(x(ends[1]) - x(ends[0]));
  std::string text;
  const auto edge = [&](double phi, double sense) {
    double in = 0, out = 1;
    while (out - in > 1e-13) {
      const double middle = (in + out) / 2;
      (std::abs(x(phi + sense * middle) - x(phi)) > share ? out : in) = middle;
    }
    return phi + sense * in;
  };
  for (const double phi : ends) {
    const double from = edge(phi, -1), to = edge(phi, 1);
    const auto degrees = [](double at) {
      return fmt::format("{:.5g}°", (at - 2 * pi * std::floor(at / (2 * pi))) * 180 / pi);
    };
    text += fmt::format("{}{:.4g}° from φ = {} to {}", text.empty() ? "" : ", ", (to - from) * 180 / pi, degrees(from),
                        degrees(to));
  }
  return "m: dwells, no farther from its reversal than 1 % of its " + what + ": over " + text;
}

// x = r cos φ + √(l² − (r sin φ − e)²), crank and rod in line at both ends; the rod is steepest with the crank upright.
TEST(MechanismWords, OfAnOffsetSliderCrank) {
  constexpr double r = 0.1, l = 0.35, e = 0.04;
  expect_words(
      "kind = \"slider-crank\"\nradius = \"100 mm\"\nrod = \"350 mm\"\noffset = \"40 mm\"\nslider_mass = \"3 kg\"", 4,
      {"m: linkage of class II: crank drives RRP (rod, slider); degrees of freedom 3·3 − 2·4 = 1",
       transmission("RRP (rod, slider)", std::acos((r + e) / l), -pi / 2),
       travel(stroke(std::sqrt((l + r) * (l + r) - e * e) - std::sqrt((l - r) * (l - r) - e * e)),
              std::asin(e / (l + r)), pi + std::asin(e / (l - r))),
       dwell([](double phi) { return r * std::cos(phi) + std::sqrt(l * l - std::pow(r * std::sin(phi) - e, 2)); },
             {std::asin(e / (l + r)), pi + std::asin(e / (l - r))})});
}

// x = r cos φ stays within 1 % of 2 r over 2 arccos 0.98.
TEST(MechanismWords, OfAScotchYokesDwell) {
  const double half = std::acos(0.98) * 180 / pi;
  expect_words(
      "kind = \"linkage\"\nunit = \"mm\"\npoints = { O = [0, 0], A = [60, 0], Y = [300, 0] }\nframe = \"O\"\n"
      "slides = { block = { on = \"yoke\", along = \"90 deg\" }, yoke = \"0 deg\" }\n"
      "links = { crank = { points = \"O A\", mass = \"1 kg\", inertia = \"0.5 kg*m2\" }, block = \"A\", yoke = { "
      "points = \"Y\", mass = \"2 kg\" } }",
      3,
      {fmt::format(
          "m: dwells, no farther from its reversal than 1 % of its stroke: over {:.4g}° from φ = {:.5g}° to {:.5g}°, "
          "{:.4g}° from φ = {:.5g}° to {:.5g}°",
          2 * half, 360 - half, half, 2 * half, 180 - half, 180 + half)});
}

// A dead centre at 4e-13° by rounding stands at 0°.
TEST(MechanismWords, OfADeadCentreAtTheBeginning) {
  const std::string json = output_of(find_forces(test::scene_file("scenes/unloaded_compressor.toml"), {})).json();
  EXPECT_NE(json.find("dead centres at φ = 0°, 180°"), std::string::npos);
}

// OB = b ± a at the ends; the coupler stands worst on the rocker with the crank along the ground.
TEST(MechanismWords, OfACrankAndRocker) {
  constexpr double a = 0.08, b = 0.25, c = 0.2, d = 0.26;
  const auto crank = [&](double reach) { return std::acos((reach * reach + d * d - c * c) / (2 * reach * d)); };
  const auto rocker = [&](double reach) { return std::acos((c * c + d * d - reach * reach) / (2 * c * d)); };
  const double near = std::acos((b * b + c * c - (d - a) * (d - a)) / (2 * b * c)),
               far = pi - std::acos((b * b + c * c - (d + a) * (d + a)) / (2 * b * c));
  expect_words(
      "kind = \"four-bar\"\ncrank = \"80 mm\"\ncoupler = \"250 mm\"\nrocker = \"200 mm\"\nground = \"260 mm\"\n"
      "rocker_inertia = \"0.05 kg*m2\"",
      4,
      {"m: linkage of class II: crank drives RRR (coupler, rocker); degrees of freedom 3·3 − 2·4 = 1",
       transmission("RRR (coupler, rocker)", std::min(near, far), near < far ? 0 : pi),
       travel(swing(rocker(b + a) - rocker(b - a)), crank(b + a), pi + crank(b - a))});
}

// Lever tangent to the crank's circle at the ends: (π + 2γ)/(π − 2γ), sin γ = r/d.
TEST(MechanismWords, OfAnInvertedSliderCrank) {
  const double gamma = std::asin(0.1 / 0.25);
  expect_words(
      "kind = \"inverted slider-crank\"\ncrank = \"100 mm\"\nground = \"250 mm\"\nlever_inertia = \"0.06 kg*m2\"", 3,
      {"m: linkage of class II: crank drives RPR (block, lever); degrees of freedom 3·3 − 2·4 = 1",
       travel(swing(2 * gamma), pi / 2 - gamma, gamma - pi / 2),
       dwell([](double phi) { return std::atan2(0.1 * std::sin(phi), 0.25 - 0.1 * std::cos(phi)); },
             {pi / 2 - gamma, 3 * pi / 2 + gamma}, "swing")});
}

// The lever's end as high at both ends; there the link is steepest, so that its transmission angle is least twice.
TEST(MechanismWords, OfAShaper) {
  constexpr double r = 0.1, d = 0.2, lever = 0.4;
  const double gamma = std::asin(r / d);
  expect_words(
      "kind = \"quick-return\"\nradius = \"100 mm\"\npivot_distance = \"200 mm\"\nlever = \"400 mm\"\n"
      "link = \"300 mm\"\nguide_height = \"400 mm\"\nram_mass = \"60 kg\"",
      4,
      {"m: linkage of class II: crank drives RPR (lever, block), RRP (link, ram); degrees of freedom 3·5 − 2·7 = 1",
       travel(stroke(2 * lever * r / d), -gamma, pi + gamma)});
}

// Crank and rod in line at both ends, the knee always on one side.
TEST(MechanismWords, OfAKnucklePress) {
  constexpr double r = 0.05, rod = 0.25, upper = 0.2, lower = 0.2, gx = -0.16, gy = 0.3;
  struct End {
    double phi, x;
  };
  const auto end = [&](double reach) {
    const double ground = std::hypot(gx, gy);
    const double beta =
        std::atan2(gy, gx) - std::acos((reach * reach + ground * ground - upper * upper) / (2 * reach * ground));
    const double rise = reach * std::sin(beta) - gy;
    return End{beta, reach * std::cos(beta) + std::sqrt(lower * lower - rise * rise)};
  };
  const End far = end(rod + r), near = end(rod - r);
  expect_words(
      "kind = \"knuckle press\"\nradius = \"50 mm\"\nrod = \"250 mm\"\nbearing_x = \"-160 mm\"\nbearing_y = \"300 "
      "mm\"\n"
      "upper = \"200 mm\"\nlower = \"200 mm\"\nbranch = \"right\"\nram_mass = \"50 kg\"",
      5, {travel(stroke(far.x - near.x), far.phi, pi + near.phi)});
}

// In line with its slider the crank is at 0° and 180°, not at 360°; where links pass change points there is no group.
TEST(MechanismWords, OfEqualStrokesAndOfChangePoints) {
  expect_words("kind = \"slider-crank\"\nradius = \"100 mm\"\nrod = \"350 mm\"\nslider_mass = \"3 kg\"", 4,
               {travel(stroke(0.2), 0, pi)});
  expect_words(
      "kind = \"four-bar\"\ncrank = \"100 mm\"\ncoupler = \"300 mm\"\nrocker = \"100 mm\"\nground = \"300 mm\"\n"
      "rocker_inertia = \"0.05 kg*m2\"",
      4,
      {"m: its output turns as often as its driving link",
       "m: linkage of class II: crank drives RRR (coupler, rocker); degrees of freedom 3·3 − 2·4 = 1",
       "m: at the change points φ = 0°, 180° its links can go on in two ways; assumed is the smooth one. Joints alone "
       "do "
       "not force it: inertia does, or links at another angle beside it, as a second rod on cranks 90° apart"});
}

// At the end of a pendulum's arc its rod stands across its slider's line: the transmission angle is zero, not rounding.
TEST(MechanismWords, OfAnArcThatEndsAtADeadPosition) {
  const Scene scene = test::scene_file("scenes/pendulum_balance.toml");
  EXPECT_NE(
      output_of(reduce(scene, {})).json().find("transmission angle of RRP (rod, slider) at least 0°, at φ = -15.47°"),
      std::string::npos);
}

}  // namespace
}  // namespace kurbel::mechanism_words_test
