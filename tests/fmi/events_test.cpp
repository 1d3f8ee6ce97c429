// events_test.cpp — exported components: events at the times of a run, what happens at the start, ways back, what depends on
// what, units, speeds from outside.
#include <algorithm>
#include <cmath>
#include <set>

#include "tests/fmi/exported.h"

namespace events_test {
namespace {

using namespace exported_components;

const char* const rattling = R"(
title = "A wheel rattles through a gap"
line = ["drive", "claw", "wheel"]
[drive]
kind = "torque source"
torque = "0 N*m"
amplitude = "40 N*m"
frequency = "2 Hz"
inertia = "0.5 kg*m2"
[claw]
kind = "coupling"
stiffness = "20 kN*m/rad"
damping = "4 N*m*s/rad"
backlash = "1 deg"
[wheel]
kind = "flywheel"
inertia = "1.5 kg*m2"
[effects]
elasticity = ["claw"]
backlash = true
[run]
until = "1 s"
accuracy = 1e-7
)";

const char* const clutch_and_brake = R"(
title = "A wheel is coupled, braked, and coupled again"
line = ["motor", "clutch", "wheel"]
[motor]
kind = "induction motor"
rated_power = "4 kW"
rated_speed = "1440 rpm"
synchronous_speed = "1500 rpm"
breakdown_ratio = 2.8
inertia = "0.02 kg*m2"
[clutch]
kind = "clutch"
torque = "60 N*m"
static_torque = "70 N*m"
inertia_in = "0.01 kg*m2"
inertia_out = "0.02 kg*m2"
[wheel]
kind = "flywheel"
inertia = "0.1 kg*m2"
[brake]
kind = "brake"
torque = "50 N*m"
inertia = "0.01 kg*m2"
[[branch]]
from = "wheel"
line = ["brake"]
[sequence]
steps = [
  { at = "0 s", set = "clutch", to = 0 },
  { at = "0 s", set = "brake", to = 0 },
  { at = "0.3 s", set = "clutch", to = 1, over = "0.1 s" },
  { at = "1 s", set = "clutch", to = 0 },
  { at = "1.05 s", set = "brake", to = 1 },
  { at = "1.6 s", set = "brake", to = 0 },
  { at = "1.7 s", set = "clutch", to = 1 },
]
[run]
start = "rest"
until = "2.2 s"
accuracy = 1e-7
)";

// Lines "t = … s: at 0.5 s brake: is set off" of the log.
std::vector<Happened> logged_events(const Slave& slave) {
  std::vector<Happened> events;
  for (const std::string& line : slave.logged) {
    const std::size_t at = line.find(": at "), unit = line.find(" s ", at + 5);
    if (at == std::string::npos || unit == std::string::npos) continue;
    const Happened event{std::stod(line.substr(at + 5, unit - at - 5)), line.substr(unit + 3)};
    if (event.t > 0 && event.what.find("contacts at once") == std::string::npos) events.push_back(event);
  }
  return events;
}

void expect_alike(const std::vector<Happened>& found, const std::vector<Happened>& expected, double until) {
  std::string all;
  for (const Happened& event : found) all += std::to_string(event.t) + " " + event.what + "\n";
  ASSERT_EQ(found.size(), expected.size()) << all;
  double apart = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].what, expected[k].what) << k << " at " << found[k].t << " and " << expected[k].t;
    apart = std::max(apart, std::abs(found[k].t - expected[k].t));
  }
  std::printf("    %zu events, %.2g s apart\n", found.size(), apart);
  EXPECT_LT(apart, 1e-7 * until);
}

struct Case {
  const char* name;
  double until;
  std::size_t least;           // events; 0: none at all
  const char* text = nullptr;  // null: the scene of this name
};
const Case cases[] = {
    {"crank_press", 1.35, 7},         {"planetary_brake", 1.6, 2}, {"clutch_and_brake", 2.2, 8, clutch_and_brake},
    {"backlash", 0.25, 15, rattling}, {"dc_hoist", 2, 4},          {"diesel_generator", 2.5, 1},
    {"six_link_press", 2, 5},         {"gear_pair", 0.3, 0},       {"stephenson", 0.5, 0}};
class Events : public testing::TestWithParam<std::tuple<Case, int>> {
 protected:
  void SetUp() override {
    const Case& c = std::get<0>(GetParam());
    static std::map<std::string, Folder> folders;
    const std::string file = c.text ? written(folders[c.name], c.text) : scene(c.name);
    until_ = c.until;
    expected_ = run(file, until_).events;
    ASSERT_GE(expected_.size(), c.least);
    ASSERT_EQ(expected_.empty(), c.least == 0);
    unpacked_ = exported(file, std::get<1>(GetParam()));
  }
  double until_ = 0;
  std::vector<Happened> expected_;
  std::shared_ptr<const Unpacked> unpacked_;
};
INSTANTIATE_TEST_SUITE_P(Scenes, Events, testing::Combine(testing::ValuesIn(cases), testing::Values(2, 3)),
                         [](const auto& of) {
                           return std::string(std::get<0>(of.param).name) + "_fmi" +
                                  std::to_string(std::get<1>(of.param));
                         });

// Communication points lie anywhere between the events.
TEST_P(Events, OfCoSimulationAreAtTheTimesOfARun) {
  const Library library(unpacked_->library());
  Slave slave(*unpacked_, library, Kind::co_simulation);
  slave.initialise(0);
  double t = 0;
  for (int k = 1; k <= 37; ++k) t = slave.step(t, until_ * k / 37 - t);
  expect_alike(logged_events(slave), expected_, until_);
}

TEST_P(Events, OfModelExchangeAreAtTheTimesOfARun) {
  const Library library(unpacked_->library());
  Slave slave(*unpacked_, library, Kind::model_exchange);
  slave.initialise(0);
  integrate(slave, 0, {until_}, 1e-9, [](std::size_t) {});
  expect_alike(logged_events(slave), expected_, until_);
}

// A brake that the importer sets: both kinds say when, and what it does.
TEST(Inputs, AreLoggedAlikeWhereTheySwitch) {
  const Folder folder;
  const std::string file = written(folder, without_sequence("planetary_brake"));
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(file, fmi, "--input brake.command");
    const Library library(unpacked->library());
    Slave stepped(*unpacked, library, Kind::co_simulation), other(*unpacked, library, Kind::model_exchange);
    for (Slave* const slave : {&stepped, &other}) slave->set("brake.command", 0), slave->initialise(0);
    stepped.step(0, 0.3);
    integrate(other, 0, {0.3}, 1e-9, [](std::size_t) {});
    other.enter_events();
    for (Slave* const slave : {&stepped, &other}) slave->set("brake.command", 1);
    stepped.step(0.3, 1);
    integrate(other, 0.3, {1.3}, 1e-9, [](std::size_t) {});
    const std::vector<Happened> events = logged_events(stepped);
    ASSERT_GE(events.size(), 2u);
    EXPECT_EQ(events[0].t, 0.3);
    EXPECT_EQ(events[0].what, "brake: is set on");
    expect_alike(logged_events(other), events, 1.3);
  }
}

// The brake is released at exactly 0 s: nothing is left to do after the first event mode, and the next step is ahead.
TEST(Start, AnEventAtExactlyTheStartIsPassed) {
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(scene("planetary_brake"), fmi);
    const Library library(unpacked->library());
    Slave slave(*unpacked, library, Kind::model_exchange), stepped(*unpacked, library, Kind::co_simulation);
    slave.initialise(0), stepped.initialise(0);
    EXPECT_EQ(stepped["torque.brake"], 0);
    const Slave::Event event = slave.discrete();
    ASSERT_TRUE(event.next);
    EXPECT_EQ(*event.next, 0.5);
    EXPECT_EQ(slave["torque.brake"], 0);
    for (const double z : slave.indicators()) EXPECT_GT(z, 0);
    for (const double rate : slave.rates()) EXPECT_TRUE(std::isfinite(rate));
    slave.time(0.5 *
               (1 - 1e-15));  // where an importer's sum of steps ends: the edge is passed, and is not the next one
    slave.enter_events();
    const Slave::Event later = slave.discrete();
    EXPECT_GT(later.next.value_or(1), 0.6);
    const std::vector<Happened> events = logged_events(slave);
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const auto& e) { return e.what.starts_with("brake: "); }));
  }
}

TEST(Start, ValuesOfTheDescriptionHoldUntilOthersAreSet) {
  const auto unpacked =
      exported(scene("crank_press"), 3, "--input flywheel.torque --parameter main_coupling.stiffness");
  const Library library(unpacked->library());
  Slave slave(*unpacked, library, Kind::co_simulation);
  const auto as_described = [&] {
    for (const Variable& v : unpacked->variables)
      if (v.start) {
        EXPECT_EQ(slave.get(v.reference), *v.start) << v.name;
      }
  };
  as_described();
  const double stiffness = slave["main_coupling.stiffness"];
  slave.set("main_coupling.stiffness", 1.1 * stiffness), slave.set("flywheel.torque", 5);
  EXPECT_EQ(slave["main_coupling.stiffness"], 1.1 * stiffness);
  slave.initialise(0);
  EXPECT_EQ(slave["flywheel.torque"], 5);
  slave.reset();
  as_described();
  for (const Variable& v : unpacked->variables)
    EXPECT_EQ(v.start.has_value(), v.causality == "input" || v.causality == "parameter") << v.name;
}

// An integrator tries a step, and takes it back: over an event a kept state does, within a stretch times and states.
TEST(Back, ATrialStepLeavesNoTrace) {
  const Folder folder;
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(written(folder, rattling), fmi);
    const Library library(unpacked->library());
    Slave slave(*unpacked, library, Kind::model_exchange);
    slave.initialise(0);
    integrate(slave, 0, {0.05}, 1e-8, [](std::size_t) {});
    const std::vector<double> x = slave.states(), rates = slave.rates(), z = slave.indicators();
    std::vector<double> further = x;
    for (std::size_t k = 0; k < x.size(); ++k) further[k] += 1e-3 * rates[k];
    slave.time(0.051), slave.states(further);
    EXPECT_NE(slave.rates(), rates);
    slave.time(0.05), slave.states(x);
    EXPECT_EQ(slave.rates(), rates);
    EXPECT_EQ(slave.indicators(), z);
    void* const kept = slave.keep();
    std::vector<std::vector<double>> ends;
    for (int way = 0; way < 2; ++way) {  // over three events
      slave.enter_events();
      integrate(slave, 0.05, {0.08}, 1e-8, [&](std::size_t) { ends.push_back(slave.states()); });
      slave.restore(kept);
    }
    EXPECT_EQ(ends[0], ends[1]);
    EXPECT_EQ(slave.rates(), rates);
    slave.free_state(kept);
  }
}

class Dependencies : public testing::TestWithParam<std::tuple<Machine, int>> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Dependencies, testing::Combine(testing::ValuesIn(machines), testing::Values(2, 3)),
                         [](const auto& of) {
                           return std::string(std::get<0>(of.param).scene) + "_fmi" +
                                  std::to_string(std::get<1>(of.param));
                         });

// Whatever is moved, what is said not to depend on it keeps its value to the last bit.
TEST_P(Dependencies, ThatAreNotSaidAreNotThere) {
  const Machine& machine = std::get<0>(GetParam());
  const auto unpacked = exported(scene(machine.scene), std::get<1>(GetParam()));
  const Library library(unpacked->library());
  Slave slave(*unpacked, library, Kind::model_exchange);
  slave.initialise(0);
  const double t = 0.37 * machine.until;
  integrate(slave, 0, {t}, 1e-7, [](std::size_t) {});
  const std::vector<double> x = slave.states(), nominal = slave.nominals();
  std::map<unsigned, double> before;
  for (const auto& [unknown, on] : unpacked->dependencies) before[unknown] = slave.get(unknown);
  std::size_t said = 0;
  for (const unsigned output : unpacked->outputs) said += unpacked->dependencies.count(output);
  EXPECT_GE(said, 2u) << "of " << unpacked->outputs.size();
  const auto compare = [&](unsigned moved) {
    for (const auto& [unknown, on] : unpacked->dependencies)
      if (std::find(on.begin(), on.end(), moved) == on.end()) {
        EXPECT_EQ(slave.get(unknown), before[unknown]) << unknown << " on " << moved;
      }
  };
  for (std::size_t k = 0; k < x.size(); ++k)
    for (const double by : {-0.01, 0.003}) {
      std::vector<double> moved = x;
      moved[k] += by * nominal[k];
      slave.states(moved);
      compare(unpacked->states[k]);
    }
  slave.states(x);
  slave.time(t + 1e-4);
  compare((*unpacked)["time"].reference);
}

// J ω̇ = −c(t) M, c(t) a law over time that a step of the sequence begins: what depends on time says so.
TEST(Laws, OfACommandDependOnTime) {
  const Folder folder;
  const std::string file = written(folder, R"toml(
title = "A brake that follows a law"
line = ["wheel", "brake"]
[wheel]
kind = "flywheel"
inertia = "2 kg*m2"
[brake]
kind = "brake"
torque = "10 N*m"
[sequence]
steps = [{ at = "0 s", set = "brake", law = { over = "time", formula = "t/(4 s)", range = ["0 s", "4 s"] } }]
[run]
start = { speed = "40 rad/s" }
until = "2 s"
accuracy = 1e-8
)toml");
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(file, fmi);
    const Library library(unpacked->library());
    Slave slave(*unpacked, library, Kind::model_exchange);
    slave.initialise(0);
    slave.discrete();
    const unsigned time = (*unpacked)["time"].reference, rate = (*unpacked)["derivative: speed of wheel"].reference;
    std::vector<double> found;
    for (const double t : {0.4, 1.2}) slave.time(t), found.push_back(slave.get(rate));
    EXPECT_NEAR(found[0], -0.5, 1e-9);
    EXPECT_NEAR(found[1], -1.5, 1e-9);
    const std::vector<unsigned>& on = unpacked->dependencies.at(rate);
    EXPECT_EQ(std::count(on.begin(), on.end(), time), 1);
  }
}

// Wheels of 3 and 5 kg·m² in a clutch that holds; a drag b brakes the second: the clutch passes on 3/8 b ω.
TEST(Derivatives, OfAJointThatSticksAreThoseOfWhatItHolds) {
  const Folder folder;
  const std::string file = written(folder, R"(
title = "A clutch that holds"
line = ["first", "clutch", "second"]
first = { kind = "flywheel", inertia = "3 kg*m2" }
clutch = { kind = "clutch", torque = "100 N*m" }
second = { kind = "flywheel", inertia = "5 kg*m2" }
drag = { kind = "bearing drag", on = "second", damping = "0.4 N*m*s/rad" }
run = { start = { speed = "10 rad/s" }, until = "1 s", accuracy = 1e-8 }
)");
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(file, fmi);
    const Library library(unpacked->library());
    Slave slave(*unpacked, library, Kind::co_simulation);
    slave.initialise(0);
    slave.step(0, 0.1);
    EXPECT_NEAR(slave["torque.clutch"], 0.4 * 3 / 8 * slave["speed.second"], 1e-8);
    double by_speeds = 0;  // of both wheels together
    for (const unsigned state : unpacked->states)
      if (unpacked->variables[state].name.starts_with("state: speed of"))
        by_speeds += slave.directional((*unpacked)["torque.clutch"].reference, state);
    EXPECT_NEAR(by_speeds, 0.4 * 3 / 8, 1e-9);
  }
}

// A torque at the input of a gear of 3 and the angles on both sides of it: ω̇ = 3 M/(J + 9 J_m), ∂φ_m/∂φ = 3.
TEST(Gears, PortsAndAnglesAreOnTheirOwnSide) {
  const Folder folder;
  const std::string file = written(folder, R"(
title = "A gear"
line = ["wheel", "gear", "pinion"]
wheel = { kind = "flywheel", inertia = "6 kg*m2" }
gear = { kind = "gearbox", stages = [{ teeth = [60, 20] }] }
pinion = { kind = "flywheel", inertia = "0.5 kg*m2" }
run = { start = { speed = "1 rad/s" }, until = "1 s", accuracy = 1e-8 }
)");
  const double whole = 6 + 9 * 0.5, torque = 7;
  for (const int fmi : {2, 3})
    for (const auto& [port, lever] : {std::pair("gear.in", 1.0), std::pair("gear.out", 3.0)}) {
      const auto unpacked = exported(file, fmi, std::string("--input ") + port + ".torque");
      const Library library(unpacked->library());
      Slave slave(*unpacked, library, Kind::co_simulation);
      slave.set(std::string(port) + ".torque", torque);
      slave.initialise(0);
      slave.step(0, 0.5);
      const double speed = 1 + 0.5 * lever * torque / whole;
      EXPECT_NEAR(slave["speed.wheel"], speed, 1e-8) << port;
      EXPECT_NEAR(slave["speed.pinion"], 3 * speed, 1e-8) << port;
      const unsigned angle = unpacked->states.front();
      ASSERT_TRUE(unpacked->variables[angle].name.starts_with("state: angle")) << unpacked->variables[angle].name;
      EXPECT_NEAR(slave.directional((*unpacked)["angle.pinion"].reference, angle) /
                      slave.directional((*unpacked)["angle.wheel"].reference, angle),
                  3, 1e-12);
      EXPECT_NEAR(slave.directional((*unpacked)["angle.wheel"].reference, angle) *
                      slave.directional(unpacked->derivatives.front(), unpacked->states.back()),
                  slave.directional((*unpacked)["speed.wheel"].reference, unpacked->states.back()), 1e-12);
    }
}

// A crank behind a gear of 3 on a shaft whose speed is given at the gear's other side: its angle is the state.
TEST(Gears, AnAngleOnAShaftThatIsDrivenIsThatOfTheCrank) {
  const Folder folder;
  const std::string file = written(folder, R"(
title = "A crank behind a gear"
line = ["drive", "gear", "crank"]
drive = { kind = "prescribed speed", speed = "6 rad/s" }
gear = { kind = "gearbox", stages = [{ teeth = [20, 60] }] }
crank = { kind = "slider-crank", radius = "50 mm", rod = "200 mm", slider_mass = "1 kg" }
run = { until = "1 s" }
)");
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(file, fmi);
    const Library library(unpacked->library());
    Slave slave(*unpacked, library, Kind::model_exchange);
    slave.initialise(0);
    slave.discrete();
    const std::vector<double> x = slave.states();
    ASSERT_EQ(x.size(), 1u);
    EXPECT_NEAR(slave.rates()[0], 2, 1e-12);
    for (const auto& [angle, ratio] : {std::pair("angle.crank", 1.0), std::pair("angle.drive", 3.0)}) {
      EXPECT_NEAR(slave.directional((*unpacked)[angle].reference, unpacked->states[0]), ratio, 1e-12) << angle;
      slave.states({x[0] + 0.5});
      const double moved = slave[angle];
      slave.states(x);
      EXPECT_NEAR(moved - slave[angle], 0.5 * ratio, 1e-12) << angle;
    }
  }
}

TEST(Units, HaveTheExponentsOfTheirBaseUnits) {
  const std::map<std::string, std::map<std::string, int>> known = {{"s", {{"s", 1}}},
                                                                   {"rad", {{"rad", 1}}},
                                                                   {"rad/s", {{"rad", 1}, {"s", -1}}},
                                                                   {"rad/s2", {{"rad", 1}, {"s", -2}}},
                                                                   {"N*m", {{"kg", 1}, {"m", 2}, {"s", -2}}},
                                                                   {"N*m/s", {{"kg", 1}, {"m", 2}, {"s", -3}}},
                                                                   {"m", {{"m", 1}}},
                                                                   {"m/s", {{"m", 1}, {"s", -1}}},
                                                                   {"m/s2", {{"m", 1}, {"s", -2}}},
                                                                   {"N", {{"kg", 1}, {"m", 1}, {"s", -2}}},
                                                                   {"A", {{"A", 1}}},
                                                                   {"A/s", {{"A", 1}, {"s", -1}}},
                                                                   {"1/s", {{"s", -1}}}};
  std::set<std::string> seen;
  for (const Machine& machine : machines)
    for (const auto& [unit, exponents] : exported(scene(machine.scene), 3)->units) {
      ASSERT_EQ(known.count(unit), 1u) << unit;
      EXPECT_EQ(exponents, known.at(unit)) << unit;
      seen.insert(unit);
    }
  EXPECT_GE(seen.size(), 8u);
}

const char* const driven = R"(
title = "A wheel behind a spring"
line = ["drive", "spring", "wheel"]
[drive]
kind = "prescribed speed"
speed = "0 rad/s"
inertia = "0.5 kg*m2"
[spring]
kind = "coupling"
stiffness = "200 N*m/rad"
[wheel]
kind = "flywheel"
inertia = "2 kg*m2"
[effects]
elasticity = ["spring"]
[run]
until = "2 s"
accuracy = 1e-8
)";

// ω_drive = a t: θ'' = a − (k/J) θ, so that the spring takes a J (1 − cos(√(k/J) t)), the drive a J_d besides.
TEST(Speed, FromOutsideIsReachedAtTheEndOfAStep) {
  const Folder folder;
  const double a = 3, inertia = 2, own = 0.5, omega = std::sqrt(200 / inertia), h = 0.05;
  for (const int fmi : {2, 3}) {
    const auto unpacked = exported(written(folder, driven), fmi, "--kind cs --input drive.speed");
    EXPECT_EQ(unpacked->complaints, std::vector<std::string>());
    EXPECT_EQ((*unpacked)["drive.speed"].unit, "rad/s");
    EXPECT_EQ((*unpacked)["drive.speed"].start, 0.0);
    const Library library(unpacked->library());
    for (const bool by_slope : {false, true}) {
      if (by_slope && fmi == 3) continue;
      Slave slave(*unpacked, library, Kind::co_simulation);
      slave.initialise(0);
      double t = 0;
      for (int k = 1; k <= 20; ++k) {
        slave.set("drive.speed", by_slope ? a * t : a * (t + h));
        if (by_slope) slave.slope("drive.speed", a);
        t = slave.step(t, h);
        const double spring = a * inertia * (1 - std::cos(omega * t));
        EXPECT_NEAR(slave["speed.drive"], a * t, 1e-12 * a);
        EXPECT_NEAR(slave["torque.spring"], spring, 1e-7 * a * inertia);
        EXPECT_NEAR(slave["torque.drive"], spring + a * own, 1e-7 * a * inertia);
        EXPECT_NEAR(slave["speed.wheel"], a * (t - std::sin(omega * t) / omega), 1e-8 * a);
      }
      t = slave.step(t, h);  // nothing set: it stays
      EXPECT_NEAR(slave["speed.drive"], a * (t - h), 1e-12 * a);
    }
  }
}

}  // namespace
}  // namespace events_test
