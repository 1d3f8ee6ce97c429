// coordinates.h — independent coordinates of the shafts with their present ties, ω = Z q̇.
//
//     G ω = 0 (relations of gears, stuck contacts)   ⇒   ω = Z q̇,   Zᵀ I Z diagonal
// An untied shaft is a coordinate. Shafts that move together are one coordinate, named after the shaft with the most kinetic
// energy, which has its speed. If a gear leaves two motions free, they are chosen without inertial coupling. Shafts at
// standstill and shafts with prescribed speed belong to no coordinate.
#pragma once

#include <span>
#include <vector>

#include "engine/equations/ties.h"
#include "engine/matrices/linear_algebra.h"

namespace kurbel {

struct Coordinates {
  SparseMatrix motion;     // Z: shafts × coordinates; rows of prescribed shafts are empty
  std::vector<int> shaft;  // per coordinate: the shaft after which it is named
  Eigen::Index size() const { return motion.cols(); }
  // q̇ of the motion nearest to these speeds of all shafts in the norm of kinetic energy.
  Eigen::VectorXd rates(std::span<const double> speed, const Eigen::VectorXd& inertia) const;
};

// `inertia`: of every shaft [kg·m²].
Coordinates coordinates_of(const Model& model, const Ties& ties, const Eigen::VectorXd& inertia);

// Motions q of the coordinates without twist: T q = 0 with T = `twists`; one per column, its largest entry 1.
Eigen::MatrixXd motions_without_twist(const SparseMatrix& twists);

}  // namespace kurbel
