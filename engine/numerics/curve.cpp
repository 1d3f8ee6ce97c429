// curve.cpp — coefficients of the pieces.
#include "engine/numerics/curve.h"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>
#include <utility>

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

// A cubic between two points of a curve, f = a + (b − a) u + u (1 − u) (p + q (2u − 1)) with u from 0 to 1. Of all p and q
// the mean square of what it is off is least at
//     p = 30 ∫ g u (1 − u) du,   q = 210 ∫ g u (1 − u) (2u − 1) du,   g the curve less a + (b − a) u
struct CubicBetween {
  double begin = 0, length = 1, a = 0, b = 0, p = 0, q = 0;

  double value(double x) const {
    const double u = (x - begin) / length;
    return a + (b - a) * u + u * (1 - u) * (p + q * (2 * u - 1));
  }
};

// Places in [a, b] where a law is narrow against the way between knots, such as a pulse of 1 ms within 3 s, or of 1° within
// a turn: a step could pass it by, as each of its evaluations may lie beside it. Intervals are halved until the cubic
// through values and slopes at their ends is within a thousandth of the law's range at all samples; if they are alike, steps
// see the law everywhere, and it needs no knots. What lies between the samples, or is lower, is not seen.
std::vector<double> narrow_parts(const FormulaProgram& law, double a, double b, int cells) {
  constexpr int alike = 16;
  constexpr double plain = 1e-3, rounding = 1e-9;
  const auto place = [&](int i) { return a + (b - a) * i / cells; };
  std::vector<double> y(static_cast<std::size_t>(cells) + 1);
  for (int i = 0; i <= cells; ++i) y[static_cast<std::size_t>(i)] = law(place(i));
  const auto [least, most] = std::minmax_element(y.begin(), y.end());
  const double slack = plain * (*most - *least);
  if (!(slack > rounding * std::max(std::abs(*least), std::abs(*most))) || !std::isfinite(slack)) return {};
  std::vector<std::pair<int, int>> open = {{0, cells}};
  std::vector<int> ends;
  int shortest = cells, longest = 0;
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const double h = place(j) - place(i);
    const Dual<1> p = law(Dual<1>::input(place(i), 0)), q = law(Dual<1>::input(place(j), 0));
    const double rise = q.value - p.value, p1 = h * p.d[0], q1 = h * q.d[0];
    bool is_plain = true;
    for (int k = i + 1; k < j && is_plain; ++k) {
      const double u = static_cast<double>(k - i) / (j - i);
      const double cubic = p.value + u * (p1 + u * (3 * rise - 2 * p1 - q1 + u * (p1 + q1 - 2 * rise)));
      is_plain = std::abs(y[static_cast<std::size_t>(k)] - cubic) <= slack;
    }
    if (!is_plain) {
      open.push_back({(i + j) / 2, j});
      open.push_back({i, (i + j) / 2});
      continue;
    }
    if (j < cells) ends.push_back(j);
    shortest = std::min(shortest, j - i), longest = std::max(longest, j - i);
  }
  if (longest < alike * shortest) return {};
  std::vector<double> places;
  for (const int i : ends) places.push_back(place(i));
  return places;
}

class FewerPieces {
 public:
  FewerPieces(const Curve& curve, double within) : curve_(curve), within_(within) {
    const std::size_t points = curve.x().size();
    left_.resize(points), right_.resize(points);
    for (std::size_t i = 0; i < points; ++i) {
      left_[i] = i == 0 ? curve.before() : curve.end_value(i - 1);
      right_[i] = curve.y()[i];
    }
    lift_points();
  }

  std::vector<std::pair<std::size_t, CubicBetween>> run() {  // with the number of the point that each begins at
    std::vector<std::pair<std::size_t, CubicBetween>> pieces;
    std::size_t guess = 2;
    for (std::size_t from = 0; from + 1 < left_.size();) {
      const std::size_t to = farthest(from, guess);
      pieces.emplace_back(from, between(from, to));
      guess = (to - from) / 2, from = to;
    }
    return pieces;
  }

  // One interval of the curve stays what it is, but for its lifted ends.
  double lift_at(std::size_t i, bool end) const { return (end ? left_[i] - given_end(i) : right_[i] - curve_.y()[i]); }

 private:
  static constexpr double jump = 1e-9;  // of the greatest value

  double given_end(std::size_t i) const { return curve_.end_value(i - 1); }
  bool jumps_at(std::size_t i) const { return std::abs(given_end(i) - curve_.y()[i]) > jump * curve_.max_abs(); }
  double slope(std::size_t piece, bool end) const {
    const std::vector<double>& x = curve_.x();
    const int k = static_cast<int>(piece);
    const double h = 1e-3 * (x[piece + 1] - x[piece]), at = end ? x[piece + 1] : x[piece];
    return (curve_.value_in(k, at + (end ? 0 : h)) - curve_.value_in(k, at - (end ? h : 0))) / h;
  }
  // Straight lines between the points of a bent law lie on one side of it: about a point their mean is off by its kink
  // times a twelfth of the way between points. By as much knots are lifted, where kinks beside each other are alike.
  void lift_points() {
    const std::size_t points = left_.size();
    if (points < 5) return;
    std::vector<double> kink(points, 0.0);
    for (std::size_t i = 1; i + 1 < points; ++i) kink[i] = slope(i, false) - slope(i - 1, true);
    const std::vector<double>& x = curve_.x();
    for (std::size_t i = 2; i + 2 < points; ++i) {
      const auto [least, most] = std::minmax({kink[i - 1], kink[i], kink[i + 1]});
      if (least * most <= 0 || jumps_at(i)) continue;
      const double lift = (least > 0 ? least : most) * 0.5 * (x[i + 1] - x[i - 1]) / 12;
      if (std::abs(lift) > 0.5 * within_) continue;
      left_[i] += lift, right_[i] += lift;
    }
  }

  CubicBetween between(std::size_t from, std::size_t to) const {
    const std::vector<double>& x = curve_.x();
    CubicBetween f{x[from], x[to] - x[from], right_[from], left_[to]};
    for (std::size_t i = from; i < to; ++i)
      gauss<4>.over(x[i], x[i + 1] - x[i], [&](double at, double weight) {
        const double u = (at - f.begin) / f.length;
        const double off = curve_.value_in(static_cast<int>(i), at) - (f.a + (f.b - f.a) * u);
        f.p += 30 * weight / f.length * off * u * (1 - u);
        f.q += 210 * weight / f.length * off * u * (1 - u) * (2 * u - 1);
      });
    return f;
  }
  // The most that the cubic is off; beyond all bounds over a jump.
  double off(std::size_t from, std::size_t to) const {
    for (std::size_t i = from + 1; i < to; ++i)
      if (jumps_at(i)) return HUGE_VAL;
    const CubicBetween f = between(from, to);
    const std::vector<double>& x = curve_.x();
    double most = 0;
    for (std::size_t i = from; i < to; ++i)
      for (const double part : {0.0, 0.25, 0.5, 0.75}) {
        const double at = x[i] + part * (x[i + 1] - x[i]);
        most = std::max(most, std::abs(f.value(at) - curve_.value_in(static_cast<int>(i), at)));
      }
    return most;
  }
  // The last point, but for a few, that a cubic from there on reaches.
  std::size_t farthest(std::size_t from, std::size_t guess) const {
    std::size_t good = from + 1, bad = left_.size();
    for (std::size_t to = from + std::max<std::size_t>(guess, 2); to < bad; to += to - from)
      (off(from, to) <= within_ ? good : bad) = to;
    while (bad - good > 1 + (good - from) / 16) {
      const std::size_t middle = good + (bad - good) / 2;
      (off(from, middle) <= within_ ? good : bad) = middle;
    }
    return good;
  }

  const Curve& curve_;
  double within_;
  std::vector<double> left_, right_;  // values of the new knots, at either side of every point
};

}  // namespace

Curve Curve::by_fewer_pieces(double within) const {
  if (programs_ || x_.size() < 3) return *this;
  FewerPieces search(*this, within);
  const auto pieces = search.run();
  if (pieces.size() + 1 >= x_.size()) return *this;
  Curve made = *this;
  made.form_ = Form::smooth;
  made.x_.clear(), made.y_.clear(), made.c1_.clear(), made.c2_.clear(), made.c3_.clear();
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& [from, f] = pieces[k];
    const std::size_t to = k + 1 < pieces.size() ? pieces[k + 1].first : x_.size() - 1;
    const double h = f.length;
    made.x_.push_back(x_[from]);
    made.y_.push_back(f.a);
    if (to == from + 1) {  // as it was, its ends lifted
      const double begin = search.lift_at(from, false), end = search.lift_at(to, true);
      made.c1_.push_back(c1_[from] + (end - begin) / h), made.c2_.push_back(c2_[from]), made.c3_.push_back(c3_[from]);
    } else {
      made.c1_.push_back((f.b - f.a + f.p - f.q) / h);
      made.c2_.push_back((3 * f.q - f.p) / (h * h));
      made.c3_.push_back(-2 * f.q / (h * h * h));
    }
  }
  made.x_.push_back(x_.back());
  made.y_.push_back(y_.back());
  return made;
}

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
  seamless_ = closes_without_kink();
}

Curve::Curve(std::vector<double> knots, std::vector<FormulaProgram> programs, double period)
    : form_(Form::formula), period_(period) {
  const std::vector<FormulaProgram> given = std::exchange(programs, {});
  const double whole = knots.back() - knots.front();
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto cells = static_cast<int>(std::max(64.0, 2048 * (knots[i + 1] - knots[i]) / whole));
    const std::vector<double> more = narrow_parts(given[i], knots[i], knots[i + 1], cells);
    x_.push_back(knots[i]);
    x_.insert(x_.end(), more.begin(), more.end());
    programs.insert(programs.end(), 1 + more.size(), given[i]);
  }
  x_.push_back(knots.back());
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
  seamless_ = closes_without_kink();
}

bool Curve::closes_without_kink() const {
  if (!(period_ > 0) || pieces() != 1) return false;
  const double slack = 1e-9 * max_abs_;
  return std::abs(end_value(0) - y_.front()) <= slack && std::abs(last_slope() - first_slope()) * period_ <= slack;
}

// Of a formula c1 … c3 are the slope at the begin, the value and the slope at the end.
Curve Curve::over_angle() const {
  constexpr double two_turns = 4 * std::numbers::pi;
  constexpr int most_modes = 100'000'000;
  Curve made = *this;
  std::vector<FormulaProgram> programs;
  const auto insert = [](std::vector<double>& v, std::size_t i, double value) {
    v.insert(v.begin() + static_cast<std::ptrdiff_t>(i), value);
  };
  for (std::size_t i = c1_.size(); i-- > 0;) {
    if (programs_) programs.push_back((*programs_)[i]);
    const double half = 0.5 * (x_[i + 1] - x_[i]);
    if (2 * half <= 0.75 * two_turns) continue;
    const Dual<1> middle = value_in(static_cast<int>(i), Dual<1>::input(x_[i] + half, 0));
    insert(made.x_, i + 1, x_[i] + half);
    insert(made.y_, i + 1, middle.value);
    insert(made.c1_, i + 1, middle.d[0]);
    if (programs_) {
      programs.push_back((*programs_)[i]);
      insert(made.c2_, i, middle.value);
      insert(made.c3_, i, middle.d[0]);
    } else {
      insert(made.c2_, i + 1, c2_[i] + 3 * c3_[i] * half);
      insert(made.c3_, i + 1, c3_[i]);
    }
  }
  if (programs_)
    made.programs_ = std::make_shared<const std::vector<FormulaProgram>>(programs.rbegin(), programs.rend());
  made.seamless_ = seamless_ && made.pieces() == 1;
  if (const double periods = std::max(1.0, std::round(two_turns / period_));
      !made.seamless_ && periods * made.pieces() < most_modes)
    made.periods_ = static_cast<int>(periods);
  return made;
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
