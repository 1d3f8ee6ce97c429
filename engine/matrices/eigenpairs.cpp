// eigenpairs.cpp — Eigen's solver, instantiated once, its success looked at.
#include "engine/matrices/eigenpairs.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <stdexcept>

namespace kurbel {
namespace {

Eigen::EigenSolver<Eigen::MatrixXd> solved(const Eigen::MatrixXd& a, bool with_vectors) {
  if (!a.allFinite())  // the solver may not notice, and hand out what looks like a result
    throw std::runtime_error(
        fmt::format("the eigenvalues of a matrix of {} rows were asked for that holds no numbers", a.rows()));
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, with_vectors);
  if (solver.info() != Eigen::Success)
    throw std::runtime_error(
        fmt::format("the eigenvalues of a matrix of {} rows were not found: the iteration did not converge", a.rows()));
  return solver;
}

}  // namespace

Eigenpairs eigenpairs(const Eigen::MatrixXd& a) {
  if (a.rows() == 0) return {};
  const auto solver = solved(a, true);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a) {
  if (a.rows() == 0) return {};
  return solved(a, false).eigenvalues();
}

}  // namespace kurbel
