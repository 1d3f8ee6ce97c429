// nameplate_test.cpp — induction motors by what stands on their nameplate: poles, Kloss' breakdown point, and the
// two-axis circuit estimated from the currents.
#include "drivetrain/induction/nameplate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "tests/published/published.h"
#include "tests/support/elements.h"

namespace kurbel::nameplate_test {
namespace {

using test::figure;
using test::run;
using Complex = std::complex<double>;

// The steady circuit by Ohm's law alone: shaft torque and line current at a slip, no Thévenin.
struct AtSlip {
  double torque, current, power_factor;
};
AtSlip by_ohm(const EquivalentCircuit& c, double slip) {
  const Complex j{0, 1}, main = j * c.magnetising, rotor = c.rotor_resistance / slip + j * c.rotor_leakage;
  const Complex z = c.stator_resistance + j * c.stator_leakage + main * rotor / (main + rotor);
  const double phase = c.voltage / std::sqrt(3.0);
  const Complex i = phase / z, i_r = i * main / (main + rotor);
  return {3 * std::norm(i_r) * c.rotor_resistance / slip / c.synchronous_speed(), std::abs(i), std::cos(std::arg(i))};
}
double greatest_torque(const EquivalentCircuit& c) {
  double best = 0;
  for (int k = 1; k <= 200000; ++k) best = std::max(best, by_ohm(c, k * 5e-6).torque);
  return best;
}

// A machine made from its circuit, its nameplate read off by Ohm's law, and the circuit found again.
TEST(Nameplate, GivesBackTheCircuitThatItWasReadFrom) {
  std::mt19937 random(11);
  const auto some = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  for (int i = 0; i < 60; ++i) {
    const double x = some(0.5, 2), leakage = x * some(0.08, 0.16);
    const EquivalentCircuit c{
        some(200, 700), i % 2 ? 50.0 : 60.0, 1 + i % 4, x * some(0.01, 0.06), x * some(0.01, 0.05), leakage,
        leakage,        x * some(2, 5)};
    const double s_b = c.characteristic().breakdown_slip, slip = s_b * some(0.12, 0.35);
    const AtSlip rated = by_ohm(c, slip);
    Nameplate plate{.rated_speed = c.synchronous_speed() * (1 - slip),
                    .voltage = c.voltage,
                    .frequency = c.frequency,
                    .pole_pairs = c.pole_pairs,
                    .current = rated.current,
                    .breakdown_torque = c.characteristic().breakdown_torque,
                    .stator_share = some(0.3, 1)};
    plate.rated_power = rated.torque * plate.rated_speed;
    // Losses beside the rotor's are R_s' over the share: the share of them is R_s'.
    plate.input_power = rated.torque * c.synchronous_speed() +
                        3 * c.stator_resistance * rated.current * rated.current / plate.stator_share;
    const NameplateCircuit found = circuit_of(plate);
    ASSERT_EQ(found.fault, "") << i;
    EXPECT_NEAR(found.circuit.stator_resistance, c.stator_resistance, 1e-8 * x) << i;
    EXPECT_NEAR(found.circuit.rotor_resistance, c.rotor_resistance, 1e-8 * x) << i;
    EXPECT_NEAR(found.circuit.stator_leakage, c.stator_leakage, 1e-8 * x) << i;
    EXPECT_NEAR(found.circuit.rotor_leakage, c.rotor_leakage, 1e-8 * x) << i;
    EXPECT_NEAR(found.circuit.magnetising, c.magnetising, 1e-7 * c.magnetising) << i;
  }
}

// A catalogue motor (15 kW, 4 poles, 400 V, 28.5 A, cos φ 0.84, 1465 rpm, M_b/M_n 2.9).
constexpr const char* plate = R"(
line = ["motor"]
[motor]
kind           = "induction motor"
rated_power    = "15 kW"
rated_speed    = "1465 rpm"
poles          = 4
breakdown_ratio = 2.9
voltage        = "400 V"
frequency      = "50 Hz"
rated_current  = "28.5 A"
power_factor   = 0.84
inertia        = "0.1 kg*m2"
)";

TEST(Nameplate, TorqueCurrentAndBreakdownAreTheOnesThatItSays) {
  const double slip = 1 - 1465.0 / 1500, torque = 15e3 / (1465 * M_PI / 30);
  const Nameplate data{.rated_power = 15e3,
                       .rated_speed = 1465 * M_PI / 30,
                       .voltage = 400,
                       .frequency = 50,
                       .pole_pairs = 2,
                       .current = 28.5,
                       .input_power = std::sqrt(3.0) * 400 * 28.5 * 0.84,
                       .breakdown_torque = 2.9 * torque};
  const NameplateCircuit found = circuit_of(data);
  ASSERT_EQ(found.fault, "");
  const AtSlip rated = by_ohm(found.circuit, slip);
  EXPECT_NEAR(rated.torque, torque, 1e-9 * torque);
  EXPECT_NEAR(rated.current, 28.5, 1e-9 * 28.5);
  EXPECT_NEAR(greatest_torque(found.circuit), 2.9 * torque, 1e-8 * torque);
  // Half of 1.4 kW − … in the stator: the circuit takes less than the plate by the other half.
  const double losses = data.input_power - torque * 50 * M_PI;
  EXPECT_NEAR(3 * found.circuit.stator_resistance * 28.5 * 28.5, 0.5 * losses, 1e-9 * losses);
  EXPECT_NEAR(std::sqrt(3.0) * 400 * rated.current * rated.power_factor, data.input_power - 0.5 * losses,
              1e-9 * data.input_power);
  // As line_current has it.
  EXPECT_NEAR(line_current(found.circuit, slip).current, rated.current, 1e-12 * rated.current);
  EXPECT_NEAR(line_current(found.circuit, slip).power_factor, rated.power_factor, 1e-12);
}

TEST(Nameplate, UnderRatedTorqueTheMotorTurnsAtItsRatedSpeedWithItsRatedCurrent) {
  const Result r = run(std::string(plate) + fmt::format(R"(
[load]
kind   = "load"
on     = "motor"
torque = "{:.12g} N*m"
[run]
start    = {{ speed = "1465 rpm", on = "motor" }}
until    = "3 s"
accuracy = 1e-9
)",
                                                        15e3 / (1465 * M_PI / 30)));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(figure(r, "final_speed.motor"), 1465 * M_PI / 30, 1e-6);
  const double d = test::series(r, "stator_current_d.motor").back(),
               q = test::series(r, "stator_current_q.motor").back();
  EXPECT_NEAR(std::hypot(d, q), std::sqrt(2.0) * 28.5, 1e-5);
}

TEST(Nameplate, PowerFactorAndEfficiencySayTheSame) {
  const std::string end = "[run]\nuntil = \"0.3 s\"\n";
  const double efficiency = 15e3 / (std::sqrt(3.0) * 400 * 28.5 * 0.84);
  test::expect_same_machine(
      plate + end, test::with(plate + end, "power_factor   = 0.84", fmt::format("efficiency = {:.17g}", efficiency)));
}

// Without transients it is the static curve of its circuit.
TEST(Nameplate, WithoutTransientsItIsItsCharacteristic) {
  std::string off = plate;
  off += "[effects]\ntransients = false\n[run]\nuntil = \"0.5 s\"\nsamples = 20001\n";
  const Result r = run(off);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double torque = 15e3 / (1465 * M_PI / 30);
  const auto way_up = test::series(r, "torque.motor");
  EXPECT_NEAR(*std::max_element(way_up.begin(), way_up.end()), 2.9 * torque, 1e-5 * torque);  // it passes breakdown
}

// Without a frequency, too; then it may have a starter.
TEST(Nameplate, WithoutItsFrequencyItIsItsCharacteristic) {
  std::string off = plate;
  off += "[effects]\ntransients = false\n[run]\nuntil = \"0.5 s\"\n";
  const std::string without = test::with(off, "frequency      = \"50 Hz\"", "");
  test::expect_same_machine(off, without);
  const Result star = run(test::with(without, "poles ", "starting = \"star-delta\"\nswitch_time = \"0.2 s\"\npoles "));
  ASSERT_TRUE(star.complete) << star.diagnosis;
  EXPECT_NEAR(test::series(star, "torque.motor")[0], test::series(run(without), "torque.motor")[0] / 3, 1e-9);
}

// --- poles and Kloss' own point ---

constexpr const char* catalogue = R"(
line = ["motor"]
[motor]
kind              = "induction motor"
rated_power       = "15 kW"
rated_speed       = "1465 rpm"
synchronous_speed = "1500 rpm"
breakdown_ratio   = 2.9
inertia           = "0.1 kg*m2"
[run]
until = "0.3 s"
)";

TEST(Nameplate, PolesAndMainsAreTheSynchronousSpeed) {
  test::expect_same_machine(catalogue, test::with(catalogue, "synchronous_speed = \"1500 rpm\"", "poles = 4"));
  test::expect_same_machine(test::with(catalogue, "\"1500 rpm\"", "\"1800 rpm\""),
                            test::with(catalogue, "synchronous_speed = \"1500 rpm\"", "poles = 4\nmains = \"60 Hz\""));
}

TEST(Nameplate, KlossByItsBreakdownPointIsTheCatalogues) {
  const double torque = 15e3 / (1465 * M_PI / 30), s = 1 - 1465.0 / 1500, s_b = s * (2.9 + std::sqrt(2.9 * 2.9 - 1));
  const std::string point =
      fmt::format("breakdown_torque = \"{:.17g} N*m\"\nbreakdown_slip = {:.17g}", 2.9 * torque, s_b);
  const Result by_point = run(test::with(catalogue, "breakdown_ratio   = 2.9", point)), by_ratio = run(catalogue);
  const auto a = test::series(by_point, "torque.motor"), b = test::series(by_ratio, "torque.motor");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t row = 0; row < a.size(); ++row) EXPECT_NEAR(a[row], b[row], 1e-6 * torque) << row;
  // Without rated data only the scale of the errors is another.
  std::string bare = test::with(catalogue, "breakdown_ratio   = 2.9", point);
  bare = test::with(test::with(bare, "rated_power       = \"15 kW\"", ""), "rated_speed       = \"1465 rpm\"", "");
  EXPECT_NEAR(figure(run(bare), "final_speed.motor"), figure(run(catalogue), "final_speed.motor"), 1e-4);
}

// Catalogues give M_pull-up, seldom where.
TEST(Nameplate, PullUpWithoutItsSpeedLiesAtTheSeventhHarmonics) {
  const std::string points = test::with(catalogue, "breakdown_ratio   = 2.9",
                                        "breakdown_ratio = 2.9\nstarting_ratio = 2.2\npull_up_ratio = 1.8");
  const std::string end = fmt::format("pull_up_ratio = 1.8\npull_up_speed = \"{:.17g} rad/s\"", 50 * M_PI / 7);
  test::expect_same_machine(points, test::with(points, "pull_up_ratio = 1.8", end));
}

}  // namespace
}  // namespace kurbel::nameplate_test
