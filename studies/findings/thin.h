// thin.h — fewer points of a curve, with every peak kept: the smallest and largest value of each bucket survive.
#pragma once

#include <cstddef>
#include <vector>

namespace kurbel {

// Leaves a curve of at most `limit` (≥ 4) points as it is; else keeps its first and last point and, of each bucket, the
// smallest and the largest value, in their order. Buckets are equally wide in x, as on a screen, so that a curve may be
// thinned again and again while it grows; where x does not ascend they hold equally many points.
void thin_by_extremes(std::vector<double>& x, std::vector<double>& y, std::size_t limit);

}  // namespace kurbel
