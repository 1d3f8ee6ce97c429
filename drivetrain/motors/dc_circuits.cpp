// dc_circuits.cpp — what becomes of a series motor's current; the static laws without the effect "transients".
#include "drivetrain/motors/dc_circuits.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

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
        "backwards beyond −R/κ = {:.6g} rpm it excites itself. Give it a lighter load, or more resistance",
        line.name, most_current, -line.base_speed() * 30 / std::numbers::pi));
  if (x.mode & ran_away) line.say_it_ran_away();
  return x.mode | ran_away;
}

std::string DcSeriesCircuit::mode_name(int mode) const {
  if (mode & ran_away) return line.mode_name(1);
  return mode & reversed ? "armature reversed" : "";
}

}  // namespace kurbel
