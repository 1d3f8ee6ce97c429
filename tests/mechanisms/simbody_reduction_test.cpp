// simbody_reduction_test.cpp — the reduction of other mechanisms than the slider-crank (C++17 island, like its header).
#include "mechanisms/bodies/simbody_reduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

namespace kurbel {
namespace {

using SimTK::Inertia;
using SimTK::MassProperties;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

struct Mechanism {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::State state;
  std::unique_ptr<SimbodyReduction> reduction;

  void finish(std::vector<TrackedPoint> points) {
    system.realizeTopology();
    state = system.getDefaultState();
    reduction = std::make_unique<SimbodyReduction>(system, matter, 0, points);
  }
  Reduction at(double phi) {  // keeps to the branch that the state is on
    state.updQ()[0] = phi;
    reduction->close(state);
    return reduction->reduce(state);
  }
};

SimTK::Body::Rigid link(double mass, double length) {
  const Vec3 com(0.4 * length, 0.1 * length, 0);
  const double central = 0.2 * mass * length * length;
  return SimTK::Body::Rigid(MassProperties(mass, com, Inertia(central / 2, central / 2, central) + Inertia(com, mass)));
}

// The pin of two bodies: their points coincide in the plane body's x and y.
void pin(MobilizedBody& plane_body, Vec3 place, MobilizedBody& follower, Vec3 station) {
  SimTK::Constraint::PointInPlane(plane_body, UnitVec3(1, 0, 0), place[0], follower, station);
  SimTK::Constraint::PointInPlane(plane_body, UnitVec3(0, 1, 0), place[1], follower, station);
}

// d/dφ of a function by central differences of order 6.
double slope_of(const std::function<double(double)>& f, double phi) {
  const double h = 2e-3;
  return (45 * (f(phi + h) - f(phi - h)) - 9 * (f(phi + 2 * h) - f(phi - 2 * h)) + (f(phi + 3 * h) - f(phi - 3 * h))) /
         (60 * h);
}

void expect_consistent_derivatives(Mechanism& mechanism, double from, double to) {
  for (double phi = from; phi < to; phi += 0.1) {
    const Reduction here = mechanism.at(phi);
    EXPECT_NEAR(slope_of([&](double p) { return mechanism.at(p).inertia; }, phi), here.slope, 1e-9) << phi;
    EXPECT_NEAR(slope_of([&](double p) { return mechanism.at(p).slope; }, phi), here.curvature, 1e-8) << phi;
    const auto x = [&](double p) { return mechanism.at(p).points[0].position[0]; };
    const auto x1 = [&](double p) { return mechanism.at(p).points[0].velocity_ratio[0]; };
    EXPECT_NEAR(slope_of(x, phi), here.points[0].velocity_ratio[0], 1e-10) << phi;
    EXPECT_NEAR(slope_of(x1, phi), here.points[0].acceleration_ratio[0], 1e-10) << phi;
    for (int j = 0; j < here.q3.size(); ++j)
      EXPECT_NEAR(slope_of([&](double p) { return mechanism.at(p).q2[j]; }, phi), here.q3[j], 1e-8) << phi;
  }
}

//      B────────C        ground OD = 1.0, crank OA = 0.3, coupler AC = 0.9, rocker DC = 0.6;
//   O──A          D      the rocker's bearing is turned by 0.4 rad, which must not matter
TEST(SimbodyReduction, FourBar) {
  Mechanism m;
  MobilizedBody::Pin crank(m.matter.Ground(), Transform(), link(2, 0.3), Transform());
  MobilizedBody::Pin coupler(crank, Vec3(0.3, 0, 0), link(1.5, 0.9), Vec3(0));
  MobilizedBody::Pin rocker(m.matter.Ground(), Transform(Rotation(0.4, SimTK::ZAxis), Vec3(1, 0, 0)), link(1, 0.6),
                            Transform());
  pin(rocker, Vec3(0.6, 0, 0), coupler, Vec3(0.9, 0, 0));  // a moving plane
  m.finish({{coupler.getMobilizedBodyIndex(), Vec3(0.45, 0.1, 0)}});
  // At φ = 0: cos(rocker) from the triangle A (0.3, 0), C, D (1, 0) with sides 0.9, 0.6 and 0.7.
  const double rocker_angle = SimTK::Pi - std::acos((0.7 * 0.7 + 0.6 * 0.6 - 0.9 * 0.9) / (2 * 0.7 * 0.6));
  const double coupler_angle = std::acos((0.7 * 0.7 + 0.9 * 0.9 - 0.6 * 0.6) / (2 * 0.7 * 0.9));
  m.state.updQ()[1] = coupler_angle;
  m.state.updQ()[2] = rocker_angle - 0.4;
  const Reduction start = m.at(0);
  EXPECT_NEAR(m.state.getQ()[1], coupler_angle, 1e-14);
  EXPECT_NEAR(m.state.getQ()[2], rocker_angle - 0.4, 1e-14);
  for (double phi = 0; phi < 2 * SimTK::Pi; phi += 0.05) EXPECT_GT(m.at(phi).determinant / start.determinant, 0);
  expect_consistent_derivatives(m, 0, 2 * SimTK::Pi);
}

// Quick-return: a block pinned to the crank slides along a rocking arm whose bearing lies 0.5 below the crank's.
TEST(SimbodyReduction, QuickReturn) {
  Mechanism m;
  MobilizedBody::Pin crank(m.matter.Ground(), Transform(), link(2, 0.2), Transform());
  MobilizedBody::Pin arm(m.matter.Ground(), Vec3(0, -0.5, 0), link(3, 0.8), Vec3(0));
  MobilizedBody::Slider block(arm, Transform(Rotation(0.1, SimTK::ZAxis), Vec3(0.05, 0.02, 0)), link(0.5, 0.1),
                              Vec3(0.01, 0.02, 0));
  pin(crank, Vec3(0.2, 0, 0), block, Vec3(0.03, 0.01, 0));
  m.finish({{arm.getMobilizedBodyIndex(), Vec3(0.8, 0, 0)}});
  m.state.updQ()[1] = std::atan2(0.5, 0.2) - 0.1;
  m.state.updQ()[2] = 0.5;
  m.at(0);
  EXPECT_GT(m.state.getQ()[2], 0);
  expect_consistent_derivatives(m, 0, 2 * SimTK::Pi);
  // The arm's angle in closed form for a block guided through its bearing: tan(arm) = (0.5 + r sin φ)/(r cos φ).
  Mechanism plain;
  MobilizedBody::Pin crank2(plain.matter.Ground(), Transform(), link(2, 0.2), Transform());
  MobilizedBody::Pin arm2(plain.matter.Ground(), Vec3(0, -0.5, 0), link(3, 0.8), Vec3(0));
  SimTK::Constraint::PointInPlane(arm2, UnitVec3(0, 1, 0), 0, crank2, Vec3(0.2, 0, 0));
  plain.finish({{arm2.getMobilizedBodyIndex(), Vec3(0.8, 0, 0)}});
  plain.state.updQ()[1] = 1.2;
  for (double phi = 0; phi < 6.3; phi += 0.1) {
    plain.at(phi);
    EXPECT_NEAR(plain.state.getQ()[1], std::atan2(0.5 + 0.2 * std::sin(phi), 0.2 * std::cos(phi)), 1e-14);
  }
  expect_consistent_derivatives(plain, 0, 6.3);
}

TEST(SimbodyReduction, OpenLoopIsReported) {
  Mechanism m;  // a rod too short to reach its line: no assembly at φ = π/2
  MobilizedBody::Pin crank(m.matter.Ground(), Transform(), link(2, 0.3), Transform());
  MobilizedBody::Pin rod(crank, Vec3(0.3, 0, 0), link(1, 0.2), Vec3(0));
  SimTK::Constraint::PointInPlane(m.matter.Ground(), UnitVec3(0, 1, 0), 0, rod, Vec3(0.2, 0, 0));
  m.finish({});
  EXPECT_NO_THROW(m.at(0.3));
  EXPECT_THROW(m.at(SimTK::Pi / 2), std::runtime_error);
}

TEST(SimbodyReduction, KnowsWhatItDoesNotKnow) {
  Mechanism spatial;
  MobilizedBody::Ball ball(spatial.matter.Ground(), Transform(), link(1, 1), Transform());
  EXPECT_THROW(spatial.finish({}), std::logic_error);
  Mechanism open;
  MobilizedBody::Pin upper(open.matter.Ground(), Transform(), link(1, 1), Transform());
  MobilizedBody::Pin lower(upper, Vec3(1, 0, 0), link(1, 1), Vec3(0));
  EXPECT_THROW(open.finish({}), std::logic_error);
}

}  // namespace
}  // namespace kurbel
