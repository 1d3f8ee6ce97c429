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

#include "drivetrain/couplings/shaft_rating.h"
#include "engine/base/estimate.h"
#include "engine/model/model.h"
#include "engine/orbit/orbit.h"
#include "engine/run/recorders.h"

namespace kurbel {

// Of one joint: by DIN 740-2, or by the section of a shaft; 0: not stated.
struct DriveLimits : CouplingLimits {
  double shear_stress = 0, polar_modulus = 0;  // [Pa], W_p [m³]
  double diameter = 0;                         // of that section [m]
  ShaftRating shaft = {};
  bool any() const {
    return nominal > 0 || maximum > 0 || vibratory > 0 || power > 0 || shear_stress > 0 || shaft.any();
  }
};

struct LimitedJoint {
  std::string name;  // of its component; numbered if it has several: "shaft.2"
  std::string component;
  int joint = 0;                 // in the network
  ReportedTorque reported = {};  // the joint's torque
  bool beside_middle = false;    // of a continuous shaft, which is judged in its middle
  bool stands = false;           // it holds a stationary part (housing): the drive's rated torque does not apply
  double rated = 0;              // torque of the drive at its rated point, reduced to this joint [N·m]
  double turns = 0;              // its speed over the reduction link's
  bool has_play = false;         // backlash is given: it hammers when its torque changes sign
  int loss_account = -1;         // of its damping losses; −1: none
  DriveLimits limits = {};

  // Of UR M68, at a speed of the link [rad/s].
  double speed_ratio(double speed) const { return limits.shaft.speed_ratio(turns * speed); }
  double continuous(double speed) const { return limits.shaft.continuous(limits.diameter, speed_ratio(speed)); }
  double transient(double speed) const { return limits.shaft.transient(limits.diameter, speed_ratio(speed)); }
};

// Names of all elastic joints, in the order of the model, and of all nodes. A divided shaft has "shaft, segment 2" and
// "shaft, station at 0.4 m"; the middle segment of a continuous one has the shaft's name.
std::vector<std::string> names_of_joints(const Model& model);
std::vector<std::string> names_of_nodes(const Model& model);

// Of all elastic joints of a model, in its order.
std::vector<LimitedJoint> limited_joints(const Model& model);
// The same joints in a model of the same scene with other effects, whose network may have other numbers.
std::vector<LimitedJoint> joints_of(const Model& other, const std::vector<LimitedJoint>& joints);
bool any_limits(const std::vector<LimitedJoint>& joints);

// Of one joint; torques in N·m.
struct JointLoad {
  Estimate mean, upper, lower;  // lower ≤ mean ≤ upper
  Estimate vibratory;           // T_W
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
