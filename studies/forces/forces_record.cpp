// forces_record.cpp — forces of a cycle for programs and for files; those of a slider-crank by the names of its joints, too.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/findings/figure_text.h"
#include "studies/forces/forces_findings.h"

namespace kurbel {
namespace {

using P = const PositionForces&;

Record force_record(Force2 force) {
  return {{"x", force.x}, {"y", force.y}, {"magnitude", force.magnitude()}, {"direction", force.direction()}};
}
Record components_of(Force2 f) { return {{"x", f.x}, {"y", f.y}}; }
Record peak_record(const Peak& p) { return {{"value", p.value}, {"error", p.error}, {"phi", p.phi}}; }

std::string underscored(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == ',') c = '_';
  return name;
}

// --- a slider-crank: its joints and links in their order ---

constexpr std::size_t main_bearing = 0, crank_pin = 1, slider_pin = 2, guide = 3;

void add_slider_crank(P p, Record& to) {
  const std::vector<JointForces>& joints = p.forces.joints;
  const std::vector<LinkForces>& links = p.forces.links;
  const JointForces& g = joints[guide];
  const Record rest = {{"position", p.forces.output},
                       {"velocity", p.forces.output_velocity},
                       {"slider_force", p.forces.state.load},
                       {"main_bearing", force_record(joints[main_bearing].force)},
                       {"crank_pin", force_record(joints[crank_pin].force)},
                       {"slider_pin", force_record(joints[slider_pin].force)},
                       {"guide", Record{{"normal", g.normal},
                                        {"point", g.point()},
                                        {"moment", g.moment},
                                        {"friction", g.friction},
                                        {"both_edges", g.both_edges},
                                        {"edge_front", g.edge_front},
                                        {"edge_back", g.edge_back}}},
                       {"inertia", Record{{"crank", force_record(links[0].inertia_force)},
                                          {"rod", force_record(links[1].inertia_force)},
                                          {"slider", force_record(links[2].inertia_force)},
                                          {"crank_couple", links[0].inertia_couple},
                                          {"rod_couple", links[1].inertia_couple}}},
                       {"friction_power", each(joints, [](const JointForces& j) { return j.friction_power; })}};
  to.insert(to.end(), rest.begin(), rest.end());
}

// --- any mechanism ---

Record position_record(const Forces& study, P p) {
  const LinkageForces& f = p.forces;
  Record r = {{"phi", f.state.phi},
              {"omega", f.state.omega},
              {"alpha", f.state.alpha},
              {"load", f.state.load},
              {"output", f.output},
              {"output_velocity", f.output_velocity},
              {"torque", f.torque},
              {"joints", each(f.joints,
                              [](const JointForces& j) {
                                return Record{{"name", j.name},         {"from", j.from}, {"on", j.on},
                                              {"x", j.force.x},         {"y", j.force.y}, {"moment", j.moment},
                                              {"friction", j.friction}, {"at_x", j.at.x}, {"at_y", j.at.y}};
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
              {"shaking_force", force_record(f.shaking_force)},
              {"shaking_moment", f.shaking_moment},
              {"efficiency", p.power.efficiency()},
              {"friction_residual", f.friction_residual},
              {"power_residual", p.power.residual}};
  if (study.balancing) add_slider_crank(p, r);
  return r;
}

List order_list(const std::vector<ForceHarmonic>& orders) {
  return each(orders, [](const ForceHarmonic& h) {
    return Record{
        {"order", h.order}, {"amplitude", h.amplitude.value}, {"phase", h.phase}, {"error", h.amplitude.error}};
  });
}

}  // namespace

std::string heading_of(const std::vector<JointForces>& joints, const JointForces& j) {
  const std::string name(j.name);
  const auto alike = std::count_if(joints.begin(), joints.end(), [&](const JointForces& o) { return name == o.name; });
  return alike > 1 ? fmt::format("{}: {} on {}", name, j.from, j.on) : name;
}

bool is_nothing(const Peak& p) {
  constexpr double negligible = 1e-6;
  return std::abs(p.value) <= p.error.value_or(0) && p.error.value_or(0) <= negligible * p.scale;
}

std::string in_words(const Peak& p, const std::string& si_unit) {
  const ReadableUnit unit = readable_unit(p.value, si_unit);
  if (std::abs(p.value) <= p.error.value_or(0) &&
      !is_nothing(p))  // not distinguished from zero: alone it would say too much
    return with_error(unit.factor * p, unit.unit);
  return fmt::format("{:.4g} {}", unit.factor * p.value, unit.unit);
}

double or_zero(double value, double largest) { return std::abs(value) < 1e-12 * std::abs(largest) ? 0.0 : value; }

std::string joint_in_words(const NamedPeak& reaction) {
  const char* const article = reaction.joint.starts_with("pin ") ? "" : "the ";
  return fmt::format("{}{} ({})", article, reaction.joint, reaction.between);
}

std::vector<NamedPeak> peaks_of(const Forces& f, const ForceCycle& c) {
  std::vector<NamedPeak> peaks;
  for (const NamedPeak& r : c.reactions) {
    if (f.balancing && r.means == "reaction_moment") continue;
    peaks.push_back(r);
    if (f.balancing) peaks.back().name = "reaction of the " + r.joint, peaks.back().joint.clear();
  }
  peaks.push_back({"balancing torque", "N*m", "balancing_torque", c.torque});
  peaks.push_back({"shaking force", "N", "shaking_force", c.shaking_force});
  peaks.push_back({"shaking moment", "N*m", "shaking_moment", c.shaking_moment});
  return peaks;
}

Record cycle_record(const Forces& study, const ForceCycle& c) {
  Record r = {
      {"description", c.description},
      {"cycle", c.cycle},
      {"mean_speed", c.mean_speed},
      {"least_speed", c.least_speed.value},
      {"greatest_speed", c.greatest_speed.value},
      {"speed_extremes_error", larger_error(c.least_speed, c.greatest_speed)},
      {"closure", c.closure},
      {"peaks", each(peaks_of(study, c),
                     [](const NamedPeak& p) {
                       return Record{{"name", p.name},
                                     {"value", p.peak.reported()},
                                     {"unit", p.unit},
                                     {"error", p.peak.error},
                                     {"phi", p.peak.phi}};
                     })},
      {"links", links_list(c)},
      {"work",
       each(c.work,
            [](const CycleWork& w) {
              return Record{{"name", w.name}, {"line", w.kind}, {"work", w.work.value}, {"error", w.work.error}};
            })},
      {"kinetic_change", c.kinetic_change},
      {"power_residual", c.power_residual},
      {"equation_residual", c.equation_residual},
      {"friction_residual", c.friction_residual},
      {"machine_residual", c.machine_residual},
      {"harmonics", Record{{"shaking_force_along", order_list(c.shaking_x)},
                           {"shaking_force_across", order_list(c.shaking_y)},
                           {"shaking_moment", order_list(c.shaking_couple)},
                           {"balancing_torque", order_list(c.torque_orders)},
                           {"balancing_torque_mean", c.torque_mean}}}};
  const auto report = [&](const char* key, Value value) { r.push_back({key, std::move(value)}); };
  if (c.efficiency)
    report("efficiency", *c.efficiency);
  else
    report("efficiency", Value()), report("no_efficiency", c.no_efficiency);
  report("work_in", c.input.value);
  report("work_useful", c.useful.value);
  report("work_harmful", c.harmful.value);
  report("works_error", larger_error(c.input, {0, larger_error(c.useful, c.harmful)}));
  report("positions_on_both_edges", c.both_edges);
  if (!c.repeats) report("begin", c.begin);
  report("positions", each(c.rows, [&](P p) { return position_record(study, p); }));
  return r;
}

DataTable table_of_forces(const Forces& study, const ForceCycle& c) {
  const bool crank = study.balancing.has_value(), rocks = study.rocks;
  auto data = data_of(c.positions);
  data.in_file("phi", "rad", [](P p) { return p.forces.state.phi; })
      .in_file("omega", "rad/s", [](P p) { return p.forces.state.omega; })
      .in_file("alpha", "rad/s2", [](P p) { return p.forces.state.alpha; })
      .in_file(rocks ? "output_angle" : "position_along_x", rocks ? "rad" : "m", [](P p) { return p.forces.output; })
      .in_file(rocks ? "output_speed" : "velocity", rocks ? "rad/s" : "m/s",
               [](P p) { return p.forces.output_velocity; })
      .in_file(crank   ? "slider_force_along_x"
               : rocks ? "load_on_output"
                       : "load_on_output_along_x",
               rocks ? "N*m" : "N", [](P p) { return p.forces.state.load; })
      .in_file("torque_of_shaft_on_crank", "N*m", [](P p) { return p.forces.torque; });
  const LinkageForces& first = c.positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string name = underscored(fmt::format("{} of {} on {}", j.name, j.from, j.on));
    data.in_file(name + "_x", "N", [k](P p) { return p.forces.joints[k].force.x; });
    data.in_file(name + "_y", "N", [k](P p) { return p.forces.joints[k].force.y; });
    if (j.slides) data.in_file(name + "_moment", "N*m", [k](P p) { return p.forces.joints[k].moment; });
  }
  if (crank)
    data.in_file("guide_point_from_pin_x", "m", [](P p) { return p.forces.joints[guide].point(); })
        .in_file("guide_friction_on_slider_x", "N", [](P p) { return p.forces.joints[guide].friction; })
        .in_file("both_edges", {}, [](P p) { return static_cast<int>(p.forces.joints[guide].both_edges); });
  data.in_file("shaking_on_frame_x", "N", [](P p) { return p.forces.shaking_force.x; })
      .in_file("shaking_on_frame_y", "N", [](P p) { return p.forces.shaking_force.y; })
      .in_file("shaking_on_frame_moment_about_crank_axis", "N*m", [](P p) { return p.forces.shaking_moment; });
  for (const RubbingJoint& joint : study.joints.joints)
    data.in_file("friction_" + (joint.name == "main bearing" ? "main" : underscored(joint.name)), "W",
                 [name = joint.name](P p) { return p.forces.friction_loss(name); });
  return data.in_file("efficiency", {}, [](P p) { return p.power.efficiency(); })
      .in_file(
          "power_residual", {}, [](P p) { return p.power.residual; }, 3)
      .data();
}

List links_list(const ForceCycle& c) {
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

DataTable table_of_links(const ForceCycle& c) {
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

}  // namespace kurbel
