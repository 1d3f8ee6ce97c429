// slope_sums_test.cpp — sums four states at a time are those of a state alone, to the last bit.
#include "engine/steppers/slope_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace kurbel::slope_sums_test {
namespace {

constexpr double untouched = 1e300;

// Vectors of any length and no alignment, with space up to the next multiple of four.
struct Case {
  explicit Case(std::size_t states, std::mt19937& random) : size(states) {
    std::normal_distribution<double> any;
    for (std::size_t k = 0; k < memory.size(); ++k) {
      memory[k].assign(1 + size + 4, 0.0);
      slopes[k] = memory[k].data() + 1;
      std::generate_n(slopes[k], size, [&] { return any(random); });
    }
    std::fill_n(out = slopes[most_stages - 1], size + 4, untouched);
    for (std::size_t k = 0; k < 12; ++k) combination.push_back({k, any(random)});
  }
  std::size_t size;
  std::array<std::vector<double>, most_stages> memory;
  Slopes slopes{};
  Combination combination;
  double* out = nullptr;
};

TEST(SlopeSums, AreThoseOfAStateAloneToTheLastBit) {
  std::mt19937 random(3);
  constexpr double h = 0.37;
  for (std::size_t size = 1; size < 40; ++size)
    for (std::size_t terms = 1; terms <= 12; ++terms) {
      Case c(size, random);
      c.combination.resize(terms);
      const double *base = c.slopes[12], *weight = c.slopes[13];
      double *sums = c.slopes[14], *errors = c.slopes[15];
      combine(size, base, c.combination, c.slopes, h, c.out);
      sum_up(size, c.combination, c.slopes, h, sums);
      const Combination rough(c.combination.rbegin(), c.combination.rend());
      correct_errors(size, c.combination, rough, c.slopes, h, weight, errors);
      for (std::size_t i = 0; i < size; ++i) {
        const auto term = [&](std::size_t k, double by) { return by * c.combination[k].weight * c.slopes[k][i]; };
        double scaled = term(0, h), sum = term(0, 1);
        for (std::size_t k = 1; k < terms; ++k) scaled += term(k, h), sum += term(k, 1);
        ASSERT_EQ(c.out[i], base[i] + scaled) << size << " states, " << terms << " terms, state " << i;
        double backwards = term(terms - 1, h);
        for (std::size_t k = terms - 1; k-- > 0;) backwards += term(k, h);
        const double e = scaled * weight[i], r = backwards * weight[i], squares = e * e + 0.01 * (r * r);
        ASSERT_DOUBLE_EQ(errors[i], e * e * (e * e) / squares) << size << " states, " << terms << " terms, state " << i;
        ASSERT_EQ(sums[i], sum * h) << size << " states, " << terms << " terms, state " << i;
      }
    }
}

TEST(SlopeSums, DenseOutputIsThatOfAStateAloneAndEndsWithTheStates) {
  std::mt19937 random(4);
  for (std::size_t size = 1; size < 40; ++size)
    for (std::size_t terms = 1; terms <= 4; ++terms) {
      Case c(size, random);
      const Slopes& v = c.slopes;
      const DenseStep step{v[4], v[5], v[6], v[7], {v[0], v[1], v[2], v[3]}, terms};
      const DensePlace place{0.37, 0.3, 0.7};
      interpolate(size, step, place, c.out);
      for (std::size_t i = 0; i < size; ++i) {
        double y = 0;
        for (std::size_t d = terms; d-- > 0;) y = v[d][i] + place.weight(d) * y;
        place.end(v[4][i], v[5][i], v[6][i], v[7][i], y);
        ASSERT_EQ(c.out[i], y) << size << " states, " << terms << " terms, state " << i;
      }
      EXPECT_EQ(c.out[size], untouched);
    }
}

}  // namespace
}  // namespace kurbel::slope_sums_test
