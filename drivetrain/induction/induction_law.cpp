// induction_law.cpp — what the keys of an induction motor make of it, and what is wrong with them.
#include "drivetrain/induction/induction_law.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "drivetrain/induction/nameplate.h"
#include "engine/numerics/angles.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Law = std::optional<InductionLaw>;
using Motor = Reading<InductionKeys>;
using Keys = InductionKeys;

// One speed must lie below another.
template <class M, class B>
bool below(const Motor& m, M B::*member, double speed, const char* other, double limit) {
  return speed < limit || m.refuse(member, fmt::format("{} = {:.6g} rpm; must be below {} = {:.6g} rpm", m.key(member),
                                                       in_rpm * speed, other, in_rpm * limit));
}

// Catalogues seldom say it; the field's seventh harmonic, forwards at a seventh of the speed, brakes just above that.
double pull_up_speed(const Motor& m) { return m.pull_up_speed.value_or(*m.synchronous_speed / 7); }

// Speeds and torques of the catalogue's points must follow each other as they do on a motor's curve.
bool points_fit(const Motor& m, double breakdown_speed) {
  bool fit = below(m, &Keys::breakdown_speed, breakdown_speed, "rated_speed", *m.rated_speed);
  if (m.given(&Keys::resistance_ratio))
    fit = m.refuse(&Keys::resistance_ratio,
                   "\"resistance_ratio\" belongs to Kloss' formula; with \"starting_ratio\" the points give the curve");
  if (breakdown_speed <= 0)
    fit = m.refuse(&Keys::breakdown_speed, fmt::format("breakdown_speed = {:.6g} rpm by these data; give it, > 0 rpm",
                                                       in_rpm * breakdown_speed));
  if (m.pull_up_speed && !m.pull_up_ratio)
    return m.refuse(&Keys::pull_up_speed, "\"pull_up_speed\" needs \"pull_up_ratio\", the least torque on the way up");
  if (m.pull_up_ratio) {
    fit = below(m, &Keys::pull_up_speed, pull_up_speed(m), "breakdown_speed", breakdown_speed) && fit;
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
  if (m.pull_up_ratio) points.pull_up = {pull_up_speed(m), *m.pull_up_ratio * at_voltage};
  return CatalogueMotor{points.curve(), synchronous, torque, breakdown_speed};
}

double mains_of(const Motor& m) { return m.frequency.value_or(m.mains); }

// The currents are states where the frequency is given; else the motor is its steady characteristic.
InductionLaw with_currents(const Motor& m, const TwoAxisMotor& motor) {
  if (m.frequency) return motor;
  return motor.line;
}

// Calls a function with every member that the circuit alone has.
void for_circuit(const auto& call) {
  call(&Keys::pole_pairs);
  for (const auto member : {&Keys::stator_resistance, &Keys::rotor_resistance, &Keys::stator_reactance,
                            &Keys::rotor_reactance, &Keys::magnetising_reactance})
    call(member);
}
constexpr std::optional<double> NameplateKeys::*currents[] = {&Keys::rated_current, &Keys::power_factor,
                                                              &Keys::efficiency};
constexpr std::optional<double> CatalogueKeys::*rated_point[] = {&Keys::rated_power, &Keys::rated_speed,
                                                                 &Keys::breakdown_ratio};

// The motor by its equivalent circuit.
Law law_by_circuit(const Motor& m) {
  const std::size_t before = m.messages().all().size();
  const auto missing = [&](auto member) {
    if (!m.given(member)) m.refuse(fmt::format("\"{}\" is missing beside the rest of its circuit", m.key(member)));
  };
  missing(&Keys::voltage);
  for_circuit(missing);
  m.keep_one(&Keys::frequency, &Keys::mains);
  const auto contradicts = [&](auto member) {
    if (m.given(member))
      m.refuse(member, fmt::format("\"{}\" is catalogue data, but its circuit is given too; keep one", m.key(member)));
  };
  for (const auto member : rated_point) contradicts(member);
  contradicts(&Keys::synchronous_speed);
  contradicts(&Keys::poles);
  contradicts(&Keys::breakdown_torque);
  contradicts(&Keys::breakdown_slip);
  contradicts(&Keys::resistance_ratio);
  contradicts(&Keys::starting_ratio);
  contradicts(&Keys::magnetising_ratio);
  contradicts(&Keys::stator_share);
  for (const auto member : currents) contradicts(member);
  if (m.starting != Starting::direct && m.frequency)
    m.refuse(&Keys::starting, fmt::format("starting = \"{}\" needs catalogue data; with the circuit let an operating "
                                          "sequence set the voltage",
                                          name_of(m.starting)));
  if (m.messages().all().size() > before) return {};
  const EquivalentCircuit circuit{.voltage = *m.voltage * m.voltage_factor,
                                  .frequency = mains_of(m),
                                  .pole_pairs = *m.pole_pairs,
                                  .stator_resistance = *m.stator_resistance,
                                  .rotor_resistance = *m.rotor_resistance,
                                  .stator_leakage = *m.stator_reactance,
                                  .rotor_leakage = *m.rotor_reactance,
                                  .magnetising = *m.magnetising_reactance};
  return with_currents(m, {circuit, circuit.characteristic()});
}

// Pole pairs of a circuit; 0: refused.
int pole_pairs_of(const Motor& m, double synchronous_speed) {
  const double pairs = 2 * std::numbers::pi * mains_of(m) / synchronous_speed;
  if (std::lround(pairs) >= 1 && std::abs(pairs - std::round(pairs)) < 1e-6 * pairs)
    return static_cast<int>(std::lround(pairs));
  const std::string text = fmt::format(
      "= {:g} Hz at {:.6g} rpm makes {:.6g} pole pairs; must be a whole number: frequency = pole pairs · "
      "synchronous_speed",
      mains_of(m), in_rpm * synchronous_speed, pairs);
  m.frequency ? m.refuse(&Keys::frequency, "frequency " + text) : m.refuse(&Keys::mains, "mains " + text);
  return 0;
}

// What the two-axis model cannot have.
bool suits_two_axes(const Motor& m) {
  bool valid = true;
  const auto refuse = [&](const std::string& text) { valid = m.refuse(&Keys::frequency, text); };
  if (m.starting_ratio)
    refuse(
        "\"frequency\" selects the two-axis model, whose characteristic is Kloss'; drop it, or "
        "\"starting_ratio\"");
  if (m.starting != Starting::direct)
    refuse(
        fmt::format("\"frequency\" selects the two-axis model, which starting = \"{}\" does not know; drop one of "
                    "them",
                    name_of(m.starting)));
  return valid;
}

// The circuit that has the catalogue's characteristic.
Law two_axis(const Motor& m, const InductionMotor& kloss) {
  // Without R_s the direct part of the stator's flux, there from the moment of switching on, would never decay: it
  // brakes and shakes at the supply's frequency for ever.
  const bool damped = kloss.resistance_ratio > 0 || m.starting_ratio ||
                      m.refuse(&Keys::frequency,
                               "\"frequency\" selects the two-axis model, whose stator must have a resistance; give "
                               "resistance_ratio = R_s/R_r′ > 0 (cage motors: about 1), or voltage, rated_current and "
                               "power_factor from the nameplate");
  if (!suits_two_axes(m) || pole_pairs_of(m, kloss.synchronous_speed) == 0 || !damped) return {};
  return TwoAxisMotor{EquivalentCircuit::of(kloss, *m.frequency, m.magnetising_ratio), kloss};
}

// What the currents of the nameplate need beside them, and do not go with.
bool nameplate_fits(const Motor& m) {
  bool fit = true;
  const auto refuse = [&](auto member, const std::string& text) { fit = m.refuse(member, text); };
  if (!m.rated_current) {
    if (m.voltage)
      refuse(&Keys::voltage, "\"voltage\" belongs to the nameplate's \"rated_current\", or to the motor's circuit");
    return m.drop_without(&Keys::rated_current, &Keys::power_factor, &Keys::efficiency, &Keys::stator_share) && fit;
  }
  if (!m.voltage)
    refuse(&Keys::rated_current, "\"rated_current\" needs \"voltage\", line to line, as the nameplate has it");
  if (!m.power_factor && !m.efficiency)
    refuse(&Keys::rated_current, "\"rated_current\" needs \"power_factor\" or \"efficiency\" from the nameplate");
  const auto estimated = [&](auto member) {
    if (m.given(member))
      refuse(member, fmt::format("\"{}\" is estimated from the nameplate's currents; keep one", m.key(member)));
  };
  estimated(&Keys::resistance_ratio);
  estimated(&Keys::magnetising_ratio);
  if (m.breakdown_torque)
    refuse(&Keys::breakdown_torque, "the nameplate's currents go with rated_power, rated_speed and breakdown_ratio");
  return fit;
}

// The circuit as the nameplate's currents have it.
Law law_by_nameplate(const Motor& m) {
  const int pairs = pole_pairs_of(m, *m.synchronous_speed);
  if (pairs == 0 || (m.frequency && !suits_two_axes(m))) return {};
  const double apparent = std::sqrt(3.0) * *m.voltage * *m.rated_current;  // S_n [VA]
  const double by_efficiency = *m.rated_power / m.efficiency.value_or(1);
  const double input = m.power_factor ? apparent * *m.power_factor : by_efficiency;
  if (m.power_factor && m.efficiency && std::abs(input - by_efficiency) > 0.05 * by_efficiency) {
    m.refuse(&Keys::efficiency, fmt::format("takes √3 U I cos φ = {} by its current, but P/η = {} by its efficiency; "
                                            "must agree within 5 %",
                                            with_unit(input / 1e3, "kW", 4), with_unit(by_efficiency / 1e3, "kW", 4)));
    return {};
  }
  if (input >= apparent) {
    m.refuse(&Keys::rated_current, fmt::format("takes {} but √3 U I_n is {} kVA only; rated_current, voltage or "
                                               "efficiency is too small",
                                               with_unit(input / 1e3, "kW", 4), fmt::format("{:.4g}", apparent / 1e3)));
    return {};
  }
  const Nameplate plate{.rated_power = *m.rated_power,
                        .rated_speed = *m.rated_speed,
                        .voltage = *m.voltage,
                        .frequency = mains_of(m),
                        .pole_pairs = pairs,
                        .current = *m.rated_current,
                        .input_power = input,
                        .breakdown_torque = *m.breakdown_ratio * *m.rated_power / *m.rated_speed,
                        .stator_share = m.stator_share};
  NameplateCircuit found = circuit_of(plate);
  if (!found.fault.empty()) {
    m.refuse(&Keys::rated_current, found.fault);
    return {};
  }
  found.circuit.voltage *= m.voltage_factor;
  return with_currents(m, {found.circuit, found.circuit.characteristic(plate.rated_torque()), plate.rated_slip()});
}

// The synchronous speed by the poles where they are given.
bool settle_speed(Motor& m) {
  if (!m.keep_one(&Keys::synchronous_speed, &Keys::poles)) return false;
  if (!m.poles) return m.rated_current || m.drop_without(&Keys::poles, &Keys::mains);
  if (*m.poles % 2 != 0) return m.refuse(&Keys::poles, fmt::format("poles = {}; must be even", *m.poles));
  if (!m.keep_one(&Keys::frequency, &Keys::mains)) return false;
  m.synchronous_speed = 4 * std::numbers::pi * mains_of(m) / *m.poles;
  return true;
}

// All that Kloss' curve needs: its rated point and breakdown ratio, or its breakdown point itself.
bool kloss_is_given(const Motor& m) {
  bool whole = true;
  const char* const needed =
      "rated_power, rated_speed, synchronous_speed (or poles) and breakdown_ratio from the catalogue, or "
      "breakdown_torque and breakdown_slip, or the motor's circuit";
  const auto need = [&](auto member) {
    if (!(m.*member)) whole = m.refuse(fmt::format("\"{}\" is missing; give {}", m.key(member), needed));
  };
  if (!m.synchronous_speed && !m.given(&Keys::poles)) need(&Keys::synchronous_speed);
  if (!m.breakdown_torque && !m.breakdown_slip) {
    for (const auto member : rated_point) need(member);
    return whole;
  }
  need(&Keys::breakdown_torque);
  need(&Keys::breakdown_slip);
  whole = m.keep_one(&Keys::breakdown_ratio, &Keys::breakdown_torque) && whole;
  if (m.rated_power.has_value() != m.rated_speed.has_value())
    whole = m.refuse(m.rated_power ? &Keys::rated_power : &Keys::rated_speed,
                     "give both \"rated_power\" and \"rated_speed\", for the rated torque, or neither");
  if (m.starting_ratio && !m.rated_power)
    whole = m.refuse(&Keys::starting_ratio,
                     "\"starting_ratio\" is over the rated torque; give rated_power and rated_speed");
  return whole;
}

InductionMotor kloss_of(const Motor& m) {
  if (!m.breakdown_torque)
    return InductionMotor::from_catalogue(*m.rated_power, *m.rated_speed, *m.synchronous_speed, *m.breakdown_ratio,
                                          m.resistance_ratio, m.voltage_factor);
  const double rated = m.rated_power ? *m.rated_power / *m.rated_speed : 0.5 * *m.breakdown_torque;
  return {*m.breakdown_torque * m.voltage_factor * m.voltage_factor, *m.synchronous_speed, *m.breakdown_slip,
          m.resistance_ratio, rated};
}

bool above_rated_speed(const Motor& m, double synchronous) {
  if (!m.rated_speed || synchronous > *m.rated_speed) return true;
  if (m.poles)
    return m.refuse(&Keys::poles, fmt::format("poles = {} make a synchronous speed of {:.6g} rpm; must be above "
                                              "rated_speed = {:.6g} rpm",
                                              *m.poles, in_rpm * synchronous, in_rpm * *m.rated_speed));
  return m.refuse(&Keys::synchronous_speed, fmt::format("synchronous_speed = {:.6g} rpm; must be above rated_speed = "
                                                        "{:.6g} rpm",
                                                        in_rpm * synchronous, in_rpm * *m.rated_speed));
}

// The motor by its catalogue, or its nameplate.
Law law_by_catalogue(Motor m) {
  const std::size_t before = m.messages().all().size();
  const bool settled = settle_speed(m);
  if (!kloss_is_given(m) || !settled || !nameplate_fits(m) || !above_rated_speed(m, *m.synchronous_speed)) return {};
  if (m.breakdown_torque && m.rated_power) m.breakdown_ratio = *m.breakdown_torque * *m.rated_speed / *m.rated_power;
  InductionMotor kloss;
  if (m.rated_current) {
    const Law plate = law_by_nameplate(m);
    if (!plate || m.frequency) return plate;
    kloss = std::get<InductionMotor>(*plate);
  } else {
    kloss = kloss_of(m);
  }
  if (!kloss.has_no_pole())
    m.refuse(&Keys::resistance_ratio,
             fmt::format("no Kloss curve passes through these data; lower resistance_ratio = {}", m.resistance_ratio));
  const std::optional<CatalogueMotor> points = by_points(m, kloss);
  if (m.messages().all().size() > before) return {};
  if (m.frequency) return two_axis(m, kloss);
  if (points) return *points;
  return kloss;
}

}  // namespace

std::optional<InductionLaw> induction_law(const Reading<InductionKeys>& motor) {
  bool by_circuit = false;
  for_circuit([&](auto member) { by_circuit = by_circuit || motor.given(member); });
  return by_circuit ? law_by_circuit(motor) : law_by_catalogue(motor);
}

}  // namespace kurbel
