// forces_plots.h — plots of a slider-crank's forces over the crank's angle, by order, and as loci.
#pragma once

#include <vector>

#include "studies/findings/report.h"
#include "studies/forces/forces.h"

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

Plot torque_plot(const Forces& forces);
std::vector<Plot> reaction_plots(const Forces& forces);
std::vector<Plot> polar_plots(const Forces& forces);
std::vector<Plot> shaking_plots(const Forces& forces);
Plot harmonic_plot(const ForceCycle& cycle);
Plot counterweight_plot(const Forces& forces);
std::vector<Plot> friction_plots(const Forces& forces);

}  // namespace kurbel
