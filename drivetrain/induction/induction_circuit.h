// induction_circuit.h — induction motor by its two-axis (dq) model: the currents are states (effect "transients").
//
//     u = R_s i_s + dψ_s/dt + j ω_f ψ_s             ψ_s = L_s i_s + L_m i_r
//     0 = R_r i_r + dψ_r/dt + j (ω_f − p ω) ψ_r     ψ_r = L_m i_s + L_r i_r        M = 3/2 p L_m Im(i_s i_r*)
//     u        voltage, along the d axis: √(2/3) U c [V], U line to line; c: command of the operating sequence
//     ω_f      speed of the reference frame [rad/s]: that of the field, 2π f, negative while reversed (c < 0)
//     R, L     of stator and rotor (referred to the stator) [Ω], [H]; L_s = L_σs + L_m, L_r = L_σr + L_m
//     p        pole pairs
// In the frame of the field a steady state is an equilibrium. Phasors are peak values, power 3/2 Re(u i_s*).
// Source: Krause, Wasynczuk, Sudhoff: Analysis of Electric Machinery, 2nd ed. 2002, ch. 4; Leonhard ch. 10.
// Its steady torque is Kloss' curve with Thévenin's equivalent of the stator, Z = jX_m (R_s + jX_s)/(R_s + j(X_s + X_m)):
//     s_b = R_r/√(R² + X²), a = R/R_r, M_b = 3 U_Th²/(2 ω_s (R + √(R² + X²))),  R = Re Z, X = Im Z + X_r, ω_s = 2πf/p
// Switched off, the stator current is zero at once, while the rotor flux decays with the time constant L_r/R_r; switched
// on again, the motor starts with the remaining flux. On reversal the field reverses where both phase sequences have the
// same voltage, and the currents are continuous. Initial currents: zero at rest (the motor is just switched on), those of
// steady motion when turning.
#pragma once

#include <complex>
#include <string>

#include "drivetrain/induction/kloss.h"
#include "engine/elements/element.h"
#include "engine/numerics/dual.h"

namespace kurbel {

// Equivalent circuit of one phase, referred to the stator; reactances at the frequency f.
struct EquivalentCircuit {
  double voltage = 0;                                  // U, line to line, RMS [V]
  double frequency = 0;                                // f [Hz]
  int pole_pairs = 1;                                  // p
  double stator_resistance = 0, rotor_resistance = 0;  // R_s ≥ 0, R_r > 0 [Ω]
  double stator_leakage = 0, rotor_leakage = 0;        // X_s, X_r [Ω], > 0
  double magnetising = 0;                              // X_m [Ω], > 0

  double field_speed() const;  // 2π f [rad/s]
  double synchronous_speed() const { return field_speed() / pole_pairs; }
  std::complex<double> thevenin_impedance() const;  // of the stator
  double thevenin_voltage() const;                  // of one phase, RMS [V]
  // The exact steady characteristic. rated_torque: for error scales; 0: half of the breakdown torque.
  InductionMotor characteristic(double rated_torque = 0) const;
  // A circuit with a given characteristic. Torques do not determine the voltage or the ratios of the reactances;
  // assumptions: U = 400 V, X_s = X_r = X, X_m = magnetising_ratio X.
  static EquivalentCircuit of(const InductionMotor& characteristic, double frequency, double magnetising_ratio);
};

// RMS line current and cos φ at a slip.
struct LineCurrent {
  double current = 0, power_factor = 0;  // [A], [1]
};
LineCurrent line_current(const EquivalentCircuit& circuit, double slip);

struct TwoAxisMotor {
  static constexpr ShaftTraits is{.account = Account::driving,
                                  .commanded = true,
                                  .reversible = true,
                                  .guards = 1,
                                  .states = 4,  // i_sd, i_sq, i_rd, i_rq
                                  .feels_switching = true,
                                  .described = true,
                                  .other_forms = true};
  EquivalentCircuit circuit;
  InductionMotor line;    // its steady characteristic
  double rated_slip = 0;  // s_n, for describe(); 0: unknown

  template <class T>
  T torque(const ShaftState<T>& x) const {
    return 1.5 * circuit.pole_pairs * mutual() * (x.own[1] * x.own[2] - x.own[0] * x.own[3]);
  }
  template <class T>
  void rates(const ShaftState<T>& x, T* rate) const;
  void first_states(const ShaftState<double>& x, double* own) const;
  void switched(const ShaftState<double>& x, double* own) const;
  InternalState state(int k) const;
  bool opens_at_zero() const { return true; }
  bool uses_time() const { return false; }
  bool uses_speed() const { return true; }
  Rated rated() const { return line.rated(); }

  // The mode: sense of the field; 0: as the mains, 1: reversed.
  void guard(const ShaftState<double>& x, double* g) const { g[0] = 1e-9 + sense(x.mode) * x.command; }
  int first_mode(const ShaftState<double>& x) const { return x.command < 0 ? 1 : 0; }
  int next_mode(const ShaftState<double>& x, int) const { return 1 - x.mode; }
  std::string mode_name(int mode) const { return mode == 0 ? "" : "field reversed"; }

  double stator() const { return (circuit.stator_leakage + circuit.magnetising) / circuit.field_speed(); }  // L_s [H]
  double rotor() const { return (circuit.rotor_leakage + circuit.magnetising) / circuit.field_speed(); }    // L_r [H]
  double mutual() const { return circuit.magnetising / circuit.field_speed(); }                             // L_m [H]
  double phase_peak() const { return std::sqrt(2.0 / 3) * circuit.voltage; }                                // |u| [V]

  std::string describe() const;

 private:
  static double sense(int mode) { return mode == 0 ? 1 : -1; }
};
// Without the effect "transients": the steady characteristic; with the effect "torque_lag" it lags.
ShaftForm under(const TwoAxisMotor& motor, const Effects& effects);
ShaftForm lagging_form(const TwoAxisMotor& motor);

template <class T>
void TwoAxisMotor::rates(const ShaftState<T>& x, T* rate) const {
  const T &sd = x.own[0], &sq = x.own[1], &rd = x.own[2], &rq = x.own[3];
  const double ls = stator(), lr = rotor(), lm = mutual();
  const double field = sense(x.mode) * circuit.field_speed();
  const T slip = field - circuit.pole_pairs * x.rate;  // ω_f − p ω
  const T rotor_d = lm * sd + lr * rd, rotor_q = lm * sq + lr * rq;
  const T from_d = slip * rotor_q - circuit.rotor_resistance * rd;  // dψ_r/dt
  const T from_q = -slip * rotor_d - circuit.rotor_resistance * rq;
  if (!x.on) {
    rate[0] = rate[1] = T(0.0);
    rate[2] = from_d / lr;
    rate[3] = from_q / lr;
    return;
  }
  const double u = phase_peak() * std::abs(x.command);
  const T stator_d = ls * sd + lm * rd, stator_q = ls * sq + lm * rq;
  const T into_d = u - circuit.stator_resistance * sd + field * stator_q;  // dψ_s/dt
  const T into_q = -circuit.stator_resistance * sq - field * stator_d;
  const double over = 1 / (ls * lr - lm * lm);
  rate[0] = over * (lr * into_d - lm * from_d);
  rate[1] = over * (lr * into_q - lm * from_q);
  rate[2] = over * (ls * from_d - lm * into_d);
  rate[3] = over * (ls * from_q - lm * into_q);
}

}  // namespace kurbel
