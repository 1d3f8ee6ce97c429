// gear_train_keys.h — what gears share: efficiencies, and how a gear without an elastic mesh joins its shafts.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "drivetrain/gears/gear_losses.h"
#include "engine/scene/fields.h"

namespace kurbel {

class Network;

// Of a gearbox, stage by stage from the driving side: teeth of the driving and of the driven wheel (Network::data).
struct StageTeeth {
  std::vector<std::array<double, 2>> stages;
};

struct EfficiencyKeys : GearEfficiency {
  std::optional<double> both;  // η, whichever side drives
};
const Fields<EfficiencyKeys>& efficiency_fields();

// φ_a = ratio φ_b: a joint, or with losses a relation that the effect gear_losses switches.
void join_gear(Network& net, int a, int b, double ratio, const std::string& component, const GearEfficiency* losses);

}  // namespace kurbel
