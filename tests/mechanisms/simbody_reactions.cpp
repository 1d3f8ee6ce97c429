// simbody_reactions.cpp — the slider-crank with a slider body of its own, and the others, realised by Simbody (C++17
// island).
#include "tests/mechanisms/simbody_reactions.h"

#include <Simbody.h>
#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "mechanisms/bodies/planar_system.h"
#include "tests/mechanisms/slider_crank_geometry.h"

namespace kurbel {

using SimTK::Inertia;
using SimTK::MassProperties;
using SimTK::MobilizedBody;
using SimTK::SpatialVec;
using SimTK::Vec3;
using SimTK::Vector;
using SimTK::Vector_;

namespace {

MassProperties link(double mass, double com_x, double central_inertia) {
  const Vec3 com(com_x, 0, 0);
  return massive(mass, com, flat(central_inertia) + Inertia(com, mass));
}

// Simbody refuses inertia without mass; mass on the axis neither moves nor has weight that a reaction would show, so it
// is taken off the bearing again.
constexpr double stand_in_mass = 1;

MassProperties crank_properties(const SliderCrankData& d) {
  if (d.crank_mass == 0) return link(stand_in_mass, 0, d.crank_inertia);
  return link(d.crank_mass, d.crank_com, std::fmax(0, d.crank_inertia - d.crank_mass * d.crank_com * d.crank_com));
}

void demand_masses(const SliderCrankData& d) {
  throw_if_any("slider-crank", faults_of(d));
  if (d.rod_mass > 0 && d.slider_mass > 0) return;
  throw std::invalid_argument(
      fmt::format("slider-crank: rod_mass = {} kg, slider_mass = {} kg; both must be > 0 for Simbody's reactions",
                  d.rod_mass, d.slider_mass));
}

//   ground ─Pin→ crank ─Pin→ rod,   ground ─Slider→ slider,   rod's end on the slider's pin by two PointInPlane
struct System {
  System(const SliderCrankData& d, double slider_force)
      : matter(system),
        forces(system),
        weight(forces, matter, -d.gravity * Vec3(std::sin(d.stroke_angle), std::cos(d.stroke_angle), 0)),
        crank(matter.Ground(), SimTK::Transform(), SimTK::Body::Rigid(crank_properties(d)), SimTK::Transform()),
        rod(crank, Vec3(d.radius, 0, 0), SimTK::Body::Rigid(link(d.rod_mass, d.rod_com, d.rod_inertia)), Vec3(0)),
        slider(matter.Ground(), Vec3(0, d.offset, 0),
               SimTK::Body::Rigid(MassProperties(d.slider_mass, Vec3(0), flat(1))), Vec3(0)),
        push(forces, slider, Vec3(0), Vec3(slider_force, 0, 0)) {
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0)})
      SimTK::Constraint::PointInPlane(slider, SimTK::UnitVec3(normal), 0, rod, Vec3(d.rod_length, 0, 0));
  }
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::Force::UniformGravity weight;
  MobilizedBody::Pin crank, rod;
  MobilizedBody::Slider slider;
  SimTK::Force::ConstantForce push;
};

}  // namespace

SimbodyReactions simbody_reactions(const SliderCrankData& d, double phi, double omega, double alpha,
                                   double slider_force) {
  demand_masses(d);
  System s(d, slider_force);
  SimTK::State state = s.system.realizeTopology();
  const SliderCrankGeometry geometry(d);
  const auto rod = geometry.rod(phi), slider = geometry.slider(phi);
  s.crank.setAngle(state, phi);
  s.rod.setAngle(state, rod.value - phi);
  s.slider.setLength(state, slider.value);
  s.crank.setRate(state, omega);
  s.rod.setRate(state, (rod.slope - 1) * omega);
  s.slider.setRate(state, slider.slope * omega);
  s.crank.lockAt(state, alpha, SimTK::Motion::Acceleration);
  s.system.realize(state, SimTK::Stage::Acceleration);
  const double open = state.getQErr().size() ? SimTK::max(SimTK::abs(state.getQErr())) : 0.0;
  if (!(open <= 1e-12 * d.rod_length))
    throw std::runtime_error(fmt::format("slider-crank: loop open by {:.3g} m at phi = {:.6g} rad", open, phi));

  Vector_<SpatialVec> joint, loop;
  Vector motion, unused;
  s.matter.calcMobilizerReactionForces(state, joint);
  s.matter.findConstraintForces(state, loop, unused);
  s.matter.findMotionForces(state, motion);
  const Vec3 bearing = joint[s.crank.getMobilizedBodyIndex()][1], pin = joint[s.rod.getMobilizedBodyIndex()][1];
  const SpatialVec guide = joint[s.slider.getMobilizedBodyIndex()];
  const Vec3 end = -loop[s.slider.getMobilizedBodyIndex()][1];  // findConstraintForces gives minus the forces, too
  const double stand_in = d.crank_mass == 0 ? stand_in_mass * d.gravity : 0;
  SimbodyReactions out{};
  out.main_bearing[0] = bearing[0] - stand_in * std::sin(d.stroke_angle);
  out.main_bearing[1] = bearing[1] - stand_in * std::cos(d.stroke_angle);
  for (int k = 0; k < 2; ++k) {
    out.crank_pin[k] = pin[k];
    out.slider_pin[k] = end[k];
  }
  out.guide = guide[1][1];
  out.guide_moment = guide[0][2];
  out.torque = -motion[0];  // findMotionForces gives minus what is to be applied
  return out;
}

namespace {

MechanismReactions reactions_in(std::unique_ptr<PlanarSystem> planar, double phi, double omega, double alpha,
                                double load) {
  const Vec3 down = -planar->gravity * planar->up();
  const SimTK::Force::UniformGravity weight(planar->forces, planar->matter, down);
  if (!planar->output_coordinates.empty()) {
    const int q = planar->output_coordinates.front();  // of the output's own pin
    SimTK::Force::ConstantTorque(planar->forces, planar->matter.updMobilizedBody(SimTK::MobilizedBodyIndex(q + 1)),
                                 Vec3(0, 0, load));
  } else {
    const TrackedPoint& output = planar->points[planar->output_point];
    SimTK::Force::ConstantForce(planar->forces, planar->matter.updMobilizedBody(output.body), output.station,
                                Vec3(load, 0, 0));
  }
  SimTK::State state = planar->realize_topology();
  state.updU() = omega * planar->reduce_at(state, planar->within_a_cycle(phi)).q1;
  planar->matter.getMobilizedBody(SimTK::MobilizedBodyIndex(1)).lockAt(state, alpha, SimTK::Motion::Acceleration);
  planar->system.realize(state, SimTK::Stage::Acceleration);
  Vector_<SpatialVec> joint;
  Vector motion;
  planar->matter.calcMobilizerReactionForces(state, joint);
  planar->matter.findMotionForces(state, motion);
  MechanismReactions out;
  for (SimTK::MobilizedBodyIndex k(1); k < planar->matter.getNumBodies(); ++k)
    out.on.push_back({joint[k][1][0], joint[k][1][1], joint[k][0][2]});
  out.torque = -motion[0];
  return out;
}

}  // namespace

MechanismReactions simbody_reactions(const BodiesOf& of, double phi, double omega, double alpha, double load) {
  return reactions_in(planar_system(of), phi, omega, alpha, load);
}

}  // namespace kurbel
