// fmi3_functions.cpp — the functions of FMI 3.0 that do something; the others: fmi3_refused.cpp.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "library/fmi/fmi3_call.h"

namespace {

using namespace kurbel;
using namespace kurbel::fmi;

Component* instantiate(fmi3String name, fmi3String token, fmi3String folder, bool logging,
                       fmi3InstanceEnvironment whose, fmi3LogMessageCallback logger, bool co_simulation,
                       const char* why_not = nullptr) {
  auto c = std::make_unique<Component>();
  c->name = name ? name : "";
  c->logging = logging;
  if (logger)
    c->report = [whose, logger](Status status, const char* category, const std::string& text) {
      logger(whose, as3(status), category, text.c_str());
    };
  if (c->name.empty()) why_not = "an instance needs a name";
  if (!folder) why_not = "the path of the resources is missing";
  if (why_not) {
    c->log(Status::error, "logStatusError", why_not);
    return nullptr;
  }
  return made(std::move(c), token, folder, co_simulation);
}

bool same_count(std::size_t a, std::size_t b) {
  if (a != b) throw std::invalid_argument("as many values as value references are needed: all variables are scalars");
  return true;
}
}  // namespace

extern "C" {

// --- the library, instances, their life (2.2.2 … 2.2.4) ---

KURBEL_FMI_EXPORT const char* fmi3GetVersion() { return "3.0"; }

KURBEL_FMI3 fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t count,
                                const fmi3String categories[]) {
  return call3(instance, "fmi3SetDebugLogging", anywhere,
               [&](Component& c) { set_debug_logging(c, on, count, categories); });
}

KURBEL_FMI_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String folder,
                                                            fmi3Boolean, fmi3Boolean logging,
                                                            fmi3InstanceEnvironment whose,
                                                            fmi3LogMessageCallback logger) {
  return instantiate(name, token, folder, logging, whose, logger, false);
}

KURBEL_FMI_EXPORT fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String folder, fmi3Boolean, fmi3Boolean logging, fmi3Boolean event_mode_used,
    fmi3Boolean may_return_early, const fmi3ValueReference required[], std::size_t required_count,
    fmi3InstanceEnvironment whose, fmi3LogMessageCallback logger, fmi3IntermediateUpdateCallback update) {
  Component* const c = instantiate(name, token, folder, logging, whose, logger, true,
                                   event_mode_used ? "event mode is not offered in co-simulation" : nullptr);
  if (!c) return nullptr;
  for (std::size_t k = 0; k < required_count; ++k)
    if (required[k] >= c->instance->view().variables.size()) {
      c->log(Status::error, "logStatusError", "an intermediate variable does not exist");
      delete c;
      return nullptr;
    }
  if (update)
    c->look = [=](double t) {
      c->phase = within_step;
      fmi3Boolean wanted = false;
      fmi3Float64 until = t;
      update(whose, t, false, true, true, may_return_early, &wanted, &until);
      c->phase = step_mode;
      return !(may_return_early && wanted && until <= t);
    };
  return c;
}

KURBEL_FMI_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String folder,
                                                                 fmi3Boolean, fmi3Boolean logging,
                                                                 fmi3InstanceEnvironment whose,
                                                                 fmi3LogMessageCallback logger, fmi3ClockUpdateCallback,
                                                                 fmi3LockPreemptionCallback,
                                                                 fmi3UnlockPreemptionCallback) {
  return instantiate(name, token, folder, logging, whose, logger, true, "scheduled execution is not offered");
}

KURBEL_FMI_EXPORT void fmi3FreeInstance(fmi3Instance instance) { delete of3(instance); }

KURBEL_FMI3 fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_defined, fmi3Float64 tolerance,
                                        fmi3Float64 start, fmi3Boolean stop_defined, fmi3Float64 stop) {
  return call3(instance, "fmi3EnterInitializationMode", instantiated, [&](Component& c) {
    set_up_experiment(c, tolerance_defined, tolerance, start, stop_defined, stop);
    c.phase = initialisation;
  });
}

KURBEL_FMI3 fmi3ExitInitializationMode(fmi3Instance instance) {
  return call3(instance, "fmi3ExitInitializationMode", initialisation, [](Component& c) { end_initialisation(c); });
}

KURBEL_FMI3 fmi3EnterEventMode(fmi3Instance instance) {
  return call3(instance, "fmi3EnterEventMode", continuous_time, [](Component& c) { c.phase = event_mode; });
}

KURBEL_FMI3 fmi3Terminate(fmi3Instance instance) {
  return call3(instance, "fmi3Terminate", running, [](Component& c) { c.phase = terminated; });
}

KURBEL_FMI3 fmi3Reset(fmi3Instance instance) {
  return call3(instance, "fmi3Reset", anywhere & ~within_step, [](Component& c) { reset(c); });
}

// --- variables (2.2.6) ---

KURBEL_FMI3 fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[], std::size_t count,
                           fmi3Float64 values[], std::size_t value_count) {
  return call3(instance, "fmi3GetFloat64", instantiated | to_look | within_step, [&](Component& c) {
    same_count(count, value_count);
    for (std::size_t k = 0; k < count; ++k) values[k] = c.instance->value(references[k]);
  });
}
KURBEL_FMI3 fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[], std::size_t count,
                           const fmi3Float64 values[], std::size_t value_count) {
  return call3(instance, "fmi3SetFloat64", set_up | running, [&](Component& c) {
    same_count(count, value_count);
    for (std::size_t k = 0; k < count; ++k) c.instance->set(references[k], values[k], c.phase & set_up);
  });
}

// --- all of it, kept and restored (2.2.8) ---

KURBEL_FMI3 fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return call3(instance, "fmi3GetFMUState", anywhere & ~(failed | within_step), [&](Component& c) { keep(c, state); });
}
KURBEL_FMI3 fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return call3(instance, "fmi3SetFMUState", anywhere & ~within_step, [&](Component& c) { restore(c, state); });
}
KURBEL_FMI3 fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return call3(instance, "fmi3FreeFMUState", anywhere, [&](Component&) { forget(state); });
}
KURBEL_FMI3 fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, std::size_t* size) {
  return call3(instance, "fmi3SerializedFMUStateSize", anywhere & ~within_step,
               [&](Component& c) { *size = text_of(c, state).size(); });
}
KURBEL_FMI3 fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], std::size_t size) {
  return call3(instance, "fmi3SerializeFMUState", anywhere & ~within_step,
               [&](Component& c) { serialise(c, state, bytes, size); });
}
KURBEL_FMI3 fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], std::size_t size,
                                    fmi3FMUState* state) {
  return call3(instance, "fmi3DeserializeFMUState", anywhere & ~within_step,
               [&](Component& c) { *state = deserialise(c, bytes, size); });
}

// --- derivatives (2.2.11) ---

KURBEL_FMI3 fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                         std::size_t unknown_count, const fmi3ValueReference knowns[],
                                         std::size_t known_count, const fmi3Float64 seed[], std::size_t seed_count,
                                         fmi3Float64 sensitivity[], std::size_t sensitivity_count) {
  return call3(instance, "fmi3GetDirectionalDerivative", to_look, [&](Component& c) {
    same_count(known_count, seed_count), same_count(unknown_count, sensitivity_count);
    const auto found = c.instance->directional({unknowns, unknown_count}, {knowns, known_count}, {seed, seed_count});
    std::copy(found.begin(), found.end(), sensitivity);
  });
}
KURBEL_FMI3 fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                     std::size_t unknown_count, const fmi3ValueReference knowns[],
                                     std::size_t known_count, const fmi3Float64 seed[], std::size_t seed_count,
                                     fmi3Float64 sensitivity[], std::size_t sensitivity_count) {
  return call3(instance, "fmi3GetAdjointDerivative", to_look, [&](Component& c) {
    same_count(unknown_count, seed_count), same_count(known_count, sensitivity_count);
    const double one = 1;
    for (std::size_t k = 0; k < known_count; ++k) {
      const auto column = c.instance->directional({unknowns, unknown_count}, {knowns + k, 1}, {&one, 1});
      sensitivity[k] = 0;
      for (std::size_t u = 0; u < unknown_count; ++u) sensitivity[k] += seed[u] * column[u];
    }
  });
}

// --- model exchange (clause 3.2) ---

KURBEL_FMI3 fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean* need_update, fmi3Boolean* terminate,
                                     fmi3Boolean* nominals_changed, fmi3Boolean* states_changed,
                                     fmi3Boolean* next_defined, fmi3Float64* next) {
  return call3(instance, "fmi3UpdateDiscreteStates", event_mode, [&](Component& c) {
    const Instance::Discrete found = c.instance->pass_events();
    c.log_events();
    *need_update = *terminate = *nominals_changed = false;
    *states_changed = found.states_changed;
    *next_defined = found.next.has_value();
    *next = found.next.value_or(0);
  });
}
KURBEL_FMI3 fmi3EnterContinuousTimeMode(fmi3Instance instance) {
  return call3(instance, "fmi3EnterContinuousTimeMode", event_mode, [](Component& c) {
    if (c.co_simulation) throw std::invalid_argument("this instance is one of co-simulation");
    c.phase = continuous_time;
  });
}
KURBEL_FMI3 fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean, fmi3Boolean* enter_event_mode,
                                        fmi3Boolean* terminate) {
  return call3(instance, "fmi3CompletedIntegratorStep", continuous_time, [&](Component& c) {
    *enter_event_mode = c.instance->wants_event();
    *terminate = false;
  });
}
KURBEL_FMI3 fmi3SetTime(fmi3Instance instance, fmi3Float64 t) {
  return call3(instance, "fmi3SetTime", continuous_time | event_mode, [&](Component& c) { set_time(c, t); });
}
KURBEL_FMI3 fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 states[], std::size_t count) {
  return call3(instance, "fmi3SetContinuousStates", continuous_time, [&](Component& c) {
    c.instance->set_states({states, count});
  });
}
KURBEL_FMI3 fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 rates[], std::size_t count) {
  return call3(instance, "fmi3GetContinuousStateDerivatives", to_look, [&](Component& c) {
    same_count(count, c.instance->state_count());
    return rates_of(c, {rates, count});
  });
}
KURBEL_FMI3 fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 indicators[], std::size_t count) {
  return call3(instance, "fmi3GetEventIndicators", to_look, [&](Component& c) {
    same_count(count, c.instance->indicator_count());
    c.instance->indicators({indicators, count});
  });
}
KURBEL_FMI3 fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 states[], std::size_t count) {
  return call3(instance, "fmi3GetContinuousStates", to_look, [&](Component& c) {
    same_count(count, c.instance->state_count());
    c.instance->states({states, count});
  });
}
KURBEL_FMI3 fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], std::size_t count) {
  return call3(instance, "fmi3GetNominalsOfContinuousStates", to_look, [&](Component& c) {
    same_count(count, c.instance->state_count());
    c.instance->nominals({nominals, count});
  });
}
KURBEL_FMI3 fmi3GetNumberOfEventIndicators(fmi3Instance instance, std::size_t* count) {
  return call3(instance, "fmi3GetNumberOfEventIndicators", instantiated | to_look,
               [&](Component& c) { *count = c.instance->indicator_count(); });
}
KURBEL_FMI3 fmi3GetNumberOfContinuousStates(fmi3Instance instance, std::size_t* count) {
  return call3(instance, "fmi3GetNumberOfContinuousStates", instantiated | to_look,
               [&](Component& c) { *count = c.instance->state_count(); });
}

// --- co-simulation (clause 4.2) ---

KURBEL_FMI3 fmi3DoStep(fmi3Instance instance, fmi3Float64 point, fmi3Float64 step, fmi3Boolean,
                       fmi3Boolean* event_handling_needed, fmi3Boolean* terminate, fmi3Boolean* early_return,
                       fmi3Float64* last_time) {
  return call3(instance, "fmi3DoStep", step_mode, [&](Component& c) {
    check_step(c, point, step);
    *event_handling_needed = *terminate = *early_return = false;
    const double to = c.instance->time() + step;
    *last_time = c.instance->go(step, c.look);
    c.log_events();
    c.last_time = *last_time;
    *early_return = *last_time < to;
  });
}

}  // extern "C"
