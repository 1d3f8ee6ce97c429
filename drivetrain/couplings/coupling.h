// coupling.h — elastic coupling or shaft: torsional spring and viscous damper in parallel.
//     τ = k θ + c θ̇                                                                    (theory 5.1)
// Positive τ drives b and brakes a.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/elements/element.h"

namespace kurbel {

// Damping in the customary measures. All except `viscous` are converted to c at a reference frequency, by default the
// natural frequency of the two inertias on the element, ω_ref = √(k/J_red), 1/J_red = 1/J_a + i²/J_b:
//   damping ratio ζ:         c = 2 ζ k/ω_ref
//   relative damping ψ:      c = ψ k/(2π ω_ref)      (energy lost per cycle over the maximum stored energy)
//   loss factor η:           c = η k/ω_ref
struct Damping {
  enum class As { viscous, ratio, relative, loss_factor };
  As as = As::viscous;
  double value = 0;      // c [N·m·s/rad] or ζ, ψ, η [1]; ≥ 0
  double frequency = 0;  // ω_ref [rad/s]; 0: the natural frequency above
  bool hangs_on_inertia() const { return as != As::viscous && value > 0 && frequency == 0; }
};

struct Coupling {
  static constexpr ConnectionTraits is{};
  double stiffness = 0;  // k [N·m/rad], > 0
  double damping = 0;    // c [N·m·s/rad], ≥ 0

  template <class T>
  T torque(const Twist<T>& x) const {
    return stiffness * x.angle + damping * x.rate;
  }
  double spring_torque(double twist) const { return stiffness * twist; }
  double twist_at(double torque) const { return torque / stiffness; }
  double energy(double twist) const { return 0.5 * stiffness * twist * twist; }
  double stiffness_at_rest() const { return stiffness; }
};

// A coupling by its data sheet; settled() gives the viscous damping once the inertias on both sides are known.
struct CouplingData {
  using Element = Coupling;
  double stiffness = 0;  // k [N·m/rad], > 0
  Damping damping;

  bool damping_hangs_on_inertia() const { return damping.hangs_on_inertia(); }
  // inertia: J_red [kg·m²]; 0: unknown (both ends held); the damping then needs c or a given frequency.
  Coupling settled(double inertia) const {
    if (damping.as == Damping::As::viscous) return {stiffness, damping.value};
    const double natural = inertia > 0 ? std::sqrt(stiffness / inertia) : HUGE_VAL;
    const double per_unit = stiffness / (damping.frequency > 0 ? damping.frequency : natural);
    switch (damping.as) {
      case Damping::As::ratio:
        return {stiffness, 2 * damping.value * per_unit};
      case Damping::As::relative:
        return {stiffness, damping.value * per_unit / (2 * std::numbers::pi)};
      case Damping::As::loss_factor:
        return {stiffness, damping.value * per_unit};
      case Damping::As::viscous:
        break;
    }
    return {stiffness, 0};
  }
};

}  // namespace kurbel
