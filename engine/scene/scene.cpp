// scene.cpp — which methods integrate which model, and the keys of [run], [operation] and [[figure]].
#include "engine/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "engine/base/find_by.h"

namespace kurbel {
namespace {

bool fits(const std::string& method, const std::string& model) {
  const std::vector<std::string>& methods = methods_of(model);
  return std::count(methods.begin(), methods.end(), method) > 0;
}

std::string method_does_not_fit(const std::string& method, const std::string& model) {
  for (const char* other : {"reduced", "multibody"})
    if (other != model && fits(method, other))
      return fmt::format("method \"{}\" belongs to model = \"{}\"; for model = \"{}\" allowed: {}", method, other,
                         model, listed(methods_of(model)));
  return fmt::format("method {}{}; allowed: {}", in_quotes(method), suggestion(method, methods_of(model)),
                     listed(methods_of(model)));
}

}  // namespace

std::string Scene::heading() const {
  std::string text = title.empty() ? file : title;
  constexpr std::size_t most = 3;
  for (std::size_t k = 0; k < settings.size() && k < most; ++k) text += (k == 0 ? " with " : ", ") + settings[k];
  if (settings.size() > most) text += fmt::format(" and {} more", settings.size() - most);
  return text;
}

const Section* Scene::find(const std::string& name) const { return find_by(components, &Section::name, name); }

const std::vector<std::string>& methods_of(const std::string& model) {
  static const std::vector<std::string> reduced = {"auto",  "work",    "dopri5", "verner6", "dop853", "fehlberg8",
                                                   "adams", "esdirk3", "esdirk", "esdirk5", "bdf"};
  static const std::vector<std::string> multibody = {
      "auto",   "RungeKuttaMerson",   "RungeKuttaFeldberg", "RungeKutta3", "RungeKutta2",
      "Verlet", "SemiExplicitEuler2", "ExplicitEuler",      "CPodes"};
  return model == "multibody" ? multibody : reduced;
}

void check_method(const std::string& method, const std::string& model) {
  if (!fits(method, model)) throw std::invalid_argument(method_does_not_fit(method, model));
}

const std::vector<Key>& run_keys() {
  static const std::vector<Key> keys = {
      defaulted("until", "s", "1 s", positive, "end of the simulated time"),
      defaulted("accuracy", "", "1e-6", {.low = 1e-12, .high = 0.1},
                "measured error of every figure over its scale (rated speed, rated torque, 1 rad)"),
      {.name = "method",
       .type = KeyType::text,
       .fallback = "\"auto\"",
       .doc = "integrator; work: the work equation over the angle (rigid, no torque over time)",
       .choices = {"auto", "work", "dopri5", "verner6", "dop853", "fehlberg8", "adams", "esdirk3", "esdirk", "esdirk5",
                   "bdf", "RungeKuttaMerson", "RungeKuttaFeldberg", "RungeKutta3", "RungeKutta2", "Verlet",
                   "SemiExplicitEuler2", "ExplicitEuler", "CPodes"}},
      {.name = "model",
       .type = KeyType::text,
       .fallback = "\"reduced\"",
       .doc = "reduced: tables from the loop equations; multibody: Simbody's closed loop at every step (rigid, one "
              "mechanism)",
       .choices = {"reduced", "multibody"}},
      {.name = "samples",
       .type = KeyType::integer,
       .fallback = "1000",
       .domain = {.low = 2, .high = 1e6},
       .doc = "rows of trajectory.csv"},
      defaulted("budget", "s", "300 s", positive,
                "processor time after which an integration, or a study that is not made of runs, is stopped with a "
                "diagnosis"),
  };
  return keys;
}

const std::vector<Key>& operation_keys() {
  static const std::vector<Key> keys = {
      {.name = "speeds",
       .type = KeyType::quantities,
       .unit = "rad/s",
       .domain = positive,
       .doc = "speed at which the machine runs for long, or the slowest and the fastest; default: the rated speed"},
      {.name = "on", .type = KeyType::text, .doc = "component whose speeds these are; default: the reduction link"},
      defaulted("margin", "", "0.1", {.low = 0, .high = 1, .high_open = true},
                "least distance wanted between an excitation's frequencies in that range and every natural frequency, "
                "of the excitation's"),
      quantity("mains", "Hz", positive,
               "frequency of the mains, whose 1× and 2× excite; default: that of the induction motors on the mains"),
      {.name = "motor", .type = KeyType::text, .doc = "that a frequency converter feeds, with `converter`"},
      {.name = "pole_pairs",
       .type = KeyType::integer,
       .domain = {.low = 1, .high = 100},
       .doc = "of that motor: the output frequency is pole_pairs times its speed, without slip; default: by its data"},
  };
  return keys;
}

#ifndef KURBEL_FMI_RUNTIME
const std::vector<Key>& figure_keys() {
  static const std::vector<Key> keys = {
      {.name = "functional",
       .type = KeyType::text,
       .fallback = "\"peak\"",
       .doc =
           "peak: the value of greatest magnitude; mean and rms over time; time above: during which the channel lies "
           "above the level",
       .choices = {"peak", "max", "min", "mean", "rms", "time above"}},
      {.name = "channel",
       .type = KeyType::text,
       .doc = "of trajectory.csv: \"torque.main_coupling\"",
       .required = true},
      {.name = "level", .type = KeyType::text, .doc = "of time above, with the channel's unit: \"40 kN*m\""},
      {.name = "window",
       .type = KeyType::text,
       .fallback = "\"run\"",
       .doc =
           "run: from its start to its end; cycle: the steady cycle, in a run the last whole one before it runs down; "
           "run-up, steady motion, run-down: the three periods of a run that becomes steady",
       .choices = {"run", "cycle", "run-up", "steady motion", "run-down"}},
      {.name = "step",
       .type = KeyType::integer,
       .domain = {.low = 1, .high = 1000},
       .doc =
           "in place of the window: the step of the sequence with this number, from 1, until the next one is carried "
           "out; of several repetitions the last whole one"},
  };
  return keys;
}
#endif

}  // namespace kurbel
