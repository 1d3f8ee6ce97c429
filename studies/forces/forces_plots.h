// forces_plots.h — plots of a slider-crank's forces over the crank's angle, by order, and as loci.
#pragma once

#include <vector>

#include "studies/findings/report.h"
#include "studies/forces/forces.h"

namespace kurbel {

// The problems that were solved; the simulated motion, where there is one, is the machine's own.
std::vector<const ForceCycle*> problems_of(const Forces& forces);
const ForceCycle& front_of(const Forces& forces);

Plot torque_plot(const Forces& forces);
std::vector<Plot> reaction_plots(const Forces& forces);
std::vector<Plot> polar_plots(const Forces& forces);
std::vector<Plot> shaking_plots(const Forces& forces);
Plot harmonic_plot(const ForceCycle& cycle);
Plot counterweight_plot(const Forces& forces);
std::vector<Plot> friction_plots(const Forces& forces);

}  // namespace kurbel
