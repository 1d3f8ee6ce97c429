// quick_return.cpp — checks of the lengths, the loop as bodies and joints, the drawing.
#include "mechanisms/linkages/quick_return.h"

#include <fmt/core.h>

#include <cmath>

#include "mechanisms/linkages/link_bodies.h"
#include "mechanisms/loops/loops.h"

namespace kurbel {

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
  checks.pivoted("crank", d.crank_body);
  checks.pivoted("lever", d.lever_body);
  checks.floating("block", {d.block_mass, 0, d.block_inertia});
  checks.floating("link", d.link_body, d.ram_mass);
  if (checks.valid()) check_geometry(d, checks);
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
          {0, 1, 3, 4, 5},
          {{"slot", {2, 1}}, {"link", {2, 3}}, {"link", {3, 4}}, {"slider", {4}}, {"crank", {0, 1}}, {"block", {1, 2}}},
          {0, 2},
          4,
          false};
}

PlanarLinkage linkage_of(const QuickReturnData& m, long double phi) {
  const Direction crank = Direction::of_variable(phi);
  const Path pin = along(crank, m.radius), pivot = {Taylor(), Taylor(-m.pivot_distance)};
  const Path to_pin = pin - pivot;
  const Taylor distance = sqrt(to_pin.x * to_pin.x + to_pin.y * to_pin.y);
  const Direction slot = {to_pin.x / distance, to_pin.y / distance};
  const Path end = pivot + along(slot + Direction::constant(m.lever_angle), m.lever);
  const Direction link = to_line(end, static_cast<long double>(m.guide_height) - m.pivot_distance, m.link, m.backward);
  PlanarLinkage l;
  l.gravity = m.gravity, l.elevation = m.stroke_angle;
  l.add(pivoted("crank", m.crank_body, {}, crank));
  l.add(pivoted("lever", m.lever_body, pivot, slot));
  l.add(floating("block", {m.block_mass, 0, m.block_inertia}, pin, slot));
  l.add(floating("link", m.link_body, end, link));
  l.join({"main bearing", PlanarLinkage::frame, 0, {}});
  l.join({"crank pin", 0, 2, pin});
  l.join({"slot", 2, 1, pin, true, slot, true});
  l.join({"lever bearing", PlanarLinkage::frame, 1, pivot});
  l.join({"lever pin", 1, 3, end});
  add_slider(l, "ram", m.ram_mass, "ram pin", end + along(link, m.link));
  return l;
}

}  // namespace kurbel
