// slope_sums.h — sums of weighted slopes over all states, four states at a time: by AVX2 where the processor has it, to the
// same bits without it.
//
// All vectors but the last argument of interpolate() are readable, and those written writable, up to the next multiple of
// four beyond `size`.
#pragma once

#include <array>
#include <cstddef>

#include "engine/steppers/butcher_tables.h"

namespace kurbel {

using Slopes = std::array<double*, most_stages>;

// out = base + h Σ combination
void combine(std::size_t size, const double* base, const Combination& c, const Slopes& slopes, double h, double* out);

// out = h Σ combination
void sum_up(std::size_t size, const Combination& c, const Slopes& slopes, double h, double* out);

// out = e⁴ / (e² + 0.01 r²) of each state by itself, so that a rough state cannot hide behind the smoothness of another;
// e and r are w h Σ of both combinations.
void correct_errors(std::size_t size, const Combination& error, const Combination& rough, const Slopes& slopes,
                    double h, const double* w, double* out);

// Hermite's cubic through both ends of a step of length h, at the part x of it, and what bends it further.
struct DensePlace {
  double h, x, u;  // u = 1 − x

  double weight(std::size_t d) const { return d % 2 == 0 ? x : u; }
  // A number, or several at once; `y` holds the tail first.
  template <class T>
  [[gnu::always_inline]] void end(const T& y0, const T& y1, const T& f0, const T& f1, T& y) const {
    const T rise = y1 - y0;
    y = y0 + x * (rise + u * (h * f0 - rise + x * (2 * rise - h * (f0 + f1) + u * y)));
  }
};

// A step as its dense output takes it.
struct DenseStep {
  const double *y0, *y1, *f0, *f1;
  std::array<double*, 4> dense;
  std::size_t terms;  // of `dense`
};
void interpolate(std::size_t size, const DenseStep& step, const DensePlace& place, double* out);

}  // namespace kurbel
