// linkage_findings.cpp — what is said of the forces in any mechanism with ideal joints, and of the links of every one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/forces/forces_findings.h"
#include "studies/forces/forces_plots.h"

namespace kurbel {

double degrees(double angle) { return angle * 180 / std::numbers::pi; }
std::string at_angle(const Peak& p) { return fmt::format("{:.1f}°", degrees(p.phi)); }
bool is_nothing(const Peak& p) {
  constexpr double negligible = 1e-6;
  return std::abs(p.value) <= p.error.value_or(0) && p.error.value_or(0) <= negligible * p.scale;
}
std::string in_words(const Peak& p, const std::string& si_unit) {
  const ReadableUnit unit = readable_unit(p.value, si_unit);
  if (std::abs(p.value) <= p.error.value_or(0) && !is_nothing(p))  // not told from zero: alone it would say too much
    return with_error(unit.factor * p, unit.unit);
  return fmt::format("{:.5g} {}", unit.factor * p.value, unit.unit);
}
std::string peak_text(const Peak& p, double factor) { return p.unbounded ? "no bound" : with_error(factor * p, ""); }
double or_zero(double value, double largest) { return std::abs(value) < 1e-12 * std::abs(largest) ? 0.0 : value; }

Findings begin_findings(const AboutForces& f, const CycleOfForces& front, const std::string& conclusion) {
  Findings to{.title = f.title,
              .subtitle = fmt::format("Kinetostatics by d'Alembert's principle; {}", front.description),
              .page_title = fmt::format("{}: forces in {}", f.title, f.mechanism),
              .scene_file = f.scene_file,
              .speed_unit = f.speed_unit.name,
              .complete = f.complete,
              .diagnosis = f.diagnosis,
              .footer = report_footer()};
  to.conclude(f.complete, conclusion);
  if (f.complete) to.conclude(true, capitalised(front.description));
  for (const std::string& sentence : f.outside_data) to.claim(Predicate::outside_data, sentence);
  to.tell("mechanism", f.mechanism);
  return to;
}

std::string begin_conclusion(const AboutForces& f, const CycleOfForces& front, const Peak& main_bearing) {
  const std::string moving = fmt::format("{} at {}", f.mechanism, f.speed_unit.text(front.mean_speed.value, 4));
  if (f.unbounded.any()) return begin_unbounded(moving, f.unbounded);
  return fmt::format("{}: the main bearing carries up to {} (at {})", moving, in_words(main_bearing, "N"),
                     at_angle(main_bearing));
}

std::string torque_in_words(const CycleOfForces& c) {
  if (is_nothing(c.torque)) return "no balancing torque is needed";
  return fmt::format("the balancing torque peaks at {} (at {})", in_words(c.torque, "N*m"), at_angle(c.torque));
}

std::vector<NamedPeak> with_torque_and_shaking(std::vector<NamedPeak> reactions, const CycleOfForces& c) {
  reactions.push_back({"balancing torque", "N*m", "balancing_torque", c.torque});
  reactions.push_back({"shaking force", "N", "shaking_force", c.shaking_force});
  reactions.push_back({"shaking moment", "N*m", "shaking_moment", c.shaking_moment});
  return reactions;
}

KeyFigure key_figure(const NamedPeak& p) {
  return {
      "largest " + p.name, p.peak.told(), p.unit, p.peak.error, fmt::format("at φ = {}", at_angle(p.peak)), 0, p.means};
}

RowsOf<std::size_t> peak_table(const std::vector<std::string>& labels, const std::vector<std::vector<NamedPeak>>& of) {
  const std::vector<NamedPeak>& first = of.front();
  auto table = table_of("", "Largest values over the cycle", numbers_below(first.size()));
  const auto unit_of = [&](std::size_t i) { return readable_unit(first[i].peak.value, first[i].unit); };
  table.text_in(0).only_for_people("largest", [&](std::size_t i) { return first[i].name; });
  for (std::size_t k = 0; k < of.size(); ++k)
    table.only_for_people(labels[k], [&](std::size_t i) { return peak_text(of[k][i].peak, unit_of(i).factor); })
        .only_for_people("at", [&](std::size_t i) { return at_angle(of[k][i].peak); });
  return table.only_for_people("unit", [&](std::size_t i) { return unit_of(i).unit; });
}

Rows work_table(const std::vector<const CycleOfForces*>& problems) {
  std::vector<std::size_t> acting;
  for (std::size_t i = 0; i < problems.front()->work.size(); ++i)
    for (const CycleOfForces* c : problems)
      if (c->work[i].work.value != 0 && (acting.empty() || acting.back() != i)) acting.push_back(i);
  auto table = table_of("", "Work done on the mechanism in a cycle", std::move(acting));
  table.text_in(2).always();
  table.only_for_people("work of a cycle", [&](std::size_t i) { return problems.front()->work[i].name; })
      .only_for_people("line", [&](std::size_t i) { return problems.back()->work[i].kind; });
  for (const CycleOfForces* c : problems)
    table.only_for_people(c->label, [&](std::size_t i) { return with_error(c->work[i].work, ""); });
  return table.only_for_people("unit", [](std::size_t) { return std::string("J"); });
}

Rows harmonic_table(const CycleOfForces& c, bool on_terminal) {
  const auto amplitude = [](const std::vector<ForceHarmonic>& orders) {
    return [&](std::size_t k) { return with_error(orders[k].amplitude, ""); };
  };
  auto table = table_of("", fmt::format("Amplitudes by order, {} motion", c.label), numbers_below(c.shaking_x.size()))
                   .headed(fmt::format("harmonics, {} motion", c.label))
                   .fold()
                   .always()
                   .only_for_people("order", [&](std::size_t k) { return c.shaking_x[k].order; })
                   .only_for_people("along [N]", amplitude(c.shaking_x))
                   .only_for_people("across [N]", amplitude(c.shaking_y))
                   .only_for_people("moment [N·m]", amplitude(c.shaking_couple))
                   .only_for_people("balancing torque [N·m]", amplitude(c.torque_orders));
  table.terminal = on_terminal;
  return table;
}

Record common_record(const CycleOfForces& c, const std::vector<NamedPeak>& peaks) {
  const auto order_list = [](const std::vector<ForceHarmonic>& orders) {
    return each(orders, [](const ForceHarmonic& h) {
      return Record{
          {"order", h.order}, {"amplitude", h.amplitude.value}, {"phase", h.phase}, {"error", h.amplitude.error}};
    });
  };
  return {{"description", c.description},
          {"cycle", c.cycle},
          {"mean_speed", c.mean_speed},
          {"least_speed", c.least_speed.value},
          {"greatest_speed", c.greatest_speed.value},
          {"speed_extremes_error", larger_error(c.least_speed, c.greatest_speed)},
          {"closure", c.closure},
          {"peaks", each(peaks,
                         [](const NamedPeak& p) {
                           return Record{{"name", p.name},
                                         {"value", p.peak.told()},
                                         {"unit", p.unit},
                                         {"error", p.peak.error},
                                         {"phi", p.peak.phi}};
                         })},
          {"work",
           each(c.work,
                [](const CycleWork& w) {
                  return Record{{"name", w.name}, {"line", w.kind}, {"work", w.work.value}, {"error", w.work.error}};
                })},
          {"kinetic_change", c.kinetic_change},
          {"power_residual", c.power_residual},
          {"machine_residual", c.machine_residual},
          {"harmonics", Record{{"shaking_force_along", order_list(c.shaking_x)},
                               {"shaking_force_across", order_list(c.shaking_y)},
                               {"shaking_moment", order_list(c.shaking_couple)},
                               {"balancing_torque", order_list(c.torque_orders)},
                               {"balancing_torque_mean", c.torque_mean}}}};
}

namespace {

using P = const PositionForces&;

std::vector<NamedPeak> peaks_of(const LinkageCycle& c) { return with_torque_and_shaking(c.reactions, c); }

// The heaviest of all joints.
const NamedPeak& heaviest(const LinkageCycle& c) {
  const NamedPeak* most = &c.reactions.front();
  for (const NamedPeak& r : c.reactions)
    if (r.unit == "N" && std::abs(r.peak.value) > std::abs(most->peak.value)) most = &r;
  return *most;
}

std::string conclusion_of(const LinkageStudy& f) {
  const LinkageCycle& c = front_of(f);
  const NamedPeak &bearing = c.reactions.front(), &most = heaviest(c);
  std::string text = begin_conclusion(f, c, bearing.peak);
  if (&most != &bearing && !f.unbounded.any())
    text += fmt::format(", the heaviest load of a joint is {} ({}, at {})", in_words(most.peak, "N"), most.name,
                        at_angle(most.peak));
  text += ", " + torque_in_words(c);
  if (!is_nothing(c.shaking_force))
    return text + fmt::format(", the shaking force peaks at {}.", in_words(c.shaking_force, "N"));
  return text + (is_nothing(c.shaking_moment) ? std::string(", nothing shakes the frame.")
                                              : fmt::format(", no force but a moment shakes the frame, up to {}.",
                                                            in_words(c.shaking_moment, "N*m")));
}

std::string signs_of(const LinkageStudy& f) {
  return fmt::format(
      "Axes of the mechanism: origin on the crank's axis, +x along the {}, +y 90° ahead of it; angles, torques and "
      "moments counter-clockwise. “{}: {} on {}” is the force of the first body on the second; the second exerts the "
      "opposite on the first. A slide's force is normal to it, positive 90° ahead of its direction; its moment is "
      "about the pin at which it is given. The balancing torque is the shaft's on the crank. Shaking force and moment "
      "are those of all inertia forces −m a and couples −I ε on the frame, moments about the crank's axis; loads and "
      "weights are not in them.",
      f.rocks ? "ground link" : "stroke", front_of(f).positions.front().forces.joints[1].name,
      front_of(f).positions.front().forces.joints[1].from, front_of(f).positions.front().forces.joints[1].on);
}

std::string joints_of(const LinkageStudy& f) {
  return fmt::format(
      "joints of a {} count as ideal: the scene knows no friction of them by their reactions (a slider-crank's may "
      "have it), so that what they lose is in neither motion nor balancing torque",
      f.kind);
}

// --- tables ---

Rows position_table(const LinkageCycle& c) {
  auto table = table_of("", fmt::format("{}: {}", c.label, c.description), c.rows);
  table.headed(fmt::format("{}: {}", c.label, c.description)).text_in(0).always();
  table.only_for_people("φ [°]", [](P p) { return degrees(p.forces.state.phi); }, {.digits = 5})
      .only_for_people("ω [rad/s]", [](P p) { return p.forces.state.omega; })
      .only_for_people("M [N·m]", [&](P p) { return or_zero(p.forces.torque, c.torque.value); });
  const double largest = heaviest(c).peak.value;
  for (std::size_t k = 0; k < c.rows.front().forces.joints.size(); ++k)
    table.only_for_people(fmt::format("{} [N]", c.rows.front().forces.joints[k].name),
                          [k, largest](P p) { return or_zero(force_of(p.forces.joints[k]), largest); });
  return table.only_for_people("shaking [N]",
                               [&](P p) { return or_zero(p.forces.shaking_force.magnitude(), largest); });
}

// --- for programs and files ---

Record components_of(Force2 f) { return {{"x", f.x}, {"y", f.y}}; }

Record position_record(P p) {
  const LinkageForces& f = p.forces;
  return {{"phi", f.state.phi},
          {"omega", f.state.omega},
          {"alpha", f.state.alpha},
          {"load", f.state.load},
          {"output", f.output},
          {"output_velocity", f.output_velocity},
          {"torque", f.torque},
          {"joints", each(f.joints,
                          [](const JointForces& j) {
                            return Record{{"name", j.name}, {"from", j.from},     {"on", j.on},     {"x", j.force.x},
                                          {"y", j.force.y}, {"moment", j.moment}, {"at_x", j.at.x}, {"at_y", j.at.y}};
                          })},
          {"links", each(f.links,
                         [](const LinkForces& l) {
                           return Record{{"name", l.name},
                                         {"omega", l.omega},
                                         {"alpha", l.alpha},
                                         {"acceleration", components_of(l.acceleration)},
                                         {"inertia_force", components_of(l.inertia_force)},
                                         {"inertia_couple", l.inertia_couple},
                                         {"reduced_inertia", l.reduced_inertia},
                                         {"kinetic_energy", l.kinetic_energy}};
                         })},
          {"shaking_force", components_of(f.shaking_force)},
          {"shaking_moment", f.shaking_moment},
          {"power_residual", p.power.residual}};
}

Record peak_record(const Peak& p) { return {{"value", p.value}, {"error", p.error}, {"phi", p.phi}}; }

Record cycle_record(const LinkageCycle& c) {
  Record r = common_record(c, peaks_of(c));
  r.push_back({"links", links_list(c)});
  r.push_back({"equation_residual", c.equation_residual});
  r.push_back({"positions", each(c.rows, position_record)});
  return r;
}

std::string underscored(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == ',') c = '_';
  return name;
}

DataTable table_of_linkage_forces(const LinkageCycle& c, bool rocks) {
  auto data = data_of(c.positions);
  data.in_file("phi", "rad", [](P p) { return p.forces.state.phi; })
      .in_file("omega", "rad/s", [](P p) { return p.forces.state.omega; })
      .in_file("alpha", "rad/s2", [](P p) { return p.forces.state.alpha; })
      .in_file(rocks ? "output_angle" : "position_along_x", rocks ? "rad" : "m", [](P p) { return p.forces.output; })
      .in_file(rocks ? "load_on_output" : "load_on_output_along_x", rocks ? "N*m" : "N",
               [](P p) { return p.forces.state.load; })
      .in_file("torque_of_shaft_on_crank", "N*m", [](P p) { return p.forces.torque; });
  const LinkageForces& first = c.positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string name = underscored(fmt::format("{} of {} on {}", j.name, j.from, j.on));
    data.in_file(name + "_x", "N", [k](P p) { return p.forces.joints[k].force.x; });
    data.in_file(name + "_y", "N", [k](P p) { return p.forces.joints[k].force.y; });
    if (j.slides) data.in_file(name + "_moment", "N*m", [k](P p) { return p.forces.joints[k].moment; });
  }
  data.in_file("shaking_on_frame_x", "N", [](P p) { return p.forces.shaking_force.x; })
      .in_file("shaking_on_frame_y", "N", [](P p) { return p.forces.shaking_force.y; })
      .in_file("shaking_on_frame_moment_about_crank_axis", "N*m", [](P p) { return p.forces.shaking_moment; });
  return data
      .in_file(
          "power_residual", {}, [](P p) { return p.power.residual; }, 3)
      .data();
}

}  // namespace

List links_list(const LinkageCycle& c) {
  return each(c.links, [](const LinkOfCycle& l) {
    return Record{{"name", l.name},
                  {"omega", peak_record(l.omega)},
                  {"alpha", peak_record(l.alpha)},
                  {"inertia_force", peak_record(l.inertia_force)},
                  {"inertia_couple", peak_record(l.inertia_couple)},
                  {"reduced_inertia", estimate_record(l.reduced_inertia)},
                  {"inertia_share", estimate_record(l.inertia_share)},
                  {"least_share", l.least_share.value},
                  {"greatest_share", l.greatest_share.value},
                  {"share_extremes_error", larger_error(l.least_share, l.greatest_share)},
                  {"energy", estimate_record(l.energy)},
                  {"energy_share", estimate_record(l.energy_share)}};
  });
}

void say_links(Findings& to, Chapter in, const LinkageCycle& c) {
  using L = const LinkOfCycle&;
  const auto told = [](auto LinkOfCycle::*of, double factor = 1) {
    return [of, factor](L l) { return with_error(factor * (l.*of), ""); };
  };
  to.say(in, table_of("", "Motion and inertia forces of the links, largest over the cycle", c.links)
                 .headed("links: motion and inertia forces, largest over the cycle")
                 .text_in(0)
                 .always()
                 .only_for_people("link", &LinkOfCycle::name)
                 .only_for_people("ω [rad/s]", told(&LinkOfCycle::omega))
                 .only_for_people("ε [rad/s²]", told(&LinkOfCycle::alpha))
                 .only_for_people("m a [N]", told(&LinkOfCycle::inertia_force))
                 .only_for_people("at", [](L l) { return at_angle(l.inertia_force); })
                 .only_for_people("−I ε [N·m]", told(&LinkOfCycle::inertia_couple)));
  to.say(in, table_of("", "Shares of the links in the reduced inertia and the kinetic energy", c.links)
                 .headed("links: shares in I_r (mean over the angle) and kinetic energy (mean over the time)")
                 .text_in(0)
                 .always()
                 .only_for_people("link", &LinkOfCycle::name)
                 .only_for_people("I_r [kg·m²]", told(&LinkOfCycle::reduced_inertia))
                 .only_for_people("of I_r [%]", told(&LinkOfCycle::inertia_share, 100))
                 .only_for_people("least [%]", told(&LinkOfCycle::least_share, 100))
                 .only_for_people("most [%]", told(&LinkOfCycle::greatest_share, 100))
                 .only_for_people("T [J]", told(&LinkOfCycle::energy))
                 .only_for_people("of T [%]", told(&LinkOfCycle::energy_share, 100)));
  to.draw(in, [&c] { return link_plots(c); });
}

DataTable table_of_links(const LinkageCycle& c) {
  auto data = data_of(c.positions);
  data.in_file("phi", "rad", [](P p) { return p.forces.state.phi; });
  for (std::size_t k = 0; k < c.links.size(); ++k) {
    const std::string name = underscored(c.links[k].name);
    const auto column = [&](const std::string& what, const char* unit, auto&& of) {
      data.in_file(name + what, unit, [k, of](P p) { return of(p.forces.links[k]); });
    };
    using L = const LinkForces&;
    column("_omega", "rad/s", [](L l) { return l.omega; });
    column("_alpha", "rad/s2", [](L l) { return l.alpha; });
    column("_com_acceleration_x", "m/s2", [](L l) { return l.acceleration.x; });
    column("_com_acceleration_y", "m/s2", [](L l) { return l.acceleration.y; });
    column("_inertia_force_x", "N", [](L l) { return l.inertia_force.x; });
    column("_inertia_force_y", "N", [](L l) { return l.inertia_force.y; });
    column("_inertia_couple", "N*m", [](L l) { return l.inertia_couple; });
    column("_reduced_inertia", "kg*m2", [](L l) { return l.reduced_inertia; });
    column("_kinetic_energy", "J", [](L l) { return l.kinetic_energy; });
  }
  return data.data();
}

Findings findings_of(const LinkageStudy& f) {
  const LinkageCycle& front = front_of(f);
  Findings to = begin_findings(f, front, conclusion_of(f));
  for (const NamedPeak& p : peaks_of(front))
    if (p.means != "reaction_moment" || !is_nothing(p.peak)) to.figures.push_back(key_figure(p));  // a ram carries none
  const Chapter torque = to.chapter("Balancing torque"), reactions = to.chapter("Reactions in the joints (theory 9.6)"),
                polar = to.chapter("Polar diagrams of the joints' loads, in the frame"),
                links = to.chapter("Links: motion, inertia forces, shares"),
                shaking = to.chapter("Shaking force and moment"), works = to.chapter("Work"),
                positions = to.chapter("Position by position"), notes = to.chapter("Notes");
  to.tell("kind", f.kind);
  to.tell("signs", signs_of(f));
  to.draw(torque, [&f] { return torque_plot(f); });
  to.draw(reactions, [&f] { return reaction_plots(f); });
  to.show(reactions, Text{.title = "Signs and axes", .body = signs_of(f)});
  to.draw(polar, [&f] { return polar_plots(f); });
  to.say(positions, peak_table(f, peaks_of));
  for (const LinkageCycle* c : problems_of(f)) {
    to.say(positions, position_table(*c));
    to.tell(c->label, cycle_record(*c));
    to.tables.push_back({"forces_" + c->label, [c, rocks = f.rocks] { return table_of_linkage_forces(*c, rocks); }});
    to.tables.push_back({"links_" + c->label, [c] { return table_of_links(*c); }});
  }
  say_links(to, links, front);
  const auto problems = problems_of(f);
  to.say(works, work_table({problems.begin(), problems.end()}));
  to.draw(shaking, [&f] { return shaking_plots(f, "along +x", "along +y"); });
  for (const LinkageCycle* c : problems) to.say(shaking, harmonic_table(*c, c == &front));
  to.say(notes, Sentences{.lines = {fmt::format("powers balance to {:.1e} of the largest at every position, the links' "
                                                "equilibrium to {:.1e}",
                                                front.power_residual, front.equation_residual)},
                          .indent = "  "});
  std::vector<std::string> told = f.notes;
  told.push_back(joints_of(f));
  to.note(notes, told);
  to.show_scene(f.scene_file, f.scene_text);
  return to;
}

}  // namespace kurbel
