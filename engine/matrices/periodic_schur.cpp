// periodic_schur.cpp — periodic QR: one factor Hessenberg, the others triangular, rotations chased through all of them.
#include "engine/matrices/periodic_schur.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "engine/matrices/linear_algebra.h"

namespace kurbel {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double none = std::numeric_limits<double>::infinity();
constexpr int most_sweeps = 80;     // per eigenvalue
constexpr int patient_sweeps = 30;  // after which what is small beside the whole factor counts as zero, too
constexpr int unshifted_first = 2;  // sweeps: they part what differs by orders, and a singular factor's zero
constexpr int unshifted_every = 6;
constexpr int exceptional_every = 11;

// m · 2^e: products of hundreds of factors leave the range of a double.
struct Scaled {
  Complex m;
  long e = 0;
  Scaled(Complex value = 0, long exponent = 0) : m(value), e(exponent) {
    const double size = std::max(std::abs(m.real()), std::abs(m.imag()));
    if (size == 0) {
      e = 0;
      return;
    }
    int shift = 0;
    std::frexp(size, &shift);
    m = {std::ldexp(m.real(), -shift), std::ldexp(m.imag(), -shift)};
    e += shift;
  }
  bool zero() const { return m == Complex(0); }
  // Over 2^exponent.
  Complex over(long exponent) const {
    const int by = static_cast<int>(std::clamp(e - exponent, -3000L, 3000L));
    return {std::ldexp(m.real(), by), std::ldexp(m.imag(), by)};
  }
};
long greatest(std::initializer_list<Scaled> values) {
  long most = std::numeric_limits<long>::min() / 2;
  for (const Scaled& v : values)
    if (!v.zero()) most = std::max(most, v.e);
  return most;
}
Scaled operator*(const Scaled& a, const Scaled& b) { return {a.m * b.m, a.e + b.e}; }
Scaled operator+(const Scaled& a, const Scaled& b) {
  const long e = greatest({a, b});
  return {a.over(e) + b.over(e), e};
}
Scaled operator-(const Scaled& a, const Scaled& b) { return a + Scaled{-b.m, b.e}; }

// G = [c s; −s̄ c] with real c.
struct Rotation {
  double c = 1;
  Complex s = 0;
};
// G (a, b)ᵀ = (r, 0)ᵀ.
Rotation making_zero_below(Complex a, Complex b) {
  if (b == Complex(0)) return {};
  if (a == Complex(0)) return {0, std::conj(b) / std::abs(b)};
  const double r = std::hypot(std::abs(a), std::abs(b)), c = std::abs(a) / r;
  return {c, (a / std::abs(a)) * (std::conj(b) / r)};
}
// (p, q) Gᴴ = (0, r).
Rotation making_zero_left(Complex p, Complex q) {
  if (p == Complex(0)) return {};
  if (q == Complex(0)) return {0, 1};
  const double r = std::hypot(std::abs(p), std::abs(q)), c = std::abs(q) / r;
  return {c, -std::conj(p / r) * (q / std::abs(q))};
}

class Iteration {
 public:
  Iteration(std::vector<MatrixXcd>& factors, std::vector<MatrixXcd>& bases)
      : a_(factors), q_(bases), count_(factors.size()), n_(factors.front().rows()) {}

  void run() {
    triangularise();
    make_hessenberg();
    Index hi = n_ - 1;
    int sweeps = 0;
    while (hi > 0) {
      Index lo = hi;
      while (lo > 0 && !negligible(lo, sweeps)) --lo;
      if (lo > 0) a_[0](lo, lo - 1) = 0;
      if (lo == hi) {
        --hi, sweeps = 0;
        continue;
      }
      if (sweeps == most_sweeps)
        throw std::runtime_error("the periodic QR iteration does not end: eigenvalues of a product of matrices");
      if (sweeps < unshifted_first || sweeps % unshifted_every == 0)
        unshifted_sweep(lo, hi);
      else
        shifted_sweep(lo, hi, shift(lo, hi, sweeps % exceptional_every == 0));
      ++sweeps;
    }
  }

 private:
  // The basis of section k turns in the plane (i, i+1): rows of the factor before it, columns of the one behind.
  void turn(std::size_t section, Index i, const Rotation& g) {
    const std::size_t k = section % count_;
    turn_rows(a_[(k + count_ - 1) % count_], i, g);
    turn_columns(a_[k], i, g);
    turn_columns(q_[k], i, g);
  }
  static void turn_rows(MatrixXcd& m, Index i, const Rotation& g) {
    for (Index j = 0; j < m.cols(); ++j) {
      const Complex x = m(i, j), y = m(i + 1, j);
      m(i, j) = g.c * x + g.s * y;
      m(i + 1, j) = g.c * y - std::conj(g.s) * x;
    }
  }
  static void turn_columns(MatrixXcd& m, Index i, const Rotation& g) {
    for (Index j = 0; j < m.rows(); ++j) {
      const Complex x = m(j, i), y = m(j, i + 1);
      m(j, i) = g.c * x + std::conj(g.s) * y;
      m(j, i + 1) = g.c * y - g.s * x;
    }
  }

  // All factors but the first, by Householder's reflections; all is real so far.
  void triangularise() {
    for (std::size_t k = 1; k < count_; ++k) {
      const Qr factors = qr(a_[k].real());
      a_[k] = factors.r.cast<Complex>();
      const std::size_t next = (k + 1) % count_;
      a_[next] = product(a_[next].real(), factors.q).cast<Complex>();
      q_[next] = product(q_[next].real(), factors.q).cast<Complex>();
    }
  }
  void make_hessenberg() {
    for (Index j = 0; j + 2 < n_; ++j)
      for (Index i = n_ - 2; i > j; --i) {
        turn(1, i, making_zero_below(a_[0](i, j), a_[0](i + 1, j)));
        a_[0](i + 1, j) = 0;
        chase(i);
      }
  }
  // After a rotation of section 1: through the triangular factors back to section 0.
  void chase(Index i) {
    for (std::size_t k = 1; k < count_; ++k) {
      turn(k + 1, i, making_zero_below(a_[k](i, i), a_[k](i + 1, i)));
      a_[k](i + 1, i) = 0;
    }
  }

  bool negligible(Index i, int sweeps) const {
    const double here = std::abs(a_[0](i, i - 1));
    if (here == 0) return true;
    const double beside = std::abs(a_[0](i, i)) + std::abs(a_[0](i - 1, i - 1));
    return here <= eps * (sweeps < patient_sweeps ? beside : a_[0].norm());
  }

  // A_0 = Q_1 R_0, then R_1 from A_1 Q_1, … and at last A_0 = R_0 Q_0. A zero on a diagonal parts what is about it.
  void unshifted_sweep(Index lo, Index hi) {
    std::vector<Rotation> turns(static_cast<std::size_t>(hi - lo));
    for (Index i = lo; i < hi; ++i) {
      Rotation& g = turns[static_cast<std::size_t>(i - lo)];
      g = making_zero_below(a_[0](i, i), a_[0](i + 1, i));
      turn_rows(a_[0], i, g);
      a_[0](i + 1, i) = 0;
    }
    for (std::size_t k = 1; k <= count_; ++k)
      for (Index i = lo; i < hi; ++i) {
        Rotation& g = turns[static_cast<std::size_t>(i - lo)];
        turn_columns(a_[k % count_], i, g);
        turn_columns(q_[k % count_], i, g);
        if (k == count_) continue;
        g = making_zero_below(a_[k](i, i), a_[k](i + 1, i));
        turn_rows(a_[k], i, g);
        a_[k](i + 1, i) = 0;
      }
  }

  // The 2 × 2 block at (i, i) of the product of the triangular factors.
  struct Corner {
    Scaled a, b, d;  // [a b; 0 d]
  };
  Corner corner(Index i) const {
    Corner c{Complex(1), Complex(0), Complex(1)};
    for (std::size_t k = 1; k < count_; ++k) {
      const Scaled a = a_[k](i, i), b = a_[k](i, i + 1), d = a_[k](i + 1, i + 1);
      c = {a * c.a, a * c.b + b * c.d, d * c.d};
    }
    return c;
  }
  // Wilkinson's: of the product's last 2 × 2 block the eigenvalue nearest to its last entry.
  Scaled shift(Index lo, Index hi, bool exceptional) const {
    const Corner r = corner(hi - 1);
    const MatrixXcd& h = a_[0];
    const Scaled a = r.a * h(hi - 1, hi - 1) + r.b * h(hi, hi - 1), b = r.a * h(hi - 1, hi) + r.b * h(hi, hi),
                 c = r.d * h(hi, hi - 1), d = r.d * h(hi, hi);
    if (exceptional) return (d + c) * Scaled(Complex(0.75, 0.4 + 0.1 * static_cast<double>(hi - lo)));
    const Scaled half = (a - d) * Scaled(0.5), inside = half * half + b * c;
    if (inside.zero()) return a;
    const Scaled root = inside.e % 2 == 0 ? Scaled(std::sqrt(inside.m), inside.e / 2)
                                          : Scaled(std::sqrt(2.0 * inside.m), (inside.e - 1) / 2);
    const Scaled middle = (a + d) * Scaled(0.5), one = middle + root, other = middle - root;
    const Scaled from_one = one - d, from_other = other - d;
    const long e = greatest({from_one, from_other});
    return std::abs(from_one.over(e)) < std::abs(from_other.over(e)) ? one : other;
  }

  void shifted_sweep(Index lo, Index hi, const Scaled& sigma) {
    const Corner r = corner(lo);
    const Scaled x = r.a * a_[0](lo, lo) + r.b * a_[0](lo + 1, lo) - sigma, y = r.d * a_[0](lo + 1, lo);
    const long e = greatest({x, y});
    turn(0, lo, making_zero_below(x.over(e), y.over(e)));
    for (std::size_t k = count_ - 1; k >= 1; --k) {  // back to section 1
      turn(k, lo, making_zero_left(a_[k](lo + 1, lo), a_[k](lo + 1, lo + 1)));
      a_[k](lo + 1, lo) = 0;
    }
    for (Index i = lo + 1; i < hi; ++i) {
      turn(1, i, making_zero_below(a_[0](i, i - 1), a_[0](i + 1, i - 1)));
      a_[0](i + 1, i - 1) = 0;
      chase(i);
    }
  }

  std::vector<MatrixXcd>&a_, &q_;
  std::size_t count_;
  Index n_;
};

// d_k x_k − e_k x_{k+1} = −b_k with cyclic k, by rotations of the last row against each other.
std::vector<Complex> solve_circle(std::vector<Complex> d, const std::vector<Complex>& e, std::vector<Complex> b) {
  const std::size_t n = d.size();
  for (Complex& value : b) value = -value;
  if (n == 1) {
    Complex pivot = d[0] - e[0];
    if (std::abs(pivot) < eps * (std::abs(d[0]) + std::abs(e[0]))) pivot = eps * (std::abs(d[0]) + std::abs(e[0]));
    return {pivot == Complex(0) ? Complex(0) : b[0] / pivot};
  }
  std::vector<Complex> above(n), last(n, 0.0);  // row k: d_k, above_k in the next column, last_k in the last one
  for (std::size_t k = 0; k + 1 < n; ++k) above[k] = -e[k];
  Complex first = -e[n - 1], corner = d[n - 1],
          rest = b[n - 1];  // last row: its first entry that is left, its last one
  double largest = std::abs(corner);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    largest = std::max({largest, std::abs(d[k]), std::abs(e[k])});
    const bool before_last = k + 2 == n;
    const Rotation g = making_zero_below(d[k], first);
    d[k] = g.c * d[k] + g.s * first;
    Complex up = before_last ? above[k] : last[k];  // row k in the last column
    const Complex corner_was = corner;
    corner = g.c * corner_was - std::conj(g.s) * up;
    up = g.c * up + g.s * corner_was;
    if (before_last) {
      above[k] = up;
    } else {
      first = -std::conj(g.s) * above[k];
      above[k] = g.c * above[k];
      last[k] = up;
    }
    const Complex was = b[k];
    b[k] = g.c * was + g.s * rest;
    rest = g.c * rest - std::conj(g.s) * was;
  }
  const auto guarded = [&](Complex pivot) { return std::abs(pivot) < eps * largest ? Complex(eps * largest) : pivot; };
  std::vector<Complex> x(n, 0.0);
  if (largest == 0) return x;
  x[n - 1] = rest / guarded(corner);
  for (std::size_t k = n - 1; k-- > 0;) {
    Complex sum = b[k] - above[k] * x[k + 1];
    if (k + 2 < n) sum -= last[k] * x[n - 1];
    x[k] = sum / guarded(d[k]);
  }
  return x;
}

}  // namespace

PeriodicSchur::PeriodicSchur(const std::vector<Eigen::MatrixXd>& factors) {
  if (factors.empty() || factors.front().rows() == 0) throw std::invalid_argument("a product of no matrices");
  const Index n = factors.front().rows();
  double scales = 0;
  std::vector<double> scale;
  for (const Eigen::MatrixXd& factor : factors) {
    if (factor.rows() != n || factor.cols() != n) throw std::invalid_argument("factors of a product do not fit");
    if (!factor.allFinite()) throw std::invalid_argument("a factor of a product holds what is no number");
    const double largest = factor.cwiseAbs().maxCoeff();
    scale.push_back(largest > 0 ? largest * (factor / largest).norm() : 1);
    scales += std::log(scale.back());
    triangular_.push_back((factor / scale.back()).cast<Complex>());
  }
  unitary_.assign(factors.size(), MatrixXcd::Identity(n, n));
  Iteration(triangular_, unitary_).run();
  backward_error_ = eps * static_cast<double>(n);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    triangular_[k] = MatrixXcd(triangular_[k].triangularView<Eigen::Upper>());
    const MatrixXcd again =
        complex_product_adjoint(complex_product(unitary_[(k + 1) % count()], triangular_[k]), unitary_[k]);
    backward_error_ = std::max(backward_error_, (again - factors[k] / scale[k]).norm());
  }
  for (Index i = 0; i < n; ++i) {
    PeriodicEigenvalue value;
    value.log_magnitude = scales;
    for (const MatrixXcd& t : triangular_) {
      value.log_magnitude += std::log(std::abs(t(i, i)));
      value.phase += std::arg(t(i, i));
    }
    value.phase = std::remainder(value.phase, 2 * std::numbers::pi);
    value.sensitivity = value.log_magnitude == -none ? none : sensitivity(i);
    value.error = value.sensitivity * backward_error_;
    eigenvalues_.push_back(value);
  }
  place_.resize(size());
  std::iota(place_.begin(), place_.end(), Index{0});
  const std::vector<PeriodicEigenvalue> by_place = eigenvalues_;
  const auto value = [&](Index i) -> const PeriodicEigenvalue& { return by_place[static_cast<std::size_t>(i)]; };
  std::stable_sort(place_.begin(), place_.end(),
                   [&](Index a, Index b) { return value(a).log_magnitude > value(b).log_magnitude; });
  for (std::size_t j = 0; j < size(); ++j) eigenvalues_[j] = value(place_[j]);
}

// T_k x_k = (T_k)_jj x_{k+1} with x_j = 1, row by row upwards.
std::vector<VectorXcd> PeriodicSchur::right(Index j) const {
  const std::size_t n = count();
  std::vector<VectorXcd> x(n, VectorXcd::Zero(triangular_.front().rows()));
  for (VectorXcd& v : x) v[j] = 1;
  std::vector<Complex> d(n), e(n), b(n);
  for (Index i = j - 1; i >= 0; --i) {
    for (std::size_t k = 0; k < n; ++k) {
      const MatrixXcd& t = triangular_[k];
      d[k] = t(i, i), e[k] = t(j, j);
      b[k] = t.row(i).segment(i + 1, j - i).transpose().cwiseProduct(x[k].segment(i + 1, j - i)).sum();
    }
    const std::vector<Complex> row = solve_circle(d, e, b);
    for (std::size_t k = 0; k < n; ++k) x[k][i] = row[k];
  }
  for (VectorXcd& v : x) v.normalize();
  return x;
}

// u_{k+1}ᴴ T_k = (T_k)_jj u_kᴴ, u_j = 1, column by column onwards; what is returned is conj(u).
std::vector<VectorXcd> PeriodicSchur::left(Index j) const {
  const std::size_t n = count();
  const Index size = triangular_.front().rows();
  std::vector<VectorXcd> u(n, VectorXcd::Zero(size));
  for (VectorXcd& v : u) v[j] = 1;
  std::vector<Complex> d(n), e(n), b(n);
  for (Index i = j + 1; i < size; ++i) {
    // Backwards through the cycle: w_m = u of section K − m, so that d w_m − e w_{m+1} = −b with factor K − 1 − m.
    for (std::size_t m = 0; m < n; ++m) {
      const MatrixXcd& t = triangular_[n - 1 - m];
      const VectorXcd& next = u[(n - m) % n];
      d[m] = t(i, i), e[m] = t(j, j);
      b[m] = t.col(i).segment(j, i - j).cwiseProduct(next.segment(j, i - j)).sum();
    }
    const std::vector<Complex> column = solve_circle(d, e, b);
    for (std::size_t m = 0; m < n; ++m) u[(n - m) % n][i] = column[m];
  }
  for (VectorXcd& v : u) v.normalize();
  return u;
}

double PeriodicSchur::sensitivity(Index j) const {
  const std::vector<VectorXcd> v = right(j), u = left(j);
  double sum = 0;
  for (std::size_t k = 0; k < count(); ++k) {
    const VectorXcd image = triangular_[k] * v[k];
    const double along = std::abs(u[(k + 1) % count()].cwiseProduct(image).sum());
    if (along == 0) return none;
    sum += 1 / along;
  }
  return sum;
}

std::vector<VectorXcd> PeriodicSchur::vectors(std::size_t j) const {
  std::vector<VectorXcd> v = right(place_.at(j));
  for (std::size_t k = 0; k < count(); ++k) v[k] = unitary_[k] * v[k];
  return v;
}

}  // namespace kurbel
