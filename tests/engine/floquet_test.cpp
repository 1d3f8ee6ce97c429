// Exponents of the motions beside a cycle: Mathieu's and Meissner's equations, systems that do not vary, what rings down.
#include "engine/periodic/floquet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/matrices/periodic_schur.h"
#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"

namespace kurbel::test::floquet_test {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

struct Cycle {
  std::shared_ptr<ReturnMap> map;
  SteadyPoint point;
  FloquetSpectrum spectrum(const FloquetOptions& options = {}) const {
    FloquetSpectrum found = floquet_exponents(*map, point.z, options);
    EXPECT_TRUE(found.found()) << found.why;
    return found;
  }
};
Cycle cycle_of(const Scene& scene, double link_speed) {
  Cycle cycle{std::make_shared<ReturnMap>(model_of(scene), ReturnMapOptions{}), {}};
  const ReturnMap::Image guess = cycle.map->approach(link_speed);
  EXPECT_EQ(guess.end, ReturnMap::End::returned) << guess.why;
  cycle.point = find_steady(*cycle.map, guess.z, 1e-11);
  EXPECT_TRUE(cycle.point.found) << cycle.point.why;
  return cycle;
}

// sin²(πν/2) = Δ sin²(π√a/2) for y″ + (a − 2q cos 2x) y = 0, Δ Hill's determinant (Whittaker; Abramowitz & Stegun 20.3).
Complex sine_squared(double a, double q) {
  constexpr int most = 20000;
  const auto gamma = [&](int r) { return q / (4.0 * r * r - a); };
  double before = 1, here = 1;
  for (int r = -most; r < most; ++r) {
    const double next = here - gamma(r) * gamma(r + 1) * before;
    before = here, here = next;
  }
  return here * std::pow(std::sin(pi * std::sqrt(Complex(a)) / 2.0), 2);
}
// ν with Re in [0, 1], Im ≥ 0, up to sign and even numbers.
Complex characteristic_exponent(double a, double q) {
  const Complex nu = 2 / pi * std::asin(std::sqrt(sine_squared(a, q)));
  return {std::abs(nu.real()), std::abs(nu.imag())};
}

// Two wheels, the first at a given speed, the second with an inertia and a viscous load: the mesh makes Mathieu's equation,
// J δ̈ + b δ̇ + k (1 + α cos z Ω t) δ = 0.
struct Mathieu {
  double a, q;  // of y(x), x = z Ω t/2, with the damping taken out
  int teeth = 20;
  double fading = 0.3;                               // b/2J [1/s]
  double speed = 60.0 / teeth;                       // Ω [rad/s]
  double pace() const { return teeth * speed / 2; }  // dx/dt
  Scene scene() const {
    const double inertia = 0.4, stiffness = inertia * (a * pace() * pace() + fading * fading);
    const double variation = 2 * q * pace() * pace() * inertia / stiffness;
    return scene_from("line = [\"drive\", \"mesh\", \"load\"]\ndrive = { kind = \"prescribed speed\", speed = \"" +
                      digits(speed) + " rad/s\" }\nmesh = { kind = \"gear mesh\", teeth = [" + std::to_string(teeth) +
                      ", " + std::to_string(teeth) + "], stiffness = \"" + digits(stiffness) +
                      " N*m/rad\", mesh_variation = [" + digits(variation) +
                      "] }\nload = { kind = \"load\", torque = \"2 N*m\", damping = \"" + digits(2 * fading * inertia) +
                      " N*m*s/rad\", inertia = \"" + digits(inertia) +
                      " kg*m2\" }\n[effects]\nelasticity = true\nmesh_variation = true\n");
  }
};

// Characteristic values a_r, b_r of Abramowitz & Stegun, table 20.1: there Hill's determinant says ν = r.
TEST(Floquet, HillsDeterminantHasThePublishedCharacteristicValues) {
  struct Value {
    double a, q;
    int order;
  };
  for (const Value v :
       {Value{1.8591080725, 1, 1}, Value{3.9170247730, 1, 2}, Value{7.4491097395, 5, 2}, Value{1.8581875415, 5, 1},
        Value{2.0994604455, 5, 2}, Value{-5.8000460209, 5, 0}, Value{-5.7900805986, 5, 1}})
    EXPECT_NEAR(std::abs(sine_squared(v.a, v.q) - (v.order == 1 ? 1.0 : 0.0)), 0, 2e-8) << v.a;
}

// Stable between the zones, in the first and the second zone: growth, frequency, and which multiple of the mesh's it is.
TEST(Floquet, ExponentsOfMathieusEquationAreThePublishedOnes) {
  struct Case {
    double a, q;
    double nu;  // about: which branch
    int teeth;  // periods in a cycle
  };
  for (const Case c : {Case{0.5, 0.1, 0.7, 20}, Case{2.3, 0.6, 1.5, 20}, Case{1.05, 0.2, 1, 1}, Case{1, 0.45, 1, 1},
                       Case{4.1, 0.9, 2, 1}, Case{6.2, 0.9, 2.5, 3}, Case{12.3, 1.5, 3.5, 20}}) {
    SCOPED_TRACE(c.a);
    const Mathieu mathieu{c.a, c.q, c.teeth};
    const Complex nu = characteristic_exponent(c.a, c.q);
    const Cycle cycle = cycle_of(mathieu.scene(), mathieu.speed);
    const FloquetSpectrum spectrum = cycle.spectrum();
    ASSERT_EQ(spectrum.exponents.size(), 2u);
    const double even = 2 * std::round((c.nu - nu.real()) / 2), odd = 2 * std::round((c.nu + nu.real()) / 2);
    const double frequency =
        std::abs(even + nu.real() - c.nu) < std::abs(odd - nu.real() - c.nu) ? even + nu.real() : odd - nu.real();
    for (const std::size_t j : {0u, 1u}) {
      const FloquetExponent& e = spectrum.exponents[j];
      const double growth = (j == 0 ? 1 : -1) * nu.imag() * mathieu.pace() - mathieu.fading;
      EXPECT_NEAR(e.exponent.real(), growth, 1e-6);
      EXPECT_NEAR(std::abs(e.exponent.imag()), frequency * mathieu.pace(), 1e-6);
      EXPECT_LT(
          std::abs(e.exponent.real() - growth) + std::abs(std::abs(e.exponent.imag()) - frequency * mathieu.pace()),
          e.error + 1e-9);
      EXPECT_LT(e.error, 1e-5);
    }
  }
}

// y″ + (a ± q) y = 0, half a period each: cos πμ = cos α cos β − (α² + β²)/(2αβ) sin α sin β over a period of π, with
// α = π√(a + q)/2, β = π√(a − q)/2 (Meissner 1918).
TEST(Floquet, MeissnersEquationIsItsClosedForm) {
  for (const auto& [a, q] : {std::pair{2.3, 0.9}, std::pair{1.0, 0.4}, std::pair{0.3, 0.2}, std::pair{4.0, 2.5}}) {
    const double alpha = pi / 2 * std::sqrt(a + q), beta = pi / 2 * std::sqrt(a - q);
    const double half_trace = std::cos(alpha) * std::cos(beta) -
                              (alpha * alpha + beta * beta) / (2 * alpha * beta) * std::sin(alpha) * std::sin(beta);
    std::vector<Eigen::MatrixXd> factors;
    for (const double s : {a + q, a - q})
      for (int k = 0; k < 8; ++k) {
        const double w = std::sqrt(s), h = pi / 16;
        Eigen::Matrix2d step;
        step << std::cos(w * h), std::sin(w * h) / w, -w * std::sin(w * h), std::cos(w * h);
        factors.emplace_back(step);
      }
    const PeriodicSchur schur(factors);
    const Complex mu = half_trace + std::sqrt(Complex(half_trace * half_trace - 1));
    EXPECT_NEAR(schur.eigenvalues()[0].log_magnitude, std::abs(std::log(std::abs(mu))), 1e-13);
    EXPECT_NEAR(std::abs(schur.eigenvalues()[0].phase), std::abs(std::arg(mu)), 1e-13);
  }
}

// Motor – stiff, strongly damped coupling – load, time-invariant and slow: multipliers go down to e^(−1e4), of which the
// product of the transition matrices knows nothing; the exponents are the eigenvalues of its matrix.
TEST(Floquet, ExponentsOfASystemThatDoesNotVaryAreItsEigenvalues) {
  for (const auto& [k, c] : {std::pair{300.0, 0.05}, std::pair{4e4, 3.0}, std::pair{2000.0, 400.0}}) {
    const Scene scene = scene_from(
        "line = [\"motor\", \"c\", \"load\"]\n"
        "motor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = \"80 rad/s\", inertia = \"0.3 "
        "kg*m2\" }\nc = { kind = \"coupling\", stiffness = \"" +
        digits(k) + " N*m/rad\", damping = \"" + digits(c) +
        " N*m*s/rad\" }\nload = { kind = \"load\", damping = \"0.5 N*m*s/rad\", inertia = \"0.5 kg*m2\" }\n"
        "[effects]\nelasticity = true\n");
    const double j1 = 0.3, j2 = 0.5, slope = 60 / 80.0, b = 0.5, steady = 60 / (slope + b);
    Eigen::Matrix3d a;
    a << 0, 1, -1, -k / j1, -(c + slope) / j1, c / j1, k / j2, c / j2, -(c + b) / j2;
    const Eigen::VectorXcd eigenvalues = eigen_solution(a).values;
    const FloquetSpectrum spectrum = cycle_of(scene, steady).spectrum();
    ASSERT_EQ(spectrum.exponents.size(), 3u);
    for (const FloquetExponent& e : spectrum.exponents) {
      double off = HUGE_VAL;
      for (const Complex& lambda : eigenvalues) off = std::min(off, std::abs(lambda - e.exponent));
      EXPECT_LT(off, 1e-7 * std::abs(e.exponent)) << e.exponent << " of " << eigenvalues.transpose();
      EXPECT_LT(off, e.error + 1e-9 * std::abs(e.exponent));
      EXPECT_EQ(e.off_nearest, 0);
    }
  }
}

// Loads with edges, dead centres, tables: multipliers of the map's own derivative, where that knows them.
TEST(Floquet, MultipliersAreThoseOfTheFixedPoint) {
  for (const char* name : {"crank_press", "compressor", "single_cylinder_engine", "six_inertia_chain"}) {
    SCOPED_TRACE(name);
    const Scene scene = scene_file(std::string("scenes/") + name + ".toml");
    const Cycle cycle = cycle_of(scene, 0.97 * model_of(scene)->speed_scale);
    const FloquetSpectrum spectrum = cycle.spectrum();
    ASSERT_EQ(spectrum.exponents.size(), cycle.point.multipliers.size());
    std::vector<Complex> left;
    for (const FloquetExponent& e : spectrum.exponents) left.push_back(std::exp(e.exponent * spectrum.time));
    for (const Complex mu : cycle.point.multipliers) {
      if (std::abs(mu) < 1e-6) continue;
      const auto nearest = std::min_element(left.begin(), left.end(),
                                            [&](Complex x, Complex y) { return std::abs(x - mu) < std::abs(y - mu); });
      EXPECT_LT(std::abs(*nearest - mu), 1e-7) << mu;
      left.erase(nearest);
    }
  }
}

// A shaft with dry friction behind a spring sticks once a period: what was its speed before is gone.
TEST(Floquet, WhatSticksOnTheWayIsGone) {
  const Cycle cycle = cycle_of(
      scene_from(
          "line = [\"source\", \"c\", \"load\"]\n"
          "source = { kind = \"torque source\", torque = \"5 N*m\", amplitude = \"9 N*m\", frequency = \"0.7 Hz\", "
          "phase = \"1.6 "
          "rad\", inertia = \"0.2 kg*m2\" }\n"
          "c = { kind = \"coupling\", stiffness = \"60 N*m/rad\", damping = \"0.8 N*m*s/rad\" }\n"
          "load = { kind = \"load\", torque = \"5 N*m\", damping = \"0.2 N*m*s/rad\", inertia = \"0.1 kg*m2\" }\n"
          "[effects]\nelasticity = true\n"),
      5);
  const FloquetSpectrum spectrum = cycle.spectrum();
  ASSERT_EQ(spectrum.exponents.size(), 3u);
  EXPECT_EQ(spectrum.exponents[2].exponent.real(), -HUGE_VAL);
  for (const std::size_t j : {0u, 1u}) {
    const Complex mu = std::exp(spectrum.exponents[j].exponent * spectrum.time);
    double off = HUGE_VAL;
    for (const Complex& known : cycle.point.multipliers) off = std::min(off, std::abs(known - mu));
    EXPECT_LT(off, 1e-6);
  }
}

// What is compared with may come from the caller; then it counts by its number.
TEST(Floquet, ModesOfTheCallerAreComparedWith) {
  const Mathieu mathieu{12.3, 1.5, 20};
  const Cycle cycle = cycle_of(mathieu.scene(), mathieu.speed);
  const FloquetSpectrum own = cycle.spectrum();
  const FloquetExponent& e = own.exponents.front();
  FloquetOptions options;
  options.modes = {{std::conj(e.exponent), e.shape.conjugate()}, {e.exponent, e.shape}};
  const FloquetSpectrum compared = cycle.spectrum(options);
  EXPECT_EQ(compared.exponents.size(), 2u);
  for (const FloquetExponent& again : compared.exponents) {
    EXPECT_NEAR(std::abs(again.exponent - options.modes[static_cast<std::size_t>(again.mode)].exponent), 0, 1e-6);
    EXPECT_EQ(again.off_nearest, 0);
  }
}

// A crank behind a soft coupling, struck: what the run does beside its cycle, cycle by cycle and crossing by crossing.
TEST(Floquet, AStruckCrankDriveRingsDownByItsExponent) {
  const Scene scene = scene_from(
      "line = [\"motor\", \"c\", \"crank\"]\n"
      "motor = { kind = \"dc shunt motor\", stall_torque = \"400 N*m\", no_load_speed = \"30 rad/s\", inertia = \"4 "
      "kg*m2\" }\nc = { kind = \"coupling\", stiffness = \"9 kN*m/rad\", damping = \"2 N*m*s/rad\" }\n"
      "crank = { kind = \"slider-crank\", radius = \"100 mm\", rod = \"350 mm\", crank_inertia = \"0.5 kg*m2\", "
      "slider_mass = \"60 kg\" }\n[effects]\nelasticity = true\n");
  const Cycle cycle = cycle_of(scene, 28);
  const FloquetSpectrum spectrum = cycle.spectrum();
  const auto swings = std::find_if(spectrum.exponents.begin(), spectrum.exponents.end(),
                                   [](const FloquetExponent& e) { return e.exponent.imag() > 1; });
  ASSERT_NE(swings, spectrum.exponents.end());
  EXPECT_GT(swings->share, 0.5);
  // Twists beside the cycle, of a cycle's samples; the disturbance is small enough to be linear.
  const auto model = cycle.map->shared_model();
  const PoincareSection& section = cycle.map->section();
  Equations equations(model, false);
  constexpr int samples = 4000, rounds = 6;
  constexpr double small = 1e-5;
  const Eigen::VectorXd coordinates = section.read_directions(swings->shape.real());
  const double from = section.state().t, step = rounds * spectrum.time / samples;
  const auto twists = [&](double by) {
    std::vector<double> y = section.place(equations, cycle.point.z + by * coordinates), found;
    for (int i = 0; i <= samples; ++i) {
      found.push_back(y[equations.twist_index(0)]);
      RunOptions run{.tolerance = 1e-12,
                     .method = "auto",
                     .until = from + step * (i + 1),
                     .budget = 100,
                     .interrupted = nullptr,
                     .progress = {}};
      run.from = {from + step * i, y};
      y = integrate(equations, run, {}).state;
    }
    return found;
  };
  const std::vector<double> struck = twists(small), left = twists(-small);
  int crossings = 0;
  for (std::size_t i = 0; i < samples; ++i) crossings += (struck[i] - left[i]) * (struck[i + 1] - left[i + 1]) < 0;
  EXPECT_NEAR(crossings * pi / (rounds * spectrum.time), swings->exponent.imag(), 1.5 * pi / (rounds * spectrum.time));
  // One mode's passages through the section: d_{n+2} = 2 Re μ d_{n+1} − |μ|² d_n.
  std::vector<Eigen::VectorXd> apart;
  Eigen::VectorXd above = cycle.point.z + small * coordinates, below = cycle.point.z - small * coordinates;
  for (int n = 0; n < 4; ++n) {
    apart.push_back(above - below);
    above = cycle.map->image(above, false).z, below = cycle.map->image(below, false).z;
  }
  Eigen::MatrixXd before(2 * coordinates.size(), 2);
  before << apart[1], apart[0], apart[2], apart[1];
  Eigen::VectorXd after(2 * coordinates.size());
  after << apart[2], apart[3];
  const Eigen::Vector2d fit = least_squares(before, after);
  EXPECT_NEAR(0.5 * std::log(-fit[1]) / spectrum.time, swings->exponent.real(), 1e-6);
  EXPECT_NEAR(0.5 * fit[0] / std::sqrt(-fit[1]), std::cos(swings->phase_advance), 1e-6);
  // Multipliers alone leave the multiple of the cycle's frequency open: here it is not the nearest to 0.
  EXPECT_GT(swings->phase_advance, 2 * pi);
}

}  // namespace
}  // namespace kurbel::test::floquet_test
