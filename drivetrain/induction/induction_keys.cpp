// induction_keys.cpp — the keys of an induction motor, each once.
#include "drivetrain/induction/induction_keys.h"

namespace kurbel {
namespace {

using Keys = InductionKeys;

Fields<Keys> catalogue_fields() {
  return Fields<Keys>()
      .add({.name = "rated_power", .unit = "W", .domain = positive, .doc = "shaft power P_n"}, &Keys::rated_power)
      .add({.name = "rated_speed", .unit = "rad/s", .domain = positive, .doc = "speed ω_n at rated power"},
           &Keys::rated_speed)
      .add({.name = "synchronous_speed", .unit = "rad/s", .domain = positive, .doc = "ω_s, e.g. 1500 rpm"},
           &Keys::synchronous_speed)
      .add({.name = "poles",
            .domain = {.low = 2, .high = 200},
            .doc = "number of poles 2 p, in place of synchronous_speed: ω_s = 2 π f/p, f = frequency or mains"},
           &Keys::poles)
      .add({.name = "mains",
            .unit = "Hz",
            .fallback = "\"50 Hz\"",
            .domain = positive,
            .doc = "frequency f of the supply where frequency is not given: for poles, nameplate and circuit"},
           &Keys::mains)
      .add({.name = "breakdown_ratio", .domain = {.low = 1, .low_open = true}, .doc = "breakdown over rated torque ν"},
           &Keys::breakdown_ratio)
      .add({.name = "breakdown_torque",
            .unit = "N*m",
            .domain = positive,
            .doc = "M_b, with breakdown_slip in place of rated_power, rated_speed and breakdown_ratio"},
           &Keys::breakdown_torque)
      .add({.name = "breakdown_slip", .domain = positive, .doc = "s_b of Kloss' curve"}, &Keys::breakdown_slip)
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

void add_nameplate(Fields<Keys>& fields) {
  fields
      .add({.name = "rated_current",
            .unit = "A",
            .domain = positive,
            .doc = "of a line at rated power; with voltage and one of the next two the circuit is estimated from the "
                   "nameplate"},
           &Keys::rated_current)
      .add({.name = "power_factor",
            .domain = {.low = 0, .high = 1, .low_open = true, .high_open = true},
            .doc = "cos φ at rated power"},
           &Keys::power_factor)
      .add({.name = "efficiency",
            .domain = {.low = 0, .high = 1, .low_open = true, .high_open = true},
            .doc = "η at rated power: P_n/η = √3 U I_n cos φ"},
           &Keys::efficiency)
      .add(
          {.name = "stator_loss_share",
           .fallback = "0.5",
           .domain = {.low = 0, .high = 1, .low_open = true},
           .doc = "estimate: the stator's copper has this share of all losses but the rotor's; the rest, iron, air and "
                  "bearings, is in no circuit"},
          &Keys::stator_share);
}

void add_circuit(Fields<Keys>& fields) {
  const auto ohms = [](const char* name, const char* doc) {
    return Key{.name = name, .unit = "Ohm", .domain = positive, .doc = doc};
  };
  fields
      .add({.name = "frequency",
            .unit = "Hz",
            .domain = positive,
            .doc = "of the mains; with it the motor is its two-axis circuit, currents as states; without it the "
                   "circuit's steady "
                   "characteristic",
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
            .doc = "line to line, of the nameplate or of the circuit that follows"},
           &Keys::voltage)
      .add({.name = "pole_pairs", .domain = {.low = 1, .high = 100}, .doc = "p"}, &Keys::pole_pairs)
      .add({.name = "stator_resistance", .unit = "Ohm", .domain = not_negative, .doc = "R_s of one phase"},
           &Keys::stator_resistance)
      .add(ohms("rotor_resistance", "R_r, referred to the stator"), &Keys::rotor_resistance)
      .add(ohms("stator_reactance", "leakage X_s at the frequency"), &Keys::stator_reactance)
      .add(ohms("rotor_reactance", "leakage X_r, referred to the stator"), &Keys::rotor_reactance)
      .add(ohms("magnetising_reactance", "X_m"), &Keys::magnetising_reactance);
}

void add_starting(Fields<Keys>& fields) {
  fields
      .add({.name = "starting",
            .fallback = "\"direct\"",
            .doc = "how it is brought up to speed; times count from its `start`"},
           &Keys::starting, starting_methods())
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

}  // namespace

const Fields<InductionKeys>& induction_fields() {
  static const auto made = [] {
    Fields<Keys> fields = catalogue_fields();
    add_nameplate(fields);
    add_circuit(fields);
    add_starting(fields);
    return fields.add(inertia_key("", "rotor inertia"), &Keys::inertia)
        .add(window_fields(), &Keys::window)
        .add(duty_rating_fields(), &Keys::duty);
  }();
  return made;
}

const Words<Starting>& starting_methods() {
  static const Words<Starting> words = {{"direct", Starting::direct},
                                        {"star-delta", Starting::star_delta},
                                        {"soft start", Starting::soft_start},
                                        {"frequency converter", Starting::frequency_converter}};
  return words;
}

const char* name_of(Starting method) { return starting_methods()[static_cast<std::size_t>(method)].first; }

}  // namespace kurbel
