// thin.h — fewer points of a curve, with every peak kept: the smallest and largest value of each bucket survive.
#pragma once

#include <cstddef>
#include <vector>

namespace kurbel {

// Leaves a curve of at most `limit` (≥ 4) points as it is; else keeps its first and last point and, of each of equally
// many points, the smallest and the largest value, in their order.
void thin_by_extremes(std::vector<double>& x, std::vector<double>& y, std::size_t limit);

}  // namespace kurbel
