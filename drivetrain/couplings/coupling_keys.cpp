// coupling_keys.cpp — inertias of both halves, limits of couplings, damping in its four forms.
#include "drivetrain/couplings/coupling_keys.h"

#include <fmt/format.h>

#include <numbers>
#include <utility>

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

const std::vector<Key>& damping_keys() {
  static const std::vector<Key> keys = {
      {.name = "damping",
       .unit = "N*m*s/rad",
       .domain = not_negative,
       .doc = "viscous damping c; one of the four forms"},
      {.name = "damping_ratio", .domain = not_negative, .doc = "ζ: c = 2 ζ k/ω_ref"},
      {.name = "relative_damping",
       .domain = not_negative,
       .doc = "ψ: energy lost in a cycle over greatest energy stored; c = ψ k/(2π ω_ref)"},
      {.name = "loss_factor", .domain = not_negative, .doc = "η: c = η k/ω_ref"},
      {.name = "damping_frequency",
       .unit = "Hz",
       .domain = positive,
       .doc = "ω_ref/2π of the three forms above; default: natural frequency of the two inertias joined"},
  };
  return keys;
}

Damping damping_of(const Section& s, Messages& messages) {
  static const std::pair<const char*, Damping::As> forms[] = {{"damping", Damping::As::viscous},
                                                              {"damping_ratio", Damping::As::ratio},
                                                              {"relative_damping", Damping::As::relative},
                                                              {"loss_factor", Damping::As::loss_factor}};
  Damping damping;
  const char* first = nullptr;
  for (const auto& [key, as] : forms) {
    if (!s.given(key)) continue;
    if (first)
      messages.add(s.where(key),
                   fmt::format("{} \"{}\": \"{}\" and \"{}\" both given; keep one", s.kind->name, s.name, first, key));
    first = key;
    damping.as = as;
    damping.value = s.number(key);
  }
  if (s.given("damping_frequency") && (!first || damping.as == Damping::As::viscous))
    messages.add(s.where("damping_frequency"),
                 fmt::format("{} \"{}\": \"damping_frequency\" belongs to \"damping_ratio\", \"relative_damping\" or "
                             "\"loss_factor\"; none is given",
                             s.kind->name, s.name));
  damping.frequency = 2 * std::numbers::pi * s.number_or("damping_frequency", 0);
  return damping;
}

}  // namespace kurbel
