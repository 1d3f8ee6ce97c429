// thin.cpp — buckets with two remaining points each.
#include "studies/findings/thin.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace kurbel {

std::vector<std::size_t> kept_by_extremes(const std::vector<double>& x, const std::vector<double>& y,
                                          std::size_t limit) {
  const std::size_t n = x.size(), buckets = (std::max<std::size_t>(limit, 4) - 2) / 2;
  const double first = x.front(), width = x.back() - x.front();
  const bool ascends = width > 0 && std::isfinite(width) && std::is_sorted(x.begin(), x.end());
  std::vector<std::size_t> kept = {0};
  kept.reserve(2 * buckets + 2);
  std::size_t end = 1;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t begin = end;
    const double share = static_cast<double>(b + 1) / static_cast<double>(buckets), border = first + share * width;
    if (b + 1 == buckets)
      end = n - 1;
    else if (!ascends)
      end = 1 + (b + 1) * (n - 2) / buckets;
    else
      while (end < n - 1 && x[end] < border) ++end;
    if (begin == end) continue;
    std::size_t low = begin, high = begin;
    double least = y[begin], greatest = y[begin];
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (y[i] < least) low = i, least = y[i];
      if (y[i] > greatest) high = i, greatest = y[i];
    }
    kept.push_back(std::min(low, high));
    if (low != high) kept.push_back(std::max(low, high));
  }
  kept.push_back(n - 1);
  return kept;
}

void thin_by_extremes(std::vector<double>& x, std::vector<double>& y, std::size_t limit) {
  if (x.size() <= std::max<std::size_t>(limit, 4)) return;
  const std::vector<std::size_t> kept = kept_by_extremes(x, y, limit);
  for (std::size_t k = 0; k < kept.size(); ++k) x[k] = x[kept[k]], y[k] = y[kept[k]];
  x.resize(kept.size());
  y.resize(kept.size());
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
