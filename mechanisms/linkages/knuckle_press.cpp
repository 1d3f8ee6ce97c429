// knuckle_press.cpp — builds the knuckle-joint press in Simbody (C++17 island).
//
//   ground ─Pin(q₀ = φ)→ crank ─Pin(q₁)→ rod ═ knee K closed by two PointInPlane ═ upper link ←Pin(q₂)─ ground
//                                 upper link ─Pin(q₃)→ lower link with the ram ─PointInPlane→ y = guide
//
// Determinant of the closures: −rod · upper · sin(upper's angle − rod's angle) · lower · cos(lower's angle).
#include "mechanisms/linkages/knuckle_press.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanisms/linkages/planar_system.h"

namespace kurbel {

using SimTK::Transform;
using SimTK::Vec3;

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

PlanePoint knee_at(const KnucklePressData& d, double phi) {
  return meeting_point({d.radius * std::cos(phi), d.radius * std::sin(phi)}, d.rod, {d.bearing_x, d.bearing_y}, d.upper,
                       !d.knee_right);
}

// Way of the ram, by angles of the crank that lie close enough to tell a ram that works from one that stands still.
double stroke_of(const KnucklePressData& d) {
  constexpr int angles = 32;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (int i = 0; i < angles; ++i) {
    const PlanePoint knee = knee_at(d, 2 * std::acos(-1.0) * i / angles);
    const double rise = d.guide - knee.y, ram = knee.x + std::sqrt((d.lower - rise) * (d.lower + rise));
    least = std::fmin(least, ram), greatest = std::fmax(greatest, ram);
  }
  return greatest - least;
}

void check_geometry(const KnucklePressData& d, DataChecks& checks) {
  const double ground = std::hypot(d.bearing_x, d.bearing_y);
  check_crank_rocker({d.radius, d.rod, d.upper, ground, "radius", "rod", "upper", "bearing distance"}, checks);
  if (!checks.sound()) return;
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
  checks.positive("radius", d.radius, "m");
  checks.positive("rod", d.rod, "m");
  checks.finite("bearing_x", d.bearing_x, "m");
  checks.finite("bearing_y", d.bearing_y, "m");
  checks.positive("upper", d.upper, "m");
  checks.positive("lower", d.lower, "m");
  checks.finite("guide", d.guide, "m");
  checks.pivoted("crank", d.crank_body);
  checks.floating("rod", d.rod_body);
  checks.pivoted("upper", d.upper_body);
  checks.floating("lower", d.lower_body, d.ram_mass);
  checks.not_negative("ram_mass", d.ram_mass, "kg");
  checks.not_negative("gravity", d.gravity, "m/s2");
  checks.finite("stroke_angle", d.stroke_angle, "rad");
  if (checks.sound()) check_geometry(d, checks);
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
          {{"link", {1, 2}}, {"link", {3, 2}}, {"link", {2, 4}}, {"slider", {4}}, {"crank", {0, 1}}},
          {0, 3},
          4,
          false};
}

std::unique_ptr<PlanarSystem> planar_system(const KnucklePressData& d) {
  throw_if_any("knuckle press", faults_of(d));
  auto m = std::make_unique<PlanarSystem>("knuckle press");
  const Vec3 bearing(d.bearing_x, d.bearing_y, 0), ram(d.lower, 0, 0);
  SimTK::MobilizedBody::Pin crank(m->matter.Ground(), Transform(), pivoted_link(d.crank_body), Transform());
  SimTK::MobilizedBody::Pin rod(crank, Vec3(d.radius, 0, 0), floating_link(d.rod_body, "knuckle press: rod_inertia"),
                                Vec3(0));
  SimTK::MobilizedBody::Pin upper(m->matter.Ground(), bearing, pivoted_link(d.upper_body), Vec3(0));
  SimTK::MobilizedBody::Pin lower(upper, Vec3(d.upper, 0, 0),
                                  floating_link(d.lower_body, "knuckle press: lower_inertia", d.ram_mass, d.lower),
                                  Vec3(0));
  close_pin(upper, Vec3(d.upper, 0, 0), rod, Vec3(d.rod, 0, 0));
  SimTK::Constraint::PointInPlane(m->matter.Ground(), SimTK::UnitVec3(0, 1, 0), d.guide, lower, ram);

  m->gravity = d.gravity;
  m->elevation = d.stroke_angle;
  m->determinant_sign = d.knee_right ? 1 : -1;
  m->start = [d](double phi) {
    const PlanePoint a = {d.radius * std::cos(phi), d.radius * std::sin(phi)}, g = {d.bearing_x, d.bearing_y};
    const PlanePoint k = knee_at(d, phi);
    const double upper_angle = std::atan2(k.y - g.y, k.x - g.x);
    return std::vector<double>{within_a_turn(std::atan2(k.y - a.y, k.x - a.x) - phi), upper_angle,
                               within_a_turn(std::asin((d.guide - k.y) / d.lower) - upper_angle)};
  };
  m->add_weight(d.crank_body.mass, crank, Vec3(d.crank_body.com, 0, 0));
  m->add_weight(d.rod_body.mass, rod, Vec3(d.rod_body.com, 0, 0));
  m->add_weight(d.upper_body.mass, upper, Vec3(d.upper_body.com, 0, 0));
  m->add_weight(d.lower_body.mass, lower, Vec3(d.lower_body.com, 0, 0));
  m->add_weight(d.ram_mass, lower, ram);
  m->set_output(lower, ram);
  m->add_joint(crank, Vec3(0));
  m->add_joint(rod, Vec3(0));
  m->add_joint(lower, Vec3(0));
  m->add_joint(upper, Vec3(0));
  m->add_joint(lower, ram);
  return m;
}

std::unique_ptr<MechanismBodies> make_bodies(const KnucklePressData& d) { return sampled(planar_system(d)); }

}  // namespace kurbel
