// approach.cpp — geometric sequences, and ranges of alternating ones.
#include "studies/run/approach.h"

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

// Changes D₁, D₂ over the two halves of the last 2 · `length` changes.
std::optional<double> geometric_rest(std::span<const double> v, std::size_t length, double noise) {
  const std::size_t n = v.size() - 1;
  const double second = std::abs(v[n] - v[n - length]), first = std::abs(v[n - length] - v[n - 2 * length]);
  if (second <= noise) return second;
  if (second >= first) return {};
  return second * second / (first - second);
}

}  // namespace

double range_of(std::span<const double> v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return *high - *low;
}

Approach approach_of(std::span<const double> values, double noise) {
  Approach approach;
  if (values.size() >= 2) approach.last_change = values.back() - values[values.size() - 2];
  if (values.size() < 3) return approach;
  const std::span<const double> v = values.last(std::max<std::size_t>(3, values.size() / 2 + 1));
  const std::size_t n = v.size() - 1, half = n / 2;
  bool rises = false, falls = false;
  for (std::size_t k = 1; k <= n; ++k) {
    rises = rises || v[k] - v[k - 1] > noise;
    falls = falls || v[k - 1] - v[k] > noise;
  }
  approach.alternates = rises && falls;
  if (approach.alternates) {
    const double before = range_of(v.first(v.size() - half)), now = range_of(v.last(half + 1));
    const double growth = std::max(1.0, now / std::max(before, noise));
    approach.remaining = std::isfinite(growth) ? now * growth * growth : now;
    return approach;
  }
  approach.remaining = 0;
  for (const std::size_t length : {std::max<std::size_t>(1, half / 4), half}) {
    const std::optional<double> rest = geometric_rest(v, length, noise);
    if (!rest || !approach.remaining) {
      approach.remaining.reset();
    } else {
      approach.remaining = std::max(*approach.remaining, *rest);
    }
  }
  // A single ratio may be that of a faster motion, which dies away in it: none below a tenth is assumed.
  if (const double change = std::abs(v[n] - v[n - 1]); n == 2 && approach.remaining && change > noise)
    approach.remaining = std::max(*approach.remaining, change / 9);
  return approach;
}

}  // namespace kurbel
