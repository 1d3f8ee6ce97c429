// slider_crank_geometry.h — the slider-crank in closed form, a third source beside both extractions: motion, reduced inertia and
// weight over the crank angle, with derivatives by hand. Shares with them nothing but the data (slider_crank.h has the drawing).
#pragma once

#include <cmath>
#include <type_traits>

#include "mechanisms/linkages/slider_crank.h"

namespace kurbel {

template <class T>
struct ValueSlopeCurvature {
  T value, slope, curvature;
};

// Closed form over T = double, long double or a dual number with sin, cos, sqrt, + − · / and comparison by value.
class SliderCrankGeometry {
 public:
  explicit SliderCrankGeometry(const SliderCrankData& data) : d_(data), changes_(data.changes()) {
    throw_if_any("slider-crank", faults_of(data));
    if (changes_) d_.rod_length = d_.radius + std::fabs(d_.offset);
  }
  const SliderCrankData& data() const { return d_; }

  // Closure r sin φ + l sin β = e, cos β > 0, and its first three derivatives by φ.
  template <class T>
  struct Pose {
    static bool is_negative(const T& v) {
      if constexpr (std::is_class_v<T>)
        return v.value < 0;
      else
        return v < T(0);
    }
    T sin_phi, cos_phi, sin_beta, cos_beta, beta1, beta2, beta3, x, x1, x2, x3;

    // Of one that passes no change point.
    Pose(const SliderCrankData& d, T phi) : Pose(d, false, phi) {}
    Pose(const SliderCrankData& d, bool changes, T phi) {
      using std::cos;
      using std::sin;
      using std::sqrt;
      const T r = d.radius, l = d.rod_length, e = d.offset;
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
      x3 = r * sin_phi + rise * (beta1 * beta1_squared - beta3) - T(3) * lever * beta1 * beta2;
    }

   private:
    void keep_side(const SliderCrankData& d) {
      using std::sqrt;
      const T r = d.radius, l = d.rod_length, e = d.offset;
      // cos²β = (1 − sin β)(1 + sin β). Near l = r + |e| these factors vanish with 1 ± sin φ; written with cos²φ they
      // keep every digit.
      const T cos_squared = cos_phi * cos_phi;
      const T below = is_negative(sin_phi) ? cos_squared / (T(1) - sin_phi) : T(1) + sin_phi;   // 1 + sin φ
      const T above = is_negative(-sin_phi) ? cos_squared / (T(1) + sin_phi) : T(1) - sin_phi;  // 1 − sin φ
      cos_beta = sqrt(((l - r - e) + r * below) * ((l - r + e) + r * above)) / l;
      if (d.folds) cos_beta = -cos_beta;
      const T lever = l * cos_beta, rise = l * sin_beta;
      beta1 = -r * cos_phi / lever;
      const T beta1_squared = beta1 * beta1;
      beta2 = (r * sin_phi + rise * beta1_squared) / lever;
      beta3 = beta1 * (beta1_squared - T(1)) + T(3) * sin_beta / cos_beta * beta1 * beta2;
    }

    static T right_angle() {
      if constexpr (std::is_floating_point_v<T>)
        return static_cast<T>(1.57079632679489661923L);
      else
        return T(1.5707963267948966);
    }

    // l = r + |e|. With h = (φ + π/2)/2, k = √r cos h and m = √r sin h (e < 0: the two exchanged), l cos β =
    // 2 m √(|e| + k²) and r cos φ = 2 k m: m is gone from β′ = −k/√(|e| + k²).
    void pass_upright(const SliderCrankData& d, T phi) {
      using std::cos;
      using std::sin;
      using std::sqrt;
      const T side = d.folds ? -1 : 1, e = d.offset, gap = std::fabs(d.offset), root = sqrt(T(d.radius));
      if (d.offset == 0) {
        cos_beta = side * cos_phi, beta1 = -side, beta2 = beta3 = T(0);
        return;
      }
      const T h = T(0.5) * (phi + right_angle()), c = root * cos(h), s = root * sin(h);
      const T k = d.offset > 0 ? c : s, m = d.offset > 0 ? s : c, q = gap + k * k, cube = q * sqrt(q);
      cos_beta = side * T(2) * m * sqrt(q) / (d.radius + gap);
      beta1 = -side * k / sqrt(q);
      beta2 = side * e * m / (T(2) * cube);
      beta3 = side * gap * k / (T(4) * cube) * (T(1) + T(3) * m * m / q);
    }
  };

  // The rod in line with the crank: sin φ = e/(l + r), and sin(φ − π) = e/(l − r).
  double extended_angle() const { return std::asin(d_.offset / (d_.rod_length + d_.radius)); }
  // Of one that passes its change points: the other end of the stroke, where the rod is extended towards −x.
  double folded_angle() const {
    const double pi = std::acos(-1.0);
    if (!changes_) return pi + std::asin(d_.offset / (d_.rod_length - d_.radius));
    const bool next_turn = d_.offset != 0 && (d_.offset > 0) != d_.folds;
    return pi - extended_angle() + (next_turn ? 2 * pi : 0);
  }
  double x_max() const { return d_.stands_still() ? 0 : leg(d_.rod_length + d_.radius); }
  double x_min() const { return changes_ ? -x_max() : leg(d_.rod_length - d_.radius); }

  // Slider position x [m], velocity ratio x′ = v/ω [m/rad], acceleration ratio x″ = (a − x′ε)/ω² [m/rad²].
  template <class T>
  ValueSlopeCurvature<T> slider(T phi) const {
    const Pose<T> p(d_, changes_, phi);
    return {p.x, p.x1, p.x2};
  }

  // Rod angle β [rad] and its ratios β′ = ω_rod/ω, β″.
  template <class T>
  ValueSlopeCurvature<T> rod(T phi) const {
    using std::atan2;
    const Pose<T> p(d_, changes_, phi);
    return {atan2(p.sin_beta, p.cos_beta), p.beta1, p.beta2};
  }

  // Reduced inertia I_r [kg·m²] (theory 2.1) with I_r′ and I_r″.
  template <class T>
  ValueSlopeCurvature<T> inertia(T phi) const {
    const Pose<T> p(d_, changes_, phi);
    const T r = d_.radius, c = d_.rod_com;
    // The rod's centre of mass: v_C²/ω² = r² + c² β′² + 2 r c f with f = β′ cos(φ − β).
    const T turn = T(1) - p.beta1;  // (φ − β)′
    const T cosine = p.cos_phi * p.cos_beta + p.sin_phi * p.sin_beta;
    const T sine = p.sin_phi * p.cos_beta - p.cos_phi * p.sin_beta;
    const T cosine1 = -sine * turn, cosine2 = -cosine * turn * turn + sine * p.beta2;
    const T f = p.beta1 * cosine, f1 = p.beta2 * cosine + p.beta1 * cosine1;
    const T f2 = p.beta3 * cosine + T(2) * p.beta2 * cosine1 + p.beta1 * cosine2;
    // Squares: (β′²)′ = 2 β′β″, (β′²)″ = 2 (β″² + β′β‴), and the same for x.
    const T m = d_.rod_mass, swing = d_.rod_mass * d_.rod_com * d_.rod_com + d_.rod_inertia, slide = d_.slider_mass;
    return {T(d_.crank_inertia) + m * r * (r + T(2) * c * f) + swing * p.beta1 * p.beta1 + slide * p.x1 * p.x1,
            T(2) * (m * r * c * f1 + swing * p.beta1 * p.beta2 + slide * p.x1 * p.x2),
            T(2) * (m * r * c * f2 + swing * (p.beta2 * p.beta2 + p.beta1 * p.beta3) +
                    slide * (p.x2 * p.x2 + p.x1 * p.x3))};
  }

  // Torque of all weights on the crank [N·m] (theory 2.2), positive when it drives: M_g = −V′, with its slope.
  template <class T>
  ValueAndSlope<T> gravity_torque(T phi) const {
    using std::cos;
    using std::sin;
    const Pose<T> p(d_, changes_, phi);
    // Static moments about O of all that turns with the crank and of the rod about A.
    const T crank = T(d_.crank_mass) * d_.crank_com + T(d_.rod_mass) * d_.radius, rod = T(d_.rod_mass) * d_.rod_com;
    const T x1 = -crank * p.sin_phi - rod * p.sin_beta * p.beta1 + d_.slider_mass * p.x1;
    const T y1 = crank * p.cos_phi + rod * p.cos_beta * p.beta1;
    const T beta1_squared = p.beta1 * p.beta1;
    const T x2 = -crank * p.cos_phi - rod * (p.cos_beta * beta1_squared + p.sin_beta * p.beta2) + d_.slider_mass * p.x2;
    const T y2 = -crank * p.sin_phi + rod * (p.cos_beta * p.beta2 - p.sin_beta * beta1_squared);
    const T up_x = sin(T(d_.stroke_angle)), up_y = cos(T(d_.stroke_angle)), g = d_.gravity;
    return {-g * (up_x * x1 + up_y * y1), -g * (up_x * x2 + up_y * y2)};
  }

  // Potential energy V of all weights [J], zero at the height of the crank's axis.
  template <class T>
  T potential_energy(T phi) const {
    using std::cos;
    using std::sin;
    const Pose<T> p(d_, changes_, phi);
    const T crank = T(d_.crank_mass) * d_.crank_com + T(d_.rod_mass) * d_.radius, rod = T(d_.rod_mass) * d_.rod_com;
    const T x = crank * p.cos_phi + rod * p.cos_beta + d_.slider_mass * p.x;
    const T y = crank * p.sin_phi + rod * p.sin_beta + T(d_.slider_mass) * d_.offset;
    return d_.gravity * (sin(T(d_.stroke_angle)) * x + cos(T(d_.stroke_angle)) * y);
  }

 private:
  // √(hypotenuse² − e²) without cancellation.
  double leg(double hypotenuse) const { return std::sqrt((hypotenuse - d_.offset) * (hypotenuse + d_.offset)); }

  SliderCrankData d_;
  bool changes_;
};

}  // namespace kurbel
