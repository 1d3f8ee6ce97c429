// laws_by_data_test.cpp — what scenes' data become: friction faces, limiters, gear trains of several stages, motors at
// a part of their voltage, joints with a phase, wheels thinned for backlash; each against its closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drivetrain/couplings/rubber_coupling.h"
#include "drivetrain/couplings/universal_joint.h"
#include "drivetrain/gears/gear_pair.h"
#include "drivetrain/induction/catalogue_motor.h"
#include "drivetrain/induction/induction_circuit.h"
#include "drivetrain/induction/kloss.h"
#include "drivetrain/motors/dc_circuits.h"
#include "drivetrain/motors/governor.h"
#include "drivetrain/motors/motors.h"
#include "tests/support/scenes.h"

namespace kurbel::laws_by_data_test {
namespace {

using test::figure;
using test::run;
constexpr double degree = std::numbers::pi / 180;

// Uniform pressure p = F/(π (r_o² − r_i²)): M = n μ ∫ p r 2π r dr.
TEST(FrictionClutch, TorqueIsThatOfUniformPressureOnItsFaces) {
  const double outer = 0.12, inner = 0.05, force = 3000, mu = 0.28, plates = 4;
  double moment = 0;
  constexpr int rings = 20000;
  for (int i = 0; i < rings; ++i) {
    const double dr = (outer - inner) / rings, r = inner + (i + 0.5) * dr;
    moment +=
        plates * mu * force / (std::numbers::pi * (outer * outer - inner * inner)) * r * 2 * std::numbers::pi * r * dr;
  }
  const Result r = run(R"(
line = ["a", "clutch", "b"]
a = { kind = "inertia", inertia = "2 kg*m2" }
b = { kind = "inertia", inertia = "3 kg*m2" }
clutch = { kind = "clutch", force = "3 kN", plates = 4, friction_coefficient = 0.28, outer_radius = "120 mm", inner_radius = "50 mm" }
run = { until = "0.1 s", accuracy = 1e-9, start = { speed = "0 rad/s", a = { speed = "100 rad/s" } } }
)",
                       false);
  EXPECT_NEAR(figure(r, "final_speed.b"), moment * 0.1 / 3, 1e-7);
}

// Over its limit it slips with a part of it.
TEST(TorqueLimiter, SlipsWithItsPart) {
  for (const double push : {70.0, -70.0}) {
    const Result r = run(fmt::format(R"(
line = ["a", "limiter", "b"]
a = {{ kind = "torque source", torque = "{} N*m", inertia = "0.2 kg*m2" }}
b = {{ kind = "inertia", inertia = "0.6 kg*m2" }}
limiter = {{ kind = "torque limiter", torque = "50 N*m", slipping_part = 0.6 }}
run = {{ until = "0.1 s", accuracy = 1e-9 }}
)",
                                     push),
                         false);
    EXPECT_NEAR(figure(r, "final_speed.b"), std::copysign(30, push) * 0.1 / 0.6, 1e-8);
    EXPECT_NEAR(figure(r, "final_speed.a"), std::copysign(40, push) * 0.1 / 0.2, 1e-8);
  }
}

// One efficiency of two stages: i = i₁ i₂, M_out = i η M_in.
TEST(Gearbox, OfTwoStagesWithOneEfficiencyHasTheProductOfTheirRatios) {
  const Result r = run(R"(
line = ["drive", "gear", "fan"]
drive = { kind = "torque source", torque = "8 N*m", inertia = "0.05 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }, { teeth = [30, 45] }], efficiency = 0.9 }
fan = { kind = "load", damping = "3 N*m*s/rad", inertia = "0.2 kg*m2" }
effects = { gear_losses = true }
run = { until = "10 s", accuracy = 1e-9 }
)",
                       false);
  EXPECT_NEAR(figure(r, "final_speed.fan"), 8 * 3.75 * 0.9 / 3, 1e-7);
  EXPECT_NEAR(figure(r, "final_speed.drive"), 3.75 * 8 * 3.75 * 0.9 / 3, 1e-6);
}

// Kloss with a, at a part of the voltage its square; reversed its mirror image.
TEST(InductionMotor, AtAPartOfTheVoltageAndReversed) {
  const InductionMotor motor{120, 157, 0.18, 0.7, 50};
  for (const double omega : {-40.0, 20.0, 140.0, 170.0}) {
    const double s = (157 - omega) / 157;
    const double kloss = 2 * 120 * (1 + 0.7 * 0.18) / (s / 0.18 + 0.18 / s + 2 * 0.7 * 0.18);
    EXPECT_NEAR(motor.torque(ShaftState<double>{.rate = omega, .command = 0.6}), 0.36 * kloss, 1e-10);
    EXPECT_NEAR(motor.torque(ShaftState<double>{.rate = -omega, .command = -0.6}), -0.36 * kloss, 1e-10);
  }
}

// A motor by catalogue points, likewise; at its points it has their torques.
TEST(CatalogueMotor, AtAPartOfTheVoltageAndReversed) {
  const CataloguePoints points{.starting_torque = 90,
                               .pull_up = {{40, 70}},
                               .breakdown = {120, 150},
                               .rated = {148, 50},
                               .synchronous_speed = 157};
  const CatalogueMotor motor{points.curve(), 157, 50};
  for (const auto& [omega, torque] :
       {std::pair{0.0, 90.0}, {40.0, 70.0}, {120.0, 150.0}, {148.0, 50.0}, {157.0, 0.0}, {166.0, -50.0}})
    for (const double command : {0.6, -0.6}) {
      ShaftState<double> x{.rate = std::copysign(omega, command), .command = command};
      x.mode = motor.first_mode(x);
      EXPECT_NEAR(motor.torque(x), std::copysign(0.36, command) * torque, 1e-10) << omega;
    }
}

// A turning shunt motor begins with (c U − k ω)/R, or over R + R_b where it brakes.
TEST(DcShuntCircuit, BeginsWithTheCurrentOfItsPartOfTheVoltage) {
  const DcShuntCircuit motor{.line = {.voltage = 220, .resistance = 0.5, .constant = 1.4, .brake = {.resistance = 1.7}},
                             .inductance = 0.02};
  for (const double command : {0.6, -0.6}) {
    double current = 0;
    ShaftState<double> x{.rate = 70, .command = command, .own = &current};
    x.mode = motor.first_mode(x);
    motor.first_states(x, &current);
    EXPECT_NEAR(current, (command * 220 - 1.4 * 70) / (command > 0 ? 0.5 : 2.2), 1e-12);
  }
}

// Switched off the stator's current ceases, the rotor's flux L_m i_s + L_r i_r stays.
TEST(TwoAxisMotor, SwitchedOffKeepsTheFluxOfItsRotor) {
  const EquivalentCircuit circuit{220, 60, 2, 0.435, 0.816, 0.5, 1.9, 26.13};
  const TwoAxisMotor motor{circuit, circuit.characteristic()};
  const double before[4] = {30, -12, -25, 17};
  double own[4] = {30, -12, -25, 17};
  ShaftState<double> x{.rate = 100, .own = own};
  x.on = false;
  motor.switched(x, own);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(own[k], 0);
    EXPECT_NEAR(motor.rotor() * own[2 + k], motor.mutual() * before[k] + motor.rotor() * before[2 + k], 1e-12);
  }
}

// A damper in place of relaxing branches loses at ω_ref what they lose there, c + Σ k T/(1 + ω² T²); ω_ref given.
TEST(RubberCoupling, WithoutRelaxationIsDampedAtItsReferenceFrequency) {
  const CouplingData spring{4000, {Damping::As::viscous, 1.5, 70}};
  const StaticRubberData rubber{spring, {{900, 0.02}, {300, 0.15}}};
  const Coupling element = rubber.settled(0.3);
  EXPECT_DOUBLE_EQ(element.stiffness, 4000);
  EXPECT_NEAR(element.damping, 1.5 + 900 * 0.02 / (1 + 1.4 * 1.4) + 300 * 0.15 / (1 + 10.5 * 10.5), 1e-12);
}

// A turning series motor begins with (R + s κ ω) i = |c| U.
TEST(DcSeriesCircuit, BeginsWithTheCurrentOfItsPartOfTheVoltage) {
  const DcSeriesCircuit motor{.line = {.voltage = 200, .resistance = 0.8, .constant = 0.05, .max_speed = 500},
                              .inductance = 0.02};
  for (const double command : {0.6, -0.6}) {
    double current = 0;
    ShaftState<double> x{.rate = std::copysign(30, command), .command = command, .own = &current};
    x.mode = motor.first_mode(x);
    motor.first_states(x, &current);
    EXPECT_NEAR(current, 0.6 * 200 / (0.8 + 0.05 * 30), 1e-12);
  }
}

TEST(SpeedGovernor, IsRatedByItsLargerLimit) {
  EXPECT_DOUBLE_EQ((SpeedGovernor{.most = 40, .least = -90}.rated().torque), 90);
  EXPECT_DOUBLE_EQ((SpeedGovernor{.most = 40, .least = -10}.rated().torque), 40);
}

// tan φ₂ = tan φ₁/cos β with φ₁ = φ_a + phase, and φ_b = 0 at φ_a = 0: so it rests, without energy.
TEST(UniversalJoint, RestsWhereItsKinematicsSayWhateverItsPhase) {
  const double beta = 35 * degree, phase = 0.4;
  const UniversalJoint joint{.stiffness = 900, .joint = {beta}, .phase = phase};
  for (double turn = -1.1; turn < 1.1; turn += 0.2) {
    const double driven =
        std::atan(std::tan(turn + phase) / std::cos(beta)) - std::atan(std::tan(phase) / std::cos(beta));
    EXPECT_NEAR(turn - joint.rest_twist(turn), driven, 1e-12) << turn;
    EXPECT_NEAR(joint.energy(Twist<double>{.angle = joint.rest_twist(turn), .turn = turn}), 0, 1e-20);
    const double slope = std::cos(beta) / (1 - std::pow(std::sin(beta) * std::cos(turn + phase), 2));
    EXPECT_NEAR(joint.rest_ratio(turn), slope, 1e-12);
  }
}

// The rack stands deeper by j_bn/(4 m sin α_n) than the nominal shift says: that decides on undercut.
TEST(GearWheel, ThinnedForBacklashIsUndercutEarlier) {
  GearPairData d;
  d.module = 3e-3;
  d.teeth = {12, 40};
  const double least = solve_gear_pair(d).wheel[0].least_shift_generated();
  for (const double backlash : {0.0, 0.1}) {
    d.backlash = backlash * d.module;
    d.shift[0] = least + 0.05;
    EXPECT_EQ(solve_gear_pair(d).wheel[0].undercut, backlash / (4 * std::sin(20 * degree)) > 0.05);
  }
}

// ISO 21771: x_min = h_a* − z sin² α_t/(2 cos β), tan α_t = tan α_n/cos β; least_teeth is its inverse.
TEST(GearWheel, LeastShiftOfHelicalTeeth) {
  const BasicRack rack{.pressure_angle = 22 * degree, .addendum = 0.9};
  for (const double helix : {0.0, 18 * degree, -33 * degree}) {
    const double transverse = std::atan(std::tan(22 * degree) / std::cos(helix));
    const double least = 0.9 - 11 * std::pow(std::sin(transverse), 2) / (2 * std::cos(helix));
    EXPECT_NEAR(least_teeth(rack, helix, least), 11, 1e-9);
  }
}

// Teeth that advance by b tan β along the pitch cylinder overlap by that over the transverse pitch.
TEST(GearPair, OverlapIsTheAdvanceOfAToothOverItsPitch) {
  GearPairData d;
  d.module = 3e-3;
  d.teeth = {19, 53};
  d.helix = -25 * degree;
  d.width = {40e-3, 35e-3};
  const double pitch = std::numbers::pi * 3e-3 / std::cos(25 * degree);
  EXPECT_NEAR(solve_gear_pair(d).overlap_ratio, 35e-3 * std::tan(25 * degree) / pitch, 1e-12);
}

// ∫ r² dA of the sections, taken along their outline, ∮ (r²/4)(x dy − y dx): Simpson on each straight piece is exact.
TEST(GearWheel, InertiaIsThatOfItsDrawnOutline) {
  for (const int teeth : {6, 17, -60}) {
    GearPairData d;
    d.module = 5e-3;
    d.teeth = {teeth > 0 ? teeth : 20, teeth > 0 ? 40 : teeth};
    d.shift = {teeth == 6 ? 0.6 : 0.1, 0};
    d.width = {20e-3, 20e-3};
    d.bore = {8e-3, 0};
    const MeshedWheel w = solve_gear_pair(d).wheel[teeth > 0 ? 0 : 1];
    const std::vector<OutlinePoint> p = wheel_outline(w, 24);
    double section = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const OutlinePoint &a = p[i], &b = p[(i + 1) % p.size()];
      const auto squared = [](double x, double y) { return x * x + y * y; };
      const double middle = squared(0.5 * (a.x + b.x), 0.5 * (a.y + b.y));
      section += (a.x * b.y - b.x * a.y) / 4 * (squared(a.x, a.y) + 4 * middle + squared(b.x, b.y)) / 6;
    }
    const double disc = std::numbers::pi / 32 * std::pow(w.bore, 4);
    const double inertia = 7850 * 20e-3 * (teeth > 0 ? section - disc : disc - section);
    EXPECT_NEAR(w.inertia, inertia, 1e-9 * inertia) << teeth;
  }
}

TEST(GearVerdicts, SayWhichTipsAreTooThinForHardenedTeeth) {
  int thin = 0, thick = 0;
  for (double shift = 0; shift < 0.75; shift += 0.05) {
    GearPairData d;
    d.module = 3e-3;
    d.teeth = {16, 41};
    d.shift = {shift, 0};
    const GearPair p = solve_gear_pair(d);
    const double tip = p.wheel[0].tip_thickness() / d.module;
    int notes = 0;
    for (const GearVerdict& v : verdicts(p))
      notes +=
          v.finding == Finding::note && v.text.find("Tips of wheel 1") == 0 && v.text.find("hardened") != v.text.npos;
    EXPECT_EQ(notes, tip < 0.4 && tip >= 0.2) << tip;
    (tip < 0.4 ? thin : thick) += 1;
  }
  EXPECT_GT(thin, 0);
  EXPECT_GT(thick, 0);
}

}  // namespace
}  // namespace kurbel::laws_by_data_test
