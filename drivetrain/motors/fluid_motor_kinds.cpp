// fluid_motor_kinds.cpp — hydraulic and pneumatic drives by their characteristics.
#include "drivetrain/motors/kinds.h"

#include <fmt/format.h>

#include <cmath>

#include "drivetrain/motors/fluid_motors.h"
#include "drivetrain/shared/shared_keys.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

void build_hydraulic(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const HydraulicMotor motor{
      s.number("displacement"),          s.number("pressure_difference"),        s.number("flow"),
      s.number("volumetric_efficiency"), s.number("hydromechanical_efficiency"), s.number("relief_rise")};
  net.put(node, s.name, TorqueOverSpeed{Account::driving, motor.curve(), 1}, window_of(s, messages));
}

void build_pneumatic(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const double power = s.number("max_power"), free_speed = s.number("free_speed");
  const double stall = s.number_or("stall_torque", 4 * power / free_speed), number = power / (stall * free_speed);
  const double least = PneumaticMotor::power_number(-1), most = PneumaticMotor::power_number(1);
  if (number < least || number > most) {
    messages.add(
        s.where("stall_torque"),
        fmt::format("pneumatic motor \"{}\": stall_torque = {:.4g} N·m; must be {:.4g} … {:.4g} N·m for this power "
                    "and free speed (a straight line has {:.4g} N·m)",
                    s.name, stall, power / (most * free_speed), power / (least * free_speed), 4 * power / free_speed));
    return;
  }
  net.put(node, s.name,
          PneumaticMotor{stall, free_speed, s.given("stall_torque") ? PneumaticMotor::bend_for(number) : 0},
          window_of(s, messages));
}

}  // namespace

std::vector<Kind> fluid_motor_kinds() {
  const Domain efficiency{.low = 0, .high = 1, .low_open = true};
  return {
      {.name = "hydraulic motor",
       .doc = "hydraulic motor on a pump of constant flow with a relief valve: constant torque up to the flow-limited "
              "speed, then falling",
       .keys = joined(
           {{.name = "displacement", .unit = "m3/rad", .domain = positive, .doc = "e.g. 80 cm3/rev", .required = true},
            {.name = "pressure_difference",
             .unit = "Pa",
             .domain = positive,
             .doc = "over the motor when the relief valve opens",
             .required = true},
            {.name = "flow", .unit = "m3/s", .domain = positive, .doc = "of the pump, e.g. 40 l/min", .required = true},
            {.name = "volumetric_efficiency",
             .fallback = "0.95",
             .domain = {.low = 0, .high = 1, .low_open = true, .high_open = true},
             .doc = "η_v at that pressure and the flow-limited speed; the rest leaks in proportion to the pressure"},
            {.name = "hydromechanical_efficiency",
             .fallback = "0.9",
             .domain = efficiency,
             .doc = "η_hm, of the torque"},
            {.name = "relief_rise",
             .unit = "Pa",
             .fallback = "\"0 bar\"",
             .domain = not_negative,
             .doc = "by which the pressure rises until the relief valve passes the whole flow"},
            inertia_key("", "rotor inertia")},
           window_keys()),
       .build = build_hydraulic},
      {.name = "pneumatic motor",
       .doc = "air motor at constant supply pressure: nearly straight from stall torque to free speed",
       .keys = joined(
           {{.name = "max_power", .unit = "W", .domain = positive, .doc = "greatest power", .required = true},
            {.name = "free_speed", .unit = "rad/s", .domain = positive, .doc = "speed without load", .required = true},
            {.name = "stall_torque",
             .unit = "N*m",
             .domain = positive,
             .doc = "at standstill; bends the line to pass max_power. Default: that of a straight line, 4 "
                    "max_power/free_speed"},
            inertia_key("", "rotor inertia")},
           window_keys()),
       .build = build_pneumatic},
  };
}

}  // namespace kurbel
