// motor_kinds.cpp — motors by catalogue data, by circuit, by table.
#include "drivetrain/kinds.h"

#include <fmt/format.h>

#include <numbers>

#include "drivetrain/motors.h"
#include "drivetrain/shared_keys.h"
#include "engine/network.h"

namespace kurbel {
namespace {

void build_dc_shunt(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  double stall = s.number_or("stall_torque", 0), no_load = s.number_or("no_load_speed", 0);
  const bool electrical = s.given("voltage") || s.given("resistance") || s.given("constant");
  if (electrical) {
    if (!s.given("voltage") || !s.given("resistance") || !s.given("constant") || s.given("stall_torque") ||
        s.given("no_load_speed")) {
      messages.add(
          s.at,
          fmt::format(
              "dc shunt motor \"{}\": give either stall_torque and no_load_speed, or voltage, resistance and constant",
              s.name));
      return;
    }
    stall = s.number("constant") * s.number("voltage") / s.number("resistance");
    no_load = s.number("voltage") / s.number("constant");
  } else if (!s.given("stall_torque") || !s.given("no_load_speed")) {
    const bool one = s.given("stall_torque") || s.given("no_load_speed");
    messages.add(s.at, one ? fmt::format("dc shunt motor \"{}\": \"{}\" is missing beside \"{}\"", s.name,
                                         s.given("stall_torque") ? "no_load_speed" : "stall_torque",
                                         s.given("stall_torque") ? "stall_torque" : "no_load_speed")
                           : fmt::format("dc shunt motor \"{}\": nothing given; give stall_torque and no_load_speed, "
                                         "or voltage, resistance and constant",
                                         s.name));
    return;
  }
  net.put(node, s.name, DcShuntMotor{stall, no_load, s.number_or("rated_torque", 0)}, window_of(s, messages));
}

void build_induction(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const double rated = s.number("rated_speed"), synchronous = s.number("synchronous_speed");
  if (synchronous <= rated) {
    messages.add(
        s.where("synchronous_speed"),
        fmt::format("induction motor \"{}\": synchronous_speed = {:.6g} rpm; must be above rated_speed = {:.6g} rpm",
                    s.name, synchronous * 30 / std::numbers::pi, rated * 30 / std::numbers::pi));
    return;
  }
  const auto motor =
      InductionMotor::from_catalogue(s.number("rated_power"), rated, synchronous, s.number("breakdown_ratio"),
                                     s.number("resistance_ratio"), s.number("voltage_factor"));
  if (!(motor.breakdown_slip > 0)) {
    messages.add(
        s.where("resistance_ratio"),
        fmt::format("induction motor \"{}\": no Kloss curve passes through these data; lower resistance_ratio = {}",
                    s.name, s.number("resistance_ratio")));
    return;
  }
  net.put(node, s.name, motor, window_of(s, messages));
}

void build_table_motor(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  put_curve(net, node, s, s["torque"].curve, 1, Account::driving, window_of(s, messages), messages);
}

}  // namespace

std::vector<Kind> motor_kinds() {
  return {
      {.name = "induction motor",
       .doc = "induction motor after Kloss from catalogue data (THEORY 4.1)",
       .keys =
           joined({{.name = "rated_power", .unit = "W", .domain = positive, .doc = "shaft power P_n", .required = true},
                   {.name = "rated_speed",
                    .unit = "rad/s",
                    .domain = positive,
                    .doc = "speed ω_n at rated power",
                    .required = true},
                   {.name = "synchronous_speed",
                    .unit = "rad/s",
                    .domain = positive,
                    .doc = "ω_s, e.g. 1500 rpm",
                    .required = true},
                   {.name = "breakdown_ratio",
                    .domain = {.low = 1, .low_open = true},
                    .doc = "breakdown over rated torque ν",
                    .required = true},
                   {.name = "resistance_ratio",
                    .fallback = "0.0",
                    .domain = not_negative,
                    .doc = "a = R_s/R_r′ in Kloss' formula"},
                   {.name = "voltage_factor",
                    .fallback = "1.0",
                    .domain = positive,
                    .doc = "voltage over rated voltage; torque goes with its square"},
                   inertia_key("", "rotor inertia")},
                  window_keys()),
       .build = build_induction},
      {.name = "dc shunt motor",
       .doc = "straight characteristic M = M_stall (1 − ω/ω₀)",
       .keys = joined(
           {{.name = "stall_torque", .unit = "N*m", .domain = positive, .doc = "torque at standstill M_stall"},
            {.name = "no_load_speed", .unit = "rad/s", .domain = positive, .doc = "speed without torque ω₀"},
            {.name = "voltage",
             .unit = "V",
             .domain = positive,
             .doc = "armature voltage U, with resistance and constant in place of the two above"},
            {.name = "resistance", .unit = "Ohm", .domain = positive, .doc = "armature resistance R: M_stall = k U/R"},
            {.name = "constant", .unit = "N*m/A", .domain = positive, .doc = "motor constant k: ω₀ = U/k"},
            {.name = "rated_torque",
             .unit = "N*m",
             .domain = positive,
             .doc = "scale of errors; default: stall torque"},
            inertia_key("", "rotor inertia")},
           window_keys()),
       .build = build_dc_shunt},
      {.name = "motor",
       .doc = "motor, turbine or hydraulic drive by table M(ω)",
       .keys = joined({{.name = "torque",
                        .type = KeyType::curve,
                        .unit = "N*m",
                        .doc = "characteristic over speed",
                        .required = true,
                        .choices = {"speed"}},
                       inertia_key("", "rotor inertia")},
                      window_keys()),
       .build = build_table_motor},
  };
}

}  // namespace kurbel
