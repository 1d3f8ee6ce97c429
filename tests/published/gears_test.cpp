// gears_test.cpp — gear pairs and planetary trains against published cases: GE02, PL01 (tests/cases), KHK's tables.
#include <gtest/gtest.h>

#include <cmath>

#include "drivetrain/gears/gear_pair.h"
#include "drivetrain/gears/planetary.h"
#include "tests/support/validation.h"

namespace kurbel::gears_test {
namespace {

using test::Against;
using test::Validation;

constexpr double mm = 1e-3, degree = std::numbers::pi / 180, rel = 1e-6;

GearPairData pair_of(double module_mm, int z1, int z2) {
  GearPairData d;
  d.module = module_mm * mm;
  d.teeth = {z1, z2};
  return d;
}

// Least teeth of an external pinion whose involute the tip of a wheel u times as large does not foul, addendum h_a* (in
// modules) on the wheel: z₁ = 2 h_a*/(u [√(1 + (1/u)(1/u + 2) sin² α) − 1]).
double least_pinion_teeth(double ratio, double pressure_angle, double addendum = 1) {
  const double v = 1 / ratio;
  return 2 * addendum * v / (std::sqrt(1 + v * (v + 2) * std::pow(std::sin(pressure_angle), 2)) - 1);
}

// Sun and ring with simple planets: i₀ = −z_r/z_s.
PlanetaryTrain simple_planetary(int sun, int ring) { return {-static_cast<double>(ring) / sun}; }
// Sun – planet, second planet on the same shaft – ring: i₀ = −(z_p/z_s)(z_r/z_q).
PlanetaryTrain stepped_planetary(int sun, int planet, int second_planet, int ring) {
  return {-static_cast<double>(planet) / sun * ring / second_planet};
}
// Both central wheels external, planets between them (Ferguson's paradox): i₀ = z_r/z_s.
PlanetaryTrain idler_planetary(int first, int last) { return {static_cast<double>(last) / first}; }

// A planet that meshes with the sun: ω_p = ω_c − (ω_s − ω_c) z_s/z_p.
double planet_speed(int sun_teeth, int planet_teeth, double sun, double carrier) {
  return carrier - (sun - carrier) * sun_teeth / planet_teeth;
}

// Moment of inertia that a simple train with its ring held shows at the sun, planets with mass m at the distance a:
//   I = J_s + i_c² (J_c + n m a²) + n J_p i_p²,  i_c = z_s/(z_s + z_r),  i_p = ω_p/ω_s.
struct PlanetaryInertia {
  double sun, carrier, planet, planet_mass, planet_distance;  // [kg·m²], [kg], [m]
  int planets;
};
double reduced_to_sun(int sun, int planet, int ring, const PlanetaryInertia& j) {
  const double carrier = simple_planetary(sun, ring).carrier_speed(1, 0);
  const double own = planet_speed(sun, planet, 1, carrier);
  const double d = j.planet_distance * carrier;
  return j.sun + j.carrier * carrier * carrier + j.planets * (j.planet_mass * d * d + j.planet * own * own);
}

// --- GE02: Khurmi, Theory of Machines, ch. 12 ---

TEST(KhurmiGears, PathOfContactOfExample3) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 12 (toothed gearing), ex. 3");
  GearPairData d = pair_of(12, 30, 80);
  d.tip_diameter = {380 * mm, 980 * mm};  // addendum 10 mm
  const GearPair p = solve_gear_pair(d);
  is.close("path of approach", "mm", -p.start / mm, 27.2766164972, rel);
  is.close("path of recess", "mm", p.end / mm, 24.9816226063, rel);
  is.close("path of contact", "mm", (p.end - p.start) / mm, 52.2582391035, rel);
  is.close("arc of contact", "mm", ((p.end - p.start) / std::cos(20 * degree)) / mm, 55.6120564827, rel);
  is.close("contact ratio", "", p.contact_ratio, 1.4751556141, rel);
}

TEST(KhurmiGears, SlidingOfExamples4And5) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 12 (toothed gearing), ex. 4 and 5");
  const GearPair p = solve_gear_pair(pair_of(5, 20, 40));
  const double omega = 2000 * 2 * std::numbers::pi / 60;
  is.close("path of approach", "mm", -p.start / mm, 12.6464411853, rel);
  is.close("path of recess", "mm", p.end / mm, 11.4899782330, rel);
  is.close("contact ratio", "", p.contact_ratio, 1.6351859636, rel);
  is.close("sliding speed at the first contact, 2000 rpm", "mm/s", -p.sliding_speed(p.start, omega) / mm, 3972.9966722,
           rel);
  is.close("sliding speed at the last contact, 2000 rpm", "mm/s", p.sliding_speed(p.end, omega) / mm, 3609.6831207,
           rel);
  is.close("angle turned by the pinion in contact", "°", (p.end - p.start) / (0.5 * p.wheel[0].base_diameter) / degree,
           29.4333473, rel);
  is.close("sliding speed at the first contact, 1.2 m/s", "mm/s", -p.sliding_speed(p.start, 24) / mm, 455.2718827,
           rel);  // 1.2 m/s on the pitch circle
  const auto start = p.specific_sliding(p.start), end = p.specific_sliding(p.end);
  is.close("specific sliding of the pinion, first contact", "", start[0], -4.2584758781, rel);
  is.close("specific sliding of the wheel, first contact", "", start[1], 0.8098308287, rel);
  is.close("specific sliding of the pinion, last contact", "", end[0], 0.6028112396, rel);
  is.close("specific sliding of the wheel, last contact", "", end[1], -1.5176946069, rel);
}

TEST(KhurmiGears, SlidingOverRollingOfExample6) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 12 (toothed gearing), ex. 6");
  const GearPair p = solve_gear_pair(pair_of(6, 17, 49));
  // The pinion is slightly short of teeth: the path by the tips, as the book counts it.
  const double tip_2 =
      std::sqrt(std::pow(0.5 * p.wheel[1].tip_diameter, 2) - std::pow(0.5 * p.wheel[1].base_diameter, 2));
  const double start = p.limit_end - tip_2;
  is.close("contact ratio by the tips", "", (p.end - start) / p.base_pitch, 1.6329737649, rel);
  is.close("angle turned by the pinion in contact", "°", (p.end - start) / (0.5 * p.wheel[0].base_diameter) / degree,
           34.5806209, rel);
  const double pitch_speed = 0.5 * p.wheel[0].working_diameter;
  is.close("sliding over rolling speed, first contact", "", -p.sliding_speed(start, 1) / pitch_speed, 0.4095974542,
           rel);
  is.close("sliding over rolling speed, last contact", "", p.sliding_speed(p.end, 1) / pitch_speed, 0.3543154151, rel);
}

TEST(KhurmiGears, InternalPairOfExample7) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 12 (toothed gearing), ex. 7");
  GearPairData d = pair_of(4, 18, -72);
  d.tip_diameter = {(72 + 17) * mm, (288 - 7) * mm};  // addenda 8.5 and 3.5 mm
  const GearPair p = solve_gear_pair(d);
  is.close("path of approach", "mm", -p.start / mm, 11.4368660255, rel);
  is.close("path of recess", "mm", p.end / mm, 16.5984007412, rel);
  is.close("contact ratio", "", p.contact_ratio, 2.3741546907, rel);
}

TEST(KhurmiGears, LeastPinionTeethOfExample9) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 12 (toothed gearing), ex. 9");
  is.close("least teeth of a pinion, ratio 3", "", least_pinion_teeth(3, 20 * degree), 14.9808759138, rel);
  is.close("least teeth of a pinion, ratio 1", "", least_pinion_teeth(1, 20 * degree), 12.3231187260, rel);
}

TEST(KhurmiGears, GreatestAddendaOfExample11) {
  const Validation is(Against::published, "Khurmi, Gupta: Theory of Machines, ch. 12 (toothed gearing), ex. 11");
  GearPairData d = pair_of(6, 16, 28);
  d.rack.pressure_angle = 16 * degree;
  d.tip_diameter = {(96 + 2 * 4) * mm, (168 + 2 * 4) * mm};
  const GearPair p = solve_gear_pair(d);
  is.close("greatest addendum of the pinion", "mm",
           (0.5 * (p.wheel[0].greatest_tip_diameter - p.wheel[0].reference_diameter)) / mm, 10.7601599135, rel);
  is.close("greatest addendum of the wheel", "mm",
           (0.5 * (p.wheel[1].greatest_tip_diameter - p.wheel[1].reference_diameter)) / mm, 4.5647710409, rel);
}

TEST(Iso21771, HelicalPairWithShiftAndBacklash) {
  const Validation is(Against::published, "ISO 21771: helical pair of 31 and 30 teeth with shift and backlash");
  GearPairData d = pair_of(3.5, 31, 30);
  d.helix = 21 * degree;
  d.centre_distance = 116.5 * mm;
  d.backlash = 0.03 * mm;
  d.shift[0] = 0.291;
  const GearPair p = solve_gear_pair(d);
  is.close("reference centre distance", "mm", p.reference_centre_distance / mm, 114.3447280708, 1e-11);
  is.close("transverse pressure angle", "°", p.wheel[0].transverse_angle / degree, 21.2990642859, 1e-11);
  is.close("working transverse pressure angle", "°", p.working_angle / degree, 23.8707609654, 1e-11);
  is.close("involute of the transverse pressure angle", "", involute(p.wheel[0].transverse_angle), 0.0181260949, 1e-8);
  is.close("involute of the working pressure angle", "", involute(p.working_angle), 0.0259052382, 1e-8);
  is.close("sum of the profile shift coefficients", "", p.shift_sum, 0.651877131252, 1e-11);
  is.close("sum of the generating shift coefficients", "", p.wheel[0].generating_shift + p.wheel[1].generating_shift,
           0.639346541, 1e-9);
  is.close("normal backlash", "mm", p.backlash_normal / mm, 0.03, 1e-9);
}

// --- KHK, Gear Technical Reference (also SDP/SI, Handbook of Gears, T-33 ff. and T-42): profile shifted pairs ---

TEST(KhkTables, ShiftedSpurPair) {  // m 3, 12/24, x 0.6 and 0.36; bolsover.com gives the same table
  const Validation is(Against::published,
                      "KHK, Gear Technical Reference (also SDP/SI, Handbook of Gears, T-33 ff.): spur pair, module 3, "
                      "12 and 24 teeth, x = 0.6 and 0.36");
  GearPairData d = pair_of(3, 12, 24);
  d.shift = {0.6, 0.36};
  const GearPair p = solve_gear_pair(d);
  is.near("involute of the working pressure angle", "", involute(p.working_angle), 0.034316, 1e-6);
  is.near("working pressure angle", "°", p.working_angle / degree, 26.0886, 1e-4);
  is.near("centre distance", "mm", p.centre_distance / mm, 56.4999, 1e-4);
  is.near("working diameter of the pinion", "mm", p.wheel[0].working_diameter / mm, 37.667, 1e-3);
  is.near("working diameter of the wheel", "mm", p.wheel[1].working_diameter / mm, 75.333, 1e-3);
  is.near("base diameter of the pinion", "mm", p.wheel[0].base_diameter / mm, 33.8289, 1e-4);
  is.near("tip diameter of the pinion", "mm", p.wheel[0].tip_diameter / mm, 44.840, 1e-3);
  is.near("tip diameter of the wheel", "mm", p.wheel[1].tip_diameter / mm, 79.400, 1e-3);
  is.near("root diameter of the pinion", "mm", p.wheel[0].root_diameter / mm, 32.100, 1e-3);
  is.near("root diameter of the wheel", "mm", p.wheel[1].root_diameter / mm, 66.660, 1e-3);
  is.near("contact ratio", "", p.contact_ratio, 1.202, 1e-3);
}

TEST(KhkTables, ShiftedInternalPair) {  // m 3, 16/24; KHK counts the shift of the internal wheel the other way: +0.5
  const Validation is(Against::published,
                      "KHK, Gear Technical Reference (also SDP/SI, Handbook of Gears, T-33 ff.): internal pair, module "
                      "3, 16 and 24 teeth, shift of 0.5");
  GearPairData d = pair_of(3, 16, -24);
  d.shift = {0, -0.5};
  const GearPair p = solve_gear_pair(d);
  is.near("involute of the working pressure angle", "", involute(p.working_angle), 0.060401, 1e-5);
  is.near("working pressure angle", "°", p.working_angle / degree, 31.0937, 1e-3);
  is.near("centre distance", "mm", -p.centre_distance / mm, 13.1683, 1e-4);
  is.near("working diameter of the pinion", "mm", p.wheel[0].working_diameter / mm, 52.673, 1e-3);
  is.near("working diameter of the wheel", "mm", -p.wheel[1].working_diameter / mm, 79.010, 1e-3);
  is.near("tip diameter of the pinion", "mm", p.wheel[0].tip_diameter / mm, 54, 1e-9 / mm);
  is.near("tip diameter of the wheel", "mm", -p.wheel[1].tip_diameter / mm, 69, 1e-9 / mm);
  is.near("root diameter of the pinion", "mm", p.wheel[0].root_diameter / mm, 40.5, 1e-9 / mm);
  is.near("root diameter of the wheel", "mm", -p.wheel[1].root_diameter / mm, 82.5, 1e-9 / mm);
}

// --- PL01: Khurmi ch. 13 ---

TEST(PlanetaryTrain, WillisRatiosOfKhurmi) {
  const Validation is(
      Against::published,
      "Khurmi, Gupta: Theory of Machines, ch. 13 (gear trains): ex. 6 and 7, stepped planets, Ferguson's paradox");
  const PlanetaryTrain ex6 = simple_planetary(32, 72);
  is.close("ex. 6: speed of the sun", "rpm", ex6.sun_speed(0, 18), 58.5, 1e-12);
  is.close("ex. 6: speed of the planets", "rpm", planet_speed(32, 20, 58.5, 18), -46.8, 1e-12);
  const PlanetaryTrain ex7 = simple_planetary(40, 90);
  is.close("ex. 7: turns of the carrier, annulus turned by −½", "", ex7.carrier_speed(1, -0.5), -0.038461538461538464,
           1e-12);
  is.close("ex. 7: turns of the carrier, annulus held", "", ex7.carrier_speed(1, 0), 0.3076923076923077, 1e-12);
  is.close("stepped planets 50/20 and 35/105: speed of the carrier", "rpm",
           stepped_planetary(50, 20, 35, 105).carrier_speed(110, 0), 50, 1e-12);
  // Ferguson's paradox: wheel A (100) held.
  is.close("Ferguson: turns of the wheel of 101 teeth", "", idler_planetary(101, 100).sun_speed(0, 1),
           0.009900990099009901, 1e-9);
  is.close("Ferguson: turns of the wheel of 99 teeth", "", idler_planetary(99, 100).sun_speed(0, 1),
           -0.010101010101010102, 1e-9);
}

TEST(PlanetaryTrain, InertiaReducedToTheSun) {
  const Validation is(
      Against::closed_form,
      "Planetary train reduced to its sun, ring held: kinetic energy of sun, carrier and planets by Willis");
  is.close("speed of the carrier over that of the sun", "", simple_planetary(30, 80).carrier_speed(1, 0),
           0.2727272727272727, 1e-12);
  is.close("speed of the planets over that of the sun", "", planet_speed(30, 25, 1, 3.0 / 11), -0.6, 1e-12);
  const PlanetaryInertia j{.sun = 2e-4,
                           .carrier = 3e-3,
                           .planet = 5e-5,
                           .planet_mass = 0.15,
                           .planet_distance = 0.5 * 2 * mm * (30 + 25),
                           .planets = 3};
  // Each planet turns by its own absolute speed −0.6.
  is.close("reduced inertia", "kg·m²", reduced_to_sun(30, 25, 80, j), 5.783904958677685e-4, 1e-12);
}

}  // namespace
}  // namespace kurbel::gears_test
