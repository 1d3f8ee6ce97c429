// elements_test.cpp — every element type against the four demands: torques in balance, power = −dE/dt − loss, Jacobian
// equals differences (of the element's own formula), and its own closed form.
#include <cmath>
#include <random>

#include "drivetrain/couplings/coupling.h"
#include "drivetrain/induction/catalogue_motor.h"
#include "drivetrain/induction/kloss.h"
#include "drivetrain/induction/started_motor.h"
#include "drivetrain/loads/loads.h"
#include "drivetrain/motors/dc_series_motor.h"
#include "drivetrain/motors/engine_torque.h"
#include "drivetrain/motors/fluid_motors.h"
#include "drivetrain/motors/motors.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/elements/element_pool.h"
#include "tests/support/scenes.h"

namespace kurbel::elements_test {
namespace {

using test::figure;
using test::run;

std::mt19937 random_numbers(11);
double some(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_numbers); }

// ∂M/∂φ and ∂M/∂ω from dual numbers against central differences at random states with their own modes.
template <class E>
void expect_exact_derivatives(const E& element, double speed) {
  for (int i = 0; i < 200; ++i) {
    ShaftState<double> x{some(0, 2), some(-4, 4), some(-speed, speed), 0, 1};
    x.direction = x.rate > 0 ? 1 : -1;
    if constexpr (Guarded<E>) x.mode = element.first_mode(x);
    if constexpr (Timed<E>) x.mode = element.mode_at(x.t);
    const Dual<2> dual = element.torque(
        ShaftState<Dual<2>>{x.t, Dual<2>::input(x.angle, 0), Dual<2>::input(x.rate, 1), x.mode, x.direction});
    EXPECT_EQ(dual.value, element.torque(x));
    const auto difference = [&](double angle, double rate) {
      ShaftState<double> up = x, down = x;
      up.angle += angle;
      up.rate += rate;
      down.angle -= angle;
      down.rate -= rate;
      return (element.torque(up) - element.torque(down)) / 2;
    };
    const double h = 1e-5, scale = std::abs(dual.value) + 1;
    EXPECT_NEAR(dual.d[0], difference(h, 0) / h, 1e-6 * scale);
    EXPECT_NEAR(dual.d[1], difference(0, h * speed) / (h * speed), 1e-6 * scale / speed + 1e-7 * std::abs(dual.d[1]));
  }
}

CatalogueMotor motor_by_points() {
  const CataloguePoints points{.starting_torque = 210,
                               .pull_up = CataloguePoints::Point{40, 160},
                               .breakdown = {135, 290},
                               .rated = {153, 98},
                               .synchronous_speed = 157.08};
  return {points.curve(), points.synchronous_speed, 98};
}

TEST(ShaftElements, DerivativesAreExact) {
  expect_exact_derivatives(HarmonicTorque{Account::driving, 3, 2, 5, 0.3}, 100);
  expect_exact_derivatives(DcShuntMotor{60, 40, 0}, 100);
  expect_exact_derivatives(InductionMotor::from_catalogue(15e3, 152.9, 157.08, 3, 0.7, 0.9), 300);
  expect_exact_derivatives(DcSeriesMotor{220, 0.8, 0.02, 1e3, "motor"}, 100);
  const CatalogueMotor by_points = motor_by_points();
  expect_exact_derivatives(by_points, 200);
  const InductionMotor kloss = InductionMotor::from_catalogue(15e3, 152.9, 157.08, 3, 0, 1);
  for (const double limit : {100.0, HUGE_VAL}) {
    expect_exact_derivatives(StartedMotor<InductionMotor, StarDelta>{kloss, {2, 0, 0.5}, limit}, 200);
    expect_exact_derivatives(StartedMotor<CatalogueMotor, StarDelta>{by_points, {-1, 120, 0}, limit}, 200);
    expect_exact_derivatives(StartedMotor<CatalogueMotor, SoftStart>{by_points, {0.3, 1.5}, limit}, 200);
    expect_exact_derivatives(
        StartedMotor<CatalogueMotor, FrequencyConverter>{by_points, {1.5, 300, by_points.synchronous_speed}, limit},
        200);
  }
  const HydraulicMotor hydraulic{1e-5, 2e7, 1e-3, 0.9, 0.9, 2e6};
  expect_exact_derivatives(TorqueOverSpeed{Account::driving, hydraulic.curve(), 1}, 300);
  expect_exact_derivatives(PneumaticMotor{20, 60, 0.4}, 100);
  const Curve pressure({0, 1, 2.5, 5, 9}, {4e5, 2e6, 3e5, 1e5, 2e5}, Curve::Form::smooth, 4 * M_PI);
  expect_exact_derivatives(EngineTorque({pressure}, {}, {{0}, {3}, {7}}), 100);
  expect_exact_derivatives(EngineTorque({pressure}, {0.005, 0.04, 0.14, 1e5}, {{0}, {3}, {7}}), 100);
  expect_exact_derivatives(SpeedLoad{Account::useful, 0.3, 0.02}, 100);
  expect_exact_derivatives(OpposingLoad{Account::useful, 5, 0.3, 0.02, 0}, 100);
  expect_exact_derivatives(
      TorqueOverSpeed{Account::driving, Curve({-100, 0, 30, 100}, {4, 5, 9, 0}, Curve::Form::smooth), 1}, 100);
  expect_exact_derivatives(
      TorqueOverAngle{Account::driving, Curve({0, 1, 2.5, 5}, {4, -1, 3, 0}, Curve::Form::smooth, 2 * M_PI), -1}, 100);
  expect_exact_derivatives(TorqueOverTime{Account::driving, Curve({0, 1, 1.5}, {4, -1, 3}, Curve::Form::linear), 1},
                           100);
}

// Resistances never drive, in either direction and at any speed.
TEST(Loads, OnlyTakePower) {
  const OpposingLoad dry{Account::useful, 5, 0.3, 0.02, 0};
  const SpeedLoad smooth{Account::harmful, 0.3, 0.02};
  for (int i = 0; i < 200; ++i) {
    const double omega = some(-50, 50);
    EXPECT_LT(dry.torque(ShaftState<double>{0, 0, omega, 0, omega > 0 ? 1 : -1}) * omega, 0);
    EXPECT_LT(smooth.torque(ShaftState<double>{0, 0, omega, 0, 1}) * omega, 0);
    EXPECT_NEAR(smooth.torque(ShaftState<double>{0, 0, omega, 0, 1}), -(0.3 * omega + 0.02 * omega * std::abs(omega)),
                1e-12);
  }
}

// A pool's torques on both shafts take from the machine what the spring stores and the damper loses:
// Σ M ω = −dE/dt − c θ̇², dE/dt = k θ θ̇; and without a ratio they are equal and opposite.
TEST(Coupling, TorquesBalanceAndPowerIsStoredOrLost) {
  for (int i = 0; i < 100; ++i) {
    const double k = some(1e2, 1e6), c = some(0, 1e3), gain_a = some(0.2, 5), gain_b = some(0.2, 5);
    ConnectionPool<Coupling> pool;
    pool.place(Coupling{k, c},
               {.id = 0, .shaft_a = 0, .shaft_b = 1, .gain_a = gain_a, .gain_b = gain_b, .loss_account = 0});
    const double theta = some(-0.1, 0.1), speed[2] = {some(-50, 50), some(-50, 50)};
    double torque[2] = {0, 0}, inertia[2] = {0, 0}, rate = 0, transmitted = 0, spring = 0, work = 0;
    const Instant now{0, nullptr, &theta, speed, nullptr, nullptr, nullptr};
    Sums sums{torque, inertia, &rate, &transmitted, &spring, nullptr, nullptr, &work};
    pool.add(now, sums);
    EXPECT_NEAR(rate, gain_a * speed[0] - gain_b * speed[1], 1e-12 * 500);
    EXPECT_NEAR(torque[0] / gain_a, -torque[1] / gain_b, 1e-12 * std::abs(transmitted));
    const double power = torque[0] * speed[0] + torque[1] * speed[1];
    EXPECT_NEAR(power, -k * theta * rate - c * rate * rate,
                1e-11 * (std::abs(power) + std::abs(transmitted * speed[0])));
    EXPECT_NEAR(work, -c * rate * rate, 1e-9 * (c * rate * rate + std::abs(transmitted * rate)));
    EXPECT_NEAR(pool.energy(now), 0.5 * k * theta * theta, 1e-12 * k * theta * theta);
    EXPECT_GT(-torque[0] * transmitted, 0);  // positive τ brakes a …
    EXPECT_GT(torque[1] * transmitted, 0);   // … and drives b
  }
}

// Free decay between two inertias: with ζ the amplitude falls by e^(−2πζ/√(1−ζ²)) in each period.
TEST(Damping, RatioIsThatOfTheTwoMassOscillator) {
  for (const double zeta : {0.01, 0.05, 0.2}) {
    const Coupling coupling = CouplingData{5000, {Damping::As::ratio, zeta, 0}}.settled(1 / (1 / 0.3 + 1 / 1.2));
    const double reduced = 1 / (1 / 0.3 + 1 / 1.2);
    EXPECT_NEAR(coupling.damping / (2 * std::sqrt(5000 * reduced)), zeta, 1e-14);
  }
}

// ψ = energy lost in a cycle over greatest energy stored, at the reference frequency: ∮ c θ̇² dt = π c ω θ̂², E = ½ k θ̂².
TEST(Damping, RelativeDampingAndLossFactorAreEnergiesPerCycle) {
  const double k = 5000, omega = 100, psi = 0.8;
  const Coupling relative = CouplingData{k, {Damping::As::relative, psi, omega}}.settled(0.1);
  EXPECT_NEAR(M_PI * relative.damping * omega / (0.5 * k), psi, 1e-14);
  const Coupling loss = CouplingData{k, {Damping::As::loss_factor, psi / (2 * M_PI), omega}}.settled(0.1);
  EXPECT_NEAR(loss.damping, relative.damping, 1e-14);
}

// In a scene the ratio refers to the inertias joined when everything is elastic, whatever effects are on.
TEST(Damping, DoesNotDependOnTheOtherEffects) {
  const Scene scene = test::scene_file("scenes/crank_press.toml");
  Effects all, one;
  all.all_elastic = true;
  one.elastic = {"main_coupling"};
  const auto damping = [](const Model& m) {
    for (const Network::Joint& j : m.network.joints)
      if (j.component == "main_coupling" && j.element) return j.element->damping;
    return 0.0;
  };
  EXPECT_GT(damping(*compile(scene, all)), 0);
  EXPECT_EQ(damping(*compile(scene, all)), damping(*compile(scene, one)));
}

// Shaft of length L: k = G J_p/L, J = ρ J_p L (steel, 50 mm, 1 m: J_p = 6.1359e-7 m⁴, k = 48.658 kN·m/rad).
TEST(Shaft, StiffnessAndInertiaFromDimensions) {
  const auto model = compile(test::scene_from(R"(
line = ["a", "s", "b"]
[a]
kind = "inertia"
inertia = "1 kg*m2"
[s]
kind = "shaft"
length = "1 m"
diameter = "50 mm"
segments = 1
[b]
kind = "inertia"
inertia = "1 kg*m2"
[effects]
elasticity = true
)"),
                             Effects{true, {}});
  const double polar = M_PI / 32 * std::pow(0.05, 4);
  ASSERT_EQ(model->elastic.size(), 1u);
  EXPECT_NEAR(model->network.joints[static_cast<std::size_t>(model->elastic[0].joint)].element->stiffness,
              79.3e9 * polar, 1e-6);
  EXPECT_NEAR(model->shafts[0].inertia + model->shafts[1].inertia, 2 + 7850 * polar, 1e-12);
  EXPECT_NEAR(79.3e9 * polar, 48658, 1);
}

// Cut into n pieces the shaft has the same static stiffness: n springs of n k in series.
TEST(Shaft, SegmentsKeepTheStaticStiffness) {
  const std::string text = R"(
line = ["a", "s", "b"]
[a]
kind = "inertia"
inertia = "2 kg*m2"
[drive]
kind = "torque source"
torque = "30 N*m"
on = "a"
[s]
kind = "shaft"
stiffness = "10 kN*m/rad"
segments = 5
inertia = "1e-6 kg*m2"
damping_ratio = 0.1
[b]
kind = "inertia"
inertia = "4 kg*m2"
[effects]
elasticity = true
[run]
start = "equilibrium"
until = "0.01 s"
)";
  const Result r = run(text);
  const double transmitted = 30 * 4.0 / 6;
  EXPECT_NEAR(figure(r, "final_angle.a") - figure(r, "final_angle.b"), transmitted / 1e4, 1e-8);
}

// Kloss with catalogue data: rated torque at rated speed, breakdown torque at breakdown slip, M(s = 0) = 0; any a.
TEST(InductionMotor, PassesThroughItsCataloguePoints) {
  for (const double a : {0.0, 0.5, 1.2})
    for (const double nu : {2.0, 3.2}) {
      const double ws = 157.07963, wn = 152.4, power = 11e3;
      const auto motor = InductionMotor::from_catalogue(power, wn, ws, nu, a, 1);
      const auto torque = [&](double w) { return motor.torque(ShaftState<double>{0, 0, w, 0, 1}); };
      EXPECT_NEAR(torque(wn), power / wn, 1e-10 * power / wn);
      EXPECT_NEAR(torque(ws), 0, 1e-12);
      const double at_breakdown = torque(ws * (1 - motor.breakdown_slip));
      EXPECT_NEAR(at_breakdown, nu * power / wn, 1e-9 * at_breakdown);
      EXPECT_GT(at_breakdown, torque(ws * (1 - 0.9 * motor.breakdown_slip)));
      EXPECT_GT(at_breakdown, torque(ws * (1 - 1.1 * motor.breakdown_slip)));
      if (a == 0) {  // s_b = s_n (ν + √(ν² − 1))
        const double sn = (ws - wn) / ws;
        EXPECT_NEAR(motor.breakdown_slip, sn * (nu + std::sqrt(nu * nu - 1)), 1e-14);
      }
      const auto weak = InductionMotor::from_catalogue(power, wn, ws, nu, a, 0.8);
      EXPECT_NEAR(weak.torque(ShaftState<double>{0, 0, 100, 0, 1}) / torque(100), 0.64, 1e-12);
    }
}

// A motor gives power between standstill and its no-load speed, and takes it outside.
template <class E>
void expect_drives_between_standstill_and(const E& motor, double no_load, double highest) {
  for (int i = 0; i < 200; ++i) {
    ShaftState<double> x{0, 0, some(-0.3 * highest, highest), 0, 1};
    if constexpr (Guarded<E>) x.mode = motor.first_mode(x);
    EXPECT_EQ(motor.torque(x) * x.rate > 0, x.rate > 0 && x.rate < no_load) << x.rate;
  }
}
TEST(Motors, DriveBetweenStandstillAndTheirNoLoadSpeed) {
  expect_drives_between_standstill_and(DcShuntMotor{60, 40, 0}, 40, 100);
  expect_drives_between_standstill_and(DcSeriesMotor{220, 0.8, 0.02, 1e3, "motor"}, HUGE_VAL, 60);
  expect_drives_between_standstill_and(InductionMotor::from_catalogue(15e3, 152.9, 157.08, 3, 0.7, 0.9), 157.08, 400);
  expect_drives_between_standstill_and(motor_by_points(), 157.08, 400);
  expect_drives_between_standstill_and(
      StartedMotor<CatalogueMotor, StarDelta>{motor_by_points(), {2, 0, 0.5}, HUGE_VAL}, 157.08, 400);
  expect_drives_between_standstill_and(PneumaticMotor{20, 60, 0.4}, 60, 100);
  const HydraulicMotor hydraulic{1e-5, 2e7, 1e-3, 0.9, 0.9, 2e6};
  expect_drives_between_standstill_and(TorqueOverSpeed{Account::driving, hydraulic.curve(), 1}, 100, 300);
}

TEST(DcShuntMotor, IsTheStraightLineBetweenStallAndNoLoad) {
  const DcShuntMotor motor{60, 40, 0};
  EXPECT_EQ(motor.torque(ShaftState<double>{0, 0, 0, 0, 1}), 60);
  EXPECT_EQ(motor.torque(ShaftState<double>{0, 0, 40, 0, 1}), 0);
  EXPECT_EQ(motor.torque(ShaftState<double>{0, 0, 20, 0, 1}), 30);
}

// Ramp: J ω̇ = M t/T until T, then M: ω(2 T) = (½ + 1) M T/J. Sine: ω = M/(J 2πf) (1 − cos 2πf t).
TEST(TorqueSource, RampAndSineIntegrateToTheirClosedForms) {
  const std::string rotor =
      "line = [\"rotor\"]\n[rotor]\nkind = \"inertia\"\ninertia = \"2 kg*m2\"\n[drive]\nkind = \"torque source\"\non = "
      "\"rotor\"\n";
  const Result ramp = run(rotor + "torque = \"6 N*m\"\nramp = \"0.4 s\"\n[run]\nuntil = \"0.8 s\"\n");
  EXPECT_NEAR(figure(ramp, "final_speed.rotor"), 1.5 * 6 * 0.4 / 2, 1e-12);
  const Result sine =
      run(rotor + "amplitude = \"6 N*m\"\nfrequency = \"3 Hz\"\n[run]\nuntil = \"0.41 s\"\naccuracy = 1e-10\n");
  const double w = 6 * M_PI;
  EXPECT_NEAR(figure(sine, "final_speed.rotor"), 6 / (2 * w) * (1 - std::cos(w * 0.41)), 1e-10);
}

// A table over time may repeat; its knots are grid points, so each period does the same impulse.
TEST(TorqueSource, PeriodicTableRepeatsItsImpulse) {
  const Result r = run(R"(
line = ["rotor"]
[rotor]
kind = "inertia"
inertia = "2 kg*m2"
[drive]
kind = "torque source"
on = "rotor"
table = { over = "time", unit = ["ms", "N*m"], points = [[0, 0], [10, 8], [30, 0], [100, 0]], period = "100 ms" }
[run]
until = "1 s"
)");
  EXPECT_NEAR(figure(r, "final_speed.rotor"), 10 * (30e-3 * 8 / 2) / 2, 1e-12);
}

// A motor by table runs to where its characteristic meets the load: M(ω) = 60 − ω/2 against 0.1 ω.
TEST(TableMotor, SettlesWhereCharacteristicsMeet) {
  const Result r = run(R"(
line = ["turbine", "load"]
[turbine]
kind = "motor"
inertia = "0.1 kg*m2"
torque = { over = "speed", unit = ["rad/s", "N*m"], points = [[0, 60], [40, 40], [80, 20], [120, 0]] }
[load]
kind = "load"
damping = "0.1 N*m*s/rad"
[run]
until = "5 s"
accuracy = 1e-8
)");
  EXPECT_NEAR(figure(r, "final_speed.load"), 100, 1e-4);
}

// Every gear stage multiplies the speed by z₁/z₂ and reduces inertias by its square.
TEST(Gearbox, RatiosMultiply) {
  const Result r = run(R"(
line = ["drive", "gearbox", "load"]
[drive]
kind = "prescribed speed"
speed = "100 rad/s"
[gearbox]
kind = "gearbox"
stages = [{ teeth = [20, 50] }, { teeth = [15, 45] }]
[load]
kind = "inertia"
inertia = "1 kg*m2"
[run]
until = "0.1 s"
)");
  EXPECT_NEAR(figure(r, "final_speed.load"), 100 / 2.5 / 3, 1e-12);
  EXPECT_NEAR(figure(r, "final_angle.load"), 10 / 7.5, 1e-12);
}

// Two cylinders 180° apart on one rigid crank: sum of both reduced inertias, and a start at another angle mirrors them.
TEST(SeveralMechanisms, KeepTheirPhases) {
  const std::string crank =
      "kind = \"slider-crank\"\nradius = \"50 mm\"\nrod = \"170 mm\"\ncrank_inertia = \"0.02 kg*m2\"\nslider_mass = "
      "\"2 kg\"\n";
  const auto speed_after = [&](const std::string& angle, const std::string& phase1, const std::string& phase2) {
    return figure(run("line = [\"one\", \"two\"]\n[one]\n" + crank + "phase = \"" + phase1 + "\"\n[two]\n" + crank +
                      "phase = \"" + phase2 +
                      "\"\n[run]\nuntil = \"0.3 s\"\naccuracy = 1e-9\nstart = { speed = \"40 rad/s\", angle = \"" +
                      angle + "\" }\n"),
                  "final_speed.one");
  };
  const double reference = speed_after("10 deg", "0 deg", "120 deg");
  EXPECT_NEAR(speed_after("0 deg", "10 deg", "130 deg"), reference, 1e-7);
  EXPECT_NEAR(speed_after("10 deg", "120 deg", "0 deg"), reference, 1e-7);
  EXPECT_GT(std::abs(speed_after("10 deg", "0 deg", "0 deg") - reference), 1e-3);
}

}  // namespace
}  // namespace kurbel::elements_test
