// slider_crank_simbody.cpp — builds the slider-crank in Simbody and samples its reduced functions (C++17 island).
#include "mechanisms/slider_crank_simbody.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "mechanisms/slider_crank_system.h"

namespace kurbel {

using SimTK::Inertia;
using SimTK::MassProperties;
using SimTK::State;
using SimTK::Vec3;

namespace {

// A flat body's central inertia: only its moment about z matters here; half of it about x and y keeps Simbody content.
Inertia flat(double about_z) { return Inertia(about_z / 2, about_z / 2, about_z); }

// Simbody refuses inertia without mass. Mass on the axis neither moves nor has a torque, so a massless crank is given
// one.
MassProperties crank_properties(const SliderCrankData& d, double shaft_inertia) {
  const double central = std::fmax(0, d.crank_inertia - d.crank_mass * d.crank_com * d.crank_com) + shaft_inertia;
  if (d.crank_mass == 0) return {1, Vec3(0), flat(central)};
  const Vec3 com(d.crank_com, 0, 0);
  return {d.crank_mass, com, flat(central) + Inertia(com, d.crank_mass)};
}

// The rod with the slider's mass at its end.
MassProperties rod_properties(const SliderCrankData& d) {
  const Vec3 com(d.rod_com, 0, 0), end(d.rod_length, 0, 0);
  const double mass = d.rod_mass + d.slider_mass;
  if (mass == 0 && d.rod_inertia == 0) return {0, Vec3(0), Inertia(0)};
  if (mass == 0)
    throw std::invalid_argument(
        fmt::format("slider-crank: rod_inertia = {} kg m2 with rod_mass = slider_mass = 0; give one of them a mass",
                    d.rod_inertia));
  return {mass, (d.rod_mass * com + d.slider_mass * end) / mass,
          flat(d.rod_inertia) + Inertia(com, d.rod_mass) + Inertia(end, d.slider_mass)};
}

// sin β on the closed loop; the right branch has cos β > 0.
double rod_angle(const SliderCrankData& d, double phi) {
  return std::asin((d.offset - d.radius * std::sin(phi)) / d.rod_length);
}

// φ between −π and π. Simbody's coordinate β − φ is a double: a small one keeps more digits of β.
double within_a_turn(double phi) {
  const long double turn = 2 * std::acos(-1.0L);
  return double(std::remainder(static_cast<long double>(phi), turn));
}

}  // namespace

SliderCrankSystem::SliderCrankSystem(const SliderCrankData& d, double shaft_inertia)
    : data((validate(d), d)),
      matter(system),
      forces(system),
      crank(matter.Ground(), SimTK::Transform(), SimTK::Body::Rigid(crank_properties(d, shaft_inertia)),
            SimTK::Transform()),
      rod(crank, Vec3(d.radius, 0, 0), SimTK::Body::Rigid(rod_properties(d)), Vec3(0)) {
  SimTK::Constraint::PointInPlane(matter.Ground(), SimTK::UnitVec3(0, 1, 0), d.offset, rod, Vec3(d.rod_length, 0, 0));
}

State SliderCrankSystem::realize_topology() {
  system.realizeTopology();
  const std::vector<TrackedPoint> points = {{crank.getMobilizedBodyIndex(), Vec3(data.crank_com, 0, 0)},
                                            {rod.getMobilizedBodyIndex(), Vec3(data.rod_com, 0, 0)},
                                            {rod.getMobilizedBodyIndex(), Vec3(data.rod_length, 0, 0)}};
  reduction = std::make_unique<SimbodyReduction>(system, matter, 0, points);
  return system.getDefaultState();
}

Reduction SliderCrankSystem::reduce_at(State& state, double phi) const {
  return reduce_at(state, phi, rod_angle(data, phi));
}

Reduction SliderCrankSystem::reduce_at(State& state, double phi, double rod_angle_start) const {
  state.updQ()[0] = phi;
  state.updQ()[1] = rod_angle_start - phi;
  reduction->close(state);
  Reduction reduced = reduction->reduce(state);
  if (!(reduced.determinant > 0))
    throw std::runtime_error(
        fmt::format("slider-crank on the wrong branch at phi = {:.17g} rad: l cos(beta) = {:.6g} m, must be > 0 "
                    "(beta = {:.6g} rad, closure error {:.3g} m)",
                    phi, reduced.determinant, state.getQ()[0] + state.getQ()[1], reduced.closure_error));
  return reduced;
}

struct SliderCrankBodies::Model {
  explicit Model(const SliderCrankData& data) : bodies(data), state(bodies.realize_topology()) {}

  // Calls f(mass, motion) for every weight.
  template <class F>
  void for_each_weight(const Reduction& reduced, F&& f) const {
    const SliderCrankData& d = bodies.data;
    f(d.crank_mass, reduced.points[SliderCrankSystem::crank_point]);
    f(d.rod_mass, reduced.points[SliderCrankSystem::rod_point]);
    f(d.slider_mass, reduced.points[SliderCrankSystem::slider_point]);
  }

  // Unit vector upwards in the mechanism's axes.
  Vec3 up() const { return Vec3(std::sin(bodies.data.stroke_angle), std::cos(bodies.data.stroke_angle), 0); }

  SliderCrankSystem bodies;
  State state;
};

SliderCrankBodies::SliderCrankBodies(const SliderCrankData& data) : model_(std::make_unique<Model>(data)) {}
SliderCrankBodies::~SliderCrankBodies() = default;
SliderCrankBodies::SliderCrankBodies(SliderCrankBodies&&) noexcept = default;
SliderCrankBodies& SliderCrankBodies::operator=(SliderCrankBodies&&) noexcept = default;

ReducedSample SliderCrankBodies::sample(double phi) { return sample(phi, rod_angle(model_->bodies.data, phi)); }

ReducedSample SliderCrankBodies::sample(double phi, double rod_angle_start) {
  const Reduction reduced = model_->bodies.reduce_at(model_->state, within_a_turn(phi), rod_angle_start);
  const PointMotion& slider = reduced.points[SliderCrankSystem::slider_point];

  ReducedSample sample{};
  sample.inertia = reduced.inertia;
  sample.inertia_slope = reduced.slope;
  sample.inertia_curvature = reduced.curvature;
  sample.slider_position = slider.position[0];
  sample.slider_velocity_ratio = slider.velocity_ratio[0];
  sample.slider_acceleration_ratio = slider.acceleration_ratio[0];
  sample.rod_angle_ratio = reduced.q1[0] + reduced.q1[1];
  sample.closure_determinant = reduced.determinant;
  // Power of the weights at ω = 1 (2.2).
  const Vec3 weight_per_mass = -model_->bodies.data.gravity * model_->up();
  model_->for_each_weight(reduced, [&](double mass, const PointMotion& point) {
    sample.gravity_torque += mass * SimTK::dot(weight_per_mass, point.velocity_ratio);
    sample.gravity_torque_slope += mass * SimTK::dot(weight_per_mass, point.acceleration_ratio);
  });
  return sample;
}

double SliderCrankBodies::kinetic_energy(double phi, double omega) {
  const Reduction reduced = model_->bodies.reduce_at(model_->state, within_a_turn(phi));
  model_->state.updU() = omega * reduced.q1;
  model_->bodies.system.realize(model_->state, SimTK::Stage::Velocity);
  return model_->bodies.matter.calcKineticEnergy(model_->state);
}

double SliderCrankBodies::potential_energy(double phi) {
  const Reduction reduced = model_->bodies.reduce_at(model_->state, within_a_turn(phi));
  double energy = 0;
  model_->for_each_weight(reduced, [&](double mass, const PointMotion& point) {
    energy += mass * model_->bodies.data.gravity * SimTK::dot(model_->up(), point.position);
  });
  return energy;
}

}  // namespace kurbel
