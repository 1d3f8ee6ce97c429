// curve.cpp — coefficients of the pieces.
#include "engine/numerics/curve.h"

#include <fmt/format.h>

#include <stdexcept>

#include "engine/base/gauss.h"

namespace kurbel {
namespace {

// Slopes at the points that keep a cubic monotone between them (Fritsch & Carlson 1980, harmonic-mean form), of a part
// without jumps: its points first … last.
void monotone_slopes(const std::vector<double>& x, const std::vector<double>& y, std::size_t first, std::size_t last,
                     bool periodic, std::vector<double>& slope) {
  const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  const auto join = [](double h0, double d0, double h1, double d1) {
    if (d0 * d1 <= 0) return 0.0;
    const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
  };
  for (std::size_t i = first + 1; i < last; ++i)
    slope[i] = join(x[i] - x[i - 1], secant(i - 1), x[i + 1] - x[i], secant(i));
  if (periodic) {
    slope[first] = slope[last] = join(x[last] - x[last - 1], secant(last - 1), x[first + 1] - x[first], secant(first));
  } else {
    slope[first] = secant(first);
    slope[last] = secant(last - 1);
  }
}

// At every point, jumps between equal x.
std::vector<double> slopes_between_jumps(const std::vector<double>& x, const std::vector<double>& y, bool periodic) {
  std::vector<double> slope(x.size(), 0.0);
  for (std::size_t first = 0; first < x.size();) {
    std::size_t last = first;
    while (last + 1 < x.size() && x[last + 1] > x[last]) ++last;
    const bool whole = first == 0 && last + 1 == x.size();
    if (last > first) monotone_slopes(x, y, first, last, periodic && whole, slope);
    first = last + 1;
  }
  return slope;
}

void check_ascending(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2 || x.size() != y.size())
    throw std::invalid_argument(fmt::format("a table needs two or more points; got {}", x.size()));
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] >= x[i - 1]))
      throw std::invalid_argument(fmt::format("the first column must ascend; row {} does not", i + 1));
  for (std::size_t i = 2; i < x.size(); ++i)
    if (x[i] == x[i - 2]) throw std::invalid_argument(fmt::format("three points at one place; drop row {}", i));
  if (x.front() == x.back()) throw std::invalid_argument("all points stand at one place");
}

}  // namespace

Curve::Curve(const std::vector<double>& given_x, const std::vector<double>& given_y, Form form, double period)
    : form_(form), period_(period) {
  check_ascending(given_x, given_y);
  std::vector<double> x = given_x, y = given_y;
  if (period_ > 0) {
    // A closing point at one period is the first point again; it is added where the data leave it out.
    const double span = x.back() - x.front(), slack = 1e-9 * period_;
    double greatest = 0;
    for (const double v : y) greatest = std::max(greatest, std::abs(v));
    if (span > period_ + slack)
      throw std::invalid_argument(fmt::format("the points span {} but the period is {}", span, period_));
    if (span < period_ - slack) {
      x.push_back(x.front() + period_);
      y.push_back(y.front());
    } else if (std::abs(y.back() - y.front()) > 1e-9 * greatest) {
      throw std::invalid_argument("the last point lies one period after the first but has another value");
    }
    const double end = x.front() + period_;
    for (std::size_t i = x.size(); i-- > 0 && x[i] >= end - slack;) x[i] = end;
  }
  const std::vector<double> slope =
      form_ == Form::smooth ? slopes_between_jumps(x, y, period_ > 0) : std::vector<double>();
  before_ = y.front();
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double h = x[i + 1] - x[i], secant = (y[i + 1] - y[i]) / h;
    if (h == 0) continue;
    x_.push_back(x[i]);
    y_.push_back(y[i]);
    const bool smooth = form_ == Form::smooth;
    c1_.push_back(smooth ? slope[i] : secant);
    c2_.push_back(smooth ? (3 * secant - 2 * slope[i] - slope[i + 1]) / h : 0);
    c3_.push_back(smooth ? (slope[i] + slope[i + 1] - 2 * secant) / (h * h) : 0);
  }
  x_.push_back(x.back());
  y_.push_back(y.back());
  for (const double v : y) max_abs_ = std::max(max_abs_, std::abs(v));
}

Curve::Curve(std::vector<double> knots, std::vector<FormulaProgram> programs, double period)
    : x_(std::move(knots)), form_(Form::formula), period_(period) {
  const auto at = [&](std::size_t piece, double x, double& value, double& slope) {
    const Dual<1> y = programs[piece](Dual<1>::input(x, 0));
    value = y.value, slope = y.d[0];
    constexpr double most = 1e30;
    if (!(std::abs(value) <= most) || !(std::abs(slope) <= most))
      throw std::invalid_argument(
          fmt::format("its {} at {:.6g} is infinite", std::abs(value) <= most ? "slope" : "value", x));
  };
  const std::size_t pieces = programs.size();
  y_.resize(pieces + 1), c1_.resize(pieces), c2_.resize(pieces), c3_.resize(pieces);
  for (std::size_t i = 0; i < pieces; ++i) {
    at(i, x_[i], y_[i], c1_[i]);
    at(i, x_[i + 1], c2_[i], c3_[i]);
    constexpr int samples = 64;
    for (int k = 0; k <= samples; ++k)
      max_abs_ = std::max(max_abs_, std::abs(programs[i](x_[i] + (x_[i + 1] - x_[i]) * k / samples)));
  }
  before_ = y_.front();
  y_.back() = c2_.back();
  programs_ = std::make_shared<const std::vector<FormulaProgram>>(std::move(programs));
}

double Curve::area(int piece, double from, double to) const {
  const int panels = programs_ ? 128 : 1;
  const double width = (to - from) / panels;
  double sum = 0;
  for (int k = 0; k < panels; ++k)
    gauss<2>.over(from + k * width, width, [&](double x, double weight) { sum += weight * value_in(piece, x); });
  return sum;
}

double Curve::last_slope() const {
  if (programs_) return c3_.back();
  const double s = x_.back() - x_[x_.size() - 2];
  return (3 * c3_.back() * s + 2 * c2_.back()) * s + c1_.back();
}

void Curve::go_on(Beyond before, Beyond after) {
  if (period_ > 0) return;
  say(before, after);
  slope_before_ = before == Beyond::line ? first_slope() : 0;
  slope_after_ = after == Beyond::line ? last_slope() : 0;
}

bool Curve::jumps() const {
  if (before_ != y_.front()) return true;
  for (std::size_t i = 0; i + 1 < x_.size(); ++i)
    if (std::abs(end_value(i) - y_[i + 1]) > 1e-9 * max_abs_) return true;
  return false;
}

}  // namespace kurbel
