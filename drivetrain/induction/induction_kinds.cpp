// induction_kinds.cpp — induction motors from catalogue, nameplate or circuit, and how they are started.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "drivetrain/induction/induction_law.h"
#include "drivetrain/induction/lagging_motor.h"
#include "drivetrain/induction/started_motor.h"
#include "drivetrain/shared/kinds.h"
#include "engine/model/network.h"
#include "engine/numerics/angles.h"

namespace kurbel {

template <class Motor>
ShaftForm under(const LaggingMotor<Motor>& motor, const Effects& effects) {
  return effects.torque_lag ? nullptr : shaft_form(static_cast<const Motor&>(motor));
}

ShaftForm lagging_form(const TwoAxisMotor& motor) {
  return shaft_form(LaggingMotor(motor.line, {motor.line.breakdown_slip, motor.circuit.frequency}));
}

namespace {

using Motor = Reading<InductionKeys>;
using Keys = InductionKeys;

// A key of the starters belongs to some of their methods.
template <class Member>
void belongs_to(const Motor& m, Member member, std::initializer_list<Starting> owners) {
  if (!m.given(member) || std::find(owners.begin(), owners.end(), m.starting) != owners.end()) return;
  std::vector<std::string> names;
  for (const Starting owner : owners) names.push_back(name_of(owner));
  m.refuse(member, fmt::format("\"{}\" belongs to starting = {}; here it is \"{}\"", m.key(member), listed(names),
                               name_of(m.starting)));
}

// ω_s, where the motor came out [rad/s].
void check_start(const Motor& m, std::optional<double> synchronous_speed) {
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
    if (m.switch_speed && synchronous_speed && *m.switch_speed >= *synchronous_speed)
      m.refuse(&Keys::switch_speed,
               fmt::format("switch_speed = {:.6g} rpm; must be below synchronous_speed = {:.6g} rpm",
                           in_rpm * *m.switch_speed, in_rpm * *synchronous_speed));
  } else if (m.starting != Starting::direct && !m.ramp) {
    m.refuse(fmt::format("starting = \"{}\" needs \"ramp\", the time it takes", name_of(m.starting)));
  }
}

// The motor on its starter, its torque with the lag of its fluxes.
template <class Element>
void put_started(const std::string& name, const InductionKeys& m, const Element& motor, FluxLag lag, Network& net,
                 int node) {
  const double limit = m.torque_limit.value_or(HUGE_VAL);
  const auto put = [&](const auto& started) { net.put(node, name, LaggingMotor(started, lag), m.window); };
  const auto put_on = [&](const auto& starter, double limit_of_it) {
    put(StartedMotor<Element, std::remove_cvref_t<decltype(starter)>>{motor, starter, limit_of_it});
  };
  switch (m.starting) {
    case Starting::direct:
      return put(motor);
    case Starting::star_delta:
      return put_on(StarDelta{m.switch_time.value_or(-1), m.switch_speed.value_or(0), m.pause}, HUGE_VAL);
    case Starting::soft_start:
      return put_on(SoftStart{m.initial_voltage, *m.ramp}, limit);
    case Starting::frequency_converter:
      return put_on(
          FrequencyConverter{*m.ramp, m.target_speed.value_or(motor.synchronous_speed), motor.synchronous_speed},
          limit);
  }
}

double synchronous_speed_of(const InductionMotor& motor) { return motor.synchronous_speed; }
double synchronous_speed_of(const CatalogueMotor& motor) { return motor.synchronous_speed; }
double synchronous_speed_of(const TwoAxisMotor& motor) { return motor.line.synchronous_speed; }

// The mains that a synchronous speed [rad/s] belongs to, with a whole number of pole pairs; 50 Hz where both fit.
double mains_at(double synchronous_speed) {
  const auto fits = [&](double frequency) {
    const double pairs = 2 * std::numbers::pi * frequency / synchronous_speed;
    return std::lround(pairs) >= 1 && std::abs(pairs - std::round(pairs)) < 1e-6 * pairs;
  };
  return !fits(50) && fits(60) ? 60 : 50;
}

InductionData data_of(const InductionKeys& motor, const InductionLaw& law) {
  InductionData data;
  if (const auto* circuit = std::get_if<TwoAxisMotor>(&law))
    data = {circuit->line.rated_torque, circuit->line.synchronous_speed, circuit->line.breakdown_slip};
  else if (const auto* kloss = std::get_if<InductionMotor>(&law))
    data = {kloss->rated_torque, kloss->synchronous_speed, kloss->breakdown_slip};
  else if (const auto* points = std::get_if<CatalogueMotor>(&law))
    data = {points->rated_torque, points->synchronous_speed, 1 - points->breakdown_speed / points->synchronous_speed};
  data.mains = motor.frequency ? *motor.frequency : motor.poles ? motor.mains : mains_at(data.synchronous_speed);
  data.has_circuit = std::holds_alternative<TwoAxisMotor>(law);
  data.by_converter = motor.starting == Starting::frequency_converter;
  data.rated_speed = motor.rated_speed.value_or(0);
  return data;
}

InductionWindings windings_of(const InductionKeys& motor, const EquivalentCircuit& circuit) {
  InductionWindings windings{circuit.stator_resistance, circuit.rotor_resistance};
  if (motor.rated_speed)
    windings.rated_current = line_current(circuit, 1 - *motor.rated_speed / circuit.synchronous_speed()).current;
  return windings;
}

MotorRating rating_of(const InductionKeys& m) {
  MotorRating rating{.duty = m.duty};
  if (m.rated_power && m.rated_speed) rating.torque = *m.rated_power / *m.rated_speed;
  if (m.breakdown_torque)
    rating.breakdown = m.voltage_factor * m.voltage_factor * *m.breakdown_torque;
  else if (rating.torque && m.breakdown_ratio)
    rating.breakdown = m.voltage_factor * m.voltage_factor * *m.breakdown_ratio * *rating.torque;
  return rating;
}

void build_induction(const Section& s, const Reading<InductionKeys>& motor, Network& net) {
  const int node = single_shaft(s, motor.inertia, net);
  const std::size_t before = motor.messages().all().size();
  const auto law = induction_law(motor);
  std::optional<double> speed;
  if (law) speed = std::visit([](const auto& m) { return synchronous_speed_of(m); }, *law);
  check_start(motor, speed);
  if (!law || motor.messages().all().size() > before) return;
  const InductionData data = data_of(motor, *law);
  net.data.add(s.name, data);
  net.data.add(s.name, rating_of(motor));
  if (const auto* two_axis = std::get_if<TwoAxisMotor>(&*law)) {
    net.data.add(s.name, windings_of(motor, two_axis->circuit));
    return net.put(node, s.name, *two_axis, motor.window);
  }
  const FluxLag lag{data.breakdown_slip, data.mains};
  if (const auto* points = std::get_if<CatalogueMotor>(&*law))
    return put_started(s.name, motor, *points, lag, net, node);
  put_started(s.name, motor, std::get<InductionMotor>(*law), lag, net, node);
}

}  // namespace

std::vector<Kind> induction_kinds() {
  return {
      kind_of<induction_fields, build_induction>(
          on_a_shaft, "induction motor",
          "induction motor from its catalogue or nameplate: after Kloss (theory 4.1), or through its starting, "
          "pull-up, breakdown and rated points; with its frequency, its nameplate's currents or its circuit by the "
          "two-axis model"),
  };
}

}  // namespace kurbel
