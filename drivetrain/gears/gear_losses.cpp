// gear_losses.cpp — the law of losses in words, with the numbers that matter to a user.
#include "drivetrain/gears/gear_losses.h"

#include <fmt/format.h>

namespace kurbel {

std::string GearEfficiency::describe(double ratio) const {
  std::string text =
      fmt::format("efficiency {:.4g} when the input drives, {:.4g} when the output drives", forwards, backwards);
  if (bearing_driving > 0 || bearing_driven > 0)
    text += fmt::format("; bearings {:.4g} and {:.4g} N·m on the input", bearing_driving, bearing_driven);
  if (self_locking())
    return text + fmt::format(
                      "; self-locking: at rest it holds any torque on the output; to move with a load on "
                      "the output it needs {:.4g} N·m on the input per N·m of the load",
                      -backwards / std::abs(ratio));
  const double held = bearing_driven * std::abs(ratio);
  if (held > 0) text += fmt::format("; without torque on the input it holds up to {:.4g} N·m on the output", held);
  return text;
}

}  // namespace kurbel
