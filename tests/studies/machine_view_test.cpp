// machine_view_test.cpp — the drawn mechanism: links keep their lengths, bearings stand still, the turn closes.
#include <algorithm>
#include <cmath>

#include "studies/run/run_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::machine_view_test {
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
  // The load is drawn on what slides at the output; a rocking one about its bearing.
  const bool slides = std::any_of(drawn.links.begin(), drawn.links.end(), [&](const MachineView::Linkage::Link& link) {
    return (link.shape == "slider" || link.shape == "point") && link.joints.front() == drawn.output;
  });
  EXPECT_NE(slides, std::find(drawn.fixed.begin(), drawn.fixed.end(), drawn.output) != drawn.fixed.end());
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

// A clutch that is open for half a second and then takes b along: its sides turn apart by 120 rad/s · 0.5 s, and while it
// slips under its 40 N·m by heat/torque. None of that is twist of the shaft, which carries at most twice the step.
TEST(MachineView, DistinguishesSlipFromTwist) {
  constexpr double torque = 40, stiffness = 1000, apart = 120, open = 0.5;
  SimulateOptions options;
  options.measure_error = false;
  options.traces = true;
  const Scene scene = test::scene_from(R"(
    line = ["a", "clutch", "shaft", "b"]
    a = { kind = "inertia", inertia = "1.7 kg*m2" }
    clutch = { kind = "clutch", torque = "40 N*m", inertia_out = "0.1 kg*m2" }
    shaft = { kind = "coupling", stiffness = "1 kN*m/rad", damping_ratio = 0.02 }
    b = { kind = "inertia", inertia = "0.5 kg*m2" }
    effects = { elasticity = true }
    sequence = { steps = [{ at = "0 s", set = "clutch", to = 0 }, { at = "0.5 s", set = "clutch" }] }
    [run]
    until = "3 s"
    start = { a = { speed = "120 rad/s" }, b = { speed = "0 rad/s" } }
  )");
  const Result r = simulate(scene, scene.effects, "elastic", options);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double heat = test::figure(r, "slip_heat.clutch"), slipped = apart * open + heat / torque;
  const MachineView view = machine_view({&r});
  const MachineView::Motion& motion = view.motions.front();
  ASSERT_EQ(view.parts.size(), 4u);
  EXPECT_TRUE(view.parts[1].slips && view.parts[2].elastic && !view.parts[1].elastic);
  EXPECT_NEAR(motion.slip_in[1].back() - motion.slip_out[1].back(), slipped, 1e-5 * slipped);
  EXPECT_EQ(motion.slip_out[3].back(), motion.slip_out[1].back()) << "behind the clutch all is as far behind";
  EXPECT_EQ(motion.slip_in[0].back(), 0) << "at the link nothing is";
  for (const auto* side : {&motion.twist_in, &motion.twist_out})
    for (const auto& twists : *side)
      for (const double twist : twists) ASSERT_LE(std::abs(twist), 2 * torque / stiffness);
  EXPECT_GE(view.enlargement, 10);
}

}  // namespace
}  // namespace kurbel::machine_view_test
