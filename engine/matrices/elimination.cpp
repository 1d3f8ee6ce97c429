// elimination.cpp — pivots by weights, zeros recognised by what was cancelled.
#include "engine/matrices/elimination.h"

#include <algorithm>
#include <cmath>

namespace kurbel {
namespace {

constexpr double round_off = 1e-12;  // of what was added and taken away

// row −= factor · pivot row, entry by entry.
void take_away(Eigen::MatrixXd& rows, Eigen::MatrixXd& size, Eigen::Index row, Eigen::Index pivot, double factor) {
  for (Eigen::Index j = 0; j < rows.cols(); ++j) {
    const double part = factor * rows(pivot, j);
    if (part == 0) continue;
    double& entry = rows(row, j);
    entry -= part;
    size(row, j) = std::max(size(row, j), std::abs(factor) * size(pivot, j));
    if (std::abs(entry) <= round_off * size(row, j)) entry = 0;
  }
}

}  // namespace

Eliminated eliminate(Eigen::MatrixXd rows, const std::vector<std::size_t>& order, const Eigen::VectorXd& weight) {
  const Eigen::Index m = rows.rows(), given = rows.cols();
  rows.conservativeResize(m, given + m);
  rows.rightCols(m).setIdentity();
  Eigen::MatrixXd size = rows.cwiseAbs();
  Eliminated result;
  for (const std::size_t next : order) {
    const auto row = static_cast<Eigen::Index>(next);
    double largest = 0;
    Eigen::Index column = 0;
    for (Eigen::Index j = 0; j < weight.size(); ++j)
      if (const double weighed = std::abs(rows(row, j)) * weight[j]; weighed > largest) largest = weighed, column = j;
    if (largest == 0) continue;
    result.row.push_back(row);
    result.column.push_back(column);
    const double pivot = rows(row, column);
    rows.row(row) /= pivot;
    size.row(row) /= std::abs(pivot);
    rows(row, column) = 1;
    for (Eigen::Index i = 0; i < m; ++i) {
      if (i == row || rows(i, column) == 0) continue;
      take_away(rows, size, i, row, rows(i, column));
      rows(i, column) = 0;
    }
  }
  result.rows = rows.leftCols(given);
  result.combination = rows.rightCols(m);
  return result;
}

bool invert(RowMatrix& a, double least) {
  const Eigen::Index n = a.rows();
  RowMatrix inverse = RowMatrix::Identity(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    if (!(std::abs(a(pivot, k)) > least)) return false;
    if (pivot != k) a.row(pivot).swap(a.row(k)), inverse.row(pivot).swap(inverse.row(k));
    const double over = 1 / a(k, k);
    a.row(k) *= over, inverse.row(k) *= over;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double factor = a(i, k);
      if (i == k || factor == 0) continue;
      a.row(i) -= factor * a.row(k), inverse.row(i) -= factor * inverse.row(k);
    }
  }
  a = inverse;
  return true;
}

}  // namespace kurbel
