// forces_plots.h — plots of a mechanism's forces over the crank's angle, by order, and as loci.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/numerics/angles.h"
#include "studies/findings/plots.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {

// A motion that a plot draws.
template <class Cycle>
struct ForceCurve {
  const Cycle* cycle;
  const char* name;
  Role role;
};

// Of a study of forces, in the order of drawing: the rigid machine behind, the machine itself in front.
template <class Study>
auto force_curves_of(const Study& f) {
  using Cycle = typename decltype(f.simulated)::value_type;
  std::vector<ForceCurve<Cycle>> curves;
  if (f.rigid) curves.push_back({&*f.rigid, "simulated, rigid", Role::rigid});
  if (f.prescribed) curves.push_back({&*f.prescribed, "prescribed: constant speed", Role::reference});
  if (f.simulated)
    curves.push_back({&*f.simulated, f.elastic ? "simulated, elastic" : "simulated, rigid",
                      f.elastic ? Role::elastic : Role::rigid});
  return curves;
}

Plot angle_plot(const std::string& title, const std::string& quantity);  // over the crank's angle
// Equal axes, both in the unit in which forces up to `largest` read easily.
Plot in_forces(Plot plot, double largest);

// Of positions, where it is finite.
template <class Cycle, class Value>
Series over_angle(const std::string& name, Role role, const Cycle& cycle, const Value& value) {
  Series series{.name = name, .role = role};
  for (const auto& p : cycle.curve)
    if (const double v = value(p); std::isfinite(v)) series.add(in_degrees * state_of(p).phi, v);
  return series;
}
// Of all motions of a study, in the unit in which it reads easily; without a unit as it is.
template <class Study, class Value>
Plot over_angle(const Study& f, const std::string& title, const std::string& quantity, const std::string& unit,
                const Value& value) {
  Plot plot = angle_plot(title, quantity);
  for (const auto& c : force_curves_of(f)) plot.series.push_back(over_angle(c.name, c.role, *c.cycle, value));
  return unit.empty() ? plot : in_readable_unit(std::move(plot), unit);
}
// Locus of a force's tip over the cycle.
template <class Study, class Force>
Plot locus(const Study& f, const std::string& title, const std::string& x, const std::string& y, const Force& force) {
  Plot plot{.title = title, .x = {x, ""}, .y = {y, ""}};
  double largest = 0;
  for (const auto& c : force_curves_of(f)) {
    Series& s = plot.series.emplace_back(Series{.name = c.name, .role = c.role});
    for (const auto& p : c.cycle->curve) {
      const Force2 v = force(p);
      s.add(v.x, v.y);
      largest = std::max(largest, v.magnitude());
    }
  }
  return in_forces(std::move(plot), largest);
}

template <class Study>
Plot torque_plot(const Study& f) {
  return over_angle(f, "Torque that the shaft must give the crank", "balancing torque M", "N*m",
                    [](const auto& p) { return p.forces.torque; });
}
// `along`, `across`: how the axes are called.
template <class Study>
std::vector<Plot> shaking_plots(const Study& f, const std::string& along, const std::string& across) {
  return {over_angle(f, "Shaking force on the frame " + along, "force", "N",
                     [](const auto& p) { return p.forces.shaking_force.x; }),
          over_angle(f, "Shaking force on the frame " + across, "force", "N",
                     [](const auto& p) { return p.forces.shaking_force.y; }),
          over_angle(f, "Shaking moment on the frame about the crank's axis", "moment", "N*m",
                     [](const auto& p) { return p.forces.shaking_moment; })};
}

std::vector<Plot> reaction_plots(const Forces& forces);
std::vector<Plot> polar_plots(const Forces& forces);
Plot harmonic_plot(const ForceCycle& cycle);
Plot counterweight_plot(const Forces& forces);
std::vector<Plot> friction_plots(const Forces& forces);

double force_of(const JointForces& joint);  // magnitude, or a slide's normal force with its sign [N]
std::vector<Plot> reaction_plots(const LinkageStudy& study);
std::vector<Plot> polar_plots(const LinkageStudy& study);
std::vector<Plot> link_plots(const LinkageCycle& cycle);

}  // namespace kurbel
