// drive_limits.h — a drive's linear response against the limits of its joints (studies/limits).
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "engine/orbit/orbit.h"
#include "studies/modes/modes.h"

namespace kurbel {

// The load from a linear response: its errors are not known and set to 0.
JointLoad load_of(const JointResponse& response);

// Fills `limited` and `barred` from the sweep over the speeds; `at` gives the response at any speed between.
void find_barred_ranges(const Model& model, double factor, const std::function<SpeedResponse(double speed)>& at,
                        ModesStudy& found);

// A machine with all its effects, and the motion that its own start leads to.
struct MachineAndOrbit {
  std::shared_ptr<const Model> machine;
  Orbit orbit;
};

// Fills `verdicts` of all joints with limits, and notes. `kept`: the steady motion; `end`: the final motion if the
// machine leaves the steady one again: then the run-up leads there. `at_orbit`: the study's operating point is that
// motion, otherwise loads are those of the linear response `here`.
void judge_limits(const MachineAndOrbit& kept, const std::optional<MachineAndOrbit>& end, bool at_orbit,
                  const Watch& watch, ModesStudy& found);

}  // namespace kurbel
