// gear_train_keys.cpp — efficiencies of a gear, from its keys to its law of losses.
#include "drivetrain/gears/gear_train_keys.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/model/network.h"

namespace kurbel {

const std::vector<Key>& efficiency_keys() {
  static const std::vector<Key> keys = {
      {.name = "efficiency",
       .domain = {.low = 0, .high = 1, .low_open = true},
       .doc = "η, whichever side drives",
       .effect = "gear_losses"},
      {.name = "efficiency_forwards",
       .domain = {.low = 0, .high = 1, .low_open = true},
       .doc = "η₁ when the input drives, in place of efficiency",
       .effect = "gear_losses"},
      {.name = "efficiency_backwards",
       .domain = {.high = 1},
       .doc = "η₂ when the output drives; ≤ 0: self-locking",
       .effect = "gear_losses"},
      {.name = "bearing_torque",
       .unit = "N*m",
       .domain = not_negative,
       .doc = "friction of the bearings b₁ on the input shaft while the input drives",
       .effect = "gear_losses"},
      {.name = "bearing_torque_backwards",
       .unit = "N*m",
       .domain = not_negative,
       .doc = "b₂ on the input shaft while the output drives; default: b₁",
       .effect = "gear_losses"},
  };
  return keys;
}

bool gives_efficiency(const Section& section) {
  return std::any_of(efficiency_keys().begin(), efficiency_keys().end(),
                     [&](const Key& key) { return section.given(key.name); });
}

GearEfficiency efficiency_of(const Section& s, const std::string& what, Messages& messages) {
  if (s.given("efficiency"))
    for (const char* key : {"efficiency_forwards", "efficiency_backwards"})
      if (s.given(key))
        messages.add(s.where(key), fmt::format("{}: \"efficiency\" and \"{}\" both given; keep one", what, key));
  const double both = s.number_or("efficiency", 1);
  GearEfficiency e;
  e.forwards = s.number_or("efficiency_forwards", both);
  e.backwards = s.number_or("efficiency_backwards", both);
  e.bearing_driving = s.number_or("bearing_torque", 0);
  e.bearing_driven = s.number_or("bearing_torque_backwards", e.bearing_driving);
  if (e.bearing_driven != e.bearing_driving && (e.self_locking() || (e.forwards == 1 && e.backwards == 1)))
    messages.add(s.where("bearing_torque_backwards"),
                 fmt::format("{}: bearing_torque_backwards = {:g} N·m; must equal bearing_torque = {:g} N·m where the "
                             "gear {}; leave it out",
                             what, e.bearing_driven, e.bearing_driving,
                             e.self_locking() ? "locks itself" : "has no other losses"));
  return e;
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
