// relations.h — relations between the speeds of shafts: plain ratios become joints, the others are solved at run time over
// the merged shafts.
#pragma once

#include <vector>

#include "engine/model/model.h"
#include "engine/scene/effects.h"

namespace kurbel {

// Whether the relations are independent of each other and of the joints. `group`: nodes connected by joints; `gain`: speed
// of each node over that of the first of its group.
bool relations_are_independent(const Network& network, const std::vector<int>& group, const std::vector<double>& gain);

// Removes losses that are off, and members at standstill (`stands`) from relations without losses; relations of two shafts
// become joints. Returns the gears' torques as terms of the remaining relations and joints.
std::vector<GearTorque> simplify_relations(Network& network, const Effects& effects, const std::vector<char>& stands);

// The relations over the merged shafts; the gains of members on the same shaft are added.
std::vector<ShaftRelation> relations_over_shafts(const Model& model);

// Free shafts without inertia whose motion is not defined by the relations, which hold in all modes. A relation defines the
// motion of one member if those of the others are defined.
std::vector<int> shafts_without_motion(const Model& model);

// One shaft of every tree of shafts whose angles are not connected by twists to the first tracked angle.
std::vector<int> loose_trees(const Model& model);

}  // namespace kurbel
