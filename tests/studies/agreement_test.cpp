// agreement_test.cpp — what `run` reaches and what other verbs say of it: a small form of `kurbel_bench agreement`, and
// the parts that it rests on.
#include "tests/agreement/agreement.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/scenes.h"

namespace kurbel::agreement::agreement_test {
namespace {

constexpr double pi = std::numbers::pi;

Scene scene_named(const std::string& name) { return test::scene_file("tests/agreement/" + name + ".toml"); }
SettledRun settled(const std::string& name) {
  const Scene scene = scene_named(name);
  return settle(scene, scene.effects);
}
double figure(const SettledRun& run, const QuantityKind& what) {
  const Measured* found = run.find(what, run.link);
  EXPECT_NE(found, nullptr) << word(what);
  return found ? found->value : std::nan("");
}

// --- the settled run ---

// Motor M = 60 (1 − ω/40), clutch 12 N·m: 32 rad/s before it, drum at 12/1.25 = 9.6 rad/s.
TEST(SettledRun, SlippingClutchLeavesMotorAndDrumAtTheirOwnSpeeds) {
  const SettledRun run = settled("clutch_slips_always");
  ASSERT_EQ(run.kind, Motion::repeats) << run.words;
  EXPECT_TRUE(run.equilibrium());
  EXPECT_NEAR(figure(run, quantities::mean_speed), 32, 1e-6);
  const Measured* useful = run.find(quantities::useful_work_per_cycle, "");
  ASSERT_NE(useful, nullptr);
  EXPECT_NEAR(useful->value / run.period, -12 * 9.6, 1e-5);
}

TEST(SettledRun, CranksOfRatio17To30RepeatAfterThirtyTurnsOfTheFirst) {
  const SettledRun run = settled("two_cranks_17_30");
  ASSERT_EQ(run.kind, Motion::repeats) << run.words;
  EXPECT_NEAR(run.angle, 30 * 2 * pi, 1e-5);
  EXPECT_NEAR(figure(run, quantities::mean_speed), run.angle / run.period, 1e-9);
}

// 0.7 s, whatever the angle.
TEST(SettledRun, LoadOverTimeGivesItsPeriod) {
  const SettledRun run = settled("load_over_time");
  ASSERT_EQ(run.kind, Motion::repeats) << run.words;
  EXPECT_EQ(run.base, Base::time);
  EXPECT_NEAR(run.period, 0.7, 1e-9);
}

TEST(SettledRun, StickingAndSlippingRepeatsByItsEventsAtTheMeanSpeedOfItsDrive) {
  const SettledRun run = settled("slow_stick_slip");
  ASSERT_EQ(run.kind, Motion::repeats) << run.words;
  EXPECT_EQ(run.base, Base::event);
  EXPECT_NEAR(run.angle / run.period, 0.2, 1e-8);
}

TEST(SettledRun, TooWeakAMotorIsAtRest) { EXPECT_EQ(settled("at_rest").kind, Motion::rests); }

// The work that a cycle of the press takes is that of its force over its travel: 800 N · (100 − 5/2) mm.
TEST(SettledRun, ReleasedBrakeLeavesThePressItsOwnWork) {
  const SettledRun run = settled("brake_released");
  ASSERT_EQ(run.kind, Motion::repeats) << run.words;
  const Measured* useful = run.find(quantities::useful_work_per_cycle, "");
  ASSERT_NE(useful, nullptr);
  EXPECT_NEAR(useful->value, -78, 1e-6);
  EXPECT_LT(useful->error, 1e-5);
}

// J ω̇ = 60 (1 − ω/40) − 0.4 ω: after a turn a deviation is exp(−1.9 T/1.1) of itself at equal times, and at equal
// angles, where what is faster has had less time, the same to first order; stiff coupling, ω = 60/1.9.
TEST(SettledRun, DeviationOfADrivenDrumDecaysByItsTimeConstant) {
  const SettledRun run = settled("load_window");
  ASSERT_EQ(run.kind, Motion::repeats) << run.words;
  EXPECT_NEAR(figure(run, quantities::mean_speed), 60 / 1.9, 1e-5);
  const Decay decay = decay_of(run);
  ASSERT_TRUE(decay.measured);
  EXPECT_NEAR(decay.factor, std::exp(-1.9 / 1.1 * run.period), 2e-3);
}

// --- cells ---

TEST(AgreementCell, WorstFigureDecides) {
  Row row;
  row.kind = Motion::repeats;
  row.figures = {{Topic::peaks, "a", 1, 1, 1e-6, Verdict::agrees, {}},
                 {Topic::peaks, "b", 1, 2, 1e-6, Verdict::silent, {}},
                 {Topic::peaks, "c", 1, 2, 1e-6, Verdict::refused, "why"},
                 {Topic::delta, "d", 1, 1, 1e-6, Verdict::agrees, {}}};
  ASSERT_NE(row.cell(Topic::peaks), nullptr);
  EXPECT_EQ(row.cell(Topic::peaks)->figure, "b");
  EXPECT_EQ(row.cell(Topic::rms), nullptr);
  const Totals totals = totals_of({row});
  EXPECT_EQ(totals.cells, 2u);
  EXPECT_EQ(totals.share(Verdict::silent), 0.5);
}

TEST(AgreementCell, NoteThatLeavesOutCountsOnlyWithAnAmount) {
  EXPECT_FALSE(reports_how_much({"the operating sequence is omitted: steady motion knows no switching"}));
  EXPECT_TRUE(reports_how_much({"joint clearance is omitted: it changes δ by 2 %"}));
  EXPECT_FALSE(reports_how_much({"12 positions of the cycle"}));
}

TEST(AgreementCell, RowReadsBackAsWritten) {
  Row row{.scene = "press", .kind = Motion::rests, .orbit = "at\trest", .figures = {}, .cpu_seconds = 0.25};
  row.figures.push_back({Topic::works, "work_per_cycle.x (useful)", -0.1, 1e-300, 3e-7, Verdict::reported, "so\nmuch"});
  const Row read = read_row(lines_of(row));
  EXPECT_EQ(read.scene, "press");
  EXPECT_EQ(read.kind, Motion::rests);
  EXPECT_EQ(read.orbit, "at rest");
  ASSERT_EQ(read.figures.size(), 1u);
  EXPECT_EQ(read.figures[0].run, -0.1);
  EXPECT_EQ(read.figures[0].study, 1e-300);
  EXPECT_EQ(read.figures[0].words, "so much");
}

// --- every verb against the run ---

void expect_agreement(const std::string& name, const Questions& questions) {
  const Row row = compare_verbs(scene_named(name), questions);
  EXPECT_NE(row.kind, Motion::none) << name << ": " << row.orbit;
  EXPECT_FALSE(row.figures.empty()) << name;
  std::string wrong;
  for (const Compared& c : row.figures)
    if (c.verdict == Verdict::silent)
      wrong += fmt::format("  {}: {}: run {:.9g}, told {:.9g}\n", name_of(c.topic), c.figure, c.run, c.study);
    else if (c.verdict == Verdict::refused)
      wrong += fmt::format("  {}: {}\n", name_of(c.topic), c.words);
  EXPECT_TRUE(wrong.empty()) << name << "\n" << wrong;
}
constexpr Questions steady_alone{.steady = true, .multipliers = false, .reduce = false, .size = false};
constexpr Questions steady_with_multipliers{.steady = true, .multipliers = true, .reduce = false, .size = false};
constexpr Questions reduce_alone{.steady = false, .multipliers = false, .reduce = true, .size = false};
constexpr Questions size_alone{.steady = false, .multipliers = false, .reduce = false, .size = true};

TEST(Agreement, SteadySpeaksOfClutchesFilmsAndLimitersThatSlip) {
  for (const char* name : {"clutch_slips_always", "fluid_coupling_slips", "limiter_slips_always", "overrunning_pair",
                           "viscous_damper_crank"})
    expect_agreement(name, steady_alone);
}
// Its steps wait for angles, its motor for seconds: hundreds of events pass before it repeats.
TEST(Agreement, SteadySpeaksOfASequenceThatRepeatsByAngles) { expect_agreement("press_every_third", steady_alone); }
TEST(Agreement, SteadySpeaksOfTheMachineThatItsSequenceLeaves) {
  for (const char* name : {"brake_released", "voltage_in_steps", "load_window", "starting_motor_off"})
    expect_agreement(name, steady_alone);
}
TEST(Agreement, SteadySpeaksOfLossesWhereNothingIsElastic) {
  for (const char* name : {"worm_losses_rigid", "gearbox_losses_crank", "regularised_bearing"})
    expect_agreement(name, steady_alone);
}
TEST(Agreement, SteadySpeaksOfMachinesWithStatesOfTheirOwn) {
  for (const char* name : {"governor_droop_load", "rubber_branches_crank", "dc_with_current", "two_axis_motor_fan",
                           "differential_unequal", "belt_elastic_crank"})
    expect_agreement(name, steady_alone);
}
TEST(Agreement, MultipliersAreTheDecayOfADisturbedRun) {
  for (const char* name : {"load_over_angle", "sine_torque", "converter_start"})
    expect_agreement(name, steady_with_multipliers);
}

TEST(Agreement, SteadySpeaksOfContactsThatComeAndGoWithinTheCycle) {
  for (const char* name : {"limiter_slips_at_the_blow", "fluid_coupling_crank", "backlash_idle_crank"})
    expect_agreement(name, steady_with_multipliers);
}
TEST(Agreement, SteadySpeaksOfGearsThatTieShafts) {
  for (const char* name : {"housing_support", "planetary_ring_drags", "planetary_ring_held", "two_cranks_17_30"})
    expect_agreement(name, steady_alone);
}
TEST(Agreement, ReducedInertiaHoldsTheKineticEnergyOfTheRun) {
  for (const char* name : {"soft_start", "air_motor_crank", "load_over_angle", "clutch_slips_always"})
    expect_agreement(name, reduce_alone);
}
TEST(Agreement, SizedMachineHasTheFluctuationThatIsReported) {
  for (const char* name :
       {"air_motor_crank", "gearbox_losses_crank", "limiter_slips_at_the_blow", "fluid_coupling_crank"})
    expect_agreement(name, size_alone);
}

// With a spring, a force within and friction in its pins; forces by the coupling's torque on its crank.
TEST(Agreement, StudiesSpeakOfALinkageByItsSketch) {
  expect_agreement("linkage_small", steady_alone);
  expect_agreement("linkage_small", reduce_alone);
  const Row row = compare_forces(scene_named("linkage_small"));
  const Compared* torque = row.cell(Topic::crank_torque);
  ASSERT_NE(torque, nullptr) << row.orbit;
  EXPECT_EQ(torque->verdict, Verdict::agrees) << torque->figure << torque->words;
}

}  // namespace
}  // namespace kurbel::agreement::agreement_test
