// slider_crank_simbody_test.cpp — what Simbody's bodies say against the closed form, over random slider-cranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "mechanisms/reduced/mechanism_data.h"
#include "tests/mechanisms/mechanism_examples.h"
#include "tests/mechanisms/slider_crank_geometry.h"

namespace kurbel::slider_crank_simbody_test {
namespace {

// Some channel vanishes when masses do; rounding is then measured by the terms that cancel.
double gravity_scale(const SliderCrankData& d) {
  return d.gravity * (d.crank_mass * std::fabs(d.crank_com) + (d.rod_mass + d.slider_mass) * d.radius);
}
double inertia_scale(const SliderCrankData& d) {
  return d.crank_inertia + (d.rod_mass + d.slider_mass) * d.radius * d.radius;
}

TEST(SliderCrankBodies, SamplesAgreeWithTheClosedForm) {
  std::mt19937 random(5);
  for (int mechanism = 0; mechanism < 100; ++mechanism) {
    const SliderCrankData d = random_mechanism(random);
    const SliderCrankGeometry geometry(d);
    const auto bodies = make_bodies(d);
    const Maxima maximum(geometry);
    for (int i = 0; i < 20; ++i) {
      const double phi = random_angle(random);
      const ReducedSample s = bodies->sample(phi);
      const double got[channels] = {s.inertia,         s.inertia_slope,         s.inertia_curvature,
                                    s.output_position, s.output_velocity_ratio, s.output_acceleration_ratio,
                                    s.gravity_torque,  s.gravity_torque_slope};
      const Truth truth(geometry, phi);
      for (int c = 0; c < channels; ++c) {
        const double floor = c < 3 ? 1e-2 * inertia_scale(d) : c > 5 ? gravity_scale(d) : 0;
        EXPECT_LE(std::fabs(got[c] - truth.value[c]), 5e-14 * std::max(maximum.value[c], floor))
            << "mechanism " << mechanism << " channel " << c << " phi = " << phi
            << " l/(r + |e|) = " << d.rod_length / (d.radius + std::fabs(d.offset));
      }
      const auto rod = geometry.rod(static_cast<long double>(phi));
      EXPECT_NEAR(static_cast<double>(linkage_of(d, phi).bodies[1].direction.rate().value() - rod.slope), 0,
                  1e-15 * std::max(1.0, std::fabs(static_cast<double>(rod.slope))));
      EXPECT_NEAR(s.closure_determinant / d.rod_length, static_cast<double>(std::cos(rod.value)), 1e-13);
    }
  }
}

// ½ I_r ω² from the closed form, Σ ½ (m v² + I ω²) from Simbody's bodies->
TEST(SliderCrankBodies, EnergiesAgreeWithTheClosedForm) {
  std::mt19937 random(6);
  for (int mechanism = 0; mechanism < 50; ++mechanism) {
    const SliderCrankData d = random_mechanism(random);
    const SliderCrankGeometry geometry(d);
    const auto bodies = make_bodies(d);
    const double inertia_maximum = Maxima(geometry).value[0];
    for (int i = 0; i < 10; ++i) {
      const double phi = random_angle(random), omega = 17;
      EXPECT_NEAR(bodies->kinetic_energy(phi, omega), geometry.inertia(phi).value * omega * omega / 2,
                  2e-14 * inertia_maximum * omega * omega);
      EXPECT_NEAR(bodies->potential_energy(phi), geometry.potential_energy(phi),
                  1e-13 * d.gravity * (d.crank_mass + d.rod_mass + d.slider_mass) * (d.radius + d.rod_length));
    }
  }
}

TEST(SliderCrankBodies, CounterweightDrivesBackwards) {
  SliderCrankData d = reference_mechanism();
  d.rod_mass = d.slider_mass = d.rod_inertia = 0;
  d.gravity = 10;
  d.crank_mass = 2;
  d.crank_com = 0.05;  // horizontal arm to the right of the axis: its weight turns the crank clockwise
  EXPECT_NEAR(make_bodies(d)->sample(0).gravity_torque, -1.0, 1e-15);
  d.crank_com = -0.05;
  EXPECT_NEAR(make_bodies(d)->sample(0).gravity_torque, 1.0, 1e-15);
  d.stroke_angle = std::numbers::pi / 2;  // stroke upwards: at φ = 0 the arm stands upright
  EXPECT_NEAR(make_bodies(d)->sample(0).gravity_torque, 0.0, 1e-15);
  EXPECT_NEAR(make_bodies(d)->sample(0).gravity_torque_slope, -1.0, 1e-15);
}

TEST(SliderCrankBodies, MasslessLinksLeaveTheCrankAlone) {
  SliderCrankData d = reference_mechanism();
  d.rod_mass = d.slider_mass = d.rod_inertia = 0;
  const ReducedSample s = make_bodies(d)->sample(1.1);
  EXPECT_DOUBLE_EQ(s.inertia, 0.55);
  EXPECT_EQ(s.inertia_slope, 0);
  EXPECT_EQ(s.inertia_curvature, 0);
}

TEST(SliderCrankBodies, FarAnglesAreTheSameMechanism) {
  const auto bodies = make_bodies(full_mechanism(1.5, 0.02));
  const double turns = 1000 * 2 * std::numbers::pi;
  EXPECT_NEAR(bodies->sample(1 + turns).inertia, bodies->sample(1).inertia, 1e-12);
  EXPECT_NEAR(bodies->sample(1 - turns).output_position, bodies->sample(1).output_position, 1e-12);
}

TEST(SliderCrankBodies, WrongBranchIsRefusedWithItsNumbers) {
  const auto bodies = make_bodies(reference_mechanism());
  try {
    bodies->sample_from(1.0, {3.0 - 1.0});  // the rod started towards −x closes the loop just as well
    FAIL() << "took the wrong branch";
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("slider-crank on the wrong branch at phi = 1 rad: determinant of its closures = -0.339734"),
              std::string::npos)
        << text;
  }
  EXPECT_GT(bodies->sample_from(1.0, {0.9 - 1.0}).closure_determinant,
            0);  // a poor start on the right side still arrives
}

TEST(SliderCrankBodies, InertiaNeedsMass) {
  SliderCrankData d = reference_mechanism();
  d.rod_mass = d.slider_mass = 0;
  EXPECT_THROW(make_bodies(d), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::slider_crank_simbody_test
