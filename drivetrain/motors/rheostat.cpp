// rheostat.cpp — the static laws of motors on their rheostats, without the effect "transients".
#include "drivetrain/motors/rheostat.h"

#include <type_traits>

#include "engine/elements/any_shaft_element.h"
#include "engine/scene/effects.h"

namespace kurbel {

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

}  // namespace kurbel
