// dc_kinds.cpp — DC motors by their static characteristics, or with their circuits.
#include "drivetrain/motors/kinds.h"

#include <fmt/format.h>

#include <numbers>

#include "drivetrain/motors/dc_circuits.h"
#include "drivetrain/motors/dc_series_motor.h"
#include "drivetrain/motors/motors.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

std::optional<double> initial_current_of(const Section& s, Messages& messages) {
  if (!s.given("initial_current")) return {};
  if (!s.given("inductance"))
    messages.add(s.where("initial_current"), fmt::format("{} \"{}\": \"initial_current\" belongs to \"inductance\", "
                                                         "which is not given; drop it",
                                                         s.kind->name, s.name));
  return s.number("initial_current");
}

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
  const auto initial = initial_current_of(s, messages);
  const double rated = s.number_or("rated_torque", 0);
  const Window window = window_of(s, messages);
  if (!electrical) {
    for (const char* key : {"inductance", "braking_resistance"})
      if (s.given(key))
        messages.add(s.where(key), fmt::format("dc shunt motor \"{}\": \"{}\" needs the circuit; give voltage, "
                                               "resistance and constant in place of stall_torque and no_load_speed",
                                               s.name, key));
    net.put(node, s.name, DcShuntMotor{stall, no_load, rated}, window);
    return;
  }
  const BrakedShuntMotor line{
      s.number("voltage"), s.number("resistance"), s.number("constant"), rated, {s.number_or("braking_resistance", 0)}};
  if (s.given("inductance"))
    net.put(node, s.name, DcShuntCircuit{line, s.number("inductance"), initial}, window);
  else if (line.brake.resistance > 0)
    net.put(node, s.name, line, window);
  else
    net.put(node, s.name, DcShuntMotor{stall, no_load, rated}, window);
}

// R/κ says little of a motor's rated speed, which in machines is some 5 … 20 times as much. At 100 times the current is
// a hundredth of U/R and the torque 10⁻⁴ of the stall torque: no load of its size lets it come there.
void limit_speed(const Section& s, DcSeriesMotor& motor) {
  if (s.given("max_speed")) {
    motor.max_speed = s.number("max_speed");
  } else if (s.given("rated_speed")) {
    motor.max_speed = 5 * s.number("rated_speed");
    motor.limit_by = "by default 5 rated_speed";
  } else {
    motor.max_speed = 100 * motor.base_speed();
    motor.limit_by = "by default 100 R/κ, as rated_speed is not given";
  }
}

void build_dc_series(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  DcSeriesMotor motor{s.number("voltage"), s.number("resistance"), s.number("constant"), 0, s.name};
  limit_speed(s, motor);
  if (s.given("rated_speed") && motor.max_speed <= s.number("rated_speed"))
    messages.add(
        s.where("max_speed"),
        fmt::format("dc series motor \"{}\": max_speed = {:.6g} rpm; must be above rated_speed = {:.6g} rpm", s.name,
                    motor.max_speed * 30 / std::numbers::pi, s.number("rated_speed") * 30 / std::numbers::pi));
  const auto initial = initial_current_of(s, messages);
  const Window window = window_of(s, messages);
  if (s.given("inductance"))
    net.put(node, s.name, DcSeriesCircuit{motor, s.number("inductance"), initial}, window);
  else
    net.put(node, s.name, motor, window);
}

std::vector<Key> circuit_keys(const char* of) {
  return {{.name = "inductance", .unit = "H", .domain = positive, .doc = of, .effect = "transients"},
          {.name = "initial_current",
           .unit = "A",
           .doc = "at the start; default: 0 at rest, else that of the static line"}};
}

}  // namespace

std::vector<Kind> dc_kinds() {
  return {
      {.name = "dc shunt motor",
       .doc = "straight characteristic M = M_stall (1 − ω/ω₀); with its inductance the armature current is a state",
       .keys = joined(
           joined(
               {{.name = "stall_torque", .unit = "N*m", .domain = positive, .doc = "torque at standstill M_stall"},
                {.name = "no_load_speed", .unit = "rad/s", .domain = positive, .doc = "speed without torque ω₀"},
                {.name = "voltage",
                 .unit = "V",
                 .domain = positive,
                 .doc = "armature voltage U, with resistance and constant in place of the two above"},
                {.name = "resistance",
                 .unit = "Ohm",
                 .domain = positive,
                 .doc = "armature resistance R: M_stall = k U/R"},
                {.name = "constant", .unit = "N*m/A", .domain = positive, .doc = "motor constant k: ω₀ = U/k"},
                {.name = "rated_torque",
                 .unit = "N*m",
                 .domain = positive,
                 .doc = "scale of errors; default: stall torque"},
                {.name = "braking_resistance",
                 .unit = "Ohm",
                 .domain = positive,
                 .doc = "closes the armature while an operating sequence sets it 0, in series with it while reversed; "
                        "default: 0 opens the circuit"},
                inertia_key("", "rotor inertia")},
               circuit_keys("L of the armature circuit")),
           window_keys()),
       .build = build_dc_shunt},
      {.name = "dc series motor",
       .doc =
           "M = κ U²/(R + κ ω)², or with its inductance L di/dt = U − R i − κ ω i, M = κ i²; runs away where no load "
           "holds it, which ends the run",
       .keys = joined(
           joined(
               {{.name = "voltage", .unit = "V", .domain = positive, .doc = "supply voltage U", .required = true},
                {.name = "resistance",
                 .unit = "Ohm",
                 .domain = positive,
                 .doc = "R of armature and field together",
                 .required = true},
                {.name = "constant",
                 .unit = "N*m/A2",
                 .domain = positive,
                 .doc = "κ: torque over current squared",
                 .required = true},
                {.name = "rated_speed", .unit = "rad/s", .domain = positive, .doc = "for the default of max_speed"},
                {.name = "max_speed",
                 .unit = "rad/s",
                 .domain = positive,
                 .doc = "beyond it the motor ran away; default: 5 rated_speed, without it 100 R/κ, where the current "
                        "is a hundredth of U/R"},
                inertia_key("", "rotor inertia")},
               circuit_keys("L of armature and field together")),
           window_keys()),
       .build = build_dc_series},
  };
}

}  // namespace kurbel
