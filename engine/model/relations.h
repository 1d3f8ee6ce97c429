// relations.h — relations between the speeds of shafts: those that are plain ratios become joints, the rest hold at run
// time over the merged shafts.
#pragma once

#include <vector>

#include "engine/model/model.h"
#include "engine/scene/effects.h"

namespace kurbel {

// Each row says something that the others, and the joints, do not. `group`: nodes that joints tie;
// `gain`: how fast each turns by the first of its group.
bool relations_are_independent(const Network& network, const std::vector<int>& group, const std::vector<double>& gain);

// Losses that are off are dropped; members that stand still (nodes where `stands`) drop out of a relation without
// losses; what then ties two shafts becomes a joint. Returns the gears' torques as terms over what remains.
std::vector<GearTorque> simplify_relations(Network& network, const Effects& effects, const std::vector<char>& stands);

// The relations over the merged shafts; where two members became one shaft their gains add.
std::vector<ShaftRelation> relations_over_shafts(const Model& model);

// Free shafts without inertia to whom the relations, which hold in every mode, do not give their motion. Each relation
// can do so for one of its members, where the others have theirs.
std::vector<int> shafts_without_motion(const Model& model);

// A shaft of every tree of shafts whose angles no twist ties to the first tracked angle.
std::vector<int> loose_trees(const Model& model);

}  // namespace kurbel
