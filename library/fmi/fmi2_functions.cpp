// fmi2_functions.cpp — every function of FMI 2.0; those of other types than Real and of steps that are on their way answer
// that they are not supported.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "library/fmi/component.h"
#include "library/fmi/fmi2.h"

namespace {

using namespace kurbel;
using namespace kurbel::fmi;

Component* of2(fmi2Component component) { return static_cast<Component*>(component); }
fmi2Status as2(Status status) { return static_cast<fmi2Status>(static_cast<int>(status)); }

template <class Do>
fmi2Status call2(fmi2Component component, const char* function, unsigned allowed, const Do& act) {
  return as2(guarded(of2(component), function, allowed, act));
}
fmi2Status all_are_real(fmi2Component component, const char* function, std::size_t count) {
  if (count == 0) return call2(component, function, anywhere, [](Component&) {});
  return as2(refused(of2(component), function, "all variables are of type Real"));
}

// "file:///tmp/a%20b" → "/tmp/a b"; a path as it is.
std::string path_of(const std::string& location) {
  std::string rest = location;
  if (rest.starts_with("file:")) {
    rest.erase(0, 5);
    if (rest.starts_with("//")) {
      const std::size_t slash = rest.find('/', 2);  // behind the host, which is this one
      rest.erase(0, slash == std::string::npos ? 2 : slash);
    }
  } else {
    return rest;
  }
  std::string path;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (rest[k] == '%' && k + 2 < rest.size()) {
      path += static_cast<char>(std::stoi(rest.substr(k + 1, 2), nullptr, 16));
      k += 2;
    } else {
      path += rest[k];
    }
  }
  return path;
}

}  // namespace

extern "C" {

#define KURBEL_FMI2 KURBEL_FMI_EXPORT fmi2Status

// --- the library, instances, their life (2.1.4 … 2.1.6) ---

KURBEL_FMI_EXPORT const char* fmi2GetTypesPlatform() { return "default"; }
KURBEL_FMI_EXPORT const char* fmi2GetVersion() { return "2.0"; }

KURBEL_FMI2 fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, std::size_t count,
                                const fmi2String categories[]) {
  return call2(component, "fmi2SetDebugLogging", anywhere,
               [&](Component& c) { set_debug_logging(c, on, count, categories); });
}

KURBEL_FMI_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String token, fmi2String location,
                                                const fmi2CallbackFunctions* functions, fmi2Boolean,
                                                fmi2Boolean logging) {
  if (!functions) return nullptr;
  auto c = std::make_unique<Component>();
  c->name = name ? name : "";
  c->logging = logging != 0;
  if (functions->logger)
    c->report = [whose = functions->componentEnvironment, logger = functions->logger, name = c->name](
                    Status status, const char* category, const std::string& text) {
      logger(whose, name.c_str(), as2(status), category, "%s", text.c_str());
    };
  if (c->name.empty() || !location) {
    c->log(Status::error, "logStatusError", c->name.empty() ? "an instance needs a name" : "no place of resources");
    return nullptr;
  }
  try {
    const std::string folder = path_of(location);
    return made(std::move(c), token, folder, type == fmi2CoSimulation);
  } catch (const std::exception&) {  // an escape that is none
    return nullptr;
  }
}

KURBEL_FMI_EXPORT void fmi2FreeInstance(fmi2Component component) { delete of2(component); }

KURBEL_FMI2 fmi2SetupExperiment(fmi2Component component, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop) {
  return call2(component, "fmi2SetupExperiment", instantiated,
               [&](Component& c) { set_up_experiment(c, tolerance_defined, tolerance, start, stop_defined, stop); });
}
KURBEL_FMI2 fmi2EnterInitializationMode(fmi2Component component) {
  return call2(component, "fmi2EnterInitializationMode", instantiated, [](Component& c) { c.phase = initialisation; });
}
KURBEL_FMI2 fmi2ExitInitializationMode(fmi2Component component) {
  return call2(component, "fmi2ExitInitializationMode", initialisation, [](Component& c) { end_initialisation(c); });
}
KURBEL_FMI2 fmi2Terminate(fmi2Component component) {
  return call2(component, "fmi2Terminate", running, [](Component& c) { c.phase = terminated; });
}
KURBEL_FMI2 fmi2Reset(fmi2Component component) {
  return call2(component, "fmi2Reset", anywhere, [](Component& c) { reset(c); });
}

// --- variables (2.1.7) ---

KURBEL_FMI2 fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                        fmi2Real values[]) {
  return call2(component, "fmi2GetReal", to_look, [&](Component& c) {
    for (std::size_t k = 0; k < count; ++k) values[k] = c.instance->value(references[k]);
  });
}
KURBEL_FMI2 fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                        const fmi2Real values[]) {
  return call2(component, "fmi2SetReal", set_up | running, [&](Component& c) {
    for (std::size_t k = 0; k < count; ++k) c.instance->set(references[k], values[k], c.phase & set_up);
  });
}
KURBEL_FMI2 fmi2GetInteger(fmi2Component component, const fmi2ValueReference*, std::size_t count, fmi2Integer*) {
  return all_are_real(component, "fmi2GetInteger", count);
}
KURBEL_FMI2 fmi2GetBoolean(fmi2Component component, const fmi2ValueReference*, std::size_t count, fmi2Boolean*) {
  return all_are_real(component, "fmi2GetBoolean", count);
}
KURBEL_FMI2 fmi2GetString(fmi2Component component, const fmi2ValueReference*, std::size_t count, fmi2String*) {
  return all_are_real(component, "fmi2GetString", count);
}
KURBEL_FMI2 fmi2SetInteger(fmi2Component component, const fmi2ValueReference*, std::size_t count, const fmi2Integer*) {
  return all_are_real(component, "fmi2SetInteger", count);
}
KURBEL_FMI2 fmi2SetBoolean(fmi2Component component, const fmi2ValueReference*, std::size_t count, const fmi2Boolean*) {
  return all_are_real(component, "fmi2SetBoolean", count);
}
KURBEL_FMI2 fmi2SetString(fmi2Component component, const fmi2ValueReference*, std::size_t count, const fmi2String*) {
  return all_are_real(component, "fmi2SetString", count);
}

// --- all of it, kept and restored (2.1.8) ---

KURBEL_FMI2 fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return call2(component, "fmi2GetFMUstate", anywhere & ~failed, [&](Component& c) { keep(c, state); });
}
KURBEL_FMI2 fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return call2(component, "fmi2SetFMUstate", anywhere, [&](Component& c) { restore(c, state); });
}
KURBEL_FMI2 fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return call2(component, "fmi2FreeFMUstate", anywhere, [&](Component&) { forget(state); });
}
KURBEL_FMI2 fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, std::size_t* size) {
  return call2(component, "fmi2SerializedFMUstateSize", anywhere,
               [&](Component& c) { *size = text_of(c, state).size(); });
}
KURBEL_FMI2 fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[], std::size_t size) {
  return call2(component, "fmi2SerializeFMUstate", anywhere, [&](Component& c) { serialise(c, state, bytes, size); });
}
KURBEL_FMI2 fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], std::size_t size,
                                    fmi2FMUstate* state) {
  return call2(component, "fmi2DeSerializeFMUstate", anywhere,
               [&](Component& c) { *state = deserialise(c, bytes, size); });
}

// --- derivatives (2.1.9) ---

KURBEL_FMI2 fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference unknowns[],
                                         std::size_t unknown_count, const fmi2ValueReference knowns[],
                                         std::size_t known_count, const fmi2Real seed[], fmi2Real sensitivity[]) {
  return call2(component, "fmi2GetDirectionalDerivative", to_look, [&](Component& c) {
    const auto found = c.instance->directional({unknowns, unknown_count}, {knowns, known_count}, {seed, known_count});
    std::copy(found.begin(), found.end(), sensitivity);
  });
}

// --- model exchange (clause 3.2) ---

KURBEL_FMI2 fmi2EnterEventMode(fmi2Component component) {
  return call2(component, "fmi2EnterEventMode", continuous_time | event_mode,
               [](Component& c) { c.phase = event_mode; });
}
KURBEL_FMI2 fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo* info) {
  return call2(component, "fmi2NewDiscreteStates", event_mode, [&](Component& c) {
    const Instance::Discrete found = c.instance->pass_events();
    c.log_events();
    *info = {0, 0, 0, found.states_changed, found.next.has_value(), found.next.value_or(0)};
  });
}
KURBEL_FMI2 fmi2EnterContinuousTimeMode(fmi2Component component) {
  return call2(component, "fmi2EnterContinuousTimeMode", event_mode, [](Component& c) { c.phase = continuous_time; });
}
KURBEL_FMI2 fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean, fmi2Boolean* enter_event_mode,
                                        fmi2Boolean* terminate) {
  return call2(component, "fmi2CompletedIntegratorStep", continuous_time, [&](Component& c) {
    *enter_event_mode = c.instance->wants_event();
    *terminate = 0;
  });
}
KURBEL_FMI2 fmi2SetTime(fmi2Component component, fmi2Real t) {
  return call2(component, "fmi2SetTime", continuous_time | event_mode, [&](Component& c) { set_time(c, t); });
}
KURBEL_FMI2 fmi2SetContinuousStates(fmi2Component component, const fmi2Real states[], std::size_t count) {
  return call2(component, "fmi2SetContinuousStates", continuous_time, [&](Component& c) {
    c.instance->set_states({states, count});
  });
}
static void check_count(std::size_t given, std::size_t count) {
  if (given != count) throw std::invalid_argument(fmt::format("{} values wanted; there are {}", given, count));
}
KURBEL_FMI2 fmi2GetDerivatives(fmi2Component component, fmi2Real rates[], std::size_t count) {
  return call2(component, "fmi2GetDerivatives", to_look, [&](Component& c) {
    check_count(count, c.instance->state_count());
    return rates_of(c, {rates, count});
  });
}
KURBEL_FMI2 fmi2GetEventIndicators(fmi2Component component, fmi2Real indicators[], std::size_t count) {
  return call2(component, "fmi2GetEventIndicators", to_look, [&](Component& c) {
    check_count(count, c.instance->indicator_count());
    c.instance->indicators({indicators, count});
  });
}
KURBEL_FMI2 fmi2GetContinuousStates(fmi2Component component, fmi2Real states[], std::size_t count) {
  return call2(component, "fmi2GetContinuousStates", to_look, [&](Component& c) {
    check_count(count, c.instance->state_count());
    c.instance->states({states, count});
  });
}
KURBEL_FMI2 fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real nominals[], std::size_t count) {
  return call2(component, "fmi2GetNominalsOfContinuousStates", instantiated | to_look, [&](Component& c) {
    check_count(count, c.instance->state_count());
    c.instance->nominals({nominals, count});
  });
}

// --- co-simulation (clause 4.2) ---

KURBEL_FMI2 fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference references[],
                                        std::size_t count, const fmi2Integer orders[], const fmi2Real values[]) {
  return call2(component, "fmi2SetRealInputDerivatives", set_up | step_mode, [&](Component& c) {
    for (std::size_t k = 0; k < count; ++k) {
      if (orders[k] != 1) throw std::invalid_argument("first derivatives of inputs alone are taken");
      c.instance->set_slope(references[k], values[k]);
    }
  });
}
KURBEL_FMI2 fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference*, std::size_t,
                                         const fmi2Integer*, fmi2Real*) {
  return as2(refused(of2(component), "fmi2GetRealOutputDerivatives", "maxOutputDerivativeOrder is 0"));
}
KURBEL_FMI2 fmi2DoStep(fmi2Component component, fmi2Real point, fmi2Real step, fmi2Boolean) {
  return call2(component, "fmi2DoStep", step_mode, [&](Component& c) {
    check_step(c, point, step);
    c.last_time = c.instance->go(step, nullptr);
    c.log_events();
  });
}
KURBEL_FMI2 fmi2CancelStep(fmi2Component component) {
  return as2(refused(of2(component), "fmi2CancelStep", "canRunAsynchronuously is false"));
}
KURBEL_FMI2 fmi2GetStatus(fmi2Component component, const fmi2StatusKind, fmi2Status*) {
  return call2(component, "fmi2GetStatus", anywhere, [](Component&) { return Status::discard; });
}
KURBEL_FMI2 fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real* value) {
  return call2(component, "fmi2GetRealStatus", anywhere, [&](Component& c) {
    if (kind != fmi2LastSuccessfulTime) return Status::discard;
    *value = c.last_time;
    return Status::ok;
  });
}
KURBEL_FMI2 fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind, fmi2Integer*) {
  return call2(component, "fmi2GetIntegerStatus", anywhere, [](Component&) { return Status::discard; });
}
KURBEL_FMI2 fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean* value) {
  return call2(component, "fmi2GetBooleanStatus", anywhere, [&](Component&) {
    if (kind != fmi2Terminated) return Status::discard;
    *value = 0;
    return Status::ok;
  });
}
KURBEL_FMI2 fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind, fmi2String*) {
  return call2(component, "fmi2GetStringStatus", anywhere, [](Component&) { return Status::discard; });
}

}  // extern "C"
