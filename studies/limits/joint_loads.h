// joint_loads.h — loads of joints in steady motion: mean, extremes, alternating part with its frequencies, heat.
//
//     T_mean = (1/T) ∫ T dt,   T_W = max |T − T_mean|,   P_W = (1/T) ∫ loss dt        over a period
//     S_f² = Σ max(1, f_i/10 Hz) T_i²/Σ T_i²                                          (theory 12.11)
// T_i: amplitudes at the frequencies f_i; for a single one S_f = √(f/10 Hz) above 10 Hz, as in DIN 740-2.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/orbit/orbit.h"
#include "engine/run/recorders.h"
#include "studies/limits/drive_limits.h"

namespace kurbel {

// Of one joint; torques in N·m.
struct JointLoad {
  Estimate mean, upper, lower;  // lower ≤ mean ≤ upper
  Estimate swing;               // T_W
  Estimate weighted;            // S_f T_W
  Estimate power;               // P_W [W]
  double frequency = 0;         // of the largest amplitude [Hz]
  double frequency_factor = 1;  // S_f
  Estimate amplitude() const { return 0.5 * (upper - lower); }
  Estimate middle() const { return 0.5 * (upper + lower); }
  const Estimate& largest() const { return std::abs(lower.value) > std::abs(upper.value) ? lower : upper; }
};

// S_f of a single frequency [Hz].
inline double frequency_factor(double hertz) { return hertz > 10 ? std::sqrt(hertz / 10) : 1; }

struct SteadyLoads {
  bool found = false;
  std::string words = {};         // source of the loads, or why there are none
  double speed = 0, slowest = 0;  // of the reduction link: mean over a period; least magnitude within [rad/s]
  double round = 0;               // period [s]; 0: nothing varies
  std::vector<JointLoad> joints = {};
};

// For the machine's steady motion; empty if it comes to rest. Errors: difference to a motion with tolerances 100 ×
// looser; if the run only approaches steady motion, also its remaining change.
SteadyLoads steady_loads(const Orbit& orbit, const std::shared_ptr<const Model>& machine,
                         const std::vector<LimitedJoint>& joints);

// Locates an extreme of a joint's torque while a machine runs; `functional`: which one.
ExtremeOf torque_extreme(const Model& machine, const LimitedJoint& joint, Functional functional);

}  // namespace kurbel
