// lobatto_element.h — a prismatic shaft as one spectral element: inertias at Gauss–Lobatto points, so that the mass
// matrix is diagonal, and its exact dynamic stiffness, which gives the error of the element (theory 5.22).
#pragma once

#include <vector>

namespace kurbel {

// Degree p: p + 1 points, p twists between neighbours θ_k = φ_{k−1} − φ_k. For a shaft with total k and J the torques
// between neighbours are τ = k S θ, the inertias J w.
struct LobattoElement {
  int degree = 1;
  std::vector<double> place;       // of the points, from 0 to 1
  std::vector<double> weight;      // w, Σ w = 1
  std::vector<double> stiffness;   // S, p × p by rows, symmetric
  std::vector<double> compliance;  // S⁻¹
  // For odd degrees above 1: weights of the torque in the middle, −k dφ/ds of the polynomial through the points, by the
  // torques between neighbours (which only balance the points): middle · τ. It converges like the frequencies.
  std::vector<double> middle;
  double share(int k) const { return place[static_cast<std::size_t>(k + 1)] - place[static_cast<std::size_t>(k)]; }
};

inline constexpr int highest_lobatto_degree = 17;
const LobattoElement& lobatto_element(int degree);  // 1 … highest_lobatto_degree

// Dynamic stiffness of both ends, over k, at x = β L = ω √(J/k): for ends in phase, d₁₁ + d₁₂, and in antiphase,
// d₁₁ − d₁₂.
struct EndStiffness {
  double together = 0, against = 0;
  // uᵀ D u
  double of(double in, double out) const {
    return 0.5 * (together * (in + out) * (in + out) + against * (in - out) * (in - out));
  }
};
EndStiffness exact_stiffness(double x);
EndStiffness element_stiffness(int degree, double x);

// Bound of the relative frequency error at x for any loads on the ends, over both kinds of motion of the ends.
double dispersion(int degree, double x);

// Number of modes below x of the shaft with both ends held: exact, and of the element (Wittrick and Williams).
int held_modes_below(double x);
int held_modes_below(int degree, double x);

}  // namespace kurbel
