// methods_agree_test.cpp — every integrator gives the same machine, within the errors that it states itself.
#include <cmath>

#include "tests/support/scenes.h"

namespace kurbel::methods_agree_test {
namespace {

// Prescribed speed with a sine on it, elastic coupling, variable inertia, resistance of the medium: work done by the
// prescribed motion is a quadrature that feeds nothing back, so nothing but its own error control looks after it.
TEST(Methods, AgreeOnAPrescribedElasticMachineWithinTheirErrors) {
  Scene scene = test::scene_from(R"(
line = ["drive", "c", "crank"]
[drive]
kind = "prescribed speed"
speed = "20 rad/s"
amplitude = "2 rad/s"
frequency = "3 Hz"
[c]
kind = "coupling"
stiffness = "50 kN*m/rad"
damping_ratio = 0.05
[crank]
kind = "slider-crank"
radius = "50 mm"
rod = "200 mm"
crank_inertia = "0.2 kg*m2"
slider_mass = "2 kg"
load = { kind = "medium", viscous = "90 N*s/m" }
[effects]
elasticity = true
[run]
start = { speed = "20 rad/s", equilibrium = true }
until = "1 s"
accuracy = 1e-5
)");
  scene.run.method = "dop853";
  const Result reference = test::run(scene);
  for (const char* method : {"dopri5", "verner6", "esdirk3", "esdirk", "esdirk5", "bdf", "adams"}) {
    scene.run.method = method;
    const Result r = test::run(scene);
    EXPECT_TRUE(r.accuracy_confirmed) << method;
    EXPECT_LE(r.energy.relative, 1e-6) << method;
    for (const char* name : {"peak_torque.c", "work.driving", "work.useful", "final_speed.crank"}) {
      // The error stated is that of the looser run; twice that and round-off must hold.
      const double stated = *r.find(name)->error + *reference.find(name)->error;
      const double scale = std::abs(test::figure(reference, name));
      EXPECT_NEAR(test::figure(r, name), test::figure(reference, name), 2 * stated + 1e-7 * scale)
          << method << " " << name;
    }
  }
}

// Its error estimate sees nothing of what time drives: refused in words rather than wrong.
TEST(Methods, FehlbergIsRefusedWhereTimeDrives) {
  Scene scene = test::scene_from(R"(
line = ["motor", "disc"]
motor = { kind = "torque source", torque = "3 N*m", amplitude = "10 N*m", frequency = "2 Hz" }
disc = { kind = "flywheel", inertia = "1 kg*m2" }
run = { until = "1 s" }
)");
  scene.run.method = "fehlberg8";
  try {
    test::run(scene);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(),
                 "test.toml:5:1: method \"fehlberg8\": the torque of \"motor\" depends on time, and its error estimate "
                 "misses "
                 "what depends on time alone; choose dop853 or verner6");
  }
}

// E1's peak spring torque: 290.808843395416 N·m (tests/cases/reference.toml).
TEST(Methods, FehlbergAndVernerFindThePeakOfTheChain) {
  Scene scene = test::scene_file("scenes/six_inertia_chain.toml");
  for (const char* method : {"verner6", "fehlberg8", "esdirk3", "esdirk5"}) {
    scene.run.method = method;
    scene.run.accuracy = 1e-8;
    const Result r = test::run(scene);
    EXPECT_NEAR(std::abs(test::figure(r, "peak_spring_torque.c1")), 290.808843395416, 3e-5) << method;
  }
}

}  // namespace
}  // namespace kurbel::methods_agree_test
