// multibody_run.cpp — forward dynamics of the closed loop by Simbody's own integrators (C++17 island).
#include "mechanisms/linkages/multibody_run.h"

#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>

#include "mechanisms/linkages/slider_crank_system.h"

namespace kurbel {

using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Vec3;
using SimTK::Vector;
using SimTK::Vector_;

namespace {

template <class Integrator>
std::unique_ptr<SimTK::Integrator> make(const SimTK::System& system) {
  return std::make_unique<Integrator>(system);
}

struct IntegratorChoice {
  const char* name;
  std::unique_ptr<SimTK::Integrator> (*make)(const SimTK::System&);
};

const IntegratorChoice integrators[] = {
    {"RungeKuttaMerson", make<SimTK::RungeKuttaMersonIntegrator>},
    {"RungeKuttaFeldberg", make<SimTK::RungeKuttaFeldbergIntegrator>},
    {"RungeKutta3", make<SimTK::RungeKutta3Integrator>},
    {"RungeKutta2", make<SimTK::RungeKutta2Integrator>},
    {"Verlet", make<SimTK::VerletIntegrator>},
    {"SemiExplicitEuler2", make<SimTK::SemiExplicitEuler2Integrator>},
    {"ExplicitEuler", make<SimTK::ExplicitEulerIntegrator>},
    {"CPodes", make<SimTK::CPodesIntegrator>},
};

std::unique_ptr<SimTK::Integrator> make_integrator(const std::string& name, const SimTK::System& system) {
  std::string valid;
  for (const IntegratorChoice& choice : integrators) {
    if (name == choice.name) return choice.make(system);
    valid += std::string(valid.empty() ? "" : ", ") + choice.name;
  }
  throw std::invalid_argument(fmt::format("multibody run: unknown integrator \"{}\"; valid: {}", name, valid));
}

// The user's torque and force. Simbody's integrators take an exception for a step that failed and try a shorter one: it
// is kept for the end, and thrown again whatever they try.
class AppliedForces : public SimTK::Force::Custom::Implementation {
 public:
  AppliedForces(const MultibodyProblem& problem, const SliderCrankSystem& bodies, std::exception_ptr& error)
      : problem_(problem), bodies_(bodies), error_(error) {}

  void calcForce(const State& state, Vector_<SpatialVec>& body_forces, Vector_<Vec3>&,
                 Vector& mobility_forces) const override {
    if (error_) std::rethrow_exception(error_);
    const Vec3 end(bodies_.data.rod_length, 0, 0);
    try {
      if (problem_.shaft_torque)
        bodies_.crank.applyOneMobilityForce(
            state, 0,
            problem_.shaft_torque(state.getTime(), bodies_.crank.getAngle(state), bodies_.crank.getRate(state)),
            mobility_forces);
      if (problem_.slider_force) {
        const double x = bodies_.rod.findStationLocationInGround(state, end)[0];
        const double v = bodies_.rod.findStationVelocityInGround(state, end)[0];
        bodies_.rod.applyForceToBodyPoint(state, end, Vec3(problem_.slider_force(state.getTime(), x, v), 0, 0),
                                          body_forces);
      }
    } catch (...) {
      error_ = std::current_exception();
      throw;
    }
  }
  double calcPotentialEnergy(const State&) const override { return 0; }

 private:
  const MultibodyProblem& problem_;
  const SliderCrankSystem& bodies_;
  std::exception_ptr& error_;
};

void validate(const MultibodyProblem& p) {
  const auto require = [](bool holds, const char* what, double got, const char* domain) {
    if (!holds) throw std::invalid_argument(fmt::format("multibody run: {} = {}; must be {}", what, got, domain));
  };
  require(p.shaft_inertia >= 0, "shaft_inertia", p.shaft_inertia, ">= 0 kg m2");
  require(std::isfinite(p.phi0), "phi0", p.phi0, "finite");
  require(std::isfinite(p.omega0), "omega0", p.omega0, "finite");
  require(p.t_end > 0 && std::isfinite(p.t_end), "t_end", p.t_end, "> 0 s");
  require(p.accuracy > 0 && p.accuracy < 1, "accuracy", p.accuracy, "between 0 and 1");
  double last = 0;
  for (const double t : p.times) {
    require(t >= last && t <= p.t_end, "a report time", t, "ascending within 0 ... t_end");
    last = t;
  }
}

MultibodySample observe(const SliderCrankSystem& bodies, const State& state) {
  bodies.system.realize(state, SimTK::Stage::Velocity);
  const Vec3 end(bodies.data.rod_length, 0, 0);
  const MultibodySample sample{state.getTime(),
                               bodies.crank.getAngle(state),
                               bodies.crank.getRate(state),
                               bodies.rod.findStationLocationInGround(state, end)[0],
                               bodies.rod.findStationVelocityInGround(state, end)[0],
                               bodies.matter.calcKineticEnergy(state)};
  if (!std::isfinite(sample.phi + sample.omega + sample.x + sample.v + sample.kinetic_energy))
    throw std::runtime_error(fmt::format("multibody run: non-finite state at t = {:.9g} s: phi = {}, omega = {}",
                                         sample.t, sample.phi, sample.omega));
  const double rod_angle = state.getQ()[0] + state.getQ()[1];
  if (!(std::cos(rod_angle) > 0))
    throw std::runtime_error(
        fmt::format("multibody run: the rod turned over at t = {:.9g} s: cos(beta) = {:.3g}, must "
                    "be > 0 (phi = {:.9g} rad)",
                    sample.t, std::cos(rod_angle), sample.phi));
  return sample;
}

}  // namespace

std::vector<std::string> multibody_integrators() {
  std::vector<std::string> names;
  for (const IntegratorChoice& choice : integrators) names.emplace_back(choice.name);
  return names;
}

MultibodyResult run_multibody(const MultibodyProblem& problem) {
  validate(problem);
  const SliderCrankData& data = problem.mechanism;

  // Bodies, weights, applied forces.
  SliderCrankSystem bodies(data, problem.shaft_inertia);
  std::exception_ptr error;
  if (data.gravity != 0)
    SimTK::Force::UniformGravity(bodies.forces, bodies.matter,
                                 -data.gravity * Vec3(std::sin(data.stroke_angle), std::cos(data.stroke_angle), 0));
  SimTK::Force::Custom(bodies.forces, new AppliedForces(problem, bodies, error));  // Simbody owns and deletes it

  // A closed and consistent start.
  State state = bodies.realize_topology();
  const Reduction start = bodies.reduce_at(state, problem.phi0);
  state.updU() = problem.omega0 * start.q1;

  const std::unique_ptr<SimTK::Integrator> integrator = make_integrator(problem.integrator, bodies.system);
  integrator->setAccuracy(problem.accuracy);
  // Projecting only when the loop leaves its tolerance disturbs the energy less than projecting after every step: on a
  // free slider-crank over 47 turns the angle comes out several times as accurate for the same CPU time. A tolerance
  // wider than a tenth of the accuracy stalls Verlet.
  integrator->setConstraintTolerance(problem.accuracy / 10);
  integrator->setAllowInterpolation(false);
  integrator->setInternalStepLimit(std::numeric_limits<int>::max());
  integrator->setUseInfinityNorm(true);
  integrator->setFinalTime(problem.t_end);

  MultibodyResult result;
  const std::vector<double> times = problem.times.empty() ? std::vector<double>{problem.t_end} : problem.times;
  try {
    integrator->initialize(state);
    for (const double t : times) {
      while (integrator->getTime() < t) integrator->stepTo(t);
      if (error) std::rethrow_exception(error);
      result.samples.push_back(observe(bodies, integrator->getState()));
    }
  } catch (const std::exception& failure) {
    if (error) std::rethrow_exception(error);
    throw std::runtime_error(fmt::format("multibody run ({}, accuracy {:g}) failed: {}", problem.integrator,
                                         problem.accuracy, failure.what()));
  }
  result.steps = integrator->getNumStepsTaken();
  result.rejected = integrator->getNumStepsAttempted() - integrator->getNumStepsTaken();
  result.evaluations = integrator->getNumRealizations();
  return result;
}

}  // namespace kurbel
