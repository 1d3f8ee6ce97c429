// elimination.h — Gauss–Jordan elimination that tells a row which says nothing new from one that speaks of little.
//
// In rows that hold speeds of heavy and light shafts the numbers lie decades apart, and what elimination leaves of a
// row may be small because its shafts count little, or because the row repeats others. Entries are therefore judged by
// what was added and taken away in their own place: less than 1e-12 of that is round-off, and becomes zero.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace kurbel {

struct Eliminated {
  // row[p] was solved for the unknown column[p]; so many are the rank.
  std::vector<Eigen::Index> row, column;
  // The rows after it: pivot columns are unit vectors, columns beyond the unknowns were carried along.
  Eigen::MatrixXd rows;
  // The combination of the given rows that every row became: rows = combination · given.
  Eigen::MatrixXd combination;

  std::size_t rank() const { return row.size(); }
};

// The rows are gone through in this order; each is solved for the unknown whose entry, times the unknown's weight > 0,
// is largest, or repeats those before. The unknowns are the first weights-many columns. With weights decades apart
// those of most weight that can be solved for are.
Eliminated eliminate(Eigen::MatrixXd rows, const std::vector<std::size_t>& order, const Eigen::VectorXd& weight);

// A square matrix becomes its inverse, by row pivots; its rows and columns should be of like size. False, with the
// matrix spoilt, where a pivot is no larger than `least`, of the size of what its entries were summed from.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
bool invert(RowMatrix& a, double least);

}  // namespace kurbel
