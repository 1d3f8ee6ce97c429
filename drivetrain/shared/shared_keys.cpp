// shared_keys.cpp — windows of time, inertias, curves.
#include "drivetrain/shared/shared_keys.h"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>
#include <utility>

#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {

std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

const std::vector<Key>& window_keys() {
  static const std::vector<Key> keys = {
      {.name = "start", .unit = "s", .doc = "acts from this time on; default: always"},
      {.name = "stop", .unit = "s", .doc = "acts until this time; default: always"},
  };
  return keys;
}

Key inertia_key(const char* fallback, const char* doc) {
  return {.name = "inertia",
          .unit = "kg*m2",
          .fallback = fallback,
          .domain = not_negative,
          .doc = doc,
          .required = *fallback == 0};
}

Key own_inertia_key() { return inertia_key("\"0 kg*m2\"", "inertia of its own shaft"); }

const std::vector<std::string>& any_abscissa() {
  static const std::vector<std::string> names = {"time", "angle", "speed"};
  return names;
}

Window window_of(const Section& s, Messages& messages) {
  Window window;
  window.start = s.number_or("start", window.start);
  window.stop = s.number_or("stop", window.stop);
  if (s.given("start") && s.given("stop") && window.stop <= window.start)
    messages.add(s.where("stop"), fmt::format("{} \"{}\": stop = {:g} s; must be later than start = {:g} s",
                                              s.kind->name, s.name, window.stop, window.start));
  return window;
}

Account account_of(const Section& s, Account fallback) {
  if (!s.has("work")) return fallback;
  const std::string& name = s.text("work");
  return name == "driving" ? Account::driving : name == "harmful" ? Account::harmful : Account::useful;
}

Curve curve_of(const CurveData& data) { return Curve(data.x, data.y, data.form, data.period); }

void put_curve(Network& net, int node, const Section& s, const CurveData& data, double sign, Account account,
               Window window, Messages& messages) {
  const Curve curve = curve_of(data);
  const Location where = s.where(s.has("table") ? "table" : "torque");
  if (data.over == "time") {
    net.put(node, s.name, TorqueOverTime{account, curve, sign}, window);
  } else if (data.over == "speed") {
    if (data.period > 0)
      messages.add(where, fmt::format("{} \"{}\": a table over speed has no period", s.kind->name, s.name));
    net.put(node, s.name, TorqueOverSpeed{account, curve, sign}, window);
  } else {
    CurveData closed = data;
    if (closed.period == 0) closed.period = 2 * std::numbers::pi;
    const double span = data.x.back() - data.x.front();
    if (span > closed.period * (1 + 1e-9)) {
      messages.add(where, fmt::format("{} \"{}\": a table over the angle spans {:.6g} deg, more than its period of "
                                      "{:.6g} deg; give period = \"720 deg\" for two turns",
                                      s.kind->name, s.name, span * 180 / std::numbers::pi,
                                      closed.period * 180 / std::numbers::pi));
      return;
    }
    try {
      net.put(node, s.name, TorqueOverAngle{account, curve_of(closed), sign}, window);
    } catch (const std::invalid_argument& error) {
      messages.add(where, fmt::format("{} \"{}\": {}", s.kind->name, s.name, error.what()));
    }
  }
}

int single_shaft(const Section& s, Network& net) {
  const int node = net.add_node(s.name, "", s.number_or("inertia", 0));
  net.ports[s.name] = {node, node};
  return node;
}

}  // namespace kurbel
