// reference_problems_test.cpp — R1, R2b, R2stick, E1, E2: references of 12 digits from long-double integration with
// located events, confirmed by quadrature in 128 bits, integration over the crank angle, and CVODE at 1e-14
// (tests/cases/reference.toml).
#include <fmt/format.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "drivetrain/couplings/coupling.h"
#include "drivetrain/loads/loads.h"
#include "drivetrain/shared/torque_source.h"
#include "tests/published/published.h"
#include "tests/support/validation.h"

namespace kurbel::reference_problems_test {
namespace {

using test::Against;
using test::figure;
using test::project_text;
using test::run;
using test::Validation;
using test::with;

// --- R1: I_r(φ) ω² = const ---

TEST(FreeSliderCrank, MotionAfterFortySevenTurnsMatchesTheQuadrature) {
  const Validation is(Against::reference,
                      "Free slider-crank, I_r(φ) ω² = const: quadrature in 128 bits (scene free_slider_crank)");
  const Result r = run(with(project_text("scenes/free_slider_crank.toml"), "accuracy = 1e-7", "accuracy = 1e-9"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  is.near("angle after 10 s", "rad", 1, r.find("final_angle.crank"), 294.719373652657, 1e-9);
  is.near("speed after 10 s", "rad/s", 1, r.find("final_speed.crank"), 29.5167074225067, 1e-9);
  // The measured error holds what it says.
  EXPECT_LE(std::abs(figure(r, "final_angle.crank") - 294.719373652657), *r.find("final_angle.crank")->error + 1e-11);
}

TEST(FreeSliderCrank, EnergyIsConstantAndSpeedFollowsTheReducedInertia) {
  const Validation is(Against::closed_form, "Free slider-crank: energy is constant, ω = √(2 E/I_r)");
  const Result r = run(with(project_text("scenes/free_slider_crank.toml"), "accuracy = 1e-7", "accuracy = 1e-9"));
  const double energy = 252.037193877551, most_inertia = 0.6028418696,
               least_inertia = 0.5600826531;  // reference.toml, R1
  is.close("kinetic energy at the start", "J", r.energy.kinetic_start, energy, 1e-12);
  is.close("kinetic energy at the end", "J", r.energy.kinetic_end, energy, 1e-9);
  is.near("least speed", "rad/s", 1, r.find("min_speed.crank"), std::sqrt(2 * energy / most_inertia),
          3e-9);  // inertia given to 10 digits
  is.near("greatest speed", "rad/s", 1, r.find("max_speed.crank"), std::sqrt(2 * energy / least_inertia), 3e-9);
}

// --- R2b, R2stick: M = 60 (1 − ω/40), 2 kN against the slider towards the crank while x < l ---

TEST(DrivenSliderCrank, MotionPastSixtyLoadEdgesMatchesLocatedEvents) {
  const Validation is(
      Against::reference,
      "Driven slider-crank past 56 edges of its load: long double with located events (scene driven_slider_crank)");
  const Result r = run(with(project_text("scenes/driven_slider_crank.toml"), "accuracy = 1e-7", "accuracy = 1e-9"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  is.near("angle after 8 s", "rad", 1, r.find("final_angle.crank"), 175.990300636005, 1e-9);
  is.near("speed after 8 s", "rad/s", 1, r.find("final_speed.crank"), 22.9514530858349, 1e-9);
  // The load sets in and ends once a turn; 175.99 rad are 28.009 turns, and the load begins before half a turn.
  EXPECT_EQ(std::count_if(r.events.begin(), r.events.end(), [](const Event& e) { return e.component == "crank"; }),
            2 * 28);
}

TEST(DrivenSliderCrank, TooSlowItStopsUnderTheLoadAndIsHeldForEver) {
  const Validation is(Against::reference,
                      "Driven slider-crank that stops under its load: long double with located events");
  const Result r = run(with(project_text("scenes/driven_slider_crank.toml"), "\"20 rad/s\"", "\"10 rad/s\""));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  is.near("angle where it stops", "rad", 1, r.find("final_angle.crank"), 2.01784108852116, 1e-10);
  EXPECT_EQ(figure(r, "final_speed.crank"), 0);  // exactly: no creep
  ASSERT_FALSE(r.events.empty());
  const Event& stop = r.events.back();
  EXPECT_EQ(stop.what, "comes to rest and is held");
  is.near("time when it stops", "s", stop.t, 0.183369336380253, 1e-10);
  // Nothing moves afterwards.
  const std::vector<double> angle = test::series(r, "angle.crank");
  for (std::size_t row = 20; row < angle.size(); ++row) EXPECT_EQ(angle[row], angle.back());
}

// --- E1: six inertias from rest ---

TEST(SixInertiaChain, SpeedsAfterTheRunUpMatchTheReference) {
  const Validation is(
      Against::reference,
      "Six inertias from rest to a fan: long double, confirmed by CVODE at 1e-14 (scene six_inertia_chain)");
  const Result r = run(project_text("scenes/six_inertia_chain.toml"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const std::vector<std::pair<const char*, double>> expected = {{"motor", 72.0459453224151}, {"j2", 72.0459597112134},
                                                                {"j3", 72.0459599907005},    {"j4", 72.0459602500263},
                                                                {"j5", 72.0459637117535},    {"fan", 72.0459618456415}};
  for (const auto& [name, omega] : expected)
    is.near(fmt::format("speed of {} at the end", name), "rad/s", 1, r.find(fmt::format("final_speed.{}", name)), omega,
            1e-9);
}

TEST(SixInertiaChain, SpringTorquePeaksWhereTheTwoSpeedsMeet) {
  const Validation is(
      Against::reference,
      "Six inertias from rest to a fan: long double, confirmed by CVODE at 1e-14 (scene six_inertia_chain)");
  const Result r = run(project_text("scenes/six_inertia_chain.toml"));
  const Figure* spring = r.find("peak_spring_torque.c1");
  ASSERT_NE(spring, nullptr);
  is.near("greatest torque of the spring c1", "N·m", 1, spring, 290.808843395416, 1e-8);
  ASSERT_TRUE(spring->at.has_value());
  is.near("its time", "s", *spring->at, 0.015016893772, 1e-10);
}

TEST(SixInertiaChain, TransmittedTorquePeaksEarlierAndHigherThanTheSpringTorque) {
  const Validation is(
      Against::reference,
      "Six inertias from rest to a fan: long double, confirmed by CVODE at 1e-14 (scene six_inertia_chain)");
  const Result r = run(project_text("scenes/six_inertia_chain.toml"));
  const Figure* transmitted = r.find("peak_torque.c1");
  ASSERT_NE(transmitted, nullptr);
  is.near("greatest transmitted torque of c1", "N·m", 1, transmitted, 291.4212, 6e-5);  // four decimals are given
  ASSERT_TRUE(transmitted->at.has_value());
  is.near("its time, transmitted", "s", *transmitted->at, 14.510e-3, 6e-7);
}

// --- E2: N equal inertias, torque on the first, viscous resistance on the last ---

constexpr double inertia = 0.01, stiffness = 1e5, damping = 1, torque_first = 10, viscous_last = 0.5;

std::shared_ptr<const Model> equal_chain(int n, double until) {
  Network net;
  int before = -1;
  for (int i = 0; i < n; ++i) {
    const std::string name = fmt::format("j{}", i);
    const int node = net.add_node(name, "", inertia);
    net.ports[name] = {node, node};
    net.components.push_back(name);
    if (before >= 0) net.connect(before, node, 1, fmt::format("k{}", i), Coupling{stiffness, damping});
    if (i == 0) net.put(node, name, HarmonicTorque{Account::driving, torque_first, 0, 0, 0});
    if (i + 1 == n) net.put(node, name, SpeedLoad{Account::useful, viscous_last, 0});
    before = node;
  }
  Scene scene;
  scene.run.until = until;
  return compile_network(std::move(net), scene, Effects{true, {}});
}

// Speeds of all inertias at the end of a bare run.
Eigen::VectorXd speeds(int n, double until, double tolerance, const std::string& method = "auto") {
  const auto model = equal_chain(n, until);
  Equations equations(model, false);
  RunOptions options;
  options.tolerance = tolerance;
  options.method = method;
  options.until = until;
  const RunOutcome out = integrate(equations, options, {});
  EXPECT_TRUE(out.complete) << out.diagnosis;
  Eigen::VectorXd omega(n);
  for (int i = 0; i < n; ++i)
    omega[i] = out.state[equations.speed_index(model->shaft_of_node[static_cast<std::size_t>(i)])];
  return omega;
}

// The same by the matrix exponential, assembled here by hand: z = (Ω θ, ω, 1), ż = A z, with Ω = √(k/J) for round-off's
// sake.
Eigen::VectorXd speeds_by_exponential(int n, double until) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  const auto w = [n](int i) { return n - 1 + i; };
  const double scale = std::sqrt(stiffness / inertia);
  for (int i = 0; i + 1 < n; ++i) {
    a(i, w(i)) = scale;
    a(i, w(i + 1)) = -scale;
    for (const int end : {0, 1}) {
      const int row = w(i + end);
      const double sign = end ? 1 : -1;
      a(row, i) += sign * stiffness / inertia / scale;
      a(row, w(i)) += sign * damping / inertia;
      a(row, w(i + 1)) -= sign * damping / inertia;
    }
  }
  a(w(n - 1), w(n - 1)) -= viscous_last / inertia;
  a(w(0), 2 * n - 1) = torque_first / inertia;
  const Eigen::MatrixXd e = (a * until).exp();
  return e.col(2 * n - 1).segment(n - 1, n);
}

TEST(EqualChain, EndSpeedsMatchTheReference) {
  const Validation is(Against::reference, "Chain of N equal inertias, torque on the first: converged reference");
  const Eigen::VectorXd ten = speeds(10, 0.2, 1e-10), hundred = speeds(100, 0.2, 1e-10);
  is.near("N = 10: speed of the first", "rad/s", ten[0], 12.64599, 6e-6);  // five decimals are given
  is.near("N = 10: speed of the last", "rad/s", ten[9], 12.64191, 6e-6);
  is.near("N = 100: speed of the first", "rad/s", hundred[0], 2.09731, 6e-6);
  is.near("N = 100: speed of the last", "rad/s", hundred[99], 1.81029, 6e-6);
}

TEST(EqualChain, AllSpeedsMatchTheMatrixExponential) {
  const Validation is(
      Against::closed_form,
      "Chain of N equal inertias, torque on the first: matrix exponential (largest difference of all speeds)");
  is.near("N = 10, 0.2 s", "rad/s", (speeds(10, 0.2, 1e-12) - speeds_by_exponential(10, 0.2)).cwiseAbs().maxCoeff(), 0,
          1e-10);
  is.near("N = 60, 0.05 s", "rad/s", (speeds(60, 0.05, 1e-12) - speeds_by_exponential(60, 0.05)).cwiseAbs().maxCoeff(),
          0, 1e-10);
}

// Before its reflection comes back, a long chain answers like an endless one: ω₁ → M/√(k J).
TEST(EqualChain, FirstSpeedOfALongChainIsTorqueOverItsImpedance) {
  const Validation is(
      Against::closed_form,
      "Chain of N equal inertias, torque on the first: before its reflection comes back, ω₁ = M/√(k J)");
  const double impedance = std::sqrt(stiffness * inertia);
  is.near("N = 1000: speed of the first", "rad/s", speeds(1000, 0.2, 1e-8)[0], torque_first / impedance,
          5e-5);  // what is left of the ring
}

// The maximum norm sees the lively inertias among many at rest: the same tolerance gives the same accuracy.
TEST(EqualChain, EqualToleranceGivesEqualAccuracyAtAnyLength) {
  for (const std::string method : {"dop853", "dopri5", "esdirk"}) {
    const double until = 0.02, tolerance = 1e-5;
    const auto error = [&](int n) {
      return (speeds(n, until, tolerance, method) - speeds(n, until, 1e-13, "dop853")).cwiseAbs().maxCoeff();
    };
    const double small = error(10), large = error(1000);
    EXPECT_LT(large, 5 * small) << method;
    EXPECT_LT(large, 1e-3) << method;
  }
}

}  // namespace
}  // namespace kurbel::reference_problems_test
