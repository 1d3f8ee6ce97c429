// rounded_profile.h — piecewise linear profile with rounded edges: no jumps, no kinks, no events, the same work.
//
//     f_w = f ∗ κ,   κ(u) = 35/(32 w) (1 − u²)³ for |u| = |d/w| ≤ 1          three times differentiable
//         = f(d) + Σ_k [jump_k (S − H)(u_k) + w kink_k (P − u_k H)(u_k)],   u_k = (d − d_k)/w,  S = ∫κ, P = ∫S
// The convolution preserves the area, except within w of the ends of the travel.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/numerics/curve.h"
#include "engine/numerics/dual.h"

namespace kurbel {

class RoundedProfile {
 public:
  struct Knot {
    double at = 0;                // d_k [m] or [rad]
    double jump = 0, kink = 0;    // of the value and of the slope
    double value = 0, slope = 0;  // of the piece that begins here
  };

  RoundedProfile() = default;
  // From a piecewise linear curve, which may be periodic.
  RoundedProfile(const Curve& curve, double width) : before_(curve.before()), width_(width), period_(curve.period()) {
    const std::vector<double>&x = curve.x(), &y = curve.y();
    double value = before_, slope = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double end = curve.end_value(i), rise = (end - y[i]) / (x[i + 1] - x[i]);
      knots_.push_back({x[i], y[i] - value, rise - slope, y[i], rise});
      value = end, slope = rise;
    }
    if (period_ > 0) {
      // The last point is the first one: one knot, with the pieces on both sides.
      knots_.front().jump = y.front() - value;
      knots_.front().kink = knots_.front().slope - slope;
    } else {
      knots_.push_back({x.back(), y.back() - value, 0 - slope, y.back(), 0});
    }
  }

  bool empty() const { return knots_.empty(); }
  double width() const { return width_; }
  double greatest() const {
    double most = std::abs(before_);
    for (const Knot& k : knots_) most = std::max({most, std::abs(k.value), std::abs(k.value - k.jump)});
    return most;
  }

  template <class T>
  T value(const T& given) const {
    T d = given;
    if (period_ > 0) {
      const double begin = knots_.front().at, here = value_of(given);
      d = d + (begin + place_within(here - begin, period_) - here);
    }
    const double x = value_of(d);
    const auto next =
        std::upper_bound(knots_.begin(), knots_.end(), x, [](double a, const Knot& k) { return a < k.at; });
    T sum = next == knots_.begin() ? T(before_) : (next - 1)->value + (next - 1)->slope * (d - (next - 1)->at);
    for (auto k = next; k != knots_.begin() && x - (k - 1)->at < width_; --k) sum = sum + rounded(*(k - 1), d, 0);
    for (auto k = next; k != knots_.end() && k->at - x < width_; ++k) sum = sum + rounded(*k, d, 0);
    if (period_ > 0) {  // knots of the previous and the next period
      for (auto k = knots_.end(); k != knots_.begin() && x + period_ - (k - 1)->at < width_; --k)
        sum = sum + rounded(*(k - 1), d, period_);
      for (auto k = knots_.begin(); k != knots_.end() && k->at + period_ - x < width_; ++k)
        sum = sum + rounded(*k, d, -period_);
    }
    return sum;
  }

 private:
  // Correction by rounding near a knot, at d + moved.
  template <class T>
  T rounded(const Knot& k, const T& d, double moved) const {
    const T u = (d + (moved - k.at)) / width_;
    const double side = value_of(u) >= 0 ? 1 : 0;
    const T s = u * u;
    const T step = 0.5 + 35.0 / 32 * u * (1 - s * (1 - s * (0.6 - s / 7.0)));
    const T ramp = 0.5 * u + 35.0 / 32 * s * (0.5 - s * (0.25 - s * (0.1 - s / 56.0))) + 35.0 / 256;
    return k.jump * (step - side) + (width_ * k.kink) * (ramp - side * u);
  }

  double before_ = 0, width_ = 0, period_ = 0;
  std::vector<Knot> knots_;
};

}  // namespace kurbel
