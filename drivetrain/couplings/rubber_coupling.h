// rubber_coupling.h — rubber coupling: spring and damper (Kelvin–Voigt) in parallel with Maxwell branches, which relax.
//     τ = k θ + c θ̇ + Σ k_j (θ − z_j),   ż_j = (θ − z_j)/T_j                               (generalised Maxwell model)
//     under θ e^{iωt}:  k*(ω) = k + i ω c + Σ k_j i ω T_j/(1 + i ω T_j)
// k is the static stiffness, k + Σ k_j the stiffness in fast motion; z_j is the creep of branch j [rad]. Loss factor of
// the material: Im k*/Re k*. Source: Christensen, Theory of Viscoelasticity, 2nd ed. 1982, ch. 1. The branches are
// relaxed at the start.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "drivetrain/couplings/coupling.h"
#include "engine/elements/element.h"

namespace kurbel {

struct MaxwellBranch {
  double stiffness = 0;        // k_j [N·m/rad], > 0
  double relaxation_time = 1;  // T_j [s], > 0
};

template <int branches>
struct RubberCoupling {
  static constexpr ConnectionTraits is{.spring_takes_motion = true, .reports_loss = true, .states = branches};
  double stiffness = 0;  // k [N·m/rad], > 0
  double damping = 0;    // c [N·m·s/rad], ≥ 0
  std::array<MaxwellBranch, branches> branch{};

  template <class T>
  T torque(const Twist<T>& x) const {
    T tau = stiffness * x.angle + damping * x.rate;
    for (std::size_t j = 0; j < branches; ++j) tau = tau + branch[j].stiffness * (x.angle - x.own[j]);
    return tau;
  }
  template <class T>
  void rates(const Twist<T>& x, T* rate) const {
    for (std::size_t j = 0; j < branches; ++j) rate[j] = (x.angle - x.own[j]) / branch[j].relaxation_time;
  }
  double spring_torque(const Twist<double>& x) const {
    double tau = stiffness * x.angle;
    for (std::size_t j = 0; j < branches; ++j) tau += branch[j].stiffness * (x.angle - x.own[j]);
    return tau;
  }
  double energy(const Twist<double>& x) const {
    double sum = 0.5 * stiffness * x.angle * x.angle;
    for (std::size_t j = 0; j < branches; ++j) sum += 0.5 * branch[j].stiffness * std::pow(x.angle - x.own[j], 2);
    return sum;
  }
  double loss_power(const Twist<double>& x) const {
    double power = damping * x.rate * x.rate;
    for (std::size_t j = 0; j < branches; ++j)
      power += branch[j].stiffness * std::pow(x.angle - x.own[j], 2) / branch[j].relaxation_time;
    return power;
  }
  void first_states(const Twist<double>& x, double* own) const {
    for (std::size_t j = 0; j < branches; ++j) own[j] = x.angle;
  }
  InternalState state(int k) const { return {branches == 1 ? "creep" : "creep" + std::to_string(k + 1), "rad", 0}; }
  double twist_at(double torque) const { return torque / stiffness; }
  double stiffness_at_rest() const { return stiffness; }
};

// The form without relaxation: the static spring, and a damper with the same loss at ω_ref as the branches,
// c + Σ k_j T_j/(1 + ω_ref² T_j²); ω_ref = √(k/J_red) unless damping_frequency is given.
struct StaticRubberData {
  using Element = Coupling;
  CouplingData spring;
  std::vector<MaxwellBranch> branch;

  bool damping_hangs_on_inertia() const { return spring.damping_hangs_on_inertia(); }
  Coupling settled(double inertia) const {
    Coupling element = spring.settled(inertia);
    const double given = spring.damping.frequency;
    const double omega = given > 0 ? given : inertia > 0 ? std::sqrt(element.stiffness / inertia) : 0;
    for (const MaxwellBranch& b : branch)
      element.damping += b.stiffness * b.relaxation_time / (1 + std::pow(omega * b.relaxation_time, 2));
    return element;
  }
};

// Data of the scene. Without the effect "relaxation" the coupling has its static form.
template <int branches>
struct RubberCouplingData {
  using Element = RubberCoupling<branches>;
  static constexpr bool other_forms = true;
  CouplingData spring;
  std::array<MaxwellBranch, branches> branch{};

  bool damping_hangs_on_inertia() const { return spring.damping_hangs_on_inertia(); }
  RubberCoupling<branches> settled(double inertia) const {
    const Coupling plain = spring.settled(inertia);
    return {plain.stiffness, plain.damping, branch};
  }
};
ConnectionForm rubber_under(const StaticRubberData& without_relaxation, const Effects& effects);
template <int branches>
ConnectionForm under(const RubberCouplingData<branches>& given, const Effects& effects) {
  return rubber_under({given.spring, {given.branch.begin(), given.branch.end()}}, effects);
}

}  // namespace kurbel
