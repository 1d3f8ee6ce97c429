// constraints.h — speeds that move together: locked clutches, held brakes, relations of gears, as rows G ω = 0.
//
//     I α = M + T λ,   G α = 0   ⇒   (G I⁻¹ T) λ = −G I⁻¹ M
// One row takes one degree of freedom out. λ is the torque that the row transmits. T = −Gᵀ, but for gears with losses.
// Where rows say the same twice (two brakes on one coordinate) each carries its share in proportion to its capacity:
// of all λ, the one of least Σ λ²/capacity.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/model.h"

namespace kurbel {

struct ConstraintRow {
  std::vector<ShaftGain> motion;  // G: Σ gain ω = 0
  std::vector<ShaftGain> torque;  // T: what λ = 1 does to the shafts
  double capacity = 1;            // [N·m], > 0
};

class Constraints {
 public:
  // Shafts from free_shafts on are prescribed: their accelerations are given.
  explicit Constraints(std::size_t free_shafts = 0) : free_(free_shafts) {}
  void set(std::vector<ConstraintRow> rows);
  bool empty() const { return rows_.empty(); }

  // Accelerations of the free shafts from the torques on them, and the rows' multipliers. In: alpha of prescribed
  // shafts. Shafts in no row are solved as well.
  void solve(std::span<const double> inertia, std::span<const double> torque, std::span<double> alpha,
             std::span<double> multiplier);
  // The speeds nearest to the given ones, by kinetic energy, that obey the rows.
  void project(std::span<const double> inertia, std::span<double> speed);
  // ∂α/∂M over these free shafts: I⁻¹ − I⁻¹ T (G I⁻¹ T)⁻¹ G I⁻¹.
  Eigen::MatrixXd mobility(std::span<const double> inertia, std::span<const int> shafts);

 private:
  bool solve_one(std::span<const double> inertia, std::span<double> alpha, double& multiplier) const;
  void factorise(std::span<const double> inertia, bool symmetric = false);
  Eigen::VectorXd multipliers(const Eigen::VectorXd& right) const;

  std::size_t free_;
  std::vector<ConstraintRow> rows_;
  std::vector<double> factorised_for_;  // inertias
  bool singular_ = false;
  Eigen::MatrixXd schur_;
  Eigen::VectorXd root_capacity_, right_, right_side_;
  Eigen::PartialPivLU<Eigen::MatrixXd> regular_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_;
};

}  // namespace kurbel
