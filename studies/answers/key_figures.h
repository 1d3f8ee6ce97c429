// key_figures.h — selects the figures of a run that are shown first: at most twelve.
//
// Priority: (1) figures with a rating, (2) speed fluctuation and speed of the link, (3) torque and power of the
// motor, (4) the three largest peak torques over the usual torques of their joints, (5) efficiency, forces and
// pressures of the process, (6) times and angles of run-up, run-down, stopping, heat of slip, (7) final state of the
// link. Within a rule: the order of the run's own list; figures beyond the limit are in the table.
#pragma once

#include <vector>

#include "studies/findings/result.h"

namespace kurbel {

// Indices of figures in result.figures, at most `most`, in the order of that list.
std::vector<std::size_t> chosen_figures(const Result& result, std::size_t most);

}  // namespace kurbel
