// multibody_run.cpp — forward dynamics of the closed loop by Simbody's own integrators (C++17 island).
#include "mechanisms/bodies/multibody_run.h"

#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>

#include "mechanisms/bodies/planar_system.h"
#include "mechanisms/bodies/simbody_module.h"

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

// The user's torque and load. Simbody's integrators take an exception for a step that failed and try a shorter one: it
// is kept for the end, and thrown again whatever they try.
class AppliedForces : public SimTK::Force::Custom::Implementation {
 public:
  AppliedForces(const MultibodyProblem& problem, const PlanarSystem& bodies, std::exception_ptr& error)
      : problem_(problem), bodies_(bodies), error_(error) {}

  void calcForce(const State& state, Vector_<SpatialVec>& body_forces, Vector_<Vec3>&,
                 Vector& mobility_forces) const override {
    if (error_) std::rethrow_exception(error_);
    try {
      if (problem_.shaft_torque)
        bodies_.crank().applyOneMobilityForce(
            state, 0, problem_.shaft_torque(state.getTime(), state.getQ()[0], state.getU()[0]), mobility_forces);
      if (problem_.load) {
        const TrackedPoint& output = bodies_.points[bodies_.output_point];
        const SimTK::MobilizedBody& body = bodies_.matter.getMobilizedBody(output.body);
        const double load = problem_.load(state.getTime(), bodies_.output_position(state), bodies_.output_speed(state));
        if (bodies_.output_coordinates.empty())
          body.applyForceToBodyPoint(state, output.station, Vec3(load, 0, 0), body_forces);
        else
          body.applyBodyTorque(state, Vec3(0, 0, load), body_forces);
      }
    } catch (...) {
      error_ = std::current_exception();
      throw;
    }
  }
  double calcPotentialEnergy(const State&) const override { return 0; }

 private:
  const MultibodyProblem& problem_;
  const PlanarSystem& bodies_;
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

MultibodySample observe(const PlanarSystem& bodies, const State& state) {
  bodies.system.realize(state, SimTK::Stage::Velocity);
  const MultibodySample sample{state.getTime(),
                               state.getQ()[0],
                               state.getU()[0],
                               bodies.output_position(state),
                               bodies.output_speed(state),
                               bodies.matter.calcKineticEnergy(state)};
  if (!std::isfinite(sample.phi + sample.omega + sample.x + sample.v + sample.kinetic_energy))
    throw std::runtime_error(fmt::format("multibody run: non-finite state at t = {:.9g} s: phi = {}, omega = {}",
                                         sample.t, sample.phi, sample.omega));
  bodies.check_branch(state);
  return sample;
}

}  // namespace

std::vector<std::string> simbody::multibody_integrators() {
  std::vector<std::string> names;
  for (const IntegratorChoice& choice : integrators) names.emplace_back(choice.name);
  return names;
}

MultibodyResult simbody::run_multibody(const MultibodyProblem& problem) {
  validate(problem);

  // Bodies, weights, applied forces.
  const std::unique_ptr<PlanarSystem> made = planar_system(problem.mechanism, problem.shaft_inertia);
  PlanarSystem& bodies = *made;
  std::exception_ptr error;
  if (bodies.gravity != 0) SimTK::Force::UniformGravity(bodies.forces, bodies.matter, -bodies.gravity * bodies.up());
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
