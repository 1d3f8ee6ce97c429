// shared_keys.h — keys and fields that several kinds of components share.
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

// A torque over time, angle or speed as the element that suits it, and what is wrong with it goes to `refuse`.
struct TorqueCurve {
  const CurveData& data;
  double sign = 1;
  Account account = Account::driving;
  Window window = {};
};
void put_curve(Network& net, int node, const std::string& component, const TorqueCurve& torque,
               const std::function<void(const std::string&)>& refuse);

// One shaft that passes through.
int single_shaft(const Section& section, double inertia, Network& net);

}  // namespace kurbel
