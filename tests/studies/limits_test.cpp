// limits_test.cpp — what the limits of a coupling say of a drive whose mean torque is negative, that vibrates faster
// than 10 Hz, or that passes a resonance: against the closed form of two masses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "studies/limits/limits_findings.h"
#include "studies/modes/modes.h"
#include "tests/support/scenes.h"

namespace kurbel::limits_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double near_inertia = 0.5, far_inertia = 1.5, stiffness = 2400, damping = 6;  // ω₀ = 80 rad/s
constexpr double drive = 40, vibratory = 8, speed = 100;

// Two masses on a spring. The load M = −(40 + 8 cos φ) N·m oscillates once a turn; `sense` −1: all of it reversed.
std::string two_masses(int sense, const std::string& limits, const std::string& further = "") {
  return fmt::format(R"(
line = ["source", "k1", "disc"]
[source]
kind = "torque source"
torque = "{} N*m"
inertia = "0.5 kg*m2"
{}
[k1]
kind = "coupling"
stiffness = "2400 N*m/rad"
damping = "6 N*m*s/rad"
{}
[disc]
kind = "load"
inertia = "1.5 kg*m2"
acts = "always"
[disc.table]
over = "angle"
unit = ["deg", "N*m"]
interpolation = "smooth"
points = [{}]
[effects]
elasticity = true
[run]
start = {{ speed = "{} rad/s", equilibrium = true }}
until = "1 s"
accuracy = 1e-6
)",
                     sense * drive, further, limits,
                     [&] {
                       std::string points;
                       for (int k = 0; k < 72; ++k)
                         points += fmt::format("[{}, {:.17g}], ", 5 * k,
                                               sense * (drive + vibratory * std::cos(5 * k * pi / 180)));
                       return points;
                     }(),
                     sense * speed);
}

ModesStudy modes_of(const std::string& text, const ModesOptions& options = {}) {
  const Scene scene = test::scene_from(text);
  return find_modes(scene, scene.effects, options);
}

// Amplitude of the coupling's torque under a torque A cos ωt on the far mass: A J₁/(J₁ + J₂) |k*|/|k* − ω² J_red|.
double amplitude_of(double torque, double omega, double on = near_inertia) {
  const std::complex<double> spring(stiffness, omega * damping);
  const double sum = near_inertia + far_inertia;
  return torque * on / sum * std::abs(spring / (spring - omega * omega * near_inertia * far_inertia / sum));
}

const Verdict& verdict_on(const ModesStudy& m, const std::string& what) {
  for (const Verdict& v : m.verdicts)
    if (v.assessed && v.requirement.starts_with(what)) return v;
  throw std::runtime_error("no verdict on " + what);
}

// DIN 740: S_f = √(f/10 Hz) above 10 Hz, of a vibration by the order as of one by a frequency of its own.
TEST(Limits, AmplitudesAboveTenHertzCountWithTheRootOfTheirFrequency) {
  const std::string limits = "vibratory_torque = \"30 N*m\"";
  const ModesStudy by_order = modes_of(two_masses(1, limits));
  const double f = speed / (2 * pi);  // 15.9 Hz
  EXPECT_NEAR(verdict_on(by_order, "vibratory").value, std::sqrt(f / 10) * amplitude_of(vibratory, speed), 2e-5);
  for (const double hertz : {4.0, 40.0}) {
    const ModesStudy m =
        modes_of(two_masses(1, limits, fmt::format("amplitude = \"300 N*m\"\nfrequency = \"{} Hz\"", hertz)));
    const double swings = amplitude_of(300, 2 * pi * hertz, far_inertia) + amplitude_of(vibratory, speed);
    const Verdict& verdict = verdict_on(m, "vibratory");
    EXPECT_NEAR(verdict.value, std::sqrt(std::max(1.0, hertz / 10)) * swings, 1e-4) << hertz;
    EXPECT_EQ(verdict.holds(), verdict.value <= 30);
  }
}

TEST(Limits, VerdictHoldsUpToItsLimitAndNotBeyond) {
  for (const double limit : {39.99, 40.01}) {
    const ModesStudy m = modes_of(two_masses(1, fmt::format("nominal_torque = \"{} N*m\"", limit)));
    EXPECT_EQ(verdict_on(m, "nominal").holds(), limit > 40) << limit;
  }
}

// 10 … 20 and 15 … 30 rad/s of two joints are one range to keep away from, 40 … 50 another.
TEST(Limits, RangesOfSeveralJointsThatOverlapAreOne) {
  const std::vector<LimitedJoint> joints(2, LimitedJoint{.name = "shaft", .component = "shaft"});
  const auto said = [&](const std::vector<std::pair<double, double>>& ends) {
    std::vector<BarredRange> ranges;
    for (const auto& [from, to] : ends) {
      BarredRange b;
      b.joint = ranges.size() % 2, b.from = from, b.to = to, b.limit = 75, b.peak = 940, b.by = BarredRange::By::limit;
      ranges.push_back(b);
    }
    return barred_claim(ranges, joints, SpeedUnit{})->text;
  };
  EXPECT_TRUE(said({{15, 30}, {10, 20}}).starts_with("1 barred range, worst ")) << said({{15, 30}, {10, 20}});
  EXPECT_TRUE(said({{15, 30}, {40, 50}, {10, 20}}).starts_with("2 barred ranges, worst "));
  EXPECT_NE(said({{10, 20}}).find("(shaft: up to 940 N·m where 75 N·m are allowed)"), std::string::npos)
      << said({{10, 20}});
}

// A negative mean torque strains a coupling like a positive one: every verdict and every barred range is the same.
TEST(Limits, MachineThatTurnsBackwardsHasTheVerdictsOfTheOneThatTurnsForwards) {
  const std::string limits = "nominal_torque = \"30 N*m\"\nmaximum_torque = \"45 N*m\"\napplication_factor = 1.25\n";
  const ModesOptions simulated{.torque = "k1"};
  const ModesStudy forwards = modes_of(two_masses(1, limits), simulated),
                   backwards = modes_of(two_masses(-1, limits), simulated);
  ASSERT_GE(forwards.verdicts.size(), 3u);
  ASSERT_EQ(backwards.verdicts.size(), forwards.verdicts.size());
  for (std::size_t k = 0; k < forwards.verdicts.size(); ++k)
    if (forwards.verdicts[k].assessed) {
      EXPECT_NEAR(backwards.verdicts[k].value, forwards.verdicts[k].value, 1e-6 * forwards.verdicts[k].value)
          << forwards.verdicts[k].requirement;
    }
  EXPECT_NEAR(verdict_on(backwards, "nominal").value, 1.25 * drive, 1e-6);
  EXPECT_NEAR(backwards.here.joints[0].mean, -drive, 1e-6);
  ASSERT_EQ(forwards.barred.size(), 1u);
  ASSERT_EQ(backwards.barred.size(), 1u);
  EXPECT_NEAR(backwards.barred[0].from, forwards.barred[0].from, 1e-6 * speed);
  EXPECT_NEAR(backwards.barred[0].to, forwards.barred[0].to, 1e-6 * speed);
}

// The resonance at 80 rad/s is passed on the way to 100 rad/s; a barred range ends where the torque is at its limit.
TEST(Limits, ResonancesBelowTheOperatingSpeedArePassedAndBarredUpToTheLimit) {
  const ModesStudy m = modes_of(two_masses(1, "maximum_torque = \"45 N*m\""));
  double passing = 0;
  for (const SpeedResponse& s : m.sweep)
    if (s.speed <= speed) passing = std::max(passing, drive + amplitude_of(vibratory, s.speed));
  EXPECT_NEAR(verdict_on(m, "maximum").value, passing, 1e-4 * passing);
  EXPECT_GT(passing, drive + amplitude_of(vibratory, speed) + 1);
  ASSERT_EQ(m.barred.size(), 1u);
  for (const double edge : {m.barred[0].from, m.barred[0].to})
    EXPECT_NEAR(drive + amplitude_of(vibratory, edge), 45, 0.02) << edge;
  EXPECT_NEAR(m.barred[0].peak, passing, 1e-4 * passing);
  // and one above it is not
  ModesStudy slow = modes_of(two_masses(1, "maximum_torque = \"45 N*m\""), {.speed = 40.0, .fastest = 120});
  EXPECT_LT(verdict_on(slow, "maximum").value, drive + amplitude_of(vibratory, 41));
}

}  // namespace
}  // namespace kurbel::limits_test
