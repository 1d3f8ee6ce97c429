// option_values.h — parsing of option values: "60 rpm", "step 2".
#pragma once

#include <optional>
#include <string>

#include "engine/orbit/moment.h"
#include "engine/scene/keys.h"

namespace kurbel {

// A quantity in SI from an option; the example shows its unit: quantity_of("--until", "3 s", "a time > 0", "3 s",
// positive). Throws std::invalid_argument with the reason.
double quantity_of(const std::string& option, const std::string& text, const std::string& what,
                   const std::string& example, const Domain& domain);

// After "step 2" of the operating sequence, at "1.5 s", or at a speed, which is stored in `speed` [rad/s]. Throws
// std::invalid_argument for anything else.
Moment moment_of(const std::string& option, const std::string& at, std::optional<double>& speed);

}  // namespace kurbel
