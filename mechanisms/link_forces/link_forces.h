// link_forces.h — what acts along a travel within a linkage, as a mechanism without inertia.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/reduced/mechanism.h"
#include "mechanisms/reduced/newton_euler.h"

namespace kurbel {

// What this element does within a linkage; null: it is something else.
const Mechanism* link_force_of(const Network::ShaftElement& element);
// Those that act within this linkage: their elements stand behind its own. "press" has "press.return".
std::vector<const Mechanism*> link_forces_of(const Network& network, const std::string& component);

// What a force or torque [N], [N·m] of this value along the travel does to the linkage's bodies, which stand in these poses.
void add_actions(const LinkageTravelData& along, double value, const LinkPoses& poses, const PlanarLinkage& linkage,
                 std::vector<AppliedForce>& to);

}  // namespace kurbel
