// forces_findings.cpp — words, tables and formulas of the forces of a slider-crank.
#include "studies/forces/forces_findings.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/forces/forces_plots.h"

namespace kurbel {
namespace {

// --- figures ---

std::vector<NamedPeak> peaks_of(const ForceCycle& c) {
  std::vector<NamedPeak> peaks;
  for (std::size_t k = 0; k < joint_count; ++k)
    peaks.push_back(
        {fmt::format("reaction of the {}", name_of(static_cast<Joint>(k))), "N", "reaction", c.reaction[k]});
  return with_torque_and_shaking(std::move(peaks), c);
}

bool has_friction(const Forces& f) { return !f.joints.frictionless(); }

// With its error where that shows.
std::string efficiency_text(const ForceCycle& c) {
  constexpr double shows = 5e-5;
  const double value = c.efficiency->value, error = c.efficiency->error.value_or(0);
  return error > shows ? fmt::format("{:.3g} ± {:.1g} %", 100 * value, 100 * error)
                       : fmt::format("{:.4g} %", 100 * value);
}

std::string conclusion_of(const Forces& f) {
  const ForceCycle& c = front_of(f);
  std::string text = fmt::format("{}, {}, the shaking force peaks at {}", begin_conclusion(f, c, c.reaction[0]),
                                 torque_in_words(c), in_words(c.shaking_force, "N"));
  if (has_friction(f))
    text += c.efficiency
                ? fmt::format("; efficiency of the cycle {}{}", efficiency_text(c),
                              c.harmful.value > 0 ? fmt::format(", {} of {} lost", with_unit(c.harmful.value, "J", 4),
                                                                with_unit(c.spent, "J", 4))
                                                  : "")
                : fmt::format("; no efficiency of the cycle: {}", c.no_efficiency);
  return text + ".";
}

// --- tables ---

Rows position_table(const ForceCycle& c) {
  using P = const CyclePosition&;
  return table_of("", fmt::format("{}: {}", c.label, c.description), c.rows)
      .headed(fmt::format("{}: {}", c.label, c.description))
      .text_in(0)
      .always()
      .only_for_people("φ [°]", [](P p) { return degrees(p.state.phi); }, {.digits = 5})
      .only_for_people("ω [rad/s]", [](P p) { return p.state.omega; })
      .only_for_people("M [N·m]", [&](P p) { return or_zero(p.forces.torque, c.torque.value); })
      .only_for_people("R main [N]", [](P p) { return p.forces.main_bearing.magnitude(); })
      .only_for_people("R crank pin [N]", [](P p) { return p.forces.crank_pin.magnitude(); })
      .only_for_people("R slider pin [N]", [](P p) { return p.forces.slider_pin.magnitude(); })
      .only_for_people("N guide [N]", [&](P p) { return or_zero(p.forces.guide, c.reaction[3].value); })
      .only_for_people("at [mm]", [](P p) { return p.forces.guide_point; }, {.factor = 1e3, .digits = 4})
      .only_for_people("shaking [N]", [](P p) { return p.forces.shaking_force.magnitude(); })
      .only_for_people("η", [](P p) {
        return p.power.efficiency() ? fmt::format("{:.4f}", *p.power.efficiency()) : std::string("—");
      });
}

Rows counterweight_table(const Forces& f) {
  return table_of("counterweights", "Counterweights beyond what the crank has: what they leave", f.counterweights)
      .headed("counterweights opposite to the crank pin, beyond what the crank has (at constant speed)")
      .always()
      .column("name", "counterweight", &Counterweight::name)
      .column("moment", "m·r [kg·m]", &Counterweight::moment, {.digits = 5})
      .column("reciprocating_share", "share of reciprocating", &Counterweight::reciprocating_share, {.digits = 3})
      .estimate("peak_shaking_force", "peak of shaking force [N]", &Counterweight::peak_force)
      .estimate("first_order_along", "order 1 along [N]", &Counterweight::first_x)
      .estimate("first_order_across", "order 1 across [N]", &Counterweight::first_y)
      .estimate("peak_main_bearing", "peak of main bearing [N]", &Counterweight::peak_bearing);
}

std::string checks_of(const ForceCycle& c) {
  std::string text =
      fmt::format("power balance closes to {:.1e} of the largest power at every position", c.power_residual);
  if (c.most_iterations > 0)
    text += fmt::format("; friction laws hold to {:.1e}, at most {} Newton steps a position", c.friction_residual,
                        c.most_iterations);
  if (c.both_edges > 0)
    text +=
        fmt::format("; the slider is in contact at both edges at {} of {} positions", c.both_edges, c.positions.size());
  return text;
}

// --- for programs and files ---

Record force_record(Force2 force) {
  return {{"x", force.x}, {"y", force.y}, {"magnitude", force.magnitude()}, {"direction", force.direction()}};
}

Record position_record(const CyclePosition& p) {
  const SliderCrankForces& s = p.forces;
  const Record guide = {{"normal", s.guide},          {"point", s.guide_point},
                        {"moment", s.guide_moment},   {"friction", s.guide_friction},
                        {"both_edges", s.both_edges}, {"edge_front", s.edge_front},
                        {"edge_back", s.edge_back}};
  const Record inertia = {{"crank", force_record(s.crank_inertia)},
                          {"rod", force_record(s.rod_inertia)},
                          {"slider", force_record(s.slider_inertia)},
                          {"crank_couple", s.crank_couple},
                          {"rod_couple", s.rod_couple}};
  return {{"phi", p.state.phi},
          {"omega", p.state.omega},
          {"alpha", p.state.alpha},
          {"position", p.position},
          {"velocity", p.velocity},
          {"slider_force", p.state.slider_force},
          {"torque", s.torque},
          {"main_bearing", force_record(s.main_bearing)},
          {"crank_pin", force_record(s.crank_pin)},
          {"slider_pin", force_record(s.slider_pin)},
          {"guide", guide},
          {"inertia", inertia},
          {"shaking_force", force_record(s.shaking_force)},
          {"shaking_moment", s.shaking_moment},
          {"efficiency", p.power.efficiency()},
          {"friction_power", s.friction_power},
          {"friction_residual", s.residual},
          {"power_residual", p.power.residual}};
}

Record cycle_record(const ForceCycle& c) {
  Record r = common_record(c, peaks_of(c));
  const auto tell = [&](const char* key, Value value) { r.push_back({key, std::move(value)}); };
  if (c.efficiency)
    tell("efficiency", *c.efficiency);
  else
    tell("efficiency", Value()), tell("no_efficiency", c.no_efficiency);
  tell("work_in", c.input.value);
  tell("work_useful", c.useful.value);
  tell("work_harmful", c.harmful.value);
  tell("works_error", larger_error(c.input, {0, larger_error(c.useful, c.harmful)}));
  tell("friction_residual", c.friction_residual);
  tell("positions_on_both_edges", c.both_edges);
  tell("positions", each(c.rows, position_record));
  return r;
}

DataTable table_of_forces(const ForceCycle& c) {
  using P = const CyclePosition&;
  auto data = data_of(c.positions);
  data.in_file("phi", "rad", [](P p) { return p.state.phi; })
      .in_file("omega", "rad/s", [](P p) { return p.state.omega; })
      .in_file("alpha", "rad/s2", [](P p) { return p.state.alpha; })
      .in_file("position_along_x", "m", &CyclePosition::position)
      .in_file("velocity", "m/s", &CyclePosition::velocity)
      .in_file("slider_force_along_x", "N", [](P p) { return p.state.slider_force; })
      .in_file("torque_of_shaft_on_crank", "N*m", [](P p) { return p.forces.torque; });
  const auto force = [&](const std::string& name, Force2 SliderCrankForces::*of) {
    data.in_file(name + "_x", "N", [of](P p) { return (p.forces.*of).x; });
    data.in_file(name + "_y", "N", [of](P p) { return (p.forces.*of).y; });
  };
  force("main_bearing_of_frame_on_crank", &SliderCrankForces::main_bearing);
  force("crank_pin_of_crank_on_rod", &SliderCrankForces::crank_pin);
  force("slider_pin_of_rod_on_slider", &SliderCrankForces::slider_pin);
  data.in_file("guide_of_frame_on_slider_y", "N", [](P p) { return p.forces.guide; })
      .in_file("guide_point_from_pin_x", "m", [](P p) { return p.forces.guide_point; })
      .in_file("guide_friction_on_slider_x", "N", [](P p) { return p.forces.guide_friction; })
      .in_file("both_edges", {}, [](P p) { return static_cast<int>(p.forces.both_edges); });
  force("shaking_on_frame", &SliderCrankForces::shaking_force);
  data.in_file("shaking_on_frame_moment_about_crank_axis", "N*m", [](P p) { return p.forces.shaking_moment; });
  for (std::size_t k = 0; k < joint_count; ++k) {
    const char* const joints[] = {"main", "crank_pin", "slider_pin", "guide"};
    data.in_file(fmt::format("friction_{}", joints[k]), "W", [k](P p) { return p.forces.friction_power[k]; });
  }
  return data.in_file("efficiency", {}, [](P p) { return p.power.efficiency(); })
      .in_file(
          "power_residual", {}, [](P p) { return p.power.residual; }, 3)
      .data();
}

// --- formulas ---

Formulas torque_formula(const Forces& f) {
  // With the numbers of the peak.
  const ForceCycle& c = front_of(f);
  const CyclePosition* const peak = &c.at_torque_peak;
  const ReducedSample at = closed_sample(f.data, peak->state.phi);
  const double w = peak->state.omega, loss = w != 0 ? peak->power.friction / w : 0;
  return Formulas()
      .add(fmt::format("At its peak, φ = {:.4g}° (theory 9.7)", degrees(peak->state.phi)),
           "M = I_r ε + ½ I_r′ ω² − M_g − F x′ + P_f/ω",
           "M = {:.5g} · ({:.5g}) + ½ · ({:.5g}) · ({:.5g})² − ({:.5g}) − ({:.5g}) · ({:.5g}) + ({:.5g}) = {:.6g} N·m",
           at.inertia, peak->state.alpha, at.inertia_slope, w, at.gravity_torque, peak->state.slider_force,
           at.output_velocity_ratio, loss, peak->forces.torque)
      .note(
          "I_r reduced inertia, M_g torque of the weights, F force on the slider, P_f power lost in the joints; SI "
          "units. Reactions come from the equilibrium of each link, this formula from energy: they agree to the power "
          "balance below.");
}

Formulas mass_formula(const Forces& f) {
  const double share = f.data.rod_com / f.data.rod_length;
  return Formulas()
      .add("Masses that rotate and that reciprocate (theory 9.11)",
           "U_rot = m₁ s₁ + m₂ (1 − c/l) r,   m_rec = m₃ + m₂ c/l",
           "U_rot = {:.5g} · ({:.5g}) + {:.5g} · (1 − {:.4g}) · {:.5g} = {:.5g} kg·m,   m_rec = {:.5g} + {:.5g} · "
           "{:.4g} = {:.5g} kg",
           f.data.crank_mass, f.data.crank_com, f.data.rod_mass, share, f.data.radius, f.rotating_moment,
           f.data.slider_mass, f.data.rod_mass, share, f.reciprocating_mass)
      .note(
          "A counterweight U = U_rot balances the rotating masses; each κ m_rec r more takes κ of the first order "
          "along the stroke and puts it across. A negative U is taken off, or set on the pin's side.");
}

void show_efficiency(Findings& to, Chapter in, const ForceCycle& c) {
  if (c.efficiency)
    to.show(in, Formulas()
                    .add(fmt::format("Efficiency of the cycle, {} motion", c.label), "η = A_useful / (A_in − ΔT)",
                         "η = {:.6g} J / {:.6g} J = {:.6g}", c.useful.value, c.spent, c.efficiency->value)
                    .note(fmt::format("{}. Harmful work {:.5g} J, kinetic energy gained {:.5g} J.", efficiency_text(c),
                                      c.harmful.value, or_zero(c.kinetic_change.value, 1e3 * c.spent))));
  else
    to.show(in, Text{.title = fmt::format("No efficiency of the cycle, {} motion", c.label),
                     .body = c.no_efficiency + "."});
}

void show_friction_circle(Findings& to, Chapter in, const char* name, const RevoluteJoint& j) {
  if (j.radius == 0) return;
  const double f_k = j.friction.kinetic;
  to.show(in, Formulas().add(fmt::format("Friction circle of the {} (theory 8.4)", name), "ρ = r sin(atan f)",
                             "ρ = {:.5g} mm · sin(atan {:.4g}) = {:.5g} mm", 1e3 * j.radius, f_k,
                             1e3 * friction_circle_radius(j.radius, f_k)));
}

// --- all of it ---

constexpr const char* signs =
    "Axes of the mechanism: origin on the crank's axis, +x along the stroke towards the extended end, +y 90° ahead of "
    "it; angles, torques and moments counter-clockwise. Main bearing: frame on crank. Crank pin: crank on rod. Slider "
    "pin: rod on slider. Guide: frame on slider, along +y. Each body does the opposite to the first. The balancing "
    "torque is the shaft's on the crank. Shaking force and moment are those of all inertia forces −m a and couples −I "
    "ε on the frame, moments about the crank's axis; loads and weights are not in them.";

void say_positions(Findings& to, Chapter in, const Forces& f) {
  to.say(in, peak_table(f, peaks_of).text_in(1).not_on_page());
  for (const ForceCycle* c : problems_of(f)) {
    to.say(in, position_table(*c));
    to.say(in, Sentences{.lines = {checks_of(*c)}, .indent = "  ", .page = false});
    to.show(in, Text{.title = "", .body = fmt::format("Check: {}.", checks_of(*c))});
    to.tell(c->label, cycle_record(*c));
  }
}

void say_friction(Findings& to, Chapter in, const Forces& f) {
  const auto problems = problems_of(f);
  to.say(in, work_table({problems.begin(), problems.end()}));
  show_efficiency(to, in, front_of(f));
  if (!has_friction(f)) {
    to.show(in, Text{.title = "",
                     .body = "The joints are without friction: give main_bearing, crank_pin, slider_pin and guide of "
                             "the slider-crank their radii and coefficients to count it."});
    return;
  }
  to.draw(in, [&f] { return friction_plots(f); });
  show_friction_circle(to, in, "main bearing", f.joints.main_bearing);
  show_friction_circle(to, in, "crank pin", f.joints.crank_pin);
  show_friction_circle(to, in, "slider pin", f.joints.slider_pin);
}

void say_shaking(Findings& to, Chapter in, const Forces& f) {
  to.draw(in, [&f] { return shaking_plots(f, "along the stroke", "across the stroke"); });
  for (const ForceCycle* c : problems_of(f)) {
    to.draw(in, [c] { return harmonic_plot(*c); });
    to.say(in, harmonic_table(*c, c == &front_of(f)));
  }
  to.draw(in, [&f] { return counterweight_plot(f); });
  to.say(in, counterweight_table(f));
  to.show(in, mass_formula(f));
  to.tell("rotating_moment", f.rotating_moment);
  to.tell("reciprocating_mass", f.reciprocating_mass);
}

}  // namespace

Findings findings_of(const Forces& f) {
  Findings to = begin_findings(f, front_of(f), conclusion_of(f));
  for (const NamedPeak& p : peaks_of(front_of(f))) to.figures.push_back(key_figure(p));
  const Chapter torque = to.chapter("Balancing torque"), reactions = to.chapter("Reactions in the joints (theory 9.6)"),
                links = to.chapter("Links: motion, inertia forces, shares"),
                polar = to.chapter("Polar diagrams of the bearings' loads"),
                shaking = to.chapter("Shaking force and moment; balancing"),
                friction = to.chapter("Work, friction, efficiency"), positions = to.chapter("Position by position"),
                notes = to.chapter("Notes");
  to.draw(torque, [&f] { return torque_plot(f); });
  to.show(torque, torque_formula(f));
  to.tell("signs", signs);
  to.draw(reactions, [&f] { return reaction_plots(f); });
  to.show(reactions, Text{.title = "Signs and axes", .body = signs});
  to.show(polar,
          Text{.title = "",
               .body = "Tips of the load over a cycle. In the frame it shows where shell and housing are pressed; "
                       "turning with the pin, where the pin is: that is where an oil hole must not be."});
  to.draw(polar, [&f] { return polar_plots(f); });
  say_positions(to, positions, f);
  say_friction(to, friction, f);
  say_shaking(to, shaking, f);
  say_links(to, links, *f.links);
  to.tell("links", links_list(*f.links));
  to.note(notes, f.notes);
  to.show_scene(f.scene_file, f.scene_text);
  for (const ForceCycle* c : problems_of(f))
    to.tables.push_back({"forces_" + c->label, [c] { return table_of_forces(*c); }});
  to.tables.push_back({"links_" + front_of(f).label, [&f] { return table_of_links(*f.links); }});
  return to;
}

StudyOutput output_of_forces(const Scene& scene, const ForcesOptions& options) {
  if (chosen_mechanism(scene, options.mechanism).kind->name == "slider-crank")
    return output_of(find_forces(scene, options));
  return output_of(find_linkage_forces(scene, options));
}

}  // namespace kurbel
