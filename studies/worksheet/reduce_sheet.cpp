// reduce_sheet.cpp — positions and edges of the load, works and flywheel; tables and diagrams of torques and works.
#include "studies/worksheet/reduce_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "engine/numerics/angles.h"
#include "engine/rigid/rigid_machine.h"
#include "studies/cycle/classical.h"
#include "studies/reduce/mechanism_words.h"
#include "studies/sheet/diagram.h"
#include "studies/sheet/table.h"
#include "studies/worksheet/energy_mass_sheet.h"
#include "studies/worksheet/motion_plans.h"

namespace kurbel {
namespace {

// --- positions ---

// M_d and M_c at an angle, from the curve.
double torques_at(const MachineReduction& r, double phi) {
  phi -= r.cycle * std::floor(phi / r.cycle);
  const auto after = std::upper_bound(r.curve.begin(), r.curve.end(), phi,
                                      [](double x, const ReducedPosition& p) { return x < p.phi; });
  const ReducedPosition& p = after == r.curve.end() ? r.curve.back() : *after;
  return p.load - p.drive;
}

std::vector<double> load_edges(const Scene& scene, const ReduceOptions& options, double sense) {
  try {
    RigidMachine rigid(compile_at(scene, classical_effects(scene), options.at));
    return rigid.periodic() ? rigid.edges(sense < 0 ? -1 : 1) : std::vector<double>{};
  } catch (const std::invalid_argument&) {  // no rigid machine of one angle
    return {};
  }
}

double largest_load(const MachineReduction& r) {
  double largest = 0;
  for (const ReducedPosition& p : r.curve) largest = std::max({largest, std::abs(p.load), std::abs(p.drive)});
  return largest;
}

// Where the resistance is greatest, an edge rather than a place beside it; empty where it is the same everywhere.
std::optional<double> greatest_load(const MachineReduction& r, const std::vector<double>& edges) {
  const auto less = [](const ReducedPosition& a, const ReducedPosition& b) {
    return std::abs(a.load) < std::abs(b.load);
  };
  const auto [least, most] = std::minmax_element(r.curve.begin(), r.curve.end(), less);
  if (most == r.curve.end() || std::abs(most->load) < 1.001 * std::abs(least->load)) return {};
  for (const ReducedPosition& p : r.curve)
    for (const double edge : edges)
      if (std::abs(p.phi - edge) < 2 * beside_edge && std::abs(p.load) > 0.999 * std::abs(most->load)) return edge;
  return most->phi;
}

std::vector<SheetPosition> positions_of(const MachineReduction& r, const SheetCycle& cycle,
                                        const std::vector<double>& edges) {
  const auto load = [&r](double phi) { return torques_at(r, phi); };
  const BentEdges bent = bent_edges(edges, r.cycle, load, largest_load(r));
  return sheet_positions(cycle, bent.at, greatest_load(r, bent.at), bent.bend);
}

void look_along(ReduceSheet& sheet) {
  const MachineReduction& r = sheet.reduction;
  const auto motion = [](const ReducedPosition& p) { return LinkAt{p.phi, p.omega, p.alpha}; };
  for (std::size_t k = 0; k < sheet.motion.positions.size(); ++k) {
    sheet.at.push_back(r.also[3 * k + 1]);
    sheet.motion.at.push_back(motion(sheet.at.back()));
  }
  for (const auto& [way, p] : by_way(sheet.motion.cycle, r.curve, &ReducedPosition::phi))
    sheet.motion.way.push_back(way), sheet.motion.between.push_back(motion(*p));
}

// --- works ---

SizeOptions size_options(const MachineReduction& r, const ReduceOptions& options, const ReduceSheetRequest& request) {
  constexpr double any = 0.05;  // the works do not depend on it
  SizeOptions o;
  o.delta = request.delta.value_or(any);
  o.basis = r.basis;
  if (r.basis == CycleBasis::classical) o.mid_speed = r.speed;
  o.at = options.at;
  o.flywheel = request.flywheel;
  o.simulate = false;
  return o;
}

void find_works(ReduceSheet& sheet, const Scene& scene, const ReduceOptions& options) {
  try {
    WorksOnSheet works{size_flywheel(scene, size_options(sheet.reduction, options, sheet.request)), {}, 0, false};
    const Sizing& s = works.sizing;
    works.demanded = sheet.request.delta.has_value();
    works.delta = works.demanded ? s.delta : s.delta_now;
    if (!(works.delta > 0 && works.delta < 2))
      throw std::invalid_argument("with its own inertia the machine does not get through the cycle at this speed");
    works.exact = works.demanded ? s.exact : wittenbauer(s.diagram, s.cycle.mechanism, s.mid_speed, works.delta);
    sheet.works = std::move(works);
  } catch (const std::invalid_argument& error) {
    if (sheet.request.delta) throw;
    sheet.why_no_works = error.what();
  }
}

// --- sheets ---

std::string speed_words(const MachineReduction& r) {
  return fmt::format("{} of {}{}", r.speed_unit.text(r.speed, 5), r.link,
                     r.basis == CycleBasis::classical ? ", constant" : " on the mean of the steady cycle");
}

using ReducedRow = SheetRow<ReducedPosition>;

std::vector<ReducedRow> rows_of(const ReduceSheet& sheet) {
  const double jump = 1e-4 * largest_load(sheet.reduction);
  return sheet_rows(sheet.motion.positions, sheet.reduction.also,
                    [jump](const ReducedPosition& before, const ReducedPosition& after) {
                      return std::abs(before.load - after.load) > jump || std::abs(before.drive - after.drive) > jump;
                    });
}

SheetTable torque_table(const ReduceSheet& sheet) {
  const MachineReduction& r = sheet.reduction;
  TableOfPositions t(fmt::format("Reduced to {}: torques, inertia, works", r.link), rows_of(sheet));
  t.add("M_d", "N·m", &ReducedPosition::drive);
  t.add("M_c", "N·m", &ReducedPosition::load);
  t.add("I_em", "kg·m²", &ReducedPosition::mechanism_inertia);
  t.add("I_r", "kg·m²", &ReducedPosition::inertia);
  t.add("I_r′", "kg·m²/rad", &ReducedPosition::slope);
  t.table.note = fmt::format(
      "M_d, M_c: driving and resisting torque reduced to {}, at {}; I_em: reduced inertia of the mechanisms, I_r: of "
      "the whole machine; letters: edges of the load and its greatest value, ⁻ just before, ⁺ just after.",
      r.link, speed_words(r));
  if (sheet.works) {
    const WorkDiagram& d = sheet.works->sizing.diagram;
    const auto work = [&](const std::string& symbol, const Piecewise& f) {
      t.add(symbol, "J", [&](const ReducedRow& row) { return sheet.from_origin(f, row.position->way); });
    };
    work("A_d", d.drive_work), work("A_c", d.load_work), work("ΔT", d.excess);
    t.table.note += fmt::format(
        " A_d, A_c, ΔT = A_d − A_c from position 0 on; A_d by the {} {:.6g} N·m that balances the cycle.",
        sheet.works->sizing.engine ? "drive; the load is its own and" : "constant torque of", d.mean_torque());
  }
  return t.table;
}

SheetCurve of_positions(const ReduceSheet& sheet, const std::string& symbol, Pen pen, double ReducedPosition::*value) {
  SheetCurve curve{symbol, {}, {}, {}, pen};
  for (const auto& [way, p] : by_way(sheet.motion.cycle, sheet.reduction.curve, &ReducedPosition::phi))
    curve.way.push_back(way), curve.value.push_back(p->*value);
  for (const ReducedPosition& p : sheet.at) curve.at_positions.push_back(p.*value);
  return curve;
}

SheetCurve of_work(const ReduceSheet& sheet, const std::string& symbol, Pen pen, const Piecewise& f,
                   bool marked = true) {
  SheetCurve curve{symbol, sheet.motion.way, {}, {}, pen};
  for (const double way : curve.way) curve.value.push_back(sheet.from_origin(f, way));
  if (marked)
    for (const SheetPosition& p : sheet.motion.positions) curve.at_positions.push_back(sheet.from_origin(f, p.way));
  return curve;
}

// The torques that the works are those of, where they are not the scene's at this speed.
void add_balanced(const ReduceSheet& sheet, SheetDiagram& torques) {
  const Sizing& s = sheet.works->sizing;
  const Piecewise& f = s.engine ? s.diagram.load_torque : s.diagram.drive_torque;
  double apart = 0;
  SheetCurve curve{s.engine ? "M_c,balanced" : "M_d,balanced", sheet.motion.way, {}, {}, Pen::dashed};
  for (std::size_t i = 0; i < curve.way.size(); ++i) {
    curve.value.push_back(f.value(sheet.study_way(curve.way[i])));
    apart = std::max(apart, std::abs(curve.value[i] - torques.curves[s.engine ? 0 : 1].value[i]));
  }
  if (apart > 1e-3 * largest_load(sheet.reduction)) torques.curves.push_back(std::move(curve));
}

void add_torques_and_works(Sheets& sheets, const ReduceSheet& sheet) {
  const MachineReduction& r = sheet.reduction;
  std::vector<SheetDiagram> diagrams = {{fmt::format("Torques reduced to {}", r.link),
                                         "μ_M",
                                         "N·m",
                                         {of_positions(sheet, "M_c", Pen::load, &ReducedPosition::load),
                                          of_positions(sheet, "M_d", Pen::drive, &ReducedPosition::drive)}}};
  std::string note = fmt::format("torques at {}. ", speed_words(r));
  if (sheet.works) {
    const WorkDiagram& d = sheet.works->sizing.diagram;
    add_balanced(sheet, diagrams.front());
    diagrams.push_back(
        {"Works",
         "μ_A",
         "J",
         {of_work(sheet, "A_c", Pen::load, d.load_work), of_work(sheet, "A_d", Pen::drive, d.drive_work)}});
    note += fmt::format("Work of a cycle {:.6g} J, mean torque {:.6g} N·m", d.work, d.mean_torque());
  } else {
    note += "No works: " + sheet.why_no_works;
  }
  add_diagrams(sheets, sheet.works ? "Torques and works over the cycle" : "Torques over the cycle", r.cycle,
               sheet.motion.positions, diagrams, note);
}

void add_inertia(Sheets& sheets, const ReduceSheet& sheet) {
  add_diagrams(sheets, "Reduced inertia over the cycle", sheet.reduction.cycle, sheet.motion.positions,
               {{"Reduced inertia of the mechanisms",
                 "μ_I",
                 "kg·m²",
                 {of_positions(sheet, "I_em", Pen::main, &ReducedPosition::mechanism_inertia)}}},
               fmt::format("at a constant ratio turn {:.6g} kg·m² more", sheet.reduction.constant_inertia));
}

}  // namespace

double ReduceSheet::study_way(double way) const {
  const SheetCycle& c = motion.cycle;
  const double s = c.sense * c.origin + way;
  const double rest = s - c.length * std::floor(s / c.length);
  return way > 0 && rest == 0 ? c.length : rest;
}

double ReduceSheet::from_origin(const Piecewise& work, double way) const {
  const double begin = study_way(0), end = study_way(way);
  const double wrapped = begin + way > motion.cycle.length * (1 + 1e-14) ? work.value(work.end()) : 0;
  return work.value(end) - work.value(begin) + wrapped;
}

std::string ReduceSheet::html() const {
  Sheets sheets(request.paper,
                {reduction.title, "kurbel reduce " + std::filesystem::path(reduction.scene_file).filename().string(),
                 request.author});
  for (const MechanismOnSheet& m : mechanisms) {
    add_mechanism(sheets, m, motion, speed_words(reduction), structure_words(m.mechanism));
    add_motion_plans(sheets, m, motion, speed_words(reduction));
  }
  add_table(sheets, torque_table(*this));
  add_torques_and_works(sheets, *this);
  if (works)
    add_energy_mass(sheets, *this);
  else
    add_inertia(sheets, *this);
  return sheets.html();
}

ReduceSheet sheet_of(const Scene& given, const ReduceOptions& options, const ReduceSheetRequest& request) {
  if (!options.to.empty())
    throw std::invalid_argument(fmt::format(
        "--sheet with --to {}: a sheet is of the machine on its reduction link; omit one of the two", options.to));
  if (options.positions < 4 || options.positions > 72)
    throw std::invalid_argument(fmt::format("--positions {}: a sheet has 4 … 72", options.positions));
  const Scene scene = as_of(given, given.effects, options.at);
  ReduceSheet sheet;
  sheet.request = request;
  sheet.mechanisms = mechanisms_of(*compile_at(scene, classical_effects(scene), options.at));
  ReduceOptions asked = options;
  asked.also = [&](const MachineReduction& r) {
    const double origin = dead_centre(sheet.mechanisms.front());
    sheet.motion.cycle = {r.cycle, origin, r.sense, options.positions};
    sheet.motion.positions = positions_of(r, sheet.motion.cycle, load_edges(scene, options, r.sense));
    return looked_at(sheet.motion.cycle, sheet.motion.positions);
  };
  sheet.reduction = reduce(given, asked);
  look_along(sheet);
  find_works(sheet, given, options);
  return sheet;
}

StudyOutput output_of(ReduceSheet sheet) {
  std::string html = sheet.html();
  StudyOutput output = output_of(std::move(sheet.reduction));
  output.files.emplace_back("sheet.html", std::move(html));
  return output;
}

}  // namespace kurbel
