// effects_test.cpp — what is off leaves no trace, any subset runs, and advice is only given on sets that were run.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "engine/base/find_by.h"
#include "engine/events/equations.h"
#include "engine/run/run.h"
#include "studies/advise/advise.h"
#include "studies/effects/effect_study.h"
#include "studies/run/compare.h"
#include "tests/support/scenes.h"
#include "tests/support/without_effect.h"

namespace kurbel::effects_test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> example_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(test::source_path("scenes")))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}
Scene example(const std::string& name) { return test::scene_file("scenes/" + name + ".toml"); }

std::vector<double> end_of_run(const Model& model, double until) {
  Equations equations(std::shared_ptr<const Model>(std::shared_ptr<void>(), &model), false);
  return integrate(equations, {.tolerance = 1e-7, .until = until, .progress = {}}, {}).state;
}

class OfExample : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, OfExample, testing::ValuesIn(example_scenes()),
                         [](const auto& info) { return info.param; });

// With an effect off, the model has the states, Jacobian and guards of the scene that never had it, and runs bit for
// bit the same.
TEST_P(OfExample, AnEffectThatIsOffLeavesNoTrace) {
  const Scene scene = example(GetParam());
  for (const EffectFlag& flag : effect_flags()) {
    if (flag.by_default != EffectFlag::Default::where_given || !has_parameters(scene, flag)) continue;
    Scene never = scene;
    test::erase_effect(never, flag.name);
    if (has_parameters(never, flag)) continue;  // a component that is nothing but the effect
    Effects off = scene.effects;
    off.*(flag.flag) = false;
    const auto with = compile(scene, off), without = compile(never, off);
    EXPECT_EQ(with->state_count(), without->state_count()) << flag.name;
    EXPECT_EQ(with->jacobian.pattern.row, without->jacobian.pattern.row) << flag.name;
    EXPECT_EQ(size_of(*with).guards, size_of(*without).guards) << flag.name;
    // Relaxation that is off leaves the loss of its branches behind, as viscous damping.
    if (flag.flag == &Effects::relaxation) continue;
    const double until = std::min(0.2, scene.run.until);
    EXPECT_EQ(end_of_run(*with, until), end_of_run(*without, until)) << flag.name;
  }
}

// Effects compose: each pair of them omitted, and each pair alone, makes a machine that runs.
TEST_P(OfExample, AnyPairOfEffectsComposes) {
  Scene scene = example(GetParam());
  scene.run.until = std::min(0.02, scene.run.until);
  const std::vector<EffectUnit> units = effect_units(scene);
  for (std::size_t a = 0; a < units.size(); ++a)
    for (std::size_t b = a; b < units.size(); ++b)
      for (const bool on : {true, false}) {
        EffectSet set(units.size(), !on);
        set[a] = set[b] = on;
        const Effects effects = effects_of(scene, units, set);
        const auto model = compile(scene, effects);
        Equations equations(model, true);
        const RunOutcome outcome =
            integrate(equations, {.tolerance = 1e-6, .until = scene.run.until, .progress = {}}, {});
        EXPECT_TRUE(outcome.complete) << describe(units, set) << ": " << outcome.diagnosis;
        for (const double value : outcome.state) EXPECT_TRUE(std::isfinite(value)) << describe(units, set);
      }
}

SimulateOptions plain() { return {.measure_error = true, .method = {}, .accuracy = {}, .until = {}}; }

// A light branch with a mode at the frequency that shakes it: it carries some 10⁻³ of the energy and sets the peak.
const char* const resonant_branch = R"(
  title = "Resonant branch"
  line = ["motor", "coupling", "machine"]
  motor = { kind = "dc shunt motor", stall_torque = "4 kN*m", no_load_speed = "160 rad/s", inertia = "2 kg*m2" }
  coupling = { kind = "coupling", stiffness = "400 kN*m/rad", damping_ratio = 0.02 }
  machine = { kind = "flywheel", inertia = "30 kg*m2" }
  work = { kind = "load", on = "machine", torque = "600 N*m", damping = "4 N*m*s/rad" }
  pump_shaft = { kind = "shaft", stiffness = "2 kN*m/rad", damping_ratio = 0.002 }
  pump = { kind = "inertia", inertia = "0.05 kg*m2" }
  shaking = { kind = "torque source", on = "pump", amplitude = "1 N*m", frequency = "31.83 Hz" }
  [[branch]]
  from = "machine"
  line = ["pump_shaft", "pump"]
  [effects]
  elasticity = true
  [run]
  until = "4 s"
  accuracy = 1e-5
  start = { speed = "130 rad/s" }
)";

TEST(Effects, EachIsRankedByWhatItChanges) {
  const Scene scene = test::scene_from(resonant_branch);
  const EffectStudy study = study_effects(scene, plain());
  ASSERT_TRUE(study.full.complete);
  ASSERT_EQ(study.omitted.size(), 2u);
  EXPECT_EQ(study.omitted[0].effect.name, "elasticity:pump_shaft");
  EXPECT_EQ(study.omitted[0].saved.states, 2);  // a twist and a speed
  EXPECT_GT(study.omitted[0].saved.nonzeros, 0);
  // By their own size the RMS and the peak are missed alike; both come before all else.
  const auto* const peak = find_by(study.omitted[0].changes, &FigureChange::figure, "peak_torque.pump_shaft");
  ASSERT_NE(peak, nullptr);
  EXPECT_GT(peak->relative, 0.9);
  EXPECT_NE(study.omitted[0].changes.front().figure.find("torque.pump_shaft"), std::string::npos);
  // Rigid, the shaft carries M + J α; at resonance 1/(2 ζ) times as much: most of it is missed.
  EXPECT_GT(study.omitted[0].changes.front().relative, 0.9);
}

TEST(Advise, KeepsALightlyDampedModeThatCarriesLittleEnergy) {
  const Scene scene = test::scene_from(resonant_branch);
  AdviseOptions options{.simulate = plain(), .within = 0.05, .figures = {}};
  const Advice advice = advise(scene, options);
  const auto at = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(advice.units.begin(), advice.units.end(), [&](const EffectUnit& u) { return u.name == name; }) -
        advice.units.begin());
  };
  const std::size_t branch = at("elasticity:pump_shaft");
  ASSERT_FALSE(advice.screens[branch].empty());
  EXPECT_EQ(advice.screens[branch].front().name, "activity");
  EXPECT_FALSE(advice.screens[branch].front().needed);  // activity alone would drop it
  EXPECT_TRUE(advice.tried[advice.chosen].on[branch]);  // the runs keep it
}

// The recommended set was run, its deviation is within the tolerance, and the scene that is written makes just that
// model.
TEST(Advise, RecommendsOnlyWhatWasRunAndStaysWithin) {
  const Scene scene = test::scene_from(resonant_branch);
  for (const double within : {0.3, 0.05, 1e-3}) {
    const Advice advice =
        advise(scene, {.simulate = plain(), .within = within, .figures = {"peak_torque", "max_speed"}});
    const TriedSet& chosen = advice.tried[advice.chosen];
    EXPECT_TRUE(chosen.within);
    EXPECT_LE(chosen.deviation, within);
    const Scene lean = test::scene_from(advice.lean_scene);
    const auto written = compile(lean, lean.effects);
    EXPECT_EQ(written->state_count(), chosen.size.states);
    const Result again = test::run(lean, false);
    for (const FigureChange& change : changes_between(advice.full, again, {"peak_torque", "max_speed"}))
      EXPECT_LE(change.relative, within * 1.01 + 1e-4) << change.figure;
    for (const HeldOut& held : advice.held_out) {
      const bool warned = std::any_of(advice.warnings.begin(), advice.warnings.end(),
                                      [&](const std::string& w) { return w.find(held.what) != std::string::npos; });
      EXPECT_NE(held.within, warned) << held.what;
    }
  }
}

// The branch is shaken next to its resonance: |1/(1 − r² + 2 i ζ r)| times as much as rigidly, r = 200/√(k (1/J +
// 1/30)).
TEST(Advise, ScreensSayHowNearAnExcitationIsToAModeAndWhatItAmplifies) {
  const Advice advice = advise(test::scene_from(resonant_branch), {.simulate = plain(), .within = 0.05, .figures = {}});
  const auto screen = [&](const std::string& unit, const std::string& name) {
    for (std::size_t k = 0; k < advice.units.size(); ++k)
      if (advice.units[k].name == unit)
        for (const Screen& s : advice.screens[k])
          if (s.name == name) return s;
    throw std::runtime_error("no screen " + name + " of " + unit);
  };
  const double omega = std::sqrt(2000 * (1 / 0.05 + 1 / 30.0)), r = 2 * std::numbers::pi * 31.83 / omega;
  const Screen orders = screen("elasticity:pump_shaft", "orders against modes");
  EXPECT_NEAR(orders.number, 1 - r, 2e-4);
  EXPECT_TRUE(orders.needed);
  const Screen amplified = screen("elasticity:pump_shaft", "quasi-static amplification");
  EXPECT_NEAR(amplified.number, 1 / std::hypot(1 - r * r, 2 * 0.002 * r), 0.05 * amplified.number);
  EXPECT_TRUE(amplified.needed);
  EXPECT_FALSE(screen("elasticity:coupling", "orders against modes").needed);
}

TEST(Advise, RefusesFiguresThatDoNotExist) {
  const Scene scene = test::scene_from(resonant_branch);
  EXPECT_THROW(advise(scene, {.simulate = plain(), .within = 0.05, .figures = {"peak_torqe"}}), std::invalid_argument);
}

// Impacts speak for clearance; a rod whose first mode lies far above the speed speaks for itself.
TEST(Advise, ScreensClearanceByImpactsAndARodByItsFrequency) {
  for (const auto& [scene, screen] :
       {std::pair("worn_crank_pin", "impacts"), std::pair("flexible_rod", "rod frequency")}) {
    const Advice advice =
        advise(example(scene), {.simulate = plain(), .within = 0.05, .figures = {}, .held_out = false});
    bool found = false;
    for (const auto& screens : advice.screens)
      for (const Screen& s : screens) found = found || (s.name == screen && s.number > 1);
    EXPECT_TRUE(found) << scene;
  }
}

// A crank at a prescribed speed: all speeds and times are given, the torque of its drive is not.
TEST(Effects, OfAPrescribedSpeedAreThoseOnItsTorque) {
  const EffectStudy study = study_effects(test::scene_from(R"(
    line = ["drive", "crank"]
    drive = { kind = "prescribed speed", speed = "1500 rpm" }
    run = { start = { speed = "1500 rpm" }, until = "0.2 s" }
    [crank]
    kind = "slider-crank"
    radius = "100 mm"
    rod = "400 mm"
    rod_mass = "3 kg"
    rod_com = "160 mm"
    rod_inertia = "0.05 kg*m2"
    slider_mass = "4 kg"
    load = { kind = "constant", force = "-5 kN" }
  )"),
                                          plain());
  const auto inertia = std::find_if(study.omitted.begin(), study.omitted.end(), [](const OmittedEffect& omitted) {
    return omitted.effect.name == "variable_inertia";
  });
  ASSERT_NE(inertia, study.omitted.end());
  ASSERT_FALSE(inertia->changes.empty());
  EXPECT_EQ(inertia->changes.front().figure, "motor_peak_torque.drive");
  EXPECT_NEAR(inertia->changes.front().relative, 0.511, 1e-3);  // −515.4 of −1054.8 N·m
}

// Without elasticity the lag of the motor's torque stays: what is omitted is one effect.
TEST(Effects, ElasticityIsOmittedWithoutTheTorqueLag) {
  const Scene scene = test::scene_from(R"(
    line = ["motor", "c", "wheel", "crank"]
    c = { kind = "coupling", stiffness = "80 kN*m/rad", damping_ratio = 0.03 }
    wheel = { kind = "flywheel", inertia = "150 kg*m2" }
    run = { start = { speed = "98 rpm", equilibrium = true }, until = "4 s" }
    [motor]
    kind = "induction motor"
    rated_power = "7.5 kW"
    rated_speed = "96 rpm"
    synchronous_speed = "100 rpm"
    breakdown_ratio = 2.5
    inertia = "20 kg*m2"
    [crank]
    kind = "slider-crank"
    radius = "60 mm"
    rod = "300 mm"
    slider_mass = "120 kg"
    load = { kind = "press", nominal_force = "200 kN", nominal_travel = "10 mm" }
  )");
  const EffectStudy study = study_effects(scene, plain());
  const auto elasticity = std::find_if(study.omitted.begin(), study.omitted.end(), [](const OmittedEffect& omitted) {
    return omitted.effect.name == "elasticity:c";
  });
  ASSERT_NE(elasticity, study.omitted.end());
  const auto* const delta = find_by(elasticity->changes, &FigureChange::figure, "delta.crank");
  ASSERT_NE(delta, nullptr);
  const Comparison beside = compare(scene, models_to_compare(scene), plain());
  EXPECT_NEAR(delta->without, test::figure(beside.a, "delta.crank"), 1e-6);  // 0.09865
  EXPECT_NEAR(delta->full, test::figure(beside.b, "delta.crank"), 1e-6);     // 0.11119
}

}  // namespace
}  // namespace kurbel::effects_test
