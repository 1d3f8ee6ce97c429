// four_bar.cpp — checks of the lengths, the loop as bodies and joints, the drawing.
#include "mechanisms/linkages/four_bar.h"

#include <cmath>

#include "mechanisms/linkages/link_bodies.h"

namespace kurbel {

DataFaults faults_of(const FourBarData& d) {
  DataChecks checks;
  checks.pivoted("crank", d.crank_body);
  checks.floating("coupler", d.coupler_body);
  checks.pivoted("rocker", d.rocker_body);
  if (checks.valid())
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
  return {"Four-bar", d.ground_angle, {0, 1, 2, 3}, {{"link", {1, 2}}, {"link", {2, 3}}, {"crank", {0, 1}}}, {0, 3}, 3,
          true};
}

PlanarLinkage linkage_of(const FourBarData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Meeting meeting = meet(m.loop(), phi, !m.crossed);
  const Path pin = along(crank, m.crank), bearing = {Taylor(m.ground), Taylor()};
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.ground_angle, l.rocks = true;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(floating("coupler", m.coupler_body, pin, meeting.coupler));
  l.add(pivoted("rocker", m.rocker_body, bearing, meeting.follower));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  l.join({"coupler pin", 1, 2, bearing + along(meeting.follower, m.rocker)});
  l.join({"rocker bearing", PlanarLinkage::frame, 2, bearing});
  l.load_at = bearing;
  if (m.loop().changes()) l.changes = true, l.sine = meeting.sine;
  const Taylor rate = meeting.follower.rate();
  l.output[0] = meeting.follower.angle(), l.output[1] = rate.value(), l.output[2] = rate.slope();
  if (m.loop().folds(!m.crossed)) {
    l.stands_still = true;
    l.output[0] = std::acos(-1.0L), l.output[1] = l.output[2] = 0;
  }
  return l;
}

}  // namespace kurbel
