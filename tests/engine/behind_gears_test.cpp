// behind_gears_test.cpp — torques, slips, starts and modes of what stands behind a gear, against closed forms: every
// ratio on the way away from 1, and the reference of a merged shaft now on one side, now on the other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "engine/linear/linearise.h"
#include "engine/run/recorders.h"
#include "engine/run/run.h"
#include "studies/modes/modes.h"
#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"

namespace kurbel::behind_gears_test {
namespace {

using test::figure;
using test::run;
using test::scene_from;
using test::series;

double first_of(const Result& r, const std::string& channel) { return series(r, channel).front(); }
double last_of(const Result& r, const std::string& channel) { return series(r, channel).back(); }

// A slider-crank with nothing but a disc and its slider's mass.
constexpr double radius = 0.1, rod = 0.35;
double position(double phi) {
  return radius * std::cos(phi) + std::sqrt(rod * rod - std::pow(radius * std::sin(phi), 2));
}
double slope_of_travel(double phi) {
  const double s = std::sin(phi), c = std::cos(phi);
  return -radius * s - radius * radius * s * c / std::sqrt(rod * rod - radius * radius * s * s);
}
double inertia_at(double disc, double mass, double phi) { return disc + mass * std::pow(slope_of_travel(phi), 2); }
std::string crank(const std::string& name, double disc, double mass, const std::string& more = "") {
  return fmt::format(
      "{} = {{ kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", crank_inertia = \"{} kg*m2\", "
      "slider_mass = \"{} kg\"{} }}\n",
      name, disc, mass, more);
}
std::string body(const std::string& name, double inertia) {
  return fmt::format("{} = {{ kind = \"inertia\", inertia = \"{} kg*m2\" }}\n", name, inertia);
}
std::string coupling(const std::string& name, const std::string& more = "") {
  return fmt::format("{} = {{ kind = \"coupling\", stiffness = \"2 kN*m/rad\"{} }}\n", name, more);
}
std::string source(const std::string& name, const std::string& on, double torque) {
  return fmt::format("{} = {{ kind = \"torque source\", on = \"{}\", torque = \"{} N*m\" }}\n", name, on, torque);
}
const std::string gear_2_5 = "gear = { kind = \"gearbox\", stages = [{ teeth = [20, 50] }] }\n";

// --- torques ---------------------------------------------------------------------------------------------------------

// Fast and slow crank on one rigid shaft, speed prescribed with a ripple; both couplings carry what lies behind them:
// M = I(φ) φ̈ + ½ I′(φ) φ̇².
TEST(BehindGears, AMechanismTakesItsOwnAcceleration) {
  const Result r =
      run("line = [\"drive\", \"near\", \"gear\", \"far\", \"crank\"]\n"
          "drive = { kind = \"prescribed speed\", speed = \"20 rad/s\", amplitude = \"6 rad/s\", frequency "
          "= \"3 Hz\", phase = \"0.8 rad\" }\n" +
              coupling("near") + gear_2_5 + coupling("far") + crank("crank", 0.2, 15) +
              "run = { until = \"0.4 s\", samples = 41, accuracy = 1e-9, start = { angle = \"0.7 rad\" } }\n",
          false);
  const auto angle = series(r, "angle.crank"), far = series(r, "torque.far"), near = series(r, "torque.near"),
             speed = series(r, "speed.crank");
  const double omega = 2 * std::numbers::pi * 3;
  for (std::size_t row = 0; row < angle.size(); ++row) {
    const double t = r.trajectory->time()[row], phi = angle[row];
    const double turned = 20 * t - 6 / omega * (std::cos(omega * t + 0.8) - std::cos(0.8));
    EXPECT_NEAR(phi, 0.7 + turned / 2.5, 1e-8);
    const double rate = (20 + 6 * std::sin(omega * t + 0.8)) / 2.5,
                 acceleration = 6 * omega * std::cos(omega * t + 0.8) / 2.5;
    EXPECT_NEAR(speed[row], rate, 1e-9);
    const double h = 1e-5, slope = (inertia_at(0.2, 15, phi + h) - inertia_at(0.2, 15, phi - h)) / (2 * h);
    const double needed = inertia_at(0.2, 15, phi) * acceleration + 0.5 * slope * rate * rate;
    EXPECT_NEAR(far[row], needed, 2e-6) << t;
    EXPECT_NEAR(near[row], needed / 2.5, 2e-6) << t;
  }
}

// The mesh's torque about its driving wheel times the ratio is what the shaft behind it carries, to a load or, where
// the speed is prescribed there, to what brakes it.
TEST(BehindGears, AnElasticMeshPassesItsTorqueOnTimesItsRatio) {
  const std::string chain =
      "line = [\"drive\", \"mesh\", \"c\", \"load\"]\n" + coupling("c") +
      "mesh = { kind = \"gear mesh\", teeth = [20, 50], stiffness = \"9 kN*m/rad\", damping_ratio = 0.2, inertia = "
      "[\"0.01 kg*m2\", \"0.3 kg*m2\"] }\neffects = { elasticity = [\"mesh\"] }\n";
  const Result loaded = run(chain +
                                "drive = { kind = \"prescribed speed\", speed = \"30 rad/s\" }\nload = { kind = "
                                "\"load\", damping = \"4 N*m*s/rad\", inertia = \"0.5 kg*m2\" }\nrun = { until = \"2 "
                                "s\", samples = 3, accuracy = 1e-9, start = { speed = \"30 rad/s\" } }\n",
                            false);
  EXPECT_NEAR(last_of(loaded, "torque.mesh"), 4 * 12 / 2.5, 1e-6);
  EXPECT_NEAR(last_of(loaded, "torque.c"), 4 * 12, 1e-6);
  const Result braked =
      run(chain +
              "drive = { kind = \"torque source\", torque = \"8 N*m\", inertia = \"0.1 kg*m2\" }\nload "
              "= { kind = \"prescribed speed\", speed = \"12 rad/s\" }\nrun = { until = \"2 s\", samples "
              "= 3, accuracy = 1e-9, start = { speed = \"30 rad/s\" } }\n",
          false);
  EXPECT_NEAR(last_of(braked, "torque.mesh"), 8, 1e-6);
  EXPECT_NEAR(last_of(braked, "torque.c"), 2.5 * 8, 1e-6);
  EXPECT_LT(braked.energy.relative, 1e-8);
}

// With losses of the rolling against the carrier, in steady motion: M_r = −i₀ η₀ M_s, and the carrier has the rest,
// M_c = (1 − i₀ η₀) M_s (VDI 2157).
TEST(BehindGears, ACarrierCarriesWhatSunAndRingDo) {
  const double i0 = -74.0 / 24;
  const Result r = run(R"(
line = ["drive", "gear", "c", "out"]
out = { kind = "prescribed speed", speed = "5 rad/s" }
drive = { kind = "torque source", torque = "8 N*m", inertia = "0.1 kg*m2" }
gear = { kind = "planetary gear", sun = 24, ring = 74, efficiency = 0.9, ring_inertia = "0.02 kg*m2", carrier_inertia = "0.03 kg*m2" }
c = { kind = "coupling", stiffness = "2 kN*m/rad" }
fan = { kind = "load", damping = "2 N*m*s/rad", inertia = "0.05 kg*m2" }
effects = { gear_losses = true }
run = { until = "12 s", samples = 3, accuracy = 1e-9, start = { speed = "40 rad/s" } }
[[branch]]
from = "gear.ring"
line = ["fan"]
)",
                       false);
  EXPECT_NEAR(last_of(r, "speed.fan"), i0 * 0.9 * 8 / 2, 1e-7);
  EXPECT_NEAR(last_of(r, "torque.c"), (1 - i0 * 0.9) * 8, 1e-7);
  EXPECT_LT(r.energy.relative, 1e-8);
}

// Slip is the difference of the clutch's own two sides, of which the driven one turns 2.5 times as fast as what lies
// behind the gear.
TEST(BehindGears, SlipOfAClutchBeforeAGearIsThatOfItsOwnSides) {
  for (const bool given : {false, true}) {
    const Result r = run("line = [\"a\", \"clutch\", \"gear\", \"b\"]\n" + body("a", 0.4) +
                             (given ? "b = { kind = \"prescribed speed\", speed = \"-2 rad/s\" }\n" : body("b", 5)) +
                             "clutch = { kind = \"clutch\", torque = \"6 N*m\" }\n" + gear_2_5 +
                             "run = { until = \"0.2 s\", samples = 21, start = { speed = \"30 rad/s\", b = { speed = "
                             "\"-2 rad/s\" } } }\n",
                         false);
    const auto slip = series(r, "slip.clutch"), fast = series(r, "speed.a"), slow = series(r, "speed.b");
    for (std::size_t row = 0; row < slip.size(); ++row) {
      EXPECT_NEAR(slip[row], fast[row] - 2.5 * slow[row], 1e-9);
      const double t = r.trajectory->time()[row];
      EXPECT_NEAR(slip[row], 35 - t * 6 * (1 / 0.4 + (given ? 0 : 2.5 * 2.5 / 5)), 1e-7);
    }
  }
}

// --- starts ----------------------------------------------------------------------------------------------------------

// What is given stands as given; the rest as if the machine were rigid.
TEST(BehindGears, StartAnglesBelongToTheShaftsTheyAreGivenFor) {
  const Result r = run("line = [\"a\", \"gear\", \"b\", \"c\", \"d\", \"e\", \"f\"]\n" + body("a", 0.3) + gear_2_5 +
                           body("b", 0.4) + coupling("c") + body("d", 0.5) + coupling("e") + body("f", 0.6) +
                           "effects = { elasticity = true }\nrun = { until = \"0.01 s\", samples = 2, start = { on = "
                           "\"b\", angle = \"0.5 rad\", d = { angle = \"0.53 rad\" } } }\n",
                       false);
  EXPECT_NEAR(first_of(r, "angle.b"), 0.5, 1e-12);
  EXPECT_NEAR(first_of(r, "angle.a"), 1.25, 1e-12);
  EXPECT_NEAR(first_of(r, "angle.d"), 0.53, 1e-12);
  EXPECT_NEAR(first_of(r, "angle.f"), 0.5, 1e-12);
  EXPECT_NEAR(first_of(r, "twist.c"), -0.03, 1e-12);
  EXPECT_NEAR(first_of(r, "twist.e"), 0.03, 1e-12);
}

// φ_crank = (φ_drive − θ)/i, and the slider where that puts it.
TEST(BehindGears, AGivenTwistTurnsTheCrankBehindTheGear) {
  const Result r = run("line = [\"drive\", \"c\", \"gear\", \"crank\"]\n" + body("drive", 0.3) + coupling("c") +
                           gear_2_5 + crank("crank", 0.2, 4) +
                           "effects = { elasticity = true }\nrun = { until = \"0.01 s\", samples = 2, start = { on = "
                           "\"drive\", angle = \"1.8 rad\", c = { twist = \"0.1 rad\" } } }\n",
                       false);
  EXPECT_NEAR(first_of(r, "angle.drive"), 1.8, 1e-12);
  EXPECT_NEAR(first_of(r, "angle.crank"), 1.7 / 2.5, 1e-12);
  EXPECT_NEAR(first_of(r, "position.crank"), position(1.7 / 2.5), 1e-9);
}

// At rest: φ̈ = M/(J + I₁ + I₂/i²) of the first crank; the coupling before it carries M − J φ̈, the one behind it what
// the second crank takes, I₂ φ̈/i², whose angle it twists.
TEST(BehindGears, AStartInBalanceCarriesWhatAMechanismBehindAGearTakes) {
  const double phase = 0.5, phi = 1.1, push = 40;
  const Result r =
      run("line = [\"drive\", \"c1\", \"one\", \"c2\", \"gear\", \"two\"]\n" + body("drive", 0.3) + coupling("c1") +
              crank("one", 0.2, 4) + coupling("c2") + gear_2_5 + crank("two", 0.9, 60, ", phase = \"0.5 rad\"") +
              source("push", "drive", push) +
              "effects = { elasticity = true }\nrun = { until = \"0.01 s\", samples = 2, start = { angle = "
              "\"1.1 rad\", equilibrium = true } }\n",
          false);
  const double one = inertia_at(0.2, 4, phi), two = inertia_at(0.9, 60, phi / 2.5 + phase) / (2.5 * 2.5);
  const double acceleration = push / (0.3 + one + two);
  EXPECT_NEAR(first_of(r, "torque.c1"), push - 0.3 * acceleration, 1e-9);
  EXPECT_NEAR(first_of(r, "torque.c2"), two * acceleration, 1e-9);
  EXPECT_NEAR(first_of(r, "angle.one"), phi, 1e-12);
  EXPECT_NEAR(first_of(r, "angle.two"), (phi - first_of(r, "twist.c2")) / 2.5, 1e-12);
  EXPECT_NEAR(first_of(r, "position.two"), position(first_of(r, "angle.two") + phase), 1e-9);
}

// A brake of 8 N·m behind 2.5:1 holds 3.2 N·m at the drive: of 5 the rest accelerates all, 3 it holds through the
// coupling.
TEST(BehindGears, AStartInBalanceKnowsWhatABrakeBehindAGearHolds) {
  for (const double push : {5.0, -5.0, 3.0, -3.0}) {
    const Result r =
        run("line = [\"drive\", \"c\", \"gear\", \"drum\"]\n" + body("drive", 0.3) + coupling("c") + gear_2_5 +
                body("drum", 2) + source("push", "drive", push) +
                "brake = { kind = \"brake\", on = \"drum\", torque = \"8 N*m\" }\neffects = { elasticity = "
                "true }\nrun = { until = \"0.01 s\", samples = 2, start = \"equilibrium\" }\n",
            false);
    const double held = std::copysign(std::min(std::abs(push), 8 / 2.5), push);
    const double acceleration = (push - held) / (0.3 + 2 / (2.5 * 2.5));
    EXPECT_NEAR(first_of(r, "torque.c"), push - 0.3 * acceleration, 1e-9) << push;
    EXPECT_NEAR(figure(r, "final_speed.drum"), acceleration / 2.5 * 0.01, 1e-7);
  }
}

// --- scales and modes ------------------------------------------------------------------------------------------------

// k (1/J₁ + i²/J₂) and ζ belong to the twist about the driving wheel.
TEST(BehindGears, DampingRatioOfAMeshBelongsToBothShaftsThroughItsRatio) {
  const Scene scene =
      scene_from("line = [\"a\", \"mesh\", \"b\"]\n" + body("a", 0.2) + body("b", 3) +
                 "mesh = { kind = \"gear mesh\", teeth = [20, 50], stiffness = \"900 N*m/rad\", "
                 "damping_ratio = 0.07 }\neffects = { elasticity = true }\nrun = { until = \"1 s\", start = "
                 "{ speed = \"1 rad/s\" } }\n");
  const ModesStudy modes = find_modes(scene, scene.effects, {});
  ASSERT_EQ(modes.modes.size(), 1u);
  EXPECT_NEAR(modes.modes[0].omega, std::sqrt(900 * (1 / 0.2 + 2.5 * 2.5 / 3)), 1e-7);
  EXPECT_NEAR(modes.modes[0].ratio, 0.07, 1e-9);
}

// Modes of a machine that starts turning are those at that speed: a fan's damping is 2 q ω of its own speed.
TEST(BehindGears, ModesAreSoughtAtTheStartSpeedOfAGearedShaft) {
  const double k = 2000, q = 0.3, omega_fan = 9;
  const Scene scene =
      scene_from("line = [\"a\", \"c\", \"gear\", \"fan\"]\n" + body("a", 0.2) + coupling("c") + gear_2_5 +
                 "fan = { kind = \"load\", quadratic = \"0.3 N*m*s2/rad2\", inertia = \"0.6 kg*m2\" }\neffects = { "
                 "elasticity = true }\nrun = { until = \"1 s\", start = { on = \"fan\", speed = \"9 rad/s\" } }\n");
  EXPECT_DOUBLE_EQ(usual_speed(*compile(scene, scene.effects)), 22.5);
  const double j2 = 0.6 / (2.5 * 2.5), damping = 2 * q * omega_fan / (2.5 * 2.5);
  Eigen::Matrix3d a;
  a << 0, 1, -1, -k / 0.2, 0, 0, k / j2, 0, -damping / j2;
  std::complex<double> swinging;
  for (const Eigen::VectorXcd values = test::eigen_solution(a).values; const std::complex<double>& lambda : values)
    if (lambda.imag() > 0) swinging = lambda;
  const ModesStudy modes = find_modes(scene, scene.effects, {});
  ASSERT_EQ(modes.modes.size(), 1u);
  EXPECT_NEAR(modes.modes[0].ratio, -swinging.real() / std::abs(swinging), 1e-9);
}

// ζ = c ω/2k and ω² = k (1/J₁ + i²/J₂) of a spring before a gear whose shaft counts by the crank behind it.
TEST(BehindGears, ADampersRateIsThatOfItsOwnSides) {
  const Scene scene = scene_from(R"(line = ["a", "c", "gear", "crank"]
a = { kind = "inertia", inertia = "0.2 kg*m2" }
c = { kind = "coupling", stiffness = "2 kN*m/rad", damping = "3 N*m*s/rad" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }] }
crank = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", crank_inertia = "0.6 kg*m2", slider_mass = "1e-6 kg" }
effects = { elasticity = true }
run = { until = "1 s", start = { speed = "5 rad/s" } }
)");
  const double omega = std::sqrt(2000 * (1 / 0.2 + 2.5 * 2.5 / 0.6));
  const ModesStudy modes = find_modes(scene, scene.effects, {});
  ASSERT_EQ(modes.modes.size(), 1u);
  EXPECT_NEAR(modes.modes[0].omega, omega, 1e-5 * omega);
  EXPECT_NEAR(modes.modes[0].ratio, 3 * omega / (2 * 2000), 1e-5);
}

// J₁ + J₂/i₁² + J₃/(i₁ i₂)², of two wheels on the shaft between both stages.
TEST(BehindGears, EveryWheelOfAGearboxHasItsInertia) {
  const Result r = run(R"(line = ["motor", "gear"]
motor = { kind = "torque source", torque = "12 N*m", inertia = "0.2 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 40], inertia = ["0.3 kg*m2", "0.4 kg*m2"] }, { teeth = [20, 60], inertia = ["0.8 kg*m2", "1.8 kg*m2"] }] }
run = { start = "rest", until = "1 s", accuracy = 1e-9 }
)");
  EXPECT_NEAR(figure(r, "final_speed.motor"), 12 / (0.5 + 1.2 / 4 + 1.8 / 36), 1e-7);
}

// Over the angle as over the time: a crank behind a gear of 2.5, loaded over its own angle, comes to the same place.
TEST(BehindGears, ACrankTurnsByItsOwnRatioOverTheAngle) {
  const auto machine = [](const char* method) {
    return run(std::string(R"(line = ["first", "gear", "second"]
first = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", crank_inertia = "1 kg*m2", slider_mass = "1 g" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 50] }] }
second = { kind = "slider-crank", radius = "100 mm", rod = "350 mm", crank_inertia = "0.5 kg*m2", slider_mass = "8 kg", load = { kind = "opposing", force = "90 N" } }
run = { start = { speed = "25 rad/s" }, until = "1 s", accuracy = 1e-9, method = ")") +
               method + "\" }\n");
  };
  const Result over_angle = machine("work"), over_time = machine("dop853");
  for (const char* name : {"final_speed.first", "final_angle.first", "final_angle.second"})
    EXPECT_NEAR(figure(over_angle, name), figure(over_time, name), 1e-5 * figure(over_time, name)) << name;
  EXPECT_NEAR(last_of(over_angle, "position.second"), last_of(over_time, "position.second"), 1e-5);
  EXPECT_NEAR(last_of(over_angle, "position.second"), position(figure(over_time, "final_angle.second")), 1e-5);
}

// Rated values count at the link: torque times the ratio, speed over it.
TEST(BehindGears, ScalesAreRatedValuesCarriedToTheLink) {
  const Scene scene =
      scene_from("line = [\"crank\", \"gear\", \"motor\"]\n" + crank("crank", 0.2, 4) + gear_2_5 +
                 "motor = { kind = \"motor\", torque = { over = \"speed\", unit = [\"rad/s\", \"N*m\"], points "
                 "= [[0, 50], [40, 50], [60, 0]] }, inertia = \"0.1 kg*m2\" }\n");
  const auto model = compile(scene, scene.effects);
  EXPECT_DOUBLE_EQ(model->torque_scale, 50 / 2.5);
  EXPECT_DOUBLE_EQ(model->speed_scale, 60 * 2.5);
}

// --- energy ----------------------------------------------------------------------------------------------------------

// The balance is judged by what was turned over: M φ in, M φ out, however often one looks.
TEST(EnergyAudit, TurnoverIsWhatWasDoneOnce) {
  const Scene scene = scene_from(R"(
line = ["drive", "load"]
drive = { kind = "torque source", torque = "12 N*m", inertia = "0.5 kg*m2" }
load = { kind = "load", damping = "0.4 N*m*s/rad" }
run = { start = { speed = "30 rad/s" } }
)");
  Equations equations(compile(scene, scene.effects), true);
  for (const int checks : {2, 5, 40}) {
    EnergyAudit audit(20, checks);
    RunOptions options;
    options.tolerance = 1e-10, options.until = 20;
    ASSERT_TRUE(integrate(equations, options, {&audit}).complete);
    EXPECT_NEAR(audit.turnover, 2 * 12 * 30 * 20.0, 1e-6) << checks;
    EXPECT_LT(audit.relative(), 1e-9);
  }
}

}  // namespace
}  // namespace kurbel::behind_gears_test
