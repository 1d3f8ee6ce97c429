// gears_plots.h — the animated drawing of a gear pair, and plots along its path of contact.
#pragma once

#include <vector>

#include "studies/findings/report.h"
#include "studies/gears/gears.h"

namespace kurbel {

// Points along the path of contact, including both ends [m].
std::vector<double> along_path(const GearPair& pair);

GearView drawing_of(const GearStage& stage);
std::vector<Plot> plots_of(const GearStage& stage);

}  // namespace kurbel
