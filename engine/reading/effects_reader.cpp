// effects_reader.cpp — [effects], and what of them a file leaves unsaid.
#include <fmt/format.h>

#include <set>

#include "engine/base/find_by.h"
#include "engine/reading/scene_reading.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

std::vector<std::string> elastic_names(const SceneReading& r) {
  std::vector<std::string> names;
  for (const Section& section : r.scene.components)
    if (section.kind->elastic) names.push_back(section.name);
  return names;
}

void add_elastic(SceneReading& r, const DocumentValue& item) {
  const Section* section = item.type == Type::text ? r.find(item.text) : nullptr;
  if (section && section->kind->elastic) {
    r.scene.effects.elastic.push_back(item.text);
    return;
  }
  if (r.unreadable.count(item.text)) return;
  if (!r.explains()) return r.refuse(item.at, fmt::format("[effects]: elasticity: {}", item.describe()));
  const std::vector<std::string> allowed = elastic_names(r);
  const std::string why = section
                              ? fmt::format("{} is a {}, which is always rigid", item.describe(), section->kind->name)
                              : fmt::format("{} is no component{}", item.describe(), suggestion(item.text, allowed));
  r.refuse(item.at, fmt::format("[effects]: elasticity: {}; allowed: {}", why,
                                allowed.empty() ? "none in this scene" : shortened_list(allowed)));
}

void read_elasticity(SceneReading& r, const DocumentEntry& entry) {
  if (entry.value.type == Type::flag) {
    r.scene.effects.all_elastic = entry.value.flag;
  } else if (entry.value.type == Type::list) {
    for (const DocumentValue& item : entry.value.items) add_elastic(r, item);
  } else {
    r.refuse(
        entry.value.at,
        fmt::format("[effects]: elasticity = {}; must be true, false or a list of components{}", entry.value.describe(),
                    entry.value.type == Type::text ? fmt::format(", e.g. [{}]", entry.value.describe()) : ""));
  }
}

// What the file does not mention is on where there are parameters for it.
void complete_effects(SceneReading& r, const std::set<std::string>& said) {
  for (const EffectFlag& effect : effect_flags())
    if (effect.by_default == EffectFlag::Default::where_given && !said.count(effect.name))
      r.scene.effects.*(effect.flag) = has_parameters(r.scene, effect);
}

// Notes which effects the file mentions.
void read_effects_table(SceneReading& r, std::set<std::string>& said) {
  const DocumentEntry* effects = r.document.find("effects");
  if (!effects) return;
  if (effects->value.type != Type::table)
    return r.refuse(effects->at, fmt::format("effects = {}; must be a table, e.g. effects = {{ elasticity = true }}",
                                             effects->value.describe()));
  for (const DocumentEntry& entry : effects->value.entries) {
    if (entry.key == "elasticity") {
      read_elasticity(r, entry);
      continue;
    }
    const auto flags = effect_flags();
    const auto* const known = find_by(flags, &EffectFlag::name, entry.key);
    if (!known) {
      std::vector<std::string> names = {"elasticity"};
      for (const EffectFlag& f : flags) names.emplace_back(f.name);
      r.refuse(entry.at, fmt::format("[effects]: unknown effect {}{}; allowed: {}", in_quotes(entry.key),
                                     suggestion(entry.key, names), listed(names, "and")));
    } else if (entry.value.type != Type::flag) {
      r.refuse(entry.value.at,
               fmt::format("[effects]: {} = {}; must be true or false", entry.key, entry.value.describe()));
    } else {
      r.scene.effects.*(known->flag) = entry.value.flag;
      said.insert(entry.key);
      if (entry.value.flag && known->by_default == EffectFlag::Default::where_given &&
          !has_parameters(r.scene, *known) && r.unreadable.empty())
        r.refuse(entry.at, fmt::format("[effects]: {} = true, but no component has parameters for it; give {}, or drop "
                                       "the line",
                                       entry.key, known->parameters));
    }
  }
}

}  // namespace

void read_effects(SceneReading& r) {
  std::set<std::string> said;
  read_effects_table(r, said);
  complete_effects(r, said);
}

}  // namespace kurbel
