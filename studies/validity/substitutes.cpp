// substitutes.cpp — loads of mechanisms with mirrored diagrams; engines and motors report their own substitutes.
#include "studies/validity/substitutes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/reading/mirrored.h"
#include "engine/values/dense_tables.h"
#include "mechanisms/deforming/deforming_mechanism.h"
#include "mechanisms/link_forces/link_forces.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

namespace {

// Of a mechanism that passes change points: how it goes on there; else empty.
std::string branch_words(const Mechanism& mechanism) {
  std::vector<std::string> at;
  for (const double phi : mechanism.reduced->cycle().change_points())
    at.push_back(fmt::format("{:.4g}°", phi * 180 / std::numbers::pi));
  if (at.empty()) return {};
  return fmt::format(
      "{}: at the change point{} φ = {} its links can go on in two ways; assumed is the smooth one. Joints alone do "
      "not "
      "force it: inertia does, or links at another angle beside it, as a second rod on cranks 90° apart",
      mechanism.name, at.size() > 1 ? "s" : "", fmt::join(at, ", "));
}

}  // namespace

std::vector<std::string> substitutes(const Model& model) {
  std::vector<std::string> notes;
  if (std::string words = words_of_dense_tables(model.scene); !words.empty()) notes.push_back(std::move(words));
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* element = mechanism_of(e);
    if (const Mechanism* mechanism = element ? &element->mechanism() : link_force_of(e)) {
      for (const SliderLoad& load : mechanism->loads)
        if (load.mirrored) notes.push_back(words_of_mirrored(load.name, "motored"));
      if (std::string words = element ? branch_words(*mechanism) : ""; !words.empty())
        notes.push_back(std::move(words));
      const auto* const drawn = element ? mechanism->data.as<LinkageData>() : nullptr;
      if (drawn && !drawn->linkage->moved_in_words().empty())
        notes.push_back(mechanism->name + ": " + drawn->linkage->moved_in_words());
      continue;
    }
    const std::vector<InternalState>& own = e.element->internal_states;
    if (std::any_of(own.begin(), own.end(), [](const InternalState& state) { return state.lags; })) {
      notes.push_back(fmt::format("\"{}\": {}", e.component, e.element->describe()));
      continue;
    }
    // A drive over the angle is an engine: all its own notes are substitutes.
    const bool engine = e.element->account == Account::driving && e.element->is.uses_angle;
    if (const std::string words = engine ? e.element->describe() : ""; !words.empty()) notes.push_back(words);
  }
  return notes;
}

std::vector<std::string> idle_effects(const Model& model) {
  std::vector<std::string> notes;
  if (model.effects.variable_inertia) return notes;
  for (const Network::ShaftElement& e : model.network.elements) {
    const MechanismElement* const element = mechanism_of(e);
    if (!element) continue;
    const Deformation& deformation = deformation_of(element->mechanism());
    std::vector<std::string> idle;
    for (const EffectFlag& effect : effect_flags())
      if ((effect.flag == &Effects::joint_clearance && !deformation.clearances.empty()) ||
          (effect.flag == &Effects::flexible_rod && deformation.flexibility))
        idle.emplace_back(effect.words);
    if (idle.empty()) continue;
    notes.push_back(
        fmt::format("variable inertia is off: \"{}\" is a crank of constant inertia then, without rod and joints, and "
                    "{} {} with it, although on",
                    e.component, fmt::join(idle, " and "), idle.size() > 1 ? "go" : "goes"));
  }
  return notes;
}

std::vector<std::string> regularised(const std::vector<std::string>& contacts) {
  std::vector<std::string> notes;
  for (const std::string& what : std::set<std::string>(contacts.begin(), contacts.end())) {
    const auto times = std::count(contacts.begin(), contacts.end(), what);
    notes.push_back(fmt::format("{}: the contact chatters{}, so it follows a law without events; see the events", what,
                                times > 1 ? fmt::format(" {} times", times) : ""));
  }
  return notes;
}

}  // namespace kurbel
