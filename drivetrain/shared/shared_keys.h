// shared_keys.h — keys and fields shared by several kinds of components.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/elements/element.h"
#include "engine/numerics/curve.h"
#include "engine/scene/fields.h"

namespace kurbel {

class Network;

Key inertia_key(const char* fallback, const char* doc);  // required where the fallback is empty
Key own_inertia_key();                                   // "0 kg*m2" unless given
Fields<Window> window_fields();                          // start, stop
const std::vector<std::string>& any_abscissa();          // time, angle, speed

// Adds a torque over time, angle or speed as the matching element; `refuse` receives the faults of its data.
struct TorqueCurve {
  const CurveData& data;
  double sign = 1;
  Account account = Account::driving;
  Window window = {};
};
void put_curve(Network& net, int node, const std::string& component, const TorqueCurve& torque,
               const std::function<void(const std::string&)>& refuse);

// One continuous shaft.
int single_shaft(const Section& section, double inertia, Network& net);

}  // namespace kurbel
