// coupling_keys.h — keys that everything with two halves shares.
#pragma once

#include <vector>

#include "engine/keys.h"

namespace kurbel {

std::vector<Key> side_inertia_keys();    // inertia_in, inertia_out
Key application_factor_key();            // K_A
std::vector<Key> coupling_limit_keys();  // what kurbel modes judges by, K_A among them

}  // namespace kurbel
