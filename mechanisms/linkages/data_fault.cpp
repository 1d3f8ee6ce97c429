// data_fault.cpp — checks of lengths and mass properties, with messages that say what to change (C++17 island).
#include "mechanisms/linkages/data_fault.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kurbel {

namespace {

// The ground link is the shortest, and the loop passes: crank and rocker both turn.
bool is_drag_link(const CrankRockerLoop& l) {
  return l.ground + l.crank < l.coupler + l.rocker && l.ground + l.coupler < l.crank + l.rocker &&
         l.ground + l.rocker < l.crank + l.coupler;
}

}  // namespace

std::string in_mm(double metres) { return fmt::format("{:.6g} mm", metres * 1e3); }

void DataChecks::finite(const char* key, double value, const char* unit) {
  if (!std::isfinite(value)) add(key, fmt::format("{} = {} {}; must be finite", key, value, unit));
}
void DataChecks::positive(const char* key, double value, const char* unit) {
  if (!(value > 0 && std::isfinite(value)))
    add(key, fmt::format("{} = {:.6g} {}; must be > 0 {}", key, value, unit, unit));
}
void DataChecks::not_negative(const char* key, double value, const char* unit) {
  if (!(value >= 0 && std::isfinite(value)))
    add(key, fmt::format("{} = {:.6g} {}; must be >= 0 {}", key, value, unit, unit));
}

void DataChecks::pivoted(const std::string& name, const LinkBody& link) {
  not_negative((name + "_mass").c_str(), link.mass, "kg");
  finite((name + "_com").c_str(), link.com, "m");
  not_negative((name + "_inertia").c_str(), link.inertia, "kg m2");
  const double least = link.mass * link.com * link.com;
  if (link.inertia < least * (1 - 1e-12))
    add(name + "_inertia", fmt::format("{0}_inertia = {1:.6g} kg·m²; is about its fixed bearing and must be ≥ "
                                       "{0}_mass · {0}_com² = {2:.6g} kg·m²",
                                       name, link.inertia, least));
}

void DataChecks::floating(const std::string& name, const LinkBody& link, double carried_mass) {
  not_negative((name + "_mass").c_str(), link.mass, "kg");
  finite((name + "_com").c_str(), link.com, "m");
  not_negative((name + "_inertia").c_str(), link.inertia, "kg m2");
  if (link.inertia > 0 && link.mass + carried_mass == 0)
    add(name + "_inertia", fmt::format("{0}_inertia = {1:.6g} kg·m² without mass; give {0}_mass, or leave the inertia "
                                       "out",
                                       name, link.inertia));
}

void check_crank_rocker(const CrankRockerLoop& l, DataChecks& checks) {
  if (is_drag_link(l)) {
    checks.add(l.ground_name,
               fmt::format("{} = {} is the shortest link, so that {} turns fully like the crank (drag link); an output "
                           "that rocks needs {} = {} as the shortest: lengthen {} beyond it",
                           l.ground_name, in_mm(l.ground), l.rocker_name, l.crank_name, in_mm(l.crank), l.ground_name));
    return;
  }
  const struct {
    double length;
    const char* name;
  } links[] = {{l.coupler, l.coupler_name}, {l.rocker, l.rocker_name}, {l.ground, l.ground_name}};
  for (int k = 0; k < 3; ++k) {
    const auto &with = links[k], &b = links[(k + 1) % 3], &c = links[(k + 2) % 3];
    const double short_side = l.crank + with.length, long_side = b.length + c.length;
    if (short_side < long_side * (1 - 1e-12)) continue;
    const double excess = short_side - long_side;
    checks.add(l.crank_name,
               fmt::format("{0} + {1} = {3} + {4} = {5}; must be < {2} + {6} = {7} + {8} = {9}, else the crank cannot "
                           "turn fully against a rocking link: {10}; shorten {0} or {1}, or lengthen {2} or {6}",
                           l.crank_name, with.name, b.name, in_mm(l.crank), in_mm(with.length), in_mm(short_side),
                           c.name, in_mm(b.length), in_mm(c.length), in_mm(long_side),
                           excess > 1e-9 * long_side ? in_mm(excess) + " too long" : "all links fall into one line"));
  }
}

void throw_if_any(const char* mechanism, const DataFaults& faults) {
  if (!faults.empty()) throw std::invalid_argument(fmt::format("{}: {}", mechanism, faults.front().text));
}

Range sine_range(double from, double to) {
  const double pi = std::acos(-1.0);
  const auto passes = [&](double angle) {  // angle + a whole number of turns lies within
    return std::floor((to - angle) / (2 * pi)) >= std::ceil((from - angle) / (2 * pi));
  };
  const double a = std::sin(from), b = std::sin(to);
  return {passes(-pi / 2) ? -1 : std::min(a, b), passes(pi / 2) ? 1 : std::max(a, b)};
}

PlanePoint meeting_point(PlanePoint a, double a_length, PlanePoint b, double b_length, bool left) {
  const double dx = b.x - a.x, dy = b.y - a.y, s = std::hypot(dx, dy);
  const double along = (s * s + (a_length - b_length) * (a_length + b_length)) / (2 * s);
  const double aside = (left ? 1 : -1) * std::sqrt(std::max(0.0, (a_length - along) * (a_length + along)));
  return {a.x + (along * dx - aside * dy) / s, a.y + (along * dy + aside * dx) / s};
}

}  // namespace kurbel
