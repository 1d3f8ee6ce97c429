// shaft_rating.h — allowable loads of a coupling; allowable torsional stress of a shaft by its manufacturer, Goodman and
// IACS UR M68.
//
//  manufacturer: τ_a ≤ τ_allowable                               τ_a = (τ_max − τ_min)/2,  τ_m = (τ_max + τ_min)/2
//  Goodman:      S (K_f τ_a + τ_W |τ_m|/τ_B) ≤ τ_W               τ_B = 0.67 σ_B
//  yield:        S |τ|_max ≤ τ_S                                 τ_S = 0.577 σ_S
//  UR M68:       τ_C = (σ_B + 160)/18 · c_K c_D (3 − 2 λ²)       λ < 0.9; λ: speed over rated speed
//                τ_C = (σ_B + 160)/18 · c_K c_D · 1.38           0.9 ≤ λ < 1.05
//                τ_T = 1.7 τ_C/√c_K                              while a barred range is passed
//                16 n_c/(18 − λ_c) ≤ n ≤ (18 − λ_c) n_c/16       barred around a resonance, λ_c < 0.8
//                c_D = 0.35 + 0.93 d^−0.2                        stresses in N/mm², d in mm  (theory 12.14 … 12.16)
// UR M68 applies to intermediate, thrust, propeller and stern tube shafts. It expressly excludes crankshafts and the
// shafts of gears, motors, generators and turbines.
#pragma once

#include <optional>

namespace kurbel {

// Limits that the loads are compared with, by DIN 740-2 (theory 12.10); 0: not given.
struct CouplingLimits {
  // The elastic part: rubber, which heats up with the frequency (S_f) and weakens with the temperature (S_t), or steel.
  enum class Type { elastomer, disc, gear, spring };
  double nominal = 0, maximum = 0, vibratory = 0;  // T_KN, T_Kmax, T_KW [N·m]
  double power = 0;                                // P_KW [W]
  double application_factor = 1;                   // K_A, ≥ 1
  double temperature_factor = 1;                   // S_t, ≥ 1
  double start_factor = 1;                         // S_z, ≥ 1
  Type type = Type::elastomer;
  // S_f; of_swing: the frequency factor of the alternating torque by its spectrum. Metal couplings have 1.
  double frequency_factor(double of_swing) const { return type == Type::elastomer ? of_swing : 1; }
};

// Marks a component with a gap in its data, whether or not the effect "backlash" is on.
struct StatedPlay {};

struct ShaftRating {
  enum class Role { none, intermediate, thrust, propeller, stern_tube };
  enum class Detail { flange, shrink_fit, tapered_keyway, cylindrical_keyway, radial_hole, slot };
  enum class Steel { carbon, alloy };

  std::optional<double> vibratory;       // τ_allowable of the manufacturer [Pa]
  std::optional<double> tensile, yield;  // σ_B, σ_S [Pa]
  std::optional<double> endurance;       // τ_W, of the smooth shaft in reversed torsion [Pa]
  double notch = 1, safety = 1;          // K_f, S
  Role role = Role::none;                // UR M68
  Detail detail = Detail::flange;        // of an intermediate shaft
  Steel steel = Steel::carbon;           // limits the σ_B that UR M68 allows for
  std::optional<double> stated_design;   // c_K instead of the value of the table
  std::optional<double> rated_speed;     // of this shaft, λ = 1 [rad/s]

  bool any() const { return vibratory || yield || endurance || role != Role::none; }
  bool is_of_propulsion() const { return role != Role::none; }

  double strength_in_shear() const;  // τ_B [Pa]
  double yield_in_shear() const;     // τ_S [Pa]
  // The stress to be compared with τ_W: S (K_f τ_a + τ_W |τ_m|/τ_B) [Pa].
  double fatigue_stress(double amplitude, double mean) const;

  double design_factor() const;                                  // c_K
  double counted_strength() const;                               // σ_B, at most the value that UR M68 allows for [Pa]
  double speed_ratio(double speed) const;                        // λ
  double continuous(double diameter, double speed_ratio) const;  // τ_C [Pa]; infinite above λ = 1.05
  double transient(double diameter, double speed_ratio) const;   // τ_T [Pa]
};

// Limits of the range that UR M68 bars around a critical speed, over that speed.
struct BarredAround {
  double from = 1, to = 1;
};
BarredAround barred_around(double speed_ratio);

}  // namespace kurbel
