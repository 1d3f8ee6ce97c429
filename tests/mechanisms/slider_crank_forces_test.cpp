// slider_crank_forces_test.cpp — reactions against Simbody, energy and published cases; friction against its laws.

#include <gtest/gtest.h>

#include <random>

#include "tests/mechanisms/mechanism_examples.h"
#include "tests/mechanisms/simbody_reactions.h"
#include "tests/mechanisms/slider_crank_geometry.h"
#include "tests/mechanisms/slider_crank_statics.h"

namespace kurbel::slider_crank_forces_test {
namespace {

constexpr double pi = std::numbers::pi;

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

CrankState random_state(std::mt19937& random) {
  CrankState s;
  s.phi = uniform(random, -7, 7);
  s.omega = uniform(random, -60, 60);
  s.alpha = uniform(random, -500, 500);
  s.slider_force = uniform(random, -5e3, 5e3);
  return s;
}

// Any mechanism whose rod is not close to its steepest limit, where the reactions of any method lose digits.
SliderCrankData random_stout_mechanism(std::mt19937& random) {
  SliderCrankData d = random_mechanism(random);
  d.rod_length = (d.radius + std::fabs(d.offset)) * uniform(random, 1.3, 8);
  d.rod_com = uniform(random, -0.2, 1.2) * d.rod_length;
  return d;
}

SliderCrankJoints random_joints(std::mt19937& random, const SliderCrankData& d) {
  SliderCrankJoints j;
  for (RevoluteJoint* joint : {&j.main_bearing, &j.crank_pin, &j.slider_pin}) {
    joint->radius = uniform(random, 0.05, 0.5) * d.radius;
    joint->friction.kinetic = uniform(random, 0, 0.2);
    joint->friction.resting = joint->friction.kinetic * uniform(random, 1, 2);
    joint->friction.stribeck_speed = uniform(random, 0, 1);
    joint->friction.viscous = uniform(random, 0, 0.001);
  }
  SliderGuide& g = j.guide;
  g.friction = {uniform(random, 0, 0.15), 0.15, uniform(random, 0, 1), 0};
  g.length = uniform(random, 0.5, 3) * d.radius;
  g.middle = uniform(random, -0.3, 0.3) * d.radius;
  g.width = uniform(random, 0, 1.5) * d.radius;
  g.rolling_arm = uniform(random, 0, 0.001) * d.radius;
  g.roller_radius = 0.2 * d.radius;
  g.com_x = uniform(random, -0.2, 0.2) * d.radius;
  g.force_offset = uniform(random, -0.1, 0.1) * d.radius;
  return j;
}

// --- without friction ---

TEST(SliderCrankForces, AgreeWithSimbodysOwnReactionsForAnyMechanism) {
  std::mt19937 random(1);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    SliderCrankData d = random_stout_mechanism(random);
    d.rod_mass += 0.1;
    d.slider_mass += 0.1;
    d.rod_inertia += 1e-3 * d.rod_mass * d.rod_length * d.rod_length;  // a rod of points is singular in Simbody
    const CrankState s = random_state(random);
    const SliderCrankForces ours = SliderCrankStatics(d).solve(s);
    const SimbodyReactions theirs = simbody_reactions(d, s.phi, s.omega, s.alpha, s.slider_force);
    const double pairs[][2] = {{ours.main_bearing.x, theirs.main_bearing[0]},
                               {ours.main_bearing.y, theirs.main_bearing[1]},
                               {ours.crank_pin.x, theirs.crank_pin[0]},
                               {ours.crank_pin.y, theirs.crank_pin[1]},
                               {ours.slider_pin.x, theirs.slider_pin[0]},
                               {ours.slider_pin.y, theirs.slider_pin[1]},
                               {ours.guide, theirs.guide},
                               {ours.torque / d.radius, theirs.torque / d.radius},
                               {ours.guide_moment / d.radius, theirs.guide_moment / d.radius}};
    double scale = 0, difference = 0;
    for (const auto& pair : pairs) {
      scale = std::max(scale, std::fabs(pair[0]));
      difference = std::max(difference, std::fabs(pair[0] - pair[1]));
    }
    worst = std::max(worst, difference / scale);
    ASSERT_LT(difference, 1e-9 * scale) << "mechanism " << i;
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-10);
}

// M = I_r ε + ½ I_r′ ω² − M_g − F x′                                                             (theory 2.4)
TEST(SliderCrankForces, BalancingTorqueIsThatOfTheReducedMachine) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const SliderCrankData d = random_stout_mechanism(random);
    const CrankState s = random_state(random);
    const SliderCrankGeometry g(d);
    const auto inertia = g.inertia(s.phi);
    const double terms[] = {inertia.value * s.alpha, 0.5 * inertia.slope * s.omega * s.omega,
                            -g.gravity_torque(s.phi).value, -s.slider_force * g.slider(s.phi).slope};
    double sum = 0, scale = std::fabs(s.slider_force) * d.radius;
    for (const double term : terms) sum += term, scale += std::fabs(term);
    EXPECT_NEAR(SliderCrankStatics(d).solve(s).torque, sum, 1e-12 * scale);
  }
}

// The frame feels slider force, weights and inertia forces, however they are shared out among its joints.
TEST(SliderCrankForces, FrameCarriesSliderForceWeightsAndShakingForce) {
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const SliderCrankData d = random_stout_mechanism(random);
    const SliderCrankStatics statics(d, random_joints(random, d));
    const CrankState s = random_state(random);
    const SliderCrankForces f = statics.solve(s);
    const double weight = d.gravity * (d.crank_mass + d.rod_mass + d.slider_mass);
    const Force2 frame = -1.0 * f.main_bearing - Force2{f.guide_friction, f.guide};
    const Force2 expected = f.shaking_force + Force2{s.slider_force - weight * std::sin(d.stroke_angle),
                                                     -weight * std::cos(d.stroke_angle)};
    const double scale = f.main_bearing.magnitude() + std::fabs(f.guide) + std::fabs(s.slider_force);
    EXPECT_NEAR(frame.x, expected.x, 1e-12 * scale);
    EXPECT_NEAR(frame.y, expected.y, 1e-12 * scale);
  }
}

// Moment about O of all that the frame and the shaft exert on the links balances weights, slider force and inertia.
TEST(SliderCrankForces, MomentsAboutTheCrankAxisBalance) {
  std::mt19937 random(4);
  for (int i = 0; i < 500; ++i) {
    SliderCrankData d = random_stout_mechanism(random);
    d.gravity = 0;
    const SliderCrankJoints joints = random_joints(random, d);
    const CrankState s = random_state(random);
    const SliderCrankForces f = SliderCrankStatics(d, joints).solve(s);
    const double x = SliderCrankGeometry(d).slider(s.phi).value,
                 v = SliderCrankGeometry(d).slider(s.phi).slope * s.omega;
    // Friction of the guide acts at its surfaces, ± ½ width from the pin's line, on the loaded side.
    const double couple =
        f.guide_friction == 0
            ? 0
            : (f.guide_friction > 0 ? 1 : -1) * 0.5 * joints.guide.width * f.guide *
                  (joints.guide.friction.at(v) + joints.guide.rolling_arm / joints.guide.roller_radius);
    const double moment = f.torque + f.friction_torque[0] + x * f.guide + f.guide_moment + couple -
                          d.offset * f.guide_friction - (d.offset + joints.guide.force_offset) * s.slider_force +
                          f.shaking_moment;
    const double scale = std::fabs(f.torque) + std::fabs(x * f.guide) + std::fabs(f.shaking_moment);
    EXPECT_NEAR(moment, 0, 1e-11 * scale);
  }
}

// --- with friction ---

TEST(JointFriction, LawsHoldTogetherWithTheReactions) {
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) {
    const SliderCrankData d = random_stout_mechanism(random);
    const SliderCrankJoints j = random_joints(random, d);
    const CrankState s = random_state(random);
    const SliderCrankStatics statics(d, j);
    const SliderCrankForces f = statics.solve(s);
    EXPECT_LT(f.residual, 1e-12);
    const auto rate = statics.rates(s.phi, s.omega);
    const auto expect_revolute = [](double torque, const RevoluteJoint& joint, Force2 r, double w) {
      const double coefficient = joint.friction.at(w * joint.radius);
      const double circle = joint.radius * coefficient / std::sqrt(1 + coefficient * coefficient);
      EXPECT_NEAR(torque, (w > 0 ? -1 : 1) * circle * r.magnitude(), 1e-11 * circle * r.magnitude() + 1e-300);
    };
    expect_revolute(f.friction_torque[0], j.main_bearing, f.main_bearing, rate.main_bearing);
    expect_revolute(f.friction_torque[1], j.crank_pin, f.crank_pin, rate.crank_pin);
    expect_revolute(f.friction_torque[2], j.slider_pin, f.slider_pin, rate.slider_pin);
    const double bearing = f.both_edges ? std::fabs(f.edge_front) + std::fabs(f.edge_back) : std::fabs(f.guide);
    const double coefficient = j.guide.friction.at(rate.slider) + j.guide.rolling_arm / j.guide.roller_radius;
    EXPECT_NEAR(f.guide_friction, (rate.slider > 0 ? -1 : 1) * coefficient * bearing, 1e-11 * coefficient * bearing);
    for (const double power : f.friction_power) EXPECT_GE(power, 0);
  }
}

// M ω + F v + weights − friction loss = dT/dt
TEST(JointFriction, PowerBalancesAtEveryPositionOfAnyMechanism) {
  std::mt19937 random(6);
  int with_friction = 0;
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const SliderCrankData d = random_stout_mechanism(random);
    const SliderCrankJoints j = i % 2 ? random_joints(random, d) : SliderCrankJoints{};
    with_friction += j.frictionless() ? 0 : 1;
    const SliderCrankStatics statics(d, j);
    const SliderCrankGeometry g(d);
    CrankState s = random_state(random);
    for (int k = 0; k < 36; ++k) {
      s.phi = 2 * pi * k / 36 + 0.01;
      const SliderCrankForces f = statics.solve(s);
      const auto inertia = g.inertia(s.phi);
      const double v = g.slider(s.phi).slope * s.omega;
      const double rate_of_energy = (inertia.value * s.alpha + 0.5 * inertia.slope * s.omega * s.omega) * s.omega;
      const double in = f.torque * s.omega + s.slider_force * v + g.gravity_torque(s.phi).value * s.omega;
      const double scale = std::fabs(f.torque * s.omega) + std::fabs(s.slider_force * v) + std::fabs(rate_of_energy);
      const double error = std::fabs(in - f.friction_loss() - rate_of_energy) / scale;
      worst = std::max(worst, error);
      ASSERT_LT(error, 1e-8) << "mechanism " << i << " position " << k;
    }
  }
  EXPECT_EQ(with_friction, 200);
  EXPECT_LT(worst, 1e-11);
}

TEST(JointFriction, ForwardProblemReturnsTheAccelerationOfTheInverseProblem) {
  std::mt19937 random(7);
  for (int i = 0; i < 1000; ++i) {
    SliderCrankData d = random_stout_mechanism(random);
    const SliderCrankJoints j = random_joints(random, d);
    CrankState s = random_state(random);
    const double shaft = uniform(random, 0.1, 5) * d.radius * d.radius;
    const SliderCrankStatics statics(d, j);
    const double torque = statics.solve(s).torque + shaft * s.alpha;
    const double expected = s.alpha;
    EXPECT_NEAR(statics.acceleration(s, torque, shaft), expected, 1e-9 * (std::fabs(expected) + s.omega * s.omega));
  }
}

TEST(JointFriction, ReversedMotionReversesEveryLossButNoReactionWithoutFriction) {
  const SliderCrankData d = full_mechanism(3, 0.02);
  const SliderCrankStatics statics(d);
  CrankState s{.phi = 1, .omega = 20, .alpha = 30, .slider_force = 400};
  const SliderCrankForces forward = statics.solve(s);
  s.omega = -20;
  const SliderCrankForces back = statics.solve(s);
  EXPECT_DOUBLE_EQ(forward.torque, back.torque);
  EXPECT_DOUBLE_EQ(forward.main_bearing.x, back.main_bearing.x);
}

// A slider whose pin pulls with P at the rod's angle: f N = f P tan β; the crank drives no more once f tan β = 1.
TEST(JointFriction, SteepRodOnARoughGuideJams) {
  SliderCrankData d;
  d.radius = 0.1;
  d.rod_length = 0.11;
  d.slider_mass = 1;
  SliderCrankJoints j;
  const double phi = 80 * pi / 180, beta = std::asin(d.radius / d.rod_length * std::sin(phi));
  // The crank turns so that the rod pushes the slider outwards: φ in the fourth quadrant.
  const CrankState s{.phi = -phi, .omega = 1e-3, .slider_force = -100};
  j.guide.friction.kinetic = j.guide.friction.resting = 0.999 / std::tan(beta);
  // P (1 − f tan β) = F: one thousandth of the force reaches the slider.
  EXPECT_NEAR(SliderCrankStatics(d, j).solve(s).slider_pin.x * 0.001, 100, 1e-4);
  j.guide.friction.kinetic = j.guide.friction.resting = 1.001 / std::tan(beta);
  EXPECT_THROW(SliderCrankStatics(d, j).solve(s), std::runtime_error);
}

// Reaction beyond the guide: two edge forces with N = N₁ + N₂ and their moment; the friction grows accordingly.
TEST(JointFriction, ReactionBeyondTheGuidePressesOnBothEdges) {
  SliderCrankData d = reference_mechanism();
  SliderCrankJoints j;
  j.guide.length = 0.1;
  j.guide.force_offset = 0.06;
  j.guide.friction.kinetic = j.guide.friction.resting = 0.1;
  const CrankState s{.phi = 0.3, .omega = 1e-3, .slider_force = -1000};
  const SliderCrankForces f = SliderCrankStatics(d, j).solve(s);
  ASSERT_TRUE(f.both_edges);
  EXPECT_LT(f.edge_front * f.edge_back, 0);
  EXPECT_NEAR(f.edge_front + f.edge_back, f.guide, 1e-9);
  EXPECT_NEAR(0.05 * (f.edge_front - f.edge_back), f.guide_moment, 1e-9);
  EXPECT_NEAR(f.guide_moment, -60, 1e-9);  // h F, against the force's own moment
  EXPECT_NEAR(f.guide_friction, 0.1 * 2 * 60 / 0.1, 1e-9);
  EXPECT_GT(std::fabs(f.guide_point), 0.05);
}

TEST(JointFriction, RestingTorquesEncloseTheFrictionlessOneAndTheirWidthIsTheFriction) {
  const SliderCrankData d = full_mechanism(3, 0.0);
  SliderCrankJoints j;
  j.main_bearing = {0.03, {0.05, 0.1, 0.1, 0}};
  j.guide.friction = {0.05, 0.12, 0.1, 0};
  const SliderCrankStatics statics(d, j);
  for (int k = 0; k < 24; ++k) {
    const double phi = 0.1 + 2 * pi * k / 24;
    const auto range = statics.resting_torque(phi, -2000);
    const double free = statics.solve_frictionless({.phi = phi, .slider_force = -2000}).torque;
    EXPECT_LT(range.low, free);
    EXPECT_GT(range.high, free);
    // At rest the static coefficients hold; about to move, the upper limit is that of motion forwards.
    EXPECT_DOUBLE_EQ(range.high,
                     statics.solve({.phi = phi, .slider_force = -2000, .direction = 1, .at_rest = true}).torque);
    // 2 ρ |R| of the main bearing alone.
    const double reaction = statics.solve_frictionless({.phi = phi, .slider_force = -2000}).main_bearing.magnitude();
    EXPECT_GT(range.high - range.low, 1.9 * friction_circle_radius(0.03, 0.1) * reaction);
  }
}

TEST(JointFriction, BadDataAreRefusedInWords) {
  SliderCrankJoints j;
  j.crank_pin = {0.02, {0.1, 0.05, 0, 0}};
  try {
    SliderCrankStatics(reference_mechanism(), j);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "slider-crank: crank pin: static friction coefficient = 0.05; must be >= the kinetic one, 0.1");
  }
  SliderCrankData massless;
  massless.radius = 0.1;
  massless.rod_length = 0.3;
  EXPECT_THROW(SliderCrankStatics(massless).acceleration({}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::slider_crank_forces_test
