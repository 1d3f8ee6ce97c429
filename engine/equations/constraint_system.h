// constraint_system.h — constraint rows and their factorisations: the matrices behind constraints.h.
#pragma once

#include "engine/equations/constraints.h"
#include "engine/matrices/elimination.h"

namespace kurbel {

class Constraints::System {
 public:
  explicit System(std::size_t free_shafts) : free_(free_shafts) { list_shafts(); }
  void set(const std::vector<ConstraintRow>& rows);
  bool empty() const { return rows_.empty(); }
  bool repeats() const { return !repeating_.empty(); }
  void share_by(const std::vector<double>& capacity);
  void solve(std::span<const double> inertia, std::span<const double> torque, std::span<double> alpha,
             std::span<double> multiplier);
  const std::optional<Trouble>& trouble() const { return trouble_; }
  void project(std::span<const double> inertia, std::span<double> speed);
  std::vector<double> mobility(std::span<const double> inertia, std::span<const int> shafts);
  double mobility(std::span<const double> inertia, std::span<const ShaftGain> motion,
                  std::span<const ShaftGain> torque);

 private:
  using Matrix = RowMatrix;

  void list_shafts();
  void factorise(std::span<const double> inertia);
  Eigen::VectorXd shaft_weights() const;
  void choose_leaders();
  void find_torque_space();
  bool reduce(const Matrix& left, const std::vector<std::size_t>& unit, Matrix& inverse) const;
  void respond_to_repeating();
  void share();
  void accelerate(const double* torque, const double* shift, double* alpha, double* lambda);
  bool is_kept(std::span<const double> alpha, std::span<const double> multiplier);
  void look_for_trouble(std::span<const double> alpha, std::span<const double> multiplier);
  bool is_lossy() const;
  std::size_t lossiest() const;

  std::size_t free_;
  std::vector<ConstraintRow> rows_;
  std::vector<int> tied_, given_, loose_;  // free shafts in rows, prescribed shafts in rows, other free shafts
  std::vector<int> place_;                 // index of every shaft in its list
  Matrix motion_, torque_;                 // G over the tied, then the given shafts; −T over the tied ones; by rows
  std::vector<double> lossy_, strength_;   // per row: deviation of T from −Gᵀ; capacity as a torque on its shafts
  std::vector<double> capacity_;           // per row, for the shares

  // Depending on the magnitudes of the inertias. Indices among the tied shafts:
  std::vector<int> magnitude_;                  // of each inertia, in steps of 2⁸
  std::vector<std::size_t> basic_, repeating_;  // independent rows, redundant rows
  std::vector<std::size_t> follow_, lead_;      // dependent and independent shafts of the motion
  std::vector<std::size_t> bear_, free_of_;     // equations of motion that give λ, and the others: Yᵀ's unit part
  Matrix allowed_, torque_free_;                // Z, Y: by tied shafts
  Matrix by_given_;                             // ∂α by the accelerations of the given shafts
  Matrix follow_inverse_, bear_inverse_;  // G⁻¹ and (−T)⁻¹ of basic rows and those shafts: by shafts, basic rows

  // Depending on the inertias:
  std::vector<double> inertia_;  // of the tied shafts; empty: unknown
  Matrix reduced_inverse_;       // (Yᵀ I Z)⁻¹
  bool locked_ = false;          // Yᵀ I Z is singular
  // λ of the redundant rows from that of the basic ones alone; effect of their λ = 1 on the basic λ and on α.
  Matrix shares_, share_multiplier_, share_alpha_;

  std::optional<Trouble> trouble_;
  std::vector<double> tied_torque_, alpha_, lambda_, shift_, right_, rest_, size_;  // working arrays
};

}  // namespace kurbel
