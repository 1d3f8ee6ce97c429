// repeating_motion_test.cpp — steady motions whose period is several cycles or a time, against closed forms; starts of drives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "engine/return_map/periodicity.h"
#include "studies/answers/run_claims.h"
#include "studies/figures/asked_figures.h"
#include "studies/findings/findings.h"
#include "studies/findings/trace.h"
#include "studies/limits/ratings.h"
#include "studies/run/periods.h"
#include "studies/run/run_findings.h"
#include "studies/steady/steady.h"
#include "tests/support/light_crank.h"
#include "tests/support/scenes.h"

namespace kurbel::repeating_motion_test {
namespace {

using test::figure, test::light_crank, test::run;
constexpr double turn = 2 * std::numbers::pi;

// 10 N·m drive, and a load brakes in some turns of each period so that A_d = A_c. With inertia I: ω² = ω₀² + 2 A/I.
// `pattern`: whether it brakes in a turn; it does in the first.
std::string braked_in(const std::vector<bool>& pattern, double inertia, double turns, const std::string& more = "") {
  const auto ones = static_cast<double>(std::count(pattern.begin(), pattern.end(), true));
  std::string steps;
  for (std::size_t k = 1; k <= pattern.size(); ++k)
    steps += fmt::format("{}{{ angle = \"0 deg\", of = \"crank\", set = \"load\", to = {} }}", k > 1 ? ", " : "",
                         pattern[k % pattern.size()] ? 1 : 0);
  return fmt::format(R"(
line = ["motor", "flywheel", "crank"]
motor = {{ kind = "torque source", torque = "10 N*m" }}
flywheel = {{ kind = "flywheel", inertia = "{} kg*m2" }}
load = {{ kind = "load", on = "flywheel", torque = "{:.17g} N*m", acts = "always" }}
sequence = {{ repeat = true, steps = [{}] }}
run = {{ start = {{ speed = "20 rad/s" }}, until = "{} s", accuracy = 1e-8 }}
{}
)",
                     inertia, 10 * static_cast<double>(pattern.size()) / ones, steps, turns * turn / 20, more) +
         light_crank;
}
std::vector<bool> one_in(std::size_t n) {
  std::vector<bool> pattern(n);
  pattern[0] = true;
  return pattern;
}

TEST(RepeatingMotion, APressThatStrikesEachNthStrokeIsSteady) {
  for (const int n : {2, 3, 5, 12}) {
    const Result r = run(braked_in(one_in(static_cast<std::size_t>(n)), 30, 3 * n + 3));
    ASSERT_TRUE(r.periods.steady) << n << " " << r.periods.verdict;
    EXPECT_EQ(r.periods.cycles, n);
    EXPECT_NE(r.periods.verdict.find(fmt::format("repeats every {} turns", n)), std::string::npos) << r.periods.verdict;
    // The load takes 10 (n − 1) N·m more than the drive gives, over one turn.
    const double low = std::sqrt(400 - 2 * 10 * (n - 1) * turn / 30);
    EXPECT_NEAR(figure(r, "delta.crank"), 2 * (20 - low) / (20 + low), 1e-7) << n;
    EXPECT_NEAR(figure(r, "mid_speed.crank"), (20 + low) / 2, 1e-6);
    EXPECT_NEAR(r.periods.steady_speed, (20 + low) / 2, 1e-6);
    EXPECT_NEAR(figure(r, "driving_work_per_cycle"), 10 * n * turn, 1e-5);
    EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -10 * n * turn, 1e-5);
    // One turn from 20 to `low`, the others back again, each at constant deceleration: t = Δφ over the mean of both ends.
    const double period = turn * n / (0.5 * (20 + low));
    EXPECT_NEAR(figure(r, "period"), period, 1e-6);
    EXPECT_NEAR(figure(r, "cycle_time.crank"), period / n, 1e-6);
    EXPECT_NEAR(figure(r, "mean_speed.crank"), turn * n / period, 1e-6);
    EXPECT_NEAR(figure(r, "flywheel_energy.flywheel"), 10 * (n - 1) * turn, 1e-4);
  }
}

// δ = 0.04 % of each turn, and the mid speeds differ by less than 0.1 %: what repeats is nevertheless three turns, of which two
// do no useful work.
TEST(RepeatingMotion, AHeavyFlywheelDoesNotHideThePeriod) {
  const Result r = run(braked_in(one_in(3), 1000, 14));
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_EQ(r.periods.cycles, 3);
  EXPECT_NEAR(figure(r, "useful_work_per_cycle"), -10 * 3 * turn, 1e-5);
}

TEST(RepeatingMotion, ThirteenTurnsAreNotSearched) {
  const Result r = run(braked_in(one_in(13), 30, 42));
  EXPECT_FALSE(r.periods.steady) << r.periods.verdict;
  EXPECT_EQ(r.periods.cycles, 1);
}

// Every pattern of braked turns has the least period that it has.
TEST(RepeatingMotion, ThePeriodOfAnyPatternIsItsLeastOne) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 24; ++trial) {
    const auto n = static_cast<std::size_t>(std::uniform_int_distribution(1, 8)(random));
    std::vector<bool> pattern = one_in(n);
    for (std::size_t k = 1; k < n; ++k) pattern[k] = random() % 2 != 0;
    std::size_t least = 1;
    const auto repeats = [&](std::size_t m) {
      for (std::size_t k = 0; k < n; ++k)
        if (pattern[k] != pattern[(k + m) % n]) return false;
      return true;
    };
    while (!repeats(least)) ++least;
    const Result r = run(braked_in(pattern, trial % 2 ? 2000 : 40, 3.0 * static_cast<double>(n) + 3), false);
    ASSERT_TRUE(r.periods.steady) << trial << " " << r.periods.verdict;
    EXPECT_EQ(r.periods.cycles, static_cast<int>(least)) << trial << " of " << n << ": " << r.periods.verdict;
  }
}

// A slow transient is no period of several turns.
TEST(RepeatingMotion, ARunUpIsNoPeriod) {
  const Result r = run(R"(
line = ["motor", "flywheel", "crank"]
motor = { kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "20 rad/s", inertia = "1 kg*m2" }
flywheel = { kind = "flywheel", inertia = "200 kg*m2" }
run = { start = { speed = "15 rad/s" }, until = "40 s" }
)" + std::string(light_crank),
                       false);
  EXPECT_FALSE(r.periods.steady) << r.periods.verdict;
  EXPECT_EQ(r.periods.cycles, 1);
}

// Over its steady cycle, by `steady`, and in a run.
TEST(RepeatingMotion, SteadyAndRunAgree) {
  const std::string press = R"(
line = ["motor", "flywheel", "press"]
motor = { kind = "dc shunt motor", stall_torque = "400 N*m", no_load_speed = "20 rad/s", inertia = "0.2 kg*m2" }
flywheel = { kind = "flywheel", inertia = "8 kg*m2" }
sequence = { repeat = true, steps = [{ angle = "30 deg", of = "press", set = "press", to = 1 }, { angle = "30 deg", of = "press", set = "press", to = 0 }, { angle = "30 deg", of = "press", set = "press", to = 0 }] }
run = { start = { speed = "19 rad/s" }, until = "20 s", accuracy = 1e-8 }
[press]
kind = "slider-crank"
radius = "0.1 m"
rod = "0.4 m"
slider_mass = "5 kg"
load = { kind = "table", force = { over = "angle", unit = ["deg", "N"], period = "360 deg", points = [[0, 0], [300, 0], [310, 3000], [340, 3000], [350, 0], [360, 0]] } }
)";
  const Scene scene = test::scene_from(press);
  const Result r = run(scene);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_EQ(r.periods.cycles, 3);
  const SteadyStudy study = steady(scene, {scene.effects}, {.start_search = false});
  ASSERT_TRUE(study.cycles.at(0).found) << study.cycles.at(0).why;
  for (const char* name :
       {"period", "delta.press", "mid_speed.press", "mean_speed.press", "cycle_time.press", "driving_work_per_cycle",
        "useful_work_per_cycle", "flywheel_energy.flywheel", "cycle_motor_power.motor"}) {
    const Figure* cycle = study.cycles[0].find(name);
    ASSERT_TRUE(cycle) << name;
    EXPECT_NEAR(figure(r, name), cycle->value, 1e-6 * std::abs(cycle->value)) << name;
  }
}

// A figure of the steady cycle, and the plots over the angle, are of the whole period.
TEST(RepeatingMotion, AskedFiguresAndPlotsAreOfTheWholePeriod) {
  const Scene scene =
      test::scene_from(braked_in(one_in(3), 30, 13,
                                 "figure = [{ functional = \"mean\", channel = \"speed.crank\", window = \"cycle\" }, "
                                 "{ functional = \"min\", channel = \"speed.crank\", window = \"cycle\" }]"));
  SimulateOptions options;
  options.traces = true;
  const Result r = simulate(scene, scene.effects, "test", options);
  const double low = std::sqrt(400 - 2 * 20 * turn / 30);
  int asked = 0;
  for (const AskedFigure& f : asked_figures(*r.model)) {
    const double found = figure(r, f.figure.name);
    EXPECT_NEAR(found, f.functional == Functional::mean ? figure(r, "mean_speed.crank") : low, 1e-6) << f.figure.name;
    ++asked;
  }
  EXPECT_EQ(asked, 2);
  const CycleTraces& last = r.traces->last_cycles.back();
  EXPECT_NEAR(last.end - last.begin, figure(r, "period"), 1e-6);
  for (const Trace& t : last.traces) {
    EXPECT_TRUE(std::is_sorted(t.x.begin(), t.x.end()));
    EXPECT_NEAR(t.x.front(), 0, 1e-9);
    EXPECT_NEAR(t.x.back(), 3 * turn, 1e-9);
  }
}

// What a step near the end begins is too short to be judged: figures and plots are of the period before it.
TEST(RepeatingMotion, PlotsAreOfThePeriodThatTheFiguresAreOf) {
  const Scene scene = test::scene_from(R"(
line = ["motor", "crank", "load"]
motor = { kind = "dc shunt motor", stall_torque = "60 N*m", no_load_speed = "40 rad/s", inertia = "0.2 kg*m2" }
load = { kind = "load", inertia = "0.1 kg*m2", table = { over = "time", unit = ["s", "N*m"], points = [[0, 10], [4.7, 10], [4.7, 10.2], [9, 10.2]] } }
crank = { kind = "slider-crank", radius = "0.1 m", rod = "0.4 m", slider_mass = "3 kg" }
run = { until = "5.1 s" }
)");
  SimulateOptions options;
  options.traces = true;
  const Result r = simulate(scene, scene.effects, "test", options);
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  const Figure* delta = r.find("delta.crank");
  ASSERT_TRUE(delta && delta->at);
  EXPECT_LT(*delta->at, 4.7);
  EXPECT_NEAR(r.traces->last_cycles.back().end, *delta->at, 1e-4);
}

// 100 N·m (1 − ω/100) drive 2 kg·m²; 30 N·m brake for 0.6 s of each 2 s. Steady: between 70 + a and 100 − b, τ = 2 s:
//     70 + (h − 70) e^(−0.3) = l,   100 − (100 − l) e^(−0.7) = h
std::string braked_by_the_clock(const std::string& sequence, const std::string& more, double until = 40) {
  return fmt::format(R"(
line = ["motor", "rotor"{}]
motor = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }}
rotor = {{ kind = "flywheel", inertia = "1 kg*m2" }}
{}
run = {{ until = "{} s", accuracy = 1e-8 }}
{}
)",
                     more.empty() ? "" : ", \"crank\"", sequence, until, more);
}
void expect_clocked(const Result& r, const std::string& link) {
  const double e = std::exp(-0.3), g = std::exp(-0.7);
  const double high = (100 * (1 - g) + 70 * (1 - e) * g) / (1 - e * g), low = 70 + (high - 70) * e;
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_EQ(r.periods.time * r.periods.cycles, 2);
  EXPECT_NE(r.periods.verdict.find("repeats every 2 s"), std::string::npos) << r.periods.verdict;
  EXPECT_NEAR(figure(r, "delta." + link), 2 * (high - low) / (high + low), 1e-6);
  EXPECT_NEAR(figure(r, "period"), 2, 1e-12);
  // ∫ M dt = 0 over the period: 100 − ω̄ = 30 · 0.3
  EXPECT_NEAR(figure(r, "mean_speed." + link), 91, 1e-5);
  EXPECT_NEAR(figure(r, "motor_mean_power.motor"), figure(r, "cycle_motor_power.motor"),
              0.2 * figure(r, "cycle_motor_power.motor"));
}
TEST(RepeatingMotion, ByTheClockIsSteadyWithoutACycle) {
  const std::string load = "load = { kind = \"load\", on = \"rotor\", torque = \"30 N*m\", acts = \"always\" }\n";
  expect_clocked(
      run(braked_by_the_clock(load + "sequence = { every = \"2 s\", steps = [{ at = \"0 s\", set = \"load\", to = "
                                     "1 }, { after = \"0.6 s\", set = \"load\", to = 0 }] }",
                              "")),
      "motor");
}
TEST(RepeatingMotion, ByTheClockIsSteadyWhereNoTurnIs) {
  const std::string load = "load = { kind = \"load\", on = \"rotor\", torque = \"30 N*m\", acts = \"always\" }\n";
  expect_clocked(
      run(braked_by_the_clock(load + "sequence = { every = \"2 s\", steps = [{ at = \"0 s\", set = \"load\", to = "
                                     "1 }, { after = \"0.6 s\", set = \"load\", to = 0 }] }",
                              light_crank)),
      "crank");
}
TEST(RepeatingMotion, OfALawOverTimeIsSteady) {
  expect_clocked(run(braked_by_the_clock(
                     "load = { kind = \"load\", on = \"rotor\", acts = \"always\", table = { over = \"time\", unit = "
                     "[\"s\", \"N*m\"], period = \"2 s\", points = [[0, 30], [0.6, 30], [0.6, 0], [2, 0], [2, "
                     "30]] } }",
                     "")),
                 "motor");
}

// --- a step of the load is the end of one motion and the begin of another ---

// 10 N·m, from 20 s on 30: ω = 90, then 70 + 20 e^(−(t − 20)/2). Not long after the step what is left is that.
TEST(Periods, AStepOfTheLoadBeginsAnotherMotion) {
  const auto stepped = [](double until) {
    return run(fmt::format(R"(
line = ["motor", "rotor"]
motor = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }}
rotor = {{ kind = "flywheel", inertia = "1 kg*m2" }}
load = {{ kind = "load", on = "rotor", table = {{ over = "time", unit = ["s", "N*m"], points = [[0, 10], [20, 10], [20, 30], [60, 30]] }} }}
run = {{ until = "{} s", accuracy = 1e-8 }}
)",
                           until));
  };
  const Result soon = stepped(21);
  EXPECT_FALSE(soon.periods.steady);
  ASSERT_TRUE(soon.periods.remaining) << soon.periods.verdict;
  EXPECT_NEAR(*soon.periods.remaining, 20 * std::exp(-0.5), 0.1 * 20 * std::exp(-0.5)) << soon.periods.verdict;
  const Result late = stepped(34);
  EXPECT_TRUE(late.periods.steady) << late.periods.verdict;
  const double left = 20 * std::exp(-7.0);
  EXPECT_NEAR(*late.periods.remaining, left, 0.01 * left) << late.periods.verdict;
}

// --- the start of a drive ---

std::string started(const std::string& starting, double ramp, double until, const std::string& more = "") {
  return fmt::format(R"(
line = ["motor", "rotor", "crank"]
[motor]
kind = "induction motor"
rated_power = "15 kW"
rated_speed = "1460 rpm"
synchronous_speed = "1500 rpm"
breakdown_ratio = 3.0
inertia = "0.09 kg*m2"
starting = "{}"
ramp = "{} s"
{}
[rotor]
kind = "flywheel"
inertia = "0.3 kg*m2"
[load]
kind = "load"
on = "rotor"
torque = "10 N*m"
[run]
until = "{} s"
)",
                     starting, ramp, more, until) +
         light_crank;
}
// At full speed long before the voltage is: the run-up lasts as long as the ramp.
TEST(RunUp, EndsNotBeforeTheRampOfASoftStart) {
  const Result r = run(started("soft start", 5, 9, "initial_voltage = 0.5"));
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(figure(r, "run_up_time"), 5, 1e-12);
  // Both parts are the whole.
  EXPECT_NEAR(figure(r, "work_of_run_up.driving") + figure(r, "work_of_steady_motion.driving"),
              figure(r, "work.driving"), 1e-6 * figure(r, "work.driving"));
  EXPECT_NEAR(figure(r, "work_of_run_up.driving") + figure(r, "work_of_run_up.useful"),
              figure(r, "work_of_run_up.energy"), 1e-4 * figure(r, "work.driving"));
}
TEST(RunUp, EndsNotBeforeTheRampOfAConverter) {
  const double time = figure(run(started("frequency converter", 5, 9)), "run_up_time");
  EXPECT_GE(time, 5);
  EXPECT_LT(time, 5.05);
}
// 2 kg·m² behind a motor of 100 N·m at 100 rad/s, its voltage raised from 1 s to 9 s: ω lags it by τ = 2 s.
TEST(RunUp, EndsNotBeforeTheRampOfACommand) {
  const Result r = run(R"(
line = ["motor", "rotor"]
motor = { kind = "dc shunt motor", stall_torque = "100000 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }
rotor = { kind = "flywheel", inertia = "1 kg*m2" }
sequence = { steps = [{ at = "0 s", set = "motor", to = 0.995 }, { at = "1 s", set = "motor", to = 1, over = "8 s" }] }
run = { until = "14 s" }
)");
  ASSERT_TRUE(r.periods.steady) << r.periods.verdict;
  EXPECT_NEAR(figure(r, "run_up_time"), 9, 1e-12);
}
TEST(RunUp, GoesOnWhileTheDriveIsBeingStarted) {
  const Result r = run(started("soft start", 20, 9, "initial_voltage = 0.5"));
  EXPECT_FALSE(r.periods.steady);
  EXPECT_EQ(r.periods.verdict, "what drives is still being started, until 20 s");
}

// --- the torque that a clutch holds ---

// 100 N·m at standstill on two like inertias: the clutch transmits half, and holds 80.
TEST(Ratings, AClutchThatHoldsIsHeldAgainstItsTorque) {
  const auto held = [](const char* torque) {
    const Result r = run(fmt::format(R"(
line = ["motor", "clutch", "rotor"]
motor = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }}
clutch = {{ kind = "clutch", torque = "{}" }}
rotor = {{ kind = "flywheel", inertia = "1 kg*m2" }}
run = {{ until = "3 s" }}
)",
                                     torque));
    for (const Verdict& v : judge_ratings(r))
      if (std::string(v.requirement).starts_with("holding torque")) return v;
    ADD_FAILURE() << "no verdict";
    return Verdict{};
  };
  const Verdict holds = held("80 N*m");
  EXPECT_EQ(holds.state(), Compliance::holds);
  EXPECT_NEAR(holds.value, 50, 1e-5);
  EXPECT_EQ(holds.limit, 80);
}

// Slipping all the time, or idle: it holds nothing, and that is said.
TEST(Ratings, AClutchThatHoldsNothingIsNotAssessed) {
  for (const char* sequence :
       {"{ at = \"0 s\", set = \"clutch\", to = 0 }", "{ at = \"0 s\", set = \"clutch\", to = 0.2 }"}) {
    const Result r = run(fmt::format(R"(
line = ["motor", "clutch", "rotor"]
motor = {{ kind = "dc shunt motor", stall_torque = "100 N*m", no_load_speed = "100 rad/s", inertia = "1 kg*m2" }}
clutch = {{ kind = "clutch", torque = "80 N*m", allowable_heat = "1 MJ" }}
rotor = {{ kind = "flywheel", inertia = "50 kg*m2" }}
sequence = {{ steps = [{}] }}
run = {{ until = "1 s" }}
)",
                                     sequence));
    const std::vector<Verdict> verdicts = judge_ratings(r);
    const auto held = std::find_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) {
      return std::string(v.requirement).starts_with("holding torque");
    });
    ASSERT_NE(held, verdicts.end());
    EXPECT_EQ(held->state(), Compliance::not_assessed);
    EXPECT_EQ(held->note, "fully closed it holds no torque in this run");
  }
}

// --- events of one kind ---

// All of them are in summary.json; on the page one row says how many there are of a kind.
TEST(Events, OfOneKindAreOneRowOnThePage) {
  const Scene scene = test::scene_file("scenes/compressor.toml");
  const Result r = run(scene, false);
  std::set<std::tuple<std::string, std::string, std::string>> kinds;
  for (const Event& e : r.events) kinds.insert({e.component, e.from, e.what});
  ASSERT_GT(r.events.size(), 5 * kinds.size());
  Findings f;
  show_background(f, {&r});
  std::size_t rows = 0;
  for (const Statement& statement : f.statements)
    if (const Rows* table = std::get_if<Rows>(&statement.what); table && table->title.starts_with("Events"))
      rows = table->count;
  EXPECT_EQ(rows, kinds.size());
}

}  // namespace
}  // namespace kurbel::repeating_motion_test
