// thin.h — reduces the points of a curve and keeps every peak: the smallest and largest value of each bucket remain.
#pragma once

#include <cstddef>
#include <vector>

namespace kurbel {

// A curve of at most `limit` (≥ 4) points is unchanged; otherwise the first and last point and the smallest and
// largest value of each bucket remain, in order. Buckets are equally wide in x, as on a screen, so that a growing
// curve may be thinned repeatedly; if x does not ascend, they hold equally many points.
void thin_by_extremes(std::vector<double>& x, std::vector<double>& y, std::size_t limit);
// The points that remain, ascending; of a curve of more than `limit` points.
std::vector<std::size_t> kept_by_extremes(const std::vector<double>& x, const std::vector<double>& y,
                                          std::size_t limit);

// Which of `count` points of a cloud remain if at most `limit` may: all, or a random selection, ascending, the same
// at each call. Every second, third … point would form a pattern: of a grid only some columns, of Sobol's sequence a
// part of the square.
std::vector<std::size_t> drawn_by_chance(std::size_t count, std::size_t limit);

}  // namespace kurbel
