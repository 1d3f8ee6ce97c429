// two_axis_motor_test.cpp — induction motor by its two-axis circuit: steady curve, energy, switching on, plugging,
// switching off and on again, catalogue data.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <random>

#include "drivetrain/induction/induction_circuit.h"
#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/elements.h"

namespace kurbel::two_axis_motor_test {
namespace {

using test::figure;
using test::run;
using Complex = std::complex<double>;

// 3 hp, 220 V, 60 Hz, four poles (Krause, Wasynczuk, Sudhoff: Analysis of Electric Machinery, table 4.10-1).
const EquivalentCircuit krause{220, 60, 2, 0.435, 0.816, 0.754, 0.754, 26.13};
std::string krause_scene(const std::string& rest, const std::string& more = "") {
  return R"(
line = ["motor"]
[motor]
kind = "induction motor"
voltage = "220 V"
frequency = "60 Hz"
pole_pairs = 2
stator_resistance = "0.435 Ohm"
rotor_resistance = "0.816 Ohm"
stator_reactance = "0.754 Ohm"
rotor_reactance = "0.754 Ohm"
magnetising_reactance = "26.13 Ohm"
inertia = "0.089 kg*m2"
)" + more +
         "\n" + rest;
}

TwoAxisMotor motor_of(const EquivalentCircuit& circuit) { return {circuit, circuit.characteristic()}; }

// Torque of the equivalent circuit by its branch currents: 3 |I_r|² R_r/s over ω_s, phasors effective.
double torque_of_circuit(const EquivalentCircuit& c, double omega) {
  const double slip = 1 - omega / c.synchronous_speed();
  const Complex j{0, 1}, rotor = c.rotor_resistance / slip + j * c.rotor_leakage, shunt = j * c.magnetising;
  const Complex whole = c.stator_resistance + j * c.stator_leakage + shunt * rotor / (shunt + rotor);
  const Complex stator_current = c.voltage / std::sqrt(3.0) / whole;
  const Complex rotor_current = stator_current * shunt / (shunt + rotor);
  return 3 * std::norm(rotor_current) * c.rotor_resistance / slip / c.synchronous_speed();
}

TEST(TwoAxisMotor, SteadyTorqueIsThatOfTheEquivalentCircuit) {
  const TwoAxisMotor motor = motor_of(krause);
  for (const double omega : {-180.0, -60.0, 1.0, 60.0, 150.0, 179.07, 185.0, 190.0, 260.0}) {
    double current[4], rate[4];
    ShaftState<double> x{0, 0, omega, 0, 1, 1, current};
    motor.first_states(x, current);
    motor.rates(x, rate);
    for (const double r : rate) EXPECT_NEAR(r, 0, 1e-7);  // A/s, of currents of 100 A at 377 rad/s
    const double expected = torque_of_circuit(krause, omega);
    EXPECT_NEAR(motor.torque(x), expected, 1e-11 * std::abs(expected)) << omega;
    EXPECT_NEAR(motor.line.torque(x), expected, 1e-11 * std::abs(expected)) << omega;  // Kloss with a
  }
}

// Switched on at a given speed the transients die away to that curve; the slow one as R/L_m, with 4 1/s.
TEST(TwoAxisMotor, TransientsEndOnTheSteadyCurve) {
  for (const double omega : {20.0, 150.0, 179.07, 200.0}) {
    const Result r = run(krause_scene(fmt::format(
        "[drum]\nkind = \"prescribed speed\"\non = \"motor\"\nspeed = \"{} rad/s\"\n[sequence]\nsteps = [{{ at = \"0 "
        "s\", set = \"motor\", to = 0 }}, {{ at = \"0.01 s\", set = \"motor\" }}]\n[run]\nuntil = \"8 s\"\naccuracy = "
        "1e-10\n",
        omega)));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const double expected = torque_of_circuit(krause, omega);
    EXPECT_NEAR(test::series(r, "torque.motor").back(), expected, 1e-8 * std::abs(expected));
  }
}

// 3/2 Re(u i_s*) = 3/2 (R_s |i_s|² + R_r |i_r|²) + dW/dt + M ω with the field's energy W, at any state, on or off.
TEST(TwoAxisMotor, ElectricalPowerIsHeatFieldAndShaft) {
  std::mt19937 random(3);
  const auto some = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  for (int i = 0; i < 300; ++i) {
    const EquivalentCircuit circuit{some(100, 700), some(20, 100), 1 + i % 4,    some(0, 2),
                                    some(0.01, 3),  some(0.1, 3),  some(0.1, 3), some(5, 100)};
    const TwoAxisMotor m = motor_of(circuit);
    double c[4], rate[4];
    for (double& part : c) part = some(-100, 100);
    ShaftState<double> x{0, 0, some(-300, 300), i % 2, 1, some(-1, 1), c};
    x.on = i % 5 != 0;
    if (!x.on) c[0] = c[1] = 0;
    m.rates(x, rate);
    const double ls = m.stator(), lr = m.rotor(), lm = m.mutual();
    double stored = 0;  // dW/dt, W = 3/4 (L_s |i_s|² + 2 L_m Re i_s i_r* + L_r |i_r|²)
    for (int k = 0; k < 2; ++k)
      stored +=
          1.5 * (ls * c[k] * rate[k] + lm * (c[k] * rate[k + 2] + c[k + 2] * rate[k]) + lr * c[k + 2] * rate[k + 2]);
    const double heat = 1.5 * (circuit.stator_resistance * (c[0] * c[0] + c[1] * c[1]) +
                               circuit.rotor_resistance * (c[2] * c[2] + c[3] * c[3]));
    const double fed = 1.5 * m.phase_peak() * std::abs(x.command) * c[0], shaft = m.torque(x) * x.rate;
    EXPECT_NEAR(fed, heat + stored + shaft, 1e-10 * (std::abs(fed) + heat + std::abs(stored) + std::abs(shaft)));
  }
}

// Switched on with the rotor held the circuit is linear: L di/dt = A i + u, solved by its eigenvalues. The torque
// oscillates with the frequency of the mains, to a first peak far above the steady starting torque.
TEST(TwoAxisMotor, SwitchedOnItsTorqueOscillatesWithTheMains) {
  const Result r =
      run(krause_scene("[drum]\nkind = \"prescribed speed\"\non = \"motor\"\nspeed = \"0 rad/s\"\n[run]\nuntil "
                       "= \"0.2 s\"\nsamples = 2001\naccuracy = 1e-10\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const TwoAxisMotor m = motor_of(krause);
  Eigen::Matrix4d a;
  Eigen::Vector4d fed;
  double zero[4] = {0, 0, 0, 0}, rate[4];
  m.rates(ShaftState<double>{0, 0, 0, 0, 1, 1, zero}, rate);
  fed << rate[0], rate[1], rate[2], rate[3];
  for (int k = 0; k < 4; ++k) {
    double unit[4] = {0, 0, 0, 0};
    unit[k] = 1;
    m.rates(ShaftState<double>{0, 0, 0, 0, 1, 1, unit}, rate);
    for (int i = 0; i < 4; ++i) a(i, k) = rate[i] - fed[i];
  }
  const test::EigenSolution modes = test::eigen_solution(a);
  for (const auto& lambda : modes.values) EXPECT_NEAR(std::abs(lambda.imag()), 2 * M_PI * 60, 1e-6 * 377);
  const Eigen::VectorXd rest = -test::solved(a, fed);
  const Eigen::VectorXcd part = test::solved_complex(modes.vectors, (-rest).cast<Complex>());
  const auto torque = test::series(r, "torque.motor");
  double highest = 0;
  for (std::size_t row = 0; row < torque.size(); ++row) {
    const double t = r.trajectory->time()[row];
    Eigen::Vector4cd i = rest.cast<Complex>();
    for (int k = 0; k < 4; ++k) i += part[k] * std::exp(modes.values[k] * t) * modes.vectors.col(k);
    const double c[4] = {i[0].real(), i[1].real(), i[2].real(), i[3].real()};
    const double expected = m.torque(ShaftState<double>{0, 0, 0, 0, 1, 1, c});
    ASSERT_NEAR(torque[row], expected, 1e-6) << t;
    highest = std::max(highest, torque[row]);
  }
  EXPECT_GT(highest, 1.5 * torque_of_circuit(krause, 0));
}

// Free acceleration of the 3 hp machine: it comes up to synchronous speed within 0.6 s (the book's figure 4.10-1).
TEST(TwoAxisMotor, RunsUpToSynchronousSpeedWithItsEnergyInBalance) {
  const Result r = run(krause_scene("[run]\nuntil = \"1.5 s\"\naccuracy = 1e-9\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_speed.motor"), 60 * M_PI, 1e-3);
  EXPECT_LT(r.energy.relative, 1e-8);
}

// Command −1 reverses the field: it brakes through standstill and runs up backwards; by its circuit and by Kloss.
TEST(TwoAxisMotor, IsPluggedAndRunsBackwards) {
  for (const char* effects : {"", "[effects]\ntransients = false\n"}) {
    const Result r =
        run(krause_scene(std::string(effects) +
                         "[sequence]\nsteps = [{ at = \"1.5 s\", set = \"motor\", to = -1 }]\n[run]\nuntil = "
                         "\"5 s\"\naccuracy = 1e-8\n"));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_NEAR(figure(r, "final_speed.motor"), -60 * M_PI, 1e-5);
    bool reported = false;
    for (const Event& e : r.events) reported = reported || (e.what == "is set -1" && e.from == "on" && e.t == 1.5);
    EXPECT_TRUE(reported);
  }
}

// Off the stator has no current, and the rotor's field decays with L_r/R_r as seen from the rotor.
TEST(TwoAxisMotor, SwitchedOffItsRotorKeepsItsFlux) {
  const Result r =
      run(krause_scene("[sequence]\nsteps = [{ at = \"1 s\", set = \"motor\", to = 0 }, { at = \"1.1 s\", set "
                       "= \"motor\" }]\n[run]\nstart = { speed = \"188 rad/s\" }\nuntil = \"1.2 s\"\nsamples = "
                       "1201\naccuracy = 1e-10\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto d = test::series(r, "rotor_current_d.motor"), q = test::series(r, "rotor_current_q.motor"),
             stator = test::series(r, "stator_current_q.motor"), torque = test::series(r, "torque.motor");
  const TwoAxisMotor m = motor_of(krause);
  const double decay = krause.rotor_resistance / m.rotor();
  for (std::size_t row = 1001; row < 1100; ++row) {
    EXPECT_EQ(stator[row], 0);
    EXPECT_EQ(torque[row], 0);
    EXPECT_NEAR(
        std::hypot(d[row], q[row]),
        std::hypot(d[1001], q[1001]) * std::exp(-decay * (r.trajectory->time()[row] - r.trajectory->time()[1001])),
        1e-6);
  }
  const double flux_before =
      std::hypot(m.mutual() * test::series(r, "stator_current_d.motor")[999] + m.rotor() * d[999],
                 m.mutual() * stator[999] + m.rotor() * q[999]);
  EXPECT_NEAR(m.rotor() * std::hypot(d[1001], q[1001]), flux_before * std::exp(-decay * 1e-3), 1e-4 * flux_before);
  EXPECT_GT(*std::max_element(torque.begin() + 1100, torque.end()), 10);  // it meets the mains out of phase
}

// From catalogue data: the circuit that is made for them has the same Kloss curve.
TEST(TwoAxisMotor, CircuitFromTheCatalogueHasItsCurve) {
  for (const double a : {0.0, 0.7, 1.5})
    for (const double ratio : {5.0, 30.0, 200.0}) {
      const auto kloss = InductionMotor::from_catalogue(15e3, 1460 * M_PI / 30, 50 * M_PI, 2.7, a, 1);
      const InductionMotor back = EquivalentCircuit::of(kloss, 50, ratio).characteristic();
      EXPECT_NEAR(back.breakdown_torque, kloss.breakdown_torque, 1e-11 * kloss.breakdown_torque);
      EXPECT_NEAR(back.breakdown_slip, kloss.breakdown_slip, 1e-11);
      EXPECT_NEAR(back.resistance_ratio, kloss.resistance_ratio, 1e-11);
      EXPECT_NEAR(back.synchronous_speed, kloss.synchronous_speed, 1e-11 * kloss.synchronous_speed);
    }
}

TEST(TwoAxisMotor, JacobianEqualsDifferencesInEveryMode) {
  for (const char* to : {"1", "0.6", "0", "-1"})
    test::expect_exact_jacobian_near_start(
        krause_scene(
            fmt::format("[sequence]\nsteps = [{{ at = \"0 s\", set = \"motor\", to = {} }}]\n[run]\nstart = {{ "
                        "speed = \"160 rad/s\" }}\n",
                        to)),
        {3, -20, 10, 5, 30});
}

TEST(TwoAxisMotor, WithoutTransientsItIsItsCharacteristic) {
  const std::string catalogue = R"(
line = ["motor"]
[motor]
kind = "induction motor"
rated_power = "15 kW"
rated_speed = "1460 rpm"
synchronous_speed = "1500 rpm"
breakdown_ratio = 2.7
resistance_ratio = 0.8
frequency = "50 Hz"
inertia = "0.2 kg*m2"
)";
  const std::string end = "[run]\nuntil = \"1 s\"\n";
  test::expect_same_machine(catalogue + "[effects]\ntransients = false\n" + end,
                            test::with(catalogue + end, "frequency = \"50 Hz\"", ""));
  // With them it comes to the same speed under the same load.
  const std::string loaded =
      "[fan]\nkind = \"load\"\non = \"motor\"\nquadratic = \"4 mN*m*s2/rad2\"\n[run]\nuntil = \"4 "
      "s\"\naccuracy = 1e-9\n";
  EXPECT_NEAR(figure(run(catalogue + loaded), "final_speed.motor"),
              figure(run(catalogue + "[effects]\ntransients = false\n" + loaded), "final_speed.motor"), 1e-5);
}

}  // namespace
}  // namespace kurbel::two_axis_motor_test
