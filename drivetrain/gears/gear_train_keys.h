// gear_train_keys.h — what gears share: efficiencies, and how a gear without an elastic mesh joins its shafts.
#pragma once

#include <optional>
#include <string>

#include "drivetrain/gears/gear_losses.h"
#include "engine/scene/fields.h"

namespace kurbel {

class Network;

struct EfficiencyKeys : GearEfficiency {
  std::optional<double> both;  // η, whichever side drives
};
const Fields<EfficiencyKeys>& efficiency_fields();

// φ_a = ratio φ_b: a joint, or with losses a relation that the effect gear_losses switches.
void join_gear(Network& net, int a, int b, double ratio, const std::string& component, const GearEfficiency* losses);

}  // namespace kurbel
