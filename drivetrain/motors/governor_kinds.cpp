// governor_kinds.cpp — drives that hold a speed.
#include <fmt/format.h>

#include "drivetrain/motors/governor.h"
#include "drivetrain/motors/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

void build_governor(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  const auto refuse = [&](const char* key, const std::string& text) {
    messages.add(s.where(key), fmt::format("governor \"{}\": {}", s.name, text));
  };
  SpeedGovernor g{.reference = s.number("speed"),
                  .proportional = s.number("proportional_gain"),
                  .integral = s.number("integral_gain"),
                  .droop = s.number("droop"),
                  .most = s.number("max_torque"),
                  .least = s.number("min_torque"),
                  .tracking_time = s.number_or("tracking_time", 0),
                  .initial_torque = s.number("initial_torque")};
  if (g.least >= g.most)
    refuse("min_torque", fmt::format("min_torque = {:g} N·m; must be below max_torque = {:g} N·m", g.least, g.most));
  if (g.proportional == 0 && g.integral == 0)
    refuse("proportional_gain", "proportional_gain and integral_gain are both 0: it governs nothing");
  if (!s.given("tracking_time")) {
    if (g.proportional == 0 && g.integral > 0)
      refuse("integral_gain", "without a proportional_gain it needs \"tracking_time\"");
    g.tracking_time = g.integral > 0 ? g.proportional / g.integral : 1;
  }
  net.put(node, s.name, g, window_of(s, messages));
}

}  // namespace

std::vector<Kind> governor_kinds() {
  return {
      {.name = "governor",
       .doc = "drive that holds a speed: proportional–integral on torque, with limits",
       .keys = joined(
           {{.name = "speed",
             .unit = "rad/s",
             .doc = "reference speed; an operating sequence sets its part",
             .required = true},
            {.name = "proportional_gain",
             .unit = "N*m*s/rad",
             .domain = not_negative,
             .doc = "K_p, torque per error of speed",
             .required = true},
            {.name = "integral_gain",
             .unit = "N*m/rad",
             .fallback = "\"0 N*m/rad\"",
             .domain = not_negative,
             .doc = "K_i, torque per error of angle"},
            {.name = "droop",
             .unit = "rad/s/N/m",
             .fallback = "\"0 rad/s/N/m\"",
             .domain = not_negative,
             .doc = "fall of the steady speed per torque"},
            {.name = "max_torque", .unit = "N*m", .doc = "upper limit of its torque", .required = true},
            {.name = "min_torque", .unit = "N*m", .fallback = "\"0 N*m\"", .doc = "lower limit; negative: it brakes"},
            {.name = "tracking_time",
             .unit = "s",
             .domain = positive,
             .doc = "at a limit the integral follows the torque within this time; default: K_p/K_i"},
            {.name = "initial_torque", .unit = "N*m", .fallback = "\"0 N*m\"", .doc = "integral at the start"},
            own_inertia_key()},
           window_keys()),
       .build = build_governor},
  };
}

}  // namespace kurbel
