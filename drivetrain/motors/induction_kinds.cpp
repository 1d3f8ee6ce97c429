// induction_kinds.cpp — induction motors from catalogue data or by their circuit, and how they are started.
#include "drivetrain/motors/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "drivetrain/motors/catalogue_motor.h"
#include "drivetrain/motors/induction_circuit.h"
#include "drivetrain/motors/motors.h"
#include "drivetrain/motors/started_motor.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

double in_rpm(double speed) { return speed * 30 / std::numbers::pi; }

// Collects faults of one motor.
struct Faults {
  const Section& s;
  Messages& messages;
  bool any = false;

  void add(const char* key, const std::string& text) {
    any = true;
    messages.add(key ? s.where(key) : s.at, fmt::format("induction motor \"{}\": {}", s.name, text));
  }
  // One speed must lie below another.
  void unless_below(const char* key, double speed, const char* other, double limit) {
    if (speed >= limit)
      add(key, fmt::format("{} = {:.6g} rpm; must be below {} = {:.6g} rpm", key, in_rpm(speed), other, in_rpm(limit)));
  }
};

// Torques by the points of the catalogue: the ratios are over the rated torque.
CatalogueMotor by_points(const Section& s, const InductionMotor& kloss, Faults& faults) {
  const double rated = s.number("rated_speed"), synchronous = s.number("synchronous_speed");
  const double breakdown = s.number("breakdown_ratio"), starting = s.number_or("starting_ratio", 0);
  const double breakdown_speed = s.number_or("breakdown_speed", synchronous * (1 - kloss.breakdown_slip));
  if (!s.given("starting_ratio")) {
    for (const char* key : {"pull_up_ratio", "pull_up_speed", "breakdown_speed"})
      if (s.given(key)) {
        faults.add(key,
                   fmt::format("\"{}\" needs \"starting_ratio\", the locked-rotor torque over the rated one", key));
        break;
      }
    return {};
  }
  if (s.given("resistance_ratio"))
    faults.add("resistance_ratio",
               "\"resistance_ratio\" belongs to Kloss' formula; with \"starting_ratio\" the points give the curve");
  faults.unless_below("breakdown_speed", breakdown_speed, "rated_speed", rated);
  if (breakdown_speed <= 0)
    faults.add("breakdown_speed",
               fmt::format("breakdown_speed = {:.6g} rpm by these data; give it, > 0 rpm", in_rpm(breakdown_speed)));
  const bool dips = s.given("pull_up_ratio");
  if (dips != s.given("pull_up_speed")) {
    faults.add(dips ? "pull_up_ratio" : "pull_up_speed",
               "give both \"pull_up_ratio\" and \"pull_up_speed\", or neither");
  } else if (dips) {
    faults.unless_below("pull_up_speed", s.number("pull_up_speed"), "breakdown_speed", breakdown_speed);
    for (const auto& [name, ratio] : {std::pair{"starting_ratio", starting}, std::pair{"breakdown_ratio", breakdown}})
      if (s.number("pull_up_ratio") >= ratio)
        faults.add("pull_up_ratio", fmt::format("pull_up_ratio = {:g}; must be below {} = {:g}: it is the least torque "
                                                "on the way up",
                                                s.number("pull_up_ratio"), name, ratio));
  } else if (starting >= breakdown) {
    faults.add("starting_ratio", fmt::format("starting_ratio = {:g}; must be below breakdown_ratio = {:g}, unless "
                                             "pull_up_ratio and pull_up_speed give the least torque between them",
                                             starting, breakdown));
  }
  if (faults.any) return {};
  const double torque = kloss.rated_torque,
               at_voltage = torque * s.number("voltage_factor") * s.number("voltage_factor");
  CataloguePoints points{.starting_torque = starting * at_voltage,
                         .breakdown = {breakdown_speed, breakdown * at_voltage},
                         .rated = {rated, at_voltage},
                         .synchronous_speed = synchronous};
  if (dips) points.pull_up = {s.number("pull_up_speed"), s.number("pull_up_ratio") * at_voltage};
  return {points.curve(), synchronous, torque};
}

// A key and the methods of starting that it belongs to.
struct StartKey {
  const char* name;
  std::vector<std::string> methods;
};
const std::vector<StartKey>& start_keys() {
  static const std::vector<StartKey> all = {{"switch_time", {"star-delta"}},
                                            {"switch_speed", {"star-delta"}},
                                            {"pause", {"star-delta"}},
                                            {"ramp", {"soft start", "frequency converter"}},
                                            {"initial_voltage", {"soft start"}},
                                            {"target_speed", {"frequency converter"}},
                                            {"torque_limit", {"soft start", "frequency converter"}}};
  return all;
}

void check_start(const Section& s, Faults& faults) {
  const std::string& method = s.text("starting");
  for (const auto& [key, methods] : start_keys())
    if (s.given(key) && std::find(methods.begin(), methods.end(), method) == methods.end())
      faults.add(key, fmt::format("\"{}\" belongs to starting = {}; here it is \"{}\"", key, listed(methods), method));
  if (method == "star-delta") {
    if (s.given("switch_time") == s.given("switch_speed"))
      faults.add(s.given("switch_time") ? "switch_speed" : nullptr,
                 s.given("switch_time") ? "\"switch_time\" and \"switch_speed\" both given; keep one"
                                        : "starting = \"star-delta\" needs \"switch_time\" or \"switch_speed\"");
    if (s.given("switch_speed") && s.given("synchronous_speed"))  // a circuit has none
      faults.unless_below("switch_speed", s.number("switch_speed"), "synchronous_speed", s.number("synchronous_speed"));
  } else if (method != "direct" && !s.given("ramp")) {
    faults.add(nullptr, fmt::format("starting = \"{}\" needs \"ramp\", the time it takes", method));
  }
}

// The motor on its starter.
template <class Motor>
void put_started(const Section& s, const Motor& motor, Network& net, int node, Window window) {
  const std::string& method = s.text("starting");
  const double on = s.given("start") ? window.start : 0, limit = s.number_or("torque_limit", HUGE_VAL);
  if (method == "direct") {
    net.put(node, s.name, motor, window);
  } else if (method == "star-delta") {
    const StarDelta starter{on, s.number_or("switch_time", -1), s.number_or("switch_speed", 0), s.number("pause")};
    net.put(node, s.name, StartedMotor<Motor, StarDelta>{motor, starter, HUGE_VAL}, window);
  } else if (method == "soft start") {
    const SoftStart starter{on, s.number("initial_voltage"), s.number("ramp")};
    net.put(node, s.name, StartedMotor<Motor, SoftStart>{motor, starter, limit}, window);
  } else {
    const FrequencyConverter starter{on, s.number("ramp"), s.number_or("target_speed", motor.synchronous_speed),
                                     motor.synchronous_speed};
    net.put(node, s.name, StartedMotor<Motor, FrequencyConverter>{motor, starter, limit}, window);
  }
}

constexpr const char* catalogue_keys[] = {"rated_power", "rated_speed", "synchronous_speed", "breakdown_ratio"};
constexpr const char* circuit_keys[] = {
    "voltage",          "pole_pairs",      "stator_resistance",    "rotor_resistance",
    "stator_reactance", "rotor_reactance", "magnetising_reactance"};

// The motor by its equivalent circuit.
void build_circuit(const Section& s, Network& net, int node, Window window, Faults& faults) {
  for (const char* key : circuit_keys)
    if (!s.given(key)) faults.add(nullptr, fmt::format("\"{}\" is missing beside the rest of its circuit", key));
  if (!s.given("frequency")) faults.add(nullptr, "\"frequency\" is missing beside the rest of its circuit");
  for (const char* key : {"rated_power", "rated_speed", "synchronous_speed", "breakdown_ratio", "resistance_ratio",
                          "starting_ratio", "magnetising_ratio"})
    if (s.given(key))
      faults.add(key, fmt::format("\"{}\" is catalogue data, but its circuit is given too; keep one", key));
  if (s.text("starting") != "direct")
    faults.add("starting", fmt::format("starting = \"{}\" needs catalogue data; with the circuit let an operating "
                                       "sequence set the voltage",
                                       s.text("starting")));
  check_start(s, faults);
  if (faults.any) return;
  const EquivalentCircuit circuit{.voltage = s.number("voltage") * s.number("voltage_factor"),
                                  .frequency = s.number("frequency"),
                                  .pole_pairs = static_cast<int>(s.number("pole_pairs")),
                                  .stator_resistance = s.number("stator_resistance"),
                                  .rotor_resistance = s.number("rotor_resistance"),
                                  .stator_leakage = s.number("stator_reactance"),
                                  .rotor_leakage = s.number("rotor_reactance"),
                                  .magnetising = s.number("magnetising_reactance")};
  net.put(node, s.name, TwoAxisMotor{circuit, circuit.characteristic()}, window);
}

// The circuit that has the catalogue's characteristic.
void put_two_axis(const Section& s, const InductionMotor& kloss, Network& net, int node, Window window,
                  Faults& faults) {
  if (s.given("starting_ratio"))
    faults.add("frequency",
               "\"frequency\" asks for the two-axis model, whose characteristic is Kloss'; drop it, or "
               "\"starting_ratio\"");
  if (s.text("starting") != "direct")
    faults.add("frequency", fmt::format("\"frequency\" asks for the two-axis model, which starting = \"{}\" does not "
                                        "know; drop one of them",
                                        s.text("starting")));
  // Without R_s the direct part of the stator's flux, there from the moment of switching on, would never decay: it
  // brakes and shakes at the supply's frequency for ever.
  if (kloss.resistance_ratio <= 0 && !s.given("starting_ratio"))
    faults.add("frequency",
               "\"frequency\" asks for the two-axis model, whose stator must have a resistance; give "
               "resistance_ratio = R_s/R_r′ > 0 (cage motors: about 1)");
  const double pairs = 2 * std::numbers::pi * s.number("frequency") / kloss.synchronous_speed;
  if (std::lround(pairs) < 1 || std::abs(pairs - static_cast<double>(std::lround(pairs))) > 1e-6 * pairs)
    faults.add("frequency", fmt::format("frequency = {:g} Hz at {:.6g} rpm makes {:.6g} pole pairs; must be a whole "
                                        "number: frequency = pole pairs · synchronous_speed",
                                        s.number("frequency"), in_rpm(kloss.synchronous_speed), pairs));
  if (faults.any) return;
  const auto circuit = EquivalentCircuit::of(kloss, s.number("frequency"), s.number("magnetising_ratio"));
  net.put(node, s.name, TwoAxisMotor{circuit, kloss}, window);
}

void build_induction(const Section& s, Network& net, Messages& messages) {
  const int node = single_shaft(s, net);
  Faults faults{s, messages};
  const Window window = window_of(s, messages);
  const auto given = [&](const char* key) { return s.given(key); };
  if (std::any_of(std::begin(circuit_keys), std::end(circuit_keys), given))
    return build_circuit(s, net, node, window, faults);
  for (const char* key : catalogue_keys)
    if (!s.given(key))
      faults.add(nullptr, fmt::format("\"{}\" is missing; give rated_power, rated_speed, synchronous_speed and "
                                      "breakdown_ratio from the catalogue, or the motor's circuit",
                                      key));
  if (faults.any) return;
  const double rated = s.number("rated_speed"), synchronous = s.number("synchronous_speed");
  if (synchronous <= rated) {
    faults.add("synchronous_speed",
               fmt::format("synchronous_speed = {:.6g} rpm; must be above rated_speed = {:.6g} rpm",
                           in_rpm(synchronous), in_rpm(rated)));
    return;
  }
  const auto kloss =
      InductionMotor::from_catalogue(s.number("rated_power"), rated, synchronous, s.number("breakdown_ratio"),
                                     s.number("resistance_ratio"), s.number("voltage_factor"));
  if (!kloss.has_no_pole())
    faults.add("resistance_ratio", fmt::format("no Kloss curve passes through these data; lower resistance_ratio = {}",
                                               s.number("resistance_ratio")));
  const CatalogueMotor points = by_points(s, kloss, faults);
  check_start(s, faults);
  if (faults.any) return;
  if (s.given("frequency")) {
    put_two_axis(s, kloss, net, node, window, faults);
  } else if (s.given("starting_ratio")) {
    put_started(s, points, net, node, window);
  } else {
    put_started(s, kloss, net, node, window);
  }
}

std::vector<Key> induction_keys() {
  return {
      {.name = "rated_power", .unit = "W", .domain = positive, .doc = "shaft power P_n"},
      {.name = "rated_speed", .unit = "rad/s", .domain = positive, .doc = "speed ω_n at rated power"},
      {.name = "synchronous_speed", .unit = "rad/s", .domain = positive, .doc = "ω_s, e.g. 1500 rpm"},
      {.name = "breakdown_ratio", .domain = {.low = 1, .low_open = true}, .doc = "breakdown over rated torque ν"},
      {.name = "resistance_ratio",
       .fallback = "0.0",
       .domain = not_negative,
       .doc = "a = R_s/R_r′ in Kloss' formula; > 0 with frequency (cage motors: about 1)"},
      {.name = "voltage_factor",
       .fallback = "1.0",
       .domain = positive,
       .doc = "voltage over rated voltage; torque goes with its square"},
      {.name = "starting_ratio",
       .domain = positive,
       .doc = "locked-rotor over rated torque; with it a smooth curve through the catalogue's points replaces Kloss'"},
      {.name = "pull_up_ratio", .domain = positive, .doc = "least torque before breakdown over the rated one"},
      {.name = "pull_up_speed", .unit = "rad/s", .domain = positive, .doc = "where that is"},
      {.name = "breakdown_speed",
       .unit = "rad/s",
       .domain = positive,
       .doc = "speed of the breakdown torque, with starting_ratio; default: that of Kloss"},
  };
}

std::vector<Key> two_axis_keys() {
  const auto ohms = [](const char* name, const char* doc) {
    return Key{.name = name, .unit = "Ohm", .domain = positive, .doc = doc};
  };
  return {{.name = "frequency",
           .unit = "Hz",
           .domain = positive,
           .doc = "of the mains; with it the motor is its two-axis circuit, currents as states",
           .effect = "transients"},
          {.name = "magnetising_ratio",
           .fallback = "30",
           .domain = {.low = 3, .high = 1000},
           .doc = "X_m over X_s = X_r of the circuit that stands for catalogue data"},
          {.name = "voltage",
           .unit = "V",
           .domain = positive,
           .doc = "line to line; with frequency and the following in place of catalogue data"},
          {.name = "pole_pairs", .type = KeyType::integer, .domain = {.low = 1, .high = 100}, .doc = "p"},
          {.name = "stator_resistance", .unit = "Ohm", .domain = not_negative, .doc = "R_s of one phase"},
          ohms("rotor_resistance", "R_r, referred to the stator"),
          ohms("stator_reactance", "leakage X_s at the frequency"),
          ohms("rotor_reactance", "leakage X_r, referred to the stator"),
          ohms("magnetising_reactance", "X_m")};
}

std::vector<Key> starting_keys() {
  return {
      {.name = "starting",
       .type = KeyType::text,
       .fallback = "\"direct\"",
       .doc = "how it is brought up to speed; times count from its `start`",
       .choices = {"direct", "star-delta", "soft start", "frequency converter"}},
      {.name = "switch_time", .unit = "s", .domain = not_negative, .doc = "star to delta at this time"},
      {.name = "switch_speed", .unit = "rad/s", .domain = positive, .doc = "star to delta at this speed"},
      {.name = "pause",
       .unit = "s",
       .fallback = "\"0 s\"",
       .domain = not_negative,
       .doc = "between star and delta, without torque"},
      {.name = "ramp",
       .unit = "s",
       .domain = positive,
       .doc = "time of soft start, or of the frequency's rise from zero"},
      {.name = "initial_voltage",
       .fallback = "0.3",
       .domain = {.low = 0, .high = 1},
       .doc = "u₀ of a soft start, over the rated voltage"},
      {.name = "target_speed",
       .unit = "rad/s",
       .domain = positive,
       .doc = "synchronous speed that the frequency converter rises to; default: synchronous_speed. Above it the field "
              "weakens"},
      {.name = "torque_limit",
       .unit = "N*m",
       .domain = positive,
       .doc = "of soft start or frequency converter, in both directions; default: none"},
  };
}

}  // namespace

std::vector<Kind> induction_kinds() {
  return {
      {.name = "induction motor",
       .doc =
           "induction motor from catalogue data: after Kloss (theory 4.1), or through its starting, pull-up, breakdown "
           "and rated points; with its frequency or its circuit also by the two-axis model",
       .keys = joined(joined(joined(joined(induction_keys(), two_axis_keys()), starting_keys()),
                             {inertia_key("", "rotor inertia")}),
                      window_keys()),
       .build = build_induction},
  };
}

}  // namespace kurbel
