// deformed_mechanism.h — forces in a mechanism from the machine's own equations, including bent rod and gaps.
//
//     M = I(φ, q) ε − Q        torque of the shaft on the crank; Q: torques of the elements on this shaft
// Reactions of a slider-crank that deforms: for an ideal joint the left sides of slider_crank_dynamics.h that belong
// to constrained motion, for a joint with a gap the contact force. Ideal joints and rigid links do not show them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "mechanisms/deforming/deforming_mechanism.h"

namespace kurbel {

struct MachineForces {
  double torque = 0;             // of the shaft on the crank [N·m]
  std::vector<double> reaction;  // of a deforming mechanism: magnitudes, in the order of its joints [N]
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
  std::vector<std::size_t> within_;  // elements within it, if it is a linkage
  const SliderCrankDynamics* dynamics_ = nullptr;
  int force_channel_ = -1;
  std::size_t own_ = 0;  // first of its internal states
};

}  // namespace kurbel
