// modes_by_energy_test.cpp — natural frequencies and modes of internal states apart: a motor's winding behind two inertias and a
// spring, by hand; and natural frequencies that wait for no start.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/deadline.h"
#include "studies/modes/modes.h"
#include "studies/modes/modes_plots.h"
#include "studies/variants/machine.h"
#include "tests/support/scenes.h"

namespace kurbel::modes_by_energy_test {
namespace {

using std::numbers::pi;
constexpr double j1 = 0.4, j2 = 0.6, inductance = 0.06, resistance = 0.8, constant = 2.1;

std::string fan_drive(double stiffness, double of_coupling, double of_fan) {
  return fmt::format(R"(
line = ["motor", "coupling", "fan"]
motor = {{ kind = "dc shunt motor", voltage = "220 V", resistance = "0.8 Ohm", constant = "2.1 N*m/A", inductance = "60 mH", inertia = "0.4 kg*m2" }}
coupling = {{ kind = "coupling", stiffness = "{} N*m/rad", damping = "{} N*m*s/rad" }}
fan = {{ kind = "load", inertia = "0.6 kg*m2", damping = "{} N*m*s/rad" }}
effects = {{ elasticity = true, transients = true }}
run = {{ start = "rest", until = "20 s" }}
)",
                     stiffness, of_coupling, of_fan);
}

ModesStudy modes_of(const std::string& text) {
  const Scene scene = test::scene_from(text);
  return find_modes(scene, scene.effects, {});
}

double torsional(double stiffness) { return std::sqrt(stiffness * (1 / j1 + 1 / j2)); }

// L di/dt = U − R i − c ω₁: with the inertia of the whole at some 8.6 rad/s, far below the spring's 61 rad/s. Number 1 is
// the spring's all the same, undamped.
TEST(ModesByEnergy, AnElectricalModeBelowTheFirstTorsionalOneIsNoNaturalFrequency) {
  const ModesStudy m = modes_of(fan_drive(900, 0.7, 1.1));
  ASSERT_EQ(m.modes.size(), 2u);
  ASSERT_EQ(natural_modes(m), 1u);
  const Mode &spring = m.modes[0], &winding = m.modes[1];
  EXPECT_NEAR(spring.omega, torsional(900), 1e-9 * spring.omega);
  EXPECT_FALSE(spring.of_internal_states);
  EXPECT_EQ(modes::nature_of(m, spring), "torsional");
  EXPECT_TRUE(winding.of_internal_states);
  EXPECT_LT(winding.omega, 0.2 * spring.omega);
  EXPECT_EQ(modes::nature_of(m, winding), "mechanical and electrical");
  EXPECT_EQ(spring.number, 1);
  EXPECT_EQ(winding.number, 2);
}

// The eigenvectors of [θ, ω₁, ω₂, i] by hand, and ½ k θ², ½ J ω², ½ L i² in them.
TEST(ModesByEnergy, SharesAreThoseOfTheStoredEnergies) {
  for (const double k : {900.0, 60.0}) {
    const double c = 0.7, d = 1.1;
    const ModesStudy m = modes_of(fan_drive(k, c, d));
    Eigen::MatrixXd a(4, 4);
    a << 0, 1, -1, 0,                             //
        -k / j1, -c / j1, c / j1, constant / j1,  //
        k / j2, c / j2, -(c + d) / j2, 0,         //
        0, -constant / inductance, 0, -resistance / inductance;
    const Eigenpairs pairs = eigenpairs(a);
    std::vector<std::pair<std::complex<double>, EnergyParts>> found;
    for (const Mode& mode : m.modes) found.emplace_back(mode.lambda, mode.energy);
    // Large drives have them by Newton's method.
    for (const DampedMode& mode : damped_modes(m.drive, m.undamped, {.dense_below = 0}))
      found.emplace_back(mode.lambda, mode.energy);
    EXPECT_EQ(found.size(), m.modes.size() + 1);
    for (const auto& [lambda, energy] : found) {
      Eigen::Index nearest = 0;
      (pairs.values.array() - lambda).abs().minCoeff(&nearest);
      EXPECT_LT(std::abs(pairs.values[nearest] - lambda), 1e-9 * std::abs(lambda));
      const Eigen::Array4d e = pairs.vectors.col(nearest).array().abs2() * Eigen::Array4d(k, j1, j2, inductance);
      EXPECT_NEAR(energy.springs, e[0] / e.sum(), 1e-9);
      EXPECT_NEAR(energy.inertias, (e[1] + e[2]) / e.sum(), 1e-9);
      ASSERT_EQ(energy.own.size(), 1u);
      EXPECT_NEAR(energy.own[0], e[3] / e.sum(), 1e-9);
    }
  }
}

// λ² + λ R/L + c²/(L J) = 0 on a shaft that is all but rigid: half of the energy in the winding, half in the inertias.
TEST(ModesByEnergy, AWindingAndAnInertiaShareTheirEnergyInHalves) {
  const ModesStudy m = modes_of(fan_drive(9e6, 2000, 0));
  ASSERT_EQ(m.modes.size(), 2u);
  const Mode& winding = m.modes[1];
  const double omega = constant / std::sqrt(inductance * (j1 + j2)), zeta = resistance / (2 * inductance * omega);
  EXPECT_NEAR(winding.omega, omega, 1e-5 * omega);
  EXPECT_NEAR(winding.ratio, zeta, 1e-5);
  EXPECT_NEAR(winding.energy.in_internal_states(), 0.5, 1e-5);
  EXPECT_NEAR(winding.energy.inertias, 0.5, 1e-5);
  EXPECT_NE(modes::energy_text(m, winding).find("current of motor 50 %"), std::string::npos)
      << modes::energy_text(m, winding);
}

TEST(ModesByEnergy, FiguresOfASweepDistinguishThem) {
  MachineQuestion question;
  question.text = fan_drive(900, 0.7, 1.1), question.file = "fan.toml", question.of = SweepStudy::modes;
  const MachineAnswer answer = answer_of(question);
  std::vector<std::string> names;
  for (const Figure& figure : answer.figures) names.push_back(figure.name);
  EXPECT_EQ(names, (std::vector<std::string>{"natural_frequency.1", "damped_frequency.1", "damping_ratio.1",
                                             "internal_frequency.2", "damped_frequency.2", "damping_ratio.2"}));
  EXPECT_NEAR(answer.figures[0].value, torsional(900) / (2 * pi), 1e-9);
}

// From rest the first turn alone is thousands of periods of the shaft's vibration, which nothing damps.
const char* const long_start = R"toml(
line = ["motor", "shaft", "disc"]
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "2000 kg*m2" }
shaft = { kind = "coupling", stiffness = "1000 kN*m/rad" }
disc = { kind = "load", inertia = "0.5 kg*m2", torque = "5 N*m", damping = "0.1 N*m*s/rad", table = { over = "angle", formula = "5 [N*m]*(1 + 0.5*sin(phi))" } }
effects = { elasticity = true }
run = { start = "rest", until = "2 s", budget = "1 s" }
)toml";

// Time is the budget's, of the processor.
TEST(ModesByEnergy, NaturalFrequenciesWaitForNoStart) {
  const double begin = processor_time();
  const ModesStudy m = modes_of(long_start);
  EXPECT_LT(processor_time() - begin, 1.5);
  EXPECT_TRUE(m.start_unknown);
  EXPECT_NE(m.orbit.find("within a fifth of the budget (0.2 s"), std::string::npos) << m.orbit;
  ASSERT_EQ(m.modes.size(), 1u);
  const double omega = std::sqrt(1e6 * (1 / 2000.0 + 1 / 0.5));
  EXPECT_NEAR(m.modes[0].omega, omega, 1e-9 * omega);
  EXPECT_EQ(std::count_if(m.notes.begin(), m.notes.end(),
                          [](const std::string& note) { return note.starts_with("not assessed"); }),
            1);
}

TEST(ModesByEnergy, ASweepWhoseStartIsUnknownSaysSo) {
  MachineQuestion question;
  question.text = long_start, question.file = "flywheel.toml", question.of = SweepStudy::modes;
  const MachineAnswer answer = answer_of(question);
  EXPECT_EQ(answer.state, RowState::unconfirmed);
  ASSERT_FALSE(answer.figures.empty());
  EXPECT_EQ(answer.figures[0].name, "natural_frequency.1");
}

}  // namespace
}  // namespace kurbel::modes_by_energy_test
