// seen_inertia.h — the inertias on both sides of an elastic joint when all elastic joints are flexible, also through flanges
// without inertia.
#pragma once

#include <array>
#include <vector>

#include "engine/model/network.h"

namespace kurbel {

// The parts of a discretised shaft count as one joint, with half of its inertia on each side.
class SeenInertias {
 public:
  explicit SeenInertias(const Network& network);

  // Inertia rigidly connected to this end of the joint, referred to the speed of this end [kg·m²]; if it is zero, the inertia
  // behind the neighbouring joints as if they were rigid, and so on through flanges without inertia. 0: none; infinite:
  // prescribed speed.
  double on_side_a(std::size_t joint) const { return on_side(joint, ends_of(joint)[0]); }
  double on_side_b(std::size_t joint) const { return on_side(joint, ends_of(joint)[1]); }
  // 1/J_red = 1/J_a + i²/J_b; 0: one side has no inertia, or neither side moves.
  double reduced(std::size_t joint) const;
  // Of the rigid group of a node, including halves of shafts, referred to the node's speed.
  double own(int node) const;

 private:
  std::array<int, 2> ends_of(std::size_t joint) const;
  double on_side(std::size_t joint, int node) const;

  const Network& net_;
  std::vector<int> group_;
  std::vector<double> gain_, inertia_;  // speed of a node over that of its group's first; inertia of a group
  std::vector<std::vector<std::size_t>> joints_at_;  // elastic joints of a group
};

}  // namespace kurbel
