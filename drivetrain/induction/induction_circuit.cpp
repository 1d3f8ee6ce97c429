// induction_circuit.cpp — equivalent circuit of an induction motor: its characteristic, steady currents, and the
// circuit that belongs to a characteristic.
#include "drivetrain/induction/induction_circuit.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/elements/any_shaft_element.h"
#include "engine/numerics/roots.h"
#include "engine/scene/effects.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

}  // namespace

double EquivalentCircuit::field_speed() const { return 2 * std::numbers::pi * frequency; }

Complex EquivalentCircuit::thevenin_impedance() const {
  const Complex own = stator_resistance + j * stator_leakage, parallel = j * magnetising;
  return own * parallel / (own + parallel);
}

double EquivalentCircuit::thevenin_voltage() const {
  return voltage / std::sqrt(3.0) * magnetising / std::hypot(stator_resistance, stator_leakage + magnetising);
}

InductionMotor EquivalentCircuit::characteristic(double rated_torque) const {
  const Complex z = thevenin_impedance();
  const double r = z.real(), x = z.imag() + rotor_leakage, u = thevenin_voltage();
  const double breakdown = 1.5 * u * u / (synchronous_speed() * (r + std::hypot(r, x)));
  return {breakdown, synchronous_speed(), rotor_resistance / std::hypot(r, x), r / rotor_resistance,
          rated_torque > 0 ? rated_torque : 0.5 * breakdown};
}

// a s_b = R/√(R² + X²) depends on R_s/X_s alone and grows with it; then R_r follows from s_b, the level from M_b.
EquivalentCircuit EquivalentCircuit::of(const InductionMotor& wanted, double frequency, double magnetising_ratio) {
  EquivalentCircuit c{
      .voltage = 400,
      .frequency = frequency,
      .pole_pairs = static_cast<int>(std::lround(2 * std::numbers::pi * frequency / wanted.synchronous_speed)),
      .rotor_resistance = 1,
      .stator_leakage = 1,
      .rotor_leakage = 1,
      .magnetising = magnetising_ratio};
  const double goal = wanted.resistance_ratio * wanted.breakdown_slip;
  const auto share = [&](double resistance) {
    c.stator_resistance = resistance;
    const Complex z = c.thevenin_impedance();
    return z.real() / std::hypot(z.real(), z.imag() + c.rotor_leakage);
  };
  double high = 1;
  while (share(high) < goal && high < 0.1 * magnetising_ratio) high *= 2;
  c.stator_resistance = goal > 0 ? halved({0, high}, 200, [&](double r) { return share(r) < goal; }).middle() : 0;
  const Complex z = c.thevenin_impedance();
  c.rotor_resistance = wanted.breakdown_slip * std::hypot(z.real(), z.imag() + c.rotor_leakage);
  const double level = c.characteristic().breakdown_torque / wanted.breakdown_torque;  // M ∝ 1/X
  for (double* part : {&c.stator_resistance, &c.rotor_resistance, &c.stator_leakage, &c.rotor_leakage, &c.magnetising})
    *part *= level;
  return c;
}

LineCurrent line_current(const EquivalentCircuit& c, double slip) {
  const Complex main = j * c.magnetising, rotor = c.rotor_resistance / slip + j * c.rotor_leakage;
  const Complex z = c.stator_resistance + j * c.stator_leakage + main * rotor / (main + rotor);
  return {c.voltage / std::sqrt(3.0) / std::abs(z), z.real() / std::abs(z)};
}

void TwoAxisMotor::first_states(const ShaftState<double>& x, double* own) const {
  std::fill(own, own + is.states, 0.0);
  if (!x.on || x.rate == 0) return;
  const double field = sense(x.mode) * circuit.field_speed(), slip = field - circuit.pole_pairs * x.rate;
  const Complex zs = circuit.stator_resistance + j * (field * stator()),
                zr = circuit.rotor_resistance + j * (slip * rotor());
  const Complex stator_current = phase_peak() * std::abs(x.command) / (zs + field * slip * mutual() * mutual() / zr);
  const Complex rotor_current = -j * (slip * mutual()) * stator_current / zr;
  own[0] = stator_current.real(), own[1] = stator_current.imag();
  own[2] = rotor_current.real(), own[3] = rotor_current.imag();
}

// The rotor keeps its flux.
void TwoAxisMotor::switched(const ShaftState<double>& x, double* own) const {
  if (x.on) return;
  for (int k = 0; k < 2; ++k) {
    own[2 + k] += mutual() / rotor() * own[k];
    own[k] = 0;
  }
}

InternalState TwoAxisMotor::state(int k) const {
  static const char* const names[] = {"stator_current_d", "stator_current_q", "rotor_current_d", "rotor_current_q"};
  const double starting = phase_peak() / (circuit.stator_leakage + circuit.rotor_leakage);
  return {names[k], "A", starting};
}

ShaftForm under(const TwoAxisMotor& motor, const Effects& effects) {
  if (effects.transients) return nullptr;
  if (!effects.torque_lag) return shaft_form(motor.line);
  return lagging_form(motor);
}

std::string TwoAxisMotor::describe() const {
  std::string text =
      fmt::format("two-axis circuit: R_s = {}, R_r = {}, X_s = {}, X_r = {}, X_m = {} at {}, {} pole pair{}",
                  with_unit(circuit.stator_resistance, "Ohm", 4), with_unit(circuit.rotor_resistance, "Ohm", 4),
                  with_unit(circuit.stator_leakage, "Ohm", 4), with_unit(circuit.rotor_leakage, "Ohm", 4),
                  with_unit(circuit.magnetising, "Ohm", 4), with_unit(circuit.frequency, "Hz", 4), circuit.pole_pairs,
                  circuit.pole_pairs == 1 ? "" : "s");
  if (rated_slip > 0) {
    const LineCurrent rated = line_current(circuit, rated_slip), held = line_current(circuit, 1);
    text += fmt::format("; estimated from the nameplate: at rated slip {} with cos φ = {:.3f}, at standstill {}",
                        with_unit(rated.current, "A", 4), rated.power_factor, with_unit(held.current, "A", 4));
  }
  return text;
}

}  // namespace kurbel
