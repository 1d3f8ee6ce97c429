// nameplate.h — an induction motor's two-axis circuit, estimated from its nameplate and catalogue.
//
//     P_1 = √3 U I_n cos φ = P_n/η                        input power
//     R_s = κ (P_1 − M_n ω_s)/(3 I_n²)                    κ: stator copper loss over all losses except the rotor's
//     M(s_n) = M_n,  max M = M_b,  |I(s_n)| = I_n         → R_r, X_s = X_r = X, X_m
//
// with M by Thévenin's equivalent of the stator (induction_circuit.h) and the line's current
//
//     I = U/√3/|Z|,   Z = R_s + jX + jX_m ∥ (R_r/s + jX)
//
// It is an estimate: iron, windage, bearing and stray losses are neglected, the leakage is shared equally, and deep bars
// are neglected, so that torque and current at standstill are those of the rotor resistance at rated speed. It is meant
// for speeds near the rated one and oscillations about them.
#pragma once

#include <string>

#include "drivetrain/induction/induction_circuit.h"

namespace kurbel {

struct Nameplate {
  double rated_power = 0, rated_speed = 0;  // P_n [W], ω_n [rad/s]
  double voltage = 0, frequency = 0;        // U, line to line [V]; f [Hz]
  int pole_pairs = 1;                       // p
  double current = 0;                       // I_n, of a line [A]
  double input_power = 0;                   // P_1 [W]
  double breakdown_torque = 0;              // M_b [N·m]
  double stator_share = 0.5;                // κ, 0 … 1

  double synchronous_speed() const;                                  // [rad/s]
  double rated_torque() const { return rated_power / rated_speed; }  // M_n [N·m]
  double rated_slip() const { return 1 - rated_speed / synchronous_speed(); }
};

// The circuit, or the reason why there is none.
struct NameplateCircuit {
  EquivalentCircuit circuit;
  std::string fault;  // empty: the circuit is valid
};
NameplateCircuit circuit_of(const Nameplate& plate);

}  // namespace kurbel
