// size_findings.cpp — words and tables of the sized flywheel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/output.h"
#include "studies/sheet/scales.h"
#include "studies/size/size.h"
#include "studies/size/size_plots.h"
#include "studies/size/size_words.h"

namespace kurbel {
namespace {

// --- tables ---

// On the terminal below its title, followed by a blank line.
void say_titled(Findings& f, Chapter in, Rows rows) {
  rows.heading = rows.title;
  rows.apart = false;
  rows.even_if_empty = true;
  f.say(in, std::move(rows));
  f.say(in, Sentences{.lines = {""}, .page = false});
}

auto ended_at_error(double SizeMethod::*inertia) {
  return [inertia](const SizeMethod& m) {
    constexpr double rounding = 1e-12;  // of the inertias
    const bool zero =
        std::abs(m.*inertia) <= rounding * std::max(std::abs(m.flywheel.value), std::abs(m.flywheel_by_parts));
    return zero ? std::string("0") : figure_text({m.*inertia, m.flywheel.error}).value;
  };
}

Rows methods_table(const Sizing& s) {
  std::vector<SizeMethod> all = s.methods;
  if (s.soft) all.push_back(*s.soft);
  if (s.meeting && !(s.soft && s.soft->name == s.meeting->name)) all.push_back(*s.meeting);
  return table_of("methods", "Flywheel by each method", std::move(all))
      .column("method", "method", &SizeMethod::name)
      .only_for_programs("drive_inertia", &SizeMethod::drive_inertia)
      .only_for_programs("flywheel", [](const SizeMethod& m) { return m.flywheel.value; })
      .only_for_programs("flywheel_error", [](const SizeMethod& m) { return m.flywheel.error; })
      .only_for_programs("flywheel_by_parts", &SizeMethod::flywheel_by_parts)
      .only_for_people("I_drive on link [kg·m²]", ended_at_error(&SizeMethod::drive_inertia))
      .value_and_error("flywheel [kg·m²]",
                       [](const SizeMethod& m, int digits) {
                         return m.flywheel.value > 0 ? figure_text(m.flywheel, digits) : FigureText{"none", ""};
                       })
      .only_for_people("I_drive − 1.1 I_motor − I_gearbox [kg·m²]",
                       [](const SizeMethod& m) {
                         return m.flywheel_by_parts > 0 ? ended_at_error(&SizeMethod::flywheel_by_parts)(m) : "none";
                       })
      .only_for_people(
          "against exact [%]",
          [&](const SizeMethod& m) { return fmt::format("{:+.3f}", 100 * (m.drive_inertia / s.exact.inertia - 1)); })
      .column("delta", "δ reached", &SizeMethod::delta, {.digits = 6, .otherwise = "stops"});
}

Rows reached_table(const Sizing& s) {
  return table_of("reached", fmt::format("δ reached against δ = {:g} demanded", s.delta), s.reached)
      .text_in(2)
      .column("model", "model", [](const DeltaReached& r) { return name_of(r.model); })
      .column("sized_by", "flywheel sized by", &DeltaReached::sized_by)
      .column("flywheel", "flywheel [kg·m²]", &DeltaReached::flywheel)
      .only_for_programs("delta_crank", &DeltaReached::crank)
      .value_and_error("δ at the crank", [](const DeltaReached& r, int digits) { return figure_text(r.crank, digits); })
      .only_for_programs("delta_motor", &DeltaReached::motor)
      .value_and_error("δ at the motor",
                       [&](const DeltaReached& r, int digits) {
                         return s.motor.empty() ? FigureText{"—", ""} : figure_text(r.motor, digits);
                       })
      .column("mid_speed", fmt::format("mid speed [{}]", s.speed_unit.name), &DeltaReached::mid_speed,
              {.factor = s.speed_unit.of(1)})
      .only_for_programs("settled", [](const DeltaReached&) { return true; })  // a steady motion is nothing else
      .only_for_programs("cycles", &DeltaReached::cycles)
      .only_for_people("cycles", [](const DeltaReached& r) {
        return r.cycles ? fmt::format("{}", r.cycles) : std::string("exact");
      });
}

Rows dimensions_table(const FlywheelDimensions& d) {
  Lines lines;
  const auto add = [&](const std::string& name, const std::string& value) { lines.push_back({name, value}); };
  add("material", fmt::format("{}, ρ = {:g} kg/m³, tensile strength {:g} MPa", d.material.name, d.material.density,
                              d.material.strength / 1e6));
  add("outer diameter D", fmt::format("{:.5g} mm", 1e3 * d.diameter));
  add("breadth b", fmt::format("{:.5g} mm", 1e3 * d.breadth));
  if (d.form == FlywheelForm::rim) {
    add("thickness of the rim h = b/2", fmt::format("{:.5g} mm", 1e3 * d.thickness));
    add("spokes (elliptical)",
        fmt::format("{} of {:.4g} mm × {:.4g} mm", flywheel_spokes, 1e3 * d.thickness, 500 * d.thickness));
    add("hub diameter D/5", fmt::format("{:.5g} mm", 200 * d.diameter));
    add("mass of the rim", fmt::format("{:.5g} kg", d.rim_mass));
    add("rim's share of the inertia", fmt::format("{:.3g} %", 100 * d.rim_share));
  }
  add("mass", fmt::format("{:.5g} kg", d.mass));
  add("rim speed at ω_max", fmt::format("{:.4g} m/s, limit {:.4g} m/s{}", d.rim_speed, d.rim_speed_limit,
                                        d.within_limit ? "" : " — EXCEEDED"));
  add(d.form == FlywheelForm::disc ? "stress at the centre (3+ν)/8 ρ v²" : "stress of a free rim ρ v²",
      fmt::format("{:.4g} MPa, limit {:.4g} MPa", d.stress / 1e6, d.allowed_stress / 1e6));
  if (d.form == FlywheelForm::rim)
    add("stress with bending between spokes", fmt::format("{:.4g} MPa", d.spoked_stress / 1e6));
  add("safety against tensile strength", read_as(d.safety, {.digits = 3}));
  add("energy stored at ω_max", with_unit(d.energy, "J", 5));
  return words_table(d.form == FlywheelForm::disc ? "Dimensions of a solid disc" : "Dimensions of a rim on six spokes",
                     {"quantity", "value"}, lines);
}

Rows inertias_table(const Sizing& s) {
  std::vector<std::pair<std::string, double>> parts = s.other_parts;
  parts.emplace_back("sum", s.motor_inertia + s.gearbox_inertia + s.other_inertia);
  using Part = std::pair<std::string, double>;
  return table_of("", fmt::format("What else turns at constant ratio, reduced to {}", s.flywheel), std::move(parts))
      .not_on_terminal()
      .only_for_people("component", &Part::first)
      .only_for_people("inertia [kg·m²]", &Part::second);
}

std::vector<double> angles(const Sizing& s, int steps) {
  std::vector<double> list;
  for (int k = 0; k <= steps; ++k) list.push_back(s.diagram.excess.begin() + s.diagram.excess.length() * k / steps);
  return list;
}

Rows positions_table(const Sizing& s) {
  constexpr int steps = 12;
  const std::vector<double> phi = angles(s, steps);
  const double largest = s.diagram.load_torque.largest(), energy = s.diagram.load_work.largest();
  // Rounding errors relative to the largest value are set to zero.
  const auto clean = [&](const Piecewise& f, double scale) {
    return [&f, &phi, scale](std::size_t k) {
      const double v = f.value(phi[k]);
      return std::abs(v) < 1e-11 * scale ? 0.0 : v;
    };
  };
  return table_of("", "The cycle at 12 positions", numbers_below(phi.size()))
      .not_on_terminal()
      .only_for_people("position", [](std::size_t k) { return k; })
      .only_for_people("φ [°]", [&](std::size_t k) { return in_degrees * phi[k]; })
      .only_for_people("M_d [N·m]", clean(s.diagram.drive_torque, largest))
      .only_for_people("M_c [N·m]", clean(s.diagram.load_torque, largest))
      .only_for_people("A_d [J]", clean(s.diagram.drive_work, energy))
      .only_for_people("A_c [J]", clean(s.diagram.load_work, energy))
      .only_for_people("ΔT [J]", clean(s.diagram.excess, energy))
      .only_for_people("I_em [kg·m²]", clean(s.cycle.mechanism.value, 0));
}

// Scales of diagrams on a sheet, per millimetre (theory 3).
Rows scales_table(const Sizing& s) {
  const double length = 1e3 * *s.diagram_length, height = length / 2;
  const double mu_phi = s.diagram.excess.length() / length;
  const double mu_m = round_scale(std::max(s.diagram.load_torque.largest(), s.diagram.drive_torque.largest()) / height);
  const double mu_a = mu_m * mu_phi;
  const double pole =
      round_scale(std::max(s.diagram.load_work.largest(), s.diagram.drive_work.largest()) / height / mu_a);
  Lines lines;
  lines.push_back({"μ_φ", read_as(mu_phi) + " rad/mm", "angle axis: one cycle over the sheet"});
  lines.push_back({"μ_M", read_as(mu_m) + " N·m/mm", "M_c, M_d"});
  lines.push_back({"μ_A = μ_M μ_φ", read_as(mu_a) + " J/mm²",
                   "area below the torques; A_c, A_d drawn with a pole distance of 1 mm"});
  lines.push_back({"μ_T = μ_A", read_as(mu_a) + " J/mm", "ΔT with a pole distance of 1 mm"});
  lines.push_back({"H μ_A", read_as(pole * mu_a) + " J/mm",
                   fmt::format("A_c, A_d, ΔT drawn with a pole distance of H = {:g} mm", pole)});
  const double largest = s.cycle.mechanism.value.largest();
  if (largest > 0) lines.push_back({"μ_I", read_as(round_scale(largest / height)) + " kg·m²/mm", "I_em"});
  Rows table = words_table(fmt::format("Scales for a sheet of {:g} mm", length), {"scale", "value", "for"}, lines);
  table.text_columns = table.text_columns_on_terminal = 3;
  return table;
}

// --- for programs and files ---

Record tangent_record(const Tangent& t) {
  return {
      {"slope", t.slope}, {"phi", t.phi}, {"inertia", t.inertia}, {"excess", t.excess}, {"intercept", t.intercept()}};
}

Record dimensions_record(const FlywheelDimensions& d) {
  return {{"form", d.form == FlywheelForm::disc ? "disc" : "rim"},
          {"material", d.material.name},
          {"diameter", d.diameter},
          {"breadth", d.breadth},
          {"thickness", d.thickness},
          {"mass", d.mass},
          {"rim_mass", d.rim_mass},
          {"rim_share", d.rim_share},
          {"rim_speed", d.rim_speed},
          {"rim_speed_limit", d.rim_speed_limit},
          {"within_limit", d.within_limit},
          {"stress", d.stress},
          {"spoked_stress", d.spoked_stress},
          {"allowed_stress", d.allowed_stress},
          {"safety", d.safety},
          {"energy", d.energy}};
}

Record punch_record(const PunchPress& p) {
  return {{"energy", p.energy},
          {"cycle_time", p.cycle_time},
          {"working_time", p.working_time},
          {"power", p.power()},
          {"from_flywheel", p.from_flywheel()}};
}

void report_basis(Findings& f, const Sizing& s) {
  f.record("link", s.link);
  f.record("basis", s.basis == CycleBasis::classical ? "classical" : "steady");
  f.record("delta", Record{{"demanded", s.delta}, {"source", s.delta_source}});
  f.record("mid_speed", Record{{"value", s.mid_speed}, {"unit", "rad/s"}, {"source", s.mid_speed_source}});
  f.record("flywheel", Record{{"component", s.flywheel},
                              {"added", s.flywheel_added},
                              {"needed", s.needed},
                              {"inertia", s.methods.front().flywheel.value},
                              {"unit", "kg*m2"},
                              {"in_scene", s.flywheel_now},
                              {"speed_ratio", s.flywheel_ratio},
                              {"delta_in_scene", s.delta_now},
                              {"delta_of_steady_cycle_in_scene", s.delta_of_orbit}});
  f.record("work_diagram", Record{{"work", s.diagram.work},
                                  {"mean_torque", s.diagram.mean_torque()},
                                  {"fluctuation", s.diagram.fluctuation()},
                                  {"phi_most", s.diagram.most.x},
                                  {"phi_least", s.diagram.least.x},
                                  {"energy_coefficient", s.diagram.energy_coefficient()}});
  f.record("wittenbauer", Record{{"inertia", s.exact.inertia},
                                 {"upper", tangent_record(s.exact.upper)},
                                 {"lower", tangent_record(s.exact.lower)}});
}

DataTable diagrams_data(const Sizing& s) {
  const auto of = [](const Piecewise& f) { return [&f](double x) { return f.value(x); }; };
  return data_of(angles(s, curve_points))
      .in_file("phi", "rad", std::identity())
      .in_file("M_d", "N*m", of(s.diagram.drive_torque))
      .in_file("M_c", "N*m", of(s.diagram.load_torque))
      .in_file("A_d", "J", of(s.diagram.drive_work))
      .in_file("A_c", "J", of(s.diagram.load_work))
      .in_file("dT", "J", of(s.diagram.excess))
      .in_file("I_em", "kg*m2", of(s.cycle.mechanism.value))
      .data();
}

// --- all of it ---

void add_key_figures(Findings& f, const Sizing& s) {
  if (s.meeting) f.key("flywheel that meets δ", s.meeting->flywheel, "flywheel_that_meets", s.meeting->name);
  f.key("flywheel", s.methods.front().flywheel, "flywheel", "Wittenbauer, exact " + basis_of(s));
  if (s.soft) f.key("flywheel with " + slope_of_what(s), s.soft->flywheel, "flywheel_with_slope");
  for (const DeltaReached& r : s.reached)
    if (r.by == SizedBy::constant_drive && r.model != SizedModel::work_equation) {
      f.key(fmt::format("δ at the crank, {}", name_of(r.model)), r.crank, "delta_reached");
      if (r.model == SizedModel::elastic && !s.motor.empty())
        f.key(fmt::format("δ at the motor, {}", name_of(r.model)), r.motor, "delta_reached");
    }
  f.key("fluctuation of energy", s.fluctuation, "fluctuation_of_energy");
  if (s.dimensions) f.key("mass", s.mass, "flywheel_mass", s.dimensions->material.name);
}

void say_notes(Findings& f, Chapter in, const Sizing& s) {
  std::vector<std::string> notes;
  for (const std::string& why : {s.soft_why, s.dimensions_why, s.meeting ? std::string() : s.meeting_words})
    if (!why.empty()) notes.push_back(why);
  notes.insert(notes.end(), s.notes.begin(), s.notes.end());
  f.say(in, Sentences{.lines = notes, .indent = "note: "});
  f.record("notes", s.notes);
}

// The actual machine may not have the δ that it was sized for.
void add_answers(Findings& f, const Sizing& s) {
  f.conclude(s.complete, conclusion_of(s));
  for (const std::string& text : motions_in_words(s)) f.conclude(true, text);
  f.claim(missed_demand(s));
}

// Rim speed and stress of the resulting flywheel, at the greatest speed of the cycle.
void judge_dimensions(Findings& f, const Sizing& s) {
  if (!s.dimensions) return;
  const FlywheelDimensions& d = *s.dimensions;
  const auto judge = [&](const std::string& what, double value, double limit, const char* unit) {
    const bool holds = value <= limit;
    std::optional<Claim> claim =
        claimed(holds ? Predicate::limit_held : Predicate::limit_exceeded,
                fmt::format("the flywheel of {} has a {} of {}, {:.0f} % of the limit{}", d.material.name, what,
                            short_text(value, unit), 100 * value / limit, holds ? "" : ": EXCEEDED"),
                s.flywheel, {.value = value, .limit = limit, .unit = unit});
    if (!claim) return;
    claim->load_case = load_case::steady, claim->in_conclusion = !holds;
    f.claim(std::move(claim));
  };
  judge("rim speed", d.rim_speed, d.rim_speed_limit, "m/s");
  judge("stress", d.stress, d.allowed_stress, "Pa");
}

}  // namespace

Findings findings_of(const Sizing& s) {
  Findings f = Findings::of(s, fmt::format("Flywheel for δ = {:g}", s.delta));
  f.speed_unit = s.speed_unit.name, f.opening = Findings::Opening::title_and_conclusion;
  add_answers(f, s);
  judge_dimensions(f, s);
  const Chapter cycle = f.chapter("One cycle"), synthesis = f.chapter("Inertia for the demanded δ"),
                motor = f.chapter("With the torques as they are over the speed, rigid and elastic"),
                body = f.chapter("Dimensions"), scales = f.chapter("Scales of the diagrams"),
                notes = f.chapter("Notes");
  add_key_figures(f, s);
  report_basis(f, s);
  f.draw(cycle, [&s] { return cycle_diagrams(s); });
  f.show(cycle, cycle_formulas(s));
  f.say(cycle, positions_table(s));
  f.say(cycle, basis_words(s));
  f.say(cycle, Sentences{.lines = {""}, .page = false});
  f.draw(synthesis, [&s] { return energy_mass_plots(s); });
  f.show(synthesis, method_formulas(s));
  f.show(synthesis, flywheel_formulas(s));
  say_titled(f, synthesis, methods_table(s));
  f.say(synthesis, inertias_table(s));
  f.show(synthesis, Text{.title = "Against the scene", .body = comparison_with_scene(s)});
  f.show(motor, motor_formulas(s));
  if (s.operating || !s.reached.empty()) f.draw(motor, [&s] { return speed_plot(s); });
  if (s.reached.empty())
    f.record("reached", List{});
  else
    say_titled(f, motor, reached_table(s));
  if (s.dimensions) {
    say_titled(f, body, dimensions_table(*s.dimensions));
    f.show(body, dimension_formulas(*s.dimensions));
    f.record("dimensions", dimensions_record(*s.dimensions));
  }
  if (s.punch) {
    f.say(synthesis, Sentences{.lines = {punch_words(*s.punch)}, .page = false});
    f.record("punch_press", punch_record(*s.punch));
  }
  if (s.diagram_length) say_titled(f, scales, scales_table(s));
  say_notes(f, notes, s);
  f.tables = {{"diagrams", [&s] { return diagrams_data(s); }}};
  return f;
}

}  // namespace kurbel
