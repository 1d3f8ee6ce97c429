// reaction_sampler.h — reactions of the joints that rub to ω² = 1, ε = 1, weights, unit load, a unit of what acts within and of friction at one
// angle, by Newton–Euler in long double (newton_euler.h).
#pragma once

#include <cstddef>
#include <vector>

#include "mechanisms/friction/joint_friction.h"
#include "mechanisms/joints/reaction_table.h"
#include "mechanisms/reduced/mechanism_data.h"
#include "mechanisms/reduced/newton_euler.h"

namespace kurbel {

// The linkage at φ with its output's centre of mass and load where they are.
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
  using UnitReactions = std::vector<std::vector<long double>>;  // as unit_reactions has them
  UnitReactions put(double phi, const PlanarLinkage& at, double* values) const;
  // Velocity of the n-th joint that rubs, by ω.
  double rate(std::size_t joint, const PlanarLinkage& at) const;
  std::size_t joint_of(std::size_t rubbing) const { return joint_[rubbing]; }  // among the linkage's
  // By columns the greatest force in any joint, whether it rubs or not, and the greatest moment, in any case what that
  // force has at the crank's length: beside these a coefficient may be rounding. A unit of load or of friction has at
  // least what it would do at that length.
  struct Greatest {
    std::vector<double> force, moment;
  };
  void widen(double phi, Greatest& to) const;
  double output_ratio(double phi) const { return static_cast<double>(linkage(phi).output[1]); }

  std::vector<JointFriction::Joint> joints;  // that rub

 private:
  void add(int number, const RubbingJoint& r, bool slides);
  UnitReactions units(double phi, const PlanarLinkage& at) const;

  MechanismData data_;
  OffThePin off_;
  std::vector<ActsWithin> within_;
  ReactionPlaces places_;
  std::vector<std::size_t> joint_;  // of the linkage, per joint that rubs
  std::vector<FrictionPlace> loads_;
};

}  // namespace kurbel
