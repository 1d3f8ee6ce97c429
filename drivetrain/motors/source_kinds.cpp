// source_kinds.cpp — torques and speeds that are given.
#include "drivetrain/motors/kinds.h"

#include <fmt/format.h>

#include "drivetrain/shared/shared_keys.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

void build_torque_source(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  Window window = window_of(s, messages);
  const double torque = s.number("torque"), amplitude = s.number("amplitude"), frequency = s.number("frequency");
  if (!s.given("torque") && !s.given("amplitude") && !s.has("table"))
    messages.add(
        s.at,
        fmt::format(
            "torque source \"{}\": nothing given; allowed: \"torque\", \"amplitude\" with \"frequency\", \"table\"",
            s.name));
  if (amplitude != 0 && frequency == 0)
    messages.add(s.where("amplitude"),
                 fmt::format("torque source \"{}\": \"amplitude\" needs a \"frequency\" > 0, e.g. \"5 Hz\"", s.name));
  if (s.given("ramp") && !s.given("torque"))
    messages.add(s.where("ramp"),
                 fmt::format("torque source \"{}\": \"ramp\" needs \"torque\", the value it rises to", s.name));
  if (s.given("ramp")) {
    const double begin = s.given("start") ? window.start : 0;
    net.put(
        node, s.name,
        TorqueOverTime{Account::driving, Curve({begin, begin + s.number("ramp")}, {0, torque}, Curve::Form::linear), 1},
        window);
    if (amplitude != 0)
      net.put(node, s.name, HarmonicTorque{Account::driving, 0, amplitude, frequency, s.number("phase")}, window);
  } else if (torque != 0 || amplitude != 0) {
    net.put(node, s.name, HarmonicTorque{Account::driving, torque, amplitude, frequency, s.number("phase")}, window);
  }
  if (s.has("table")) put_curve(net, node, s, s["table"].curve, 1, Account::driving, window, messages);
}

void build_prescribed_speed(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  PrescribedSpeed given;
  if (s.has("table") == s.given("speed")) {
    if (s.has("table"))
      messages.add(s.where("table"),
                   fmt::format("prescribed speed \"{}\": \"speed\" and \"table\" both given; keep one", s.name));
    if (!s.has("table"))
      messages.add(s.at, fmt::format("prescribed speed \"{}\": \"speed\" is missing; give it, or \"table\"", s.name));
    return;
  }
  if (s.number("amplitude") != 0 && s.number("frequency") == 0)
    messages.add(
        s.where("amplitude"),
        fmt::format("prescribed speed \"{}\": \"amplitude\" needs a \"frequency\" > 0, e.g. \"5 Hz\"", s.name));
  if (s.given("ramp") && !s.given("speed"))
    messages.add(s.where("ramp"),
                 fmt::format("prescribed speed \"{}\": \"ramp\" needs \"speed\", the value it rises to", s.name));
  if (s.has("table")) {
    const CurveData& data = s["table"].curve;
    if (data.form == Curve::Form::smooth || data.period > 0)
      messages.add(s.where("table"),
                   fmt::format("prescribed speed \"{}\": only linear tables without a period are allowed", s.name));
    given.time = data.x;
    given.speed = data.y;
  } else if (s.given("ramp")) {
    given.time = {0, s.number("ramp")};
    given.speed = {0, s.number("speed")};
  } else {
    given.time = {0};
    given.speed = {s.number("speed")};
  }
  given.amplitude = s.number("amplitude");
  given.frequency = s.number("frequency");
  given.phase = s.number("phase");
  net.prescribe(node, given);
}

}  // namespace

std::vector<Kind> source_kinds() {
  return {
      {.name = "torque source",
       .doc = "torque as constant, ramp, sine or table",
       .keys = joined(
           {{.name = "torque", .unit = "N*m", .fallback = "\"0 N*m\"", .doc = "constant part M₀"},
            {.name = "ramp", .unit = "s", .domain = positive, .doc = "time over which the constant part rises from 0"},
            {.name = "amplitude", .unit = "N*m", .fallback = "\"0 N*m\"", .doc = "of M₁ sin(2π f t + ψ)"},
            {.name = "frequency", .unit = "Hz", .fallback = "\"0 Hz\"", .domain = not_negative, .doc = "f"},
            {.name = "phase", .unit = "rad", .fallback = "\"0 rad\"", .doc = "ψ"},
            {.name = "table",
             .type = KeyType::curve,
             .unit = "N*m",
             .doc = "torque over time, angle or speed",
             .choices = any_abscissa()},
            own_inertia_key()},
           window_keys()),
       .build = build_torque_source},
      {.name = "prescribed speed",
       .doc = "speed as constant, ramp, sine or table, whatever torque that takes",
       .keys =
           {{.name = "speed", .unit = "rad/s", .doc = "constant speed"},
            {.name = "ramp", .unit = "s", .domain = positive, .doc = "time over which it rises from 0"},
            {.name = "amplitude", .unit = "rad/s", .fallback = "\"0 rad/s\"", .doc = "of an added sine"},
            {.name = "frequency", .unit = "Hz", .fallback = "\"0 Hz\"", .domain = not_negative, .doc = "of the sine"},
            {.name = "phase", .unit = "rad", .fallback = "\"0 rad\"", .doc = "of the sine"},
            {.name = "table", .type = KeyType::curve, .unit = "rad/s", .doc = "speed over time", .choices = {"time"}},
            own_inertia_key()},
       .build = build_prescribed_speed},
  };
}

}  // namespace kurbel
