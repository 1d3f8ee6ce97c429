// reduced_mechanism_test.cpp — tables from the closed form and from Simbody against a closed form of their own in long double.
#include "mechanisms/reduced/reduced_mechanism.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <thread>

#include "tests/mechanisms/mechanism_examples.h"
#include "tests/mechanisms/slider_crank_geometry.h"

namespace kurbel::reduced_mechanism_test {
namespace {

using Channel = ReducedMechanism::Channel;

constexpr Extraction both[] = {Extraction::first, Extraction::second};
ReducedMechanism extracted(const SliderCrankData& d, Extraction from) {
  return extract_mechanism(d, table_tolerance, table_max_pieces, from);
}
// Finer tables of a lower degree take twice the pieces.
std::size_t pieces_of(Extraction from, std::size_t by_bodies) {
  return from == Extraction::first ? 2 * by_bodies : by_bodies;
}

// Largest error of each channel at random angles: of I_r's own value, of the other channels' maxima.
void expect_accurate(const ReducedMechanism& mechanism, const SliderCrankGeometry& geometry, double tolerance) {
  std::mt19937 random(7);
  const Maxima maximum(geometry);
  for (int i = 0; i < 5000; ++i) {
    const double phi = random_angle(random);
    const auto at = mechanism.at(phi);
    const Truth truth(geometry, phi);
    for (int c = 0; c < channels; ++c) {
      const long double scale = c == 0 ? truth.value[0] : maximum.value[c];
      ASSERT_LE(std::fabs(at.value(static_cast<Channel>(c)) - truth.value[c]), tolerance * scale)
          << "channel " << c << " phi = " << phi
          << " l/(r + |e|) = " << geometry.data().rod_length / (0.1 + std::fabs(geometry.data().offset));
    }
  }
}

class NearAndFarFromTheDeadPosition : public testing::TestWithParam<double> {};

TEST_P(NearAndFarFromTheDeadPosition, EveryChannelIsGoodToTwelveDigits) {
  for (const double offset : {0.0, 0.03, -0.06})
    for (const Extraction from : both) {
      const SliderCrankData d = full_mechanism(GetParam(), offset);
      const ReducedMechanism mechanism = extracted(d, from);
      EXPECT_TRUE(mechanism.report().converged);
      EXPECT_LE(mechanism.report().pieces, pieces_of(from, GetParam() < 1.01 ? 1024 : 128));
      expect_accurate(mechanism, SliderCrankGeometry(d), from == Extraction::first ? 1e-13 : 1e-12);
    }
}
INSTANTIATE_TEST_SUITE_P(RodToCrank, NearAndFarFromTheDeadPosition,
                         testing::Values(1.0001, 1.001, 1.01, 1.05, 1.2, 2.0, 3.5, 10.0));

TEST(ReducedMechanism, ReferenceMachineNeedsFewPieces) {
  for (const Extraction from : both) {
    const ReducedMechanism mechanism = extracted(reference_mechanism(), from);
    EXPECT_LE(mechanism.report().pieces, pieces_of(from, 32));
    EXPECT_LE(mechanism.report().samples, pieces_of(from, 800));
    const double tolerance = from == Extraction::first ? fine_tolerance * table_tolerance : table_tolerance;
    for (const auto& channel : mechanism.report().channels) EXPECT_LE(channel.error, tolerance) << channel.name;
  }
}

TEST(ReducedMechanism, PairsHoldAFunctionAndItsSlope) {
  const SliderCrankGeometry geometry(full_mechanism(2, 0.03));
  const auto mechanism = reduce_mechanism(geometry.data());
  const double phi = 4.2;
  const auto inertia = geometry.inertia(phi), slider = geometry.slider(phi);
  const auto weight = geometry.gravity_torque(phi);
  EXPECT_NEAR(mechanism->inertia(phi).value, inertia.value, 1e-12);
  EXPECT_NEAR(mechanism->inertia(phi).slope, inertia.slope, 1e-12);
  EXPECT_NEAR(mechanism->inertia_derivative(phi).value, inertia.slope, 1e-12);
  EXPECT_NEAR(mechanism->inertia_derivative(phi).slope, inertia.curvature, 1e-12);
  EXPECT_NEAR(mechanism->output_position(phi).value, slider.value, 1e-12);
  EXPECT_NEAR(mechanism->output_position(phi).slope, slider.slope, 1e-12);
  EXPECT_NEAR(mechanism->output_velocity(phi).value, slider.slope, 1e-12);
  EXPECT_NEAR(mechanism->output_velocity(phi).slope, slider.curvature, 1e-12);
  EXPECT_NEAR(mechanism->gravity_torque(phi).value, weight.value, 1e-10);
  EXPECT_NEAR(mechanism->gravity_torque(phi).slope, weight.slope, 1e-10);
}

TEST(ReducedMechanism, MillionTurnsAreAsGoodAsTheFirst) {
  const SliderCrankGeometry geometry(full_mechanism(1.2, 0.03));
  const auto mechanism = reduce_mechanism(geometry.data());
  std::mt19937 random(8);
  const Maxima maximum(geometry);
  for (const double turns : {-1.0, 1.0, 47.0, -1e4, 1e6, -1e6})
    for (int i = 0; i < 200; ++i) {
      const double phi = turns * 2 * std::numbers::pi + random_angle(random);
      const Truth truth(geometry, phi);
      for (int c = 0; c < channels; ++c)
        ASSERT_LE(std::fabs(mechanism->at(phi).value(static_cast<Channel>(c)) - truth.value[c]),
                  1e-12 * maximum.value[c]);
    }
}

TEST(ReducedMechanism, VanishingChannelsDoNotHauntTheTable) {
  SliderCrankData flywheel = reference_mechanism();  // nothing moves but the crank
  flywheel.rod_mass = flywheel.rod_inertia = flywheel.slider_mass = 0;
  SliderCrankData guided = reference_mechanism();  // all weight is carried by the guide
  guided.rod_mass = 0;
  guided.gravity = 9.80665;
  SliderCrankData heavy = full_mechanism(3.5, 0.03);  // a flywheel of 10⁵ times the moving inertia
  heavy.crank_inertia = 5000;
  for (const Extraction from : both) {
    for (const SliderCrankData& d : {flywheel, guided, heavy}) {
      const ReducedMechanism mechanism = extracted(d, from);
      EXPECT_TRUE(mechanism.report().converged);
      EXPECT_LE(mechanism.report().pieces, pieces_of(from, 40));
    }
    EXPECT_NEAR(extracted(guided, from).gravity_torque(1).value, 0, 1e-14);
    EXPECT_EQ(extracted(flywheel, from).inertia(1).slope, 0);
  }
}

TEST(ReducedMechanism, RandomMechanismsConverge) {
  std::mt19937 random(9);
  for (int i = 0; i < 50; ++i) {
    SliderCrankData d = random_mechanism(random);
    d.crank_inertia += 1e-3 * d.radius * d.radius;  // never all massless
    const ReducedMechanism mechanism = extracted(d, both[i % 2]);
    EXPECT_TRUE(mechanism.report().converged) << "mechanism " << i;
    const SliderCrankGeometry geometry(d);
    for (int k = 0; k < 200; ++k) {
      const double phi = random_angle(random), inertia = geometry.inertia(phi).value;
      ASSERT_NEAR(mechanism.inertia(phi).value / inertia, 1, 1e-12) << "mechanism " << i << " phi = " << phi;
    }
  }
}

TEST(ReducedMechanism, EqualDataShareOneTable) {
  SliderCrankData d = full_mechanism(2.5, 0);
  const auto first = reduce_mechanism(d);
  EXPECT_EQ(reduce_mechanism(d), first);
  EXPECT_NE(reduce_mechanism(d, 1e-9), first);
  d.slider_mass += 1e-9;
  EXPECT_NE(reduce_mechanism(d), first);
  d.crank_inertia = -1;
  EXPECT_THROW(reduce_mechanism(d), std::invalid_argument);
}

// Threads that request the same tables share them, those that request others do not wait for each other, and a failure
// reaches everyone who asked.
TEST(ReducedMechanism, ThreadsAskForTablesAllAtOnce) {
  constexpr int threads = 6;
  std::vector<std::shared_ptr<const ReducedMechanism>> made(threads);
  std::atomic<int> refused = 0;
  std::vector<std::thread> team;
  for (int k = 0; k < threads; ++k)
    team.emplace_back([&, k] {
      SliderCrankData data = reference_mechanism();
      data.radius *= 1.0001 + 1e-4 * (k % 2);
      made[static_cast<std::size_t>(k)] = reduce_mechanism(data);
      data.offset = data.radius + 1.1 * data.rod_length;  // beyond its reach
      try {
        reduce_mechanism(data);
      } catch (const std::exception&) {
        ++refused;
      }
    });
  for (std::thread& one : team) one.join();
  for (int k = 2; k < threads; ++k) EXPECT_EQ(made[static_cast<std::size_t>(k)], made[static_cast<std::size_t>(k % 2)]);
  EXPECT_NE(made[0], made[1]);
  EXPECT_EQ(refused, threads);
}

TEST(ReducedMechanism, WrongBranchReachesTheCaller) {
  const auto bodies = make_bodies(reference_mechanism());
  const auto wrong = [&](double phi) { return bodies->sample_from(phi, {std::numbers::pi - phi}); };
  EXPECT_THROW(ReducedMechanism(wrong, {}, 1e-9, 100), std::runtime_error);
}

TEST(ReducedMechanism, SaysWhenThePiecesDoNotSuffice) {
  const ReducedMechanism mechanism = extract_mechanism(full_mechanism(1.001, 0), table_tolerance, 40);
  EXPECT_FALSE(mechanism.report().converged);
  EXPECT_GT(mechanism.report().channels[ReducedMechanism::inertia_curvature].error, 1e-9);
}

}  // namespace
}  // namespace kurbel::reduced_mechanism_test
