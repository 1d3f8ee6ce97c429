// governor_kinds.cpp — drives that hold a speed.
#include <fmt/format.h>

#include "drivetrain/motors/governor.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

struct GovernorKeys : SpeedGovernor {
  double inertia = 0;  // [kg·m²]
  Window window;
};

void check_governor(const Reading<GovernorKeys>& g) {
  using Keys = GovernorKeys;
  if (g.least >= g.most)
    g.refuse(&Keys::least, fmt::format("min_torque = {:g} N·m; must be below max_torque = {:g} N·m", g.least, g.most));
  if (g.proportional == 0 && g.integral == 0)
    g.refuse(&Keys::proportional, "proportional_gain and integral_gain are both 0: it governs nothing");
  if (!g.given(&Keys::tracking_time) && g.proportional == 0 && g.integral > 0)
    g.refuse(&Keys::integral, "without a proportional_gain it needs \"tracking_time\"");
}

Fields<GovernorKeys> governor_fields() {
  using Keys = GovernorKeys;
  return Fields<Keys>()
      .add(required("speed", "rad/s", any_number, "reference speed; an operating sequence sets its part"),
           &Keys::reference)
      .add(required("proportional_gain", "N*m*s/rad", not_negative, "K_p, torque per error of speed"),
           &Keys::proportional)
      .add(defaulted("integral_gain", "N*m/rad", "0 N*m/rad", not_negative, "K_i, torque per error of angle"),
           &Keys::integral)
      .add(defaulted("droop", "rad/s/N/m", "0 rad/s/N/m", not_negative, "fall of the steady speed per torque"),
           &Keys::droop)
      .add(required("max_torque", "N*m", any_number, "upper limit of its torque"), &Keys::most)
      .add(defaulted("min_torque", "N*m", "0 N*m", any_number, "lower limit; negative: it brakes"), &Keys::least)
      .add(quantity("tracking_time", "s", positive,
                    "at a limit the integral follows the torque within this time; default: K_p/K_i"),
           &Keys::tracking_time, [](const Keys& g) { return g.integral > 0 ? g.proportional / g.integral : 1; })
      .add(defaulted("initial_torque", "N*m", "0 N*m", any_number, "integral at the start"), &Keys::initial_torque)
      .add(own_inertia_key(), &Keys::inertia)
      .add(window_fields(), &Keys::window)
      .check(check_governor);
}

void build_governor(const Section& s, const Reading<GovernorKeys>& governor, Network& net) {
  net.put(single_shaft(s, governor.inertia, net), s.name, static_cast<const SpeedGovernor&>(governor), governor.window);
}

}  // namespace

std::vector<Kind> governor_kinds() {
  return {
      kind_of<governor_fields, build_governor>(
          on_a_shaft, "governor", "drive that holds a speed: proportional–integral on torque, with limits"),
  };
}

}  // namespace kurbel
