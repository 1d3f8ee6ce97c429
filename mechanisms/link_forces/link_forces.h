// link_forces.h — forces and torques along a travel within a linkage, as mechanisms without inertia.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/reduced/mechanism.h"
#include "mechanisms/reduced/newton_euler.h"

namespace kurbel {

// The force within a linkage of this element; null: the element is something else.
const Mechanism* link_force_of(const Network::ShaftElement& element);
// The forces within this linkage; their elements follow its own. "press" has "press.return".
std::vector<const Mechanism*> link_forces_of(const Network& network, const std::string& component);

// Adds the actions of a force [N] or torque [N·m] along the travel on the bodies of the linkage in these poses.
void add_actions(const LinkageTravelData& along, double value, const LinkPoses& poses, const PlanarLinkage& linkage,
                 std::vector<AppliedForce>& to);

}  // namespace kurbel
