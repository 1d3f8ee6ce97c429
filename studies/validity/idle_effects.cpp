// idle_effects.cpp — effects without influence because another one is off.
#include "studies/validity/idle_effects.h"

#include <fmt/format.h>

#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

std::vector<std::string> idle_effects(const Model& model) {
  std::vector<std::string> notes;
  if (model.effects.variable_inertia) return notes;
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    if (!element) continue;
    std::vector<std::string> idle;
    for (const EffectFlag& effect : effect_flags())
      if ((effect.flag == &Effects::joint_clearance && !element->mechanism().clearances.empty()) ||
          (effect.flag == &Effects::flexible_rod && element->mechanism().flexibility))
        idle.emplace_back(effect.words);
    if (idle.empty()) continue;
    notes.push_back(
        fmt::format("variable inertia is off: \"{}\" is a crank of constant inertia then, without rod and joints, and "
                    "{} {} with it, although on",
                    e.component, fmt::join(idle, " and "), idle.size() > 1 ? "go" : "goes"));
  }
  return notes;
}

}  // namespace kurbel
