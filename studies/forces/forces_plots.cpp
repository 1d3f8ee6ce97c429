// forces_plots.cpp — curves over the angle of the crank, tips of forces over the cycle, orders.
#include "studies/forces/forces_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "engine/numerics/angles.h"

namespace kurbel {
namespace {

using P = const PositionForces&;
using ValueAt = std::function<double(P)>;
using ForceAt = std::function<Force2(P)>;

// A motion that a plot draws.
struct ForceCurve {
  const ForceCycle* cycle;
  const char* name;
  Role role;
};

// In drawing order: the rigid machine behind, the machine itself in front.
std::vector<ForceCurve> curves_of(const Forces& f) {
  std::vector<ForceCurve> curves;
  if (f.rigid) curves.push_back({&*f.rigid, "simulated, rigid", Role::rigid});
  if (f.prescribed) curves.push_back({&*f.prescribed, "prescribed: constant speed", Role::reference});
  if (f.simulated)
    curves.push_back({&*f.simulated, f.elastic ? "simulated, elastic" : "simulated, rigid",
                      f.elastic ? Role::elastic : Role::rigid});
  return curves;
}

Plot angle_plot(const std::string& title, const std::string& quantity) {
  return {.title = title, .x = {"crank angle", "°"}, .y = {quantity, ""}};
}

// Of positions, where it is finite.
Series over_angle(const std::string& name, Role role, const ForceCycle& cycle, const ValueAt& value) {
  Series series{.name = name, .role = role};
  for (P p : cycle.curve)
    if (const double v = value(p); std::isfinite(v)) series.add(in_degrees * p.forces.state.phi, v);
  return series;
}
// Of all motions of a study, in the unit in which it reads easily; without a unit as it is.
Plot over_angle(const Forces& f, const std::string& title, const std::string& quantity, const std::string& unit,
                const ValueAt& value) {
  Plot plot = angle_plot(title, quantity);
  for (const ForceCurve& c : curves_of(f)) plot.series.push_back(over_angle(c.name, c.role, *c.cycle, value));
  return unit.empty() ? plot : in_readable_unit(std::move(plot), unit);
}

// Equal axes, both in the unit in which forces up to `largest` read easily.
Plot in_forces(Plot plot, double largest) {
  const double factor = readable_unit(largest, "N").factor;
  plot = in_readable_unit(std::move(plot), "N", largest);
  plot.x.unit = plot.y.unit;
  for (Series& s : plot.series)
    for (double& v : s.x) v *= factor;
  plot.equal_axes = true;
  return plot;
}

// Locus of a force's tip over the cycle.
Plot locus(const Forces& f, const std::string& title, const std::string& x, const std::string& y,
           const ForceAt& force) {
  Plot plot{.title = title, .x = {x, ""}, .y = {y, ""}};
  double largest = 0;
  for (const ForceCurve& c : curves_of(f)) {
    Series& s = plot.series.emplace_back(Series{.name = c.name, .role = c.role});
    for (P p : c.cycle->curve) {
      const Force2 v = force(p);
      s.add(v.x, v.y);
      largest = std::max(largest, v.magnitude());
    }
  }
  return in_forces(std::move(plot), largest);
}

// Where the reaction of a slide acts that the scene gives.
Plot point_plot(const Forces& f, std::size_t joint, const RubbingJoint& given) {
  Plot plot = angle_plot(fmt::format("Where the reaction of the {} acts, along it from its pin", given.name),
                         "point of action");
  plot.note = "Beyond its ends both edges are in contact.";
  // Where N passes through zero the point goes to infinity: it is omitted if it is farther beyond the ends than these
  // are apart.
  double crank = 0;
  for (P p : f.prescribed->positions) crank = std::max(crank, p.forces.joints[1].at.magnitude());
  const double reach = given.length > 0 ? 1.5 * given.length : 3 * crank;
  for (const ForceCurve& c : curves_of(f))
    plot.series.push_back(over_angle(c.name, c.role, *c.cycle, [&](P p) {
      const double point = p.forces.joints[joint].point();
      return std::abs(point - given.middle) < reach ? point : std::nan("");
    }));
  if (given.length > 0)
    for (const int side : {1, -1})
      plot.series.push_back(dashed(over_angle(side > 0 ? "its ends" : "", Role::reference, f.front(),
                                              [&](P) { return given.middle + side * 0.5 * given.length; })));
  return in_readable_unit(std::move(plot), "m");
}

Plot link_plot(const ForceCycle& c, const std::string& title, const std::string& quantity, const std::string& unit,
               const std::function<double(const LinkForces&)>& of) {
  Plot plot = angle_plot(title, quantity);
  for (std::size_t k = 0; k < c.links.size(); ++k)
    plot.series.push_back(
        over_angle(c.links[k].name, further_role(k), c, [&, k](P p) { return of(p.forces.links[k]); }));
  return in_readable_unit(std::move(plot), unit);
}

// Of a link's name; none: the frame.
std::optional<std::size_t> link_named(const LinkageForces& f, std::string_view name) {
  for (std::size_t i = 0; i < f.links.size(); ++i)
    if (f.links[i].name == name) return i;
  return {};
}

bool turns(const ForceCycle& c, std::size_t link) {
  return std::any_of(c.positions.begin(), c.positions.end(), [&](P p) { return p.forces.links[link].omega != 0; });
}

}  // namespace

double force_of(const JointForces& j) { return j.slides ? j.normal : j.force.magnitude(); }

Plot torque_plot(const Forces& f) {
  return over_angle(f, "Torque that the shaft must give the crank", "balancing torque M", "N*m",
                    [](P p) { return p.forces.torque; });
}

std::vector<Plot> reaction_plots(const Forces& f) {
  std::vector<Plot> plots;
  const LinkageForces& first = f.prescribed->positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string what = fmt::format("{}: {} on {}", j.name, j.from, j.on);
    plots.push_back(over_angle(f, j.slides ? what + ", positive 90° ahead of the slide" : what,
                               j.slides ? "normal force" : "force", "N",
                               [k](P p) { return force_of(p.forces.joints[k]); }));
    if (!j.slides) continue;
    Plot moment =
        over_angle(f, what + ", about the pin", "moment", "N*m", [k](P p) { return p.forces.joints[k].moment; });
    if (largest_of(moment) > 0) plots.push_back(std::move(moment));
    for (const RubbingJoint& given : f.joints.joints)
      if (given.name == j.name) plots.push_back(point_plot(f, k, given));
  }
  return plots;
}

std::vector<Plot> polar_plots(const Forces& f) {
  std::vector<Plot> plots;
  const LinkageForces& first = f.prescribed->positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    if (j.slides) continue;
    plots.push_back(locus(f, fmt::format("{}: {} on {}, in the frame", j.name, j.from, j.on),
                          f.rocks ? "along the ground link" : "along the stroke", "across",
                          [k](P p) { return p.forces.joints[k].force; }));
    for (const auto& [by, to, sense] : {std::tuple(j.from, j.on, 1.0), std::tuple(j.on, j.from, -1.0)})
      if (const auto link = link_named(first, to); link && turns(*f.prescribed, *link))
        plots.push_back(locus(f, fmt::format("{}: {} on {}, in axes of the {}", j.name, by, to, to),
                              fmt::format("along the {}", to), "ahead of it", [k, i = *link, s = sense](P p) {
                                return (s * p.forces.joints[k].force).seen_from(p.forces.links[i].direction);
                              }));
  }
  return plots;
}

std::vector<Plot> shaking_plots(const Forces& f, const std::string& along, const std::string& across) {
  return {
      over_angle(f, "Shaking force on the frame " + along, "force", "N", [](P p) { return p.forces.shaking_force.x; }),
      over_angle(f, "Shaking force on the frame " + across, "force", "N", [](P p) { return p.forces.shaking_force.y; }),
      over_angle(f, "Shaking moment on the frame about the crank's axis", "moment", "N*m",
                 [](P p) { return p.forces.shaking_moment; })};
}

Plot harmonic_plot(const ForceCycle& c) {
  const auto bars = [](const char* name, Role role, const std::vector<ForceHarmonic>& orders) {
    return series_of(name, role, orders, &ForceHarmonic::order,
                     [](const ForceHarmonic& h) { return h.amplitude.value; });
  };
  return {.title = fmt::format("Orders of the shaking force, {} motion", c.label),
          .x = {"order of the crank's turn", ""},
          .y = {"amplitude", "N"},
          .series = {bars("along the stroke", Role::elastic, c.shaking_x), bars("across", Role::orange, c.shaking_y)},
          .bars = true};
}

Plot counterweight_plot(const Forces& f) {
  Plot plot{.title = "Shaking force before and after balancing, at constant speed",
            .x = {"along the stroke", ""},
            .y = {"across", ""},
            .note = "Tip of the force on the frame over a turn."};
  double largest = 0;
  for (const Counterweight& c : f.balancing->counterweights) {
    largest = std::max(largest, c.peak_force.value);
    const std::size_t i = plot.series.size();
    plot.series.push_back(
        series_of(c.name, i == 0 ? Role::reference : further_role(i - 1), c.shaking, &Force2::x, &Force2::y));
    plot.series.back().dashed = i == 0;
  }
  return in_forces(std::move(plot), largest);
}

std::vector<Plot> friction_plots(const Forces& f) {
  Plot power = angle_plot("Power lost in the joints", "power");
  for (std::size_t k = 0; k < f.joints.joints.size(); ++k)
    power.series.push_back(over_angle(f.joints.joints[k].name, further_role(k), f.front(),
                                      [&](P p) { return p.forces.friction_loss(f.joints.joints[k].name); }));
  return {in_readable_unit(std::move(power), "W"),
          over_angle(f, "Efficiency of the mechanism at each position", "η", "",
                     [](P p) { return p.power.efficiency().value_or(std::nan("")); })};
}

std::vector<Plot> link_plots(const ForceCycle& c) {
  return {
      link_plot(c, "Angular velocities of the links", "ω", "rad/s", [](const LinkForces& l) { return l.omega; }),
      link_plot(c, "Angular accelerations of the links", "ε", "rad/s2", [](const LinkForces& l) { return l.alpha; }),
      link_plot(c, "Inertia forces of the links, by magnitude", "m a", "N",
                [](const LinkForces& l) { return l.inertia_force.magnitude(); }),
      link_plot(c, "Inertia couples of the links about their centres of mass", "−I ε", "N*m",
                [](const LinkForces& l) { return l.inertia_couple; }),
      link_plot(c, "Parts of the links in the reduced inertia", "I_r", "kg*m2",
                [](const LinkForces& l) { return l.reduced_inertia; })};
}

}  // namespace kurbel
