// induction_kinds.cpp — induction motors from catalogue data or by their circuit, and how they are started.
#include "drivetrain/motors/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "drivetrain/motors/catalogue_motor.h"
#include "drivetrain/motors/induction_circuit.h"
#include "drivetrain/motors/motors.h"
#include "drivetrain/motors/started_motor.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

double in_rpm(double speed) { return speed * 30 / std::numbers::pi; }

// From a catalogue: ratios are torques over the rated torque.
struct CatalogueKeys {
  std::optional<double> rated_power, rated_speed, synchronous_speed, breakdown_ratio;  // [W], [rad/s]
  double resistance_ratio = 0;                                                         // a = R_s/R_r′
  double voltage_factor = 1;                                                           // over the rated voltage
  std::optional<double> starting_ratio, pull_up_ratio, pull_up_speed, breakdown_speed;
};
// Of the two-axis model: X in Ω at the frequency, of one phase.
struct CircuitKeys {
  std::optional<double> frequency;  // [Hz]
  double magnetising_ratio = 30;    // X_m over X_s = X_r
  std::optional<double> voltage;    // line to line [V]
  std::optional<int> pole_pairs;
  std::optional<double> stator_resistance, rotor_resistance, stator_reactance, rotor_reactance, magnetising_reactance;
};
enum class Starting { direct, star_delta, soft_start, frequency_converter };
struct StartingKeys {
  Starting starting = Starting::direct;
  std::optional<double> switch_time, switch_speed;   // [s], [rad/s]
  double pause = 0;                                  // [s]
  std::optional<double> ramp;                        // [s]
  double initial_voltage = 0.3;                      // u₀
  std::optional<double> target_speed, torque_limit;  // [rad/s], [N·m]
};
struct MotorKeys : CatalogueKeys, CircuitKeys, StartingKeys {
  double inertia = 0;  // [kg·m²]
  Window window;
};
using Motor = Reading<MotorKeys>;
using Keys = MotorKeys;

const Words<Starting>& methods() {
  static const Words<Starting> words = {{"direct", Starting::direct},
                                        {"star-delta", Starting::star_delta},
                                        {"soft start", Starting::soft_start},
                                        {"frequency converter", Starting::frequency_converter}};
  return words;
}
const char* name_of(Starting method) { return methods()[static_cast<std::size_t>(method)].first; }

Fields<MotorKeys> catalogue_fields() {
  return Fields<MotorKeys>()
      .add({.name = "rated_power", .unit = "W", .domain = positive, .doc = "shaft power P_n"}, &Keys::rated_power)
      .add({.name = "rated_speed", .unit = "rad/s", .domain = positive, .doc = "speed ω_n at rated power"},
           &Keys::rated_speed)
      .add({.name = "synchronous_speed", .unit = "rad/s", .domain = positive, .doc = "ω_s, e.g. 1500 rpm"},
           &Keys::synchronous_speed)
      .add({.name = "breakdown_ratio", .domain = {.low = 1, .low_open = true}, .doc = "breakdown over rated torque ν"},
           &Keys::breakdown_ratio)
      .add({.name = "resistance_ratio",
            .fallback = "0.0",
            .domain = not_negative,
            .doc = "a = R_s/R_r′ in Kloss' formula; > 0 with frequency (cage motors: about 1)"},
           &Keys::resistance_ratio)
      .add({.name = "voltage_factor",
            .fallback = "1.0",
            .domain = positive,
            .doc = "voltage over rated voltage; torque goes with its square"},
           &Keys::voltage_factor)
      .add({.name = "starting_ratio",
            .domain = positive,
            .doc = "locked-rotor over rated torque; with it a smooth curve through the catalogue's points replaces "
                   "Kloss'"},
           &Keys::starting_ratio)
      .add({.name = "pull_up_ratio", .domain = positive, .doc = "least torque before breakdown over the rated one"},
           &Keys::pull_up_ratio)
      .add({.name = "pull_up_speed", .unit = "rad/s", .domain = positive, .doc = "where that is"}, &Keys::pull_up_speed)
      .add({.name = "breakdown_speed",
            .unit = "rad/s",
            .domain = positive,
            .doc = "speed of the breakdown torque, with starting_ratio; default: that of Kloss"},
           &Keys::breakdown_speed);
}

void add_circuit(Fields<MotorKeys>& fields) {
  const auto ohms = [](const char* name, const char* doc) {
    return Key{.name = name, .unit = "Ohm", .domain = positive, .doc = doc};
  };
  fields
      .add({.name = "frequency",
            .unit = "Hz",
            .domain = positive,
            .doc = "of the mains; with it the motor is its two-axis circuit, currents as states",
            .effect = "transients"},
           &Keys::frequency)
      .add({.name = "magnetising_ratio",
            .fallback = "30",
            .domain = {.low = 3, .high = 1000},
            .doc = "X_m over X_s = X_r of the circuit that stands for catalogue data"},
           &Keys::magnetising_ratio)
      .add({.name = "voltage",
            .unit = "V",
            .domain = positive,
            .doc = "line to line; with frequency and the following in place of catalogue data"},
           &Keys::voltage)
      .add({.name = "pole_pairs", .domain = {.low = 1, .high = 100}, .doc = "p"}, &Keys::pole_pairs)
      .add({.name = "stator_resistance", .unit = "Ohm", .domain = not_negative, .doc = "R_s of one phase"},
           &Keys::stator_resistance)
      .add(ohms("rotor_resistance", "R_r, referred to the stator"), &Keys::rotor_resistance)
      .add(ohms("stator_reactance", "leakage X_s at the frequency"), &Keys::stator_reactance)
      .add(ohms("rotor_reactance", "leakage X_r, referred to the stator"), &Keys::rotor_reactance)
      .add(ohms("magnetising_reactance", "X_m"), &Keys::magnetising_reactance);
}

void add_starting(Fields<MotorKeys>& fields) {
  fields
      .add({.name = "starting",
            .fallback = "\"direct\"",
            .doc = "how it is brought up to speed; times count from its `start`"},
           &Keys::starting, methods())
      .add({.name = "switch_time", .unit = "s", .domain = not_negative, .doc = "star to delta at this time"},
           &Keys::switch_time)
      .add({.name = "switch_speed", .unit = "rad/s", .domain = positive, .doc = "star to delta at this speed"},
           &Keys::switch_speed)
      .add({.name = "pause",
            .unit = "s",
            .fallback = "\"0 s\"",
            .domain = not_negative,
            .doc = "between star and delta, without torque"},
           &Keys::pause)
      .add({.name = "ramp",
            .unit = "s",
            .domain = positive,
            .doc = "time of soft start, or of the frequency's rise from zero"},
           &Keys::ramp)
      .add({.name = "initial_voltage",
            .fallback = "0.3",
            .domain = {.low = 0, .high = 1},
            .doc = "u₀ of a soft start, over the rated voltage"},
           &Keys::initial_voltage)
      .add({.name = "target_speed",
            .unit = "rad/s",
            .domain = positive,
            .doc = "synchronous speed that the frequency converter rises to; default: synchronous_speed. Above it the "
                   "field weakens"},
           &Keys::target_speed)
      .add({.name = "torque_limit",
            .unit = "N*m",
            .domain = positive,
            .doc = "of soft start or frequency converter, in both directions; default: none"},
           &Keys::torque_limit);
}

const Fields<MotorKeys>& motor_fields() {
  static const auto made = [] {
    Fields<MotorKeys> fields = catalogue_fields();
    add_circuit(fields);
    add_starting(fields);
    return fields.add(inertia_key("", "rotor inertia"), &Keys::inertia).add(window_fields(), &Keys::window);
  }();
  return made;
}

// One speed must lie below another.
template <class M, class B>
bool below(const Motor& m, M B::*member, double speed, const char* other, double limit) {
  return speed < limit || m.refuse(member, fmt::format("{} = {:.6g} rpm; must be below {} = {:.6g} rpm", m.key(member),
                                                       in_rpm(speed), other, in_rpm(limit)));
}

// Speeds and torques of the catalogue's points must follow each other as they do on a motor's curve.
bool points_fit(const Motor& m, double breakdown_speed) {
  bool fit = below(m, &Keys::breakdown_speed, breakdown_speed, "rated_speed", *m.rated_speed);
  if (m.given(&Keys::resistance_ratio))
    fit = m.refuse(&Keys::resistance_ratio,
                   "\"resistance_ratio\" belongs to Kloss' formula; with \"starting_ratio\" the points give the curve");
  if (breakdown_speed <= 0)
    fit = m.refuse(&Keys::breakdown_speed, fmt::format("breakdown_speed = {:.6g} rpm by these data; give it, > 0 rpm",
                                                       in_rpm(breakdown_speed)));
  if (m.pull_up_ratio.has_value() != m.pull_up_speed.has_value())
    return m.refuse(m.pull_up_ratio ? &Keys::pull_up_ratio : &Keys::pull_up_speed,
                    "give both \"pull_up_ratio\" and \"pull_up_speed\", or neither");
  if (m.pull_up_ratio) {
    fit = below(m, &Keys::pull_up_speed, *m.pull_up_speed, "breakdown_speed", breakdown_speed) && fit;
    for (const auto member : {&Keys::starting_ratio, &Keys::breakdown_ratio})
      if (*m.pull_up_ratio >= *(m.*member))
        fit = m.refuse(&Keys::pull_up_ratio, fmt::format("pull_up_ratio = {:g}; must be below {} = {:g}: it is the "
                                                         "least torque on the way up",
                                                         *m.pull_up_ratio, m.key(member), *(m.*member)));
  } else if (*m.starting_ratio >= *m.breakdown_ratio) {
    fit = m.refuse(&Keys::starting_ratio,
                   fmt::format("starting_ratio = {:g}; must be below breakdown_ratio = {:g}, unless pull_up_ratio and "
                               "pull_up_speed give the least torque between them",
                               *m.starting_ratio, *m.breakdown_ratio));
  }
  return fit;
}

// Torques by the points of the catalogue; none: no points are given, or they do not fit.
std::optional<CatalogueMotor> by_points(const Motor& m, const InductionMotor& kloss) {
  if (!m.starting_ratio) {
    for (const auto member : {&Keys::pull_up_ratio, &Keys::pull_up_speed, &Keys::breakdown_speed})
      if (m.*member) {
        m.refuse(member, fmt::format("\"{}\" needs \"starting_ratio\", the locked-rotor torque over the rated one",
                                     m.key(member)));
        break;
      }
    return {};
  }
  const double synchronous = *m.synchronous_speed;
  const double breakdown_speed = m.breakdown_speed.value_or(synchronous * (1 - kloss.breakdown_slip));
  if (!points_fit(m, breakdown_speed)) return {};
  const double torque = kloss.rated_torque, at_voltage = torque * m.voltage_factor * m.voltage_factor;
  CataloguePoints points{.starting_torque = *m.starting_ratio * at_voltage,
                         .breakdown = {breakdown_speed, *m.breakdown_ratio * at_voltage},
                         .rated = {*m.rated_speed, at_voltage},
                         .synchronous_speed = synchronous};
  if (m.pull_up_ratio) points.pull_up = {*m.pull_up_speed, *m.pull_up_ratio * at_voltage};
  return CatalogueMotor{points.curve(), synchronous, torque};
}

// A key of the starters belongs to some of their methods.
template <class Member>
void belongs_to(const Motor& m, Member member, std::initializer_list<Starting> owners) {
  if (!m.given(member) || std::find(owners.begin(), owners.end(), m.starting) != owners.end()) return;
  std::vector<std::string> names;
  for (const Starting owner : owners) names.push_back(name_of(owner));
  m.refuse(member, fmt::format("\"{}\" belongs to starting = {}; here it is \"{}\"", m.key(member), listed(names),
                               name_of(m.starting)));
}

void check_start(const Motor& m) {
  belongs_to(m, &Keys::switch_time, {Starting::star_delta});
  belongs_to(m, &Keys::switch_speed, {Starting::star_delta});
  belongs_to(m, &Keys::pause, {Starting::star_delta});
  belongs_to(m, &Keys::ramp, {Starting::soft_start, Starting::frequency_converter});
  belongs_to(m, &Keys::initial_voltage, {Starting::soft_start});
  belongs_to(m, &Keys::target_speed, {Starting::frequency_converter});
  belongs_to(m, &Keys::torque_limit, {Starting::soft_start, Starting::frequency_converter});
  if (m.starting == Starting::star_delta) {
    m.keep_one(&Keys::switch_time, &Keys::switch_speed);
    if (!m.switch_time && !m.switch_speed)
      m.refuse("starting = \"star-delta\" needs \"switch_time\" or \"switch_speed\"");
    if (m.switch_speed && m.synchronous_speed)  // a circuit has none
      below(m, &Keys::switch_speed, *m.switch_speed, "synchronous_speed", *m.synchronous_speed);
  } else if (m.starting != Starting::direct && !m.ramp) {
    m.refuse(fmt::format("starting = \"{}\" needs \"ramp\", the time it takes", name_of(m.starting)));
  }
}

// The motor on its starter.
template <class Element>
void put_started(const std::string& name, const MotorKeys& m, const Element& motor, Network& net, int node) {
  const double on = m.window.start > Window{}.start ? m.window.start : 0;
  const double limit = m.torque_limit.value_or(HUGE_VAL);
  switch (m.starting) {
    case Starting::direct:
      return net.put(node, name, motor, m.window);
    case Starting::star_delta: {
      const StarDelta starter{on, m.switch_time.value_or(-1), m.switch_speed.value_or(0), m.pause};
      return net.put(node, name, StartedMotor<Element, StarDelta>{motor, starter, HUGE_VAL}, m.window);
    }
    case Starting::soft_start: {
      const SoftStart starter{on, m.initial_voltage, *m.ramp};
      return net.put(node, name, StartedMotor<Element, SoftStart>{motor, starter, limit}, m.window);
    }
    case Starting::frequency_converter: {
      const FrequencyConverter starter{on, *m.ramp, m.target_speed.value_or(motor.synchronous_speed),
                                       motor.synchronous_speed};
      return net.put(node, name, StartedMotor<Element, FrequencyConverter>{motor, starter, limit}, m.window);
    }
  }
}

// Calls a function with every member of the circuit, or of the catalogue.
void for_circuit(const auto& call) {
  call(&Keys::voltage);
  call(&Keys::pole_pairs);
  for (const auto member : {&Keys::stator_resistance, &Keys::rotor_resistance, &Keys::stator_reactance,
                            &Keys::rotor_reactance, &Keys::magnetising_reactance})
    call(member);
}
constexpr std::optional<double> CatalogueKeys::*needed_of_catalogue[] = {
    &Keys::rated_power, &Keys::rated_speed, &Keys::synchronous_speed, &Keys::breakdown_ratio};

// The motor by its equivalent circuit.
void build_circuit(const Motor& m, Network& net, int node) {
  const std::size_t before = m.messages().all().size();
  const auto missing = [&](auto member) {
    if (!m.given(member)) m.refuse(fmt::format("\"{}\" is missing beside the rest of its circuit", m.key(member)));
  };
  for_circuit(missing);
  missing(&Keys::frequency);
  const auto contradicts = [&](auto member) {
    if (m.given(member))
      m.refuse(member, fmt::format("\"{}\" is catalogue data, but its circuit is given too; keep one", m.key(member)));
  };
  for (const auto member : needed_of_catalogue) contradicts(member);
  contradicts(&Keys::resistance_ratio);
  contradicts(&Keys::starting_ratio);
  contradicts(&Keys::magnetising_ratio);
  if (m.starting != Starting::direct)
    m.refuse(&Keys::starting, fmt::format("starting = \"{}\" needs catalogue data; with the circuit let an operating "
                                          "sequence set the voltage",
                                          name_of(m.starting)));
  check_start(m);
  if (m.messages().all().size() > before) return;
  const EquivalentCircuit circuit{.voltage = *m.voltage * m.voltage_factor,
                                  .frequency = *m.frequency,
                                  .pole_pairs = *m.pole_pairs,
                                  .stator_resistance = *m.stator_resistance,
                                  .rotor_resistance = *m.rotor_resistance,
                                  .stator_leakage = *m.stator_reactance,
                                  .rotor_leakage = *m.rotor_reactance,
                                  .magnetising = *m.magnetising_reactance};
  net.put(node, m.section().name, TwoAxisMotor{circuit, circuit.characteristic()}, m.window);
}

// The circuit that has the catalogue's characteristic.
void put_two_axis(const Motor& m, const InductionMotor& kloss, Network& net, int node) {
  bool sound = true;
  const auto refuse = [&](const std::string& text) { sound = m.refuse(&Keys::frequency, text); };
  if (m.starting_ratio)
    refuse(
        "\"frequency\" asks for the two-axis model, whose characteristic is Kloss'; drop it, or "
        "\"starting_ratio\"");
  if (m.starting != Starting::direct)
    refuse(
        fmt::format("\"frequency\" asks for the two-axis model, which starting = \"{}\" does not know; drop one of "
                    "them",
                    name_of(m.starting)));
  // Without R_s the direct part of the stator's flux, there from the moment of switching on, would never decay: it
  // brakes and shakes at the supply's frequency for ever.
  if (kloss.resistance_ratio <= 0 && !m.starting_ratio)
    refuse(
        "\"frequency\" asks for the two-axis model, whose stator must have a resistance; give resistance_ratio = "
        "R_s/R_r′ > 0 (cage motors: about 1)");
  const double pairs = 2 * std::numbers::pi * *m.frequency / kloss.synchronous_speed;
  if (std::lround(pairs) < 1 || std::abs(pairs - static_cast<double>(std::lround(pairs))) > 1e-6 * pairs)
    refuse(
        fmt::format("frequency = {:g} Hz at {:.6g} rpm makes {:.6g} pole pairs; must be a whole number: frequency = "
                    "pole pairs · synchronous_speed",
                    *m.frequency, in_rpm(kloss.synchronous_speed), pairs));
  if (!sound) return;
  const auto circuit = EquivalentCircuit::of(kloss, *m.frequency, m.magnetising_ratio);
  net.put(node, m.section().name, TwoAxisMotor{circuit, kloss}, m.window);
}

// The motor by its catalogue.
void build_catalogue(const Motor& m, Network& net, int node) {
  const std::size_t before = m.messages().all().size();
  for (const auto member : needed_of_catalogue)
    if (!(m.*member))
      m.refuse(
          fmt::format("\"{}\" is missing; give rated_power, rated_speed, synchronous_speed and breakdown_ratio "
                      "from the catalogue, or the motor's circuit",
                      m.key(member)));
  if (m.messages().all().size() > before) return;
  const double rated = *m.rated_speed, synchronous = *m.synchronous_speed;
  if (synchronous <= rated) {
    m.refuse(&Keys::synchronous_speed, fmt::format("synchronous_speed = {:.6g} rpm; must be above rated_speed = {:.6g} "
                                                   "rpm",
                                                   in_rpm(synchronous), in_rpm(rated)));
    return;
  }
  const auto kloss = InductionMotor::from_catalogue(*m.rated_power, rated, synchronous, *m.breakdown_ratio,
                                                    m.resistance_ratio, m.voltage_factor);
  if (!kloss.has_no_pole())
    m.refuse(&Keys::resistance_ratio,
             fmt::format("no Kloss curve passes through these data; lower resistance_ratio = {}", m.resistance_ratio));
  const std::optional<CatalogueMotor> points = by_points(m, kloss);
  check_start(m);
  if (m.messages().all().size() > before) return;
  if (m.frequency)
    put_two_axis(m, kloss, net, node);
  else if (points)
    put_started(m.section().name, m, *points, net, node);
  else
    put_started(m.section().name, m, kloss, net, node);
}

void build_induction(const Section& s, Network& net, Messages& messages) {
  const auto motor = motor_fields().read(s, messages);
  const int node = single_shaft(s, motor.inertia, net);
  bool by_circuit = false;
  for_circuit([&](auto member) { by_circuit = by_circuit || motor.given(member); });
  if (by_circuit)
    build_circuit(motor, net, node);
  else
    build_catalogue(motor, net, node);
}

}  // namespace

std::vector<Kind> induction_kinds() {
  return {
      {.name = "induction motor",
       .doc =
           "induction motor from catalogue data: after Kloss (theory 4.1), or through its starting, pull-up, breakdown "
           "and rated points; with its frequency or its circuit also by the two-axis model",
       .keys = motor_fields().keys(),
       .build = build_induction},
  };
}

}  // namespace kurbel
