// linkage_plots.cpp — curves over the angle of the crank, and tips of forces over the cycle.
#include "studies/forces/forces_plots.h"

#include <fmt/format.h>

#include <functional>

namespace kurbel {
namespace {

using P = const PositionForces&;

Plot link_plot(const LinkageCycle& c, const std::string& title, const std::string& quantity, const std::string& unit,
               const std::function<double(const LinkForces&)>& of) {
  Plot plot = angle_plot(title, quantity);
  for (std::size_t k = 0; k < c.links.size(); ++k)
    plot.series.push_back(
        over_angle(c.links[k].name, further_role(k), c, [&, k](P p) { return of(p.forces.links[k]); }));
  return in_readable_unit(std::move(plot), unit);
}

}  // namespace

double force_of(const JointForces& j) { return j.slides ? j.normal : j.force.magnitude(); }

std::vector<Plot> reaction_plots(const LinkageStudy& f) {
  std::vector<Plot> plots;
  const LinkageForces& first = f.prescribed->positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    const std::string what = fmt::format("{}: {} on {}", j.name, j.from, j.on);
    plots.push_back(over_angle(f, j.slides ? what + ", positive 90° ahead of the slide" : what,
                               j.slides ? "normal force" : "force", "N",
                               [k](P p) { return force_of(p.forces.joints[k]); }));
    if (j.slides)
      plots.push_back(
          over_angle(f, what + ", about the pin", "moment", "N*m", [k](P p) { return p.forces.joints[k].moment; }));
  }
  return plots;
}

std::vector<Plot> polar_plots(const LinkageStudy& f) {
  std::vector<Plot> plots;
  const LinkageForces& first = f.prescribed->positions.front().forces;
  for (std::size_t k = 0; k < first.joints.size(); ++k) {
    const JointForces& j = first.joints[k];
    if (j.slides) continue;
    plots.push_back(locus(f, fmt::format("{}: {} on {}", j.name, j.from, j.on),
                          f.rocks ? "along the ground link" : "along the stroke", "across",
                          [k](P p) { return p.forces.joints[k].force; }));
  }
  return plots;
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
