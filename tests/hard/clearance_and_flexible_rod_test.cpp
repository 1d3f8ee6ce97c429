// clearance_and_flexible_rod_test.cpp — everything that deforms in a slider-crank at once, over a long run of impacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engine/events/equations.h"
#include "engine/run/recorders.h"
#include "engine/run/run.h"
#include "tests/support/scenes.h"

namespace kurbel::test::clearance_and_flexible_rod_test {
namespace {

// All joints with clearance, the rod flexible, gravity, friction and a press: energy is in balance (conservation law).
TEST(EverythingDeforms, EnergyIsInBalance) {
  const std::string contact = ", gap = \"0.1 mm\", stiffness = \"1e8 N/m\", damping = \"2 s/m\", friction = 0.1";
  const Scene scene = scene_from(R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "150 mm"
crank_inertia = "0.02 kg*m2"
rod_mass = "0.3 kg"
rod_inertia = "5.625e-4 kg*m2"
slider_mass = "0.5 kg"
gravity = "9.81 m/s2"
clearance = [{ kind = "crank pin", radius = "10 mm")" +
                                 contact + R"( }, { kind = "wrist pin", radius = "8 mm")" + contact +
                                 R"( }, { kind = "guide", length = "60 mm", height = "40 mm", inertia = "3e-4 kg*m2")" +
                                 contact + R"( }]
rod_flexibility = { modulus = "200 GPa", height = "8 mm", width = "8 mm", damping_ratio = 0.02 }
load = { kind = "press", nominal_force = "500 N", nominal_travel = "20 mm" }
[run]
start = { speed = "60 rad/s" }
)");
  const double until = 0.1;
  Equations equations(compile(scene, scene.effects), true);
  EnergyAudit audit(until, 20);
  const RunOutcome outcome =
      integrate(equations, {.tolerance = 1e-9, .method = "auto", .until = until, .progress = {}}, {&audit});
  ASSERT_TRUE(outcome.complete) << outcome.diagnosis;
  EXPECT_GT(std::count_if(outcome.events.begin(), outcome.events.end(),
                          [](const Event& e) { return e.what.ends_with(": touches"); }),
            20);
  EXPECT_LT(audit.relative(), 1e-6);
}

}  // namespace
}  // namespace kurbel::test::clearance_and_flexible_rod_test
