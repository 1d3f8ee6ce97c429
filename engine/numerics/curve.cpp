// curve.cpp — coefficients of the pieces.
#include "engine/numerics/curve.h"

#include <fmt/format.h>

#include <stdexcept>

namespace kurbel {
namespace {

// Slopes at the points that keep a cubic monotone between them (Fritsch & Carlson 1980, harmonic-mean form).
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y, bool periodic) {
  const std::size_t n = x.size();
  std::vector<double> slope(n, 0.0);
  const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  const auto join = [](double h0, double d0, double h1, double d1) {
    if (d0 * d1 <= 0) return 0.0;
    const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
  };
  for (std::size_t i = 1; i + 1 < n; ++i) slope[i] = join(x[i] - x[i - 1], secant(i - 1), x[i + 1] - x[i], secant(i));
  if (periodic) {
    slope[0] = slope[n - 1] = join(x[n - 1] - x[n - 2], secant(n - 2), x[1] - x[0], secant(0));
  } else {
    slope[0] = secant(0);
    slope[n - 1] = secant(n - 2);
  }
  return slope;
}

}  // namespace

Curve::Curve(std::vector<double> x, std::vector<double> y, Form form, double period)
    : x_(std::move(x)), y_(std::move(y)), form_(form), period_(period) {
  if (x_.size() < 2 || x_.size() != y_.size())
    throw std::invalid_argument(fmt::format("a table needs two or more points; got {}", x_.size()));
  for (std::size_t i = 1; i < x_.size(); ++i)
    if (!(x_[i] > x_[i - 1]))
      throw std::invalid_argument(fmt::format("the first column must ascend; row {} does not", i + 1));
  if (period_ > 0) {
    // A closing point at one period is the first point again; it is added where the data leave it out.
    const double span = x_.back() - x_.front(), slack = 1e-9 * period_;
    if (span > period_ + slack)
      throw std::invalid_argument(fmt::format("the points span {} but the period is {}", span, period_));
    if (span < period_ - slack) {
      x_.push_back(x_.front() + period_);
      y_.push_back(y_.front());
    } else if (std::abs(y_.back() - y_.front()) > 1e-9 * max_abs()) {
      throw std::invalid_argument("the last point lies one period after the first but has another value");
    }
    x_.back() = x_.front() + period_;
  }
  const std::size_t n = x_.size();
  c1_.assign(n - 1, 0);
  c2_.assign(n - 1, 0);
  c3_.assign(n - 1, 0);
  const std::vector<double> slope =
      form_ == Form::smooth ? monotone_slopes(x_, y_, period_ > 0) : std::vector<double>();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = x_[i + 1] - x_[i], secant = (y_[i + 1] - y_[i]) / h;
    if (form_ == Form::linear) {
      c1_[i] = secant;
    } else {
      c1_[i] = slope[i];
      c2_[i] = (3 * secant - 2 * slope[i] - slope[i + 1]) / h;
      c3_[i] = (slope[i] + slope[i + 1] - 2 * secant) / (h * h);
    }
  }
}

double Curve::max_abs() const {
  double largest = 0;
  for (const double y : y_) largest = std::max(largest, std::abs(y));
  return largest;
}

}  // namespace kurbel
