// no_element.h — what `with` returns for a shaft element that is gone without its effect: compile leaves it out.
#pragma once

#include <memory>

#include "engine/model/network.h"

namespace kurbel {

std::shared_ptr<ShaftElementMaker> no_element();

}  // namespace kurbel
