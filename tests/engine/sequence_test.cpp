// sequence_test.cpp — the operating sequence: what is set when, ramps, reversal, repetition, the list of events.
#include <fmt/format.h>

#include <cmath>

#include "tests/published/published.h"

namespace kurbel::sequence_test {
namespace {

using test::figure;
using test::run;

// M = 20 N·m (c − ω/100), J = 2 kg·m²: τ = J ω₀/M_stall = 10 s.
std::string machine(const std::string& steps, const std::string& settings, const std::string& more = "") {
  return R"(
line = ["motor"]
[motor]
kind = "dc shunt motor"
stall_torque = "20 N*m"
no_load_speed = "100 rad/s"
inertia = "2 kg*m2"
)" + more +
         "[sequence]\nsteps = [" + steps + "]\n[run]\naccuracy = 1e-10\n" + settings;
}
std::string refusal_of(const std::string& text) {
  try {
    test::scene_from(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}
std::vector<std::string> said(const Result& r) {
  std::vector<std::string> lines;
  for (const Event& e : r.events) lines.push_back(fmt::format("{:.9g} {}: {} -> {}", e.t, e.component, e.from, e.what));
  return lines;
}

// Off the machine runs on, on it rises as 1 − e^{−t/τ}, at half the voltage towards half the speed.
TEST(Sequence, SwitchesOnOffAndToPartOfTheVoltage) {
  const Result r =
      run(machine("{ at = \"4 s\", set = \"motor\", to = 0 }, { at = \"6 s\", set = \"motor\", to = 0.5 }, "
                  "{ after = \"3 s\", set = \"motor\" }",
                  "until = \"12 s\"\nsamples = 13\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto speed = test::series(r, "speed.motor");
  const double a = 100 * (1 - std::exp(-0.4)), b = 50 + (a - 50) * std::exp(-0.3);
  EXPECT_NEAR(speed[4], a, 1e-8);
  EXPECT_EQ(speed[5], speed[6]);
  EXPECT_NEAR(speed[6], a, 1e-8);
  EXPECT_NEAR(speed[9], b, 1e-8);
  EXPECT_NEAR(speed[12], 100 + (b - 100) * std::exp(-0.3), 1e-8);
  EXPECT_EQ(said(r), (std::vector<std::string>{"4 motor: on -> is set off", "6 motor: off -> is set 0.5",
                                               "9 motor: 0.5 -> is set on"}));
}

// A ramp of the voltage from 0 to 1 within T: ω = ω₀ (t − τ (1 − e^{−t/τ}))/T.
TEST(Sequence, RampsFollowTheClosedForm) {
  const Result r =
      run(machine("{ at = \"0 s\", set = \"motor\", to = 0 }, { at = \"2 s\", set = \"motor\", to = 1, over = "
                  "\"5 s\" }",
                  "until = \"10 s\"\nsamples = 101\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto speed = test::series(r, "speed.motor");
  const auto ramp = [](double t) { return 100.0 / 5 * (t - 10 * (1 - std::exp(-t / 10))); };
  for (std::size_t row = 0; row < speed.size(); ++row) {
    const double t = r.trajectory->time()[row] - 2;
    const double expected = t <= 0 ? 0 : t <= 5 ? ramp(t) : 100 + (ramp(5) - 100) * std::exp(-(t - 5) / 10);
    EXPECT_NEAR(speed[row], expected, 1e-8) << t;
  }
  EXPECT_EQ(said(r), (std::vector<std::string>{"2 motor: off -> goes to on within 5 s"}));
}

// Dubey, example 2.2 (tests/cases/mo02_closed_forms.toml): M = 100 − 0.1 N drives, load 0.05 N, J = 10 kg·m²; reversed
// at the steady 666.667 rpm, M = −100 − 0.1 N. Time to 95 % of the new speed.
TEST(Sequence, ReversalTakesTheTimeOfDubey) {
  const double per_rpm = M_PI / 30;
  const Result r =
      run(fmt::format(R"(
line = ["motor"]
[motor]
kind = "dc shunt motor"
stall_torque = "100 N*m"
no_load_speed = "1000 rpm"
inertia = "10 kg*m2"
[load]
kind = "load"
on = "motor"
damping = "{} N*m*s/rad"
[sequence]
steps = [{{ at = "1 s", set = "motor", to = -1 }}, {{ speed_below = "{} rpm", of = "motor", set = "motor", to = 0 }}]
[run]
start = {{ speed = "{} rpm" }}
until = "40 s"
accuracy = 1e-10
)",
                      test::digits(0.05 / per_rpm), test::digits(-0.95 * 2000 / 3), test::digits(2000.0 / 3)));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_EQ(r.events[0].what, "is set -1");
  EXPECT_EQ(r.events[1].from, "-1");
  EXPECT_NEAR(r.events[1].t - 1, 25.75323687, 1e-7);
}

// Speed above and below, angle: located where the closed form has them.
TEST(Sequence, WaitsForSpeedsAndAngles) {
  const Result r =
      run(machine("{ speed_above = \"50 rad/s\", of = \"motor\", set = \"motor\", to = 0 }, { angle = \"1 "
                  "rad\", of = \"motor\", set = \"motor\", to = -1 }, { speed_below = \"20 rad/s\", of = "
                  "\"motor\", set = \"motor\", to = 0 }",
                  "until = \"20 s\"\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 3u);
  const double at = 10 * std::log(2.0), angle = 100 * (at - 10 * (1 - std::exp(-at / 10)));
  EXPECT_NEAR(r.events[0].t, at, 1e-9);
  const double turn = 2 * M_PI, next = 1 + turn * std::ceil((angle - 1) / turn);
  EXPECT_NEAR(r.events[1].t, at + (next - angle) / 50, 1e-9);
  EXPECT_NEAR(r.events[2].t - r.events[1].t, 10 * std::log(150.0 / 120), 1e-9);  // ω + 100 falls from 150 to 120
  EXPECT_NEAR(figure(r, "final_speed.motor"), 20, 1e-8);
}

// A condition that holds already is met at once.
TEST(Sequence, ConditionThatHoldsIsMetAtOnce) {
  const Result r =
      run(machine("{ speed_below = \"5 rad/s\", of = \"motor\", set = \"motor\", to = 0.5 }", "until = \"1 s\"\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_EQ(r.events[0].t, 0);
  EXPECT_NEAR(figure(r, "final_speed.motor"), 50 * (1 - std::exp(-0.1)), 1e-8);
}

// Repeated, the machine hunts between two speeds: the period is that of two exponentials.
// By the clock a cycle begins every 5 s, and at 12 a minute, however long its steps take; longer ones delay the next.
TEST(Sequence, RoundsByTheClock) {
  const std::string once =
      machine("{ set = \"motor\" }, { after = \"2 s\", set = \"motor\", to = 0.2 }", "until = \"21 s\"\n");
  for (const char* clock : {"every = \"5 s\"", "rate = \"12 1/min\"", "repeat = true\nevery = \"5 s\""}) {
    const Result r = run(test::with(once, "[sequence]\n", std::string("[sequence]\n") + clock + "\n"));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    ASSERT_EQ(r.events.size(), 8u) << clock;  // what is set at the start is none
    for (std::size_t k = 0; k < r.events.size(); ++k)
      EXPECT_NEAR(r.events[k].t, 5 * static_cast<double>((k + 1) / 2) + (k % 2 == 0 ? 2 : 0), 1e-12) << clock;
  }
  const Result late = run(test::with(once, "[sequence]\n", "[sequence]\nevery = \"1.5 s\"\n"));
  std::vector<std::string> words;
  for (const Event& e : late.events)
    if (e.component == "sequence") words.push_back(fmt::format("{:.9g} {}", e.t, e.what));
  ASSERT_EQ(words.size(), 10u);
  EXPECT_EQ(words.front(), "2 begins a repetition late: the one before took 2 s, every = 1.5 s");
  for (const auto& [keys, message] : std::vector<std::pair<std::string, std::string>>{
           {"every = \"5 s\"\nrate = \"12 1/min\"", "both \"every\" and \"rate\" given"},
           {"repeat = false\nevery = \"5 s\"", "repeat = false, but"},
           {"every = \"0 s\"", "every = 0 s; must be > 0"},
           {"every = \"5 rpm\"", "every"}})
    EXPECT_NE(refusal_of(test::with(once, "[sequence]\n", "[sequence]\n" + keys + "\n")).find(message),
              std::string::npos)
        << keys;
  EXPECT_NE(refusal_of(test::with(test::with(once, "{ set =", "{ after = \"1 s\", set ="), "[sequence]\n",
                                  "[sequence]\nevery = \"5 s\"\n"))
                .find("its first step waits for something else"),
            std::string::npos);
}

TEST(Sequence, RepeatsUntilTheEnd) {
  const std::string once = machine(
      "{ speed_above = \"60 rad/s\", of = \"motor\", set = \"motor\", to = 0.2 }, { speed_below = \"40 rad/s\", of = "
      "\"motor\", set = \"motor\", to = 1 }",
      "until = \"200 s\"\n");
  const Result r = run(once);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 2u);
  const Result again = run(test::with(once, "[sequence]\n", "[sequence]\nrepeat = true\n"));
  ASSERT_TRUE(again.complete) << again.diagnosis;
  const double period = 10 * std::log(40.0 / 20) + 10 * std::log(60.0 / 40), first = 10 * std::log(100.0 / 40);
  const auto count = static_cast<std::size_t>(1 + std::floor((200 - first) / period)) +
                     static_cast<std::size_t>(1 + std::floor((200 - first - 10 * std::log(2.0)) / period));
  ASSERT_EQ(again.events.size(), count);
  for (std::size_t k = 0; k + 2 < again.events.size(); ++k)
    EXPECT_NEAR(again.events[k + 2].t - again.events[k].t, period, 1e-8);
  EXPECT_NEAR(again.events[0].t, first, 1e-9);
}

// A ramp that is over before time has moved on is a jump.
TEST(Sequence, RampWithinNoTimeIsAJump) {
  const auto final_speed = [](const std::string& over) {
    const Result r =
        run(machine("{ at = \"1.75969 s\", set = \"motor\", to = 0.25" + over + " }", "until = \"3 s\"\n"));
    EXPECT_TRUE(r.complete) << r.diagnosis;
    return figure(r, "final_speed.motor");
  };
  const double jump = final_speed("");
  for (const char* over : {"1e-30 s", "1e-17 s", "1e-14 s"})
    EXPECT_EQ(final_speed(fmt::format(", over = \"{}\"", over)), jump) << over;
  EXPECT_NEAR(final_speed(", over = \"1e-9 s\""), jump, 1e-7);
}

// Steps that wait for nothing, again and again: the run says so.
TEST(Sequence, ThatNeverPausesIsReportedAndEndsTheRun) {
  for (const char* pause : {"1e-30 s", "1e-20 s"}) {
    const std::string steps = fmt::format(
        "{{ at = \"1 s\", set = \"motor\", to = 0.5 }}, {{ after = \"{0}\", set = \"motor\", to = 0.25 }}, "
        "{{ after = \"{0}\", set = \"motor\" }}",
        pause);
    const Result r =
        run(test::with(machine(steps, "until = \"3 s\"\n"), "[sequence]\n", "[sequence]\nrepeat = true\n"));
    EXPECT_FALSE(r.complete);
    EXPECT_NE(r.diagnosis.find("repeats without a pause at 1 s"), std::string::npos) << r.diagnosis;
    EXPECT_NE(r.diagnosis.find("let one of them wait"), std::string::npos) << r.diagnosis;
  }
}

// Steps that fall due together happen together, in their order; one may set several components.
TEST(Sequence, SetsSeveralAtOneTime) {
  const Result r =
      run(machine("{ at = \"2 s\", set = [\"motor\", \"brake\"], to = 0 }, { after = \"0 s\", set = \"brake\", to "
                  "= 0.5 }, { at = \"1 s\", set = \"motor\", to = 1 }",
                  "until = \"3 s\"\n", "[brake]\nkind = \"brake\"\non = \"motor\"\ntorque = \"8 N*m\"\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  // Brake on from the start: (M_stall − 8)(1 − e^{−t/τ}); after 2 s motor on, brake at half.
  const double before = 60 * (1 - std::exp(-0.2));
  EXPECT_NEAR(figure(r, "final_speed.motor"), 80 + (before - 80) * std::exp(-0.1), 1e-8);
  EXPECT_EQ(said(r), (std::vector<std::string>{"2 motor: on -> is set off", "2 brake: on -> is set off",
                                               "2 brake: off -> is set 0.5", "2 motor: off -> is set on"}));
}

// A braked stop: motor off, brake on at a speed; it comes to rest at J ω/M_brake and stays.
TEST(Sequence, BrakesToRest) {
  const Result r =
      run(machine("{ at = \"0 s\", set = \"brake\", to = 0 }, { speed_above = \"30 rad/s\", of = \"motor\", set = "
                  "\"motor\", to = 0 }, { after = \"0 s\", set = \"brake\" }",
                  "until = \"20 s\"\n", "[brake]\nkind = \"brake\"\non = \"motor\"\ntorque = \"8 N*m\"\n"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  ASSERT_EQ(r.events.size(), 3u);
  EXPECT_NEAR(r.events[2].t - r.events[0].t, 2 * 30 / 8.0, 1e-9);
  EXPECT_EQ(r.events[2].what, "comes to rest and is held");
  EXPECT_EQ(figure(r, "final_speed.motor"), 0);
}

}  // namespace
}  // namespace kurbel::sequence_test
