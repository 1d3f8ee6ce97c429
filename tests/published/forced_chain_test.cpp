// forced_chain_test.cpp — linear chains under a harmonic torque: a transient through a gear, and the periodic steady motion
// against the closed form (tests/cases/el04_forced_chain.toml).
#include <fmt/format.h>

#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/validation.h"

namespace kurbel::forced_chain_test {
namespace {

using test::Against;
using test::figure;
using test::PublishedSeries;
using test::run;
using test::two_pi;
using test::Validation;

// --- Modelica.Mechanics.Rotational.Examples.First: motor 0.1, gear 10, J2 = 2 with 10 N·m·s/rad to the frame, k = 1e4,
// J3 = 2 ---

std::string first(double until, int samples, const std::string& start) {
  return fmt::format(R"(
line = ["motor", "gear", "j2", "spring", "j3"]
[motor]
kind = "torque source"
amplitude = "10 N*m"
frequency = "5 Hz"
inertia = "0.1 kg*m2"
[gear]
kind = "gearbox"
stages = [{{ teeth = [10, 100] }}]
[j2]
kind = "inertia"
inertia = "2 kg*m2"
[damper]
kind = "bearing drag"
damping = "10 N*m*s/rad"
on = "j2"
[spring]
kind = "coupling"
stiffness = "10 kN*m/rad"
[j3]
kind = "inertia"
inertia = "2 kg*m2"
[effects]
elasticity = true
[run]
until = "{} s"
samples = {}
accuracy = 1e-10
start = {}
)",
                     until, samples, start);
}

TEST(GearedForcedChain, TransientAfterOneSecondMatchesTheConvergedSolution) {
  const Validation is(Against::published,
                      "Modelica.Mechanics.Rotational.Examples.First (case el04), recomputed to convergence");
  const Result r = run(first(1, 51, "\"rest\""));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  is.near("angle of J2 after 1 s", "rad", 1, r.find("final_angle.j2"), 0.16232823, 6e-9);  // own_t1, eight decimals
  is.near("speed of J2 after 1 s", "rad/s", 1, r.find("final_speed.j2"), -0.11224931, 6e-9);
  is.near("angle of J3 after 1 s", "rad", 1, r.find("final_angle.j3"), 0.16286164, 6e-9);
  is.near("speed of J3 after 1 s", "rad/s", 1, r.find("final_speed.j3"), -0.13814528, 6e-9);
  EXPECT_NEAR(figure(r, "final_angle.motor"), 10 * figure(r, "final_angle.j2"), 1e-14);
}

// The published series holds to its own tolerance: 3e-6 rad, 2e-4 rad/s. Its damper is mounted the other way round.
TEST(GearedForcedChain, TransientFollowsTheModelicaSeries) {
  const Validation is(
      Against::published,
      "Modelica.Mechanics.Rotational.Examples.First (case el04), published series (largest difference)");
  const Result r = run(first(1, 51, "\"rest\""));
  is.near("angle of J3", "rad", test::largest_difference(r, "angle.j3", test::published_series("el04_first.csv", 1, 4)),
          0, 5e-6);
  is.near("speed of J3", "rad/s",
          test::largest_difference(r, "speed.j3", test::published_series("el04_first.csv", 1, 5)), 0, 3e-4);
  PublishedSeries damper = test::published_series("el04_first.csv", 1, 2);
  for (double& phi : damper.y) phi = -phi;
  is.near("angle of J2", "rad", test::largest_difference(r, "angle.j2", damper), 0, 5e-6);
}

// Complex amplitudes X of J ẍ + C ẋ + K x = F e^{iωt}.
Eigen::VectorXcd harmonic_response(const Eigen::MatrixXd& j, const Eigen::MatrixXd& c, const Eigen::MatrixXd& k,
                                   const Eigen::VectorXd& f, double omega) {
  const Eigen::MatrixXcd dynamic = (k - omega * omega * j).cast<std::complex<double>>() +
                                   std::complex<double>(0, omega) * c.cast<std::complex<double>>();
  return test::solved_complex(dynamic, f.cast<std::complex<double>>());
}

// x = Im(X e^{iωt}) at t = 0, as the start of components.
std::string periodic_start(const std::vector<std::string>& names, const Eigen::VectorXcd& x, double omega) {
  std::string text = "{ ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::complex<double> amplitude = x[static_cast<Eigen::Index>(i)];
    text += fmt::format("{}{} = {{ angle = \"{} rad\", speed = \"{} rad/s\" }}", i ? ", " : "", names[i],
                        amplitude.imag(), omega * amplitude.real());
  }
  return text + " }";
}

TEST(GearedForcedChain, SteadyMotionHasTheAmplitudesOfTheClosedForm) {
  const Validation is(Against::closed_form,
                      "Chain of motor, gear and two inertias under a harmonic torque: complex amplitudes (case el04)");
  const double omega = two_pi * 5, geared = 0.1 * 10 * 10 + 2;  // motor's inertia counts with i²
  Eigen::Matrix2d j, c, k;
  j << geared, 0, 0, 2;
  c << 10, 0, 0, 0;
  k << 1e4, -1e4, -1e4, 1e4;
  const Eigen::VectorXcd x = harmonic_response(j, c, k, Eigen::Vector2d(100, 0), omega);  // torque counts with i
  EXPECT_NEAR(std::abs(x[0]), 0.0069899, 6e-8);                                           // the case's own digits
  EXPECT_NEAR(std::abs(x[1]), 0.00870898, 6e-9);
  const Result r = run(first(1, 501, periodic_start({"j2", "j3"}, x, omega)));  // five periods
  is.near("amplitude of J2", "rad", test::harmonic_amplitude(r, "angle.j2", omega), std::abs(x[0]), 1e-11);
  is.near("amplitude of J3", "rad", test::harmonic_amplitude(r, "angle.j3", omega), std::abs(x[1]), 1e-11);
  is.near("greatest torque of the spring", "N·m", std::abs(figure(r, "peak_spring_torque.spring")), 17.19084363, 1e-7);
  // It is periodic: the end is the start.
  EXPECT_NEAR(figure(r, "final_angle.j3"), x[1].imag(), 1e-11);
  EXPECT_NEAR(figure(r, "final_speed.j3"), omega * x[1].real(), 1e-10);
}

// --- three discs, free at both ends, below, between and above the two natural frequencies (163.96 and 279.49 rad/s)
// ---

struct ForcedCase {
  double omega, amplitude1, amplitude2, amplitude3, torque1, torque2;
};
class ThreeDiscs : public ::testing::TestWithParam<ForcedCase> {};

std::string three_discs(double omega, const std::string& start) {
  return fmt::format(R"(
line = ["j1", "k1", "j2", "k2", "j3"]
[j1]
kind = "torque source"
amplitude = "100 N*m"
frequency = "{} Hz"
inertia = "0.5 kg*m2"
[k1]
kind = "coupling"
stiffness = "20 kN*m/rad"
damping = "15 N*m*s/rad"
[j2]
kind = "inertia"
inertia = "1 kg*m2"
[k2]
kind = "coupling"
stiffness = "30 kN*m/rad"
[j3]
kind = "inertia"
inertia = "2 kg*m2"
[effects]
elasticity = true
[run]
until = "{} s"
samples = 401
accuracy = 1e-10
start = {}
)",
                     omega / two_pi, 4 * two_pi / omega, start);
}

TEST_P(ThreeDiscs, SteadyAmplitudesAndTorquesMatchTheClosedForm) {
  const Validation is(
      Against::closed_form,
      "Three discs under a harmonic torque, below, between and above their natural frequencies (case el04)");
  const ForcedCase& given = GetParam();
  Eigen::Matrix3d c, k;
  c << 15, -15, 0, -15, 15, 0, 0, 0, 0;
  k << 2e4, -2e4, 0, -2e4, 5e4, -3e4, 0, -3e4, 3e4;
  const Eigen::Matrix3d j = Eigen::Vector3d(0.5, 1, 2).asDiagonal();
  const Eigen::VectorXcd x = harmonic_response(j, c, k, Eigen::Vector3d(100, 0, 0), given.omega);
  const Result r = run(three_discs(given.omega, periodic_start({"j1", "j2", "j3"}, x, given.omega)));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double last_digit = 6e-9;  // eight decimals are given
  is.near(fmt::format("{} rad/s: amplitude of disc 1", given.omega), "rad",
          test::harmonic_amplitude(r, "angle.j1", given.omega), given.amplitude1, last_digit);
  is.near(fmt::format("{} rad/s: amplitude of disc 2", given.omega), "rad",
          test::harmonic_amplitude(r, "angle.j2", given.omega), given.amplitude2, last_digit);
  is.near(fmt::format("{} rad/s: amplitude of disc 3", given.omega), "rad",
          test::harmonic_amplitude(r, "angle.j3", given.omega), given.amplitude3, last_digit);
  is.close(fmt::format("{} rad/s: torque between 1 and 2", given.omega), "N·m", std::abs(figure(r, "peak_torque.k1")),
           given.torque1, 1e-8);
  is.close(fmt::format("{} rad/s: torque between 2 and 3", given.omega), "N·m", std::abs(figure(r, "peak_torque.k2")),
           given.torque2, 1e-8);
  // Four periods later every disc is where it began: no other motion is mixed in.
  for (const auto& [name, i] : {std::pair{"j1", 0}, {"j2", 1}, {"j3", 2}})
    EXPECT_NEAR(figure(r, std::string("final_angle.") + name), x[i].imag(), 1e-10) << name;
  // The root mean square of a sine is its peak over √2.
  EXPECT_NEAR(figure(r, "rms_torque.k2"), given.torque2 / std::numbers::sqrt2, 1e-8 * given.torque2);
}

INSTANTIATE_TEST_SUITE_P(
    BelowBetweenAndAboveTheNaturalFrequencies, ThreeDiscs,
    ::testing::Values(ForcedCase{50, 0.00624563, 0.01084655, 0.01301587, 92.1957142987, 65.0793277402},
                      ForcedCase{120, 0.00741295, 0.00020837, 0.00520919, 153.0251589656, 150.0246656526},
                      ForcedCase{200, 0.00701172, 0.00503558, 0.00302135, 40.2846729602, 241.7080377611},
                      ForcedCase{300, 0.00541619, 0.00323741, 0.00064748, 174.8201723162, 116.5467818777}),
    [](const auto& info) { return fmt::format("At{:.0f}RadPerSecond", info.param.omega); });

}  // namespace
}  // namespace kurbel::forced_chain_test
