// mechanism_statics.h — reactions in all joints of any mechanism, balancing torque and joint friction at any state, without
// tables: the links' equilibrium (newton_euler.h) solved together with the laws of friction (joint_friction.h).
#pragma once

#include <optional>
#include <vector>

#include "mechanisms/joints/reaction_sampler.h"

namespace kurbel {

class MechanismStatics {
 public:
  // What the scene gives of its joints rubs only with `friction`. Throws as tabulate_joint_friction.
  MechanismStatics(const MechanismData& data, MechanismJoints joints, bool friction, bool weightless);
  const MechanismData& data() const { return data_; }
  const MechanismJoints& joints() const { return joints_; }
  // Null: nothing is known of it.
  const RubbingJoint* joint_data(const char* name) const;

  // The links at φ. Of a mechanism that passes change points φ is moved beside them (linkage_beside).
  PlanarLinkage linkage(double& phi) const;
  // Throws as forces_in; Jam, with the numbers, where no finite reactions satisfy the friction laws.
  LinkageForces solve(const PlanarLinkage& linkage, const LinkageState& state) const;
  // Angles where friction turns round: a joint that rubs stands still there [rad].
  std::vector<double> turnings() const;

 private:
  void add_friction(const PlanarLinkage& linkage, LinkageForces& forces) const;

  MechanismData data_;
  MechanismJoints joints_;
  bool weightless_;
  std::optional<ReactionSampler> sampler_;  // of the joints that rub; none: none does
};

}  // namespace kurbel
