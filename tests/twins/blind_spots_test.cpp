// blind_spots_test.cpp — closed forms where neither the gain is 1, nor all turns forwards, nor a neutral value hides
// what is asked about.
#include <fmt/format.h>

#include <complex>
#include <numbers>

#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "tests/mechanisms/slider_crank_statics.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/scenes.h"

namespace kurbel::blind_spots_test {
namespace {

using test::figure;
using test::run;
using test::scene_from;
constexpr double pi = std::numbers::pi;

std::size_t channel_of(const Result& r, const std::string& name) {
  const auto& channels = r.trajectory->channels();
  for (std::size_t k = 0; k < channels.size(); ++k)
    if (channels[k].name == name) return k;
  throw std::logic_error("no channel " + name);
}
double last_of(const Result& r, const std::string& name) {
  return r.trajectory->value(r.trajectory->time().size() - 1, channel_of(r, name));
}
std::string ending(const std::string& run) {
  return "\n[effects]\nelasticity = true\n[run]\naccuracy = 1e-8\nsamples = 41\n" + run;
}
std::string inertia(const std::string& name, double value) {
  return fmt::format("\n[{}]\nkind = \"inertia\"\ninertia = \"{} kg*m2\"\n", name, value);
}
const std::string gear_2_5 = "\n[gear]\nkind = \"gearbox\"\nstages = [{ teeth = [20, 50] }]\n";
const std::string gear_3 = "\n[gear]\nkind = \"gearbox\"\nstages = [{ teeth = [20, 60] }]\n";

// --- gears -----------------------------------------------------------------------------------------------------------

// ζ belongs to the two inertias that the coupling joins: J₂ counts by J₂/i².
TEST(BlindSpots, DampingRatioBelongsToTheInertiaReducedThroughTheGear) {
  const double stiffness = 900, own = 0.2, behind = 3 / (2.5 * 2.5);
  const Scene scene =
      scene_from("line = [\"a\", \"c\", \"gear\", \"b\"]" + inertia("a", own) + inertia("b", 3) + gear_2_5 +
                 "[c]\nkind = \"coupling\"\nstiffness = \"900 N*m/rad\"\ndamping_ratio = 0.07\n" +
                 ending("until = \"1 s\"\nstart = { speed = \"1 rad/s\" }"));
  const ModesStudy modes = find_modes(scene, scene.effects, {});
  ASSERT_EQ(modes.modes.size(), 1u);
  EXPECT_NEAR(modes.modes[0].omega, std::sqrt(stiffness * (1 / own + 1 / behind)), 1e-7);
  EXPECT_NEAR(modes.modes[0].ratio, 0.07, 1e-9);
}

// Two slider-cranks with nothing but their sliders' masses, the second one three times slower.
constexpr double radius = 0.1, rod = 0.35, fast_mass = 4, slow_mass = 60, fast_inertia = 0.05, slow_inertia = 0.9;
const std::string two_cranks = "line = [\"fast\", \"gear\", \"slow\"]" + gear_3 + R"(
[fast]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.05 kg*m2"
slider_mass = "4 kg"
[slow]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
crank_inertia = "0.9 kg*m2"
slider_mass = "60 kg"
phase = "0.5 rad"
)";
double slope_of_travel(double phi) {  // x′, x = r cos φ + √(l² − r² sin² φ)
  const double s = std::sin(phi), c = std::cos(phi);
  return -radius * s - radius * radius * s * c / std::sqrt(rod * rod - radius * radius * s * s);
}
double two_inertias(double phi) {
  const double fast = slope_of_travel(phi), slow = slope_of_travel(phi / 3 + 0.5);
  return fast_inertia + fast_mass * fast * fast + (slow_inertia + slow_mass * slow * slow) / 9;
}

// I_r = I₁(φ) + I₂(φ/i)/i²                                                                      (theory 2.1)
TEST(BlindSpots, SecondMechanismCountsByTheSquareOfItsRatio) {
  const MachineReduction r = reduce(scene_from(two_cranks + ending("start = { speed = \"20 rad/s\" }")),
                                    {.positions = 11, .to = "fast", .speed = 20.0, .orders = 3});
  EXPECT_NEAR(r.cycle, 6 * pi, 1e-12);
  for (const ReducedPosition& p : r.positions) {
    EXPECT_NEAR(p.inertia, two_inertias(p.phi), 1e-8) << p.phi;
    EXPECT_NEAR(p.slope, (two_inertias(p.phi + 1e-5) - two_inertias(p.phi - 1e-5)) / 2e-5, 1e-7) << p.phi;
  }
}

// Without torques I_r ω² is constant: ω_max, ω_min stand where I_r is least and greatest within three turns.
TEST(BlindSpots, FluctuationOfTwoGearedMechanismsIsThatOfTheWholeCycle) {
  const Result r = run(two_cranks + ending("until = \"5 s\"\nstart = { speed = \"20 rad/s\" }"), false);
  double least = HUGE_VAL, greatest = 0;
  for (int k = 0; k < 200000; ++k) {
    const double here = two_inertias(6 * pi * k / 200000);
    least = std::min(least, here), greatest = std::max(greatest, here);
  }
  const double fast = 1 / std::sqrt(least), slow = 1 / std::sqrt(greatest);
  EXPECT_NEAR(figure(r, "delta.fast"), 2 * (fast - slow) / (fast + slow), 1e-6);
}

// φ_crank = φ₀ + i ω t, and the slider with it.
TEST(BlindSpots, PrescribedSpeedBehindAGearMovesTheCrankByTheRatio) {
  const Result r = run("line = [\"crank\", \"gear\", \"drive\"]" + gear_2_5 + R"(
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
slider_mass = "4 kg"
[drive]
kind = "prescribed speed"
speed = "7 rad/s"
)" + ending("until = \"0.5 s\"\nstart = { angle = \"0.4 rad\" }"),
                       false);
  for (std::size_t row = 0; row < r.trajectory->time().size(); ++row) {
    const double t = r.trajectory->time()[row], phi = 0.4 + 2.5 * 7 * t;
    EXPECT_NEAR(r.trajectory->value(row, channel_of(r, "angle.crank")), phi, 1e-8);
    EXPECT_NEAR(r.trajectory->value(row, channel_of(r, "angle.drive")), phi / 2.5, 1e-8);
    EXPECT_NEAR(r.trajectory->value(row, channel_of(r, "position.crank")),
                radius * std::cos(phi) + std::sqrt(rod * rod - std::pow(radius * std::sin(phi), 2)), 1e-8);
  }
}

// Slip is the difference of the clutch's own two speeds, 0 while it is locked.
TEST(BlindSpots, SlipOfAClutchBehindAGearIsThatOfItsOwnSides) {
  const Result r =
      run("line = [\"a\", \"gear\", \"clutch\", \"b\"]" + inertia("a", 0.4) + inertia("b", 5) + gear_2_5 + R"(
[clutch]
kind = "clutch"
torque = "60 N*m"
static_torque = "80 N*m"
[push]
kind = "torque source"
on = "a"
torque = "50 N*m"
start = "0.2 s"
)" + ending("until = \"0.5 s\"\nstart = { speed = \"9 rad/s\", b = { speed = \"1 rad/s\" } }"),
          false);
  const auto at = [&](std::size_t row, const char* name) { return r.trajectory->value(row, channel_of(r, name)); };
  for (std::size_t row = 0; row < r.trajectory->time().size(); ++row)
    EXPECT_NEAR(at(row, "slip.clutch"), at(row, "speed.a") / 2.5 - at(row, "speed.b"), 1e-9);
  // J₁ i² on the clutch: 2.5 kg·m²; slips from 3.6 and 1 rad/s until both move alike.
  const double until_locked = (3.6 - 1) / (60 / 2.5 + 60 / 5.0);
  ASSERT_FALSE(r.events.empty());
  EXPECT_NEAR(r.events.front().t, until_locked, 1e-8);
  // 50 N·m then push through the gear: 125 N·m of which the load takes 2/3 = 83 > 80.
  EXPECT_NEAR(last_of(r, "torque.clutch"), 60, 1e-7);
}

// --- backwards -------------------------------------------------------------------------------------------------------

// It holds |τ| ≤ M_s either way, and slips with M_k.
TEST(BlindSpots, ClutchHoldsAndSlipsBackwardsAsForwards) {
  for (const double push : {79.0, 81.0, -79.0, -81.0}) {
    const Result r =
        run("line = [\"a\", \"clutch\", \"b\"]" + inertia("a", 0.3) + inertia("b", 0.9) +
                fmt::format("[clutch]\nkind = \"clutch\"\ntorque = \"40 N*m\"\nstatic_torque = \"60 N*m\"\n"
                            "[push]\nkind = \"torque source\"\non = \"a\"\ntorque = \"{} N*m\"\n",
                            push) +
                ending("until = \"0.1 s\"\nstart = { speed = \"0 rad/s\" }"),
            false);
    const bool holds = std::abs(push) < 80;
    const double carried = holds ? 0.75 * push : std::copysign(40, push);
    EXPECT_NEAR(figure(r, "final_speed.b"), carried / 0.9 * 0.1, 1e-8) << push;
    EXPECT_NEAR(last_of(r, "speed.a"), (push - carried) / 0.3 * 0.1, 1e-7) << push;
  }
}

// Pushed backwards, a freewheel's drag carries up to its own torque.
TEST(BlindSpots, FreewheelPushedWithinItsDragStaysTogether) {
  for (const double push : {-12.0, -16.0, 20.0}) {
    const Result r = run("line = [\"a\", \"wheel\", \"b\"]" + inertia("a", 0.3) + inertia("b", 0.9) +
                             fmt::format("[wheel]\nkind = \"one-way clutch\"\ndrag = \"10 N*m\"\n"
                                         "[push]\nkind = \"torque source\"\non = \"a\"\ntorque = \"{} N*m\"\n",
                                         push) +
                             ending("until = \"0.1 s\"\nstart = { speed = \"0 rad/s\" }"),
                         false);
    const double carried = push == -16 ? -10 : 0.75 * push;
    EXPECT_NEAR(figure(r, "final_speed.b"), carried / 0.9 * 0.1, 1e-8) << push;
    EXPECT_NEAR(last_of(r, "speed.a"), (push - carried) / 0.3 * 0.1, 1e-7) << push;
  }
}

// Force over the distance to the end, on the stroke towards it alone, edge by edge; its work is its area either way.
TEST(BlindSpots, PressWithOffsetWorksTowardsItsEndWhicheverWayItTurns) {
  const double e = 0.03, furthest = std::sqrt(std::pow(radius + rod, 2) - e * e);
  const auto profile = [](double d) {  // breakthrough 20, drop 5, nominal travel 60, rise 15 mm
    if (d < 0.015 || d > 0.06) return 0.0;
    return d < 0.02 ? (d - 0.015) / 0.005 : d < 0.045 ? 1.0 : (0.06 - d) / 0.015;
  };
  for (const double omega : {8.0, -8.0}) {
    const Result r = run(fmt::format(R"(
line = ["drive", "press"]
[drive]
kind = "prescribed speed"
speed = "{0} rad/s"
[press]
kind = "slider-crank"
radius = "100 mm"
rod = "350 mm"
offset = "30 mm"
slider_mass = "4 kg"
load = {{ kind = "press", nominal_force = "5 kN", nominal_travel = "60 mm", rise = "15 mm", breakthrough = "20 mm", drop = "5 mm" }}
[run]
accuracy = 1e-8
until = "{1:.17g} s"
samples = 400
start = {{ angle = "1.9 rad" }}
)",
                                     omega, 2 * pi / 8),
                         false);
    for (std::size_t row = 0; row < r.trajectory->time().size(); ++row) {
      const double phi = 1.9 + omega * r.trajectory->time()[row], side = radius * std::sin(phi) - e;
      const double x = radius * std::cos(phi) + std::sqrt(rod * rod - side * side);
      const double v =
          omega * (-radius * std::sin(phi) - side * radius * std::cos(phi) / std::sqrt(rod * rod - side * side));
      EXPECT_NEAR(r.trajectory->value(row, channel_of(r, "force.press")), v > 0 ? -5000 * profile(furthest - x) : 0,
                  5e-4)
          << phi;
    }
    EXPECT_NEAR(figure(r, "work.useful"), -5000 * (0.0025 + 0.025 + 0.0075), 1e-4);
  }
}

// --- what a set-up hid -----------------------------------------------------------------------------------------------

// All moments about the crank's axis, weights among them: M + Σ r × m g + x N + M_guide − y F + inertia forces = 0.
TEST(BlindSpots, MomentsOfAllForcesBalanceUnderGravity) {
  SliderCrankData d;
  d.radius = 0.1, d.rod_length = 0.35, d.offset = 0.03;
  d.crank_mass = 9, d.crank_com = 0.04, d.crank_inertia = 0.2;
  d.rod_mass = 5, d.rod_com = 0.12, d.rod_inertia = 0.06;
  d.slider_mass = 13;
  d.gravity = 9.81, d.stroke_angle = 0.6;
  SliderCrankJoints joints;
  joints.guide.com_x = 0.02, joints.guide.force_offset = 0.015;
  const SliderCrankStatics statics(d, joints);
  for (const double omega : {0.0, 17.0, -17.0})
    for (double phi = 0.1; phi < 6.3; phi += 0.7) {
      const double force = 800, alpha = 40;
      const SliderCrankForces f = statics.solve_frictionless({phi, omega, alpha, force, 0, false});
      const double ax = d.radius * std::cos(phi), ay = d.radius * std::sin(phi);
      const double bx = ax + std::sqrt(d.rod_length * d.rod_length - std::pow(ay - d.offset, 2)), by = d.offset;
      const double gx = -d.gravity * std::sin(d.stroke_angle), gy = -d.gravity * std::cos(d.stroke_angle);
      const auto weight = [&](double mass, double x, double y) { return mass * (x * gy - y * gx); };
      const double along = d.rod_com / d.rod_length;
      const double weights = weight(d.crank_mass, d.crank_com * std::cos(phi), d.crank_com * std::sin(phi)) +
                             weight(d.rod_mass, ax + along * (bx - ax), ay + along * (by - ay)) +
                             weight(d.slider_mass, bx + joints.guide.com_x, by);
      const double guide = bx * f.guide + f.guide_moment, load = -(by + joints.guide.force_offset) * force;
      EXPECT_NEAR(f.torque + weights + guide + load + f.shaking_moment, 0, 1e-9) << phi;
      EXPECT_NEAR(f.main_bearing.y + f.guide + (d.crank_mass + d.rod_mass + d.slider_mass) * gy + f.shaking_force.y, 0,
                  1e-9);
      EXPECT_NEAR(f.main_bearing.x + force + (d.crank_mass + d.rod_mass + d.slider_mass) * gx + f.shaking_force.x, 0,
                  1e-9);
    }
}

// Steady currents of the T circuit by phasors, each part of them, from breakdown down to no load.
TEST(BlindSpots, CurrentsOfTheTwoAxisMotorAreThoseOfItsCircuitPartByPart) {
  using Complex = std::complex<double>;
  const double frequency = 50, voltage = 400, rs = 0.7, rr = 0.5, xs = 1.1, xr = 1.3, xm = 31, pairs = 2;
  for (const double slip : {0.3, 0.03, 0.002}) {
    const double speed = (1 - slip) * 2 * pi * frequency / pairs;
    const Result r = run(fmt::format(R"(
line = ["motor", "drive"]
[motor]
kind = "induction motor"
voltage = "400 V"
frequency = "50 Hz"
pole_pairs = 2
stator_resistance = "0.7 Ohm"
rotor_resistance = "0.5 Ohm"
stator_reactance = "1.1 Ohm"
rotor_reactance = "1.3 Ohm"
magnetising_reactance = "31 Ohm"
inertia = "0.1 kg*m2"
[drive]
kind = "prescribed speed"
speed = "{:.17g} rad/s"
[run]
accuracy = 1e-8
samples = 5
until = "2.5 s"
)",
                                     speed),
                         false);
    const Complex j(0, 1), u = voltage / std::sqrt(3.0);
    const Complex magnetising = j * xm, rotor = rr / slip + j * xr;
    const Complex stator_current = u / (rs + j * xs + magnetising * rotor / (magnetising + rotor));
    const Complex rotor_current = -stator_current * magnetising / (magnetising + rotor);
    const double torque = 3 * pairs / (2 * pi * frequency) * std::norm(rotor_current) * rr / slip;
    EXPECT_NEAR(last_of(r, "torque.motor"), torque, 1e-6 * std::abs(torque) + 1e-5);
    std::vector<double> parts;
    for (std::size_t k = 0; k < r.trajectory->channels().size(); ++k)
      if (r.trajectory->channels()[k].unit == "A")
        parts.push_back(r.trajectory->value(r.trajectory->time().size() - 1, k) / std::sqrt(2.0));
    ASSERT_EQ(parts.size(), 4u);
    const double size = std::abs(stator_current);
    EXPECT_NEAR(parts[0], stator_current.real(), 1e-6 * size);
    EXPECT_NEAR(parts[1], stator_current.imag(), 1e-6 * size);
    EXPECT_NEAR(parts[2], rotor_current.real(), 1e-6 * size);
    EXPECT_NEAR(parts[3], rotor_current.imag(), 1e-6 * size);
  }
}

// Three free shafts with planets that spin: two coordinates, ω_r = (1 + z_s/z_r) ω_c − z_s/z_r ω_s,
// ω_p = ω_c − z_s/z_p (ω_s − ω_c).
TEST(BlindSpots, PlanetaryGearAcceleratesAllThreeShaftsByLagrange) {
  const double zs = 24, zr = 72, zp = 24, planets = 3, js = 0.03, jr = 0.6, jc = 0.25, jp = 0.004, mass = 1.8;
  const double distance = 0.5 * 0.004 * (zs + zp), sun_torque = 11, ring_torque = -17, carrier_torque = 23;
  const Result r = run(R"(
line = ["sun_push", "gear", "carrier_push"]
[gear]
kind = "planetary gear"
sun = 24
ring = 72
planets = 3
module = "4 mm"
sun_inertia = "0.03 kg*m2"
ring_inertia = "0.6 kg*m2"
carrier_inertia = "0.25 kg*m2"
planet_inertia = "0.004 kg*m2"
planet_mass = "1.8 kg"
[sun_push]
kind = "torque source"
torque = "11 N*m"
[carrier_push]
kind = "torque source"
torque = "23 N*m"
[ring_push]
kind = "torque source"
torque = "-17 N*m"
[[branch]]
from = "gear.ring"
line = ["ring_push"]
[run]
accuracy = 1e-8
samples = 5
until = "0.3 s"
)",
                       false);
  const double ring_s = -zs / zr, ring_c = 1 + zs / zr, planet_s = -zs / zp, planet_c = 1 + zs / zp;
  Eigen::Matrix2d m;
  m(0, 0) = js + jr * ring_s * ring_s + planets * jp * planet_s * planet_s;
  m(0, 1) = m(1, 0) = jr * ring_s * ring_c + planets * jp * planet_s * planet_c;
  m(1, 1) = jc + planets * mass * distance * distance + jr * ring_c * ring_c + planets * jp * planet_c * planet_c;
  const Eigen::Vector2d torque(sun_torque + ring_s * ring_torque, carrier_torque + ring_c * ring_torque);
  const Eigen::Vector2d speed = 0.3 * test::solved(m, torque);
  EXPECT_NEAR(last_of(r, "speed.sun_push"), speed[0], 1e-7);
  EXPECT_NEAR(last_of(r, "speed.carrier_push"), speed[1], 1e-7);
  EXPECT_NEAR(last_of(r, "speed.ring_push"), ring_s * speed[0] + ring_c * speed[1], 1e-7);
}

// M(ω) = M_c + (M_s − M_c) exp(−(ω/ω_s)ⁿ) + b ω with an exponent that is not 2, either way.
TEST(BlindSpots, StribeckFrictionFallsWithItsOwnExponent) {
  for (const double exponent : {0.7, 1.3, 3.1})
    for (const double speed : {1.1, -3.0}) {
      const Result r = run(fmt::format(R"(
line = ["drive", "bearing"]
[drive]
kind = "prescribed speed"
speed = "{} rad/s"
[bearing]
kind = "bearing"
torque = "9 N*m"
static_torque = "16 N*m"
stribeck_speed = "2 rad/s"
stribeck_exponent = {}
damping = "0.3 N*m*s/rad"
inertia = "0.1 kg*m2"
[run]
until = "0.1 s"
samples = 3
)",
                                       speed, exponent),
                           false);
      const double v = std::abs(speed), friction = 9 + 7 * std::exp(-std::pow(v / 2, exponent)) + 0.3 * v;
      EXPECT_NEAR(last_of(r, "torque.bearing"), -std::copysign(friction, speed), 1e-12);
    }
}

// Above 10 Hz a lasting amplitude counts by S_f = √(f/10 Hz) (DIN 740-2), below by itself; the mean torque is negative.
TEST(BlindSpots, VibratoryTorqueCountsMoreAboveTenHertz) {
  for (const double frequency : {4.0, 25.0}) {
    const double j1 = 0.3, j2 = 0.9, k = 2500, c = 4, amplitude = 30, w = 2 * pi * frequency;
    const Scene scene = scene_from("line = [\"a\", \"c\", \"b\"]" + inertia("a", j1) + inertia("b", j2) +
                                   fmt::format(R"(
[c]
kind = "coupling"
stiffness = "2500 N*m/rad"
damping = "4 N*m*s/rad"
vibratory_torque = "20 N*m"
nominal_torque = "50 N*m"
[shake]
kind = "torque source"
on = "a"
torque = "-21 N*m"
amplitude = "30 N*m"
frequency = "{} Hz"
[pull]
kind = "load"
on = "b"
torque = "-21 N*m"
acts = "always"
)",
                                               frequency) +
                                   ending("until = \"1 s\"\nstart = { speed = \"-30 rad/s\" }"));
    const ModesStudy modes = find_modes(scene, scene.effects, {});
    const double reduced = j1 * j2 / (j1 + j2);
    const std::complex<double> spring(k, w * c);
    const double swing = std::abs(spring * (amplitude / j1) / (spring / reduced - w * w));
    int found = 0;
    for (const Verdict& v : modes.verdicts) {
      if (v.requirement.starts_with("vibratory")) {
        EXPECT_NEAR(v.value, (frequency > 10 ? std::sqrt(frequency / 10) : 1) * swing, 1e-6 * swing);
        EXPECT_EQ(v.holds(), v.value <= 20);
        ++found;
      }
      if (v.requirement.starts_with("nominal")) {
        EXPECT_NEAR(v.value, 21, 1e-7);
        ++found;
      }
    }
    EXPECT_EQ(found, 2);
  }
}

}  // namespace
}  // namespace kurbel::blind_spots_test
