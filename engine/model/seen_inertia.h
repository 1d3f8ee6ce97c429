// seen_inertia.h — the inertias that an elastic joint has on its two sides when all elastic ones are flexible, and what it
// sees of them where a flange has none of its own.
#pragma once

#include <array>
#include <vector>

#include "engine/model/network.h"

namespace kurbel {

// The parts of a shaft that is cut into several count as one joint, and half of the inertia within it on either side.
class SeenInertias {
 public:
  explicit SeenInertias(const Network& network);

  // Of what is rigidly joined to this end of the joint, on the end's own speed; where that is nothing, of what is seen
  // through the neighbouring joints as if they were rigid, on and on through flanges without inertia. 0: there is none;
  // infinite: its speed is given. [kg·m²]
  double on_side_a(std::size_t joint) const { return on_side(joint, ends_of(joint)[0]); }
  double on_side_b(std::size_t joint) const { return on_side(joint, ends_of(joint)[1]); }
  // 1/J_red = 1/J_a + i²/J_b; 0: one side has no inertia, or neither side moves.
  double reduced(std::size_t joint) const;
  // Of the rigid group of a node, halves of shafts included, on the node's speed.
  double own(int node) const;

 private:
  std::array<int, 2> ends_of(std::size_t joint) const;
  double on_side(std::size_t joint, int node) const;

  const Network& net_;
  std::vector<int> group_;
  std::vector<double> gain_, inertia_;               // of a node by its group's first; of a group
  std::vector<std::vector<std::size_t>> joints_at_;  // elastic ones, of a group
};

}  // namespace kurbel
