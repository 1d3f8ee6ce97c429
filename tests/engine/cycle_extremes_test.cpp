// cycle_extremes_test.cpp — extremes of a cycle's speed are those of the solution, not of the steps' ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/run/recorders.h"
#include "tests/support/scenes.h"

namespace kurbel::cycle_extremes_test {
namespace {

// The link's speed at many places of every step.
class ThoroughLook final : public Observer {
 public:
  void step(StepView& view) override {
    const Model& m = view.equations().model();
    const auto node = static_cast<std::size_t>(m.reduction_node);
    constexpr int places = 40;
    for (int k = 0; k <= places; ++k) {
      const double t = view.t_previous() + (view.t() - view.t_previous()) * k / places;
      seen.emplace_back(t, m.gain_of_node[node] * view.snapshot(t).now.speed[m.shaft_of_node[node]]);
    }
  }
  std::vector<std::pair<double, double>> seen;
};

struct Case {
  const char *scene, *method;
  double tolerance, until;
};

class CycleExtremes : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Each, CycleExtremes,
    testing::Values(Case{"crank_press", "dop853", 1e-2, 3}, Case{"crank_press", "verner6", 1e-3, 3},
                    Case{"compressor", "dop853", 1e-2, 1}, Case{"compressor", "verner6", 1e-3, 1},
                    Case{"press_drive", "dop853", 1e-2, 4}, Case{"press_drive", "verner6", 1e-3, 4},
                    Case{"single_cylinder_engine", "dop853", 1e-2, 1},
                    Case{"single_cylinder_engine", "verner6", 1e-3, 1},
                    Case{"six_cylinder_engine", "dop853", 1e-2, 0.4}, Case{"six_cylinder_engine", "verner6", 1e-3, 0.4},
                    Case{"shaper", "dop853", 1e-2, 4}, Case{"shaper", "verner6", 1e-3, 4},
                    Case{"piston_pump", "dop853", 1e-2, 1}, Case{"piston_pump", "verner6", 1e-3, 1},
                    Case{"four_bar_rocker", "dop853", 1e-2, 2}, Case{"four_bar_rocker", "verner6", 1e-3, 2}));

// The rates are those of the equations, which the dense output meets within the tolerance.
TEST_P(CycleExtremes, AreThoseOfTheSolution) {
  const Scene scene = test::scene_file(std::string("scenes/") + GetParam().scene + ".toml");
  Equations equations(compile(scene, scene.effects), true);
  CycleRecorder cycles;
  ThoroughLook look;
  RunOptions options;
  options.tolerance = GetParam().tolerance;
  options.method = GetParam().method;
  options.until = GetParam().until;
  const RunOutcome outcome = integrate(equations, options, {&cycles, &look});
  ASSERT_TRUE(outcome.complete) << outcome.diagnosis;
  std::size_t beyond = 0;
  double worst = 0;
  for (const CycleRecord& c : cycles.cycles()) {
    double most = c.omega_max, least = c.omega_min;
    for (const auto& [t, omega] : look.seen)
      if (t >= c.begin && t <= c.end) {
        most = std::max(most, omega);
        least = std::min(least, omega);
      }
    const double slack = 0.01 * GetParam().tolerance * std::abs(c.mid_speed());
    worst = std::max({worst, (most - c.omega_max) / c.mid_speed(), (c.omega_min - least) / c.mid_speed()});
    beyond += most > c.omega_max + slack || least < c.omega_min - slack;
  }
  EXPECT_EQ(beyond, 0u) << "of " << cycles.cycles().size() << " cycles, by up to " << worst;
}

}  // namespace
}  // namespace kurbel::cycle_extremes_test
