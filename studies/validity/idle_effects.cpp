// idle_effects.cpp — which effects go along with one that is off.
#include "studies/validity/idle_effects.h"

#include <fmt/format.h>

#include <algorithm>

namespace kurbel {
namespace {

// It stands in the component's table.
bool is_given(const Section& component, const EffectFlag& effect) {
  return std::any_of(component.kind->keys.begin(), component.kind->keys.end(),
                     [&](const Key& key) { return key.gives(effect.name) && component.given(key.name); });
}

}  // namespace

std::vector<std::string> idle_effects(const Model& model) {
  std::vector<std::string> notes;
  if (model.effects.variable_inertia) return notes;
  for (const Section& component : model.scene.components) {
    std::vector<std::string> idle;
    for (const EffectFlag& effect : effect_flags()) {
      const bool needs_links = effect.flag == &Effects::joint_clearance || effect.flag == &Effects::flexible_rod;
      if (needs_links && model.effects.*(effect.flag) && is_given(component, effect)) idle.emplace_back(effect.words);
    }
    if (idle.empty()) continue;
    notes.push_back(
        fmt::format("variable inertia is off: \"{}\" is a crank of constant inertia then, without rod and joints, and "
                    "{} {} with it, "
                    "although on",
                    component.name, fmt::join(idle, " and "), idle.size() > 1 ? "go" : "goes"));
  }
  return notes;
}

}  // namespace kurbel
