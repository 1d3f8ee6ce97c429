// periodic_schur.h — eigenvalues and eigenvectors of a product of many small matrices, without ever forming the product.
//
//     A_k = Q_{k+1} T_k Q_kᴴ,  k = 0 … K−1,  Q_K = Q_0        T_k upper triangular, Q_k unitary
//     eigenvalues of A_{K−1} … A_1 A_0:  μ_j = Π_k (T_k)_jj
// A. Bojanczyk, G. Golub, P. Van Dooren, The periodic Schur decomposition, Proc. SPIE 1770, 1992. Rounding is equivalent to
// a small relative change of each factor, so that a multiplier of 1e-200 next to one of 1 is as accurate as the factors;
// the product would lose multipliers below 1e-16.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace kurbel {

struct PeriodicEigenvalue {
  double log_magnitude = 0;  // ln |μ|; −∞: a factor is singular
  double phase = 0;          // arg μ in (−π, π]
  // Σ_k ‖A_k‖/|u_{k+1}ᴴ A_k v_k| with unit vectors: |δ ln μ| ≤ sensitivity · max ‖δA_k‖/‖A_k‖ to first order.
  double sensitivity = 0;
  double error = 0;  // of ln μ: sensitivity times backward error
};

class PeriodicSchur {
 public:
  // Real square factors of equal size, A_0 first (it acts first). Throws std::invalid_argument if there are none, if sizes
  // differ or entries are not finite; std::runtime_error if the iteration does not converge.
  explicit PeriodicSchur(const std::vector<Eigen::MatrixXd>& factors);

  std::size_t size() const { return static_cast<std::size_t>(triangular_.front().rows()); }
  std::size_t count() const { return triangular_.size(); }
  // Largest magnitude first.
  const std::vector<PeriodicEigenvalue>& eigenvalues() const { return eigenvalues_; }
  // Unit vectors v_k before each factor for the eigenvalue j in the order above: A_k v_k = ν_k v_{k+1}, Π ν_k = μ.
  std::vector<Eigen::VectorXcd> vectors(std::size_t j) const;
  // Largest ‖A_k − Q_{k+1} T_k Q_kᴴ‖/‖A_k‖, at least the rounding error.
  double backward_error() const { return backward_error_; }

 private:
  std::vector<Eigen::VectorXcd> right(Eigen::Index diagonal) const;
  std::vector<Eigen::VectorXcd> left(Eigen::Index diagonal) const;
  double sensitivity(Eigen::Index diagonal) const;

  std::vector<Eigen::MatrixXcd> triangular_, unitary_;  // factors over their norms
  std::vector<Eigen::Index> place_;                     // on the diagonal, per eigenvalue
  std::vector<PeriodicEigenvalue> eigenvalues_;
  double backward_error_ = 0;
};

}  // namespace kurbel
