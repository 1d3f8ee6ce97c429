// effect_units.cpp — the switches of a scene, and the sets that they make.
#include "studies/effects/effect_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>

#include "engine/events/equations.h"

namespace kurbel {
namespace {

// The component of "gearbox.support".
std::string base_name(const std::string& joint) { return joint.substr(0, joint.find('.')); }

bool on_in(const Scene& scene, const EffectUnit& unit) {
  if (!unit.component.empty()) return scene.effects.is_elastic(unit.component);
  const auto flags = effect_flags();
  return std::any_of(flags.begin(), flags.end(),
                     [&](const EffectFlag& flag) { return unit.name == flag.name && scene.effects.*(flag.flag); });
}

bool is_usual(const EffectUnit& unit) {
  const auto flags = effect_flags();
  return std::any_of(flags.begin(), flags.end(),
                     [&](const EffectFlag& flag) { return unit.name == flag.name && flag.is_usual(); });
}

// Values of a setting that are multiplied.
enum class Scales { nothing, value, abscissa };
using Choice = std::function<Scales(const Key&, const Setting&)>;

void multiply(Setting& setting, Scales which, double factor) {
  if (which == Scales::abscissa) {
    for (std::vector<double>* x : {&setting.curve.x, &setting.curve.x_back})
      for (double& value : *x) value *= factor;
    return;
  }
  setting.number *= factor;
  for (double& value : setting.numbers) value *= factor;
  for (std::vector<double>* y : {&setting.curve.y, &setting.curve.y_back})
    for (double& value : *y) value *= factor;
}

// Multiplies chosen values in a section and its nested tables; returns the keys given. Default values are multiplied
// as well, to keep the proportions.
std::vector<std::string> scale(Section& section, const Choice& chosen, double factor) {
  std::vector<std::string> changed;
  for (Setting& setting : section.settings) {
    for (Section& nested : setting.sections)
      for (const std::string& key : scale(nested, chosen, factor)) changed.push_back(setting.key + "." + key);
    const Key* const key = section.kind->key(setting.key);
    const Scales which = key ? chosen(*key, setting) : Scales::nothing;
    if (which == Scales::nothing || !setting.curve.by_formula.empty()) continue;  // a formula stays as it is
    multiply(setting, which, factor);
    if (setting.given) changed.push_back(setting.key);
  }
  return changed;
}

// For these keys' values, if given.
Choice given_of(std::set<std::string> keys) {
  return [keys = std::move(keys)](const Key& key, const Setting& setting) {
    return setting.given && keys.count(key.name) ? Scales::value : Scales::nothing;
  };
}

bool is_load(const Section& section) { return section.kind->name == "load" || section.kind->name == "torque source"; }

}  // namespace

std::vector<EffectUnit> effect_units(const Scene& scene) {
  std::vector<EffectUnit> units;
  // A gearbox is elastic only if its flanks or supports are. Decided on the network as described: with all of them
  // elastic at once, a shaft without inertia may remain, while one alone is a valid model.
  std::set<std::string> elastic;
  const Network network = build_network(scene);
  for (const Network::Joint& joint : network.joints)
    if (joint.element && joint.element->is.has_spring()) elastic.insert(base_name(joint.component));
  for (const Section& section : scene.components)
    if (section.kind->elastic && elastic.count(section.name))
      units.push_back({"elasticity:" + section.name, "elasticity of " + section.name, section.name});
  for (const EffectFlag& effect : effect_flags())
    if (has_parameters(scene, effect) && (effect.flag != &Effects::multibody || scene.effects.multibody))
      units.push_back({effect.name, effect.words});
  return units;
}

EffectSet without(EffectSet set, std::size_t unit) {
  set[unit] = false;
  return set;
}

Effects effects_of(const Scene&, const std::vector<EffectUnit>& units, const EffectSet& on) {
  Effects effects;
  for (std::size_t k = 0; k < units.size(); ++k) {
    if (on[k] && !units[k].component.empty()) effects.elastic.push_back(units[k].component);
    for (const EffectFlag& effect : effect_flags())
      if (units[k].name == effect.name) effects.*(effect.flag) = on[k];
    // Without elasticity the torque lag is left on: one effect is omitted, not two.
    if (units[k].name == "torque_lag") effects.lags_rigid = on[k];
  }
  effects.lags_rigid = effects.lags_rigid && effects.elastic.empty();
  return effects;
}

EffectSet fullest_set(const Scene& scene, const std::vector<EffectUnit>& units, std::optional<std::size_t> keep) {
  const EffectSet all(units.size(), true);
  if (makes_machine(scene, effects_of(scene, units, all))) return all;
  // Parts of the machine come first: without them a mechanism may be too simple to exclude anything.
  const auto rank = [&](std::size_t k) {
    return is_usual(units[k]) ? 0 : k == keep ? 1 : on_in(scene, units[k]) ? 2 : 3;
  };
  std::vector<std::size_t> order(units.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  EffectSet on(units.size(), false);
  for (const std::size_t k : order) {
    on[k] = true;
    on[k] = makes_machine(scene, effects_of(scene, units, on));
    if (k == keep && !on[k]) return on;
  }
  return on;
}

InPlaceOf in_place_of_others(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& fullest,
                             std::size_t unit) {
  InPlaceOf found{.with = fullest_set(scene, units, unit), .without = {}, .gives_way = {}};
  found.without = without(found.with, unit);
  EffectSet gone(units.size(), false);
  for (std::size_t k = 0; k < units.size(); ++k) gone[k] = fullest[k] && !found.with[k];
  found.gives_way = describe(units, gone);
  return found;
}

std::string describe(const std::vector<EffectUnit>& units, const EffectSet& on) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < units.size(); ++k)
    if (on[k]) words.push_back(units[k].words);
  return words.empty() ? "none" : joined_words(words);
}

std::string joined_words(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

bool makes_machine(const Scene& scene, const Effects& effects) {
  try {
    compile(scene, effects);
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

ModelSize size_of(const Model& model) {
  Equations equations(std::shared_ptr<const Model>(std::shared_ptr<void>(), &model), false);
  return {static_cast<std::ptrdiff_t>(model.state_count()), std::ssize(model.jacobian.pattern.row),
          static_cast<std::ptrdiff_t>(equations.guard_count())};
}

std::string with_effects(const Scene& scene, const std::vector<EffectUnit>& units, const EffectSet& on) {
  // Removes the old table in either form; a table ends where the next one begins.
  std::string text;
  bool inside = false;
  for (std::size_t begin = 0; begin < scene.text.size();) {
    const std::size_t end = std::min(scene.text.find('\n', begin), scene.text.size() - 1) + 1;
    const std::string line = scene.text.substr(begin, end - begin);
    begin = end;
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line[first] == '[') inside = line.compare(first, 9, "[effects]") == 0;
    const bool in_one_line = first != std::string::npos && !inside && line.compare(first, 7, "effects") == 0 &&
                             line.find('=') != std::string::npos;
    if (!inside && !in_one_line) text += line;
  }
  std::string elastic, flags;
  for (std::size_t k = 0; k < units.size(); ++k) {
    if (!units[k].component.empty()) {
      if (on[k]) elastic += (elastic.empty() ? "\"" : ", \"") + units[k].component + "\"";
    } else {
      flags += fmt::format("{} = {}\n", units[k].name, on[k] ? "true" : "false");
    }
  }
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text + "\n[effects]\nelasticity = [" + elastic + "]\n" + flags;
}

bool is_speed(const Key& key) { return key.unit == "rad/s" || key.unit == "Hz"; }

bool is_of_a_part(const Key& key) {
  static const std::set<std::string> parts = {"damping_frequency", "stribeck_speed", "creep_speed"};
  return parts.count(key.name) > 0;
}

std::string scale_loads(Scene& scene, double factor) {
  const Choice torques = given_of({"torque", "damping", "quadratic", "table", "amplitude"});
  const Choice forces =
      given_of({"nominal_force", "force", "pressure", "table", "suction_pressure", "delivery_pressure"});
  std::vector<std::string> changed;
  for (Section& section : scene.components) {
    if (is_load(section))
      for (const std::string& key : scale(section, torques, factor)) changed.push_back(section.name + "." + key);
    for (Setting& setting : section.settings)
      for (Section& nested : setting.sections)
        if (setting.key == "load" || setting.key == "loads" || setting.key == "torque")
          for (const std::string& key : scale(nested, forces, factor)) changed.push_back(section.name + ".load." + key);
  }
  return joined_words(changed);
}

std::string scale_speeds(Scene& scene, double factor) {
  std::vector<std::string> changed;
  for (Section& section : scene.components) {
    const bool load = is_load(section);
    const Choice speeds = [load](const Key& key, const Setting& setting) {
      if (is_speed(key) && !is_of_a_part(key)) return Scales::value;
      return key.type == KeyType::curve && setting.given && setting.curve.over == "speed" && !load ? Scales::abscissa
                                                                                                   : Scales::nothing;
    };
    for (const std::string& key : scale(section, speeds, factor)) changed.push_back(section.name + "." + key);
  }
  StartSettings& start = scene.run.start;
  if (start.speed != 0) start.speed *= factor, changed.push_back("start speed");
  for (auto& [component, given] : start.components)
    if (given.speed && *given.speed != 0) *given.speed *= factor, changed.push_back("start speed of " + component);
  for (SequenceStep& step : scene.sequence.steps)
    if (step.when == SequenceStep::When::speed_above || step.when == SequenceStep::When::speed_below)
      step.value *= factor, changed.push_back("speed that a step of the sequence waits for");
  return joined_words(changed);
}

}  // namespace kurbel
