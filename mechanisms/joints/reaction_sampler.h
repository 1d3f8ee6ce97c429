// reaction_sampler.h — reactions of the joints with friction at one angle to ω² = 1, ε = 1, weights, unit load and units of
// the forces within and of friction, by Newton–Euler in long double (newton_euler.h).
#pragma once

#include <cstddef>
#include <vector>

#include "mechanisms/friction/joint_friction.h"
#include "mechanisms/joints/reaction_table.h"
#include "mechanisms/reduced/mechanism_data.h"
#include "mechanisms/reduced/newton_euler.h"

namespace kurbel {

// The linkage with the centre of mass and the load of its output moved off the pin.
PlanarLinkage placed_off_the_pin(PlanarLinkage linkage, const OffThePin& off);

class ReactionSampler {
 public:
  // Throws as tabulate_joint_friction does.
  ReactionSampler(const MechanismData& data, const std::vector<RubbingJoint>& rubbing, const OffThePin& off,
                  std::vector<ActsWithin> within);
  const ReactionPlaces& places() const { return places_; }
  PlanarLinkage linkage(double phi) const { return placed_off_the_pin(data_.linkage(phi), off_); }

  // All coefficients, in the order of ReactionPlaces.
  void operator()(double phi, double* values) const;
  using UnitReactions = std::vector<std::vector<long double>>;  // see unit_reactions
  UnitReactions put(double phi, const PlanarLinkage& at, double* values) const;
  // Velocity of the n-th joint with friction over ω.
  double rate(std::size_t joint, const PlanarLinkage& at) const;
  std::size_t joint_of(std::size_t rubbing) const { return joint_[rubbing]; }  // index in the linkage
  // For each column the maximum force in any joint, with or without friction, and the maximum moment, at least that force
  // times the crank's length: coefficients far below these are rounding errors. For units of load or friction at least
  // their effect at that length.
  struct Greatest {
    std::vector<double> force, moment;
  };
  void widen(double phi, Greatest& to) const;
  double output_ratio(double phi) const { return static_cast<double>(linkage(phi).output[1]); }

  std::vector<JointFriction::Joint> joints;  // with friction

 private:
  void add(int number, const RubbingJoint& r, const PlanarLinkage::Joint& j);
  UnitReactions units(double phi, const PlanarLinkage& at) const;

  MechanismData data_;
  OffThePin off_;
  std::vector<ActsWithin> within_;
  ReactionPlaces places_;
  std::vector<std::size_t> joint_;  // index in the linkage, per joint with friction
  std::vector<FrictionPlace> loads_;
};

}  // namespace kurbel
