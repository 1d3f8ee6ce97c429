// output_start_test.cpp — a machine that starts at a given position of slider or rocker, against the closed forms of
// slider-crank and four-bar.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/published/published.h"

namespace kurbel::output_start_test {
namespace {

constexpr double pi = std::numbers::pi;

Scene started(const std::string& mechanism, const std::string& start) {
  return test::scene_from(
      fmt::format("line = [\"wheel\", \"m\"]\nwheel = {{ kind = \"flywheel\", inertia = \"1 kg*m2\" "
                  "}}\n[m]\n{}\n[run]\nstart = {{ {} "
                  "}}\n",
                  mechanism, start));
}

constexpr double r = 0.1, l = 0.35, e = 0.02;
const char* const crank =
    "kind = \"slider-crank\"\nradius = \"100 mm\"\nrod = \"350 mm\"\noffset = \"20 mm\"\nslider_mass = \"3 kg\"";

double position(double phi) { return r * std::cos(phi) + std::sqrt(l * l - std::pow(r * std::sin(phi) - e, 2)); }
double slope(double phi) {
  const double s = r * std::sin(phi) - e;
  return -r * std::sin(phi) - s * r * std::cos(phi) / std::sqrt(l * l - s * s);
}

// Each stroke, each sense, each way of telling it; the phase is the shaft's.
TEST(OutputStart, SliderGivesAngleAndSpeedOfItsCrank) {
  const double extended = std::asin(e / (l + r)), folded = pi + std::asin(e / (l - r));
  for (const double shift : {0.0, 50.0})
    for (const double phi : {0.4, 1.7, 2.9, 3.6, 4.4, 6.1})
      for (const double omega : {7.0, -7.0, 0.0}) {
        const bool falling = phi > extended && phi < folded;
        const std::string velocity = omega == 0 ? "" : fmt::format(", velocity = \"{:.17g} m/s\"", slope(phi) * omega);
        const bool by_velocity = omega > 0 || (omega == 0 && falling);  // is what is meant unless stated
        for (const bool reported : {true, false}) {
          if (!reported && !by_velocity) continue;
          SCOPED_TRACE(fmt::format("{} {} {} {}", shift, phi, omega, reported));
          const Scene scene =
              started(fmt::format("{}\nphase = \"{} deg\"", crank, shift),
                      fmt::format("on = \"m.slider\", position = \"{:.17g} m\"{}{}", position(phi), velocity,
                                  reported ? fmt::format(", towards = \"{}\"", falling ? "folded" : "extended") : ""));
          EXPECT_EQ(scene.run.start.on, "m");
          EXPECT_NEAR(std::remainder(scene.run.start.angle - phi + shift * pi / 180, 2 * pi), 0, 1e-10);
          EXPECT_NEAR(scene.run.start.speed, omega, 1e-8);
        }
      }
}

// At an end of the stroke both strokes meet.
TEST(OutputStart, SliderStandsAtItsDeadCentre) {
  for (const char* towards : {"folded", "extended"}) {
    const Scene scene = started(crank, fmt::format("on = \"m.slider\", position = \"{:.17g} m\", towards = \"{}\"",
                                                   std::sqrt((l + r) * (l + r) - e * e), towards));
    EXPECT_NEAR(scene.run.start.angle, std::asin(e / (l + r)), 1e-6);
  }
}

// The rocker of a crank–rocker: cosine theorems over the diagonal from crank pin to rocker bearing.
TEST(OutputStart, RockerGivesAngleAndSpeedOfItsCrank) {
  const double a = 0.06, b = 0.24, c = 0.18, d = 0.25;
  const auto rocker = [&](double phi) {
    const double x = d - a * std::cos(phi), y = -a * std::sin(phi), diagonal = std::hypot(x, y);
    const double at_bearing = std::acos((diagonal * diagonal + c * c - b * b) / (2 * diagonal * c));
    return std::atan2(-y, -x) - at_bearing;  // open: the pin lies left of the line from crank pin to bearing
  };
  const double h = 1e-5;
  for (const double phi : {0.8, 2.0, 4.0, 5.5}) {
    const double rate =
        (rocker(phi - 2 * h) - 8 * rocker(phi - h) + 8 * rocker(phi + h) - rocker(phi + 2 * h)) / (12 * h);
    const double turned = rocker(phi) < 0 ? rocker(phi) + 2 * pi : rocker(phi);
    const Scene scene = started(
        "kind = \"four-bar\"\ncrank = \"60 mm\"\ncoupler = \"240 mm\"\nrocker = \"180 mm\"\nground = \"250 "
        "mm\"\nrocker_inertia = \"0.1 kg*m2\"",
        fmt::format("on = \"m.rocker\", position = \"{:.17g} rad\", velocity = \"{:.17g} rad/s\"", turned, 5 * rate));
    EXPECT_NEAR(scene.run.start.angle, phi, 1e-9);
    EXPECT_NEAR(scene.run.start.speed, 5, 1e-7);
  }
}

// The first row of a run is what was given.
TEST(OutputStart, RunBeginsThere) {
  const Result result =
      test::run(started(crank, "on = \"m.slider\", position = \"400 mm\", velocity = \"0.7 m/s\""), false);
  ASSERT_TRUE(result.complete) << result.diagnosis;
  EXPECT_NEAR(test::series(result, "position.m").front(), 0.4, 1e-12);
  EXPECT_NEAR(test::series(result, "velocity.m").front(), 0.7, 1e-11);
}

}  // namespace
}  // namespace kurbel::output_start_test
