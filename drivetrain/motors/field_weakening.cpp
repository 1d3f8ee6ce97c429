// field_weakening.cpp — the static law of a motor with weakened field, without the effect "transients".
#include "drivetrain/motors/field_weakening.h"

#include "engine/elements/any_shaft_element.h"
#include "engine/scene/effects.h"

namespace kurbel {

template <FieldOver over>
ShaftForm under(const WeakenedShuntCircuit<over>& circuit, const Effects& effects) {
  return effects.transients ? nullptr : shaft_form(circuit.line);
}

template ShaftForm under(const WeakenedShuntCircuit<FieldOver::time>&, const Effects&);
template ShaftForm under(const WeakenedShuntCircuit<FieldOver::speed>&, const Effects&);

}  // namespace kurbel
