// gear_train_keys.h — fields shared by gears: efficiencies; connection of the shafts by a gear without an elastic mesh.
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

// φ_a = ratio φ_b: a joint, or with losses a relation controlled by the effect gear_losses.
void join_gear(Network& net, int a, int b, double ratio, const std::string& component, const GearEfficiency* losses);

}  // namespace kurbel
