// dc_kinds.cpp — DC motors by their static characteristics, or with their circuits.
#include <fmt/format.h>

#include <numbers>

#include "drivetrain/motors/dc_circuits.h"
#include "drivetrain/motors/dc_series_motor.h"
#include "drivetrain/motors/field_weakening.h"
#include "drivetrain/motors/motors.h"
#include "drivetrain/motors/rheostat.h"
#include "drivetrain/shared/kinds.h"
#include "drivetrain/shared/rating_keys.h"
#include "drivetrain/shared/shared_keys.h"
#include "engine/model/network.h"

namespace kurbel {
namespace {

// With an inductance the armature's current is a state.
struct CircuitKeys {
  std::optional<double> inductance, initial_current;  // L [H], [A]
};
Fields<CircuitKeys> circuit_fields(const char* of) {
  return Fields<CircuitKeys>()
      .add(quantity("inductance", "H", positive, of, "transients"), &CircuitKeys::inductance)
      .add(quantity("initial_current", "A", any_number,
                    "at the start; default: 0 at rest, else that of the static line"),
           &CircuitKeys::initial_current)
      .check([](const Reading<CircuitKeys>& c) {
        c.drop_without(&CircuitKeys::inductance, &CircuitKeys::initial_current);
      });
}

// Resistances in the armature circuit that are cut out while it starts.
struct RheostatKeys {
  std::optional<std::vector<double>> starting_resistances, switch_times;  // R_1 > R_2 > … [Ω], [s]
  std::optional<double> switch_current;                                   // [A]
};
void check_rheostat(const Reading<RheostatKeys>& r) {
  using Keys = RheostatKeys;
  if (!r.drop_without(&Keys::starting_resistances, &Keys::switch_times, &Keys::switch_current)) return;
  if (!r.starting_resistances) return;
  const std::vector<double>& steps = *r.starting_resistances;
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k] <= 0 || (k > 0 && steps[k] >= steps[k - 1])) {
      r.refuse(&Keys::starting_resistances,
               fmt::format("starting_resistances: {:g} Ohm in place {}; must be > 0 and below the one before: what is "
                           "still in the circuit, stage by stage",
                           steps[k], k + 1));
      return;
    }
  if (!r.keep_one(&Keys::switch_current, &Keys::switch_times)) return;
  if (!r.switch_current && !r.switch_times)
    r.refuse(&Keys::starting_resistances,
             "\"starting_resistances\" need \"switch_current\", at which the next is cut out, or \"switch_times\"");
  if (!r.switch_times) return;
  const std::vector<double>& times = *r.switch_times;
  bool rises = times.front() > 0;
  for (std::size_t k = 1; k < times.size(); ++k) rises = rises && times[k] > times[k - 1];
  if (times.size() != steps.size() || !rises)
    r.refuse(&Keys::switch_times,
             fmt::format("switch_times: {} of them for {} starting_resistances; must be one each, > 0 and rising",
                         times.size(), steps.size()));
}
Fields<RheostatKeys> rheostat_fields() {
  using Keys = RheostatKeys;
  return Fields<Keys>()
      .add(quantity("starting_resistances", "Ohm", any_number,
                    "in the armature circuit, stage by stage of a start, falling; a sequence may only switch the motor "
                    "on and off then, and each start goes through them"),
           &Keys::starting_resistances)
      .add(quantity("switch_current", "A", positive, "armature current down to which a stage lasts"),
           &Keys::switch_current)
      .add(quantity("switch_times", "s", any_number, "ends of the stages, in place of switch_current"),
           &Keys::switch_times)
      .check(check_rheostat);
}

// The motor with every resistance of its start; `with` makes one of a total resistance.
template <class With>
void put_on_rheostat(const RheostatKeys& keys, const std::string& name, Window window, double resistance, Network& net,
                     int node, const With& with) {
  using Motor = decltype(with(resistance));
  std::vector<Motor> stages;
  for (const double step : *keys.starting_resistances) stages.push_back(with(resistance + step));
  stages.push_back(with(resistance));
  const auto put = [&](auto motor) {
    motor.stages = std::move(stages);
    motor.switch_current = keys.switch_current.value_or(1);
    if (keys.switch_times) motor.times = *keys.switch_times;
    net.put(node, name, std::move(motor), window);
  };
  if (keys.switch_times)
    put(OnRheostat<Motor, CutOut::by_time>{});
  else
    put(OnRheostat<Motor, CutOut::by_current>{});
}

// The motor with a rheostat, an inductance, or both; false: it has neither.
template <class Circuit, class Motor>
bool put_with_circuit(const RheostatKeys& rheostat, const CircuitKeys& circuit, const std::string& name, Window window,
                      const Motor& motor, Network& net, int node) {
  const auto with = [&](double total) {
    Motor one = motor;
    one.resistance = total;
    return one;
  };
  const auto wound = [&](double total) { return Circuit{with(total), *circuit.inductance, circuit.initial_current}; };
  if (rheostat.starting_resistances && circuit.inductance)
    put_on_rheostat(rheostat, name, window, motor.resistance, net, node, wound);
  else if (rheostat.starting_resistances)
    put_on_rheostat(rheostat, name, window, motor.resistance, net, node, with);
  else if (circuit.inductance)
    net.put(node, name, wound(motor.resistance), window);
  else
    return false;
  return true;
}

// --- shunt motor ---

struct ShuntKeys {
  std::optional<double> stall_torque, no_load_speed;    // M_stall [N·m], ω₀ [rad/s]
  std::optional<double> voltage, resistance, constant;  // U [V], R [Ω], k [N·m/A]
  double rated_torque = 0;                              // [N·m]
  std::optional<double> braking_resistance;             // [Ω]
  std::optional<CurveData> field;                       // f over [s] or [rad/s]
  double inertia = 0;                                   // [kg·m²]
  CircuitKeys circuit;
  RheostatKeys rheostat;
  DutyRating duty;
  Window window;

  bool electrical() const { return voltage || resistance || constant; }
};

void needs_circuit(const Reading<ShuntKeys>& m) {
  const auto refuse = [&](auto member) {
    m.refuse(member, fmt::format("\"{}\" needs the circuit; give voltage, resistance and constant in place of "
                                 "stall_torque and no_load_speed",
                                 m.key(member)));
  };
  if (m.circuit.inductance) refuse(&ShuntKeys::circuit);
  if (m.braking_resistance) refuse(&ShuntKeys::braking_resistance);
  if (m.field) refuse(&ShuntKeys::field);
  if (m.rheostat.starting_resistances) refuse(&ShuntKeys::rheostat);
}

// f stays above zero, and over the speed it begins at standstill.
void check_field(const Reading<ShuntKeys>& m) {
  const auto refuse = [&](const std::string& text) { m.refuse(&ShuntKeys::field, text); };
  if (m.rheostat.starting_resistances || m.braking_resistance)
    return refuse(
        fmt::format("\"field\" is weakened behind the start, without resistances in the armature; drop \"{}\"",
                    m.braking_resistance ? "braking_resistance" : "starting_resistances"));
  const CurveData& data = *m.field;
  if (data.over == "speed" && data.period > 0) return refuse("a table over the speed has no period; drop it");
  if (data.over == "speed" && data.x.front() < 0)
    return refuse("over the speed it counts in both senses of rotation; give it from 0 on");
  const Curve curve = data.curve();
  if (data.over == "speed" && curve.jumps()) return refuse("it jumps over the speed; let it fall within a part of it");
  constexpr int samples = 1000;
  for (int k = 0; k <= samples; ++k)
    if (const double f = curve.value(data.x.front() + (data.x.back() - data.x.front()) * k / samples); !(f > 0))
      return refuse(
          fmt::format("it falls to {:.3g}; must stay > 0: without a field the motor has no torque and runs away", f));
}

void check_shunt(const Reading<ShuntKeys>& m) {
  if (m.duty.duty != DutyRating::Duty::none && m.rated_torque == 0)
    m.refuse(&ShuntKeys::duty, "\"duty\" is of the rated torque; give \"rated_torque\", too");
  if (m.duty.duty != DutyRating::Duty::none && m.field)
    m.refuse(
        &ShuntKeys::duty,
        "\"duty\" judges by the torque, which determines the heat of the armature only under the full field; drop it "
        "beside \"field\"");
  if (m.electrical()) {
    if (!m.voltage || !m.resistance || !m.constant || m.stall_torque || m.no_load_speed)
      m.refuse("give either stall_torque and no_load_speed, or voltage, resistance and constant");
    if (m.rheostat.starting_resistances && m.braking_resistance)
      m.refuse(&ShuntKeys::braking_resistance,
               "\"braking_resistance\" acts by commands, which a motor on \"starting_resistances\" does not take; drop "
               "one of them");
    if (m.field) check_field(m);
    return;
  }
  if (!m.stall_torque && !m.no_load_speed)
    m.refuse("nothing given; give stall_torque and no_load_speed, or voltage, resistance and constant");
  else if (!m.stall_torque || !m.no_load_speed)
    m.refuse(m.stall_torque ? "\"no_load_speed\" is missing beside \"stall_torque\""
                            : "\"stall_torque\" is missing beside \"no_load_speed\"");
  else
    needs_circuit(m);
}

Fields<ShuntKeys> shunt_fields() {
  using Keys = ShuntKeys;
  return Fields<Keys>()
      .add(quantity("stall_torque", "N*m", positive, "torque at standstill M_stall"), &Keys::stall_torque)
      .add(quantity("no_load_speed", "rad/s", positive, "speed without torque ω₀"), &Keys::no_load_speed)
      .add(quantity("voltage", "V", positive,
                    "armature voltage U, with resistance and constant in place of the two above"),
           &Keys::voltage)
      .add(quantity("resistance", "Ohm", positive, "armature resistance R: M_stall = k U/R"), &Keys::resistance)
      .add(quantity("constant", "N*m/A", positive, "motor constant k: ω₀ = U/k"), &Keys::constant)
      .add(quantity("rated_torque", "N*m", positive,
                    "M_N: scale of errors, and what duty is stated for; default: stall torque"),
           &Keys::rated_torque)
      .add(quantity("braking_resistance", "Ohm", positive,
                    "closes the armature while an operating sequence sets it 0, in series with it while reversed; "
                    "default: 0 opens the circuit"),
           &Keys::braking_resistance)
      .add(curve("field", {"time", "speed"}, "1",
                 "flux over the rated one, over the time or the speed (of either sense): weakened below 1 the "
                 "motor runs up to U/(f k)"),
           &Keys::field)
      .add(inertia_key("", "rotor inertia"), &Keys::inertia)
      .add(circuit_fields("L of the armature circuit"), &Keys::circuit)
      .add(rheostat_fields(), &Keys::rheostat)
      .add(window_fields(), &Keys::window)
      .add(duty_rating_fields(), &Keys::duty)
      .check(check_shunt);
}

template <FieldOver over>
void put_weakened(const Reading<ShuntKeys>& m, const std::string& name, Network& net, int node) {
  const FieldPart<over> field{m.field->curve()};
  using Over = Network::DataRange::Over;
  net.limit({.component = name,
             .of = "field",
             .over = over == FieldOver::time ? Over::time : Over::size_of_speed,
             .node = node,
             .unit = over == FieldOver::time ? "s" : "rad/s"},
            field.curve);
  const WeakenedShuntMotor<over> line{field, *m.voltage, *m.resistance, *m.constant, m.rated_torque};
  if (m.circuit.inductance)
    net.put(node, name, WeakenedShuntCircuit<over>{field, line, *m.circuit.inductance, m.circuit.initial_current},
            m.window);
  else
    net.put(node, name, line, m.window);
}

void build_dc_shunt(const Section& s, const Reading<ShuntKeys>& m, Network& net) {
  const int node = single_shaft(s, m.inertia, net);
  if (!m.valid()) return;
  MotorRating rating{.duty = m.duty};
  if (m.rated_torque > 0) rating.torque = m.rated_torque;
  net.data.add(s.name, rating);
  if (m.constant && !m.field) net.data.add(s.name, ArmatureCurrent{.by_square = 1 / (*m.constant * *m.constant)});
  if (!m.electrical())
    return net.put(node, s.name, DcShuntMotor{*m.stall_torque, *m.no_load_speed, m.rated_torque}, m.window);
  if (m.field)
    return m.field->over == "time" ? put_weakened<FieldOver::time>(m, s.name, net, node)
                                   : put_weakened<FieldOver::speed>(m, s.name, net, node);
  const double voltage = *m.voltage, resistance = *m.resistance, constant = *m.constant;
  const BrakedShuntMotor line{voltage, resistance, constant, m.rated_torque, {m.braking_resistance.value_or(0)}};
  if (put_with_circuit<DcShuntCircuit>(m.rheostat, m.circuit, s.name, m.window, line, net, node)) return;
  if (line.brake.resistance > 0)
    net.put(node, s.name, line, m.window);
  else
    net.put(node, s.name, DcShuntMotor{constant * voltage / resistance, voltage / constant, m.rated_torque}, m.window);
}

// --- series motor ---

struct SeriesKeys : DcSeriesMotor {
  std::optional<double> rated_speed;  // [rad/s]
  double inertia = 0;                 // [kg·m²]
  CircuitKeys circuit;
  RheostatKeys rheostat;
  Window window;
};

// R/κ says little of a motor's rated speed, which in machines is some 5 … 20 times as much. At 100 times the current is
// a hundredth of U/R and the torque 10⁻⁴ of the stall torque: no load of its size lets it come there.
double speed_limit(const SeriesKeys& m) { return m.rated_speed ? 5 * *m.rated_speed : 100 * m.base_speed(); }

Fields<SeriesKeys> series_fields() {
  using Keys = SeriesKeys;
  return Fields<Keys>()
      .add(required("voltage", "V", positive, "supply voltage U"), &Keys::voltage)
      .add(required("resistance", "Ohm", positive, "R of armature and field together"), &Keys::resistance)
      .add(required("constant", "N*m/A2", positive, "κ: torque over current squared"), &Keys::constant)
      .add(quantity("rated_speed", "rad/s", positive, "for the default of max_speed"), &Keys::rated_speed)
      .add(quantity("max_speed", "rad/s", positive,
                    "beyond it the motor ran away; default: 5 rated_speed, without it 100 R/κ, where the current "
                    "is a hundredth of U/R"),
           &Keys::max_speed, speed_limit)
      .add(inertia_key("", "rotor inertia"), &Keys::inertia)
      .add(circuit_fields("L of armature and field together"), &Keys::circuit)
      .add(rheostat_fields(), &Keys::rheostat)
      .add(window_fields(), &Keys::window)
      .check([](const Reading<Keys>& m) {
        constexpr double in_rpm = 30 / std::numbers::pi;
        if (m.rated_speed && m.max_speed <= *m.rated_speed)
          m.refuse(&Keys::max_speed, fmt::format("max_speed = {:.6g} rpm; must be above rated_speed = {:.6g} rpm",
                                                 m.max_speed * in_rpm, *m.rated_speed * in_rpm));
      });
}

void build_dc_series(const Section& s, const Reading<SeriesKeys>& m, Network& net) {
  const int node = single_shaft(s, m.inertia, net);
  net.data.add(s.name, ArmatureCurrent{.by_mean = 1 / m.constant});
  DcSeriesMotor motor = m;
  motor.name = s.name;
  if (const auto* unit = net.data.find<SpeedUnit>("")) motor.unit = *unit;
  if (!m.given(&SeriesKeys::max_speed))
    motor.limit_by = m.rated_speed ? "by default 5 rated_speed" : "by default 100 R/κ, as rated_speed is not given";
  if (!put_with_circuit<DcSeriesCircuit>(m.rheostat, m.circuit, s.name, m.window, motor, net, node))
    net.put(node, s.name, motor, m.window);
}

}  // namespace

std::vector<Kind> dc_kinds() {
  return {
      kind_of<shunt_fields, build_dc_shunt>(
          on_a_shaft, "dc shunt motor",
          "straight characteristic M = M_stall (1 − ω/ω₀); with its inductance the armature current is a state"),
      kind_of<series_fields, build_dc_series>(
          on_a_shaft, "dc series motor",
          "M = κ U²/(R + κ ω)², or with its inductance L di/dt = U − R i − κ ω i, M = κ i²; runs away where no load "
          "holds it, which ends the run"),
  };
}

}  // namespace kurbel
