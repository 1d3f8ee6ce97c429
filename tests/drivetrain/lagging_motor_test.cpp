// lagging_motor_test.cpp — static curves of induction motors with the lag of their fluxes: against the two-axis model over
// slips and frequencies, in modes of a chain, by closed forms at standstill, switched off and on, and where it is off.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "drivetrain/induction/induction_circuit.h"
#include "drivetrain/induction/lagging_motor.h"
#include "studies/modes/modes.h"
#include "studies/steady/steady.h"
#include "tests/published/published.h"
#include "tests/support/eigen_solutions.h"
#include "tests/support/elements.h"

namespace kurbel::lagging_motor_test {
namespace {

using test::run;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// Krause, Wasynczuk, Sudhoff: Analysis of Electric Machinery, table 4.10-1: 3, 50 and 2250 hp; one with almost no
// resistance in its stator and little field current.
const EquivalentCircuit small{220, 60, 2, 0.435, 0.816, 0.754, 0.754, 26.13};
const EquivalentCircuit middle{460, 60, 2, 0.087, 0.228, 0.302, 0.302, 13.08};
const EquivalentCircuit large{2300, 60, 2, 0.029, 0.022, 0.226, 0.226, 13.04};
const EquivalentCircuit ideal{400, 50, 2, 0.002, 0.2, 1, 1, 100};

double breakdown_slip(const EquivalentCircuit& circuit) { return circuit.characteristic().breakdown_slip; }

// ∂M/∂ω of a small oscillation of the speed about a slip: the two-axis model's, by its four currents.
class SmallOscillations {
 public:
  SmallOscillations(const EquivalentCircuit& circuit, double slip) : motor_{circuit, circuit.characteristic()} {
    omega_ = (1 - slip) * circuit.synchronous_speed();
    double at[4];
    motor_.first_states(state(omega_, at), at);
    // Rates are bilinear in currents and speed, the torque in the currents: differences of any length are exact.
    for (int k = 0; k < 4; ++k) {
      double up[4], down[4];
      for (int i = 0; i < 4; ++i) up[i] = at[i] + (i == k), down[i] = at[i] - (i == k);
      by_current_.col(k) = 0.5 * (rates(omega_, up) - rates(omega_, down));
      torque_by_[k] = 0.5 * (motor_.torque(state(omega_, up)) - motor_.torque(state(omega_, down)));
    }
    by_speed_ = 0.5 * (rates(omega_ + 1, at) - rates(omega_ - 1, at));
  }
  Complex two_axis(double frequency) const {
    const Complex i_omega{0, 2 * pi * frequency};
    const Eigen::Matrix4cd system = i_omega * Eigen::Matrix4cd::Identity() - by_current_.cast<Complex>();
    return torque_by_.cast<Complex>().dot(test::solved_complex(system, by_speed_.cast<Complex>()));
  }
  double slope() const {
    ShaftState<Dual<1>> x{0, {}, Dual<1>::input(omega_, 0), 0, 1};
    return motor_.line.torque(x).d[0];
  }
  // By the element's own rates, whose state is its torque.
  Complex with_lag(double frequency) const {
    const LaggingMotor lagging(motor_.line, {motor_.line.breakdown_slip, motor_.circuit.frequency});
    using Number = Dual<2>;
    const Number own = Number::input(motor_.line.torque(ShaftState<double>{0, 0, omega_, 0, 1}), 1);
    ShaftState<Number> x{0, {}, Number::input(omega_, 0), 0, 1, 1, &own};
    Number rate;
    lagging.rates(x, &rate);
    EXPECT_NEAR(rate.value, 0, 1e-9 * motor_.line.breakdown_torque);
    return rate.d[0] / (Complex{0, 2 * pi * frequency} - rate.d[1]);
  }

 private:
  static ShaftState<double> state(double omega, const double* currents) { return {0, 0, omega, 0, 1, 1, currents}; }
  Eigen::Vector4d rates(double omega, const double* currents) const {
    Eigen::Vector4d rate;
    motor_.rates(state(omega, currents), rate.data());
    return rate;
  }

  TwoAxisMotor motor_;
  double omega_ = 0;
  Eigen::Matrix4d by_current_;
  Eigen::Vector4d torque_by_, by_speed_;
};

// What drivetrain/induction/lagging_motor.h says of it, over the slope at the synchronous speed.
TEST(LaggingMotor, FollowsOscillationsOfTheSpeedAsTheTwoAxisModelDoes) {
  for (const EquivalentCircuit& circuit : {small, middle, large, ideal}) {
    const double sb = breakdown_slip(circuit), usual = std::abs(SmallOscillations(circuit, 0).slope());
    for (const double part : {-0.25, 0.0, 0.1, 0.25, 0.5}) {
      const SmallOscillations swings(circuit, part * sb);
      EXPECT_NEAR(swings.two_axis(0).real(), swings.slope(), 1e-9 * usual);
      for (const double frequency : {0.1 * sb, 0.5 * sb, sb, 2 * sb, 0.25, 0.5, 0.8, 1.2, 2.0}) {
        const Complex really = swings.two_axis(frequency * circuit.frequency);
        const double off = std::abs(really - swings.with_lag(frequency * circuit.frequency)) / usual;
        const double curve = std::abs(really - swings.slope()) / usual;
        const auto where = fmt::format("s_b {:.3g}, slip {} s_b, {:.3g} f", sb, part, frequency);
        if (frequency <= 0.5) {
          EXPECT_LT(off, std::abs(part) <= 0.25 ? 0.17 : 0.22) << where;
        }
        EXPECT_LT(off, 0.3) << where;
        if (std::abs(part) <= 0.25 && frequency >= sb) {
          EXPECT_LT(off, 0.4 * curve) << where;
        }
      }
    }
  }
  // Without a stator resistance and at the synchronous speed the fluxes are of first order.
  const SmallOscillations idling(ideal, 0);
  for (const double frequency : {1.0, 5.0, 20.0, 40.0, 100.0})
    EXPECT_LT(std::abs(idling.two_axis(frequency) / idling.with_lag(frequency) - 1.0), 0.02) << frequency;
}

std::string motor_keys(const EquivalentCircuit& c, bool currents) {
  return fmt::format(
      "kind = \"induction motor\"\nvoltage = \"{} V\"\n{} = \"{} Hz\"\npole_pairs = {}\nstator_resistance = \"{} "
      "Ohm\"\nrotor_resistance = \"{} Ohm\"\nstator_reactance = \"{} Ohm\"\nrotor_reactance = \"{} "
      "Ohm\"\nmagnetising_reactance = \"{} Ohm\"\n",
      c.voltage, currents ? "frequency" : "mains", c.frequency, c.pole_pairs, c.stator_resistance, c.rotor_resistance,
      c.stator_leakage, c.rotor_leakage, c.magnetising);
}

// The large motor on a shaft with a natural frequency, and a fan that loads it to a tenth of its breakdown slip.
std::string chain(double hertz, const std::string& effects, bool currents = true) {
  const double j1 = 63.87, j2 = 51.1, omega = (1 - 0.1 * breakdown_slip(large)) * large.synchronous_speed();
  const double stiffness = std::pow(2 * pi * hertz, 2) / (1 / j1 + 1 / j2);
  const double torque = large.characteristic().torque(ShaftState<double>{0, 0, omega, 0, 1});
  return fmt::format(R"(
line = ["motor", "shaft", "fan"]
effects = {{ elasticity = true{} }}
run = {{ start = {{ speed = "{} rad/s", equilibrium = true }}, until = "1 s" }}
[shaft]
kind = "coupling"
stiffness = "{} N*m/rad"
damping_ratio = 0.0005
[fan]
kind = "load"
inertia = "{} kg*m2"
quadratic = "{} N*m*s2/rad2"
[motor]
{}inertia = "{} kg*m2"
)",
                     effects, omega, stiffness, j2, torque / (omega * omega), motor_keys(large, currents), j1);
}

// Of the eigenvalue nearest to a frequency: |λ| [Hz] and ζ.
std::pair<double, double> mode_near(double hertz, const std::string& effects) {
  const Scene scene = test::scene_from(chain(hertz, effects));
  const ModesStudy study = find_modes(scene, scene.effects, {});
  Complex nearest = 0;
  for (const DampedMode& mode : study.damped)
    if (std::abs(mode.lambda - Complex{0, 2 * pi * hertz}) < std::abs(nearest - Complex{0, 2 * pi * hertz}))
      nearest = mode.lambda;
  return {std::abs(nearest) / (2 * pi), -nearest.real() / std::abs(nearest)};
}

// The curve's slope is no damper: it makes 0.06 of 3e-5 at 58 Hz.
TEST(LaggingMotor, ModesOfAChainAreThoseOfTheTwoAxisModel) {
  for (const double hertz : {10.0, 20.0, 30.0, 58.0, 100.0}) {
    const auto [really, damping] = mode_near(hertz, "");
    const auto [lagging, with_lag] = mode_near(hertz, ", transients = false");
    const auto [curve, of_curve] = mode_near(hertz, ", transients = false, torque_lag = false");
    EXPECT_NEAR(lagging, really, 0.005 * really);
    EXPECT_NEAR(with_lag, damping, hertz <= 30 ? 0.45 * damping : 7e-4) << hertz;
    EXPECT_GT(of_curve, 5 * damping) << hertz;
    EXPECT_GT(std::abs(curve - really), std::abs(lagging - really));
  }
}

// Held at standstill, of torque M_s there: M_s (1 − e^{−t/T}); off none, meanwhile what is left decays as fast, and on
// again it goes on from there.
TEST(LaggingMotor, AtStandstillItsTorqueComesAndGoesWithItsFluxes) {
  const Result r = run(R"(
line = ["motor", "shaft", "disc"]
effects = { elasticity = true }
motor = { kind = "induction motor", breakdown_torque = "120 N*m", breakdown_slip = 0.2, synchronous_speed = "1500 rpm", inertia = "0.1 kg*m2" }
drum = { kind = "prescribed speed", on = "motor", speed = "0 rad/s" }
shaft = { kind = "coupling", stiffness = "1 kN*m/rad", damping = "1 N*m*s/rad" }
disc = { kind = "inertia", inertia = "0.1 kg*m2" }
sequence = { steps = [{ at = "0.02 s", set = "motor", to = 0 }, { at = "0.03 s", set = "motor", to = 1 }] }
run = { until = "0.1 s", samples = 1001, accuracy = 1e-9 }
)");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double held = 2 * 120 * 0.2 / (1 + 0.04), lag = 1 / (0.2 * 2 * pi * 50);
  const std::vector<double> torque = test::series(r, "torque.motor");
  for (std::size_t row = 0; row < torque.size(); ++row) {
    const double t = r.trajectory->time()[row];
    const double left = held * (1 - std::exp(-0.02 / lag)) * std::exp(-0.01 / lag);
    const double expected =
        t < 0.02 ? held * (1 - std::exp(-t / lag)) : held + (left - held) * std::exp(-(t - 0.03) / lag);
    if (t > 0.0201 && t < 0.0299) {
      EXPECT_EQ(torque[row], 0) << t;
    }
    if (t < 0.0199 || t > 0.0301) {
      EXPECT_NEAR(torque[row], expected, 1e-6) << t;
    }
  }
}

// A machine that already turns has the curve's torque, and its work is that of its torque, not of the curve's.
TEST(LaggingMotor, WorksWithItsEnergyInBalance) {
  for (const char* start : {"\"rest\"", "{ speed = \"1440 rpm\" }"})
    for (const char* starting :
         {"", ", starting = \"star-delta\", switch_time = \"0.3 s\", pause = \"40 ms\"",
          ", starting = \"soft start\", ramp = \"0.5 s\"",
          ", starting = \"frequency converter\", ramp = \"0.5 s\", torque_limit = \"200 N*m\""}) {
      const std::string text = fmt::format(R"(
line = ["motor", "shaft", "fan"]
effects = {{ elasticity = true }}
motor = {{ kind = "induction motor", rated_power = "15 kW", rated_speed = "1460 rpm", synchronous_speed = "1500 rpm", breakdown_ratio = 3, starting_ratio = 2, inertia = "0.1 kg*m2"{} }}
shaft = {{ kind = "coupling", stiffness = "2 kN*m/rad", damping = "1 N*m*s/rad" }}
fan = {{ kind = "load", inertia = "0.5 kg*m2", damping = "0.5 N*m*s/rad" }}
run = {{ start = {}, until = "1 s", accuracy = 1e-8 }}
)",
                                           starting, start);
      const Result r = run(text);
      ASSERT_TRUE(r.complete) << r.diagnosis;
      EXPECT_LT(r.energy.relative, 1e-6) << starting;
      EXPECT_EQ(r.model->internal_states.size(), 1u);
      EXPECT_FALSE(r.model->has_memory());
      test::expect_exact_jacobian_near_start(text, {3.0});
      const auto torque = test::series(r, "torque.motor"), fluxes = test::series(r, "lagging_torque.motor");
      EXPECT_EQ(torque.front(), fluxes.front());
      if (start[0] == '"') {
        EXPECT_EQ(torque.front(), 0);
      }
      EXPECT_TRUE(std::any_of(r.notes.begin(), r.notes.end(), [](const std::string& note) {
        return note.find("lag of the fluxes") != std::string::npos;
      }));
    }
}

// Where nothing is elastic, and where it is switched off, it leaves no trace; a circuit without its currents is its curve.
TEST(LaggingMotor, LeavesNoTraceWhereItIsOff) {
  const auto with = [](const std::string& effects) { return chain(20, effects); };
  const auto rigid = [](const std::string& effects) {
    return test::with(chain(20, effects), "elasticity = true", "elasticity = false");
  };
  test::expect_same_machine(rigid(", transients = false"), rigid(", transients = false, torque_lag = false"));
  test::expect_same_machine(with(", transients = false"), chain(20, "", false));
  test::expect_same_machine(with(", transients = false, torque_lag = false"), chain(20, ", torque_lag = false", false));
  test::expect_same_machine(with(""), with(", torque_lag = false"));  // its currents are there
  const Scene scene = test::scene_from(chain(20, "", false));
  EXPECT_EQ(compile(scene, scene.effects)->internal_states.size(), 1u);
  EXPECT_TRUE(compile(scene, without_elasticity(scene.effects))->internal_states.empty());
  EXPECT_TRUE(compile(scene, parse_effects("elasticity,-torque_lag", scene))->internal_states.empty());
  EXPECT_EQ(compile(scene, parse_effects("elasticity", scene))->internal_states.size(), 1u);
}

// The mean torque at a constant speed is the curve's: operating points are no estimates, and the machine settles there.
TEST(LaggingMotor, OperatingPointsAreThoseOfTheCurve) {
  const Scene scene = test::scene_from(chain(20, "", false));
  SteadyOptions options;
  options.start_search = false;
  const SteadyStudy study = steady(scene, {scene.effects}, options);
  ASSERT_TRUE(study.diagram);
  EXPECT_FALSE(study.diagram->estimate);
  ASSERT_FALSE(study.diagram->points.empty());
  EXPECT_NEAR(study.diagram->points.back().speed.value, scene.run.start.speed, 1e-6 * scene.run.start.speed);
}

}  // namespace
}  // namespace kurbel::lagging_motor_test
