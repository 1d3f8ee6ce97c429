// induction_keys.h — the keys of an induction motor: data of catalogue, nameplate and equivalent circuit, and the method
// of starting.
#pragma once

#include <optional>

#include "drivetrain/shared/rating_keys.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/scene/fields.h"

namespace kurbel {

// From a catalogue: ratios are torques over the rated torque.
struct CatalogueKeys {
  std::optional<double> rated_power, rated_speed, breakdown_ratio;  // [W], [rad/s]
  std::optional<double> synchronous_speed;                          // [rad/s]; default by the number of poles
  std::optional<int> poles;                                         // 2 p
  double mains = 50;                                                // [Hz], for the poles
  std::optional<double> breakdown_torque, breakdown_slip;           // of Kloss' curve [N·m], [1]
  double resistance_ratio = 0;                                      // a = R_s/R_r′
  double voltage_factor = 1;                                        // over the rated voltage
  std::optional<double> starting_ratio, pull_up_ratio, pull_up_speed, breakdown_speed;
};
// Nameplate data for the currents; two of the three are sufficient.
struct NameplateKeys {
  std::optional<double> rated_current, power_factor, efficiency;  // [A]
  double stator_share = 0.5;  // stator copper loss over all losses except the rotor's
};
// Data of the two-axis model, per phase; X in Ω at the frequency.
struct CircuitKeys {
  std::optional<double> frequency;  // [Hz]
  double magnetising_ratio = 30;    // X_m over X_s = X_r
  std::optional<double> voltage;    // line to line [V]
  std::optional<int> pole_pairs;
  std::optional<double> stator_resistance, rotor_resistance, stator_reactance, rotor_reactance, magnetising_reactance;
};
enum class Starting { direct, star_delta, soft_start, frequency_converter };
struct StartingKeys {
  Starting starting = Starting::direct;
  std::optional<double> switch_time, switch_speed;   // [s], [rad/s]
  double pause = 0;                                  // [s]
  std::optional<double> ramp;                        // [s]
  double initial_voltage = 0.3;                      // u₀
  std::optional<double> target_speed, torque_limit;  // [rad/s], [N·m]
};
struct InductionKeys : CatalogueKeys, NameplateKeys, CircuitKeys, StartingKeys {
  double inertia = 0;  // [kg·m²]
  Window window;
  DutyRating duty;
};

const Words<Starting>& starting_methods();
const char* name_of(Starting method);
Fields<InductionKeys> induction_fields();

}  // namespace kurbel
