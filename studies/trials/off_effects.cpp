// off_effects.cpp — effects that are off and could be on, grouped by what applies only together.
#include "studies/trials/off_effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "studies/effects/effect_units.h"

namespace kurbel {
namespace {

// Those made elastic besides.
Effects with_elastic(Effects effects, const std::vector<std::string>& components) {
  effects.elastic.insert(effects.elastic.end(), components.begin(), components.end());
  return effects;
}

// Components that could be elastic and have data for this effect.
std::vector<std::string> carriers(const Scene& scene, const EffectFlag& effect,
                                  const std::vector<std::string>& could_be_elastic) {
  std::vector<std::string> names;
  for (const Section& section : scene.components)
    if (std::count(could_be_elastic.begin(), could_be_elastic.end(), section.name) > 0 &&
        has_parameters(section, effect))
      names.push_back(section.name);
  return names;
}

OffEffect elasticity_of(const std::vector<std::string>& components, const Effects& on) {
  return {.name = fmt::format("elasticity:{}", fmt::join(components, ",")),
          .words = "elasticity of " + joined_words(components),
          .effects = with_elastic(on, components)};
}

OffEffect switched_on(const Scene& scene, const Effects& on, const EffectFlag& flag,
                      const std::vector<std::string>& could_be_elastic) {
  OffEffect off{.name = flag.name, .words = flag.words, .effects = on};
  if (flag.of_elasticity) {
    const std::vector<std::string> with_data = carriers(scene, flag, could_be_elastic);
    const bool any_elastic =
        std::any_of(with_data.begin(), with_data.end(), [&](const std::string& c) { return on.is_elastic(c); });
    if (!with_data.empty() && !any_elastic) {
      off = elasticity_of(with_data, on);
      off.name += fmt::format(",{}", flag.name);
      off.words += fmt::format(", with {}", flag.words);
    }
  }
  off.effects.*(flag.flag) = true;
  return off;
}

// Of a mechanism's joints and rod.
bool is_dear(const EffectFlag& flag) {
  return flag.flag == &Effects::joint_friction || flag.flag == &Effects::joint_clearance ||
         flag.flag == &Effects::flexible_rod;
}

}  // namespace

std::vector<OffEffect> effects_that_are_off(const Scene& scene, const Effects& on) {
  std::vector<std::string> could_be_elastic, rigid;
  const std::vector<EffectUnit> units = effect_units(scene);
  for (const EffectUnit& unit : units)
    if (!unit.component.empty()) could_be_elastic.push_back(unit.component);
  for (const std::string& component : could_be_elastic)
    if (!on.is_elastic(component)) rigid.push_back(component);
  std::vector<OffEffect> list;
  if (!rigid.empty()) {
    if (rigid.size() == 1 || makes_machine(scene, with_elastic(on, rigid)))
      list.push_back(elasticity_of(rigid, on));
    else
      for (const std::string& component : rigid) list.push_back(elasticity_of({component}, on));
  }
  // The first elasticity brings the lag of the motors' torques.
  const bool lag = std::any_of(units.begin(), units.end(), [](const EffectUnit& u) { return u.name == "torque_lag"; });
  if (lag && on.torque_lag && !on.lags_rigid && !on.transients && rigid.size() == could_be_elastic.size())
    for (OffEffect& elastic : list) elastic.words += ", with torque lag";
  for (const bool dear : {false, true})
    for (const EffectFlag& flag : effect_flags()) {
      const bool has_data =
          std::any_of(units.begin(), units.end(), [&](const EffectUnit& unit) { return unit.name == flag.name; });
      if (!has_data || on.*(flag.flag) || flag.flag == &Effects::multibody || is_dear(flag) != dear) continue;
      list.push_back(switched_on(scene, on, flag, could_be_elastic));
    }
  return list;
}

std::shared_ptr<const Model> machine_with(const Scene& scene, const Effects& on, OffEffect& effect) {
  try {
    return compile(scene, effect.effects);
  } catch (const SceneError&) {
  }
  // First without the run's own effects, then adding one after the other.
  Effects fits = effect.effects;
  std::vector<const EffectFlag*> dropped;
  for (const EffectFlag& flag : effect_flags())
    if (on.*(flag.flag) && !flag.is_usual()) fits.*(flag.flag) = false, dropped.push_back(&flag);
  if (dropped.empty() || !makes_machine(scene, fits)) return compile(scene, effect.effects);
  std::vector<std::string> gone;
  for (const EffectFlag* flag : dropped) {
    fits.*(flag->flag) = true;
    if (makes_machine(scene, fits)) continue;
    fits.*(flag->flag) = false;
    gone.emplace_back(flag->words);
  }
  effect.effects = fits;
  effect.gives_way = joined_words(gone);
  return compile(scene, fits);
}

}  // namespace kurbel
