// linkages_test.cpp — four-bar, quick-return and knuckle press: extraction against their loop equations.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanisms/reduced/mechanism.h"
#include "tests/mechanisms/linkage_truth.h"
#include "tests/mechanisms/slider_crank_geometry.h"

namespace kurbel::linkages_test {
namespace {

using std::numbers::pi;
using test::LinkageTruth;
using test::RandomLinkage;

constexpr int channels = 8;

// Largest magnitude of each channel over the turn. Inertia and torque channels that vanish where the terms of their
// sums cancel are measured by those terms.
template <class Data>
std::vector<double> scales_of(const Data& data, MechanismBodies& bodies) {
  std::vector<double> scale(channels, 0.0);
  for (int i = 0; i < 360; ++i) {
    const double phi = 2 * pi * i / 360;
    const LinkageTruth truth = test::truth_of(data, phi);
    for (int c = 0; c < channels; ++c) scale[c] = std::max(scale[c], static_cast<double>(std::fabs(truth.value[c])));
    const ReducedSample sample = bodies.sample(phi);
    scale[6] = std::max(scale[6], sample.gravity_torque_scale);
  }
  for (int c = 1; c < 3; ++c) scale[c] = std::max(scale[c], 0.01 * scale[0]);
  scale[7] = std::max(scale[7], scale[6]);
  return scale;
}

template <class Data>
void expect_loop_equations(const Data& data, double phi, MechanismBodies& bodies, const ReducedMechanism& table,
                           const std::vector<double>& scale, double of_samples, double of_table) {
  const LinkageTruth truth = test::truth_of(data, phi);
  const ReducedSample s = bodies.sample(phi);
  const double got[channels] = {s.inertia,         s.inertia_slope,         s.inertia_curvature,
                                s.output_position, s.output_velocity_ratio, s.output_acceleration_ratio,
                                s.gravity_torque,  s.gravity_torque_slope};
  const auto at = table.at(phi);
  for (int c = 0; c < channels; ++c) {
    const auto exact = static_cast<double>(truth.value[c]);
    EXPECT_NEAR(got[c], exact, of_samples * scale[c]) << "sample, channel " << c << " phi = " << phi;
    EXPECT_NEAR(at.value(static_cast<ReducedMechanism::Channel>(c)), exact, of_table * scale[c])
        << "table, channel " << c << " phi = " << phi;
  }
  EXPECT_GT(s.closure_determinant, 0);
  // ½ I_r ω² against the sum over Simbody's bodies, and the weights' potential energy.
  const double omega = 13;
  EXPECT_NEAR(bodies.kinetic_energy(phi, omega), static_cast<double>(truth.value[0]) * omega * omega / 2,
              of_samples * scale[0] * omega * omega);
  EXPECT_NEAR(bodies.potential_energy(phi), static_cast<double>(truth.potential_energy),
              of_samples * std::max(1.0, std::fabs(static_cast<double>(truth.potential_energy))));
}

// Twelve positions and twelve random ones.
template <class Data>
void expect_loop_equations(const Data& data, RandomLinkage& random) {
  const auto bodies = make_bodies(data);
  const std::vector<double> scale = scales_of(data, *bodies);
  for (const Extraction from : {Extraction::first, Extraction::second}) {
    const ReducedMechanism table = extract_mechanism(data, table_tolerance, table_max_pieces, from);
    EXPECT_TRUE(table.report().converged);
    for (int i = 0; i < 12; ++i) {
      expect_loop_equations(data, 2 * pi * i / 12, *bodies, table, scale, 1e-12, 2e-12);
      expect_loop_equations(data, random.uniform(0, 2 * pi), *bodies, table, scale, 1e-12, 2e-12);
    }
  }
}

TEST(FourBar, ExtractionAgreesWithFreudensteinsEquation) {
  RandomLinkage random(31);
  for (int i = 0; i < 25; ++i) {
    SCOPED_TRACE(i);
    expect_loop_equations(random.four_bar(), random);
  }
}

TEST(QuickReturn, ExtractionAgreesWithItsTriangles) {
  RandomLinkage random(32);
  int shapers = 0;
  for (int i = 0; i < 25; ++i) {
    SCOPED_TRACE(i);
    const QuickReturnData data = random.quick_return();
    shapers += !data.lever_turns_fully();
    expect_loop_equations(data, random);
  }
  EXPECT_GT(shapers, 5);  // both forms were among them
  EXPECT_LT(shapers, 20);
}

TEST(KnucklePress, ExtractionAgreesWithItsTwoLoops) {
  RandomLinkage random(33);
  for (int i = 0; i < 25; ++i) {
    SCOPED_TRACE(i);
    expect_loop_equations(random.knuckle_press(), random);
  }
}

// --- four-bar ---

FourBarData crank_rocker() {
  FourBarData d;
  d.crank = 0.06, d.coupler = 0.2, d.rocker = 0.15, d.ground = 0.22;
  d.crank_body.inertia = 0.05;
  d.coupler_body = {1, 0.1, 0.004};
  d.rocker_body = {2, 0.08, 0.02};
  return d;
}

// Travel between crank and coupler in line, extended and folded: two triangles with the sides coupler ± crank.
TEST(FourBar, SwingOfTheRockerMatchesItsDeadCentreTriangles) {
  const FourBarData d = crank_rocker();
  const Mechanism m("rocker", d);
  const auto angle = [&](double side) {
    return pi - std::acos((d.ground * d.ground + d.rocker * d.rocker - side * side) / (2 * d.ground * d.rocker));
  };
  EXPECT_NEAR(m.travel.greatest, angle(d.coupler - d.crank), 2e-12);
  EXPECT_NEAR(m.travel.least, angle(d.coupler + d.crank), 2e-12);
  EXPECT_EQ(m.travel.reversals.size(), 2u);
}

TEST(FourBar, CrossedIsTheMirrorImageOfOpen) {
  RandomLinkage random(34);
  for (int i = 0; i < 10; ++i) {
    FourBarData d = random.four_bar();
    d.gravity = 0;
    d.crossed = false;
    const auto open = make_bodies(d);
    d.crossed = true;
    const auto crossed = make_bodies(d);
    const double phi = random.uniform(0, 2 * pi);
    const ReducedSample a = open->sample(phi), b = crossed->sample(-phi);
    EXPECT_NEAR(b.output_position, -a.output_position, 1e-13);
    EXPECT_NEAR(b.output_velocity_ratio, a.output_velocity_ratio, 1e-12);
    EXPECT_NEAR(b.inertia, a.inertia, 1e-12 * a.inertia);
    EXPECT_GT(a.output_position, 0);
    EXPECT_LT(a.output_position, pi);
  }
}

// Coupler = ground and rocker → crank: the parallelogram, in which the rocker goes with the crank.
TEST(FourBar, NearTheParallelogramTheRockerFollowsTheCrank) {
  double last = 1;
  for (const double excess : {1e-2, 1e-3, 1e-4}) {
    FourBarData d = crank_rocker();
    d.coupler = d.ground = 0.3;
    d.rocker = d.crank * (1 + excess);
    const auto bodies = make_bodies(d);
    double largest = 0;
    for (double phi = 0.5; phi < pi - 0.5; phi += 0.1) {
      const ReducedSample s = bodies->sample(phi);
      largest = std::max({largest, std::fabs(s.output_position - phi), std::fabs(s.output_velocity_ratio - 1)});
    }
    EXPECT_LT(largest, 10 * excess);
    EXPECT_NEAR(last / largest, 10, last == 1 ? 1e9 : 1.0);  // first order in the excess
    last = largest;
  }
}

TEST(FourBar, WrongBranchIsRefused) {
  FourBarData d = crank_rocker();
  const auto open = make_bodies(d);
  const auto right = open->sample(1.0);
  d.crossed = true;
  const auto crossed = make_bodies(d)->sample(1.0);
  EXPECT_GT(right.output_position, 0);
  EXPECT_LT(crossed.output_position, 0);
  EXPECT_THROW(open->sample_from(1.0, {-1.0 - 1.0, crossed.output_position}), std::runtime_error);
  EXPECT_NEAR(open->sample_from(1.0, {0.4 - 1.0, right.output_position + 0.1}).output_position, right.output_position,
              1e-14);
}

// coupler + rocker = 350 mm: a ground of 300 mm lets a crank of 60 mm rock, one of 420 mm keeps the loop open.
TEST(FourBar, LoopThatCannotBeClosedIsRefused) {
  FourBarData d = crank_rocker();
  d.ground = 0.30;
  EXPECT_TRUE(faults_of(d).empty());
  ASSERT_TRUE(d.loop().arc());
  EXPECT_NEAR(d.loop().arc()->half, std::acos((0.0036 + 0.09 - 0.1225) / (2 * 0.06 * 0.3)), 1e-14);
  d.ground = 0.42;
  const DataFaults faults = faults_of(d);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].key, "ground");
  EXPECT_NE(faults[0].text.find("ground = 420 mm; must be < 410 mm"), std::string::npos) << faults[0].text;
  EXPECT_THROW(make_bodies(d), std::invalid_argument);
  d.ground = 0.3 * (1 + 1e-8), d.coupler = 0.16, d.rocker = 0.2;  // neither a change point nor clear of one
  ASSERT_FALSE(faults_of(d).empty());
  d.ground = 0.04, d.coupler = 0.16;  // a drag link: the rocker turns, too
  EXPECT_TRUE(faults_of(d).empty());
  d.coupler = d.ground = 0.3, d.rocker = d.crank * (1 + 2e-12);  // hardly not a parallelogram
  ASSERT_FALSE(faults_of(d).empty());
  EXPECT_NE(faults_of(d)[0].text.find("one line so nearly"), std::string::npos) << faults_of(d)[0].text;
}

// --- quick-return ---

QuickReturnData shaper() {
  QuickReturnData d;
  d.radius = 0.1, d.pivot_distance = 0.25, d.lever = 0.5, d.link = 0.25, d.guide_height = 0.48;
  d.crank_body.inertia = 2;
  d.lever_body = {10, 0.24, 0.9};
  d.block_mass = 1, d.block_inertia = 0.001;
  d.link_body = {4, 0.125, 0.03};
  d.ram_mass = 60;
  return d;
}

double time_ratio(const Mechanism& m) {
  EXPECT_EQ(m.travel.reversals.size(), 2u);
  const double part = m.travel.reversals[1] - m.travel.reversals[0], rest = 2 * pi - part;
  return std::max(part, rest) / std::min(part, rest);
}

// Lever tangent to the crank circle at both ends: (π + 2γ)/(π − 2γ), sin γ = r/d.
TEST(QuickReturn, TimeRatioOfTheShaper) {
  for (const double distance : {0.12, 0.2, 0.25, 0.6}) {
    QuickReturnData d = shaper();
    d.pivot_distance = distance;
    d.link = 0.7;
    const double gamma = std::asin(d.radius / distance);
    EXPECT_NEAR(time_ratio(Mechanism("shaper", d)) / ((pi + 2 * gamma) / (pi - 2 * gamma)), 1, 1e-11) << distance;
  }
  QuickReturnData third = shaper();  // r/d = ½: γ = 30°, ratio 2 : 1
  third.pivot_distance = 0.2;
  EXPECT_NEAR(time_ratio(Mechanism("shaper", third)), 2, 1e-11);
}

// Lever along the guide through its bearing at both ends: (π + 2γ)/(π − 2γ), sin γ = d/r.
TEST(QuickReturn, TimeRatioOfWhitworthsForm) {
  QuickReturnData d = shaper();
  d.pivot_distance = 0.05;
  d.lever = 0.15, d.lever_angle = pi, d.link = 0.6, d.guide_height = 0;
  const Mechanism m("whitworth", d);
  EXPECT_NEAR(time_ratio(m), 2, 1e-11);  // γ = 30°
  EXPECT_NEAR(m.stroke(), 2 * d.lever, 1e-12);
}

// Stroke of the shaper: 2 L r/d for the lever's end, and the ram has it too when both ends stand equally high.
TEST(QuickReturn, StrokeOfTheShaper) {
  const QuickReturnData d = shaper();
  EXPECT_NEAR(Mechanism("shaper", d).stroke(), 2 * d.lever * d.radius / d.pivot_distance, 1e-12);
}

// Pivot on the crank axis: the lever turns with the crank, and what is left is a slider-crank of radius L.
TEST(QuickReturn, PivotOnTheCrankAxisLeavesASliderCrank) {
  double last = 1;
  for (const double distance : {1e-3, 1e-4, 1e-5}) {
    QuickReturnData d = shaper();
    d.radius = 1, d.pivot_distance = distance;
    d.lever = 0.15, d.lever_angle = 0.7, d.link = 0.6, d.guide_height = 0.05;
    SliderCrankData s;
    s.radius = d.lever, s.rod_length = d.link, s.offset = d.guide_height, s.crank_inertia = 1;
    const SliderCrankGeometry geometry(s);
    const auto bodies = make_bodies(d);
    double largest = 0;
    for (double phi = 0; phi < 6.2; phi += 0.3) {
      const auto exact = geometry.slider(phi + d.lever_angle);
      const ReducedSample got = bodies->sample(phi);
      largest = std::max({largest, std::fabs(got.output_position - exact.value),
                          std::fabs(got.output_velocity_ratio - exact.slope),
                          std::fabs(got.output_acceleration_ratio - exact.curvature)});
    }
    EXPECT_LT(largest, distance);
    EXPECT_NEAR(last / largest, 10, last == 1 ? 1e9 : 0.1);  // first order in the distance
    last = largest;
  }
}

TEST(QuickReturn, LinkPointsWhereItIsReported) {
  QuickReturnData d = shaper();
  const auto ahead = MechanismData(d).places(1.0);
  d.backward = true;
  const auto behind = MechanismData(d).places(1.0);
  EXPECT_GT(ahead[4].x, ahead[3].x);
  EXPECT_LT(behind[4].x, behind[3].x);
  EXPECT_NEAR(ahead[4].x - ahead[3].x, behind[3].x - behind[4].x, 1e-14);
}

TEST(QuickReturn, ShortLinkAndPinOverTheBearingAreRefused) {
  QuickReturnData d = shaper();
  d.link = 0.02;  // the lever's end lies 480 … 500 mm up at its ends 458 mm: 21.7 mm from the guide
  ASSERT_EQ(faults_of(d).size(), 1u);
  EXPECT_EQ(faults_of(d)[0].key, "link");
  EXPECT_NE(faults_of(d)[0].text.find("must be > 21.7424 mm"), std::string::npos) << faults_of(d)[0].text;
  d = shaper();
  d.pivot_distance = d.radius;
  ASSERT_EQ(faults_of(d).size(), 1u);
  EXPECT_EQ(faults_of(d)[0].key, "pivot_distance");
  EXPECT_THROW(make_bodies(d), std::invalid_argument);
}

// --- knuckle press ---

// The crank carries the knee across the line of the two links.
KnucklePressData toggle() {
  KnucklePressData d;
  d.radius = 0.04, d.rod = 0.36;
  d.bearing_x = -0.35, d.bearing_y = 0.38;
  d.upper = d.lower = 0.35, d.guide = 0.38;
  d.knee_right = true;
  d.crank_body.inertia = 3;
  d.rod_body = {30, 0.18, 0.5};
  d.upper_body = {20, 0.17, 0.9};
  d.lower_body = {20, 0.18, 0.3};
  d.ram_mass = 400;
  return d;
}

TEST(KnucklePress, LinksInLinePutTheRamAtItsFarEndTwiceATurn) {
  const KnucklePressData d = toggle();
  const Mechanism m("press", d);
  EXPECT_NEAR(m.travel.greatest, d.bearing_x + d.upper + d.lower, 1e-12);
  EXPECT_EQ(m.travel.reversals.size(), 4u);
  int straight = 0;
  for (const double phi : m.travel.reversals)
    straight += std::fabs(m.reduced->output_position(phi).value - m.travel.greatest) < 1e-12;
  EXPECT_EQ(straight, 2);
  // The crank pin then lies where the rod reaches the knee at (bearing_x + upper, bearing_y) = (0, 380 mm):
  // 380² + 40² − 2 · 380 · 40 sin φ = 360².
  const double sine = (0.38 * 0.38 + 0.04 * 0.04 - 0.36 * 0.36) / (2 * 0.38 * 0.04);
  bool found = false;
  for (const double phi : m.travel.reversals) found = found || std::fabs(std::sin(phi) - sine) < 1e-11;
  EXPECT_TRUE(found);
}

// Ram force F on the knee joint at angles α of both links to the line: 2 F tan α at the knee; so x′ → 0 with α.
TEST(KnucklePress, MechanicalAdvantageGrowsWithoutBoundAsTheLinksFallInLine) {
  const KnucklePressData d = toggle();
  const Mechanism m("press", d);
  for (double phi = 0.05; phi < 2 * pi; phi += 0.1) {
    const std::vector<PlanePoint> joint = MechanismData(d).places(phi);
    const double tangent = (joint[2].y - d.bearing_y) / (joint[2].x - d.bearing_x);  // of the upper link
    const auto upper_rate = static_cast<double>(linkage_of(d, phi).bodies[2].direction.rate().value());
    // Equal links: x = x_G + 2 u cos α, so x′ = −2 u sin α α′.
    const double sine = tangent / std::sqrt(1 + tangent * tangent);
    EXPECT_NEAR(m.reduced->output_velocity(phi).value, -2 * d.upper * sine * upper_rate, 1e-12);
  }
}

TEST(KnucklePress, KneeIsOnTheSideThatWasAskedFor) {
  RandomLinkage random(35);
  for (int i = 0; i < 20; ++i) {
    const KnucklePressData d = random.knuckle_press();
    for (double phi = 0; phi < 6.2; phi += 0.5) {
      const std::vector<PlanePoint> j = MechanismData(d).places(phi);  // O, A, K, G, ram
      const double cross = (j[3].x - j[1].x) * (j[2].y - j[1].y) - (j[3].y - j[1].y) * (j[2].x - j[1].x);
      EXPECT_EQ(cross < 0, d.knee_right);
      EXPECT_GT(j[4].x, j[2].x);
      EXPECT_NEAR(j[4].y, d.guide, 1e-13);
    }
  }
}

TEST(KnucklePress, GeometryThatCannotTurnIsRefused) {
  KnucklePressData d = toggle();
  d.rod = 0.20;
  ASSERT_FALSE(faults_of(d).empty());
  EXPECT_EQ(faults_of(d)[0].key, "radius");
  EXPECT_NE(faults_of(d)[0].text.find("bearing distance"), std::string::npos) << faults_of(d)[0].text;
  d = toggle();
  d.lower = 0.02;
  ASSERT_EQ(faults_of(d).size(), 1u);
  EXPECT_EQ(faults_of(d)[0].key, "lower");
  EXPECT_THROW(make_bodies(d), std::invalid_argument);
}

// The link just longer than its message demands works; just shorter is refused.
TEST(KnucklePress, LeastLowerLinkIsExact) {
  RandomLinkage random(36);
  for (int i = 0; i < 20; ++i) {
    KnucklePressData d = random.knuckle_press();
    double rise = 0;
    for (int k = 0; k < 20000; ++k) {
      const double phi = 2 * pi * k / 20000;
      const double tilt = std::atan2(d.bearing_y, d.bearing_x), ground = std::hypot(d.bearing_x, d.bearing_y);
      const auto upper =
          test::follower(Direction::of_variable(phi - tilt), d.radius, d.rod, d.upper, ground, !d.knee_right) +
          Direction::constant(tilt);
      rise = std::max(rise, std::fabs(d.guide - d.bearing_y - d.upper * static_cast<double>(upper.sin.value())));
    }
    d.lower_body.com = 0;
    d.lower = rise * (1 + 1e-6);
    EXPECT_TRUE(faults_of(d).empty());
    d.lower = rise * (1 - 1e-9);
    EXPECT_FALSE(faults_of(d).empty());
  }
}

// Simbody's bodies take the links' shapes from one position of the loops: from any they are the same links.
TEST(Linkages, ShapesAreTheSameWhereverTheyAreReadOff) {
  RandomLinkage random(37);
  for (int i = 0; i < 10; ++i)
    for (const MechanismData& data : {MechanismData(random.four_bar()), MechanismData(random.quick_return()),
                                      MechanismData(random.knuckle_press())}) {
      BodiesOf of = data.bodies_of();
      const auto one = make_bodies(of);
      of.place = random.uniform(0, 2 * pi);
      const auto other = make_bodies(of);
      for (double phi = 0.1; phi < 6.2; phi += 0.7) {
        const ReducedSample a = one->sample(phi), b = other->sample(phi);
        EXPECT_NEAR(b.inertia, a.inertia, 1e-13 * a.inertia) << phi << " from " << of.place;
        EXPECT_NEAR(b.output_position, a.output_position, 1e-13) << phi << " from " << of.place;
        EXPECT_NEAR(b.gravity_torque, a.gravity_torque, 1e-12 * a.gravity_torque_scale) << phi;
        EXPECT_GT(b.closure_determinant, 0);
      }
    }
}

TEST(Linkages, SenselessDataAreRefusedInWords) {
  FourBarData f = crank_rocker();
  f.rocker_body.inertia = 0.001;  // less than its mass demands about the bearing
  ASSERT_EQ(faults_of(f).size(), 1u);
  EXPECT_EQ(faults_of(f)[0].key, "rocker_inertia");
  f = crank_rocker();
  f.coupler_body = {0, 0, 0.1};
  ASSERT_EQ(faults_of(f).size(), 1u);
  EXPECT_EQ(faults_of(f)[0].key, "coupler_inertia");
  EXPECT_THROW(make_bodies(f), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::linkages_test
