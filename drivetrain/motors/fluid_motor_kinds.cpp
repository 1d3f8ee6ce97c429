// fluid_motor_kinds.cpp — hydraulic and pneumatic drives by their characteristics.
#include <fmt/format.h>

#include "drivetrain/motors/fluid_motors.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct HydraulicKeys : HydraulicMotor {
  double inertia = 0;  // [kg·m²]
  Window window;
};

Fields<HydraulicKeys> hydraulic_fields() {
  using Keys = HydraulicKeys;
  return Fields<Keys>()
      .add(required("displacement", "m3/rad", positive, "e.g. 80 cm3/rev"), &Keys::displacement)
      .add(required("pressure_difference", "Pa", positive, "over the motor when the relief valve opens"),
           &Keys::relief_pressure)
      .add(required("flow", "m3/s", positive, "of the pump, e.g. 40 l/min"), &Keys::flow)
      .add(defaulted("volumetric_efficiency", "", "0.95", {.low = 0, .high = 1, .low_open = true, .high_open = true},
                     "η_v at that pressure and the flow-limited speed; the rest leaks in proportion to the pressure"),
           &Keys::volumetric_efficiency)
      .add(defaulted("hydromechanical_efficiency", "", "0.9", {.low = 0, .high = 1, .low_open = true},
                     "η_hm, of the torque"),
           &Keys::hydromechanical_efficiency)
      .add(defaulted("relief_rise", "Pa", "0 bar", not_negative,
                     "by which the pressure rises until the relief valve passes the whole flow"),
           &Keys::relief_rise)
      .add(inertia_key("", "rotor inertia"), &Keys::inertia)
      .add(window_fields(), &Keys::window);
}

void build_hydraulic(const Section& s, const Reading<HydraulicKeys>& motor, Network& net) {
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

Fields<PneumaticKeys> pneumatic_fields() {
  using Keys = PneumaticKeys;
  return Fields<Keys>()
      .add(required("max_power", "W", positive, "greatest power"), &Keys::power)
      .add(required("free_speed", "rad/s", positive, "speed without load"), &Keys::free_speed)
      .add(quantity("stall_torque", "N*m", positive,
                    "at standstill; bends the line to pass max_power. Default: that of a straight line, 4 "
                    "max_power/free_speed"),
           &Keys::stall_torque, &Keys::straight_stall_torque)
      .add(inertia_key("", "rotor inertia"), &Keys::inertia)
      .add(window_fields(), &Keys::window);
}

void build_pneumatic(const Section& s, const Reading<PneumaticKeys>& motor, Network& net) {
  const int node = single_shaft(s, motor.inertia, net);
  const double power = motor.power, free_speed = motor.free_speed, stall = motor.stall_torque;
  const double number = power / (stall * free_speed);
  const double least = PneumaticMotor::power_number(-1), most = PneumaticMotor::power_number(1);
  if (number < least || number > most) {
    motor.refuse(
        &PneumaticKeys::stall_torque,
        fmt::format("stall_torque = {:.4g} N·m; must be {:.4g} … {:.4g} N·m for this power and free speed (a straight "
                    "line has {:.4g} N·m)",
                    stall, power / (most * free_speed), power / (least * free_speed), motor.straight_stall_torque()));
    return;
  }
  const bool bent = motor.given(&PneumaticKeys::stall_torque);
  net.put(node, s.name, PneumaticMotor{stall, free_speed, bent ? PneumaticMotor::bend_for(number) : 0}, motor.window);
}

}  // namespace

std::vector<Kind> fluid_motor_kinds() {
  return {
      kind_of<hydraulic_fields, build_hydraulic>(on_a_shaft, "hydraulic motor",
                                                 "hydraulic motor on a pump of constant flow with a relief valve: "
                                                 "constant torque up to the flow-limited speed, then falling"),
      kind_of<pneumatic_fields, build_pneumatic>(
          on_a_shaft, "pneumatic motor",
          "air motor at constant supply pressure: nearly straight from stall torque to free speed"),
  };
}

}  // namespace kurbel
