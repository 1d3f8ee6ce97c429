// shared_keys.cpp — windows of time, inertias, curves.
#include "drivetrain/shared/shared_keys.h"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <stdexcept>

#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {

Key inertia_key(const char* fallback, const char* doc) {
  return {.name = "inertia",
          .unit = "kg*m2",
          .fallback = fallback,
          .domain = not_negative,
          .doc = doc,
          .required = *fallback == 0};
}

Key own_inertia_key() { return inertia_key("\"0 kg*m2\"", "inertia of its own shaft"); }

Fields<Window> window_fields() {
  return Fields<Window>()
      .add(quantity("start", "s", any_number, "acts from this time on; default: always"), &Window::start)
      .add(quantity("stop", "s", any_number, "acts until this time; default: always"), &Window::stop)
      .check([](const Reading<Window>& w) {
        if (w.given(&Window::start) && w.given(&Window::stop) && w.stop <= w.start)
          w.refuse(&Window::stop, fmt::format("stop = {:g} s; must be later than start = {:g} s", w.stop, w.start));
      });
}

const std::vector<std::string>& any_abscissa() {
  static const std::vector<std::string> names = {"time", "angle", "speed"};
  return names;
}

namespace {

constexpr double above_no_load = 0.05;  // of the no-load speed: so far the last slope of a drive counts as data

// A drive continues beyond its table along the last slope, where that falls; if it neither falls nor has come to 0, a motion
// that gets there is refused. Returns whether the first and the last point are no-load speeds: there it brakes beyond.
std::array<bool, 2> go_on_as_drive(Curve& curve) {
  const double first = curve.x().front(), last = curve.x().back();
  Beyond before = curve.beyond_first(), after = curve.beyond_last();
  std::array<bool, 2> no_load = {};
  if (last > 0 && curve.y().back() >= 0 && after == Beyond::unspecified) {
    if (curve.last_slope() < 0)
      curve.follow_last_slope(), no_load[1] = curve.y().back() == 0;
    else if (curve.y().back() > 0)
      after = Beyond::refuse;
  }
  if (first < 0 && curve.before() <= 0 && before == Beyond::unspecified) {
    if (curve.first_slope() < 0)
      curve.follow_first_slope(), no_load[0] = curve.before() == 0;
    else if (curve.before() < 0)
      before = Beyond::refuse;
  }
  curve.say(before, after);
  return no_load;
}

}  // namespace

void put_curve(Network& net, int node, const std::string& component, const TorqueCurve& torque,
               const std::function<void(const std::string&)>& refuse) {
  const auto& [data, sign, account, window] = torque;
  Curve curve = data.curve();
  using Over = Network::DataRange::Over;
  if (data.over == "time") {
    net.limit({.component = component, .of = "torque", .over = Over::time, .node = node, .unit = "s"}, curve);
    net.put(node, component, TorqueOverTime{account, curve, sign}, window);
  } else if (data.over == "speed") {
    if (data.period > 0) refuse("a table over speed has no period");
    const auto no_load = account == Account::driving ? go_on_as_drive(curve) : std::array<bool, 2>{};
    const std::size_t ranges = net.ranges.size();
    net.limit({.component = component, .of = "torque", .over = Over::speed, .node = node, .unit = "rad/s"}, curve);
    if (net.ranges.size() > ranges && (no_load[0] || no_load[1])) {
      Network::DataRange& range = net.ranges.back();
      range.of = "torque, which counts up to 5 % above no load,";
      if (no_load[0]) range.low *= 1 + above_no_load;
      if (no_load[1]) range.high *= 1 + above_no_load;
    }
    net.put(node, component, TorqueOverSpeed{account, curve, sign}, window);
  } else {
    CurveData closed = data;
    if (closed.period == 0) closed.period = 2 * std::numbers::pi;
    const double span = data.x.back() - data.x.front();
    if (span > closed.period * (1 + 1e-9))
      return refuse(
          fmt::format("a table over the angle spans {:.6g} deg, more than its period of {:.6g} deg; give "
                      "period = \"720 deg\" for two turns",
                      span * 180 / std::numbers::pi, closed.period * 180 / std::numbers::pi));
    try {
      net.put(node, component, TorqueOverAngle{account, closed.curve().over_angle(), sign}, window);
    } catch (const std::invalid_argument& error) {
      refuse(error.what());
    }
  }
}

int single_shaft(const Section& s, double inertia, Network& net) {
  const int node = net.add_node(s.name, "", inertia);
  net.ports[s.name] = {node, node};
  return node;
}

}  // namespace kurbel
