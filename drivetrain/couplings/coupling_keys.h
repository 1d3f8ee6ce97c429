// coupling_keys.h — fields shared by all components with two shafts.
#pragma once

#include <array>

#include "drivetrain/couplings/coupling.h"
#include "drivetrain/couplings/shaft_rating.h"
#include "engine/scene/fields.h"

namespace kurbel {

class Network;

struct SideInertias {
  double in = 0, out = 0;  // [kg·m²]
};
Fields<SideInertias> side_inertia_fields();
// The two shafts of a component, each with its inertia.
std::array<int, 2> two_shafts(const Section& section, const SideInertias& inertia, Network& net);

Fields<CouplingLimits> coupling_limit_fields();
Key application_factor_key();

Fields<ShaftRating> shaft_rating_fields();

// Data of a shaft in the scene.
struct ShaftKeys {
  std::optional<double> stiffness, length, diameter;  // k [N·m/rad], L, D [m]
  double bore = 0, shear_modulus = 0, density = 0;    // d [m], G [Pa], ρ [kg/m³]
  std::optional<double> inertia;                      // [kg·m²]
  std::optional<int> segments;
  std::optional<double> allowable_shear_stress;  // [Pa]
  ShaftRating rating;
  Damping damping;
  double application_factor = 1;

  bool judges_stress() const { return allowable_shear_stress || rating.any(); }
  double polar_moment() const;   // J_p = π (D⁴ − d⁴)/32 [m⁴]; only for shafts given by diameter
  double polar_modulus() const;  // W_p = 2 J_p/D [m³]
};

Fields<Damping> damping_fields();  // in its four forms

}  // namespace kurbel
