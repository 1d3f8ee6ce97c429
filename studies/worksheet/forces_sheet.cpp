// forces_sheet.cpp — forces in the form of a sheet; tables and diagrams of reactions and balancing torque.
#include "studies/worksheet/forces_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "mechanisms/reduced/mechanism.h"
#include "studies/forces/crank_motion.h"
#include "studies/reduce/mechanism_words.h"
#include "studies/sheet/diagram.h"
#include "studies/sheet/table.h"
#include "studies/worksheet/motion_plans.h"

namespace kurbel {
namespace {

void name_parts(ForcesSheet& sheet, const LinkageForces& f) {
  for (const LinkForces& l : f.links) sheet.links.emplace_back(l.name);
  for (const JointForces& j : f.joints)
    sheet.joints.push_back(
        {reaction_symbol(f, j.from, j.on), fmt::format("{}: {} on {}", j.name, j.from, j.on), j.slides});
}

// --- positions ---

std::vector<SheetPosition> positions_of(const PrescribedCycle& c, const SheetCycle& cycle) {
  constexpr int samples = 720;
  double largest = 0, least = HUGE_VAL, where = 0;
  const auto look = [&](double phi, double beyond) {
    const double load = std::abs(c.load(phi));
    least = std::min(least, load);
    if (load > largest * beyond) largest = load, where = phi;
  };
  for (const double edge : c.edges)
    for (const double side : {-beside_edge, 0.0, beside_edge}) look(edge + side, 1 + 1e-9);
  for (int k = 0; k < samples; ++k) look(c.length * k / samples, 1 + 1e-3);  // an edge rather than a place beside it
  const BentEdges bent = bent_edges(c.edges, c.length, c.load, largest);
  return sheet_positions(cycle, bent.at, largest > 1.001 * least ? std::optional(where) : std::nullopt, bent.bend);
}

MechanismOnSheet drawn(Mechanism mechanism) {
  check_rotates(mechanism);
  mechanism.phase = 0;  // angles are those of the crank
  return {std::move(mechanism), 1};
}

// --- sheets ---

using P = const PositionForces&;
using Get = std::function<double(P)>;
using TableOfForces = TableOfPositions<PositionForces>;

double phi_of(P p) { return p.forces.state.phi; }
double load_of(P p) { return p.forces.state.load; }
double torque_of(P p) { return p.forces.torque; }
Get reaction_of(std::size_t joint) {
  return [joint](P p) { return p.forces.joints[joint].force.magnitude(); };
}

double largest_of(const ForcesSheet& sheet, const Get& get) {
  double largest = 0;
  for (P p : sheet.forces.prescribed->curve) largest = std::max(largest, std::abs(get(p)));
  return largest;
}

std::vector<TableOfForces::Row> rows_of(const ForcesSheet& sheet) {
  return sheet_rows(sheet.motion.positions, sheet.forces.also, [jump = 1e-4 * largest_of(sheet, load_of)](P a, P b) {
    return std::abs(load_of(a) - load_of(b)) > jump;
  });
}

// A row of cells a position, a cell a link; of many links more rows.
void add_polygons(Sheets& sheets, const ForcesSheet& sheet) {
  const Mechanism& m = sheet.mechanisms.front().mechanism;
  PlanarLinkage linkage = m.data.linkage(0);
  if (sheet.weightless) linkage.gravity = 0;
  const Box room = sheets.room();
  const int links = linkage.body_count, lines = (links * 44 - 1) / static_cast<int>(room.width) + 1,
            columns = (links + lines - 1) / lines;
  std::vector<VectorPlan> plans;
  for (const auto& row : rows_of(sheet)) {
    for (VectorPlan& plan : force_polygons(row.values->forces, linkage, row.label)) plans.push_back(std::move(plan));
    for (int k = links; k < lines * columns; ++k) plans.emplace_back();
  }
  add_plans(sheets,
            {.what = m.name + ": polygons of forces",
             .note = fmt::format(
                 "On each link at each position, closed: F load on the output, G weight, F with the link's number −m "
                 "a_S (F_x, F_y of the table), R_21 of link 2 on link 1, the opposite of R_12; T friction along a "
                 "slide, F_a what else acts within. Forces shorter than 1.2 mm are not named; {}.",
                 sheet.speed),
             .scale = "μ_F",
             .unit = "N",
             .columns = columns,
             .rows = static_cast<int>(room.height) / 43,
             .together = lines,
             .direction = m.data.drawing().direction,
             .each_to_its_own = true},
            plans);
}

double heaviest(const ForcesSheet& sheet) {
  double largest = 0;
  for (std::size_t k = 0; k < sheet.joints.size(); ++k) largest = std::max(largest, largest_of(sheet, reaction_of(k)));
  return largest;
}

std::string notes_of(const ForcesSheet& sheet) {
  const std::string& unbounded = sheet.forces.unbounded.words;
  return unbounded.empty() ? "" : ".\n" + unbounded;
}

bool load_rocks(const ForcesSheet& sheet) { return sheet.mechanisms.front().mechanism.rocks(); }

SheetTable reaction_table(const ForcesSheet& sheet) {
  TableOfForces t(fmt::format("{}: reactions in the joints, balancing torque", sheet.mechanisms.front().mechanism.name),
                  rows_of(sheet));
  const double scale = heaviest(sheet);
  t.add(load_rocks(sheet) ? "M_load" : "F", load_rocks(sheet) ? "N·m" : "N", load_of);
  std::string words;
  for (std::size_t k = 0; k < sheet.joints.size(); ++k) {
    const ForcesSheet::Joint& joint = sheet.joints[k];
    const auto across = [k](P p) { return p.forces.joints[k].force.y; };
    if (joint.slides && largest_of(sheet, [k](P p) { return p.forces.joints[k].force.x; }) <= 1e-12 * scale) {
      t.add(joint.symbol, "N", across, scale);  // to +x, with its sign
    } else {
      t.add(joint.symbol, "N", reaction_of(k), scale);
      t.add("α_" + joint.symbol.substr(2), "°", [k, scale](P p) {
        const Force2 f = p.forces.joints[k].force;
        return f.magnitude() <= 1e-12 * scale ? std::nan("") : f.direction() * in_degrees;
      });
    }
    words += fmt::format("{} {}; ", joint.symbol, joint.words);
  }
  t.add("M_b", "N·m", torque_of);
  t.table.note = fmt::format(
      "{}α: direction from +x, counter-clockwise; a guide's reaction along +y; M_b: balancing torque of the shaft on "
      "the crank; {}: load on the output, positive {}; {}{}.",
      words, load_rocks(sheet) ? "M_load" : "F", load_rocks(sheet) ? "counter-clockwise" : "along +x", sheet.speed,
      notes_of(sheet));
  return t.table;
}

SheetTable inertia_table(const ForcesSheet& sheet) {
  TableOfForces t(fmt::format("{}: inertia forces of the links", sheet.mechanisms.front().mechanism.name),
                  rows_of(sheet));
  const auto force_of = [](std::size_t link) -> Get {
    return [link](P p) { return p.forces.links[link].inertia_force.magnitude(); };
  };
  const auto couple_of = [](std::size_t link) -> Get {
    return [link](P p) { return p.forces.links[link].inertia_couple; };
  };
  double scale = 0, couple_scale = 0;
  for (std::size_t i = 0; i < sheet.links.size(); ++i) {
    scale = std::max(scale, largest_of(sheet, force_of(i)));
    couple_scale = std::max(couple_scale, largest_of(sheet, couple_of(i)));
  }
  std::string words;
  for (std::size_t i = 0; i < sheet.links.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    words += fmt::format("{} {}; ", number, sheet.links[i]);
    if (largest_of(sheet, force_of(i)) > 1e-12 * scale) {
      const auto along = [i](P p) { return p.forces.links[i].inertia_force.x; };
      const auto across = [i](P p) { return p.forces.links[i].inertia_force.y; };
      t.add("F_x" + number, "N", along, scale);
      t.add("F_y" + number, "N", across, scale);
    }
    if (largest_of(sheet, couple_of(i)) > 1e-12 * couple_scale) t.add("M_" + number, "N·m", couple_of(i), couple_scale);
  }
  t.table.note = fmt::format(
      "links: {}F = −m a_S in the centre of mass and M = −I ε, in the axes of the mechanism: +x along {}, +y 90° ahead "
      "of it; {}.",
      words, load_rocks(sheet) ? "the ground link" : "the stroke", sheet.speed);
  return t.table;
}

SheetCurve curve_of(const ForcesSheet& sheet, const std::string& symbol, Pen pen, const Get& get) {
  SheetCurve curve{symbol, {}, {}, {}, pen};
  for (const auto& [way, p] : by_way(sheet.motion.cycle, sheet.forces.prescribed->curve, phi_of))
    curve.way.push_back(way), curve.value.push_back(get(*p));
  for (std::size_t k = 0; k < sheet.motion.positions.size(); ++k)
    curve.at_positions.push_back(get(sheet.forces.also[3 * k + 1]));
  return curve;
}

void add_torques(Sheets& sheets, const ForcesSheet& sheet) {
  const bool rocks = load_rocks(sheet);
  add_diagrams(
      sheets, fmt::format("{}: load and balancing torque", sheet.mechanisms.front().mechanism.name),
      sheet.motion.cycle.length, sheet.motion.positions,
      {{"Load on the output",
        rocks ? "μ_M" : "μ_F",
        rocks ? "N·m" : "N",
        {curve_of(sheet, rocks ? "M_load" : "F", Pen::load, load_of)}},
       {"Balancing torque of the shaft on the crank", "μ_M", "N·m", {curve_of(sheet, "M_b", Pen::main, torque_of)}}},
      sheet.speed);
}

// Two a diagram: reactions of neighbours are alike and would hide each other.
void add_reactions(Sheets& sheets, const ForcesSheet& sheet) {
  std::vector<SheetDiagram> diagrams;
  for (std::size_t k = 0; k < sheet.joints.size(); ++k) {
    const ForcesSheet::Joint& joint = sheet.joints[k];
    const bool second = k % 2 == 1;
    if (!second) diagrams.push_back({"", "μ_F", "N", {}});
    diagrams.back().title += (second ? ", " : "") + joint.symbol + " " + joint.words;
    diagrams.back().curves.push_back(curve_of(sheet, joint.symbol, second ? Pen::load : Pen::main, reaction_of(k)));
  }
  constexpr std::size_t per_sheet = 2;
  for (auto d = diagrams.begin(); d < diagrams.end();) {
    const auto end = d + std::min<std::ptrdiff_t>(per_sheet, diagrams.end() - d);
    add_diagrams(sheets, fmt::format("{}: reactions in the joints", sheet.mechanisms.front().mechanism.name),
                 sheet.motion.cycle.length, sheet.motion.positions, {d, end},
                 fmt::format("magnitudes; {}{}", sheet.speed, notes_of(sheet)), per_sheet);
    d = end;
  }
}

}  // namespace

std::string ForcesSheet::html() const {
  Sheets sheets(paper, {title, "kurbel forces " + std::filesystem::path(scene_file).filename().string(), author});
  add_mechanism(sheets, mechanisms.front(), motion, speed, structure_words(mechanisms.front().mechanism));
  add_motion_plans(sheets, mechanisms.front(), motion, speed);
  add_table(sheets, reaction_table(*this));
  add_table(sheets, inertia_table(*this));
  add_polygons(sheets, *this);
  add_torques(sheets, *this);
  add_reactions(sheets, *this);
  return sheets.html();
}

ForcesSheet sheet_of(const Scene& scene, const ForcesOptions& options, const Paper& paper, const std::string& author) {
  if (options.positions > 36)
    throw std::invalid_argument(fmt::format("--positions {}: a sheet has 4 … 36 of a turn", options.positions));
  const AskedMechanism chosen(scene, options.mechanism);
  ForcesSheet sheet;
  sheet.paper = paper;
  sheet.author = author;
  sheet.title = scene.heading();
  sheet.scene_file = scene.file;
  sheet.mechanisms = {drawn(chosen.mechanism())};
  sheet.weightless = !(options.effects ? *options.effects : scene.effects).gravity;
  ForcesOptions asked = options;
  asked.also = [&](const PrescribedCycle& c) {
    const int turns = std::max(1, static_cast<int>(std::lround(c.length / (2 * std::numbers::pi))));
    const SheetCycle cycle{c.length, dead_centre(sheet.mechanisms.front()), c.speed < 0 ? -1.0 : 1.0,
                           turns * options.positions};
    sheet.motion = even_motion(cycle, positions_of(c, cycle), c.speed);
    sheet.speed = fmt::format("crank at {}, constant", scene.speed_unit.text(c.speed, 5));
    return looked_at(cycle, sheet.motion.positions);
  };
  sheet.forces = find_forces(scene, asked);
  name_parts(sheet, sheet.forces.prescribed->positions.front().forces);
  return sheet;
}

StudyOutput output_of(ForcesSheet sheet) {
  std::string html = sheet.html();
  StudyOutput output = output_of(std::move(sheet.forces));
  output.files.emplace_back("sheet.html", std::move(html));
  return output;
}

}  // namespace kurbel
