// engine_torque_test.cpp — several cylinders by firing order: harmonics that cancel, work, the same as with mechanisms.
#include "drivetrain/motors/engine_torque.h"

#include <fmt/format.h>

#include <complex>
#include <random>

#include "tests/published/published.h"

namespace kurbel::engine_torque_test {
namespace {

using test::run;

constexpr double pi = std::numbers::pi;

double torque_at(const EngineTorque& engine, double phi) {
  ShaftState<double> x{0, phi, 100, 0, 1};
  x.mode = engine.first_mode(x);
  return engine.torque(x);
}

Curve some_diagram(unsigned seed, double cycle, Curve::Form form) {
  std::mt19937 random(seed);
  const auto some = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  std::vector<double> x = {some(0, 0.2)}, y = {some(-20, 100)};
  while (x.back() + 0.6 < cycle) {
    x.push_back(x.back() + some(0.05, 0.6));
    y.push_back(some(-20, 100));
  }
  return Curve(x, y, form, cycle);
}

struct Engine {
  int cylinders;
  int strokes;
  Curve::Form form;
};
class EqualIntervals : public ::testing::TestWithParam<Engine> {
 protected:
  const int n = GetParam().cylinders;
  const double cycle = GetParam().strokes * pi;
  const Curve diagram = some_diagram(static_cast<unsigned>(n + GetParam().strokes), cycle, GetParam().form);
  EngineTorque engine(CylinderGeometry geometry = {}) const {
    std::vector<EngineTorque::Cylinder> cylinders;
    for (int k = 0; k < n; ++k) cylinders.push_back({0.3 + k * cycle / n, 0});
    return EngineTorque({diagram}, geometry, cylinders);
  }
  static constexpr CylinderGeometry geometry{0.006, 0.045, 0.14, 1.0};
  // Values over one cycle; 720 n of them, so that every cylinder sees the same angles.
  std::vector<double> sampled(const EngineTorque& engine) const {
    std::vector<double> values;
    for (int i = 0; i < 720 * n; ++i) values.push_back(torque_at(engine, cycle * i / (720 * n)));
    return values;
  }
  std::complex<double> harmonic(const std::vector<double>& values, int order) const {  // of the cycle
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += values[i] * std::polar(1.0, -2 * pi * order * static_cast<double>(i) / static_cast<double>(values.size()));
    return sum / static_cast<double>(values.size());
  }
};

// Of a four-stroke engine only the orders n/2, n, … of the crankshaft are left; each is n times the single cylinder's.
TEST_P(EqualIntervals, LeaveOnlyMultiplesOfTheNumberOfCylindersPerCycle) {
  for (const CylinderGeometry& g : {CylinderGeometry{}, geometry}) {
    const EngineTorque single({diagram}, g, {{0.3}});
    const auto all = sampled(engine(g)), one = sampled(single);
    const double scale = std::max(single.rated().torque, 1e-9);
    EXPECT_NEAR(harmonic(all, 0).real(), n * harmonic(one, 0).real(), 1e-12 * n * scale);
    for (int order = 1; order <= 24; ++order) {
      const std::complex<double> expected = order % n == 0 ? harmonic(one, order) * static_cast<double>(n) : 0;
      EXPECT_NEAR(std::abs(harmonic(all, order) - expected), 0, 1e-12 * n * scale) << order;
    }
  }
}

TEST_P(EqualIntervals, SumUpTheDiagramsOfAllCylinders) {
  const EngineTorque whole = engine(geometry);
  for (int i = 0; i < 500; ++i) {
    const double phi = i * 0.0371;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double at = phi - 0.3 - k * cycle / n, l = 0.045 / 0.14;
      sum += (diagram.value(at) - 1.0) * 0.006 * 0.045 *
             (std::sin(at) + l * std::sin(at) * std::cos(at) / std::sqrt(1 - std::pow(l * std::sin(at), 2)));
    }
    EXPECT_NEAR(torque_at(whole, phi), sum, 1e-12 * whole.rated().torque * n);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, EqualIntervals,
                         ::testing::Values(Engine{1, 4, Curve::Form::linear}, Engine{2, 4, Curve::Form::smooth},
                                           Engine{3, 4, Curve::Form::linear}, Engine{4, 4, Curve::Form::smooth},
                                           Engine{5, 4, Curve::Form::linear}, Engine{6, 4, Curve::Form::smooth},
                                           Engine{8, 4, Curve::Form::linear}, Engine{12, 4, Curve::Form::smooth},
                                           Engine{1, 2, Curve::Form::smooth}, Engine{2, 2, Curve::Form::linear},
                                           Engine{3, 2, Curve::Form::smooth}, Engine{7, 2, Curve::Form::linear}),
                         [](const auto& info) {
                           return fmt::format("{}Cylinders{}Strokes", info.param.cylinders, info.param.strokes);
                         });

// Points of four cylinders at 10° steps fall together: 72 in the cycle, not 288.
TEST(EngineTorque, PointsThatFallTogetherAreOneEdge) {
  std::vector<double> x, y;
  for (int i = 0; i < 72; ++i) {
    x.push_back(i * pi / 18);
    y.push_back(std::sin(0.1 * i * i));
  }
  const EngineTorque engine({Curve(x, y, Curve::Form::linear, 4 * pi)}, {}, {{0}, {pi}, {2 * pi}, {3 * pi}});
  ShaftState<double> at{0, 0.001, 1, 0, 1};
  int pieces = 0;
  do {
    at.mode = engine.next_mode(at, 1);
    ++pieces;
  } while (at.mode != 0 && pieces < 1000);
  EXPECT_EQ(pieces, 72);
}

// Four massless slider-cranks with their phases give the drive the same work at any moment as one engine does.
TEST(EngineTorque, IsThatOfSliderCranksWithTheirPhases) {
  const std::string diagram =
      "{ over = \"angle\", unit = [\"deg\", \"bar\"], period = \"720 deg\", points = [[0, 21], [15, 45], [60, 14], "
      "[180, "
      "3], [200, 1.1], [360, 1.1], [380, 0.9], [540, 0.9], [640, 3], [720, 21]] }";
  const double area = pi / 4 * 0.081 * 0.081;
  // As gas force for the mechanisms: (p − 1.013 bar) A.
  std::string force = "{ over = \"angle\", unit = [\"deg\", \"N\"], period = \"720 deg\", points = [";
  const double table[][2] = {{0, 21},    {15, 45},   {60, 14},   {180, 3}, {200, 1.1},
                             {360, 1.1}, {380, 0.9}, {540, 0.9}, {640, 3}, {720, 21}};
  for (const auto& row : table) force += fmt::format("[{}, {:.17g}],", row[0], (row[1] - 1.013) * 1e5 * area);
  force += "] }";
  const std::string end = "[run]\nuntil = \"0.0237 s\"\naccuracy = 1e-10\n";
  const std::string drive = "drive = { kind = \"prescribed speed\", speed = \"3000 rpm\" }\n";
  std::string cranks = "line = [\"drive\", \"c1\", \"c2\", \"c3\", \"c4\"]\n" + drive;
  const int phase[] = {0, 180, 540, 360};  // fires 0, 540, 180, 360 deg of the crankshaft: order 1-3-4-2
  for (int k = 0; k < 4; ++k)
    cranks += fmt::format(
        "[c{}]\nkind = \"slider-crank\"\nradius = \"44 mm\"\nrod = \"144 mm\"\ncrank_inertia = \"1e-3 kg*m2\"\nphase = "
        "\"{} deg\"\nload = {{ kind = \"table\", work = \"driving\", force = {} }}\n",
        k + 1, phase[k], force);
  const Result mechanisms = run(cranks + end);
  const Result engine =
      run("line = [\"drive\", \"engine\"]\n" + drive +
          "[engine]\nkind = \"engine\"\nfiring_order = [1, 3, 4, 2]\nbore = \"81 mm\"\nradius = \"44 mm\"\nrod = \"144 "
          "mm\"\ninertia = \"4e-3 kg*m2\"\npressure = " +
          diagram + "\n" + end);
  ASSERT_TRUE(mechanisms.complete && engine.complete);
  double work = 0;
  for (int k = 1; k <= 4; ++k) work += mechanisms.energy.by_account.at(fmt::format("c{}.load", k));
  EXPECT_GT(std::abs(work), 100);
  EXPECT_NEAR(engine.energy.by_account.at("engine"), work, 1e-9 * std::abs(work));
}

// Three cylinders of a two-stroke engine, each a triangle of 60 N·m over 180°: 45 N·m on average, 10 turns.
TEST(EngineTorque, DoesTheWorkOfItsMeanTorque) {
  const Result r = run(fmt::format(R"(
line = ["drive", "engine"]
drive = {{ kind = "prescribed speed", speed = "100 rad/s" }}
[engine]
kind = "engine"
firing_order = [1, 3, 2]
strokes = "two"
torque = {{ over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [60, 60], [180, 0]] }}
inertia = "1 kg*m2"
[run]
until = "{:.17g} s"
accuracy = 1e-10
)",
                                   10 * 2 * pi / 100));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double mean = 3 * 60 * 0.5 * 180 / 360;
  EXPECT_NEAR(r.energy.by_account.at("engine"), mean * 10 * 2 * pi, 1e-9 * mean * 10 * 2 * pi);
}

}  // namespace
}  // namespace kurbel::engine_torque_test
