// coupling_keys.cpp — inertias of both halves, limits of couplings, damping in its four forms.
#include "drivetrain/couplings/coupling_keys.h"

#include <fmt/format.h>

#include <numbers>

#include "engine/model/network.h"

namespace kurbel {

const Fields<SideInertias>& side_inertia_fields() {
  static const auto made = Fields<SideInertias>()
                               .add({.name = "inertia_in",
                                     .unit = "kg*m2",
                                     .fallback = "\"0 kg*m2\"",
                                     .domain = not_negative,
                                     .doc = "half on the driving side"},
                                    &SideInertias::in)
                               .add({.name = "inertia_out",
                                     .unit = "kg*m2",
                                     .fallback = "\"0 kg*m2\"",
                                     .domain = not_negative,
                                     .doc = "half on the driven side"},
                                    &SideInertias::out);
  return made;
}

std::array<int, 2> two_shafts(const Section& s, const SideInertias& inertia, Network& net) {
  const int in = net.add_node(s.name, "in", inertia.in);
  const int out = net.add_node(s.name, "out", inertia.out);
  net.ports[s.name] = {in, out, {}};
  return {in, out};
}

Key application_factor_key() {
  return {.name = "application_factor",
          .fallback = "1",
          .domain = {.low = 1},
          .doc = "K_A on the mean torque, in kurbel modes"};
}

const Fields<CouplingLimits>& coupling_limit_fields() {
  using Limits = CouplingLimits;
  static const auto made =
      Fields<Limits>()
          .add({.name = "nominal_torque",
                .unit = "N*m",
                .domain = positive,
                .doc = "T_KN, of the mean torque in steady motion, limit for kurbel modes"},
               &Limits::nominal)
          .add({.name = "maximum_torque",
                .unit = "N*m",
                .domain = positive,
                .doc = "T_Kmax, of peaks at starts and in resonances passed, limit for kurbel modes and run"},
               &Limits::maximum)
          .add({.name = "vibratory_torque",
                .unit = "N*m",
                .domain = positive,
                .doc = "T_KW, lasting amplitude at 10 Hz, limit for kurbel modes"},
               &Limits::vibratory)
          .add({.name = "dissipated_power", .unit = "W", .domain = positive, .doc = "P_KW, limit for kurbel modes"},
               &Limits::power)
          .add(application_factor_key(), &Limits::application_factor)
          .add({.name = "temperature_factor",
                .fallback = "1",
                .domain = {.low = 1},
                .doc = "S_t by its maker's table, for what its rubber loses at its temperature, in kurbel modes"},
               &Limits::temperature_factor)
          .add({.name = "start_factor",
                .fallback = "1",
                .domain = {.low = 1},
                .doc = "S_z by its maker's table, for the number of starts or blows in an hour, in kurbel modes"},
               &Limits::start_factor);
  return made;
}

const Fields<Damping>& damping_fields() {
  using As = Damping::As;
  static const auto made =
      Fields<Damping>()
          .add_forms(&Damping::value, &Damping::as,
                     {{{.name = "damping",
                        .unit = "N*m*s/rad",
                        .domain = not_negative,
                        .doc = "viscous damping c; one of the four forms"},
                       As::viscous},
                      {{.name = "damping_ratio", .domain = not_negative, .doc = "ζ: c = 2 ζ k/ω_ref"}, As::ratio},
                      {{.name = "relative_damping",
                        .domain = not_negative,
                        .doc = "ψ: energy lost in a cycle over greatest energy stored; c = ψ k/(2π ω_ref)"},
                       As::relative},
                      {{.name = "loss_factor", .domain = not_negative, .doc = "η: c = η k/ω_ref"}, As::loss_factor}})
          .add({.name = "damping_frequency",
                .unit = "Hz",
                .domain = positive,
                .doc = "ω_ref/2π of the three forms above; default: natural frequency of the two inertias joined"},
               &Damping::frequency, Scaled(2 * std::numbers::pi))
          .check([](const Reading<Damping>& damping) {
            if (damping.given(&Damping::frequency) && damping.as == As::viscous)
              damping.refuse(&Damping::frequency,
                             "\"damping_frequency\" belongs to \"damping_ratio\", \"relative_damping\" or "
                             "\"loss_factor\"; none is given");
          });
  return made;
}

}  // namespace kurbel
