// reaction_balance.h — torques that hang on the accelerations, such as friction of joints by their reactions: both are
// found together.
//
//     I α = M + M_r(α),   by Newton's method: −∂M_r/∂α counts as inertia
//
// Costs nothing where no element reacts.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/elements/element_pool.h"
#include "engine/equations/state.h"
#include "engine/model/model.h"

namespace kurbel {

class ReactionBalance {
 public:
  ReactionBalance(const Model& model, const Modes& modes);
  bool any() const { return !pools_.empty(); }

  // Accelerations of the free shafts from torques and inertias, by whatever ties them.
  using Accelerate =
      std::function<void(std::span<const double> torque, std::span<const double> inertia, double* alpha)>;
  // α of the free shafts: in, without M_r; out, with it. Adds M_r to the sums. Throws Jam where no α satisfies it.
  void settle(const Instant& now, std::span<const double> free_torque, std::span<const double> inertia,
              const Accelerate& accelerate, double* alpha, Sums& sums);

  // Of the last balance, per shaft: −∂M_r/∂α, and with it the inertia that answers a push [kg·m²].
  double slope(std::size_t shaft) const { return slope_[shaft]; }
  std::span<const double> effective_inertia() const { return effective_inertia_; }

 private:
  void react(const Instant& now, double* work_rate);
  double newton_step(std::span<const double> inertia);

  const Model& model_;
  const Modes& modes_;
  std::vector<const ElementPool*> pools_;
  std::vector<std::unique_ptr<ElementPool::Memory>> memory_;
  std::vector<double> alpha_, next_, torque_, slope_, element_torque_, effective_torque_, effective_inertia_;
};

}  // namespace kurbel
