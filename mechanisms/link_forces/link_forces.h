// link_forces.h — what acts along a travel within a linkage, as a mechanism without inertia.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/reduced/mechanism.h"
#include "mechanisms/reduced/newton_euler.h"

namespace kurbel {

// Those that act within this linkage: their elements stand behind its own. "press" has "press.return".
std::vector<const Mechanism*> link_forces_of(const Network& network, const std::string& component);

// What this force or torque [N], [N·m] along the travel of `force` does to the linkage's bodies at φ.
void add_actions(const Mechanism& force, double value, long double phi, const PlanarLinkage& linkage,
                 std::vector<AppliedForce>& to);

}  // namespace kurbel
