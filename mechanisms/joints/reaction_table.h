// reaction_table.h — friction in the joints of any mechanism: which of them rub, and their reactions tabulated over φ.
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

// Where the output's slider has its centre of mass and its load, off the pin that its linkage puts both in.
struct OffThePin {
  double com = 0;   // of the centre of mass along the output's direction [m]
  double load = 0;  // of the load's line, 90° ahead of that direction [m]
};

// A mechanism's joints as its scene gives them, by the names of its linkage's; of those that are not named nothing is known.
struct MechanismJoints {
  std::vector<RubbingJoint> joints;
  OffThePin off;
};

// What acts within the linkage, besides loads on its output: "press.return", and along which travel.
struct ActsWithin {
  std::string name;
  LinkageTravelData along;
};

// Reactions of the joints named in `rubbing`, by Newton–Euler in long double (newton_euler.h), in tables that are good to
// table_tolerance of each coefficient's greatest value, on a crank's arc of its own value. Joints that do not rub are left
// out; several joints of one name all rub. Throws std::invalid_argument for a name that no joint has, for values outside
// their domain, for a linkage whose reactions are not determined or have no bound (change points), for too many joints or
// too much that acts within.
std::shared_ptr<const JointFriction> tabulate_joint_friction(const MechanismData& data,
                                                             const std::vector<RubbingJoint>& rubbing,
                                                             const OffThePin& off,
                                                             const std::vector<ActsWithin>& within,
                                                             Extraction extraction);

// Why friction by reactions cannot be found, in words; empty: it can.
std::string refusal_of_joint_friction(const MechanismData& data, const CrankCycle& cycle);

}  // namespace kurbel
