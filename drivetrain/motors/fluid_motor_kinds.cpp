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

struct HydraulicKeys : HydraulicMotor {
  double inertia = 0;  // [kg·m²]
  Window window;
};

const Fields<HydraulicKeys>& hydraulic_fields() {
  using Keys = HydraulicKeys;
  static const auto made =
      Fields<Keys>()
          .add({.name = "displacement",
                .unit = "m3/rad",
                .domain = positive,
                .doc = "e.g. 80 cm3/rev",
                .required = true},
               &Keys::displacement)
          .add({.name = "pressure_difference",
                .unit = "Pa",
                .domain = positive,
                .doc = "over the motor when the relief valve opens",
                .required = true},
               &Keys::relief_pressure)
          .add({.name = "flow",
                .unit = "m3/s",
                .domain = positive,
                .doc = "of the pump, e.g. 40 l/min",
                .required = true},
               &Keys::flow)
          .add({.name = "volumetric_efficiency",
                .fallback = "0.95",
                .domain = {.low = 0, .high = 1, .low_open = true, .high_open = true},
                .doc = "η_v at that pressure and the flow-limited speed; the rest leaks in proportion to the pressure"},
               &Keys::volumetric_efficiency)
          .add({.name = "hydromechanical_efficiency",
                .fallback = "0.9",
                .domain = {.low = 0, .high = 1, .low_open = true},
                .doc = "η_hm, of the torque"},
               &Keys::hydromechanical_efficiency)
          .add({.name = "relief_rise",
                .unit = "Pa",
                .fallback = "\"0 bar\"",
                .domain = not_negative,
                .doc = "by which the pressure rises until the relief valve passes the whole flow"},
               &Keys::relief_rise)
          .add(inertia_key("", "rotor inertia"), &Keys::inertia)
          .add(window_fields(), &Keys::window);
  return made;
}

void build_hydraulic(const Section& s, Network& net, Messages& messages) {
  const auto motor = hydraulic_fields().read(s, messages);
  net.put(single_shaft(s, motor.inertia, net), s.name, TorqueOverSpeed{Account::driving, motor.curve(), 1},
          motor.window);
}

struct PneumaticKeys {
  double power = 0, free_speed = 0;  // P_max [W], ω₀ [rad/s]
  double stall_torque = 0;           // M_s [N·m]
  double inertia = 0;                // [kg·m²]
  Window window;

  double straight_stall_torque() const { return 4 * power / free_speed; }
};

const Fields<PneumaticKeys>& pneumatic_fields() {
  using Keys = PneumaticKeys;
  static const auto made =
      Fields<Keys>()
          .add({.name = "max_power", .unit = "W", .domain = positive, .doc = "greatest power", .required = true},
               &Keys::power)
          .add({.name = "free_speed",
                .unit = "rad/s",
                .domain = positive,
                .doc = "speed without load",
                .required = true},
               &Keys::free_speed)
          .add({.name = "stall_torque",
                .unit = "N*m",
                .domain = positive,
                .doc = "at standstill; bends the line to pass max_power. Default: that of a straight line, 4 "
                       "max_power/free_speed"},
               &Keys::stall_torque, &Keys::straight_stall_torque)
          .add(inertia_key("", "rotor inertia"), &Keys::inertia)
          .add(window_fields(), &Keys::window);
  return made;
}

void build_pneumatic(const Section& s, Network& net, Messages& messages) {
  const auto motor = pneumatic_fields().read(s, messages);
  const int node = single_shaft(s, motor.inertia, net);
  const double power = motor.power, free_speed = motor.free_speed, stall = motor.stall_torque;
  const double number = power / (stall * free_speed);
  const double least = PneumaticMotor::power_number(-1), most = PneumaticMotor::power_number(1);
  if (number < least || number > most) {
    motor.refuse(
        &PneumaticKeys::stall_torque,
        fmt::format("stall_torque = {:.4g} N·m; must be {:.4g} … {:.4g} N·m for this power and free speed (a "
                    "straight line has {:.4g} N·m)",
                    stall, power / (most * free_speed), power / (least * free_speed), motor.straight_stall_torque()));
    return;
  }
  const bool bent = motor.given(&PneumaticKeys::stall_torque);
  net.put(node, s.name, PneumaticMotor{stall, free_speed, bent ? PneumaticMotor::bend_for(number) : 0}, motor.window);
}

}  // namespace

std::vector<Kind> fluid_motor_kinds() {
  return {
      {.name = "hydraulic motor",
       .doc = "hydraulic motor on a pump of constant flow with a relief valve: constant torque up to the flow-limited "
              "speed, then falling",
       .keys = hydraulic_fields().keys(),
       .build = build_hydraulic},
      {.name = "pneumatic motor",
       .doc = "air motor at constant supply pressure: nearly straight from stall torque to free speed",
       .keys = pneumatic_fields().keys(),
       .build = build_pneumatic},
  };
}

}  // namespace kurbel
