// reaction_balance.h — torques that depend on the accelerations, such as joint friction by reactions, solved together with
// them.
//
//     I α = M + M_r(α),   by Newton's method: −∂M_r/∂α counts as inertia
//
// If only one element reacts, on the shaft s, α_s is linear in its torque: α_s = α_s0 + m M_r with m = ∂α_s/∂M, which is
// 1/I_s if s is not tied to other shafts, and the element solves for M_r (ReactingPool::add_answered).
// No cost without reacting elements.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/elements/reacting_pool.h"
#include "engine/equations/state.h"
#include "engine/model/model.h"

namespace kurbel {

class ReactionBalance {
 public:
  ReactionBalance(const Model& model, const Modes& modes);
  bool any() const { return !pools_.empty(); }

  // Accelerations of the free shafts from torques and inertias, with all ties.
  using Accelerate =
      std::function<void(std::span<const double> torque, std::span<const double> inertia, double* alpha)>;
  // α of the free shafts: input without M_r, output with it. Adds M_r to the sums. Throws Jam if no α satisfies it.
  void settle(const Instant& now, std::span<const double> free_torque, std::span<const double> inertia,
              const Accelerate& accelerate, double* alpha, Sums& sums);

  // Of a pool, with the reactions of the last balance.
  ElementPool::Memory* memory_of(const ElementPool& pool) const;
  // Of the last balance, per shaft: −∂M_r/∂α, and the effective inertia including it [kg·m²].
  double slope(std::size_t shaft) const { return slope_[shaft]; }
  std::span<const double> effective_inertia() const { return effective_inertia_; }

 private:
  bool settle_alone(const Instant& now, std::span<const double> free_torque, std::span<const double> inertia,
                    const Accelerate& accelerate, double* alpha, Sums& sums);
  void react(const Instant& now, double* work_rate);
  double newton_step(std::span<const double> inertia);

  const Model& model_;
  const Modes& modes_;
  std::vector<const ElementPool*> pools_;
  const ReactingPool* alone_ = nullptr;  // pool of the only reacting element
  std::size_t alone_shaft_ = 0;
  bool alone_coupled_ = false;  // other shafts may be tied to that one
  std::vector<std::unique_ptr<ElementPool::Memory>> memory_;
  std::vector<double> alpha_, next_, torque_, slope_, element_torque_, effective_torque_, effective_inertia_;
};

}  // namespace kurbel
