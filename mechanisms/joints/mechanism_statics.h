// mechanism_statics.h — reactions in all joints of any mechanism, balancing torque and joint friction at any state, without
// tables: equilibrium of the links (newton_euler.h) together with the friction laws (joint_friction.h).
#pragma once

#include <optional>
#include <vector>

#include "mechanisms/joints/reaction_sampler.h"

namespace kurbel {

class MechanismStatics {
 public:
  // `friction`: false: joints without friction. Throws as tabulate_joint_friction.
  MechanismStatics(const MechanismData& data, MechanismJoints joints, bool friction, bool weightless);
  const MechanismData& data() const { return data_; }
  const MechanismJoints& joints() const { return joints_; }
  // Null: the scene has no data of it.
  const RubbingJoint* joint_data(const char* name) const;

  // The links at φ. Of a mechanism that passes change points φ is moved beside them (linkage_beside).
  PlanarLinkage linkage(double& phi) const;
  // Throws as forces_in; throws Jam, with the numbers, if no finite reactions satisfy the friction laws.
  LinkageForces solve(const PlanarLinkage& linkage, const LinkageState& state) const;
  // Angles at which friction reverses: the velocity of a joint with friction is zero [rad].
  std::vector<double> turnings() const;

 private:
  void add_friction(const PlanarLinkage& linkage, LinkageForces& forces) const;

  MechanismData data_;
  MechanismJoints joints_;
  bool weightless_;
  std::optional<ReactionSampler> sampler_;  // of the joints with friction; empty: there are none
};

}  // namespace kurbel
