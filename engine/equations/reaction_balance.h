// reaction_balance.h — torques that hang on the accelerations, such as friction of joints by their reactions: both are
// found together.
//
//     I α = M + M_r(α),   by Newton's method: −∂M_r/∂α counts as inertia
//
// Where one element alone reacts, on the shaft s, the others answer it in proportion: α_s = α_s0 + m M_r with m = ∂α_s/∂M,
// 1/I_s where nothing ties it to other shafts, and the element finds M_r itself (ReactingPool::add_answered).
// Costs nothing where no element reacts.
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
  bool settle_alone(const Instant& now, std::span<const double> free_torque, std::span<const double> inertia,
                    const Accelerate& accelerate, double* alpha, Sums& sums);
  void react(const Instant& now, double* work_rate);
  double newton_step(std::span<const double> inertia);

  const Model& model_;
  const Modes& modes_;
  std::vector<const ElementPool*> pools_;
  const ReactingPool* alone_ = nullptr;  // has the only element that reacts
  std::size_t alone_shaft_ = 0;
  bool alone_coupled_ = false;  // other shafts may be tied to that one
  std::vector<std::unique_ptr<ElementPool::Memory>> memory_;
  std::vector<double> alpha_, next_, torque_, slope_, element_torque_, effective_torque_, effective_inertia_;
};

}  // namespace kurbel
