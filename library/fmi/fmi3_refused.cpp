// fmi3_refused.cpp — the functions of FMI 3.0 that answer that they are not supported: clocks, other types than Float64,
// configuration, what capabilities deny.
#include "library/fmi/fmi3_call.h"

namespace {

using namespace kurbel;
using namespace kurbel::fmi;

fmi3Status other_type(fmi3Instance instance, const char* function, std::size_t count) {
  if (count == 0) return call3(instance, function, anywhere, [](Component&) {});
  return as3(refused(of3(instance), function, "all variables are of type Float64"));
}
fmi3Status no_clocks(fmi3Instance instance, const char* function) {
  return as3(refused(of3(instance), function, "there are no clocks"));
}

}  // namespace

extern "C" {

// --- other types (2.2.6) ---

#define KURBEL_OTHER_TYPE(Type)                                                                                     \
  KURBEL_FMI3 fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, fmi3##Type*,       \
                            std::size_t) {                                                                          \
    return other_type(instance, "fmi3Get" #Type, count);                                                            \
  }                                                                                                                 \
  KURBEL_FMI3 fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, const fmi3##Type*, \
                            std::size_t) {                                                                          \
    return other_type(instance, "fmi3Set" #Type, count);                                                            \
  }
KURBEL_OTHER_TYPE(Float32)
KURBEL_OTHER_TYPE(Int8)
KURBEL_OTHER_TYPE(UInt8)
KURBEL_OTHER_TYPE(Int16)
KURBEL_OTHER_TYPE(UInt16)
KURBEL_OTHER_TYPE(Int32)
KURBEL_OTHER_TYPE(UInt32)
KURBEL_OTHER_TYPE(Int64)
KURBEL_OTHER_TYPE(UInt64)
KURBEL_OTHER_TYPE(Boolean)
KURBEL_OTHER_TYPE(String)
#undef KURBEL_OTHER_TYPE
KURBEL_FMI3 fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, std::size_t*,
                          fmi3Binary*, std::size_t) {
  return other_type(instance, "fmi3GetBinary", count);
}
KURBEL_FMI3 fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, const std::size_t*,
                          const fmi3Binary*, std::size_t) {
  return other_type(instance, "fmi3SetBinary", count);
}
KURBEL_FMI3 fmi3GetClock(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, fmi3Clock*) {
  return other_type(instance, "fmi3GetClock", count);
}
KURBEL_FMI3 fmi3SetClock(fmi3Instance instance, const fmi3ValueReference*, std::size_t count, const fmi3Clock*) {
  return other_type(instance, "fmi3SetClock", count);
}

// Those of scalars do not change: the description says them (2.2.10).
KURBEL_FMI3 fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference, std::size_t*) {
  return as3(refused(of3(instance), "fmi3GetNumberOfVariableDependencies", "providesPerElementDependencies is false"));
}
KURBEL_FMI3 fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference, std::size_t*, fmi3ValueReference*,
                                        std::size_t*, fmi3DependencyKind*, std::size_t) {
  return as3(refused(of3(instance), "fmi3GetVariableDependencies", "providesPerElementDependencies is false"));
}

// --- configuration: there are no structural parameters (2.2.9); clocks: there are none (2.2.12) ---

KURBEL_FMI3 fmi3EnterConfigurationMode(fmi3Instance instance) {
  return as3(refused(of3(instance), "fmi3EnterConfigurationMode", "there are no structural parameters"));
}
KURBEL_FMI3 fmi3ExitConfigurationMode(fmi3Instance instance) {
  return as3(refused(of3(instance), "fmi3ExitConfigurationMode", "there are no structural parameters"));
}
KURBEL_FMI3 fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t, fmi3Float64*,
                                   fmi3IntervalQualifier*) {
  return no_clocks(instance, "fmi3GetIntervalDecimal");
}
KURBEL_FMI3 fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t, fmi3UInt64*,
                                    fmi3UInt64*, fmi3IntervalQualifier*) {
  return no_clocks(instance, "fmi3GetIntervalFraction");
}
KURBEL_FMI3 fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t, fmi3Float64*) {
  return no_clocks(instance, "fmi3GetShiftDecimal");
}
KURBEL_FMI3 fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t, fmi3UInt64*,
                                 fmi3UInt64*) {
  return no_clocks(instance, "fmi3GetShiftFraction");
}
KURBEL_FMI3 fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t, const fmi3Float64*) {
  return no_clocks(instance, "fmi3SetIntervalDecimal");
}
KURBEL_FMI3 fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t, const fmi3UInt64*,
                                    const fmi3UInt64*) {
  return no_clocks(instance, "fmi3SetIntervalFraction");
}
KURBEL_FMI3 fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference*, std::size_t, const fmi3Float64*) {
  return no_clocks(instance, "fmi3SetShiftDecimal");
}
KURBEL_FMI3 fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference*, std::size_t, const fmi3UInt64*,
                                 const fmi3UInt64*) {
  return no_clocks(instance, "fmi3SetShiftFraction");
}
KURBEL_FMI3 fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference, fmi3Float64) {
  return no_clocks(instance, "fmi3ActivateModelPartition");
}

// --- what capabilities deny (3.3, 4.3) ---

KURBEL_FMI3 fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return as3(refused(of3(instance), "fmi3EvaluateDiscreteStates", "providesEvaluateDiscreteStates is false"));
}
KURBEL_FMI3 fmi3EnterStepMode(fmi3Instance instance) {
  return as3(refused(of3(instance), "fmi3EnterStepMode", "hasEventMode is false"));
}
KURBEL_FMI3 fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference*, std::size_t, const fmi3Int32*,
                                     fmi3Float64*, std::size_t) {
  return as3(refused(of3(instance), "fmi3GetOutputDerivatives", "maxOutputDerivativeOrder is 0"));
}

}  // extern "C"
