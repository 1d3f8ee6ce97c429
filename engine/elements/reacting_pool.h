// reacting_pool.h — a pool of elements whose torques hang on the accelerations by laws with kinks: on which side of a
// kink they are is a mode.
//
// Kinks lie where a reaction changes its sign, which only who knows the accelerations can tell. Until it is told the
// side counts as it comes: the law is the same, but has a kink.
#pragma once

#include <vector>

#include "engine/elements/element_pool.h"

namespace kurbel {

class ReactingPool : public ElementPool {
 public:
  // Places in `mode` of all sides: ±1; 0: as it comes; without_events: so for good.
  static constexpr int without_events = 2;
  virtual const std::vector<int>& side_modes() const = 0;
  // Guards of the sides alone, in the order of side_modes(), each times its mode; of order one.
  virtual const std::vector<int>& side_guards() const = 0;  // their places among guards()
  // How far the reactions are from the kinks at the accelerations alpha per shaft, with their signs; of order one.
  virtual void find_sides(const Instant& now, const double* alpha, double* side) const = 0;

  // Shafts of the elements that react, one entry an element.
  virtual const std::vector<int>& reacting_shafts() const = 0;
  // Of a pool with one that reacts: its reaction M_r where its shaft has the acceleration alpha + response M_r, both found
  // at once. response: what a unit of torque on the shaft adds to its acceleration, ≥ 0 [1/(kg·m²)].
  virtual void add_answered(const Instant& now, double alpha, double response, Reactions& sums) const = 0;
};

}  // namespace kurbel
