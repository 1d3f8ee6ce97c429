// formulas_in_scenes_test.cpp — laws by formula, tables with jumps, tables used by name, commands and speeds over time:
// each against its closed form, or against the same machine written the long way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/numerics/dual.h"
#include "engine/reading/settings.h"
#include "tests/support/elements.h"

namespace kurbel::formulas_in_scenes_test {
namespace {

using test::figure;
using test::run;

constexpr double pi = std::numbers::pi;

// A flywheel of 2 kg·m² from rest under one torque.
std::string flywheel_under(const std::string& source, const std::string& more = "", const std::string& settings = "") {
  return fmt::format(R"~(
line = ["source", "flywheel"]
{}
[source]
kind = "torque source"
{}
[flywheel]
kind = "flywheel"
inertia = "2 kg*m2"
[run]
until = "2 s"
accuracy = 1e-10
{}
)~",
                     more, source, settings);
}

double end_speed(const Result& result, const char* component = "flywheel") {
  return figure(result, fmt::format("final_speed.{}", component));
}

std::string message_of(const std::string& text) {
  try {
    const Scene scene = test::scene_from(text);
    compile(scene, scene.effects);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

// J ω(2 s) = ∫ M dt
TEST(FormulaOverTime, GivesTheImpulseOfItsIntegral) {
  const Result r = run(flywheel_under(
      R"~(table = { over = "time", formula = "M0*exp(-t/T)", range = ["0 s", "10 s"], with = { T = "0.5 s" } })~",
      "[constants]\nM0 = \"12 N*m\""));
  EXPECT_NEAR(end_speed(r), 12 * 0.5 * (1 - std::exp(-4.0)) / 2, 1e-9);
}

TEST(FormulaOverTime, KinksAndJumpsAreEdges) {
  // |sin| over four half waves; a step at 1.3 s.
  const Result r = run(flywheel_under(
      R"~(table = { over = "time", formula = "5 [N*m]*abs(sin(2*pi*t/1 s)) + if(t < 1.3 s, 0, 3 [N*m])", range = ["0 s", "3 s"] })~"));
  EXPECT_NEAR(end_speed(r), (5 * 2 * 2 / pi + 3 * 0.7) / 2, 1e-9);
}

// J ω ω′ = P: ω² = ω₀² + 2 P t/J, as long as the range reaches.
TEST(FormulaOverSpeed, ConstantPowerRaisesTheSquareOfTheSpeed) {
  const Result r = run(R"~(
line = ["m", "flywheel"]
[constants]
P = "1 kW"
[m]
kind = "motor"
inertia = "0 kg*m2"
torque = { over = "speed", formula = "P/speed*1 rad", range = ["2 rad/s", "500 rad/s"] }
[flywheel]
kind = "flywheel"
inertia = "2 kg*m2"
[run]
until = "2 s"
accuracy = 1e-10
start = { speed = "3 rad/s" }
)~");
  EXPECT_NEAR(end_speed(r), std::sqrt(9 + 2 * 1000 * 2 / 2.0), 1e-7);
}

// ½ J ω² = ∫ M dφ over one turn and more; M has a kink at every half turn.
TEST(FormulaOverAngle, RepeatsAfterItsPeriodWithKinksAsEvents) {
  const Result r = run(flywheel_under(R"~(table = { over = "angle", formula = "8 [N*m]*max(sin(phi), 0)" })~", "",
                                      "start = { angle = \"30 deg\" }"));
  // The same by points is near, and by a closed form of the work: W(φ) over whole turns is 16 a turn.
  const double speed = end_speed(r), angle = figure(r, "final_angle.flywheel");
  const double turns = std::floor(angle / (2 * pi)), rest = angle - 2 * pi * turns;
  const double work = 16 * turns + 8 * (1 - std::cos(std::min(rest, pi))) - 8 * (1 - std::cos(pi / 6));
  EXPECT_NEAR(0.5 * 2 * speed * speed, work, 1e-6);
}

std::string spring_on_frame(const std::string& law) {
  return fmt::format(R"~(
line = ["frame", "c", "disc"]
[constants]
k = "400 N*m/rad"
k3 = "3 MN*m/rad3"
[frame]
kind = "prescribed speed"
speed = "0 rad/s"
[c]
kind = "progressive coupling"
table = {}
[disc]
kind = "inertia"
inertia = "0.5 kg*m2"
[effects]
elasticity = true
[run]
until = "0.4 s"
accuracy = 1e-10
start = {{ disc = {{ speed = "1 rad/s" }} }}
)~",
                     law);
}

// Duffing: ½ J ω₀² = ½ k θ² + ¼ k₃ θ⁴ at the greatest twist.
TEST(FormulaOverTwist, HardeningSpringStoresTheEnergyOfItsLaw) {
  const Result r =
      run(spring_on_frame(R"~({ over = "twist", formula = "k*twist + k3*twist^3", range = ["0 rad", "0.05 rad"] })~"));
  const double k = 400, k3 = 3e6, j = 0.5;
  const double square = (-k + std::sqrt(k * k + 2 * k3 * j)) / k3, twist = std::sqrt(square);
  EXPECT_NEAR(std::abs(figure(r, "peak_torque.c")), k * twist + k3 * twist * square, 1e-8);
}

TEST(FormulaOverTwist, MustPassTheOriginAndRise) {
  EXPECT_NE(message_of(spring_on_frame(
                           R"~({ over = "twist", formula = "k*twist + 1 [N*m]", range = ["0 rad", "0.05 rad"] })~"))
                .find("1 N·m at zero twist"),
            std::string::npos);
  EXPECT_NE(message_of(
                spring_on_frame(
                    R"~({ over = "twist", formula = "k*sin(twist*100/1 rad)*1 rad", range = ["0 rad", "0.05 rad"] })~"))
                .find("does not rise at a twist"),
            std::string::npos);
}

// --- constants in place of numbers ---

TEST(FormulaOfConstants, StandsWhereverAQuantityStands) {
  const Scene scene = test::scene_from(R"~(
line = ["a", "s", "b"]
[constants]
G = "80 GPa"
d = "40 mm"
l = "= 25*d"
[a]
kind = "inertia"
inertia = "1 kg*m2"
[s]
kind = "coupling"
stiffness = "= G*pi*d^4/(32*l)/1 rad"
[b]
kind = "inertia"
inertia = "= 1/2*7850 [kg/m3]*pi*(2*d)^2*l*(4*d)^2"
)~");
  EXPECT_NEAR(scene.find("s")->number("stiffness"), 80e9 * pi * std::pow(0.04, 4) / 32, 1e-6);
  EXPECT_NEAR(scene.find("b")->number("inertia"), 0.5 * 7850 * pi * 0.0064 * 0.0256, 1e-12);
}

TEST(FormulaOfConstants, IsSetBesideTheFile) {
  const std::string text = flywheel_under("torque = \"= 2*M0\"", "[constants]\nM0 = \"3 N*m\"");
  const auto torque = [&](const std::vector<std::string>& settings) {
    return parse_scene(SettledText(text, "test.toml", settings), all_kinds()).find("source")->number("torque");
  };
  EXPECT_EQ(torque({}), 6);
  EXPECT_EQ(torque({"constants.M0=5 N*m"}), 10);
  EXPECT_EQ(torque({"source.torque== M0/3"}), 1);
  try {
    torque({"source.torque== M0/3 s"});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("--set", 0), 0u) << error.what();
  }
}

// --- tables used by name ---

TEST(TableUsedByName, IsThatTable) {
  const std::string named = flywheel_under("table = { use = \"table.push\" }",
                                           "[table.push]\nover = \"time\"\nunit = [\"s\", \"N*m\"]\n"
                                           "points = [[0, 4], [1, 4], [1, 7]]");
  const std::string written =
      flywheel_under(R"~(table = { over = "time", unit = ["s", "N*m"], points = [[0, 4], [1, 4], [1, 7]] })~");
  EXPECT_EQ(end_speed(run(named)), end_speed(run(written)));
  EXPECT_NEAR(end_speed(run(named)), (4 + 7) / 2.0, 1e-9);
}

TEST(TableUsedByName, OwnKeysStandBeforeThoseOfTheTable) {
  const std::string text = flywheel_under(
      R"~(table = { use = "table.push", with = { M0 = "6 N*m" } })~",
      "[table.push]\nover = \"time\"\nformula = \"M0\"\nrange = [\"0 s\", \"5 s\"]\nwith = { M0 = \"1 N*m\" }");
  EXPECT_NEAR(end_speed(run(text)), 6, 1e-9);
}

TEST(TableUsedByName, ThatIsNotThereIsReportedWithTheNearest) {
  const std::string text =
      message_of(flywheel_under("table = { use = \"table.psuh\" }", std::string("[table.push]\nover = \"time\"\n")));
  EXPECT_NE(text.find("did you mean \"table.push\"?"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << "one fault, one message: " << text;
}

// --- jumps ---

TEST(JumpInATable, HappensAtItsPlace) {
  const Result r = run(flywheel_under(
      R"~(table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [0, 10], [0.5, 10], [0.5, -2], [1.5, -2], [1.5, 0]] })~"));
  EXPECT_NEAR(end_speed(r), (10 * 0.5 - 2 * 1.0) / 2, 1e-9);
  EXPECT_NE(
      message_of(flywheel_under(
                     R"~(table = { over = "time", unit = ["s", "N*m"], points = [[0, 0], [1, 1], [1, 2], [1, 3]] })~"))
          .find("stands three times"),
      std::string::npos);
}

TEST(JumpInATable, SmoothPartsEndAtIt) {
  const Curve c({0, 1, 1, 2}, {0, 1, 5, 4}, Curve::Form::smooth);
  EXPECT_EQ(c.value(1.0), 5);
  EXPECT_NEAR(c.value(0.5), 0.5, 1e-15);
  EXPECT_NEAR(c.value(1.5), 4.5, 1e-15);
  const Curve saw({0, 1, 1}, {0, 1, 0}, Curve::Form::linear, 1);
  EXPECT_NEAR(saw.value(7.75), 0.75, 1e-12);
  EXPECT_EQ(saw.value(3.0), 0);
}

// --- commands and speeds over time ---

std::string braked(const std::string& step) {
  return fmt::format(R"~(
line = ["b", "flywheel"]
[b]
kind = "brake"
torque = "20 N*m"
[flywheel]
kind = "flywheel"
inertia = "2 kg*m2"
[sequence]
steps = [{{ at = "0 s", set = "b", to = 0 }}, {{ at = "0.5 s", set = "b", {} }}]
[run]
until = "2 s"
accuracy = 1e-10
start = {{ speed = "100 rad/s" }}
)~",
                     step);
}

// J Δω = −M_k ∫ p dt
TEST(PressureOverTime, TakesTheImpulseOfItsIntegral) {
  EXPECT_NEAR(
      end_speed(run(braked(R"~(law = { over = "time", formula = "1 - exp(-t/0.2 s)", range = ["0 s", "9 s"] })~"))),
      100 - 10 * (1.5 - 0.2 * (1 - std::exp(-7.5))), 1e-8);
  EXPECT_NEAR(
      end_speed(run(braked(
          R"~(law = { over = "time", unit = ["s", "1"], points = [[0, 0], [0.2, 1], [0.2, 0.5], [0.7, 0]] })~"))),
      100 - 10 * (0.1 + 0.125), 1e-8);
  // What repeats: a saw of 0.4 s, three and three quarters of it.
  EXPECT_NEAR(
      end_speed(run(braked(
          R"~(law = { over = "time", unit = ["s", "1"], points = [[0, 0], [0.4, 1], [0.4, 0]], period = "0.4 s" })~"))),
      100 - 10 * (3 * 0.2 + 0.5 * 0.3 * 0.75), 1e-8);
}

TEST(PressureOverTime, StandsAloneAndWithinItsBounds) {
  std::string text = braked(R"~(law = { over = "time", formula = "t/1 s", range = ["0 s", "1 s"] }, to = 1)~");
  EXPECT_NE(message_of(text).find("\"law\" and \"to\" both given"), std::string::npos) << message_of(text);
  text = braked(R"~(law = { over = "time", formula = "20*t/1 s", range = ["0 s", "1 s"] })~");
  EXPECT_NE(message_of(text).find("within −1 … 10"), std::string::npos) << message_of(text);
}

// M = J ω′ + b ω, given ω(t).
TEST(SpeedOverTime, TakesTheTorqueOfItsSlope) {
  const auto driven = [](const std::string& law) {
    return fmt::format(R"~(
line = ["p", "c", "flywheel"]
[p]
kind = "prescribed speed"
table = {}
[c]
kind = "coupling"
stiffness = "1 kN*m/rad"
[flywheel]
kind = "flywheel"
inertia = "2 kg*m2"
[effects]
elasticity = false
[run]
until = "2 s"
accuracy = 1e-9
)~",
                       law);
  };
  const Result r = run(driven(R"~({ over = "time", formula = "30 [rad/s]*(t/1 s)^2", range = ["0 s", "2.5 s"] })~"));
  EXPECT_NEAR(end_speed(r), 120, 1e-7);
  EXPECT_NEAR(figure(r, "peak_torque.c"), 2 * 30 * 2 * 2.0, 1e-5);
  EXPECT_NE(message_of(driven(R"~({ over = "time", formula = "if(t < 1 s, 0, 5 [rad/s])", range = ["0 s", "2 s"] })~"))
                .find("jumps"),
            std::string::npos);
  const Result smooth = run(driven(
      R"~({ over = "time", unit = ["s", "rad/s"], points = [[0, 0], [1, 10], [2, 40]], interpolation = "smooth" })~"));
  EXPECT_NEAR(end_speed(smooth), 40, 1e-7);
}

}  // namespace
}  // namespace kurbel::formulas_in_scenes_test
