// closed_loops_test.cpp — closed loops of shafts: a torque-split gearbox with locked-in torque, a lock-up clutch across a
// planetary gear, ratios that clash; against equations of motion written out here, in long double.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>

#include "engine/events/equations.h"
#include "engine/linear/coordinates.h"
#include "tests/published/published.h"

namespace kurbel::closed_loops_test {
namespace {

using test::figure;
using test::run;
using test::scene_from;
using test::with;
using Real = long double;

// Motor – head – two stages 1 : 3 side by side, each with its shaft – bull gear 1 : 4 – load.
constexpr const char* split = R"(
line = ["motor", "head", "stage_a", "shaft_a", "bull", "load"]
[motor]
kind = "dc shunt motor"
stall_torque = "400 N*m"
no_load_speed = "150 rad/s"
inertia = "0.4 kg*m2"
[head]
kind = "flywheel"
inertia = "0.02 kg*m2"
[stage_a]
kind = "gearbox"
stages = [{ teeth = [20, 60], inertia = ["0.01 kg*m2", "0.05 kg*m2"] }]
[shaft_a]
kind = "coupling"
stiffness = "20 kN*m/rad"
damping = "20 N*m*s/rad"
[bull]
kind = "gearbox"
stages = [{ teeth = [20, 80], inertia = ["0.2 kg*m2", "1 kg*m2"] }]
[load]
kind = "load"
torque = "1 kN*m"
inertia = "20 kg*m2"
[stage_b]
kind = "gearbox"
stages = [{ teeth = [20, 60], inertia = ["0.01 kg*m2", "0.06 kg*m2"] }]
[shaft_b]
kind = "coupling"
stiffness = "10 kN*m/rad"
damping = "5 N*m*s/rad"
[[branch]]
from = "head"
line = ["stage_b", "shaft_b"]
to = "bull.in"
)";
constexpr const char* elastic_end = R"(
[effects]
elasticity = true
[run]
until = "0.5 s"
samples = 501
accuracy = 1e-10
start = { speed = "10 rad/s", on = "motor", shaft_a = { twist = "10 mrad" } }
)";

// Driving shaft ω₁ (on the motor), two twists, driven shaft ω₂ (on the bull gear's pinion).
struct Split {
  static constexpr Real j1 = 0.4L + 0.02L + 0.01L + 0.01L + (0.05L + 0.06L) / 9, j2 = 0.2L + (1 + 20) / 16.0L;
  std::array<Real, 4> rate(const std::array<Real, 4>& y) const {
    const auto [w1, a, b, w2] = y;
    const Real da = w1 / 3 - w2, tau_a = 20e3L * a + 20 * da, tau_b = 10e3L * b + 5 * da;
    return {(400 * (1 - w1 / 150) - (tau_a + tau_b) / 3) / j1, da, da, (tau_a + tau_b - 1000 / 4.0L) / j2};
  }
};

template <class System, std::size_t N>
std::array<Real, N> step(const System& system, const std::array<Real, N>& y, Real h) {
  const auto plus = [](const std::array<Real, N>& a, Real s, const std::array<Real, N>& b) {
    std::array<Real, N> c;
    for (std::size_t i = 0; i < N; ++i) c[i] = a[i] + s * b[i];
    return c;
  };
  const auto k1 = system.rate(y), k2 = system.rate(plus(y, h / 2, k1)), k3 = system.rate(plus(y, h / 2, k2)),
             k4 = system.rate(plus(y, h, k3));
  std::array<Real, N> next;
  for (std::size_t i = 0; i < N; ++i) next[i] = y[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return next;
}

TEST(ClosedLoop, TorqueSplitWithLockedInTorqueMovesByItsEquations) {
  const Result r = run(std::string(split) + elastic_end);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const auto a = test::series(r, "torque.shaft_a"), b = test::series(r, "torque.shaft_b"),
             w = test::series(r, "speed.motor");
  const Split own;
  std::array<Real, 4> y = {10, 0.01L, 0, 10 / 3.0L};
  constexpr int steps_a_row = 200;
  for (std::size_t row = 0; row < a.size(); ++row) {
    const Real da = y[0] / 3 - y[3];
    ASSERT_NEAR(a[row], static_cast<double>(20e3L * y[1] + 20 * da), 2e-6) << row;
    ASSERT_NEAR(b[row], static_cast<double>(10e3L * y[2] + 5 * da), 2e-6) << row;
    ASSERT_NEAR(w[row], static_cast<double>(y[0]), 1e-7) << row;
    for (int i = 0; i < steps_a_row; ++i) y = step(own, y, 0.5L / 500 / steps_a_row);
  }
  // What is locked in stays: θ_a − θ_b.
  const auto ta = test::series(r, "twist.shaft_a"), tb = test::series(r, "twist.shaft_b");
  for (std::size_t row = 0; row < ta.size(); ++row) ASSERT_NEAR(ta[row] - tb[row], 0.01, 1e-12) << row;
  EXPECT_LT(r.energy.relative, 1e-9);
}

// Rigid, both ways carry what their stiffnesses say: the limit of the elastic machine.
TEST(ClosedLoop, RigidWaysShareByTheirStiffness) {
  for (const bool clamped : {false, true}) {
    const std::string start = clamped ? ", shaft_a = { twist = \"10 mrad\" }" : "";
    const Result r = run(std::string(split) +
                         "[run]\nuntil = \"0.5 s\"\nstart = { speed = \"10 rad/s\", on = \"motor\"" + start + " }\n");
    ASSERT_TRUE(r.complete) << r.diagnosis;
    const auto a = test::series(r, "torque.shaft_a"), b = test::series(r, "torque.shaft_b"),
               w = test::series(r, "speed.motor");
    const double locked_in = clamped ? 0.01 * 20e3 * 10e3 / 30e3 : 0;  // springs in series around the loop
    for (std::size_t row = 0; row < a.size(); ++row) {
      const double drive = 400 * (1 - w[row] / 150);
      const double alpha = (3 * drive - 250) / static_cast<double>(9 * Split::j1 + Split::j2);  // of the pinion
      const double passed = 250 + static_cast<double>(Split::j2) * alpha;                       // into the pinion
      ASSERT_NEAR(a[row] + b[row], passed, 1e-9 * passed) << row;
      ASSERT_NEAR(a[row], 2.0 / 3 * passed + locked_in, 1e-9 * passed) << row;
    }
  }
}

// A gear that closes the loop, its losses omitted: what its coupling passes goes through its teeth, whenever it is read
// (once each torque was added to the one before it: MN·m after some seconds).
TEST(ClosedLoop, GearThatClosesItPassesWhatItsCouplingPasses) {
  std::string text =
      with(test::project_text("scenes/back_to_back_rig.toml"), "elasticity = true", "gear_losses = false");
  const std::size_t gear = text.rfind("stages     = [{ teeth = [16, 24], inertia = [\"2 g*m2\", \"9 g*m2\"] }]");
  ASSERT_NE(gear, std::string::npos);
  text =
      text.substr(0, gear) + "stages = [{ teeth = [16, 24], efficiency = 0.98 }]" + text.substr(text.find('\n', gear));
  const Result r = run(text);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_LE(r.measured_accuracy, 1e-6);
  const auto coupling = test::series(r, "torque.load_coupling"), in = test::series(r, "torque.test.in"),
             out = test::series(r, "torque.test.out");
  for (std::size_t row = 0; row < in.size(); ++row) {
    ASSERT_NEAR(in[row], coupling[row], 1e-9 * 200) << row;
    ASSERT_NEAR(out[row], 1.5 * coupling[row], 1e-9 * 200) << row;
  }
}

// Cut elsewhere, or walked the other way round, it is the same machine.
TEST(ClosedLoop, WhereItIsCutMakesNoDifference) {
  const Result r = run(std::string(split) + elastic_end);
  std::string other = with(std::string(split) + elastic_end,
                           "line = [\"motor\", \"head\", \"stage_a\", \"shaft_a\", \"bull\", \"load\"]",
                           "line = [\"motor\", \"head\", \"stage_b\", \"shaft_b\", \"bull\", \"load\"]");
  other = with(other, "line = [\"stage_b\", \"shaft_b\"]", "line = [\"stage_a\", \"shaft_a\"]");
  const Result s = run(other);
  ASSERT_TRUE(r.complete && s.complete) << r.diagnosis << s.diagnosis;
  for (const char* channel : {"torque.shaft_a", "torque.shaft_b", "speed.motor", "speed.load"}) {
    const auto a = test::series(r, channel), b = test::series(s, channel);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t row = 0; row < a.size(); ++row) ASSERT_NEAR(a[row], b[row], 1e-6) << channel << " " << row;
  }
}

// Started in balance nothing rings, and what is locked in stays beside what is passed.
TEST(ClosedLoop, StartsInBalanceWithWhatIsLockedIn) {
  std::string text = with(std::string(split) + elastic_end, "start = { ", "start = { equilibrium = true, ");
  text = with(
      text, "kind = \"dc shunt motor\"\nstall_torque = \"400 N*m\"\nno_load_speed = \"150 rad/s\"",
      "kind = \"torque source\"\ntable = { over = \"time\", unit = [\"s\", \"N*m\"], points = [[0, 120], [1, 120]] }");
  const Result r = run(text);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  const double alpha = (3 * 120 - 250) / static_cast<double>(9 * Split::j1 + Split::j2);
  const double passed = 250 + static_cast<double>(Split::j2) * alpha, own = 0.01 * 20e3 * 10e3 / 30e3;
  // The wheels behind the stages are before the springs.
  for (const double tau : test::series(r, "torque.shaft_a")) ASSERT_NEAR(tau, 2.0 / 3 * passed + own, 1e-6);
  for (const double tau : test::series(r, "torque.shaft_b")) ASSERT_NEAR(tau, 1.0 / 3 * passed - own, 1e-6);
}

std::string refusal(const std::string& text) {
  try {
    compile(scene_from(text), scene_from(text).effects);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(ClosedLoop, RatiosThatClashAreReportedWithBothWays) {
  std::string text = split;
  text.replace(text.rfind("teeth = [20, 60]"), 16, "teeth = [100, 301]");
  const std::string reported = refusal(text);
  EXPECT_NE(reported.find("0.996678 times"), std::string::npos) << reported;  // 3/3.01
  EXPECT_NE(reported.find("cannot turn"), std::string::npos) << reported;
  // With a clutch in it there is a motion.
  text = with(text, "[[branch]]\nfrom = \"head\"\nline = [\"stage_b\", \"shaft_b\"]",
              "[grip]\nkind = \"clutch\"\ntorque = \"50 N*m\"\ninertia_in = \"0.01 kg*m2\"\ninertia_out = \"0.01 "
              "kg*m2\"\n[[branch]]\nfrom = \"head\"\nline = [\"stage_b\", \"shaft_b\", \"grip\"]");
  const Result r = run(text + elastic_end);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_NEAR(test::series(r, "torque.grip").back(), -50, 1e-9);  // its driving side is the slower one
  // Where every clutch counts as locked there is none.
  Scene locked = scene_from(text + elastic_end);
  locked.effects.locked = true;
  try {
    compile(locked, locked.effects);
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find("counts as locked here"), std::string::npos) << e.what();
  }
}

TEST(ClosedLoop, GearsAloneAllAroundLeaveTheirShareOpen) {
  std::string text = with(split, "\"stage_a\", \"shaft_a\", \"bull\"", "\"stage_a\", \"bull\"");
  text = with(text, "line = [\"stage_b\", \"shaft_b\"]", "line = [\"stage_b\"]");
  for (const char* shaft : {"[shaft_a]\nkind = \"coupling\"\nstiffness = \"20 kN*m/rad\"\ndamping = \"20 N*m*s/rad\"\n",
                            "[shaft_b]\nkind = \"coupling\"\nstiffness = \"10 kN*m/rad\"\ndamping = \"5 N*m*s/rad\"\n"})
    text = with(text, shaft, "");
  EXPECT_NE(refusal(text).find("rigid all round"), std::string::npos) << refusal(text);
}

// --- lock-up clutch across a planetary gear, shifted under load ---

constexpr const char* lockup = R"(
line = ["motor", "planet", "load"]
[motor]
kind = "dc shunt motor"
stall_torque = "200 N*m"
no_load_speed = "150 rad/s"
inertia = "0.4 kg*m2"
[planet]
kind = "planetary gear"
sun = 30
ring = 60
sun_inertia = "0.01 kg*m2"
carrier_inertia = "0.05 kg*m2"
[load]
kind = "load"
torque = "120 N*m"
inertia = "3 kg*m2"
[band]
kind = "brake"
on = "planet.ring"
torque = "400 N*m"
inertia = "0.06 kg*m2"
[lockup]
kind = "clutch"
torque = "150 N*m"
inertia_in = "0.002 kg*m2"
inertia_out = "0.003 kg*m2"
[[branch]]
from = "planet.sun"
line = ["lockup"]
to = "planet.ring"
[sequence]
steps = [{ at = "0 s", set = "lockup", to = 0 }, { at = "0.5 s", set = "band", to = 0 }, { at = "0.51 s", set = "lockup", to = 1 }]
[run]
start = { speed = "60 rad/s", on = "motor", band = { speed = "0 rad/s" }, load = { speed = "20 rad/s" } }
until = "1.5 s"
samples = 301
accuracy = 1e-10
)";

// Sun ω_s and ring ω_r are free, the carrier turns at (30 ω_s + 60 ω_r)/90. The band holds the ring, then lets it go; the
// clutch slips between sun and ring until they turn alike.
struct Shift {
  bool band = true, on = false, locked = false;
  static constexpr Real is = 0.4L + 0.01L + 0.002L, ir = 0.06L + 0.003L, ic = 0.05L + 3, s = 1 / 3.0L, r = 2 / 3.0L;
  std::array<Real, 2> rate(const std::array<Real, 2>& w) const {
    const Real drive = 200 * (1 - w[0] / 150);
    if (locked) {  // one body
      const Real alpha = (drive - 120) / (is + ir + ic);
      return {alpha, alpha};
    }
    const Real grip = on ? 150 : 0;  // the sun is the faster one until they turn alike
    const Real ms = drive - s * 120 - grip, mr = -r * 120 + grip;
    const Real a = is + s * s * ic, b = s * r * ic, d = ir + r * r * ic;
    if (band) return {ms / a, 0};
    const Real det = a * d - b * b;
    return {(d * ms - b * mr) / det, (a * mr - b * ms) / det};
  }
};

TEST(ClosedLoop, LockUpClutchAcrossAPlanetaryGearShiftsUnderLoad) {
  const Result result = run(lockup);
  ASSERT_TRUE(result.complete) << result.diagnosis;
  const auto sun = test::series(result, "speed.motor"), ring = test::series(result, "speed.band"),
             load = test::series(result, "speed.load");
  Shift own;
  std::array<Real, 2> w = {60, 0};
  constexpr int steps_a_row = 500;
  constexpr Real h = 1.5L / 300 / steps_a_row;
  Real locked_at = 0;
  for (std::size_t row = 0; row < sun.size(); ++row) {
    ASSERT_NEAR(sun[row], static_cast<double>(w[0]), 3e-7) << row;
    ASSERT_NEAR(ring[row], static_cast<double>(w[1]), 3e-7) << row;
    ASSERT_NEAR(load[row], static_cast<double>((w[0] + 2 * w[1]) / 3), 3e-7) << row;
    for (int i = 0; i < steps_a_row; ++i) {
      const auto number = static_cast<long>(row) * steps_a_row + i;
      own.band = number < 50000;  // 0.5 s
      own.on = number >= 51000;   // 0.51 s
      const auto next = step(own, w, h);
      if (own.on && !own.locked && (next[0] - next[1]) * (w[0] - w[1]) <= 0) {
        const Real part =
            (w[0] - w[1]) / ((w[0] - w[1]) - (next[0] - next[1]));  // Newton's first step, then exact enough
        w = step(own, w, part * h);
        locked_at = static_cast<Real>(number) * h + part * h;
        w[1] = w[0];
        own.locked = true;
        w = step(own, w, (1 - part) * h);
      } else {
        w = next;
      }
    }
  }
  ASSERT_TRUE(own.locked);
  bool reported = false;
  for (const Event& e : result.events)
    reported = reported || (e.component == "lockup" && std::abs(e.t - static_cast<double>(locked_at)) < 1e-7);
  EXPECT_TRUE(reported) << static_cast<double>(locked_at);
  EXPECT_LT(result.energy.relative, 1e-8);
}

// Two clutches locked into one loop at once block it: that is a motion, at rest.
TEST(ClosedLoop, BandAndLockUpTogetherStopTheMachine) {
  std::string text = with(lockup, "{ at = \"0.5 s\", set = \"band\", to = 0 }, ", "");
  text = with(with(text, "\"400 N*m\"", "\"900 N*m\""), "\"150 N*m\"", "\"600 N*m\"");
  const Result r = run(text);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  EXPECT_EQ(test::series(r, "speed.motor").back(), 0);
  EXPECT_EQ(test::series(r, "speed.load").back(), 0);
}

}  // namespace
}  // namespace kurbel::closed_loops_test
