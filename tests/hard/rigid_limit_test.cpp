// rigid_limit_test.cpp — the rigid model as the limit of the elastic one (theory 5.15): with smooth torques and
// constant damping ratios the motion comes nearer as 1/k; after a step the motion does so too, but the peak torque does
// not.
#include <fmt/format.h>

#include "studies/run/compare.h"
#include "tests/published/published.h"

namespace kurbel::rigid_limit_test {
namespace {

using test::figure;
using test::run;
using test::series;

// --- a press drive under a torque without steps or kinks: M₀ (1 − cos 2πft) ---

std::string press_drive(double times) {
  return fmt::format(R"(
line = ["motor", "motor_coupling", "gearbox", "main_coupling", "flywheel", "press"]
[motor]
kind = "torque source"
torque = "60 N*m"
amplitude = "60 N*m"
frequency = "2 Hz"
phase = "-90 deg"
inertia = "0.1 kg*m2"
[motor_coupling]
kind = "coupling"
stiffness = "{} N*m/rad"
damping_ratio = 0.06
[gearbox]
kind = "gearbox"
stages = [{{ teeth = [20, 100], inertia = ["0.01 kg*m2", "0.5 kg*m2"] }}]
[main_coupling]
kind = "coupling"
stiffness = "{} N*m/rad"
damping_ratio = 0.05
[flywheel]
kind = "flywheel"
inertia = "20 kg*m2"
[press]
kind = "slider-crank"
radius = "50 mm"
rod = "300 mm"
crank_inertia = "0.5 kg*m2"
rod_mass = "20 kg"
rod_inertia = "0.2 kg*m2"
slider_mass = "60 kg"
load = {{ kind = "medium", viscous = "500 N*s/m" }}
[run]
start = {{ speed = "5 rad/s" }}
until = "1.2 s"
accuracy = 1e-10
samples = 121
)",
                     2e3 * times, 1e5 * times);
}

TEST(RigidLimit, UnderSmoothTorqueTheMotionApproachesTheRigidOneAsOneOverStiffness) {
  const Scene scene = test::scene_from(press_drive(1));
  const Result rigid = simulate(scene, {}, "rigid", {});
  ASSERT_TRUE(rigid.complete) << rigid.diagnosis;
  std::vector<double> angle, speed;  // difference to the rigid run
  for (const double times : {1.0, 10.0, 100.0, 1000.0}) {
    const Result elastic = simulate(test::scene_from(press_drive(times)), {true, {}}, "elastic", {});
    ASSERT_TRUE(elastic.complete) << elastic.diagnosis;
    angle.push_back(figure(elastic, "final_angle.press") - figure(rigid, "final_angle.press"));
    speed.push_back(figure(elastic, "final_speed.press") - figure(rigid, "final_speed.press"));
  }
  for (std::size_t i = 1; i < angle.size(); ++i) {
    EXPECT_NEAR(angle[i - 1] / angle[i], 10, 1.5) << "stiffness × 10^" << i;
    EXPECT_NEAR(speed[i - 1] / speed[i], 10, 2.5) << "stiffness × 10^" << i;
  }
  EXPECT_NEAR(angle[2] / angle[3], 10, 0.5);
  EXPECT_GT(std::abs(angle[0]), 1e-4);  // there was something to converge
}

// The stiff machine carries what the rigid one transmits by d'Alembert.
TEST(RigidLimit, UnderSmoothTorqueThePeakTorqueApproachesTheRigidOne) {
  const Result rigid = simulate(test::scene_from(press_drive(1)), {}, "rigid", {});
  std::vector<double> difference;
  for (const double times : {1.0, 10.0, 100.0, 1000.0}) {
    const Result elastic = simulate(test::scene_from(press_drive(times)), {true, {}}, "elastic", {});
    difference.push_back(
        std::abs(figure(elastic, "peak_torque.main_coupling") / figure(rigid, "peak_torque.main_coupling") - 1));
  }
  for (std::size_t i = 1; i < difference.size(); ++i) EXPECT_LT(difference[i], 0.25 * difference[i - 1]) << i;
  EXPECT_LT(difference[3], 1e-4);
}

TEST(RigidLimit, ASmoothTorqueRaisesNoWarningOfSuddenLoads) {
  const Comparison c = compare(test::scene_from(press_drive(10)), {{}, {true, {}}, "rigid", "elastic"}, {});
  for (const std::string& note : c.notes) EXPECT_EQ(note.find("sudden"), std::string::npos) << note;
}

// --- two inertias, a step of torque on the first: M′ = M J₂/(J₁ + J₂) ---

constexpr double j1 = 0.4, j2 = 1.6, step = 50;
constexpr double rigid_torque = step * j2 / (j1 + j2), reduced = j1 * j2 / (j1 + j2);

std::string two_inertias(double stiffness, double damping_ratio, const std::string& start = "\"rest\"") {
  return fmt::format(R"(
line = ["source", "c", "driven"]
[source]
kind = "torque source"
torque = "{} N*m"
inertia = "{} kg*m2"
[c]
kind = "coupling"
stiffness = "{} N*m/rad"
damping_ratio = {}
[driven]
kind = "inertia"
inertia = "{} kg*m2"
[effects]
elasticity = true
[run]
until = "0.2 s"
samples = 2001
accuracy = 1e-10
start = {}
)",
                     step, j1, stiffness, damping_ratio, j2, start);
}

TEST(RigidLimit, AfterAStepThePeakTorqueStaysTwiceTheRigidOneWhileTheMotionConverges) {
  for (const double k : {1e3, 1e4, 1e5, 1e6}) {
    const Result r = run(two_inertias(k, 0));
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_NEAR(figure(r, "peak_torque.c"), 2 * rigid_torque, 1e-7 * rigid_torque) << k;
    // φ₂ = φ_rigid − J₁/(J₁ + J₂) θ with θ = M′/k (1 − cos ω_n t)
    const double natural = std::sqrt(k / reduced);
    const auto phi = series(r, "angle.driven");
    double largest = 0;
    for (std::size_t row = 0; row < phi.size(); ++row) {
      const double t = r.trajectory->time()[row], rigid = 0.5 * step / (j1 + j2) * t * t;
      const double twist = rigid_torque / k * (1 - std::cos(natural * t));
      EXPECT_NEAR(phi[row] - rigid, -j1 / (j1 + j2) * twist, 1e-4 * rigid_torque / k) << "k = " << k << ", t = " << t;
      largest = std::max(largest, std::abs(phi[row] - rigid));
    }
    EXPECT_NEAR(largest, j1 / (j1 + j2) * 2 * rigid_torque / k, 1e-2 * rigid_torque / k);
  }
}

// With little damping: θ = M′/k (1 − e^{−ζω_n t}(cos ω_d t + ζ/√(1−ζ²) sin ω_d t)); the spring's first peak overshoots
// by e^{−πζ/√(1−ζ²)}.
TEST(RigidLimit, TinyDampingTakesLittleFromTheDoubledPeakAtAnyStiffness) {
  const double zeta = 0.01, overshoot = std::exp(-std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta));
  for (const double k : {1e3, 1e4, 1e5, 1e6})
    EXPECT_NEAR(figure(run(two_inertias(k, zeta)), "peak_spring_torque.c"), rigid_torque * (1 + overshoot),
                1e-7 * rigid_torque)
        << k;
}

// A travel Δ closed first by the free J₁ gives it ω₁ = √(2MΔ/J₁) at contact: peak M′ (1 + √(1 + 2kΔ/M′)).
TEST(RigidLimit, TravelToCloseFirstRaisesThePeakWithTheRootOfTheStiffness) {
  for (const double k : {1e3, 1e4, 1e5, 1e6}) {
    const double travel = 2e-3, speed = std::sqrt(2 * step * travel / j1);
    const Result r = run(two_inertias(k, 0, fmt::format("{{ source = {{ speed = \"{} rad/s\" }} }}", speed)));
    const double peak = rigid_torque * (1 + std::sqrt(1 + 2 * k * travel / rigid_torque));
    EXPECT_NEAR(figure(r, "peak_torque.c"), peak, 1e-7 * peak) << k;
  }
}

TEST(RigidLimit, ComparisonSaysThatAStepDoublesThePeakTorque) {
  const Comparison c = compare(test::scene_from(two_inertias(1e5, 0.001)), {{}, {true, {}}, "rigid", "elastic"}, {});
  ASSERT_EQ(c.amplification.size(), 1u);
  EXPECT_NEAR(c.amplification[0].b->value, 2, 0.01);
  const bool said = std::any_of(c.notes.begin(), c.notes.end(), [](const std::string& note) {
    return note.find("sudden loads") != std::string::npos && note.find("by up to a factor of two") != std::string::npos;
  });
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace kurbel::rigid_limit_test
