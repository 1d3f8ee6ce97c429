// reaction_balance.cpp — Newton's method for accelerations and the torques that depend on them.
#include "engine/equations/reaction_balance.h"

#include <algorithm>
#include <cmath>

#include "engine/equations/contact.h"
#include "engine/equations/jam.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr int most_steps = 50;
constexpr double settled = 1e-8;  // tolerance; Newton's method that alternates across a kink has not converged

}  // namespace

ReactionBalance::ReactionBalance(const Model& model, const Modes& modes) : model_(model), modes_(modes) {
  for (const auto& pool : model.pools)
    if (pool->reacts()) pools_.push_back(pool.get()), memory_.push_back(pool->make_memory());
  if (pools_.empty()) return;
  for (auto* per_shaft : {&alpha_, &next_, &torque_, &slope_, &effective_torque_, &effective_inertia_})
    per_shaft->assign(model.shafts.size(), 0);
  element_torque_.assign(model.network.elements.size(), 0);
  alone_ = pools_.size() == 1 ? dynamic_cast<const ReactingPool*>(pools_.front()) : nullptr;
  if (alone_ && alone_->reacting_shafts().size() != 1) alone_ = nullptr;
  if (!alone_) return;
  alone_shaft_ = at(alone_->reacting_shafts().front());
  for (const JacobianLayout::Coupled& group : model.jacobian.coupled)
    for (const int s : group.shafts) alone_coupled_ = alone_coupled_ || at(s) == alone_shaft_;
}

ElementPool::Memory* ReactionBalance::memory_of(const ElementPool& pool) const {
  return memory_[static_cast<std::size_t>(std::find(pools_.begin(), pools_.end(), &pool) - pools_.begin())].get();
}

void ReactionBalance::react(const Instant& now, double* work_rate) {
  std::fill(torque_.begin(), torque_.end(), 0.0);
  std::fill(slope_.begin(), slope_.end(), 0.0);
  std::fill(element_torque_.begin(), element_torque_.end(), 0.0);
  Reactions sums{torque_.data(), slope_.data(), element_torque_.data(), work_rate};
  for (std::size_t p = 0; p < pools_.size(); ++p) pools_[p]->add_reactions(now, alpha_.data(), sums, memory_[p].get());
}

// One step of α; returns the largest change over the acceleration.
double ReactionBalance::newton_step(std::span<const double> inertia) {
  double change = 0;
  for (std::size_t s = 0; s < model_.free_shafts; ++s) {
    const double step = next_[s] - alpha_[s];
    if (inertia[s] == 0) continue;  // follows others
    const double usual = 1e-3 * model_.shafts[s].torque_scale / inertia[s];
    change = std::max(change, std::abs(step) / (std::abs(alpha_[s]) + usual));
  }
  return change;
}

// False: the shaft has no inertia for a response.
bool ReactionBalance::settle_alone(const Instant& now, std::span<const double> free_torque,
                                   std::span<const double> inertia, const Accelerate& accelerate, double* alpha,
                                   Sums& sums) {
  const std::size_t s = alone_shaft_, free = model_.free_shafts;
  if (!(inertia[s] > 0) && s < free) return false;
  std::copy(inertia.begin(), inertia.end(), effective_inertia_.begin());
  slope_[s] = 0;
  if (modes_.direction[s] == 0) return true;  // no reaction at rest
  std::fill(element_torque_.begin(), element_torque_.end(), 0.0);
  torque_[s] = 0;
  double before = 0, response = 0;
  if (s >= free) {
    before = prescribed_acceleration(model_, modes_, s, now.t);
  } else {
    before = alpha[s];
    response = 1 / inertia[s];
    if (alone_coupled_) {
      const double unit = std::max(std::abs(free_torque[s]), model_.shafts[s].torque_scale);
      std::copy(free_torque.begin(), free_torque.end(), effective_torque_.begin());
      effective_torque_[s] += unit;
      accelerate(effective_torque_, inertia, next_.data());
      response = (next_[s] - before) / unit;
    }
  }
  Reactions reactions{torque_.data(), slope_.data(), element_torque_.data(), sums.work_rate};
  alone_->add_answered(now, before, response, reactions, memory_.front().get());
  if (s < free) {
    if (alone_coupled_) {
      effective_torque_[s] = free_torque[s] + torque_[s];
      accelerate(effective_torque_, inertia, alpha);
    } else {
      alpha[s] = (free_torque[s] + torque_[s]) / inertia[s];
    }
  }
  effective_inertia_[s] += slope_[s];
  sums.torque[s] += torque_[s];
  for (std::size_t e = 0; e < element_torque_.size(); ++e) sums.element_torque[e] += element_torque_[e];
  return true;
}

void ReactionBalance::settle(const Instant& now, std::span<const double> free_torque, std::span<const double> inertia,
                             const Accelerate& accelerate, double* alpha, Sums& sums) {
  if (alone_ && settle_alone(now, free_torque, inertia, accelerate, alpha, sums)) return;
  const std::size_t shafts = model_.shafts.size(), free = model_.free_shafts;
  std::copy(alpha, alpha + free, alpha_.begin());
  for (std::size_t s = free; s < shafts; ++s) alpha_[s] = prescribed_acceleration(model_, modes_, s, now.t);
  for (const auto& memory : memory_)
    if (memory) memory->begin();
  double last_change = HUGE_VAL;
  for (int i = 0; i < most_steps; ++i) {
    react(now, nullptr);
    for (std::size_t s = 0; s < shafts; ++s) {
      effective_torque_[s] = free_torque[s] + torque_[s] + slope_[s] * alpha_[s];
      effective_inertia_[s] = inertia[s] + slope_[s];
    }
    accelerate(effective_torque_, effective_inertia_, next_.data());
    const double change = newton_step(inertia);
    const bool lost = !std::all_of(next_.begin(), next_.end(), [](double a) { return std::isfinite(a); });
    const bool round_off = change < 1e-12 && change >= 0.5 * last_change;
    last_change = lost ? HUGE_VAL : change;
    // At an α evaluated before: the elements have its results.
    if (lost || !(change > 1e-14) || round_off) break;
    std::copy_n(next_.begin(), model_.free_shafts, alpha_.begin());
  }
  if (!(last_change < settled)) {
    const auto reacting = std::find_if(slope_.begin(), slope_.end(), [](double slope) { return slope != 0; });
    throw Jam("no acceleration satisfies the friction in the joints",
              reacting == slope_.end() ? -1 : static_cast<int>(reacting - slope_.begin()));
  }
  react(now, sums.work_rate);
  for (std::size_t s = 0; s < shafts; ++s) sums.torque[s] += torque_[s];
  for (std::size_t e = 0; e < element_torque_.size(); ++e) sums.element_torque[e] += element_torque_[e];
  std::copy(alpha_.begin(), alpha_.begin() + static_cast<std::ptrdiff_t>(free), alpha);
}

}  // namespace kurbel
