// linkage_findings.cpp — what is said of the forces in any mechanism with ideal joints, and of the links of every one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/forces/forces_findings.h"
#include "studies/forces/linkage_plots.h"

namespace kurbel {

double degrees(double angle) { return angle * 180 / std::numbers::pi; }
std::string at_angle(const Peak& p) { return fmt::format("{:.1f}°", degrees(p.phi)); }
bool is_nothing(const Peak& p) {
  constexpr double negligible = 1e-6;
  return std::abs(p.value) <= p.error.value_or(0) && p.error.value_or(0) <= negligible * p.scale;
}
std::string in_words(const Peak& p, const std::string& si_unit) {
  const ReadableUnit unit = readable_unit(p.value, si_unit);
  const double error = p.error.value_or(0);
  if (std::abs(p.value) <= error && !is_nothing(p))  // not told from zero: the number alone would say too much
    return with_error(unit.factor * p.value, unit.factor * error, unit.unit);
  return fmt::format("{:.5g} {}", unit.factor * p.value, unit.unit);
}
std::string peak_text(const Peak& p, double factor) {
  const std::optional<double> error = p.error ? std::optional(factor * *p.error) : std::nullopt;
  return p.unbounded ? "no bound" : with_error(factor * p.value, error, "");
}

namespace {

using P = const PositionForces&;

std::vector<const LinkageFigure*> peaks_of(const LinkageCycle& c) {
  std::vector<const LinkageFigure*> peaks;
  for (const LinkageFigure& r : c.reactions) peaks.push_back(&r);
  peaks.insert(peaks.end(), {&c.torque, &c.shaking_force, &c.shaking_moment});
  return peaks;
}

// The heaviest of all joints.
const LinkageFigure& heaviest(const LinkageCycle& c) {
  const LinkageFigure* most = &c.reactions.front();
  for (const LinkageFigure& r : c.reactions)
    if (r.unit == "N" && std::abs(r.peak.value) > std::abs(most->peak.value)) most = &r;
  return *most;
}

std::string conclusion_of(const LinkageStudy& f) {
  const LinkageCycle& c = front_of(f);
  const LinkageFigure &bearing = c.reactions.front(), &most = heaviest(c);
  const std::string moving = fmt::format("{} at {}", f.mechanism, f.speed_unit.text(c.mean_speed.value, 4));
  std::string text = f.unbounded.any() ? begin_unbounded(moving, f.unbounded)
                                       : fmt::format("{}: the main bearing carries up to {} (at {})", moving,
                                                     in_words(bearing.peak, "N"), at_angle(bearing.peak));
  if (&most != &bearing && !f.unbounded.any())
    text += fmt::format(", the heaviest load of a joint is {} ({}, at {})", in_words(most.peak, "N"), most.name,
                        at_angle(most.peak));
  text += is_nothing(c.torque.peak) ? std::string(", no balancing torque is needed")
                                    : fmt::format(", the balancing torque peaks at {} (at {})",
                                                  in_words(c.torque.peak, "N*m"), at_angle(c.torque.peak));
  if (!is_nothing(c.shaking_force.peak))
    return text + fmt::format(", the shaking force peaks at {}.", in_words(c.shaking_force.peak, "N"));
  return text + (is_nothing(c.shaking_moment.peak) ? std::string(", nothing shakes the frame.")
                                                   : fmt::format(", no force but a moment shakes the frame, up to {}.",
                                                                 in_words(c.shaking_moment.peak, "N*m")));
}

std::string signs_of(const LinkageStudy& f) {
  return fmt::format(
      "Axes of the mechanism: origin on the crank's axis, +x along the {}, +y 90° ahead of it; angles, torques and "
      "moments counter-clockwise. “{}: {} on {}” is the force that the first body does to the second; the second does "
      "its opposite to the first. A slide's force is normal to it, positive 90° ahead of its direction; its moment is "
      "about the pin that it is told at. The balancing torque is the shaft's on the crank. Shaking force and moment "
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

Rows peak_table(const LinkageStudy& f) {
  const auto first = peaks_of(*f.prescribed);
  auto table = table_of("", "Largest values over the cycle", numbers_below(first.size()));
  table.text_in(0);
  const auto unit_of = [&](std::size_t i) { return readable_unit(first[i]->peak.value, first[i]->unit); };
  table.only_for_people("largest", [&](std::size_t i) { return first[i]->name; });
  for (const LinkageCycle* c : problems_of(f)) {
    const auto peaks = peaks_of(*c);
    table.only_for_people(c->label, [&](std::size_t i) { return peak_text(peaks[i]->peak, unit_of(i).factor); })
        .only_for_people("at", [&](std::size_t i) { return at_angle(peaks[i]->peak); });
  }
  return table.only_for_people("unit", [&](std::size_t i) { return unit_of(i).unit; });
}

Rows position_table(const LinkageCycle& c) {
  auto table = table_of("", fmt::format("{}: {}", c.label, c.description), c.rows);
  table.headed(fmt::format("{}: {}", c.label, c.description)).text_in(0).always();
  const auto clean = [](double value, double largest) {
    return std::abs(value) < 1e-12 * std::abs(largest) ? 0.0 : value;
  };
  table.only_for_people("φ [°]", [](P p) { return degrees(p.forces.state.phi); }, {.digits = 5})
      .only_for_people("ω [rad/s]", [](P p) { return p.forces.state.omega; })
      .only_for_people("M [N·m]", [&](P p) { return clean(p.forces.torque, c.torque.peak.value); });
  const double largest = heaviest(c).peak.value;
  for (std::size_t k = 0; k < c.rows.front().forces.joints.size(); ++k)
    table.only_for_people(fmt::format("{} [N]", c.rows.front().forces.joints[k].name),
                          [k, clean, largest](P p) { return clean(force_of(p.forces.joints[k]), largest); });
  return table.only_for_people("shaking [N]", [&](P p) { return clean(p.forces.shaking_force.magnitude(), largest); });
}

Rows work_table(const LinkageStudy& f) {
  std::vector<std::size_t> acting;
  for (std::size_t i = 0; i < f.prescribed->work.size(); ++i)
    for (const LinkageCycle* c : problems_of(f))
      if (c->work[i].work != 0 && (acting.empty() || acting.back() != i)) acting.push_back(i);
  auto table = table_of("", "Work done on the mechanism in a cycle", std::move(acting));
  table.text_in(2).always();
  table.only_for_people("work of a cycle", [&](std::size_t i) { return f.prescribed->work[i].name; })
      .only_for_people("line", [&](std::size_t i) { return front_of(f).work[i].kind; });
  for (const LinkageCycle* c : problems_of(f))
    table.only_for_people(c->label, [&](std::size_t i) { return with_error(c->work[i].work, c->work[i].error, ""); });
  return table.only_for_people("unit", [](std::size_t) { return std::string("J"); });
}

Rows harmonic_table(const LinkageCycle& c, bool on_terminal) {
  const auto amplitude = [](const std::vector<ForceHarmonic>& orders) {
    return [&](std::size_t k) { return with_error(orders[k].amplitude, orders[k].error, ""); };
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

Record mean_record(const MeanFigure& m) { return {{"value", m.value}, {"error", m.error}}; }
Record peak_record(const Peak& p) { return {{"value", p.value}, {"error", p.error}, {"phi", p.phi}}; }

Record cycle_record(const LinkageCycle& c) {
  return {{"description", c.description},
          {"cycle", c.cycle},
          {"mean_speed", c.mean_speed.value},
          {"mean_speed_error", c.mean_speed.error},
          {"least_speed", c.least_speed},
          {"greatest_speed", c.greatest_speed},
          {"speed_extremes_error", c.speed_error},
          {"closure", c.closure},
          {"closure_error", c.closure_error},
          {"peaks", each(peaks_of(c),
                         [](const LinkageFigure* p) {
                           return Record{{"name", p->name},
                                         {"value", p->peak.told()},
                                         {"unit", p->unit},
                                         {"error", p->peak.error},
                                         {"phi", p->peak.phi}};
                         })},
          {"links", links_list(c)},
          {"work", each(c.work,
                        [](const CycleWork& w) {
                          return Record{{"name", w.name}, {"line", w.kind}, {"work", w.work}, {"error", w.error}};
                        })},
          {"kinetic_change", c.kinetic_change},
          {"kinetic_change_error", c.kinetic_error},
          {"power_residual", c.power_residual},
          {"equation_residual", c.equation_residual},
          {"machine_residual", c.machine_residual},
          {"harmonics", Record{{"shaking_force_along", order_list(c.shaking_x)},
                               {"shaking_force_across", order_list(c.shaking_y)},
                               {"shaking_moment", order_list(c.shaking_couple)},
                               {"balancing_torque", order_list(c.torque_orders)},
                               {"balancing_torque_mean", c.torque_mean.value},
                               {"balancing_torque_mean_error", c.torque_mean.error}}},
          {"positions", each(c.rows, position_record)}};
}

std::string underscored(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == ',') c = '_';
  return name;
}

std::string csv_of_forces(const LinkageCycle& c, bool rocks) {
  auto csv = csv_of(c.positions);
  csv.column("phi [rad]", [](P p) { return p.forces.state.phi; })
      .column("omega [rad/s]", [](P p) { return p.forces.state.omega; })
      .column("alpha [rad/s2]", [](P p) { return p.forces.state.alpha; })
      .column(rocks ? "output_angle [rad]" : "position_along_x [m]", [](P p) { return p.forces.output; })
      .column(rocks ? "load_on_output [N*m]" : "load_on_output_along_x [N]", [](P p) { return p.forces.state.load; })
      .column("torque_of_shaft_on_crank [N*m]", [](P p) { return p.forces.torque; });
  const LinkageForces& first = c.positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string name = underscored(fmt::format("{} of {} on {}", j.name, j.from, j.on));
    csv.column(name + "_x [N]", [k](P p) { return p.forces.joints[k].force.x; });
    csv.column(name + "_y [N]", [k](P p) { return p.forces.joints[k].force.y; });
    if (j.slides) csv.column(name + "_moment [N*m]", [k](P p) { return p.forces.joints[k].moment; });
  }
  csv.column("shaking_on_frame_x [N]", [](P p) { return p.forces.shaking_force.x; })
      .column("shaking_on_frame_y [N]", [](P p) { return p.forces.shaking_force.y; })
      .column("shaking_on_frame_moment_about_crank_axis [N*m]", [](P p) { return p.forces.shaking_moment; });
  return csv
      .column(
          "power_residual", [](P p) { return p.power.residual; }, 3)
      .text();
}

}  // namespace

List order_list(const std::vector<ForceHarmonic>& orders) {
  return each(orders, [](const ForceHarmonic& h) {
    return Record{{"order", h.order}, {"amplitude", h.amplitude}, {"phase", h.phase}, {"error", h.error}};
  });
}

List links_list(const LinkageCycle& c) {
  return each(c.links, [](const LinkOfCycle& l) {
    return Record{{"name", l.name},
                  {"omega", peak_record(l.omega)},
                  {"alpha", peak_record(l.alpha)},
                  {"inertia_force", peak_record(l.inertia_force)},
                  {"inertia_couple", peak_record(l.inertia_couple)},
                  {"reduced_inertia", mean_record(l.reduced_inertia)},
                  {"inertia_share", mean_record(l.inertia_share)},
                  {"least_share", l.least_share},
                  {"greatest_share", l.greatest_share},
                  {"share_extremes_error", l.share_error},
                  {"energy", mean_record(l.energy)},
                  {"energy_share", mean_record(l.energy_share)}};
  });
}

void say_links(Findings& to, Chapter in, const LinkageCycle& c) {
  using L = const LinkOfCycle&;
  const auto largest = [](Peak LinkOfCycle::*of) {
    return [of](L l) { return with_error((l.*of).value, (l.*of).error, ""); };
  };
  const auto mean = [](MeanFigure LinkOfCycle::*of, double factor) {
    return [of, factor](L l) {
      const MeanFigure& m = l.*of;
      return with_error(factor * m.value, factor * m.error.value_or(0), "");
    };
  };
  to.say(in, table_of("", "Motion and inertia forces of the links, largest over the cycle", c.links)
                 .headed("links: motion and inertia forces, largest over the cycle")
                 .text_in(0)
                 .always()
                 .only_for_people("link", &LinkOfCycle::name)
                 .only_for_people("ω [rad/s]", largest(&LinkOfCycle::omega))
                 .only_for_people("ε [rad/s²]", largest(&LinkOfCycle::alpha))
                 .only_for_people("m a [N]", largest(&LinkOfCycle::inertia_force))
                 .only_for_people("at", [](L l) { return at_angle(l.inertia_force); })
                 .only_for_people("−I ε [N·m]", largest(&LinkOfCycle::inertia_couple)));
  to.say(
      in,
      table_of("", "Shares of the links in the reduced inertia and the kinetic energy", c.links)
          .headed("links: shares in I_r (mean over the angle) and kinetic energy (mean over the time)")
          .text_in(0)
          .always()
          .only_for_people("link", &LinkOfCycle::name)
          .only_for_people("I_r [kg·m²]", mean(&LinkOfCycle::reduced_inertia, 1))
          .only_for_people("of I_r [%]", mean(&LinkOfCycle::inertia_share, 100))
          .only_for_people("least [%]", [](L l) { return with_error(100 * l.least_share, 100 * l.share_error, ""); })
          .only_for_people("most [%]", [](L l) { return with_error(100 * l.greatest_share, 100 * l.share_error, ""); })
          .only_for_people("T [J]", mean(&LinkOfCycle::energy, 1))
          .only_for_people("of T [%]", mean(&LinkOfCycle::energy_share, 100)));
  to.draw(in, [&c] { return link_plots(c); });
}

std::string csv_of_links(const LinkageCycle& c) {
  auto csv = csv_of(c.positions);
  csv.column("phi [rad]", [](P p) { return p.forces.state.phi; });
  for (std::size_t k = 0; k < c.links.size(); ++k) {
    const std::string name = underscored(c.links[k].name);
    const auto column = [&](const std::string& what, auto&& of) {
      csv.column(name + what, [k, of](P p) { return of(p.forces.links[k]); });
    };
    using L = const LinkForces&;
    column("_omega [rad/s]", [](L l) { return l.omega; });
    column("_alpha [rad/s2]", [](L l) { return l.alpha; });
    column("_com_acceleration_x [m/s2]", [](L l) { return l.acceleration.x; });
    column("_com_acceleration_y [m/s2]", [](L l) { return l.acceleration.y; });
    column("_inertia_force_x [N]", [](L l) { return l.inertia_force.x; });
    column("_inertia_force_y [N]", [](L l) { return l.inertia_force.y; });
    column("_inertia_couple [N*m]", [](L l) { return l.inertia_couple; });
    column("_reduced_inertia [kg*m2]", [](L l) { return l.reduced_inertia; });
    column("_kinetic_energy [J]", [](L l) { return l.kinetic_energy; });
  }
  return csv.text();
}

Findings findings_of(const LinkageStudy& f) {
  const LinkageCycle& front = front_of(f);
  Findings to{.title = f.title,
              .subtitle = fmt::format("Kinetostatics by d'Alembert's principle; {}", front.description),
              .page_title = fmt::format("{}: forces in {}", f.title, f.mechanism),
              .scene_file = f.scene_file,
              .speed_unit = f.speed_unit.name,
              .complete = f.complete,
              .diagnosis = f.diagnosis,
              .footer = report_footer()};
  to.answer(f.complete ? Question::figures : Question::runs, conclusion_of(f), f.complete ? 0 : 100);
  for (const LinkageFigure* p : peaks_of(front)) {
    if (p->means == "reaction_moment" && is_nothing(p->peak)) continue;  // a ram that carries none
    to.figures.push_back({"largest " + p->name, p->peak.told(), p->unit, p->peak.error,
                          fmt::format("at φ = {}", at_angle(p->peak)), 0, p->means});
  }
  const Chapter torque = to.chapter("Balancing torque"), reactions = to.chapter("Reactions in the joints (theory 9.6)"),
                polar = to.chapter("Polar diagrams of the joints' loads, in the frame"),
                links = to.chapter("Links: motion, inertia forces, shares"),
                shaking = to.chapter("Shaking force and moment"), works = to.chapter("Work"),
                positions = to.chapter("Position by position"), notes = to.chapter("Notes");
  to.tell("mechanism", f.mechanism);
  to.tell("kind", f.kind);
  to.tell("signs", signs_of(f));
  to.draw(torque, [&f] { return torque_plot(f); });
  to.draw(reactions, [&f] { return reaction_plots(f); });
  to.show(reactions, Text{.title = "Signs and axes", .body = signs_of(f)});
  to.draw(polar, [&f] { return polar_plots(f); });
  to.say(positions, peak_table(f));
  for (const LinkageCycle* c : problems_of(f)) {
    to.say(positions, position_table(*c));
    to.tell(c->label, cycle_record(*c));
    to.csv.push_back(
        {fmt::format("forces_{}.csv", c->label), [c, rocks = f.rocks] { return csv_of_forces(*c, rocks); }});
    to.csv.push_back({fmt::format("links_{}.csv", c->label), [c] { return csv_of_links(*c); }});
  }
  say_links(to, links, front);
  to.say(works, work_table(f));
  to.draw(shaking, [&f] { return shaking_plots(f); });
  for (const LinkageCycle* c : problems_of(f)) to.say(shaking, harmonic_table(*c, c == &front));
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
