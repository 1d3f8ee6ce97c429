// universal_joint.cpp — the joint in words.
#include "drivetrain/couplings/universal_joint.h"

#include <fmt/format.h>

namespace kurbel {

std::string UniversalJoint::describe() const {
  return fmt::format("universal joint at {:.4g}°: the driven shaft turns {:.4g} … {:.4g} times as fast",
                     joint.angle * 180 / std::numbers::pi, joint.least_ratio(), joint.greatest_ratio());
}

}  // namespace kurbel
