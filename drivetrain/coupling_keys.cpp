// coupling_keys.cpp — inertias of both halves, limits of couplings.
#include "drivetrain/coupling_keys.h"

namespace kurbel {

std::vector<Key> side_inertia_keys() {
  return {{.name = "inertia_in",
           .unit = "kg*m2",
           .fallback = "\"0 kg*m2\"",
           .domain = not_negative,
           .doc = "half on the driving side"},
          {.name = "inertia_out",
           .unit = "kg*m2",
           .fallback = "\"0 kg*m2\"",
           .domain = not_negative,
           .doc = "half on the driven side"}};
}

Key application_factor_key() {
  return {.name = "application_factor",
          .fallback = "1",
          .domain = {.low = 1},
          .doc = "K_A on the mean torque, in kurbel modes"};
}

// Limits of couplings after DIN 740-2.
std::vector<Key> coupling_limit_keys() {
  return {{.name = "nominal_torque", .unit = "N*m", .domain = positive, .doc = "T_KN, limit for kurbel modes"},
          {.name = "maximum_torque", .unit = "N*m", .domain = positive, .doc = "T_Kmax, limit for kurbel modes"},
          {.name = "vibratory_torque",
           .unit = "N*m",
           .domain = positive,
           .doc = "T_KW, lasting amplitude at 10 Hz, limit for kurbel modes"},
          {.name = "dissipated_power", .unit = "W", .domain = positive, .doc = "P_KW, limit for kurbel modes"},
          application_factor_key()};
}

}  // namespace kurbel
