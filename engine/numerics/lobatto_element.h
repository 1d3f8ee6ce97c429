// lobatto_element.h — a prismatic shaft as one spectral element: inertias at Gauss–Lobatto points, so that the mass
// matrix is diagonal, and its exact dynamic stiffness, by which the element's error is known (theory 5.22).
#pragma once

#include <vector>

namespace kurbel {

// Of degree p: p + 1 points, p twists between neighbours θ_k = φ_{k−1} − φ_k. Of a shaft with k and J as a whole the
// torques between neighbours are τ = k S θ, the inertias J w.
struct LobattoElement {
  int degree = 1;
  std::vector<double> place;       // of the points, from 0 to 1
  std::vector<double> weight;      // w, Σ w = 1
  std::vector<double> stiffness;   // S, p × p by rows, symmetric
  std::vector<double> compliance;  // S⁻¹
  // Of an odd degree above 1: the torque in the middle, −k dφ/ds of the polynomial through the points, over the torques
  // between neighbours, which balance points alone: middle · τ. It converges as frequencies do.
  std::vector<double> middle;
  double share(int k) const { return place[static_cast<std::size_t>(k + 1)] - place[static_cast<std::size_t>(k)]; }
};

inline constexpr int highest_lobatto_degree = 17;
const LobattoElement& lobatto_element(int degree);  // 1 … highest_lobatto_degree

// Dynamic stiffness of both ends, over k, at x = β L = ω √(J/k): of ends that swing together, d₁₁ + d₁₂, and against
// each other, d₁₁ − d₁₂.
struct EndStiffness {
  double together = 0, against = 0;
  // uᵀ D u
  double of(double in, double out) const {
    return 0.5 * (together * (in + out) * (in + out) + against * (in - out) * (in - out));
  }
};
EndStiffness exact_stiffness(double x);
EndStiffness element_stiffness(int degree, double x);

// By how much of itself a frequency is off at which the shaft has x, whatever its ends carry: the bound over both kinds
// of motion of its ends.
double dispersion(int degree, double x);

// Modes below x of the shaft with both ends held: exactly, and of the element (what Wittrick and Williams count).
int held_modes_below(double x);
int held_modes_below(int degree, double x);

}  // namespace kurbel
