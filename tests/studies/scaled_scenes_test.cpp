// scaled_scenes_test.cpp — speeds times a factor: every key that is one, of every kind, by the unit in its table.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "drivetrain/induction/induction_law.h"
#include "engine/scene/units.h"
#include "studies/effects/effect_units.h"
#include "studies/run/simulate.h"
#include "studies/scenes/kinds.h"
#include "tests/support/scenes.h"

namespace kurbel::scaled_scenes_test {
namespace {

// By its dimension, whatever the unit is called.
bool has_dimension_of_speed(const Key& key) {
  UnitError error;
  const auto unit = parse_unit(key.unit, error), turning = parse_unit("rad/s", error), often = parse_unit("Hz", error);
  return unit && (unit->dimension == turning->dimension || unit->dimension == often->dimension);
}

// One component of this kind with one setting.
Scene with_setting(const Kind& kind, const Key& key, const std::string& over) {
  Setting setting;
  setting.key = key.name;
  setting.given = true;
  setting.number = 10;
  setting.numbers = {10};
  setting.curve.over = over;
  setting.curve.x = {1, 2};
  setting.curve.y = {10, 20};
  Section section{.name = "part", .kind = &kind, .at = {}};
  section.settings.push_back(setting);
  Scene scene;
  scene.components.push_back(section);
  return scene;
}

void expect_scaled(const Kind& kind, const std::string& path, std::set<std::string>& left) {
  for (const Key& key : kind.keys) {
    if (key.nested)
      for (const Kind& nested : *key.nested) expect_scaled(nested, path + "." + key.name, left);
    if (!has_dimension_of_speed(key)) continue;
    EXPECT_TRUE(is_speed(key)) << path << "." << key.name << " [" << key.unit << "]";
    Scene scene = with_setting(kind, key, key.type == KeyType::curve ? "time" : "");
    const std::string words = scale_speeds(scene, 1.2);
    const Setting& now = scene.components.front().settings.front();
    if (is_of_a_part(key)) {
      left.insert(key.name);
      EXPECT_TRUE(words.empty() && now.number == 10) << path << "." << key.name;
      continue;
    }
    EXPECT_EQ(words, "part." + key.name) << path;
    if (key.type == KeyType::curve) {
      EXPECT_DOUBLE_EQ(now.curve.y[1], 24) << path << "." << key.name;
    } else {
      EXPECT_DOUBLE_EQ(now.number, 12) << path << "." << key.name;
    }
  }
}

TEST(ScaledSpeeds, are_all_keys_of_that_dimension_in_all_kinds) {
  std::set<std::string> left;
  for (const Kind& kind : all_kinds()) expect_scaled(kind, kind.name, left);
  EXPECT_EQ(left, (std::set<std::string>{"creep_speed", "damping_frequency", "stribeck_speed"}));
}

TEST(ScaledSpeeds, stretch_a_motors_characteristic_over_its_speed_and_no_loads) {
  for (const Kind& kind : all_kinds())
    for (const Key& key : kind.keys) {
      if (key.type != KeyType::curve || std::count(key.choices.begin(), key.choices.end(), "speed") == 0) continue;
      Scene scene = with_setting(kind, key, "speed");
      const bool load = !scale_loads(scene, 1.2).empty();
      const double was = scene.components.front().settings.front().curve.x[1];
      scale_speeds(scene, 1.2);
      EXPECT_DOUBLE_EQ(scene.components.front().settings.front().curve.x[1], load ? was : 1.2 * was) << kind.name;
    }
}

// By poles and mains the field turns a fifth faster, and the motor still fits itself.
TEST(ScaledSpeeds, of_a_motor_by_its_poles_go_with_its_mains) {
  for (const char* by : {"poles = 4", "poles = 4\nmains = \"60 Hz\"", "synchronous_speed = \"1500 rpm\""}) {
    Scene scene = test::scene_from(std::string(R"(
line = ["motor", "fan"]
[motor]
kind = "induction motor"
rated_power = "15 kW"
rated_speed = "1460 rpm"
breakdown_ratio = 3
inertia = "0.1 kg*m2"
)") + by + R"(
[fan]
kind = "flywheel"
inertia = "2 kg*m2"
)");
    const double was = build_network(scene).data.find<InductionData>("motor")->synchronous_speed;
    EXPECT_FALSE(scale_speeds(scene, 1.2).empty());
    const Network network = build_network(scene);
    const auto* now = network.data.find<InductionData>("motor");
    ASSERT_NE(now, nullptr) << by;
    EXPECT_NEAR(now->synchronous_speed, 1.2 * was, 1e-9 * was) << by;
    EXPECT_NO_THROW(compile(scene, {})) << by;
  }
}

TEST(ScaledSpeeds, are_also_those_that_a_sequence_waits_for) {
  Scene scene;
  scene.sequence.steps.resize(2);
  scene.sequence.steps[0].when = SequenceStep::When::speed_above, scene.sequence.steps[0].value = 50;
  scene.sequence.steps[1].when = SequenceStep::When::at, scene.sequence.steps[1].value = 5;
  EXPECT_FALSE(scale_speeds(scene, 0.8).empty());
  EXPECT_DOUBLE_EQ(scene.sequence.steps[0].value, 40);
  EXPECT_DOUBLE_EQ(scene.sequence.steps[1].value, 5);
}

}  // namespace
}  // namespace kurbel::scaled_scenes_test
