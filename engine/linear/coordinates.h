// coordinates.h — what may move apart from what: independent coordinates of the shafts under their present ties, ω = Z q̇.
//
//     G ω = 0 (relations of gears, stuck contacts)   ⇒   ω = Z q̇,   Zᵀ I Z diagonal
// A shaft that nothing ties is a coordinate of its own. Shafts that move together are one, named after the one that
// carries the most kinetic energy, which turns with it 1 : 1. Where a gear leaves two motions free, they are chosen so that
// inertia does not couple them. Shafts that stand, and those whose speed is prescribed, are in none.
#pragma once

#include <span>
#include <vector>

#include "engine/equations/ties.h"
#include "engine/matrices/linear_algebra.h"

namespace kurbel {

struct Coordinates {
  SparseMatrix motion;     // Z: shafts × coordinates; rows of prescribed shafts are empty
  std::vector<int> shaft;  // per coordinate: the one that names it
  Eigen::Index size() const { return motion.cols(); }
  // q̇ of the motion nearest to these speeds of all shafts, by kinetic energy.
  Eigen::VectorXd rates(std::span<const double> speed, const Eigen::VectorXd& inertia) const;
};

// `inertia`: of every shaft [kg·m²].
Coordinates coordinates_of(const Model& model, const Ties& ties, const Eigen::VectorXd& inertia);

// Motions q of the coordinates under which no row of `twists` turns: T q = 0, one per column, its largest entry 1.
Eigen::MatrixXd motions_without_twist(const SparseMatrix& twists);

}  // namespace kurbel
