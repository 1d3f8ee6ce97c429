// section_reader.cpp — checks types, units and domains of a table's values.
#include "engine/reading/section_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/values/curve_reader.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

constexpr std::size_t most_items = 100'000;

std::string first_example_of(const std::string& unit) {
  const std::string examples = examples_of(unit);
  return examples.substr(0, examples.find(", "));
}

// How a missing value would be written.
std::string example_of(const Key& key) {
  switch (key.type) {
    case KeyType::quantity:
      return first_example_of(key.unit);
    case KeyType::integers:
      return "[19, 95]";
    case KeyType::quantities:
      return key.unit.empty() ? "[0, 0]" : fmt::format("[{}]", first_example_of(key.unit));
    case KeyType::curve:
      return fmt::format("{{ over = \"{}\", unit = [\"{}\", \"{}\"], points = [[0, 0], [1, 1]] }}", key.choices.front(),
                         unit_over(key.choices.front()), key.unit);
    case KeyType::sections: {
      std::string text = key.nested->size() == 1 ? "" : fmt::format("kind = \"{}\"", key.nested->front().name);
      for (const Key& nested : key.nested->front().keys)
        if (nested.required)
          text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", nested.name, example_of(nested));
      return fmt::format("[{{ {} }}]", text);
    }
    case KeyType::named:
      return fmt::format("{{ A = {} }}", example_of(key.nested->front().keys.front()));
    default:
      return "…";
  }
}

bool read_list(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages,
               Setting& setting) {
  if (value.type != Type::list) {
    messages.add(value.at, fmt::format("{} = {}; must be a list in brackets{}", what, value.describe(),
                                       key.type == KeyType::integers ? ", e.g. [19, 95]" : ""));
    return false;
  }
  if (value.items.size() > most_items) {
    messages.add(value.at, fmt::format("{} has {} values; must be at most {}", what, value.items.size(), most_items));
    return false;
  }
  if (value.items.empty() && key.fallback != "[]") {  // nobody behind the reader asks whether there is a first one
    messages.add(value.at, fmt::format("{} = []; must hold one value at least, e.g. [{}]{}", what,
                                       key.type == KeyType::integers ? "1" : first_example_of(key.unit),
                                       key.required ? "" : ", or leave the key out"));
    return false;
  }
  for (const DocumentValue& item : value.items) {
    double number = 0;
    if (key.type == KeyType::integers) {
      if (!is_whole(item) || !key.domain.contains(item.number)) {
        messages.add(item.at, fmt::format("{} = {}; must be a whole number, {}", what, item.describe(),
                                          key.domain.describe("")));
        return false;
      }
      number = item.number;
    } else if (!read_quantity(item, key.unit, key.domain, what, messages, number)) {
      return false;
    }
    setting.numbers.push_back(number);
  }
  return true;
}

bool read_nested(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages,
                 DataFiles allowed, Setting& setting) {
  std::vector<const DocumentValue*> tables;
  if (value.type == Type::table) tables.push_back(&value);
  for (const DocumentValue& item : value.items) tables.push_back(&item);
  bool good = !tables.empty() || value.type == Type::list;
  for (const DocumentValue* table : tables) good = good && table->type == Type::table;
  if (!good) {
    messages.add(value.at, fmt::format("{} = {}; must be a table or a list of tables, e.g. {}", what, value.describe(),
                                       example_of(key)));
    return false;
  }
  bool valid = true;  // else something was said, be it of a table used by name, before this component was come to
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const DocumentValue& table = *tables[i];
    if (table.computed && table.computed->faulty) {
      valid = false;
      continue;
    }
    const std::string name = value.type == Type::table ? what : fmt::format("{}[{}]", what, i + 1);
    const bool one_kind = key.nested->size() == 1;
    const Kind* kind = one_kind ? &key.nested->front() : read_kind(table, *key.nested, name, table.at, messages);
    if (kind) {
      setting.sections.push_back(read_section(table, *kind, key.name, name, messages,
                                              one_kind ? std::vector<std::string>{} : std::vector<std::string>{"kind"},
                                              allowed));
      valid = valid && setting.sections.back().valid;
    } else {
      valid = false;
    }
  }
  return valid;
}

// { A = [0, 0], B = { at = [1, 0] } }: what is no table is the value of the first key of one.
bool read_named(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages,
                DataFiles allowed, Setting& setting) {
  if (value.type != Type::table || value.entries.empty() || value.entries.size() > most_items) {
    messages.add(value.at, fmt::format("{} = {}; must be a table with a name of yours for each, e.g. {}", what,
                                       value.type == Type::table && value.entries.empty() ? "{ }" : value.describe(),
                                       example_of(key)));
    return false;
  }
  const Kind& kind = key.nested->front();
  bool valid = true;
  for (const DocumentEntry& entry : value.entries) {
    DocumentValue table = entry.value;
    if (table.computed && table.computed->faulty) {
      valid = false;
      continue;
    }
    if (table.type != Type::table) {
      table = {};
      table.at = entry.at, table.end = entry.value.end;
      table.entries.push_back({kind.keys.front().name, entry.at, entry.value});
    }
    const std::string name = what + "." + entry.key;
    setting.sections.push_back(read_section(table, kind, entry.key, name, messages, {}, allowed));
    valid = valid && setting.sections.back().valid;
  }
  return valid;
}

bool read_setting(const DocumentValue& value, const Key& key, const std::string& what, Messages& messages,
                  DataFiles allowed, Setting& setting) {
  const auto refuse = [&](const std::string& allowed) {
    messages.add(value.at, fmt::format("{} = {}; must be {}", what, value.describe(), allowed));
    return false;
  };
  if (value.computed && value.computed->faulty) return false;
  switch (key.type) {
    case KeyType::quantity:
      return read_quantity(value, key.unit, key.domain, what, messages, setting.number);
    case KeyType::integer:
      if (!is_whole(value) || !key.domain.contains(value.number))
        return refuse(fmt::format("a whole number, {}", key.domain.describe("")));
      setting.number = value.number;
      return true;
    case KeyType::flag:
      if (value.type != Type::flag) return refuse("true or false");
      setting.flag = value.flag;
      return true;
    case KeyType::text:
      if (value.type != Type::text) return refuse(key.choices.empty() ? "a text in quotes" : listed(key.choices));
      setting.text = value.text;
      if (key.choices.empty() || std::find(key.choices.begin(), key.choices.end(), value.text) != key.choices.end())
        return true;
      return refuse(listed(key.choices) + suggestion(value.text, key.choices));
    case KeyType::curve:
      return read_curve(value, key, what, messages, allowed, setting.curve);
    case KeyType::quantities:
    case KeyType::integers:
      return read_list(value, key, what, messages, setting);
    case KeyType::sections:
      return read_nested(value, key, what, messages, allowed, setting);
    case KeyType::named:
      return read_named(value, key, what, messages, allowed, setting);
  }
  return false;
}

// A fallback is written as in a file; it is read by the same code.
Setting fallback_setting(const Key& key, Location at, Messages& messages) {
  const DocumentValue document = parse_toml("x = " + key.fallback, "fallback of " + key.name);
  Setting setting;
  setting.key = key.name;
  setting.at = at;
  read_setting(document.entries.front().value, key, key.name, messages, DataFiles::below_the_scene, setting);
  return setting;
}

}  // namespace

const Kind* read_kind(const DocumentValue& table, const std::vector<Kind>& kinds, const std::string& what, Location at,
                      Messages& messages) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  const DocumentEntry* entry = table.find("kind");
  if (!entry) {
    messages.add(at, fmt::format("{}: \"kind\" is missing; allowed: {}", what, listed(names)));
    return nullptr;
  }
  for (const Kind& kind : kinds)
    if (entry->value.type == Type::text && kind.name == entry->value.text) return &kind;
  messages.add(entry->value.at, fmt::format("{}: kind = {}{}; allowed: {}", what, entry->value.describe(),
                                            suggestion(entry->value.text, names), listed(names)));
  return nullptr;
}

Section read_section(const DocumentValue& table, const Kind& kind, const std::string& name, const std::string& what,
                     Messages& messages, const std::vector<std::string>& passed_over, DataFiles allowed) {
  Section section{.name = name, .kind = &kind, .at = table.at};
  const std::size_t errors_before = messages.all().size();
  bool all_read = true;                   // else something was said, be it before this component was come to
  std::vector<std::string> known, meant;  // meant: by a key mistyped
  for (const Key& key : kind.keys) known.push_back(key.name);
  known.insert(known.end(), passed_over.begin(), passed_over.end());
  for (const DocumentEntry& entry : table.entries) {
    if (std::find(passed_over.begin(), passed_over.end(), entry.key) != passed_over.end()) continue;
    const Key* const key = kind.key(entry.key);
    if (!key) {
      if (const auto near = nearest(entry.key, known)) meant.push_back(*near);
      messages.add(entry.at, fmt::format("{}: unknown key {}{}; allowed: {}", what, in_quotes(entry.key),
                                         suggestion(entry.key, known), listed(known, "and")));
      continue;
    }
    Setting setting;
    setting.key = key->name;
    setting.at = entry.value.at;
    setting.given = true;
    if (read_setting(entry.value, *key, what + ": " + key->name, messages, allowed, setting)) {
      section.settings.push_back(std::move(setting));
    } else {
      // Something was said about this value already: put the least harmful one in its place.
      all_read = false;
      setting.number = std::isfinite(key->domain.low) ? key->domain.low + 1 : 0;
      setting.text = key->choices.empty() ? "" : key->choices.front();
      section.settings.push_back(std::move(setting));
    }
  }
  for (const Key& key : kind.keys) {
    if (section.has(key.name)) continue;
    if (!key.fallback.empty()) {
      section.settings.push_back(fallback_setting(key, section.at, messages));
    } else if (key.required && std::find(meant.begin(), meant.end(), key.name) == meant.end()) {
      messages.add(section.at, fmt::format("{}: \"{}\" is missing ({}); write e.g. {} = {}", what, key.name,
                                           std::string_view(key.doc), key.name, example_of(key)));
    }
  }
  section.valid = all_read && messages.all().size() == errors_before;
  return section;
}

}  // namespace kurbel
