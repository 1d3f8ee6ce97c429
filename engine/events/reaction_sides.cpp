// reaction_sides.cpp — asks pools whose reactions have kinks on which sides they are.
#include "engine/events/reaction_sides.h"

#include <algorithm>
#include <cmath>

#include "engine/elements/reacting_pool.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double at_kink = 1e-9;  // of order one as guards are

// Of one machine most have none: asked only where something reacts.
const ReactingPool* reacting(const ElementPool& pool) {
  return pool.reacts() ? dynamic_cast<const ReactingPool*>(&pool) : nullptr;
}

bool holds_sides(const ReactingPool& pool, const Flow& flow) {
  return std::any_of(pool.side_modes().begin(), pool.side_modes().end(),
                     [&](int place) { return std::abs(flow.modes().piece[at(place)]) == 1; });
}

// Of every pool with sides that is wanted: visit(pool, its index, its sides).
// True: it was evaluated for that.
template <class Wanted, class Visit>
bool for_sides(Flow& flow, double t, std::span<const double> y, Wanted wanted, Visit visit) {
  const auto& pools = flow.model().pools;
  bool evaluated = false;
  std::vector<double> side;
  for (std::size_t p = 0; p < pools.size(); ++p) {
    const ReactingPool* const pool = reacting(*pools[p]);
    if (!pool || !wanted(*pool)) continue;
    if (!evaluated) flow.evaluate(t, y);
    evaluated = true;
    side.resize(pool->side_modes().size());
    pool->find_sides(flow.now(), flow.accelerations().data(), side.data(), flow.reactions().memory_of(*pool));
    visit(*pool, p, side);
  }
  return evaluated;
}

}  // namespace

bool guard_reactions(Flow& flow, double t, std::span<const double> y, std::span<const std::size_t> pool_guards,
                     std::span<double> g) try {
  const auto watched = [&](const ReactingPool& pool) { return holds_sides(pool, flow); };
  return for_sides(flow, t, y, watched, [&](const ReactingPool& pool, std::size_t p, const std::vector<double>& side) {
    for (std::size_t k = 0; k < side.size(); ++k) {
      const int mode = flow.modes().piece[at(pool.side_modes()[k])];
      if (mode == 1 || mode == -1) g[pool_guards[p] + at(pool.side_guards()[k])] = mode * side[k];
    }
  });
} catch (const Jam&) {  // a trial step goes too far: its rates are no numbers, either
  return false;
}

bool is_side(const ElementPool& any, int guard) {
  const ReactingPool* const pool = reacting(any);
  return pool && std::count(pool->side_guards().begin(), pool->side_guards().end(), guard) > 0;
}

OpenSides::OpenSides(Flow& flow) : flow_(flow) {
  std::vector<int>& mode = flow_.changing_modes().piece;
  for (const auto& any : flow_.model().pools)
    if (const ReactingPool* const pool = reacting(*any))
      for (const int place : pool->side_modes()) {
        before_.push_back(mode[at(place)]);
        if (mode[at(place)] != ReactingPool::without_events) mode[at(place)] = 0;
      }
}

void OpenSides::settle(double t, std::span<const double> y) try {
  if (before_.empty()) return;
  std::size_t next = 0;
  std::vector<int>& mode = flow_.changing_modes().piece;
  const auto all = [](const ReactingPool&) { return true; };
  for_sides(flow_, t, y, all, [&](const ReactingPool& pool, std::size_t, const std::vector<double>& side) {
    for (std::size_t k = 0; k < side.size(); ++k) {
      const int last = before_[next++];
      int& now = mode[at(pool.side_modes()[k])];
      if (now == ReactingPool::without_events) continue;
      const bool keeps = last != 0 && std::abs(side[k]) < at_kink;
      now = keeps ? last : side[k] >= 0 ? 1 : -1;
    }
  });
} catch (const Jam&) {  // no accelerations: as they come
}

}  // namespace kurbel
