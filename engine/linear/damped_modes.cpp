// damped_modes.cpp — eigenvalues of the damped drive: dense; large drives by Newton from the undamped modes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/linear/eigen_modes.h"
#include "engine/matrices/linear_algebra.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The state of first order in springs' and inertias' own scales, x = [√k θ, √J ω, z/scale], is skew-symmetric without
// damping.
struct FirstOrder {
  MatrixXd a;
  Index speeds = 0, own = 0;  // where they begin
};

// Twists of joints that anything depends on.
FirstOrder by_twists(const LinearDrive& drive) {
  const Index n = drive.size(), z = drive.internal_states();
  std::vector<Index> joints;
  VectorXd root(static_cast<Index>(drive.joints.size()));
  for (Index j = 0; j < root.size(); ++j) {
    const double k = drive.joints[at(j)].stiffness;
    root[j] = k > 0 ? std::sqrt(k) : 1;
    if (drive.torque_by_twist.col(j).norm() > 0 || (z > 0 && drive.internal_by_twist.col(j).norm() > 0))
      joints.push_back(j);
  }
  const auto t = static_cast<Index>(joints.size());
  const VectorXd scale = drive.inertia.cwiseSqrt().cwiseInverse();
  const MatrixXd twists = MatrixXd(drive.twists) * scale.asDiagonal(),
                 torque = scale.asDiagonal() * MatrixXd(drive.torque_by_twist);
  const MatrixXd own = z > 0 ? MatrixXd(drive.internal_by_twist) : MatrixXd(0, root.size());
  FirstOrder f{MatrixXd::Zero(t + n + z, t + n + z), t, t + n};
  for (Index i = 0; i < t; ++i) {
    const Index j = joints[at(i)];
    f.a.block(i, t, 1, n) = root[j] * twists.row(j);
    f.a.block(t, i, n, 1) = torque.col(j) / root[j];
    if (z > 0) f.a.block(t + n, i, z, 1) = drive.internal_scale.cwiseInverse().cwiseProduct(own.col(j)) / root[j];
  }
  return f;
}

// With the link held at an angle: x = [√J q, √J ω, z/scale].
FirstOrder by_angles(const LinearDrive& drive) {
  const Index n = drive.size(), z = drive.internal_states();
  const VectorXd scale = drive.inertia.cwiseSqrt().cwiseInverse();
  FirstOrder f{MatrixXd::Zero(2 * n + z, 2 * n + z), n, 2 * n};
  f.a.block(0, n, n, n).setIdentity();
  f.a.block(n, 0, n, n) =
      -(scale.asDiagonal() * MatrixXd(drive.stiffness + drive.other_stiffness) * scale.asDiagonal());
  if (z > 0)
    f.a.block(2 * n, 0, z, n) = drive.internal_scale.cwiseInverse().asDiagonal() *
                                MatrixXd(product(drive.internal_by_twist, drive.twists) + drive.internal_by_angle) *
                                scale.asDiagonal();
  return f;
}

FirstOrder first_order(const LinearDrive& drive) {
  const Index n = drive.size(), z = drive.internal_states();
  FirstOrder f = drive.at.angle ? by_angles(drive) : by_twists(drive);
  const VectorXd scale = drive.inertia.cwiseSqrt().cwiseInverse();
  f.a.block(f.speeds, f.speeds, n, n) = -(scale.asDiagonal() * MatrixXd(drive.damping) * scale.asDiagonal());
  if (z == 0) return f;
  const VectorXd per_internal = drive.internal_scale.cwiseInverse();
  f.a.block(f.speeds, f.own, n, z) =
      scale.asDiagonal() * MatrixXd(drive.torque_by_internal) * drive.internal_scale.asDiagonal();
  f.a.block(f.own, f.speeds, z, n) = per_internal.asDiagonal() * MatrixXd(drive.internal_by_speed) * scale.asDiagonal();
  f.a.block(f.own, f.own, z, z) =
      per_internal.asDiagonal() * MatrixXd(drive.internal_by_internal) * drive.internal_scale.asDiagonal();
  return f;
}

DampedMode normalised(std::complex<double> lambda, Eigen::VectorXcd shape) {
  Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  shape /= shape[largest];
  return {.lambda = lambda, .shape = std::move(shape)};
}

void sort_modes(std::vector<DampedMode>& modes) {
  std::stable_sort(modes.begin(), modes.end(), [](const DampedMode& x, const DampedMode& y) {
    const bool swings_x = x.lambda.imag() > 0, swings_y = y.lambda.imag() > 0;
    if (swings_x != swings_y) return swings_x;
    return std::abs(x.lambda) < std::abs(y.lambda);
  });
}

// Of each eigenvalue: its condition number times the backward error of its pair and of the solver. `left`: rows.
VectorXd eigenvalue_errors(const MatrixXd& a, const Eigenpairs& pairs, const Eigen::MatrixXcd& left) {
  const double backward = 4 * std::numeric_limits<double>::epsilon() *
                          std::sqrt(a.cwiseAbs().rowwise().sum().maxCoeff() * a.cwiseAbs().colwise().sum().maxCoeff());
  VectorXd error(a.rows());
  for (Index i = 0; i < a.rows(); ++i) {
    const Eigen::VectorXcd v = pairs.vectors.col(i);
    const double residual = (complex_image(a, v) - pairs.values[i] * v).norm() / v.norm();
    const double condition = left.row(i).norm() * v.norm();
    error[i] = std::isfinite(condition) ? condition * (residual + backward) : std::sqrt(backward * a.norm());
  }
  return error;
}

// Where eigenvectors are parallel, and no left one is known, by the right one alone.
EnergyParts energy_parts(const FirstOrder& system, const Eigen::VectorXcd& left, const Eigen::VectorXcd& right) {
  VectorXd part = left.cwiseProduct(right).cwiseAbs();
  if (!part.allFinite() || part.sum() == 0) part = right.cwiseAbs2();
  part /= part.sum();
  const VectorXd own = part.tail(part.size() - system.own);
  return {.springs = part.head(system.speeds).sum(),
          .inertias = part.segment(system.speeds, system.own - system.speeds).sum(),
          .own = std::vector<double>(own.begin(), own.end())};
}

std::vector<DampedMode> dense_damped(const LinearDrive& drive) {
  const FirstOrder system = first_order(drive);
  const MatrixXd& a = system.a;
  const Eigenpairs pairs = eigenpairs(a);
  const double noise = 1e-12 * a.norm();
  const Eigen::MatrixXcd left = ComplexLu(pairs.vectors).inverse();  // rows
  const VectorXd error = eigenvalue_errors(a, pairs, left), scale = drive.inertia.cwiseSqrt().cwiseInverse();
  std::vector<DampedMode> modes;
  for (Index i = 0; i < a.rows(); ++i) {
    std::complex<double> lambda = pairs.values[i];
    if (lambda.imag() < 0) continue;
    if (std::abs(lambda.imag()) <= noise) lambda = lambda.real();
    if (std::abs(lambda) <= noise) lambda = 0;
    const Eigen::VectorXcd v = pairs.vectors.col(i);
    DampedMode mode =
        normalised(lambda, scale.cast<std::complex<double>>().cwiseProduct(v.segment(system.speeds, drive.size())));
    mode.error = error[i];
    mode.in_internal_states = v.tail(drive.internal_states()).squaredNorm() / v.squaredNorm();
    mode.energy = energy_parts(system, left.row(i).transpose(), v);
    modes.push_back(std::move(mode));
  }
  sort_modes(modes);
  return modes;
}

// Newton on Q(λ) x = 0, x = [q, z]: inverse iteration with the derivative, Q w = Q′ x. Where Q is symmetric λ is then the
// root of the quadratic form, else by what w gives.
class DampedNewton {
 public:
  using Complex = std::complex<double>;

  explicit DampedNewton(const LinearDrive& drive)
      : drive_(drive), n_(drive.size()), states_(drive.internal_states()), pencil_(pencil_of(drive)) {}

  // False where it does not converge. `change`: of λ in the last step, what its error is of the order of.
  bool refine(Complex& lambda, Eigen::VectorXcd& v, double& change) {
    Eigen::VectorXcd x = Eigen::VectorXcd::Zero(n_ + states_);
    x.head(n_) = v;
    refined_ = x;
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Sparse q = lambda * lambda * pencil_.mass + lambda * pencil_.damping + pencil_.stiffness;
      if (!solver_.factorise(q)) return true;  // λ is an eigenvalue to the last bit
      const Eigen::VectorXcd w = solver_.solve((2.0 * lambda * pencil_.mass + pencil_.damping) * x);
      if (!w.allFinite()) return false;
      const Complex before = lambda;
      const Complex step = x.dot(x) / x.dot(w);
      x = w.normalized();
      lambda = drive_.is_symmetric() ? root(x, lambda) : lambda - step;
      v = x.head(n_);
      refined_ = x;
      change = std::abs(lambda - before);
      if (change <= 1e-12 * std::abs(lambda)) return true;
    }
    return false;
  }

  // Of the pair refined last. The left vector of first order follows from that of Q.
  EnergyParts energy(Complex lambda) {
    const Eigen::VectorXcd left = drive_.is_symmetric() ? refined_ : left_vector(lambda);
    const Eigen::VectorXcd q = refined_.head(n_), w = left.head(n_);
    Eigen::VectorXcd twist = q, by_twist;
    if (drive_.at.angle) {
      by_twist = -((drive_.stiffness + drive_.other_stiffness).transpose() * w);
    } else {
      twist = drive_.twists * q;
      by_twist = drive_.torque_by_twist.transpose() * w;
    }
    if (states_ > 0) {
      const Eigen::VectorXcd z = left.tail(states_);
      const Eigen::VectorXcd by_internal = drive_.internal_by_twist.transpose() * z;
      if (drive_.at.angle)
        by_twist += drive_.twists.transpose() * by_internal + drive_.internal_by_angle.transpose() * z;
      else
        by_twist += by_internal;
    }
    const VectorXd own = left.tail(states_).cwiseProduct(refined_.tail(states_)).cwiseAbs();
    EnergyParts parts{.springs = by_twist.cwiseProduct(twist).cwiseAbs().sum() / std::abs(lambda),
                      .inertias = std::abs(lambda) * w.cwiseProduct(q).cwiseAbs().dot(drive_.inertia),
                      .own = {}};
    const double all = parts.springs + parts.inertias + own.sum();
    if (!(all > 0 && std::isfinite(all))) return {};
    parts.springs /= all, parts.inertias /= all;
    for (const double part : own) parts.own.push_back(part / all);
    return parts;
  }

 private:
  using Sparse = ComplexSparseMatrix;

  Eigen::VectorXcd left_vector(Complex lambda) {
    const auto transposed = [this](Complex s) {
      return Sparse((s * s * pencil_.mass + s * pencil_.damping + pencil_.stiffness).transpose());
    };
    constexpr double beside = 1e-12;  // where λ is an eigenvalue to the last bit
    Eigen::VectorXcd u = refined_;
    if (!solver_.factorise(transposed(lambda)) && !solver_.factorise(transposed((1 + beside) * lambda))) return u;
    for (int iteration = 0; iteration < 2; ++iteration) u = solver_.solve(u).normalized();
    return u;
  }

  Complex root(const Eigen::VectorXcd& v, Complex near) const {
    const auto form = [&](const Sparse& m) { return (v.transpose() * (m * v)).value(); };
    const Complex a = form(pencil_.mass), c = form(pencil_.damping), k = form(pencil_.stiffness);
    const Complex half = std::sqrt(c * c - 4.0 * a * k);
    const Complex one = (-c + half) / (2.0 * a), two = (-c - half) / (2.0 * a);
    return std::abs(one - near) < std::abs(two - near) ? one : two;
  }

  const LinearDrive& drive_;
  Index n_, states_;
  QuadraticPencil pencil_;
  ComplexSparseLu solver_;
  Eigen::VectorXcd refined_;  // [q, z]
};

std::vector<DampedMode> sparse_damped(const LinearDrive& drive, const UndampedModes& undamped) {
  DampedNewton newton(drive);
  std::vector<DampedMode> modes;
  for (Index i = undamped.rigid; i < undamped.omega.size(); ++i) {
    const VectorXd shape = undamped.shapes.col(i);
    const double decay = 0.5 * shape.dot(drive.damping * shape);
    std::complex<double> lambda(-decay, std::sqrt(std::max(0.0, std::pow(undamped.omega[i], 2) - decay * decay)));
    Eigen::VectorXcd v = shape.cast<std::complex<double>>();
    double change = 0;
    if (!newton.refine(lambda, v, change)) continue;
    const bool known = std::any_of(modes.begin(), modes.end(), [&](const DampedMode& m) {
      return std::abs(m.lambda - lambda) < 1e-9 * std::abs(lambda) &&
             std::abs(m.shape.normalized().dot(v.normalized())) > 1 - 1e-6;
    });
    if (known) continue;
    modes.push_back(normalised(lambda, v));
    modes.back().error = std::max(change, 1e-14 * std::abs(lambda));
    modes.back().energy = newton.energy(lambda);
  }
  sort_modes(modes);
  return modes;
}

}  // namespace

QuadraticPencil pencil_of(const LinearDrive& drive) {
  using Complex = std::complex<double>;
  using Entries = std::vector<Eigen::Triplet<Complex>>;
  const Index n = drive.size(), z = drive.internal_states();
  const auto add = [](const SparseMatrix& from, Index row, Index column, double factor, Entries& to) {
    for (Index c = 0; c < from.outerSize(); ++c)
      for (SparseMatrix::InnerIterator it(from, c); it; ++it)
        to.emplace_back(row + it.row(), column + c, factor * it.value());
  };
  const auto matrix = [&](Entries& entries) {
    for (Index i = 0; i < n + z; ++i) entries.emplace_back(i, i, 0.0);
    ComplexSparseMatrix sparse(n + z, n + z);
    sparse.setFromTriplets(entries.begin(), entries.end());
    return sparse;
  };
  Entries mass, damping, stiffness;
  for (Index i = 0; i < n; ++i) mass.emplace_back(i, i, drive.inertia[i]);
  add(drive.damping, 0, 0, 1, damping);
  add(drive.stiffness, 0, 0, 1, stiffness);
  add(drive.other_stiffness, 0, 0, 1, stiffness);
  if (z > 0) {
    add(drive.torque_by_internal, 0, n, -1, stiffness);
    add(product(drive.internal_by_twist, drive.twists), n, 0, -1, stiffness);
    add(drive.internal_by_angle, n, 0, -1, stiffness);
    add(drive.internal_by_speed, n, 0, -1, damping);
    add(drive.internal_by_internal, n, n, -1, stiffness);
    for (Index k = 0; k < z; ++k) damping.emplace_back(n + k, n + k, 1.0);
  }
  return {matrix(mass), matrix(damping), matrix(stiffness)};
}

double EnergyParts::in_internal_states() const { return std::accumulate(own.begin(), own.end(), 0.0); }

std::vector<DampedMode> damped_modes(const LinearDrive& drive, const UndampedModes& undamped,
                                     const ModesWanted& wanted) {
  return drive.size() <= wanted.dense_below ? dense_damped(drive) : sparse_damped(drive, undamped);
}

}  // namespace kurbel
