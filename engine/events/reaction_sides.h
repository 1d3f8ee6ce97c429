// reaction_sides.h — on which sides of their kinks the reactions are: guards while modes hold, and the sides anew when
// other modes have changed.
#pragma once

#include <span>
#include <vector>

#include "engine/equations/flow.h"

namespace kurbel {

// Guards of all reactions: positive while their sides hold, 1 where nothing is to be told. True: the flow was evaluated at
// this state for them.
bool guard_reactions(Flow& flow, double t, std::span<const double> y, std::span<const std::size_t> pool_guards,
                     std::span<double> g);

// While other modes change, reactions may jump across kinks: until settle() each counts as it comes.
class OpenSides {
 public:
  explicit OpenSides(Flow& flow);
  // Then by the accelerations; next to a kink what was said last stays, as one that fired has its new side.
  void settle(double t, std::span<const double> y);

 private:
  Flow& flow_;
  std::vector<int> before_;
};

}  // namespace kurbel
