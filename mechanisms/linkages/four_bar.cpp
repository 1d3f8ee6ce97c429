// four_bar.cpp — builds the four-bar linkage in Simbody (C++17 island).
//
//   ground ─Pin(q₀ = φ)→ crank ─Pin(q₁)→ coupler ═ pin B closed by two PointInPlane ═ rocker ←Pin(q₂ = ψ)─ ground
//
// Determinant of the closures: −coupler · rocker · sin(ψ − coupler's angle), negative where B is left of A → D.
#include "mechanisms/linkages/four_bar.h"

#include <cmath>

#include "mechanisms/linkages/planar_system.h"

namespace kurbel {

using SimTK::Transform;
using SimTK::Vec3;

DataFaults faults_of(const FourBarData& d) {
  DataChecks checks;
  checks.positive("crank", d.crank, "m");
  checks.positive("coupler", d.coupler, "m");
  checks.positive("rocker", d.rocker, "m");
  checks.positive("ground", d.ground, "m");
  checks.pivoted("crank", d.crank_body);
  checks.floating("coupler", d.coupler_body);
  checks.pivoted("rocker", d.rocker_body);
  checks.not_negative("gravity", d.gravity, "m/s2");
  checks.finite("ground_angle", d.ground_angle, "rad");
  if (checks.sound())
    check_loop_closes({d.crank, d.coupler, d.rocker, d.ground, "crank", "coupler", "rocker", "ground"}, checks);
  return checks.take();
}

std::vector<double> values_of(const FourBarData& d) {
  std::vector<double> values = {d.crank, d.coupler, d.rocker, d.ground, double(d.crossed), d.gravity, d.ground_angle};
  for (const LinkBody* b : {&d.crank_body, &d.coupler_body, &d.rocker_body})
    values.insert(values.end(), {b->mass, b->com, b->inertia});
  return values;
}

std::optional<CrankArc> arc_of(const FourBarData& d) { return d.loop().arc(); }

LinkageDrawing drawing_of(const FourBarData& d) {
  return {"Four-bar", d.ground_angle, {{"link", {1, 2}}, {"link", {2, 3}}, {"crank", {0, 1}}}, {0, 3}, 3, true};
}

std::unique_ptr<PlanarSystem> planar_system(const FourBarData& d) {
  throw_if_any("four-bar", faults_of(d));
  auto m = std::make_unique<PlanarSystem>("four-bar");
  SimTK::MobilizedBody::Pin crank(m->matter.Ground(), Transform(), pivoted_link(d.crank_body), Transform());
  SimTK::MobilizedBody::Pin coupler(crank, Vec3(d.crank, 0, 0),
                                    floating_link(d.coupler_body, "four-bar: coupler_inertia"), Vec3(0));
  SimTK::MobilizedBody::Pin rocker(m->matter.Ground(), Vec3(d.ground, 0, 0), pivoted_link(d.rocker_body), Vec3(0));
  close_pin(rocker, Vec3(d.rocker, 0, 0), coupler, Vec3(d.coupler, 0, 0));

  m->gravity = d.gravity;
  m->elevation = d.ground_angle;
  m->determinant_sign = d.crossed ? 1 : -1;
  m->start = [d](double phi) {
    const PlanePoint a = {d.crank * std::cos(phi), d.crank * std::sin(phi)};
    const PlanePoint b = meeting_point(a, d.coupler, {d.ground, 0}, d.rocker, !d.crossed);
    return std::vector<double>{within_a_turn(std::atan2(b.y - a.y, b.x - a.x) - phi), std::atan2(b.y, b.x - d.ground)};
  };
  if (d.loop().changes())
    m->follow = [d](double phi) {
      const Meeting b = meet(d.loop(), phi, !d.crossed);
      return PlanarSystem::Followed{{b.coupler.series() - Taylor::variable(phi), b.follower.series()}, -b.sine};
    };
  if (d.loop().folds(!d.crossed)) m->stands_at = std::acos(-1.0);
  m->add_weight(d.crank_body.mass, crank, Vec3(d.crank_body.com, 0, 0));
  m->add_weight(d.coupler_body.mass, coupler, Vec3(d.coupler_body.com, 0, 0));
  m->add_weight(d.rocker_body.mass, rocker, Vec3(d.rocker_body.com, 0, 0));
  m->set_output(2);
  m->add_joint(crank, Vec3(0));
  m->add_joint(coupler, Vec3(0));
  m->add_joint(coupler, Vec3(d.coupler, 0, 0));
  m->add_joint(rocker, Vec3(0));
  return m;
}

std::unique_ptr<MechanismBodies> make_bodies(const FourBarData& d) { return sampled(planar_system(d)); }

}  // namespace kurbel
