// roots.h — root of a function of one variable between two points with opposite signs, and its maximum between two
// points.
#pragma once

#include <cmath>
#include <functional>
#include <utility>

namespace kurbel {

// Root of f in [a, b] with f(a), f(b) of opposite signs (Anderson–Björck), to a few ulps or |f| ≤ enough.
double find_root(const std::function<double(double)>& f, double a, double fa, double b, double fb, double enough = 0);

// Bisects a bracket so many times, or to the last bit: `below` is true for points below the result.
struct Bracket {
  double low, high;
  double middle() const { return 0.5 * (low + high); }
};
template <class F>
Bracket halved(Bracket b, int times, const F& below) {
  for (int i = 0; i < times && b.low < b.high; ++i) {
    const double middle = b.middle();
    if (middle == b.low || middle == b.high) break;
    (below(middle) ? b.low : b.high) = middle;
  }
  return b;
}

// A position and the value of a function there.
struct Sampled {
  double at = 0, value = 0;
};
// Zeros of a rate between three of its samples, in each half with opposite signs at its ends. Calls turn(position) for
// each, in order.
template <class Rate, class Turn>
void for_each_turn(const Rate& rate, const Sampled& begin, const Sampled& middle, const Sampled& end,
                   const Turn& turn) {
  for (const auto& [a, b] : {std::pair(begin, middle), std::pair(middle, end)})
    if (a.value != 0 && b.value != 0 && (a.value > 0) != (b.value > 0))
      turn(find_root(rate, a.at, a.value, b.at, b.value));
}

// Position and value of the maximum of a unimodal f in [a, b] by golden section; each step leaves 0.618 of the interval.
// A value above `enough` ends the search.
struct Maximum {
  double at = 0, value = 0;
};
Maximum find_maximum(const std::function<double(double)>& f, double a, double b, int steps, double enough = HUGE_VAL);

}  // namespace kurbel
