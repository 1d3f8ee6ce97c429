// vanishing_damping_test.cpp — damping that is given in relation to inertias, where a flange has none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace kurbel::vanishing_damping_test {
namespace {

double damping_of(const Model& model, const std::string& component) {
  for (const Network::Joint& joint : model.network.joints)
    if (joint.component == component && joint.element) return joint.element->damping;
  return std::nan("");
}

std::string refusal_of(const std::string& text, const Effects& effects = Effects{true, {}}) {
  try {
    compile(test::scene_from(text), effects);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

// c = 2 ζ √(k J_red) by the motor's 4 and the saw's 0.5 kg·m², whichever effects are on.
TEST(VanishingDamping, inertias_are_seen_through_the_neighbouring_springs) {
  const Scene scene = test::scene_file("tests/cases/reports/vanishing_damping.toml");
  const double right = 2 * 0.1 * std::sqrt(20e3 * 4 * 0.5 / 4.5);
  EXPECT_NEAR(right, 18.856, 1e-3);
  for (const Effects& effects : {scene.effects, Effects{}})
    EXPECT_NEAR(damping_of(*compile(scene, effects), "cardan"), right, 1e-10) << effects.describe();
  EXPECT_NEAR(test::figure(test::run(scene), "peak_torque.coupling"), 610.04, 0.005);
}

// Through a gear its square counts, through branches their sum, and on through one flange without inertia after the other.
TEST(VanishingDamping, ratios_and_branches_count) {
  const std::string text = R"(
line = ["a", "c1", "g", "c2", "d"]
a = { kind = "inertia", inertia = "2 kg*m2" }
c1 = { kind = "coupling", stiffness = "1 kN*m/rad" }
g = { kind = "gearbox", stages = [{ teeth = [19, 57] }] }
c2 = { kind = "coupling", stiffness = "5 kN*m/rad", WHAT }
d = { kind = "inertia", inertia = "7 kg*m2" }
c3 = { kind = "coupling", stiffness = "2 kN*m/rad" }
e = { kind = "inertia", inertia = "5 kg*m2" }
effects = { elasticity = true }

[[branch]]
from = "g.out"
line = ["c3", "e"]
)";
  const double seen = 2 * 9 + 5, reduced = 7 * seen / (7 + seen), k = 5e3;
  const std::pair<const char*, double> forms[] = {
      {"damping_ratio = 0.05", 2 * 0.05 * std::sqrt(k * reduced)},
      {"loss_factor = 0.1", 0.1 * std::sqrt(k * reduced)},
      {"relative_damping = 0.6", 0.6 / (2 * M_PI) * std::sqrt(k * reduced)}};
  for (const auto& [words, right] : forms) {
    std::string one = text;
    one.replace(one.find("WHAT"), 4, words);
    EXPECT_NEAR(damping_of(*compile(test::scene_from(one), Effects{}), "c2"), right, 1e-10) << words;
  }
}

// Where nothing is defined it is refused, at the component, with what to give; elastic or not at all.
TEST(VanishingDamping, what_is_not_defined_is_refused) {
  const std::string held = R"(
line = ["a", "c", "b"]
a = { kind = "prescribed speed", speed = "10 rad/s" }
c = { kind = "coupling", stiffness = "1 kN*m/rad", damping_ratio = 0.1MORE }
b = { kind = "prescribed speed", speed = "10 rad/s" }
)";
  const auto with = [&](const char* more) {
    std::string one = held;
    one.replace(one.find("MORE"), 4, more);
    return one;
  };
  const std::string words = refusal_of(with(""));
  EXPECT_NE(words.find("both of its shafts turn at given speeds"), std::string::npos) << words;
  EXPECT_NE(words.find("damping_frequency"), std::string::npos) << words;
  EXPECT_NE(words.find("test.toml:4:"), std::string::npos) << words;
  EXPECT_EQ(refusal_of(with(", damping_frequency = \"8 Hz\"")), "");
  std::string loose = R"(
line = ["a", "c", "d"]
a = { kind = "inertia", inertia = "1 kg*m2" }
c = { kind = "coupling", stiffness = "1 kN*m/rad", loss_factor = 0.1 }
d = { kind = "coupling", stiffness = "1 kN*m/rad", inertia_out = "0 kg*m2" }
)";
  EXPECT_NE(refusal_of(loose), "");
}

}  // namespace
}  // namespace kurbel::vanishing_damping_test
