// linkage_plots.cpp — curves over the angle of the crank, and tips of forces over the cycle.
#include "studies/forces/linkage_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/numerics/angles.h"
#include "studies/findings/plots.h"
#include "studies/forces/forces_plots.h"

namespace kurbel {
namespace {

using P = const PositionForces&;
using Quantity = std::function<double(P)>;

Series over_angle(const std::string& name, Role role, const LinkageCycle& c, const Quantity& value) {
  return series_of(
      name, role, c.curve, [](P p) { return in_degrees * p.forces.state.phi; }, value);
}

Plot both(const LinkageStudy& f, const std::string& title, const std::string& quantity, const std::string& unit,
          const Quantity& value) {
  Plot plot{.title = title, .x = {"crank angle", "°"}, .y = {quantity, ""}};
  for (const auto& c : force_curves_of(f)) plot.series.push_back(over_angle(c.name, c.role, *c.cycle, value));
  return in_readable_unit(std::move(plot), unit);
}

Plot link_plot(const LinkageCycle& c, const std::string& title, const std::string& quantity, const std::string& unit,
               const std::function<double(const LinkForces&)>& of) {
  Plot plot{.title = title, .x = {"crank angle", "°"}, .y = {quantity, ""}};
  for (std::size_t k = 0; k < c.links.size(); ++k)
    plot.series.push_back(
        over_angle(c.links[k].name, further_role(k), c, [&, k](P p) { return of(p.forces.links[k]); }));
  return in_readable_unit(std::move(plot), unit);
}

}  // namespace

double force_of(const JointForces& j) { return j.slides ? j.normal : j.force.magnitude(); }

Plot torque_plot(const LinkageStudy& f) {
  return both(f, "Torque that the shaft must give the crank", "balancing torque M", "N*m",
              [](P p) { return p.forces.torque; });
}

std::vector<Plot> reaction_plots(const LinkageStudy& f) {
  std::vector<Plot> plots;
  const LinkageForces& first = f.prescribed->positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string what = fmt::format("{}: {} on {}", j.name, j.from, j.on);
    plots.push_back(both(f, j.slides ? what + ", positive 90° ahead of the slide" : what,
                         j.slides ? "normal force" : "force", "N", [k](P p) { return force_of(p.forces.joints[k]); }));
    if (j.slides)
      plots.push_back(
          both(f, what + ", about the pin", "moment", "N*m", [k](P p) { return p.forces.joints[k].moment; }));
  }
  return plots;
}

std::vector<Plot> polar_plots(const LinkageStudy& f) {
  std::vector<Plot> plots;
  const LinkageForces& first = f.prescribed->positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    if (j.slides) continue;
    Plot plot{.title = fmt::format("{}: {} on {}", j.name, j.from, j.on),
              .x = {f.rocks ? "along the ground link" : "along the stroke", ""},
              .y = {"across", ""}};
    double largest = 0;
    for (const auto& c : force_curves_of(f)) {
      plot.series.push_back(series_of(
          c.name, c.role, c.cycle->curve, [k](P p) { return p.forces.joints[k].force.x; },
          [k](P p) { return p.forces.joints[k].force.y; }));
      for (P p : c.cycle->curve) largest = std::max(largest, p.forces.joints[k].force.magnitude());
    }
    const double factor = readable_unit(largest, "N").factor;
    plot = in_readable_unit(std::move(plot), "N", largest);
    plot.x.unit = plot.y.unit;
    for (Series& s : plot.series)
      for (double& v : s.x) v *= factor;
    plot.equal_axes = true;
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<Plot> shaking_plots(const LinkageStudy& f) {
  return {both(f, "Shaking force on the frame along +x", "force", "N", [](P p) { return p.forces.shaking_force.x; }),
          both(f, "Shaking force on the frame along +y", "force", "N", [](P p) { return p.forces.shaking_force.y; }),
          both(f, "Shaking moment on the frame about the crank's axis", "moment", "N*m",
               [](P p) { return p.forces.shaking_moment; })};
}

std::vector<Plot> link_plots(const LinkageCycle& c) {
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
