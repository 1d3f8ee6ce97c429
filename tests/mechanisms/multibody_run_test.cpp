// multibody_run_test.cpp — the full multibody run against the reduced equation of motion (theory 2.4) in Runge-Kutta
// steps.
#include "mechanisms/bodies/multibody_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "mechanisms/reduced/mechanism_data.h"
#include "tests/mechanisms/mechanism_examples.h"
#include "tests/mechanisms/slider_crank_geometry.h"

namespace kurbel::multibody_run_test {
namespace {

struct CrankState {
  double phi, omega;
};

// theory 2.4 with the closed form, 10⁴ classical Runge-Kutta steps a second.
CrankState reduced_run(const MultibodyProblem& p, const SliderCrankData& data, double t_end) {
  const SliderCrankGeometry geometry(data);
  const auto rate = [&](double t, CrankState y) -> CrankState {
    const auto inertia = geometry.inertia(y.phi);
    const auto slider = geometry.slider(y.phi);
    double torque = geometry.gravity_torque(y.phi).value - inertia.slope * y.omega * y.omega / 2;
    if (p.shaft_torque) torque += p.shaft_torque(t, y.phi, y.omega);
    if (p.load) torque += p.load(t, slider.value, slider.slope * y.omega) * slider.slope;
    return {y.omega, torque / (inertia.value + p.shaft_inertia)};
  };
  const auto moved = [](CrankState y, CrankState k, double h) -> CrankState {
    return {y.phi + h * k.phi, y.omega + h * k.omega};
  };
  const int steps = static_cast<int>(std::lround(t_end * 1e4));
  const double h = t_end / steps;
  CrankState y{p.phi0, p.omega0};
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const CrankState k1 = rate(t, y), k2 = rate(t + h / 2, moved(y, k1, h / 2)),
                     k3 = rate(t + h / 2, moved(y, k2, h / 2)), k4 = rate(t + h, moved(y, k3, h));
    y.phi += h / 6 * (k1.phi + 2 * k2.phi + 2 * k3.phi + k4.phi);
    y.omega += h / 6 * (k1.omega + 2 * k2.omega + 2 * k3.omega + k4.omega);
  }
  return y;
}

TEST(MultibodyRun, FreeSliderCrankFollowsTheReducedEquation) {
  MultibodyProblem p;
  p.mechanism = MechanismData(reference_mechanism()).bodies_of();
  p.omega0 = 30;
  p.t_end = 1;
  p.accuracy = 1e-9;
  p.times = {0, 0.25, 1};
  const auto samples = run_multibody(p).samples;
  ASSERT_EQ(samples.size(), 3u);
  const SliderCrankGeometry geometry(reference_mechanism());
  for (const MultibodySample& s : samples) {
    const CrankState expected = s.t == 0 ? CrankState{0, 30} : reduced_run(p, reference_mechanism(), s.t);
    EXPECT_NEAR(s.phi, expected.phi, 1e-6) << s.t;
    EXPECT_NEAR(s.omega, expected.omega, 1e-6) << s.t;
    EXPECT_NEAR(s.x, geometry.slider(s.phi).value, 1e-9);
    EXPECT_NEAR(s.v, geometry.slider(s.phi).slope * s.omega, 1e-7);
    EXPECT_NEAR(s.kinetic_energy, 252.037193877551, 1e-6);
  }
  EXPECT_EQ(samples[1].t, 0.25);
  EXPECT_GT(samples[2].phi, 29);  // not wrapped
}

TEST(MultibodyRun, DrivenMachineUnderGravityFollowsTheReducedEquation) {
  MultibodyProblem p;
  const SliderCrankData data = full_mechanism(2, 0.03);
  p.mechanism = MechanismData(data).bodies_of();
  p.shaft_inertia = 0.3;
  p.phi0 = 0.4;
  p.omega0 = 5;
  p.t_end = 0.8;
  p.accuracy = 1e-9;
  p.shaft_torque = [](double t, double phi, double omega) {
    return 60 * (1 - omega / 40) + 5 * std::sin(3 * t) + 4 * std::cos(phi);
  };
  p.load = [](double t, double x, double v) { return -80 * v - 300 * (x - 0.2) + 10 * t; };
  const MultibodySample end = run_multibody(p).samples.back();
  const CrankState expected = reduced_run(p, data, p.t_end);
  EXPECT_NEAR(end.phi, expected.phi, 2e-7);
  EXPECT_NEAR(end.omega, expected.omega, 2e-6);
  EXPECT_NEAR(end.kinetic_energy, (SliderCrankGeometry(data).inertia(end.phi).value + 0.3) * end.omega * end.omega / 2,
              1e-6);
}

// Methods of order 1 to 5 at their own pace, all on the same quarter turn.
TEST(MultibodyRun, EveryIntegratorArrives) {
  MultibodyProblem p;
  p.mechanism = MechanismData(reference_mechanism()).bodies_of();
  p.omega0 = 30;
  p.t_end = 0.05;
  p.accuracy = 1e-5;
  const CrankState expected = reduced_run(p, reference_mechanism(), p.t_end);
  for (const std::string& name : multibody_integrators()) {
    p.integrator = name;
    EXPECT_NEAR(run_multibody(p).samples.back().phi, expected.phi, 3e-3) << name;
  }
}

TEST(MultibodyRun, UnknownIntegratorIsAnsweredWithTheList) {
  MultibodyProblem p;
  p.mechanism = MechanismData(reference_mechanism()).bodies_of();
  p.t_end = 1;
  p.integrator = "Euler";
  try {
    run_multibody(p);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("\"Euler\"; valid: RungeKuttaMerson, "), std::string::npos)
        << error.what();
  }
}

TEST(MultibodyRun, TroubleInATorqueReachesTheCaller) {
  MultibodyProblem p;
  p.mechanism = MechanismData(reference_mechanism()).bodies_of();
  p.omega0 = 10;
  p.t_end = 0.1;
  p.shaft_torque = [](double t, double, double) -> double {
    if (t > 0.05) throw std::domain_error("no torque after 0.05 s");
    return 1;
  };
  EXPECT_THROW(run_multibody(p), std::domain_error);
  p.shaft_torque = [](double t, double, double) { return t > 0.05 ? NAN : 1.0; };
  EXPECT_THROW(run_multibody(p), std::runtime_error);
}

// Simbody's integrators try a shorter step where one throws; trouble reported once is trouble all the same.
TEST(MultibodyRun, TroubleThatIsReportedOnlyOnceReachesTheCallerByEveryIntegrator) {
  MultibodyProblem p;
  p.mechanism = MechanismData(reference_mechanism()).bodies_of();
  p.omega0 = 10;
  p.t_end = 0.06;
  p.accuracy = 1e-3;
  for (const std::string& name : multibody_integrators()) {
    p.integrator = name;
    bool reported = false;
    p.shaft_torque = [&](double t, double, double) -> double {
      if (t > 0.05 && !std::exchange(reported, true)) throw std::domain_error("no torque just now");
      return 1;
    };
    EXPECT_THROW(run_multibody(p), std::domain_error) << name;
  }
}

TEST(MultibodyRun, RefusesSenselessProblems) {
  MultibodyProblem p;
  p.mechanism = MechanismData(reference_mechanism()).bodies_of();
  EXPECT_THROW(run_multibody(p), std::invalid_argument);  // no end
  p.t_end = 1;
  p.times = {0.5, 0.2};
  EXPECT_THROW(run_multibody(p), std::invalid_argument);
  p.times = {2};
  EXPECT_THROW(run_multibody(p), std::invalid_argument);
}

}  // namespace
}  // namespace kurbel::multibody_run_test
