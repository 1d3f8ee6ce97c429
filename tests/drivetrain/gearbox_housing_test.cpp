// gearbox_housing_test.cpp — gearbox on an elastic support, and elastic flanks of a stage: motion, reactions, geometry.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "drivetrain/gears/gear_pair.h"
#include "tests/published/published.h"
#include "tests/support/jacobians.h"
#include "tests/support/validation.h"

namespace kurbel::gearbox_housing_test {
namespace {

using test::Against;
using test::figure;
using test::run;
using test::series;
using test::Validation;

// Modelica.Mechanics.Rotational.Examples.ElasticBearing (tests/cases/el04_forced_chain.toml). There the gear's output
// has no inertia; 1e-6 kg·m² here changes the motion by some 1e-8.
std::string elastic_bearing(const std::string& more) {
  return R"(
line = ["shaft", "gear", "spring", "load"]
shaft = { kind = "torque source", torque = "100 N*m", ramp = "5 s", inertia = "1 kg*m2" }
spring = { kind = "coupling", stiffness = "1 kN*m/rad" }
load = { kind = "flywheel", inertia = "50 kg*m2" }
run = { until = "10 s", accuracy = 1e-9, samples = 41 }
[gear]
kind = "gearbox"
stages = [{ teeth = [10, 30], inertia = ["0 kg*m2", "1e-6 kg*m2"] }]
reversing = false
housing_inertia = "5 kg*m2"
support_stiffness = "100 kN*m/rad"
support_damping = "5 N*m*s/rad"
)" + more;
}

TEST(GearboxHousing, OscillatesOnItsSupportAsPublished) {
  const Validation is(Against::published, "Modelica.Mechanics.Rotational.Examples.ElasticBearing (case el04)");
  const Result r = run(elastic_bearing("[effects]\nelasticity = true\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double relative = 1e-5;
  const auto expect = [&](const std::string& name, double published) {
    is.near(name, "", 1, r.find(name), published, relative * std::abs(published));
  };
  expect("final_angle.load", 148.266381937);
  expect("final_speed.load", 38.132231923);
  expect("final_angle.shaft", 445.560301096);
  expect("final_speed.shaft", 114.462801283);
  is.close("angle of the housing after 10 s", "rad", series(r, "angle.gear.housing").back(), -0.00168389428, 1e-5);
  // The reference solution was computed to 1e-6 of its own.
  is.near("largest difference to the series, angle of the load", "rad",
          test::largest_difference(r, "angle.load", test::published_series("el04b_elasticbearing.csv", 1, 2)), 0, 2e-5);
  is.near("largest difference to the series, speed of the shaft", "rad/s",
          test::largest_difference(r, "speed.shaft", test::published_series("el04b_elasticbearing.csv", 1, 5)), 0,
          2e-3);
  is.near("largest difference to the series, angle of the housing", "rad",
          test::largest_difference(r, "angle.gear.housing", test::published_series("el04b_elasticbearing.csv", 1, 6)),
          0, 2e-6);
  EXPECT_LT(r.energy.relative, 1e-9);
}

// What goes in and comes out of a gearbox adds up to what its housing hands to the frame.
TEST(GearboxHousing, ReactionIsTheSumOfItsShaftsTorques) {
  for (const char* sense : {"reversing = false", "reversing = true"})
    for (const char* effects : {"[effects]\nelasticity = false\n", "[effects]\nelasticity = true\n"}) {
      const Result r = run(test::with(elastic_bearing(effects), "reversing = false", sense), false);
      const double sign = std::string(sense) == "reversing = true" ? -1 : 1;
      const auto in = series(r, "torque.gear.in"), out = series(r, "torque.gear.out");
      const auto on_housing = series(r, "torque.gear.housing"), support = series(r, "torque.gear.support");
      const auto speed = series(r, "speed.gear.housing");
      for (std::size_t k = 0; k < in.size(); ++k) {
        EXPECT_NEAR(on_housing[k], in[k] - sign * out[k], 1e-9);
        EXPECT_NEAR(out[k], 3 * in[k], 1e-9);
        if (std::string(effects).find("false") != std::string::npos) {
          EXPECT_NEAR(support[k], on_housing[k], 1e-9);
          EXPECT_EQ(speed[k], 0.0);
        }
      }
    }
}

// Rigidly supported, it is the gearbox without a housing.
TEST(GearboxHousing, RigidSupportLeavesNoTraceInTheMotion) {
  const std::string with_support = elastic_bearing("[effects]\nelasticity = [\"spring\"]\n");
  std::string without = with_support;
  for (const char* line : {"reversing = false\n", "housing_inertia = \"5 kg*m2\"\n",
                           "support_stiffness = \"100 kN*m/rad\"\n", "support_damping = \"5 N*m*s/rad\"\n"})
    without = test::with(without, line, "");
  const Scene a = test::scene_from(with_support), b = test::scene_from(without);
  const auto first = compile(a, a.effects), second = compile(b, b.effects);
  EXPECT_EQ(first->state_count(), second->state_count());
  EXPECT_EQ(first->jacobian.pattern.row, second->jacobian.pattern.row);
  EXPECT_TRUE(first->relations.empty());
  for (const char* name : {"final_speed.load", "final_angle.shaft", "peak_torque.spring"})
    EXPECT_NEAR(figure(run(a), name), figure(run(b), name), 1e-9 * std::abs(figure(run(b), name))) << name;
}

// As the support stiffens the housing comes to rest; its amplitude falls as 1/k.
TEST(GearboxHousing, StiffSupportTendsToTheRigidOne) {
  const Result rigid = run(elastic_bearing("[effects]\nelasticity = [\"spring\"]\n"), false);
  double last = 0;
  for (const double k : {1e5, 1e6, 1e7}) {
    const std::string scene =
        test::with(elastic_bearing("[effects]\nelasticity = true\n"), "100 kN*m/rad", test::digits(k) + " N*m/rad");
    const double off = std::abs(figure(run(scene, false), "final_angle.load") - figure(rigid, "final_angle.load"));
    if (last > 0) {
      EXPECT_LT(off, 0.2 * last);
    }
    last = off;
  }
}

TEST(GearboxHousing, StartInEquilibriumDoesNotRing) {
  const Result r = run(test::with(test::with(elastic_bearing("[effects]\nelasticity = true\n"), ", ramp = \"5 s\"", ""),
                                  "run = {", "run = { start = { equilibrium = true, speed = \"10 rad/s\" },"),
                       false);
  const auto housing = series(r, "angle.gear.housing");
  // λ = M − 1 · ω̇, ω̇ = 100/(1 + 50/9) at the shaft; T_h = (1 − 3) λ.
  const double expected = -2 * (100 - 100 / (1 + 50.0 / 9)) / 1e5;
  for (const double angle : housing) EXPECT_NEAR(angle, expected, 1e-6 * std::abs(expected));
}

TEST(GearboxHousing, JacobianEqualsDifferencesWithLossesToo) {
  for (const char* losses : {"", "efficiency = 0.9\n"}) {
    const std::string drag = R"([drag]
kind = "load"
on = "load"
damping = "3 N*m*s/rad"
quadratic = "0.2 N*m*s2/rad2"
)";
    test::expect_exact_jacobian_near_start(
        test::with(elastic_bearing(std::string(losses) + drag + "[effects]\nelasticity = true\n"), "run = {",
                   "run = { start = { speed = \"10 rad/s\" },"),
        {}, 1e-6);
  }
}

// --- elastic flanks ---

const char* const pair_keys = R"(teeth = [19, 57], module = "4 mm", width = "40 mm", backlash = "0.1 mm")";

TEST(ElasticMesh, TakesStiffnessAndGapFromTheTeeth) {
  GearPairData data{.module = 4e-3, .teeth = {19, 57}, .backlash = 1e-4, .width = {0.04, 0.04}};
  const GearPair pair = solve_gear_pair(data);
  const Scene scene = test::scene_from(fmt::format(R"(
line = ["motor", "gear", "load"]
motor = {{ kind = "flywheel", inertia = "0.1 kg*m2" }}
gear = {{ kind = "gearbox", stages = [{{ {}, mesh = true, mesh_gap = true }}] }}
load = {{ kind = "flywheel", inertia = "2 kg*m2" }}
effects = {{ elasticity = true }}
run = {{ until = "0.01 s" }}
)",
                                                   pair_keys));
  const auto model = compile(scene, scene.effects);
  ASSERT_EQ(model->elastic.size(), 1u);
  const Network::Joint& joint = model->network.joints[static_cast<std::size_t>(model->elastic[0].joint)];
  EXPECT_DOUBLE_EQ(joint.ratio, 3);
  EXPECT_DOUBLE_EQ(joint.element->stiffness, mesh_stiffness(pair).torsional);
  // The gap: twist at a torque is half of it and the torque over the stiffness.
  EXPECT_NEAR(joint.element->twist_at(100), 0.5 * pair.backlash_angle(0) + 100 / mesh_stiffness(pair).torsional, 1e-15);
  EXPECT_GT(pair.backlash_angle(0), 1e-3);
}

// Natural frequency of two wheels with flanks of stiffness k: ω² = k (1/J₁ + i²/J₂), i² on the far side as 9/J₂.
TEST(ElasticMesh, OscillatesAtItsFrequency) {
  const std::string scene = R"(
line = ["motor", "gear", "load"]
motor = { kind = "flywheel", inertia = "0.1 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 60], mesh_stiffness = "1 MN*m/rad", mesh_damping_ratio = 0 }] }
load = { kind = "flywheel", inertia = "2 kg*m2" }
effects = { elasticity = true }
)";
  test::expect_frequencies(
      {Against::closed_form, "Two wheels with flanks of stiffness k in mesh: ω = √(k (1/J₁ + i²/J₂))"}, scene,
      {std::sqrt(1e6 * (1 / 0.1 + 9 / 2.0))}, 1, 1e-9);
}

TEST(ElasticMesh, OffIsTheIdealStage) {
  const std::string scene = R"(
line = ["motor", "gear", "load"]
motor = { kind = "torque source", torque = "5 N*m", inertia = "0.1 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 60], mesh_stiffness = "1 MN*m/rad", mesh_backlash = "0.1 deg" }] }
load = { kind = "flywheel", inertia = "2 kg*m2" }
run = { until = "0.5 s" }
)";
  const Scene off = test::scene_from(scene);
  const Scene absent =
      test::scene_from(test::with(scene, ", mesh_stiffness = \"1 MN*m/rad\", mesh_backlash = \"0.1 deg\"", ""));
  test::expect_same_model(off, absent);
  EXPECT_EQ(figure(run(off), "final_speed.load"), figure(run(absent), "final_speed.load"));
}

}  // namespace
}  // namespace kurbel::gearbox_housing_test
