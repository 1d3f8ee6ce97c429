// gears_test.cpp — gear pairs and planetary trains against published cases: GE02, PL01 (tests/cases), KHK's tables.
#include <gtest/gtest.h>

#include <cmath>

#include "drivetrain/gears/gear_pair.h"
#include "drivetrain/gears/planetary.h"

namespace kurbel {
namespace {

constexpr double mm = 1e-3, degree = std::numbers::pi / 180, rel = 1e-6;

void expect_relative(double found, double expected, double tolerance = rel) {
  EXPECT_NEAR(found, expected, tolerance * std::abs(expected));
}

GearPairData pair_of(double module_mm, int z1, int z2) {
  GearPairData d;
  d.module = module_mm * mm;
  d.teeth = {z1, z2};
  return d;
}

// --- GE02: Khurmi, Theory of Machines, ch. 12 ---

TEST(KhurmiGears, PathOfContactOfExample3) {
  GearPairData d = pair_of(12, 30, 80);
  d.tip_diameter = {380 * mm, 980 * mm};  // addendum 10 mm
  const GearPair p = solve_gear_pair(d);
  expect_relative(-p.start, 27.2766164972 * mm);
  expect_relative(p.end, 24.9816226063 * mm);
  expect_relative(p.end - p.start, 52.2582391035 * mm);
  expect_relative((p.end - p.start) / std::cos(20 * degree), 55.6120564827 * mm);
  expect_relative(p.contact_ratio, 1.4751556141);
}

TEST(KhurmiGears, SlidingOfExamples4And5) {
  const GearPair p = solve_gear_pair(pair_of(5, 20, 40));
  const double omega = 2000 * 2 * std::numbers::pi / 60;
  expect_relative(-p.start, 12.6464411853 * mm);
  expect_relative(p.end, 11.4899782330 * mm);
  expect_relative(p.contact_ratio, 1.6351859636);
  expect_relative(-p.sliding_speed(p.start, omega), 3972.9966722 * mm);
  expect_relative(p.sliding_speed(p.end, omega), 3609.6831207 * mm);
  expect_relative((p.end - p.start) / (0.5 * p.wheel[0].base_diameter) / degree, 29.4333473);
  expect_relative(-p.sliding_speed(p.start, 24), 455.2718827 * mm);  // 1.2 m/s on the pitch circle
  const auto start = p.specific_sliding(p.start), end = p.specific_sliding(p.end);
  expect_relative(start[0], -4.2584758781);
  expect_relative(start[1], 0.8098308287);
  expect_relative(end[0], 0.6028112396);
  expect_relative(end[1], -1.5176946069);
}

TEST(KhurmiGears, SlidingOverRollingOfExample6) {
  const GearPair p = solve_gear_pair(pair_of(6, 17, 49));
  // The pinion is slightly short of teeth: the path by the tips, as the book counts it.
  const double tip_2 =
      std::sqrt(std::pow(0.5 * p.wheel[1].tip_diameter, 2) - std::pow(0.5 * p.wheel[1].base_diameter, 2));
  const double start = p.limit_end - tip_2;
  expect_relative((p.end - start) / p.base_pitch, 1.6329737649);
  expect_relative((p.end - start) / (0.5 * p.wheel[0].base_diameter) / degree, 34.5806209);
  const double pitch_speed = 0.5 * p.wheel[0].working_diameter;
  expect_relative(-p.sliding_speed(start, 1) / pitch_speed, 0.4095974542);
  expect_relative(p.sliding_speed(p.end, 1) / pitch_speed, 0.3543154151);
}

TEST(KhurmiGears, InternalPairOfExample7) {
  GearPairData d = pair_of(4, 18, -72);
  d.tip_diameter = {(72 + 17) * mm, (288 - 7) * mm};  // addenda 8.5 and 3.5 mm
  const GearPair p = solve_gear_pair(d);
  expect_relative(-p.start, 11.4368660255 * mm);
  expect_relative(p.end, 16.5984007412 * mm);
  expect_relative(p.contact_ratio, 2.3741546907);
}

TEST(KhurmiGears, LeastPinionTeethOfExample9) {
  expect_relative(least_pinion_teeth(3, 20 * degree), 14.9808759138);
  expect_relative(least_pinion_teeth(1, 20 * degree), 12.3231187260);
}

TEST(KhurmiGears, GreatestAddendaOfExample11) {
  GearPairData d = pair_of(6, 16, 28);
  d.rack.pressure_angle = 16 * degree;
  d.tip_diameter = {(96 + 2 * 4) * mm, (168 + 2 * 4) * mm};
  const GearPair p = solve_gear_pair(d);
  expect_relative(0.5 * (p.wheel[0].greatest_tip_diameter - p.wheel[0].reference_diameter), 10.7601599135 * mm);
  expect_relative(0.5 * (p.wheel[1].greatest_tip_diameter - p.wheel[1].reference_diameter), 4.5647710409 * mm);
}

TEST(Iso21771, HelicalPairWithShiftAndBacklash) {
  GearPairData d = pair_of(3.5, 31, 30);
  d.helix = 21 * degree;
  d.centre_distance = 116.5 * mm;
  d.backlash = 0.03 * mm;
  d.shift[0] = 0.291;
  const GearPair p = solve_gear_pair(d);
  expect_relative(p.reference_centre_distance, 114.3447280708 * mm, 1e-11);
  expect_relative(p.wheel[0].transverse_angle / degree, 21.2990642859, 1e-11);
  expect_relative(p.working_angle / degree, 23.8707609654, 1e-11);
  expect_relative(involute(p.wheel[0].transverse_angle), 0.0181260949, 1e-8);
  expect_relative(involute(p.working_angle), 0.0259052382, 1e-8);
  expect_relative(p.shift_sum, 0.651877131252, 1e-11);
  expect_relative(p.wheel[0].generating_shift + p.wheel[1].generating_shift, 0.639346541, 1e-9);
  expect_relative(p.backlash_normal, 0.03 * mm, 1e-9);
}

// --- KHK, Gear Technical Reference (also SDP/SI, Handbook of Gears, T-33 ff. and T-42): profile shifted pairs ---

TEST(KhkTables, ShiftedSpurPair) {  // m 3, 12/24, x 0.6 and 0.36; bolsover.com gives the same table
  GearPairData d = pair_of(3, 12, 24);
  d.shift = {0.6, 0.36};
  const GearPair p = solve_gear_pair(d);
  EXPECT_NEAR(involute(p.working_angle), 0.034316, 1e-6);
  EXPECT_NEAR(p.working_angle / degree, 26.0886, 1e-4);
  EXPECT_NEAR(p.centre_distance, 56.4999 * mm, 1e-4 * mm);
  EXPECT_NEAR(p.wheel[0].working_diameter, 37.667 * mm, 1e-3 * mm);
  EXPECT_NEAR(p.wheel[1].working_diameter, 75.333 * mm, 1e-3 * mm);
  EXPECT_NEAR(p.wheel[0].base_diameter, 33.8289 * mm, 1e-4 * mm);
  EXPECT_NEAR(p.wheel[0].tip_diameter, 44.840 * mm, 1e-3 * mm);
  EXPECT_NEAR(p.wheel[1].tip_diameter, 79.400 * mm, 1e-3 * mm);
  EXPECT_NEAR(p.wheel[0].root_diameter, 32.100 * mm, 1e-3 * mm);
  EXPECT_NEAR(p.wheel[1].root_diameter, 66.660 * mm, 1e-3 * mm);
  EXPECT_NEAR(p.contact_ratio, 1.202, 1e-3);
}

TEST(KhkTables, ShiftedInternalPair) {  // m 3, 16/24; KHK counts the shift of the internal wheel the other way: +0.5
  GearPairData d = pair_of(3, 16, -24);
  d.shift = {0, -0.5};
  const GearPair p = solve_gear_pair(d);
  EXPECT_NEAR(involute(p.working_angle), 0.060401, 1e-5);
  EXPECT_NEAR(p.working_angle / degree, 31.0937, 1e-3);
  EXPECT_NEAR(-p.centre_distance, 13.1683 * mm, 1e-4 * mm);
  EXPECT_NEAR(p.wheel[0].working_diameter, 52.673 * mm, 1e-3 * mm);
  EXPECT_NEAR(-p.wheel[1].working_diameter, 79.010 * mm, 1e-3 * mm);
  EXPECT_NEAR(p.wheel[0].tip_diameter, 54 * mm, 1e-9);
  EXPECT_NEAR(-p.wheel[1].tip_diameter, 69 * mm, 1e-9);
  EXPECT_NEAR(p.wheel[0].root_diameter, 40.5 * mm, 1e-9);
  EXPECT_NEAR(-p.wheel[1].root_diameter, 82.5 * mm, 1e-9);
}

// --- PL01: Khurmi ch. 13 ---

TEST(PlanetaryTrain, WillisRatiosOfKhurmi) {
  const PlanetaryTrain ex6 = simple_planetary(32, 72);
  expect_relative(ex6.sun_speed(0, 18), 58.5, 1e-12);
  expect_relative(planet_speed(32, 20, 58.5, 18), -46.8, 1e-12);
  const PlanetaryTrain ex7 = simple_planetary(40, 90);
  expect_relative(ex7.carrier_speed(1, -0.5), -0.038461538461538464, 1e-12);
  expect_relative(ex7.carrier_speed(1, 0), 0.3076923076923077, 1e-12);
  expect_relative(stepped_planetary(50, 20, 35, 105).carrier_speed(110, 0), 50, 1e-12);
  // Ferguson's paradox: wheel A (100) held.
  expect_relative(idler_planetary(101, 100).sun_speed(0, 1), 0.009900990099009901, 1e-9);
  expect_relative(idler_planetary(99, 100).sun_speed(0, 1), -0.010101010101010102, 1e-9);
}

TEST(PlanetaryTrain, InertiaReducedToTheSun) {
  expect_relative(simple_planetary(30, 80).carrier_speed(1, 0), 0.2727272727272727, 1e-12);
  expect_relative(planet_speed(30, 25, 1, 3.0 / 11), -0.6, 1e-12);
  const PlanetaryInertia j{.sun = 2e-4,
                           .carrier = 3e-3,
                           .planet = 5e-5,
                           .planet_mass = 0.15,
                           .planet_distance = 0.5 * 2 * mm * (30 + 25),
                           .planets = 3};
  // Each planet turns by its own absolute speed −0.6.
  expect_relative(reduced_to_sun(30, 25, 80, j), 5.783904958677685e-4, 1e-12);
}

}  // namespace
}  // namespace kurbel
