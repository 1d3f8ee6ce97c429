// source_kinds.cpp — torques and speeds that are given.
#include <fmt/format.h>

#include <stdexcept>

#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/shared_keys.h"
#include "drivetrain/shared/torque_source.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

// A constant that may rise from nothing, a sine and a table, of a torque or a speed.
struct SourceKeys {
  double constant = 0;                             // [N·m] or [rad/s]
  std::optional<double> ramp;                      // [s]
  double amplitude = 0, frequency = 0, phase = 0;  // [N·m] or [rad/s], [Hz], [rad]
  std::optional<CurveData> table;
  double inertia = 0;  // [kg·m²]
  Window window;
};

void check_rises(const Reading<SourceKeys>& s) {
  if (s.amplitude != 0 && s.frequency == 0)
    s.refuse(&SourceKeys::amplitude, "\"amplitude\" needs a \"frequency\" > 0, e.g. \"5 Hz\"");
  if (s.ramp && !s.given(&SourceKeys::constant))
    s.refuse(&SourceKeys::ramp,
             fmt::format("\"ramp\" needs \"{}\", the value it rises to", s.key(&SourceKeys::constant)));
}

// --- torque source ---

Fields<SourceKeys> torque_source_fields() {
  using Keys = SourceKeys;
  return Fields<Keys>()
      .add(defaulted("torque", "N*m", "0 N*m", any_number, "constant part M₀"), &Keys::constant)
      .add(quantity("ramp", "s", positive, "time over which the constant part rises from 0"), &Keys::ramp)
      .add(defaulted("amplitude", "N*m", "0 N*m", any_number, "of M₁ sin(2π f t + ψ)"), &Keys::amplitude)
      .add(defaulted("frequency", "Hz", "0 Hz", not_negative, "f"), &Keys::frequency)
      .add(defaulted("phase", "rad", "0 rad", any_number, "ψ"), &Keys::phase)
      .add(curve("table", any_abscissa(), "N*m", "torque over time, angle or speed"), &Keys::table)
      .add(own_inertia_key(), &Keys::inertia)
      .add(window_fields(), &Keys::window)
      .check([](const Reading<Keys>& s) {
        if (!s.given(&Keys::constant) && !s.given(&Keys::amplitude) && !s.table)
          s.refuse("nothing given; allowed: \"torque\", \"amplitude\" with \"frequency\", \"table\"");
      })
      .check(check_rises);
}

void build_torque_source(const Section& s, const Reading<SourceKeys>& source, Network& net) {
  const int node = single_shaft(s, source.inertia, net);
  const auto put_sine = [&](double mean) {
    if (mean != 0 || source.amplitude != 0)
      net.put(node, s.name, HarmonicTorque{Account::driving, mean, source.amplitude, source.frequency, source.phase},
              source.window);
  };
  if (source.ramp) {
    const double begin = source.window.start > Window{}.start ? source.window.start : 0;
    const Curve rise({begin, begin + *source.ramp}, {0, source.constant}, Curve::Form::linear);
    net.put(node, s.name, TorqueOverTime{Account::driving, rise, 1}, source.window);
    put_sine(0);
  } else {
    put_sine(source.constant);
  }
  if (source.table)
    put_curve(net, node, s.name, {*source.table, 1, Account::driving, source.window},
              [&](const std::string& text) { source.refuse(&SourceKeys::table, text); });
}

// --- prescribed speed ---

Fields<SourceKeys> prescribed_speed_fields() {
  using Keys = SourceKeys;
  return Fields<Keys>()
      .add(quantity("speed", "rad/s", any_number, "constant speed"), &Keys::constant)
      .add(quantity("ramp", "s", positive, "time over which it rises from 0"), &Keys::ramp)
      .add(defaulted("amplitude", "rad/s", "0 rad/s", any_number, "of an added sine"), &Keys::amplitude)
      .add(defaulted("frequency", "Hz", "0 Hz", not_negative, "of the sine"), &Keys::frequency)
      .add(defaulted("phase", "rad", "0 rad", any_number, "of the sine"), &Keys::phase)
      .add(curve("table", {"time"}, "rad/s", "speed over time"), &Keys::table)
      .add(own_inertia_key(), &Keys::inertia);
}

void build_prescribed_speed(const Section& s, const Reading<SourceKeys>& source, Network& net) {
  const int node = single_shaft(s, source.inertia, net);
  const bool constant = source.given(&SourceKeys::constant);
  if (source.table && constant) {
    source.refuse(&SourceKeys::table, "\"speed\" and \"table\" both given; keep one");
    return;
  }
  if (!source.table && !constant) {
    source.refuse("\"speed\" is missing; give it, or \"table\"");
    return;
  }
  check_rises(source);
  PrescribedSpeed given;
  given.amplitude = source.amplitude;
  given.frequency = source.frequency;
  given.phase = source.phase;
  if (source.table) {
    try {
      given.law = source.table->curve();
    } catch (const std::invalid_argument& error) {
      source.refuse(&SourceKeys::table, error.what());
      return;
    }
    net.limit({.component = s.name, .of = "speed", .over = Network::DataRange::Over::time, .node = node, .unit = "s"},
              given.law);
    if (given.law.jumps()) {
      source.refuse(&SourceKeys::table, "a speed that jumps would take an infinite torque; let it rise within a time");
      return;
    }
    if (given.law.form() == Curve::Form::linear && given.law.period() == 0) {
      given.time = given.law.x();
      given.speed = given.law.y();
      given.law = {};
    }
  } else if (source.ramp) {
    given.time = {0, *source.ramp};
    given.speed = {0, source.constant};
  } else {
    given.time = {0};
    given.speed = {source.constant};
  }
  net.prescribe(node, given);
}

}  // namespace

std::vector<Kind> source_kinds() {
  return {
      kind_of<torque_source_fields, build_torque_source>(on_a_shaft, "torque source",
                                                         "torque as constant, ramp, sine or table"),
      kind_of<prescribed_speed_fields, build_prescribed_speed>(
          on_a_shaft, "prescribed speed", "speed as constant, ramp, sine or table, whatever torque that takes"),
  };
}

}  // namespace kurbel
