// reacting_pool.h — a pool of elements whose torques depend on the accelerations by laws with kinks; the side of each kink
// is a mode.
//
// Kinks are where a reaction changes its sign, which depends on the accelerations. As long as the side is not set, it
// follows from the state: the law is the same, but has a kink.
#pragma once

#include <vector>

#include "engine/elements/element_pool.h"

namespace kurbel {

class ReactingPool : public ElementPool {
 public:
  // Indices in `mode` of all sides: ±1; 0: by the state; without_events: permanently by the state.
  static constexpr int without_events = 2;
  virtual const std::vector<int>& side_modes() const = 0;
  // Guards of the sides, in the order of side_modes(), each times its mode; of order one.
  virtual const std::vector<int>& side_guards() const = 0;  // their indices in guards()
  // Signed distances of the reactions from the kinks at the accelerations alpha per shaft; of order one. The memory is that
  // of the reactions found at this instant and alpha.
  virtual void find_sides(const Instant& now, const double* alpha, double* side, Memory* memory) const = 0;

  // Shafts of the reacting elements, one entry per element.
  virtual const std::vector<int>& reacting_shafts() const = 0;
  // For a pool with one reacting element: its reaction M_r at the shaft acceleration alpha + response M_r, both solved
  // together. response: acceleration of the shaft per unit torque, ≥ 0 [1/(kg·m²)].
  virtual void add_answered(const Instant& now, double alpha, double response, Reactions& sums,
                            Memory* memory) const = 0;
};

}  // namespace kurbel
