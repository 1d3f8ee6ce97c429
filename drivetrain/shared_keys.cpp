// shared_keys.cpp — windows of time, damping in its four forms, curves.
#include "drivetrain/shared_keys.h"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>
#include <utility>

#include "drivetrain/torque_source.h"

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

const std::vector<Key>& damping_keys() {
  static const std::vector<Key> keys = {
      {.name = "damping",
       .unit = "N*m*s/rad",
       .domain = not_negative,
       .doc = "viscous damping c; one of the four forms"},
      {.name = "damping_ratio", .domain = not_negative, .doc = "ζ: c = 2 ζ k/ω_ref"},
      {.name = "relative_damping",
       .domain = not_negative,
       .doc = "ψ: energy lost in a cycle over greatest energy stored; c = ψ k/(2π ω_ref)"},
      {.name = "loss_factor", .domain = not_negative, .doc = "η: c = η k/ω_ref"},
      {.name = "damping_frequency",
       .unit = "Hz",
       .domain = positive,
       .doc = "ω_ref/2π of the three forms above; default: natural frequency of the two inertias joined"},
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

Damping damping_of(const Section& s, Messages& messages) {
  static const std::pair<const char*, Damping::As> forms[] = {{"damping", Damping::As::viscous},
                                                              {"damping_ratio", Damping::As::ratio},
                                                              {"relative_damping", Damping::As::relative},
                                                              {"loss_factor", Damping::As::loss_factor}};
  Damping damping;
  const char* first = nullptr;
  for (const auto& [key, as] : forms) {
    if (!s.given(key)) continue;
    if (first)
      messages.add(s.where(key),
                   fmt::format("{} \"{}\": \"{}\" and \"{}\" both given; keep one", s.kind->name, s.name, first, key));
    first = key;
    damping.as = as;
    damping.value = s.number(key);
  }
  if (s.given("damping_frequency") && (!first || damping.as == Damping::As::viscous))
    messages.add(s.where("damping_frequency"),
                 fmt::format("{} \"{}\": \"damping_frequency\" belongs to \"damping_ratio\", \"relative_damping\" or "
                             "\"loss_factor\"; none is given",
                             s.kind->name, s.name));
  damping.frequency = 2 * std::numbers::pi * s.number_or("damping_frequency", 0);
  return damping;
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
