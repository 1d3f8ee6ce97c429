// belt.h — belt drive that can slip: an elastic belt in series with the friction on the pulley with the smaller wrap.
//
//     r₁ φ_a ≈ r₂ φ_b:  i = d₂/d₁,   θ = φ_a − i φ_b,  all referred to pulley 1 (a)
//     grips:  τ = k (θ − s) + c θ̇,  ṡ = 0,  |τ| ≤ M
//     slips:  τ = ± M,              c (θ̇ − ṡ) = ± M − k (θ − s); without damping ṡ = θ̇
// s is the angle slipped [rad]. Two strands of length L, stiffness of the belt EA: k = 2 EA r₁²/L.
// Capacity by Euler and Eytelwein, T₁/T₂ = e^{μα} at the limit, with T₁ + T₂ = 2 F₀ (fixed centres):
//     F_u = T₁ − T₂ = 2 F₀ tanh(μα/2),   M = r₁ F_u;   V-belt in a groove of angle γ: μ counts as μ/sin(γ/2)
// (Decker, Maschinenelemente, ch. "Riementriebe"; Firbank, Int. J. Mech. Sci. 12 (1970) 1053, for the elastic creep
// F_u/EA, which is stated but neglected in the motion.) Centrifugal tension is neglected: F₀ is the value at speed.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "drivetrain/couplings/coupling.h"
#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Maximum difference of the tensions of the strands [N].
inline double eytelwein_force(double pretension, double friction, double wrap) {
  return 2 * pretension * std::tanh(0.5 * friction * wrap);
}
// Wrap of the smaller pulley of an open belt drive [rad]; centre distance > (d₂ − d₁)/2.
inline double open_belt_wrap(double diameter_1, double diameter_2, double centre_distance) {
  return std::numbers::pi - 2 * std::asin(std::abs(diameter_2 - diameter_1) / (2 * centre_distance));
}

struct Belt {
  enum Mode : int { slips_back = -1, grips = 0, slips_ahead = 1 };
  static constexpr ConnectionTraits is{.spring_takes_motion = true,
                                       .reports_loss = true,
                                       .guards = 2,
                                       .contact_modes = true,
                                       .states = 1,
                                       .described = true};
  double stiffness = 0;    // k [N·m/rad], > 0
  double damping = 0;      // c [N·m·s/rad], ≥ 0
  double limit = 0;        // M [N·m], > 0
  double speed_scale = 1;  // of slip [rad/s]
  std::string words = {};

  template <class T>
  T torque(const Twist<T>& x) const {
    if (x.mode != grips) return T(limit * x.mode);
    return stiffness * (x.angle - x.own[0]) + damping * x.rate;
  }
  template <class T>
  void rates(const Twist<T>& x, T* rate) const {
    rate[0] = x.mode == grips ? T(0.0) : slip(x, x.mode);
  }
  double spring_torque(const Twist<double>& x) const { return stiffness * (x.angle - x.own[0]); }
  double energy(const Twist<double>& x) const { return 0.5 * stiffness * std::pow(x.angle - x.own[0], 2); }
  double loss_power(const Twist<double>& x) const {
    if (x.mode == grips) return damping * x.rate * x.rate;
    const double sliding = slip(x, x.mode), stretching = x.rate - sliding;
    return limit * x.mode * sliding + damping * stretching * stretching;
  }
  void first_states(const Twist<double>& x, double* own) const {
    const double most = limit / stiffness;
    own[0] = std::abs(x.angle) <= most ? 0 : x.angle - std::copysign(most, x.angle);
  }
  InternalState state(int) const { return {"slipped_angle", "rad", limit / stiffness}; }
  double twist_at(double torque) const { return torque / stiffness; }
  double stiffness_at_rest() const { return stiffness; }

  int first_mode(const Twist<double>& x) const {
    const double wanted = stiffness * (x.angle - x.own[0]) + damping * x.rate;
    const bool rising = damping > 0 ? std::abs(wanted) > limit : wanted * x.rate > 0 && std::abs(wanted) >= limit;
    return !rising ? grips : wanted > 0 ? slips_ahead : slips_back;
  }
  void guard(const Twist<double>& x, double* g) const {
    if (x.mode == grips) {
      const double wanted = stiffness * (x.angle - x.own[0]) + damping * x.rate;
      g[0] = (limit - wanted) / limit;
      g[1] = (limit + wanted) / limit;
    } else {
      g[0] = x.mode * slip(x, x.mode) / speed_scale;
      g[1] = 1;
    }
  }
  int next_mode(const Twist<double>& x, int which) const {
    return x.mode != grips ? grips : which == 0 ? slips_ahead : slips_back;
  }
  const std::string& describe() const { return words; }
  std::string mode_name(int mode) const { return mode == grips ? "grips" : mode > 0 ? "slips" : "slips backwards"; }

 private:
  template <class T>
  T slip(const Twist<T>& x, int side) const {
    if (damping == 0) return x.rate;
    return x.rate - (limit * side - stiffness * (x.angle - x.own[0])) / damping;
  }
};

// The inextensible belt: grips up to the limit, then slips.
struct RigidBelt {
  static constexpr ConnectionTraits is{.slips = true, .described = true};
  double limit = 0;  // M [N·m], > 0
  std::string words = {};

  template <class T>
  T torque(const Twist<T>& x) const {
    return T(limit * x.direction);
  }
  Hold hold(const Twist<double>&) const { return {-limit, limit}; }
  double capacity() const { return limit; }
  const std::string& describe() const { return words; }
};

// Data of the scene. The belt is rigid where its elasticity is off.
struct BeltData {
  using Element = Belt;
  static constexpr bool other_forms = true;
  std::string name;                 // of the component
  double ratio = 1, radius = 1;     // i; r₁ [m]
  double stiffness = 0, limit = 0;  // k [N·m/rad], M [N·m], both > 0
  double axial_stiffness = 0;       // EA [N], 0: unknown
  Damping damping;

  bool damping_hangs_on_inertia() const { return damping.hangs_on_inertia(); }
  Belt settled(double inertia) const {
    const double scale = inertia > 0 ? limit / std::sqrt(stiffness * inertia) : limit / stiffness;
    return {stiffness, CouplingData{stiffness, damping}.settled(inertia).damping, limit, scale, describe()};
  }
  std::string describe() const;
};
ConnectionForm under(const BeltData& given, const Effects& effects);

// Allowable loads of a belt, and the data for its forces (Network::data).
struct BeltRating {
  double pretension = 0, radius = 1;  // F₀ [N]; r₁ of the driving pulley [m]
  double limit = 0;                   // M at which it slips [N·m]
  std::optional<double> tension;      // allowable force in a strand [N]
  std::optional<double> reserve;      // required M/|τ|, ≥ 1

  // Tension of the tight strand [N] at a torque τ on the driving pulley; fixed centres: T₁ + T₂ = 2 F₀, T₁ − T₂ = |τ|/r₁.
  double tight_strand(double torque) const { return pretension + 0.5 * (torque < 0 ? -torque : torque) / radius; }
};

}  // namespace kurbel
