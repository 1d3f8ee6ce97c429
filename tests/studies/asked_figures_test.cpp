// asked_figures_test.cpp — figures that a scene requests by [[figure]], against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "studies/dictionary/dictionary.h"
#include "studies/run/simulate.h"
#include "studies/steady/steady.h"
#include "tests/support/scenes.h"

namespace kurbel::asked_figures_test {
namespace {

constexpr double pi = std::numbers::pi;

// The value, within the measured error, which is small itself.
void expect(const std::vector<Figure>& figures, const std::string& name, double exact, double small = 1e-6) {
  const Figure* f = find(figures, name);
  ASSERT_TRUE(f) << name;
  ASSERT_TRUE(f->error) << name;
  EXPECT_LE(std::abs(f->value - exact), *f->error + 1e-12 * std::abs(exact)) << name << " " << f->value;
  EXPECT_LE(*f->error, small) << name;
}

// M = 2 + 10 sin(2π 2 Hz t) over six periods: above 7 where sin > ½, a third of each.
TEST(AskedFigures, OfASineOverARunAreThoseOfTheClosedForm) {
  const Result r = test::run(R"(
    line = ["drive", "wheel"]
    drive = { kind = "torque source", torque = "2 N*m", amplitude = "10 N*m", frequency = "2 Hz" }
    wheel = { kind = "flywheel", inertia = "1.5 kg*m2" }
    figure = [
      { functional = "time above", channel = "torque.drive", level = "0.007 kN*m" },
      { functional = "time above", channel = "torque.drive", level = "12.5 N*m" },
      { functional = "time above", channel = "torque.drive", level = "-9 N*m" },
      { functional = "max", channel = "torque.drive" }, { functional = "min", channel = "torque.drive" },
      { channel = "torque.drive" },
      { functional = "mean", channel = "torque.drive" }, { functional = "rms", channel = "torque.drive" },
    ]
    run = { until = "3 s" }
  )");
  expect(r.figures, "time_above_torque.0.007kN*m.drive", 1);
  expect(r.figures, "time_above_torque.12.5N*m.drive", 0);
  expect(r.figures, "time_above_torque.-9N*m.drive", 3);
  ASSERT_TRUE(r.find("time_above_torque.0.007kN*m.drive"));
  EXPECT_EQ(r.find("time_above_torque.0.007kN*m.drive")->unit, "s");
  expect(r.figures, "max_torque.drive", 12, 1e-5);
  expect(r.figures, "min_torque.drive", -8, 1e-5);
  expect(r.figures, "peak_torque.drive", 12, 1e-5);
  expect(r.figures, "run_mean_torque.drive", 2, 1e-5);
  expect(r.figures, "rms_torque.drive", std::sqrt(4 + 50), 1e-5);
}

// θ = θ₀ cos ω t of two wheels on a spring. Above ⅔ θ₀: ω t within α of a multiple of 2π, α = arccos ⅔. The levels'
// crossings lie on the solution, which the equations know only as a state: rows and steps are far apart.
TEST(AskedFigures, TimeAboveALevelIsLocatedOnTheSolution) {
  const double until = 1.37, omega = std::sqrt(800 * (1 / 0.5 + 1 / 2.0)), alpha = std::acos(2.0 / 3);
  const Result r = test::run(R"(
    line = ["a", "spring", "b"]
    a = { kind = "inertia", inertia = "0.5 kg*m2" }
    spring = { kind = "coupling", stiffness = "800 N*m/rad" }
    b = { kind = "inertia", inertia = "2 kg*m2" }
    effects = { elasticity = true }
    figure = [{ functional = "time above", channel = "twist.spring", level = "0.2 rad" },
              { functional = "rms", channel = "twist.spring" }]
    run = { until = "1.37 s", samples = 2, accuracy = 1e-8, start = { spring = { twist = "0.3 rad" } } }
  )");
  const double turns = std::floor(omega * until / (2 * pi)), rest = omega * until - 2 * pi * turns;
  const double above = 2 * alpha * turns + std::min(rest, alpha) + std::max(0.0, rest - (2 * pi - alpha));
  expect(r.figures, "time_above_twist.0.2rad.spring", above / omega, 1e-7);
  const double square = 0.5 * 0.09 * (1 + std::sin(2 * omega * until) / (2 * omega * until));
  expect(r.figures, "rms_twist.spring", std::sqrt(square), 1e-7);
}

// A wheel on a motor M = M_s (1 − ω/ω₀): ω = ω₀ (1 − e^(−t/T)), T = J ω₀/M_s, run-up until
// ω = 0.99 ω₀; then the motor is switched off and a brake of constant torque stops the wheel: ω falls linearly.
TEST(AskedFigures, OfThePeriodsOfARunAreThoseOfTheClosedForm) {
  const Result r = test::run(R"(
    line = ["motor", "wheel"]
    motor = { kind = "dc shunt motor", stall_torque = "20 N*m", no_load_speed = "100 rad/s", inertia = "0.02 kg*m2" }
    wheel = { kind = "flywheel", inertia = "0.08 kg*m2" }
    brake = { kind = "brake", on = "wheel", torque = "5 N*m" }
    sequence = { steps = [{ at = "0 s", set = "brake", to = 0 }, { at = "10 s", set = "motor", to = 0 },
                          { at = "10 s", set = "brake", to = 1 }] }
    figure = [
      { functional = "rms", channel = "torque.motor", window = "run-up" },
      { functional = "mean", channel = "speed.wheel", window = "run-up" },
      { functional = "max", channel = "torque.motor", window = "steady motion" },
      { functional = "time above", channel = "speed.wheel", level = "50 rad/s", window = "run-up" },
      { functional = "time above", channel = "speed.wheel", level = "50 rad/s", window = "run-down" },
      { functional = "mean", channel = "speed.wheel", window = "run-down" },
      { functional = "rms", channel = "torque.brake", window = "run-down" },
    ]
    run = { until = "13 s" }
  )");
  ASSERT_TRUE(r.periods.run_up_end && r.periods.run_down_begin && r.periods.standstill) << r.periods.verdict;
  const double T = 0.1 * 100 / 20.0, t1 = *r.periods.run_up_end;
  EXPECT_NEAR(t1, T * std::log(100), 1e-4);  // within 1 % of the steady speed
  expect(r.figures, "run_up_rms_torque.motor", 20 * std::sqrt(T / 2 * (1 - std::exp(-2 * t1 / T)) / t1), 1e-3);
  expect(r.figures, "run_up_mean_speed.wheel", 100 * (1 - T / t1 * (1 - std::exp(-t1 / T))), 1e-3);
  expect(r.figures, "steady_motion_max_torque.motor", 20 * std::exp(-t1 / T), 1e-4);
  expect(r.figures, "run_up_time_above_speed.50rad/s.wheel", t1 - T * std::log(2), 1e-4);
  const double at_10 = 100 * (1 - std::exp(-10 / T));
  expect(r.figures, "run_down_time_above_speed.50rad/s.wheel", (at_10 - 50) / 50, 1e-4);
  expect(r.figures, "run_down_rms_torque.brake", 5, 1e-4);
  expect(r.figures, "run_down_mean_speed.wheel", at_10 / 2, 1e-4);
}

// The rigid machine has no twist, nothing of it goes through cycles, and the sequence waits for ever: no faults of the scene.
TEST(AskedFigures, ThatARunDoesNotGiveAreNoted) {
  const Result r = test::run(R"(
    line = ["a", "spring", "b"]
    a = { kind = "inertia", inertia = "0.5 kg*m2" }
    spring = { kind = "coupling", stiffness = "800 N*m/rad" }
    b = { kind = "inertia", inertia = "2 kg*m2" }
    brake = { kind = "brake", on = "b", torque = "40 N*m" }
    sequence = { steps = [{ at = "9 s", set = "brake", to = 0 }] }
    figure = [{ functional = "rms", channel = "twist.spring" }, { channel = "speed.a", window = "cycle" },
              { channel = "speed.a", step = 1 }, { channel = "speed.b" }]
    run = { until = "0.1 s" }
  )");
  std::vector<std::string> notes;
  std::ranges::copy_if(r.notes, std::back_inserter(notes),
                       [](const std::string& n) { return n.starts_with("[[figure]]"); });
  EXPECT_EQ(notes, (std::vector<std::string>{
                       "[[figure]]: under these effects the machine has no channel \"twist.spring\"",
                       "[[figure]]: no cycle_peak_speed.a: the run has no whole cycle",
                       "[[figure]]: no step_peak_speed.1.a: the run does not come to step 1 of the sequence"}));
  EXPECT_TRUE(r.find("peak_speed.b"));
}

// m g R = 9806.65 N·m, held by one at rest; by two in proportion to their capacities.
TEST(AskedFigures, TorqueOfWhatHoldsAMachineIsWhatItHolds) {
  const std::string drum = R"(
line = ["drum"]
drum = { kind = "slide", radius = "1 m", inclination = "90 deg", mass = "1 t", inertia = "10 kg*m2" }
run = { start = "rest", until = "1 s" }
figure = [{ functional = "rms", channel = "torque.holder" }, { functional = "rms", channel = "torque.other" }]
)";
  const std::string none = "other = { kind = \"bearing\", on = \"drum\", torque = \"0 N*m\" }\n";
  for (const char* kind : {"brake", "bearing", "load"}) {
    const Result r = test::run(
        drum + fmt::format("holder = {{ kind = \"{}\", on = \"drum\", torque = \"20 kN*m\" }}\n", kind) + none);
    const Figure* held = r.find("rms_torque.holder");
    ASSERT_TRUE(held) << kind;
    EXPECT_NEAR(held->value, 9806.65, 1e-6) << kind;
  }
  const Result two = test::run(drum + "holder = { kind = \"brake\", on = \"drum\", torque = \"20 kN*m\" }\n" +
                               "other = { kind = \"bearing\", on = \"drum\", torque = \"5 kN*m\" }\n");
  EXPECT_NEAR(two.find("rms_torque.holder")->value, 0.8 * 9806.65, 1e-6);
  EXPECT_NEAR(two.find("rms_torque.other")->value, 0.2 * 9806.65, 1e-6);
}

// A brake of −40 N·m at any speed whose command is a trapezoid: from 1 at 0.2 s to ¼ within 0.2 s, from 0.6 s to ¾ within
// 0.2 s, from 1 s to 0 within 0.1 s, up to 1.2 s.
TEST(AskedFigures, OfStepsOfASequenceAreThoseOfATrapezoid) {
  const Result r = test::run(R"(
    line = ["wheel"]
    wheel = { kind = "flywheel", inertia = "10 kg*m2" }
    brake = { kind = "brake", on = "wheel", torque = "40 N*m" }
    sequence = { steps = [{ at = "0.2 s", set = "brake", to = 0.25, over = "0.2 s" },
                          { at = "0.6 s", set = "brake", to = 0.75, over = "0.2 s" },
                          { at = "1 s", set = "brake", to = 0, over = "0.1 s" }] }
    figure = [
      { functional = "max", channel = "torque.brake", step = 1 }, { functional = "min", channel = "torque.brake", step = 1 },
      { functional = "time above", level = "-20 N*m", channel = "torque.brake", step = 1 },
      { functional = "max", channel = "torque.brake", step = 2 }, { functional = "min", channel = "torque.brake", step = 2 },
      { functional = "mean", channel = "torque.brake", step = 2 }, { functional = "rms", channel = "torque.brake", step = 2 },
      { functional = "time above", level = "-20 N*m", channel = "torque.brake", step = 2 },
      { channel = "torque.brake", step = 3 }, { functional = "mean", channel = "torque.brake", step = 3 },
      { functional = "min", channel = "speed.wheel", step = 1 },
    ]
    run = { until = "1.2 s", start = { speed = "50 rad/s" } }
  )");
  expect(r.figures, "step_min_torque.1.brake", -40, 1e-4);
  expect(r.figures, "step_max_torque.1.brake", -10, 1e-4);
  expect(r.figures, "step_time_above_torque.1.-20N*m.brake", 0.2 * (0.5 - 0.25) / (1 - 0.25) + 0.2);
  expect(r.figures, "step_min_torque.2.brake", -30, 1e-4);
  expect(r.figures, "step_max_torque.2.brake", -10, 1e-4);
  expect(r.figures, "step_mean_torque.2.brake", -25, 1e-4);
  expect(r.figures, "step_rms_torque.2.brake",
         40 * std::sqrt((0.2 * (0.0625 + 0.1875 + 0.5625) / 3 + 0.2 * 0.5625) / 0.4), 1e-4);
  expect(r.figures, "step_time_above_torque.2.-20N*m.brake", 0.1);
  expect(r.figures, "step_peak_torque.3.brake", -30, 1e-4);
  expect(r.figures, "step_mean_torque.3.brake", -30 * 0.05 / 0.2, 1e-4);
  // ∫ M dt/J up to 0.6 s: on average 40 N·m over 0.2 s, 25 N·m over 0.2 s, 10 N·m over 0.2 s.
  expect(r.figures, "step_min_speed.1.wheel", 50 - 0.2 * (40 + 25 + 10) / 10, 1e-5);
  ASSERT_TRUE(r.find("step_mean_torque.2.brake"));
  EXPECT_EQ(r.find("step_mean_torque.2.brake")->unit, "N*m");
}

// Of several repetitions the last whole one: on within 0.1 s, off within 0.1 s after 0.2 s, every 0.5 s.
TEST(AskedFigures, OfAStepOfARepeatedSequenceAreOfTheLastWholeRepetition) {
  const Result r = test::run(R"(
    line = ["wheel"]
    wheel = { kind = "flywheel", inertia = "10 kg*m2" }
    brake = { kind = "brake", on = "wheel", torque = "40 N*m" }
    sequence = { every = "0.5 s", steps = [{ at = "0 s", set = "brake", to = 1, over = "0.1 s" },
                                           { after = "0.2 s", set = "brake", to = 0, over = "0.1 s" }] }
    figure = [{ functional = "mean", channel = "torque.brake", step = 1 },
              { functional = "mean", channel = "torque.brake", step = 2 },
              { functional = "time above", level = "-10 N*m", channel = "torque.brake", step = 1 }]
    run = { until = "1.63 s", start = { speed = "50 rad/s" } }
  )");
  expect(r.figures, "step_mean_torque.1.brake", -40 * 0.15 / 0.2, 1e-4);
  expect(r.figures, "step_mean_torque.2.brake", -40 * 0.05 / 0.3, 1e-4);
  expect(r.figures, "step_time_above_torque.1.-10N*m.brake", 0.1 * 0.25);
}

const char* const cranked = R"(
    line = ["motor", "press"]
    motor = { kind = "prescribed speed", speed = "5 rad/s" }
    press = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", crank_inertia = "5 kg*m2", slider_mass = "1 kg" }
    figure = [
      { functional = "time above", channel = "position.press", level = "0.2 m", window = "cycle" },
      { functional = "max", channel = "position.press", window = "cycle" },
      { functional = "mean", channel = "position.press", window = "cycle" },
      { functional = "rms", channel = "velocity.press", window = "cycle" },
    ]
    run = { until = "4.1 s", start = { speed = "5 rad/s", angle = "40 deg" } }
  )";

// x = r cos φ + √(l² − r² sin² φ) at constant speed: above x₀ for |φ| < arccos((x₀² + r² − l²)/(2 r x₀)).
TEST(AskedFigures, OfACycleAreThoseOfTheClosedFormInRunsAndSteadyMotion) {
  const double r = 0.05, l = 0.2, x = 0.2, omega = 5;
  const double above = 2 * std::acos((x * x + r * r - l * l) / (2 * r * x)) / omega;
  double mean = 0, square = 0;  // by the midpoint rule, which converges faster than any power for a periodic function
  constexpr int n = 400;
  for (int k = 0; k < n; ++k) {
    const double phi = 2 * pi * (k + 0.5) / n, root = std::sqrt(l * l - r * r * std::sin(phi) * std::sin(phi));
    mean += (r * std::cos(phi) + root) / n;
    square += std::pow(omega * (-r * std::sin(phi) - r * r * std::sin(phi) * std::cos(phi) / root), 2) / n;
  }
  const Scene scene = test::scene_from(cranked);
  const SteadyStudy s = steady(scene, {scene.effects}, {.start_search = false});
  const Result run = simulate(scene, scene.effects, "run", {});
  ASSERT_TRUE(s.cycles.back().found) << s.cycles.back().why;
  for (const std::vector<Figure>* figures : {&run.figures, &s.cycles.back().figures}) {
    expect(*figures, "cycle_time_above_position.0.2m.press", above);
    expect(*figures, "cycle_max_position.press", r + l);
    expect(*figures, "cycle_mean_position.press", mean);
    expect(*figures, "cycle_rms_velocity.press", std::sqrt(square));
  }
}

std::vector<Figure> listed(const std::string& text) {
  const Scene scene = test::scene_from(text);
  return figure_list(*compile(scene, scene.effects));
}

std::string refused(const std::string& figure) {
  try {
    listed(R"(
      line = ["motor", "spring", "wheel"]
      motor = { kind = "torque source", torque = "2 N*m" }
      spring = { kind = "coupling", stiffness = "800 N*m/rad" }
      wheel = { kind = "flywheel", inertia = "1.5 kg*m2" }
      sequence = { steps = [{ at = "0.2 s", set = "motor", to = 0 }] }
      figure = [)" +
           figure + "]");
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

TEST(AskedFigures, AreRefusedAtTheirPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {R"({ functional = "mean", channel = "torque.moter" })",
       "7:17: [[figure]]: channel = \"torque.moter\"; the machine has none of this name — did you mean "
       "\"torque.motor\"?"},
      {R"({ functional = "time above", channel = "torque.motor", level = "3 rad/s" })", "N*m"},
      {R"({ functional = "mean", channel = "speed.spring" })", "did you mean \"speed.spring.in\"?"},
      {R"({ functional = "time above", channel = "torque.motor" })", "\"level\" is missing"},
      {R"({ functional = "mean", channel = "torque.motor", level = "3 N*m" })",
       "belongs to functional = \"time above\""},
      {R"({ functional = "mean", channel = "torque.motor", step = 2 })", "the [sequence] has 1 steps"},
      {R"({ functional = "mean", channel = "torque.motor", step = 1, window = "run" })", "keep one"},
      {R"({ functional = "median", channel = "torque.motor" })", "functional"},
      {R"({ functional = "mean" })", "channel"},
      {R"({ channel = "speed.wheel" }, { channel = "speed.wheel" })", "requested twice"},
  };
  for (const auto& [figure, text] : wrong) EXPECT_NE(refused(figure).find(text), std::string::npos) << refused(figure);
  EXPECT_EQ(refused(R"({ functional = "mean", channel = "torque.motor", step = 1 })"), "");
}

TEST(AskedFigures, AreListedAndExplained) {
  const std::vector<Figure> list = listed(cranked);
  const Figure* f = find(list, "cycle_time_above_position.0.2m.press");
  ASSERT_TRUE(f);
  EXPECT_EQ(f->unit, "s");
  ASSERT_TRUE(definition_of(f->name));
  EXPECT_EQ(definition_of(f->name)->unit, "s");
  EXPECT_EQ(said_of_channel("step_mean_torque.2.motor"), "its mean over time in one step of the operating sequence");
  EXPECT_EQ(said_of_channel("run_mean_speed.motor"), "its mean over time in a whole run");
  EXPECT_EQ(said_of_channel("peak_current.motor"), "its greatest magnitude in a whole run, with its sign");
  EXPECT_EQ(said_of_channel("cycle_peak_torque.main_coupling"), "");  // has words of its own
  EXPECT_EQ(definition_of("step_rms_torque.2.motor"), definition_of("torque"));
  EXPECT_EQ(definition_of("step_time_above_torque.2.40N*m.motor"), definition_of(f->name));
}

}  // namespace
}  // namespace kurbel::asked_figures_test
