// constraints_test.cpp — shafts that move together, with inertias far apart: against elimination with 34 digits.
#include "engine/equations/constraints.h"
#include "engine/numerics/index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kurbel::constraints_test {
namespace {

__extension__ typedef __float128 Quad;

double magnitude(Quad x) { return std::abs(static_cast<double>(x)); }

// A x = b by complete pivoting, rows and columns weighed to like size.
std::vector<Quad> solved(std::vector<std::vector<Quad>> a, std::vector<Quad> b, const std::vector<double>& weight) {
  const std::size_t n = b.size();
  std::vector<std::size_t> row(n), column(n);
  for (std::size_t i = 0; i < n; ++i) row[i] = column[i] = i;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t r = k, c = k;
    double largest = -1;
    for (std::size_t i = k; i < n; ++i)
      for (std::size_t j = k; j < n; ++j)
        if (const double size = magnitude(a[row[i]][column[j]]) * weight[row[i]] * weight[column[j]]; size > largest)
          largest = size, r = i, c = j;
    std::swap(row[k], row[r]), std::swap(column[k], column[c]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Quad factor = a[row[i]][column[k]] / a[row[k]][column[k]];
      if (factor == 0) continue;
      for (std::size_t j = k; j < n; ++j) a[row[i]][column[j]] -= factor * a[row[k]][column[j]];
      b[row[i]] -= factor * b[row[k]];
    }
  }
  std::vector<Quad> x(n);
  for (std::size_t k = n; k-- > 0;) {
    Quad sum = b[row[k]];
    for (std::size_t j = k + 1; j < n; ++j) sum -= a[row[k]][column[j]] * x[column[j]];
    x[column[k]] = sum / a[row[k]][column[k]];
  }
  return x;
}

// Shafts that a tree of ties joins, some of it twice over.
struct Tree {
  std::size_t shafts = 0, free = 0, independent = 0;  // of the rows the first so many
  std::vector<ConstraintRow> rows;
  std::vector<std::vector<double>> repeats;  // per further row: the combination of the independent ones that it is
  std::vector<double> inertia, torque, given;
};

class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  Tree make(double decades, bool losses, bool repeating, bool massless = false) {
    Tree tree;
    tree.shafts = at(whole(3, 8));
    const bool prescribed = whole(0, 3) == 0;
    tree.free = tree.shafts - (prescribed ? 1 : 0);
    std::size_t joined = 1;
    const auto known = [&] { return whole(0, static_cast<int>(joined) - 1); };
    const auto next = [&] { return static_cast<int>(joined++); };
    while (joined < tree.shafts) {
      if (joined > 1 && whole(0, 5) == 0) joined += 1;  // a shaft in no row
      if (joined >= tree.shafts) break;
      const int a = known(), third = known(), b = next();
      std::vector<ShaftGain> motion = {{a, 1}, {b, gain()}};
      if (whole(0, 1) && joined < tree.shafts)
        motion.push_back({next(), gain()});
      else if (whole(0, 1) && third != a)
        motion.push_back({third, gain()});
      tree.rows.push_back(row_of(motion, losses));
    }
    if (!prescribed && whole(0, 2) == 0) tree.rows.push_back(row_of({{0, 1}}, false));  // a held shaft
    tree.independent = tree.rows.size();
    if (repeating && tree.independent > 0)
      for (int k = whole(1, 2); k > 0; --k) repeat(tree);
    for (std::size_t s = 0; s < tree.shafts; ++s) {
      tree.inertia.push_back(std::pow(10, real(-0.5, 0.5) * decades));
      tree.torque.push_back(real(-50, 50));
      tree.given.push_back(s < tree.free ? 0 : real(-9, 9));
    }
    // A shaft that the first row alone fixes.
    if (massless && tree.independent > 0 && at(tree.rows[0].motion[1].shaft) < tree.free)
      tree.inertia[at(tree.rows[0].motion[1].shaft)] = 0;
    return tree;
  }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double gain() { return (whole(0, 1) ? 1 : -1) * whole(3, 80) / 16.0; }  // so that repeated rows repeat exactly
  ConstraintRow row_of(const std::vector<ShaftGain>& motion, bool losses) {
    ConstraintRow row{motion, motion, std::pow(10, real(-3, 3))};
    for (ShaftGain& t : row.torque) t.gain = -t.gain;
    if (losses && whole(0, 1) && row.torque.size() > 1) row.torque[1].gain *= real(0.5, 1);
    return row;
  }
  void repeat(Tree& tree) {
    std::vector<double> part(tree.independent, 0.0);
    for (int k = whole(1, 3); k > 0; --k) part[at(whole(0, static_cast<int>(part.size()) - 1))] = gain();
    std::vector<double> sum(tree.shafts, 0.0);
    for (std::size_t r = 0; r < part.size(); ++r)
      for (const ShaftGain& g : tree.rows[r].motion) sum[at(g.shaft)] += part[r] * g.gain;
    std::vector<ShaftGain> motion;
    for (std::size_t s = 0; s < tree.shafts; ++s)
      if (sum[s] != 0) motion.push_back({static_cast<int>(s), sum[s]});
    tree.rows.push_back(row_of(motion, false));
    tree.repeats.push_back(part);
  }
  std::mt19937 random_;
};

// [I −T; G 0] [α; λ] = [M; −G_given α_given] over the independent rows, for one right-hand side.
std::vector<Quad> bordered(const Tree& tree, const std::vector<double>& torque, const std::vector<double>& given) {
  const std::size_t n = tree.free, m = tree.independent;
  std::vector<std::vector<Quad>> a(n + m, std::vector<Quad>(n + m, 0));
  std::vector<Quad> b(n + m, 0);
  std::vector<double> weight(n + m, 1);
  for (std::size_t s = 0; s < n; ++s) {
    a[s][s] = tree.inertia[s];
    b[s] = torque[s];
    weight[s] = 1 / std::sqrt(tree.inertia[s] + 1e-40);
  }
  for (std::size_t k = 0; k < m; ++k) {
    for (const ShaftGain& g : tree.rows[k].motion) {
      if (at(g.shaft) < n)
        a[n + k][at(g.shaft)] += g.gain;
      else
        b[n + k] -= static_cast<Quad>(g.gain) * given[at(g.shaft)];
    }
    for (const ShaftGain& t : tree.rows[k].torque)
      if (at(t.shaft) < n) a[at(t.shaft)][n + k] -= t.gain;
  }
  return solved(a, b, weight);
}

// Of all λ that do the same the one of least Σ λ²/capacity: λ₀ + N z, a column of N for every repeating row.
std::vector<Quad> shared(const Tree& tree, const std::vector<Quad>& alone) {
  const std::size_t m = tree.independent, q = tree.repeats.size();
  const auto null = [&](std::size_t row, std::size_t k) -> Quad {
    return row < m ? -static_cast<Quad>(tree.repeats[k][row]) : row == m + k ? 1 : 0;
  };
  std::vector<std::vector<Quad>> a(q, std::vector<Quad>(q, 0));
  std::vector<Quad> b(q, 0), lambda(m + q, 0);
  for (std::size_t r = 0; r < m; ++r) lambda[r] = alone[tree.free + r];
  for (std::size_t r = 0; r < m + q; ++r)
    for (std::size_t i = 0; i < q; ++i) {
      b[i] -= null(r, i) * lambda[r] / tree.rows[r].capacity;
      for (std::size_t j = 0; j < q; ++j) a[i][j] += null(r, i) * null(r, j) / tree.rows[r].capacity;
    }
  const std::vector<Quad> z = solved(a, b, std::vector<double>(q, 1.0));
  for (std::size_t r = 0; r < m + q; ++r)
    for (std::size_t i = 0; i < q; ++i) lambda[r] += null(r, i) * z[i];
  return lambda;
}

// What 34 digits are too few for: below this part of the others, by kinetic energy, it is none.
constexpr double none = 1e-19;

// Largest errors over what goes into a number: Σ |∂α/∂M| |M|, and for λ alike.
struct Errors {
  double alpha = 0, lambda = 0, motion = 0, mobility = 0;
};
Errors errors_of(const Tree& tree) {
  const std::size_t n = tree.free;
  Constraints constraints(n);
  constraints.set(tree.rows);
  std::vector<double> alpha = tree.given, lambda(tree.rows.size());
  constraints.solve(tree.inertia, tree.torque, alpha, lambda);
  EXPECT_FALSE(constraints.trouble());
  const std::vector<Quad> truth = bordered(tree, tree.torque, tree.given);
  const std::vector<Quad> true_lambda = shared(tree, truth);
  std::vector<double> alpha_size(n), lambda_size(tree.rows.size());
  std::vector<int> shafts(n);
  for (std::size_t s = 0; s < n; ++s) shafts[s] = static_cast<int>(s);
  const std::vector<double> w = constraints.mobility(tree.inertia, shafts);
  Errors worst;
  const auto root = [&](std::size_t s) { return std::sqrt(tree.inertia[s]); };
  const auto add = [&](const std::vector<Quad>& part, double times, double scale) {
    for (std::size_t i = 0; i < n; ++i)
      if (magnitude(part[i]) * std::min(1.0, root(i) * scale) > none) alpha_size[i] += magnitude(part[i]) * times;
    const std::vector<Quad> all = shared(tree, part);
    for (std::size_t k = 0; k < all.size(); ++k) lambda_size[k] += magnitude(all[k]) * times;
  };
  const std::vector<double> nothing(tree.shafts, 0.0);
  for (std::size_t s = 0; s < n; ++s) {
    std::vector<double> unit(tree.shafts, 0.0);
    unit[s] = 1;
    const std::vector<Quad> response = bordered(tree, unit, nothing);
    add(response, std::abs(tree.torque[s]), root(s));
    for (std::size_t i = 0; i < n; ++i) {
      const double size = magnitude(response[i]);
      if (size * root(i) * root(s) > none)
        worst.mobility = std::max(worst.mobility, magnitude(response[i] - w[i * n + s]) / size);
    }
  }
  add(bordered(tree, nothing, tree.given), 1, 1e100);
  for (std::size_t s = 0; s < n; ++s)
    if (alpha_size[s] > 0) worst.alpha = std::max(worst.alpha, magnitude(truth[s] - alpha[s]) / alpha_size[s]);
  for (std::size_t k = 0; k < tree.rows.size(); ++k)
    if (lambda_size[k] > 0)
      worst.lambda = std::max(worst.lambda, magnitude(true_lambda[k] - lambda[k]) / lambda_size[k]);
  for (const ConstraintRow& row : tree.rows) {
    double sum = 0, size = 0;
    for (const ShaftGain& g : row.motion) {
      sum += g.gain * alpha[at(g.shaft)];
      size += std::abs(g.gain) * (at(g.shaft) < n ? alpha_size[at(g.shaft)] : std::abs(alpha[at(g.shaft)]));
    }
    if (size > 0) worst.motion = std::max(worst.motion, std::abs(sum) / size);
  }
  return worst;
}

constexpr double all_decades[] = {0, 6, 12, 24};
constexpr unsigned trees = 150;

void expect_exact(bool losses, bool repeating, bool massless) {
  for (const double decades : all_decades)
    for (unsigned seed = 0; seed < trees; ++seed) {
      const Errors e = errors_of(RandomTree(seed).make(decades, losses, repeating, massless));
      ASSERT_LT(e.alpha, 2e-13) << decades << " decades, seed " << seed;
      ASSERT_LT(e.lambda, 1e-11) << decades << " decades, seed " << seed;
      ASSERT_LT(e.motion, 1e-12) << decades << " decades, seed " << seed;
      ASSERT_LT(e.mobility, 2e-12) << decades << " decades, seed " << seed;
    }
}

TEST(Ties, AccelerateAsByEliminationHoweverFarTheInertiasLieApart) { expect_exact(false, false, false); }
TEST(Ties, WithLossesAccelerateAsByElimination) { expect_exact(true, false, false); }
TEST(Ties, ThatRepeatOthersShareInProportionToCapacity) { expect_exact(false, true, false); }
TEST(Ties, CarryAShaftWithoutInertia) { expect_exact(false, false, true); }

// I ω′ = I ω + T λ, G ω′ = 0: of all speeds that the ties allow the nearest by kinetic energy, exact to round-off.
TEST(Ties, ProjectSpeedsWithTheLeastChangeOfKineticEnergy) {
  for (const double decades : all_decades)
    for (unsigned seed = 0; seed < trees; ++seed) {
      RandomTree random(seed);
      Tree tree = random.make(decades, false, seed % 2 == 1, seed % 3 == 0);
      std::vector<double> speed(tree.shafts), momentum(tree.shafts);
      for (std::size_t s = 0; s < tree.shafts; ++s) {
        speed[s] = random.real(-20, 20);
        momentum[s] = tree.inertia[s] * speed[s];
      }
      const std::vector<Quad> nearest = bordered(tree, momentum, speed);
      std::vector<double> projected = speed;
      Constraints constraints(tree.free);
      constraints.set(tree.rows);
      constraints.project(tree.inertia, projected);
      for (const ConstraintRow& row : tree.rows) {
        double sum = 0, size = 0;
        for (const ShaftGain& g : row.motion)
          sum += g.gain * projected[at(g.shaft)], size += std::abs(g.gain * projected[at(g.shaft)]);
        ASSERT_LE(std::abs(sum), 1e-12 * (size + 20)) << seed;
      }
      double most = 20;
      for (std::size_t s = 0; s < tree.free; ++s) most = std::max(most, magnitude(nearest[s]));
      for (std::size_t s = 0; s < tree.free; ++s)
        ASSERT_NEAR(projected[s], static_cast<double>(nearest[s]), 1e-12 * most)
            << decades << " decades, seed " << seed;
    }
}

// T = (−1, i η) against G = (1, −i): G I⁻¹ T = 0 at η = −I₂/(I₁ i²). Whatever the torques, they cannot be balanced.
TEST(Ties, OfAGearThatLocksItselfHaveNoAnswerAndSaySo) {
  const double ratio = 3, near = 0.7, far = 2.5;
  for (const double off : {0.0, 1e-9, -1e-9, 0.3}) {
    const double efficiency = -far / near / (ratio * ratio) * (1 + off);
    Constraints constraints(2);
    std::vector<double> alpha(2), lambda(1);
    constraints.set({{{{0, 1}, {1, -ratio}}, {{0, -1}, {1, ratio * efficiency}}, 1}});
    constraints.solve(std::vector{near, far}, std::vector{5.0, -4.0}, alpha, lambda);
    ASSERT_EQ(constraints.trouble().has_value(), off == 0) << off;
    if (off != 0) continue;
    EXPECT_EQ(constraints.trouble()->cause, Constraints::Trouble::Cause::locked);
    EXPECT_EQ(constraints.trouble()->row, 0u);
  }
}

// A trial step that went nowhere has inertias that are no numbers: so are its answers, and the next ones are as before.
TEST(Ties, SurviveInertiasThatAreNoNumbers) {
  Constraints constraints(2);
  constraints.set({{{{0, 1}, {1, -2}}, {{0, -1}, {1, 2}}, 1}});
  std::vector<double> alpha(2), lambda(1);
  for (const double lost : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    constraints.solve(std::vector{0.5, lost}, std::vector{3.0, 0.0}, alpha, lambda);
    constraints.solve(std::vector{0.5, 0.25}, std::vector{3.0, 0.0}, alpha, lambda);
    EXPECT_FALSE(constraints.trouble().has_value());
    EXPECT_NEAR(alpha[0], 3 / (0.5 + 0.25 / 4), 1e-14);
    EXPECT_NEAR(alpha[1], alpha[0] / 2, 1e-14);
  }
}

// ω₀ = ω₁ between two shafts that are both driven: only where they are driven alike.
TEST(Ties, OfPrescribedShaftsSayWhenTheyAreNotKept) {
  Constraints constraints(1);
  constraints.set({{{{0, 1}, {1, -1}}, {{0, -1}, {1, 1}}, 1}, {{{0, 1}, {2, -2}}, {{0, -1}, {2, 2}}, 1}});
  for (const double second : {2.0, 2.0 + 1e-15, 2.1}) {
    std::vector<double> alpha = {0, 4, second}, lambda(2);
    constraints.solve(std::vector{0.5, 0.0, 0.0}, std::vector{3.0, 0.0, 0.0}, alpha, lambda);
    ASSERT_EQ(constraints.trouble().has_value(), second == 2.1);
    if (second == 2.1) {
      EXPECT_EQ(constraints.trouble()->cause, Constraints::Trouble::Cause::contradicted);
      EXPECT_EQ(constraints.trouble()->row, 1u);
    } else {
      EXPECT_NEAR(alpha[0], 4, 1e-14);
      EXPECT_NEAR(lambda[0] + lambda[1], 3 - 0.5 * 4, 1e-14);
    }
  }
  // Nothing is free at all.
  Constraints none(0);
  none.set({{{{0, 1}, {1, -2}}, {{0, -1}, {1, 2}}, 1}});
  for (const double second : {2.0, 2.1}) {
    std::vector<double> alpha = {4, second}, lambda(1, 7.0);
    none.solve(std::vector{0.0, 0.0}, std::vector{0.0, 0.0}, alpha, lambda);
    EXPECT_EQ(none.trouble().has_value(), second == 2.1);
    EXPECT_EQ(lambda[0], 0);
  }
}

}  // namespace
}  // namespace kurbel::constraints_test
