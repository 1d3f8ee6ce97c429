// eigenvalues.cpp — of dense matrices, symmetric and not.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <stdexcept>

#include "engine/matrices/linear_algebra.h"

namespace kurbel {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

Eigen::SelfAdjointEigenSolver<MatrixXd> solved_symmetric(const MatrixXd& a, int options) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a, options);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the dense eigenvalue solver did not converge");
  return solver;
}

Eigen::EigenSolver<MatrixXd> solved(const MatrixXd& a, bool with_vectors) {
  if (!a.allFinite())  // the solver may not notice, and hand out what looks like a result
    throw std::runtime_error(
        fmt::format("a matrix of {} rows contains values that are not finite; it has no eigenvalues", a.rows()));
  const Eigen::EigenSolver<MatrixXd> solver(a, with_vectors);
  if (solver.info() != Eigen::Success)
    throw std::runtime_error(
        fmt::format("the eigenvalues of a matrix of {} rows were not found: the iteration did not converge", a.rows()));
  return solver;
}

}  // namespace

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const auto solver = solved_symmetric(a, Eigen::ComputeEigenvectors);
  return {solver.eigenvalues(), solver.eigenvectors()};
}
VectorXd symmetric_eigenvalues(const MatrixXd& a) { return solved_symmetric(a, Eigen::EigenvaluesOnly).eigenvalues(); }

Eigenpairs eigenpairs(const MatrixXd& a) {
  if (a.rows() == 0) return {};
  const auto solver = solved(a, true);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXcd eigenvalues(const MatrixXd& a) {
  if (a.rows() == 0) return {};
  return solved(a, false).eigenvalues();
}

}  // namespace kurbel
