// curve.h — a characteristic given by points ("graphically"): torque over time, angle or speed, force over travel.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/numerics/period.h"

namespace kurbel {

// Piecewise polynomial through the points (x, y), x strictly ascending: straight between points, or smooth
// (monotone cubic: Fritsch & Carlson 1980, no overshoot). Outside the points the end values hold, unless periodic.
// Pieces are numbered −1 (before the first point), 0 … n−2, n−1 (after the last).
class Curve {
 public:
  enum class Form { linear, smooth };

  Curve() = default;
  // period > 0: the points lie within one period and the curve closes itself. Throws std::invalid_argument on
  // fewer than 2 points, x not ascending, or points that span more than the period.
  Curve(std::vector<double> x, std::vector<double> y, Form form, double period = 0);

  bool empty() const { return x_.empty(); }
  Form form() const { return form_; }
  double period() const { return period_; }
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }
  double max_abs() const;

  // x brought into [first point, first point + period) by whole periods; x itself without a period.
  double within(double x) const {
    if (!(period_ > 0)) return x;
    const double place = x_.front() + place_within(x - x_.front(), period_);
    return place < x_.back() ? place : std::nextafter(x_.back(), x_.front());
  }
  // Piece that holds x, which may be any: of a periodic curve always one of 0 … n−2.
  int piece(double x) const {
    return static_cast<int>(std::upper_bound(x_.begin(), x_.end(), within(x)) - x_.begin()) - 1;
  }
  // Of any number: a piece before the first one ends where that begins.
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
    if (piece < 0) return T(y_.front());
    if (piece + 1 >= static_cast<int>(x_.size())) return T(y_.back());
    const auto i = static_cast<std::size_t>(piece);
    const T s = x - x_[i];
    return ((c3_[i] * s + c2_[i]) * s + c1_[i]) * s + y_[i];
  }
  template <class T>
  T value(const T& x) const {
    const double here = value_of(x), there = within(here);
    return value_in(piece(there), x + (there - here));
  }

 private:
  static double value_of(double x) { return x; }
  template <class T>
  static double value_of(const T& x) {
    return x.value;
  }

  std::vector<double> x_, y_, c1_, c2_, c3_;
  Form form_ = Form::linear;
  double period_ = 0;
};

}  // namespace kurbel
