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

ForcesAt forces_of(const PositionForces& p) {
  ForcesAt at{p.forces.state.phi, p.forces.state.load, p.forces.torque, {}, {}};
  for (const JointForces& j : p.forces.joints) at.reactions.push_back({j.force, j.moment});
  for (const LinkForces& l : p.forces.links) at.inertia.push_back({l.inertia_force, l.inertia_couple});
  return at;
}

void take_forces(ForcesSheet& sheet) {
  for (const PositionForces& p : sheet.forces.also) sheet.looks.push_back(forces_of(p));
  for (std::size_t k = 1; k < sheet.looks.size(); k += 3) sheet.at.push_back(sheet.looks[k]);
  std::vector<ForcesAt> forces;
  for (const PositionForces& p : sheet.forces.prescribed->curve) forces.push_back(forces_of(p));
  for (const auto& [way, at] : by_way(sheet.motion.cycle, forces)) sheet.way.push_back(way), sheet.curve.push_back(*at);
}

void name_parts(ForcesSheet& sheet, const LinkageForces& f) {
  for (const LinkForces& l : f.links) sheet.links.emplace_back(l.name);
  for (const JointForces& j : f.joints)
    sheet.joints.push_back(
        {reaction_symbol(f, j.from, j.on), fmt::format("{}: {} on {}", j.name, j.from, j.on), j.slides});
}

// --- positions ---

std::vector<SheetPosition> positions_of(const PrescribedCycle& c, const SheetCycle& cycle) {
  constexpr double step = 2 / in_degrees, visible = 2e-3;
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
  std::vector<double> edges, weight;
  for (const double edge : c.edges) {
    const double bend = std::abs(c.load(edge + step) - 2 * c.load(edge) + c.load(edge - step));
    if (bend > visible * largest && edge < c.length * (1 - 1e-12)) edges.push_back(edge), weight.push_back(bend);
  }
  return sheet_positions(cycle, edges, largest > 1.001 * least ? std::optional(where) : std::nullopt, weight);
}

MechanismOnSheet drawn(Mechanism mechanism) {
  check_rotates(mechanism);
  mechanism.phase = 0;  // angles are those of the crank
  return {std::move(mechanism), 1};
}

// --- sheets ---

using ForcesRow = SheetRow<ForcesAt>;

double load_of(const ForcesAt& at) { return at.load; }
double load_of(const PositionForces& at) { return at.forces.state.load; }

template <class Values>
std::vector<SheetRow<Values>> rows_of(const ForcesSheet& sheet, const std::vector<Values>& looks) {
  double largest = 0;
  for (const ForcesAt& at : sheet.curve) largest = std::max(largest, std::abs(at.load));
  return sheet_rows(sheet.motion.positions, looks, [largest](const Values& before, const Values& after) {
    return std::abs(load_of(before) - load_of(after)) > 1e-4 * largest;
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
  for (const auto& row : rows_of(sheet, sheet.forces.also)) {
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
             .direction = m.data.drawing().direction,
             .each_to_its_own = true},
            plans);
}

using Get = std::function<double(const ForcesAt&)>;

class TableOfForces {
 public:
  TableOfForces(const ForcesSheet& sheet, const std::string& title)
      : rows_(rows_of(sheet, sheet.looks)), table_(table_of_positions(title, rows_)) {}
  // Values that are rounding dust beside `scale` are zeros.
  void add(const std::string& symbol, const std::string& unit, const Get& get, double scale = 0) {
    SheetColumn column{symbol, unit, {}};
    for (const ForcesRow& row : rows_) {
      const double v = get(*row.values);
      column.values.push_back(std::abs(v) < 1e-12 * scale ? 0 : v);
    }
    table_.columns.push_back(std::move(column));
  }
  SheetTable& table() { return table_; }

 private:
  std::vector<ForcesRow> rows_;
  SheetTable table_;
};

double largest_of(const ForcesSheet& sheet, const Get& get) {
  double largest = 0;
  for (const ForcesAt& at : sheet.curve) largest = std::max(largest, std::abs(get(at)));
  return largest;
}

double heaviest(const ForcesSheet& sheet) {
  double largest = 0;
  for (std::size_t k = 0; k < sheet.joints.size(); ++k)
    largest =
        std::max(largest, largest_of(sheet, [k](const ForcesAt& at) { return at.reactions[k].force.magnitude(); }));
  return largest;
}

std::string notes_of(const ForcesSheet& sheet) {
  const std::string& unbounded = sheet.forces.unbounded.words;
  return unbounded.empty() ? "" : "\n" + unbounded + ".";
}

bool load_rocks(const ForcesSheet& sheet) { return sheet.mechanisms.front().mechanism.rocks(); }

SheetTable reaction_table(const ForcesSheet& sheet) {
  TableOfForces t(
      sheet, fmt::format("{}: reactions in the joints, balancing torque", sheet.mechanisms.front().mechanism.name));
  const double scale = heaviest(sheet);
  t.add(load_rocks(sheet) ? "M_load" : "F", load_rocks(sheet) ? "N·m" : "N",
        [](const ForcesAt& at) { return at.load; });
  std::string words;
  for (std::size_t k = 0; k < sheet.joints.size(); ++k) {
    const ForcesSheet::Joint& joint = sheet.joints[k];
    const auto magnitude = [k](const ForcesAt& at) { return at.reactions[k].force.magnitude(); };
    if (joint.slides &&
        largest_of(sheet, [k](const ForcesAt& at) { return at.reactions[k].force.x; }) <= 1e-12 * scale) {
      t.add(
          joint.symbol, "N", [k](const ForcesAt& at) { return at.reactions[k].force.y; },
          scale);  // across +x, with its sign
    } else {
      t.add(joint.symbol, "N", magnitude, scale);
      t.add("α_" + joint.symbol.substr(2), "°", [k, scale](const ForcesAt& at) {
        const Force2 f = at.reactions[k].force;
        return f.magnitude() <= 1e-12 * scale ? std::nan("") : f.direction() * in_degrees;
      });
    }
    words += fmt::format("{} {}; ", joint.symbol, joint.words);
  }
  t.add("M_b", "N·m", [](const ForcesAt& at) { return at.torque; });
  t.table().note = fmt::format(
      "{}α: direction from +x, counter-clockwise; a guide's reaction along +y; M_b: balancing torque of the shaft on "
      "the crank; {}: load on the output, positive {}; {}.{}",
      words, load_rocks(sheet) ? "M_load" : "F", load_rocks(sheet) ? "counter-clockwise" : "along +x", sheet.speed,
      notes_of(sheet));
  return t.table();
}

SheetTable inertia_table(const ForcesSheet& sheet) {
  TableOfForces t(sheet, fmt::format("{}: inertia forces of the links", sheet.mechanisms.front().mechanism.name));
  double scale = 0, couple_scale = 0;
  for (std::size_t i = 0; i < sheet.links.size(); ++i) {
    scale = std::max(scale, largest_of(sheet, [i](const ForcesAt& at) { return at.inertia[i].force.magnitude(); }));
    couple_scale = std::max(couple_scale, largest_of(sheet, [i](const ForcesAt& at) { return at.inertia[i].couple; }));
  }
  std::string words;
  for (std::size_t i = 0; i < sheet.links.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    words += fmt::format("{} {}; ", number, sheet.links[i]);
    const Get force = [i](const ForcesAt& at) { return at.inertia[i].force.magnitude(); };
    const Get couple = [i](const ForcesAt& at) { return at.inertia[i].couple; };
    if (largest_of(sheet, force) > 1e-12 * scale) {
      t.add(
          "F_x" + number, "N", [i](const ForcesAt& at) { return at.inertia[i].force.x; }, scale);
      t.add(
          "F_y" + number, "N", [i](const ForcesAt& at) { return at.inertia[i].force.y; }, scale);
    }
    if (largest_of(sheet, couple) > 1e-12 * couple_scale) t.add("M_" + number, "N·m", couple, couple_scale);
  }
  t.table().note = fmt::format(
      "links: {}F = −m a_S in the centre of mass and M = −I ε, in the axes of the mechanism: +x along {}, +y 90° ahead "
      "of it; {}.",
      words, load_rocks(sheet) ? "the ground link" : "the stroke", sheet.speed);
  return t.table();
}

SheetCurve curve_of(const ForcesSheet& sheet, const std::string& symbol, Pen pen, const Get& get) {
  SheetCurve curve{symbol, sheet.way, {}, {}, pen};
  for (const ForcesAt& at : sheet.curve) curve.value.push_back(get(at));
  for (const ForcesAt& at : sheet.at) curve.at_positions.push_back(get(at));
  return curve;
}

void add_diagrams(Sheets& sheets, const ForcesSheet& sheet) {
  const Box room = sheets.room();
  const AngleAxis axis = angle_axis(sheet.motion.cycle.length, room.x + 6, room.width - 24);
  Canvas& c =
      sheets.add(fmt::format("{}: load and balancing torque", sheet.mechanisms.front().mechanism.name), axis.words());
  const double height = room.height / 2;
  draw_diagram(
      c, {room.x, room.y, room.width, height - 2}, axis,
      {"Load on the output",
       load_rocks(sheet) ? "μ_M" : "μ_F",
       load_rocks(sheet) ? "N·m" : "N",
       {curve_of(sheet, load_rocks(sheet) ? "M_load" : "F", Pen::load, [](const ForcesAt& at) { return at.load; })}},
      sheet.motion.positions);
  draw_diagram(c, {room.x, room.y + height, room.width, height - 2}, axis,
               {"Balancing torque of the shaft on the crank",
                "μ_M",
                "N·m",
                {curve_of(sheet, "M_b", Pen::main, [](const ForcesAt& at) { return at.torque; })}},
               sheet.motion.positions);
  add_lines(c, sheets.foot(), fmt::format("{}; {}.", axis.words(), sheet.speed));
}

// Two a diagram: reactions of neighbours are alike and would hide each other.
void add_reactions(Sheets& sheets, const ForcesSheet& sheet) {
  constexpr Pen pens[] = {Pen::main, Pen::load};
  const Box room = sheets.room();
  const AngleAxis axis = angle_axis(sheet.motion.cycle.length, room.x + 6, room.width - 24);
  const std::size_t n = sheet.joints.size(), per_sheet = 4;
  for (std::size_t from = 0; from < n; from += per_sheet) {
    Canvas& c =
        sheets.add(fmt::format("{}: reactions in the joints", sheet.mechanisms.front().mechanism.name), axis.words());
    const double height = room.height / 2;
    for (std::size_t k = from; k < std::min(n, from + per_sheet); k += 2) {
      SheetDiagram d{"", "μ_F", "N", {}};
      for (std::size_t j = k; j < std::min({n, k + 2, from + per_sheet}); ++j) {
        d.title += (j > k ? ", " : "") + sheet.joints[j].symbol + " " + sheet.joints[j].words;
        d.curves.push_back(curve_of(sheet, sheet.joints[j].symbol, pens[j - k],
                                    [j](const ForcesAt& at) { return at.reactions[j].force.magnitude(); }));
      }
      const double top = room.y + height * static_cast<double>((k - from) / 2);
      draw_diagram(c, {room.x, top, room.width, height - 2}, axis, d, sheet.motion.positions);
    }
    add_lines(c, sheets.foot(), fmt::format("{}; magnitudes; {}.{}", axis.words(), sheet.speed, notes_of(sheet)));
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
  add_diagrams(sheets, *this);
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
  take_forces(sheet);
  return sheet;
}

StudyOutput output_of(ForcesSheet sheet) {
  std::string html = sheet.html();
  StudyOutput output = output_of(std::move(sheet.forces));
  output.files.emplace_back("sheet.html", std::move(html));
  return output;
}

}  // namespace kurbel
