// gear_train_keys.cpp — efficiencies of a gear, from its keys to its law of losses.
#include "drivetrain/gears/gear_train_keys.h"

#include <fmt/format.h>

#include "engine/model/network.h"

namespace kurbel {

namespace {

void check_efficiency(const Reading<EfficiencyKeys>& e) {
  using Keys = EfficiencyKeys;
  e.keep_one(&Keys::both, &Keys::forwards);
  e.keep_one(&Keys::both, &Keys::backwards);
  if (e.bearing_driven != e.bearing_driving && (e.self_locking() || (e.forwards == 1 && e.backwards == 1)))
    e.refuse(
        &Keys::bearing_driven,
        fmt::format("bearing_torque_backwards = {:g} N·m; must equal bearing_torque = {:g} N·m where the gear {}; "
                    "leave it out",
                    e.bearing_driven, e.bearing_driving, e.self_locking() ? "is self-locking" : "has no other losses"));
}

}  // namespace

const Fields<EfficiencyKeys>& efficiency_fields() {
  using Keys = EfficiencyKeys;
  const auto of_both = [](const Keys& e) { return e.both.value_or(1); };
  static const auto made =
      Fields<Keys>()
          .add(quantity("efficiency", "", {.low = 0, .high = 1, .low_open = true}, "η, whichever side drives",
                        "gear_losses"),
               &Keys::both)
          .add(quantity("efficiency_forwards", "", {.low = 0, .high = 1, .low_open = true},
                        "η₁ when the input drives, in place of efficiency", "gear_losses"),
               &Keys::forwards, of_both)
          .add(quantity("efficiency_backwards", "", {.high = 1}, "η₂ when the output drives; ≤ 0: self-locking",
                        "gear_losses"),
               &Keys::backwards, of_both)
          .add(quantity("bearing_torque", "N*m", not_negative,
                        "friction of the bearings b₁ on the input shaft while the input drives", "gear_losses"),
               &Keys::bearing_driving)
          .add(quantity("bearing_torque_backwards", "N*m", not_negative,
                        "b₂ on the input shaft while the output drives; default: b₁", "gear_losses"),
               &Keys::bearing_driven, &Keys::bearing_driving)
          .check(check_efficiency);
  return made;
}

void join_gear(Network& net, int a, int b, double ratio, const std::string& component, const GearEfficiency* losses) {
  if (!losses) return net.join(a, b, ratio, component);
  net.relate({.node = {a, b, -1},
              .gain = {1, -ratio, 0},
              .usual = {1, 1 / ratio, 0},
              .component = component,
              .lossy = true,
              .loss = losses->law(),
              .words = losses->describe(ratio)});
}

}  // namespace kurbel
