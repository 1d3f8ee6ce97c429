// sequence_ahead.h — whether a motion that was found makes the operating sequence go on: then the machine does not keep it.
#pragma once

#include <Eigen/Core>

#include "engine/return_map/return_map.h"

namespace kurbel {

// A step that waits for a time or an angle comes; one that waits for a speed comes where a round from there reaches it, or
// where it is reached already. Of a sequence that goes round: never.
bool sequence_goes_on(const ReturnMap& map, const Eigen::VectorXd& z);

}  // namespace kurbel
