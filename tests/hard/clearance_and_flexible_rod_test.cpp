// clearance_and_flexible_rod_test.cpp — hard contact in joints and fast modes of the rod, by every method that applies.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/equations.h"
#include "engine/recorders.h"
#include "engine/run.h"
#include "tests/support/scenes.h"

namespace kurbel::test {
namespace {

std::string machine(const std::string& more) {
  return R"(
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
)" + more +
         R"(
[run]
start = { speed = "60 rad/s" }
until = "8 ms"
)";
}

struct End {
  double angle = 0, speed = 0, imbalance = 0;
  int impacts = 0;
};
End end_of(const std::string& text, const std::string& method, double tolerance, double until) {
  const Scene scene = scene_from(text);
  Equations equations(compile(scene, scene.effects), true);
  EnergyAudit audit(until, 20);
  const RunOutcome outcome =
      integrate(equations, {.tolerance = tolerance, .method = method, .until = until, .progress = {}}, {&audit});
  EXPECT_TRUE(outcome.complete) << method << ": " << outcome.diagnosis;
  const Snapshot& s = equations.snapshot(outcome.t, outcome.state);
  End end{s.node_angle[equations.model().reduction_node], s.now.speed[0], audit.relative(), 0};
  for (const Event& e : outcome.events) end.impacts += e.what.ends_with(": touches");
  return end;
}

class ByMethod : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, ByMethod,
                         testing::Values("dopri5", "verner6", "dop853", "fehlberg8", "esdirk3", "esdirk", "esdirk5",
                                         "bdf", "adams", "auto"),
                         [](const auto& info) { return info.param; });

// From the first impacts on: soft to hard contact, with the same reference for all methods.
TEST_P(ByMethod, ContactsFromSoftToHardAgree) {
  for (const char* stiffness : {"1e6 N/m", "1e8 N/m", "1e10 N/m"}) {
    const std::string text = machine(
        std::string("clearance = { kind = \"crank pin\", gap = \"0.1 mm\", restitution = 0.5, restitution_speed = "
                    "\"0.2 m/s\", friction = 0.05, radius = \"10 mm\", friction_speed = \"10 mm/s\", stiffness = \"") +
        stiffness + "\" }");
    const End exact = end_of(text, "dop853", 1e-12, 0.008), found = end_of(text, GetParam(), 1e-8, 0.008);
    EXPECT_GE(exact.impacts, 1) << stiffness;
    EXPECT_EQ(found.impacts, exact.impacts) << stiffness;
    EXPECT_NEAR(found.angle, exact.angle, 1e-6) << stiffness;
    EXPECT_NEAR(found.speed, exact.speed, 1e-4) << stiffness;
    EXPECT_LT(exact.imbalance, 1e-9) << stiffness;
  }
}

// The sixth mode of bending at 40 kHz, and stretching beyond.
TEST_P(ByMethod, FastModesOfTheRodAgree) {
  const std::string text = machine(
      "rod_flexibility = { modulus = \"200 GPa\", height = \"8 mm\", width = \"8 mm\", modes = 6, damping_ratio = "
      "0.02 }");
  const End exact = end_of(text, "dop853", 1e-12, 0.008), found = end_of(text, GetParam(), 1e-8, 0.008);
  EXPECT_NEAR(found.angle, exact.angle, 1e-6);
  EXPECT_NEAR(found.speed, exact.speed, 1e-5);
  EXPECT_LT(exact.imbalance, 1e-9);
}

// All joints with clearance, the rod flexible, gravity and friction: the energy of a long run of impacts.
TEST(EverythingDeforms, EnergyIsInBalance) {
  const std::string contact = ", gap = \"0.1 mm\", stiffness = \"1e8 N/m\", damping = \"2 s/m\", friction = 0.1";
  const std::string text =
      machine("clearance = [{ kind = \"crank pin\", radius = \"10 mm\"" + contact +
              " }, { kind = \"wrist pin\", radius = \"8 mm\"" + contact +
              " }, { kind = \"guide\", length = \"60 mm\", height = \"40 mm\", inertia = \"3e-4 kg*m2\"" + contact +
              " }]\nrod_flexibility = { modulus = \"200 GPa\", height = \"8 mm\", width = \"8 mm\", damping_ratio = "
              "0.02 }\nload = { kind = \"press\", nominal_force = \"500 N\", nominal_travel = \"20 mm\" }");
  const End end = end_of(text, "auto", 1e-9, 0.1);
  EXPECT_GT(end.impacts, 20);
  EXPECT_LT(end.imbalance, 1e-6);
}

}  // namespace
}  // namespace kurbel::test
