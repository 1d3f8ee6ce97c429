// advise_test.cpp — advice holds where it is run again and elsewhere, and says what its runs leave open.
#include "studies/advise/advise.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/agreement/agreement.h"
#include "tests/support/scenes.h"

namespace kurbel::advise_test {
namespace {

FigureChange change(const std::string& figure, double relative, double error) {
  return {.figure = figure, .unit = "", .full = 1, .without = 1 + relative, .relative = relative, .error = error};
}

// d + e ≤ τ is within; what is known less well than τ is not judged unless it is surely outside.
TEST(Advise, AFigureIsWithinOnlyTogetherWithItsError) {
  EXPECT_TRUE(deviation_of({change("a", 0.006, 0.003)}, 0.01).within);
  EXPECT_FALSE(deviation_of({change("a", 0.009, 0.003)}, 0.01).within);
  const Deviation unsure = deviation_of({change("a", 0.02, 0.03), change("b", 0.002, 0.001)}, 0.01);
  EXPECT_TRUE(unsure.within);
  ASSERT_EQ(unsure.not_judged.size(), 1u);
  EXPECT_EQ(unsure.not_judged.front(), "a (known to 3 %)");
  EXPECT_EQ(unsure.figure, "b");
  const Deviation sure = deviation_of({change("a", 0.08, 0.03), change("b", 0.002, 0.001)}, 0.01);
  EXPECT_FALSE(sure.within);
  EXPECT_TRUE(sure.not_judged.empty());
}

// The greatest change and the greatest error may be of different figures: their sum bounds both.
TEST(Advise, DeviationAndErrorTogetherBoundEveryFigure) {
  const std::vector<FigureChange> changes = {change("a", 0.005, 0.0001), change("b", 0.003, 0.004)};
  const Deviation d = deviation_of(changes, 0.01);
  EXPECT_EQ(d.deviation, 0.005);
  EXPECT_EQ(d.figure, "a");
  for (const FigureChange& c : changes) EXPECT_LE(c.relative + c.error, d.deviation + d.error + 1e-15);
}

// Ideal joints with friction and a joint with a gap exclude each other in one mechanism.
const char* const worn_pump = R"(
  title = "Worn pump"
  line = ["motor", "crank"]
  motor = { kind = "dc shunt motor", stall_torque = "40 N*m", no_load_speed = "62 rad/s", inertia = "0.01 kg*m2" }
  [crank]
  kind = "slider-crank"
  radius = "50 mm"
  rod = "150 mm"
  crank_inertia = "0.05 kg*m2"
  rod_mass = "0.3 kg"
  slider_mass = "0.5 kg"
  clearance = { kind = "crank pin", gap = "0.1 mm", stiffness = "50 kN/mm", exponent = 1.5, restitution = 0.5, restitution_speed = "0.2 m/s" }
  main_bearing = { radius = "20 mm", friction = 0.1 }
  load = { kind = "medium", viscous = "40 N*s/m" }
  [run]
  start = { speed = "60 rad/s" }
  until = "0.02 s"
  accuracy = 1e-4
)";

TEST(Effects, WhatDoesNotGoWithTheRestIsJudgedInTheirPlace) {
  const Scene scene = test::scene_from(worn_pump);
  const std::vector<EffectUnit> units = effect_units(scene);
  const auto at = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(units.begin(), units.end(), [&](const EffectUnit& u) { return u.name == name; }) - units.begin());
  };
  const std::size_t friction = at("joint_friction"), clearance = at("joint_clearance");
  ASSERT_LT(std::max(friction, clearance), units.size());
  const EffectSet fullest = fullest_set(scene, units);
  EXPECT_TRUE(fullest[clearance]);  // the scene's own effect
  EXPECT_FALSE(fullest[friction]);
  const InPlaceOf sets = in_place_of_others(scene, units, fullest, friction);
  EXPECT_TRUE(sets.with[friction]);
  EXPECT_FALSE(sets.with[clearance]);
  EXPECT_EQ(sets.gives_way, "joint clearance");

  const EffectStudy study = study_effects(scene, {});
  ASSERT_TRUE(study.full.complete) << study.full.diagnosis;
  const auto judged = std::find_if(study.omitted.begin(), study.omitted.end(),
                                   [](const OmittedEffect& l) { return l.effect.name == "joint_friction"; });
  ASSERT_NE(judged, study.omitted.end());
  EXPECT_EQ(judged->failed, "");
  EXPECT_EQ(judged->in_place_of, "joint clearance");
  ASSERT_FALSE(judged->changes.empty());
  EXPECT_TRUE(judged->changes.front().reported());
  EXPECT_NE(study.conclusion.find("joint friction, which does not go with joint clearance"), std::string::npos);
}

const char* const stiff_drive = R"(
  title = "Stiff drive"
  line = ["motor", "coupling", "machine"]
  motor = { kind = "dc shunt motor", stall_torque = "4 kN*m", no_load_speed = "160 rad/s", inertia = "2 kg*m2" }
  coupling = { kind = "coupling", stiffness = "4 kN*m/rad", damping_ratio = 0.1 }
  machine = { kind = "flywheel", inertia = "30 kg*m2" }
  work = { kind = "load", on = "machine", torque = "600 N*m", damping = "4 N*m*s/rad" }
  [effects]
  elasticity = true
  [run]
  until = "1 s"
  accuracy = 1e-6
  start = { speed = "130 rad/s" }
)";

// What is advised holds when it is run again, with a tighter accuracy, and where a load of ± 20 % is said to be within.
TEST(Advise, TheAdvisedSetStaysWithinWhenRunAgainAndAtOtherLoads) {
  const Scene scene = test::scene_from(stiff_drive);
  for (const double within : {1e-3, 0.02, 0.9}) {
    const Advice advice = advise(scene, {.simulate = {}, .within = within, .figures = {}});
    const TriedSet& chosen = advice.tried[advice.chosen];
    EXPECT_LE(chosen.deviation + chosen.error, within);
    for (const TriedSet& t : advice.tried) {
      if (t.within) {
        EXPECT_GE(t.work(), 0.97 * chosen.work()) << t.words;
      }
    }
    SimulateOptions tighter;
    tighter.accuracy = 1e-7;
    const auto deviation = [&](const Scene& machine) {
      const Result full = simulate(machine, scene.effects, "full", tighter);
      const Result lean = simulate(machine, effects_of(machine, advice.units, chosen.on), "lean", tighter);
      double most = 0;
      for (const FigureChange& c : changes_between(full, lean))
        if (c.error < within) most = std::max(most, c.sure());
      return most;
    };
    EXPECT_LE(deviation(scene), within);
    for (const HeldOut& held : advice.held_out) {
      if (!held.what.starts_with("loads")) continue;
      Scene loaded = scene;
      scale_loads(loaded, held.what.find('+') != std::string::npos ? 1.2 : 0.8);
      EXPECT_NEAR(deviation(loaded), held.deviation, held.error + 2e-3 * held.deviation + 1e-9) << held.what;
    }
  }
}

// What is advised does not depend on what else the computer does: times are measured, the choice counts evaluations.
TEST(Advise, IsTheSameWhateverTheTimes) {
  const Scene scene = test::scene_from(stiff_drive);
  const AdviseOptions options{.simulate = {}, .within = 0.02, .figures = {}, .held_out = false};
  const Advice first = advise(scene, options), second = advise(scene, options);
  ASSERT_EQ(first.tried.size(), second.tried.size());
  for (std::size_t i = 0; i < first.tried.size(); ++i) EXPECT_EQ(first.tried[i].work(), second.tried[i].work());
  EXPECT_EQ(first.chosen, second.chosen);
}

// A start from rest hides what the settled machine does: the run's figures call a crank of constant inertia good enough
// here for 5 %, and the RMS of a half shaft's torque is 5.0 % off in the motion that is kept. What is advised, and what is
// warned of at other loads, covers the settled motion, too (tests/agreement: no cell of advice is silent).
TEST(Advise, CoversTheSettledMotionAndNotTheStartAlone) {
  for (const char* file :
       {"tests/agreement/vibrations/differential_shafts.toml", "tests/agreement/belt_elastic_crank.toml"}) {
    const agreement::Row row = agreement::compare_advice(test::scene_file(file), 0.05, {});
    EXPECT_FALSE(row.figures.empty() && row.orbit != "everything is recommended") << file;
    for (const auto& cell : row.figures)
      EXPECT_NE(cell.verdict, agreement::Verdict::silent) << file << ": " << cell.figure;
  }
}

}  // namespace
}  // namespace kurbel::advise_test
