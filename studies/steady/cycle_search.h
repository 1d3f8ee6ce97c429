// cycle_search.h — the steady cycle of one model: free, or at a demanded mid speed with a torque added to the drive.
#pragma once

#include "studies/steady/steady.h"

namespace kurbel {

// `study` holds what is known already: the operating diagram, where there is one.
SteadyCycle search_cycle(const Scene& scene, const Effects& effects, const SteadyStudy& study,
                         const SteadyOptions& options);

}  // namespace kurbel
