// messages_test.cpp — what is said of a machine is true of that machine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "studies/report/render.h"
#include "studies/run/run_findings.h"
#include "studies/size/size.h"
#include "tests/support/scenes.h"

namespace kurbel::messages_test {
namespace {

bool any_says(const std::vector<std::string>& notes, const std::string& words) {
  for (const std::string& note : notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

// Stall torque κ U²/R² = 9680 N·m, R/κ = 10 rad/s; the fan takes what the motor gives at 150 rad/s, 9680/16² N·m.
std::string fan_motor(const std::string& limit) {
  return fmt::format(R"(
line = ["motor"]
motor = {{ kind = "dc series motor", voltage = "220 V", resistance = "0.5 Ohm", constant = "0.05 N*m/A2", inertia = "0.5 kg*m2"{} }}
fan = {{ kind = "load", on = "motor", damping = "{} N*m*s/rad" }}
run = {{ until = "40 s", accuracy = 1e-6 }}
)",
                     limit, 9680.0 / 256 / 150);
}

TEST(Messages, LoadedSeriesMotorRunsAtItsRatedSpeedFarAboveItsBaseSpeed) {
  const Result r = test::run(fan_motor(""));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(test::figure(r, "final_speed.motor"), 150, 1e-3);
}

TEST(Messages, SeriesMotorThatRunsAwayFromAFanIsNotSaidToBeWithoutALoad) {
  const Result r = test::run(fan_motor(", rated_speed = \"25 rad/s\""));
  ASSERT_FALSE(r.complete);
  EXPECT_EQ(r.diagnosis.find("ithout a load"), std::string::npos) << r.diagnosis;
  EXPECT_NE(r.diagnosis.find("max_speed = 125 rad/s (by default 5 rated_speed)"), std::string::npos) << r.diagnosis;
  // Nor is what was not drawn up reported as nothing.
  EXPECT_EQ(output_of(r).text().find("nothing moves"), std::string::npos) << output_of(r).text();
  EXPECT_EQ(output_of(r).text().find("closed to 0"), std::string::npos);
}

TEST(Messages, RunThatDoesNothingProvesNoBalanceOfEnergy) {
  for (const double speed : {0.0, 10.0}) {
    const Result r = test::run(fmt::format(R"(
line = ["wheel"]
wheel = {{ kind = "flywheel", inertia = "1 kg*m2" }}
run = {{ until = "1 s", start = {{ speed = "{} rad/s" }} }}
)",
                                           speed));
    const StudyOutput output = output_of(r);
    for (const std::string& text : {output.text(), output.conclusion()}) {
      EXPECT_EQ(text.find("closed to 0"), std::string::npos) << text;
      EXPECT_EQ(text.find("energy balance 0"), std::string::npos) << text;
    }
    EXPECT_NE(output.text().find(speed == 0 ? "nothing moves" : "the kinetic energy stays 50 J"), std::string::npos);
    EXPECT_EQ(html_of(output.report()).find("balance closes to 0"), std::string::npos);
  }
  const Result works = test::run(fan_motor(""));
  EXPECT_NE(output_of(works).text().find("energy balance closed to"), std::string::npos);
}

// An engine by a table over two turns; its load as given, or none.
std::string engine(const std::string& load) {
  return R"(
line = ["engine", "flywheel"]
engine = { kind = "slider-crank", radius = "36 mm", rod = "115 mm", crank_inertia = "0.008 kg*m2", slider_mass = "0.48 kg", load = { kind = "table", working_end = "extended", work = "driving", force = { over = "angle", unit = ["deg", "N"], period = "720 deg", points = [[0, 28000], [30, 16000], [90, 1900], [180, 400], [540, 0], [640, 700], [720, 28000]] } } }
flywheel = { kind = "flywheel", inertia = "0.45 kg*m2" }
)" + load;
}

TEST(Messages, SizeSaysWhatLoadTheSceneHasAndWhatIsAddedToIt) {
  SizeOptions options;
  options.delta = 0.05;
  options.mid_speed = 300;
  options.simulate = false;
  const Sizing none = size_flywheel(test::scene_from(engine("")), options);
  ASSERT_TRUE(none.engine);
  EXPECT_TRUE(any_says(none.notes, "the scene has no load on the cycle"));
  EXPECT_FALSE(any_says(none.notes, "the load of the scene"));
  const double mean = none.cycle.drive.mean();
  const auto loaded = [&](double share) {
    return size_flywheel(
        test::scene_from(engine(
            fmt::format("generator = {{ kind = \"load\", on = \"flywheel\", torque = \"{} N*m\" }}\n", share * mean))),
        options);
  };
  EXPECT_TRUE(any_says(loaded(0.7).notes, "as if a constant load of"));
  EXPECT_TRUE(any_says(loaded(1.3).notes, "more than there is; sized as if a constant drive of"));
}

// A series motor on a light fan runs far above R/κ: something does limit its speed.
TEST(Messages, SizeFindsTheOperatingSpeedFarAboveTheMotorsBaseSpeed) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "wheel", "pump"]
motor = { kind = "dc series motor", voltage = "220 V", resistance = "0.5 Ohm", constant = "0.05 N*m/A2", inertia = "0.5 kg*m2" }
wheel = { kind = "flywheel", inertia = "5 kg*m2" }
pump = { kind = "slider-crank", radius = "20 mm", rod = "100 mm", crank_inertia = "0.1 kg*m2", slider_mass = "1 kg", load = { kind = "opposing", force = "1500 N" } }
)");
  SizeOptions options;
  options.delta = 0.05;
  options.simulate = false;
  const Sizing s = size_flywheel(scene, options);
  ASSERT_TRUE(s.operating);
  // 4 r F a turn: 120 J, 19.1 N·m = 9680/(1 + ω/10)².
  EXPECT_NEAR(s.operating->speed, 10 * (std::sqrt(9680 / (4 * 0.02 * 1500 / (2 * M_PI))) - 1), 1e-6);
}

}  // namespace
}  // namespace kurbel::messages_test
