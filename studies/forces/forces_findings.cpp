// forces_findings.cpp — words, tables and formulas of the forces of a mechanism.
#include "studies/forces/forces_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/units.h"
#include "studies/claims/headline.h"
#include "studies/findings/figure_text.h"
#include "studies/forces/forces_plots.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {
namespace {

using P = const PositionForces&;

// --- peaks in words: "90.0°", "10.45 kN"; for tables with the error, or "no bound" ---

double degrees(double angle) { return angle * 180 / std::numbers::pi; }
std::string at_angle(const Peak& p) { return fmt::format("{:.1f}°", degrees(p.phi)); }
std::string peak_text(const Peak& p, double factor) { return p.unbounded ? "no bound" : with_error(factor * p, ""); }

Findings begin_findings(const Forces& f, const ForceCycle& front, const std::string& conclusion) {
  Findings to = Findings::of(f, "Kinetostatics by d'Alembert's principle; " + front.description);
  to.page_title = fmt::format("{}: forces in {}", f.title, f.mechanism);
  to.speed_unit = f.speed_unit.name, to.footer = report_footer();
  to.conclude(f.complete, conclusion);
  for (const std::string& sentence : f.outside_data) to.claim(Predicate::outside_data, sentence);
  to.record("mechanism", f.mechanism);
  return to;
}

std::string it(const ForceCycle& c) { return c.repeats ? "cycle" : "range"; }
// " between φ = 30° and 100°" of a crank that rocks.
std::string over_range(const ForceCycle& c) {
  if (c.repeats) return {};
  return fmt::format(" between φ = {:.4g}° and {:.4g}°", degrees(c.begin), degrees(c.begin + c.cycle));
}

// "press at 60 rpm: the main bearing (frame on crank) carries up to 10.45 kN (at 90.0°)", or that reactions have no bound.
std::string begin_conclusion(const Forces& f, const ForceCycle& front) {
  const double range = front.greatest_speed.value - front.least_speed.value;
  const char* const kind = front.assumed_speed ? " (reference speed, which the scene does not state)"
                           : range > 1e-4 * std::abs(front.mean_speed.value) ? " on average"
                                                                             : "";
  const std::string moving = fmt::format("{} at {}{}", f.mechanism, f.speed_unit.text(front.mean_speed.value, 4), kind);
  if (f.unbounded.any()) return begin_unbounded(moving, f.unbounded);
  if (front.reactions.empty()) return moving + ": reactions in its joints are not assessed";
  const NamedPeak& first = front.reactions.front();
  return fmt::format("{}{}: {} carries up to {} (at {})", moving, over_range(front), joint_in_words(first),
                     in_words(first.peak, "N"), at_angle(first.peak));
}

// "peaks at 1.48 kN·m", "is less than 2100 N"
std::string peaks(const Peak& p, const std::string& unit) {
  return (p.error && *p.error >= std::abs(p.value) ? "is " : "peaks at ") + in_words(p, unit);
}

std::string torque_in_words(const ForceCycle& c) {
  if (is_nothing(c.torque)) return "no balancing torque is needed";
  return fmt::format("the balancing torque {} (at {})", peaks(c.torque, "N*m"), at_angle(c.torque));
}

std::string closure_in_words(const ForceCycle& c) {
  if (!c.repeats || std::abs(c.closure.value) < 1e-3) return {};
  return fmt::format("; the motion is not steady: over this cycle the crank's speed changes by {:+.2g} % of its mean",
                     100 * c.closure.value);
}

// The joint with the largest force; null: reactions are not assessed.
const NamedPeak* heaviest(const ForceCycle& c) {
  const NamedPeak* most = nullptr;
  for (const NamedPeak& r : c.reactions)
    if (!most || (r.unit == "N" && std::abs(r.peak.value) > std::abs(most->peak.value))) most = &r;
  return most;
}

// With its error if that is visible.
std::string efficiency_text(const ForceCycle& c) { return with_error(100 * *c.efficiency, "%", headline_digits); }

std::string conclusion_of(const Forces& f) {
  const ForceCycle& c = f.front();
  const NamedPeak* const most = heaviest(c);
  std::string text = begin_conclusion(f, c);
  if (most && most != &c.reactions.front() && !f.unbounded.any() && !f.balancing)
    text += fmt::format(", the heaviest load of a joint is {} on {}, at {}", in_words(most->peak, "N"),
                        joint_in_words(*most), at_angle(most->peak));
  text += ", " + torque_in_words(c);
  if (!is_nothing(c.shaking_force))
    text += ", the shaking force " + peaks(c.shaking_force, "N");
  else if (is_nothing(c.shaking_moment))
    text += ", nothing shakes the frame";
  else
    text += fmt::format(", no force but a moment shakes the frame, up to {}", in_words(c.shaking_moment, "N*m"));
  if (f.friction)
    text += c.efficiency
                ? fmt::format("; efficiency of the {} {}{}", it(c), efficiency_text(c),
                              c.harmful.value > 0 ? fmt::format(", {} of {} lost", with_unit(c.harmful.value, "J", 4),
                                                                with_unit(c.spent, "J", 4))
                                                  : "")
                : fmt::format("; no efficiency of the {}: {}", it(c), c.no_efficiency);
  return text + closure_in_words(c) + ".";
}

std::string signs_of(const Forces& f) {
  const std::vector<JointForces>& joints = f.front().positions.front().forces.joints;
  const std::string of_joints =
      joints.size() < 2
          ? ""
          : fmt::format(
                "“{}: {} on {}” is the force of the first body on the second; the second exerts the "
                "opposite on the first. A slide's force is normal to it, positive 90° ahead of its direction; "
                "its moment is about the pin at which it is given. ",
                joints[1].name, joints[1].from, joints[1].on);
  return fmt::format(
      "Axes of the mechanism: origin on the crank's axis, +x along the {}, +y 90° ahead of it; angles, torques and "
      "moments counter-clockwise. {}The balancing torque is the shaft's on the crank. Shaking force and moment "
      "are those of all inertia forces −m a and couples −I ε on the frame, moments about the crank's axis; loads and "
      "weights are not in them.",
      f.rocks ? "ground link" : "stroke", of_joints);
}

std::string checks_of(const ForceCycle& c) {
  if (c.reactions.empty()) return "the balancing torque is that of the powers, so that these balance";
  std::string text = fmt::format(
      "power balance closes to {:.1e} of the largest power at every position, the links' equilibrium to {:.1e}",
      c.power_residual, c.equation_residual);
  if (c.friction_residual > 0) text += fmt::format("; friction laws hold to {:.1e}", c.friction_residual);
  if (c.both_edges > 0)
    text +=
        fmt::format("; a slide is in contact at both edges at {} of {} positions", c.both_edges, c.positions.size());
  return text;
}

// --- tables ---

KeyFigure key_figure(const NamedPeak& p) {
  const Estimate most{p.peak.reported(), p.peak.error};
  const std::string name = (p.joint.empty() ? "largest " : "largest reaction, ") + p.name;
  return {most, name, p.unit, fmt::format("at φ = {}", at_angle(p.peak)), 0, p.means};
}

RowsOf<std::size_t> peak_table(const Forces& f) {
  std::vector<std::vector<NamedPeak>> of;
  for (const ForceCycle* c : f.problems()) of.push_back(peaks_of(f, *c));
  const std::vector<NamedPeak> first = of.front();
  auto table = table_of("", fmt::format("Largest values over the {}", it(f.front())), numbers_below(first.size()));
  const auto unit_of = [&](std::size_t i) { return readable_unit(first[i].peak.value, first[i].unit); };
  table.text_in(1).only_for_people("largest", [&](std::size_t i) { return first[i].name; });
  for (std::size_t k = 0; k < of.size(); ++k)
    table
        .only_for_people(f.problems()[k]->label,
                         [&](std::size_t i) { return peak_text(of[k][i].peak, unit_of(i).factor); })
        .only_for_people("at", [&](std::size_t i) { return at_angle(of[k][i].peak); });
  return table.only_for_people("unit", [&](std::size_t i) { return unit_of(i).unit; });
}

Rows work_table(const Forces& f) {
  const std::vector<const ForceCycle*> problems = f.problems();
  std::vector<std::size_t> acting;
  for (std::size_t i = 0; i < problems.front()->work.size(); ++i)
    for (const ForceCycle* c : problems)
      if (c->work[i].work.value != 0 && (acting.empty() || acting.back() != i)) acting.push_back(i);
  const std::string_view in_it = problems.front()->in_it();
  auto table = table_of("", fmt::format("Work done on the mechanism {}", in_it), std::move(acting));
  table.text_in(2).always();
  table
      .only_for_people(f.over_a_range ? "work" : "work of a cycle",
                       [&](std::size_t i) { return problems.front()->work[i].name; })
      .only_for_people("line", [&](std::size_t i) { return problems.back()->work[i].kind; });
  for (const ForceCycle* c : problems)
    table.only_for_people(c->label, [&](std::size_t i) { return with_error(c->work[i].work, ""); });
  return table.only_for_people("unit", [](std::size_t) { return std::string("J"); });
}

Rows harmonic_table(const ForceCycle& c, bool on_terminal) {
  const auto amplitude = [](const std::vector<ForceHarmonic>& orders) {
    return [&](std::size_t k) { return with_error(orders[k].amplitude, ""); };
  };
  auto table = table_of("", fmt::format("Amplitudes by order, {} motion", c.label), numbers_below(c.shaking_x.size()))
                   .headed(fmt::format("harmonics, {} motion", c.label))
                   .fold()
                   .always()
                   .only_for_people("order", [&](std::size_t k) { return c.shaking_x[k].order; }, {.digits = 3})
                   .only_for_people("along [N]", amplitude(c.shaking_x))
                   .only_for_people("across [N]", amplitude(c.shaking_y))
                   .only_for_people("moment [N·m]", amplitude(c.shaking_couple))
                   .only_for_people("balancing torque [N·m]", amplitude(c.torque_orders));
  table.terminal = on_terminal;
  return table;
}

// For a slide given in the scene, the table states where its reaction acts.
bool is_given(const Forces& f, const JointForces& j) {
  const std::vector<RubbingJoint>& given = f.joints.joints;
  return std::any_of(given.begin(), given.end(), [&](const RubbingJoint& r) { return r.name == j.name; });
}

Rows position_table(const Forces& f, const ForceCycle& c) {
  auto table = table_of("", fmt::format("{}: {}", c.label, c.description), c.rows);
  table.headed(fmt::format("{}: {}", c.label, c.description)).text_in(0).always();
  // A dead centre is located within rounding of its angle.
  const auto or_nothing = [](double value, double peak) {
    return std::abs(value) < 1e-9 * std::abs(peak) ? 0.0 : value;
  };
  table.only_for_people("φ [°]", [](P p) { return degrees(p.forces.state.phi); }, {.digits = 5})
      .only_for_people("ω [" + f.speed_unit.name + "]", [&f](P p) { return f.speed_unit.of(p.forces.state.omega); })
      .only_for_people("M [N·m]", [&, or_nothing](P p) { return or_nothing(p.forces.torque, c.torque.value); });
  const double largest = c.reactions.empty() ? c.shaking_force.value : heaviest(c)->peak.value;
  const std::vector<JointForces>& joints = c.rows.front().forces.joints;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const JointForces& j = joints[k];
    table.only_for_people(heading_of(joints, j) + " [N]",
                          [k, largest, or_nothing](P p) { return or_nothing(force_of(p.forces.joints[k]), largest); });
    if (j.slides && is_given(f, j))
      table.only_for_people("at [mm]",
                            [k, largest, or_nothing](P p) {
                              const JointForces& j = p.forces.joints[k];
                              return or_nothing(force_of(j), largest) == 0 ? std::nan("") : j.point();
                            },
                            {.factor = 1e3, .digits = 4, .otherwise = "a couple"});
  }
  table.only_for_people("shaking [N]",
                        [&, or_nothing](P p) { return or_nothing(p.forces.shaking_force.magnitude(), largest); });
  if (f.friction)
    table.only_for_people("η", [](P p) {
      return p.power.efficiency() ? fmt::format("{:.4f}", *p.power.efficiency()) : std::string("—");
    });
  return table;
}

Rows counterweight_table(const Forces& f) {
  return table_of("counterweights", "Counterweights beyond what the crank has: what they leave",
                  f.balancing->counterweights)
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

void say_links(Findings& to, Chapter in, const Forces& f, const ForceCycle& c) {
  const auto shown = [](auto LinkOfCycle::*of, double k = 1) {
    return [=](const LinkOfCycle& l) { return with_error(k * (l.*of), ""); };
  };
  const auto percent = [](auto LinkOfCycle::*of) {
    return [of](const LinkOfCycle& l) {
      const Estimate share = 100.0 * (l.*of);  // [%]
      return share.value < std::max(0.001, share.error.value_or(0)) ? std::string("0")
                                                                    : fmt::format("{:.4g}", share.value);
    };
  };
  to.say(in, table_of("", "Motion and inertia forces of the links, largest over the " + it(c), c.links)
                 .not_on_terminal()
                 .text_in(0)
                 .always()
                 .only_for_people("link", &LinkOfCycle::name)
                 .only_for_people("ω [" + f.speed_unit.name + "]", shown(&LinkOfCycle::omega, f.speed_unit.of(1)))
                 .only_for_people("ε [rad/s²]", shown(&LinkOfCycle::alpha))
                 .only_for_people("m a [N]", shown(&LinkOfCycle::inertia_force))
                 .only_for_people("at", [](const LinkOfCycle& l) { return at_angle(l.inertia_force); })
                 .only_for_people("−I ε [N·m]", shown(&LinkOfCycle::inertia_couple)));
  to.say(in, table_of("", "Shares of the links in the reduced inertia and the kinetic energy", c.links)
                 .not_on_terminal()
                 .text_in(0)
                 .always()
                 .only_for_people("link", &LinkOfCycle::name)
                 .only_for_people("I_r [kg·m²]", shown(&LinkOfCycle::reduced_inertia))
                 .only_for_people("of I_r [%]", percent(&LinkOfCycle::inertia_share))
                 .only_for_people("least [%]", percent(&LinkOfCycle::least_share))
                 .only_for_people("most [%]", percent(&LinkOfCycle::greatest_share))
                 .only_for_people("T [J]", shown(&LinkOfCycle::energy))
                 .only_for_people("of T [%]", percent(&LinkOfCycle::energy_share)));
  to.draw(in, [&c] { return link_plots(c); });
}

// --- formulas ---

// With the numbers of the peak.
Formulas torque_formula(const Forces& f) {
  const PositionForces& peak = f.front().at_torque_peak;
  const LinkageForces& at = peak.forces;
  const double w = at.state.omega, by = w != 0 ? 1 / w : 0;
  double slope = 0;
  for (const LinkForces& l : at.links) slope += l.reduced_inertia_rate;
  const bool within = !at.state.applied.empty();  // springs, dampers, forces and couples
  const double power_within = at.load_power - at.state.load * at.output_velocity;
  return Formulas()
      .add(
          fmt::format("At its peak, φ = {:.4g}° (theory 9.7)", degrees(at.state.phi)),
          fmt::format("M = I_r ε + ½ I_r′ ω² − M_g − F x′{} + P_f/ω", within ? " − M_i" : ""),
          "M = {:.5g} · ({:.5g}) + ½ · ({:.5g}) · ({:.5g})² − ({:.5g}) − ({:.5g}) · ({:.5g}){} + ({:.5g}) = {:.6g} N·m",
          at.reduced_inertia, at.state.alpha, slope, w, by * at.weight_power, at.state.load, by * at.output_velocity,
          within ? fmt::format(" − ({:.5g})", by * power_within) : "", by * peak.power.friction, at.torque)
      .note(fmt::format("I_r reduced inertia, M_g torque of the weights, F load on the output, {}P_f power lost in the "
                        "joints; SI units. Reactions come from the equilibrium of each link, this formula from energy: "
                        "they agree to the power balance below.",
                        within ? "M_i torque of the springs, dampers, forces and couples within the linkage, " : ""));
}

Formulas mass_formula(const Forces& f) {
  const SliderCrankData& d = f.balancing->data;
  const double share = d.rod_com / d.rod_length;
  return Formulas()
      .add("Masses that rotate and that reciprocate (theory 9.11)",
           "U_rot = m₁ s₁ + m₂ (1 − c/l) r,   m_rec = m₃ + m₂ c/l",
           "U_rot = {:.5g} · ({:.5g}) + {:.5g} · (1 − {:.4g}) · {:.5g} = {:.5g} kg·m,   m_rec = {:.5g} + {:.5g} · "
           "{:.4g} = {:.5g} kg",
           d.crank_mass, d.crank_com, d.rod_mass, share, d.radius, f.balancing->rotating_moment, d.slider_mass,
           d.rod_mass, share, f.balancing->reciprocating_mass)
      .note(
          "A counterweight U = U_rot balances the rotating masses; each κ m_rec r more takes κ of the first order "
          "along the stroke and puts it across. A negative U is taken off, or set on the pin's side.");
}

void show_efficiency(Findings& to, Chapter in, const ForceCycle& c) {
  if (c.efficiency)
    to.show(in, Formulas()
                    .add(fmt::format("Efficiency of the {}, {} motion", it(c), c.label), "η = A_useful / (A_in − ΔT)",
                         "η = {:.6g} J / {:.6g} J = {:.6g}", c.useful.value, c.spent, c.efficiency->value)
                    .note(fmt::format("{}. Harmful work {:.4g} J, kinetic energy gained {:.4g} J.", efficiency_text(c),
                                      c.harmful.value, or_zero(c.kinetic_change.value, 1e3 * c.spent))));
  else
    to.show(in, Text{.title = fmt::format("No efficiency of the {}, {} motion", it(c), c.label),
                     .body = c.no_efficiency + "."});
}

void show_friction_circle(Findings& to, Chapter in, const RubbingJoint& j) {
  if (j.radius == 0) return;
  const double f_k = j.friction.kinetic;
  to.show(in, Formulas().add(fmt::format("Friction circle of the {} (theory 8.4)", j.name), "ρ = r sin(atan f)",
                             "ρ = {:.5g} mm · sin(atan {:.4g}) = {:.5g} mm", 1e3 * j.radius, f_k,
                             1e3 * friction_circle_radius(j.radius, f_k)));
}

void say_films(Findings& to, Chapter in, const Forces& f) {
  if (f.films.empty()) return;
  for (const PinFilm& p : f.films)
    to.figures.push_back({p.parameter, "least film parameter of the " + p.joint, "",
                          fmt::format("{}; at φ = {:.1f}°", p.words(), degrees(p.phi)), 0, "film_parameter"});
  to.say(in, table_of("films",
                      fmt::format("Oil films of the pins, least over the {}, {} motion (theory 8.16)", it(f.front()),
                                  f.front().label),
                      f.films)
                 .headed("oil films of the pins")
                 .text_in(0)
                 .always()
                 .column("joint", "pin", &PinFilm::joint)
                 .column("load", "load [N]", &PinFilm::load)
                 .column("sliding_speed", "sliding speed [m/s]", &PinFilm::speed,
                         [](double v) { return read_as(std::abs(v) < 1e-9 ? 0.0 : v); })
                 .only_for_programs("film", &PinFilm::film)
                 .only_for_people("film [µm]", [](const PinFilm& p) { return with_error(1e6 * p.film, ""); })
                 .estimate("film_parameter", "λ", &PinFilm::parameter)
                 .column("boundary", "boundary λ < 1", &PinFilm::boundary, {.digits = 3})
                 .column("mixed", "mixed λ < 3", &PinFilm::mixed, {.digits = 3})
                 .column("friction", "friction", [](const PinFilm& p) { return p.words(); }));
}

// --- all of it ---

void say_positions(Findings& to, Chapter in, const Forces& f) {
  to.say(in, peak_table(f));
  for (const ForceCycle* c : f.problems()) {
    to.say(in, position_table(f, *c));
    to.say(in, Sentences{.lines = {checks_of(*c)}, .indent = "  ", .page = false});
    to.show(in, Text{.title = "", .body = fmt::format("Check: {}.", checks_of(*c))});
    to.record(c->label, cycle_record(f, *c));
    to.tables.push_back({"forces_" + c->label, [c, &f] { return table_of_forces(f, *c); }});
    to.tables.push_back({"links_" + c->label, [c] { return table_of_links(*c); }});
  }
}

void say_work(Findings& to, Chapter in, const Forces& f) {
  to.say(in, work_table(f));
  show_efficiency(to, in, f.front());
  if (!f.friction) {
    to.show(in, Text{.title = "",
                     .body = "The joints are without friction: give them radii and coefficients of friction in the "
                             "scene to count it."});
    return;
  }
  to.draw(in, [&f] { return friction_plots(f); });
  for (const RubbingJoint& joint : f.joints.joints) show_friction_circle(to, in, joint);
}

void say_shaking(Findings& to, Chapter in, const Forces& f) {
  const std::string x = f.rocks ? "the ground link" : "the stroke";
  to.draw(in, [&f, x] { return shaking_plots(f, "along " + x, "across " + x); });
  for (const ForceCycle* c : f.problems()) {
    if (!c->repeats) continue;
    to.draw(in, [c] { return harmonic_plot(*c); });
    to.say(in, harmonic_table(*c, c == &f.front()));
  }
  if (!f.balancing) return;
  to.draw(in, [&f] { return counterweight_plot(f); });
  to.say(in, counterweight_table(f));
  to.show(in, mass_formula(f));
  to.record("rotating_moment", f.balancing->rotating_moment);
  to.record("reciprocating_mass", f.balancing->reciprocating_mass);
}

}  // namespace

Findings findings_of(const Forces& f) {
  const ForceCycle& front = f.front();
  Findings to = begin_findings(f, front, conclusion_of(f));
  for (const NamedPeak& p : peaks_of(f, front))
    if (p.means != "reaction_moment" || !is_nothing(p.peak)) to.figures.push_back(key_figure(p));  // a ram carries none
  const Chapter torque = to.chapter("Balancing torque"), reactions = to.chapter("Reactions in the joints (theory 9.6)"),
                links = to.chapter("Links: motion, inertia forces, shares"),
                polar = to.chapter("Polar diagrams of the joints' loads"),
                shaking = to.chapter(f.balancing ? "Shaking force and moment; balancing" : "Shaking force and moment"),
                work = to.chapter("Work, friction, efficiency"), positions = to.chapter("Position by position"),
                notes = to.chapter("Notes");
  to.record("kind", f.kind);
  to.record("signs", signs_of(f));
  to.draw(torque, [&f] { return torque_plot(f); });
  to.show(torque, torque_formula(f));
  to.draw(reactions, [&f] { return reaction_plots(f); });
  to.show(reactions, Text{.title = "Signs and axes", .body = signs_of(f)});
  if (!front.reactions.empty())
    to.show(
        polar,
        Text{.title = "",
             .body = "The curve joins the tips of the load vector. It shows where shell and housing are pressed or, "
                     "in axes of a link, its pin or bore; place no oil hole there."});
  to.draw(polar, [&f] { return polar_plots(f); });
  say_positions(to, positions, f);
  say_work(to, work, f);
  say_films(to, work, f);
  say_shaking(to, shaking, f);
  say_links(to, links, f, front);
  to.record("links", links_list(front));
  std::vector<std::string> remarks = f.about;
  remarks.insert(remarks.end(), f.notes.begin(), f.notes.end());
  to.note(notes, remarks);
  to.show_scene(f.scene_file, f.scene_text);
  return to;
}

}  // namespace kurbel
