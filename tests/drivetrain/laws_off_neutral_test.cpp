// laws_off_neutral_test.cpp — laws of drive elements where no ratio is 1, no offset 0, no exponent 1 or 2, and turned
// backwards, too: each against its closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/friction/belt.h"
#include "drivetrain/gears/bevel_worm.h"
#include "drivetrain/gears/gear_losses.h"
#include "drivetrain/gears/gear_mesh.h"
#include "drivetrain/gears/gear_pair.h"
#include "drivetrain/induction/induction_circuit.h"
#include "drivetrain/motors/dc_circuits.h"
#include "drivetrain/motors/governor.h"
#include "tests/support/elements.h"

namespace kurbel::laws_off_neutral_test {
namespace {

using test::figure;
using test::run;
constexpr double degree = std::numbers::pi / 180;

// --- motors and governors --------------------------------------------------------------------------------------------

// U = (R + κ ω) i, M = κ i²: at a part c of the voltage the current is that part, the torque its square.
TEST(DcSeriesMotor, AtAPartOfTheVoltageTakesThatPartOfTheCurrent) {
  const DcSeriesMotor motor{.voltage = 200, .resistance = 0.8, .constant = 0.05, .max_speed = 500};
  for (const double command : {0.6, 1.3, -0.6})
    for (const double omega : {-3.0, 0.0, 20.0, 90.0}) {
      const double sense = command < 0 ? -1 : 1, current = std::abs(command) * 200 / (0.8 + 0.05 * omega);
      const ShaftState<double> x{.rate = sense * omega, .command = command};
      EXPECT_NEAR(motor.torque(x), sense * 0.05 * current * current, 1e-9) << command << ' ' << omega;
    }
}

// Closed over R + R_b the armature's current is (c U − k ω)/(R + R_b).
TEST(BrakedShuntMotor, BrakesOverBothResistances) {
  const BrakedShuntMotor motor{.voltage = 220, .resistance = 0.5, .constant = 1.4, .brake = {.resistance = 1.7}};
  for (const double command : {0.0, -1.0, -0.4}) {
    ShaftState<double> x{.rate = 130, .command = command};
    x.mode = motor.first_mode(x);
    EXPECT_NEAR(motor.torque(x), 1.4 * (command * 220 - 1.4 * 130) / 2.2, 1e-10);
  }
}

// Droop alone: J ω̇ = K_p (ω_ref − ω)/(1 + K_p d) − M_L, so ω = ω∞ + (ω₀ − ω∞) e^{−t/T} with ω∞ = ω_ref − M_L (1/K_p +
// d) and T = J (1 + K_p d)/K_p.
TEST(SpeedGovernor, WithDroopAndWithoutIntegralSettlesExponentially) {
  const double kp = 12, droop = 0.05, inertia = 2, load = 30, until = 0.7;
  const Result r = run(R"(
line = ["drive"]
[drive]
kind = "governor"
speed = "50 rad/s"
proportional_gain = "12 N*m*s/rad"
droop = "0.05 rad/s/N/m"
max_torque = "1000 N*m"
min_torque = "-1000 N*m"
inertia = "2 kg*m2"
[load]
kind = "load"
on = "drive"
torque = "30 N*m"
acts = "always"
[run]
start = { speed = "44 rad/s" }
until = "0.7 s"
accuracy = 1e-9
)",
                       false);
  const double last = 50 - load * (1 / kp + droop), time = inertia * (1 + kp * droop) / kp;
  EXPECT_NEAR(figure(r, "final_speed.drive"), last + (44 - last) * std::exp(-until / time), 1e-7);
}

// A motor whose field is reversed is its own mirror image: steady currents at −ω, and the torque reversed.
TEST(TwoAxisMotor, ReversedStartsWithTheSteadyCurrentsOfItsMirrorImage) {
  const EquivalentCircuit circuit{220, 60, 2, 0.435, 0.816, 0.754, 0.95, 26.13};
  const TwoAxisMotor motor{circuit, circuit.characteristic()};
  for (const double command : {1.0, 0.7})
    for (const double omega : {-90.0, 40.0, 175.0, 230.0}) {
      double current[4], mirrored[4], rate[4];
      ShaftState<double> x{.rate = omega, .mode = 0, .command = command, .own = current};
      ShaftState<double> back{.rate = -omega, .mode = 1, .command = -command, .own = mirrored};
      motor.first_states(x, current);
      motor.first_states(back, mirrored);
      motor.rates(back, rate);
      for (const double r : rate) EXPECT_NEAR(r, 0, 1e-7) << omega;
      EXPECT_NEAR(motor.torque(back), -motor.torque(x), 1e-10 * std::abs(motor.torque(x))) << omega;
    }
}

// --- brakes, belts, gaps ---------------------------------------------------------------------------------------------

// At rest it holds up to M_s; once it slips it takes M_k.
TEST(FrictionBrake, HoldsItsStaticTorqueAndSlipsWithItsKineticOneEitherWay) {
  for (const double push : {69.0, 71.0, -69.0, -71.0}) {
    const Result r = run(fmt::format(R"(
line = ["drum"]
drum = {{ kind = "inertia", inertia = "0.4 kg*m2" }}
brake = {{ kind = "brake", on = "drum", torque = "50 N*m", static_torque = "70 N*m" }}
push = {{ kind = "torque source", on = "drum", torque = "{} N*m" }}
run = {{ until = "0.2 s", accuracy = 1e-9 }}
)",
                                     push),
                         false);
    const double net = std::abs(push) < 70 ? 0 : push - std::copysign(50, push);
    EXPECT_NEAR(figure(r, "final_speed.drum"), net * 0.2 / 0.4, 1e-8) << push;
  }
}

// Wound beyond its limit, a belt without damping stands at the limit: it slips on where it is wound further, and grips
// where it unwinds.
TEST(Belt, WoundToItsLimitSlipsOnOrGripsByTheSenseOfMotion) {
  const Belt belt{.stiffness = 400, .damping = 0, .limit = 50};
  for (const double side : {1.0, -1.0})
    for (const double rate : {3.0, -3.0}) {
      double slipped = 0;
      Twist<double> x{.angle = side * 0.2, .rate = side * rate, .own = &slipped};
      belt.first_states(x, &slipped);
      EXPECT_NEAR(slipped, side * (0.2 - 50.0 / 400), 1e-15);
      EXPECT_EQ(belt.first_mode(x), rate < 0 ? Belt::grips : side > 0 ? Belt::slips_ahead : Belt::slips_back);
    }
}

// τ = k pⁿ beyond half the gap: twist_at is its inverse, the energy its integral, the stiffness its slope.
TEST(Backlash, TwistEnergyAndStiffnessBelongToItsPower) {
  const Backlash contact{
      .law = ContactLaw::hunt_crossley, .stiffness = 5e5, .gap = 0.02, .exponent = 1.7, .twist_scale = 3e-3};
  for (const double torque : {7.0, 90.0, -40.0}) {
    const double twist = contact.twist_at(torque), h = 1e-7;
    EXPECT_NEAR(std::abs(twist), 0.01 + std::pow(std::abs(torque) / 5e5, 1 / 1.7), 1e-15);
    EXPECT_NEAR(contact.spring_torque(twist), torque, 1e-9);
    EXPECT_NEAR((contact.energy(twist + h) - contact.energy(twist - h)) / (2 * h), torque, 1e-6 * std::abs(torque));
  }
  const double at = 0.01 + 3e-3, h = 1e-8;
  EXPECT_NEAR(contact.stiffness_at_rest(), (contact.spring_torque(at + h) - contact.spring_torque(at - h)) / (2 * h),
              1e-4 * contact.stiffness_at_rest());
}

// In balance with a torque from the start on, Hunt and Crossley's flanks stay as they are.
TEST(Backlash, StartsInBalanceByItsPower) {
  const Result r = run(R"(
line = ["a", "c", "b"]
a = { kind = "torque source", torque = "90 N*m", inertia = "0.5 kg*m2" }
c = { kind = "coupling", stiffness = "500 kN*m/rad", backlash = "0.02 rad", contact = "Hunt-Crossley", contact_exponent = 1.7 }
b = { kind = "inertia", inertia = "1.3 kg*m2" }
effects = { elasticity = true }
run = { until = "0.1 s", accuracy = 1e-9, samples = 11, start = "equilibrium" }
)",
                       false);
  EXPECT_NEAR(figure(r, "peak_torque.c"), 90 * 1.3 / 1.8, 1e-6);
}

// --- gears -----------------------------------------------------------------------------------------------------------

// λ = η₂ (μ + b₂) where the output drives, λ = (μ + b₁)/η₁ where the input does; backwards mirrored.
TEST(GearEfficiency, LawIsThatOfBothDirectionsOfPower) {
  for (const double back : {0.7, -0.3}) {
    const GearEfficiency gear{0.92, back, 1.5, 2.5};
    const GearLoss law = gear.law();
    const auto lost = [&](int direction, int sign, double taken) {
      const GearLoss::Line& line = law.line(direction, sign);
      return line.slope * taken + line.offset;
    };
    for (const double passed : {20.0, 55.0}) {
      const double driving = (passed + 1.5) / 0.92, driven = back * (-passed + 2.5);
      EXPECT_NEAR(lost(1, 1, driving), driving - passed, 1e-12);
      EXPECT_NEAR(lost(1, -1, driven), driven + passed, 1e-12);
      EXPECT_NEAR(lost(-1, -1, -driving), -driving + passed, 1e-12);
      EXPECT_NEAR(lost(-1, 1, -driven), -driven - passed, 1e-12);
    }
  }
}

// The worm's thread moves by ω d₁/2 around and ω m z₁/2 along its axis.
TEST(WormPair, SlidingSpeedIsThatOfTheThread) {
  const WormPair worm{.starts = 3, .teeth = 40, .module = 5e-3, .worm_diameter = 0.05};
  EXPECT_NEAR(worm.sliding_speed(150), std::hypot(150 * 0.05 / 2, 150 * 5e-3 * 3 / 2), 1e-12);
}

// f(φ) = 1 + Σ a_n cos(n z φ + ψ_n): its slope, and E and its slope with the twist.
TEST(MeshVariation, HarmonicsHaveTheirOrdersAndPhases) {
  const MeshVariation variation{7, {{0.2, 0.9}, {0.1, -2.0}}};
  VaryingMesh<Coupling> mesh;
  static_cast<Coupling&>(mesh) = {.stiffness = 3000, .damping = 2};
  mesh.variation = variation;
  for (double phi = -1; phi < 1; phi += 0.13) {
    const double f = 1 + 0.2 * std::cos(7 * phi + 0.9) + 0.1 * std::cos(14 * phi - 2.0);
    const double slope = -7 * 0.2 * std::sin(7 * phi + 0.9) - 14 * 0.1 * std::sin(14 * phi - 2.0);
    EXPECT_NEAR(variation.factor(phi), f, 1e-13);
    EXPECT_NEAR(variation.slope(phi), slope, 1e-12);
    const Twist<double> x{.angle = 0.04, .rate = 1.5, .turn = phi};
    EXPECT_NEAR(mesh.torque(x), f * (3000 * 0.04 + 2 * 1.5), 1e-10);
    EXPECT_NEAR(mesh.energy(x), f * 0.5 * 3000 * 0.04 * 0.04, 1e-12);
    EXPECT_NEAR(mesh.turning_torque(x), -slope * 0.5 * 3000 * 0.04 * 0.04, 1e-11);
  }
}

// ISO 6336-1, method B: 1/c′_th by virtual teeth and shifts of both wheels, C_M = 0.8, C_B of the rack, cos β.
TEST(MeshStiffness, IsThatOfMethodBForShiftedHelicalWheelsOfAnyRack) {
  GearPairData d;
  d.module = 3e-3;
  d.teeth = {19, 53};
  d.shift = {0.45, 0.21};
  d.helix = 17 * degree;
  d.rack = {.pressure_angle = 23 * degree, .addendum = 0.95, .clearance = 0.3, .root_radius = 0.25};
  d.width = {30e-3, 28e-3};
  const GearPair p = solve_gear_pair(d);
  const double sin_base = std::sin(d.helix) * std::cos(23 * degree), cos2_base = 1 - sin_base * sin_base;
  const double z1 = 19 / (cos2_base * std::cos(d.helix)), z2 = 53 / (cos2_base * std::cos(d.helix));
  const double x1 = 0.45, x2 = 0.21;
  const double compliance = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1 - 0.00193 * x2 -
                            0.24188 * x2 / z2 + 0.00529 * x1 * x1 + 0.00182 * x2 * x2;
  const double rack = (1 + 0.5 * (1.2 - 1.25)) * (1 - 0.02 * (20 - 23));
  const MeshStiffness s = mesh_stiffness(p);
  EXPECT_NEAR(s.single, 1e9 / compliance * 0.8 * rack * std::cos(d.helix), 1e-9 * s.single);
  EXPECT_NEAR(s.mean, s.single * (0.75 * p.contact_ratio + 0.25), 1e-9 * s.mean);
  EXPECT_NEAR(s.torsional, s.mean * 28e-3 * std::pow(0.5 * p.wheel[0].base_diameter, 2), 1e-9 * s.torsional);
}

// Which wheel is called the first one is a matter of words: the path of contact is the same, undercut or not.
TEST(GearPair, UndercutOfEitherWheelShortensThePathOfContactAlike) {
  GearPairData d;
  d.module = 2e-3;
  d.teeth = {8, 31};
  d.shift = {0.1, -0.05};
  GearPairData swapped = d;
  swapped.teeth = {31, 8};
  swapped.shift = {-0.05, 0.1};
  const GearPair p = solve_gear_pair(d), q = solve_gear_pair(swapped);
  ASSERT_TRUE(p.wheel[0].undercut);
  ASSERT_GT(p.start, p.tip_start + 0.01 * d.module);  // it does shorten the path
  EXPECT_NEAR(q.end, -p.start, 1e-15);
  EXPECT_NEAR(q.start, -p.end, 1e-15);
  EXPECT_NEAR(q.contact_ratio, p.contact_ratio, 1e-12);
  EXPECT_NEAR(q.wheel[1].active_diameter, p.wheel[0].active_diameter, 1e-15);
}

TEST(GearVerdicts, CallAClearanceBelowATenthOfTheModuleSmall) {
  for (const double clearance : {0.05, 0.15}) {
    GearPairData d;
    d.module = 4e-3;
    d.teeth = {25, 60};
    d.rack = {.clearance = clearance, .root_radius = 0.05};
    int said = 0;
    for (const GearVerdict& v : verdicts(solve_gear_pair(d)))
      said += v.finding == Finding::warning && v.text.find("Clearance of the tip") == 0;
    EXPECT_EQ(said, clearance < 0.1 ? 2 : 0) << clearance;
  }
}

// --- behind a gear ---------------------------------------------------------------------------------------------------

// z_s + z_r = 98: while the sun stands, the carrier turns by z_r/(z_s + z_r) of the ring; where its gear losses are on
// a run-time relation ties both, and a coupling behind it begins unloaded.
TEST(PlanetaryGear, WithItsSunHeldStartsInItsUsualMotion) {
  for (const bool losses : {false, true}) {
    const Result r = run(fmt::format(R"(
line = ["drive", "gear", "soft", "load"]
drive = {{ kind = "inertia", inertia = "0.4 kg*m2" }}
gear = {{ kind = "planetary gear", sun = 24, ring = 74, in = "ring", out = "carrier", fixed = "sun", efficiency = 0.98, ring_inertia = "0.02 kg*m2", carrier_inertia = "0.03 kg*m2" }}
soft = {{ kind = "coupling", stiffness = "300 N*m/rad" }}
load = {{ kind = "inertia", inertia = "0.9 kg*m2" }}
effects = {{ elasticity = true, gear_losses = {} }}
run = {{ until = "0.1 s", samples = 3, start = {{ on = "load", speed = "3 rad/s", angle = "0.7 rad" }} }}
)",
                                     losses),
                         false);
    const double ratio = 98.0 / 74;
    const auto first = [&](const char* name) {
      const auto& channels = r.trajectory->channels();
      for (std::size_t k = 0; k < channels.size(); ++k)
        if (channels[k].name == name) return r.trajectory->value(0, k);
      return std::nan("");
    };
    EXPECT_NEAR(first("speed.load"), 3, 1e-12);
    EXPECT_NEAR(first("speed.gear.out"), 3, 1e-12);
    EXPECT_NEAR(first("speed.drive"), 3 * ratio, 1e-12);
    EXPECT_NEAR(first("angle.load"), 0.7, 1e-12);
    EXPECT_NEAR(first("angle.drive"), 0.7 * ratio, 1e-12);
  }
}

TEST(FluidCoupling, JacobianBehindAGearEqualsDifferences) {
  const std::string scene = R"(
line = ["drive", "gear", "fluid", "back", "load"]
drive = { kind = "inertia", inertia = "0.4 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }] }
fluid = { kind = "fluid coupling", diameter = "0.4 m", lambda = { over = "speed ratio", unit = ["1", "1"], points = [[0, 0.002], [0.5, 0.0016], [1, 0]] } }
back = { kind = "gearbox", stages = [{ teeth = [30, 45] }] }
load = { kind = "load", quadratic = "0.02 N*m*s2/rad2", inertia = "0.9 kg*m2" }
)";
  for (const auto& speeds : {std::vector<double>{100, 13}, {100, 31}, {-100, -13}, {20, 60}})
    test::expect_exact_jacobian(scene, 0.3, {0}, speeds);
}

}  // namespace
}  // namespace kurbel::laws_off_neutral_test
