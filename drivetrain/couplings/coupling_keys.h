// coupling_keys.h — keys that everything with two halves shares, and how its damping is read.
#pragma once

#include <vector>

#include "drivetrain/couplings/coupling.h"
#include "engine/scene/keys.h"

namespace kurbel {

std::vector<Key> side_inertia_keys();    // inertia_in, inertia_out
Key application_factor_key();            // K_A
std::vector<Key> coupling_limit_keys();  // what kurbel modes judges by, K_A among them

const std::vector<Key>& damping_keys();  // damping in its four forms
// Faults go into the messages.
Damping damping_of(const Section& section, Messages& messages);

}  // namespace kurbel
