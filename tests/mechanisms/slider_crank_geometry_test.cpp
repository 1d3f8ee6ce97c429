// slider_crank_geometry_test.cpp — the closed form against dual numbers, energy and published slider-cranks.
#include "tests/mechanisms/slider_crank_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/mechanisms/mechanism_examples.h"

namespace kurbel::slider_crank_geometry_test {
namespace {

constexpr double pi = std::numbers::pi;

// a + a′ ε in long double: differentiates without using the formulas under test.
struct Dual {
  Dual(long double value = 0, long double slope = 0) : value(value), slope(slope) {}
  long double value, slope;
  friend Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator-(Dual a) { return {-a.value, -a.slope}; }
  friend Dual operator*(Dual a, Dual b) { return {a.value * b.value, a.slope * b.value + a.value * b.slope}; }
  friend Dual operator/(Dual a, Dual b) {
    return {a.value / b.value, (a.slope - a.value / b.value * b.slope) / b.value};
  }
  friend bool operator<(Dual a, Dual b) { return a.value < b.value; }
  friend bool operator>(Dual a, Dual b) { return a.value > b.value; }
  friend Dual sin(Dual a) { return {std::sin(a.value), std::cos(a.value) * a.slope}; }
  friend Dual cos(Dual a) { return {std::cos(a.value), -std::sin(a.value) * a.slope}; }
  friend Dual sqrt(Dual a) { return {std::sqrt(a.value), a.slope / (2 * std::sqrt(a.value))}; }
  friend Dual atan2(Dual y, Dual x) {
    return {std::atan2(y.value, x.value),
            (y.slope * x.value - y.value * x.slope) / (x.value * x.value + y.value * y.value)};
  }
};

void expect_close(long double got, long double expected, double tolerance, const char* what) {
  EXPECT_LE(std::fabs(got - expected), tolerance)
      << what << ": " << static_cast<double>(got) << " for " << static_cast<double>(expected);
}

TEST(SliderCrankGeometry, RodJoinsPinAndSlider) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const SliderCrankData d = random_mechanism(random);
    const SliderCrankGeometry geometry(d);
    const long double phi = random_angle(random), beta = geometry.rod(phi).value;
    expect_close(d.radius * std::cos(phi) + d.rod_length * std::cos(beta), geometry.slider(phi).value, 1e-17, "x");
    expect_close(d.radius * std::sin(phi) + d.rod_length * std::sin(beta), d.offset, 1e-17, "y");
    EXPECT_GT(std::cos(beta), 0);
  }
}

TEST(SliderCrankGeometry, SlopesAndCurvaturesAreDerivatives) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const SliderCrankGeometry geometry(random_mechanism(random));
    const Maxima maximum(geometry);
    const long double angle = random_angle(random);
    const Dual phi(angle, 1);
    const double* m = maximum.value;
    expect_close(geometry.slider(angle).slope, geometry.slider(phi).value.slope, 1e-15 * m[4], "x'");
    expect_close(geometry.slider(angle).curvature, geometry.slider(phi).slope.slope, 1e-15 * m[5], "x''");
    expect_close(geometry.rod(angle).slope, geometry.rod(phi).value.slope, 1e-16, "beta'");
    expect_close(geometry.rod(angle).curvature, geometry.rod(phi).slope.slope, 1e-13, "beta''");
    expect_close(geometry.inertia(angle).slope, geometry.inertia(phi).value.slope, 1e-15 * m[1], "I'");
    expect_close(geometry.inertia(angle).curvature, geometry.inertia(phi).slope.slope, 1e-15 * m[2], "I''");
    expect_close(geometry.gravity_torque(angle).value, -geometry.potential_energy(phi).slope, 1e-15 * m[6], "M");
    expect_close(geometry.gravity_torque(angle).slope, geometry.gravity_torque(phi).value.slope, 1e-15 * m[7], "M'");
  }
}

// T = ½ Σ (m v² + I ω²) at ω = 1, every velocity differentiated from a position.
TEST(SliderCrankGeometry, ReducedInertiaHoldsTheKineticEnergy) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const SliderCrankData d = random_mechanism(random);
    const SliderCrankGeometry geometry(d);
    const Dual phi(random_angle(random), 1), beta = geometry.rod(phi).value;
    const Dual rod_x = d.radius * cos(phi) + d.rod_com * cos(beta), rod_y = d.radius * sin(phi) + d.rod_com * sin(beta);
    const Dual slider_x = d.radius * cos(phi) + d.rod_length * cos(beta);
    const long double twice_energy =
        d.crank_inertia + d.rod_mass * (rod_x.slope * rod_x.slope + rod_y.slope * rod_y.slope) +
        d.rod_inertia * beta.slope * beta.slope + d.slider_mass * slider_x.slope * slider_x.slope;
    expect_close(geometry.inertia(phi.value).value, twice_energy, 1e-15 * Maxima(geometry).value[0], "I");
  }
}

TEST(SliderCrankGeometry, StrokeEndsLieAtTheDeadCentres) {
  for (const double offset : {0.0, 0.04, -0.07}) {
    const SliderCrankGeometry geometry(full_mechanism(1.7, offset));
    EXPECT_NEAR(geometry.slider(geometry.extended_angle()).value, geometry.x_max(), 1e-15);
    EXPECT_NEAR(geometry.slider(geometry.folded_angle()).value, geometry.x_min(), 1e-15);
    EXPECT_NEAR(geometry.slider(geometry.extended_angle()).slope, 0, 1e-15);
    EXPECT_NEAR(geometry.slider(geometry.folded_angle()).slope, 0, 1e-15);
    EXPECT_LT(geometry.slider(geometry.extended_angle()).curvature, 0);
    EXPECT_GT(geometry.slider(geometry.folded_angle()).curvature, 0);
  }
  const SliderCrankGeometry in_line(reference_mechanism());
  EXPECT_EQ(in_line.extended_angle(), 0);
  EXPECT_DOUBLE_EQ(in_line.folded_angle(), pi);
  EXPECT_DOUBLE_EQ(in_line.x_max(), 0.45);
  EXPECT_DOUBLE_EQ(in_line.x_min(), 0.25);
}

TEST(SliderCrankGeometry, DoubleKeepsItsDigitsNearTheDeadPosition) {
  std::mt19937 random(4);
  for (const double ratio : {1.0001, 1.001, 1.05, 3.5})
    for (const double offset : {0.0, 0.03}) {
      const SliderCrankGeometry geometry(full_mechanism(ratio, offset));
      const Maxima maximum(geometry);
      for (int i = 0; i < 1000; ++i) {
        const double phi = random_angle(random);
        const Truth truth(geometry, phi);
        const auto inertia = geometry.inertia(phi);
        expect_close(inertia.value, truth.value[0], 1e-15 * maximum.value[0], "I");
        expect_close(inertia.slope, truth.value[1], 2e-15 * maximum.value[1], "I'");
        expect_close(inertia.curvature, truth.value[2], 3e-15 * maximum.value[2], "I''");
      }
    }
}

// l → ∞: harmonic motion x′ = −r sin φ, and I_r = J + m r² + m_slider r² (sin²φ), the rod moved on a circle, unturned,
// with its mass at its pin (rod_com = 0).
TEST(SliderCrankGeometry, LongRodGivesHarmonicMotion) {
  SliderCrankData d = reference_mechanism();
  d.rod_length = 1e7 * d.radius;
  d.rod_com = 0;
  const SliderCrankGeometry geometry(d);
  for (double phi = 0; phi < 6.3; phi += 0.1) {
    const double r = d.radius, sine = std::sin(phi);
    EXPECT_NEAR(geometry.slider(phi).slope, -r * sine, 1e-7 * r);
    EXPECT_NEAR(geometry.slider(phi).curvature, -r * std::cos(phi), 2e-7 * r);
    EXPECT_NEAR(geometry.inertia(phi).value, 0.55 + 2 * r * r + 3 * r * r * sine * sine, 1e-7);
    EXPECT_NEAR(geometry.inertia(phi).slope, 3 * r * r * std::sin(2 * phi), 1e-7);
    EXPECT_NEAR(geometry.inertia(phi).curvature, 6 * r * r * std::cos(2 * phi), 1e-6);
  }
}

// Range of the reduced inertia and conservation of energy over 47 turns, from long-double integration by two methods.
TEST(SliderCrankGeometry, ReferenceMachineKeepsItsEnergy) {
  const SliderCrankGeometry geometry(reference_mechanism());
  double least = 1, most = 0;
  for (int i = 0; i < 100000; ++i) {
    const double inertia = geometry.inertia(2 * pi * i / 100000).value;
    least = std::min(least, inertia), most = std::max(most, inertia);
  }
  EXPECT_NEAR(least, 0.5600826531, 1e-10);
  EXPECT_NEAR(most, 0.6028418696, 1e-10);
  EXPECT_NEAR(geometry.inertia(0.0).value * 30 * 30 / 2, 252.037193877551, 1e-12);
  const double phi = 294.719373652657, omega = 29.5167074225067;
  EXPECT_NEAR(geometry.inertia(phi).value * omega * omega / 2, 252.037193877551, 1e-11);
}

// Run-up under a constant 0.1 N·m, M θ = ½ I_r(θ) ω². Mechanism: EXUDYN (J. Gerstmayr), sliderCrankFloatingTest; θ and
// ω recomputed by an ODE of one degree of freedom.
TEST(SliderCrankGeometry, ConstantTorqueTurnsIntoKineticEnergy) {
  SliderCrankData d;
  d.radius = 0.1, d.rod_length = 0.3;
  d.crank_mass = 0.2, d.crank_com = 0.05, d.crank_inertia = 0.2 * 0.1 * 0.1 / 3;
  d.rod_mass = 0.2, d.rod_com = 0.15, d.rod_inertia = 0.2 * 0.3 * 0.3 / 12;
  d.slider_mass = 0.4;
  const SliderCrankGeometry geometry(d);
  const double torque = 0.1;
  EXPECT_NEAR(torque / geometry.inertia(0.0).value, 75.0, 1e-12);  // acceleration at the start
  const double published[][2] = {{0.8739419278, 5.440358458}, {3.123834129, 21.64015143}, {14.12789222, 20.53748285},
                                 {31.23885114, 62.16994275},  {55.0724438, 39.79557704},  {85.43171058, 86.47829981},
                                 {121.88627751, 101.36564506}};
  for (const auto& [theta, omega] : published) {
    const double energy = geometry.inertia(theta).value * omega * omega / 2;
    EXPECT_NEAR(energy / (torque * theta), 1, 3e-8) << "theta = " << theta;  // ten digits were printed
  }
}

// Rigid limit of the slider crank of the IVP test set (B. Simeon): Ω = 150, a = −(r Ω² + l (Ω/2)²) at φ = 0.
TEST(SliderCrankGeometry, SimeonsSliderAcceleration) {
  SliderCrankData d;
  d.radius = 0.15, d.rod_length = 0.30;
  d.crank_inertia = 0.002727;
  d.rod_mass = 0.151104, d.rod_com = 0.15, d.rod_inertia = 0.0045339259 - 0.151104 * 0.15 * 0.15;
  d.slider_mass = 0.075552;
  const double omega = 150;
  const double acceleration = SliderCrankGeometry(d).slider(0.0).curvature * omega * omega;
  EXPECT_NEAR(acceleration, -5062.5, 1e-9);
  EXPECT_NEAR(-d.slider_mass * acceleration, 382.4820, 1e-9);
}

// Free engine under gravity, slider on top: ½ I_r ω² + V is kept. Data: Modelica Standard Library, Engine1a; the state
// at 5 s recomputed with one degree of freedom.
TEST(SliderCrankGeometry, EngineUnderGravityKeepsItsEnergy) {
  SliderCrankData d;
  d.radius = 0.1, d.rod_length = 0.2;
  d.crank_mass = 1, d.crank_com = 0.1314280927234432, d.crank_inertia = 1.0114306736259937;
  d.rod_mass = 1.848, d.rod_com = 0.1, d.rod_inertia = 0.0067144;
  d.slider_mass = 6.047565858160353;
  d.gravity = 9.80665;
  d.stroke_angle = pi / 2;
  const SliderCrankGeometry geometry(d);
  const auto energy = [&](double phi, double omega) {
    return geometry.inertia(phi).value * omega * omega / 2 + geometry.potential_energy(phi);
  };
  EXPECT_NEAR(energy(53.4150446, 11.64032783) / energy(0, 10), 1, 1e-8);
  EXPECT_NEAR(geometry.potential_energy(0.0) - geometry.potential_energy(pi),
              9.80665 * 2 * (0.1314280927234432 + 1.848 * 0.1 + 6.047565858160353 * 0.1), 1e-13);
}

TEST(SliderCrankGeometry, RefusesWhatCannotMove) {
  SliderCrankData d = reference_mechanism();
  d.offset = -0.45;  // the rod is hardly as long as the crank's pin comes near
  try {
    SliderCrankGeometry geometry(d);
    FAIL() << "accepted a rod too short";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find("slider-crank: rod = 350 mm; must be > |offset| - radius = 350 mm"), 0u);
  }
  d = reference_mechanism();
  d.crank_mass = 100, d.crank_com = 0.1;  // needs 1 kg·m² about the axis
  EXPECT_THROW(SliderCrankGeometry{d}, std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::slider_crank_geometry_test
