// gear_train_keys.h — keys that gears share: efficiencies, and how a gear without an elastic mesh joins its shafts.
#pragma once

#include <string>
#include <vector>

#include "drivetrain/gears/gear_losses.h"
#include "engine/scene/keys.h"

namespace kurbel {

class Network;

const std::vector<Key>& efficiency_keys();

bool gives_efficiency(const Section& section);
// Faults go into the messages; `what` names the section in them.
GearEfficiency efficiency_of(const Section& section, const std::string& what, Messages& messages);

// φ_a = ratio φ_b: a joint, or with losses a relation that the effect gear_losses switches.
void join_gear(Network& net, int a, int b, double ratio, const std::string& component, const GearEfficiency* losses);

}  // namespace kurbel
