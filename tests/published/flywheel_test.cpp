// flywheel_test.cpp — turning-moment diagrams, flywheels and punch presses (tests/cases/fl01_flywheel_areas.toml).
#include "studies/size/flywheel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/validation.h"

namespace kurbel::flywheel_test {
namespace {

using test::Against;
using test::Validation;

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr double digits = 5e-9;  // of the case's numbers, relative

double rpm(double n) { return n * pi / 30; }

// Areas between the torque curve and its mean, in order, times the scale of the drawing: the greatest difference of
// their running sums. [area] · [J per area] → J.
double fluctuation_of_areas(const std::vector<double>& areas, double scale) {
  double sum = 0, most = 0, least = 0;
  for (const double area : areas) {
    sum += area;
    most = std::max(most, sum);
    least = std::min(least, sum);
  }
  return (most - least) * scale;
}

// ΔE = ½ I (ω₁² − ω₂²), solved for I and for ω₂.
double inertia_for_range(double energy, double faster, double slower) {
  return 2 * energy / ((faster - slower) * (faster + slower));
}
double speed_after(double inertia, double speed, double energy) {
  return std::sqrt(speed * speed - 2 * energy / inertia);
}

// A turn without corners, cut so that no extreme of 3φ hides in a symmetric piece.
const std::vector<double> turn = {0, 2.0, 4.1, 2 * pi};

TEST(Fl01, Example4FluctuationOfAnEngineByItsAreas) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 4");
  const double energy = fluctuation_of_areas({295, -685, 40, -340, 960, -270}, 5 * degree);
  is.close("fluctuation of energy", "J", energy, 85.957466, 1e-8);
  is.close("speed fluctuation δ", "", energy / (36 * 0.15 * 0.15 * rpm(1800) * rpm(1800)), 0.298673e-2, 1e-6);
}

TEST(Fl01, Example5MassOfAFlywheelByAreas) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 5");
  const double energy = fluctuation_of_areas({52, -124, 92, -140, 85, -72, 107}, 600 * 3 * degree);
  is.close("fluctuation of energy", "J", energy, 5403.539364, 1e-9);
  is.close("mass of the flywheel", "kg", inertia_by_fluctuation(energy, rpm(600), 0.03) / (0.5 * 0.5), 182.497668,
           1e-8);
}

TEST(Fl01, Example6MachineWithARisingLoadOverThreeTurns) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 6");
  const WorkDiagram d =
      with_constant_drive(Piecewise::linear({0, 2 * pi, 3 * pi, 5 * pi, 6 * pi}, {750, 750, 3000, 3000, 750}));
  is.close("mean torque", "N·m", d.mean_torque(), 1875, digits);
  is.close("power", "W", d.mean_torque() * rpm(250), 49.0873852e3, digits);
  is.close("fluctuation of energy", "J", d.fluctuation(), 8835.729338, digits);
  is.close("speed fluctuation δ", "", d.fluctuation() / (500 * 0.36 * rpm(250) * rpm(250)), 0.0716197, 1e-6);
}

TEST(Fl01, Example7TwoTrianglesMeetTheMeanTorqueWhereTheBookSays) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 7");
  const WorkDiagram d = with_constant_load(
      Piecewise::linear({0, 80 * degree, 180 * degree, 260 * degree, 360 * degree}, {0, 2000, 0, 1500, 0}));
  is.close("mean torque", "N·m", d.mean_torque(), 875, digits);
  is.close("fluctuation of energy", "J", d.fluctuation(), 994.019551, digits);
  is.close("coefficient of fluctuation of energy", "", d.energy_coefficient(), 0.1808036, 1e-6);
  is.close("mass of the flywheel", "kg", inertia_by_fluctuation(d.fluctuation(), rpm(100), 0.015) / (1.75 * 1.75),
           197.319649, digits);
  is.near("angle of the least speed", "°", d.least.x / degree, 35, 1e-9);
  is.near("angle of the greatest speed", "°", d.most.x / degree, 136.25, 1e-9);
}

TEST(Fl01, Example8ThreeCylindersShareTheTurn) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 8");
  const std::vector<double> edges = {0,           60 * degree, 120 * degree, 180 * degree, 240 * degree, 300 * degree,
                                     360 * degree};
  const Piecewise torque = Piecewise::of(edges, [](double phi) {
    double sum = 0;
    for (const int k : {0, 1, 2}) {
      const double x = std::fmod(phi / degree + 360 - 120 * k, 360);
      sum += x < 60 ? 1.5 * x : x < 180 ? 0.75 * (180 - x) : 0;
    }
    return sum;
  });
  const WorkDiagram d = with_constant_load(torque);
  const double inertia = 12 * 0.08 * 0.08;
  is.close("power", "W", d.mean_torque() * rpm(600), 4.24115008e3, digits);
  is.close("fluctuation of energy", "J", d.fluctuation(), 11.78097245, digits);
  is.close("speed fluctuation δ", "", d.fluctuation() / (inertia * rpm(600) * rpm(600)), 0.038856187, 2e-8);
  is.close("coefficient of fluctuation of energy", "", d.energy_coefficient(), 0.0277778, 1e-6);
  is.close("greatest angular acceleration", "rad/s²", d.net_torque.maximum().value / inertia, 292.96875, digits);
}

// Expansion stroke triangular; the other strokes take their work, below the mean torque everywhere.
WorkDiagram four_stroke(double expansion, double others) {
  const double top = 2 * expansion / pi, rest = -others / (3 * pi);
  return with_constant_load(Piecewise::linear({0, pi / 2, pi, pi, 4 * pi}, {0, top, 0, rest, rest}));
}

TEST(Fl01, Example9FourStrokeEngineWithTriangularPowerStroke) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 9");
  const WorkDiagram d = four_stroke(12000, 4000);
  is.close("greatest torque", "N·m", d.drive_torque.maximum().value, 7639.437268, digits);
  is.close("mean torque", "N·m", d.mean_torque(), 636.619772, digits);
  is.close("power", "W", d.mean_torque() * rpm(300), 20e3, digits);
  is.close("fluctuation of energy", "J", d.fluctuation(), 10083.333333, digits);
  is.close("inertia of the flywheel", "kg·m²", inertia_by_fluctuation(d.fluctuation(), rpm(300), 0.04), 255.413817,
           digits);
}

TEST(Fl01, Example10FourStrokeEngineByTheAreasOfItsStrokes) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 10");
  const double scale = 3.0e6;
  const WorkDiagram d = four_stroke(6.8e-3 * scale, (0.45e-3 + 1.7e-3 + 0.65e-3) * scale);
  is.close("mass of the flywheel", "kg", inertia_for_range(d.fluctuation(), rpm(202), rpm(198)) / (1.2 * 1.2),
           1386.065409, digits);
}

TEST(Fl01, Example11TorqueOfSecondOrder) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 11");
  const WorkDiagram d = with_constant_load(
      Piecewise::of(turn, [](double x) { return 20000 + 9500 * std::sin(2 * x) - 5700 * std::cos(2 * x); }));
  const double inertia = inertia_by_fluctuation(d.fluctuation(), rpm(180), 0.01);
  is.close("power", "W", d.mean_torque() * rpm(180), 376.991118e3, digits);
  is.close("fluctuation of energy", "J", d.fluctuation(), 11078.808600, digits);
  is.close("inertia of the flywheel", "kg·m²", inertia, 3118.105558, digits);
  is.close("angular acceleration at 45°", "rad/s²", d.net_torque.value(45 * degree) / inertia, 3.0467217, 2e-8);
}

TEST(Fl01, Example12DriveAndLoadBothVary) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 12");
  const auto drive = [](double x) { return 5000 + 600 * std::sin(2 * x); };
  const auto load = [](double x) { return 5000 + 500 * std::sin(x); };
  const std::vector<Piecewise> both =
      Piecewise::sample(turn, 2, [&](double x, std::span<double> out) { out[0] = drive(x), out[1] = load(x); });
  const WorkDiagram d = work_diagram(both[0], both[1]);
  is.close("fluctuation of energy", "J", d.fluctuation(), 1204.166667, 1e-9);
  is.close("speed fluctuation", "%", 100 * d.fluctuation() / (80 * rpm(150) * rpm(150)), 6.1003796, 1e-8);
  const Extreme most = d.net_torque.maximum(), least = d.net_torque.minimum();
  is.close("greatest angular acceleration", "rad/s²", most.value / 80, 12.2029906, 1e-8);
  is.close("greatest angular deceleration", "rad/s²", -least.value / 80, 12.2029906, 1e-8);
  is.near("angle of the greatest acceleration", "°", most.x / degree, 232.3692, 5e-5);
  is.near("angle of the greatest deceleration", "°", least.x / degree, 127.6308, 5e-5);
}

TEST(Fl01, Example13ThirdOrderAgainstAConstantAndAVaryingLoad) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 13");
  const auto sampled = [&](double amplitude) {
    return Piecewise::sample(turn, 2, [=](double x, std::span<double> out) {
      out[0] = 5000 + 1500 * std::sin(3 * x);
      out[1] = 5000 + amplitude * std::sin(x);
    });
  };
  const auto a = sampled(0), b = sampled(600);
  const WorkDiagram constant = work_diagram(a[0], a[1]), varying = work_diagram(b[0], b[1]);
  const double stiffness = 1000 * rpm(300) * rpm(300);
  is.close("power", "W", constant.mean_torque() * rpm(300), 157.0796327e3, digits);
  is.close("constant load: fluctuation of energy", "J", constant.fluctuation(), 1000, 1e-12);
  is.close("constant load: speed fluctuation", "%", 100 * constant.fluctuation() / stiffness, 0.10132118, 5e-8);
  is.close("varying load: fluctuation of energy", "J", varying.fluctuation(), 1656.502339, digits);
  is.close("varying load: speed fluctuation", "%", 100 * varying.fluctuation() / stiffness, 0.16783878, 5e-8);
  // 1500 sin 3φ = 600 sin φ where sin²φ = 0.65: 53.728802°; the case's 53.72874° is off in its last two digits.
  const double meet = std::asin(std::sqrt(0.65)) / degree;
  EXPECT_NEAR(varying.least.x / degree, 180 - meet, 1e-10);  // the first of two, as of the maxima
  EXPECT_NEAR(varying.most.x / degree, meet, 1e-10);
  EXPECT_NEAR(meet, 53.72874, 1e-4);
}

TEST(Fl01, Example19PunchByTimeAndSpeedRange) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 19");
  const PunchPress press{.energy = 15e3, .cycle_time = 5, .working_time = 2};
  is.close("power", "W", press.power(), 3000, digits);
  is.close("mass of the flywheel", "kg", inertia_for_range(press.from_flywheel(), rpm(225), rpm(200)) / (0.5 * 0.5),
           617.940019, digits);
}

TEST(Fl01, Example20PunchByStroke) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 20");
  const double area = pi * 38 * 32;  // sheared [mm²]
  const PunchPress press{.energy = 7 * area, .cycle_time = 10, .working_time = 10 * 32.0 / (2 * 100)};
  is.close("power", "W", press.power(), 2674.123667, digits);
  // I ω² δ = m v² δ at the rim.
  is.close("mass of the flywheel", "kg", press.from_flywheel() / (25 * 25 * 0.03), 1198.007403, digits);
}

TEST(Fl01, Example21RivetingSlowsTheFlywheel) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 21");
  const double motor = 3000, energy = 10e3, inertia = 150 * 0.36;
  is.close("speed after a rivet", "rpm", speed_after(inertia, rpm(300), energy - motor * 1.0) * 30 / pi, 257.601224,
           digits);
  is.near("rivets a minute", "", motor * 60 / energy, 18, 1e-12);
}

TEST(Fl01, Example22PunchingThirtyHolesAMinute) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 22");
  const PunchPress press{.energy = 6 * pi * 40 * 15, .cycle_time = 2, .working_time = 0.1};
  is.close("power", "W", press.power(), 5654.866776, digits);
  is.close("mass of the flywheel", "kg", inertia_for_range(press.from_flywheel(), rpm(160), rpm(140)), 326.585943,
           digits);
}

TEST(Fl01, Example23PunchingForceOfTheSheet) {
  const Validation is(Against::published,
                      "Khurmi, Gupta: Theory of Machines, ch. 16 (turning moment diagrams and flywheel), ex. 23");
  const double force = pi * 25e-3 * 18e-3 * 300e6;
  const PunchPress press{.energy = 0.5 * force * 18e-3, .cycle_time = 60.0 / 25, .working_time = 0.1 * 60.0 / 25};
  is.close("power", "kW", press.power() / 0.95 / 1e3, 1.674138190, digits);
  is.close("energy from the flywheel", "J", press.from_flywheel(), 3435.331567, digits);
}

}  // namespace
}  // namespace kurbel::flywheel_test
