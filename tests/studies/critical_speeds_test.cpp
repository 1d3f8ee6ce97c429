// critical_speeds_test.cpp — where orders vibrate most, and speeds at which a machine can stay, by closed forms; what
// cannot be kept bars nothing.
#include "studies/modes/critical_speeds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/index.h"
#include "tests/support/scenes.h"

namespace kurbel::test::critical_speeds_test {
namespace {

// An induction motor, synchronous at 100 rad/s, that breaks down at a slip of 0.2; behind it an elastic shaft.
const std::string driven =
    "line = [\"motor\", \"shaft\", \"wheel\"]\nmotor = { kind = \"induction motor\", breakdown_torque = \"90 N*m\", "
    "breakdown_slip = 0.2, synchronous_speed = \"100 rad/s\", inertia = \"0.3 kg*m2\" }\n"
    "shaft = { kind = \"shaft\", stiffness = \"5 kN*m/rad\", damping = \"1 N*m*s/rad\" }\n"
    "wheel = { kind = \"load\", damping = \"LOAD\", inertia = \"1.2 kg*m2\" }\n[effects]\nelasticity = true\n";

bool grows_at(double speed, const std::string& load) {
  std::string text = driven;
  text.replace(text.find("LOAD"), 4, load);
  const Scene scene = scene_from(text);
  LinearisationPoint point;
  point.speed = speed;
  return grows(linearise(compile(scene, scene.effects), point));
}

// Kloss: M = 2 M_b/(s/s_b + s_b/s). The whole machine grows where dM/dω exceeds the load's slope.
double slope(double speed) {
  const double s = 1 - speed / 100, h = 1e-6;
  const auto torque = [](double slip) { return 180 / (slip / 0.2 + 0.2 / slip); };
  return -(torque(s + h) - torque(s - h)) / (2 * h) / 100;
}

// Inertias J₁ = 0.5 and J₂ = 1.5 kg·m² on a shaft of k = 3750 N·m/rad, ω₀ = 100 rad/s; 40 N·m of the first order on the
// second, of which a rigid shaft carries J₁/(J₁ + J₂), 10 N·m.
std::string swinging(double damping) {
  return fmt::format(R"~(
line    = ["motor", "shaft", "wheel"]
motor   = {{ kind = "dc shunt motor", stall_torque = "1e-6 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }}
shaft   = {{ kind = "shaft", stiffness = "3750 N*m/rad", damping = "{} N*m*s/rad" }}
wheel   = {{ kind = "torque source", inertia = "1.5 kg*m2", table = {{ over = "angle", formula = "A*cos(angle)", with = {{ A = "40 N*m" }}, period = "6.283185307179586 rad" }} }}
effects = {{ elasticity = true }}
run     = {{ start = {{ speed = "70 rad/s" }} }}
)~",
                     damping);
}

ModesStudy study_over(const std::string& text, double slowest, double fastest) {
  const Scene scene = scene_from(text);
  ModesOptions options;
  options.speed = 70;
  options.slowest = slowest, options.fastest = fastest;
  return find_modes(scene, scene.effects, options);
}

// What a joint with ζ passes on: √((1 + (2ζr)²)/((1 − r²)² + (2ζr)²)) times the rigid torque, r = ω/ω₀, greatest at
// r² = (√(1 + 8ζ²) − 1)/(4ζ²) (Den Hartog, Mechanical Vibrations, section 2.12).
TEST(CriticalSpeeds, OscillateMostWhereTheClosedFormDoes) {
  for (const double ratio : {0.02, 0.2, 0.4}) {
    SCOPED_TRACE(ratio);
    const double r2 = (std::sqrt(1 + 8 * ratio * ratio) - 1) / (4 * ratio * ratio), damper = 4 * ratio * ratio * r2;
    const double most = 10 * std::sqrt((1 + damper) / ((1 - r2) * (1 - r2) + damper));
    const ModesStudy study = study_over(swinging(75 * ratio), 30, 150);
    ASSERT_EQ(study.critical.size(), 1U);
    const CriticalSpeed& c = study.critical.front();
    EXPECT_NEAR(c.speed, 100, 1e-4);
    ASSERT_TRUE(c.peak);
    EXPECT_NEAR(*c.peak, 100 * std::sqrt(r2), 1e-3 * 100 * ratio);
    EXPECT_NEAR(c.amplitude, most, 1e-5 * most);
    EXPECT_TRUE(std::any_of(study.sweep.begin(), study.sweep.end(), [&](const auto& s) { return s.speed == *c.peak; }))
        << "curves and tables have the peak, too";
    EXPECT_TRUE(std::is_sorted(study.sweep.begin(), study.sweep.end(),
                               [](const auto& a, const auto& b) { return a.speed < b.speed; }));
  }
}

// A stiff shaft of small torque before a soft one with a large damping: reported is what the soft one does, which the
// mode twists, and not the slope of the other; its peak is that of the closed form.
TEST(CriticalSpeeds, AreTheAmplitudeOfTheJointThatTheModeTwists) {
  const ModesStudy study = study_over(R"~(
line    = ["motor", "stiff", "wheel", "soft", "fan"]
motor   = { kind = "dc shunt motor", stall_torque = "1e-6 N*m", no_load_speed = "100 rad/s", inertia = "40 kg*m2" }
stiff   = { kind = "shaft", stiffness = "1e10 N*m/rad", damping = "1 N*m*s/rad" }
wheel   = { kind = "torque source", inertia = "20 kg*m2", table = { over = "angle", formula = "A*cos(angle)", with = { A = "40 N*m" }, period = "6.283185307179586 rad" } }
soft    = { kind = "shaft", stiffness = "4000 N*m/rad", damping = "12 N*m*s/rad" }
fan     = { kind = "load", inertia = "0.8 kg*m2", torque = "0 N*m" }
effects = { elasticity = true }
run     = { start = { speed = "70 rad/s" } }
)~",
                                      40, 110);
  ASSERT_FALSE(study.critical.empty());
  const CriticalSpeed& c = study.critical.front();
  EXPECT_EQ(study.joint_names[c.joint], "soft");
  const double reduced = 1 / (1 / 60.0 + 1 / 0.8), omega = std::sqrt(4000 / reduced), zeta = 12 / (2 * omega * reduced);
  const double r2 = (std::sqrt(1 + 8 * zeta * zeta) - 1) / (4 * zeta * zeta), damper = 4 * zeta * zeta * r2;
  ASSERT_TRUE(c.peak);
  EXPECT_NEAR(*c.peak, omega * std::sqrt(r2), 2e-3 * omega * zeta);
  const double most = 40 * 0.8 / 60.8 * std::sqrt((1 + damper) / ((1 - r2) * (1 - r2) + damper));
  EXPECT_NEAR(c.amplitude, most, 1e-3 * most);
}

// Without damping the swing at a resonance knows no bound: that bars it, and is no reason to leave it out.
TEST(CriticalSpeeds, WithoutDampingAreBarred) {
  const ModesStudy study = study_over(swinging(0), 30, 150);
  ASSERT_EQ(study.critical.size(), 1U);
  EXPECT_NEAR(study.critical.front().severest(), 100, 1e-3);
  EXPECT_TRUE(std::any_of(study.barred.begin(), study.barred.end(),
                          [](const BarredRange& b) { return b.from < 100 && 100 < b.to; }));
}

// Where the range ends below the peak, or begins above it, there is none to report.
TEST(CriticalSpeeds, HaveNoPeakBeyondTheRange) {
  const ModesStudy study = study_over(swinging(15), 98, 140);
  ASSERT_EQ(study.critical.size(), 1U);
  EXPECT_FALSE(study.critical.front().peak);
  EXPECT_EQ(study.critical.front().severest(), study.critical.front().speed);
}

TEST(CriticalSpeeds, BehindTheCurvesStandsTheRigidMachine) {
  const ModesStudy study = study_over(swinging(15), 30, 300);
  ASSERT_GT(study.rigid.size(), 30U);
  for (const SpeedResponse& s : study.rigid) EXPECT_NEAR(s.joints.front().peak, 10, 1e-4) << s.speed;
}

TEST(OperatingSpeeds, AMotorBeyondItsBreakdownIsNotKept) {
  EXPECT_FALSE(grows_at(85, "0.01 N*m*s/rad"));  // slip 0.15
  EXPECT_TRUE(grows_at(75, "0.01 N*m*s/rad"));   // slip 0.25
  EXPECT_GT(slope(75), 0.01);
  EXPECT_LT(slope(85), 0);
}

TEST(OperatingSpeeds, ALoadThatRisesFasterHoldsIt) {
  const double rises = slope(60);
  ASSERT_GT(rises, 0.1);
  EXPECT_TRUE(grows_at(60, fmt::format("{} N*m*s/rad", 0.98 * rises)));
  EXPECT_FALSE(grows_at(60, fmt::format("{} N*m*s/rad", 1.02 * rises)));
}

TEST(OperatingSpeeds, StretchesAreWhole) {
  std::vector<SpeedResponse> sweep(6);
  sweep[1].kept = sweep[2].kept = sweep[5].kept = false;
  const auto list = stretches(sweep);
  ASSERT_EQ(list.size(), 4U);
  EXPECT_EQ(list[1].begin, 1U);
  EXPECT_EQ(list[1].end, 3U);
  EXPECT_FALSE(list[1].kept);
  EXPECT_TRUE(list[2].kept);
  EXPECT_EQ(list[3].end, 6U);
}

// A rigid shaft pair under M cos φ on a wheel J: the speed oscillates by M/(J ω), at low speeds by more than itself.
TEST(OperatingSpeeds, OscillationOfTheSpeedIsThatOfTheClosedForm) {
  const Scene scene = scene_from(R"~(
line    = ["motor", "shaft", "wheel"]
motor   = { kind = "dc shunt motor", stall_torque = "0.001 N*m", no_load_speed = "100 rad/s", inertia = "0.5 kg*m2" }
shaft   = { kind = "shaft", stiffness = "1e9 N*m/rad", damping = "1 N*m*s/rad" }
wheel   = { kind = "torque source", inertia = "1.5 kg*m2", table = { over = "angle", formula = "A*cos(angle)", with = { A = "40 N*m" }, period = "6.283185307179586 rad" } }
effects = { elasticity = true }
run     = { start = { speed = "50 rad/s" } }
)~");
  ModesOptions options;
  options.speed = 50;
  const ModesStudy study = find_modes(scene, scene.effects, options);
  ASSERT_FALSE(study.sweep.empty());
  for (const SpeedResponse& s : study.sweep) {
    const double swing = 40 / (2.0 * s.speed);
    EXPECT_NEAR(s.speed_amplitude, swing, 1e-3 * swing) << s.speed;
    EXPECT_EQ(s.kept, s.speed_amplitude < s.speed) << s.speed;
  }
  EXPECT_TRUE(std::any_of(study.sweep.begin(), study.sweep.end(), [](const auto& s) { return !s.kept; }));
}

// Mains-fed compressor at 979 rpm: its motor breaks down below some 900 rpm. Nothing below is critical or barred, where
// the linear response says thousands of times what the coupling can carry.
TEST(OperatingSpeeds, NothingIsBarredWhereTheMachineCannotStay) {
  const Scene scene = scene_file("docs/tasks/two_cylinder_compressor.toml");
  const ModesStudy study = find_modes(scene, scene.effects, {});
  const auto is_kept = [&](double speed) {
    const auto nearest = std::min_element(study.sweep.begin(), study.sweep.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.speed - speed) < std::abs(b.speed - speed);
    });
    return nearest->kept;
  };
  EXPECT_TRUE(study.keeps_its_speed);
  EXPECT_FALSE(is_kept(75));
  EXPECT_TRUE(is_kept(std::abs(study.drive.at.speed)));
  for (const CriticalSpeed& c : study.critical) EXPECT_TRUE(is_kept(c.speed)) << c.speed;
  for (const BarredRange& range : study.barred) EXPECT_TRUE(is_kept(range.from) && is_kept(range.to)) << range.from;
  EXPECT_TRUE(std::any_of(study.notes.begin(), study.notes.end(), [](const std::string& note) {
    return note.find("the machine cannot run continuously") != std::string::npos;
  }));
}

// Equal cylinders at equal intervals: what they cancel is no order, whatever the kinks of their diagram.
TEST(CriticalSpeeds, OrdersThatEqualCylindersCancelAreNone) {
  for (const int cylinders : {2, 3, 5, 6, 7, 8, 9, 10, 12}) {
    std::string order = "1";
    for (int i = 2; i <= cylinders; ++i) order += fmt::format(", {}", i);
    const Scene scene = scene_from(fmt::format(R"~(
line = ["engine", "shaft", "wheel"]
engine = {{ kind = "engine", firing_order = [{}], inertia = "0.5 kg*m2", torque = {{ over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [17, 431], [38, 760], [71, 330], [123, 90], [180, 0], [541, -15], [630, -90], [691, -360], [720, 0]] }} }}
shaft = {{ kind = "shaft", stiffness = "20 kN*m/rad", damping = "15 N*m*s/rad" }}
wheel = {{ kind = "load", damping = "1 N*m*s/rad", inertia = "1.5 kg*m2" }}
effects = {{ elasticity = true }}
run = {{ start = {{ speed = "1500 rpm" }} }}
)~",
                                               order));
    const ModesStudy study = find_modes(scene, scene.effects, {});
    ASSERT_FALSE(study.critical.empty()) << cylinders;
    for (const CriticalSpeed& c : study.critical)
      EXPECT_NEAR(std::remainder(c.order, 0.5 * cylinders), 0, 1e-9) << cylinders << " cylinders, order " << c.order;
  }
}

}  // namespace
}  // namespace kurbel::test::critical_speeds_test
