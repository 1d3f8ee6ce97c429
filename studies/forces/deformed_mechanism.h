// deformed_mechanism.h — forces in a mechanism as the machine's own equations have them, bent rod and gaps included.
//
//     M = I(φ, q) ε − Q        torque of the shaft on the crank, from what its elements add to its shaft
// Reactions of a slider-crank that deforms: the left sides of slider_crank_dynamics.h for what stays zero in an ideal
// joint, the contact's force in a joint with a gap. They are what figures of ideal joints and rigid links miss.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "mechanisms/slider_crank/slider_crank_dynamics.h"

namespace kurbel {

struct MachineForces {
  double torque = 0;             // of the shaft on the crank [N·m]
  std::vector<double> reaction;  // of one that deforms: magnitudes, in the order of its joints [N]
};

class DeformedMechanism {
 public:
  DeformedMechanism(std::shared_ptr<const Model> model, const std::string& component);
  bool deforms() const { return dynamics_ != nullptr; }
  std::size_t element() const { return element_; }  // of the network
  MachineForces at(const Snapshot& s) const;

 private:
  using Vector = SliderCrankDynamics::Vector;
  void find_reactions(const Snapshot& s, double omega, double alpha, MachineForces& out) const;

  std::shared_ptr<const Model> model_;
  std::size_t element_ = 0;          // of the network
  std::vector<std::size_t> within_;  // what acts within it, where it is a linkage
  const SliderCrankDynamics* dynamics_ = nullptr;
  int force_channel_ = -1;
  std::size_t own_ = 0;  // first of its own states
};

}  // namespace kurbel
