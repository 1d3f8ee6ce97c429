// continuous_extension.cpp — the bootstrapped stages of a dense output and its coefficients, by linear algebra.
#include "engine/steppers/continuous_extension.h"

#include <cmath>

#include "engine/matrices/linear_algebra.h"

namespace kurbel {
namespace {

// Interior points of each pass: those of a grid with the smallest error of the next higher power times 1 + the sum of
// the magnitudes by which errors of the slopes enter.
const std::vector<std::vector<double>> points_of_round = {
    {0.725}, {0.2, 0.8}, {0.15, 0.375, 0.875}, {0.1, 0.3, 0.7, 0.9}};

// x² (1−x)² times x, (1−x) in turn: the j-th function of the interpolant's own part, and its derivative.
struct OwnFunction {
  double value, slope;
};
OwnFunction own_function(std::size_t j, double x) {
  const double a = 2 + static_cast<double>((j + 1) / 2), b = 2 + static_cast<double>(j / 2), u = 1 - x;
  return {std::pow(x, a) * std::pow(u, b),
          a * std::pow(x, a - 1) * std::pow(u, b) - b * std::pow(x, a) * std::pow(u, b - 1)};
}

// Weights of all slopes, zeros too.
Eigen::VectorXd spread(const Combination& combination, std::size_t size) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size));
  for (const Term& term : combination) weights[static_cast<Eigen::Index>(term.stage)] = term.weight;
  return weights;
}

Combination gathered(const Eigen::VectorXd& weights) {
  Combination combination;
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    if (weights[i] != 0) combination.push_back({static_cast<std::size_t>(i), weights[i]});
  return combination;
}

class Extension {
 public:
  explicit Extension(EmbeddedTable& table) : table_(table), end_(table.stages) {}

  void add_round(const std::vector<double>& points) {
    const std::size_t first = table_.row.size();
    for (const double x : points) {
      table_.node.push_back(x);
      table_.row.push_back(gathered(value_at(x)));
    }
    fit(points, first);
  }

 private:
  std::size_t size() const { return table_.row.size(); }
  Eigen::VectorXd slope_of(std::size_t stage) const { return spread({{stage, 1.0}}, size()); }
  Eigen::VectorXd rise() const { return spread(table_.row[end_], size()); }

  // (y(t + x h) − y)/h of Hermite's cubic, and d/dx of it.
  Eigen::VectorXd cubic(double x) const {
    return x * x * (3 - 2 * x) * rise() + x * (1 - x) * (1 - x) * slope_of(0) - x * x * (1 - x) * slope_of(end_);
  }
  Eigen::VectorXd cubic_slope(double x) const {
    return 6 * x * (1 - x) * rise() + (1 - x) * (1 - 3 * x) * slope_of(0) + x * (3 * x - 2) * slope_of(end_);
  }
  Eigen::VectorXd value_at(double x) const {
    Eigen::VectorXd value = cubic(x);
    for (std::size_t j = 0; j < table_.dense.size(); ++j)
      value += own_function(j, x).value * spread(table_.dense[j], size());
    return value;
  }

  // The own part that gives the interpolant the new stages' slopes at their points.
  void fit(const std::vector<double>& points, std::size_t first) {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd functions(n, n), wanted(n, static_cast<Eigen::Index>(size()));
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = points[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < n; ++j) functions(i, j) = own_function(static_cast<std::size_t>(j), x).slope;
      wanted.row(i) = slope_of(first + static_cast<std::size_t>(i)) - cubic_slope(x);
    }
    const Eigen::MatrixXd own = Lu(functions).solve_all(wanted);
    table_.dense.clear();
    for (Eigen::Index j = 0; j < n; ++j) table_.dense.push_back(gathered(own.row(j)));
  }

  EmbeddedTable& table_;
  std::size_t end_;
};

}  // namespace

EmbeddedTable with_continuous_extension(EmbeddedTable table, int rounds) {
  Extension extension(table);
  for (int round = 0; round < rounds; ++round) extension.add_round(points_of_round.at(static_cast<std::size_t>(round)));
  return table;
}

}  // namespace kurbel
