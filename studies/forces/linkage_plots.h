// linkage_plots.h — plots of any mechanism's forces and of its links over the crank's angle, and as loci.
#pragma once

#include <vector>

#include "studies/findings/report.h"
#include "studies/forces/linkage_cycle.h"

namespace kurbel {

double force_of(const JointForces& joint);  // magnitude, or a slide's normal force with its sign [N]

Plot torque_plot(const LinkageStudy& study);
std::vector<Plot> reaction_plots(const LinkageStudy& study);
std::vector<Plot> polar_plots(const LinkageStudy& study);
std::vector<Plot> shaking_plots(const LinkageStudy& study);
std::vector<Plot> link_plots(const LinkageCycle& cycle);

}  // namespace kurbel
