// newton_euler_test.cpp — reactions of all mechanisms against the slider-crank's closed form, momentum and energy.
#include "mechanisms/reduced/newton_euler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mechanisms/reduced/mechanism_data.h"
#include "tests/mechanisms/linkage_truth.h"
#include "tests/mechanisms/mechanism_examples.h"
#include "tests/mechanisms/simbody_reactions.h"
#include "tests/mechanisms/slider_crank_statics.h"

namespace kurbel::newton_euler_test {
namespace {

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

LinkageState random_state(std::mt19937& random) {
  return {uniform(random, -7, 7), uniform(random, -60, 60), uniform(random, -500, 500), uniform(random, -5e3, 5e3)};
}

LinkageForces forces_of(const MechanismData& data, const LinkageState& state) {
  return forces_in(data.linkage(state.phi), state);
}

void expect_near(Force2 got, Force2 right, double bound, const char* what) {
  EXPECT_NEAR(got.x, right.x, bound) << what;
  EXPECT_NEAR(got.y, right.y, bound) << what;
}

double largest_force(const LinkageForces& f) {
  double largest = 0;
  for (const JointForces& j : f.joints) largest = std::max(largest, j.force.magnitude());
  for (const LinkForces& l : f.links) largest = std::max(largest, l.inertia_force.magnitude());
  return std::max(largest, std::abs(f.state.load));
}

TEST(ReactionsOfAllLinks, AreTheSliderCranksClosedForm) {
  std::mt19937 random(19);
  for (int trial = 0; trial < 200; ++trial) {
    SliderCrankData d = random_mechanism(random);
    d.rod_length = (d.radius + std::fabs(d.offset)) * uniform(random, 1.3, 8);
    d.rod_com = uniform(random, -0.2, 1.2) * d.rod_length;
    const LinkageState state = random_state(random);
    const LinkageForces f = forces_of(d, state);
    const SliderCrankForces s =
        SliderCrankStatics(d).solve_frictionless({state.phi, state.omega, state.alpha, state.load});
    const double force = largest_force(f), moment = force * (d.radius + d.rod_length);
    expect_near(f.joints[0].force, s.main_bearing, 1e-12 * force, "main bearing");
    expect_near(f.joints[1].force, s.crank_pin, 1e-12 * force, "crank pin");
    expect_near(f.joints[2].force, s.slider_pin, 1e-12 * force, "slider pin");
    EXPECT_NEAR(f.joints[3].normal, s.guide, 1e-12 * force);
    EXPECT_NEAR(f.joints[3].moment, s.guide_moment, 1e-12 * moment);
    EXPECT_NEAR(f.torque, s.torque, 1e-12 * moment);
    expect_near(f.shaking_force, s.shaking_force, 1e-12 * force, "shaking force");
    EXPECT_NEAR(f.shaking_moment, s.shaking_moment, 1e-12 * moment);
    EXPECT_NEAR(f.links[1].inertia_couple, s.rod_couple, 1e-12 * moment);
    expect_near(f.links[1].inertia_force, s.rod_inertia, 1e-12 * force, "rod");
  }
}

// Linear momentum and that about the crank's axis at (φ, ω), from the centres of mass and the links' turning.
struct Momentum {
  double x = 0, y = 0, about = 0;
};
Momentum momentum_of(const PlanarLinkage& l, double omega) {
  Momentum p;
  for (int i = 0; i < l.body_count; ++i) {
    const PlanarLinkage::Body& b = l.bodies[i];
    const long double m = b.mass * omega, vx = b.com.x.slope(), vy = b.com.y.slope();
    p.x += static_cast<double>(m * vx);
    p.y += static_cast<double>(m * vy);
    p.about += static_cast<double>(m * (b.com.x.value() * vy - b.com.y.value() * vx) +
                                   omega * b.inertia * b.direction.rate().value());
  }
  return p;
}

// What the frame does to the mechanism, weights and load included, is the rate of its momentum; the frame feels the
// inertia forces. d/dt by differences along φ̈ = α.
void expect_rate_of_momentum(const MechanismData& data, const LinkageState& s) {
  const LinkageForces f = forces_of(data, s);
  const PlanarLinkage l = data.linkage(s.phi);
  Force2 sum;
  double mass = 0, moment = 0, about_weights = 0;
  for (const JointForces& j : f.joints) {
    if (std::string(j.from) != "frame") continue;
    sum = sum + j.force;
    moment += j.at.x * j.force.y - j.at.y * j.force.x + j.moment;
  }
  const double up_x = std::sin(l.elevation), up_y = std::cos(l.elevation);
  for (int i = 0; i < l.body_count; ++i) {
    mass += l.bodies[i].mass;
    about_weights -= l.bodies[i].mass * l.gravity *
                     static_cast<double>(l.bodies[i].com.x.value() * up_y - l.bodies[i].com.y.value() * up_x);
  }
  sum = sum - mass * l.gravity * Force2{up_x, up_y};
  moment += about_weights + f.torque;
  if (l.rocks) {
    moment += s.load;
  } else {
    sum.x += s.load;
    moment -= s.load * static_cast<double>(l.load_at.y.value());
  }
  const double force = largest_force(f), span = 10 * std::hypot(f.joints.back().at.x, f.joints.back().at.y);
  expect_near(sum, -1.0 * f.shaking_force, 1e-12 * force, "sum of the frame's forces");
  EXPECT_NEAR(moment, -f.shaking_moment, 1e-11 * force * span);
  const double h = 1e-4 / std::max(1.0, std::abs(s.omega));  // s
  const auto later = [&](double t) {
    return momentum_of(data.linkage(s.phi + s.omega * t + s.alpha * t * t / 2), s.omega + s.alpha * t);
  };
  // Richardson's extrapolation: error of order h⁴.
  const auto rate = [&](double Momentum::*of) {
    const double wide = (later(2 * h).*of - later(-2 * h).*of) / (4 * h),
                 near = (later(h).*of - later(-h).*of) / (2 * h);
    return (4 * near - wide) / 3;
  };
  EXPECT_NEAR(-f.shaking_force.x, rate(&Momentum::x), 1e-6 * force);
  EXPECT_NEAR(-f.shaking_force.y, rate(&Momentum::y), 1e-6 * force);
  EXPECT_NEAR(-f.shaking_moment, rate(&Momentum::about), 1e-6 * force * span);
}

// M ω + W + F v = dT/dt, and T, I_r are those of the reduced machine.
void expect_power_balance(const MechanismData& data, const LinkageState& s) {
  const LinkageForces f = forces_of(data, s);
  const ClosedForm reduced = data.closed_form(s.phi);
  const double torque = static_cast<double>(reduced.inertia * s.alpha + reduced.inertia_slope * s.omega * s.omega / 2 -
                                            reduced.gravity_torque - s.load * reduced.output_velocity_ratio);
  const double scale = static_cast<double>(
      std::fabs(reduced.inertia * s.alpha) + std::fabs(reduced.inertia_slope) * s.omega * s.omega / 2 +
      reduced.gravity_torque_scale + std::fabs(s.load * reduced.output_velocity_ratio));
  EXPECT_NEAR(f.torque, torque, 1e-12 * scale);
  EXPECT_NEAR(f.torque * s.omega + f.weight_power + f.load_power, f.kinetic_rate, 1e-12 * scale * std::abs(s.omega));
  EXPECT_NEAR(f.reduced_inertia, static_cast<double>(reduced.inertia), 1e-14 * f.reduced_inertia);
  EXPECT_LT(f.residual, 1e-17);
}

// A random state for whatever mechanism `next` gives.
template <class Next>
void expect_laws(Next&& next) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const MechanismData data = next();
    const LinkageState state = random_state(random);
    expect_rate_of_momentum(data, state);
    expect_power_balance(data, state);
  }
}

TEST(ReactionsOfAllLinks, AreTheRateOfMomentumAndBalancePowersInAFourBar) {
  test::RandomLinkage random(41);
  expect_laws([&] { return random.four_bar(); });
}

TEST(ReactionsOfAllLinks, AreTheRateOfMomentumAndBalancePowersInAQuickReturn) {
  test::RandomLinkage random(42);
  expect_laws([&] { return random.quick_return(); });
}

TEST(ReactionsOfAllLinks, AreTheRateOfMomentumAndBalancePowersInAKnucklePress) {
  test::RandomLinkage random(43);
  expect_laws([&] { return random.knuckle_press(); });
}

TEST(ReactionsOfAllLinks, AreTheRateOfMomentumAndBalancePowersInASliderCrank) {
  std::mt19937 random(44);
  expect_laws([&] { return random_mechanism(random); });
}

// Simbody's mobilizers, each by the joint and the sense in which it is stated here; every link with mass.
struct Reported {
  const char* joint;
  int sense;
};
template <class Data>
void expect_simbody(const Data& data, const std::vector<Reported>& mobilizers, std::mt19937& random) {
  const LinkageState s = random_state(random);
  const LinkageForces f = forces_of(data, s);
  const MechanismReactions simbody =
      simbody_reactions(MechanismData(data).bodies_of(), s.phi, s.omega, s.alpha, s.load);
  const double force = largest_force(f), moment = force + std::abs(f.torque);
  ASSERT_EQ(simbody.on.size(), mobilizers.size());
  for (std::size_t k = 0; k < mobilizers.size(); ++k)
    for (const JointForces& j : f.joints)
      if (std::string(j.name) == mobilizers[k].joint) {
        expect_near(j.force, mobilizers[k].sense * Force2{simbody.on[k].x, simbody.on[k].y}, 1e-9 * force, j.name);
        EXPECT_NEAR(j.moment, mobilizers[k].sense * (j.slides || k > 0 ? simbody.on[k].moment : 0.0), 1e-9 * moment)
            << j.name;
      }
  EXPECT_NEAR(f.torque, simbody.torque, 1e-9 * moment);
}

void give_mass(LinkBody& link, bool pivoted) {
  link.mass += 0.3;
  link.inertia = (pivoted ? link.mass * link.com * link.com : 0) + 0.02;
}

TEST(ReactionsOfAllLinks, AreSimbodysInAFourBar) {
  test::RandomLinkage linkage(45);
  std::mt19937 random(45);
  for (int trial = 0; trial < 10; ++trial) {
    FourBarData d = linkage.four_bar();
    give_mass(d.crank_body, true), give_mass(d.coupler_body, false), give_mass(d.rocker_body, true);
    expect_simbody(d, {{"main bearing", 1}, {"crank pin", 1}, {"rocker bearing", 1}}, random);
  }
}

TEST(ReactionsOfAllLinks, AreSimbodysInAQuickReturn) {
  test::RandomLinkage linkage(46);
  std::mt19937 random(46);
  for (int trial = 0; trial < 10; ++trial) {
    QuickReturnData d = linkage.quick_return();
    give_mass(d.crank_body, true), give_mass(d.lever_body, true), give_mass(d.link_body, false);
    d.block_mass += 0.4, d.block_inertia += 0.01;
    expect_simbody(d, {{"main bearing", 1}, {"lever bearing", 1}, {"slot", -1}, {"lever pin", 1}}, random);
  }
}

TEST(ReactionsOfAllLinks, AreSimbodysInAKnucklePress) {
  test::RandomLinkage linkage(47);
  std::mt19937 random(47);
  for (int trial = 0; trial < 10; ++trial) {
    KnucklePressData d = linkage.knuckle_press();
    give_mass(d.crank_body, true), give_mass(d.rod_body, false);
    give_mass(d.upper_body, true), give_mass(d.lower_body, false);
    expect_simbody(d, {{"main bearing", 1}, {"crank pin", 1}, {"upper bearing", 1}, {"knee, lower link", 1}}, random);
  }
}

}  // namespace
}  // namespace kurbel::newton_euler_test
