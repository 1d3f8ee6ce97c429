// reduce_output.cpp — the reduced machine as table, JSON, CSV and report.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"
#include "studies/reduce/reduce.h"

namespace kurbel {
namespace {

// Rounding of the sums, not a harmonic.
bool is_dust(const Harmonic& h, const Spectrum& s) { return h.amplitude < 1e-10 * std::sqrt(s.mean_square); }

using Json = nlohmann::ordered_json;
constexpr double degrees = 180 / std::numbers::pi;
// No minus before a zero.
std::string number(double value, int digits = 7) { return fmt::format("{:.{}g}", value + 0.0, digits); }

// Names and units of what the positions hold.
struct Names {
  std::string inertia, inertia_unit, slope_unit, torque, torque_unit;
};
Names names_of(const MachineReduction& r) {
  if (r.to_output && !r.to_rocker) return {"m", "kg", "kg/m", "F", "N"};
  return {"I", "kg*m2", "kg*m2/rad", "M", "N*m"};
}

// Shares that act at all.
std::vector<std::size_t> acting(const MachineReduction& r) {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < r.accounts.size(); ++k)
    if (std::any_of(r.curve.begin(), r.curve.end(),
                    [&](const ReducedPosition& p) { return k < p.share.size() && p.share[k] != 0; }))
      list.push_back(k);
  return list;
}

std::vector<std::string> heading(const MachineReduction& r) {
  const Names n = names_of(r);
  const std::string i = pretty_unit(n.inertia_unit), t = pretty_unit(n.torque_unit);
  std::vector<std::string> cells = {"position",
                                    "φ [°]",
                                    fmt::format("{}_r [{}]", n.inertia, i),
                                    fmt::format("{}_drive [{}]", n.inertia, i),
                                    fmt::format("{}_em [{}]", n.inertia, i),
                                    fmt::format("{}_r′ [{}]", n.inertia, pretty_unit(n.slope_unit)),
                                    fmt::format("{}_d [{}]", n.torque, t),
                                    fmt::format("{}_c [{}]", n.torque, t)};
  for (const std::size_t k : acting(r)) cells.push_back(r.accounts[k]);
  return cells;
}

std::vector<double> values_of(const MachineReduction& r, const ReducedPosition& p) {
  std::vector<double> values = {p.inertia, p.drive_inertia, p.mechanism_inertia, p.slope, p.drive, p.load};
  for (const std::size_t k : acting(r)) values.push_back(p.share[k]);
  return values;
}

// One row per position; values that are rounding dust beside their column's largest are zeros.
std::vector<std::vector<std::string>> rows_of(const MachineReduction& r, int digits) {
  std::vector<double> largest(6 + acting(r).size(), 0.0);
  for (const ReducedPosition& p : r.positions) {
    if (!p.singular.empty()) continue;
    const std::vector<double> values = values_of(r, p);
    for (std::size_t k = 0; k < values.size(); ++k) largest[k] = std::max(largest[k], std::abs(values[k]));
  }
  std::vector<std::vector<std::string>> rows;
  for (const ReducedPosition& p : r.positions) {
    std::vector<std::string> cells = {std::to_string(p.number), number(p.phi * degrees, digits)};
    if (p.singular.empty()) {
      const std::vector<double> values = values_of(r, p);
      for (std::size_t k = 0; k < values.size(); ++k)
        cells.push_back(number(std::abs(values[k]) < 1e-12 * largest[k] ? 0.0 : values[k], digits));
    }
    cells.resize(2 + largest.size(), "—");
    rows.push_back(std::move(cells));
  }
  return rows;
}

std::string conclusion_of(const MachineReduction& r) {
  const ReducedPosition *most = nullptr, *least = nullptr;
  for (const ReducedPosition& p : r.curve) {
    if (!most || p.inertia > most->inertia) most = &p;
    if (!least || p.inertia < least->inertia) least = &p;
  }
  if (r.to_output)
    return fmt::format("{}: reduced to {} the machine has {:.5g} {} or more, infinite in the dead centres", r.title,
                       r.to, least ? least->inertia : 0.0, pretty_unit(names_of(r).inertia_unit));
  return fmt::format(
      "{}: reduced to {} the machine has {:.5g} … {:.5g} kg·m², of which {:.5g} kg·m² turn at constant ratio", r.title,
      r.to, least ? least->inertia : 0.0, most ? most->inertia : 0.0, r.constant_inertia);
}

// --- tables ---

Table positions_table(const MachineReduction& r) {
  return Table{.title = fmt::format("Reduced to {} at {} positions", r.to, r.positions.size()),
               .columns = heading(r),
               .rows = rows_of(r, 6)};
}

Table chain_table(const MachineReduction& r) {
  Table t{.title = fmt::format("Drive as an elastic chain, reduced to {}", r.to_output ? r.link : r.to),
          .columns = {"part", "what", "own", "speed ratio i", "reduced", "own c", "reduced c"},
          .rows = {},
          .text_columns = 2};
  for (std::size_t k = 0; k < r.chain.inertias.size(); ++k) {
    const ChainInertia& i = r.chain.inertias[k];
    t.rows.push_back({fmt::format("J{}", k + 1), i.name + (i.mechanism ? " (mean)" : ""), number(i.own, 6) + " kg·m²",
                      number(i.ratio, 6), number(i.reduced, 6) + " kg·m²", "", ""});
  }
  for (const ChainSpring& s : r.chain.springs)
    t.rows.push_back({fmt::format("k{}-{}", s.a + 1, s.b + 1), s.name, number(s.stiffness, 6) + " N·m/rad",
                      number(s.ratio, 6), number(s.reduced_stiffness, 6) + " N·m/rad",
                      number(s.damping, 5) + " N·m·s/rad", number(s.reduced_damping, 5) + " N·m·s/rad"});
  return t;
}

// −180° < phase ≤ 180°, to a millionth of a degree.
std::string phase_text(double phase) {
  const double rounded_phase = std::round(phase * degrees * 1e6) / 1e6;
  return number(rounded_phase <= -180 ? rounded_phase + 360 : rounded_phase, 5);
}

Table harmonics_table(const MachineReduction& r) {
  Table t{.title = fmt::format("Harmonics over a cycle, on {}", r.link), .columns = {"order"}, .rows = {}};
  for (const Spectrum& s : r.spectra) {
    t.columns.push_back(fmt::format("{} [{}]", s.name, pretty_unit(s.unit)));
    t.columns.push_back("phase [°]");
  }
  for (std::size_t n = 0; !r.spectra.empty() && n < r.spectra.front().harmonics.size(); ++n) {
    std::vector<std::string> cells = {number(r.spectra.front().harmonics[n].order, 4)};
    for (const Spectrum& s : r.spectra) {
      const Harmonic& h = s.harmonics[n];
      const bool dust = is_dust(h, s);
      cells.push_back(number(dust ? 0.0 : h.amplitude, 6));
      cells.push_back(n == 0 || dust || h.amplitude == 0 ? "—" : phase_text(h.phase));
    }
    t.rows.push_back(std::move(cells));
  }
  return t;
}

std::string text_of(const Table& t) {
  std::vector<std::vector<std::string>> rows = {t.columns};
  rows.insert(rows.end(), t.rows.begin(), t.rows.end());
  return t.title + "\n" + aligned(rows, t.text_columns);
}

std::string speed_text(const MachineReduction& r) {
  return fmt::format("torques at {:.6g} rpm of {} ({})\n", r.speed * 30 / std::numbers::pi, r.link, r.speed_source);
}

std::string table_of(const MachineReduction& r) {
  std::string text = conclusion_of(r) + "\n" + speed_text(r) + "\n" + text_of(positions_table(r)) + "\n" +
                     text_of(chain_table(r)) + "\n";
  if (!r.spectra.empty()) text += text_of(harmonics_table(r));
  for (const std::string& note : r.notes) text += "note: " + note + "\n";
  return text;
}

// --- JSON, CSV ---

Json position_json(const MachineReduction& r, const ReducedPosition& p) {
  Json j = {{"position", p.number}, {"phi", p.phi}};
  if (p.ratio) j["slider_velocity_ratio"] = *p.ratio;
  if (!p.singular.empty()) {
    j["singular"] = p.singular;
    return j;
  }
  const char* inertia = r.to_output && !r.to_rocker ? "mass" : "inertia";
  const char* torque = r.to_output && !r.to_rocker ? "force" : "torque";
  j[inertia] = p.inertia;
  j[fmt::format("drive_{}", inertia)] = p.drive_inertia;
  j[fmt::format("mechanism_{}", inertia)] = p.mechanism_inertia;
  j[fmt::format("{}_slope", inertia)] = p.slope;
  j[fmt::format("driving_{}", torque)] = p.drive;
  j[fmt::format("resisting_{}", torque)] = p.load;
  j["share"] = Json::object();
  for (std::size_t k = 0; k < r.accounts.size(); ++k) j["share"][r.accounts[k]] = p.share[k];
  return j;
}

Json chain_json(const Chain& chain) {
  Json j = {{"inertias", Json::array()}, {"springs", Json::array()}};
  for (const ChainInertia& i : chain.inertias)
    j["inertias"].push_back({{"name", i.name},
                             {"own", i.own},
                             {"ratio", i.ratio},
                             {"reduced", i.reduced},
                             {"mean_of_mechanism", i.mechanism}});
  for (const ChainSpring& s : chain.springs)
    j["springs"].push_back({{"name", s.name},
                            {"from", s.a},
                            {"to", s.b},
                            {"ratio", s.ratio},
                            {"stiffness", s.stiffness},
                            {"damping", s.damping},
                            {"reduced_stiffness", s.reduced_stiffness},
                            {"reduced_damping", s.reduced_damping}});
  return j;
}

std::string json_of(const MachineReduction& r) {
  Json j;
  j["title"] = r.title;
  j["scene"] = r.scene_file;
  j["conclusion"] = conclusion_of(r);
  j["link"] = r.link;
  j["reduced_to"] = r.to;
  j["speed_ratio"] = r.to_output ? Json() : Json(r.to_ratio);
  j["speed"] = {{"value", r.speed}, {"unit", "rad/s"}, {"source", r.speed_source}};
  j["units"] = {{"inertia", names_of(r).inertia_unit}, {"torque", names_of(r).torque_unit}, {"angle", "rad"}};
  j["positions"] = Json::array();
  for (const ReducedPosition& p : r.positions) j["positions"].push_back(position_json(r, p));
  j["chain"] = chain_json(r.chain);
  j["harmonics"] = Json::array();
  for (const Spectrum& s : r.spectra) {
    Json one = {{"name", s.name}, {"unit", s.unit}, {"captured_of_mean_square", s.captured}, {"orders", Json::array()}};
    for (const Harmonic& h : s.harmonics)
      one["orders"].push_back({{"order", h.order}, {"amplitude", h.amplitude}, {"phase", h.phase}});
    j["harmonics"].push_back(std::move(one));
  }
  j["notes"] = r.notes;
  return json_text(j);
}

std::string csv_of(const std::vector<std::string>& columns, const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t k = 0; k < cells.size(); ++k) text += (k ? "," : "") + cells[k];
    text += "\n";
  };
  line(columns);
  for (const auto& row : rows) line(row);
  return text;
}

std::string positions_csv(const MachineReduction& r) {
  std::vector<std::vector<std::string>> rows = rows_of(r, 15), kept;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (r.positions[k].singular.empty()) kept.push_back(std::move(rows[k]));
  return csv_of(heading(r), kept);
}

std::string harmonics_csv(const MachineReduction& r) {
  std::vector<std::vector<std::string>> rows;
  for (const Spectrum& s : r.spectra)
    for (const Harmonic& h : s.harmonics)
      rows.push_back({s.name, number(h.order, 6), number(h.amplitude, 15), number(h.phase, 15)});
  return csv_of({"quantity", "order", "amplitude", "phase [rad]"}, rows);
}

// --- report ---

Series over_angle(const MachineReduction& r, const std::string& name, Role role,
                  const std::function<double(const ReducedPosition&)>& value) {
  Series s{.name = name, .role = role, .x = {}, .y = {}};
  for (const ReducedPosition& p : r.curve) {
    s.x.push_back(p.phi * degrees);
    s.y.push_back(value(p));
  }
  return s;
}
Series at_positions(const MachineReduction& r, Role role, const std::function<double(const ReducedPosition&)>& value) {
  Series s{.name = fmt::format("{} positions", r.positions.size()),
           .role = role,
           .x = {},
           .y = {},
           .points = true,
           .line = false};
  for (const ReducedPosition& p : r.positions) {
    if (!p.singular.empty()) continue;
    s.x.push_back(p.phi * degrees);
    s.y.push_back(value(p));
  }
  return s;
}

std::vector<Plot> motion_plots(const MachineReduction& r) {
  const Names n = names_of(r);
  const std::string angle = fmt::format("angle of {}", r.link);
  std::vector<Plot> plots;
  Plot inertia{.title = fmt::format("Reduced {} of the mechanism, on {}", n.inertia == "m" ? "mass" : "inertia", r.to),
               .x = {angle, "°"},
               .y = {n.inertia + "_em", pretty_unit(n.inertia_unit)},
               .series = {}};
  const auto mechanism = [](const ReducedPosition& p) { return p.mechanism_inertia; };
  inertia.series = {over_angle(r, n.inertia + "_em", Role::elastic, mechanism),
                    at_positions(r, Role::vermillion, mechanism)};
  if (!r.to_output)
    inertia.note = fmt::format("The drive adds a constant {:.6g} kg·m².", r.constant_inertia);
  else
    inertia.note = "Near the dead centres it grows beyond all bounds and is left out.";
  Plot slope{
      .title = fmt::format("Its derivative {}_r′", n.inertia),
      .x = {angle, "°"},
      .y = {n.inertia + "_r′", pretty_unit(n.slope_unit)},
      .series = {over_angle(r, n.inertia + "_r′", Role::elastic, [](const ReducedPosition& p) { return p.slope; })}};
  Plot torque{
      .title = fmt::format("Driving and resisting {}, reduced to {}", n.torque == "F" ? "force" : "torque", r.to),
      .x = {angle, "°"},
      .y = {n.torque, pretty_unit(n.torque_unit)},
      .series = {over_angle(r, n.torque + "_d", Role::green, [](const ReducedPosition& p) { return p.drive; }),
                 over_angle(r, n.torque + "_c", Role::orange, [](const ReducedPosition& p) { return p.load; })},
      .note = speed_text(r)};
  Plot shares{.title = "Share of each force, positive when it drives",
              .x = {angle, "°"},
              .y = {n.torque, pretty_unit(n.torque_unit)},
              .series = {}};
  for (const std::size_t k : acting(r))
    shares.series.push_back(over_angle(r, r.accounts[k], further_role(shares.series.size()),
                                       [k](const ReducedPosition& p) { return p.share[k]; }));
  plots.push_back(std::move(inertia));
  plots.push_back(std::move(slope));
  plots.push_back(std::move(torque));
  if (!shares.series.empty()) plots.push_back(std::move(shares));
  return plots;
}

Plot harmonics_plot(const Spectrum& s, const std::string& link) {
  Plot plot{.title = fmt::format("Harmonics of the {}", s.name),
            .x = {fmt::format("order (per turn of {})", link), ""},
            .y = {"amplitude", pretty_unit(s.unit)},
            .series = {{.name = s.name, .role = Role::elastic, .x = {}, .y = {}}},
            .note = fmt::format("Without the mean of {:.6g} {}; these orders hold {:.6g} % of the mean square.",
                                s.harmonics.front().amplitude, pretty_unit(s.unit), 100 * s.captured),
            .bars = true};
  for (std::size_t n = 1; n < s.harmonics.size(); ++n) {
    plot.series[0].x.push_back(s.harmonics[n].order);
    plot.series[0].y.push_back(is_dust(s.harmonics[n], s) ? 0 : s.harmonics[n].amplitude);
  }
  return plot;
}

// Where an inertia stands in the drawing: compliance from the first one along the x-axis, branches below each other.
struct Place {
  double x = 0;
  int row = 0;
};
std::vector<Place> places_of(const Chain& chain) {
  std::vector<Place> places(chain.inertias.size());
  std::vector<char> placed(chain.inertias.size(), 0);
  std::vector<int> branches(chain.inertias.size(), 0);
  int rows = 1;
  if (!placed.empty()) placed[0] = 1;
  for (bool grown = true; grown;) {
    grown = false;
    for (const ChainSpring& s : chain.springs) {
      if (placed[s.a] == placed[s.b]) continue;
      const std::size_t from = placed[s.a] ? s.a : s.b, to = placed[s.a] ? s.b : s.a;
      places[to] = {places[from].x + (s.reduced_stiffness > 0 ? 1 / s.reduced_stiffness : 0.0),
                    branches[from]++ == 0 ? places[from].row : rows++};
      placed[to] = 1;
      grown = true;
    }
  }
  return places;
}

// The chain as one draws it by hand: discs as high as the cube root of their inertia, as far apart as the shaft between
// them is soft.
Plot chain_plot(const MachineReduction& r) {
  const Chain& chain = r.chain;
  const std::vector<Place> places = places_of(chain);
  double largest = 0, length = 0;
  for (const ChainInertia& i : chain.inertias) largest = std::max(largest, i.reduced);
  for (const Place& p : places) length = std::max(length, p.x);
  if (length == 0) length = 1e-6;
  Plot plot{.title = "The elastic chain: discs are inertias, distances are compliances",
            .x = {"compliance from the first inertia", "µrad/(N·m)"},
            .y = {"∛(J/J_max)", ""},
            .series = {},
            .note = "Height of a disc: cube root of its reduced inertia. The table names what is on each."};
  for (const ChainSpring& s : chain.springs) {
    const Place a = places[s.a], b = places[s.b];
    plot.series.push_back({.name = fmt::format("{}: k = {:.4g} N·m/rad", s.name, s.reduced_stiffness),
                           .role = Role::elastic,
                           .x = {1e6 * a.x, 1e6 * b.x},
                           .y = {-2.5 * a.row, -2.5 * b.row}});
  }
  for (std::size_t k = 0; k < chain.inertias.size(); ++k) {
    const ChainInertia& i = chain.inertias[k];
    const double height = largest > 0 ? std::max(0.05, std::cbrt(i.reduced / largest)) : 1, width = 4e3 * length,
                 x = 1e6 * places[k].x, y = -2.5 * places[k].row;
    plot.series.push_back({.name = fmt::format("J{} = {:.4g} kg·m²", k + 1, i.reduced),
                           .role = further_role(k),
                           .x = {x - width, x + width, x + width, x - width, x - width},
                           .y = {y - height, y - height, y + height, y + height, y - height}});
  }
  return plot;
}

void add_formulas(ReportSection& section, const MachineReduction& r) {
  const ReducedPosition* p = nullptr;
  for (const ReducedPosition& one : r.positions)
    if (one.singular.empty() && (!p || std::abs(one.load) > std::abs(p->load))) p = &one;
  if (!p) return;
  const std::string where = fmt::format("At φ = {:.5g}°.", p->phi * degrees);
  if (r.to_output) {
    const Names n = names_of(r);
    const std::string i = pretty_unit(n.inertia_unit), t = pretty_unit(n.torque_unit), x = r.to_rocker ? "" : " m";
    section.cards.push_back(
        Formula{.title = fmt::format("Reduced {} (theory 2.1)", r.to_rocker ? "inertia" : "mass"),
                .symbols = fmt::format("{}_r = I_r / x′²", n.inertia),
                .numbers = fmt::format("{}_r = {:.6g} kg·m² / ({:.6g}{})² = {:.6g} {}", n.inertia,
                                       p->inertia * *p->ratio * *p->ratio, *p->ratio, x, p->inertia, i),
                .note = where});
    section.cards.push_back(Formula{.title = "Resistance reduced to it (theory 2.2)",
                                    .symbols = fmt::format("{}_r = M_c / x′", n.torque),
                                    .numbers = fmt::format("{}_r = {:.6g} N·m / {:.6g}{} = {:.6g} {}", n.torque,
                                                           p->load * *p->ratio, *p->ratio, x, p->load, t),
                                    .note = where});
    return;
  }
  section.cards.push_back(Formula{.title = "Reduced inertia (theory 2.1)",
                                  .symbols = "I_r(φ) = I_drive + I_em(φ)",
                                  .numbers = fmt::format("I_r = {:.6g} + {:.6g} = {:.6g} kg·m²", p->drive_inertia,
                                                         p->mechanism_inertia, p->inertia),
                                  .note = where});
  std::string sum;
  for (const std::size_t k : acting(r)) sum += fmt::format("{}{:.6g}", sum.empty() ? "" : " + ", p->share[k]);
  section.cards.push_back(
      Formula{.title = "Reduced torque (theory 2.2)",
              .symbols = "M_r = Σ [F·v + M·ω]/ω = M_d − M_c",
              .numbers = fmt::format("M_r = {} = {:.6g} N·m", sum.empty() ? "0" : sum, p->drive - p->load),
              .note = where});
}

Report report_of(const MachineReduction& r) {
  Report report{
      .title = r.title, .subtitle = fmt::format("Machine reduced to {}", r.to), .conclusion = conclusion_of(r)};
  report.figures = {
      {"constant inertia of the drive", r.constant_inertia, "kg*m2", {}, r.to_output ? "on " + r.link : ""},
      {"mean driving torque", r.mean_drive, "N*m", {}, "on " + r.link},
      {"mean resisting torque", r.mean_load, "N*m", {}, "on " + r.link}};
  ReportSection& section = report.add("Over the cycle");
  for (Plot& plot : motion_plots(r)) section.cards.push_back(std::move(plot));
  section.cards.push_back(positions_table(r));
  add_formulas(section, r);
  ReportSection& drive = report.add("The drive as an elastic chain (theory 5.3)");
  if (!r.chain.springs.empty()) drive.cards.push_back(chain_plot(r));
  drive.cards.push_back(chain_table(r));
  if (!r.spectra.empty()) {
    ReportSection& spectra = report.add("Harmonics");
    for (const Spectrum& s : r.spectra)
      if (std::any_of(s.harmonics.begin() + 1, s.harmonics.end(), [&](const Harmonic& h) { return !is_dust(h, s); }))
        spectra.cards.push_back(harmonics_plot(s, r.link));
    spectra.cards.push_back(harmonics_table(r));
  }
  std::string notes;
  for (const std::string& note : r.notes) notes += note + "\n";
  if (!notes.empty()) report.add("Notes").cards.push_back(Text{.title = "", .body = notes});
  return report;
}

}  // namespace

StudyOutput output_of(const MachineReduction& r) {
  StudyOutput output{
      .conclusion = conclusion_of(r), .table = table_of(r), .json = json_of(r), .report = [r] { return report_of(r); }};
  output.csv = {{"positions.csv", [r] { return positions_csv(r); }},
                {"harmonics.csv", [r] { return harmonics_csv(r); }}};
  return output;
}

}  // namespace kurbel
