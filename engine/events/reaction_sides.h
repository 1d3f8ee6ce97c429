// reaction_sides.h — sides of the kinks of reactions: their guards, and their update after changes of other modes.
#pragma once

#include <span>
#include <vector>

#include "engine/equations/flow.h"

namespace kurbel {

// Guards of all reactions: positive while their sides hold, 1 for guards without events. True: the flow was evaluated at
// this state.
bool guard_reactions(Flow& flow, double t, std::span<const double> y, std::span<const std::size_t> pool_guards,
                     std::span<double> g);

// Whether this guard of the pool is one of them.
bool is_side(const ElementPool& pool, int guard);

// While other modes change, reactions may jump across kinks: until settle() the sides follow from the state.
class OpenSides {
 public:
  explicit OpenSides(Flow& flow);
  // Sets the sides by the accelerations; very near to a kink the last side is kept, as a fired guard has set it.
  void settle(double t, std::span<const double> y);

 private:
  Flow& flow_;
  std::vector<int> before_;
};

}  // namespace kurbel
