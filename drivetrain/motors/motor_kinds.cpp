// motor_kinds.cpp — motors by table.
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct MotorKeys {
  CurveData torque;    // over speed [N·m]
  double inertia = 0;  // [kg·m²]
  Window window;
};
Fields<MotorKeys> motor_fields() {
  return Fields<MotorKeys>()
      .add(required_curve("torque", {"speed"}, "N*m", "characteristic over speed"), &MotorKeys::torque)
      .add(inertia_key("", "rotor inertia"), &MotorKeys::inertia)
      .add(window_fields(), &MotorKeys::window);
}

void build_table_motor(const Section& s, const Reading<MotorKeys>& motor, Network& net) {
  put_curve(net, single_shaft(s, motor.inertia, net), s.name, {motor.torque, 1, Account::driving, motor.window},
            [&](const std::string& text) { motor.refuse(&MotorKeys::torque, text); });
}

}  // namespace

std::vector<Kind> motor_kinds() {
  return {
      kind_of<motor_fields, build_table_motor>(on_a_shaft, "motor", "motor, turbine or hydraulic drive by table M(ω)"),
  };
}

}  // namespace kurbel
