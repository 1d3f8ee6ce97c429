// slotted_lever.cpp — builds the inverted slider-crank in Simbody (C++17 island).
//
//   ground ─Pin(q₀ = φ)→ crank ═ pin A closed by two PointInPlane ═ block ←Slider(q₂ = DA)─ lever ←Pin(q₁)─ ground
//
// Determinant of the closures: −DA.
#include "mechanisms/linkages/slotted_lever.h"

#include <fmt/core.h>

#include <cmath>

#include "mechanisms/linkages/planar_system.h"

namespace kurbel {

using SimTK::Transform;
using SimTK::Vec3;

DataFaults faults_of(const SlottedLeverData& d) {
  constexpr double least_clearance = 1e-3;  // of the crank: nearer by the bearing the lever's speed has no bound
  DataChecks checks;
  checks.positive("crank", d.crank, "m");
  checks.positive("ground", d.ground, "m");
  checks.pivoted("crank", d.crank_body);
  checks.pivoted("lever", d.lever_body);
  checks.floating("block", {d.block_mass, 0, d.block_inertia});
  checks.not_negative("gravity", d.gravity, "m/s2");
  checks.finite("ground_angle", d.ground_angle, "rad");
  if (checks.sound() && !d.loop().changes() && std::fabs(d.ground - d.crank) < least_clearance * d.crank)
    checks.add("ground",
               fmt::format("ground = {} against crank = {}: the crank pin passes so close by the lever's bearing "
                           "that the lever's speed has no bound; make it longer for a rocking lever, shorter "
                           "for a turning one, or equal to the crank for one that passes its change point",
                           in_mm(d.ground), in_mm(d.crank)));
  return checks.take();
}

std::vector<double> values_of(const SlottedLeverData& d) {
  std::vector<double> values = {d.crank, d.ground, d.block_mass, d.block_inertia, d.gravity, d.ground_angle};
  for (const LinkBody* b : {&d.crank_body, &d.lever_body}) values.insert(values.end(), {b->mass, b->com, b->inertia});
  return values;
}

LinkageDrawing drawing_of(const SlottedLeverData& d) {
  return {"Slotted lever", d.ground_angle, {{"slot", {2, 1}}, {"crank", {0, 1}}, {"block", {1, 2}}}, {0, 2}, 2, true};
}

std::unique_ptr<PlanarSystem> planar_system(const SlottedLeverData& d) {
  throw_if_any("inverted slider-crank", faults_of(d));
  auto m = std::make_unique<PlanarSystem>("inverted slider-crank");
  SimTK::MobilizedBody::Pin crank(m->matter.Ground(), Transform(), pivoted_link(d.crank_body), Transform());
  SimTK::MobilizedBody::Pin lever(m->matter.Ground(), Vec3(d.ground, 0, 0), pivoted_link(d.lever_body), Vec3(0));
  SimTK::MobilizedBody::Slider block(
      lever, Transform(), floating_link({d.block_mass, 0, d.block_inertia}, "inverted slider-crank: block_inertia"),
      Transform());
  close_pin(crank, Vec3(d.crank, 0, 0), block, Vec3(0));

  m->gravity = d.gravity;
  m->elevation = d.ground_angle;
  m->determinant_sign = -1;
  m->start = [d](double phi) {
    const double x = d.crank * std::cos(phi) - d.ground, y = d.crank * std::sin(phi);  // A from D
    return std::vector<double>{std::atan2(y, x), std::hypot(x, y)};
  };
  if (d.loop().changes())
    m->follow = [d](double phi) {
      const Slot slot = slot_to_pin(d.loop(), phi);
      return PlanarSystem::Followed{{slot.along.series(), slot.reach}, -slot.reach.value() / (d.crank + d.ground)};
    };
  m->add_weight(d.crank_body.mass, crank, Vec3(d.crank_body.com, 0, 0));
  m->add_weight(d.lever_body.mass, lever, Vec3(d.lever_body.com, 0, 0));
  m->add_weight(d.block_mass, block, Vec3(0));
  m->set_output(1);
  m->add_joint(crank, Vec3(0));
  m->add_joint(crank, Vec3(d.crank, 0, 0));
  m->add_joint(lever, Vec3(0));
  return m;
}

std::unique_ptr<MechanismBodies> make_bodies(const SlottedLeverData& d) { return sampled(planar_system(d)); }

}  // namespace kurbel
