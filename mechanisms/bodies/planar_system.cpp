// planar_system.cpp — samples the reduced functions of any mechanism from its Simbody model (C++17 island).
#include "mechanisms/bodies/planar_system.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace kurbel {

using SimTK::Inertia;
using SimTK::MassProperties;
using SimTK::MobilizedBody;
using SimTK::State;
using SimTK::UnitVec3;
using SimTK::Vec3;

namespace {

class SampledBodies final : public MechanismBodies {
 public:
  explicit SampledBodies(std::unique_ptr<PlanarSystem> planar)
      : planar_(std::move(planar)), state_(planar_->realize_topology()) {}

  ReducedSample sample(double phi) override { return sample_of(reduce_at(phi), phi); }
  ReducedSample sample_from(double phi, const std::vector<double>& start) override {
    return sample_of(planar_->reduce_at(state_, planar_->within_a_cycle(phi), start), phi);
  }
  std::vector<TrackedMotion> tracked() const override { return tracked_; }

  double kinetic_energy(double phi, double omega) override {
    state_.updU() = omega * reduce_at(phi, Upto::velocity).q1;
    planar_->system.realize(state_, SimTK::Stage::Velocity);
    return planar_->matter.calcKineticEnergy(state_);
  }

  double potential_energy(double phi) override {
    const Reduction reduced = reduce_at(phi);
    double energy = 0;
    for (const PlanarSystem::Weight& weight : planar_->weights)
      energy += weight.mass * planar_->gravity * SimTK::dot(planar_->up(), reduced.points[weight.point].position);
    return energy;
  }

 private:
  Reduction reduce_at(double phi, Upto last = Upto::jerk) {
    return planar_->reduce_at(state_, planar_->within_a_cycle(phi), last);
  }

  ReducedSample sample_of(const Reduction& reduced, double phi) {
    ReducedSample sample{};
    tracked_.clear();
    for (const PlanarSystem::Place& place : planar_->places) tracked_.push_back(motion_of(place, reduced));
    sample.inertia = reduced.inertia;
    sample.inertia_slope = reduced.slope;
    sample.inertia_curvature = reduced.curvature;
    sample.closure_determinant = planar_->sign_at(planar_->within_a_cycle(phi)) * reduced.determinant;
    if (!planar_->output_coordinates.empty()) {
      sample.output_position = planar_->output_from;
      for (const int q : planar_->output_coordinates) {
        sample.output_position += state_.getQ()[q];
        sample.output_velocity_ratio += reduced.q1[q];
        sample.output_acceleration_ratio += reduced.q2[q];
      }
    } else {
      const PointMotion& output = reduced.points[planar_->output_point];
      sample.output_position = output.position[0];
      sample.output_velocity_ratio = output.velocity_ratio[0];
      sample.output_acceleration_ratio = output.acceleration_ratio[0];
    }
    if (planar_->stands_at) {
      sample.output_position = *planar_->stands_at;
      sample.output_velocity_ratio = sample.output_acceleration_ratio = 0;
    }
    // Power of the weights at ω = 1 (theory 2.2).
    const Vec3 weight_per_mass = -planar_->gravity * planar_->up();
    for (const PlanarSystem::Weight& weight : planar_->weights) {
      const PointMotion& point = reduced.points[weight.point];
      sample.gravity_torque += weight.mass * SimTK::dot(weight_per_mass, point.velocity_ratio);
      sample.gravity_torque_slope += weight.mass * SimTK::dot(weight_per_mass, point.acceleration_ratio);
      sample.gravity_torque_scale += weight.mass * planar_->gravity * point.velocity_ratio.norm();
    }
    return sample;
  }

  TrackedMotion motion_of(const PlanarSystem::Place& place, const Reduction& reduced) const {
    const auto flat = [](const Vec3& v) { return Planar<double>{v[0], v[1]}; };
    const PointMotion& point = reduced.points[place.point];
    TrackedMotion m{flat(point.position), flat(point.velocity_ratio), flat(point.acceleration_ratio)};
    for (const int q : place.pins) {
      m.rotation += state_.getQ()[q];
      m.rotation_velocity_ratio += reduced.q1[q];
      m.rotation_acceleration_ratio += reduced.q2[q];
    }
    return m;
  }

  std::unique_ptr<PlanarSystem> planar_;
  State state_;
  std::vector<TrackedMotion> tracked_;
};

}  // namespace

std::size_t PlanarSystem::track(const MobilizedBody& body, const Vec3& station) {
  points.push_back({body.getMobilizedBodyIndex(), station});
  return points.size() - 1;
}

void PlanarSystem::add_weight(double mass, const MobilizedBody& body, const Vec3& station) {
  weights.push_back({mass, track(body, station)});
}

void PlanarSystem::set_output(const MobilizedBody& body, const Vec3& station) { output_point = track(body, station); }
void PlanarSystem::set_output(const MobilizedBody& body, std::vector<int> coordinates, double from) {
  set_output(body, Vec3(0));
  output_coordinates = std::move(coordinates), output_from = from;
}

void PlanarSystem::add_place(const MobilizedBody& body, const Vec3& station, std::vector<int> pins) {
  places.push_back({track(body, station), std::move(pins)});
}

double PlanarSystem::output_position(const State& state) const {
  const TrackedPoint& output = points[output_point];
  if (output_coordinates.empty())
    return matter.getMobilizedBody(output.body).findStationLocationInGround(state, output.station)[0];
  double angle = output_from;
  for (const int q : output_coordinates) angle += state.getQ()[q];
  return angle;
}

double PlanarSystem::output_speed(const State& state) const {
  const TrackedPoint& output = points[output_point];
  if (output_coordinates.empty())
    return matter.getMobilizedBody(output.body).findStationVelocityInGround(state, output.station)[0];
  double speed = 0;
  for (const int q : output_coordinates) speed += state.getU()[q];
  return speed;
}

State PlanarSystem::realize_topology() {
  system.realizeTopology();
  reduction = std::make_unique<SimbodyReduction>(system, matter, 0, points, redundant);
  const State& state = system.getDefaultState();
  for (SimTK::MobilizedBodyIndex k(1); k < matter.getNumBodies(); ++k)
    if (matter.getMobilizedBody(k).getFirstQIndex(state) != k - 1)
      throw std::logic_error("planar_system: coordinates are not in the order of the bodies");
  State drawn = state;
  drawn.updQ()[0] = drawn_at;
  const std::vector<double> others = start(drawn_at);
  for (std::size_t k = 0; k < others.size(); ++k) drawn.updQ()[int(k) + 1] = others[k];
  reduction->close(drawn);
  determinant_sign_ = std::copysign(1.0, sign_at(drawn_at) * reduction->reduce(drawn).determinant);
  return state;
}

Reduction PlanarSystem::reduce_at(State& state, double phi, Upto last) const {
  return follow ? reduce_through(state, phi, last) : reduce_at(state, phi, start(phi), last);
}

Reduction PlanarSystem::reduce_at(State& state, double phi, const std::vector<double>& start_from, Upto last) const {
  state.updQ()[0] = phi;
  for (std::size_t k = 0; k < start_from.size(); ++k) state.updQ()[int(k) + 1] = start_from[k];
  reduction->close(state);
  Reduction reduced = reduction->reduce(state, nullptr, last);
  check_branch(phi, reduced, sign_at(phi));
  return reduced;
}

// So near to a change point the closures' first derivatives leave d³q/dφ³ fewer than fourteen digits.
constexpr double hardly_closed = 0.3;

Reduction PlanarSystem::reduce_through(State& state, double phi, Upto last) const {
  const Followed to = follow(phi);
  std::vector<double> q;
  for (const Taylor& t : to.coordinates) q.push_back(double(t.value()));
  if (std::fabs(to.sine) > hardly_closed) return reduce_at(state, phi, q, last);
  KnownDerivatives known{SimTK::Vector(int(q.size()) + 1, 0.0), SimTK::Vector(int(q.size()) + 1, 0.0),
                         SimTK::Vector(int(q.size()) + 1, 0.0)};
  known.q1[0] = 1;
  state.updQ()[0] = phi;
  for (int k = 1; k <= int(q.size()); ++k) {
    const Taylor& t = to.coordinates[std::size_t(k) - 1];
    state.updQ()[k] = q[std::size_t(k) - 1];
    known.q1[k] = double(t.c[1]), known.q2[k] = double(2 * t.c[2]), known.q3[k] = double(6 * t.c[3]);
  }
  return reduction->reduce(state, &known, last);
}

void PlanarSystem::check_branch(double phi, const Reduction& reduced, double sign) const {
  if (sign * reduced.determinant > 0) return;
  throw std::runtime_error(
      fmt::format("{} on the wrong branch at phi = {:.17g} rad: determinant of its closures = {:.6g}, must be > 0 "
                  "(closure error {:.3g} m)",
                  kind, phi, sign * reduced.determinant, reduced.closure_error));
}

double PlanarSystem::sign_at(double phi) const {
  if (!follow) return determinant_sign_;
  const Followed to = follow(phi);
  return to.turns_over && to.sine < 0 ? -determinant_sign_ : determinant_sign_;
}

void PlanarSystem::check_branch(State state) const {
  const double phi = state.getQ()[0];
  reduction->close(state);
  check_branch(phi, reduction->reduce(state, nullptr, Upto::velocity), sign_at(within_a_cycle(phi)));
}

double PlanarSystem::within_a_cycle(double phi) const {
  const long double turn = 2 * std::acos(-1.0L);
  return follow || turns > 1 ? double(std::remainder(static_cast<long double>(phi), 2 * turn)) : within_a_turn(phi);
}

std::unique_ptr<MechanismBodies> sampled(std::unique_ptr<PlanarSystem> planar) {
  return std::make_unique<SampledBodies>(std::move(planar));
}

// Simbody moves moments to the centre of mass and refuses what rounding leaves below nothing there, by an absolute
// bound that heavy links pass (1e-16 of m l² is more than its 2e-14 kg·m² from 100 kg·m² on). So much is added to
// those.
MassProperties massive(double mass, const Vec3& com, const Inertia& about_origin) {
  const double moment = about_origin.getMoments()[2];
  if (moment < 10 || moment > 1e9) return MassProperties(mass, com, about_origin);  // beyond, units are wrong
  return MassProperties(mass, com, about_origin + Inertia(16 * std::numeric_limits<double>::epsilon() * moment));
}

double within_a_turn(double phi) {
  const long double turn = 2 * std::acos(-1.0L);
  return double(std::remainder(static_cast<long double>(phi), turn));
}

}  // namespace kurbel
