// starters.h — starters of an induction motor: star–delta, soft start, frequency converter.
//
// At a time t after switching on, a starter gives the factor of the torque and the reduction (lag) of the synchronous speed:
//     M(t, ω) = factor · M_c(ω + lag),   M_c: the characteristic at rated voltage and frequency
// Stages are fixed between events; a stage ends where its guard reaches zero. Sources: Dubey, Fundamentals of
// Electrical Drives, ch. 6 (starting, variable frequency control); Leonhard, Control of Electrical Drives.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace kurbel {

struct Supply {
  double factor = 1;  // of torque
  double lag = 0;     // ω_s at rated frequency − ω_s now [rad/s]
};

// Star–delta: in star each winding has 1/√3 of the line voltage and, with M ∝ U², a third of the torque; then all
// contacts are open during a pause; then delta. Switched at a time or at a speed.
struct StarDelta {
  double switch_time = -1;  // [s]; < 0: by speed
  double switch_speed = 0;  // [rad/s]
  double pause = 0;         // [s], ≥ 0
  static constexpr int star = 0, delta = 1;

  bool by_time() const { return switch_time >= 0; }
  bool uses_time() const { return by_time() || pause > 0; }
  double settled_from() const { return by_time() ? switch_time + pause : -HUGE_VAL; }
  Supply supply(int stage, double) const { return {stage == star ? 1.0 / 3 : stage == delta ? 1.0 : 0.0, 0}; }
  double guard(int stage, double t, double speed) const {
    if (stage == delta) return 1;
    if (stage == star) return by_time() ? switch_time - t : (switch_speed - speed) / std::abs(switch_speed);
    return (by_time() ? switch_time : since(stage)) + pause - t;
  }
  int next_stage(int stage, double t) const { return stage == star && pause > 0 ? waiting(t) : delta; }
  // Depends on the present time and speed only: above the switching speed the motor starts in delta.
  int first_stage(double t, double speed) const {
    if (!by_time()) return speed >= switch_speed ? delta : star;
    return t < switch_time ? star : t < switch_time + pause ? waiting(switch_time) : delta;
  }
  std::string name(int stage) const {
    return stage == star ? "in star" : stage == delta ? "switched to delta" : "star opened: no torque";
  }

 private:
  // Only the mode is stored: a negative one holds the start of the pause, to 24 bits (relative error 6e-8).
  static int waiting(double t) { return -1 - std::bit_cast<int>(static_cast<float>(std::max(t, 0.0))); }
  static double since(int stage) { return static_cast<double>(std::bit_cast<float>(-1 - stage)); }
};

// Soft start: thyristors raise the voltage from u₀ to 1 over the ramp; M ∝ u².
struct SoftStart {
  double initial_voltage = 0;  // u₀ over the rated voltage, 0 … 1
  double ramp = 0;             // [s], > 0
  static constexpr int rising = 0, full = 1;

  bool uses_time() const { return true; }
  double settled_from() const { return ramp; }
  Supply supply(int stage, double t) const {
    const double u = stage == full ? 1 : initial_voltage + (1 - initial_voltage) * t / ramp;
    return {u * u, 0};
  }
  double guard(int stage, double t, double) const { return stage == full ? 1 : (ramp - t) / ramp; }
  int next_stage(int, double) const { return full; }
  int first_stage(double t, double) const { return t < ramp ? rising : full; }
  std::string name(int stage) const { return stage == full ? "full voltage" : "voltage rises"; }
};

// Frequency converter: the synchronous speed rises linearly from zero to its target over the ramp.
// Up to the rated frequency U/f and the flux are constant (the converter compensates for the voltage drop at the stator
// resistance): the curve is shifted, with the same breakdown torque and the same slip speed at each torque. Above it U
// is constant, and the torque decreases with the square of the flux, (f_n/f)².
struct FrequencyConverter {
  double ramp = 0;               // [s], > 0
  double target_speed = 0;       // synchronous speed at its end [rad/s], > 0
  double synchronous_speed = 0;  // at rated frequency [rad/s], > 0
  static constexpr int constant_flux = 0, weak_field = 1, at_target = 2;

  bool uses_time() const { return true; }
  double settled_from() const { return ramp; }
  double speed_of_field(int stage, double t) const {
    return stage == at_target ? target_speed : target_speed * t / ramp;
  }
  Supply supply(int stage, double t) const {
    const double field = speed_of_field(stage, t);
    const bool weak = stage == weak_field || (stage == at_target && target_speed > synchronous_speed);
    const double flux = weak ? synchronous_speed / field : 1;
    return {flux * flux, synchronous_speed - field};
  }
  double rated_frequency_at() const { return ramp * synchronous_speed / target_speed; }
  double guard(int stage, double t, double) const {
    if (stage == at_target) return 1;
    const bool knee = stage == constant_flux && target_speed > synchronous_speed;
    return ((knee ? rated_frequency_at() : ramp) - t) / ramp;
  }
  int next_stage(int stage, double) const {
    return stage == constant_flux && target_speed > synchronous_speed ? weak_field : at_target;
  }
  int first_stage(double t, double) const {
    if (t >= ramp) return at_target;
    return t < rated_frequency_at() ? constant_flux : weak_field;
  }
  std::string name(int stage) const {
    return stage == at_target ? "frequency at its target" : stage == weak_field ? "field weakens" : "frequency rises";
  }
};

}  // namespace kurbel
