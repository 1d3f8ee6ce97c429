// fluid_coupling_test.cpp — hydrodynamic coupling and viscous damper against their closed forms.
#include "drivetrain/couplings/fluid_coupling.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/published/published.h"
#include "tests/support/elements.h"

namespace kurbel::fluid_coupling_test {
namespace {

// c and the peak M/M₀ over k of the best untuned damper.
double best_damping(double inertia, double ring, double stiffness) {
  const double mu = ring / inertia;
  return 2 * ring * std::sqrt(stiffness / inertia) / std::sqrt(2 * (1 + mu) * (2 + mu));
}
double least_peak(double inertia, double ring) { return 1 + 2 * inertia / ring; }

using test::digits;
using test::figure;
using test::run;

// λ = λ₀ (1 − ν), D = 0.4 m, ρ = 870 kg/m³.
constexpr double lambda0 = 0.004, size = 870 * 0.4 * 0.4 * 0.4 * 0.4 * 0.4;
std::string drive(const std::string& pump, const std::string& load, const std::string& settings,
                  const std::string& points = "[[-1, 0.008], [1, 0]]") {
  return fmt::format(R"(
line = ["pump", "coupling", "turbine"]
[pump]
{}
[coupling]
kind = "fluid coupling"
diameter = "0.4 m"
lambda = {{ over = "speed ratio", unit = ["1", "1"], points = {} }}
inertia_out = "0.5 kg*m2"
[turbine]
kind = "inertia"
inertia = "1.5 kg*m2"
{}
[run]
accuracy = 1e-10
{}
)",
                     pump, points, load, settings);
}
const std::string at_150 = "kind = \"prescribed speed\"\nspeed = \"150 rad/s\"";

// J ω̇ = λ₀ ρ D⁵ ω_p² (1 − ω/ω_p): the turbine follows e^{−t/T}, T = J/(λ₀ ρ D⁵ ω_p); the oil takes ½ J ω_p² (1 − …).
TEST(FluidCoupling, AcceleratesAFreeTurbineExponentially) {
  const double time = 2 / (lambda0 * size * 150), until = 0.6;
  const Result r = run(drive(at_150, "", "until = \"0.6 s\"\nstart = { turbine = { speed = \"0 rad/s\" } }"));
  const double rest = std::exp(-until / time);
  EXPECT_NEAR(figure(r, "final_speed.turbine"), 150 * (1 - rest), 1e-7);
  EXPECT_NEAR(r.energy.by_account.at("coupling"), -0.5 * 2 * 150 * 150 * (1 - rest * rest), 1e-4);
  EXPECT_NEAR(figure(r, "peak_torque.coupling"), lambda0 * size * 150 * 150, 1e-6);
}
// Steady: λ(ν) ρ D⁵ ω_p² = M, the slip of the rated point.
TEST(FluidCoupling, SlipsSteadilyAsItsLoadDemands) {
  const double nu = 0.97, load = lambda0 * (1 - nu) * size * 150 * 150;
  const std::string brake =
      "[load]\nkind = \"torque source\"\ntorque = \"" + digits(-load) + " N*m\"\non = \"turbine\"";
  const Result r = run(drive(at_150, brake, "until = \"8 s\"\nstart = { speed = \"150 rad/s\" }"));
  EXPECT_NEAR(figure(r, "final_speed.turbine"), 150 * nu, 1e-7);
  EXPECT_NEAR(test::series(r, "slip.coupling").back(), 150 * (1 - nu), 1e-7);
}
// The driven side ahead, or backwards: the same law from the faster side.
TEST(FluidCoupling, DrivesFromTheFasterSide) {
  const FluidCoupling c{Curve({-1, 0, 0.5, 0.9, 1}, {0.008, 0.005, 0.004, 0.0015, 0}, Curve::Form::smooth), 9};
  const auto torque = [&](double a, double b) {
    return c.torque(Twist<double>{.angle = 0, .rate = a - b, .turn_rate = a});
  };
  for (const double a : {5.0, 80.0, 150.0})
    for (const double b : {-150.0, -80.0, -3.0, 0.0, 40.0, 79.0, 80.0, 149.0}) {
      EXPECT_EQ(torque(a, b), -torque(b, a));
      EXPECT_EQ(torque(a, b), -torque(-a, -b));
      EXPECT_GE(torque(a, b) * (a - b), 0);
      EXPECT_NEAR(torque(3 * a, 3 * b), 9 * torque(a, b), 1e-12 * std::abs(torque(3 * a, 3 * b)));  // similarity
    }
  EXPECT_EQ(torque(0, 0), 0);
  EXPECT_NEAR(torque(100, 0), 0.005 * 9 * 1e4, 1e-12);
  // Smooth through ν = 1, continuous where the sides turn against each other equally fast.
  const double h = 1e-3;
  EXPECT_NEAR(torque(100, 100 + h) - torque(100, 100), torque(100, 100) - torque(100, 100 - h), 1e-6);
  EXPECT_NEAR(torque(100, -100 - h), torque(100, -100 + h), 0.03);
}
TEST(FluidCoupling, StaysWhateverElasticityIsOn) {
  const Scene scene = test::scene_from(drive("kind = \"inertia\"\ninertia = \"1 kg*m2\"", "", ""));
  EXPECT_EQ(compile(scene, {})->free_shafts, 2u);
}
TEST(FluidCoupling, JacobianEqualsDifferences) {
  const std::string text = drive("kind = \"inertia\"\ninertia = \"1 kg*m2\"", "", "",
                                 "[[-0.5, 0.006], [0, 0.005], [0.6, 0.004], [1, 0]], interpolation = \"smooth\"");
  for (const double pump : {150.0, 60.0, -150.0, -90.0})
    for (const double turbine : {100.0, 10.0, -20.0, -110.0})
      test::expect_exact_jacobian(text, 0.3, {2.0}, {pump, turbine});
}

// --- viscous damper (Den Hartog) ---

std::string damped_shaft(double ring, double damping, double omega, double until, int samples) {
  return fmt::format(R"(
line = ["frame", "shaft", "disc"]
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[shaft]
kind = "coupling"
stiffness = "2 kN*m/rad"
[disc]
kind = "torque source"
amplitude = "10 N*m"
frequency = "{} Hz"
inertia = "0.5 kg*m2"
[damper]
kind = "viscous damper"
ring_inertia = "{} kg*m2"
damping = "{} N*m*s/rad"
on = "disc"
[effects]
elasticity = true
[run]
until = "{} s"
samples = {}
accuracy = 1e-9
)",
                     digits(omega / test::two_pi), digits(ring), digits(damping), digits(until), samples);
}
double swing(double ring, double damping, double omega) {
  const double period = test::two_pi / omega;
  const int periods = 20, before = static_cast<int>(std::ceil(6 / period)), samples = (before + periods) * 32 + 1;
  const Result r = run(damped_shaft(ring, damping, omega, (before + periods) * period, samples), false);
  EXPECT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LE(r.energy.relative, 1e-8);
  const std::vector<double> angle = test::series(r, "angle.disc");
  std::complex<double> sum = 0;
  for (int i = before * 32; i + 1 < samples; ++i)
    sum += angle[static_cast<std::size_t>(i)] *
           std::polar(1.0, -omega * r.trajectory->time()[static_cast<std::size_t>(i)]);
  return std::abs(sum) * 2 / (periods * 32.0);
}
TEST(ViscousDamper, BestDampingLeavesThePeakOfDenHartog) {
  const double inertia = 0.5, k = 2000, still = 10 / k;
  for (const double mu : {0.3, 0.8}) {
    const double ring = mu * inertia, c = best_damping(inertia, ring, k);
    const double common = std::sqrt(k / inertia * 2 / (2 + mu)), peak = least_peak(inertia, ring);
    EXPECT_NEAR(swing(ring, c, common), peak * still, 1e-6 * peak * still);
    // All curves meet there, whatever the damping; the best one is flat.
    EXPECT_NEAR(swing(ring, 2 * c, common), peak * still, 1e-5 * peak * still);
    EXPECT_LT(swing(ring, c, 0.99 * common), peak * still);
    EXPECT_LT(swing(ring, c, 1.01 * common), peak * still);
  }
}
TEST(ViscousDamper, JacobianEqualsDifferences) {
  test::expect_exact_jacobian(damped_shaft(0.2, 7, 60, 1, 11), 0, {0.01, 3.0}, {4, -1});
}

}  // namespace
}  // namespace kurbel::fluid_coupling_test
