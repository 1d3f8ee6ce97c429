// explain_test.cpp — kurbel explain on the command line.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/program.h"

namespace kurbel::explain_test {
namespace {

using test::Said;

Said explain(const std::string& arguments) { return test::said_by_program("explain " + arguments); }

TEST(Explain, SaysWhatAFigureIsItsFormulaAndWhatItIsNot) {
  for (const char* asked : {"delta", "delta.press", "δ", "\"speed fluctuation\""}) {
    const Said said = explain(asked);
    EXPECT_EQ(said.code, 0) << said.text;
    EXPECT_TRUE(said.has("delta.SHAFT — speed fluctuation δ")) << said.text;
    EXPECT_TRUE(said.has("ω_mid = ½ (ω_max + ω_min)")) << said.text;
    EXPECT_TRUE(said.has("is not")) << said.text;
    EXPECT_TRUE(said.has("docs/theory/02-reduction.md")) << said.text;
    EXPECT_TRUE(said.has("steady")) << said.text;
  }
}

TEST(Explain, MeanAndMidSpeedAreTwo) {
  EXPECT_TRUE(explain("'mean speed'").has("Φ/T"));
  EXPECT_TRUE(explain("mid_speed.press").has("½ (ω_max + ω_min)"));
}

TEST(Explain, APeakOfAnElementsOwnIsStatedToBeOne) {
  const Said said = explain("peak_current.motor");
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_TRUE(said.has("greatest magnitude in a whole run")) << said.text;
}

TEST(Explain, AKeyOfASceneIsExplainedByTheKeysOfItsKinds) {
  const Said said = explain("rotor.inertia");
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_TRUE(said.has("rotor.inertia — key of a scene")) << said.text;
  EXPECT_TRUE(said.has("kg·m²; domain: ≥ 0")) << said.text;
  EXPECT_TRUE(said.has("rotor inertia")) << said.text;
  EXPECT_TRUE(said.has("key of     induction motor, ")) << said.text;
  EXPECT_TRUE(explain("run.until").has("key of     run"));
  EXPECT_EQ(explain("rotor.inertai").code, 2);
}

TEST(Explain, WhatIsUnknownIsRefusedWithNamesThatAreLikeIt) {
  const Said said = explain("torqe");
  EXPECT_EQ(said.code, 2);
  EXPECT_TRUE(said.has("no figure \"torqe\" — did you mean \"torque\"?")) << said.text;
  EXPECT_EQ(explain("xyzzy").code, 2);
}

TEST(Explain, WithoutANameAllAreListed) {
  const Said all = explain(""), names = explain("--list");
  EXPECT_EQ(all.code, 0);
  for (const char* name : {"delta", "peak_torque", "mid_speed", "flywheel", "natural_frequency"}) {
    EXPECT_TRUE(all.has(std::string(name) + " ")) << name;
    EXPECT_TRUE(names.has(std::string(name) + "\n")) << name;
  }
}

}  // namespace
}  // namespace kurbel::explain_test
