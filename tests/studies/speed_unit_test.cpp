// speed_unit_test.cpp — people read speeds in the scene's unit, programs in rad/s; both are the same.
#include "engine/scene/speed_unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "studies/findings/figure_text.h"
#include "studies/modes/campbell.h"
#include "studies/modes/modes.h"
#include "studies/run/run_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::speed_unit_test {
namespace {

constexpr double pi = std::numbers::pi;

SpeedUnit radians() { return {"rad/s", 1}; }

TEST(SpeedUnits, AFigureInATableIsInTheUnitOfItsScene) {
  const FigureCells turns = figure_cells({2 * pi, 1.6e-6 * pi}, "rad/s", {});
  EXPECT_EQ(turns.value, "60.0000");
  EXPECT_EQ(turns.error, "± 0.00005");
  EXPECT_EQ(turns.unit, "rpm");
  EXPECT_EQ(figure_cells({2.5}, "rad/s", radians()).unit, "rad/s");
  EXPECT_EQ(figure_cells({2.5}, "N*m", {}).unit, "N·m");
}

// The ray of order r passes the speed Ω at the frequency r Ω/2π, whatever the axis counts in.
TEST(SpeedUnits, RaysOfTheCampbellDiagramKeepTheirSlope) {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  for (const SpeedUnit& unit : {SpeedUnit{}, radians()}) {
    scene.speed_unit = unit;
    const ModesStudy m = find_modes(scene, scene.effects, {.count = 2});
    const Plot plot = modes::campbell_plot(m);
    EXPECT_EQ(plot.x.unit, unit.name);
    int rays = 0;
    for (const Series& s : plot.series) {
      if (s.role != Role::rigid || s.text_at_end.empty()) continue;
      const double order = std::stod(s.name);  // "2 press"
      for (std::size_t k = 0; k < s.x.size(); ++k)
        EXPECT_NEAR(s.y[k], order * s.x[k] * unit.size / (2 * pi), 1e-12 * s.y.back());
      ++rays;
    }
    EXPECT_GT(rays, 0);
  }
}

// Programs read the same numbers, and which unit people see.
TEST(SpeedUnits, OnlyWordsAndTheNameOfTheUnitChange) {
  Scene scene = test::scene_file("scenes/crank_press.toml");
  scene.run.until = 0.2;
  const auto reported = [&](const SpeedUnit& unit) {
    scene.speed_unit = unit;
    return nlohmann::json::parse(output_of(test::run(scene, false)).json());
  };
  const nlohmann::json turns = reported({}), radian = reported(radians());
  EXPECT_EQ(turns["speed_unit"], "rpm");
  EXPECT_EQ(radian["speed_unit"], "rad/s");
  EXPECT_EQ(turns["figures"], radian["figures"]);
}

}  // namespace
}  // namespace kurbel::speed_unit_test
