// shared_keys.h — keys that several kinds of components share, and how they are read.
#pragma once

#include <string>
#include <vector>

#include "engine/elements/element.h"
#include "engine/numerics/curve.h"
#include "engine/scene/keys.h"

namespace kurbel {

class Network;

std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more);
const std::vector<Key>& window_keys();                   // start, stop
Key inertia_key(const char* fallback, const char* doc);  // required where the fallback is empty
Key own_inertia_key();                                   // "0 kg*m2" unless given
const std::vector<std::string>& any_abscissa();          // time, angle, speed

// What they mean together; faults go into the messages.
Window window_of(const Section& section, Messages& messages);
Account account_of(const Section& section, Account fallback);
Curve curve_of(const CurveData& data);

// A torque over time, angle or speed as the element that suits it.
void put_curve(Network& net, int node, const Section& section, const CurveData& data, double sign, Account account,
               Window window, Messages& messages);

// One shaft that passes through.
int single_shaft(const Section& section, Network& net);

}  // namespace kurbel
