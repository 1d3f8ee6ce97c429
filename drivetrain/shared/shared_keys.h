// shared_keys.h — keys that several kinds of components share, and how they are read.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/model/network.h"
#include "engine/numerics/curve.h"
#include "engine/scene/fields.h"

namespace kurbel {

Key inertia_key(const char* fallback, const char* doc);  // required where the fallback is empty
Key own_inertia_key();                                   // "0 kg*m2" unless given
const Fields<Window>& window_fields();                   // start, stop
const std::vector<std::string>& any_abscissa();          // time, angle, speed

Curve curve_of(const CurveData& data);

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
// TEMPORARY
namespace kurbel {
inline std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}
inline const std::vector<Key>& window_keys() { return window_fields().keys(); }
inline Window window_of(const Section& s, Messages& m) { return window_fields().read(s, m); }
inline int single_shaft(const Section& s, Network& net) { return single_shaft(s, s.number_or("inertia", 0), net); }
}  // namespace kurbel
