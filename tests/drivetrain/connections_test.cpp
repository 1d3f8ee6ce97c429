// connections_test.cpp — every type of connection against one demand: the torques on both of its sides are those that it
// reports, and together they take from the machine what it stores and loses.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/couplings/coupling.h"
#include "drivetrain/couplings/fluid_coupling.h"
#include "drivetrain/couplings/progressive_coupling.h"
#include "drivetrain/couplings/rubber_coupling.h"
#include "drivetrain/couplings/universal_joint.h"
#include "drivetrain/friction/belt.h"
#include "drivetrain/friction/clutch.h"
#include "drivetrain/gears/gear_mesh.h"
#include "engine/elements/any_connection.h"

namespace kurbel::connections_test {
namespace {

std::mt19937 random_numbers(23);
double some(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_numbers); }

MeshVariation two_harmonics() { return {7, {{0.2, 0.9}, {0.1, -2.0}}}; }

// One of each type, with numbers of order one.
template <class E>
E example();
template <>
Coupling example() {
  return {300, 2};
}
template <>
Backlash example() {
  Backlash b;
  b.stiffness = 300, b.damping = 2, b.gap = 0.1, b.twist_scale = 0.1;
  return b;
}
template <>
ProgressiveCoupling example() {
  return {{0, 0.1, 0.3}, {0, 20, 120}, Curve::Form::linear, 2};
}
template <>
RubberCoupling<2> example() {
  return {300, 2, {{{100, 0.02}, {50, 0.2}}}};
}
template <>
Belt example() {
  Belt b;
  b.stiffness = 300, b.damping = 2, b.limit = 40;
  return b;
}
template <>
UniversalJoint example() {
  return {300, 2, {0.6}, 0.3};
}
template <>
VaryingMesh<Coupling> example() {
  return {{300, 2}, two_harmonics()};
}
template <>
VaryingMesh<Backlash> example() {
  return {example<Backlash>(), two_harmonics()};
}
template <>
FluidCoupling example() {
  return {Curve({-1, 0.5, 1}, {2e-3, 1e-3, 0}, Curve::Form::linear), 3};
}
template <>
ViscousFilm example() {
  return {4};
}
template <>
FrictionClutch example() {
  return {30, 40, 0.5};
}
template <>
OneWayClutch example() {
  return {3};
}

template <class E>
class Connections : public ::testing::Test {};
using Types = ::testing::Types<Coupling, Backlash, ProgressiveCoupling, RubberCoupling<2>, Belt, UniversalJoint,
                               VaryingMesh<Coupling>, VaryingMesh<Backlash>, FluidCoupling, ViscousFilm, FrictionClutch,
                               OneWayClutch>;
TYPED_TEST_SUITE(Connections, Types);

TYPED_TEST(Connections, TorquesOnBothSidesTakeWhatIsStoredAndLost) {
  using E = TypeParam;
  constexpr std::size_t states = E::is.states;
  for (int i = 0; i < 200; ++i) {
    const double gain_a = some(0.3, 3), gain_b = some(0.3, 3);
    ConnectionPool<E> pool;
    ConnectionExtras more;
    more.angle = 0;
    pool.place(example<E>(),
               {.id = 0, .shaft_a = 0, .shaft_b = 1, .gain_a = gain_a, .gain_b = gain_b, .loss_account = 0}, more);
    const double theta = some(-0.3, 0.3), turn = some(-4, 4), speed[2] = {some(-5, 5), some(-5, 5)};
    const double rate = gain_a * speed[0] - gain_b * speed[1], command = 1;
    int mode = 0;
    const int slip = rate > 0 ? 1 : -1;
    std::array<double, states + 1> own{}, internal_rate{};
    double angle_now = turn, twist_now = theta;
    Instant now;
    now.angle = &angle_now, now.twist = &twist_now, now.speed = speed, now.mode = &mode, now.slip = &slip;
    now.command = &command, now.own = own.data();
    pool.first_states(now, own.data());
    for (std::size_t k = 0; k < states; ++k) own[k] += some(-0.02, 0.02);
    pool.first_modes(now, &mode);

    double torque[2] = {}, twist_rate = 0, reported = 0, turning = 0, spring = 0, work = 0;
    Sums sums;
    sums.torque = torque, sums.twist_rate = &twist_rate, sums.connection_torque = &reported,
    sums.spring_torque = &spring;
    sums.turning_torque = &turning, sums.work_rate = &work, sums.internal_rate = internal_rate.data();
    pool.add(now, sums);
    const double size = std::abs(reported) + std::abs(turning) + 1;
    EXPECT_NEAR(torque[0], gain_a * (turning - reported), 1e-13 * size * gain_a);
    EXPECT_NEAR(torque[1], gain_b * reported, 1e-13 * size * gain_b);

    const std::array<double, states + 1> own_then = own;
    const auto energy_at = [&](double dt) {
      twist_now = theta + rate * dt, angle_now = turn + gain_a * speed[0] * dt;
      for (std::size_t k = 0; k < states; ++k) own[k] = own_then[k] + internal_rate[k] * dt;
      return pool.energy(now);
    };
    const double h = 1e-6, stored = (energy_at(h) - energy_at(-h)) / (2 * h);
    EXPECT_LE(work, 1e-12 * size);  // what is lost
    EXPECT_NEAR(torque[0] * speed[0] + torque[1] * speed[1], work - stored, 1e-6 * size * 20) << "mode " << mode;
  }
}

// At rest, what carries τ on b takes share_of_a · τ from a, wherever it stands.
TYPED_TEST(Connections, AtRestATwistThatCarriesATorqueDoesSoOnBothSides) {
  using E = TypeParam;
  if constexpr (E::is.has_spring() && !E::is.slips) {
    const ConnectionOf<E> any(example<E>());
    const E element = example<E>();
    for (int i = 0; i < 100; ++i) {
      const double torque = some(1, 30) * (i % 2 ? 1 : -1), turn = some(-4, 4);
      Twist<double> x{.angle = any.rest_twist(turn) + any.twist_at(torque, turn), .turn = turn};
      std::array<double, E::is.states + 1> own{};
      x.own = own.data();
      if constexpr (HasStates<E>) element.first_states(x, own.data());
      if constexpr (Guarded<E>) x.mode = element.first_mode(x);
      EXPECT_NEAR(element.torque(x), torque, 1e-11 * std::abs(torque));
      double taken = torque;
      if constexpr (UsesAngle<E>) taken -= element.turning_torque(x);
      EXPECT_NEAR(any.share_of_a(torque, turn) * torque, taken, 1e-11 * std::abs(torque));
    }
  }
}

TEST(UniversalJointOnBothSides, TakesGPrimeTau) {
  const UniversalJoint joint = example<UniversalJoint>();
  const ConnectionOf<UniversalJoint> any(joint);
  for (double turn = -3; turn < 3; turn += 0.17)
    for (const double torque : {0.0, 25.0, -7.0})
      EXPECT_NEAR(any.share_of_a(torque, turn), joint.joint.ratio(turn + 0.3), 1e-12);
}

}  // namespace
}  // namespace kurbel::connections_test
