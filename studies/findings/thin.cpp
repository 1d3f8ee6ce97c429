// thin.cpp — buckets with two remaining points each.
#include "studies/findings/thin.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace kurbel {

void thin_by_extremes(std::vector<double>& x, std::vector<double>& y, std::size_t limit) {
  const std::size_t n = x.size();
  limit = std::max<std::size_t>(limit, 4);
  if (n <= limit) return;
  const std::size_t buckets = (limit - 2) / 2;
  const double first = x.front(), width = x.back() - x.front();
  const bool ascends = width > 0 && std::isfinite(width) && std::is_sorted(x.begin(), x.end());
  std::size_t kept = 1;  // the first point stays; survivors are written over what was read already
  const auto keep = [&](std::size_t i) {
    x[kept] = x[i];
    y[kept] = y[i];
    ++kept;
  };
  std::size_t end = 1;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t begin = end;
    const double share = static_cast<double>(b + 1) / static_cast<double>(buckets);
    if (b + 1 == buckets)
      end = n - 1;
    else if (!ascends)
      end = 1 + (b + 1) * (n - 2) / buckets;
    else
      while (end < n - 1 && x[end] < first + share * width) ++end;
    if (begin == end) continue;
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
    }
    keep(std::min(low, high));
    if (low != high) keep(std::max(low, high));
  }
  keep(n - 1);
  x.resize(kept);
  y.resize(kept);
}

std::vector<std::size_t> drawn_by_chance(std::size_t count, std::size_t limit) {
  std::vector<std::size_t> kept;
  std::mt19937_64 generator(20260101);
  // Knuth, The Art of Computer Programming 2, 3.4.2, algorithm S: each remaining item with the remaining probability.
  for (std::size_t i = 0; i < count && kept.size() < limit; ++i) {
    const double share = static_cast<double>(generator() >> 11) * 0x1p-53;
    if (share * static_cast<double>(count - i) < static_cast<double>(limit - kept.size())) kept.push_back(i);
  }
  return kept;
}

}  // namespace kurbel
