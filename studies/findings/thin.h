// thin.h — fewer points of a curve, with every peak kept: the smallest and largest value of each bucket survive.
#pragma once

#include <cstddef>
#include <vector>

namespace kurbel {

// Leaves a curve of at most `limit` (≥ 4) points as it is; else keeps its first and last point and, of each bucket, the
// smallest and the largest value, in their order. Buckets are equally wide in x, as on a screen, so that a curve may be
// thinned again and again while it grows; where x does not ascend they hold equally many points.
void thin_by_extremes(std::vector<double>& x, std::vector<double>& y, std::size_t limit);

// Which of `count` points of a cloud stay where at most `limit` may: all, or so many drawn by chance, ascending, the same
// at each call. Every second, third … point would be a pattern of its own: of a grid some columns alone, of Sobol's
// sequence a part of the square.
std::vector<std::size_t> drawn_by_chance(std::size_t count, std::size_t limit);

}  // namespace kurbel
