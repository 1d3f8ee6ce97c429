// motor_kinds.cpp — motors by table.
#include "drivetrain/motors/kinds.h"

#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

void build_table_motor(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  put_curve(net, node, s, s["torque"].curve, 1, Account::driving, window_of(s, messages), messages);
}

}  // namespace

std::vector<Kind> motor_kinds() {
  return {
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
