// piecewise.cpp — adaptive pieces, each a sum of Legendre's polynomials.
#include "engine/base/piecewise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "engine/base/gauss.h"
#include "engine/base/legendre.h"

namespace kurbel {
namespace {

constexpr std::size_t nodes = Piecewise::nodes, most_terms = legendre::most_terms;
constexpr std::size_t most_pieces = 8192;  // refinement stops here

// P_13 … P_15 are of this size within a piece: √(2/(πk)).
constexpr double size_of_last = 0.21;

// Coefficients of the polynomial through samples at the nodes.
void transform(const double* samples, double* c) {
  std::array<double, nodes> values;
  std::copy_n(samples, nodes, values.begin());
  std::ranges::copy(legendre::terms(values), c);
}

// Σ c_k P_k(x) by Clenshaw: b_k = c_k + (2k + 1)/(k + 1) x b_{k+1} − (k + 1)/(k + 2) b_{k+2}
double clenshaw(const double* c, std::size_t n, double x) {
  double b1 = 0, b2 = 0;
  for (std::size_t k = n; k-- > 0;) {
    const double b0 = legendre::recursion.by_x[k] * x * b1 + (c[k] - legendre::recursion.back[k + 1] * b2);
    b2 = b1;
    b1 = b0;
  }
  return b1;
}

// d/dx of Σ c_k P_k, n coefficients in and out: P′_k = Σ (2j + 1) P_j over j = k − 1, k − 3, …
std::vector<double> differentiated(const std::vector<double>& c) {
  std::vector<double> d(c.size() + 1, 0.0);
  for (std::size_t j = c.size() - 1; j-- > 0;) d[j] = c[j + 1] + d[j + 2];
  for (std::size_t j = 0; j < c.size(); ++j) d[j] *= 2 * static_cast<double>(j) + 1;
  d.resize(c.size());
  return d;
}

// Spherical Bessel functions j_0, j_1, … at z: upwards where z is larger than the order, else downwards from where they
// vanish, scaled by the larger of j_0 and j_1 (Miller's algorithm; DLMF 3.6, 10.51).
std::array<double, most_terms> spherical_bessel(double z) {
  std::array<double, most_terms> j{1};
  if (z == 0) return j;
  const double first = std::sin(z) / z, second = (first - std::cos(z)) / z;
  if (std::abs(z) > most_terms) {
    j[0] = first, j[1] = second;
    for (std::size_t k = 1; k + 1 < most_terms; ++k) j[k + 1] = static_cast<double>(2 * k + 1) / z * j[k] - j[k - 1];
    return j;
  }
  double above = 0, here = 1e-300;
  for (std::size_t k = most_terms + 24; k > 0; --k) {
    const double below = static_cast<double>(2 * k + 1) / z * here - above;
    above = here, here = below;
    if (k <= most_terms) j[k - 1] = here;
    if (std::abs(here) < 1e200) continue;
    above *= 1e-200, here *= 1e-200;
    for (std::size_t i = k - 1; i < most_terms; ++i) j[i] *= 1e-200;
  }
  const double scale = std::abs(first) > std::abs(second) ? first / j[0] : second / j[1];
  for (double& value : j) value *= scale;
  return j;
}

double tail(const std::vector<double>& c) {
  double sum = 0;
  for (std::size_t k = 1; k < c.size(); ++k) sum += std::abs(c[k]);
  return sum;
}

// The same polynomial over lo … hi within −1 … 1.
std::vector<double> restricted(const std::vector<double>& c, double lo, double hi) {
  std::array<double, most_terms> values;
  for (std::size_t i = 0; i < most_terms; ++i)
    values[i] = clenshaw(c.data(), c.size(), lo + 0.5 * (hi - lo) * (1 + gauss<most_terms>.x[i]));
  const auto terms = legendre::terms(values);
  return {terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(c.size())};
}

// All simple roots of a polynomial within lo … hi: intervals are halved until bounds exclude or isolate a root.
void find_roots(const std::vector<double>& whole, double lo, double hi, double noise, int depth,
                std::vector<double>& roots) {
  const std::vector<double> c = restricted(whole, lo, hi);
  if (std::abs(c[0]) > tail(c) || std::abs(c[0]) + tail(c) <= noise) return;
  const std::vector<double> d = differentiated(c);
  const double f_lo = clenshaw(c.data(), c.size(), -1), f_hi = clenshaw(c.data(), c.size(), 1);
  if (std::abs(d[0]) > tail(d) || depth == 0) {
    if ((f_lo < 0) == (f_hi < 0) && f_lo != 0 && f_hi != 0) return;
    double a = -1, b = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (a + b);
      ((clenshaw(c.data(), c.size(), middle) < 0) == (f_lo < 0) ? a : b) = middle;
    }
    if (f_lo == 0) a = b = -1;
    roots.push_back(lo + 0.5 * (hi - lo) * (1 + 0.5 * (a + b)));
    return;
  }
  const double cut = lo + 0.5013 * (hi - lo);  // off the middle, where symmetric functions have roots
  find_roots(whole, lo, cut, noise, depth - 1, roots);
  find_roots(whole, cut, hi, noise, depth - 1, roots);
}

void check_edges(const std::vector<double>& edges) {
  if (edges.size() < 2) throw std::invalid_argument("a cycle needs at least its begin and its end as edges");
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if (!(edges[i] < edges[i + 1]) || !std::isfinite(edges[i + 1] - edges[i]))
      throw std::invalid_argument("the edges of a cycle must ascend");
}

}  // namespace

class PiecewiseBuilder {
 public:
  PiecewiseBuilder(std::size_t channels, const Piecewise::Sampler& sampler, const Piecewise::Enter& enter,
                   double tolerance)
      : channels_(channels), sampler_(sampler), enter_(enter), tolerance_(tolerance), scale_(channels, 0.0) {}

  std::vector<Piecewise> build(const std::vector<double>& edges) {
    check_edges(edges);
    shortest_ = (edges.back() - edges.front()) * 1e-9;
    std::vector<Piece> fresh;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) fresh.push_back(take(edges[i], edges[i + 1]));
    std::reverse(fresh.begin(), fresh.end());
    // Depth first, so that the pieces come out in order.
    std::vector<Piece> done;
    while (!fresh.empty()) {
      Piece piece = std::move(fresh.back());
      fresh.pop_back();
      if (good(piece) || piece.hi - piece.lo < shortest_ || done.size() + fresh.size() > most_pieces) {
        done.push_back(std::move(piece));
        continue;
      }
      const double middle = 0.5 * (piece.lo + piece.hi);
      fresh.push_back(take(middle, piece.hi));
      fresh.push_back(take(piece.lo, middle));
    }
    return assembled(done);
  }

 private:
  struct Piece {
    double lo, hi;
    std::vector<double> c;  // channel after channel
  };

  Piece take(double lo, double hi) {
    if (enter_) enter_(0.5 * (lo + hi));
    std::vector<double> samples(channels_ * nodes), at(channels_);
    for (std::size_t k = 0; k < nodes; ++k) {
      sampler_(lo + 0.5 * (hi - lo) * (1 + Piecewise::node(k)), at);
      for (std::size_t channel = 0; channel < channels_; ++channel) {
        if (!std::isfinite(at[channel])) throw std::runtime_error("a function over the cycle is not finite");
        samples[channel * nodes + k] = at[channel];
        scale_[channel] = std::max(scale_[channel], std::abs(at[channel]));
      }
    }
    Piece piece{lo, hi, std::vector<double>(channels_ * nodes)};
    for (std::size_t channel = 0; channel < channels_; ++channel)
      transform(&samples[channel * nodes], &piece.c[channel * nodes]);
    return piece;
  }

  // The last coefficients say how much a longer polynomial would add.
  bool good(const Piece& piece) const {
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      const double* c = &piece.c[channel * nodes];
      const double left = std::max({std::abs(c[nodes - 1]), std::abs(c[nodes - 2]), std::abs(c[nodes - 3])});
      if (size_of_last * left > tolerance_ * scale_[channel]) return false;
    }
    return true;
  }

  std::vector<Piecewise> assembled(const std::vector<Piece>& pieces) const {
    auto breaks = std::make_shared<std::vector<double>>();
    for (const Piece& piece : pieces) breaks->push_back(piece.lo);
    breaks->push_back(pieces.back().hi);
    std::vector<Piecewise> all(channels_);
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      all[channel].breaks_ = breaks;
      all[channel].terms_ = nodes;
      for (const Piece& piece : pieces)
        all[channel].coefficient_.insert(all[channel].coefficient_.end(), &piece.c[channel * nodes],
                                         &piece.c[channel * nodes] + nodes);
    }
    return all;
  }

  std::size_t channels_;
  const Piecewise::Sampler& sampler_;
  const Piecewise::Enter& enter_;
  double tolerance_, shortest_ = 0;
  std::vector<double> scale_;
};

std::vector<Piecewise> Piecewise::sample(const std::vector<double>& edges, std::size_t channels, const Sampler& sampler,
                                         const Enter& enter, double tolerance) {
  return PiecewiseBuilder(channels, sampler, enter, tolerance).build(edges);
}

Piecewise Piecewise::of(const std::vector<double>& edges, const std::function<double(double)>& f, double tolerance) {
  return sample(
             edges, 1, [&](double x, std::span<double> out) { out[0] = f(x); }, {}, tolerance)
      .front();
}

double Piecewise::node(std::size_t k) { return gauss<nodes>.x[k]; }

Piecewise Piecewise::through(const std::vector<double>& breaks, const std::vector<double>& samples) {
  check_edges(breaks);
  if (samples.size() != (breaks.size() - 1) * nodes) throw std::logic_error("samples of a wrong number");
  Piecewise f;
  f.breaks_ = std::make_shared<std::vector<double>>(breaks);
  f.terms_ = nodes;
  f.coefficient_.resize(samples.size());
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) transform(&samples[i * nodes], &f.coefficient_[i * nodes]);
  return f;
}

Piecewise Piecewise::linear(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size()) throw std::invalid_argument("points of a line need as many y as x");
  Piecewise f;
  auto breaks = std::make_shared<std::vector<double>>();
  f.terms_ = 2;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    if (x[i + 1] == x[i]) continue;
    breaks->push_back(x[i]);
    f.coefficient_.push_back(0.5 * (y[i] + y[i + 1]));
    f.coefficient_.push_back(0.5 * (y[i + 1] - y[i]));
  }
  if (!x.empty()) breaks->push_back(x.back());
  check_edges(*breaks);
  f.breaks_ = breaks;
  return f;
}

std::size_t Piecewise::piece_at(double x) const {
  const auto after = std::upper_bound(breaks_->begin(), breaks_->end(), x);
  const auto index = after - breaks_->begin() - 1;
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, static_cast<std::ptrdiff_t>(pieces()) - 1));
}

// The differences are exact in short pieces.
double Piecewise::value_in(std::size_t piece, double x) const {
  const double lo = (*breaks_)[piece], hi = (*breaks_)[piece + 1];
  return clenshaw(&coefficient_[piece * terms_], terms_, ((x - lo) - (hi - x)) / (hi - lo));
}

double Piecewise::value(double x) const { return value_in(piece_at(x), x); }

double Piecewise::largest() const {
  double bound = 0;
  for (std::size_t i = 0; i < pieces(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < terms_; ++k) sum += std::abs(coefficient_[i * terms_ + k]);
    bound = std::max(bound, sum);
  }
  return bound;
}

// ∫P_k = (P_{k+1} − P_{k−1})/(2k + 1), zero at a piece's begin; ∫P_0 = P_1 + P_0.
Piecewise Piecewise::integral() const {
  if (terms_ == most_terms) throw std::logic_error("too many integrals of a function by pieces");
  Piecewise f;
  f.breaks_ = breaks_;
  f.terms_ = terms_ + 1;
  double reached = 0;
  for (std::size_t i = 0; i < pieces(); ++i) {
    const double half = 0.5 * ((*breaks_)[i + 1] - (*breaks_)[i]);
    const double* c = &coefficient_[i * terms_];
    const auto part = [&](std::size_t k) { return k < terms_ ? half * c[k] / (2 * static_cast<double>(k) + 1) : 0; };
    f.coefficient_.push_back(reached + part(0) - part(1));
    for (std::size_t k = 1; k < f.terms_; ++k) f.coefficient_.push_back(part(k - 1) - part(k + 1));
    reached += 2 * part(0);
  }
  return f;
}

Piecewise Piecewise::derivative() const {
  Piecewise f = *this;
  for (std::size_t i = 0; i < pieces(); ++i) {
    const double half = 0.5 * ((*breaks_)[i + 1] - (*breaks_)[i]);
    const auto first = coefficient_.begin() + static_cast<std::ptrdiff_t>(i * terms_);
    const std::vector<double> d = differentiated({first, first + static_cast<std::ptrdiff_t>(terms_)});
    for (std::size_t k = 0; k < terms_; ++k) f.coefficient_[i * terms_ + k] = d[k] / half;
  }
  return f;
}

double Piecewise::total() const {
  double sum = 0;
  for (std::size_t i = 0; i < pieces(); ++i) sum += ((*breaks_)[i + 1] - (*breaks_)[i]) * coefficient_[i * terms_];
  return sum;
}

double Piecewise::mean_square() const {
  double sum = 0;
  for (std::size_t i = 0; i < pieces(); ++i)
    for (std::size_t k = 0; k < terms_; ++k) {
      const double c = coefficient_[i * terms_ + k];
      sum += ((*breaks_)[i + 1] - (*breaks_)[i]) * c * c / static_cast<double>(2 * k + 1);
    }
  return sum / length();
}

std::complex<double> Piecewise::mean_with_wave(double nu) const {
  std::complex<double> sum = 0;
  double theta = 0;
  auto bessel = spherical_bessel(theta);
  for (std::size_t i = 0; i < pieces(); ++i) {
    const double half = 0.5 * ((*breaks_)[i + 1] - (*breaks_)[i]), middle = (*breaks_)[i] + half;
    if (nu * half != theta) bessel = spherical_bessel(theta = nu * half);
    const double* c = &coefficient_[i * terms_];
    double even = 0, odd = 0;  // of i^k: 1, i, −1, −i
    for (std::size_t k = 0; k < terms_; k += 2) even += (k % 4 == 0 ? c[k] : -c[k]) * bessel[k];
    for (std::size_t k = 1; k < terms_; k += 2) odd += (k % 4 == 1 ? c[k] : -c[k]) * bessel[k];
    sum += 2 * half * std::polar(1.0, nu * middle) * std::complex<double>(even, odd);
  }
  return sum / length();
}

std::vector<double> Piecewise::roots_in(std::size_t piece, double noise) const {
  const auto first = coefficient_.begin() + static_cast<std::ptrdiff_t>(piece * terms_);
  std::vector<double> local;
  find_roots({first, first + static_cast<std::ptrdiff_t>(terms_)}, -1, 1, noise, 40, local);
  const double lo = (*breaks_)[piece], hi = (*breaks_)[piece + 1];
  for (double& x : local) x = lo + 0.5 * (hi - lo) * (1 + x);
  return local;
}

Extreme Piecewise::maximum(const Piecewise& derivative) const {
  const double same = 1e-14 * largest();
  Extreme best{begin(), value_in(0, begin())};
  const auto consider = [&](std::size_t piece, double x) {
    const double v = value_in(piece, x);
    if (v > best.value + same) best = {x, v};
  };
  const double noise = 1e-13 * derivative.largest();
  for (std::size_t i = 0; i < pieces(); ++i) {
    consider(i, (*breaks_)[i]);
    consider(i, (*breaks_)[i + 1]);
    double bound = coefficient_[i * terms_];
    for (std::size_t k = 1; k < terms_; ++k) bound += std::abs(coefficient_[i * terms_ + k]);
    if (bound <= best.value) continue;
    for (const double root : derivative.roots_in(i, noise)) consider(i, root);
  }
  return best;
}

Extreme Piecewise::minimum(const Piecewise& derivative) const {
  const Extreme e = (-1.0 * *this).maximum(derivative);
  return {e.x, -e.value};
}
Extreme Piecewise::maximum() const { return maximum(derivative()); }
Extreme Piecewise::minimum() const { return minimum(derivative()); }

Piecewise operator+(const Piecewise& a, const Piecewise& b) {
  if (a.breaks_ != b.breaks_ && *a.breaks_ != *b.breaks_)
    throw std::logic_error("functions with different breaks cannot be added");
  const Piecewise& longer = a.terms_ >= b.terms_ ? a : b;
  const Piecewise& shorter = a.terms_ >= b.terms_ ? b : a;
  Piecewise sum = longer;
  for (std::size_t i = 0; i < sum.pieces(); ++i)
    for (std::size_t k = 0; k < shorter.terms_; ++k)
      sum.coefficient_[i * longer.terms_ + k] += shorter.coefficient_[i * shorter.terms_ + k];
  return sum;
}

Piecewise operator*(double factor, Piecewise f) {
  for (double& c : f.coefficient_) c *= factor;
  return f;
}

Piecewise Piecewise::constant(double c) const {
  Piecewise f;
  f.breaks_ = breaks_;
  f.terms_ = 1;
  f.coefficient_.assign(pieces(), c);
  return f;
}

}  // namespace kurbel
