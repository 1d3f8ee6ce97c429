// gear_mesh_test.cpp — elastic teeth: energy, the tooth frequency in the spectrum, and what is left when it is off.
#include "drivetrain/gears/gear_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "drivetrain/gears/gear_pair.h"
#include "tests/published/published.h"
#include "tests/support/elements.h"

namespace kurbel::gear_mesh_test {
namespace {

using test::digits;
using test::figure;
using test::run;

// Wheel 1 driven at a given speed or free, wheel 2 with a load; i = 2.
std::string pair_of_wheels(const std::string& drive, const std::string& mesh, const std::string& effects,
                           const std::string& settings) {
  return fmt::format(R"(
line = ["drive", "mesh", "drum"]
[drive]
{}
[mesh]
kind = "gear mesh"
teeth = [20, 40]
inertia = ["0.001 kg*m2", "0.02 kg*m2"]
{}
[drum]
kind = "inertia"
inertia = "0.18 kg*m2"
[load]
kind = "torque source"
torque = "-60 N*m"
on = "drum"
[effects]
elasticity = true
{}
[run]
{}
)",
                     drive, mesh, effects, settings);
}
const std::string free_drive = "kind = \"torque source\"\ntorque = \"40 N*m\"\ninertia = \"0.05 kg*m2\"";
const std::string varying = "mesh_variation = [0.3, 0.1]\nmesh_phase = [\"0 deg\", \"40 deg\"]\n";

// θ̈ + (c/J) θ̇ + (k/J) f θ = const with a small a₁: the twist vibrates by θ₀ a₁ k/|k − J ω² + i ω c| at ω = z₁ Ω.
TEST(GearMesh, TwistOscillatesAtTheToothFrequencyAsFirstOrderTheorySays) {
  const double k = 20e3, c = 4, a = 1e-3, reduced = 0.2 / 4, torque = 60.0 / 2;
  for (const double speed : {5.0, 20.0, 31.0, 45.0}) {  // resonance at √(k/J)/z₁ = 31.6 rad/s
    const double omega = 20 * speed, period = test::two_pi / omega;
    const int periods = 10, samples_per_period = 32;
    const int before = static_cast<int>(std::ceil(30 / (0.5 * c / reduced) / period));
    const int samples = (before + periods) * samples_per_period + 1;
    const Result r =
        run(pair_of_wheels("kind = \"prescribed speed\"\nspeed = \"" + digits(speed) + " rad/s\"",
                           "stiffness = \"20 kN*m/rad\"\ndamping = \"4 N*m*s/rad\"\nmesh_variation = [1e-3]", "",
                           fmt::format("until = \"{} s\"\nsamples = {}\naccuracy = 1e-11\nstart = "
                                       "\"equilibrium\"",
                                       digits((before + periods) * period), samples)),
            false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const std::vector<double> twist = test::series(r, "twist.mesh");
    std::complex<double> first = 0;
    double mean = 0;
    for (int i = before * samples_per_period; i + 1 < samples; ++i) {
      const auto row = static_cast<std::size_t>(i);
      first += twist[row] * std::polar(1.0, -omega * r.trajectory->time()[row]);
      mean += twist[row];
    }
    const double count = periods * samples_per_period, rest = torque / k;
    const double exact = rest * a * k / std::abs(std::complex<double>(k - reduced * omega * omega, omega * c));
    EXPECT_NEAR(mean / count, rest, 2e-6 * rest) << speed;                   // second order, too
    EXPECT_NEAR(std::abs(first) * 2 / count, exact, 1e-4 * exact) << speed;  // second order in a₁ Q
  }
}

// Undamped, large variation, tooth frequency through the natural one: nothing is lost, nothing is won.
TEST(GearMesh, UndampedMeshKeepsTheEnergy) {
  const Result r = run(pair_of_wheels(free_drive, "stiffness = \"20 kN*m/rad\"\n" + varying, "",
                                      "until = \"0.5 s\"\naccuracy = 1e-9\nstart = { speed = \"20 rad/s\" }"),
                       false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LE(r.energy.relative, 1e-9);
  EXPECT_NEAR(r.energy.by_account.at("mesh"), 0, 1e-12);
  EXPECT_GT(
      figure(r, "peak_spring_torque.mesh"),
      1.05 * std::abs(figure(run(pair_of_wheels(free_drive, "stiffness = \"20 kN*m/rad\"", "",
                                                "until = \"0.5 s\"\naccuracy = 1e-9\nstart = { speed = \"20 rad/s\" }"),
                                 false),
                             "peak_spring_torque.mesh")));
}
TEST(GearMesh, EnergyBalanceClosesWithGapAndDamping) {
  const std::string geometry = "module = \"3 mm\"\nbacklash = \"0.3 mm\"\ndamping = \"2 N*m*s/rad\"\n";
  const Result r = run(pair_of_wheels(test::with(free_drive, "torque = \"40 N*m\"",
                                                 "torque = \"-5 N*m\"\namplitude = \"70 N*m\"\nfrequency = \"20 Hz\""),
                                      geometry + "mesh_stiffness = \"2e7 N/m\"\n" + varying, "",
                                      "until = \"0.5 s\"\naccuracy = 1e-9\nstart = { speed = \"20 rad/s\" }"),
                       false);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LE(r.energy.relative, 1e-8);
  EXPECT_GT(r.events.size(), 10u);  // it hammers
}

// k = k_m r_b1², r_b1 = ½ m z₁ cos 20°, gap b = j_bn/r_b1; or all of it from the teeth.
TEST(GearMesh, TakesItsNumbersFromTheTeeth) {
  const double base = 0.5 * 3e-3 * 20 * std::cos(20 * M_PI / 180);
  const Scene scene = test::scene_from(pair_of_wheels(
      free_drive, "module = \"3 mm\"\nbacklash = \"0.3 mm\"\nmesh_stiffness = \"2e8 N/m\"", "", "until = \"1 s\""));
  const auto model = compile(scene, scene.effects);
  const AnyConnection& mesh = *model->network.joints[0].element;
  EXPECT_NEAR(mesh.stiffness, 2e8 * base * base, 1e-6);
  EXPECT_NEAR(mesh.twist_at(30), 0.5 * 0.3e-3 / base + 30 / (2e8 * base * base), 1e-12);
  EXPECT_EQ(model->elastic[0].gain_b, 2);
  GearPairData data;
  data.module = 3e-3;
  data.teeth = {20, 40};
  data.width = {0.03, 0.03};
  const Scene estimated =
      test::scene_from(pair_of_wheels(free_drive, "module = \"3 mm\"\nwidth = \"30 mm\"", "", "until = \"1 s\""));
  EXPECT_NEAR(compile(estimated, estimated.effects)->network.joints[0].element->stiffness,
              mesh_stiffness(solve_gear_pair(data)).torsional, 1e-6);
}

TEST(GearMesh, WithoutVariationIsItsMeanToTheLastBit) {
  const std::string settings = "until = \"0.3 s\"\nstart = { speed = \"20 rad/s\" }";
  const std::string mean = "stiffness = \"20 kN*m/rad\"\ndamping_ratio = 0.03\n";
  test::expect_same_machine(pair_of_wheels(free_drive, mean + varying, "mesh_variation = false", settings),
                            pair_of_wheels(free_drive, mean, "", settings));
  const std::string gap = mean + "module = \"3 mm\"\nbacklash = \"0.3 mm\"\n";
  test::expect_same_machine(pair_of_wheels(free_drive, gap + varying, "mesh_variation = false", settings),
                            pair_of_wheels(free_drive, gap, "", settings));
  test::expect_same_machine(pair_of_wheels(free_drive, gap + varying, "backlash = false", settings),
                            pair_of_wheels(free_drive, mean + varying, "", settings));
  test::expect_same_machine(
      pair_of_wheels(free_drive, gap + varying, "backlash = false\nmesh_variation = false", settings),
      pair_of_wheels(free_drive, mean, "", settings));
}
TEST(GearMesh, WithoutElasticityIsTheIdealGear) {
  std::string text = pair_of_wheels(free_drive, "stiffness = \"20 kN*m/rad\"\n" + varying, "", "until = \"0.3 s\"");
  const Result r = run(test::with(text, "elasticity = true", "elasticity = false"));
  const double acceleration = (40 - 60.0 / 2) / (0.051 + 0.2 / 4);
  EXPECT_NEAR(figure(r, "final_speed.drive"), 0.3 * acceleration, 1e-9);
  EXPECT_NEAR(figure(r, "final_speed.drum"), 0.15 * acceleration, 1e-9);
}
TEST(GearMesh, JacobianEqualsDifferencesInEveryMode) {
  const std::string with_gap =
      "stiffness = \"20 kN*m/rad\"\nmodule = \"3 mm\"\nbacklash = \"0.3 mm\"\ndamping = \"20 N*m*s/rad\"\n" + varying;
  for (const double angle : {0.1, 1.7, -2.2}) {
    test::expect_exact_jacobian(
        pair_of_wheels(free_drive, "stiffness = \"20 kN*m/rad\"\ndamping = \"2 N*m*s/rad\"\n" + varying, "", ""), angle,
        {0.003}, {21, 10});
    for (const double twist : {0.02, -0.02, 0.001})
      for (const double rate : {1.0, -1.0, 30.0, -30.0})  // spring 300 N·m, damper 20 or 600 N·m
        test::expect_exact_jacobian(pair_of_wheels(free_drive, with_gap, "", ""), angle, {twist}, {20 + rate, 10});
  }
}

}  // namespace
}  // namespace kurbel::gear_mesh_test
