// induction_keys.cpp — the keys of an induction motor, each once.
#include "drivetrain/induction/induction_keys.h"

namespace kurbel {
namespace {

using Keys = InductionKeys;

Fields<Keys> catalogue_fields() {
  return Fields<Keys>()
      .add(quantity("rated_power", "W", positive, "shaft power P_n"), &Keys::rated_power)
      .add(quantity("rated_speed", "rad/s", positive, "speed ω_n at rated power"), &Keys::rated_speed)
      .add(quantity("synchronous_speed", "rad/s", positive, "ω_s, e.g. 1500 rpm"), &Keys::synchronous_speed)
      .add(quantity("poles", "", {.low = 2, .high = 200},
                    "number of poles 2 p, in place of synchronous_speed: ω_s = 2 π f/p, f = frequency or mains"),
           &Keys::poles)
      .add(defaulted("mains", "Hz", "50 Hz", positive,
                     "frequency f of the supply where frequency is not given: for poles, nameplate and circuit"),
           &Keys::mains)
      .add(quantity("breakdown_ratio", "", {.low = 1, .low_open = true}, "breakdown over rated torque ν", "torque_lag"),
           &Keys::breakdown_ratio)
      .add(quantity("breakdown_torque", "N*m", positive,
                    "M_b, with breakdown_slip in place of rated_power, rated_speed and breakdown_ratio"),
           &Keys::breakdown_torque)
      .add(quantity("breakdown_slip", "", positive, "s_b of Kloss' curve", "torque_lag"), &Keys::breakdown_slip)
      .add(defaulted("resistance_ratio", "", "0.0", not_negative,
                     "a = R_s/R_r′ in Kloss' formula; > 0 with frequency (cage motors: about 1)"),
           &Keys::resistance_ratio)
      .add(defaulted("voltage_factor", "", "1.0", positive, "voltage over rated voltage; torque goes with its square"),
           &Keys::voltage_factor)
      .add(quantity(
               "starting_ratio", "", positive,
               "locked-rotor over rated torque; with it a smooth curve through the catalogue's points replaces Kloss'"),
           &Keys::starting_ratio)
      .add(quantity("pull_up_ratio", "", positive, "least torque before breakdown over the rated one"),
           &Keys::pull_up_ratio)
      .add(quantity("pull_up_speed", "rad/s", positive, "where that is"), &Keys::pull_up_speed)
      .add(quantity("breakdown_speed", "rad/s", positive,
                    "speed of the breakdown torque, with starting_ratio; default: that of Kloss"),
           &Keys::breakdown_speed);
}

void add_nameplate(Fields<Keys>& fields) {
  fields
      .add(quantity("rated_current", "A", positive,
                    "of a line at rated power; with voltage and one of the next two the circuit is estimated from the "
                    "nameplate"),
           &Keys::rated_current)
      .add(quantity("power_factor", "", {.low = 0, .high = 1, .low_open = true, .high_open = true},
                    "cos φ at rated power"),
           &Keys::power_factor)
      .add(quantity("efficiency", "", {.low = 0, .high = 1, .low_open = true, .high_open = true},
                    "η at rated power: P_n/η = √3 U I_n cos φ"),
           &Keys::efficiency)
      .add(defaulted("stator_loss_share", "", "0.5", {.low = 0, .high = 1, .low_open = true},
                     "estimate: the stator's copper has this share of all losses but the rotor's; the rest, iron, air "
                     "and bearings, is in no circuit"),
           &Keys::stator_share);
}

void add_circuit(Fields<Keys>& fields) {
  const auto ohms = [](const char* name, const char* doc, const char* effect = "") {
    return quantity(name, "Ohm", positive, doc, effect);
  };
  fields
      .add(quantity("frequency", "Hz", positive,
                    "of the mains; with it the motor is its two-axis circuit, currents as states; without it the "
                    "circuit's steady characteristic",
                    "transients"),
           &Keys::frequency)
      .add(defaulted("magnetising_ratio", "", "30", {.low = 3, .high = 1000},
                     "X_m over X_s = X_r of the circuit that stands for catalogue data"),
           &Keys::magnetising_ratio)
      .add(quantity("voltage", "V", positive, "line to line, of the nameplate or of the circuit that follows"),
           &Keys::voltage)
      .add(quantity("pole_pairs", "", {.low = 1, .high = 100}, "p"), &Keys::pole_pairs)
      .add(quantity("stator_resistance", "Ohm", not_negative, "R_s of one phase"), &Keys::stator_resistance)
      .add(ohms("rotor_resistance", "R_r, referred to the stator", "torque_lag"), &Keys::rotor_resistance)
      .add(ohms("stator_reactance", "leakage X_s at the frequency"), &Keys::stator_reactance)
      .add(ohms("rotor_reactance", "leakage X_r, referred to the stator"), &Keys::rotor_reactance)
      .add(ohms("magnetising_reactance", "X_m"), &Keys::magnetising_reactance);
}

void add_starting(Fields<Keys>& fields) {
  fields
      .add(choice("starting", "direct", "how it is brought up to speed; times count from its `start`"), &Keys::starting,
           starting_methods())
      .add(quantity("switch_time", "s", not_negative, "star to delta at this time"), &Keys::switch_time)
      .add(quantity("switch_speed", "rad/s", positive, "star to delta at this speed"), &Keys::switch_speed)
      .add(defaulted("pause", "s", "0 s", not_negative, "between star and delta, without torque"), &Keys::pause)
      .add(quantity("ramp", "s", positive, "time of soft start, or of the frequency's rise from zero"), &Keys::ramp)
      .add(defaulted("initial_voltage", "", "0.3", {.low = 0, .high = 1}, "u₀ of a soft start, over the rated voltage"),
           &Keys::initial_voltage)
      .add(quantity("target_speed", "rad/s", positive,
                    "synchronous speed that the frequency converter rises to; default: synchronous_speed. Above it the "
                    "field weakens"),
           &Keys::target_speed)
      .add(quantity("torque_limit", "N*m", positive,
                    "of soft start or frequency converter, in both directions; default: none"),
           &Keys::torque_limit);
}

}  // namespace

Fields<InductionKeys> induction_fields() {
  return [] {
    Fields<Keys> fields = catalogue_fields();
    add_nameplate(fields);
    add_circuit(fields);
    add_starting(fields);
    return fields.add(inertia_key("", "rotor inertia"), &Keys::inertia)
        .add(window_fields(), &Keys::window)
        .add(duty_rating_fields(), &Keys::duty);
  }();
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
