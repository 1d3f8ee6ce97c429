// slope_sums.cpp — each loop once, compiled for AVX2 and for any processor.
#include "engine/steppers/slope_sums.h"

#include <cstring>
#include <limits>

namespace kurbel {
namespace {

// So many numbers at once, as values and as they lie in memory.
template <std::size_t lanes>
struct Several {
  using Value [[gnu::vector_size(lanes * sizeof(double))]] = double;
  using Stored [[gnu::vector_size(lanes * sizeof(double)), gnu::aligned(8), gnu::may_alias]] = double;
};
template <std::size_t lanes>
[[gnu::always_inline]] inline const typename Several<lanes>::Stored& at(const double* place) {
  return *reinterpret_cast<const typename Several<lanes>::Stored*>(place);
}
template <std::size_t lanes>
[[gnu::always_inline]] inline typename Several<lanes>::Stored& at(double* place) {
  return *reinterpret_cast<typename Several<lanes>::Stored*>(place);
}

struct Sum {
  const Combination& combination;
  const Slopes& slopes;
  double h;
};

// h Σ from the left, `end(i, sum)` for so many states, several of these at once, so that none waits for another's sum.
template <std::size_t lanes, std::size_t count, class End>
[[gnu::always_inline]] inline void sum_at(std::size_t i, const Sum& of, const End& end) {
  typename Several<lanes>::Value sum[count];
  const Term* term = of.combination.data();
  const Term* const last = term + of.combination.size();
  const auto add = [&](bool first) __attribute__((always_inline)) {
    const double weight = of.h * term->weight;
    const double* const slope = of.slopes[term->stage] + i;
    for (std::size_t b = 0; b < count; ++b) {
      const typename Several<lanes>::Value part = weight * at<lanes>(slope + b * lanes);
      sum[b] = first ? part : sum[b] + part;
    }
  };
  add(true);
  while (++term != last) add(false);
  for (std::size_t b = 0; b < count; ++b) end(i + b * lanes, sum[b]);
}
template <std::size_t lanes, class End>
[[gnu::always_inline]] inline void sum_all(std::size_t size, const Sum& of, const End& end) {
  std::size_t i = 0;
  for (; i + 3 * lanes < size; i += 4 * lanes) sum_at<lanes, 4>(i, of, end);
  if (i + 2 * lanes < size) return sum_at<lanes, 3>(i, of, end);
  if (i + lanes < size) return sum_at<lanes, 2>(i, of, end);
  if (i < size) sum_at<lanes, 1>(i, of, end);
}

template <std::size_t lanes>
[[gnu::always_inline]] inline void combine_by(std::size_t size, const double* base, const Sum& of, double* out) {
  using Value = typename Several<lanes>::Value;
  sum_all<lanes>(size, of, [&](std::size_t i, const Value& sum) { at<lanes>(out + i) = at<lanes>(base + i) + sum; });
}
template <std::size_t lanes>
[[gnu::always_inline]] inline void sum_up_by(std::size_t size, const Sum& of, double h, double* out) {
  using Value = typename Several<lanes>::Value;
  sum_all<lanes>(size, of, [&](std::size_t i, const Value& sum) { at<lanes>(out + i) = (0.0 + sum) * h; });
}
template <std::size_t lanes>
[[gnu::always_inline]] inline void correct_errors_by(std::size_t size, const Sum& error, const Sum& rough,
                                                     const double* w, double* out) {
  using Value = typename Several<lanes>::Value;
  sum_all<lanes>(size, error, [&](std::size_t i, const Value& sum) { at<lanes>(out + i) = sum; });
  sum_all<lanes>(size, rough, [&](std::size_t i, const Value& sum) {
    const Value e = at<lanes>(out + i) * at<lanes>(w + i), r = sum * at<lanes>(w + i);
    at<lanes>(out + i) = e * e * (e * e) / (e * e + 0.01 * (r * r) + std::numeric_limits<double>::min());
  });
}
template <std::size_t lanes>
[[gnu::always_inline]] inline void interpolate_by(std::size_t size, const DenseStep& s, const DensePlace& place,
                                                  double* out) {
  using Value = typename Several<lanes>::Value;
  for (std::size_t i = 0; i < size; i += lanes) {
    Value y{};
    for (std::size_t d = s.terms; d-- > 0;) y = at<lanes>(s.dense[d] + i) + place.weight(d) * y;
    const Value y0 = at<lanes>(s.y0 + i), y1 = at<lanes>(s.y1 + i), f0 = at<lanes>(s.f0 + i), f1 = at<lanes>(s.f1 + i);
    place.end(y0, y1, f0, f1, y);
    if (i + lanes <= size)
      at<lanes>(out + i) = y;
    else
      std::memcpy(out + i, &y, (size - i) * sizeof(double));
  }
}

[[gnu::target("avx2")]] void combine_wide(std::size_t size, const double* base, const Sum& of, double* out) {
  combine_by<4>(size, base, of, out);
}
[[gnu::target("avx2")]] void sum_up_wide(std::size_t size, const Sum& of, double h, double* out) {
  sum_up_by<4>(size, of, h, out);
}
[[gnu::target("avx2")]] void correct_errors_wide(std::size_t size, const Sum& error, const Sum& rough, const double* w,
                                                 double* out) {
  correct_errors_by<4>(size, error, rough, w, out);
}
[[gnu::target("avx2")]] void interpolate_wide(std::size_t size, const DenseStep& step, const DensePlace& place,
                                              double* out) {
  interpolate_by<4>(size, step, place, out);
}

#ifdef __OPTIMIZE_SIZE__  // the library within an FMU
constexpr bool is_wide = false;
#else
const bool is_wide = __builtin_cpu_supports("avx2");
#endif

}  // namespace

void combine(std::size_t size, const double* base, const Combination& c, const Slopes& slopes, double h, double* out) {
  const Sum of{c, slopes, h};
  if (is_wide) return combine_wide(size, base, of, out);
  combine_by<2>(size, base, of, out);
}

void sum_up(std::size_t size, const Combination& c, const Slopes& slopes, double h, double* out) {
  const Sum of{c, slopes, 1};
  if (is_wide) return sum_up_wide(size, of, h, out);
  sum_up_by<2>(size, of, h, out);
}

void correct_errors(std::size_t size, const Combination& error, const Combination& rough, const Slopes& slopes,
                    double h, const double* w, double* out) {
  const Sum e{error, slopes, h}, r{rough, slopes, h};
  if (is_wide) return correct_errors_wide(size, e, r, w, out);
  correct_errors_by<2>(size, e, r, w, out);
}

void interpolate(std::size_t size, const DenseStep& step, const DensePlace& place, double* out) {
  if (is_wide) return interpolate_wide(size, step, place, out);
  interpolate_by<2>(size, step, place, out);
}

}  // namespace kurbel
