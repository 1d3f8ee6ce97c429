// mechanism_sheets.cpp — plan, table and diagrams of one mechanism's motion.
#include "studies/sheet/mechanism_sheets.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/numerics/angles.h"
#include "studies/sheet/diagram.h"
#include "studies/sheet/linkage_drawing.h"
#include "studies/sheet/table.h"

namespace kurbel {
namespace {

using Motions = std::vector<MechanismMotionAt>;
using Get = std::function<double(const MechanismMotionAt&)>;

Motions motions_of(const MechanismOnSheet& m, const std::vector<LinkAt>& list) {
  Motions all;
  for (const LinkAt& at : list) all.push_back(motion_at(m, at.phi, at.omega, at.alpha));
  return all;
}

std::vector<double> values_of(const Motions& motions, const Get& get) {
  std::vector<double> list;
  for (const MechanismMotionAt& m : motions) list.push_back(get(m));
  return list;
}

double length_of(PlanePoint p) { return std::hypot(p.x, p.y); }

// ω and ε of links that turn otherwise than the crank; those that only slide along the frame do not.
void add_links(SheetTable& t, const Motions& motions) {
  for (std::size_t i = 1; i < motions.front().links.size(); ++i) {
    double turning = 0;
    for (const MechanismMotionAt& m : motions) turning = std::max(turning, std::abs(m.links[i].omega));
    if (turning == 0) continue;
    const std::string number = std::to_string(i + 1);
    t.columns.push_back({"ω_" + number, "rad/s", values_of(motions, [i](const auto& m) { return m.links[i].omega; })});
    t.columns.push_back({"ε_" + number, "rad/s²", values_of(motions, [i](const auto& m) { return m.links[i].alpha; })});
    t.note += fmt::format("{} {}; ", number, motions.front().links[i].name);
  }
}

// Speeds that are the output's or do not change are stated already.
bool is_reported(const std::vector<double>& speeds, const Motions& motions) {
  bool even = true, of_output = true;
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    even = even && std::abs(speeds[k] - std::abs(motions[k].omega / motions[0].omega) * speeds[0]) < 1e-9 * speeds[0];
    of_output = of_output && std::abs(speeds[k] - std::abs(motions[k].velocity)) < 1e-9 * std::abs(speeds[k]) + 1e-12;
  }
  return even || of_output;
}

void add_points(SheetTable& t, const Motions& motions, std::vector<JointMotion> MechanismMotionAt::*points) {
  for (std::size_t i = 0; i < (motions.front().*points).size(); ++i) {
    const std::string& name = (motions.front().*points)[i].name;
    const std::string index = name.size() > 1 ? "S" + name.substr(2) : name;
    const std::vector<double> speeds =
        values_of(motions, [&](const auto& m) { return length_of((m.*points)[i].velocity); });
    if (is_reported(speeds, motions)) continue;
    t.columns.push_back({"v_" + index, "m/s", speeds});
    t.columns.push_back({"a_" + index, "m/s²",
                         values_of(motions, [&](const auto& m) { return length_of((m.*points)[i].acceleration); })});
  }
}

SheetTable kinematic_table(const MechanismOnSheet& m, const SheetMotion& motion, const Motions& at,
                           const std::string& speed) {
  const bool rocks = m.mechanism.rocks();
  const std::string x = rocks ? "ψ" : "x", unit = rocks ? "rad" : "m";
  SheetTable t{.title = fmt::format("{}: position, velocity, acceleration", m.mechanism.name),
               .labels = labels_of(motion.positions),
               .columns = {},
               .stressed = stressed(motion.positions)};
  const auto add = [&](const std::string& symbol, const std::string& in, const Get& get) {
    t.columns.push_back({symbol, in, values_of(at, get)});
  };
  const double turn = 2 * std::numbers::pi * std::round(m.mechanism.cycle() / (2 * std::numbers::pi));
  const double first = at.front().output;
  add("φ", "°", [turn](const auto& k) { return in_degrees * (k.crank - turn * std::floor(k.crank / turn + 1e-12)); });
  add(x, unit, [](const auto& k) { return k.output; });
  add("s", unit,
      [&](const auto& k) { return rocks ? std::remainder(k.output - first, 2 * std::numbers::pi) : k.output - first; });
  add(x + "′", rocks ? "1" : "m/rad", [](const auto& k) { return k.first; });
  add(x + "″", rocks ? "1/rad" : "m/rad²", [](const auto& k) { return k.second; });
  add(rocks ? "ψ̇" : "v", rocks ? "rad/s" : "m/s", [](const auto& k) { return k.velocity; });
  add(rocks ? "ψ̈" : "a", rocks ? "rad/s²" : "m/s²", [](const auto& k) { return k.acceleration; });
  t.note = fmt::format(
      "{0}: of the output, positive {1}; s from position 0; {0}′ = d{0}/dφ and {0}″ its analogues of velocity and "
      "acceleration; φ of the crank from +x, counter-clockwise; {2}.\nlinks: 1 crank; ",
      x, rocks ? "counter-clockwise" : "along +x", speed);
  add_links(t, at);
  add_points(t, at, &MechanismMotionAt::pins);
  add_points(t, at, &MechanismMotionAt::centres);
  t.note +=
      "v, a with an index: magnitudes, of pins and of centres of mass S. Letters: edges of the load and its greatest "
      "value.";
  return t;
}

SheetCurve curve_of(const std::string& symbol, const SheetMotion& motion, const Motions& at, const Motions& between,
                    Pen pen, const Get& get) {
  return {symbol, motion.way, values_of(between, get), values_of(at, get), pen};
}

void add_motion(Sheets& sheets, const MechanismOnSheet& m, const SheetMotion& motion, const Motions& at,
                const std::string& speed) {
  const Motions between = motions_of(m, motion.between);
  const bool rocks = m.mechanism.rocks();
  const double first = at.front().output;
  const Get place = [=](const auto& k) {
    return rocks ? std::remainder(k.output - first, 2 * std::numbers::pi) : k.output - first;
  };
  const double rotates = m.mechanism.travel.winding;
  std::vector<SheetDiagram> list = {
      {"Displacement of the output from position 0",
       "μ_s",
       rocks ? "rad" : "m",
       {curve_of("s", motion, at, between, Pen::main, place)}},
      {"Its velocity",
       "μ_v",
       rocks ? "rad/s" : "m/s",
       {curve_of("v", motion, at, between, Pen::drive, [](const auto& k) { return k.velocity; })}},
      {"Its acceleration",
       "μ_a",
       rocks ? "rad/s²" : "m/s²",
       {curve_of("a", motion, at, between, Pen::load, [](const auto& k) { return k.acceleration; })}}};
  if (rotates != 0) list.erase(list.begin());
  add_diagrams(sheets, fmt::format("{}: diagrams of motion", m.mechanism.name), motion.cycle.length, motion.positions,
               list, "velocity and acceleration of the output by time, " + speed);
}

}  // namespace

SheetMotion even_motion(const SheetCycle& cycle, std::vector<SheetPosition> positions, double omega) {
  SheetMotion m{cycle, std::move(positions), {}, {}, {}};
  for (const SheetPosition& p : m.positions) m.at.push_back({p.phi, omega, 0});
  constexpr int points = 360;
  for (int i = 0; i <= points; ++i) {
    m.way.push_back(cycle.length * i / points);
    m.between.push_back({cycle.phi_at(m.way.back()), omega, 0});
  }
  return m;
}

void add_mechanism(Sheets& sheets, const MechanismOnSheet& m, const SheetMotion& motion, const std::string& speed,
                   const std::string& structure) {
  Canvas plan;
  const PlanPlaced placed = draw_linkage(plan, sheets.room(), m, motion.positions, motion.cycle.sense);
  Canvas& c = sheets.add(fmt::format("{}: {} in its positions", m.mechanism.name, m.mechanism.data.drawing().name),
                         placed.scale.words());
  c = plan;
  add_lines(c, sheets.foot(),
            lengths_in_words(m, placed.scale) +
                ".\nNumbers from a dead centre of the output on, in the sense of ω; letters: edges of the load and its "
                "greatest value. Dash-dotted: paths.\n" +
                structure);
  const Motions at = motions_of(m, motion.at);
  add_table(sheets, kinematic_table(m, motion, at, speed));
  add_motion(sheets, m, motion, at, speed);
}

std::vector<std::string> labels_of(const std::vector<SheetPosition>& positions) {
  std::vector<std::string> labels;
  for (const SheetPosition& p : positions) labels.push_back(p.label);
  return labels;
}

std::vector<bool> stressed(const std::vector<SheetPosition>& positions) {
  std::vector<bool> list;
  for (const SheetPosition& p : positions) list.push_back(!p.numbered || p.greatest);
  return list;
}

}  // namespace kurbel
