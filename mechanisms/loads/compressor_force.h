// compressor_force.h — gas force of a reciprocating compressor from pressures, clearance volume and polytropic
// exponents.
//
//   p |  4____3        d   distance of the piston from the working end, s the stroke, c s the clearance
//     |  |     \       1–2  compression    p = p₁ ((s + c s)/(d + c s))^n      until the delivery valve opens at p₂
//     |  |      '.     2–3  delivery       p = p₂
//     |  \  .     '.   3–4  re-expansion   p = p₂ (c s/(d + c s))^m            until the suction valve opens at p₁
//     |   '.________1  4–1  suction        p = p₁
//     +------------------ d
//   F = (p − p_out) A on the piston, away from the working end
// Valves open at d₂ = (s + c s) (p₁/p₂)^(1/n) − c s and d₄ = c s ((p₂/p₁)^(1/m) − 1): these are events. The part of the
// stroke with suction is the volumetric efficiency λ = 1 − c ((p₂/p₁)^(1/m) − 1).
// Source: e.g. R. K. Rajput, Thermal Engineering, ch. "Air compressors" (clearance volume, volumetric efficiency).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/elements/element.h"
#include "engine/numerics/dual.h"
#include "mechanisms/loads/load_traits.h"
#include "mechanisms/loads/slider_state.h"

namespace kurbel {

struct CompressorForce {
  static constexpr LoadTraits is{.holds = true, .in_pieces = true, .turns_back = true};
  WorkingEnd end;
  double stroke = 0;                 // s [m], > 0
  double area = 0;                   // A [m²], > 0
  double suction = 0, delivery = 0;  // p₁ < p₂ [Pa], absolute, > 0
  double outside = 0;                // p_out on the other face of the piston [Pa]
  double clearance = 0;              // c, clearance volume over swept volume, > 0
  double compression_exponent = 0;   // n, > 0
  double expansion_exponent = 0;     // m, > 0

  double delivery_opens_at() const {  // d₂ [m]; ≤ 0: never
    return stroke * ((1 + clearance) * std::pow(suction / delivery, 1 / compression_exponent) - clearance);
  }
  double suction_opens_at() const { return stroke * (1 - volumetric_efficiency()); }  // d₄ [m]
  double volumetric_efficiency() const {
    return 1 - clearance * (std::pow(delivery / suction, 1 / expansion_exponent) - 1);
  }

  // Mode in both strokes: 0 between the working end and the opening of the valve, 1 beyond.
  template <class T>
  T pressure(bool approach, int mode, const T& distance) const {
    const double dead = clearance * stroke;
    if (approach)
      return mode == 0 ? T(delivery) : suction * power((stroke + dead) / (distance + dead), compression_exponent);
    return mode == 1 ? T(suction) : delivery * power(dead / (distance + dead), expansion_exponent);
  }
  template <class T>
  T value(const SliderState<T>& s) const {
    const T gas = pressure(end.approached(s.travel), s.mode, end.distance(s.x));
    return -static_cast<double>(end.side) * area * (gas - outside);
  }
  bool uses_speed() const { return false; }
  // At standstill the valves are closed between the pressures of both strokes: static forces up to the difference.
  Hold hold(const SliderState<double>& s) const {
    const double d = end.distance(s.x);
    return end.hold_beyond(area * (pressure(true, d < delivery_opens_at() ? 0 : 1, d) -
                                   pressure(false, d < suction_opens_at() ? 0 : 1, d)));
  }
  void guard(const SliderState<double>& s, double* g) const {
    const double beyond = (end.distance(s.x) - opens_at(s.travel)) / stroke;
    g[0] = s.mode == 0 ? 1 : beyond;
    g[1] = s.mode == 0 ? -beyond : 1;
  }
  int first_mode(const SliderState<double>& s) const { return end.distance(s.x) < opens_at(s.travel) ? 0 : 1; }
  // After the direction of travel has changed.
  int turned_mode(const SliderState<double>& s) const {
    return std::abs(end.distance(s.x) - opens_at(s.travel)) <= 1e-12 * stroke ? s.mode : first_mode(s);
  }
  int next_mode(const SliderState<double>&, int which) const { return which; }
  std::string mode_name(const SliderState<double>& s) const {
    return s.mode == 0 ? "delivery valve opens" : "suction valve opens";
  }
  double greatest() const { return area * std::max(std::abs(delivery - outside), std::abs(suction - outside)); }

 private:
  double opens_at(int travel) const { return end.approached(travel) ? delivery_opens_at() : suction_opens_at(); }
  static double power(double base, double exponent) { return std::pow(base, exponent); }
  template <int N>
  static Dual<N> power(const Dual<N>& base, double exponent) {
    const double value = std::pow(base.value, exponent);
    return base.chain(value, exponent * value / base.value);
  }
};

}  // namespace kurbel
