// static_curve.h — how far the static torque-speed curve of induction motors holds in a motion (theory 4.1).
//
// Told where the speed swings faster than the curve holds for: above 3 % of the mains' frequency, where the estimate of
// what the fluxes let through differs by more than 5 % of the rated torque. As far as the samples resolve it. Fluxes
// follow the curve as drivetrain/induction/lagging_motor.h says; motors that do so in the model are not told.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/return_map/return_map.h"
#include "engine/run/recorders.h"

namespace kurbel {

// Of one motor over time [s]: speed [rad/s] and torque [N·m] of its shaft.
struct MotorMotion {
  std::vector<double> time, speed, torque;
};

// A sentence for each motor; `motion_of` is asked for motors on their static curve alone, and may be empty.
std::vector<std::string> static_curve_notes(const Model& model,
                                            const std::function<MotorMotion(const std::string& motor)>& motion_of);
// Of a run, as its trajectory samples it.
std::vector<std::string> static_curve_notes(const Model& model, const TrajectoryRecorder& trajectory);
// Of the steady motion from the map's fixed point: two more rounds, only where there is such a motor.
std::vector<std::string> static_curve_notes(const ReturnMap& map, const SteadyPoint& point);

}  // namespace kurbel
