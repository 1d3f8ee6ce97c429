// knuckle_press.cpp — checks of the lengths, the two loops as bodies and joints, the drawing.
#include "mechanisms/linkages/knuckle_press.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanisms/linkages/link_bodies.h"
#include "mechanisms/loops/loops.h"

namespace kurbel {

namespace {

constexpr double least_stroke = 1e-8;  // of the upper link: below it, places of the ram are mostly round-off

// Heights of the knee between the upper link's dead centres, where crank and rod are in line.
Range knee_heights(const KnucklePressData& d) {
  const double ground = std::hypot(d.bearing_x, d.bearing_y), towards_crank = std::atan2(-d.bearing_y, -d.bearing_x);
  const auto angle_at = [&](double reach) {  // of the upper link, with the knee at this distance from O
    const double c = (ground * ground + (d.upper - reach) * (d.upper + reach)) / (2 * ground * d.upper);
    const double turn = std::acos(std::clamp(c, -1.0, 1.0));
    return towards_crank + (d.knee_right ? turn : -turn);
  };
  const double a = angle_at(d.rod - d.radius), b = angle_at(d.rod + d.radius);
  const Range sine = sine_range(std::fmin(a, b), std::fmax(a, b));
  return {d.bearing_y + d.upper * sine.least, d.bearing_y + d.upper * sine.greatest};
}

// Way of the ram, by angles of the crank close enough to distinguish a ram that works from one that stands still.
double stroke_of(const KnucklePressData& d) {
  constexpr int angles = 32;
  long double least = std::numeric_limits<long double>::infinity(), greatest = -least;
  for (int i = 0; i < angles; ++i) {
    const long double ram = linkage_of(d, 2 * std::acos(-1.0L) * i / angles).output[0];
    least = std::fmin(least, ram), greatest = std::fmax(greatest, ram);
  }
  return static_cast<double>(greatest - least);
}

void check_geometry(const KnucklePressData& d, DataChecks& checks) {
  const double ground = std::hypot(d.bearing_x, d.bearing_y);
  check_crank_rocker({d.radius, d.rod, d.upper, ground, "radius", "rod", "upper", "bearing distance"}, checks);
  if (!checks.valid()) return;
  const Range heights = knee_heights(d);
  const double rise = std::fmax(std::fabs(d.guide - heights.least), std::fabs(d.guide - heights.greatest));
  if (!(d.lower > rise))
    checks.add("lower", fmt::format("lower = {}; must be > {}, the knee's greatest distance from the guide, else the "
                                    "crank cannot turn fully: {} too short; lengthen the lower link or move the guide",
                                    in_mm(d.lower), in_mm(rise), in_mm(rise - d.lower)));
  else if (stroke_of(d) < least_stroke * d.upper)
    checks.add("bearing_x",
               fmt::format("the ram stands still: lower = upper = {}, and the lower link lies upon the upper "
                           "one, which points from bearing_x = {} away from the stroke; set the bearing "
                           "back behind the knee, or take the other branch",
                           in_mm(d.upper), in_mm(d.bearing_x)));
}

}  // namespace

DataFaults faults_of(const KnucklePressData& d) {
  DataChecks checks;
  checks.pivoted("crank", d.crank_body);
  checks.floating("rod", d.rod_body);
  checks.pivoted("upper", d.upper_body);
  checks.floating("lower", d.lower_body, d.ram_mass);
  if (checks.valid()) check_geometry(d, checks);
  return checks.take();
}

std::vector<double> values_of(const KnucklePressData& d) {
  std::vector<double> values = {d.radius,   d.rod,     d.bearing_x,   d.bearing_y,
                                d.upper,    d.lower,   d.guide,       double(d.knee_right),
                                d.ram_mass, d.gravity, d.stroke_angle};
  for (const LinkBody* b : {&d.crank_body, &d.rod_body, &d.upper_body, &d.lower_body})
    values.insert(values.end(), {b->mass, b->com, b->inertia});
  return values;
}

LinkageDrawing drawing_of(const KnucklePressData& d) {
  return {"Knuckle press",
          d.stroke_angle,
          {0, 1, 2, 4, 5},
          {{"link", {1, 2}}, {"link", {3, 2}}, {"link", {2, 4}}, {"slider", {4}}, {"crank", {0, 1}}},
          {0, 3},
          4,
          false};
}

// The loop crank – rod – upper link is a four-bar in axes turned towards the bearing.
PlanarLinkage linkage_of(const KnucklePressData& m, long double phi) {
  const long double x = m.bearing_x, y = m.bearing_y, ground = std::hypot(x, y), tilt = std::atan2(y, x);
  const Meeting meeting = meet({m.radius, m.rod, m.upper, ground}, phi - tilt, !m.knee_right);
  const Direction back = Direction::constant(tilt), crank = Direction::of_variable(phi);
  const Direction upper = meeting.follower + back, rod = meeting.coupler + back;
  const Path pin = along(crank, m.radius), bearing = {Taylor(x), Taylor(y)};
  const Path knee = bearing + along(upper, m.upper);
  const Direction lower = to_line(knee, m.guide, m.lower, false);
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.stroke_angle;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(floating("rod", m.rod_body, pin, rod));
  l.add(pivoted("upper link", m.upper_body, bearing, upper));
  l.add(floating("lower link", m.lower_body, knee, lower));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 1, pin});
  l.join({"knee, rod", 1, 2, knee});
  l.join({"knee, lower link", 2, 3, knee});
  l.join({"upper bearing", PlanarLinkage::frame, 2, bearing});
  add_slider(l, "ram", m.ram_mass, "ram pin", knee + along(lower, m.lower));
  return l;
}

}  // namespace kurbel
