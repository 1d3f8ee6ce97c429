// sequence_ahead.h — whether the operating sequence continues in a motion that was found, which is then not steady.
#pragma once

#include <Eigen/Core>

#include "engine/return_map/return_map.h"

namespace kurbel {

// A step that waits for a time or an angle is executed; a step that waits for a speed, if it is reached within a period or
// already. False for a repeated sequence.
bool sequence_goes_on(const ReturnMap& map, const Eigen::VectorXd& z);

}  // namespace kurbel
