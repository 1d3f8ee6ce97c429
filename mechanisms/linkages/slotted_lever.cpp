// slotted_lever.cpp — checks of the lengths, the loop as bodies and joints, the drawing.
#include "mechanisms/linkages/slotted_lever.h"

#include <fmt/core.h>

#include <cmath>

#include "mechanisms/linkages/link_bodies.h"

namespace kurbel {

DataFaults faults_of(const SlottedLeverData& d) {
  constexpr double least_clearance = 1e-3;  // of the crank: nearer by the bearing the lever's speed has no bound
  DataChecks checks;
  checks.pivoted("crank", d.crank_body);
  checks.pivoted("lever", d.lever_body);
  checks.floating("block", {d.block_mass, 0, d.block_inertia});
  if (checks.valid() && !d.loop().changes() && std::fabs(d.ground - d.crank) < least_clearance * d.crank)
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
  return {"Slotted lever",
          d.ground_angle,
          {0, 1, 3},
          {{"slot", {2, 1}}, {"crank", {0, 1}}, {"block", {1, 2}}},
          {0, 2},
          2,
          true};
}

PlanarLinkage linkage_of(const SlottedLeverData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path pin = along(crank, m.crank), bearing = {Taylor(m.ground), Taylor()};
  const Slot slot = slot_to_pin(m.loop(), phi);
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.ground_angle, l.rocks = true;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(floating("block", {m.block_mass, 0, m.block_inertia}, pin, slot.along));
  l.add(pivoted("lever", m.lever_body, bearing, slot.along));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  l.join({"slot", 1, 2, pin, true, slot.along, true});
  l.join({"lever bearing", PlanarLinkage::frame, 2, bearing});
  l.load_at = bearing;
  if (m.loop().changes()) l.changes = true, l.sine = slot.reach.value() / (m.crank + m.ground);
  const Taylor rate = slot.along.rate();
  l.output[0] = slot.along.angle(), l.output[1] = rate.value(), l.output[2] = rate.slope();
  return l;
}

}  // namespace kurbel
