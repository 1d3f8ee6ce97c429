// difference_test.cpp — two machines side by side: keys that differ, figures that differ by more than their errors.
#include "studies/difference/difference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/find_by.h"
#include "tests/support/scenes.h"

namespace kurbel::test::difference_test {
namespace {

std::vector<SceneChange> changes(const std::string& a, const std::string& b) {
  return scene_changes(parse_toml(a, "a.toml"), parse_toml(b, "b.toml"));
}

TEST(SceneChanges, KeysAndValuesDifferNotLines) {
  const auto list = changes(
      "title = \"A\"\n# a remark\n[main]\nstiffness = \"900 kN*m/rad\"\ndamping = 3\nold = true\n[gone]\nx = 1\n",
      "title = \"A\"\n\n[main]\ndamping = 3.0\nstiffness = \"1 MN*m/rad\"\n[come]\ny = [1, 2]\n");
  ASSERT_EQ(list.size(), 4U);
  EXPECT_EQ(list[0].path, "main.stiffness");
  EXPECT_EQ(list[0].a, "\"900 kN*m/rad\"");
  EXPECT_EQ(list[0].b, "\"1 MN*m/rad\"");
  EXPECT_EQ(list[0].at_a.line, 4);
  EXPECT_EQ(list[0].at_b.line, 5);
  EXPECT_EQ(list[1].path, "main.old");
  EXPECT_FALSE(list[1].b);
  EXPECT_EQ(list[2].path, "gone");
  EXPECT_EQ(list[3].path, "come");
  EXPECT_EQ(list[3].b, "{ y = [1, 2] }");
}

TEST(SceneChanges, TwoWritingsOfAQuantityAreTheSame) {
  EXPECT_TRUE(changes("k = \"0.9 MN*m/rad\"\nn = 60\n", "k = \"900 kN*m/rad\"\nn = 60.0\n").empty());
  EXPECT_EQ(changes("k = \"0.9 MN*m/rad\"\n", "k = \"900 N*m\"\n").size(), 1U);  // another dimension
  EXPECT_EQ(changes("k = \"900 kN*m/rad\"\n", "k = \"900.0000001 kN*m/rad\"\n").size(), 1U);
}

TEST(SceneChanges, ListsOfOneLengthItemByItemElseAsAWhole) {
  const auto item = changes("steps = [{ after = \"1 s\" }, { after = \"2 s\" }]\n",
                            "steps = [{ after = \"1 s\" }, { after = \"3 s\" }]\n");
  ASSERT_EQ(item.size(), 1U);
  EXPECT_EQ(item[0].path, "steps[2].after");
  const auto whole = changes("line = [\"motor\", \"load\"]\n", "line = [\"motor\", \"clutch\", \"load\"]\n");
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].b, "[\"motor\", \"clutch\", \"load\"]");
}

// A DC motor M = M₀ (1 − ω/ω₀) runs at ω₀ (1 − M/M₀) with a load of M, and starts with the time constant τ = J ω₀/M₀ = 2/3 s.
const std::string driven =
    "line = [\"motor\", \"load\"]\nmotor = { kind = \"dc shunt motor\", stall_torque = \"60 N*m\", no_load_speed = "
    "\"40 "
    "rad/s\", inertia = \"0.5 kg*m2\" }\nload = { kind = \"load\", torque = \"TORQUE\", inertia = \"INERTIA\" "
    "}\n[run]\nuntil "
    "= \"10 s\"\naccuracy = 1e-6\n";
MachineQuestion question(std::string torque, std::string inertia) {
  std::string text = driven;
  text.replace(text.find("TORQUE"), 6, torque);
  text.replace(text.find("INERTIA"), 7, inertia);
  MachineQuestion q;
  q.text = text, q.file = torque + ".toml";
  return q;
}

const FigureDifference& figure(const MachineDifference& d, const std::string& name) {
  const auto* const found = find_by(d.figures, &FigureDifference::name, name);
  EXPECT_NE(found, nullptr) << name;
  return *found;
}

TEST(Difference, IsThatOfTheClosedForm) {
  const MachineDifference d =
      difference_between(question("15 N*m", "0.5 kg*m2"), question("30 N*m", "0.5 kg*m2"), "run");
  const FigureDifference& speed = figure(d, "final_speed.load");
  ASSERT_TRUE(speed.change() && speed.change()->error);
  EXPECT_NEAR(speed.change()->value, -10 * (1 - std::exp(-15)), *speed.change()->error + 1e-12);
  EXPECT_LT(*speed.change()->error, 1e-6);
  EXPECT_NEAR(*speed.relative(), -1 / 3.0, 1e-7);
  EXPECT_TRUE(speed.differs());
  EXPECT_FALSE(figure(d, "run_up_time").differs()) << "the time constant is the same";
  ASSERT_EQ(d.changes.size(), 1U);
  EXPECT_EQ(d.changes[0].path, "load.torque");
  const std::string conclusion = findings_of(d).conclusion();
  EXPECT_NE(conclusion.find("one key differs, load.torque (\"15 N*m\" → \"30 N*m\")"), std::string::npos) << conclusion;
}

// ln 100 time constants up to the band of 1 %, as long as they are: twice the inertia, twice the time.
TEST(Difference, OfTwiceTheInertiaIsTwiceTheTime) {
  MachineQuestion a = question("15 N*m", "0.5 kg*m2"), b = question("15 N*m", "1.5 kg*m2");
  a.settings = b.settings = {"run.until=40 s"};
  const MachineDifference d = difference_between(a, b, "run");
  const FigureDifference& time = figure(d, "run_up_time");
  ASSERT_TRUE(time.relative() && time.change()->error);
  EXPECT_NEAR(time.a->value, 2 / 3.0 * std::log(100), *time.a->error + 1e-5);
  EXPECT_NEAR(*time.relative(), 1, 1e-5);
  EXPECT_TRUE(time.differs());
}

TEST(Difference, OfTheSameMachineIsNone) {
  const MachineQuestion q = question("15 N*m", "0.5 kg*m2");
  const MachineDifference d = difference_between(q, q, "run");
  EXPECT_FALSE(d.figures.empty());
  for (const FigureDifference& f : d.figures) EXPECT_FALSE(f.differs()) << f.name;
  EXPECT_NE(findings_of(d).conclusion().find("do not differ"), std::string::npos) << findings_of(d).conclusion();
}

TEST(Difference, OfAMachineThatFailsIsIncomplete) {
  MachineQuestion stops = question("15 N*m", "0.5 kg*m2");
  stops.settings = {"run.budget=1e-9 s", "run.until=1e7 s"};
  const MachineDifference d = difference_between(question("15 N*m", "0.5 kg*m2"), stops, "run");
  EXPECT_FALSE(d.complete());
  EXPECT_FALSE(findings_of(d).complete);
  EXPECT_NE(findings_of(d).conclusion().find("no sure answer"), std::string::npos);
}

// ζ is given: that it comes out as 0.02 and 0.02 (1 + 3e-15) is rounding.
TEST(Difference, RoundingIsNone) {
  const auto with = [](const char* stiffness) {
    MachineQuestion q;
    q.text = fmt::format(
        "line = [\"a\", \"k\", \"b\"]\na = {{ kind = \"inertia\", inertia = \"0.5 kg*m2\" }}\n"
        "k = {{ kind = \"coupling\", stiffness = \"{}\", damping_ratio = 0.02 }}\n"
        "b = {{ kind = \"flywheel\", inertia = \"2 kg*m2\" }}\n"
        "effects = {{ elasticity = true }}\nrun = {{ until = \"1 s\" }}\n",
        stiffness);
    q.file = "zeta.toml", q.of = SweepStudy::modes;
    return q;
  };
  const MachineDifference d = difference_between(with("20 kN*m/rad"), with("40 kN*m/rad"), "modes");
  EXPECT_FALSE(figure(d, "damping_ratio.1").differs());
  EXPECT_TRUE(figure(d, "natural_frequency.1").differs());
}

}  // namespace
}  // namespace kurbel::test::difference_test
