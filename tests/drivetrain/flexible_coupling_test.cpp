// flexible_coupling_test.cpp — progressive and rubber couplings against their closed forms.
#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "drivetrain/couplings/progressive_coupling.h"
#include "drivetrain/couplings/rubber_coupling.h"
#include "engine/matrices/linear_algebra.h"
#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/elements.h"

namespace kurbel::flexible_coupling_test {
namespace {

using test::digits;
using test::figure;
using test::run;

// Frame – coupling – disc, with a torque on the disc.
std::string on_frame(const std::string& coupling, double inertia, double torque, const std::string& run_settings) {
  return fmt::format(R"(
line = ["frame", "c", "disc"]
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[c]
{}
[disc]
kind = "inertia"
inertia = "{} kg*m2"
[drive]
kind = "torque source"
torque = "{} N*m"
on = "disc"
[effects]
elasticity = true
[run]
accuracy = 1e-10
{}
)",
                     coupling, digits(inertia), digits(torque), run_settings);
}

// --- progressive ---

// k₁ up to θ₁, k₂ beyond.
struct TwoStages {
  double k1 = 400, k2 = 5000, theta1 = 0.02;
  std::string coupling(const std::string& more = "") const {
    return fmt::format(
        "kind = \"progressive coupling\"\ntable = {{ over = \"twist\", unit = [\"rad\", \"N*m\"], points = [[0, 0], "
        "[{}, {}], [0.05, {}]] }}\n{}",
        digits(theta1), digits(k1 * theta1), digits(k1 * theta1 + k2 * (0.05 - theta1)), more);
  }
  double torque(double twist) const { return k1 * std::min(twist, theta1) + k2 * std::max(twist - theta1, 0.0); }
  double energy(double twist) const {
    const double beyond = std::max(twist - theta1, 0.0);
    return 0.5 * k1 * std::pow(std::min(twist, theta1), 2) + k1 * theta1 * beyond + 0.5 * k2 * beyond * beyond;
  }
};

TEST(ProgressiveCoupling, TorqueEnergyAndTwistBelongTogether) {
  const std::vector<double> x = {0, 0.01, 0.03, 0.04, 0.1}, y = {0, 3, 12, 25, 180};
  for (const Curve::Form form : {Curve::Form::linear, Curve::Form::smooth}) {
    const ProgressiveCoupling c(x, y, form);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(c.spring_torque(x[i]), y[i], 1e-11);
      EXPECT_NEAR(c.spring_torque(-x[i]), -y[i], 1e-11);
    }
    for (double twist = -0.3; twist < 0.3; twist += 0.0037) {
      EXPECT_NEAR(c.spring_torque(-twist), -c.spring_torque(twist), 1e-9);
      EXPECT_NEAR(c.energy(-twist), c.energy(twist), 1e-9);
      EXPECT_NEAR(c.twist_at(c.spring_torque(twist)), twist, 1e-12);
      // E′ = M by Richardson's extrapolation; the curvature jumps at the points.
      const double h = 1e-6;
      EXPECT_NEAR((c.energy(twist + h) - c.energy(twist - h)) / (2 * h), c.spring_torque(twist), 3e-3);
    }
    EXPECT_EQ(c.energy(0), 0);
    EXPECT_NEAR(c.energy(0.4) - c.energy(0.3), 0.5 * 0.1 * (c.spring_torque(0.3) + c.spring_torque(0.4)), 1e-9);
    EXPECT_NEAR(c.spring_torque(0.2), 180 + 155 / 0.06 * 0.1, 1e-9);  // straight on
  }
  const ProgressiveCoupling straight(x, y, Curve::Form::linear);
  EXPECT_NEAR(straight.energy(0.04), 0.5 * 0.01 * 3 + 0.5 * 0.02 * 15 + 0.5 * 0.01 * 37, 1e-13);
  EXPECT_NEAR(straight.stiffness_at_rest(), 300, 1e-9);
  const ProgressiveCoupling lopsided({-0.1, 0, 0.1}, {-5, 0, 20}, Curve::Form::linear);
  EXPECT_NEAR(lopsided.stiffness_at_rest(), 125, 1e-10);
  EXPECT_NEAR(lopsided.spring_torque(-0.2), -10, 1e-10);
}

// From rest under a sudden torque the work M θ is all in the spring at the peak.
TEST(ProgressiveCoupling, StepTorquePeaksWhereTheWorkIsStored) {
  const TwoStages s;
  for (const double torque : {3.0, 8.0, 40.0}) {
    double low = 1e-9, high = 1;
    for (int i = 0; i < 200; ++i)
      (s.energy(0.5 * (low + high)) < torque * 0.5 * (low + high) ? low : high) = 0.5 * (low + high);
    const Result r = run(on_frame(s.coupling(), 2, torque, "until = \"0.6 s\""));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_NEAR(std::abs(figure(r, "peak_spring_torque.c")), s.torque(low), 1e-7 * s.torque(low));
    EXPECT_LE(r.energy.relative, 1e-9);
  }
}

// Free vibration through both stages: arcs of two frequencies, put together.
TEST(ProgressiveCoupling, FreeVibrationHasThePeriodOfItsArcs) {
  const TwoStages s;
  const double inertia = 2, speed = 1.1;  // at θ = 0
  const double w1 = std::sqrt(s.k1 / inertia), w2 = std::sqrt(s.k2 / inertia);
  const double t1 = std::asin(w1 * s.theta1 / speed) / w1;
  const double v1 = std::sqrt(speed * speed - std::pow(w1 * s.theta1, 2)), offset = s.k1 * s.theta1 / s.k2;
  const double t2 = std::atan2(v1 / w2, offset) / w2;
  const double period = 4 * (t1 + t2);
  const std::string settings = "until = \"" + digits(3 * period) + " s\"\nstart = { disc = { speed = \"1.1 rad/s\" } }";
  const Result r = run(on_frame(s.coupling(), inertia, 0, settings));
  EXPECT_NEAR(figure(r, "final_angle.disc"), 0, 1e-9);
  EXPECT_NEAR(figure(r, "final_speed.disc"), speed, 1e-9);
  EXPECT_EQ(r.statistics.knots, 12);  // two knots, twice each way, three times
}

TEST(ProgressiveCoupling, StraightTableIsTheLinearCoupling) {
  const std::string settings = "until = \"1 s\"\nstart = { disc = { speed = \"2 rad/s\" } }";
  const std::string table =
      "kind = \"progressive coupling\"\ntable = { over = \"twist\", unit = [\"rad\", \"N*m\"], points = [[0, 0], "
      "[0.01, "
      "5], [0.1, 50]] }\ndamping_ratio = 0.05";
  const Result by_table = run(on_frame(table, 2, 7, settings));
  const Result linear =
      run(on_frame("kind = \"coupling\"\nstiffness = \"500 N*m/rad\"\ndamping_ratio = 0.05", 2, 7, settings));
  EXPECT_NEAR(figure(by_table, "final_angle.disc"), figure(linear, "final_angle.disc"), 1e-10);
  EXPECT_NEAR(figure(by_table, "peak_torque.c"), figure(linear, "peak_torque.c"), 1e-8);
  EXPECT_EQ(by_table.statistics.knots, linear.statistics.knots);  // no points where nothing changes
}

TEST(ProgressiveCoupling, JacobianEqualsDifferencesOnEveryPiece) {
  for (const std::string form : {"linear", "smooth"}) {
    const std::string coupling =
        "kind = \"progressive coupling\"\ntable = { over = \"twist\", unit = [\"deg\", \"N*m\"], points = [[-3, -50], "
        "[-1, "
        "-2], [0, 0], [1, 3], [2, 20], [4, 100]], interpolation = \"" +
        form + "\" }\ndamping = \"0.3 N*m*s/rad\"";
    for (const double degrees : {-9.0, -2.0, -0.5, 0.4, 1.3, 3.1, 7.0})
      test::expect_exact_jacobian(on_frame(coupling, 2, 7, "until = \"1 s\""), 0, {degrees * M_PI / 180}, {1.5});
  }
}
TEST(ProgressiveCoupling, EnergyBalanceClosesOverEveryPiece) {
  const Result r = run(on_frame(TwoStages{}.coupling("damping = \"0.4 N*m*s/rad\"\n"), 2, 60,
                                "until = \"0.5 s\"\nstart = { disc = { speed = \"-2 rad/s\" } }"));
  EXPECT_LE(r.energy.relative, 1e-9);
  EXPECT_LT(r.energy.by_account.at("c"), -0.1);
}

// --- rubber ---

struct Rubber {
  double k = 900, c = 2;
  std::vector<MaxwellBranch> branch = {{600, 0.02}, {250, 0.3}};
  std::string coupling() const {
    std::string list;
    for (const MaxwellBranch& b : branch)
      list += fmt::format("{}{{ stiffness = \"{} N*m/rad\", relaxation_time = \"{} s\" }}", list.empty() ? "" : ", ",
                          digits(b.stiffness), digits(b.relaxation_time));
    return fmt::format(
        "kind = \"rubber coupling\"\nstiffness = \"{} N*m/rad\"\ndamping = \"{} N*m*s/rad\"\nbranches = [{}]",
        digits(k), digits(c), list);
  }
  // k*(ω) = k + iωc + Σ k_j iωT_j/(1 + iωT_j)
  std::complex<double> dynamic_stiffness(double omega) const {
    std::complex<double> sum(k, omega * c);
    for (const MaxwellBranch& b : branch) {
      const std::complex<double> iwt(0, omega * b.relaxation_time);
      sum += b.stiffness * iwt / (1.0 + iwt);
    }
    return sum;
  }
};

// The coupling between a frame and a shaft that is forced to oscillate, after a hundred times its relaxation time.
TEST(RubberCoupling, TransmitsTheComplexStiffnessOfItsBranches) {
  Rubber rubber;
  rubber.branch[1].relaxation_time = 0.1;
  for (const double hertz : {0.5, 2.0, 8.0, 30.0}) {
    const double omega = test::two_pi * hertz, amplitude = 0.01;
    const double settled = std::ceil(4 * hertz) / hertz;  // whole periods, e⁻⁴⁰
    const int periods = 8, samples = 64 * static_cast<int>(std::lround(settled * hertz) + periods) + 1;
    const Result r = run(fmt::format(R"(
line = ["shaker", "c", "frame", "spring", "ballast"]
[shaker]
kind = "prescribed speed"
speed = "0 rad/s"
amplitude = "{} rad/s"
frequency = "{} Hz"
[c]
{}
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[spring]
kind = "coupling"
stiffness = "1 N*m/rad"
[ballast]
kind = "inertia"
inertia = "1 kg*m2"
[effects]
elasticity = true
[run]
until = "{} s"
samples = {}
accuracy = 1e-10
)",
                                     digits(amplitude * omega), digits(hertz), rubber.coupling(),
                                     digits(settled + periods / hertz), samples),
                         false);
    ASSERT_TRUE(r.complete) << r.diagnosis;
    // ω_shaker = θ̂ω sin ωt, so θ = θ̂ (1 − cos ωt): τ = k θ̂ + Re(−k* θ̂ e^{iωt}).
    const std::vector<double> torque = test::series(r, "torque.c");
    std::complex<double> sum = 0;
    for (int i = samples - 1 - 64 * periods; i + 1 < samples; ++i)
      sum += torque[static_cast<std::size_t>(i)] *
             std::polar(1.0, -omega * r.trajectory->time()[static_cast<std::size_t>(i)]);
    const std::complex<double> found = -sum * 2.0 / (64.0 * periods) / amplitude,
                               exact = rubber.dynamic_stiffness(omega);
    EXPECT_NEAR(std::abs(found - exact), 0, 1e-7 * std::abs(exact)) << hertz << " Hz";
  }
}

// Twisted at a constant rate v: τ = k v t + c v + Σ k_j T_j v (1 − e^{−t/T_j}), the integral of the relaxation.
TEST(RubberCoupling, RelaxesWithTheTimesOfItsBranches) {
  const Rubber rubber;
  const double v = 0.2;
  const Result r = run(fmt::format(R"(
line = ["ramp", "c", "frame", "spring", "ballast"]
[ramp]
kind = "prescribed speed"
speed = "0.2 rad/s"
[c]
{}
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[spring]
kind = "coupling"
stiffness = "1 N*m/rad"
[ballast]
kind = "inertia"
inertia = "1 kg*m2"
[effects]
elasticity = true
[run]
until = "1 s"
samples = 101
accuracy = 1e-10
)",
                                   rubber.coupling()),
                       false);
  const std::vector<double> torque = test::series(r, "torque.c");
  for (std::size_t i = 0; i < torque.size(); ++i) {
    const double t = r.trajectory->time()[i];
    double exact = rubber.k * v * t + rubber.c * v;
    for (const MaxwellBranch& b : rubber.branch)
      exact -= b.stiffness * b.relaxation_time * v * std::expm1(-t / b.relaxation_time);
    EXPECT_NEAR(torque[i], exact, 1e-7) << t;
  }
}

// Creep under a sudden torque: J θ̈ = M − τ with its branches is linear; its exact solution by eigenvalues.
TEST(RubberCoupling, CreepsUnderASuddenTorqueAsItsEigenvaluesSay) {
  const Rubber rubber;
  const double inertia = 0.3, torque = 25, t = 0.7;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 4);  // θ, ω, z₁, z₂ of the disc
  a(0, 1) = 1;
  a(1, 0) = -rubber.k / inertia;
  a(1, 1) = -rubber.c / inertia;
  for (Eigen::Index j = 0; j < 2; ++j) {
    const MaxwellBranch& b = rubber.branch[static_cast<std::size_t>(j)];
    a(1, 0) -= b.stiffness / inertia;
    a(1, 2 + j) = b.stiffness / inertia;
    a(2 + j, 0) = 1 / b.relaxation_time;
    a(2 + j, 2 + j) = -1 / b.relaxation_time;
  }
  const double rest = torque / rubber.k;  // θ = z₁ = z₂ in the end
  const Eigen::Vector4cd from_rest(-rest, 0, -rest, -rest);
  const auto [lambda, modes] = eigenpairs(a);
  const Eigen::VectorXcd weights = test::solved_complex(modes, from_rest);
  Eigen::VectorXcd x = Eigen::VectorXcd::Zero(4);
  for (Eigen::Index i = 0; i < 4; ++i) x += weights[i] * std::exp(lambda[i] * t) * modes.col(i);
  const Result r = run(on_frame(rubber.coupling(), inertia, torque, "until = \"0.7 s\""));
  EXPECT_NEAR(figure(r, "final_angle.disc"), rest + x[0].real(), 1e-10);
  EXPECT_NEAR(figure(r, "final_speed.disc"), x[1].real(), 1e-9);
  EXPECT_LE(r.energy.relative, 1e-9);
}

// Without relaxation: the static spring, and the damper that loses the same at the natural frequency (stated).
TEST(RubberCoupling, WithoutRelaxationItIsItsStaticSpringAndEquivalentDamper) {
  const Rubber rubber;
  const double inertia = 0.3, omega = std::sqrt(rubber.k / inertia);
  double damping = rubber.c;
  for (const MaxwellBranch& b : rubber.branch)
    damping += b.stiffness * b.relaxation_time / (1 + std::pow(omega * b.relaxation_time, 2));
  std::string off = on_frame(rubber.coupling(), inertia, 25, "until = \"0.5 s\"");
  off = test::with(off, "elasticity = true\n", "elasticity = true\nrelaxation = false\n");
  const std::string plain =
      on_frame("kind = \"coupling\"\nstiffness = \"900 N*m/rad\"\ndamping = \"" + digits(damping) + " N*m*s/rad\"",
               inertia, 25, "until = \"0.5 s\"");
  test::expect_same_machine(off, plain);
  // The loss of a cycle at ω is π θ̂² Im k*.
  EXPECT_NEAR(damping * omega, rubber.dynamic_stiffness(omega).imag(), 1e-12 * damping * omega);
}
TEST(RubberCoupling, JacobianEqualsDifferences) {
  for (const std::size_t branches : {1u, 2u, 3u, 4u}) {
    Rubber rubber;
    rubber.branch = {{600, 0.02}, {250, 0.3}, {100, 0.004}, {77, 1.3}};
    rubber.branch.resize(branches);
    const Scene scene = test::scene_from(on_frame(rubber.coupling(), 0.3, 25, "until = \"1 s\""));
    Equations equations(compile(scene, scene.effects), false);
    std::vector<double> y = equations.state_of(0, 0, std::vector<double>{0.02}, std::vector<double>{1.2});
    for (std::size_t j = 0; j < branches; ++j) y[y.size() - 1 - j] = 0.01 * static_cast<double>(j);
    test::expect_exact_jacobian(equations, y);
  }
}

}  // namespace
}  // namespace kurbel::flexible_coupling_test
