// rheostat_test.cpp — DC motors started over a rheostat of five steps: against closed forms, and against equations of
// motion written out here in long double.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "tests/published/published.h"
#include "tests/support/jacobians.h"

namespace kurbel::rheostat_test {
namespace {

using test::figure;
using test::run;
using test::with;
using Real = long double;

constexpr Real voltage = 220, resistance = 0.4L, constant = 1.4L, inertia = 3, load = 60, least = 90;
constexpr Real steps[] = {1.6L, 1.0L, 0.6L, 0.3L, 0.12L};

constexpr const char* hoist = R"(
line = ["motor", "load"]
[motor]
kind = "dc shunt motor"
voltage = "220 V"
resistance = "0.4 Ohm"
constant = "1.4 N*m/A"
inertia = "1 kg*m2"
starting_resistances = ["1.6 Ohm", "1 Ohm", "0.6 Ohm", "0.3 Ohm", "0.12 Ohm"]
switch_current = "90 A"
[load]
kind = "flywheel"
inertia = "2 kg*m2"
[weight]
kind = "torque source"
on = "load"
torque = "-60 N*m"
[run]
until = "6 s"
samples = 601
accuracy = 1e-10
)";

std::vector<Event> stage_events(const Result& r) {
  std::vector<Event> list;
  for (const Event& e : r.events)
    if (e.component == "motor" && e.what.find("starting resistance") != std::string::npos) list.push_back(e);
  return list;
}

// Without an inductance each stage is an exponential: ω_∞ = U/k − M (R + R_k)/k², T = J (R + R_k)/k².
TEST(Rheostat, StagesOfAShuntMotorEndWhereTheirExponentialsSay) {
  const Result r = run(hoist);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const std::vector<Event> events = stage_events(r);
  ASSERT_EQ(events.size(), 5U);
  Real t = 0, speed = 0;
  for (int k = 0; k < 5; ++k) {
    const Real total = resistance + steps[k], end = (voltage - least * total) / constant;
    const Real last = voltage / constant - load * total / (constant * constant);
    t += inertia * total / (constant * constant) * std::log((last - speed) / (last - end));
    speed = end;
    EXPECT_NEAR(events[static_cast<std::size_t>(k)].t, static_cast<double>(t), 1e-8) << k;
  }
  const Real last = voltage / constant - load * resistance / (constant * constant);
  const Real after = (6 - t) * constant * constant / (inertia * resistance);
  EXPECT_NEAR(figure(r, "final_speed.motor"), static_cast<double>(last - (last - speed) * std::exp(-after)), 1e-7);
  EXPECT_LT(r.energy.relative, 1e-9);
  // The peaks of current follow from the steps: the torque jumps up at each.
  const auto torque = test::series(r, "torque.motor");
  for (const double m : torque)
    EXPECT_LT(m, 1.01 * static_cast<double>(constant * voltage / (resistance + steps[0])) + 60);
}

struct Circuit {
  Real inductance, added;
  bool series;
  // Speed and current.
  void rate(const Real* y, Real* d) const {
    const Real kappa = 0.05L, total = resistance + added;
    d[0] = ((series ? kappa * y[1] * y[1] : constant * y[1]) - load) / inertia;
    d[1] = (voltage - total * y[1] - (series ? kappa * y[0] * y[1] : constant * y[0])) / inductance;
  }
};
void advance(const Circuit& c, Real* y, Real h) {
  Real k[4][2], at[2];
  c.rate(y, k[0]);
  for (int s = 1; s < 4; ++s) {
    for (int i = 0; i < 2; ++i) at[i] = y[i] + (s == 3 ? h : h / 2) * k[s - 1][i];
    c.rate(at, k[s]);
  }
  for (int i = 0; i < 2; ++i) y[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

// With its inductance: the current rises to a peak after each switching, then falls to the current of switching.
class CircuitOnRheostat : public ::testing::TestWithParam<bool> {};
TEST_P(CircuitOnRheostat, EndsItsStagesWhereItsCurrentHasFallen) {
  const bool series = GetParam();
  std::string text = with(hoist, "switch_current = \"90 A\"", "switch_current = \"90 A\"\ninductance = \"20 mH\"");
  if (series)
    text = with(with(text, "dc shunt motor", "dc series motor"), "constant = \"1.4 N*m/A\"",
                "constant = \"50 mN*m/A2\"\nmax_speed = \"400 rad/s\"");
  const Result r = run(text);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const std::vector<Event> events = stage_events(r);
  ASSERT_EQ(events.size(), 5U);
  Circuit c{0.02L, steps[0], series};
  Real y[2] = {0, 0}, t = 0;
  constexpr Real h = 2e-5L;
  int stage = 0;
  bool fallen = false;
  while (stage < 5 && t < 6) {
    const Real before[2] = {y[0], y[1]};
    advance(c, y, h);
    t += h;
    if (y[1] < before[1]) fallen = true;
    if (!fallen || y[1] > least) continue;
    Real low = 0, high = h;  // within this step
    for (int i = 0; i < 60; ++i) {
      const Real middle = (low + high) / 2;
      y[0] = before[0], y[1] = before[1];
      advance(c, y, middle);
      (y[1] > least ? low : high) = middle;
    }
    t += low - h;
    EXPECT_NEAR(events[static_cast<std::size_t>(stage)].t, static_cast<double>(t), 2e-8) << stage;
    ++stage;
    c.added = stage < 5 ? steps[stage] : 0;
    fallen = false;
  }
  EXPECT_EQ(stage, 5);
  const auto current = test::series(r, "current.motor"), time = r.trajectory->time();
  for (std::size_t row = 0; row < time.size(); ++row)
    if (time[row] > events.front().t && time[row] < events.back().t) {
      EXPECT_GT(current[row], 89.99) << time[row];
    }
}
INSTANTIATE_TEST_SUITE_P(Motors, CircuitOnRheostat, ::testing::Bool(),
                         [](const auto& i) { return i.param ? "Series" : "Shunt"; });

TEST(Rheostat, ByTimesItsStagesEndAtThem) {
  const Result r = run(with(hoist, "switch_current = \"90 A\"",
                            "switch_times = [\"0.5 s\", \"0.9 s\", \"1.2 s\", \"1.4 s\", \"1.5 s\"]"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const std::vector<Event> events = stage_events(r);
  ASSERT_EQ(events.size(), 5U);
  const double ends[] = {0.5, 0.9, 1.2, 1.4, 1.5};
  Real t = 0, speed = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(events[k].t, ends[k], 1e-12);
    const Real total = resistance + steps[k], last = voltage / constant - load * total / (constant * constant);
    speed = last - (last - speed) * std::exp(-(ends[k] - t) * constant * constant / (inertia * total));
    t = ends[k];
  }
  EXPECT_NEAR(test::series(r, "speed.motor")[150], static_cast<double>(speed), 1e-7);
}

// A stage too small to lift the current above that of switching is skipped; one that starts turning begins there.
TEST(Rheostat, StagesThatDoNothingArePassedOver) {
  const Result r = run(with(hoist, "\"220 V\"", "\"150 V\"") + "start = { speed = \"60 rad/s\", on = \"motor\" }\n");
  ASSERT_TRUE(r.complete) << r.diagnosis;
  // At 60 rad/s 66 V are left: 90 A flow over less than 0.733 Ω, which is stage 4 with its 0.7 Ω.
  EXPECT_EQ(stage_events(r).size(), 2U);
  EXPECT_NEAR(test::series(r, "torque.motor")[0], 1.4 * (150 - 1.4 * 60) / 0.7, 1e-9);
}

// Off at 3 s, on at 8 s: the weight has slowed it down by 100 rad/s, and the stages that suit that speed repeat.
TEST(Rheostat, IsInTheCircuitAgainAtEachStart) {
  const std::string twice = with(hoist, "until = \"6 s\"", "until = \"12 s\"") + R"([sequence]
steps = [{ at = "3 s", set = "motor", to = 0 }, { at = "8 s", set = "motor", to = 1 }]
)";
  const Result r = run(with(twice, "samples = 601", "samples = 1201"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto speed = test::series(r, "speed.motor"), torque = test::series(r, "torque.motor");
  EXPECT_NEAR(speed[300] - speed[799], 4.99 * 60 / 3, 1e-6);
  const double at_start = speed[799] - 0.2;  // at 8 s
  double added = 0;                          // the first stage in which more than 90 A flow
  for (const Real step : {0.12L, 0.3L, 0.6L, 1.0L, 1.6L})
    if (220 - 1.4 * at_start > 90 * (0.4 + static_cast<double>(step))) added = static_cast<double>(step);
  ASSERT_GT(added, 0.5);
  const auto last_row = static_cast<std::size_t>(801);
  EXPECT_NEAR(torque[last_row], 1.4 * (220 - 1.4 * speed[last_row]) / (0.4 + added), 1e-6);
  // Two stages were cut out before, and are cut out again.
  const std::vector<Event> events = stage_events(r);
  ASSERT_EQ(events.size(), 5U);
  EXPECT_LT(events[1].t, 3);
  EXPECT_GT(events[2].t, 8);
  EXPECT_EQ(events[2].what, events[0].what);

  // With its inductance the current begins at zero again, and no jump of it goes into the machine.
  const Result slow =
      run(with(twice, "switch_current = \"90 A\"", "switch_current = \"90 A\"\ninductance = \"20 mH\""));
  ASSERT_TRUE(slow.complete) << slow.diagnosis;
  EXPECT_EQ(stage_events(slow).size(), stage_events(r).size());
  EXPECT_LT(slow.energy.relative, 1e-8);
  const auto current = test::series(slow, "current.motor"), time = slow.trajectory->time();
  for (std::size_t row = 0; row < time.size(); ++row)
    if (time[row] > 3.001 && time[row] < 7.999) {
      EXPECT_EQ(current[row], 0) << time[row];
    }
}

// Its times count from each start.
TEST(Rheostat, TimesCountFromEachStart) {
  const Result r = run(with(with(hoist, "switch_current = \"90 A\"",
                                 "switch_times = [\"0.5 s\", \"0.9 s\", \"1.2 s\", \"1.4 s\", \"1.5 s\"]"),
                            "[run]",
                            "[sequence]\nsteps = [{ at = \"2 s\", set = \"motor\", to = 0 }, { at = \"3 s\", set = "
                            "\"motor\", to = 1 }]\n[run]"));
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const std::vector<Event> events = stage_events(r);
  ASSERT_EQ(events.size(), 10U);
  const double ends[] = {0.5, 0.9, 1.2, 1.4, 1.5};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(events[5 + k].t, 3 + ends[k], 1e-12);
}

TEST(Rheostat, JacobianEqualsDifferences) {
  for (const char* more : {"", "inductance = \"20 mH\"\n"})
    test::expect_exact_jacobian_near_start(
        with(hoist, "switch_current = \"90 A\"", std::string("switch_current = \"90 A\"\n") + more) +
            "start = { speed = \"20 rad/s\", on = \"motor\" }\n",
        {3, 10});
}

}  // namespace
}  // namespace kurbel::rheostat_test
