// simbody_loops.cpp — the slider-crank as a user of Simbody writes it: crank, rod, slider, and a ball joint that closes
// the loop (C++17 island).
#include "bench/peers/simbody_loops.h"

#include <Simbody.h>

#include <cmath>
#include <limits>
#include <memory>

namespace kurbel::bench {

using namespace SimTK;

SimbodyEnd simbody_r1_with_slider(const std::string& name, double accuracy) {
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  const double r = 0.1, l = 0.35, s2 = 0.1225;
  const auto flat = [](double about_z) { return Inertia(about_z / 2, about_z / 2, about_z); };
  const Body::Rigid crank_body(MassProperties(1, Vec3(0), flat(0.55)));
  const Body::Rigid rod_body(MassProperties(2, Vec3(s2, 0, 0), flat(0.02).shiftFromMassCenter(Vec3(s2, 0, 0), 2)));
  const Body::Rigid slider_body(MassProperties(3, Vec3(0), Inertia(0.01)));
  MobilizedBody::Pin crank(matter.Ground(), Transform(), crank_body, Transform());
  MobilizedBody::Pin rod(crank, Transform(Vec3(r, 0, 0)), rod_body, Transform());
  MobilizedBody::Slider slider(matter.Ground(), Transform(), slider_body, Transform());
  Constraint::Ball(rod, Vec3(l, 0, 0), slider, Vec3(0));

  system.realizeTopology();
  State state = system.getDefaultState();
  slider.setLength(state, r + l);
  crank.setRate(state, 30);
  rod.setRate(state, -30 * (1 + r / l));  // relative to the crank, extended dead centre
  slider.setRate(state, 0);

  std::unique_ptr<Integrator> integrator;
  if (name == "CPodes")
    integrator = std::make_unique<CPodesIntegrator>(system);
  else if (name == "RungeKuttaFeldberg")
    integrator = std::make_unique<RungeKuttaFeldbergIntegrator>(system);
  else
    integrator = std::make_unique<RungeKuttaMersonIntegrator>(system);
  integrator->setAccuracy(accuracy);
  integrator->setConstraintTolerance(accuracy / 10);
  integrator->setAllowInterpolation(false);
  integrator->setInternalStepLimit(std::numeric_limits<int>::max());
  integrator->setUseInfinityNorm(true);
  integrator->setFinalTime(10);
  integrator->initialize(state);
  while (integrator->getTime() < 10) integrator->stepTo(10);
  return {crank.getAngle(integrator->getState()), integrator->getNumStepsTaken()};
}

}  // namespace kurbel::bench
