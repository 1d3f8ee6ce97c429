// rounding_shown_test.cpp — what is rounding is shown as 0: small and large machines whose torques balance.
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "studies/findings/output.h"
#include "studies/forces/forces_findings.h"
#include "studies/limits/limits_findings.h"
#include "studies/modes/modes.h"
#include "studies/reduce/reduce.h"
#include "studies/report/render.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"

namespace kurbel::rounding_shown_test {
namespace {

// A drive of a filter wheel: mN·m, a gearbox with losses, a constant load.
const char* const servo = R"(
line = ["motor", "gearbox", "coupling", "wheel"]
motor = { kind = "dc shunt motor", voltage = "12 V", resistance = "20 Ohm", constant = "8 mN*m/A", inertia = "1e-7 kg*m2" }
gearbox = { kind = "gearbox", stages = [{ teeth = [12, 48] }, { teeth = [12, 48] }], efficiency = 0.7 }
coupling = { kind = "coupling", stiffness = "2 N*m/rad", damping_ratio = 0.02, maximum_torque = "30 mN*m" }
wheel = { kind = "load", inertia = "5e-6 kg*m2", torque = "15 mN*m" }
effects = { elasticity = true }
run = { until = "0.5 s" }
)";

// A rolling mill, MN·m, at rest between two passes: no torque at all.
const char* const mill = R"(
line = ["motor", "spindle", "gearbox", "shaft", "rolls"]
motor = { kind = "motor", torque = { over = "speed", unit = ["rad/s", "kN*m"], points = [[0, 900], [9, 800], [10.5, 0]], beyond = "line" }, inertia = "42 t*m2" }
spindle = { kind = "coupling", stiffness = "240 MN*m/rad", damping_ratio = 0.02, maximum_torque = "2.5 MN*m" }
gearbox = { kind = "gearbox", stages = [{ teeth = [30, 60], inertia = ["3 t*m2", "4 t*m2"] }] }
shaft = { kind = "shaft", stiffness = "180 MN*m/rad", damping_ratio = 0.01 }
rolls = { kind = "load", inertia = "9000 kg*m2", table = { over = "time", unit = ["s", "kN*m"], points = [[0, 0], [2, 0], [2.02, 1300], [6, 1300], [6.01, 0], [8, 0]] } }
effects = { elasticity = true }
run = { start = { speed = "10 rad/s", on = "motor", equilibrium = true }, until = "8 s" }
)";

// The first number of the size of rounding that is no error, bound, residual or inertia; empty: none.
std::string rounding_in(const std::string& text) {
  static const std::regex small("(± |= |to |of |than |<)?[0-9.]+(e-(09|1[0-9]|2[0-9]|3[0-9])| nN·m(?!·s))(?! kg)");
  for (std::sregex_iterator i(text.begin(), text.end(), small); i != std::sregex_iterator(); ++i)
    if (!(*i)[1].matched) return i->str();
  return {};
}

TEST(RoundingShown, IsZeroInSteadyMotion) {
  for (const char* const of : {servo, mill}) {
    const Scene scene = test::scene_from(of);
    const std::string text = output_of(steady(scene, {rigid_effects(), scene.effects}, {})).text();
    EXPECT_EQ(rounding_in(text), "") << text;
  }
}

TEST(RoundingShown, IsZeroInAReducedMachine) {
  const MachineReduction r = reduce(test::scene_from(servo), {});
  EXPECT_EQ(rounding_in(output_of(r).text()), "") << output_of(r).text();
  const std::string numbers = "M_r = −0.000401786 + 0.00133929 − 0.0009375 = 0 N·m";
  EXPECT_NE(html_of(output_of(r).report()).find(numbers), std::string::npos);
}

// In dead centres neither torque nor the guide's reaction is left of forces of kN.
TEST(RoundingShown, IsZeroInDeadCentres) {
  ForcesOptions options;
  options.simulate = false;
  const std::string text = output_of(find_forces(test::scene_file("docs/tasks/flywheel_sheet.toml"), options)).text();
  EXPECT_EQ(rounding_in(text), "") << text;
  EXPECT_EQ(text.find("e-08 "), std::string::npos) << text;
}

// A constant load excites nothing: there is no response to check.
TEST(RoundingShown, IsNotComparedAtSpots) {
  const Scene scene = test::scene_from(servo);
  const ModesStudy m = find_modes(scene, scene.effects, {.spots = {60}});
  EXPECT_TRUE(m.excitations.none());
  EXPECT_TRUE(m.spots.empty());
}

// A load below its error is 0; its error is shown where it is visible beside the limit.
TEST(RoundingShown, IsZeroInATableOfLimits) {
  const auto load = [](double value, double error) {
    const Rows table = verdict_table({Verdict{{value, error}, "spindle", "maximum torque", 2.5e6, "N*m", ""}});
    return table.texts().front()[4];
  };
  EXPECT_EQ(load(7e-6, 2.6e-3), "0 MN·m");
  EXPECT_EQ(load(7, 2600), "less than 0.0026 MN·m");
  EXPECT_EQ(load(1e6, 1e-3), "1 MN·m");
  EXPECT_EQ(load(1e6, 1e4), "1.000 ± 0.010 MN·m");
}

}  // namespace
}  // namespace kurbel::rounding_shown_test
