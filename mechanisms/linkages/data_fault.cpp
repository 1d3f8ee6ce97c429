// data_fault.cpp — checks of lengths and mass properties, with messages that say what to change (C++17 island).
#include "mechanisms/linkages/data_fault.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mechanisms/loops/loops.h"

namespace kurbel {

namespace {

// The ground link is the shortest, and the loop passes: crank and rocker both turn.
bool is_drag_link(const CrankRockerLoop& l) {
  return l.ground + l.crank < l.coupler + l.rocker && l.ground + l.coupler < l.crank + l.rocker &&
         l.ground + l.rocker < l.crank + l.coupler;
}

}  // namespace

std::string in_mm(double metres) { return fmt::format("{:.6g} mm", metres * 1e3); }

void DataChecks::pivoted(const std::string& name, const LinkBody& link) {
  const double least = link.mass * link.com * link.com;
  if (link.inertia < least * (1 - 1e-12))
    add(name + "_inertia", fmt::format("{0}_inertia = {1:.6g} kg·m²; is about its fixed bearing and must be ≥ "
                                       "{0}_mass · {0}_com² = {2:.6g} kg·m²",
                                       name, link.inertia, least));
}

void DataChecks::floating(const std::string& name, const LinkBody& link, double carried_mass) {
  if (link.inertia > 0 && link.mass + carried_mass == 0)
    add(name + "_inertia", fmt::format("{0}_inertia = {1:.6g} kg·m² without mass; give {0}_mass, or leave the inertia "
                                       "out",
                                       name, link.inertia));
}

namespace {

std::string in_degrees(double angle) { return fmt::format("{:.4g}°", angle * 180 / std::acos(-1.0)); }

// Where a crank that cannot turn fully rocks; coupler and rocker lie in one line at the ends.
std::string rocking_of(const CrankRockerLoop& l) {
  const std::optional<CrankArc> arc = FourBarLoop{l.crank, l.coupler, l.rocker, l.ground}.arc();
  if (!arc) return "the loop cannot even be closed";
  return fmt::format("{} rocks between φ = {} and {}, where {} and {} lie in one line", l.crank_name,
                     in_degrees(arc->middle - arc->half), in_degrees(arc->middle + arc->half), l.coupler_name,
                     l.rocker_name);
}

struct NamedLength {
  double length;
  const char* name;
};

// Two links whose sum must not be longer than that of the two others.
struct Sums {
  NamedLength a, b, c, d;
  double excess() const { return a.length + b.length - (c.length + d.length); }
  bool nearly_equal() const { return std::fabs(excess()) <= 1e-12 * (c.length + d.length); }
};

void add_fault(const Sums& s, const char* relation, const std::string& consequence, DataChecks& checks) {
  checks.add(s.a.name, fmt::format("{0} + {1} = {2} + {3} = {4}; must be {5} {6} + {7} = {8} + {9} = {10}, {11}; "
                                   "shorten {0} or {1}, or lengthen {6} or {7}",
                                   s.a.name, s.b.name, in_mm(s.a.length), in_mm(s.b.length),
                                   in_mm(s.a.length + s.b.length), relation, s.c.name, s.d.name, in_mm(s.c.length),
                                   in_mm(s.d.length), in_mm(s.c.length + s.d.length), consequence));
}

}  // namespace

void check_crank_rocker(const CrankRockerLoop& l, DataChecks& checks) {
  if (is_drag_link(l)) {
    checks.add(l.ground_name,
               fmt::format("{} = {} is the shortest link, so that {} turns fully like the crank (drag link); an output "
                           "that rocks needs {} = {} as the shortest: lengthen {} beyond it",
                           l.ground_name, in_mm(l.ground), l.rocker_name, l.crank_name, in_mm(l.crank), l.ground_name));
    return;
  }
  const NamedLength crank = {l.crank, l.crank_name};
  const NamedLength links[] = {{l.coupler, l.coupler_name}, {l.rocker, l.rocker_name}, {l.ground, l.ground_name}};
  for (int k = 0; k < 3; ++k) {
    const Sums sums = {crank, links[k], links[(k + 1) % 3], links[(k + 2) % 3]};
    if (sums.excess() < 0 && !sums.nearly_equal()) continue;
    add_fault(sums, "<",
              "else the crank cannot turn fully against a rocking link: " +
                  (sums.nearly_equal() ? "all links fall into one line"
                                       : in_mm(sums.excess()) + " too long (" + rocking_of(l) + ")"),
              checks);
  }
}

// Excess of two links' sum over that of the others, in parts of it, that is neither a change point nor clear of one.
constexpr double hardly = 1e-6;

void check_loop_closes(const CrankRockerLoop& l, DataChecks& checks) {
  const NamedLength links[] = {
      {l.crank, l.crank_name}, {l.ground, l.ground_name}, {l.coupler, l.coupler_name}, {l.rocker, l.rocker_name}};
  for (int k = 0; k < 4; ++k) {
    const double others = l.crank + l.ground + l.coupler + l.rocker - links[k].length;
    if (links[k].length < others) continue;
    checks.add(links[k].name,
               fmt::format("{} = {}; must be < {}, the three other links together, else the loop cannot be closed; "
                           "shorten it or lengthen another one",
                           links[k].name, in_mm(links[k].length), in_mm(others)));
    return;
  }
  const bool rocks = FourBarLoop{l.crank, l.coupler, l.rocker, l.ground}.arc().has_value();
  const Sums all[] = {{links[0], links[1], links[2], links[3]},
                      {links[0], links[2], links[1], links[3]},
                      {links[0], links[3], links[1], links[2]}};
  for (const Sums& sums : all) {
    if (same_length(sums.a.length + sums.b.length, sums.c.length + sums.d.length)) continue;  // a change point
    if (sums.nearly_equal() || (rocks && std::fabs(sums.excess()) <= hardly * (sums.c.length + sums.d.length)))
      add_fault(sums, "equal to, or clearly different from,",
                fmt::format("but differs from it by {:.1e} of itself: links that lie in one line so nearly follow no "
                            "branch that rounding would not choose",
                            std::fabs(sums.excess()) / (sums.c.length + sums.d.length)),
                checks);
  }
}

void throw_if_any(const std::string& mechanism, const DataFaults& faults) {
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

}  // namespace kurbel
