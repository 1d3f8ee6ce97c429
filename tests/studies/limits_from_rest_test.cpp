// limits_from_rest_test.cpp — what a coupling carries on its way from rest and in steady motion, against DIN 740-2's
// own estimates on two masses; which speeds are barred; what is undecided.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/base/find_by.h"
#include "studies/limits/limits_findings.h"
#include "studies/limits/ratings.h"
#include "studies/modes/drive_limits.h"
#include "studies/modes/modes.h"
#include "tests/support/scenes.h"

namespace kurbel::limits_from_rest_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double own = 0.5, far = 1.5, stiffness = 2400;  // J_A, J_L, k: ω₀ = 80 rad/s

// A torque drives two masses against a fan that keeps them at 100 rad/s.
std::string fan(double torque, double damping, const std::string& limits, const std::string& further = "",
                const std::string& start = "") {
  return fmt::format(R"(
line = ["source", "k1", "disc"]
source = {{ kind = "torque source", torque = "{} N*m", inertia = "0.5 kg*m2" }}
k1 = {{ kind = "coupling", stiffness = "2400 N*m/rad", damping = "{} N*m*s/rad"{} }}
disc = {{ kind = "load", inertia = "1.5 kg*m2", quadratic = "{} N*m*s2/rad2" }}
{}
[effects]
elasticity = true
[run]
{}
until = "12 s"
)",
                     torque, damping, limits.empty() ? "" : ", " + limits, torque * 1e-4, further, start);
}

ModesStudy modes_of(const std::string& text, const ModesOptions& options = {}) {
  const Scene scene = test::scene_from(text);
  return find_modes(scene, scene.effects, options);
}

const Verdict& verdict_on(const ModesStudy& m, const std::string& what) {
  for (const Verdict& v : m.verdicts)
    if (v.assessed && v.requirement.starts_with(what)) return v;
  throw std::runtime_error("no verdict on " + what);
}

// Step response of the torque k θ + c θ̇ of two masses: 1 − e^{−ζωt} (cos ω_d t − ζ/√(1 − ζ²) sin ω_d t).
double shock_factor(double damping) {
  const double reduced = own * far / (own + far), omega = std::sqrt(stiffness / reduced);
  const double zeta = damping / (2 * reduced * omega), root = std::sqrt(1 - zeta * zeta);
  double most = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double x = 2 * pi * i / 20000;  // ω_d t
    most = std::max(most, 1 - std::exp(-zeta / root * x) * (std::cos(x) - zeta / root * std::sin(x)));
  }
  return most;
}

// --- start ---

// DIN 740-2: T_S = T_AS S_A J_L/(J_A + J_L), S_A = 1.6 … 2 by the damping. The fan has hardly begun to turn.
TEST(LimitsFromRest, StartShockIsThatOfTheTwoMassFormula) {
  for (const double damping : {0.5, 2.0, 6.0}) {
    const ModesStudy m = modes_of(fan(60, damping, "maximum_torque = \"100 N*m\""));
    const double factor = shock_factor(damping), expected = 60 * far / (own + far) * factor;
    EXPECT_GT(factor, 1.6);
    EXPECT_LT(factor, 2.0);
    const Verdict& v = verdict_on(m, "maximum");
    EXPECT_NEAR(v.value, expected, 2e-3 * expected) << damping;
    EXPECT_LT(v.known_error(), 1e-6 * expected);
    EXPECT_FALSE(v.bound);
    EXPECT_NE(v.note.find("scene's own start from rest"), std::string::npos) << v.note;
  }
}

// The scene begins at speed: the peak is that of a run-up from rest all the same, and it says so.
TEST(LimitsFromRest, PeakOfAStartAtSpeedIsThatOfTheRunUpFromRest) {
  const std::string limits = "maximum_torque = \"100 N*m\"";
  const ModesStudy rest = modes_of(fan(60, 2, limits)),
                   speed = modes_of(fan(60, 2, limits, "", "start = { speed = \"90 rad/s\", equilibrium = true }"));
  EXPECT_NEAR(verdict_on(speed, "maximum").value, verdict_on(rest, "maximum").value, 1e-5);
  EXPECT_NE(verdict_on(speed, "maximum").note.find("made for this purpose"), std::string::npos);
  EXPECT_EQ(verdict_on(rest, "maximum").note.find("made for this purpose"), std::string::npos);
}

// A blow of the operating sequence, long after the start: the load is thrown on at 3 s.
TEST(LimitsFromRest, SequenceOnTheWayToTheSteadyMotionCounts) {
  const ModesStudy m = modes_of(fan(60, 2, "maximum_torque = \"300 N*m\"", R"(
[thrown]
kind = "load"
on = "disc"
torque = "600 N*m"
acts = "against motion"
start = "3 s"
stop = "3.02 s"
)"));
  const Verdict& v = verdict_on(m, "maximum");
  EXPECT_GT(v.value, 150);
  const Result run = test::run(fan(60, 2, "", R"(
[thrown]
kind = "load"
on = "disc"
torque = "600 N*m"
acts = "against motion"
start = "3 s"
stop = "3.02 s"
)"));
  EXPECT_NEAR(v.value, std::abs(test::figure(run, "peak_torque.k1")), 1e-3);
}

// The operating sequence is part of the run-up and of the motion that it leads to: a brake that it releases is not on.
TEST(LimitsFromRest, BrakeThatTheSequenceReleasesIsReleased) {
  Scene scene = test::scene_file("tests/agreement/brake_released.toml");
  for (Section& s : scene.components)
    if (s.name == "coupling")
      for (const char* key : {"maximum_torque", "nominal_torque"})
        s.settings.push_back({.key = key, .at = s.at, .given = true, .number = 100, .sections = {}});
  const ModesStudy m = find_modes(scene, scene.effects, {});
  const Result run = test::run(scene, false);
  EXPECT_NEAR(verdict_on(m, "maximum").value, std::abs(test::figure(run, "peak_torque.coupling")), 1e-4);
  EXPECT_LT(verdict_on(m, "nominal").value, 15);  // 37 with the brake on
}

// A worm gear's losses, omitted by modes, number the network otherwise: the coupling is found by its name.
TEST(LimitsFromRest, CouplingIsItselfInTheMachineWithAllItsEffects) {
  Scene scene = test::scene_file("scenes/inclined_conveyor.toml");
  for (Section& s : scene.components)
    if (s.name == "claw_coupling")
      s.settings.push_back({.key = "maximum_torque", .at = s.at, .given = true, .number = 1e4, .sections = {}});
  const ModesStudy m = find_modes(scene, scene.effects, {});
  const Result run = test::run(scene, false);
  const double peak = std::abs(test::figure(run, "peak_torque.claw_coupling"));
  EXPECT_NEAR(verdict_on(m, "maximum").value, peak, 1e-5 * peak);
}

// DIN 740-2: S_t (T_N + S_z T_S); how much of T_N acts at the peak is within the error.
TEST(LimitsFromRest, StartFactorCountsOnWhatTheStartAddsAndTemperatureOnAll) {
  DriveLimits limits;
  limits.start_factor = 1.3, limits.temperature_factor = 1.4;
  const Estimate t = start_torque(limits, {-150, 1e-3}, {-60, 0});
  EXPECT_NEAR(t.value - *t.error, 1.4 * (60 + 1.3 * 90) - 1.4 * 1.3e-3, 1e-12);
  EXPECT_NEAR(t.value + *t.error, 1.4 * 1.3 * 150 + 1.4 * 1.3e-3, 1e-12);
  // A blow against the mean torque is all of the start's.
  const Estimate back = start_torque(limits, {150, 0}, {-60, 0});
  EXPECT_NEAR(back.value, 1.4 * 1.3 * 150, 1e-12);
  EXPECT_NEAR(*back.error, 0, 1e-12);
}

// --- resonance ---

std::string shaken_table(double mean, double vibratory) {
  std::string points;
  for (int k = 0; k < 72; ++k)
    points += fmt::format("[{}, {:.17g}], ", 5 * k, mean + vibratory * std::cos(5 * k * pi / 180));
  return fmt::format(
      "[shaker]\nkind = \"load\"\non = \"disc\"\nacts = \"always\"\n[shaker.table]\nover = \"angle\"\nunit = [\"deg\", "
      "\"N*m\"]\ninterpolation = \"smooth\"\npoints = [{}]\n",
      points);
}

// The resonance at 80 rad/s is run through: more than the shock of the start, less than the steady amplitude at it.
TEST(LimitsFromRest, ResonanceRunThroughStaysBelowTheSteadyAmplitudeAtIt) {
  const std::string text = fan(60, 1, "maximum_torque = \"150 N*m\"", shaken_table(0, 20));
  const ModesStudy m = modes_of(text, {.fastest = 120});
  const Verdict& v = verdict_on(m, "maximum");
  double bound = 0;
  for (const SpeedResponse& s : m.sweep) bound = std::max(bound, load_of(s.joints[0]).largest().value);
  EXPECT_FALSE(v.bound);
  EXPECT_LT(v.value, 0.8 * bound);
  EXPECT_GT(v.value, 60 * far / (own + far) * shock_factor(1));
  const Result run = test::run(text);
  EXPECT_NEAR(v.value, std::abs(test::figure(run, "peak_torque.k1")), 1e-4 * v.value);
}

// A speed that is prescribed has no start: a bound can show that a limit holds, never that it is exceeded.
TEST(LimitsFromRest, BoundHoldsOrIsNotAssessedNeverExceeded) {
  Verdict v;
  v.value = 100, v.bound = true;
  for (const double limit : {99.0, 101.0}) {
    v.limit = limit;
    EXPECT_EQ(v.state(), limit > 100 ? Compliance::holds : Compliance::not_assessed);
  }
  v.value = HUGE_VAL;
  EXPECT_EQ(v.state(), Compliance::not_assessed);
  v.bound = false;
  EXPECT_EQ(v.state(), Compliance::exceeded);
}

TEST(LimitsFromRest, VerdictIsUndecidedWhereItsLimitLiesWithinTheError) {
  Verdict v;
  v.value = 100, v.error = 2;
  for (const auto& [limit, state] : {std::pair{97.9, Compliance::exceeded}, std::pair{98.1, Compliance::undecided},
                                     std::pair{101.9, Compliance::undecided}, std::pair{102.1, Compliance::holds}}) {
    v.limit = limit;
    EXPECT_EQ(v.state(), state) << limit;
    EXPECT_EQ(v.holds(), state == Compliance::holds);
  }
  v.error = std::nan("");
  EXPECT_EQ(v.state(), Compliance::undecided);
}

// --- the alternating part ---

// DIN 740-2: T_W = T_Ai V_f J_L/(J_A + J_L), V_f² = (1 + (ψ/2π)²)/((1 − (f/f_e)²)² + (ψ/2π)²); P_W = ½ c (ω θ)².
TEST(LimitsInSteadyMotion, AlternatingTorqueIsTheAmplificationOfTheStandard) {
  constexpr double damping = 3, amplitude = 10, temperature = 1.2;
  for (const double ratio : {0.5, 1.0, 1.4}) {
    const double natural = 80 / (2 * pi), f = ratio * natural;
    const std::string text = fmt::format(R"(
line = ["source", "k1", "disc"]
source = {{ kind = "torque source", torque = "40 N*m", amplitude = "{} N*m", frequency = "{} Hz", inertia = "0.5 kg*m2" }}
k1 = {{ kind = "coupling", stiffness = "2400 N*m/rad", damping = "{} N*m*s/rad", vibratory_torque = "50 N*m", nominal_torque = "50 N*m", dissipated_power = "50 W", temperature_factor = {} }}
disc = {{ kind = "load", inertia = "1.5 kg*m2", torque = "40 N*m", acts = "against motion" }}
effects = {{ elasticity = true }}
run = {{ start = {{ speed = "100 rad/s", equilibrium = true }} }}
)",
                                         amplitude, f, damping, temperature);
    const ModesStudy m = modes_of(text);
    const double psi = damping * 2 * pi * f / stiffness;  // ψ/2π
    const double v = std::sqrt((1 + psi * psi) / (std::pow(1 - ratio * ratio, 2) + psi * psi));
    const double vibratory = amplitude * far / (own + far) * v;
    const double factor = f > 10 ? std::sqrt(f / 10) : 1;
    EXPECT_NEAR(verdict_on(m, "vibratory").value, temperature * factor * vibratory, 1e-6 * vibratory) << ratio;
    EXPECT_NEAR(verdict_on(m, "nominal").value, temperature * 40, 1e-6);
    const double twist = vibratory / std::hypot(stiffness, damping * 2 * pi * f);
    EXPECT_NEAR(verdict_on(m, "dissipated").value, 0.5 * damping * std::pow(2 * pi * f * twist, 2), 1e-4) << ratio;
  }
}

// Shear stress by the largest torque, of the run-up where that is larger.
TEST(LimitsFromRest, ShearStressIsThatOfTheStart) {
  const ModesStudy m = modes_of(R"(
line = ["source", "shaft", "disc"]
source = { kind = "torque source", torque = "300 N*m", inertia = "0.5 kg*m2" }
shaft = { kind = "shaft", length = "1 m", diameter = "40 mm", inertia = "0 kg*m2", damping_ratio = 0.02, allowable_shear_stress = "30 MPa", application_factor = 1.2 }
disc = { kind = "load", damping = "30 N*m*s/rad", inertia = "1.5 kg*m2" }
effects = { elasticity = true }
)");
  const Verdict& v = verdict_on(m, "shear");
  const double modulus = pi / 16 * std::pow(0.04, 3);
  EXPECT_GT(v.value, 1.2 * 300 / modulus);                    // by the steady motion
  EXPECT_LT(v.value, 2 * 300 * far / (own + far) / modulus);  // undamped start
  EXPECT_EQ(v.state(), Compliance::exceeded);
}

// --- barred ranges ---

LimitedJoint joint_of(const DriveLimits& limits, double rated = 40, bool has_play = false) {
  LimitedJoint joint{.name = "k1", .component = "k1"};
  joint.rated = rated, joint.has_play = has_play, joint.limits = limits;
  return joint;
}
// Mean and a resonance curve of width 5 around 80 rad/s, no vibration far from it.
std::vector<SpeedLoads> resonance(double mean, double vibratory) {
  std::vector<SpeedLoads> sweep;
  for (int i = 10; i <= 150; ++i) {
    JointLoad load;
    load.mean.value = mean;
    load.vibratory.value = load.weighted.value = vibratory / (1 + std::pow((i - 80) / 5.0, 2));
    load.upper.value = mean + load.vibratory.value, load.lower.value = mean - load.vibratory.value;
    sweep.push_back({static_cast<double>(i), {load}});
  }
  return sweep;
}

// Without limits the rated torque is the reference that does not vanish: no mean bars what a larger one does not.
TEST(BarredRanges, RuleDoesNotBreakWhereTheMeanTorqueVanishes) {
  const std::vector<LimitedJoint> joint = {joint_of({})};
  EXPECT_TRUE(barred_ranges(joint, resonance(0, 39), 1).empty());
  for (const double mean : {0.0, 1e-9, -1e-3, 5.0, -39.0}) {
    const auto ranges = barred_ranges(joint, resonance(mean, 80), 1);
    ASSERT_EQ(ranges.size(), 1u) << mean;
    EXPECT_NEAR(ranges[0].from, 75, 0.01);  // half of the peak
    EXPECT_NEAR(ranges[0].to, 85, 0.01);
    EXPECT_EQ(ranges[0].by, BarredRange::By::rule);
    EXPECT_FALSE(ranges[0].everywhere);
  }
  EXPECT_TRUE(barred_ranges(joint, resonance(81, 80), 1).empty());
}

TEST(BarredRanges, JointBeyondItsLimitEverywhereIsBarredEverywhereAndReported) {
  DriveLimits limits;
  limits.maximum = 30;
  const std::vector<LimitedJoint> joints = {joint_of(limits)};
  const auto ranges = barred_ranges(joints, resonance(-29.9, 30), 1);  // 30/197 at the far end
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_TRUE(ranges[0].everywhere);
  EXPECT_EQ(ranges[0].from, 10);
  EXPECT_EQ(ranges[0].to, 150);
  EXPECT_EQ(ranges[0].reason, "maximum_torque");
  const auto notes = limits_notes({}, ranges, joints, {}, {});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("at every speed examined"), std::string::npos);
  EXPECT_NE(barred_claim(ranges, joints, {})->text.find("every speed"), std::string::npos);
}

// A frequency of its own excites, no order does: the coupling is barred at every speed all the same.
TEST(BarredRanges, OscillationAtAFrequencyOfItsOwnIsBarredAtEverySpeed) {
  const ModesStudy m = modes_of(R"(
line = ["source", "k1", "disc"]
source = { kind = "torque source", torque = "40 N*m", amplitude = "30 N*m", frequency = "12 Hz", inertia = "0.5 kg*m2" }
k1 = { kind = "coupling", stiffness = "2400 N*m/rad", damping = "6 N*m*s/rad", vibratory_torque = "20 N*m" }
disc = { kind = "load", inertia = "1.5 kg*m2", damping = "0.4 N*m*s/rad" }
effects = { elasticity = true }
)");
  ASSERT_EQ(m.barred.size(), 1u);
  EXPECT_TRUE(m.barred[0].everywhere);
  EXPECT_EQ(m.barred[0].reason, "vibratory_torque");
  EXPECT_TRUE(std::any_of(m.notes.begin(), m.notes.end(),
                          [](const std::string& n) { return n.find("at every speed examined") != n.npos; }));
}

// Each limit bars alone: upper, lower, alternating, stress, heat; and where all are given, the one used most.
TEST(BarredRanges, EveryLimitBars) {
  const auto bars = [](const DriveLimits& limits, double mean, double vibratory) {
    const auto ranges = barred_ranges({joint_of(limits)}, resonance(mean, vibratory), 1);
    return ranges.empty() ? std::string() : ranges[0].reason;
  };
  DriveLimits maximum, vibratory, shear;
  maximum.maximum = vibratory.vibratory = 50;
  shear.shear_stress = 5e6, shear.polar_modulus = 1e-5;
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(bars(maximum, sign * 30, 21), "maximum_torque");
    EXPECT_EQ(bars(shear, sign * 30, 21), "allowable_shear_stress");
    EXPECT_EQ(bars(vibratory, sign * 300, 51), "vibratory_torque");
    EXPECT_EQ(bars(maximum, sign * 30, 19), "");
    EXPECT_EQ(bars(vibratory, sign * 300, 49), "");
  }
  DriveLimits both = maximum;
  both.vibratory = 10;
  EXPECT_EQ(bars(both, 20, 40), "vibratory_torque");  // 4 times, 1.2 times
  DriveLimits heat;
  heat.power = 10;
  std::vector<SpeedLoads> sweep = resonance(20, 40);
  for (SpeedLoads& s : sweep)
    s.joints[0].power.value = std::pow(s.joints[0].vibratory.value, 2) / 40;  // 40 W at the peak
  const auto hot = barred_ranges({joint_of(heat)}, sweep, 1);
  ASSERT_EQ(hot.size(), 1u);
  EXPECT_EQ(hot[0].reason, "dissipated_power");
  EXPECT_NEAR(hot[0].limit, 20, 1e-9);  // the swing that makes 10 W
  EXPECT_NEAR(hot[0].from, 75, 0.01);
  DriveLimits warm = maximum;
  warm.temperature_factor = 1.4;
  EXPECT_EQ(bars(warm, 30, 10), "maximum_torque");
}

// A mean beyond the limit by itself bars nothing, with or without vibration: it is not assessed.
TEST(BarredRanges, MeanTorqueAloneBarsNothing) {
  DriveLimits maximum, shear;
  maximum.maximum = 50, maximum.vibratory = 30;
  shear.shear_stress = 5e6, shear.polar_modulus = 1e-5;
  for (const double vibratory : {0.0, 1e-9, 25.0})
    for (const DriveLimits& limits : {maximum, shear}) {
      const std::vector<LimitedJoint> joints = {joint_of(limits)};
      EXPECT_TRUE(barred_ranges(joints, resonance(-60, vibratory), 1).empty());
      const auto alone = beyond_by_mean(joints, resonance(-60, vibratory));
      ASSERT_EQ(alone.size(), 1u);
      EXPECT_TRUE(alone[0].everywhere);
      EXPECT_TRUE(beyond_by_mean(joints, resonance(49, vibratory)).empty());
    }
  EXPECT_EQ(barred_ranges({joint_of(maximum)}, resonance(-60, 31), 1).size(), 1u);  // by the alternating torque
}

// A straight motor far from its balance: τ = d ω + J_L/(J_A + J_L) (M_s (1 − ω/ω₀) − d ω) accelerates the disc.
TEST(BarredRanges, AcceleratingTorqueBarsNoSpeed) {
  const std::string machine = R"(
line = ["motor", "k1", "disc"]
motor = { kind = "dc shunt motor", stall_torque = "400 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
k1 = { kind = "coupling", stiffness = "2400 N*m/rad", damping = "6 N*m*s/rad", maximum_torque = "120 N*m" }
disc = { kind = "load", inertia = "1.5 kg*m2", damping = "0.5 N*m*s/rad" }
effects = { elasticity = true }
)";
  const auto torque = [](double w) { return 0.5 * w + 0.75 * (400 * (1 - w / 100) - 0.5 * w); };
  const double end = (300 - 120) / (3 - 0.125);  // τ = 120 N·m
  EXPECT_NEAR(torque(end), 120, 1e-9);
  for (const char* pulse : {"", R"(
ripple = { kind = "torque source", on = "disc", torque = "0 N*m", amplitude = "0.5 N*m", frequency = "3 Hz" })"}) {
    std::string text = machine;
    const ModesStudy m = modes_of(text.insert(text.find("effects"), std::string(pulse).substr(*pulse ? 1 : 0) + "\n"));
    ASSERT_FALSE(m.sweep.empty());
    EXPECT_TRUE(m.barred.empty());
    EXPECT_NEAR(m.sweep.front().joints[0].mean, torque(m.sweep.front().speed), 1e-3);
    const auto note = std::find_if(m.notes.begin(), m.notes.end(), [](const std::string& n) {
      return n.starts_with("not assessed: whether \"k1\" may run at ");
    });
    ASSERT_NE(note, m.notes.end());
    EXPECT_NE(note->find("… " + m.speed_unit.text(end, 4)), std::string::npos) << *note;
  }
}

// Where halves may part and the torque changes sign they hammer, however small the amplitude: reported separately.
TEST(BarredRanges, HammeringIsReportedSeparately) {
  DriveLimits wide;
  wide.maximum = 1000;
  const auto ranges = barred_ranges({joint_of(wide, 40, true)}, resonance(10, 20), 1);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].by, BarredRange::By::sign);
  EXPECT_NEAR(ranges[0].from, 75, 0.01);
  EXPECT_TRUE(barred_ranges({joint_of(wide, 40, false)}, resonance(10, 20), 1).empty());
  EXPECT_TRUE(barred_ranges({joint_of(wide, 40, true)}, resonance(0, 0), 1).empty());
}

TEST(BarredRanges, EndsAreRootsWhereTheLoadsAreKnownBetweenThePoints) {
  DriveLimits limits;
  limits.vibratory = 20;
  const std::vector<LimitedJoint> joints = {joint_of(limits)};
  const auto at = [](double speed) {
    JointLoad load;
    load.vibratory.value = load.weighted.value = 100 / (1 + std::pow((speed - 80) / 5.0, 2));
    return std::vector<JointLoad>{load};
  };
  const auto ranges = barred_ranges(joints, resonance(0, 100), 1, at);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_NEAR(ranges[0].from, 70, 1e-3);  // 100/(1 + 4) = 20
  EXPECT_NEAR(ranges[0].to, 90, 1e-3);
  EXPECT_EQ(ranges[0].peak, 100);
}

// The same machine switched on while it turns: its first peak is not that of a start, which `modes` judges.
TEST(LimitsFromRest, AMachineThatTurnsAtTheStartHasNoStartFromRest) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "coupling", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
    coupling = { kind = "coupling", stiffness = "2 kN*m/rad", relative_damping = 0.8, maximum_torque = "300 N*m" }
    wheel = { kind = "load", damping = "0.2 N*m*s/rad", inertia = "4 kg*m2" }
    effects = { elasticity = true }
    run = { until = "20 s", start = { speed = "60 rad/s" } }
  )");
  const std::vector<Verdict> by_run = judge_ratings(test::run(scene)),
                             by_modes = find_modes(scene, scene.effects, {}).verdicts;
  ASSERT_EQ(by_run.size(), 2u);
  EXPECT_EQ(by_run[0].load_case, load_case::run);
  EXPECT_EQ(by_run[0].state(), Compliance::holds);
  EXPECT_EQ(by_run[1].load_case, load_case::start);
  EXPECT_EQ(by_run[1].state(), Compliance::not_assessed);
  const auto* const start = find_by(by_modes, &Verdict::load_case, load_case::start);
  ASSERT_NE(start, nullptr);
  EXPECT_GT(start->value, 1.5 * by_run[0].value);
}

}  // namespace
}  // namespace kurbel::limits_from_rest_test
