// roots.h — where a function of one variable vanishes between two places at which its signs differ, and where it is
// greatest between two places.
#pragma once

#include <cmath>
#include <functional>
#include <utility>

namespace kurbel {

// Root of f in [a, b] with f(a), f(b) of opposite signs (Illinois), to the last few bits or |f| ≤ enough.
double find_root(const std::function<double(double)>& f, double a, double fa, double b, double fb, double enough = 0);

// A bracket halved so many times, or down to its last bit: `below` is true of places below what is sought.
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

// A place and the value of a function there.
struct Sampled {
  double at = 0, value = 0;
};
// Where the rate of something vanishes between three samples of it, in each half at whose ends its signs differ: there it
// turns. turn(place) for each, in order.
template <class Rate, class Turn>
void for_each_turn(const Rate& rate, const Sampled& begin, const Sampled& middle, const Sampled& end,
                   const Turn& turn) {
  for (const auto& [a, b] : {std::pair(begin, middle), std::pair(middle, end)})
    if (a.value != 0 && b.value != 0 && (a.value > 0) != (b.value > 0))
      turn(find_root(rate, a.at, a.value, b.at, b.value));
}

// The place and value of the maximum of f in [a, b], where f rises to it and falls after it; by the golden section,
// each of whose steps leaves 0.618 of the interval. More than `enough` ends the search.
struct Maximum {
  double at = 0, value = 0;
};
Maximum find_maximum(const std::function<double(double)>& f, double a, double b, int steps, double enough = HUGE_VAL);

}  // namespace kurbel
