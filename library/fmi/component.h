// component.h — the object behind an instance handle of FMI 2.0 or 3.0: the machine instance, its phase and its
// logger.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "library/fmi/instance.h"

namespace kurbel::fmi {

// Numbered as in both versions.
enum class Status { ok, warning, discard, error, fatal };

// Phase of an instance; a set of phases says when a function may be called.
enum Phase : unsigned {
  instantiated = 1,
  initialisation = 2,
  event_mode = 4,
  continuous_time = 8,
  step_mode = 16,
  terminated = 32,
  failed = 64,
  within_step = 128,  // during a callback to the importer
  configuration = 256,
  set_up = instantiated | initialisation,
  running = event_mode | continuous_time | step_mode,
  to_look = initialisation | running | terminated | failed,  // values may be requested
  anywhere = 511
};
inline const char* name_of(unsigned phase) {
  switch (phase) {
    case instantiated:
      return "the instance has just been made";
    case initialisation:
      return "initialisation";
    case event_mode:
      return "event mode";
    case continuous_time:
      return "continuous-time mode";
    case step_mode:
      return "step mode";
    case terminated:
      return "the simulation has been ended";
    case failed:
      return "the instance has failed";
    case within_step:
      return "a step is on its way";
    default:
      return "configuration";
  }
}

struct Component {
  std::string name;
  bool co_simulation = false;
  unsigned phase = instantiated;
  bool logging = false;                      // errors are always logged
  std::vector<std::string> categories = {};  // categories to log; empty: all
  std::unique_ptr<Instance> instance;
  std::function<void(Status, const char* category, const std::string&)> report;
  std::function<bool(double t)> look;  // called at the end of each integrator step; false: the importer stops
  double last_time = 0;                // end of the importer's last step

  // Throws std::invalid_argument for an unknown category. Messages carry the time.
  void log_only(bool on, std::vector<std::string> wanted) {
    for (const std::string& category : wanted)
      if (category != "logEvents" && category != "logStatusError")
        throw std::invalid_argument("there is no category " + category + " of messages");
    logging = on;
    categories = std::move(wanted);
  }
  void log(Status status, const char* category, const std::string& text) const {
    const bool always = status >= Status::error;
    const bool wanted = categories.empty() || std::count(categories.begin(), categories.end(), category) > 0;
    if (!report || (!always && !(logging && wanted))) return;
    report(status, category, instance ? fmt::format("t = {:.9g} s: {}", instance->time(), text) : text);
  }
  void log_events() const {
    for (const Event& event : instance->take_events())
      log(Status::ok, "logEvents", fmt::format("at {:.12g} s {}: {}", event.t, event.component, event.what));
  }
};

// Does what a function of the interface does; whatever is wrong is logged, and nothing is thrown. A fault of the call
// leaves the instance as it was; one of the machine ends its life.
inline Status guarded(Component* c, const char* function, unsigned allowed, const void* of,
                      Status (*act)(const void* of, Component& c)) {
  if (!c) return Status::error;
  if (!(c->phase & allowed)) {
    c->log(Status::error, "logStatusError", fmt::format("{} cannot be called now: {}", function, name_of(c->phase)));
    return Status::error;
  }
  try {
    return act(of, *c);
  } catch (const std::invalid_argument& fault) {
    c->log(Status::error, "logStatusError", fmt::format("{}: {}", function, fault.what()));
  } catch (const std::exception& fault) {
    c->phase = failed;
    c->log(Status::error, "logStatusError", fmt::format("{}: {}", function, fault.what()));
  } catch (...) {
    c->phase = failed;
  }
  return Status::error;
}
// What returns nothing is well when it ends.
template <class Do>
Status guarded(Component* c, const char* function, unsigned allowed, const Do& act) {
  return guarded(c, function, allowed, &act, [](const void* of, Component& component) {
    const Do& does = *static_cast<const Do*>(of);
    if constexpr (std::is_void_v<decltype(does(component))>) {
      does(component);
      return Status::ok;
    } else {
      return does(component);
    }
  });
}

// What functions of both versions do.
inline void set_debug_logging(Component& c, bool on, std::size_t count, const char* const categories[]) {
  std::vector<std::string> wanted;
  for (std::size_t k = 0; k < count; ++k) wanted.emplace_back(categories[k] ? categories[k] : "");
  c.log_only(on, std::move(wanted));
}
inline void set_up_experiment(Component& c, bool tolerance_defined, double tolerance, double start, bool stop_defined,
                              double stop) {
  if (!std::isfinite(start) || (stop_defined && !(stop >= start)))
    throw std::invalid_argument("the simulation must end behind its start");
  if (tolerance_defined && !(tolerance > 0)) throw std::invalid_argument("the tolerance must be positive");
  c.instance->set_up(start, tolerance_defined ? std::optional(tolerance) : std::nullopt);
}
inline void end_initialisation(Component& c) {
  c.instance->begin();
  c.phase = c.co_simulation ? step_mode : event_mode;
  c.last_time = c.instance->time();
}
inline void reset(Component& c) {
  c.instance->reset();
  c.phase = instantiated;
}
inline void set_time(Component& c, double t) {
  if (!std::isfinite(t)) throw std::invalid_argument("the time is no number");
  c.instance->set_time(t);
}

// All of an instance as an importer keeps it, and as bytes: the phase, the time, and what the instance says of itself.
struct Kept {
  InstanceState state;
  unsigned phase = 0;
  double last_time = 0;
};
inline const Kept& kept(const void* state) {
  if (!state) throw std::invalid_argument("there is no state");
  return *static_cast<const Kept*>(state);
}
inline void keep(Component& c, void** state) {
  if (!state) throw std::invalid_argument("there is no place for the state");
  auto now = std::make_unique<Kept>(Kept{c.instance->state(), c.phase, c.last_time});
  delete static_cast<Kept*>(*state);  // given back: taken anew
  *state = now.release();
}
inline void restore(Component& c, const void* state) {
  const Kept& to = kept(state);
  c.instance->restore(to.state);
  c.phase = to.phase, c.last_time = to.last_time;
}
inline void forget(void** state) {
  if (!state) return;
  delete static_cast<Kept*>(*state);
  *state = nullptr;
}
inline std::string text_of(Component& c, const void* state) {
  const Kept& of = kept(state);
  return fmt::format("{} {} ", of.phase, of.last_time) + c.instance->text(of.state);
}
inline void serialise(Component& c, const void* state, void* bytes, std::size_t size) {
  const std::string text = text_of(c, state);
  if (size != text.size()) throw std::invalid_argument("the size is not that of the serialised state");
  std::copy(text.begin(), text.end(), static_cast<char*>(bytes));
}
inline void* deserialise(Component& c, const void* bytes, std::size_t size) {
  const std::string text(static_cast<const char*>(bytes), size);
  std::istringstream stream(text);
  auto of = std::make_unique<Kept>();
  if (!(stream >> of->phase >> of->last_time)) throw std::invalid_argument("this is no state of this component");
  stream.get();
  of->state = c.instance->state_from(text.substr(static_cast<std::size_t>(stream.tellg())));
  return of.release();
}

// A communication point differs from where the last step ended by round-off at most.
inline bool is_at(double point, double t) { return std::abs(point - t) <= 1e-9 * std::max(1.0, std::abs(t)); }

inline void check_step(const Component& c, double point, double step) {
  if (!is_at(point, c.instance->time()))
    throw std::invalid_argument(fmt::format("the step begins at {:.9g} s, where the instance is not", point));
  if (!(step > 0) || !std::isfinite(step)) throw std::invalid_argument("the step must be longer than 0");
}

inline Status rates_of(Component& c, std::span<double> rates) {
  if (c.instance->derivatives(rates)) return Status::ok;
  c.log(Status::discard, "logStatusError",
        "states with which the rates are no finite numbers; a shorter step may help");
  return Status::discard;
}

inline Status refused(Component* c, const char* function, const char* why) {
  if (c) c->log(Status::error, "logStatusError", fmt::format("{}: {}", function, why));
  return Status::error;
}

// The component of this resources folder. Null, with a message, if it cannot be made.
inline Component* made(std::unique_ptr<Component> c, const char* token, std::string folder, bool co_simulation) {
  try {
    while (folder.ends_with("/")) folder.pop_back();
    std::ifstream file(folder + "/machine.json", std::ios::binary);
    if (!file) throw std::runtime_error(fmt::format("\"{}/machine.json\" cannot be read", folder));
    std::ostringstream text;
    text << file.rdbuf();
    ExportedMachine machine = ExportedMachine::from_text(text.str());
    if (!token || machine.token != token)
      throw std::invalid_argument(
          fmt::format("the token {} is not that of this component, {}", token ? token : "(none)", machine.token));
    if (co_simulation ? !machine.co_simulation : !machine.model_exchange)
      throw std::invalid_argument(
          fmt::format("this component was exported without {}", co_simulation ? "co-simulation" : "model exchange"));
    c->co_simulation = co_simulation;
    c->instance = std::make_unique<Instance>(std::move(machine), folder);
    return c.release();
  } catch (const std::exception& fault) {
    c->log(Status::error, "logStatusError", fault.what());
    return nullptr;
  }
}

}  // namespace kurbel::fmi
