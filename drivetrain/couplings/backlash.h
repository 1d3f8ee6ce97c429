// backlash.h — elastic contact with a gap b between the flanks; three contact laws, two of them published.
//
//     u = twist;  beyond the gap θ = u − ½ b sgn u, compression p = |θ|, ṗ = sgn(u) u̇     (theory 5.6, 5.7)
//   no pulling    τ = sgn(u) (k p + min(k p, c ṗ)),  0 where k p + c ṗ ≤ 0: the damper torque never exceeds the spring
//                 torque and never pulls the flanks together (Modelica.Mechanics.Rotational.Components.ElastoBacklash)
//   Hunt–Crossley τ = sgn(u) k pⁿ (1 + d ṗ), ≥ 0: damping grows with the compression, so the torque starts from zero
//                 (Hunt, Crossley: J. Appl. Mech. 42 (1975), 440–445)
//   clipped       τ = sgn(u) max(0, k p + c ṗ): jumps by c ṗ where the flanks touch
// Modes: touching below (−1), free (0), touching above (+1). The law and the gap are stated in the report.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "drivetrain/couplings/coupling.h"
#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

enum class ContactLaw { no_pulling, hunt_crossley, clipped };

struct Backlash {
  // The mode: the flank in contact (sign; 0: none) and the branch of the law there.
  enum Mode : int {
    below_cut = -3,
    below_limited = -2,
    below = -1,
    apart = 0,
    above = 1,
    above_limited = 2,
    above_cut = 3,
    regularised = 100  // the law without events
  };
  static constexpr ConnectionTraits is{
      .spring_takes_motion = true, .guards = 2, .regularised_mode = regularised, .described = true};
  ContactLaw law = ContactLaw::no_pulling;
  double stiffness = 0;    // k [N·m/rad^n], > 0
  double damping = 0;      // c [N·m·s/rad]; of Hunt–Crossley d [s/rad]
  double gap = 0;          // b, total [rad], ≥ 0
  double exponent = 1;     // n of Hunt–Crossley
  double twist_scale = 1;  // [rad], of the order of the compression in operation

  template <class T>
  T torque(const Twist<T>& x) const {
    int mode = x.mode;
    if (mode == regularised) mode = first_mode({value_of(x.angle), value_of(x.rate)});
    if (mode == apart || mode == above_cut || mode == below_cut) return T(0.0);
    const double side = mode > 0 ? 1 : -1;
    const T p = side * x.angle - 0.5 * gap, rate = side * x.rate;
    switch (law) {
      case ContactLaw::no_pulling:
        return side * (std::abs(mode) == 2 ? 2.0 * stiffness * p : stiffness * p + damping * rate);
      case ContactLaw::hunt_crossley:
        return side * power(p) * (1.0 + damping * rate);
      case ContactLaw::clipped:
        break;
    }
    return side * (stiffness * p + damping * rate);
  }

  double spring_torque(double twist) const {
    const double p = std::abs(twist) - 0.5 * gap;
    return p <= 0 ? 0 : std::copysign(power(p), twist);
  }
  // Zero while the flanks are apart, even if an integration stage overshoots the flank.
  double spring_torque(const Twist<double>& x) const { return x.mode == apart ? 0 : spring_torque(x.angle); }
  template <class T>
  T energy(const T& twist) const {
    const T p = (value_of(twist) < 0 ? -1.0 : 1.0) * twist - 0.5 * gap;
    if (value_of(p) <= 0) return T(0.0);
    using std::pow;
    return stiffness * pow(p, exponent + 1) / (exponent + 1);
  }
  double energy(const Twist<double>& x) const { return energy(x.angle); }
  double twist_at(double torque) const {
    if (torque == 0) return 0;
    return std::copysign(0.5 * gap + std::pow(std::abs(torque) / stiffness, 1 / exponent), torque);
  }
  double stiffness_at_rest() const {
    return exponent == 1 ? stiffness : exponent * stiffness * std::pow(twist_scale, exponent - 1);
  }

  // --- modes ---
  int first_mode(const Twist<double>& x) const {
    const int side = x.angle > 0.5 * gap ? 1 : x.angle < -0.5 * gap ? -1 : 0;
    return side == 0 ? apart : within(side, side * x.angle - 0.5 * gap, side * x.rate);
  }
  // Zeros where the law changes: at the ends of the gap, and in contact where the damper torque reaches the spring torque.
  void guard(const Twist<double>& x, double* g) const {
    if (x.mode == apart) {
      g[0] = (0.5 * gap - x.angle) / twist_scale;
      g[1] = (0.5 * gap + x.angle) / twist_scale;
      return;
    }
    const double side = x.mode > 0 ? 1 : -1, p = side * x.angle - 0.5 * gap, rate = side * x.rate;
    const double torque_scale = stiffness * twist_scale;
    if (law == ContactLaw::hunt_crossley) {
      g[0] = p / twist_scale;
      g[1] = std::abs(x.mode) == 3 ? -(1 + damping * rate) : 1 + damping * rate;
      return;
    }
    const double spring = stiffness * p, damper = damping * rate;
    switch (std::abs(x.mode)) {
      case 1:  // k p + c ṗ ≥ 0 and, without pulling, c ṗ ≤ k p
        g[0] = (spring + damper) / torque_scale;
        g[1] = law == ContactLaw::no_pulling && damping > 0 ? (spring - damper) / torque_scale : 1;
        break;
      case 2:  // the damper torque is limited to the spring torque
        g[0] = p / twist_scale;
        g[1] = (damper - spring) / torque_scale;
        break;
      default:  // the flanks separate faster than the spring recovers
        g[0] = p / twist_scale;
        g[1] = -(spring + damper) / torque_scale;
    }
  }
  int next_mode(const Twist<double>& x, int which) const {
    const int side = x.mode > 0 ? 1 : x.mode < 0 ? -1 : which == 0 ? 1 : -1;
    if (x.mode == apart) {
      const double rate = side * x.rate;
      if (law == ContactLaw::no_pulling && rate > 0 && damping > 0) return 2 * side;
      return side;
    }
    switch (std::abs(x.mode)) {
      case 1:
        if (law == ContactLaw::hunt_crossley) return which == 0 ? static_cast<int>(apart) : 3 * side;
        if (which != 0) return 2 * side;
        return damping > 0 ? 3 * side : static_cast<int>(apart);  // without damping the torque ends with the contact
      case 2:
        return which == 0 ? static_cast<int>(apart) : side;
      default:
        return which == 0 ? static_cast<int>(apart) : side;
    }
  }
  std::string mode_name(int mode) const {
    if (mode == regularised) return "contact without events";
    if (mode == apart) return "flanks apart";
    const char* flank = mode > 0 ? "driving flank" : "rear flank";
    return std::abs(mode) == 3 ? std::string(flank) + ", parting" : std::string("on the ") + flank;
  }
  std::string describe() const;

 private:
  template <class T>
  T power(const T& p) const {
    if (exponent == 1) return stiffness * p;
    if (value_of(p) <= 0) return T(0.0);
    using std::pow;
    return stiffness * pow(p, exponent);
  }
  int within(int side, double p, double rate) const {
    if (law == ContactLaw::hunt_crossley) return 1 + damping * rate < 0 ? 3 * side : side;
    const double spring = stiffness * p, damper = damping * rate;
    if (spring + damper < 0) return 3 * side;
    return law == ContactLaw::no_pulling && damper > spring ? 2 * side : side;
  }
};

// Data of the scene. Without the effect "backlash" the flanks always touch.
struct BacklashData {
  using Element = Backlash;
  static constexpr bool other_forms = true;
  Backlash contact;
  Damping given;  // in any of its forms; unused by Hunt–Crossley

  bool damping_hangs_on_inertia() const { return contact.law != ContactLaw::hunt_crossley && given.hangs_on_inertia(); }
  Backlash settled(double inertia) const;
  CouplingData without_gap() const;
};
ConnectionForm under(const BacklashData& given, const Effects& effects);

}  // namespace kurbel
