// gear_mesh.h — elastic gear mesh whose stiffness varies with the number of tooth pairs in contact.
//
//     θ = φ_a − i φ_b, i = z₂/z₁, referred to wheel 1 (a);  f(φ_a) = 1 + Σ a_n cos(n z₁ φ_a + ψ_n) > 0
//     τ = f τ₀(θ, θ̇),  E = f E₀(θ),  and on a in addition to −τ:  −∂E/∂φ_a = −f′ E₀
// τ₀, E₀ belong to the mean mesh: spring and damper, or flanks with a gap (backlash.h). Damping varies in proportion to
// stiffness. From the line of action: k = k_m r_b1², k_m the mean stiffness along it [N/m]; b = j_bn/r_b1.
// Source: Blankenship, Singh: J. Sound Vib. 149 (1992), 475–498 (parametric stiffness); ISO 6336-1 for k_m.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "drivetrain/couplings/backlash.h"
#include "drivetrain/couplings/coupling.h"

namespace kurbel {

// f(φ) of a wheel with z teeth.
struct MeshVariation {
  struct Harmonic {
    double amplitude = 0, phase = 0;  // a_n [1], ψ_n [rad]
  };
  int teeth = 1;
  std::vector<Harmonic> harmonic;  // of order n = 1, 2 …; Σ |a_n| < 1

  template <class T>
  T factor(const T& angle) const {
    using std::cos;
    T sum = T(1.0);
    for (std::size_t n = 0; n < harmonic.size(); ++n)
      sum = sum + harmonic[n].amplitude * cos(order(n) * angle + harmonic[n].phase);
    return sum;
  }
  template <class T>
  T slope(const T& angle) const {
    using std::sin;
    T sum = T(0.0);
    for (std::size_t n = 0; n < harmonic.size(); ++n)
      sum = sum - order(n) * harmonic[n].amplitude * sin(order(n) * angle + harmonic[n].phase);
    return sum;
  }

 private:
  double order(std::size_t n) const { return static_cast<double>(n + 1) * teeth; }
};

// Energy of the mean mesh, for dual numbers too.
template <class T>
T mean_energy(const Coupling& contact, const T& twist) {
  return 0.5 * contact.stiffness * twist * twist;
}
template <class T>
T mean_energy(const Backlash& contact, const T& twist) {
  return contact.energy(twist);
}

// Contact is Coupling, or Backlash with its modes.
template <class Contact>
struct VaryingMesh : Contact {
  static constexpr ConnectionTraits is = [] {
    ConnectionTraits varying = Contact::is;
    varying.uses_angle = varying.spring_takes_motion = varying.described = true;
    return varying;
  }();
  MeshVariation variation;

  template <class T>
  T torque(const Twist<T>& x) const {
    return variation.factor(x.turn) * Contact::torque(x);
  }
  template <class T>
  T turning_torque(const Twist<T>& x) const {
    return -(variation.slope(x.turn) * mean_energy(static_cast<const Contact&>(*this), x.angle));
  }
  double spring_torque(const Twist<double>& x) const {
    return variation.factor(x.turn) * Contact::spring_torque(x.angle);
  }
  using Contact::twist_at;  // of the mean mesh
  double twist_at(double torque, double turn) const { return Contact::twist_at(torque / variation.factor(turn)); }
  double energy(const Twist<double>& x) const { return variation.factor(x.turn) * Contact::energy(x.angle); }
  std::string describe() const;
};

// Data of the contact in the scene (CouplingData or BacklashData), and the variation of its stiffness.
template <class Data>
struct MeshData {
  using Element = VaryingMesh<typename Data::Element>;
  static constexpr bool other_forms = true;
  Data contact;
  MeshVariation variation;

  bool damping_hangs_on_inertia() const { return contact.damping_hangs_on_inertia(); }
  Element settled(double inertia) const { return {contact.settled(inertia), variation}; }
};
template <class Data>
ConnectionForm under(const MeshData<Data>& given, const Effects& effects);

}  // namespace kurbel
