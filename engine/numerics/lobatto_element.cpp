// lobatto_element.cpp — points, weights and stiffness of a spectral element; what it and the continuum do to their ends.
#include "engine/numerics/lobatto_element.h"

#include <cmath>
#include <stdexcept>

#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// P_{p−1} and P_p.
std::pair<double, double> legendre_pair(int p, double x) {
  double before = 1, here = x;
  for (int k = 1; k < p; ++k) {
    const double next = ((2 * k + 1) * x * here - k * before) / (k + 1);
    before = here, here = next;
  }
  return {before, here};
}

// Zeros of (1 − x²) P_p′ by Newton, from those of Chebyshev.
VectorXd lobatto_points(int p) {
  VectorXd x(p + 1);
  for (Index i = 0; i <= p; ++i) {
    double z = -std::cos(pi * static_cast<double>(i) / p);
    for (int round = 0; round < 30 && i > 0 && i < p; ++round) {
      const auto [before, here] = legendre_pair(p, z);
      const double slope = p * (before - z * here) / (1 - z * z);
      z -= slope * (1 - z * z) / (2 * z * slope - p * (p + 1) * here);
    }
    x[i] = z;
  }
  return x;
}

// Of the points: ∫ φ′ ψ′ on [0, 1], integrated exactly.
MatrixXd point_stiffness(const VectorXd& x, const VectorXd& weight) {
  const Index n = x.size();
  const auto p = static_cast<int>(n) - 1;
  VectorXd value(n);
  for (Index i = 0; i < n; ++i) value[i] = legendre_pair(p, x[i]).second;
  MatrixXd slope = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      if (i != j) slope(i, j) = value[i] / (value[j] * (x[i] - x[j]));
  slope(0, 0) = -0.25 * p * (p + 1);
  slope(p, p) = -slope(0, 0);
  return 4 * slope.transpose() * weight.asDiagonal() * slope;  // d/d(place) = 2 d/dx
}

// −dφ/ds at s = ½ by the twists between neighbours: of each the slopes of all points behind it. No point is there.
VectorXd twists_in_the_middle(const VectorXd& x) {
  const Index n = x.size();
  VectorXd by_twist = VectorXd::Zero(n - 1);
  for (Index i = 1; i < n; ++i) {
    double value = 1, slope = 0;  // of the polynomial that is 1 at this point, 0 at the others; d/ds = 2 d/dx
    for (Index j = 0; j < n; ++j)
      if (j != i) value *= -x[j] / (x[i] - x[j]), slope -= 2 / x[j];
    by_twist.head(i).array() += value * slope;
  }
  return by_twist;
}

struct Made : LobattoElement {
  MatrixXd points;  // stiffness between the points
  MatrixXd inner;   // the same between its ends, over the inertias of both

  explicit Made(int p) {
    degree = p;
    const VectorXd x = lobatto_points(p);
    VectorXd w(p + 1);
    for (Index i = 0; i <= p; ++i) w[i] = 1 / (p * (p + 1) * std::pow(legendre_pair(p, x[i]).second, 2));
    for (Index i = 0; i <= p; ++i) {
      place.push_back(0.5 * (1 + x[i]));
      weight.push_back(w[i]);
    }
    points = point_stiffness(x, w);
    // φ_i = φ_0 − Σ_{k ≤ i} θ_k
    MatrixXd by_twist = MatrixXd::Zero(p + 1, p);
    for (Index i = 1; i <= p; ++i) by_twist.row(i).head(i).setConstant(-1);
    MatrixXd s = by_twist.transpose() * points * by_twist;
    s = 0.5 * (s + s.transpose()).eval();
    const MatrixXd inverse = Lu(s).inverse();
    for (Index k = 0; k < p; ++k)
      for (Index l = 0; l < p; ++l) stiffness.push_back(s(k, l)), compliance.push_back(inverse(k, l));
    if (p == 1) return;
    if (p % 2 == 1) {
      const VectorXd torque = inverse.transpose() * twists_in_the_middle(x);
      middle.assign(torque.begin(), torque.end());
    }
    const VectorXd scale = w.segment(1, p - 1).cwiseSqrt().cwiseInverse();
    inner = scale.asDiagonal() * points.block(1, 1, p - 1, p - 1) * scale.asDiagonal();
  }
};

const Made& made(int degree) {
  static const std::vector<Made> all = [] {
    std::vector<Made> list;
    for (int p = 1; p <= highest_lobatto_degree; ++p) list.emplace_back(p);
    return list;
  }();
  if (degree < 1 || degree > highest_lobatto_degree) throw std::out_of_range("degree of a shaft's element");
  return all[at(degree - 1)];
}

// Between two angles, modulo half a turn.
double apart(double a, double b) { return std::abs(std::remainder(a - b, pi)); }

}  // namespace

const LobattoElement& lobatto_element(int degree) { return made(degree); }

EndStiffness exact_stiffness(double x) {
  if (x == 0) return {0, 2};
  return {-x * std::tan(0.5 * x), x / std::tan(0.5 * x)};
}

EndStiffness element_stiffness(int degree, double x) {
  const Made& e = made(degree);
  const Index p = degree;
  MatrixXd d = e.points;
  for (Index i = 0; i <= p; ++i) d(i, i) -= x * x * e.weight[at(i)];
  double own = d(0, 0), other = d(0, p);
  if (p > 1) {
    const VectorXd from_in = d.col(0).segment(1, p - 1), from_out = d.col(p).segment(1, p - 1);
    const VectorXd follows = Lu(d.block(1, 1, p - 1, p - 1)).solve(from_in);
    own -= from_in.dot(follows), other -= from_out.dot(follows);
  }
  return {own + other, own - other};
}

double dispersion(int degree, double x) {
  if (x <= 0) return 0;
  const EndStiffness exact = exact_stiffness(x), element = element_stiffness(degree, x);
  // What an end's stiffness says of the wave's phase there: d = −x tan, or x cot, of half the way.
  return (apart(std::atan2(exact.together, x), std::atan2(element.together, x)) +
          apart(std::atan2(exact.against, x), std::atan2(element.against, x))) /
         x;
}

int held_modes_below(double x) { return static_cast<int>(std::ceil(x / pi)) - 1; }
int held_modes_below(int degree, double x) {
  static const std::vector<VectorXd> all = [] {  // x of the modes with both ends held
    std::vector<VectorXd> list(1);
    for (int p = 2; p <= highest_lobatto_degree; ++p) list.push_back(symmetric_eigenvalues(made(p).inner).cwiseSqrt());
    return list;
  }();
  return static_cast<int>((all.at(at(degree - 1)).array() < x).count());
}

}  // namespace kurbel
