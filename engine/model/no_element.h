// no_element.h — what a shaft element becomes that is gone without its effect: compile leaves it out.
#pragma once

#include "engine/elements/element.h"

namespace kurbel {

ShaftForm no_element();

}  // namespace kurbel
