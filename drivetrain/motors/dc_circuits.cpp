// dc_circuits.cpp — what becomes of a series motor's current; the static laws without the effect "transients", also of
// a weakened field and on a rheostat.
#include "drivetrain/motors/dc_circuits.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <type_traits>

#include "drivetrain/motors/field_weakening.h"
#include "drivetrain/motors/rheostat.h"
#include "engine/elements/any_shaft_element.h"
#include "engine/scene/effects.h"

namespace kurbel {

ShaftForm under(const DcShuntCircuit& circuit, const Effects& effects) {
  const BrakedShuntMotor& line = circuit.line;
  if (effects.transients) return nullptr;
  if (line.brake.resistance > 0) return shaft_form(line);
  return shaft_form(DcShuntMotor{line.stall_torque(), line.voltage / line.constant, line.rated_torque});
}

ShaftForm under(const DcSeriesCircuit& circuit, const Effects& effects) {
  return effects.transients ? nullptr : shaft_form(circuit.line);
}

template <FieldOver over>
ShaftForm under(const WeakenedShuntCircuit<over>& circuit, const Effects& effects) {
  return effects.transients ? nullptr : shaft_form(circuit.line);
}

template ShaftForm under(const WeakenedShuntCircuit<FieldOver::time>&, const Effects&);
template ShaftForm under(const WeakenedShuntCircuit<FieldOver::speed>&, const Effects&);

template <class Circuit, CutOut when>
ShaftForm under(const OnRheostat<Circuit, when>& motor, const Effects& effects) requires(Circuit::is.states > 0) {
  if (under(motor.stages.back(), effects) == nullptr) return nullptr;
  OnRheostat<std::remove_cvref_t<decltype(motor.stages.back().line)>, when> line;
  for (const Circuit& stage : motor.stages) line.stages.push_back(stage.line);
  line.switch_current = motor.switch_current, line.times = motor.times;
  return shaft_form(line);
}

template ShaftForm under(const OnRheostat<DcShuntCircuit, CutOut::by_current>&, const Effects&);
template ShaftForm under(const OnRheostat<DcShuntCircuit, CutOut::by_time>&, const Effects&);
template ShaftForm under(const OnRheostat<DcSeriesCircuit, CutOut::by_current>&, const Effects&);
template ShaftForm under(const OnRheostat<DcSeriesCircuit, CutOut::by_time>&, const Effects&);

void DcSeriesCircuit::guard(const ShaftState<double>& x, double* g) const {
  constexpr double zero = 1e-9;  // of the command
  g[0] = x.mode & ran_away ? -1.0 : std::min(1.0, (line.max_speed - sense(x.mode) * x.rate) / line.max_speed);
  g[1] = std::min(1.0, most_current - std::abs(x.own[0]) / stall_current());
  g[2] = zero + sense(x.mode) * x.command;
}

int DcSeriesCircuit::next_mode(const ShaftState<double>& x, int which) const {
  if (which == 2) return x.mode ^ reversed;
  if (which == 1)
    throw std::runtime_error(fmt::format(
        "the current of series motor \"{}\" passed {:g} times its stall current U/R and grows without bound: driven "
        "backwards beyond −R/κ = {} it excites itself. Give it a lighter load, or more resistance",
        line.name, most_current, line.unit.text(-line.base_speed())));
  if (x.mode & ran_away) line.say_it_ran_away();
  return x.mode | ran_away;
}

std::string DcSeriesCircuit::mode_name(int mode) const {
  if (mode & ran_away) return line.mode_name(1);
  return mode & reversed ? "armature reversed" : "";
}

}  // namespace kurbel
