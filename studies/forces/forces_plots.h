// forces_plots.h — plots of a mechanism's forces over the crank's angle, by order, and as loci.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/plots.h"
#include "studies/forces/forces.h"

namespace kurbel {

double force_of(const JointForces& joint);  // magnitude, or a slide's normal force with sign [N]
Plot torque_plot(const Forces& forces);
std::vector<Plot> reaction_plots(const Forces& forces);
// For every pin, relative to the frame and to each rotating link.
std::vector<Plot> polar_plots(const Forces& forces);
// `along`, `across`: names of the axes.
std::vector<Plot> shaking_plots(const Forces& forces, const std::string& along, const std::string& across);
Plot harmonic_plot(const ForceCycle& cycle);
Plot counterweight_plot(const Forces& forces);
std::vector<Plot> friction_plots(const Forces& forces);
std::vector<Plot> link_plots(const ForceCycle& cycle);

}  // namespace kurbel
