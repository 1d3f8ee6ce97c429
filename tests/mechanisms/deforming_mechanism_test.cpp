// deforming_mechanism_test.cpp — clearance in the slider-crank's joints and its flexible rod: laws, limits, energy,
// Jacobian, and no trace when off.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "mechanisms/deforming/joint_contact.h"
#include "tests/published/published.h"
#include "tests/support/elements.h"
#include "tests/support/scenes.h"

namespace kurbel::test::deforming_mechanism_test {
namespace {

// v′ of joint_contact.h by Newton's method, which comes from one side as the right hand side is convex.
double rebound(const JointContact& law, double speed) {
  const double wanted = law.damping * speed - std::log1p(law.damping * speed);
  const auto out = [](double u) { return -u - std::log1p(-u); };
  double u = std::min(law.damping * speed, 1 - 1e-12);
  for (int i = 0; i < 200; ++i) {
    const double next = u - (out(u) - wanted) * (1 - u) / std::max(u, 1e-300);
    if (!(next < u) || next <= 0) break;
    u = next;
  }
  return law.damping > 0 ? u / law.damping : speed;
}

// A small crank with `more` keys; `line` and `drive` put something before it.
std::string crank(const std::string& more, const std::string& run, const std::string& line = "\"crank\"",
                  const std::string& drive = "") {
  return "line = [" + line + "]\n" + drive + R"(
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "150 mm"
crank_mass = "0.5 kg"
crank_com = "10 mm"
crank_inertia = "0.02 kg*m2"
rod_mass = "0.3 kg"
rod_com = "75 mm"
rod_inertia = "5.625e-4 kg*m2"
slider_mass = "0.5 kg"
)" + more +
         "\n[run]\n" + run + "\n";
}
std::string clearance(const std::string& joint, const std::string& gap, const std::string& stiffness,
                      const std::string& more = "restitution = 0.6, restitution_speed = \"0.2 m/s\"") {
  const std::string slider =
      joint == "guide" ? ", length = \"60 mm\", height = \"40 mm\", inertia = \"3e-4 kg*m2\"" : "";
  return "{ kind = \"" + joint + "\", gap = \"" + gap + "\", stiffness = \"" + stiffness + "\", " + more + slider +
         " }";
}
const std::string flexible =
    "rod_flexibility = { modulus = \"200 GPa\", height = \"8 mm\", width = \"8 mm\", modes = 2, damping_ratio = 0.02 }";
const std::string sixty = "start = { speed = \"60 rad/s\" }\nuntil = \"50 ms\"\naccuracy = 1e-7";

// ---------------------------------------------------------------------------------------------------------------------
// The law of contact

TEST(JointContact, SpeedAfterANormalImpactIsThatOfTheClosedForm) {
  // m δ̈ = −N by small steps against (1) of joint_contact.h, for any exponent, stiffness and mass.
  for (const double exponent : {1.0, 1.5, 2.2}) {
    const JointContact law{.gap = 1e-4, .stiffness = 3e7, .exponent = exponent, .damping = 2.5};
    const double mass = 0.7, speed = 0.3;
    double depth = 0, rate = speed;
    const double h = 2e-9;
    const auto acceleration = [&](double d, double v) { return -law.normal(JointContact::touching, d, v) / mass; };
    while (depth >= 0) {  // Heun's method, third order
      const double a1 = acceleration(depth, rate);
      const double a2 = acceleration(depth + h / 3 * rate, rate + h / 3 * a1);
      const double v2 = rate + h / 3 * a1, v3 = rate + 2 * h / 3 * a2;
      const double a3 = acceleration(depth + 2 * h / 3 * v2, v3);
      depth += h / 4 * (rate + 3 * v3);
      rate += h / 4 * (a1 + 3 * a3);
      if (depth == 0) break;
    }
    EXPECT_NEAR(-rate, rebound(law, speed), 1e-6 * speed) << exponent;
  }
}

TEST(JointContact, DampingForARestitutionGivesItBack) {
  for (const double e : {0.05, 0.4, 0.9, 1.0}) {
    JointContact law{.gap = 1e-4, .stiffness = 1e7};
    law.damping = JointContact::damping_for(e, 0.25);
    EXPECT_NEAR(rebound(law, 0.25), e * 0.25, 1e-9) << e;
  }
}

TEST(JointContact, NeverPulls) {
  const JointContact law{.gap = 1e-4, .stiffness = 1e7, .damping = 4};
  EXPECT_EQ(law.first_mode(1e-5, -0.3), JointContact::parting);
  EXPECT_EQ(law.normal(JointContact::parting, 1e-5, -0.3), 0);
  EXPECT_EQ(law.normal(JointContact::without_events, 1e-5, -0.3), 0);
}

// ---------------------------------------------------------------------------------------------------------------------
// Clearance

// Crank held, rod in line with it, +x downwards: rod and slider fall through the gap as one, ½ g t² = c.
TEST(JointClearance, FlightThroughTheGapIsTheParabola) {
  const std::string fall = crank("gravity = \"9.81 m/s2\"\nstroke_angle = \"-90 deg\"\nclearance = " +
                                     clearance("crank pin", "0.5 mm", "100 MN/m"),
                                 "until = \"9.9 ms\"\naccuracy = 1e-9", "\"drive\", \"crank\"",
                                 "drive = { kind = \"prescribed speed\", speed = \"0 rad/s\" }\n");
  const Result r = run(fall, false);
  const std::vector<double> shift = series(r, "crank_pin_shift_x.crank");
  for (std::size_t row = 0; row < shift.size(); ++row) {
    const double t = r.trajectory->time()[row];
    EXPECT_NEAR(shift[row], 0.5 * 9.81 * t * t, 1e-12);
  }
  const Result longer = run_until(scene_from(fall), 0.0102);
  ASSERT_FALSE(longer.events.empty());
  EXPECT_NEAR(longer.events.front().t, std::sqrt(2 * 0.5e-3 / 9.81), 1e-9);
}

// In flight nothing reaches a crank without weight: its speed stays to the last bit.
TEST(JointClearance, TheCrankIsFreeWhileTheRodFlies) {
  Scene scene = scene_from(crank("clearance = " + clearance("crank pin", "0.1 mm", "100 MN/m"), sixty));
  scene.run.until = 1e-4;
  const Result r = run(scene, false);
  ASSERT_TRUE(r.events.empty());
  for (const double omega : series(r, "speed.crank")) EXPECT_EQ(omega, 60);
}

// A hard impact is over before the machine moves: speeds of the gap before and after obey the law's closed form.
TEST(JointClearance, ReboundInAJointIsThatOfTheLaw) {
  double last = 1;
  for (const char* stiffness : {"1e9 N/m", "1e11 N/m", "1e13 N/m", "1e15 N/m"}) {
    const Scene scene = scene_from(crank("clearance = " + clearance("crank pin", "0.1 mm", stiffness), sixty));
    const auto model = compile(scene, scene.effects);
    const auto normal_speed = [&](double t) {
      Equations equations(model, false);
      const RunOutcome there =
          integrate(equations, {.tolerance = 1e-11, .method = "dop853", .until = t, .progress = {}}, {});
      const double* own = equations.snapshot(there.t, there.state).now.own;
      return (own[0] * own[2] + own[1] * own[3]) / std::hypot(own[0], own[1]);
    };
    Equations equations(model, false);
    const RunOutcome all =
        integrate(equations, {.tolerance = 1e-11, .method = "dop853", .until = 0.01, .progress = {}}, {});
    ASSERT_GE(all.events.size(), 2u);
    ASSERT_NE(all.events[0].what.find("touches"), std::string::npos);
    ASSERT_NE(all.events[1].what.find("in flight"), std::string::npos);
    JointContact law;
    law.damping = JointContact::damping_for(0.6, 0.2);
    const double in = normal_speed(all.events[0].t), out = normal_speed(all.events[1].t);
    const double off = std::fabs(-out / rebound(law, in) - 1);
    EXPECT_LT(off, last / 3) << stiffness;
    last = off;
  }
  EXPECT_LT(last, 1e-3);
}

class InEachJoint : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Joints, InEachJoint, testing::Values("crank pin", "wrist pin", "guide"),
                         [](const auto& info) { return info.param.substr(0, info.param.find(' ')); });

TEST_P(InEachJoint, EnergyIsInBalance) {
  const std::string friction = GetParam() == "guide" ? "" : ", radius = \"10 mm\"";
  const Result r =
      run(crank("gravity = \"9.81 m/s2\"\nload = { kind = \"medium\", viscous = \"20 N*s/m\" }\nclearance = " +
                    clearance(GetParam(), "0.1 mm", "20 MN/m",
                              "damping = \"1.5 s/m\", friction = 0.1, friction_speed = \"0.1 m/s\"" + friction),
                sixty),
          false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_GT(figure(r, "impacts.crank"), 2);
  EXPECT_LT(r.energy.relative, 1e-7);
  EXPECT_LT(r.energy.reduction_residual, 1e-12);
  EXPECT_LT(r.energy.by_account.at("crank.contact"), 0);
}

TEST_P(InEachJoint, JacobianIsExactInFlightAndInContact) {
  const Scene scene =
      scene_from(crank("gravity = \"9.81 m/s2\"\nload = { kind = \"medium\", viscous = \"20 N*s/m\" }\nclearance = " +
                           clearance(GetParam(), "0.1 mm", "2 MN/m",
                                     "damping = \"0.5 s/m\", friction = 0.1, friction_speed = \"1 m/s\""),
                       sixty));
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  const RunOutcome all =
      integrate(equations, {.tolerance = 1e-9, .method = "dop853", .until = 0.05, .progress = {}}, {});
  ASSERT_GE(all.events.size(), 2u);
  ASSERT_NE(all.events[0].what.find("touches"), std::string::npos);
  for (const double t : {0.5 * all.events[0].t, 0.5 * (all.events[0].t + all.events[1].t)}) {
    Equations there(model, false);
    const RunOutcome at = integrate(there, {.tolerance = 1e-9, .method = "dop853", .until = t, .progress = {}}, {});
    expect_exact_jacobian(there, at.state);
  }
}

// The angle rather than the speed, which goes on oscillating with the slider in its gap.
TEST_P(InEachJoint, AVanishingGapIsTheIdealJoint) {
  const auto end = [](const Result& r) { return figure(r, "final_angle.crank"); };
  const std::string run_text = "start = { speed = \"60 rad/s\" }\nuntil = \"30 ms\"\naccuracy = 1e-8";
  const double ideal = end(run(crank("", run_text), false));
  double last = HUGE_VAL;
  for (const char* gap : {"100 um", "10 um", "1 um"}) {
    const Result r = run(
        crank("clearance = " + clearance(GetParam(), gap, "500 MN/m", "exponent = 1, damping = \"20 s/m\""), run_text),
        false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double off = std::fabs(end(r) - ideal);
    EXPECT_LT(off, 0.5 * last) << gap;
    last = off;
  }
  EXPECT_LT(last, 1e-5 * ideal);
}

TEST_P(InEachJoint, OffLeavesNoTrace) {
  const std::string keys = "clearance = " + clearance(GetParam(), "0.1 mm", "20 MN/m") + "\n" + flexible;
  expect_same_machine("effects = { joint_clearance = false, flexible_rod = false }\n" + crank(keys, sixty),
                      crank("", sixty));
}

TEST(JointClearance, ReportsWhatItCannotBeHadWith) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      const Scene scene = scene_from(text);
      compile(scene, scene.effects);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const std::string pin = "clearance = " + clearance("crank pin", "0.1 mm", "20 MN/m");
  EXPECT_NE(message(crank(pin + "\nload = { kind = \"opposing\", force = \"10 N\" }", sixty)).find("opposing"),
            std::string::npos);
  EXPECT_NE(message("effects = { joint_friction = true }\n" +
                    crank(pin + "\ncrank_pin = { radius = \"10 mm\", friction = 0.1 }", sixty))
                .find("joint_friction"),
            std::string::npos);
  EXPECT_NE(message(crank("clearance = [" + clearance("guide", "1 mm", "1 MN/m") + ", " +
                              clearance("guide", "1 mm", "1 MN/m") + "]",
                          sixty))
                .find("two of them"),
            std::string::npos);
}

// ---------------------------------------------------------------------------------------------------------------------
// Flexible rod

// Crank held in line with the rod: the rod stands on two supports, ω_n = (nπ/l)² √(EI/μ).
TEST(FlexibleRod, VibratesAsARodOnTwoSupports) {
  const std::string rod =
      "rod_flexibility = { modulus = \"200 GPa\", height = \"8 mm\", width = \"5 mm\", modes = 4, stretching = false }";
  const std::vector<double> found =
      natural_frequencies(crank(rod, "until = \"1 ms\"", "\"drive\", \"crank\"",
                                "drive = { kind = \"prescribed speed\", speed = \"0 rad/s\" }\n"));
  const double inertia = 5e-3 * std::pow(8e-3, 3) / 12, per_length = 0.3 / 0.15;
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t n = 1; n <= 4; ++n) {
    const double k = static_cast<double>(n) * std::numbers::pi / 0.15;
    EXPECT_NEAR(found[n - 1], k * k * std::sqrt(200e9 * inertia / per_length), 1e-9 * found[n - 1]);
  }
}

TEST(FlexibleRod, AStiffRodIsTheRigidOne) {
  const auto end = [](const std::string& more) {
    return figure(
        run(crank(more, "start = { speed = \"60 rad/s\", equilibrium = true }\nuntil = \"20 ms\"\naccuracy = 1e-10"),
            false),
        "final_speed.crank");
  };
  const double rigid = end("");
  std::vector<double> off;
  for (const char* modulus : {"200 GPa", "2000 GPa", "20000 GPa"})
    off.push_back(end("rod_flexibility = { modulus = \"" + std::string(modulus) +
                      "\", height = \"8 mm\", width = \"8 mm\", damping_ratio = 0.5 }") -
                  rigid);
  EXPECT_NEAR(off[0] / off[1], 10, 1);
  EXPECT_NEAR(off[1] / off[2], 10, 1);
}

TEST(FlexibleRod, EnergyIsInBalance) {
  const Result r =
      run(crank("gravity = \"9.81 m/s2\"\nload = { kind = \"medium\", viscous = \"20 N*s/m\" }\n" + flexible,
                "start = { speed = \"200 rad/s\" }\nuntil = \"50 ms\"\naccuracy = 1e-8"),
          false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LT(r.energy.relative, 1e-8);
  EXPECT_LT(r.energy.reduction_residual, 1e-12);
  EXPECT_LT(r.energy.by_account.at("crank.rod"), 0);
  // σ = E w″ h/2, and w″ = (π/l)² w of the first mode, which is nearly all.
  const double stress = figure(r, "peak_rod_bending_stress.crank"), deflection = figure(r, "peak_rod_deflection.crank");
  EXPECT_NEAR(stress, 200e9 * 4e-3 * std::pow(std::numbers::pi / 0.15, 2) * std::fabs(deflection), 0.2 * stress);
}

// Both effects, an elastic coupling and a motor with its circuit: what moves the shaft moves the rod.
TEST(FlexibleRod, JacobianIsExactThroughTheShaftsAcceleration) {
  const std::string drive = R"(
effects = { elasticity = true, transients = true }
motor = { kind = "dc shunt motor", voltage = "200 V", resistance = "0.8 Ohm", constant = "1.5 N*m/A", inductance = "20 mH", inertia = "0.05 kg*m2" }
coupling = { kind = "coupling", stiffness = "2 kN*m/rad", damping_ratio = 0.05 }
)";
  for (const std::string& pin : {std::string("crank pin"), std::string("wrist pin"), std::string("guide")}) {
    const Scene scene =
        scene_from(crank("gravity = \"9.81 m/s2\"\nclearance = " + clearance(pin, "0.1 mm", "2 MN/m") + "\n" + flexible,
                         sixty, "\"motor\", \"coupling\", \"crank\"", drive));
    const auto model = compile(scene, scene.effects);
    Equations equations(model, false);
    const RunOutcome at =
        integrate(equations, {.tolerance = 1e-9, .method = "dop853", .until = 4.3e-3, .progress = {}}, {});
    ASSERT_TRUE(at.complete) << at.diagnosis;
    expect_exact_jacobian(equations, at.state);
  }
}

// A locked clutch ties flywheel and crank: the rod follows the acceleration that the tie gives.
TEST(FlexibleRod, FollowsAShaftThatAClutchTies) {
  const std::string drive = R"(
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "70 rad/s", inertia = "0.05 kg*m2" }
clutch = { kind = "clutch", torque = "400 N*m", static_torque = "500 N*m" }
)";
  const Scene scene =
      scene_from(crank("gravity = \"9.81 m/s2\"\n" + flexible, sixty, "\"motor\", \"clutch\", \"crank\"", drive));
  const auto model = compile(scene, scene.effects);
  Equations equations(model, false);
  const RunOutcome at =
      integrate(equations, {.tolerance = 1e-9, .method = "dop853", .until = 4.3e-3, .progress = {}}, {});
  ASSERT_TRUE(at.complete) << at.diagnosis;
  EXPECT_EQ(at.state[equations.speed_index(0)], at.state[equations.speed_index(1)]);  // locked
  expect_exact_jacobian(equations, at.state, 3e-7, equations.speed_index(0));
  EXPECT_LT(run(scene, false).energy.relative, 1e-8);
}

// Two of them on one shaft, the second behind a gear and turned by a phase: each counts with its own ratio.
TEST(FlexibleRod, SeveralCranksOnOneShaftThroughGears) {
  const std::string second = R"(
gear = { kind = "gearbox", stages = [{ teeth = [20, 30], inertia = ["1e-4 kg*m2", "2e-4 kg*m2"] }] }
[second]
kind = "slider-crank"
radius = "40 mm"
rod = "130 mm"
crank_inertia = "0.01 kg*m2"
rod_mass = "0.2 kg"
rod_inertia = "2.9e-4 kg*m2"
slider_mass = "0.4 kg"
phase = "90 deg"
gravity = "9.81 m/s2"
clearance = { kind = "wrist pin", gap = "0.1 mm", stiffness = "2 MN/m", damping = "1 s/m" }
rod_flexibility = { modulus = "200 GPa", area = "5e-5 m2", second_moment = "3e-10 m4", modes = 1, damping_ratio = 0.02 }
)";
  const Scene scene =
      scene_from(crank("gravity = \"9.81 m/s2\"\n" + flexible, sixty, "\"crank\", \"gear\", \"second\"", second));
  const auto model = compile(scene, scene.effects);
  ASSERT_EQ(model->shafts.size(), 1u);
  Equations equations(model, false);
  const RunOutcome at =
      integrate(equations, {.tolerance = 1e-9, .method = "dop853", .until = 3.7e-3, .progress = {}}, {});
  ASSERT_TRUE(at.complete) << at.diagnosis;
  expect_exact_jacobian(equations, at.state);
  const Result r = run(scene, false);
  EXPECT_LT(r.energy.relative, 1e-8);
  EXPECT_LT(r.energy.reduction_residual, 1e-12);
}

// A brake that holds the crank leaves the rod on two supports. Under its weight, as the beam's first mode carries it:
// q₀ = −μ g (2 l/π)/k.
struct HeldRod {
  double inertia = std::pow(8e-3, 4) / 12, l = 0.15, mass = 0.3;
  double stiffness = 200e9 * inertia * std::pow(std::numbers::pi, 4) / (2 * l * l * l);
  double omega = std::sqrt(stiffness / (mass / 2)), still = -mass * 9.81 * 2 / std::numbers::pi / stiffness;
  static Result run_from(const std::string& start) {
    const std::string rod =
        "rod_flexibility = { modulus = \"200 GPa\", height = \"8 mm\", width = \"8 mm\", modes = 1, stretching = "
        "false }";
    return run(crank("gravity = \"9.81 m/s2\"\n" + rod, "start = " + start + "\nuntil = \"20 ms\"\naccuracy = 1e-8",
                     "\"brake\", \"crank\"",
                     "brake = { kind = \"brake\", torque = \"400 N*m\", static_torque = \"500 N*m\" }\n"),
               false);
  }
};

TEST(FlexibleRod, RingsWhileABrakeHoldsTheCrank) {
  const HeldRod rod;
  const Result r = HeldRod::run_from("\"rest\"");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const std::vector<double> q = series(r, "bending_1.crank"), speed = series(r, "speed.crank");
  for (std::size_t row = 0; row < q.size(); ++row) {
    EXPECT_EQ(speed[row], 0);
    EXPECT_NEAR(q[row], rod.still * (1 - std::cos(rod.omega * r.trajectory->time()[row])), 1e-6 * std::fabs(rod.still));
  }
}

TEST(FlexibleRod, StandsStillWhereItStartsInEquilibrium) {
  const HeldRod rod;
  const Result r = HeldRod::run_from("\"equilibrium\"");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  for (const double q : series(r, "bending_1.crank")) EXPECT_NEAR(q, rod.still, 1e-9 * std::fabs(rod.still));
}

TEST(FlexibleRod, ARodWithoutMassIsReported) {
  const std::string text = crank(flexible, sixty), mass = "rod_mass = \"0.3 kg\"";
  try {
    const Scene scene = scene_from(with(text, mass, "rod_mass = \"0 kg\""));
    compile(scene, scene.effects);
    FAIL() << "no message";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("the rod has no mass"), std::string::npos);
  }
}

}  // namespace
}  // namespace kurbel::test::deforming_mechanism_test
