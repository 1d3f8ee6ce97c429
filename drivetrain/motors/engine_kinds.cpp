// engine_kinds.cpp — piston engines of several cylinders by firing order.
#include "drivetrain/motors/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "drivetrain/motors/engine_torque.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

// Angles at which the cylinders fire, one after the other; empty: what is given does not fit.
std::vector<double> firing_angles(const Section& s, double cycle, Messages& messages) {
  const std::vector<double>& order = s["firing_order"].numbers;
  const std::size_t n = order.size();
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("engine \"{}\": {}", s.name, text));
    return std::vector<double>();
  };
  std::vector<double> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < n; ++k)
    if (sorted[k] != static_cast<double>(k + 1))
      return refuse("firing_order",
                    fmt::format("firing_order must name each cylinder from 1 to {} once, e.g. [1, 3, 4, "
                                "2]",
                                n));
  if (n == 0) return refuse("firing_order", "firing_order is empty; one cylinder is [1]");
  std::vector<double> intervals(n, cycle / static_cast<double>(n));
  if (s.given("firing_intervals")) {
    intervals = s["firing_intervals"].numbers;
    if (intervals.size() != n)
      return refuse("firing_intervals",
                    fmt::format("{} firing_intervals for {} cylinders; give one from each firing to "
                                "the next",
                                intervals.size(), n));
    double sum = 0;
    for (const double interval : intervals) sum += interval;
    if (std::abs(sum - cycle) > 1e-9 * cycle)
      return refuse("firing_intervals",
                    fmt::format("firing_intervals add up to {:.6g} deg; must be the cycle of {:.6g} "
                                "deg",
                                sum * degrees, cycle * degrees));
  }
  std::vector<double> angles = {s.number("phase")};
  for (std::size_t k = 0; k + 1 < n; ++k) angles.push_back(angles.back() + intervals[k]);
  return angles;
}

// One cylinder's geometry, for an indicator diagram.
bool read_geometry(const Section& s, CylinderGeometry& geometry, Messages& messages) {
  if (s.has("torque") == s.has("pressure")) {
    messages.add(s.has("pressure") ? s.where("pressure") : s.at,
                 fmt::format("engine \"{}\": {}", s.name,
                             s.has("pressure") ? "\"torque\" and \"pressure\" both given; keep one"
                                               : "nothing given of one cylinder; allowed: \"torque\" or \"pressure\""));
    return false;
  }
  for (const char* key : {"bore", "radius", "rod"})
    if (s.given(key) != s.has("pressure")) {
      messages.add(
          s.where(key),
          fmt::format("engine \"{}\": {}", s.name,
                      s.has("pressure") ? fmt::format("\"pressure\" needs \"{}\"", key)
                                        : fmt::format("\"{}\" belongs to \"pressure\"; \"torque\" is given", key)));
      return false;
    }
  if (!s.has("pressure")) return true;
  if (s.number("rod") <= s.number("radius")) {
    messages.add(s.where("rod"), fmt::format("engine \"{}\": rod = {:.6g} mm; must be > radius = {:.6g} mm", s.name,
                                             s.number("rod") * 1e3, s.number("radius") * 1e3));
    return false;
  }
  geometry = {0.25 * std::numbers::pi * s.number("bore") * s.number("bore"), s.number("radius"), s.number("rod"),
              s.number("outside_pressure")};
  return true;
}

void build_engine(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const Window window = window_of(s, messages);
  const double cycle = (s.text("strokes") == "four" ? 4 : 2) * std::numbers::pi;
  const std::vector<double> angles = firing_angles(s, cycle, messages);
  CylinderGeometry geometry;
  if (!read_geometry(s, geometry, messages) || angles.empty()) return;
  const char* key = s.has("pressure") ? "pressure" : "torque";
  const CurveData& data = s[key].curve;
  if (data.period > 0 && std::abs(data.period - cycle) > 1e-9 * cycle) {
    messages.add(s.where(key),
                 fmt::format("engine \"{}\": period of {:.6g} deg; a {}-stroke engine repeats after {:.6g} "
                             "deg",
                             s.name, data.period * degrees, s.text("strokes"), cycle * degrees));
    return;
  }
  const double span = data.x.back() - data.x.front();
  if (span > cycle * (1 + 1e-9)) {
    messages.add(s.where(key), fmt::format("engine \"{}\": the diagram spans {:.6g} deg, more than the cycle of {:.6g} "
                                           "deg",
                                           s.name, span * degrees, cycle * degrees));
    return;
  }
  try {
    net.put(node, s.name, EngineTorque(Curve(data.x, data.y, data.form, cycle), geometry, angles), window);
  } catch (const std::invalid_argument& error) {
    messages.add(s.where(key), fmt::format("engine \"{}\": {}", s.name, error.what()));
  }
}

}  // namespace

std::vector<Kind> engine_kinds() {
  return {
      {.name = "engine",
       .doc = "piston engine of equal cylinders on a rigid crankshaft, from the diagram of one cylinder and the firing "
              "order",
       .keys = joined(
           {{.name = "firing_order",
             .type = KeyType::integers,
             .doc = "numbers of the cylinders in the order in which they fire",
             .required = true},
            {.name = "firing_intervals",
             .type = KeyType::quantities,
             .unit = "rad",
             .domain = not_negative,
             .doc = "crank angle from each firing to the next, the last back to the first; default: equal"},
            {.name = "phase",
             .unit = "rad",
             .fallback = "\"0 deg\"",
             .doc = "shaft angle where the first cylinder fires"},
            {.name = "strokes",
             .type = KeyType::text,
             .fallback = "\"four\"",
             .doc = "of a cycle: four take two turns, two take one",
             .choices = {"four", "two"}},
            {.name = "torque",
             .type = KeyType::curve,
             .unit = "N*m",
             .doc =
                 "of one cylinder over the crank angle, 0 = top dead centre at firing: tangential force times radius",
             .choices = {"angle"}},
            {.name = "pressure",
             .type = KeyType::curve,
             .unit = "Pa",
             .doc = "of one cylinder over the same angle, absolute (indicator diagram), in place of torque",
             .choices = {"angle"}},
            {.name = "bore", .unit = "m", .domain = positive, .doc = "diameter of a piston, with pressure"},
            {.name = "radius", .unit = "m", .domain = positive, .doc = "of the crank, with pressure"},
            {.name = "rod", .unit = "m", .domain = positive, .doc = "length of the rod, with pressure"},
            {.name = "outside_pressure",
             .unit = "Pa",
             .fallback = "\"1.013 bar\"",
             .domain = not_negative,
             .doc = "under the pistons, absolute"},
            inertia_key("", "crankshaft with what rotates, and the mean of what oscillates")},
           window_keys()),
       .build = build_engine},
  };
}

}  // namespace kurbel
