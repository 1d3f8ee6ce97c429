// state_test.cpp — the state is a value: kept, written, read and handed on, it goes on to the same bits; and whatever
// was evaluated by the equations in between changes nothing.
#include "engine/equations/state.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "engine/run/checkpoint.h"
#include "engine/run/recorders.h"
#include "engine/run/speed_history.h"
#include "tests/coverage/variant.h"
#include "tests/hard/random_machine.h"
#include "tests/support/scenes.h"

namespace kurbel::state_test {
namespace {

using test::scene_from;

RunOptions options_until(double until) {
  RunOptions options;
  options.tolerance = 1e-7;
  options.until = until;
  options.budget = 20;
  options.to_go_on = true;
  return options;
}

RunOutcome from(Equations& equations, const Checkpoint& checkpoint, double until) {
  RunOptions options = options_until(until);
  options.checkpoint = &checkpoint;
  return integrate(equations, options, {});
}

// Stopped at a part of the time and gone on from there: by the equations that stopped, and by others from the text.
void expect_the_same_bits(const Scene& scene, double part, const std::string& what) {
  SCOPED_TRACE(what);
  const auto model = compile(scene, scene.effects);
  const double until = scene.run.until, moment = part * until;
  Equations here(model, true), elsewhere(model, true);
  const RunOutcome first = integrate(here, options_until(moment), {});
  if (!first.complete) return;  // a machine that fails says so in other tests
  const Checkpoint read = checkpoint_from(text_of(first.checkpoint, here), elsewhere);
  EXPECT_TRUE(read == first.checkpoint);
  const RunOutcome a = from(here, first.checkpoint, until), b = from(elsewhere, read, until);
  EXPECT_EQ(a.complete, b.complete) << a.diagnosis << b.diagnosis;
  EXPECT_TRUE(a.checkpoint == b.checkpoint);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.statistics.stepper.steps, b.statistics.stepper.steps);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t k = 0; k < a.events.size(); ++k) {
    EXPECT_EQ(a.events[k].t, b.events[k].t);
    EXPECT_EQ(a.events[k].what, b.events[k].what);
  }
}

TEST(State, OfEveryExampleSceneGoesOnFromTextToTheSameBits) {
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> part(0.02, 0.98);
  for (const std::string& name : coverage::scene_names()) {
    Scene scene = test::scene_file("scenes/" + name + ".toml");
    scene.run.until *= 0.3;
    expect_the_same_bits(scene, part(dice), name);
  }
}

// In the pause of a starter, which its mode alone remembers, and after a second start.
TEST(State, OfAStarterGoesOnFromItsPauseAndFromASecondStart) {
  Scene fan = test::scene_file("scenes/fan_star_delta.toml");
  expect_the_same_bits(fan, 11.7 / 20, "in its pause, from 11.686 s to 11.746 s");
  fan.sequence.steps = {{.when = SequenceStep::When::at, .value = 5, .set = {"motor"}, .to = 0},
                        {.when = SequenceStep::When::at, .value = 6, .set = {"motor"}, .to = 1}};
  expect_the_same_bits(fan, 0.4, "in its second start");
}

// KURBEL_STATES=1000: as many as one likes.
int states_asked() {
  const char* text = std::getenv("KURBEL_STATES");
  return text ? std::atoi(text) : 40;
}

TEST(State, OfRandomMachinesGoesOnFromTextToTheSameBits) {
  for (int seed = 1; seed <= states_asked(); ++seed) {
    std::mt19937 dice(static_cast<unsigned>(seed));
    const std::string text = test::text_of(test::some_machine(static_cast<unsigned>(seed), seed % 4 == 0));
    expect_the_same_bits(scene_from(text), std::uniform_real_distribution<double>(0.02, 0.98)(dice), text);
    if (::testing::Test::HasFailure()) return;
  }
}

// Rates, guards and derivatives of one state before and after others were asked about: contacts, losses, joint friction
// and whatever else iterates begins at a function of the state.
void expect_no_memory(const Scene& scene, const std::string& what) {
  SCOPED_TRACE(what);
  const auto model = compile(scene, scene.effects);
  Equations equations(model, true);
  const RunOutcome ran = integrate(equations, options_until(0.4 * scene.run.until), {});
  if (!ran.complete) return;
  const std::size_t n = equations.size();
  struct Answers {
    std::vector<double> rates, guards, slopes;
    bool operator==(const Answers&) const = default;
  };
  const auto ask = [&](std::span<const double> y) {
    Answers a{std::vector<double>(n), std::vector<double>(equations.guard_count()),
              std::vector<double>(equations.jacobian_pattern().row.size())};
    equations.flow(ran.t, y, a.rates);
    equations.guards(ran.t, y, a.guards);
    equations.jacobian(ran.t, y, a.slopes);
    return a;
  };
  std::mt19937 dice(7);
  std::uniform_real_distribution<double> shift(-1e-3, 1e-3);
  const Modes modes = equations.modes();
  std::vector<double> reversed(n);
  const Answers first = ask(ran.state);
  for (int round = 0; round < 3; ++round) {
    std::vector<double> other = ran.state;
    for (double& v : other) v += shift(dice) * std::max(1.0, std::abs(v));
    ask(other);
    equations.snapshot(ran.t, other);
    // Alone and in another order.
    equations.jacobian(ran.t, ran.state, std::span<double>(reversed = std::vector<double>(first.slopes.size())));
    const Answers again = ask(ran.state);
    for (std::size_t i = 0; i < n; ++i)
      if (again.rates[i] != first.rates[i] && !(std::isnan(again.rates[i]) && std::isnan(first.rates[i])))
        ADD_FAILURE() << equations.state_name(i) << ": " << first.rates[i] << " and " << again.rates[i];
    EXPECT_EQ(again.guards, first.guards);
    EXPECT_EQ(again.slopes, first.slopes);
    EXPECT_TRUE(equations.modes() == modes);
  }
  // Another machine's worker, bound to these modes, gives the same.
  Equations bound(model, true);
  bound.bind(modes);
  std::vector<double> rates(n);
  bound.flow(ran.t, ran.state, rates);
  EXPECT_EQ(rates, first.rates);
}

TEST(State, AnswersDoNotDependOnWhatWasAskedBefore) {
  for (const std::string& name : coverage::scene_names())
    expect_no_memory(test::scene_file("scenes/" + name + ".toml"), name);
  for (const char* effects : {"joint_friction", "all"}) {
    Scene press = test::scene_file("scenes/crank_press.toml");
    press.effects = parse_effects(effects, press);
    expect_no_memory(press, effects);
  }
}

TEST(State, TwoThreadsGoOnFromOneToTheSameBits) {
  for (const char* name : {"crank_press", "stick_slip", "planetary_brake", "worn_crank_pin"}) {
    Scene scene = test::scene_file(std::string("scenes/") + name + ".toml");
    const auto model = compile(scene, scene.effects);
    Equations equations(model, true);
    const RunOutcome first = integrate(equations, options_until(0.2 * scene.run.until), {});
    ASSERT_TRUE(first.complete) << first.diagnosis;
    RunOutcome ends[2];
    std::vector<std::thread> threads;
    for (RunOutcome& end : ends)
      threads.emplace_back([&] {
        Equations own(model, true);
        end = from(own, first.checkpoint, 0.4 * scene.run.until);
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_TRUE(ends[0].checkpoint == ends[1].checkpoint) << name;
    EXPECT_EQ(ends[0].state, ends[1].state) << name;
  }
}

// What a run watched by all recorders leaves behind.
struct Watched {
  TrajectoryRecorder trajectory;
  ExtremeRecorder extremes;
  CycleRecorder cycles, by_time;
  SpeedRecorder speed;
  EnergyAudit energy;
  explicit Watched(const Model& model, double until)
      : trajectory(channels_of(model, {}), until, 50),
        extremes(extremes_of(model)),
        by_time(until / 7.3),
        speed(until),
        energy(until, 10) {}
  std::vector<Observer*> all() { return {&trajectory, &extremes, &cycles, &by_time, &speed, &energy}; }
  std::vector<std::vector<double>> memory() {
    std::vector<std::vector<double>> list;
    for (Observer* observer : all()) {
      Tape tape;
      observer->remember(tape);
      list.push_back(tape.take());
    }
    return list;
  }
};

RunOutcome watch(Equations& equations, Watched& by, double until, const Checkpoint* from = nullptr) {
  RunOptions options = options_until(until);
  options.tolerance = 1e-10;
  options.checkpoint = from;
  return integrate(equations, options, by.all());
}

// Two legs, the second by other recorders that read what the first ones knew: to the last bit what the first ones make
// of both, and within the accuracy what they see of the run in one piece.
TEST(State, RecordersGoOnWithTheRun) {
  for (const char* name : {"crank_press", "four_cylinder_engine", "worm_hoist", "stick_slip", "dc_hoist"}) {
    SCOPED_TRACE(name);
    const Scene scene = test::scene_file(std::string("scenes/") + name + ".toml");
    const auto model = compile(scene, scene.effects);
    const double until = 0.5 * scene.run.until;
    Equations here(model, true), elsewhere(model, true);
    Watched both(*model, until), second(*model, until), whole(*model, until);
    const RunOutcome first = watch(here, both, 0.4 * until);
    ASSERT_TRUE(first.complete) << first.diagnosis;
    const Checkpoint read = checkpoint_from(text_of(first.checkpoint, here), elsewhere);
    EXPECT_EQ(read.observers, both.memory());
    const RunOutcome end = watch(elsewhere, second, until, &read);
    ASSERT_TRUE(end.complete) << end.diagnosis;
    watch(here, both, until, &first.checkpoint);
    EXPECT_EQ(second.memory(), both.memory());

    watch(here, whole, until);
    EXPECT_EQ(second.trajectory.time(), whole.trajectory.time());
    for (const auto recorder : {&Watched::cycles, &Watched::by_time}) {
      const std::vector<CycleRecord>&these = (second.*recorder).cycles(), &those = (whole.*recorder).cycles();
      ASSERT_EQ(these.size(), those.size());
      for (std::size_t k = 0; k < those.size(); ++k) {
        const CycleRecord &a = these[k], &b = those[k];
        EXPECT_NEAR(a.end - a.begin, b.end - b.begin, 1e-6 * (b.end - b.begin)) << k;
        EXPECT_NEAR(a.omega_max, b.omega_max, 1e-6 * std::max(std::abs(b.omega_max), 0.01 * model->speed_scale)) << k;
        EXPECT_NEAR(a.turned, b.turned, 1e-6 * std::max(1.0, std::abs(b.turned))) << k;
      }
    }
    EXPECT_EQ(whole.by_time.cycles().size(), 7u);
    for (std::size_t i = 0; i < whole.extremes.found().size(); ++i) {
      const double a = second.extremes.found()[i].value, b = whole.extremes.found()[i].value;
      EXPECT_NEAR(a, b, 1e-6 * std::max(whole.extremes.wanted()[i].scale, std::abs(b)))
          << whole.extremes.wanted()[i].name.text;
    }
    EXPECT_LT(second.energy.relative(), 1e-7);
    EXPECT_EQ(second.energy.checked, whole.energy.checked);
  }
}

// A press at 60 rpm that is gone on with at a multiple of its angle: its next cycle begins there and lasts a second,
// and what was done before is not counted into it.
TEST(State, ACycleThatBeginsWhereTheRunGoesOnBeginsThere) {
  const Scene scene = scene_from(R"(line = ["drive", "press"]
drive = { kind = "prescribed speed", speed = "60 rpm" }
press = { kind = "slider-crank", radius = "50 mm", rod = "300 mm", crank_inertia = "1 kg*m2", slider_mass = "40 kg" }
run = { until = "3 s" })");
  const auto model = compile(scene, scene.effects);
  Equations equations(model, true);
  const RunOutcome first = integrate(equations, options_until(1), {});
  ASSERT_TRUE(first.complete) << first.diagnosis;
  CycleRecorder cycles;
  RunOptions options = options_until(2.5);
  options.checkpoint = &first.checkpoint;
  integrate(equations, options, {&cycles});
  ASSERT_EQ(cycles.cycles().size(), 1u);
  EXPECT_NEAR(cycles.cycles()[0].begin, 1, 1e-9);
  EXPECT_NEAR(cycles.cycles()[0].end, 2, 1e-9);
}

TEST(State, AnotherMachinesStateIsRefusedWithWhatDiffers) {
  const Scene press = test::scene_file("scenes/crank_press.toml"), hoist = test::scene_file("scenes/worm_hoist.toml");
  Equations a(compile(press, press.effects), true), b(compile(hoist, hoist.effects), true);
  const RunOutcome ran = integrate(a, options_until(0.01), {});
  const std::string text = text_of(ran.checkpoint, a);
  try {
    checkpoint_from(text, b);
    FAIL();
  } catch (const UnfitCheckpoint& unfit) {
    EXPECT_NE(std::string(unfit.what()).find("is of another machine: its state "), std::string::npos) << unfit.what();
  }
  for (const char* broken : {"", "{}", "[1, 2", "null", "{\"kind\": \"kurbel checkpoint 2\"}"}) try {
      checkpoint_from(broken, a);
      ADD_FAILURE() << broken;
    } catch (const UnfitCheckpoint& unfit) {
      EXPECT_NE(std::string(unfit.what()).find("--save-state"), std::string::npos) << unfit.what();
    }
  std::string wrong = text;
  wrong.replace(wrong.find("\"direction\": [") + 14, 0, "\n 7,");
  EXPECT_THROW(checkpoint_from(wrong, a), UnfitCheckpoint);
}

}  // namespace
}  // namespace kurbel::state_test
