// variant_motors.h — motors from catalogue data give way to others of their power and speed.
#pragma once

#include <string>

#include "tests/coverage/variant_text.h"

namespace kurbel::coverage {

// Of every three induction motors given by catalogue data alone, two stay as they are; the others become two-axis
// circuits, DC shunt motors or characteristics by points.
std::string with_other_motors(const std::string& text, const std::string& file, Dice& dice);

}  // namespace kurbel::coverage
