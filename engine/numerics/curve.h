// curve.h — a characteristic given by points or a formula: torque over time, angle or speed, force over travel.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/numerics/dual.h"
#include "engine/numerics/formula.h"
#include "engine/numerics/period.h"

namespace kurbel {

// Piecewise polynomial through the points (x, y), x ascending: linear, or smooth (monotone cubic: Fritsch & Carlson 1980,
// no overshoot). Two points at the same x are a jump; at x the value after it applies. Outside the points the curve is
// constant, or continued by the slope at the end, unless periodic. Pieces are numbered −1 (before the first point), 0 … n−2,
// n−1 (after the last), points at the same x counted once. For a formula its knots take the role of the points.
// Continuation of a curve beyond its data as defined in the scene; it then counts as data. refuse: no continuation.
enum class Beyond { unspecified, hold, line, refuse };

class Curve {
 public:
  enum class Form { linear, smooth, formula };

  Curve() = default;
  // period > 0: the points lie within one period and the curve is closed. Throws std::invalid_argument for fewer than 2
  // points, x not ascending, three points at the same x, or points that span more than the period.
  Curve(const std::vector<double>& x, const std::vector<double>& y, Form form, double period = 0);
  // One program for each piece between ascending knots, which span the period if there is one. Throws
  // std::invalid_argument if a value or slope at the end of a piece is not finite.
  Curve(std::vector<double> knots, std::vector<FormulaProgram> programs, double period = 0);

  // Approximation by fewer cubic pieces between some of its points, with errors up to `within` [unit of y] at the points and
  // at quarters of the intervals between; each is the least-squares cubic between its ends. Jumps and both ends are kept;
  // a formula is unchanged, as are parts that fewer pieces do not approximate.
  Curve by_fewer_pieces(double within) const;

  // The same law of an angle known without whole double turns: its pieces are distinguished within two turns, so that
  // no step leads from a piece to the same one a period later; one longer than three quarters of two turns becomes two.
  Curve over_angle() const;

  // Defines the continuation at both ends; default: undefined, with constant end values.
  void go_on(Beyond before, Beyond after);
  void say(Beyond before, Beyond after) { beyond_first_ = before, beyond_last_ = after; }  // values unchanged
  // Continues an end by its slope without definition in the scene.
  void follow_first_slope() { slope_before_ = first_slope(); }
  void follow_last_slope() { slope_after_ = last_slope(); }
  Beyond beyond_first() const { return beyond_first_; }
  Beyond beyond_last() const { return beyond_last_; }
  double first_slope() const { return c1_.front(); }  // at the first and the last point, within the data
  double last_slope() const;
  bool follows_slope(bool after) const { return (after ? slope_after_ : slope_before_) != 0; }

  bool empty() const { return x_.empty(); }
  Form form() const { return form_; }
  double period() const { return period_; }
  int pieces() const { return static_cast<int>(x_.size()) - 1; }
  int periods() const { return periods_; }        // whose pieces are distinguished
  bool is_seamless() const { return seamless_; }  // one piece that goes on without a kink a period later
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }  // at x, after a jump
  double before() const { return before_; }            // the value up to the first point
  double end_value(std::size_t piece) const { return value_in(static_cast<int>(piece), x_[piece + 1]); }
  bool jumps() const;
  const std::vector<FormulaProgram>& programs() const { return *programs_; }  // of a formula
  double max_abs() const { return max_abs_; }

  // x shifted into [first point, first point + period) by whole periods; x itself without a period.
  double within(double x) const {
    if (!(period_ > 0)) return x;
    const double place = x_.front() + place_within(x - x_.front(), period_);
    return place < x_.back() ? place : std::nextafter(x_.back(), x_.front());
  }
  // Piece of any x; for a periodic curve always one of 0 … n−2.
  int piece(double x) const {
    return static_cast<int>(std::upper_bound(x_.begin(), x_.end(), within(x)) - x_.begin()) - 1;
  }
  // For any piece number; a piece before the first one ends where the first begins.
  double piece_begin(int piece) const {
    return piece < 0 ? -HUGE_VAL : x_[std::min(static_cast<std::size_t>(piece), x_.size() - 1)];
  }
  double piece_end(int piece) const {
    if (piece + 1 >= static_cast<int>(x_.size())) return HUGE_VAL;
    return x_[static_cast<std::size_t>(std::max(piece + 1, 0))];
  }

  // Value of one piece, continued beyond its ends: between events a right-hand side stays smooth.
  template <class T>
  T value_in(int piece, const T& x) const {
    if (piece < 0) return slope_before_ == 0 ? T(before_) : T(before_ + slope_before_ * (x - x_.front()));
    if (piece + 1 >= static_cast<int>(x_.size()))
      return slope_after_ == 0 ? T(y_.back()) : T(y_.back() + slope_after_ * (x - x_.back()));
    const auto i = static_cast<std::size_t>(piece);
    if (programs_) return by_formula(i, x);
    const T s = x - x_[i];
    return ((c3_[i] * s + c2_[i]) * s + c1_[i]) * s + y_[i];
  }
  // ∫ of one piece from one x to another: exact between points, by many short panels for a formula.
  double area(int piece, double from, double to) const;
  template <class T>
  T value(const T& x) const {
    using kurbel::value_of;
    const double here = value_of(x), there = within(here);
    return value_in(piece(there), x + (there - here));
  }

 private:
  bool closes_without_kink() const;
  // Beyond the ends of the piece by the tangent, so that trial steps stay within the domain of the formula.
  template <class T>
  T by_formula(std::size_t i, const T& x) const {
    using kurbel::value_of;
    const double here = value_of(x);
    if (here < x_[i]) return y_[i] + c1_[i] * (x - x_[i]);
    if (here > x_[i + 1]) return c2_[i] + c3_[i] * (x - x_[i + 1]);
    return (*programs_)[i](x);
  }

  std::vector<double> x_, y_, c1_, c2_, c3_;  // c1 … c3 of a formula: slope at the begin, value and slope at the end
  Form form_ = Form::linear;
  double period_ = 0;
  int periods_ = 1;
  bool seamless_ = false;
  double before_ = 0, max_abs_ = 0;
  double slope_before_ = 0, slope_after_ = 0;  // beyond the ends
  Beyond beyond_first_ = Beyond::unspecified, beyond_last_ = Beyond::unspecified;
  std::shared_ptr<const std::vector<FormulaProgram>> programs_;  // null: by points
};

}  // namespace kurbel
