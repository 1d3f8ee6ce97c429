#include "tests/support/eigen_solutions.h"

#include <Eigen/Dense>

namespace kurbel::test {

EigenSolution eigen_solution(const Eigen::MatrixXd& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

std::vector<std::complex<double>> eigenvalues_of(const LongMatrix& a) {
  const Eigen::VectorXcd values = Eigen::EigenSolver<LongMatrix>(a, false).eigenvalues().cast<std::complex<double>>();
  return {values.begin(), values.end()};
}

PairSolution solution_of_pair(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(k, m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& a) { return a.partialPivLu().inverse(); }
Eigen::VectorXd solved(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) { return a.partialPivLu().solve(b); }
Eigen::VectorXcd solved_complex(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b) {
  return a.partialPivLu().solve(b);
}
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

}  // namespace kurbel::test
