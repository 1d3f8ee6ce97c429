// effects.cpp — the list of effects, and how people name them.
#include "engine/scene/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "engine/base/find_by.h"
#include "engine/scene/scene.h"

namespace kurbel {

bool has_parameters(const Section& section, const EffectFlag& effect) {
  for (const Setting& setting : section.settings) {
    if (setting.given && section.kind)
      if (const Key* const key = section.kind->key(setting.key); key && key->gives(effect.name)) return true;
    for (const Section& nested : setting.sections)
      if (has_parameters(nested, effect)) return true;
  }
  return false;
}

namespace {

void switch_elasticity(const std::string& component, bool on, const Scene& scene, Effects& effects) {
  const Section* section = scene.find(component);
  std::vector<std::string> all;
  for (const Section& s : scene.components)
    if (s.kind->elastic) all.push_back(s.name);
  if (!section || !section->kind->elastic) {
    const std::string why = section ? fmt::format("is a {}, which is always rigid", section->kind->name)
                                    : "is no component" + suggestion(component, all);
    throw std::invalid_argument(fmt::format("effects {}: {} {}; allowed: {}", in_quotes("elasticity:" + component),
                                            in_quotes(component), why,
                                            all.empty() ? "none in this scene" : shortened_list(all)));
  }
  if (on) {
    effects.elastic.push_back(component);
    return;
  }
  if (effects.all_elastic) effects.elastic = std::move(all);
  effects.all_elastic = false;
  std::erase(effects.elastic, component);
}

bool is_effect(const std::string& name) {
  const auto flags = effect_flags();
  return name == "all" || name == "elasticity" ||
         std::any_of(flags.begin(), flags.end(), [&](const EffectFlag& f) { return name == f.name; });
}

// One name, switched on or off.
void switch_effect(const std::string& name, bool on, const Scene& scene, Effects& effects) {
  if (name == "elasticity") {
    effects.all_elastic = on;
    if (!on) effects.elastic.clear();
    return;
  }
  const auto flags = effect_flags();
  if (name == "all" && on) {
    effects.all_elastic = true;
    for (const EffectFlag& f : flags)
      if (f.is_usual() || has_parameters(scene, f))
        effects.*(f.flag) = f.flag != &Effects::multibody;  // the same physics at many times the cost
    return;
  }
  const auto* const known = find_by(flags, &EffectFlag::name, name);
  if (!known) {
    std::vector<std::string> names = {"none", "all", "elasticity"};
    for (const EffectFlag& f : flags) names.emplace_back(f.name);
    const std::string near = suggestion(name, names);
    names.insert(names.begin() + 3, "elasticity:COUPLING,…");
    throw std::invalid_argument(
        fmt::format("effects {}{}; allowed: {}; several joined by commas, or -NAME to take one away", in_quotes(name),
                    near, listed(names)));
  }
  if (on && known->by_default == EffectFlag::Default::where_given && !has_parameters(scene, *known))
    throw std::invalid_argument(fmt::format("effects {}: no component of the scene has parameters for it; give {}",
                                            in_quotes(name), known->parameters));
  effects.*(known->flag) = on;
}

}  // namespace

std::span<const EffectFlag> effect_flags() {
  using Default = EffectFlag::Default;
  static constexpr std::array<EffectFlag, 14> flags = {{
      {"joint_friction", &Effects::joint_friction, "joint friction", Default::off,
       "friction in the joints of mechanisms, found together with the reactions", "a joint's friction_coefficient",
       "none; dead centres and standstill are events", "efficiency, heat in the joints, starting under load"},
      {"backlash", &Effects::backlash, "backlash", Default::where_given,
       "gaps between flanks, with contact and flight as modes", "the backlash of a coupling or a gear stage",
       "none; flanks part and touch at events", "where the torque changes its sign", true},
      {"mesh_variation", &Effects::mesh_variation, "mesh variation", Default::where_given,
       "tooth stiffness that varies at the frequency of mesh", "mesh_variation of a gear mesh", "an angle",
       "where the frequency of mesh meets a mode", true},
      {"transients", &Effects::transients, "electrical transients", Default::where_given,
       "currents and fluxes of motors as states", "the inductance of a DC motor or the frequency of an induction motor",
       "a current of a DC motor, four currents of an induction motor", "at switching, and for fast changes of load"},
      {"torque_lag", &Effects::torque_lag, "torque lag", Default::with_elasticity,
       "the lag of the fluxes behind an induction motor's static curve, T_e dM/dt + M = M(ω), T_e = 1/(s_b 2π f)",
       "an induction motor and anything elastic", "a torque per motor",
       "where the speed of a motor oscillates faster than a tenth of s_b f; transients, where data allow, replace it"},
      {"relaxation", &Effects::relaxation, "relaxation", Default::where_given,
       "Maxwell branches of rubber couplings as states", "the branches of a rubber coupling", "a twist per branch",
       "where damping must fit over a range of frequencies", true},
      {"bearing_friction", &Effects::bearing_friction, "bearing friction", Default::where_given,
       "dry and mixed friction of bearings, with sticking", "a bearing",
       "none, of LuGre's law a deflection; standstill is an event", "at low speed, for starts and stops"},
      {"gear_losses", &Effects::gear_losses, "gear losses", Default::where_given,
       "losses of gears by the direction of power, with self-locking", "the efficiency of a gearbox",
       "none; changes of flank and standstill are events", "efficiency, lowering loads, self-locking gears"},
      {"joint_clearance", &Effects::joint_clearance, "joint clearance", Default::where_given,
       "gaps in the joints of a slider-crank, with contact and flight as modes", "the clearance of a slider-crank",
       "two displacements and their rates per joint; contact and flight are events",
       "noise, wear and impact forces; where a joint's reaction reverses"},
      {"flexible_rod", &Effects::flexible_rod, "flexible rod", Default::where_given,
       "bending and stretching of a slider-crank's rod", "the rod_flexibility of a slider-crank",
       "an amplitude and its rate per mode", "slender rods at high speed; stress in the rod", true},
      {"gravity", &Effects::gravity, "gravity", Default::part_of_machine, "weight of a mechanism's links",
       "the gravity of a mechanism", "none", "heavy links at low speed"},
      {"variable_inertia", &Effects::variable_inertia, "variable inertia", Default::part_of_machine,
       "the reduced inertia of a mechanism varies with its angle; off: its mean", "a mechanism", "none",
       "speed fluctuation and torques at the frequency of revolution"},
      {"load_edges", &Effects::load_edges, "load edges", Default::part_of_machine,
       "edges of a force over travel or angle, located as events; off: rounded, with the same work",
       "the rounding of a mechanism's load", "none; every edge is an event",
       "vibration after a shock or a break-through"},
      {"multibody", &Effects::multibody, "multibody in the loop", Default::off,
       "mechanisms evaluated body by body by Simbody at every step; off: by tables extracted from it", "a mechanism",
       "none", "never, but to check the tables: the same physics at many times the cost"},
  }};
  return flags;
}

bool has_parameters(const Scene& scene, const EffectFlag& effect) {
  return std::any_of(scene.components.begin(), scene.components.end(),
                     [&](const Section& section) { return has_parameters(section, effect); });
}

bool Effects::is_elastic(const std::string& component) const {
  return all_elastic || std::count(elastic.begin(), elastic.end(), component) > 0;
}

Effects without_elasticity(const Effects& effects) {
  Effects rigid = effects;
  rigid.all_elastic = false;
  rigid.elastic.clear();
  for (const EffectFlag& effect : effect_flags())
    if (effect.of_elasticity) rigid.*(effect.flag) = false;
  return rigid;
}

Effects bare_machine(const Effects& effects) {
  Effects bare;
  for (const EffectFlag& effect : effect_flags())
    if (effect.is_usual()) bare.*(effect.flag) = effects.*(effect.flag);
  bare.locked = effects.locked;
  return bare;
}

Effects in_both(const Effects& a, const Effects& b) {
  Effects common;
  common.all_elastic = a.all_elastic && b.all_elastic;
  if (!common.all_elastic)
    for (const std::string& component : a.all_elastic ? b.elastic : a.elastic)
      if (b.is_elastic(component)) common.elastic.push_back(component);
  for (const EffectFlag& effect : effect_flags())
    common.*(effect.flag) =
        effect.is_usual() ? a.*(effect.flag) || b.*(effect.flag) : a.*(effect.flag) && b.*(effect.flag);
  common.lags_rigid = a.lags_rigid || b.lags_rigid;
  common.locked = a.locked && b.locked;
  return common;
}

std::string Effects::describe() const {
  std::vector<std::string> words;
  if (all_elastic) {
    words.emplace_back("elasticity");
  } else if (!elastic.empty()) {
    std::string text = "elasticity of ";
    for (std::size_t i = 0; i < elastic.size(); ++i) text += (i ? ", " : "") + elastic[i];
    words.push_back(text);
  }
  std::string without;
  for (const EffectFlag& effect : effect_flags()) {
    const bool on = this->*(effect.flag);
    if (effect.is_usual()) {
      if (!on) without += (without.empty() ? ", without " : " and ") + std::string(effect.words);
    } else if (on) {
      words.emplace_back(effect.words);
    }
  }
  if (torque_lag && lags_rigid) words.emplace_back("torque lag");
  if (words.empty()) return "none" + without;
  std::string text = words.front();
  for (std::size_t i = 1; i < words.size(); ++i) text += (i + 1 == words.size() ? " and " : ", ") + words[i];
  return text + without;
}

Effects parse_effects(const std::string& text, const Scene& scene) {
  if (text == "none") return {};
  Effects effects;
  if (text.starts_with('-')) effects = scene.effects;
  const std::string prefix = "elasticity:";
  bool couplings = false, on = true;  // what a name without a prefix of its own goes on with
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of("+,", begin), text.size());
    std::string name = text.substr(begin, end - begin);
    const bool goes_on = couplings && begin > 0 && text[begin - 1] == ',' && !name.starts_with('-') &&
                         !is_effect(name) && !name.starts_with(prefix);
    begin = end + 1;
    if (!goes_on) {
      on = !name.starts_with('-');
      if (!on) name.erase(0, 1);
      couplings = name.starts_with(prefix);
      if (couplings) name.erase(0, prefix.size());
    }
    if (couplings)
      switch_elasticity(name, on, scene, effects);
    else
      switch_effect(name, on, scene, effects);
  }
  return effects;
}

}  // namespace kurbel
