// slave.cpp — one instance, driven by the functions of either version; an integrator for model exchange.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "tests/fmi/importer.h"

namespace importer {
namespace {

using Size = std::size_t;
using Ref = const unsigned*;

struct Callbacks2 {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(Size, Size);
  void (*free)(void*);
  void (*finished)(void*, int);
  void* environment;
};
struct EventInfo2 {
  int needed, terminate, nominals, states, defined;
  double next;
};

void log2(void* slave, const char*, int, const char*, const char* form, ...) {
  char text[4096];
  va_list list;
  va_start(list, form);
  std::vsnprintf(text, sizeof text, form, list);
  va_end(list);
  static_cast<Slave*>(slave)->logged.emplace_back(text);
}
void log3(void* slave, int, const char*, const char* message) {
  static_cast<Slave*>(slave)->logged.emplace_back(message);
}
void update3(void* slave, double t, bool, bool, bool, bool can_return, bool* wanted, double* until) {
  const auto& look = static_cast<Slave*>(slave)->onlooker;
  if (look && !look(t) && can_return) *wanted = true, *until = t;
}

}  // namespace

struct Slave::Callbacks {
  Callbacks2 two;
};

template <class F>
F Slave::function(const char* name) const {
  void* const found = library_.find((unpacked_.fmi == 3 ? "fmi3" : "fmi2") + std::string(name));
  if (!found) throw std::runtime_error(std::string("missing: ") + name);
  return reinterpret_cast<F>(found);
}

void Slave::expect(int status, const char* what) const {
  if (status != 0)
    throw std::runtime_error(std::string(what) + ": status " + std::to_string(status) +
                             (logged.empty() ? "" : ": " + logged.back()));
}

Slave::Slave(const Unpacked& unpacked, const Library& library, Kind kind, const std::string& name)
    : unpacked_(unpacked), library_(library), kind_(kind), callbacks_(std::make_unique<Callbacks>()) {
  const std::string resources = unpacked.folder + "/resources/";
  if (unpacked.fmi == 2) {
    callbacks_->two = {log2, nullptr, nullptr, nullptr, this};
    instance_ = function<void* (*)(const char*, int, const char*, const char*, const Callbacks2*, int, int)>(
        "Instantiate")(name.c_str(), kind == Kind::co_simulation ? 1 : 0, unpacked.token.c_str(),
                       ("file://" + resources).c_str(), &callbacks_->two, 0, 1);
  } else if (kind == Kind::co_simulation) {
    instance_ = function<void* (*)(const char*, const char*, const char*, bool, bool, bool, bool, Ref, Size, void*,
                                   void (*)(void*, int, const char*, const char*),
                                   void (*)(void*, double, bool, bool, bool, bool, bool*, double*))>(
        "InstantiateCoSimulation")(name.c_str(), unpacked.token.c_str(), resources.c_str(), false, true, false, true,
                                   nullptr, 0, this, log3, update3);
  } else {
    instance_ = function<void* (*)(const char*, const char*, const char*, bool, bool, void*,
                                   void (*)(void*, int, const char*, const char*))>("InstantiateModelExchange")(
        name.c_str(), unpacked.token.c_str(), resources.c_str(), false, true, this, log3);
  }
  if (!instance_) throw std::runtime_error("no instance" + (logged.empty() ? "" : ": " + logged.back()));
}

Slave::~Slave() {
  if (instance_) function<void (*)(void*)>("FreeInstance")(instance_);
}

void Slave::initialise(double start) {
  if (unpacked_.fmi == 2) {
    expect(function<int (*)(void*, int, double, double, int, double)>("SetupExperiment")(instance_, 0, 0, start, 0, 0),
           "set-up");
    expect(function<int (*)(void*)>("EnterInitializationMode")(instance_), "initialisation");
  } else {
    expect(function<int (*)(void*, bool, double, double, bool, double)>("EnterInitializationMode")(instance_, false, 0,
                                                                                                   start, false, 0),
           "initialisation");
  }
  expect(function<int (*)(void*)>("ExitInitializationMode")(instance_), "end of initialisation");
}

double Slave::get(unsigned reference) {
  double value = NAN;
  expect(unpacked_.fmi == 3
             ? function<int (*)(void*, Ref, Size, double*, Size)>("GetFloat64")(instance_, &reference, 1, &value, 1)
             : function<int (*)(void*, Ref, Size, double*)>("GetReal")(instance_, &reference, 1, &value),
         "get");
  return value;
}
void Slave::set(unsigned reference, double value) {
  expect(
      unpacked_.fmi == 3
          ? function<int (*)(void*, Ref, Size, const double*, Size)>("SetFloat64")(instance_, &reference, 1, &value, 1)
          : function<int (*)(void*, Ref, Size, const double*)>("SetReal")(instance_, &reference, 1, &value),
      "set");
}

void Slave::slope(const std::string& name, double value) {
  const unsigned reference = unpacked_[name].reference;
  const int order = 1;
  expect(function<int (*)(void*, Ref, Size, const int*, const double*)>("SetRealInputDerivatives")(
             instance_, &reference, 1, &order, &value),
         "slope");
}

double Slave::step(double t, double h) {
  if (unpacked_.fmi == 2) {
    expect(function<int (*)(void*, double, double, int)>("DoStep")(instance_, t, h, 0), "step");
    return t + h;
  }
  bool events = false, terminate = false, early = false;
  double last = NAN;
  expect(function<int (*)(void*, double, double, bool, bool*, bool*, bool*, double*)>("DoStep")(
             instance_, t, h, false, &events, &terminate, &early, &last),
         "step");
  if (events || terminate || early != (last < t + h)) throw std::runtime_error("what a step says of its end");
  return last;
}

int Slave::raw_step_in_wrong_state() {
  if (unpacked_.fmi == 2) return function<int (*)(void*, double, double, int)>("DoStep")(instance_, 0, 1, 0);
  bool a, b, c;
  double d;
  return function<int (*)(void*, double, double, bool, bool*, bool*, bool*, double*)>("DoStep")(instance_, 0, 1, false,
                                                                                                &a, &b, &c, &d);
}

void* Slave::keep() {
  void* state = nullptr;
  expect(function<int (*)(void*, void**)>(unpacked_.fmi == 3 ? "GetFMUState" : "GetFMUstate")(instance_, &state),
         "keep");
  return state;
}
void Slave::restore(void* state) {
  expect(function<int (*)(void*, void*)>(unpacked_.fmi == 3 ? "SetFMUState" : "SetFMUstate")(instance_, state),
         "restore");
}
void Slave::free_state(void* state) {
  expect(function<int (*)(void*, void**)>(unpacked_.fmi == 3 ? "FreeFMUState" : "FreeFMUstate")(instance_, &state),
         "free");
  if (state) throw std::runtime_error("a freed state is not null");
}
std::string Slave::serialise(void* state) {
  const bool three = unpacked_.fmi == 3;
  Size size = 0;
  expect(function<int (*)(void*, void*, Size*)>(three ? "SerializedFMUStateSize" : "SerializedFMUstateSize")(
             instance_, state, &size),
         "size");
  std::string bytes(size, '\0');
  expect(function<int (*)(void*, void*, void*, Size)>(three ? "SerializeFMUState" : "SerializeFMUstate")(
             instance_, state, bytes.data(), size),
         "serialise");
  return bytes;
}
void* Slave::deserialise(const std::string& bytes) {
  void* state = nullptr;
  expect(function<int (*)(void*, const void*, Size, void**)>(unpacked_.fmi == 3 ? "DeserializeFMUState"
                                                                                : "DeSerializeFMUstate")(
             instance_, bytes.data(), bytes.size(), &state),
         "deserialise");
  return state;
}

Slave::Event Slave::discrete() {
  Event event;
  for (int round = 0; round < 100; ++round) {
    bool needed = false;
    if (unpacked_.fmi == 2) {
      EventInfo2 info{};
      expect(function<int (*)(void*, EventInfo2*)>("NewDiscreteStates")(instance_, &info), "discrete states");
      needed = info.needed;
      event.states_changed = event.states_changed || info.states;
      event.next = info.defined ? std::optional(info.next) : std::nullopt;
    } else {
      bool terminate, nominals, states, defined;
      double next;
      expect(function<int (*)(void*, bool*, bool*, bool*, bool*, bool*, double*)>("UpdateDiscreteStates")(
                 instance_, &needed, &terminate, &nominals, &states, &defined, &next),
             "discrete states");
      event.states_changed = event.states_changed || states;
      event.next = defined ? std::optional(next) : std::nullopt;
    }
    if (!needed) {
      expect(function<int (*)(void*)>("EnterContinuousTimeMode")(instance_), "continuous time");
      return event;
    }
  }
  throw std::runtime_error("discrete states are never settled");
}
void Slave::enter_events() { expect(function<int (*)(void*)>("EnterEventMode")(instance_), "event mode"); }
void Slave::time(double t) { expect(function<int (*)(void*, double)>("SetTime")(instance_, t), "time"); }
void Slave::states(const std::vector<double>& x) {
  expect(function<int (*)(void*, const double*, Size)>("SetContinuousStates")(instance_, x.data(), x.size()), "states");
}
std::vector<double> Slave::states() {
  std::vector<double> x(unpacked_.states.size());
  expect(function<int (*)(void*, double*, Size)>("GetContinuousStates")(instance_, x.data(), x.size()), "states");
  return x;
}
std::vector<double> Slave::rates() {
  std::vector<double> x(unpacked_.states.size());
  expect(function<int (*)(void*, double*, Size)>(unpacked_.fmi == 3 ? "GetContinuousStateDerivatives"
                                                                    : "GetDerivatives")(instance_, x.data(), x.size()),
         "rates");
  return x;
}
std::vector<double> Slave::indicators() {
  std::vector<double> z(unpacked_.indicators);
  expect(function<int (*)(void*, double*, Size)>("GetEventIndicators")(instance_, z.data(), z.size()), "indicators");
  return z;
}
std::vector<double> Slave::nominals() {
  std::vector<double> x(unpacked_.states.size());
  expect(function<int (*)(void*, double*, Size)>("GetNominalsOfContinuousStates")(instance_, x.data(), x.size()),
         "nominals");
  return x;
}
bool Slave::completed() {
  if (unpacked_.fmi == 2) {
    int enter = 0, terminate = 0;
    expect(function<int (*)(void*, int, int*, int*)>("CompletedIntegratorStep")(instance_, 1, &enter, &terminate),
           "step");
    return enter;
  }
  bool enter = false, terminate = false;
  expect(function<int (*)(void*, bool, bool*, bool*)>("CompletedIntegratorStep")(instance_, true, &enter, &terminate),
         "step");
  return enter;
}
double Slave::directional(unsigned unknown, unsigned known) {
  const double seed = 1;
  double found = NAN;
  expect(unpacked_.fmi == 3 ? function<int (*)(void*, Ref, Size, Ref, Size, const double*, Size, double*, Size)>(
                                  "GetDirectionalDerivative")(instance_, &unknown, 1, &known, 1, &seed, 1, &found, 1)
                            : function<int (*)(void*, Ref, Size, Ref, Size, const double*, double*)>(
                                  "GetDirectionalDerivative")(instance_, &unknown, 1, &known, 1, &seed, &found),
         "directional derivative");
  return found;
}
double Slave::adjoint(const std::vector<unsigned>& unknowns, const std::vector<double>& seeds, unsigned known) {
  double found = NAN;
  expect(function<int (*)(void*, Ref, Size, Ref, Size, const double*, Size, double*, Size)>("GetAdjointDerivative")(
             instance_, unknowns.data(), unknowns.size(), &known, 1, seeds.data(), seeds.size(), &found, 1),
         "adjoint derivative");
  return found;
}
void Slave::terminate() { expect(function<int (*)(void*)>("Terminate")(instance_), "end"); }
void Slave::reset() { expect(function<int (*)(void*)>("Reset")(instance_), "reset"); }

namespace {

// A step of Dormand and Prince's pair from (t, x): the new state, and the error over the nominals.
struct Tried {
  std::vector<double> x;
  double error = 0;
};
Tried try_step(Slave& slave, double t, const std::vector<double>& x, const std::vector<double>& nominal, double h) {
  static const std::array<std::array<double, 6>, 6> a = {
      {{1. / 5},
       {3. / 40, 9. / 40},
       {44. / 45, -56. / 15, 32. / 9},
       {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
       {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
       {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}};
  static const std::array<double, 6> c = {1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
  static const std::array<double, 7> e = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                          -17253. / 339200, 22. / 525, -1. / 40};
  std::vector<std::vector<double>> k;
  slave.time(t), slave.states(x);
  k.push_back(slave.rates());
  Tried tried;
  for (std::size_t stage = 0; stage < 6; ++stage) {
    tried.x = x;
    for (std::size_t j = 0; j <= stage; ++j)
      for (std::size_t i = 0; i < x.size(); ++i) tried.x[i] += h * a[stage][j] * k[j][i];
    slave.time(t + c[stage] * h), slave.states(tried.x);
    k.push_back(slave.rates());
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < 7; ++j) sum += e[j] * k[j][i];
    tried.error = std::max(tried.error, std::abs(h * sum) / nominal[i]);
  }
  return tried;
}

bool crossed(const std::vector<double>& before, const std::vector<double>& now) {
  for (std::size_t i = 0; i < now.size(); ++i)
    if (before[i] > 0 && now[i] <= 0) return true;
  return false;
}

}  // namespace

Crossings integrate(Slave& slave, double start, const std::vector<double>& times, double tolerance,
                    const std::function<void(std::size_t k)>& seen) {
  Crossings all;
  double t = start;
  Slave::Event event = slave.discrete();
  std::vector<double> x = slave.states(), nominal = slave.nominals(), z = slave.indicators();
  double h = 1e-4;
  for (std::size_t k = 0; k < times.size();) {
    double end = times[k];
    const bool timed = event.next && *event.next <= end;
    if (timed) end = *event.next;
    double step = std::min(h, end - t);
    if (step > 0) {
      Tried tried = try_step(slave, t, x, nominal, step);
      if (!(tried.error <= tolerance) && step > 1e-13) {
        h = step * std::clamp(0.9 * std::pow(tolerance / tried.error, 0.2), 0.1, 0.9);
        continue;
      }
      std::vector<double> z1 = slave.indicators();
      bool found = crossed(z, z1);
      if (found) {
        double low = 0, high = step;
        for (int i = 0; i < 60 && high - low > 1e-14; ++i) {
          const double middle = 0.5 * (low + high);
          const Tried part = try_step(slave, t, x, nominal, middle);
          (crossed(z, slave.indicators()) ? high : low) = middle;
        }
        step = high;
        tried = try_step(slave, t, x, nominal, step);
      }
      const bool at_end = !found && step == end - t;
      if (!found && tried.error > 0) h = step * std::clamp(0.9 * std::pow(tolerance / tried.error, 0.2), 0.2, 4.0);
      t = at_end ? end : t + step;
      x = tried.x;
      slave.time(t), slave.states(x);
      if (found) all.times.push_back(t);
      const bool wanted = slave.completed();
      if (found || wanted || (timed && t == end)) {
        slave.enter_events();
        event = slave.discrete();
        if (event.states_changed) x = slave.states();
        nominal = slave.nominals();
      }
      z = slave.indicators();
    } else if (timed) {
      slave.enter_events();
      event = slave.discrete();
      if (event.states_changed) x = slave.states();
      z = slave.indicators();
      if (event.next && *event.next <= t) throw std::runtime_error("the next event is not ahead");
    }
    while (k < times.size() && t >= times[k]) seen(k++);
  }
  return all;
}

}  // namespace importer
