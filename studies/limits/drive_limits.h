// drive_limits.h — allowable loads of a drive's joints, from the scene's components.
#pragma once

#include <string>
#include <vector>

#include "drivetrain/couplings/shaft_rating.h"
#include "engine/model/model.h"

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
  int joint = 0;          // in the network
  ToldTorque told = {};   // the joint's torque
  bool stands = false;    // it holds a stationary part (housing): the drive's rated torque does not apply
  double rated = 0;       // torque of the drive at its rated point, reduced to this joint [N·m]
  double turns = 0;       // its speed over the reduction link's
  bool has_play = false;  // backlash is given: it hammers when its torque changes sign
  int loss_account = -1;  // of its damping losses; −1: none
  DriveLimits limits = {};

  // Of UR M68, at a speed of the link [rad/s].
  double speed_ratio(double speed) const { return limits.shaft.speed_ratio(turns * speed); }
  double continuous(double speed) const { return limits.shaft.continuous(limits.diameter, speed_ratio(speed)); }
  double transient(double speed) const { return limits.shaft.transient(limits.diameter, speed_ratio(speed)); }
};

// Of all elastic joints of a model, in its order.
std::vector<LimitedJoint> limited_joints(const Model& model);
// The same joints in a model of the same scene with other effects, whose network may have other numbers.
std::vector<LimitedJoint> joints_of(const Model& other, const std::vector<LimitedJoint>& joints);
bool any_limits(const std::vector<LimitedJoint>& joints);

}  // namespace kurbel
