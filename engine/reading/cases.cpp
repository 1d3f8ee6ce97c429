// cases.cpp — [[case]]: reads the list, and the machine of each case as a check.
#include <fmt/format.h>

#include <algorithm>

#include "engine/reading/read_scene.h"
#include "engine/reading/scene_reading.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

const char* const how =
    "a case is written [[case]] with name = \"damper out of order\" and set = [\"damper.damping=0 N*m*s/rad\"]";

Case read_case(const DocumentValue& table, Messages& messages) {
  Case made;
  if (table.type != Type::table)
    return messages.add(table.at, fmt::format("case = {}: {}", table.describe(), how)), made;
  for (const DocumentEntry& entry : table.entries) {
    if (entry.key == "name" && entry.value.type == Type::text && !entry.value.text.empty()) {
      made.name = entry.value.text;
    } else if (entry.key == "set" && entry.value.type == Type::list) {
      for (const DocumentValue& item : entry.value.items) {
        if (item.type != Type::text)
          messages.add(item.at, fmt::format("case: set: {}; must be a text COMPONENT.KEY=VALUE", item.describe()));
        made.settings.push_back(item.text), made.setting_at.push_back(item.at);
      }
    } else {
      messages.add(entry.at, fmt::format("case: {} = {}; {}", entry.key, entry.value.describe(), how));
    }
  }
  if (made.name.empty()) messages.add(table.at, fmt::format("a case without a name; {}", how));
  if (made.settings.empty()) messages.add(table.at, fmt::format("a case that sets nothing; {}", how));
  return made;
}

std::vector<Case> read_list(const DocumentValue& document, Messages& messages) {
  std::vector<Case> cases;
  const DocumentEntry* entry = document.find("case");
  if (!entry) return cases;
  if (entry->value.type != Type::list)
    return messages.add(entry->at, fmt::format("case = {}: {}", entry->value.describe(), how)), cases;
  for (const DocumentValue& table : entry->value.items) {
    Case made = read_case(table, messages);
    if (std::any_of(cases.begin(), cases.end(), [&](const Case& other) { return other.name == made.name; }))
      messages.add(table.at, fmt::format("two cases are named {}", in_quotes(made.name)));
    cases.push_back(std::move(made));
  }
  return cases;
}

// Faults by settings are located at the setting in the file; others at their own location.
void place(const Case& one, const SceneError& error, Messages& messages) {
  for (const Message& m : error.messages) {
    const auto said = std::find_if(one.settings.begin(), one.settings.end(), [&](const std::string& setting) {
      return m.file == fmt::format("--set {}", in_quotes(setting));
    });
    const bool here = said != one.settings.end();
    messages.add(here ? one.setting_at[static_cast<std::size_t>(said - one.settings.begin())] : m.at,
                 fmt::format("case {}: {}{}", in_quotes(one.name), here ? in_quotes(*said) + ": " : "", m.text));
  }
}

}  // namespace

void read_cases(SceneReading& r) {
  const std::size_t before = r.messages.all().size();
  const std::vector<Case> cases = read_list(r.document, r.messages);
  if (r.messages.all().size() > before) return;
  for (const Case& one : cases) try {
      scene_of(one, r.scene.text, r.scene.file, {}, r.kinds, r.allowed);
    } catch (const SceneError& error) {
      place(one, error, r.messages);
    }
}

std::vector<Case> cases_of(const std::string& text, const std::string& file) {
  Messages messages(file);
  std::vector<Case> cases = read_list(parse_toml(text, file), messages);
  messages.throw_if_any();
  return cases;
}

Scene scene_of(const Case& one, const std::string& text, const std::string& file,
               const std::vector<std::string>& settings, const std::vector<Kind>& kinds, DataFiles allowed) {
  std::vector<std::string> all = settings;
  all.insert(all.end(), one.settings.begin(), one.settings.end());
  return parse_scene(SettledText(text, file, all), kinds, allowed, false);
}

}  // namespace kurbel
