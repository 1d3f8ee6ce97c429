// static_curve.h — validity of the static torque–speed curve of induction motors in a motion (theory 4.1).
//
// Reported if the speed varies faster than the curve is valid for: above 3 % of the mains' frequency, if the estimated
// torque with flux lag differs by more than 5 % of the rated torque. Limited by the resolution of the samples. Fluxes
// follow the curve as in drivetrain/induction/lagging_motor.h; motors modelled that way are not reported.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/return_map/return_map.h"
#include "engine/run/recorders.h"

namespace kurbel {

// Motion of one motor over time [s]: speed [rad/s] and torque [N·m] of its shaft.
struct MotorMotion {
  std::vector<double> time, speed, torque;
};

// One sentence for each motor; `motion_of` is called only for motors with a static curve, and may be empty.
std::vector<std::string> static_curve_notes(const Model& model,
                                            const std::function<MotorMotion(const std::string& motor)>& motion_of);
// For a run, from the samples of its trajectory.
std::vector<std::string> static_curve_notes(const Model& model, const TrajectoryRecorder& trajectory);
// For the steady motion from the map's fixed point: two more periods, only if there is such a motor.
std::vector<std::string> static_curve_notes(const ReturnMap& map, const SteadyPoint& point);

}  // namespace kurbel
