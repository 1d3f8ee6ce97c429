// piecewise.h — piecewise polynomial functions of one variable: integrals and extremes to rounding error.
//
//     const std::vector<double> edges = {0, 2.1, 6.28};
//     const Piecewise load = Piecewise::of(edges, [](double phi) { return phi < 2.1 ? 100.0 : 40 * phi; });
//     const Piecewise work = load.integral();          // ∫ from the start of the cycle, without quadrature error
//     work.maximum().x                                 // its position, to rounding error: a root of the derivative or an edge
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace kurbel {

struct Extreme {
  double x = 0, value = 0;
};

class Piecewise {
 public:
  Piecewise() = default;

  // Writes the channels at x, strictly within a piece.
  using Sampler = std::function<void(double x, std::span<double> values)>;
  // Called with the middle of each piece before its samples: selects branches of laws that change at edges, checks the
  // remaining time.
  using Enter = std::function<void(double middle)>;

  // Divides [edges.front(), edges.back()] into pieces, none across an edge, until the polynomials of each channel agree with
  // it to `tolerance` of its largest magnitude. All channels have the same breaks. Throws std::invalid_argument for fewer
  // than two edges or edges that do not ascend; std::runtime_error if a sample is not finite.
  static std::vector<Piecewise> sample(const std::vector<double>& edges, std::size_t channels, const Sampler& sampler,
                                       const Enter& enter = {}, double tolerance = 2e-13);
  static Piecewise of(const std::vector<double>& edges, const std::function<double(double)>& f,
                      double tolerance = 2e-13);
  // The polynomials through samples at node(0), node(1), … of each piece, in order of the pieces: Gauss nodes, so that
  // integrals are exact up to degree 31.
  static constexpr std::size_t nodes = 16;
  static double node(std::size_t k);  // −1 … 1 across a piece, ascending
  static Piecewise through(const std::vector<double>& breaks, const std::vector<double>& samples);
  // Linear between points; two points with the same x are a jump.
  static Piecewise linear(const std::vector<double>& x, const std::vector<double>& y);

  double begin() const { return breaks_->front(); }
  double end() const { return breaks_->back(); }
  double length() const { return end() - begin(); }
  std::size_t pieces() const { return breaks_->size() - 1; }
  const std::vector<double>& breaks() const { return *breaks_; }
  double value(double x) const;  // at a break: from the right (at the end: from the left)
  double value_in(std::size_t piece, double x) const;
  double largest() const;  // bound of |value|

  Piecewise integral() const;  // zero at the begin, continuous; only for sampled functions, not for their integrals
  Piecewise derivative() const;
  double total() const;  // integral over the whole range
  double mean() const { return total() / length(); }
  double mean_square() const;
  // The mean of f(x) e^(iνx), without quadrature error:
  //     ∫ P_k(u) e^(iθu) du over −1 … 1 = 2 i^k j_k(θ),   θ = ν half the piece's width     (DLMF 10.54.2, 18.17.19)
  std::complex<double> mean_with_wave(double nu) const;

  // Global extremes; at a jump the larger (smaller) side counts, of equal ones the first. They are located as roots of the
  // given derivative, or of the derivative of the pieces.
  Extreme maximum() const;
  Extreme minimum() const;
  Extreme maximum(const Piecewise& derivative) const;
  Extreme minimum(const Piecewise& derivative) const;

  // Sums of functions with the same breaks; std::logic_error for others.
  friend Piecewise operator+(const Piecewise& a, const Piecewise& b);
  friend Piecewise operator-(const Piecewise& a, const Piecewise& b) { return a + -1.0 * b; }
  friend Piecewise operator*(double factor, Piecewise f);
  // The constant c on the breaks of this function.
  Piecewise constant(double c) const;

 private:
  friend class PiecewiseBuilder;
  std::size_t piece_at(double x) const;
  std::vector<double> roots_in(std::size_t piece, double noise) const;

  std::shared_ptr<const std::vector<double>> breaks_;
  std::size_t terms_ = 0;            // Legendre coefficients per piece
  std::vector<double> coefficient_;  // in order of the pieces
};

}  // namespace kurbel
