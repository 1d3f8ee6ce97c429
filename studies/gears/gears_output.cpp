// gears_output.cpp — words, tables, formulas, plots and the turning drawing of gear pairs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"
#include "studies/gears/gears.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double mm = 1e3, degree = std::numbers::pi / 180;
constexpr int plot_points = 401;
constexpr double shown_sliding = 8;  // specific sliding runs to −∞ at the base circles

std::string number(double v, int digits = 6) {
  return std::isfinite(v) ? fmt::format("{:.{}g}", v == 0 ? 0.0 : v, digits) : "—";
}
std::string length(double v) { return std::isfinite(v) ? fmt::format("{:.4f}", mm * v) : "—"; }
std::string angle(double v) { return fmt::format("{:.4f}", v / degree); }

const char* word_of(Finding finding) {
  switch (finding) {
    case Finding::good:
      return "good";
    case Finding::note:
      return "note";
    case Finding::warning:
      return "warning";
    case Finding::fault:
      return "fault";
  }
  return "";
}

std::string shape_of(const GearPair& p) {
  return fmt::format("{} {} pair", p.internal() ? "internal" : "external", p.data.helix == 0 ? "spur" : "helical");
}

std::string summary_of(const GearStage& s) {
  const GearPair& p = s.pair;
  std::string text = fmt::format("{}: {} {}/{}, m_n = {:g} mm, a_w = {:.4f} mm, α_wt = {:.3f}°, ε_α = {:.3f}", s.name,
                                 shape_of(p), p.data.teeth[0], p.data.teeth[1], mm * p.data.module,
                                 mm * std::abs(p.centre_distance), p.working_angle / degree, p.contact_ratio);
  if (p.overlap_ratio > 0) text += fmt::format(", ε_β = {:.3f}", p.overlap_ratio);
  const Finding worst = worst_of(s);
  if (worst < Finding::warning) return text + ": sound";
  int count = 0;
  std::string first;
  for (const GearVerdict& v : s.verdicts)
    if (v.finding == worst && ++count == 1) first = v.text;
  while (first.ends_with('.')) first.pop_back();
  return text + fmt::format(": {}{}", first, count > 1 ? fmt::format(" (and {} more)", count - 1) : "");
}

std::string conclusion_of(const Gears& g) {
  std::string text;
  for (const GearStage& s : g.stages) text += (text.empty() ? "" : "; ") + summary_of(s);
  return text + ".";
}

// --- tables ---

Rows wheel_rows(const GearPair& p) {
  Rows rows = {{"of the wheels", "symbol", "1", "2", "unit"}};
  const auto row = [&](const char* name, const char* symbol, const char* unit, auto&& value) {
    rows.push_back({name, symbol, value(p.wheel[0]), value(p.wheel[1]), unit});
  };
  row("teeth", "z", "", [](const MeshedWheel& w) { return std::to_string(w.teeth); });
  row("profile shift", "x", "", [](const MeshedWheel& w) { return number(w.shift); });
  row("generating shift", "x_E", "", [](const MeshedWheel& w) { return number(w.generating_shift); });
  row("least shift without undercut", "x_min", "",
      [](const MeshedWheel& w) { return number(w.least_shift_generated(), 5); });
  row("reference diameter", "d", "mm", [](const MeshedWheel& w) { return length(w.reference_diameter); });
  row("working diameter", "d_w", "mm", [](const MeshedWheel& w) { return length(w.working_diameter); });
  row("base diameter", "d_b", "mm", [](const MeshedWheel& w) { return length(w.base_diameter); });
  row("tip diameter", "d_a", "mm", [](const MeshedWheel& w) { return length(w.tip_diameter); });
  row("greatest tip diameter without interference", "d_a,max", "mm",
      [](const MeshedWheel& w) { return length(w.internal() ? -w.greatest_tip_diameter : w.greatest_tip_diameter); });
  row("root diameter", "d_f", "mm", [](const MeshedWheel& w) { return length(w.root_diameter); });
  row("root form diameter", "d_Ff", "mm", [](const MeshedWheel& w) { return length(w.form_diameter); });
  row("start of active profile", "d_Nf", "mm", [](const MeshedWheel& w) { return length(w.active_diameter); });
  row("tooth thickness on the reference circle, normal", "s_n", "mm",
      [](const MeshedWheel& w) { return length(w.thickness_normal(w.reference_diameter)); });
  row("the same, transverse", "s_t", "mm",
      [](const MeshedWheel& w) { return length(w.thickness(w.reference_diameter)); });
  row("on the working circle", "s_wt", "mm",
      [](const MeshedWheel& w) { return length(w.thickness(w.working_diameter)); });
  row("at the tip, normal", "s_an", "mm", [](const MeshedWheel& w) { return length(w.tip_thickness()); });
  row("diameter where the tooth is pointed", "", "mm",
      [](const MeshedWheel& w) { return length(w.pointed_diameter()); });
  row("tip clearance", "c", "mm", [](const MeshedWheel& w) { return length(w.tip_clearance); });
  if (p.wheel[0].inertia > 0 || p.wheel[1].inertia > 0) {
    row("width", "b", "mm", [](const MeshedWheel& w) { return length(w.width); });
    row("bore, or outer diameter of the rim", "", "mm", [](const MeshedWheel& w) { return length(w.bore); });
    row("moment of inertia", "J", "kg·m²", [](const MeshedWheel& w) { return number(w.inertia); });
  }
  return rows;
}

Rows mesh_rows(const GearStage& s) {
  const GearPair& p = s.pair;
  Rows rows = {{"of the mesh", "symbol", "value", "unit"}};
  const auto row = [&](const char* name, const char* symbol, const std::string& value, const char* unit) {
    rows.push_back({name, symbol, value, unit});
  };
  row("ratio", "u = z₂/z₁", number(p.ratio), "");
  row("pressure angle, normal", "α_n", angle(p.data.rack.pressure_angle), "°");
  row("pressure angle, transverse", "α_t", angle(p.wheel[0].transverse_angle), "°");
  row("working pressure angle", "α_wt", angle(p.working_angle), "°");
  if (p.data.helix != 0) row("base helix angle", "β_b", angle(p.wheel[0].base_helix), "°");
  row("reference centre distance", "a", length(p.reference_centre_distance), "mm");
  row("centre distance", "a_w", length(p.centre_distance), "mm");
  row("sum of shifts", "Σx", number(p.shift_sum), "");
  row("sum of shifts that closes the backlash", "Σx(a_w)", number(p.mating_shift_sum), "");
  row("tip shortening", "k", number(p.tip_shortening, 5), "m_n");
  row("base pitch", "p_et", length(p.base_pitch), "mm");
  row("contact ratio", "ε_α", number(p.contact_ratio), "");
  row("overlap ratio", "ε_β", number(p.overlap_ratio), "");
  row("total contact ratio", "ε_γ", number(p.total_contact_ratio()), "");
  row("backlash along the normal", "j_bn", length(p.backlash_normal), "mm");
  row("backlash on the working circle", "j_wt", length(p.backlash_arc), "mm");
  row("backlash angle at wheel 1", "", number(1e3 * p.backlash_angle(0), 5), "mrad");
  row("backlash angle at wheel 2", "", number(1e3 * p.backlash_angle(1), 5), "mrad");
  row("stiffness of a pair of teeth per width", "c′", number(1e-9 * s.stiffness.single, 5), "N/(mm·µm)");
  row("mesh stiffness per width", "c_γα", number(1e-9 * s.stiffness.mean, 5), "N/(mm·µm)");
  if (s.stiffness.torsional > 0)
    row("torsional mesh stiffness about wheel 1", "k", number(s.stiffness.torsional), "N·m/rad");
  row("least teeth without undercut, x = 0", "z_min", number(least_teeth(p.data.rack, p.data.helix), 5), "");
  if (p.internal()) {
    row("margin against tip fouling", "", number(tip_fouling_margin(p), 4), "rad");
    row("margin of radial assembly", "", number(radial_assembly_margin(p), 4), "rad");
  }
  if (s.speed) row("gear-mesh frequency", "f_z", number(p.mesh_frequency(*s.speed)), "Hz");
  return rows;
}

Rows path_rows(const GearStage& s) {
  const GearPair& p = s.pair;
  Rows rows = {{"point", "g [mm]", "d₁ [mm]", "d₂ [mm]", "ρ₁ [mm]", "ρ₂ [mm]", s.speed ? "v_g [m/s]" : "v_g/ω₁ [mm]",
                "ζ₁", "ζ₂"}};
  for (const char name : {'A', 'B', 'C', 'D', 'E'}) {
    const double g = p.point(name);
    const auto rho = p.curvature(g), r = p.radius(g), zeta = p.specific_sliding(g);
    rows.push_back({std::string(1, name), length(g), length(2 * r[0]), length(2 * r[1]), length(rho[0]), length(rho[1]),
                    s.speed ? number(p.sliding_speed(g, *s.speed), 5) : length(p.sliding_speed(g, 1)),
                    number(zeta[0], 5), number(zeta[1], 5)});
  }
  return rows;
}

std::string verdict_lines(const GearStage& s) {
  std::string text;
  for (const GearVerdict& v : s.verdicts) text += fmt::format("  {}: {}\n", word_of(v.finding), v.text);
  return text;
}

std::string table_of(const Gears& g, const std::string& conclusion) {
  std::string text = conclusion + "\n";
  for (const GearStage& s : g.stages) {
    text += fmt::format("\n{}: {}\n", s.name, shape_of(s.pair));
    text += aligned(wheel_rows(s.pair), 2) + "\n" + aligned(mesh_rows(s), 2) + "\n" + aligned(path_rows(s), 1) + "\n" +
            verdict_lines(s);
  }
  for (const std::string& note : g.notes) text += "  note: " + note + "\n";
  return text;
}

// --- JSON and CSV ---

Json finite(double v) { return std::isfinite(v) ? Json(v) : Json(); }

Json wheel_json(const MeshedWheel& w) {
  return {{"teeth", w.teeth},
          {"shift", w.shift},
          {"generating_shift", w.generating_shift},
          {"least_shift", finite(w.least_shift_generated())},
          {"undercut", w.undercut},
          {"reference_diameter", w.reference_diameter},
          {"working_diameter", w.working_diameter},
          {"base_diameter", w.base_diameter},
          {"tip_diameter", w.tip_diameter},
          {"root_diameter", w.root_diameter},
          {"form_diameter", w.form_diameter},
          {"active_diameter", w.active_diameter},
          {"thickness_normal", w.thickness_normal(w.reference_diameter)},
          {"tip_thickness", w.tip_thickness()},
          {"tip_clearance", w.tip_clearance},
          {"width", w.width},
          {"inertia", w.inertia}};
}

Json stage_json(const GearStage& s) {
  const GearPair& p = s.pair;
  Json j = {{"name", s.name}, {"module", p.data.module}, {"helix", p.data.helix}, {"ratio", p.ratio}};
  j["wheels"] = {wheel_json(p.wheel[0]), wheel_json(p.wheel[1])};
  j["centre_distance"] = p.centre_distance;
  j["reference_centre_distance"] = p.reference_centre_distance;
  j["working_angle"] = p.working_angle;
  j["shift_sum"] = p.shift_sum;
  j["tip_shortening"] = p.tip_shortening;
  j["base_pitch"] = p.base_pitch;
  j["contact_ratio"] = p.contact_ratio;
  j["overlap_ratio"] = p.overlap_ratio;
  for (const char name : {'A', 'B', 'C', 'D', 'E'}) {
    const double g = p.point(name);
    const auto zeta = p.specific_sliding(g);
    j["path"].push_back({{"point", std::string(1, name)},
                         {"g", g},
                         {"sliding_over_omega", p.sliding_speed(g, 1)},
                         {"specific_sliding", {finite(zeta[0]), finite(zeta[1])}}});
  }
  j["backlash_normal"] = p.backlash_normal;
  j["backlash_angle"] = {p.backlash_angle(0), p.backlash_angle(1)};
  j["mesh_stiffness"] = {{"single", s.stiffness.single},
                         {"mean", s.stiffness.mean},
                         {"torsional", s.stiffness.torsional},
                         {"within_range_of_method", s.stiffness.within}};
  if (s.speed) j["mesh_frequency"] = p.mesh_frequency(*s.speed);
  j["verdicts"] = Json::array();
  for (const GearVerdict& v : s.verdicts) j["verdicts"].push_back({{"finding", word_of(v.finding)}, {"text", v.text}});
  return j;
}

std::string json_of(const Gears& g, const std::string& conclusion) {
  Json j = {{"title", g.title}, {"scene", g.scene_file}, {"conclusion", conclusion}};
  j["pairs"] = Json::array();
  for (const GearStage& s : g.stages) j["pairs"].push_back(stage_json(s));
  j["notes"] = g.notes;
  return json_text(j);
}

std::string path_csv(const GearPair& p) {
  std::string text = "g [m],r1 [m],r2 [m],rho1 [m],rho2 [m],sliding/omega1 [m],zeta1,zeta2\n";
  for (int i = 0; i < plot_points; ++i) {
    const double g = p.start + (p.end - p.start) * i / (plot_points - 1);
    const auto rho = p.curvature(g), r = p.radius(g), zeta = p.specific_sliding(g);
    text += fmt::format("{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{},{}\n", g, r[0], r[1], rho[0], rho[1],
                        p.sliding_speed(g, 1), std::isfinite(zeta[0]) ? fmt::format("{:.9g}", zeta[0]) : "",
                        std::isfinite(zeta[1]) ? fmt::format("{:.9g}", zeta[1]) : "");
  }
  return text;
}

std::string outline_csv(const GearWheel& w) {
  std::string text = "x [mm],y [mm]\n";
  for (const OutlinePoint& q : wheel_outline(w, 16)) text += fmt::format("{:.7f},{:.7f}\n", mm * q.x, mm * q.y);
  return text;
}

// --- report ---

GearView::Wheel view_of(const GearPair& p, int i) {
  const MeshedWheel& w = p.wheel[static_cast<std::size_t>(i)];
  GearView::Wheel view;
  view.name = fmt::format("wheel {}", i + 1);
  view.teeth = std::abs(w.teeth);
  view.internal = w.internal();
  for (const OutlinePoint& q : tooth_outline(w, view.teeth > 60 ? 7 : 10)) {
    view.x.push_back(q.x);
    view.y.push_back(q.y);
  }
  const MeshPlace place = mesh_place(p, 0);
  view.centre = i == 0 ? 0 : p.centre_distance;
  view.angle = i == 0 ? 0 : place.angle_2;
  view.speed = i == 0 ? 1 : -1 / p.ratio;
  view.circles = {{"root", 0.5 * std::abs(w.root_diameter)},
                  {"base", 0.5 * std::abs(w.base_diameter)},
                  {"working", 0.5 * std::abs(w.working_diameter)},
                  {"tip", 0.5 * std::abs(w.tip_diameter)}};
  view.edge = 0.5 * w.bore;
  return view;
}

GearView drawing_of(const GearStage& s) {
  const GearPair& p = s.pair;
  GearView view{
      .title = fmt::format("{}: both wheels in mesh, transverse section", s.name), .wheels = {}, .points = {}};
  view.note =
      "Wheel 1 turns counterclockwise and drives. Flanks are involutes, external fillets the trochoids that the "
      "rounded "
      "rack cuts; fillets of an internal wheel are drawn as circles.";
  view.wheels = {view_of(p, 0), view_of(p, 1)};
  view.pitch_point = 0.5 * p.wheel[0].working_diameter;
  view.direction = std::numbers::pi / 2 - p.working_angle;
  for (const char name : {'A', 'B', 'C', 'D', 'E'}) view.points.push_back({std::string(1, name), p.point(name)});
  view.points.push_back({"T₁", p.limit_start});
  if (!p.internal()) view.points.push_back({"T₂", p.limit_end});
  view.start = p.start;
  view.end = p.end;
  view.base_pitch = p.base_pitch;
  view.first_contact = contact_at(p, 0);
  view.base_radius = 0.5 * p.wheel[0].base_diameter;
  view.close_up = 1.25 * std::max({std::abs(p.start), std::abs(p.end), 2.5 * p.wheel[0].transverse_module});
  return view;
}

template <class F>
Series over_path(const GearPair& p, const std::string& name, Role role, F&& value) {
  Series s{.name = name, .role = role, .x = {}, .y = {}};
  for (int i = 0; i < plot_points; ++i) {
    const double g = p.start + (p.end - p.start) * i / (plot_points - 1), v = value(g);
    if (!std::isfinite(v) || std::abs(v) > shown_sliding) continue;
    s.x.push_back(mm * g);
    s.y.push_back(v);
  }
  return s;
}

std::vector<EventMark> path_marks(const GearPair& p) {
  std::vector<EventMark> marks;
  for (const char name : {'A', 'B', 'C', 'D', 'E'})
    marks.push_back({mm * p.point(name), fmt::format("{}{}", name, name == 'C' ? ", pitch point" : "")});
  return marks;
}

Plot sliding_plot(const GearStage& s) {
  const GearPair& p = s.pair;
  const double omega = s.speed ? std::abs(*s.speed) : 2 / p.wheel[0].working_diameter;
  Plot plot{.title = "Sliding is least at the pitch point and greatest at the ends of the path",
            .x = {"place on the path of contact g", "mm"},
            .y = {s.speed ? "sliding speed v_g" : "sliding speed over pitch-line speed", s.speed ? "m/s" : ""},
            .series = {}};
  Series line{.name = "flank of wheel 1 over that of wheel 2", .role = Role::elastic, .x = {}, .y = {}};
  for (int i = 0; i < plot_points; ++i) {
    const double g = p.start + (p.end - p.start) * i / (plot_points - 1);
    line.x.push_back(mm * g);
    line.y.push_back(p.sliding_speed(g, omega));
  }
  plot.series.push_back(std::move(line));
  plot.marks = path_marks(p);
  return plot;
}

Plot specific_plot(const GearPair& p) {
  Plot plot{.title = "Specific sliding: wear grows towards the root of either wheel",
            .x = {"place on the path of contact g", "mm"},
            .y = {"specific sliding ζ", ""},
            .series = {}};
  plot.series.push_back(over_path(p, "wheel 1", Role::elastic, [&](double g) { return p.specific_sliding(g)[0]; }));
  plot.series.push_back(over_path(p, "wheel 2", Role::orange, [&](double g) { return p.specific_sliding(g)[1]; }));
  plot.marks = path_marks(p);
  plot.note = fmt::format("Values beyond ±{:g} are left out: at a base circle ζ runs to −∞.", shown_sliding);
  return plot;
}

Plot thickness_plot(const MeshedWheel& w, int i) {
  Plot plot{.title = fmt::format("Tooth thickness of wheel {} from its form circle to its tip", i + 1),
            .x = {"radius", "mm"},
            .y = {"transverse tooth thickness s_t", "mm"},
            .series = {}};
  Series s{.name = fmt::format("wheel {}", i + 1), .role = i == 0 ? Role::elastic : Role::orange, .x = {}, .y = {}};
  const double from = w.internal() ? w.tip_diameter : w.form_diameter,
               to = w.internal() ? w.form_diameter : w.tip_diameter;
  for (int k = 0; k < 101; ++k) {
    const double d = from + (to - from) * k / 100;
    s.x.push_back(mm * 0.5 * std::abs(d));
    s.y.push_back(mm * w.thickness(d));
  }
  plot.series.push_back(std::move(s));
  plot.marks = {{mm * 0.5 * std::abs(w.reference_diameter), "reference circle"},
                {mm * 0.5 * std::abs(w.working_diameter), "working circle"}};
  return plot;
}

void add_formulas(ReportSection& section, const GearStage& s) {
  const GearPair& p = s.pair;
  const double alpha_n = p.data.rack.pressure_angle;
  const MeshedWheel& one = p.wheel[0];
  section.cards.push_back(Formula{
      .title = "Working pressure angle (theory 6.5)",
      .symbols = "inv α_wt = inv α_t + 2 tan α_n Σx/(z₁ + z₂)",
      .numbers = fmt::format("inv α_wt = {:.8f} + 2 tan {:.4g}° · {:.6g}/({}) = {:.8f},   α_wt = {:.5f}°",
                             involute(one.transverse_angle), alpha_n / degree, p.mating_shift_sum,
                             p.data.teeth[0] + p.data.teeth[1], involute(p.working_angle), p.working_angle / degree)});
  section.cards.push_back(
      Formula{.title = "Centre distance (theory 6.6)",
              .symbols = "a_w = ½ m_t (z₁ + z₂) cos α_t/cos α_wt",
              .numbers = fmt::format("a_w = ½ · {:.5f} · ({}) · {:.6f}/{:.6f} = {:.4f} mm", mm * one.transverse_module,
                                     p.data.teeth[0] + p.data.teeth[1], std::cos(one.transverse_angle),
                                     std::cos(p.working_angle), mm * p.centre_distance)});
  section.cards.push_back(Formula{.title = "Contact ratio (theory 6.9)",
                                  .symbols = "ε_α = (g_E − g_A)/(π m_t cos α_t)",
                                  .numbers = fmt::format("ε_α = ({:.4f} − ({:.4f}))/{:.4f} = {:.4f}", mm * p.end,
                                                         mm * p.start, mm * p.base_pitch, p.contact_ratio)});
  section.cards.push_back(Formula{
      .title = "Specific sliding at both ends (theory 6.11)",
      .symbols = "ζ₁ = 1 − ρ₂/(u ρ₁),   ζ₂ = 1 − u ρ₁/ρ₂",
      .numbers = fmt::format("A: ζ₁ = {}, ζ₂ = {};   E: ζ₁ = {}, ζ₂ = {}", number(p.specific_sliding(p.start)[0], 5),
                             number(p.specific_sliding(p.start)[1], 5), number(p.specific_sliding(p.end)[0], 5),
                             number(p.specific_sliding(p.end)[1], 5))});
  section.cards.push_back(Formula{
      .title = "Undercut of wheel 1 (theory 6.4)",
      .symbols = "x_min = h_Ff* − z sin² α_t/(2 cos β),   h_Ff* = h_f* − ρ_f* (1 − sin α_n)",
      .numbers = fmt::format("x_min = {:.5f} − {} · {:.6f}/(2 · {:.6f}) = {:.4f};   x_E = {:.4f}",
                             p.data.rack.straight_depth(), one.teeth, std::pow(std::sin(one.transverse_angle), 2),
                             std::cos(p.data.helix), one.least_shift_generated(), one.generating_shift)});
  section.cards.push_back(Formula{
      .title = "Mesh stiffness, ISO 6336-1 method B (theory 6.13)",
      .symbols = "c_γα = c′ (0.75 ε_α + 0.25),   k = c_γα b r_b1²",
      .numbers = fmt::format(
          "c_γα = {:.4g} · (0.75 · {:.4f} + 0.25) = {:.4g} N/(mm·µm){}", 1e-9 * s.stiffness.single, p.contact_ratio,
          1e-9 * s.stiffness.mean,
          s.stiffness.torsional > 0 ? fmt::format(",   k = {:.5g} N·m/rad about wheel 1", s.stiffness.torsional) : ""),
      .note = fmt::format("An estimate: solid wheels, a load of at least 100 N per mm of width.{}",
                          s.stiffness.within ? "" : " Outside the range that the method was fitted for.")});
}

Table table_card(const std::string& title, Rows rows, std::size_t text_columns) {
  Table table{.title = title, .columns = rows.front(), .rows = {}, .text_columns = text_columns};
  table.rows.assign(rows.begin() + 1, rows.end());
  return table;
}

void add_stage(Report& report, const GearStage& s) {
  ReportSection& section = report.add(s.name);
  section.cards.push_back(drawing_of(s));
  std::string words;
  for (const GearVerdict& v : s.verdicts) words += fmt::format("{}: {}\n", word_of(v.finding), v.text);
  section.cards.push_back(Text{.title = "Verdict", .body = words});
  section.cards.push_back(sliding_plot(s));
  section.cards.push_back(specific_plot(s.pair));
  for (const int i : {0, 1}) section.cards.push_back(thickness_plot(s.pair.wheel[static_cast<std::size_t>(i)], i));
  add_formulas(section, s);
  section.cards.push_back(table_card("Wheels", wheel_rows(s.pair), 2));
  section.cards.push_back(table_card("Mesh", mesh_rows(s), 2));
  section.cards.push_back(table_card("Along the path of contact", path_rows(s), 1));
}

Report report_of(const Gears& g, const std::string& conclusion) {
  Report report{.title = g.scene_file.empty() ? g.title : fmt::format("{}: gear pairs", g.title),
                .subtitle = "Involute geometry after ISO 21771",
                .conclusion = conclusion};
  for (const GearStage& s : g.stages) {
    const std::string prefix = g.stages.size() > 1 ? s.name + ": " : "";
    report.figures.push_back({prefix + "centre distance", mm * std::abs(s.pair.centre_distance), "mm", {}, "", 7});
    report.figures.push_back({prefix + "contact ratio ε_α", s.pair.contact_ratio, "", {}, "", 4});
    report.figures.push_back(
        {prefix + "greatest specific sliding",
         std::min(s.pair.specific_sliding(s.pair.start)[0], s.pair.specific_sliding(s.pair.end)[1]),
         "",
         {},
         "at the foot of a flank",
         3});
    report.figures.push_back({prefix + "backlash at wheel 1", 1e3 * s.pair.backlash_angle(0), "mrad", {}, "", 4});
    if (s.stiffness.torsional > 0)
      report.figures.push_back(
          {prefix + "mesh stiffness about wheel 1", s.stiffness.torsional, "N*m/rad", {}, "ISO 6336-1 B", 3});
  }
  for (const GearStage& s : g.stages) add_stage(report, s);
  std::string notes;
  for (const std::string& note : g.notes) notes += note + "\n";
  if (!notes.empty()) report.add("Notes").cards.push_back(Text{.title = "", .body = notes});
  if (!g.scene_text.empty())
    report.add("Scene").cards.push_back(
        Text{.title = g.scene_file, .body = g.scene_text, .verbatim = true, .folded = true});
  report.footer = report_footer();
  return report;
}

}  // namespace

StudyOutput output_of(const Gears& g) {
  StudyOutput output;
  output.conclusion = conclusion_of(g);
  output.table = table_of(g, output.conclusion);
  output.json = json_of(g, output.conclusion);
  output.report = [g, conclusion = output.conclusion] { return report_of(g, conclusion); };
  for (const GearStage& s : g.stages) {
    output.csv.push_back({fmt::format("{}.path.csv", s.name), [p = s.pair] { return path_csv(p); }});
    for (const std::size_t i : {0, 1})
      output.csv.push_back(
          {fmt::format("{}.wheel{}.csv", s.name, i + 1), [w = s.pair.wheel[i]] { return outline_csv(w); }});
  }
  return output;
}

}  // namespace kurbel
