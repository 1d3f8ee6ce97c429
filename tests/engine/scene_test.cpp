// scene_test.cpp — what a scene file says, in SI and in canonical order.
#include "engine/scene/scene.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/scenes.h"

namespace kurbel::scene_test {
namespace {

using Texts = std::vector<std::string>;

const std::string motor =
    "[motor]\nkind = \"dc shunt motor\"\nstall_torque = \"60 N*m\"\nno_load_speed = \"1500 rpm\"\ninertia = \"0.1 "
    "kg*m2\"\n";
const std::string coupling = "[coupling]\nkind = \"coupling\"\nstiffness = \"4 kN*m/rad\"\ndamping_ratio = \"5 %\"\n";
std::string flywheel(const std::string& name, const std::string& more = "") {
  return "[" + name + "]\nkind = \"flywheel\"\ninertia = \"2 kg*m2\"\n" + more;
}
const std::string base = "line = [\"motor\", \"coupling\", \"wheel\"]\n" + motor + coupling + flywheel("wheel");

Texts order_of(const Scene& scene) {
  Texts names;
  for (const Section& s : scene.components) names.push_back(s.name);
  return names;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

TEST(Scene, ValuesAreReadInSi) {
  const Scene scene = test::scene_from(base);
  EXPECT_NEAR(scene.find("motor")->number("no_load_speed"), 50 * std::numbers::pi, 1e-12);
  EXPECT_EQ(scene.find("coupling")->number("stiffness"), 4000);
  EXPECT_EQ(scene.find("coupling")->number("damping_ratio"), 0.05);
}

TEST(Scene, WhatIsNotGivenHasItsDefault) {
  const Scene scene = test::scene_from(base);
  const Section& c = *scene.find("coupling");
  EXPECT_EQ(c.number("inertia_in"), 0);
  EXPECT_FALSE(c.given("inertia_in"));
  EXPECT_FALSE(c.has("damping"));
  EXPECT_EQ(scene.run.until, 1);
  EXPECT_EQ(scene.run.accuracy, 1e-6);
  EXPECT_EQ(scene.run.method, "auto");
  EXPECT_EQ(scene.run.model, "reduced");
  EXPECT_EQ(scene.run.samples, 1000);
  EXPECT_EQ(scene.run.budget, 300);
  EXPECT_FALSE(scene.run.start.equilibrium);
  EXPECT_EQ(scene.effects.describe(), "none");
  EXPECT_TRUE(scene.title.empty());
}

TEST(Scene, RunAndTitleAreRead) {
  const Scene scene = test::scene_from("title = \"Test\"\n" + base +
                                       "[run]\nuntil = \"2 min\"\naccuracy = 1e-9\nmethod = \"bdf\"\nsamples = "
                                       "7\nbudget = \"1 h\"\noutput = [\"wheel\"]\n");
  EXPECT_EQ(scene.title, "Test");
  EXPECT_EQ(scene.run.until, 120);
  EXPECT_EQ(scene.run.accuracy, 1e-9);
  EXPECT_EQ(scene.run.method, "bdf");
  EXPECT_EQ(scene.run.samples, 7);
  EXPECT_EQ(scene.run.budget, 3600);
  EXPECT_EQ(scene.run.output, Texts{"wheel"});
}

// Messages state speeds as the scene's first one is written.
TEST(Scene, SpeedsAreReportedInTheUnitOfTheFirst) {
  const auto unit = [](const std::string& first, const std::string& start) {
    std::string text = base;
    text.replace(text.find("1500 rpm"), std::string("1500 rpm").size(), first);
    return test::scene_from(text + "[run]\nstart = { speed = \"" + start + "\" }\n").speed_unit;
  };
  EXPECT_EQ(unit("300 rpm", "3 rad/s").text(2 * M_PI), "60 rpm");
  EXPECT_EQ(unit("300 1/min", "3 rad/s").text(2 * M_PI), "60 1/min");
  EXPECT_EQ(unit("30 rad/s", "3 rpm").text(2.5), "2.5 rad/s");
  EXPECT_EQ(unit("5 Hz", "3 rad/s").text(2 * M_PI), "1 Hz");
  EXPECT_EQ(unit("1e3 deg/s", "3 rad/s").text(M_PI), "180 deg/s");
}

TEST(Scene, AFrequencyIsNoSpeed) {
  const Scene scene = test::scene_from(
      "line = [\"source\", \"wheel\"]\nsource = { kind = \"torque source\", amplitude = \"1 N*m\", frequency = \"300 "
      "1/min\" }\nwheel = { kind = \"flywheel\", inertia = \"1 kg*m2\" }\n");
  EXPECT_EQ(scene.speed_unit.name, "rpm");  // nothing said
}

TEST(Scene, OrderOfTablesInTheFileDoesNotMatter) {
  const Scene a = test::scene_from(base), b = test::scene_from("line = [\"motor\", \"coupling\", \"wheel\"]\n" +
                                                               flywheel("wheel") + coupling + motor);
  EXPECT_EQ(order_of(a), (Texts{"motor", "coupling", "wheel"}));
  EXPECT_EQ(order_of(b), order_of(a));
}

TEST(Scene, OnIsABranchOfOneComponent) {
  const Scene a = test::scene_from(base + flywheel("pump", "on = \"wheel\"\n"));
  const Scene b = test::scene_from(base + flywheel("pump") + "[[branch]]\nfrom = \"wheel\"\nline = [\"pump\"]\n");
  ASSERT_EQ(a.lines.size(), 2u);
  EXPECT_EQ(a.lines[1].from, b.lines[1].from);
  EXPECT_EQ(a.lines[1].names, b.lines[1].names);
  EXPECT_EQ(order_of(a), order_of(b));
}

TEST(Scene, BranchesOfBranchesFollowWhatTheyBranchFrom) {
  const Scene scene = test::scene_from(base + flywheel("a", "on = \"b\"\n") + flywheel("b", "on = \"c\"\n") +
                                       flywheel("c", "on = \"coupling.out\"\n") + flywheel("d", "on = \"a\"\n"));
  EXPECT_EQ(order_of(scene), (Texts{"motor", "coupling", "wheel", "c", "b", "a", "d"}));
  EXPECT_EQ(scene.lines[1].from, "coupling.out");
}

TEST(Scene, EffectsAreAllNoneOrNamed) {
  EXPECT_TRUE(test::scene_from(base + "[effects]\nelasticity = true\n").effects.is_elastic("coupling"));
  EXPECT_FALSE(test::scene_from(base + "[effects]\nelasticity = false\n").effects.is_elastic("coupling"));
  const Scene named = test::scene_from(base + "[effects]\nelasticity = [\"coupling\"]\n");
  EXPECT_FALSE(named.effects.all_elastic);
  EXPECT_TRUE(named.effects.is_elastic("coupling"));
  EXPECT_EQ(named.effects.describe(), "elasticity of coupling");
}

TEST(Scene, StartIsRestEquilibriumOrATable) {
  EXPECT_FALSE(test::scene_from(base + "[run]\nstart = \"rest\"\n").run.start.equilibrium);
  EXPECT_TRUE(test::scene_from(base + "[run]\nstart = \"equilibrium\"\n").run.start.equilibrium);
  const StartSettings start =
      test::scene_from(base +
                       "[run]\nstart = { speed = \"30 rpm\", angle = \"90 deg\", on = \"wheel\", equilibrium = true, "
                       "motor = { speed = \"2 rad/s\", angle = \"1 rad\" }, coupling = { twist = \"180 deg\" } }\n")
          .run.start;
  EXPECT_NEAR(start.speed, std::numbers::pi, 1e-15);
  EXPECT_NEAR(start.angle, std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(start.on, "wheel");
  EXPECT_TRUE(start.equilibrium);
  EXPECT_EQ(start.components.at("motor").speed, 2);
  EXPECT_EQ(start.components.at("motor").angle, 1);
  EXPECT_NEAR(*start.components.at("coupling").twist, std::numbers::pi, 1e-15);
  EXPECT_FALSE(start.components.at("coupling").speed);
}

TEST(Scene, CommandLineEffectsAreParsed) {
  const Scene scene = test::scene_from(base);
  EXPECT_EQ(parse_effects("none", scene).describe(), "none");
  EXPECT_TRUE(parse_effects("elasticity", scene).all_elastic);
  EXPECT_EQ(parse_effects("elasticity:coupling", scene).elastic, Texts{"coupling"});
  EXPECT_EQ(parse_effects("elasticity,-elasticity:coupling", scene).describe(), "none");
  const Scene press = test::scene_file("bench/scenes/press_with_everything.toml");
  const Effects some = parse_effects("elasticity:motor_coupling,main_coupling,backlash,gravity", press);
  EXPECT_EQ(some.elastic, (Texts{"motor_coupling", "main_coupling"}));
  EXPECT_TRUE(some.backlash && some.gravity && !some.gear_losses);
  EXPECT_EQ(parse_effects("elasticity,-elasticity:main_coupling", press).elastic, (Texts{"motor_coupling", "gearbox"}));
  const Effects nearly_all = parse_effects("all,-transients", press);
  EXPECT_TRUE(nearly_all.all_elastic && nearly_all.joint_friction && nearly_all.gear_losses && nearly_all.gravity);
  EXPECT_FALSE(nearly_all.transients || nearly_all.mesh_variation);
  EXPECT_EQ(parse_effects("-backlash", press).elastic, press.effects.elastic);
}

TEST(Scene, CommandLineEffectsErrorsNameTheAllowed) {
  const Scene scene = test::scene_from(base);
  EXPECT_EQ(
      message_of([&] { parse_effects("elastisity", scene); }),
      "effects \"elastisity\" — did you mean \"elasticity\"?; allowed: \"none\", \"all\", \"elasticity\", "
      "\"elasticity:COUPLING,…\", \"joint_friction\", \"backlash\", \"mesh_variation\", \"transients\", "
      "\"torque_lag\", \"relaxation\", \"bearing_friction\", \"gear_losses\", \"joint_clearance\", \"flexible_rod\", "
      "\"gravity\", "
      "\"variable_inertia\", \"load_edges\" or \"multibody\"; several joined by commas, or -NAME to take one away");
  EXPECT_NE(message_of([&] { parse_effects("backlash", scene); }).find("no component of the scene has parameters"),
            std::string::npos);
  EXPECT_EQ(parse_effects("-elasticity", scene).describe(), "none");
  EXPECT_EQ(message_of([&] { parse_effects("elasticity:copling", scene); }),
            "effects \"elasticity:copling\": \"copling\" is no component — did you mean \"coupling\"?; allowed: "
            "\"coupling\"");
  EXPECT_EQ(message_of([&] { parse_effects("elasticity:wheel", scene); }),
            "effects \"elasticity:wheel\": \"wheel\" is a flywheel, which is always rigid; allowed: \"coupling\"");
  EXPECT_NE(message_of([&] { parse_effects("elasticity:coupling,", scene); }), "no error");
  EXPECT_NE(message_of([&] { parse_effects("", scene); }), "no error");
}

TEST(Scene, MethodsBelongToTheirModel) {
  EXPECT_EQ(message_of([] { check_method("bdf", "reduced"); }), "no error");
  EXPECT_EQ(message_of([] { check_method("CPodes", "multibody"); }), "no error");
  EXPECT_NE(message_of([] { check_method("CPodes", "reduced"); }).find("belongs to model = \"multibody\""),
            std::string::npos);
  for (const char* model : {"reduced", "multibody"})
    for (const std::string& method : methods_of(model)) {
      const auto key =
          std::find_if(run_keys().begin(), run_keys().end(), [](const Key& k) { return k.name == "method"; });
      EXPECT_EQ(std::count(key->choices.begin(), key->choices.end(), method), 1) << method;
    }
}

TEST(Scene, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(message_of([] { test::scene_from(base + "[run]\nuntil = \"3 µs·x\"\n"); }),
            "test.toml:15:15: [run]: until = \"3 µs·x\": unknown unit \"x\"; write e.g. \"3 s\", \"20 ms\"");
}

TEST(Scene, MessagesOfOneFileComeSortedByLine) {
  try {
    test::scene_from(base + "[run]\nuntil = 3\nsamples = 0\n[effects]\nelasticity = 3\n[odd]\nkind = \"odd\"\n");
    FAIL();
  } catch (const SceneError& error) {
    ASSERT_EQ(error.messages.size(), 4u);
    for (std::size_t i = 1; i < error.messages.size(); ++i)
      EXPECT_LT(error.messages[i - 1].at.line, error.messages[i].at.line);
  }
}

}  // namespace
}  // namespace kurbel::scene_test
