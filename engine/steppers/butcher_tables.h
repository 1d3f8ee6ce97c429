// butcher_tables.h — coefficients of the explicit embedded Runge–Kutta methods, without zeros.
//
// Source: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993),
// table II.5.2 (Dormand–Prince 5(4)), section II.10 and its program DOP853 (8(5,3)), II.6 (dense output);
// table II.5.4 (J. H. Verner 6(5), SIAM J. Numer. Anal. 15, 1978) and table II.6.4's source E. Fehlberg, NASA TR R-287
// (1968) (8(7)). Verner's later "most efficient" 6(5) pair has weights of ±176 and rows of ±207: their rounding alone
// violates the order conditions by 7e-12, so that it cannot be used for tolerances below 1e-10.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace kurbel {

inline constexpr std::size_t most_stages = 24;

struct Term {
  std::size_t stage;
  double weight;
};
using Combination = std::vector<Term>;  // Σ weight · k[stage], ascending in stage

// Stage i: k[i] = f(t + node[i] h, y + h Σ row[i]).
// The first `stages` of them give the step. Number `stages` is the slope at the end of the step: its row is the
// solution, and it is k[0] of the next step. The following ones are only for the dense output.
struct EmbeddedTable {
  std::string_view name;
  std::size_t order;
  std::size_t stages;
  std::vector<double> node;
  std::vector<Combination> row;

  Combination error;        // estimate e of the local error, divided by h
  Combination rough_error;  // lower-order estimate r that corrects it to e² / √(e² + 0.01 r²); empty: e alone
  // y(t + θh) = y + θ(Δ + (1−θ)(hf₀−Δ + θ(2Δ−h(f₀+f₁) + (1−θ)(d₀ + θ(d₁ + (1−θ)(d₂ + …)))))), d = h Σ dense[·]
  std::vector<Combination> dense;

  double integral_exponent;      // of the step controller: h ∝ error^−integral · previous_error^proportional
  double proportional_exponent;  //
  double smallest_factor;        // limits of the change of a step
  double largest_factor;         //
  double stability_limit;        // of h·ρ along the negative real axis, with ρ estimated from two stages
};

const EmbeddedTable& dormand_prince_54();
const EmbeddedTable& dormand_prince_853();
const EmbeddedTable& verner_65();
// Its error estimate, 41/840 (k₀ + k₁₀ − k₁₁ − k₁₂), has each end of the step once with each sign: it is identically
// zero for rates that depend on time only.
const EmbeddedTable& fehlberg_87();

}  // namespace kurbel
