// gear_keys.h — keys of a gear stage that is given by its teeth's geometry, and how they are read.
#pragma once

#include <optional>
#include <vector>

#include "drivetrain/gears/gear_pair.h"
#include "engine/scene/keys.h"

namespace kurbel {

const std::vector<Key>& gear_geometry_keys();

// The pair of a stage with a module; nothing where the stage has none. Faults go into the messages with their place;
// `what` names the stage in them.
std::optional<GearPair> gear_pair_of(const Section& stage, const std::string& what, Messages& messages);

}  // namespace kurbel
