// elimination.h — Gauss–Jordan elimination that distinguishes redundant rows from rows with small entries.
//
// In rows with speeds of heavy and light shafts the entries differ by decades. The remainder of a row may be small because
// its entries are small, or because the row is redundant. Entries are therefore compared with the terms added and
// subtracted at the same position: less than 1e-12 of them is round-off and is set to zero.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace kurbel {

struct Eliminated {
  // row[p] was solved for the unknown column[p]; their number is the rank.
  std::vector<Eigen::Index> row, column;
  // The eliminated rows: pivot columns are unit vectors, columns after the unknowns are transformed as well.
  Eigen::MatrixXd rows;
  // Every row as a combination of the given rows: rows = combination · given.
  Eigen::MatrixXd combination;

  std::size_t rank() const { return row.size(); }
};

// Rows are processed in this order; each is redundant or solved for the unknown with the largest entry times weight (> 0).
// The unknowns are the first weight.size() columns. With weights that differ by decades the unknowns of largest weight
// are solved for where possible.
Eliminated eliminate(Eigen::MatrixXd rows, const std::vector<std::size_t>& order, const Eigen::VectorXd& weight);

// Inverts a square matrix in place with row pivots; its rows and columns should be scaled. False, with the matrix
// destroyed, if a pivot is ≤ `least`, relative to the terms summed in its entry.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
bool invert(RowMatrix& a, double least);

}  // namespace kurbel
