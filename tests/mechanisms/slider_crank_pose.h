// slider_crank_pose.h — pose of rod and slider of a slider-crank with two derivatives by φ, also for dual numbers.
#pragma once

#include <cmath>
#include <type_traits>

#include "mechanisms/linkages/slider_crank.h"

namespace kurbel {

// Closure r sin φ + l sin β = e, over T = double or a dual number with sin, cos, sqrt, + − · / and comparison by value.
template <class T>
struct SliderCrankPose {
  static bool is_negative(const T& v) {
    if constexpr (std::is_class_v<T>)
      return v.value < 0;
    else
      return v < T(0);
  }
  T sin_phi, cos_phi, sin_beta, cos_beta, beta1, beta2, x, x1, x2;

  // `changes`: the data's changes().
  SliderCrankPose(const SliderCrankData& d, bool changes, T phi) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T r = d.radius, l = length(d, changes), e = d.offset;
    sin_phi = sin(phi), cos_phi = cos(phi);
    sin_beta = (e - r * sin_phi) / l;
    if (changes)
      pass_upright(d, phi);
    else
      keep_side(d);
    const T lever = l * cos_beta, rise = l * sin_beta;
    const T beta1_squared = beta1 * beta1;
    x = r * cos_phi + lever;
    x1 = -r * sin_phi - rise * beta1;
    x2 = -r * cos_phi - lever * beta1_squared - rise * beta2;
  }

 private:
  static double length(const SliderCrankData& d, bool changes) {
    return changes ? d.radius + std::fabs(d.offset) : d.rod_length;
  }
  void keep_side(const SliderCrankData& d) {
    using std::sqrt;
    const T r = d.radius, l = d.rod_length, e = d.offset;
    // cos²β = (1 − sin β)(1 + sin β). Near l = r + |e| these factors vanish with 1 ± sin φ; cos²φ avoids the
    // cancellation.
    const T cos_squared = cos_phi * cos_phi;
    const T below = is_negative(sin_phi) ? cos_squared / (T(1) - sin_phi) : T(1) + sin_phi;   // 1 + sin φ
    const T above = is_negative(-sin_phi) ? cos_squared / (T(1) + sin_phi) : T(1) - sin_phi;  // 1 − sin φ
    cos_beta = sqrt(((l - r - e) + r * below) * ((l - r + e) + r * above)) / l;
    if (d.folds) cos_beta = -cos_beta;
    const T lever = l * cos_beta, rise = l * sin_beta;
    beta1 = -r * cos_phi / lever;
    const T beta1_squared = beta1 * beta1;
    beta2 = (r * sin_phi + rise * beta1_squared) / lever;
  }

  static T right_angle() {
    if constexpr (std::is_floating_point_v<T>)
      return static_cast<T>(1.57079632679489661923L);
    else
      return T(1.5707963267948966);
  }

  // l = r + |e|. With h = (φ + π/2)/2, k = √r cos h and m = √r sin h (e < 0: the two exchanged), l cos β =
  // 2 m √(|e| + k²) and r cos φ = 2 k m: m cancels in β′ = −k/√(|e| + k²).
  void pass_upright(const SliderCrankData& d, T phi) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T side = d.folds ? -1 : 1, e = d.offset, gap = std::fabs(d.offset), root = sqrt(T(d.radius));
    if (d.offset == 0) {
      cos_beta = side * cos_phi, beta1 = -side, beta2 = T(0);
      return;
    }
    const T h = T(0.5) * (phi + right_angle()), c = root * cos(h), s = root * sin(h);
    const T k = d.offset > 0 ? c : s, m = d.offset > 0 ? s : c, q = gap + k * k, cube = q * sqrt(q);
    cos_beta = side * T(2) * m * sqrt(q) / (d.radius + gap);
    beta1 = -side * k / sqrt(q);
    beta2 = side * e * m / (T(2) * cube);
  }
};

}  // namespace kurbel
