// backlash_test.cpp — flanks with a gap: two published laws of contact, the step torque, impacts, and the gap omitted.
#include "drivetrain/couplings/backlash.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/published/published.h"
#include "tests/support/elements.h"
#include "tests/support/validation.h"

namespace kurbel::backlash_test {
namespace {

using test::Against;
using test::digits;
using test::figure;
using test::run;
using test::Validation;
using test::with;

// --- tests/cases/el06_backlash.toml: Modelica.Mechanics.Rotational.Examples.Backlash ---

std::string torsion_pendulum(const std::string& contact, double until) {
  return fmt::format(R"(
line = ["frame", "spring", "disc"]
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[spring]
kind = "coupling"
stiffness = "20 kN*m/rad"
damping = "50 N*m*s/rad"
{}
[disc]
kind = "inertia"
inertia = "5 kg*m2"
[effects]
elasticity = true
[run]
until = "{} s"
samples = 51
accuracy = 1e-11
start = {{ disc = {{ angle = "90 deg" }} }}
)",
                     contact, until);
}

TEST(TorsionPendulumWithBacklash, FollowsTheLawWithoutPulling) {
  const Validation is(Against::published,
                      "Modelica.Mechanics.Rotational.Examples.Backlash (case el06), law that never pulls, recomputed");
  const struct {
    double t, angle, speed;
  } expected[] = {{0.1, 0.24983586, 52.89371861}, {0.5, -0.30995803, -17.22842571}, {1, -0.15558142, -7.02293729}};
  for (const auto& e : expected) {
    const Result r = run(torsion_pendulum("backlash = \"45 deg\"", e.t), false);
    // The last printed digit; at 1 s the case itself is converged to 1.4e-8 only.
    is.near(fmt::format("angle at {} s", e.t), "rad", 1, r.find("final_angle.disc"), e.angle, 7e-9);
    is.near(fmt::format("speed at {} s", e.t), "rad/s", 1, r.find("final_speed.disc"), e.speed, 1.5e-8);
  }
}
TEST(TorsionPendulumWithBacklash, FollowsTheClippedLaw) {
  const Validation is(Against::published,
                      "Modelica.Mechanics.Rotational.Examples.Backlash (case el06), clipped law, recomputed");
  const Result r = run(torsion_pendulum("backlash = \"45 deg\"\ncontact = \"clipped\"", 1), false);
  is.near("angle at 1 s", "rad", 1, r.find("final_angle.disc"), 0.103475, 6e-7);
  is.near("speed at 1 s", "rad/s", 1, r.find("final_speed.disc"), -6.213397, 6e-7);
}
// The published series keeps its own tolerance: 2.1e-5 rad with the gap, 1.7e-5 rad without.
TEST(TorsionPendulumWithBacklash, FollowsTheModelicaSeries) {
  const Validation is(
      Against::published,
      "Modelica.Mechanics.Rotational.Examples.Backlash (case el06), published series (largest difference)");
  const Result gap = run(torsion_pendulum("backlash = \"45 deg\"", 1), false),
               none = run(torsion_pendulum("", 1), false);
  is.near("angle with the gap", "rad",
          test::largest_difference(gap, "angle.disc", test::published_series("el06_backlash.csv", 1, 2)), 0, 3e-5);
  is.near("angle without a gap", "rad",
          test::largest_difference(none, "angle.disc", test::published_series("el06_backlash.csv", 1, 4)), 0, 3e-5);
}

// --- a step torque on two free inertias ---

std::string two_masses(const std::string& coupling, double stiffness = 1e3, const std::string& effects = "",
                       const std::string& run = "") {
  return fmt::format(R"(
line = ["a", "c", "b"]
[a]
kind = "inertia"
inertia = "1 kg*m2"
[c]
kind = "coupling"
stiffness = "{} N*m/rad"
{}
[b]
kind = "inertia"
inertia = "3 kg*m2"
[drive]
kind = "torque source"
torque = "8 N*m"
on = "a"
[effects]
elasticity = true
{}
[run]
until = "1 s"
accuracy = 1e-9
{}
)",
                     digits(stiffness), coupling, effects, run);
}

// theory 5.14: M′ (1 + √(1 + 2kΔ/M′)) with M′ = M J₂/(J₁ + J₂) and the travel Δ = ½ b from the middle of the gap.
TEST(StepTorqueThroughBacklash, PeakIsTheClosedForm) {
  for (const double gap : {1e-4, 1e-3, 0.01, 0.1, 0.4})
    for (const double stiffness : {300.0, 1e4, 2e6}) {
      const double rigid = 8.0 * 3 / 4, peak = rigid * (1 + std::sqrt(1 + stiffness * gap / rigid));
      const Result r = run(two_masses("backlash = \"" + digits(gap) + " rad\"", stiffness), false);
      EXPECT_NEAR(figure(r, "peak_spring_torque.c"), peak, 1e-6 * peak) << gap << " rad, " << stiffness;
    }
}
TEST(StepTorqueThroughBacklash, GapOfNothingIsNoGap) {
  const Result none = run(two_masses("")), gap = run(two_masses("backlash = \"0 rad\""));
  EXPECT_NEAR(figure(none, "peak_spring_torque.c"), 12, 1e-7);  // 2 M J₂/(J₁ + J₂)
  EXPECT_NEAR(figure(gap, "peak_spring_torque.c"), 12, 1e-7);
  EXPECT_NEAR(figure(gap, "final_angle.b"), figure(none, "final_angle.b"), 1e-8);
}
TEST(StepTorqueThroughBacklash, EventsNameTheFlankThatIsTouched) {
  const Result r = run(two_masses("backlash = \"0.1 rad\"\ndamping = \"3 N*m*s/rad\""), false);
  ASSERT_GE(r.events.size(), 2u);
  EXPECT_EQ(r.events[0].component, "c");
  EXPECT_EQ(r.events[0].from, "flanks apart");
  EXPECT_EQ(r.events[0].what, "on the driving flank");
  EXPECT_NEAR(r.events[0].t, std::sqrt(2 * 0.05 / 8), 1e-9);  // Δ = ½ (M/J₁) t²
}

// --- Hunt–Crossley: energy lost in one impact against the frame ---

// J v dv/(1 + d v) = −k pⁿ dp: F(v) = v/d − ln(1 + d v)/d² is the same at the end of the impact, F(−v₁) = F(v₀).
long double rebound_speed(long double v0, long double d) {
  const auto f = [d](long double v) { return v / d - std::log1p(d * v) / (d * d); };
  long double low = 0, high = std::min(v0, 1 / d * (1 - 1e-18L));
  for (int i = 0; i < 200; ++i) {
    const long double middle = (low + high) / 2;
    (f(-middle) < f(v0) ? low : high) = middle;
  }
  return low;
}
TEST(HuntCrossleyImpact, LosesTheEnergyOfTheClosedForm) {
  for (const double exponent : {1.0, 1.5, 2.2})
    for (const double d : {0.05, 0.4, 2.0}) {
      const std::string text = fmt::format(R"(
line = ["frame", "c", "disc"]
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[c]
kind = "coupling"
stiffness = "1e6 N*m/rad"
backlash = "0.2 rad"
contact = "Hunt-Crossley"
contact_exponent = {}
contact_damping = "{} s/rad"
[disc]
kind = "inertia"
inertia = "0.5 kg*m2"
[effects]
elasticity = true
[run]
until = "0.13 s"
accuracy = 1e-10
start = {{ disc = {{ speed = "2 rad/s" }} }}
)",
                                           exponent, d);
      const Result r = run(text, false);
      const auto rebound = static_cast<double>(rebound_speed(2, d));
      EXPECT_NEAR(figure(r, "final_speed.disc"), -rebound, 2e-8) << exponent << ", " << d;
      EXPECT_NEAR(r.energy.by_account.at("c"), -0.25 * (4 - rebound * rebound), 2e-8);
      EXPECT_LE(r.energy.relative, 1e-9);
    }
}

// --- the demands on every element ---

TEST(Backlash, SwitchedOffIsTheLinearCouplingToTheLastBit) {
  const std::string damping = "damping = \"2 N*m*s/rad\"\n";
  test::expect_same_machine(two_masses(damping + "backlash = \"0.02 rad\"", 1e3, "backlash = false"),
                            two_masses(damping));
  test::expect_same_machine(two_masses("damping_ratio = 0.1\nbacklash = \"0.02 rad\"", 1e3, "backlash = false"),
                            two_masses("damping_ratio = 0.1"));
}
TEST(Backlash, JacobianEqualsDifferencesInEveryMode) {
  const std::string gap = "damping = \"5 N*m*s/rad\"\nbacklash = \"0.02 rad\"\n";
  const double touching = 0.03;  // twist; compression 0.02, spring torque 20 N·m
  for (const std::string law : {"no pulling", "clipped"})
    for (const double side : {-1.0, 1.0})
      for (const double rate : {0.5, -0.5, 6.0, -6.0, 0.0})  // ± 2.5, ± 30 N·m from the damper
        test::expect_exact_jacobian(two_masses(gap + "contact = \"" + law + "\""), 0.3, {side * touching},
                                    {10 + rate, 10});
  test::expect_exact_jacobian(two_masses(gap), 0.3, {0.004}, {10.5, 10});
  for (const double side : {-1.0, 1.0})
    for (const double rate : {0.5, -0.5, -4.0})  // the last parts faster than the law allows
      test::expect_exact_jacobian(
          two_masses("backlash = \"0.02 rad\"\ncontact = \"Hunt-Crossley\"\ncontact_damping = \"0.3 s/rad\""), 0.3,
          {side * touching}, {10 + side * rate, 10});
}
// Damped or not, whatever the law: what the drive puts in is what moves, what is stored and what is lost.
TEST(Backlash, EnergyBalanceCloses) {
  for (const std::string law :
       {"contact = \"no pulling\"\ndamping = \"5 N*m*s/rad\"", "contact = \"clipped\"\ndamping = \"5 N*m*s/rad\"",
        "contact = \"Hunt-Crossley\"\ncontact_damping = \"0.3 s/rad\""}) {
    const Result r = run(two_masses("backlash = \"0.05 rad\"\n" + law), false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_LE(r.energy.relative, 1e-8) << law;
    EXPECT_LT(r.energy.by_account.at("c"), -1e-3) << law;
  }
}

}  // namespace
}  // namespace kurbel::backlash_test
