// machine_view_test.cpp — the drawn mechanism: links keep their lengths, bearings stand still, the turn closes.
#include <algorithm>
#include <cmath>

#include "studies/run/run_findings.h"
#include "tests/support/scenes.h"

namespace kurbel {
namespace {

struct Drawn {
  const char* scene;
  std::size_t joints;
  std::vector<double> lengths;  // of the lines "link" and "crank" in the order of drawing [m]
};

class MachineViewOf : public testing::TestWithParam<Drawn> {};

TEST_P(MachineViewOf, DrawsEveryLinkInItsLengthAtEveryAngle) {
  Scene scene = test::scene_file(std::string("scenes/") + GetParam().scene + ".toml");
  scene.run.until = 0.2;
  SimulateOptions options;
  options.measure_error = false;
  options.traces = true;
  const Result result = simulate(scene, {}, "rigid", options);
  const MachineView view = machine_view({&result});
  ASSERT_EQ(view.linkages.size(), 1u);
  const MachineView::Linkage& drawn = view.linkages.front();
  ASSERT_EQ(drawn.x.size(), GetParam().joints);
  for (std::size_t k = 0; k < drawn.x.size(); ++k) {
    EXPECT_NEAR(drawn.x[k].front(), drawn.x[k].back(), 1e-13);
    EXPECT_NEAR(drawn.y[k].front(), drawn.y[k].back(), 1e-13);
  }
  for (const int k : drawn.fixed)
    for (const double x : drawn.x[static_cast<std::size_t>(k)])
      EXPECT_EQ(x, drawn.x[static_cast<std::size_t>(k)].front());
  std::size_t line = 0;
  for (const MachineView::Linkage::Link& link : drawn.links) {
    if (link.shape != "link" && link.shape != "crank") continue;
    ASSERT_LT(line, GetParam().lengths.size());
    const auto a = static_cast<std::size_t>(link.joints[0]), b = static_cast<std::size_t>(link.joints[1]);
    for (std::size_t i = 0; i < drawn.x[a].size(); ++i)
      EXPECT_NEAR(std::hypot(drawn.x[b][i] - drawn.x[a][i], drawn.y[b][i] - drawn.y[a][i]), GetParam().lengths[line],
                  1e-13);
    ++line;
  }
  EXPECT_EQ(line, GetParam().lengths.size());
  int cranks = 0;
  for (const MachineView::Part& part : view.parts) cranks += part.crank;
  EXPECT_EQ(cranks, 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MachineViewOf,
                         testing::Values(Drawn{"crank_press", 3, {0.42, 0.05}},
                                         Drawn{"four_bar_rocker", 4, {0.4, 0.15, 0.06}},
                                         Drawn{"shaper", 5, {0.56, 0.18, 0.11}},
                                         Drawn{"knuckle_press", 5, {0.5099, 0.35, 0.35, 0.07}}),
                         [](const auto& info) { return std::string(info.param.scene); });

}  // namespace
}  // namespace kurbel
