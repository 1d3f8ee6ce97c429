// misfire_test.cpp — a cylinder that does not fire: its mirrored diagram, the torque that is missing, its half orders; of
// one engine on a rigid crankshaft and of throws by their firing order (theory 4.14, 4.19).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/reading/mirrored.h"
#include "mechanisms/reduced/mechanism.h"
#include "tests/published/published.h"

namespace kurbel::misfire_test {
namespace {

using test::figure;
using test::run;

constexpr double pi = std::numbers::pi, cycle = 4 * pi, degree = pi / 180;

CurveData data_of(std::vector<double> degrees, std::vector<double> y, Curve::Form form) {
  CurveData data;
  data.over = "angle", data.form = form, data.y = std::move(y);
  for (const double x : degrees) data.x.push_back(x * degree);
  return data;
}

const std::vector<double> places = {0, 12, 40, 95, 170, 200, 360, 390, 540, 610, 660, 700, 720};
const std::vector<double> values = {40, 55, 30, 8, 3, 1.2, 1.1, 0.9, 0.95, 2, 6, 24, 40};

// f*(x) = f(c − x) within the first half turn, else f, also from points that begin elsewhere. A smooth one has its points,
// and where halves meet other slopes between them.
TEST(MirroredDiagram, IsItsCompressionBackwardsAndElseItself) {
  for (const Curve::Form form : {Curve::Form::linear, Curve::Form::smooth})
    for (const double shift : {0.0, 250.0}) {
      std::vector<double> x, y;
      for (std::size_t i = 0; i + 1 < places.size(); ++i)
        if (places[i] >= shift) x.push_back(places[i]), y.push_back(values[i]);
      for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] < shift || (shift == 0 && i + 1 == places.size()))
          x.push_back(places[i] + (shift > 0 ? 720 : 0)), y.push_back(values[i]);
      const CurveData data = data_of(x, y, form);
      const Curve fired = data.curve(cycle);
      for (const bool odd : {false, true}) {
        const Curve motored = first_half_turn_mirrored(data, cycle, odd).curve();
        const auto expected = [&](double phi) {
          return phi < pi ? (odd ? -1 : 1) * fired.value(cycle - phi) : fired.value(phi);
        };
        for (double phi = 0.003; phi < cycle && form == Curve::Form::linear; phi += 0.0171)
          EXPECT_NEAR(motored.value(phi), expected(phi), 1e-12 * 55) << phi / degree;
        for (const double phi : {20.0, 60.0, 110.0, 200.0, 360.0, 390.0, 610.0, 660.0, 700.0})
          EXPECT_NEAR(motored.value(phi * degree), expected(phi * degree), 1e-11 * 55) << phi;
      }
    }
}

TEST(MirroredDiagram, OfAFormulaIsRefused) {
  CurveData data;
  data.by_formula = Curve({0, 1}, {0, 1}, Curve::Form::linear);
  EXPECT_THROW(first_half_turn_mirrored(data, cycle, false), std::invalid_argument);
}

const char* const gas =
    R"(over = "angle", unit = ["deg", "bar"], points = [[0, 40], [12, 55], [40, 30], [95, 8], [170, 3], [200, 1.2], [360, 1.1], [390, 0.9], [540, 0.95], [610, 2], [660, 6], [700, 24], [720, 40]])";

// An engine at a held speed: its torque is that of the shaft that drives.
std::string engine(const std::string& misfire) {
  return fmt::format(R"(
line = ["drive", "engine"]
drive = {{ kind = "prescribed speed", speed = "1500 rpm" }}
run = {{ until = "0.08 s", samples = 1441, accuracy = 1e-9 }}
[engine]
kind = "engine"
firing_order = [1, 3, 4, 2]
bore = "81 mm"
radius = "44 mm"
rod = "144 mm"
inertia = "0.1 kg*m2"
{}
pressure = {{ {} }}
)",
                     misfire, gas);
}

// What the cylinder that fires has and the motored one has not, of theory 4.14 with the slider-crank's own lever.
double missing(double phi) {
  const Curve fired = data_of(places, values, Curve::Form::linear).curve(cycle);
  const double x = fired.within(phi), l = 44.0 / 144;
  if (x >= pi) return 0;
  const double lever =
      0.044 * (std::sin(x) + l * std::sin(x) * std::cos(x) / std::sqrt(1 - std::pow(l * std::sin(x), 2)));
  return (fired.value(x) - fired.value(cycle - x)) * 1e5 * pi / 4 * 0.081 * 0.081 * lever;
}

TEST(Misfire, TakesItsCylindersShareOfTheTorqueAway) {
  const Result misfires = run(engine("misfire = [4]"), false);
  EXPECT_NE(misfires.notes.front().find("give \"motored_pressure\""), std::string::npos);
  const auto whole = test::series(run(engine(""), false), "torque.engine"),
             out = test::series(misfires, "torque.engine");
  ASSERT_EQ(whole.size(), out.size());
  for (std::size_t row = 0; row < whole.size(); ++row) {
    const double phi = 50 * pi * 0.08 * static_cast<double>(row) / 1440;
    const double at = phi - 2 * pi;                         // cylinder 4 is the third to fire: at 360 deg
    if (std::abs(std::remainder(at, pi)) < 1e-6) continue;  // at its dead centres the diagram jumps
    EXPECT_NEAR(std::abs(whole[row] - out[row]), std::abs(missing(at)), 1e-7) << phi / degree;
  }
}

// Orders ½, 1, 1½ of the crankshaft: nothing of four equal cylinders; with one out the phasor of what is missing.
TEST(Misfire, BringsHalfOrdersOfTheSizeOfTheMissingTorque) {
  const Result whole = run(engine(""), false), out = run(engine("misfire = [4]"), false);
  for (const int r : {1, 2, 3}) {  // of the cycle
    const double omega = 25 * pi * r;
    std::complex<double> sum = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i)
      sum += missing(cycle * (i + 0.5) / n) * std::polar(2.0 / n, -0.5 * r * cycle * (i + 0.5) / n);
    EXPECT_LT(test::harmonic_amplitude(whole, "torque.engine", omega), 1e-6);
    EXPECT_NEAR(test::harmonic_amplitude(out, "torque.engine", omega), std::abs(sum), 3e-4 * std::abs(sum)) << r;
  }
}

// Its closed part does no work: what is compressed comes back; nor does the gas exchange at one pressure. Each cycle is
// the one before, for ever; fired, the engine gains each time.
TEST(Misfire, AloneGivesEveryCycleTheWorkOfTheOneBefore) {
  const auto after = [](const char* time, const char* misfire) {
    return run(fmt::format(R"(
line = ["engine"]
run = {{ start = {{ speed = "100 rad/s", angle = "180 deg" }}, until = "{}", accuracy = 1e-10, samples = 3 }}
[engine]
kind = "engine"
firing_order = [1]
{}
bore = "81 mm"
radius = "44 mm"
rod = "144 mm"
inertia = "0.5 kg*m2"
pressure = {{ over = "angle", unit = ["deg", "bar"], points = [[0, 40], [12, 70], [40, 30], [95, 8], [170, 3], [175, 1], [540, 1], [610, 2], [660, 6], [700, 24], [720, 40]] }}
)",
                           time, misfire));
  };
  const Result one = after("0.2 s", "misfire = [1]"), many = after("1.3 s", "misfire = [1]");
  ASSERT_TRUE(one.complete && many.complete) << one.diagnosis << many.diagnosis;
  EXPECT_NEAR(figure(one, "max_speed.engine"), figure(many, "max_speed.engine"), 1e-8);
  EXPECT_NEAR(figure(one, "min_speed.engine"), figure(many, "min_speed.engine"), 1e-8);
  EXPECT_LT(figure(one, "min_speed.engine"), 99);
  EXPECT_GT(figure(after("1.3 s", ""), "max_speed.engine"), 120);
}

// With an offset the piston turns elsewhere, and the mirror image would do work (2.6 % of the speed a cycle here): refused,
// while the motored diagram is taken; without offset the same throw loses nothing.
TEST(Misfire, OfAThrowWithAnOffsetNeedsTheMotoredDiagram) {
  const auto after = [](const char* offset, const char* motored) {
    return run(fmt::format(R"(
line = ["c"]
run = {{ start = {{ speed = "100 rad/s", angle = "180 deg" }}, until = "1.3 s", accuracy = 1e-9, samples = 3 }}
[c]
kind = "slider-crank"
radius = "44 mm"
rod = "144 mm"
offset = "{}"
crank_inertia = "0.5 kg*m2"
load = {{ kind = "cylinder", bore = "81 mm", outside_pressure = "1 bar", misfire = true, {} pressure = {{ over = "angle", unit = ["deg", "bar"], points = [[0, 40], [12, 70], [40, 30], [95, 8], [170, 3], [175, 1], [540, 1], [610, 2], [660, 6], [700, 24], [720, 40]] }} }}
)",
                           offset, motored));
  };
  const auto reported = [](const Result& r) {
    return std::any_of(r.notes.begin(), r.notes.end(), [](const std::string& note) {
      return note.starts_with("c.load: a cylinder that does not fire");
    });
  };
  const Result straight = after("0 mm", "");
  ASSERT_TRUE(straight.complete) << straight.diagnosis;
  EXPECT_TRUE(reported(straight));                          // that its diagram is a substitute
  EXPECT_NEAR(figure(straight, "max_speed.c"), 100, 1e-6);  // comes back to where each cycle began
  try {
    after("15 mm", "");
    FAIL() << "taken";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("give \"motored\""), std::string::npos) << error.what();
  }
  const Result given = after(
      "15 mm", R"(motored = { over = "angle", unit = ["deg", "bar"], points = [[0, 20], [360, 1], [720, 20]] },)");
  EXPECT_TRUE(given.complete && !reported(given));
}

// Massless throws by the firing order do what one engine does, cylinder by cylinder, misfire included.
TEST(FiringOrder, ThrowsAreTheCylindersOfOneEngine) {
  std::string throws = R"(
line = ["one", "two", "three", "four"]
run = { start = { speed = "1500 rpm" }, until = "0.08 s", samples = 241, accuracy = 1e-11 }
[table.throw]
firing_order = [1, 3, 4, 2]
radius = "44 mm"
rod = "144 mm"
crank_inertia = "0.025 kg*m2"
)";
  const char* const names[] = {"one", "two", "three", "four"};
  for (int k = 0; k < 4; ++k)
    throws += fmt::format(
        "[{0}]\nkind = \"slider-crank\"\nuse = \"table.throw\"\ncylinder = {1}\nload = {{ kind = \"cylinder\", bore = "
        "\"81 mm\", outside_pressure = \"1.013 bar\", {2}pressure = {{ {3} }} }}\n",
        names[k], k + 1, k == 3 ? "misfire = true, " : "", gas);
  const auto by_throws = test::series(run(throws, false), "speed.one");
  std::string one =
      test::with(engine("misfire = [4]"),
                 "line = [\"drive\", \"engine\"]\ndrive = { kind = \"prescribed speed\", speed = \"1500 rpm\" }\n",
                 "line = [\"engine\"]\n");
  one = test::with(one, "run = { until = \"0.08 s\", samples = 1441, accuracy = 1e-9 }",
                   "run = { start = { speed = \"1500 rpm\" }, until = \"0.08 s\", samples = 241, accuracy = 1e-11 }");
  const auto by_engine = test::series(run(one, false), "speed.engine");
  ASSERT_EQ(by_throws.size(), by_engine.size());
  for (std::size_t row = 0; row < by_throws.size(); ++row) EXPECT_NEAR(by_throws[row], by_engine[row], 1e-8) << row;
  EXPECT_GT(
      *std::max_element(by_engine.begin(), by_engine.end()) - *std::min_element(by_engine.begin(), by_engine.end()), 5);
}

// Phases of a four-cylinder's pins: 0, 180, 180 and 0 deg; one that is given must be the same crank.
TEST(FiringOrder, GivesThePhaseAndReportsOneThatIsAnother) {
  const auto scene = [](const std::string& more) {
    return "line = [\"drive\", \"c\"]\ndrive = { kind = \"prescribed speed\", speed = \"10 rad/s\" }\n[c]\nkind = "
           "\"slider-crank\"\nradius = \"40 mm\"\nrod = \"140 mm\"\ncrank_inertia = \"1 kg*m2\"\n" +
           more + "\n";
  };
  const auto phase_of = [&](const std::string& more) {
    const Scene s = test::scene_from(scene(more));
    const auto model = compile(s, s.effects);
    for (const Network::ShaftElement& e : model->network.elements)
      if (const MechanismElement* m = mechanism_of(e)) return m->mechanism().phase;
    return std::nan("");
  };
  const std::string order = "firing_order = [1, 3, 4, 2]\n";
  EXPECT_NEAR(phase_of(order + "cylinder = 1"), 0, 1e-15);
  EXPECT_NEAR(phase_of(order + "cylinder = 3"), 3 * pi, 1e-14);  // fires at 180 deg of the shaft
  EXPECT_NEAR(phase_of(order + "cylinder = 4"), 2 * pi, 1e-14);
  EXPECT_NEAR(phase_of(order + "cylinder = 2"), pi, 1e-14);
  EXPECT_NEAR(phase_of(order + "cylinder = 2\nphase = \"-180 deg\""), pi, 1e-14);
  EXPECT_NEAR(phase_of("firing_order = [1, 2]\nfiring_intervals = [\"180 deg\", \"540 deg\"]\ncylinder = 2"), 3 * pi,
              1e-14);
  EXPECT_NEAR(phase_of("firing_order = [1, 2, 3]\nstrokes = \"two\"\ncylinder = 3"), 2 * pi / 3, 1e-14);
  try {
    phase_of(order + "cylinder = 2\nphase = \"90 deg\"");
    FAIL() << "taken";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("phase = 180 deg"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace kurbel::misfire_test
