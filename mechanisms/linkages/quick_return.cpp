// quick_return.cpp — builds the quick-return mechanism in Simbody (C++17 island).
//
//   ground ─Pin(q₀ = φ)→ crank ═ pin A closed by two PointInPlane ═ block ←Slider(q₂ = PA)─ lever ←Pin(q₁)─ ground
//                                                    lever ─Pin(q₃)→ link with the ram ─PointInPlane→ y = guide
//
// Determinant of the closures: −PA · link · cos(link's angle).
#include "mechanisms/linkages/quick_return.h"

#include <fmt/core.h>

#include <cmath>

#include "mechanisms/linkages/planar_system.h"

namespace kurbel {

using SimTK::Transform;
using SimTK::Vec3;

namespace {

// The block passes close by the lever's bearing, where the lever's speed has no bound.
constexpr double least_clearance = 1e-3;  // of the radius

// Greatest distance of the lever's end from the guide.
double greatest_rise(const QuickReturnData& d) {
  const double pi = std::acos(-1.0);
  const double swing = d.lever_turns_fully() ? pi : std::asin(d.radius / d.pivot_distance);
  const Range sine = sine_range(pi / 2 + d.lever_angle - swing, pi / 2 + d.lever_angle + swing);
  return std::fmax(std::fabs(d.guide_height - d.lever * sine.least),
                   std::fabs(d.guide_height - d.lever * sine.greatest));
}

void check_geometry(const QuickReturnData& d, DataChecks& checks) {
  if (std::fabs(d.pivot_distance - d.radius) < least_clearance * d.radius) {
    checks.add("pivot_distance",
               fmt::format("pivot_distance = {} against radius = {}: the crank pin passes over the lever's bearing; "
                           "make it longer for a rocking lever (shaper) or shorter for a turning one (Whitworth)",
                           in_mm(d.pivot_distance), in_mm(d.radius)));
    return;
  }
  const double rise = greatest_rise(d);
  if (!(d.link > rise))
    checks.add("link", fmt::format("link = {}; must be > {}, the greatest distance of the lever's end from the guide, "
                                   "else the crank cannot turn fully: {} too short; lengthen the link or set "
                                   "guide_height between the lever's heights",
                                   in_mm(d.link), in_mm(rise), in_mm(rise - d.link)));
}

}  // namespace

DataFaults faults_of(const QuickReturnData& d) {
  DataChecks checks;
  checks.positive("radius", d.radius, "m");
  checks.positive("pivot_distance", d.pivot_distance, "m");
  checks.positive("lever", d.lever, "m");
  checks.finite("lever_angle", d.lever_angle, "rad");
  checks.positive("link", d.link, "m");
  checks.finite("guide_height", d.guide_height, "m");
  checks.pivoted("crank", d.crank_body);
  checks.pivoted("lever", d.lever_body);
  checks.floating("block", {d.block_mass, 0, d.block_inertia});
  checks.floating("link", d.link_body, d.ram_mass);
  checks.not_negative("ram_mass", d.ram_mass, "kg");
  checks.not_negative("gravity", d.gravity, "m/s2");
  checks.finite("stroke_angle", d.stroke_angle, "rad");
  if (checks.sound()) check_geometry(d, checks);
  return checks.take();
}

std::vector<double> values_of(const QuickReturnData& d) {
  std::vector<double> values = {d.radius,       d.pivot_distance,   d.lever,      d.lever_angle,   d.link,
                                d.guide_height, double(d.backward), d.block_mass, d.block_inertia, d.ram_mass,
                                d.gravity,      d.stroke_angle};
  for (const LinkBody* b : {&d.crank_body, &d.lever_body, &d.link_body})
    values.insert(values.end(), {b->mass, b->com, b->inertia});
  return values;
}

LinkageDrawing drawing_of(const QuickReturnData& d) {
  return {"Quick-return",
          d.stroke_angle,
          {{"slot", {2, 1}}, {"link", {2, 3}}, {"link", {3, 4}}, {"slider", {4}}, {"crank", {0, 1}}, {"block", {1, 2}}},
          {0, 2},
          4,
          false};
}

std::unique_ptr<PlanarSystem> planar_system(const QuickReturnData& d) {
  throw_if_any("quick-return", faults_of(d));
  auto m = std::make_unique<PlanarSystem>("quick-return");
  const Vec3 lever_end(d.lever * std::cos(d.lever_angle), d.lever * std::sin(d.lever_angle), 0), ram(d.link, 0, 0);
  SimTK::MobilizedBody::Pin crank(m->matter.Ground(), Transform(), pivoted_link(d.crank_body), Transform());
  SimTK::MobilizedBody::Pin lever(m->matter.Ground(), Vec3(0, -d.pivot_distance, 0), pivoted_link(d.lever_body),
                                  Vec3(0));
  SimTK::MobilizedBody::Slider block(lever, Transform(),
                                     floating_link({d.block_mass, 0, d.block_inertia}, "quick-return: block_inertia"),
                                     Transform());
  SimTK::MobilizedBody::Pin link(lever, lever_end,
                                 floating_link(d.link_body, "quick-return: link_inertia", d.ram_mass, d.link), Vec3(0));
  close_pin(crank, Vec3(d.radius, 0, 0), block, Vec3(0));
  const double guide = d.guide_height - d.pivot_distance;
  SimTK::Constraint::PointInPlane(m->matter.Ground(), SimTK::UnitVec3(0, 1, 0), guide, link, ram);

  m->gravity = d.gravity;
  m->elevation = d.stroke_angle;
  m->determinant_sign = d.backward ? 1 : -1;
  m->start = [d](double phi) {
    const double x = d.radius * std::cos(phi), y = d.pivot_distance + d.radius * std::sin(phi);  // A from P
    const double slot = std::atan2(y, x);
    const double rise = std::asin((d.guide_height - d.lever * std::sin(slot + d.lever_angle)) / d.link);
    const double link_angle = d.backward ? std::acos(-1.0) - rise : rise;
    return std::vector<double>{slot, std::hypot(x, y), within_a_turn(link_angle - slot)};
  };
  m->add_weight(d.crank_body.mass, crank, Vec3(d.crank_body.com, 0, 0));
  m->add_weight(d.lever_body.mass, lever, Vec3(d.lever_body.com, 0, 0));
  m->add_weight(d.block_mass, block, Vec3(0));
  m->add_weight(d.link_body.mass, link, Vec3(d.link_body.com, 0, 0));
  m->add_weight(d.ram_mass, link, ram);
  m->set_output(link, ram);
  m->add_joint(crank, Vec3(0));
  m->add_joint(crank, Vec3(d.radius, 0, 0));
  m->add_joint(lever, Vec3(0));
  m->add_joint(link, Vec3(0));
  m->add_joint(link, ram);
  return m;
}

std::unique_ptr<MechanismBodies> make_bodies(const QuickReturnData& d) { return sampled(planar_system(d)); }

}  // namespace kurbel
