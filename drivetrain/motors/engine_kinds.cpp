// engine_kinds.cpp — piston engines of several cylinders by firing order.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "drivetrain/motors/engine_torque.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"
#include "engine/numerics/angles.h"
#include "engine/reading/mirrored.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

// Top dead centre that a diagram counts from.
enum class Zero { firing, gas_exchange };

struct EngineKeys {
  std::vector<int> firing_order;
  std::optional<std::vector<double>> firing_intervals;  // [rad]
  double phase = 0;                                     // [rad]
  int strokes = 4;
  Zero zero = Zero::firing;                   // of the diagrams
  std::optional<CurveData> torque, pressure;  // of one cylinder [N·m], [Pa]
  std::optional<std::vector<int>> misfire;    // numbers of cylinders
  std::optional<CurveData> motored_torque, motored_pressure;
  std::optional<double> bore, radius, rod;  // [m]
  double outside_pressure = 0;              // [Pa]
  double inertia = 0;                       // [kg·m²]
  Window window;

  double cycle() const { return strokes * std::numbers::pi; }
};

Fields<EngineKeys> engine_fields() {
  using Keys = EngineKeys;
  return Fields<Keys>()
      .add(
          {.name = "firing_order", .doc = "numbers of the cylinders in the order in which they fire", .required = true},
          &Keys::firing_order)
      .add(quantity("firing_intervals", "rad", not_negative,
                    "crank angle from each firing to the next, the last back to the first; default: equal"),
           &Keys::firing_intervals)
      .add(defaulted("phase", "rad", "0 deg", any_number, "shaft angle where the first cylinder fires"), &Keys::phase)
      .add(choice("strokes", "four", "of a cycle: four take two turns, two take one"), &Keys::strokes,
           {{"four", 4}, {"two", 2}})
      .add(choice("zero", "firing",
                  "top dead centre that the diagrams count from. Where it is not given, diagrams are refused whose "
                  "peak or whose work speaks against it"),
           &Keys::zero, {{"firing", Zero::firing}, {"gas exchange", Zero::gas_exchange}})
      .add(curve("torque", {"angle"}, "N*m",
                 "of one cylinder over the crank angle, from `zero` on: tangential force times radius"),
           &Keys::torque)
      .add(curve("pressure", {"angle"}, "Pa",
                 "of one cylinder over the same angle, absolute (indicator diagram), in place of torque"),
           &Keys::pressure)
      .add({.name = "misfire", .fallback = "[]", .doc = "numbers of the cylinders that do not fire"}, &Keys::misfire)
      .add(curve("motored_torque", {"angle"}, "N*m",
                 "of a cylinder that does not fire; default: its compression, mirrored about top dead centre"),
           &Keys::motored_torque)
      .add(curve("motored_pressure", {"angle"}, "Pa",
                 "of a cylinder that does not fire, with pressure; default: its compression, mirrored about top dead "
                 "centre"),
           &Keys::motored_pressure)
      .add(quantity("bore", "m", positive, "diameter of a piston, with pressure"), &Keys::bore)
      .add(quantity("radius", "m", positive, "of the crank, with pressure"), &Keys::radius)
      .add(quantity("rod", "m", positive, "length of the rod, with pressure"), &Keys::rod)
      .add(defaulted("outside_pressure", "Pa", "1.013 bar", not_negative, "under the pistons, absolute"),
           &Keys::outside_pressure)
      .add(inertia_key("", "crankshaft with what rotates, and the mean of what oscillates"), &Keys::inertia)
      .add(window_fields(), &Keys::window);
}

// Angles at which the cylinders fire, one after the other; empty: what is given does not fit.
std::vector<double> firing_angles(const Reading<EngineKeys>& e) {
  using Keys = EngineKeys;
  const std::size_t n = e.firing_order.size();
  const double cycle = e.cycle();
  const auto refuse = [&](auto member, const std::string& text) {
    e.refuse(member, text);
    return std::vector<double>();
  };
  std::vector<int> sorted = e.firing_order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < n; ++k)
    if (sorted[k] != static_cast<int>(k + 1))
      return refuse(&Keys::firing_order,
                    fmt::format("firing_order must name each cylinder from 1 to {} once, e.g. [1, 3, 4, 2]", n));
  const std::vector<double> intervals =
      e.firing_intervals.value_or(std::vector<double>(n, cycle / static_cast<double>(n)));
  if (intervals.size() != n)
    return refuse(&Keys::firing_intervals,
                  fmt::format("{} firing_intervals for {} cylinders; give one from each firing to the next",
                              intervals.size(), n));
  const double sum = std::accumulate(intervals.begin(), intervals.end(), 0.0);
  if (e.firing_intervals && std::abs(sum - cycle) > 1e-9 * cycle)
    return refuse(&Keys::firing_intervals,
                  fmt::format("firing_intervals add up to {:.6g} deg; must be the cycle of {:.6g} deg",
                              sum * in_degrees, cycle * in_degrees));
  std::vector<double> angles = {e.phase};
  for (std::size_t k = 0; k + 1 < n; ++k) angles.push_back(angles.back() + intervals[k]);
  return angles;
}

// One cylinder's geometry, for an indicator diagram; none: what is given does not fit.
std::optional<CylinderGeometry> geometry_of(const Reading<EngineKeys>& e) {
  using Keys = EngineKeys;
  if (e.torque && e.pressure) {
    e.refuse(&Keys::pressure, "\"torque\" and \"pressure\" both given; keep one");
    return {};
  }
  if (!e.torque && !e.pressure) {
    e.refuse("nothing given of one cylinder; allowed: \"torque\" or \"pressure\"");
    return {};
  }
  for (const auto member : {&Keys::bore, &Keys::radius, &Keys::rod})
    if ((e.*member).has_value() != e.pressure.has_value()) {
      e.refuse(member, e.pressure ? fmt::format("\"pressure\" needs \"{}\"", e.key(member))
                                  : fmt::format("\"{}\" belongs to \"pressure\"; \"torque\" is given", e.key(member)));
      return {};
    }
  if (!e.pressure) return CylinderGeometry{};
  if (*e.rod <= *e.radius) {
    e.refuse(&Keys::rod, fmt::format("rod = {:.6g} mm; must be > radius = {:.6g} mm", *e.rod * 1e3, *e.radius * 1e3));
    return {};
  }
  return CylinderGeometry{0.25 * std::numbers::pi * *e.bore * *e.bore, *e.radius, *e.rod, e.outside_pressure};
}

using Diagram = std::optional<CurveData> EngineKeys::*;

// Where a diagram is greatest, as an angle from firing, −c/2 … c/2: of several places the nearest to it.
double peak_of(const Curve& diagram, double cycle) {
  constexpr int samples = 1440;
  double most = -HUGE_VAL, at = 0;
  const auto see = [&](double x) {
    const double value = diagram.value(x), angle = std::remainder(x, cycle);
    const double same = 1e-9 * diagram.max_abs();
    if (value > most + same || (value > most - same && std::abs(angle) < std::abs(at)))
      most = std::max(most, value), at = angle;
  };
  for (const double x : diagram.x()) see(x);
  for (int k = 0; k < samples; ++k) see(cycle * k / samples);
  return at;
}

// Where the scene does not say what its diagrams count from, they must show it: a cylinder's pressure peaks near firing,
// its torque within the half turn behind, and over a cycle it gives work. False, with what it looks like.
bool shows_its_zero(const Reading<EngineKeys>& e, Diagram key, const Curve& diagram, const CylinderGeometry& geometry) {
  if (e.given(&EngineKeys::zero)) return true;
  const double cycle = e.cycle(), peak = peak_of(diagram, cycle);
  const double from_firing = e.pressure ? std::abs(peak) : std::abs(peak - 0.25 * std::numbers::pi);
  const std::string seen =
      fmt::format("its peak, {}, stands at {:.4g} deg", with_unit(diagram.value(peak), e.pressure ? "Pa" : "N*m", 4),
                  (peak < 0 ? peak + cycle : peak) * in_degrees);
  const bool motored = key != &EngineKeys::pressure && key != &EngineKeys::torque;
  if (e.strokes == 4 && from_firing > 0.25 * cycle)
    return e.refuse(key, fmt::format("{}, as where 0 deg is the dead centre of gas exchange; say zero = \"gas "
                                     "exchange\", or zero = \"firing\" where 0 deg is firing all the same",
                                     seen));
  if (e.pressure && std::abs(peak) > 0.5 * std::numbers::pi)
    return e.refuse(key, fmt::format("{}, near no top dead centre; bring it there by a shift, e.g. shift = \"180 "
                                     "deg\", or say zero = \"firing\" where 0 deg is firing all the same",
                                     seen));
  if (motored) return true;
  constexpr int samples = 1440;
  double work = 0, size = 0;
  for (int k = 0; k < samples; ++k) {
    const double phi = cycle * (k + 0.5) / samples, read = diagram.value(phi);
    const double part = (e.pressure ? geometry.torque(read, phi) : read) * cycle / samples;
    work += part, size += std::abs(part);
  }
  return work >= -1e-3 * size ||
         e.refuse(key,
                  fmt::format(
                      "over a cycle it takes {:.4g} J, as where its angle counts backwards or from another dead "
                      "centre; reverse it, or give zero = \"firing\" or \"gas exchange\" where it brakes all the same",
                      -work));
}

// Adds a diagram over the cycle, counted from firing; false, with a message, where it does not fit.
bool put_diagram(const Reading<EngineKeys>& e, Diagram key, CurveData data, const CylinderGeometry& geometry,
                 std::vector<Curve>& diagrams) {
  const double cycle = e.cycle();
  if (data.period > 0 && std::abs(data.period - cycle) > 1e-9 * cycle)
    return e.refuse(key, fmt::format("period of {:.6g} deg; a {}-stroke engine repeats after {:.6g} deg",
                                     data.period * in_degrees, e.strokes == 4 ? "four" : "two", cycle * in_degrees));
  const double span = data.x.back() - data.x.front();
  if (span > cycle * (1 + 1e-9))
    return e.refuse(key, fmt::format("the diagram spans {:.6g} deg, more than the cycle of {:.6g} deg",
                                     span * in_degrees, cycle * in_degrees));
  if (e.zero == Zero::gas_exchange) {
    if (!data.by_formula.empty()) return e.refuse(key, "a formula is not moved to firing; write it so, or give points");
    for (double& x : data.x) x += 2 * std::numbers::pi;
  }
  try {
    diagrams.push_back(data.curve(cycle));
    if (!shows_its_zero(e, key, diagrams.back(), geometry)) return false;
  } catch (const std::invalid_argument& error) {
    return e.refuse(key, error.what());
  }
  return true;
}

// The cylinders that do not fire take the motored diagram, the second one.
bool let_misfire(const Reading<EngineKeys>& e, Diagram fired, const CylinderGeometry& geometry,
                 std::vector<EngineTorque::Cylinder>& cylinders, std::vector<Curve>& diagrams) {
  using Keys = EngineKeys;
  const auto motored = e.pressure ? &Keys::motored_pressure : &Keys::motored_torque;
  const auto other = e.pressure ? &Keys::motored_torque : &Keys::motored_pressure;
  if (e.*other)
    return e.refuse(other, fmt::format("\"{}\" belongs to \"{}\"; \"{}\" is given", e.key(other),
                                       e.pressure ? "torque" : "pressure", e.key(fired)));
  if (!e.misfire || e.misfire->empty()) return true;
  for (const int number : *e.misfire) {
    const auto at = std::find(e.firing_order.begin(), e.firing_order.end(), number);
    if (at == e.firing_order.end())
      return e.refuse(&Keys::misfire, fmt::format("there is no cylinder {}; allowed: 1 to {}, e.g. [1]", number,
                                                  e.firing_order.size()));
    cylinders[static_cast<std::size_t>(at - e.firing_order.begin())].diagram = 1;
  }
  if (e.*motored) return put_diagram(e, motored, *(e.*motored), geometry, diagrams);
  try {
    CurveData from_firing = *(e.*fired);
    if (e.zero == Zero::gas_exchange)
      for (double& x : from_firing.x) x += 2 * std::numbers::pi;
    diagrams.push_back(first_half_turn_mirrored(from_firing, e.cycle(), !e.pressure).curve());
  } catch (const std::invalid_argument& error) {
    return e.refuse(&Keys::misfire, error.what());
  }
  return true;
}

void build_engine(const Section& s, const Reading<EngineKeys>& e, Network& net) {
  const int node = single_shaft(s, e.inertia, net);
  const std::vector<double> angles = firing_angles(e);
  const std::optional<CylinderGeometry> geometry = geometry_of(e);
  if (!geometry || angles.empty()) return;
  const auto fired = e.pressure ? &EngineKeys::pressure : &EngineKeys::torque;
  std::vector<Curve> diagrams;
  if (e.zero == Zero::gas_exchange && e.strokes != 4)
    return static_cast<void>(
        e.refuse(&EngineKeys::zero,
                 "a two-stroke engine exchanges its gas at bottom dead centre, 180 deg from firing; say \"firing\", "
                 "with `shift` in the diagram where its angle counts from elsewhere"));
  if (!put_diagram(e, fired, *(e.*fired), *geometry, diagrams)) return;
  std::vector<EngineTorque::Cylinder> cylinders;
  for (std::size_t k = 0; k < angles.size(); ++k) cylinders.push_back({angles[k], 0});
  if (!let_misfire(e, fired, *geometry, cylinders, diagrams)) return;
  std::string substitute;
  if (diagrams.size() > 1 && !e.motored_torque && !e.motored_pressure)
    substitute = words_of_mirrored(s.name, e.pressure ? "motored_pressure" : "motored_torque");
  net.put(node, s.name, EngineTorque(std::move(diagrams), *geometry, std::move(cylinders), std::move(substitute)),
          e.window);
}

}  // namespace

std::vector<Kind> engine_kinds() {
  return {
      kind_of<engine_fields, build_engine>(on_a_shaft, "engine",
                                           "piston engine of equal cylinders on a rigid crankshaft, from the diagram "
                                           "of one cylinder and the firing order"),
  };
}

}  // namespace kurbel
