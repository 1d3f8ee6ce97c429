// coupling_keys.cpp — inertias of both halves, limits of couplings, damping in its four forms.
#include "drivetrain/couplings/coupling_keys.h"

#include <numbers>

#include "engine/model/network.h"

namespace kurbel {

Fields<SideInertias> side_inertia_fields() {
  return Fields<SideInertias>()
      .add(defaulted("inertia_in", "kg*m2", "0 kg*m2", not_negative, "half on the driving side"), &SideInertias::in)
      .add(defaulted("inertia_out", "kg*m2", "0 kg*m2", not_negative, "half on the driven side"), &SideInertias::out);
}

std::array<int, 2> two_shafts(const Section& s, const SideInertias& inertia, Network& net) {
  const int in = net.add_node(s.name, "in", inertia.in);
  const int out = net.add_node(s.name, "out", inertia.out);
  net.ports[s.name] = {in, out, {}};
  return {in, out};
}

Key application_factor_key() {
  return defaulted("application_factor", "", "1", {.low = 1}, "K_A on the mean torque, in kurbel modes");
}

Fields<CouplingLimits> coupling_limit_fields() {
  using Limits = CouplingLimits;
  return Fields<Limits>()
      .add(quantity("nominal_torque", "N*m", positive,
                    "T_KN, of the mean torque in steady motion, limit for kurbel modes"),
           &Limits::nominal)
      .add(quantity("maximum_torque", "N*m", positive,
                    "T_Kmax, of peaks at starts and in resonances passed, limit for kurbel modes and run"),
           &Limits::maximum)
      .add(quantity("vibratory_torque", "N*m", positive, "T_KW, lasting amplitude at 10 Hz, limit for kurbel modes"),
           &Limits::vibratory)
      .add(quantity("dissipated_power", "W", positive, "P_KW, limit for kurbel modes"), &Limits::power)
      .add(application_factor_key(), &Limits::application_factor)
      .add(defaulted(
               "temperature_factor", "", "1", {.low = 1},
               "S_t from the manufacturer's table, for the loss of its rubber at its temperature, in kurbel modes"),
           &Limits::temperature_factor)
      .add(defaulted(
               "start_factor", "", "1", {.low = 1},
               "S_z from the manufacturer's table, for the number of starts or shocks in an hour, in kurbel modes"),
           &Limits::start_factor)
      .add(choice("type", "elastomer",
                  "what carries: rubber has S_f and S_t; steel has none, of discs, gear teeth or springs"),
           &Limits::type,
           {{"elastomer", Limits::Type::elastomer},
            {"disc", Limits::Type::disc},
            {"gear", Limits::Type::gear},
            {"spring", Limits::Type::spring}})
      .check([](const Reading<Limits>& r) {
        if (r.type != Limits::Type::elastomer && r.given(&Limits::temperature_factor))
          r.refuse(&Limits::temperature_factor,
                   "\"temperature_factor\" is of rubber; a coupling of this \"type\" has none: drop it");
      });
}

Fields<Damping> damping_fields() {
  using As = Damping::As;
  return Fields<Damping>()
      .add_forms(
          &Damping::value, &Damping::as,
          {{quantity("damping", "N*m*s/rad", not_negative, "viscous damping c; one of the four forms"), As::viscous},
           {quantity("damping_ratio", "", not_negative, "ζ: c = 2 ζ k/ω_ref"), As::ratio},
           {quantity("relative_damping", "", not_negative,
                     "ψ: energy lost in a cycle over greatest energy stored; c = ψ k/(2π ω_ref)"),
            As::relative},
           {quantity("loss_factor", "", not_negative, "η: c = η k/ω_ref"), As::loss_factor}})
      .add(quantity("damping_frequency", "Hz", positive,
                    "ω_ref/2π of the three forms above; default: natural frequency of the two inertias joined"),
           &Damping::frequency, Scaled(2 * std::numbers::pi))
      .check([](const Reading<Damping>& damping) {
        if (damping.given(&Damping::frequency) && damping.as == As::viscous)
          damping.refuse(&Damping::frequency,
                         "\"damping_frequency\" belongs to \"damping_ratio\", \"relative_damping\" or "
                         "\"loss_factor\"; none is given");
      });
}

}  // namespace kurbel
