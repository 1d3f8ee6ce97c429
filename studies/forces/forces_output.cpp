// forces_output.cpp — words, tables and plots of the forces of a slider-crank.
#include "studies/forces/forces_output.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/findings/json_text.h"
#include "studies/findings/text_table.h"
#include "studies/run/run_report.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr double turn = 2 * std::numbers::pi;
double degrees(double angle) { return angle * 360 / turn; }
std::string number(double value, int digits = 6) { return fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits); }
// "12.3 kN": in the unit that reads easily.
std::string in_words(const Peak& p, const std::string& si_unit) {
  const ReadableUnit unit = readable_unit(p.value, si_unit);
  return fmt::format("{:.5g} {}", unit.factor * p.value, unit.unit);
}
bool is_nothing(const Peak& p) { return std::abs(p.value) <= p.error.value_or(0); }
std::string at_angle(const Peak& p) { return fmt::format("{:.1f}°", degrees(p.phi)); }

std::vector<const ForceCycle*> problems_of(const Forces& f) {
  std::vector<const ForceCycle*> problems;
  if (f.prescribed) problems.push_back(&*f.prescribed);
  if (f.simulated) problems.push_back(&*f.simulated);
  return problems;
}

// The simulated motion where there is one: it is the machine's own.
const ForceCycle& front_of(const Forces& f) { return f.simulated ? *f.simulated : *f.prescribed; }
Role role_of(const ForceCycle& c) { return c.label == "simulated" ? Role::elastic : Role::rigid; }

// --- figures ---

struct NamedPeak {
  std::string name, unit;  // as in JSON
  const Peak* peak;
};

std::vector<NamedPeak> peaks_of(const ForceCycle& c) {
  std::vector<NamedPeak> peaks;
  for (std::size_t k = 0; k < joint_count; ++k)
    peaks.push_back({fmt::format("reaction of the {}", name_of(static_cast<Joint>(k))), "N", &c.reaction[k]});
  peaks.push_back({"balancing torque", "N*m", &c.torque});
  peaks.push_back({"shaking force", "N", &c.shaking_force});
  peaks.push_back({"shaking moment", "N*m", &c.shaking_moment});
  return peaks;
}

bool has_friction(const Forces& f) { return !f.joints.frictionless(); }

std::string conclusion_of(const Forces& f) {
  const ForceCycle& c = front_of(f);
  const Peak& bearing = c.reaction[0];
  std::string text = fmt::format(
      "{} at {}: the main bearing carries up to {} (at {}), {}, the shaking force peaks at {}", f.mechanism,
      with_unit(c.mean_speed * 60 / turn, "rpm", 4), in_words(bearing, "N"), at_angle(bearing),
      is_nothing(c.torque)
          ? std::string("no balancing torque is needed")
          : fmt::format("the balancing torque peaks at {} (at {})", in_words(c.torque, "N*m"), at_angle(c.torque)),
      in_words(c.shaking_force, "N"));
  if (has_friction(f))
    text += c.efficiency ? fmt::format("; efficiency of the cycle {:.4g} %{}", 100 * *c.efficiency,
                                       c.harmful > 0 ? fmt::format(", {} of {} lost", with_unit(c.harmful, "J", 4),
                                                                   with_unit(c.spent, "J", 4))
                                                     : "")
                         : fmt::format("; no efficiency of the cycle: {}", c.no_efficiency);
  return text + ".";
}

// --- terminal ---

Rows figure_rows(const Forces& f) {
  Rows rows = {{"largest"}};
  for (const ForceCycle* c : problems_of(f)) {
    rows[0].push_back(c->label);
    rows[0].push_back("at");
  }
  rows[0].push_back("unit");
  const std::size_t count = peaks_of(*f.prescribed).size();
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::string> row;
    for (const ForceCycle* c : problems_of(f)) {
      const NamedPeak p = peaks_of(*c)[i];
      if (row.empty()) row.push_back(p.name);
      row.push_back(with_error(p.peak->value, p.peak->error, ""));
      row.push_back(at_angle(*p.peak));
    }
    row.push_back(pretty_unit(peaks_of(*f.prescribed)[i].unit));
    rows.push_back(row);
  }
  return rows;
}

// Rounding errors beside large forces read as zero.
std::string beside(double value, double largest) {
  return number(std::abs(value) < 1e-12 * std::abs(largest) ? 0.0 : value);
}

Rows position_rows(const ForceCycle& c) {
  Rows rows = {{"φ [°]", "ω [rad/s]", "M [N·m]", "R main [N]", "R crank pin [N]", "R slider pin [N]", "N guide [N]",
                "at [mm]", "shaking [N]", "η"}};
  for (const CyclePosition& p : c.rows) {
    const SliderCrankForces& s = p.forces;
    rows.push_back({number(degrees(p.state.phi), 5), number(p.state.omega), beside(s.torque, c.torque.value),
                    number(s.main_bearing.magnitude()), number(s.crank_pin.magnitude()),
                    number(s.slider_pin.magnitude()), beside(s.guide, c.reaction[3].value),
                    std::isfinite(s.guide_point) ? number(1e3 * s.guide_point, 4) : std::string("—"),
                    number(s.shaking_force.magnitude()),
                    p.power.efficiency() ? fmt::format("{:.4f}", *p.power.efficiency()) : std::string("—")});
  }
  return rows;
}

Rows work_rows(const Forces& f) {
  Rows rows = {{"work of a cycle", "line"}};
  for (const ForceCycle* c : problems_of(f)) rows[0].push_back(c->label);
  rows[0].push_back("unit");
  for (std::size_t i = 0; i < f.prescribed->work.size(); ++i) {
    const CycleWork& w = f.prescribed->work[i];
    std::vector<std::string> row = {w.name, front_of(f).work[i].kind};
    bool any = false;
    for (const ForceCycle* c : problems_of(f)) {
      row.push_back(number(c->work[i].work));
      any = any || c->work[i].work != 0;
    }
    row.push_back("J");
    if (any) rows.push_back(row);
  }
  return rows;
}

Rows counterweight_rows(const Forces& f) {
  Rows rows = {{"counterweight", "m·r [kg·m]", "share of reciprocating", "peak of shaking force [N]",
                "order 1 along [N]", "order 1 across [N]", "peak of main bearing [N]"}};
  for (const Counterweight& c : f.counterweights)
    rows.push_back({c.name, number(c.moment, 5), number(c.reciprocating_share, 3), number(c.peak_force),
                    number(c.first_x), number(c.first_y), number(c.peak_bearing)});
  return rows;
}

Rows harmonic_rows(const ForceCycle& c) {
  Rows rows = {{"order", "along [N]", "across [N]", "moment [N·m]", "balancing torque [N·m]"}};
  for (std::size_t k = 0; k < c.shaking_x.size(); ++k)
    rows.push_back({std::to_string(c.shaking_x[k].order), number(c.shaking_x[k].amplitude),
                    number(c.shaking_y[k].amplitude), number(c.shaking_couple[k].amplitude),
                    number(c.torque_orders[k].amplitude)});
  return rows;
}

std::string checks_of(const ForceCycle& c) {
  std::string text =
      fmt::format("power balance closes to {:.1e} of the largest power at every position", c.power_residual);
  if (c.most_iterations > 0)
    text += fmt::format("; friction laws hold to {:.1e}, at most {} Newton steps a position", c.friction_residual,
                        c.most_iterations);
  if (c.both_edges > 0)
    text += fmt::format("; the slider bears on both edges at {} of {} positions", c.both_edges, c.positions.size());
  return text;
}

std::string table_of(const Forces& f, const std::string& conclusion) {
  std::string text = conclusion + "\n\n" + aligned(figure_rows(f), 1) + "\n";
  for (const ForceCycle* c : problems_of(f)) {
    text += fmt::format("{}: {}\n", c->label, c->description);
    text += aligned(position_rows(*c), 0);
    text += fmt::format("  {}\n\n", checks_of(*c));
  }
  text += aligned(work_rows(f), 2) + "\n";
  text += fmt::format("harmonics, {} motion\n", front_of(f).label) + aligned(harmonic_rows(front_of(f)), 1) + "\n";
  text += "counterweights opposite to the crank pin, beyond what the crank has (at constant speed)\n" +
          aligned(counterweight_rows(f), 1);
  for (const std::string& note : f.notes) text += "  note: " + note + "\n";
  if (!f.complete) text += "  INCOMPLETE: " + f.diagnosis + "\n";
  return text;
}

// --- JSON and CSV ---

Json force_json(Force2 force) {
  return {{"x", force.x}, {"y", force.y}, {"magnitude", force.magnitude()}, {"direction", force.direction()}};
}
Json optional_json(const std::optional<double>& v) { return v ? Json(*v) : Json(); }
Json finite_json(double v) { return std::isfinite(v) ? Json(v) : Json(); }

Json position_json(const CyclePosition& p) {
  const SliderCrankForces& s = p.forces;
  Json j = {{"phi", p.state.phi},
            {"omega", p.state.omega},
            {"alpha", p.state.alpha},
            {"position", p.position},
            {"velocity", p.velocity},
            {"slider_force", p.state.slider_force},
            {"torque", s.torque},
            {"main_bearing", force_json(s.main_bearing)},
            {"crank_pin", force_json(s.crank_pin)},
            {"slider_pin", force_json(s.slider_pin)},
            {"guide",
             {{"normal", s.guide},
              {"point", finite_json(s.guide_point)},
              {"moment", s.guide_moment},
              {"friction", s.guide_friction},
              {"both_edges", s.both_edges},
              {"edge_front", s.edge_front},
              {"edge_back", s.edge_back}}},
            {"inertia",
             {{"crank", force_json(s.crank_inertia)},
              {"rod", force_json(s.rod_inertia)},
              {"slider", force_json(s.slider_inertia)},
              {"crank_couple", s.crank_couple},
              {"rod_couple", s.rod_couple}}},
            {"shaking_force", force_json(s.shaking_force)},
            {"shaking_moment", s.shaking_moment},
            {"efficiency", optional_json(p.power.efficiency())},
            {"friction_power", s.friction_power},
            {"friction_residual", s.residual},
            {"power_residual", p.power.residual}};
  return j;
}

Json orders_json(const std::vector<ForceHarmonic>& orders) {
  Json list = Json::array();
  for (const ForceHarmonic& h : orders)
    list.push_back({{"order", h.order}, {"amplitude", h.amplitude}, {"phase", h.phase}});
  return list;
}

Json cycle_json(const ForceCycle& c) {
  Json j = {{"description", c.description},       {"cycle", c.cycle},
            {"mean_speed", c.mean_speed},         {"least_speed", c.least_speed},
            {"greatest_speed", c.greatest_speed}, {"closure", c.closure}};
  j["peaks"] = Json::array();
  for (const NamedPeak& p : peaks_of(c))
    j["peaks"].push_back({{"name", p.name},
                          {"value", p.peak->value},
                          {"unit", p.unit},
                          {"error", optional_json(p.peak->error)},
                          {"phi", p.peak->phi}});
  j["work"] = Json::array();
  for (const CycleWork& w : c.work) {
    j["work"].push_back({{"name", w.name}, {"line", w.kind}, {"work", w.work}});
    if (w.error > 0) j["work"].back()["error"] = w.error;
  }
  j["efficiency"] = optional_json(c.efficiency);
  if (!c.efficiency) j["no_efficiency"] = c.no_efficiency;
  j["work_in"] = c.input;
  j["work_useful"] = c.useful;
  j["work_harmful"] = c.harmful;
  j["kinetic_change"] = c.kinetic_change;
  j["power_residual"] = c.power_residual;
  j["friction_residual"] = c.friction_residual;
  j["positions_on_both_edges"] = c.both_edges;
  j["harmonics"] = {{"shaking_force_along", orders_json(c.shaking_x)},
                    {"shaking_force_across", orders_json(c.shaking_y)},
                    {"shaking_moment", orders_json(c.shaking_couple)},
                    {"balancing_torque", orders_json(c.torque_orders)},
                    {"balancing_torque_mean", c.torque_mean}};
  j["positions"] = Json::array();
  for (const CyclePosition& p : c.rows) j["positions"].push_back(position_json(p));
  return j;
}

std::string json_of(const Forces& f, const std::string& conclusion) {
  Json j;
  j["title"] = f.title;
  j["scene"] = f.scene_file;
  j["complete"] = f.complete;
  if (!f.complete) j["diagnosis"] = f.diagnosis;
  j["mechanism"] = f.mechanism;
  j["conclusion"] = conclusion;
  for (const ForceCycle* c : problems_of(f)) j[c->label] = cycle_json(*c);
  j["rotating_moment"] = f.rotating_moment;
  j["reciprocating_mass"] = f.reciprocating_mass;
  j["counterweights"] = Json::array();
  for (const Counterweight& c : f.counterweights)
    j["counterweights"].push_back({{"name", c.name},
                                   {"moment", c.moment},
                                   {"reciprocating_share", c.reciprocating_share},
                                   {"peak_shaking_force", c.peak_force},
                                   {"first_order_along", c.first_x},
                                   {"first_order_across", c.first_y},
                                   {"peak_main_bearing", c.peak_bearing}});
  j["notes"] = f.notes;
  return json_text(j);
}

std::string csv_of(const ForceCycle& c) {
  std::string text =
      "phi [rad],omega [rad/s],alpha [rad/s2],position [m],velocity [m/s],slider_force [N],torque [N*m],"
      "main_x [N],main_y [N],crank_pin_x [N],crank_pin_y [N],slider_pin_x [N],slider_pin_y [N],guide [N],"
      "guide_point [m],guide_friction [N],both_edges,shaking_x [N],shaking_y [N],shaking_moment [N*m],"
      "friction_main [W],friction_crank_pin [W],friction_slider_pin [W],friction_guide [W],efficiency,power_residual\n";
  for (const CyclePosition& p : c.positions) {
    const SliderCrankForces& s = p.forces;
    for (const double v :
         {p.state.phi, p.state.omega, p.state.alpha, p.position, p.velocity, p.state.slider_force, s.torque,
          s.main_bearing.x, s.main_bearing.y, s.crank_pin.x, s.crank_pin.y, s.slider_pin.x, s.slider_pin.y, s.guide})
      text += fmt::format("{:.12g},", v);
    text += std::isfinite(s.guide_point) ? fmt::format("{:.12g},", s.guide_point) : std::string(",");
    text += fmt::format("{:.12g},{:d},{:.12g},{:.12g},{:.12g},", s.guide_friction, s.both_edges, s.shaking_force.x,
                        s.shaking_force.y, s.shaking_moment);
    for (const double power : s.friction_power) text += fmt::format("{:.12g},", power);
    text += p.power.efficiency() ? fmt::format("{:.12g},", *p.power.efficiency()) : std::string(",");
    text += fmt::format("{:.3g}\n", p.power.residual);
  }
  return text;
}

// --- report ---

// A curve over the crank's angle in readable units.
class AnglePlot {
 public:
  AnglePlot(std::string title, std::string quantity, std::string unit) : unit_(std::move(unit)) {
    plot_.title = std::move(title);
    plot_.x = {"crank angle", "°"};
    plot_.y = {std::move(quantity), ""};
  }
  template <class F>
  AnglePlot& add(const std::string& name, Role role, const ForceCycle& c, F&& value, bool dashed = false) {
    Series s{.name = name, .role = role, .x = {}, .y = {}, .dashed = dashed};
    for (const CyclePosition& p : c.curve) {
      const double v = value(p);
      if (!std::isfinite(v)) continue;
      s.x.push_back(degrees(p.state.phi));
      s.y.push_back(v);
      largest_ = std::max(largest_, std::abs(v));
    }
    plot_.series.push_back(std::move(s));
    return *this;
  }
  AnglePlot& note(std::string text) {
    plot_.note = std::move(text);
    return *this;
  }
  Plot made() {
    const ReadableUnit unit = unit_.empty() ? ReadableUnit{} : readable_unit(largest_, unit_);
    plot_.y.unit = unit.unit;
    for (Series& s : plot_.series)
      for (double& v : s.y) v *= unit.factor;
    return plot_;
  }

 private:
  Plot plot_;
  std::string unit_;
  double largest_ = 0;
};

// Locus of a force's tip over the cycle.
template <class F>
Plot locus(const std::string& title, const std::string& x, const std::string& y, const Forces& f, F&& force) {
  Plot plot{.title = title, .x = {x, ""}, .y = {y, ""}, .series = {}};
  plot.equal_axes = true;
  double largest = 0;
  for (const ForceCycle* c : problems_of(f)) {
    Series s{.name = c->label, .role = role_of(*c), .x = {}, .y = {}};
    for (const CyclePosition& p : c->curve) {
      const Force2 v = force(p);
      s.x.push_back(v.x);
      s.y.push_back(v.y);
      largest = std::max(largest, v.magnitude());
    }
    plot.series.push_back(std::move(s));
  }
  const ReadableUnit unit = readable_unit(largest, "N");
  plot.x.unit = plot.y.unit = unit.unit;
  for (Series& s : plot.series) {
    for (double& v : s.x) v *= unit.factor;
    for (double& v : s.y) v *= unit.factor;
  }
  return plot;
}

template <class F>
Plot both(const Forces& f, const std::string& title, const std::string& quantity, const std::string& unit, F&& value) {
  AnglePlot plot(title, quantity, unit);
  for (const ForceCycle* c : problems_of(f)) plot.add(c->label, role_of(*c), *c, value);
  return plot.made();
}

Table table_card(const std::string& title, Rows rows, std::size_t text_columns, bool folded = false) {
  Table table{.title = title, .columns = rows.front(), .rows = {}, .folded = folded, .text_columns = text_columns};
  table.rows.assign(rows.begin() + 1, rows.end());
  return table;
}

void add_torque(Report& report, const Forces& f) {
  ReportSection& section = report.add("Balancing torque");
  section.cards.push_back(both(f, "Torque that the shaft must give the crank", "balancing torque M", "N*m",
                               [](const CyclePosition& p) { return p.forces.torque; }));
  // With the numbers of the peak.
  const ForceCycle& c = front_of(f);
  const CyclePosition* const peak = &c.at_torque_peak;
  const SliderCrankGeometry g(f.data);
  const auto inertia = g.inertia(peak->state.phi);
  const double w = peak->state.omega, slope = g.slider(peak->state.phi).slope,
               weight = g.gravity_torque(peak->state.phi).value, loss = w != 0 ? peak->power.friction / w : 0;
  section.cards.push_back(Formula{
      .title = fmt::format("At its peak, φ = {:.4g}° (theory 9.7)", degrees(peak->state.phi)),
      .symbols = "M = I_r ε + ½ I_r′ ω² − M_g − F x′ + P_f/ω",
      .numbers =
          fmt::format("M = {:.5g} · ({:.5g}) + ½ · ({:.5g}) · ({:.5g})² − ({:.5g}) − ({:.5g}) · ({:.5g}) + ({:.5g}) "
                      "= {:.6g} N·m",
                      inertia.value, peak->state.alpha, inertia.slope, w, weight, peak->state.slider_force, slope, loss,
                      peak->forces.torque),
      .note = "I_r reduced inertia, M_g torque of the weights, F force on the slider, P_f power lost in the joints; "
              "SI units. Reactions come from the equilibrium of each link, this formula from energy: they agree to the "
              "power balance below."});
}

void add_reactions(Report& report, const Forces& f) {
  ReportSection& section = report.add("Reactions in the joints (theory 9.6)");
  section.cards.push_back(both(f, "Load of the main bearing", "reaction", "N",
                               [](const CyclePosition& p) { return p.forces.main_bearing.magnitude(); }));
  section.cards.push_back(both(f, "Load of the crank pin", "reaction", "N",
                               [](const CyclePosition& p) { return p.forces.crank_pin.magnitude(); }));
  section.cards.push_back(both(f, "Load of the slider pin", "reaction", "N",
                               [](const CyclePosition& p) { return p.forces.slider_pin.magnitude(); }));
  section.cards.push_back(both(f, "Reaction of the guide, positive 90° ahead of the stroke", "normal reaction N", "N",
                               [](const CyclePosition& p) { return p.forces.guide; }));
  AnglePlot point("Where the guide's reaction acts, from the slider pin towards the extended end", "point of action",
                  "m");
  for (const ForceCycle* c : problems_of(f))
    point.add(c->label, role_of(*c), *c, [&](const CyclePosition& p) {
      // Where N passes through zero the point runs away to infinity: left out beyond three guides.
      const double reach = 3 * std::max({f.joints.guide.length, f.joints.guide.width, f.data.radius});
      return std::abs(p.forces.guide_point) < reach ? p.forces.guide_point : std::nan("");
    });
  if (f.joints.guide.length > 0)
    for (const int side : {1, -1})
      point.add(
          side > 0 ? "ends of the guide" : "", Role::reference, front_of(f),
          [&](const CyclePosition&) { return f.joints.guide.middle + side * 0.5 * f.joints.guide.length; }, true);
  section.cards.push_back(point.note("Beyond the guide's ends both edges bear.").made());
}

void add_polar(Report& report, const Forces& f) {
  ReportSection& section = report.add("Polar diagrams of the bearings' loads");
  section.cards.push_back(Text{
      .title = "",
      .body =
          "Tips of the load over a cycle. In the frame it shows where shell and housing are pressed; turning with the "
          "pin, where the pin is: that is where an oil hole must not be."});
  section.cards.push_back(locus("Main bearing: crank on frame, in the frame", "along the stroke", "across", f,
                                [](const CyclePosition& p) { return -1.0 * p.forces.main_bearing; }));
  section.cards.push_back(locus("Main journal: frame on crank, turning with the crank", "towards the crank pin",
                                "ahead of it", f,
                                [](const CyclePosition& p) { return p.forces.main_bearing.seen_from(p.state.phi); }));
  section.cards.push_back(locus("Crank pin: rod on pin, in the frame", "along the stroke", "across", f,
                                [](const CyclePosition& p) { return -1.0 * p.forces.crank_pin; }));
  section.cards.push_back(
      locus("Crank pin: rod on pin, turning with the crank", "outwards", "ahead", f,
            [](const CyclePosition& p) { return (-1.0 * p.forces.crank_pin).seen_from(p.state.phi); }));
  section.cards.push_back(locus("Rod's big end: pin on rod, swinging with the rod", "along the rod", "across", f,
                                [](const CyclePosition& p) { return p.forces.crank_pin.seen_from(p.rod_angle); }));
  section.cards.push_back(
      locus("Slider pin: slider on rod, swinging with the rod", "along the rod", "across", f,
            [](const CyclePosition& p) { return (-1.0 * p.forces.slider_pin).seen_from(p.rod_angle); }));
  section.cards.push_back(locus("Slider pin: rod on slider, in the frame", "along the stroke", "across", f,
                                [](const CyclePosition& p) { return p.forces.slider_pin; }));
}

Plot harmonic_plot(const ForceCycle& c) {
  Plot plot{.title = fmt::format("Orders of the shaking force, {} motion", c.label),
            .x = {"order of the crank's turn", ""},
            .y = {"amplitude", "N"},
            .series = {}};
  plot.bars = true;
  const auto add = [&](const char* name, Role role, const std::vector<ForceHarmonic>& orders) {
    Series s{.name = name, .role = role, .x = {}, .y = {}};
    for (const ForceHarmonic& h : orders) {
      s.x.push_back(h.order);
      s.y.push_back(h.amplitude);
    }
    plot.series.push_back(std::move(s));
  };
  add("along the stroke", Role::elastic, c.shaking_x);
  add("across", Role::orange, c.shaking_y);
  return plot;
}

Plot counterweight_plot(const Forces& f) {
  Plot plot{.title = "Shaking force before and after balancing, at constant speed",
            .x = {"along the stroke", ""},
            .y = {"across", ""},
            .series = {},
            .note = "Tip of the force on the frame over a turn."};
  plot.equal_axes = true;
  double largest = 0;
  for (const Counterweight& c : f.counterweights) largest = std::max(largest, c.peak_force);
  const ReadableUnit unit = readable_unit(largest, "N");
  plot.x.unit = plot.y.unit = unit.unit;
  for (std::size_t i = 0; i < f.counterweights.size(); ++i) {
    const Counterweight& c = f.counterweights[i];
    Series s{.name = c.name, .role = i == 0 ? Role::rigid : further_role(i - 1), .x = {}, .y = {}, .dashed = i == 0};
    for (const Force2& force : c.shaking) {
      s.x.push_back(unit.factor * force.x);
      s.y.push_back(unit.factor * force.y);
    }
    plot.series.push_back(std::move(s));
  }
  return plot;
}

void add_shaking(Report& report, const Forces& f) {
  ReportSection& section = report.add("Shaking force and moment; balancing");
  section.cards.push_back(both(f, "Shaking force on the frame along the stroke", "force", "N",
                               [](const CyclePosition& p) { return p.forces.shaking_force.x; }));
  section.cards.push_back(both(f, "Shaking force on the frame across the stroke", "force", "N",
                               [](const CyclePosition& p) { return p.forces.shaking_force.y; }));
  section.cards.push_back(both(f, "Shaking moment on the frame about the crank's axis", "moment", "N*m",
                               [](const CyclePosition& p) { return p.forces.shaking_moment; }));
  for (const ForceCycle* c : problems_of(f)) {
    section.cards.push_back(harmonic_plot(*c));
    section.cards.push_back(
        table_card(fmt::format("Amplitudes by order, {} motion", c->label), harmonic_rows(*c), 1, true));
  }
  section.cards.push_back(counterweight_plot(f));
  section.cards.push_back(
      table_card("Counterweights beyond what the crank has: what they leave", counterweight_rows(f), 1));
  const double share = f.data.rod_com / f.data.rod_length;
  section.cards.push_back(Formula{
      .title = "Masses that rotate and that reciprocate (theory 9.11)",
      .symbols = "U_rot = m₁ s₁ + m₂ (1 − c/l) r,   m_rec = m₃ + m₂ c/l",
      .numbers =
          fmt::format("U_rot = {:.5g} · ({:.5g}) + {:.5g} · (1 − {:.4g}) · {:.5g} = {:.5g} kg·m,   m_rec = {:.5g} + "
                      "{:.5g} · {:.4g} = {:.5g} kg",
                      f.data.crank_mass, f.data.crank_com, f.data.rod_mass, share, f.data.radius, f.rotating_moment,
                      f.data.slider_mass, f.data.rod_mass, share, f.reciprocating_mass),
      .note = "A counterweight U = U_rot balances the rotating masses; each κ m_rec r more takes κ of the first order "
              "along "
              "the stroke and puts it across. A negative U is taken off, or set on the pin's side."});
}

void add_friction(Report& report, const Forces& f) {
  ReportSection& section = report.add("Work, friction, efficiency");
  section.cards.push_back(table_card("Work done on the mechanism in a cycle", work_rows(f), 2));
  const ForceCycle& c = front_of(f);
  if (c.efficiency)
    section.cards.push_back(Formula{
        .title = fmt::format("Efficiency of the cycle, {} motion", c.label),
        .symbols = "η = A_useful / (A_in − ΔT)",
        .numbers = fmt::format("η = {:.6g} J / {:.6g} J = {:.6g}", c.useful, c.spent, *c.efficiency),
        .note = fmt::format("Harmful work {:.5g} J, kinetic energy gained {:.5g} J.", c.harmful, c.kinetic_change)});
  else
    section.cards.push_back(
        Text{.title = fmt::format("No efficiency of the cycle, {} motion", c.label), .body = c.no_efficiency + "."});
  if (!has_friction(f)) {
    section.cards.push_back(Text{.title = "",
                                 .body =
                                     "The joints are without friction: give main_bearing, crank_pin, slider_pin and "
                                     "guide of the slider-crank their radii and coefficients to count it."});
    return;
  }
  AnglePlot power("Power lost in the joints", "power", "W");
  for (std::size_t k = 0; k < joint_count; ++k)
    power.add(name_of(static_cast<Joint>(k)), further_role(k), c,
              [k](const CyclePosition& p) { return p.forces.friction_power[k]; });
  section.cards.push_back(power.made());
  section.cards.push_back(both(f, "Efficiency of the mechanism at each position", "η", "",
                               [](const CyclePosition& p) { return p.power.efficiency().value_or(std::nan("")); }));
  const auto circle = [&](const char* name, const RevoluteJoint& j) {
    if (j.radius == 0) return;
    const double f_k = j.friction.kinetic;
    section.cards.push_back(
        Formula{.title = fmt::format("Friction circle of the {} (theory 8.4)", name),
                .symbols = "ρ = r sin(atan f)",
                .numbers = fmt::format("ρ = {:.5g} mm · sin(atan {:.4g}) = {:.5g} mm", 1e3 * j.radius, f_k,
                                       1e3 * friction_circle_radius(j.radius, f_k))});
  };
  circle("main bearing", f.joints.main_bearing);
  circle("crank pin", f.joints.crank_pin);
  circle("slider pin", f.joints.slider_pin);
}

Report report_of(const Forces& f, const std::string& conclusion) {
  Report report{.title = fmt::format("{}: forces in {}", f.title, f.mechanism),
                .subtitle = fmt::format("Kinetostatics by d'Alembert's principle; {}", front_of(f).description),
                .conclusion = conclusion};
  report.complete = f.complete;
  for (const NamedPeak& p : peaks_of(front_of(f)))
    report.figures.push_back({"largest " + p.name, p.peak->value, p.unit, p.peak->error,
                              fmt::format("at φ = {}", at_angle(*p.peak)), p.peak->error ? 0 : 6});
  add_torque(report, f);
  add_reactions(report, f);
  add_polar(report, f);
  add_shaking(report, f);
  add_friction(report, f);
  ReportSection& tables = report.add("Position by position");
  for (const ForceCycle* c : problems_of(f)) {
    tables.cards.push_back(table_card(fmt::format("{}: {}", c->label, c->description), position_rows(*c), 0));
    tables.cards.push_back(Text{.title = "", .body = fmt::format("Check: {}.", checks_of(*c))});
  }
  std::string notes;
  for (const std::string& note : f.notes) notes += note + "\n";
  if (!f.complete) notes += "incomplete: " + f.diagnosis + "\n";
  if (!notes.empty()) report.add("Notes").cards.push_back(Text{.title = "", .body = notes});
  report.add("Scene").cards.push_back(
      Text{.title = f.scene_file, .body = f.scene_text, .verbatim = true, .folded = true});
  report.footer = report_footer();
  return report;
}

}  // namespace

StudyOutput output_of(const Forces& f) {
  StudyOutput output;
  output.conclusion = conclusion_of(f);
  output.table = table_of(f, output.conclusion);
  output.json = json_of(f, output.conclusion);
  output.report = [&f, conclusion = output.conclusion] { return report_of(f, conclusion); };
  for (const ForceCycle* c : problems_of(f))
    output.csv.push_back({fmt::format("forces_{}.csv", c->label), [c] { return csv_of(*c); }});
  output.complete = f.complete;
  output.diagnosis = f.diagnosis;
  return output;
}

}  // namespace kurbel
