// coupling_selection_test.cpp — selections of couplings by DIN 740-2 as the manufacturers' handbooks work them through:
// the same data as a machine, and what kurbel modes says of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "studies/modes/modes.h"
#include "tests/support/scenes.h"
#include "tests/support/validation.h"

namespace kurbel::coupling_selection_test {
namespace {

using test::Against;
using test::Validation;
constexpr double pi = std::numbers::pi;

const Verdict& verdict_on(const ModesStudy& m, const std::string& what) {
  for (const Verdict& v : m.verdicts)
    if (v.requirement.starts_with(what)) return v;
  throw std::runtime_error("no verdict on " + what);
}

// A motor of constant torque up to some speed, which falls to what a load of its square takes at the rated one.
ModesStudy judged(double starting, double rated, double rpm, double driving, double driven,
                  const std::string& coupling) {
  const double omega = rpm * pi / 30;
  const Scene scene = test::scene_from(fmt::format(R"(
line = ["motor", "coupling", "load"]
motor = {{ kind = "motor", inertia = "{} kg*m2", torque = {{ over = "speed", unit = ["rpm", "N*m"], points = [[-100, {:.17g}], [{}, {:.17g}], [{}, {:.17g}], [{}, 0]] }} }}
coupling = {{ kind = "coupling", {} }}
load = {{ kind = "load", inertia = "{} kg*m2", quadratic = "{:.17g} N*m*s2/rad2" }}
effects = {{ elasticity = true }}
run = {{ until = "5 s" }}
)",
                                                   driving, starting, 0.9 * rpm, starting, rpm, rated, 1.1 * rpm,
                                                   coupling, driven, rated / (omega * omega)));
  return find_modes(scene, scene.effects, {});
}

// Step response of the torque k θ + c θ̇ of two masses: the greatest, over its end.
double shock_factor(double zeta) {
  const double root = std::sqrt(1 - zeta * zeta);
  double most = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double x = 2 * pi * i / 20000;  // ω_d t
    most = std::max(most, 1 - std::exp(-zeta / root * x) * (std::cos(x) - zeta / root * std::sin(x)));
  }
  return most;
}

// A motor of 160 kW, 1485 rpm, started without load, drives a screw compressor: T_AS = 2058, T_LN = 930 N·m, S_A = 1.8,
// S_z = 1, S_t = 1.45; J_A = 2.9673, J_L = 6.8673 kg·m² with the halves; T_KN = 2400, T_Kmax = 4800 N·m. Its damping is
// chosen so that a step of torque on the driving side goes through with S_A. The book takes J_L/(J_A + J_L) as 0.7.
TEST(CouplingSelection, ScrewCompressorOfKtr) {
  constexpr double driving = 2.9673, driven = 6.8673, stiffness = 60e3, warm = 1.45, shock = 1.8;
  double low = 0.01, high = 0.2;
  for (int i = 0; i < 60; ++i) {
    const double zeta = 0.5 * (low + high);
    (shock_factor(zeta) > shock ? low : high) = zeta;
  }
  const double reduced = driving * driven / (driving + driven);
  const ModesStudy m = judged(
      2058, 930, 1485, driving - 0.0673, driven - 0.0673,
      fmt::format(
          "inertia_in = \"0.0673 kg*m2\", inertia_out = \"0.0673 kg*m2\", stiffness = \"{} N*m/rad\", damping = "
          "\"{:.17g} N*m*s/rad\", nominal_torque = \"2400 N*m\", maximum_torque = \"4800 N*m\", temperature_factor "
          "= {}",
          stiffness, 2 * low * std::sqrt(stiffness * reduced), warm));
  const Verdict &nominal = verdict_on(m, "nominal"), &start = verdict_on(m, "maximum");
  const Validation is(Against::published,
                      "KTR: Coupling selection according to DIN 740 part 2, p. 13 (screw compressor, ROTEX 90)");
  is.near("required nominal torque", "N·m", nominal.value, 1348.5, 0.01, nominal.error);
  is.near("required maximum torque, as printed", "N·m", start.value, 3760, 15, start.error);
  is.near("required maximum torque, recomputed", "N·m", start.value, warm * 2058 * driven / (driving + driven) * shock,
          0.2, start.error);
  EXPECT_EQ(nominal.state(), Compliance::holds);
  EXPECT_EQ(start.state(), Compliance::holds);
}

// T_KN ≥ T_AN S_A S_ϑ S_Z: 450 kW at 980 rpm, a load without shocks at 40 °C; 800 kW, a bucket-wheel excavator.
TEST(CouplingSelection, SafetyCouplingsOfRAndW) {
  const Validation is(Against::published,
                      "R+W: Sizing and selection (DIN 740 part 2), safety couplings, examples 1 and 2");
  const auto nominal = [](double power, double rpm, double rated, double application, double warm) {
    const double torque = power / (rpm * pi / 30);
    const ModesStudy m =
        judged(torque, torque, rpm, 20, 50,
               fmt::format("stiffness = \"5 MN*m/rad\", damping_ratio = 0.02, nominal_torque = \"{} N*m\", "
                           "application_factor = {}, temperature_factor = {}",
                           rated, application, warm));
    return verdict_on(m, "nominal");
  };
  const Verdict first = nominal(450e3, 980, 6030, 1.25, 1.1), second = nominal(800e3, 980, 16000, 2, 1);
  is.near("example 1, required nominal torque, as printed", "N·m", first.value, 6029.7, 1, first.error);
  is.near("example 2, required nominal torque, as printed", "N·m", second.value, 15592, 2, second.error);
  EXPECT_EQ(first.state(), Compliance::holds);
  EXPECT_EQ(second.state(), Compliance::holds);
}

// 15.2 kW at 1500 rpm through rubber of polyurethane at 50 °C: T_N S_ϑ = 96.8 · 1.4 ≤ 240 N·m.
TEST(CouplingSelection, LectureExampleOfAnElectricMotor) {
  const double torque = 15.2e3 / (50 * pi);
  const ModesStudy m = judged(2 * torque, torque, 1500, 0.13, 0.3,
                              "stiffness = \"4 kN*m/rad\", relative_damping = 0.8, nominal_torque = \"240 N*m\", "
                              "temperature_factor = 1.4");
  const Verdict& v = verdict_on(m, "nominal");
  const Validation is(Against::published, "Kupplungsauslegung nach DIN 740 (lecture, electric motor, Hadeflex X48)");
  is.near("required nominal torque, as printed", "N·m", v.value, 135.52, 0.1, v.error);
  EXPECT_EQ(v.state(), Compliance::holds);
}

}  // namespace
}  // namespace kurbel::coupling_selection_test
