// gauss.h — Gauss–Legendre quadrature: nodes and weights of the rule with n nodes.
//
//     ∫f dx ≈ Σ w_i f(x_i),   P_n(x_i) = 0,   w_i = 2/((1 − x_i²) P′_n(x_i)²)      exact up to degree 2n − 1
//
//     gauss<3>.over(begin, length, [&](double x, double weight) { sum += weight * std::exp(x); });
//
// Each number is the double nearest to its exact value.
#pragma once

#include <array>
#include <cstddef>

namespace kurbel {

// On [−1, 1], nodes ascending.
template <std::size_t n>
struct GaussRule {
  std::array<double, n> x{}, w{};

  // From the nodes ≥ 0 and their weights.
  constexpr explicit GaussRule(const double (&half)[(n + 1) / 2][2]) {
    for (std::size_t k = 0; k < (n + 1) / 2; ++k) {
      const std::size_t left = (n - 1) / 2 - k, right = n / 2 + k;
      x[left] = -half[k][0], x[right] = half[k][0];
      w[left] = w[right] = half[k][1];
    }
  }

  // Calls visit(x, weight) for each node in [begin, begin + length]; the weights add up to the length.
  template <class Visit>
  constexpr void over(double begin, double length, Visit&& visit) const {
    const double half = 0.5 * length;
    for (std::size_t i = 0; i < n; ++i) visit(begin + half * (1 + x[i]), half * w[i]);
  }
};

// The rules in use; others do not compile.
template <std::size_t n>
inline constexpr GaussRule<n> gauss;
template <>
inline constexpr GaussRule<2> gauss<2>{{{0.57735026918962576451, 1}}};
template <>
inline constexpr GaussRule<3> gauss<3>{{{0, 0.88888888888888888889}, {0.77459666924148337704, 0.55555555555555555556}}};
template <>
inline constexpr GaussRule<4> gauss<4>{
    {{0.3399810435848562648, 0.65214515486254614263}, {0.86113631159405257522, 0.34785484513745385737}}};
template <>
inline constexpr GaussRule<5> gauss<5>{{{0, 0.56888888888888888889},
                                        {0.53846931010568309104, 0.47862867049936646804},
                                        {0.9061798459386639928, 0.23692688505618908751}}};
template <>
inline constexpr GaussRule<6> gauss<6>{{{0.23861918608319690863, 0.46791393457269104739},
                                        {0.66120938646626451366, 0.36076157304813860757},
                                        {0.93246951420315202781, 0.17132449237917034504}}};
template <>
inline constexpr GaussRule<16> gauss<16>{{{0.095012509837637440185, 0.18945061045506849629},
                                          {0.28160355077925891323, 0.18260341504492358887},
                                          {0.45801677765722738634, 0.16915651939500253819},
                                          {0.61787624440264374845, 0.14959598881657673208},
                                          {0.7554044083550030339, 0.12462897125553387205},
                                          {0.86563120238783174388, 0.09515851168249278481},
                                          {0.94457502307323257608, 0.062253523938647892863},
                                          {0.9894009349916499326, 0.027152459411754094852}}};
template <>
inline constexpr GaussRule<17> gauss<17>{{{0, 0.17944647035620652546},
                                          {0.17848418149584785585, 0.17656270536699264633},
                                          {0.3512317634538763153, 0.16800410215645004451},
                                          {0.51269053708647696789, 0.15404576107681028808},
                                          {0.65767115921669076585, 0.13513636846852547329},
                                          {0.78151400389680140693, 0.11188384719340397109},
                                          {0.88023915372698590212, 0.085036148317179180884},
                                          {0.95067552176876776122, 0.055459529373987201129},
                                          {0.99057547531441733568, 0.02414830286854793196}}};

}  // namespace kurbel
