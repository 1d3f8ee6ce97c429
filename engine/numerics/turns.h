// turns.h — where a value turns within a step, known by itself alone.
#pragma once

#include <algorithm>

#include "engine/numerics/roots.h"

namespace kurbel {

// Calls turn(t) where the central differences of a smooth value change their sign between two of nine places.
template <class Value, class Turn>
void for_each_turn_within(double begin, double end, const Value& value, const Turn& turn) {
  constexpr int parts = 8;
  const double delta = 1e-3 * (end - begin);
  const auto rate = [&](double t) { return value(std::min(t + delta, end)) - value(std::max(t - delta, begin)); };
  Sampled before{begin, rate(begin)};
  for (int k = 1; k <= parts; ++k) {
    const double t = k < parts ? begin + (end - begin) * k / parts : end;
    const Sampled now{t, rate(t)};
    if (before.value * now.value < 0) turn(find_root(rate, before.at, before.value, now.at, now.value));
    before = now;
  }
}

}  // namespace kurbel
