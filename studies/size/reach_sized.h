// reach_sized.h — δ of the sized machine, rigid and elastic, in steady motion; and what the work equation omits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/size/size.h"

namespace kurbel {

// Fills `reached` of a sizing, `soft` if some torque depends on the speed, and `meeting` if the flywheel by the work
// equation misses the demanded δ. A machine without a sequence starts at this speed of the link [rad/s], if given.
void reach_sized(Sizing& sizing, const Scene& scene, const SizeOptions& options, std::optional<double> start_speed);

// Notes on parts that the work equation cannot represent (`beyond` elasticity), and their contribution to δ.
void report_omitted(Sizing& sizing, const std::vector<std::string>& beyond);

}  // namespace kurbel
