// drive_torques_test.cpp — what drives a machine, in figures and columns: a prescribed shaft's torque and power by closed
// forms, peaks of motors; and efficiencies of what does not close.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "studies/duty/work_periods.h"
#include "tests/support/scenes.h"

namespace kurbel::drive_torques_test {
namespace {

using test::figure;

std::vector<double> column(const Result& r, const std::string& name) {
  std::vector<double> values;
  const auto& channels = r.trajectory->channels();
  for (std::size_t k = 0; k < channels.size(); ++k)
    if (channels[k].name.text == name)
      for (std::size_t row = 0; row < r.trajectory->time().size(); ++row) values.push_back(r.trajectory->value(row, k));
  return values;
}

// ω = ω₀ + a sin Ωt on J with a load M: torque M + J a Ω cos Ωt, power that times ω, over whole periods.
TEST(DriveOfAPrescribedShaft, BringsWhatItsInertiaAndItsLoadTake) {
  const double J = 0.7, M = 30, w0 = 20, a = 2, W = 2 * M_PI * 5;
  for (const char* coupling : {"", "\"coupling\", "}) {
    const Result r = test::run(std::string("line = [\"drive\", ") + coupling + R"("rotor"]
drive = { kind = "prescribed speed", speed = "20 rad/s", amplitude = "2 rad/s", frequency = "5 Hz", inertia = "0.2 kg*m2" }
rotor = { kind = "load", torque = "30 N*m", acts = "always", inertia = "0.5 kg*m2" }
)" + (*coupling ? "coupling = { kind = \"coupling\", stiffness = \"1 MN*m/rad\" }\n" : "") +
                               "run = { until = \"2 s\", samples = 401, accuracy = 1e-8 }\n");
    ASSERT_TRUE(r.complete) << r.diagnosis;
    EXPECT_TRUE(r.accuracy_confirmed);
    EXPECT_NEAR(figure(r, "motor_peak_torque.drive"), M + J * a * W, 1e-6);
    EXPECT_NEAR(figure(r, "motor_rms_torque.drive"), std::sqrt(M * M + std::pow(J * a * W, 2) / 2), 1e-6);
    EXPECT_NEAR(figure(r, "motor_mean_power.drive"), M * w0, 1e-5);
    double peak = 0;
    for (double t = 0; t < 0.2; t += 1e-6)
      peak = std::max(peak, (M + J * a * W * std::cos(W * t)) * (w0 + a * std::sin(W * t)));
    EXPECT_NEAR(figure(r, "motor_peak_power.drive"), peak, 1e-4);
    const std::vector<double> torque = column(r, "torque.drive"), power = column(r, "power.drive");
    ASSERT_EQ(torque.size(), r.trajectory->time().size());
    ASSERT_EQ(power.size(), torque.size());
    for (std::size_t row = 0; row < torque.size(); ++row) {
      const double t = r.trajectory->time()[row], expected = M + J * a * W * std::cos(W * t);
      EXPECT_NEAR(torque[row], expected, 1e-6);
      EXPECT_NEAR(power[row], expected * (w0 + a * std::sin(W * t)), 1e-5);
    }
  }
}

// Nothing but the load's edges keeps the steps of such a machine short: every stroke does the load's work, wherever it begins.
TEST(DriveOfAPrescribedShaft, DoesTheWorkOfEveryStroke) {
  for (const int start : {0, 60, 170, 180, 181, 300, 359})
    for (const char* speed : {"20 rpm", "-20 rpm"}) {
      const Result r = test::run(fmt::format(R"(
line = ["drive", "press"]
drive = {{ kind = "prescribed speed", speed = "{0}" }}
press = {{ kind = "slider-crank", radius = "75 mm", rod = "900 mm", load = {{ kind = "press", nominal_force = "6300 kN", nominal_travel = "13 mm" }} }}
run = {{ start = {{ speed = "{0}", angle = "{1} deg" }}, until = "12 s" }}
)",
                                             speed, start));
      EXPECT_NEAR(figure(r, "work.useful"), -4 * 6300e3 * 0.013, 1) << start << " " << speed;
    }
}

// A crank at constant speed: m x′ x″ ω² for the slider, −F x′ for a force F on it.
TEST(DriveOfAPrescribedShaft, OfACrankAtGivenSpeedIsKnownFromItsGeometry) {
  const double radius = 0.05, rod = 0.42, mass = 340, force = -20e3, w = 6;
  const Scene scene = test::scene_from(R"(
line = ["drive", "press"]
drive = { kind = "prescribed speed", speed = "6 rad/s" }
press = { kind = "slider-crank", radius = "50 mm", rod = "420 mm", slider_mass = "340 kg", gravity = "0 m/s2", load = { kind = "constant", force = "-20 kN" } }
run = { until = "3 s", accuracy = 1e-7, start = { speed = "6 rad/s" } }
)");
  const Result r = test::run(scene);
  ASSERT_TRUE(r.complete) << r.diagnosis;
  double peak = 0, square = 0;
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double phi = 2 * M_PI * i / count, s = radius * std::sin(phi), c = radius * std::cos(phi);
    const double q = std::sqrt(rod * rod - s * s);  // x = c + q, q q′ = −s c
    const double slope = -s - s * c / q, bend = -c - ((c * c - s * s) * q + s * c * s * c / q) / (q * q);
    const double torque = mass * slope * bend * w * w - force * slope;
    if (std::abs(torque) > std::abs(peak)) peak = torque;
    square += torque * torque / count;
  }
  EXPECT_NEAR(std::abs(figure(r, "motor_peak_torque.drive")), std::abs(peak), 1e-6 * std::abs(peak));
  const Result whole = test::run_until(scene, 4 * M_PI / w);
  EXPECT_NEAR(figure(whole, "motor_rms_torque.drive"), std::sqrt(square), 1e-6 * std::sqrt(square));
}

TEST(PeaksOfMotors, AreThoseOfTheirLaws) {
  const Result shunt = test::run(R"(
line = ["motor", "wheel"]
motor = { kind = "dc shunt motor", voltage = "220 V", resistance = "0.5 Ohm", constant = "2 N*m/A", inertia = "0.1 kg*m2" }
wheel = { kind = "inertia", inertia = "1 kg*m2" }
run = { until = "1 s" }
)");
  EXPECT_NEAR(figure(shunt, "motor_peak_torque.motor"), 880, 1e-6);  // from rest: k U/R
  EXPECT_NEAR(figure(shunt, "motor_peak_current.motor"), 440, 1e-6);

  const Result series = test::run(R"(
line = ["motor", "wheel"]
motor = { kind = "dc series motor", voltage = "220 V", resistance = "0.5 Ohm", constant = "0.02 N*m/A2", inertia = "0.1 kg*m2", max_speed = "1000 rad/s" }
wheel = { kind = "inertia", inertia = "10 kg*m2" }
run = { until = "1 s" }
)");
  EXPECT_NEAR(figure(series, "motor_peak_torque.motor"), 0.02 * 440 * 440, 1e-5);
  EXPECT_NEAR(figure(series, "motor_peak_current.motor"), 440, 1e-6);
}

TEST(PeaksOfMotors, OfTheTwoAxisModelAreTheLengthOfItsCurrent) {
  Scene scene = test::scene_file("tests/agreement/two_axis_motor.toml");
  scene.run.until = 0.2;
  scene.run.samples = 20001;
  const Result r = test::run(scene, false);
  const std::vector<double> d = column(r, "stator_current_d.motor"), q = column(r, "stator_current_q.motor");
  ASSERT_EQ(d.size(), 20001u);
  double peak = 0;
  for (std::size_t row = 0; row < d.size(); ++row) peak = std::max(peak, std::hypot(d[row], q[row]));
  EXPECT_NEAR(figure(r, "motor_peak_current.motor"), peak, 1e-4 * peak);
  const std::vector<double> torque = column(r, "torque.motor");
  const double most = std::abs(
      *std::max_element(torque.begin(), torque.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  EXPECT_NEAR(std::abs(figure(r, "motor_peak_torque.motor")), most, 1e-4 * most);
}

// What is spent: driving work, that of weights, what stored energy gives. A run-down had an efficiency of 528 %.
TEST(Efficiency, CountsTheChangeOfStoredEnergy) {
  EXPECT_NEAR(*efficiency_of(100, -80, 0, 0), 0.8, 1e-15);
  EXPECT_NEAR(*efficiency_of(10, -80, 0, -90), 0.8, 1e-15);  // of 100 J that were spent, 90 J stored before
  EXPECT_NEAR(*efficiency_of(200, -80, 0, 100), 0.8, 1e-15);
  EXPECT_NEAR(*efficiency_of(0, -60, 100, 0), 0.6, 1e-15);
  EXPECT_FALSE(efficiency_of(100, 0, 0, 0));
  EXPECT_FALSE(efficiency_of(100, -1e-10, 0, 0)) << "rounding is no useful work";
  EXPECT_FALSE(efficiency_of(50, -10, 0, 60));

  const Result r = test::run(test::scene_file("tests/cases/reports/motor_switched_off.toml"), false);
  const double steady = figure(r, "machine_efficiency");
  for (const char* period : {"run_up", "steady_motion", "run_down"}) {
    const auto of = [&](const char* what) { return figure(r, std::string("work_of_") + period + "." + what); };
    const auto efficiency = efficiency_of(of("driving"), of("useful"), of("weight"), of("energy"));
    if (std::string(period) == "run_up") {  // it is over before the first stroke's work
      EXPECT_FALSE(efficiency);
      continue;
    }
    ASSERT_TRUE(efficiency) << period;
    EXPECT_GT(*efficiency, 0) << period;
    EXPECT_LT(*efficiency, 1) << period;
    if (std::string(period) == "steady_motion") {
      EXPECT_NEAR(*efficiency, steady, 1e-3);
    }
  }
  EXPECT_EQ(figure(r, "work_of_run_down.driving"), 0);
  EXPECT_LT(figure(r, "work_of_run_down.useful"), 0);
}

}  // namespace
}  // namespace kurbel::drive_torques_test
