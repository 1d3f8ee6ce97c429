// period_test.cpp — where an angle or a time lies within a period, and that no machine sees on which turn it began.
#include "engine/numerics/period.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "drivetrain/shared/torque_source.h"
#include "engine/model/cycle_of.h"
#include "engine/model/model.h"
#include "engine/numerics/curve.h"
#include "tests/support/scenes.h"

namespace kurbel::period_test {
namespace {

using std::numbers::pi;
constexpr double least = std::numeric_limits<double>::denorm_min();

double moved(double x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, HUGE_VAL);
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -HUGE_VAL);
  return x;
}

// Values about every multiple of a period that rounding can take to either side.
std::vector<double> about_multiples(double period) {
  std::vector<double> values = {0.0, -0.0, least, -least, 1e-300, -1e-300, 1e-16, -1e-16, 1e-17, -1e-17};
  for (const double k : {-1e6, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 7.0, 1e6, 1e15})
    for (int ulps = -3; ulps <= 3; ++ulps) values.push_back(moved(k * period, ulps));
  return values;
}

TEST(Period, PlaceIsNeverLessThanNothingAndAlwaysLessThanThePeriod) {
  std::mt19937 random(2);
  for (const double period : {2 * pi, 4 * pi, 1.0, 0.1, 1e-9, 1e9, 1e-300, 100 * pi / 180}) {
    std::vector<double> values = about_multiples(period);
    for (int i = 0; i < 200; ++i)
      values.push_back(
          std::ldexp(std::uniform_real_distribution<double>(-1, 1)(random), static_cast<int>(random() % 80) - 40));
    for (const double x : values) {
      const double place = place_within(x, period);
      EXPECT_GE(place, 0) << x << " in " << period;
      EXPECT_LT(place, period) << x << " in " << period;
      // What is taken away is a whole number of periods, to the rounding of the place.
      const double left = std::remainder(x - place, period);
      EXPECT_LE(std::fabs(left), 4e-16 * (std::fabs(x) + period)) << x << " in " << period;
    }
  }
}

TEST(Period, EveryPlaceOfAPeriodicTableIsInAPiece) {
  for (const double first : {0.0, -0.3, 1.7, 1e-16, -1e-16})
    for (const double period : {2 * pi, 4 * pi, 0.02}) {
      const std::vector<double> x = {first, first + 0.25 * period, first + 0.5 * period, first + 0.9 * period};
      const Curve curve(x, {1, 3, -2, 4}, Curve::Form::linear, period);
      std::vector<double> values = about_multiples(period);
      for (const double knot : x)
        for (const double turns : {-2.0, 0.0, 1.0, 5.0})
          for (int ulps = -3; ulps <= 3; ++ulps) values.push_back(moved(knot + turns * period, ulps));
      for (const double at : values) {
        const int piece = curve.piece(at);
        ASSERT_GE(piece, 0) << at;
        ASSERT_LE(piece, 3) << at;
        const double expected = curve.value(place_within(at - first, period) + first);
        EXPECT_NEAR(curve.value(at), expected, 40e-16 * (std::fabs(at) + period) * 60 / period) << at;
      }
    }
}

TEST(Period, NextEdgeOfALawOverTimeLiesAhead) {
  for (const double period : {0.1, 1.0 / 3, 1e-3, 7.0}) {
    const TorqueOverTime law{.curve = Curve({0, 0.25 * period, 0.7 * period}, {1, 4, -2}, Curve::Form::linear, period)};
    std::vector<double> times = about_multiples(period);
    for (const double knot : {0.25 * period, 0.7 * period})
      for (const double k : {0.0, 1.0, 3.0, 1e3, 1e6})
        for (int ulps = -3; ulps <= 3; ++ulps) times.push_back(moved(knot + k * period, ulps));
    for (const double t : times) {
      if (std::fabs(t) > 1e7) continue;
      const int mode = law.mode_at(t);
      EXPECT_TRUE(mode >= 0 && mode <= 2) << t;
      EXPECT_GT(law.next_edge(t), t) << period;
      EXPECT_LT(law.next_edge(t) - t, 0.46 * period + 1e-12 * std::fabs(t)) << t << " in " << period;
    }
  }
}

// --- machines ---

// A figure of a run, without those that count from where it began.
struct Figures {
  std::vector<std::string> name;
  std::vector<double> value, scale;
};

Figures figures_of(Scene scene, double angle, double until) {
  scene.run.start.angle = angle;
  scene.run.until = until;
  SimulateOptions options{.measure_error = false, .method = {}, .accuracy = {}, .until = {}};
  options.first_tolerance = 1e-10;
  const Result r = simulate(scene, scene.effects, "shifted", options);
  EXPECT_TRUE(r.complete) << scene.file << " from " << angle << ": " << r.diagnosis;
  Figures figures;
  for (const Figure& f : r.figures) {
    if (f.name.starts_with("work_of_")) continue;  // of whole cycles, which begin at multiples of the cycle
    figures.name.push_back(f.name);
    figures.value.push_back(f.name.starts_with("final_angle.") ? 0 : f.value);
    figures.scale.push_back(std::max(f.scale, std::fabs(f.value)));
  }
  return figures;
}

void expect_same(const Figures& a, const Figures& b, double tolerance, const std::string& which) {
  ASSERT_EQ(a.name, b.name) << which;
  for (std::size_t i = 0; i < a.name.size(); ++i)
    EXPECT_NEAR(a.value[i], b.value[i], tolerance * a.scale[i]) << a.name[i] << ": " << which;
}

std::string engine(int cylinders, const std::string& strokes, const std::string& phase) {
  std::string order;
  for (int k = 1; k <= cylinders; ++k) order += fmt::format("{}{}", k > 1 ? ", " : "", k);
  return fmt::format(R"(
line = ["engine", "fan"]
[engine]
kind = "engine"
firing_order = [{}]
strokes = "{}"
phase = "{}"
inertia = "0.4 kg*m2"
torque = {{ over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [20, 300], [60, 120], [180, 0], [300, -20]] }}
[fan]
kind = "load"
quadratic = "1e-3 N*m*s2/rad2"
inertia = "1 kg*m2"
[run]
start = {{ speed = "60 rad/s" }}
until = "0.3 s"
)",
                     order, strokes, phase);
}

std::string over_angle(const std::string& period) {
  return fmt::format(R"(
line = ["motor", "mill"]
[motor]
kind = "dc shunt motor"
stall_torque = "60 N*m"
no_load_speed = "40 rad/s"
inertia = "0.2 kg*m2"
[mill]
kind = "load"
table = {{ over = "angle", period = "{}", unit = ["deg", "N*m"], points = [[0, 5], [30, 25], [70, 2]] }}
inertia = "0.3 kg*m2"
[run]
start = {{ speed = "30 rad/s" }}
until = "1 s"
)",
                     period);
}

// A start is rounded to 1e-15 rad a turn, which figures magnify by their sensitivity. A start a hair before a knot
// makes an event of it, or an ulp another step: then runs at a tolerance of 1e-10 differ by some hundreds of that, as
// works do, which take no part in the error control.
constexpr double of_steps = 1e-7;

std::vector<double> starts_about(double knot, double period) {
  std::vector<double> starts;
  for (const double turns : {0.0, 1.0, -1.0, 3.0, -4.0})
    for (const int ulps : {0, 1, -1, 3, -3}) starts.push_back(moved(knot + turns * period, ulps));
  for (const double tiny : {1e-16, -1e-16, least, -least}) starts.push_back(knot + tiny);
  return starts;
}

TEST(Period, EnginesOfAnyNumberOfCylindersStartOnAnyTurn) {
  for (const int cylinders : {1, 2, 3, 5, 6, 8, 12})
    for (const std::string strokes : {"four", "two"}) {
      const double cycle = strokes == "four" ? 4 * pi : 2 * pi;
      const Scene scene = test::scene_from(engine(cylinders, strokes, "0 deg"));
      const Figures base = figures_of(scene, 0, 0.1);
      for (const double start :
           {cycle, moved(cycle, -1), moved(cycle, 1), -cycle, 3 * cycle, -1e-16, 1e-16, -least, 4 * pi, -8 * pi})
        expect_same(base, figures_of(scene, start, 0.1), of_steps,
                    fmt::format("{} cylinders from {:.17g}", cylinders, start));
      for (const char* phase : {"1e-16 rad", "-1e-16 rad", "720 deg", "-360 deg", "5e-324 rad"})
        if (strokes == "four" || phase[0] != '-')
          expect_same(base,
                      figures_of(test::scene_from(
                                     engine(cylinders, strokes, phase == std::string("-360 deg") ? "-720 deg" : phase)),
                                 0, 0.1),
                      of_steps, fmt::format("{} cylinders, phase {}", cylinders, phase));
    }
}

TEST(Period, LawsOverTheAngleStartOnAnyTurn) {
  for (const auto& [text, period] :
       {std::pair{"360 deg", 2 * pi}, {"720 deg", 4 * pi}, {"180 deg", pi}, {"240 deg", pi * 4 / 3}}) {
    const Scene scene = test::scene_from(over_angle(text));
    for (const double knot : {0.0, pi / 6, pi * 70 / 180}) {
      const Figures base = figures_of(scene, knot, 3);
      for (const double start : starts_about(knot, period))
        expect_same(base, figures_of(scene, start, 3), of_steps, fmt::format("period {} from {:.17g}", text, start));
    }
  }
}

// Behind 1009:1000 a law of 72° repeats after 0.2018 turns, and with whole turns never within a thousand: the machine's
// cycle is the law's, and what averages over whole turns takes one.
TEST(Period, ALawThatNeverMeetsATurnKeepsItsOwn) {
  const auto model = compile(test::scene_from(R"(
line = ["motor", "gearbox", "mill"]
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.2 kg*m2" }
gearbox = { kind = "gearbox", stages = [{ teeth = [1000, 1009], inertia = ["0 kg*m2", "0 kg*m2"] }] }
mill = { kind = "load", inertia = "0.3 kg*m2", table = { over = "angle", period = "72 deg", unit = ["deg", "N*m"], points = [[0, 5], [30, 25]] } }
)"),
                             {});
  const CyclePeriod cycle = cycle_of(*model);
  EXPECT_FALSE(cycle.periodic);
  EXPECT_DOUBLE_EQ(cycle.angle, 2 * pi);
  EXPECT_NEAR(cycle.of_laws, 2 * pi * 0.2 * 1.009, 1e-12);
  EXPECT_DOUBLE_EQ(model->cycle, cycle.of_laws);
}

// A force over the crank angle, with sharp knots and with rounded ones; the second cylinder stands 90° ahead.
TEST(Period, ForcesOverTheCrankAngleStartOnAnyTurn) {
  const auto text = [](const std::string& edges) {
    const std::string cylinder = R"(kind = "slider-crank"
radius = "0.1 m"
rod = "0.35 m"
crank_inertia = "0.55 kg*m2"
slider_mass = "3 kg"
load = { kind = "table", rounding_angle = "4 deg", force = { over = "angle", unit = ["deg", "N"], period = "720 deg", points = [[0, 10], [30, 900], [200, 20], [540, 300]] } }
)";
    return "line = [\"first\", \"second\"]\n[first]\n" + cylinder + "[second]\nphase = \"90 deg\"\n" + cylinder +
           "[effects]\nload_edges = " + edges + "\n[run]\nstart = { speed = \"30 rad/s\" }\n";
  };
  for (const std::string edges : {"true", "false"}) {
    const Scene scene = test::scene_from(text(edges));
    for (const double knot : {0.0, pi / 6}) {
      const Figures base = figures_of(scene, knot, 0.5);
      for (const double start : starts_about(knot, 4 * pi))
        expect_same(base, figures_of(scene, start, 0.5), of_steps,
                    fmt::format("load edges {}, from {:.17g}", edges, start));
    }
  }
}

// Every example scene, whatever it is made of: whole cycles of 720° on, and a hair to either side of it.
TEST(Period, ExampleScenesDoNotSeeTheTurnTheyBeginOn) {
  for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes"))) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = test::scene_file("scenes/" + entry.path().filename().string());
    const double until = std::min(scene.run.until, 0.02), angle = scene.run.start.angle;
    const Figures base = figures_of(scene, angle, until);
    for (const double start :
         {angle + 4 * pi, angle - 4 * pi, moved(angle + 4 * pi, -1), moved(angle, -2), angle - 1e-16})
      expect_same(base, figures_of(scene, start, until), of_steps, fmt::format("{} from {:.17g}", scene.file, start));
  }
}

}  // namespace
}  // namespace kurbel::period_test
