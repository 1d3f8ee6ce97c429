// reach_sized.h — δ that the sized machine reaches, rigid and elastic, by its steady motion; and what the work equation left out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/size/size.h"

namespace kurbel {

// Fills `reached` of a sizing, and `meeting` where the flywheel of the work equation misses the demanded δ. A machine
// without a sequence begins at this speed of the link at its angle 0 [rad/s], if given.
void reach_sized(Sizing& sizing, const Scene& scene, const SizeOptions& options, std::optional<double> start_speed);

// Notes of what the work equation cannot carry (`beyond` elasticity), and how much of δ that is.
void say_what_is_left_out(Sizing& sizing, const std::vector<std::string>& beyond);

}  // namespace kurbel
