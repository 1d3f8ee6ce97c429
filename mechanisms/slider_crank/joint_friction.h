// joint_friction.h — friction in the slider-crank's joints as a torque on its crank: two unknowns, smooth under signs.
//
// Friction acts back on the reactions through the slider pin's force b alone, that of the rod on the slider: its torques
// turn the rod against the guide, its drag D pushes the slider along x.
//     b_x = b_x0 − D,   b_y = b_y0 − D tan β + (Q₁ − Q₂)/(l cos β)                  ₀: without friction (theory 9.6)
//     Q₀ = −sgn(ω) ρ₀|b − F_rod − F_crank|,   Q₁ = −sgn(β̇ − ω) ρ₁|b − F_rod|,   Q₂ = sgn(β̇) ρ₂|b|
//     D = −sgn(v) f (|u| + |w|)/2L,   u, w = L N ∓ 2 M: what the guide's two edges bear
//     D = −sgn(v) f |N|               for L = 0: u = N, and no second edge
// F: inertia forces and weights of a link. The torque on the crank, from the balance of powers:
//     M_f = −Q₀ + (1 − β′) Q₁ + β′ Q₂ − x′ D
// β′ < 1, so that the crank pin turns one way; the kinks lie at β′ = 0, x′ = 0, u = 0, w = 0. With their signs given the
// law is smooth, and goes on smoothly beyond. Its derivatives come from the implicit function theorem.
//
// Internal to slider_crank_*.cpp.
#pragma once

#include <optional>

#include "mechanisms/slider_crank/slider_crank_forces.h"

namespace kurbel {

template <class T>
struct PlaneVector {
  T x{}, y{};
  template <class U>
  friend auto operator+(const PlaneVector& a, const PlaneVector<U>& b) {
    return PlaneVector<decltype(a.x + b.x)>{a.x + b.x, a.y + b.y};
  }
  friend PlaneVector operator-(const PlaneVector& a, const PlaneVector& b) { return {a.x - b.x, a.y - b.y}; }
  friend PlaneVector operator*(double s, const PlaneVector& a) { return {s * a.x, s * a.y}; }
};

// One state without friction, as far as friction asks: forces at ε = 0, and per unit of ε [N], [N s²].
template <class T>
struct FrictionFrame {
  T beta1, x1, lever, tan_beta;             // β′, x′ [m/rad], l cos β [m]
  PlaneVector<T> pin[2], rod[2], crank[2];  // b₀, F_rod, F_crank
  double across = 0;                        // the slider's weight along y [N]
  T moment;                                 // of weight and slider force about its pin [N·m]
  T circle[3], guide;                       // signed as Q₀, Q₁, Q₂, D are [m], [1]
};

// Solved at one ε: b, and what hangs on it.
struct FrictionBalance {
  double alpha = 0;
  PlaneVector<double> pin, pin_by_alpha;      // b [N], db/dε
  SliderCrankStatics::FrictionTorque torque;  // M_f, dM_f/dε
  double inverse[2][2] = {{1, 0}, {0, 1}};    // of the derivative of the two equations by b
};

}  // namespace kurbel
