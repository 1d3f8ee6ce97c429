// fmi3_call.h — dispatches a call of FMI 3.0 to its component.
#pragma once

#include "library/fmi/component.h"
#include "library/fmi/fmi3.h"

#define KURBEL_FMI3 KURBEL_FMI_EXPORT fmi3Status

namespace kurbel::fmi {

inline Component* of3(fmi3Instance instance) { return static_cast<Component*>(instance); }
inline fmi3Status as3(Status status) { return static_cast<fmi3Status>(static_cast<int>(status)); }

template <class Do>
fmi3Status call3(fmi3Instance instance, const char* function, unsigned allowed, const Do& act) {
  return as3(guarded(of3(instance), function, allowed, act));
}

}  // namespace kurbel::fmi
