// reaction_table.h — friction in the joints of any mechanism: joints with friction, and their reactions tabulated over φ.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanisms/friction/joint_friction.h"
#include "mechanisms/linkage/travel.h"
#include "mechanisms/reduced/crank_cycle.h"
#include "mechanisms/reduced/extraction.h"
#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel {

// Offsets of the centre of mass and of the load of the output slider from its pin, where the linkage puts both.
struct OffThePin {
  double com = 0;   // of the centre of mass along the output's direction [m]
  double load = 0;  // of the load's line, 90° ahead of that direction [m]
};

// Joint data of a mechanism in the scene, by the joint names of its linkage; other joints have no data.
struct MechanismJoints {
  std::vector<RubbingJoint> joints;
  OffThePin off;
};

// A force within the linkage, besides loads on its output: its name ("press.return") and its travel.
struct ActsWithin {
  std::string name;
  LinkageTravelData along;
};

// Tables of the reactions of the joints in `rubbing`, by Newton–Euler in long double (newton_euler.h), with the error
// table_tolerance relative to the maximum of each coefficient, on a crank's arc to its own value. Joints without friction
// are omitted; a name applies to all joints with it. Throws std::invalid_argument for unknown joint names, for values
// outside their domain, for a linkage with undetermined or unbounded reactions (change points), for too many joints or
// forces within.
std::shared_ptr<const JointFriction> tabulate_joint_friction(const MechanismData& data,
                                                             const std::vector<RubbingJoint>& rubbing,
                                                             const OffThePin& off,
                                                             const std::vector<ActsWithin>& within,
                                                             Extraction extraction);

// The reason why friction by reactions cannot be computed; empty: it can.
std::string refusal_of_joint_friction(const MechanismData& data, const CrankCycle& cycle);

}  // namespace kurbel
