// size_output.cpp — the sized flywheel as table, JSON, CSV and a report to file: every formula with its numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"
#include "studies/size/size.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;
constexpr double degrees = 180 / std::numbers::pi;

double rpm(double speed) { return speed * 30 / std::numbers::pi; }
std::string number(double value, int digits = 6) { return fmt::format("{:.{}g}", value + 0.0, digits); }

const SizeMethod& exact_method(const Sizing& s) { return s.methods.front(); }

const DeltaReached* reached(const Sizing& s, const std::string& model) {
  for (const DeltaReached& r : s.reached)
    if (r.model == model && r.sized_by == "Wittenbauer") return &r;
  return nullptr;
}

// What the classical methods take the torques for.
std::string basis_of(const Sizing& s) {
  return s.engine ? "at torques of the angle alone" : "at constant driving torque";
}

const char* unless_settled(const DeltaReached& r) {
  return r.settled ? "" : " in its last cycle, for it does not settle (see the notes)";
}

std::string conclusion_of(const Sizing& s) {
  const SizeMethod& exact = exact_method(s);
  if (!s.needed)
    return fmt::format(
        "{}: no flywheel is needed for δ = {:g}: without any, δ is smaller already; {}", s.title, s.delta,
        exact.drive_inertia > 0
            ? fmt::format("the drive could be lighter by {:.5g} kg·m² on {}", -exact.flywheel, s.flywheel)
            : std::string("its torques would not swing the speed as far with any inertia"));
  std::string text = fmt::format("{}: a flywheel of {:.6g} kg·m² on {} keeps δ at {:g} {}", s.title, exact.flywheel,
                                 s.flywheel, s.delta, basis_of(s));
  if (s.soft) {
    const double less = 100 * (1 - s.soft->flywheel / exact.flywheel);
    text += s.soft->flywheel > 0 ? fmt::format("; with {} counted {:.6g} kg·m² do ({:.3g} % {})", slope_of_what(s),
                                               s.soft->flywheel, std::abs(less), less >= 0 ? "less" : "more")
                                 : fmt::format("; with {} counted none is needed", slope_of_what(s));
  }
  if (const DeltaReached* rigid = reached(s, "rigid, simulated"))
    text += fmt::format("; simulated rigid it reaches {:.5g}{}", rigid->crank, unless_settled(*rigid));
  if (const DeltaReached* elastic = reached(s, "elastic, simulated"))
    text += fmt::format(", elastic {:.5g} at the crank{}{}", elastic->crank,
                        s.motor.empty() ? "" : fmt::format(" and {:.5g} at the motor", elastic->motor),
                        unless_settled(*elastic));
  return text;
}

std::string comparison_with_scene(const Sizing& s) {
  if (s.flywheel_added) return fmt::format("The scene has no flywheel; it is put on the shaft of {}.", s.link);
  const double needed = exact_method(s).flywheel;
  const std::string now = std::isnan(s.delta_now) ? "the machine would stop within the cycle"
                                                  : fmt::format("δ = {:.5g} {}", s.delta_now, basis_of(s));
  return fmt::format("The scene's \"{}\" has {:.6g} kg·m²: {}; it is {}.", s.flywheel, s.flywheel_now, now,
                     s.flywheel_now >= needed ? "already larger than needed" : "too small");
}

// --- tables ---

Table methods_table(const Sizing& s) {
  Table t{.title = "Flywheel by each method",
          .columns = {"method", "I_drive on link [kg·m²]", "flywheel [kg·m²]", "by theory 3.1 [kg·m²]",
                      "against exact [%]", "δ reached"},
          .rows = {}};
  std::vector<SizeMethod> all = s.methods;
  if (s.soft) all.push_back(*s.soft);
  for (const SizeMethod& m : all)
    t.rows.push_back({m.name, number(m.drive_inertia, 7), number(m.flywheel, 7), number(m.flywheel_by_parts, 7),
                      fmt::format("{:+.3f}", 100 * (m.drive_inertia / s.exact.inertia - 1)),
                      m.delta ? number(*m.delta, 7) : "stops"});
  return t;
}

Table reached_table(const Sizing& s) {
  Table t{.title = fmt::format("δ reached against δ = {:g} demanded", s.delta),
          .columns = {"model", "flywheel sized by", "flywheel [kg·m²]", "δ at the crank", "error", "δ at the motor",
                      "error", "mean speed [rpm]", "cycles"},
          .rows = {},
          .text_columns = 2};
  for (const DeltaReached& r : s.reached)
    t.rows.push_back({r.model, r.sized_by, number(r.flywheel), figure_text(r.crank, r.crank_error).value,
                      figure_text(r.crank, r.crank_error).error,
                      s.motor.empty() ? "—" : figure_text(r.motor, r.motor_error).value,
                      s.motor.empty() ? "" : figure_text(r.motor, r.motor_error).error, number(rpm(r.mean_speed)),
                      r.cycles ? fmt::format("{}{}", r.cycles, r.settled ? "" : ", not settled") : "exact"});
  return t;
}

Table dimensions_table(const FlywheelDimensions& d) {
  Table t{.title = d.form == FlywheelForm::disc ? "Dimensions of a solid disc" : "Dimensions of a rim on six spokes",
          .columns = {"quantity", "value"},
          .rows = {}};
  const auto add = [&](const std::string& name, const std::string& value) { t.rows.push_back({name, value}); };
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
  add("safety against tensile strength", number(d.safety, 3));
  add("energy stored at ω_max", with_unit(d.energy, "J", 5));
  return t;
}

Table inertias_table(const Sizing& s) {
  Table t{.title = fmt::format("What else turns at constant ratio, reduced to {}", s.flywheel),
          .columns = {"component", "inertia [kg·m²]"},
          .rows = {}};
  for (const auto& [name, inertia] : s.other_parts) t.rows.push_back({name, number(inertia)});
  t.rows.push_back({"sum", number(s.motor_inertia + s.gearbox_inertia + s.other_inertia)});
  return t;
}

Table positions_table(const Sizing& s) {
  Table t{.title = "The cycle at 12 positions",
          .columns = {"position", "φ [°]", "M_d [N·m]", "M_c [N·m]", "A_d [J]", "A_c [J]", "ΔT [J]", "I_em [kg·m²]"},
          .rows = {}};
  const double largest = s.diagram.load_torque.largest(), energy = s.diagram.load_work.largest();
  const auto clean = [](double v, double scale) { return number(std::abs(v) < 1e-11 * scale ? 0.0 : v); };
  for (int k = 0; k <= 12; ++k) {
    const double phi = s.diagram.excess.begin() + s.diagram.excess.length() * k / 12;
    t.rows.push_back({std::to_string(k), number(phi * degrees), clean(s.diagram.drive_torque.value(phi), largest),
                      clean(s.diagram.load_torque.value(phi), largest), clean(s.diagram.drive_work.value(phi), energy),
                      clean(s.diagram.load_work.value(phi), energy), clean(s.diagram.excess.value(phi), energy),
                      number(s.cycle.mechanism.value.value(phi))});
  }
  return t;
}

// The next of 1, 2, 2.5, 5, 10 … that is not below.
double round_scale(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 2.5, 5.0, 10.0})
    if (step * decade >= value * (1 - 1e-12)) return step * decade;
  return 10 * decade;
}

// Scales of diagrams on a sheet, per millimetre (theory 3).
Table scales_table(const Sizing& s) {
  const double length = 1e3 * *s.sheet, height = length / 2;
  const double mu_phi = s.diagram.excess.length() / length;
  const double mu_m = round_scale(std::max(s.diagram.load_torque.largest(), s.diagram.drive_torque.largest()) / height);
  const double mu_a = mu_m * mu_phi;
  const double pole =
      round_scale(std::max(s.diagram.load_work.largest(), s.diagram.drive_work.largest()) / height / mu_a);
  Table t{.title = fmt::format("Scales for a sheet of {:g} mm", length),
          .columns = {"scale", "value", "for"},
          .rows = {},
          .text_columns = 3};
  t.rows.push_back({"μ_φ", number(mu_phi) + " rad/mm", "angle axis: one cycle over the sheet"});
  t.rows.push_back({"μ_M", number(mu_m) + " N·m/mm", "M_c, M_d"});
  t.rows.push_back({"μ_A = μ_M μ_φ", number(mu_a) + " J/mm²",
                    "area below the torques; A_c, A_d drawn with a pole distance of 1 mm"});
  t.rows.push_back({"μ_T = μ_A", number(mu_a) + " J/mm", "ΔT with a pole distance of 1 mm"});
  t.rows.push_back({"H μ_A", number(pole * mu_a) + " J/mm",
                    fmt::format("A_c, A_d, ΔT drawn with a pole distance of H = {:g} mm", pole)});
  const double largest = s.cycle.mechanism.value.largest();
  if (largest > 0) t.rows.push_back({"μ_I", number(round_scale(largest / height)) + " kg·m²/mm", "I_em"});
  return t;
}

std::string text_of(const Table& t) {
  std::vector<std::vector<std::string>> rows = {t.columns};
  rows.insert(rows.end(), t.rows.begin(), t.rows.end());
  return t.title + "\n" + aligned(rows, t.text_columns) + "\n";
}

std::string basis_text(const Sizing& s) {
  std::string text = fmt::format("  demanded: δ = {:g} ({}), mean speed {:.6g} rpm of {} ({})\n", s.delta,
                                 s.delta_source, rpm(s.mean_speed), s.link, s.mean_speed_source);
  text += fmt::format("  work of a cycle {}, greatest fluctuation of energy {} between {:.5g}° and {:.5g}°\n",
                      with_unit(s.diagram.work, "J"), with_unit(s.diagram.fluctuation(), "J"),
                      s.diagram.least.x * degrees, s.diagram.most.x * degrees);
  return text + "  " + comparison_with_scene(s) + "\n\n";
}

std::string table_of(const Sizing& s) {
  std::string text = conclusion_of(s) + "\n" + basis_text(s) + text_of(methods_table(s));
  if (!s.reached.empty()) text += text_of(reached_table(s));
  if (s.dimensions) text += text_of(dimensions_table(*s.dimensions));
  if (s.punch)
    text += fmt::format(
        "punch-press form: {} per stroke, working for {:.4g} s of {:.4g} s; the flywheel gives {}, the motor needs "
        "{}\n",
        with_unit(s.punch->energy, "J"), s.punch->working_time, s.punch->cycle_time,
        with_unit(s.punch->from_flywheel(), "J"), with_unit(s.punch->power(), "W"));
  if (s.sheet) text += text_of(scales_table(s));
  if (!s.soft_why.empty()) text += "note: " + s.soft_why + "\n";
  if (!s.dimensions_why.empty()) text += "note: " + s.dimensions_why + "\n";
  for (const std::string& note : s.notes) text += "note: " + note + "\n";
  return text;
}

// --- JSON, CSV ---

Json optional_json(const std::optional<double>& v) { return v ? Json(*v) : Json(); }

Json method_json(const SizeMethod& m) {
  return {{"method", m.name},
          {"drive_inertia", m.drive_inertia},
          {"flywheel", m.flywheel},
          {"flywheel_by_parts", m.flywheel_by_parts},
          {"delta", optional_json(m.delta)}};
}

Json tangent_json(const Tangent& t) {
  return {
      {"slope", t.slope}, {"phi", t.phi}, {"inertia", t.inertia}, {"excess", t.excess}, {"intercept", t.intercept()}};
}

Json dimensions_json(const FlywheelDimensions& d) {
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

std::string json_of(const Sizing& s) {
  Json j;
  j["title"] = s.title;
  j["scene"] = s.scene_file;
  j["conclusion"] = conclusion_of(s);
  j["complete"] = s.complete;
  if (!s.complete) j["diagnosis"] = s.diagnosis;
  j["link"] = s.link;
  j["delta"] = {{"demanded", s.delta}, {"source", s.delta_source}};
  j["mean_speed"] = {{"value", s.mean_speed}, {"unit", "rad/s"}, {"source", s.mean_speed_source}};
  j["flywheel"] = {{"component", s.flywheel},
                   {"added", s.flywheel_added},
                   {"needed", s.needed},
                   {"inertia", exact_method(s).flywheel},
                   {"unit", "kg*m2"},
                   {"in_scene", s.flywheel_now},
                   {"speed_ratio", s.flywheel_ratio},
                   {"delta_in_scene", std::isnan(s.delta_now) ? Json() : Json(s.delta_now)}};
  j["work_diagram"] = {{"work", s.diagram.work},
                       {"mean_torque", s.diagram.mean_torque()},
                       {"fluctuation", s.diagram.fluctuation()},
                       {"phi_most", s.diagram.most.x},
                       {"phi_least", s.diagram.least.x},
                       {"energy_coefficient", s.diagram.energy_coefficient()}};
  j["wittenbauer"] = {
      {"inertia", s.exact.inertia}, {"upper", tangent_json(s.exact.upper)}, {"lower", tangent_json(s.exact.lower)}};
  j["methods"] = Json::array();
  for (const SizeMethod& m : s.methods) j["methods"].push_back(method_json(m));
  if (s.soft) j["methods"].push_back(method_json(*s.soft));
  if (s.punch)
    j["punch_press"] = {{"energy", s.punch->energy},
                        {"cycle_time", s.punch->cycle_time},
                        {"working_time", s.punch->working_time},
                        {"power", s.punch->power()},
                        {"from_flywheel", s.punch->from_flywheel()}};
  j["reached"] = Json::array();
  for (const DeltaReached& r : s.reached)
    j["reached"].push_back({{"model", r.model},
                            {"sized_by", r.sized_by},
                            {"flywheel", r.flywheel},
                            {"delta_crank", r.crank},
                            {"delta_crank_error", optional_json(r.crank_error)},
                            {"delta_motor", r.motor},
                            {"delta_motor_error", optional_json(r.motor_error)},
                            {"mean_speed", r.mean_speed},
                            {"settled", r.settled},
                            {"cycles", r.cycles}});
  if (s.dimensions) j["dimensions"] = dimensions_json(*s.dimensions);
  j["notes"] = s.notes;
  return json_text(j);
}

constexpr int curve_points = 720;

std::string diagrams_csv(const Sizing& s) {
  std::string text = "phi [rad],M_d [N*m],M_c [N*m],A_d [J],A_c [J],dT [J],I_em [kg*m2]\n";
  for (int k = 0; k <= curve_points; ++k) {
    const double phi = s.diagram.excess.begin() + s.diagram.excess.length() * k / curve_points;
    text +=
        fmt::format("{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n", phi, s.diagram.drive_torque.value(phi),
                    s.diagram.load_torque.value(phi), s.diagram.drive_work.value(phi), s.diagram.load_work.value(phi),
                    s.diagram.excess.value(phi), s.cycle.mechanism.value.value(phi));
  }
  return text;
}

// --- report: the classical diagrams ---

// Both sides of every jump are points.
std::vector<double> angles_of(const Piecewise& f) {
  std::vector<double> list;
  for (int k = 0; k <= curve_points; ++k) list.push_back(f.begin() + f.length() * k / curve_points);
  for (const double edge : f.breaks()) {
    list.push_back(std::max(f.begin(), edge - 1e-7));
    list.push_back(std::min(f.end(), edge + 1e-7));
  }
  std::sort(list.begin(), list.end());
  return list;
}

Series curve(const std::string& name, Role role, const Piecewise& f, double factor = 1, bool dashed = false) {
  Series series{.name = name, .role = role, .x = {}, .y = {}, .dashed = dashed};
  for (const double phi : angles_of(f)) {
    series.x.push_back(phi * degrees);
    series.y.push_back(f.value(phi) * factor);
  }
  return series;
}

Series marks(const std::string& name, Role role, std::vector<double> x, std::vector<double> y) {
  return {.name = name, .role = role, .x = std::move(x), .y = std::move(y), .points = true, .line = false};
}

std::vector<Plot> diagrams(const Sizing& s) {
  const WorkDiagram& d = s.diagram;
  const Axis angle{fmt::format("angle of {}", s.link), "°"};
  const ReadableUnit torque = readable_unit(d.load_torque.largest(), "N*m"),
                     energy = readable_unit(d.load_work.largest(), "J"), excess = readable_unit(d.fluctuation(), "J");
  std::vector<Plot> plots;
  plots.push_back({.title = s.engine ? "Driving torque and the load that balances it"
                                     : "Torque of resistance, and the constant driving torque that balances it",
                   .x = angle,
                   .y = {"M", torque.unit},
                   .series = {curve("M_c", Role::orange, d.load_torque, torque.factor),
                              curve("M_d", Role::green, d.drive_torque, torque.factor)},
                   .note = fmt::format("Mean torque {:.6g} N·m at {:.5g} rpm.", d.mean_torque(), rpm(s.mean_speed))});
  plots.push_back({.title = "Work of resistance and of the drive: equal at the end of the cycle",
                   .x = angle,
                   .y = {"A", energy.unit},
                   .series = {curve("A_c", Role::orange, d.load_work, energy.factor),
                              curve("A_d", Role::green, d.drive_work, energy.factor)}});
  Plot change{.title = "Change of kinetic energy ΔT = A_d − A_c",
              .x = angle,
              .y = {"ΔT", excess.unit},
              .series = {curve("ΔT", Role::elastic, d.excess, excess.factor),
                         marks("extremes, where M_d = M_c", Role::vermillion, {d.most.x * degrees, d.least.x * degrees},
                               {d.most.value * excess.factor, d.least.value * excess.factor})},
              .note = fmt::format("Greatest fluctuation {}.", with_unit(d.fluctuation(), "J"))};
  plots.push_back(std::move(change));
  plots.push_back({.title = "Reduced inertia of the executive mechanism",
                   .x = angle,
                   .y = {"I_em", "kg·m²"},
                   .series = {curve("I_em", Role::elastic, s.cycle.mechanism.value)}});
  return plots;
}

Series tangent_line(const std::string& name, Role role, const Tangent& t, double from, double to, double factor) {
  return {.name = name,
          .role = role,
          .x = {from, to},
          .y = {(t.intercept() + t.slope * from) * factor, (t.intercept() + t.slope * to) * factor},
          .dashed = true};
}

// ΔT over I_em with both tangents, their touching points and their intercepts on the axis I_em = 0.
std::vector<Plot> energy_mass_plots(const Sizing& s) {
  const Piecewise &excess = s.diagram.excess, &inertia = s.cycle.mechanism.value;
  const double least = inertia.minimum(s.cycle.mechanism.slope).value,
               most = inertia.maximum(s.cycle.mechanism.slope).value;
  Series closed{.name = "ΔT over I_em", .role = Role::elastic, .x = {}, .y = {}};
  const Tangent &upper = s.exact.upper, &lower = s.exact.lower;
  const ReadableUnit unit = readable_unit(std::max(std::abs(upper.intercept()), std::abs(lower.intercept())), "J");
  for (const double phi : angles_of(excess)) {
    closed.x.push_back(inertia.value(phi));
    closed.y.push_back(excess.value(phi) * unit.factor);
  }
  const double span = std::max(most - least, 1e-3 * std::abs(most));
  const auto plot = [&](const std::string& title, double from, double to, const std::string& note) {
    Plot p{.title = title, .x = {"I_em", "kg·m²"}, .y = {"ΔT", unit.unit}, .series = {closed}, .note = note};
    p.series.push_back(tangent_line("tangent of slope ½ ω_max²", Role::vermillion, upper, from, to, unit.factor));
    p.series.push_back(tangent_line("tangent of slope ½ ω_min²", Role::purple, lower, from, to, unit.factor));
    p.series.push_back(marks("touching points", Role::orange, {upper.inertia, lower.inertia},
                             {upper.excess * unit.factor, lower.excess * unit.factor}));
    return p;
  };
  std::vector<Plot> plots;
  plots.push_back(plot("Energy–mass curve with the tangents of Wittenbauer", least - 0.2 * span, most + 0.2 * span,
                       fmt::format("Touching at φ = {:.6g}° (fastest) and {:.6g}° (slowest).", upper.phi * degrees,
                                   lower.phi * degrees)));
  if (least > 0) {
    plots.push_back(plot("The same to the axis I_em = 0: the intercepts give the inertia", 0, most + 0.05 * most,
                         fmt::format("Intercepts {} and {}; their difference over ½ (ω_max² − ω_min²) is I₀.",
                                     with_unit(upper.intercept(), "J"), with_unit(lower.intercept(), "J"))));
    plots.back().series.push_back(
        marks("intercepts", Role::green, {0, 0}, {upper.intercept() * unit.factor, lower.intercept() * unit.factor}));
  }
  return plots;
}

// Speed over the cycle: at constant torque before and after, with the motor, simulated.
std::optional<Plot> speed_plot(const Sizing& s) {
  const double now = s.methods.front().drive_inertia +
                     (s.flywheel_now - s.methods.front().flywheel) * s.flywheel_ratio * s.flywheel_ratio;
  Plot p{.title = "Speed over the cycle, before and after",
         .x = {fmt::format("angle of {}", s.link), "°"},
         .y = {fmt::format("speed of {}", s.link), "1/min"},
         .series = {}};
  const auto add = [&](const std::string& name, Role role, double inertia, bool dashed) {
    try {
      const SpeedCycle cycle(s.diagram, s.cycle.mechanism, inertia, s.mean_speed);
      Series series{.name = name, .role = role, .x = {}, .y = {}, .dashed = dashed};
      for (const double phi : angles_of(s.diagram.excess)) {
        series.x.push_back(phi * degrees);
        series.y.push_back(rpm(cycle.speed(phi)));
      }
      p.series.push_back(std::move(series));
    } catch (const std::invalid_argument&) {  // it would stop within the cycle
    }
  };
  if (!s.flywheel_added && s.flywheel_now > 0) add("scene as it is, " + basis_of(s), Role::reference, now, true);
  if (s.needed) add("sized, " + basis_of(s), Role::green, s.exact.inertia, true);
  for (const DeltaReached& r : s.reached) {
    if (r.sized_by != "Wittenbauer" || r.model == "rigid, work equation") continue;
    Series series{.name = "sized, " + r.model,
                  .role = r.model.starts_with("rigid") ? Role::rigid : Role::elastic,
                  .x = {},
                  .y = {}};
    for (std::size_t k = 0; k < r.phi.size(); ++k) {
      series.x.push_back(r.phi[k] * degrees);
      series.y.push_back(rpm(r.speed[k]));
    }
    p.series.push_back(std::move(series));
    if (!r.model.starts_with("elastic") || s.motor.empty()) continue;
    Series motor{.name = fmt::format("sized, elastic, {} (reduced)", s.motor),
                 .role = Role::sky,
                 .x = p.series.back().x,
                 .y = {}};
    for (const double v : r.motor_speed) motor.y.push_back(rpm(v));
    p.series.push_back(std::move(motor));
  }
  if (p.series.empty()) return {};
  return p;
}

// --- report: formulas with numbers ---

void add_cycle_formulas(ReportSection& section, const Sizing& s) {
  const WorkDiagram& d = s.diagram;
  const double cycle = d.excess.length();
  section.cards.push_back(
      Formula{.title = "Driving torque from the balance of work (theory 2.3)",
              .symbols = s.engine ? "∫ M_d dφ = ∫ M_c dφ" : "M_d = (1/Φ) ∫ M_c dφ",
              .numbers = fmt::format("M_d = {:.6g} J / {:.6g} rad = {:.6g} N·m", d.work, cycle, d.mean_torque())});
  section.cards.push_back(Formula{
      .title = "Greatest fluctuation of energy (theory 3.4)",
      .symbols = "ΔA_max = max ΔT − min ΔT",
      .numbers = fmt::format("ΔA_max = {:.6g} J − ({:.6g} J) = {:.6g} J", d.most.value, d.least.value, d.fluctuation()),
      .note = fmt::format("At φ = {:.6g}° and {:.6g}°.", d.most.x * degrees, d.least.x * degrees)});
  const double fastest = s.mean_speed * (1 + s.delta / 2), slowest = s.mean_speed * (1 - s.delta / 2);
  section.cards.push_back(Formula{.title = "Limits of the speed (theory 2.6)",
                                  .symbols = "ω_max, ω_min = ω_mean (1 ± δ/2)",
                                  .numbers = fmt::format("{:.6g} rad/s · (1 ± {:g}/2) = {:.6g} and {:.6g} rad/s",
                                                         s.mean_speed, s.delta, fastest, slowest)});
}

void add_method_formulas(ReportSection& section, const Sizing& s) {
  const Tangent &u = s.exact.upper, &l = s.exact.lower;
  section.cards.push_back(
      Formula{.title = "Wittenbauer (theory 3.2)",
              .symbols = "I₀ = [max(ΔT − a I_em) − min(ΔT − b I_em)] / (a − b),   a = ½ ω_max²,  b = ½ ω_min²",
              .numbers = fmt::format("I₀ = [{:.7g} − ({:.7g})] J / ({:.7g} − {:.7g}) s⁻² = {:.7g} kg·m²", u.intercept(),
                                     l.intercept(), u.slope, l.slope, s.exact.inertia),
              .note = "Exact for torques of the angle alone."});
  section.cards.push_back(Formula{
      .title = "Mertsalov (theory 3.3)",
      .symbols = "I₀ = (max ΔT₁ − min ΔT₁)/(ω_mean² δ),   ΔT₁ = ΔT − ½ ω_mean² I_em",
      .numbers =
          fmt::format("I₀ = [{:.7g} − ({:.7g})] J / ({:.6g}² · {:g}) s⁻² = {:.7g} kg·m²", s.approximate.most.value,
                      s.approximate.least.value, s.mean_speed, s.delta, s.approximate.inertia),
      .note = fmt::format("{:+.3g} % against the exact value.", 100 * (s.approximate.inertia / s.exact.inertia - 1))});
  const SizeMethod& neglecting = s.methods[2];
  section.cards.push_back(Formula{
      .title = "Neglecting I_em (theory 3.4)",
      .symbols = "I₀ = ΔA_max/(ω_mean² δ)",
      .numbers = fmt::format("I₀ = {:.6g} J / ({:.6g}² · {:g}) s⁻² = {:.7g} kg·m²", s.diagram.fluctuation(),
                             s.mean_speed, s.delta, neglecting.drive_inertia),
      .note =
          fmt::format("{:+.3g} % against the exact value.", 100 * (neglecting.drive_inertia / s.exact.inertia - 1))});
}

void add_flywheel_formulas(ReportSection& section, const Sizing& s) {
  const SizeMethod& exact = exact_method(s);
  const double on_shaft = exact.drive_inertia / (s.flywheel_ratio * s.flywheel_ratio);
  if (s.flywheel_ratio != 1)
    section.cards.push_back(Formula{.title = fmt::format("On the shaft of {}", s.flywheel),
                                    .symbols = "I_drive = I₀ / i²",
                                    .numbers = fmt::format("I_drive = {:.7g} / {:.6g}² = {:.7g} kg·m²",
                                                           exact.drive_inertia, s.flywheel_ratio, on_shaft)});
  section.cards.push_back(
      Formula{.title = "Flywheel with the scene's own inertias",
              .symbols = "I_fly = I_drive − I_motor − I_gearbox − I_others",
              .numbers = fmt::format("I_fly = {:.7g} − {:.6g} − {:.6g} − {:.6g} = {:.7g} kg·m²", on_shaft,
                                     s.motor_inertia, s.gearbox_inertia, s.other_inertia, exact.flywheel)});
  section.cards.push_back(
      Formula{.title = "The same by the customary allowance for couplings (theory 3.1)",
              .symbols = "I_fly = I_drive − 1.1 I_motor − I_gearbox",
              .numbers = fmt::format("I_fly = {:.7g} − 1.1 · {:.6g} − {:.6g} = {:.7g} kg·m²", on_shaft, s.motor_inertia,
                                     s.gearbox_inertia, exact.flywheel_by_parts)});
  if (s.punch)
    section.cards.push_back(Formula{
        .title = "Punch-press form (theory 3.5)",
        .symbols = "ΔE = E (1 − t_w/t_c),   I₀ = ΔE/(ω_mean² δ),   P = E/t_c",
        .numbers = fmt::format("ΔE = {:.6g} J · (1 − {:.4g}/{:.4g}) = {:.6g} J,   I₀ = {:.7g} kg·m²,   P = {:.6g} W",
                               s.punch->energy, s.punch->working_time, s.punch->cycle_time, s.punch->from_flywheel(),
                               s.methods.back().drive_inertia, s.punch->power()),
        .note = "Useful work and the time in which it is done, at the mean speed."});
}

void add_dimension_formulas(ReportSection& section, const FlywheelDimensions& d, double fastest) {
  section.cards.push_back(
      Formula{.title = "Rim speed",
              .symbols = "v = ω_max D/2",
              .numbers = fmt::format("v = {:.5g} rad/s · {:.5g} m / 2 = {:.5g} m/s", fastest, d.diameter, d.rim_speed),
              .note = fmt::format("Limit {:.4g} m/s{}.", d.rim_speed_limit, d.within_limit ? "" : ": exceeded")});
  if (d.form == FlywheelForm::disc) {
    section.cards.push_back(
        Formula{.title = "Mass of the disc",
                .symbols = "m = 8 I/D²",
                .numbers = fmt::format("m = 8 · {:.6g} / {:.5g}² = {:.6g} kg", d.inertia, d.diameter, d.mass)});
    section.cards.push_back(
        Formula{.title = "Stress at the centre (theory 3.7)",
                .symbols = "σ = (3 + ν)/8 · ρ v²",
                .numbers = fmt::format("σ = (3 + {:g})/8 · {:g} kg/m³ · ({:.5g} m/s)² = {:.4g} MPa", d.material.poisson,
                                       d.material.density, d.rim_speed, d.stress / 1e6)});
  } else {
    const double radius = 0.5 * (d.diameter - d.thickness);
    section.cards.push_back(Formula{
        .title = "Inertia of the rim",
        .symbols = "I_rim = (π/32) ρ b (D⁴ − (D − 2h)⁴)",
        .numbers =
            fmt::format("I_rim = (π/32) · {:g} · {:.5g} · ({:.5g}⁴ − {:.5g}⁴) = {:.6g} kg·m²", d.material.density,
                        d.breadth, d.diameter, d.diameter - 2 * d.thickness, d.rim_share * d.inertia),
        .note = fmt::format("{:.3g} % of the whole; spokes and hub bring the rest.", 100 * d.rim_share)});
    section.cards.push_back(
        Formula{.title = "Stress of the rim, with bending between the spokes (theory 3.7)",
                .symbols = "σ = ρ v_m² (0.75 + 4.935 R_m/(n² h))",
                .numbers = fmt::format("σ = {:.4g} MPa · (0.75 + 4.935 · {:.5g}/({}² · {:.5g})) = {:.4g} MPa",
                                       d.stress / 1e6, radius, flywheel_spokes, d.thickness, d.spoked_stress / 1e6),
                .note = "Khurmi and Gupta, A Textbook of Machine Design (22.3): ¾ of a free ring's tension, ¼ of "
                        "clamped bending."});
  }
  section.cards.push_back(Formula{
      .title = "Energy stored",
      .symbols = "T = ½ I ω_max²",
      .numbers = fmt::format("T = ½ · {:.6g} · {:.5g}² = {}", d.inertia, fastest, with_unit(d.energy, "J", 5))});
}

void add_motor_section(Report& report, const Sizing& s) {
  if (!s.operating && s.reached.empty()) return;
  ReportSection& section = report.add("With the torques as they are over the speed, rigid and elastic");
  if (s.with_motor && s.with_motor->found)
    section.cards.push_back(Formula{
        .title = s.operating->drive_slope < 0 ? "The drive gives way: its torque rises as the speed falls"
                                              : "The drive does not give way: what holds the speed is the load",
        .symbols = "d(½ I ω²)/dφ = M_d(ω) − M_c(φ, ω),   ω(Φ) = ω(0)",
        .numbers = fmt::format("δ = ({:.6g} − {:.6g})/{:.6g} = {:.6g} instead of {:g}", s.with_motor->fastest.value,
                               s.with_motor->slowest.value, s.with_motor->mean_speed(), s.with_motor->delta(), s.delta),
        .note = fmt::format(
            "Slope of the torques at the operating speed {:.5g} N·m·s/rad; a disturbance of the energy {} to "
            "{:.3g} of itself within a cycle.",
            s.operating->slope, s.with_motor->multiplier < 1 ? "shrinks" : "grows", s.with_motor->multiplier)});
  if (s.soft)
    section.cards.push_back(Formula{
        .title = "Inertia that gives δ with these torques",
        .symbols = "δ(I₀) = δ",
        .numbers = fmt::format("I₀ = {:.7g} kg·m², flywheel {:.7g} kg·m², {:.4g} % {} than without their slope",
                               s.soft->drive_inertia, s.soft->flywheel,
                               std::abs(100 * (1 - s.soft->flywheel / exact_method(s).flywheel)),
                               s.soft->flywheel <= exact_method(s).flywheel ? "less" : "more"),
        .note =
            s.soft_cycle && s.soft_cycle->found
                ? fmt::format("Its mean speed (ω_max + ω_min)/2 is then {:.6g} rpm.", rpm(s.soft_cycle->mean_speed()))
                : ""});
  if (auto plot = speed_plot(s)) section.cards.push_back(std::move(*plot));
  if (!s.reached.empty()) section.cards.push_back(reached_table(s));
}

Report report_of(const Sizing& s) {
  Report report{.title = s.title,
                .subtitle = fmt::format("Flywheel for δ = {:g}", s.delta),
                .conclusion = conclusion_of(s),
                .complete = s.complete};
  report.figures = {{"flywheel", exact_method(s).flywheel, "kg*m2", {}, "Wittenbauer, exact " + basis_of(s)}};
  if (s.soft) report.figures.push_back({"flywheel with " + slope_of_what(s), s.soft->flywheel, "kg*m2", {}, ""});
  for (const DeltaReached& r : s.reached)
    if (r.sized_by == "Wittenbauer" && r.model != "rigid, work equation") {
      report.figures.push_back(
          {"δ at the crank, " + r.model, r.crank, "", r.crank_error, r.settled ? "" : "last cycle, not settled"});
      if (r.model.starts_with("elastic") && !s.motor.empty())
        report.figures.push_back(
            {"δ at the motor, " + r.model, r.motor, "", r.motor_error, r.settled ? "" : "last cycle, not settled"});
    }
  report.figures.push_back({"fluctuation of energy", s.diagram.fluctuation(), "J", {}, ""});
  if (s.dimensions) report.figures.push_back({"mass", s.dimensions->mass, "kg", {}, s.dimensions->material.name});

  ReportSection& cycle = report.add("One cycle");
  for (Plot& plot : diagrams(s)) cycle.cards.push_back(std::move(plot));
  add_cycle_formulas(cycle, s);
  cycle.cards.push_back(positions_table(s));
  ReportSection& synthesis = report.add("Inertia for the demanded δ");
  for (Plot& plot : energy_mass_plots(s)) synthesis.cards.push_back(std::move(plot));
  add_method_formulas(synthesis, s);
  add_flywheel_formulas(synthesis, s);
  synthesis.cards.push_back(methods_table(s));
  synthesis.cards.push_back(inertias_table(s));
  synthesis.cards.push_back(Text{.title = "Against the scene", .body = comparison_with_scene(s)});
  add_motor_section(report, s);
  if (s.dimensions) {
    ReportSection& body = report.add("Dimensions");
    body.cards.push_back(dimensions_table(*s.dimensions));
    add_dimension_formulas(body, *s.dimensions, 2 * s.dimensions->rim_speed / s.dimensions->diameter);
  }
  if (s.sheet) report.add("Scales of the diagrams").cards.push_back(scales_table(s));
  std::string notes = s.soft_why.empty() ? "" : s.soft_why + "\n";
  if (!s.dimensions_why.empty()) notes += s.dimensions_why + "\n";
  for (const std::string& note : s.notes) notes += note + "\n";
  if (!notes.empty()) report.add("Notes").cards.push_back(Text{.title = "", .body = notes});
  return report;
}

}  // namespace

StudyOutput output_of(const Sizing& s) {
  StudyOutput output{
      .conclusion = conclusion_of(s), .table = table_of(s), .json = json_of(s), .report = [s] { return report_of(s); }};
  output.csv = {{"diagrams.csv", [s] { return diagrams_csv(s); }}};
  output.complete = s.complete;
  output.diagnosis = s.diagnosis;
  return output;
}

}  // namespace kurbel
