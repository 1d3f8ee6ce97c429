// component_reader.cpp — reads the tables of the components and other top-level entries of a scene.
#include <fmt/format.h>

#include <algorithm>

#include "engine/numerics/deadline.h"
#include "engine/reading/scene_reading.h"
#include "engine/reading/section_reader.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = {"title", "description", "line",      "branch", "effects", "sequence",
                                                 "run",   "operation",   "constants", "case",   "figure"};
  return names;
}

static bool is_top_key(const DocumentEntry& entry) { return entry.key == "line" || entry.key == "title"; }

void refuse_top_key(SceneReading& r, const DocumentEntry& entry) {
  const auto is = [&](const Key& key) { return key.name == entry.key; };
  const bool tables =
      entry.value.type == Type::list && !entry.value.items.empty() && entry.value.items.front().type == Type::table;
  if (tables) {
    r.refuse(entry.at,
             fmt::format("[[{0}]] is a list of tables; a component is written [{0}], a branch [[branch]]", entry.key));
  } else if (std::any_of(run_keys().begin(), run_keys().end(), is) || entry.key == "start" || entry.key == "output") {
    r.refuse(entry.at, fmt::format("\"{}\" belongs under [run]", entry.key));
  } else if (entry.key == "elasticity") {
    r.refuse(entry.at, "\"elasticity\" belongs under [effects]");
  } else {
    r.refuse(
        entry.at,
        fmt::format("unknown key {}{}; allowed at the top of a scene: {}, and a table for each component",
                    in_quotes(entry.key), suggestion(entry.key, reserved_names()), listed(reserved_names(), "and")));
  }
}

// `on = "flywheel"` is a branch of one component.
void read_on(SceneReading& r, const Section& section, const DocumentValue& value) {
  if (section.kind->placement == Placement::inline_two) {
    r.lines_valid = false;
    return r.refuse(value.at,
                    fmt::format("{} \"{}\": on = {}; it has two shafts and stands in a `line` or a [[branch]]",
                                section.kind->name, section.name, value.describe()));
  }
  if (value.type != Type::text || value.text.empty()) {
    r.lines_valid = false;
    return r.refuse(value.at, fmt::format("{} \"{}\": on = {}; must be the name of a component in quotes",
                                          section.kind->name, section.name, value.describe()));
  }
  r.scene.lines.push_back({value.text, {section.name}, value.at, {value.at}});
}

// `orders = [5]`: blades or teeth of any component that has no such key of its own.
void read_orders(SceneReading& r, const std::string& what, const std::string& name, const DocumentValue& value) {
  std::vector<double>& orders = r.scene.operation.orders[name];
  if (value.type != Type::list || value.items.empty())
    return r.refuse(value.at, fmt::format("{}: orders = {}; must be a list of numbers per turn of its shaft, e.g. [5]",
                                          what, value.describe()));
  for (const DocumentValue& item : value.items) {
    const bool number = item.type == Type::integer || item.type == Type::number;
    if (!number || !(item.number > 0 && item.number <= 1e5))
      r.refuse(item.at, fmt::format("{}: orders: {}; must be a number > 0 and ≤ 100000", what, item.describe()));
    orders.push_back(item.number);
  }
}

// Each of [table] is used by name; else it is a component that lacks its kind.
bool tables_are_tables(SceneReading& r, const DocumentEntry& tables) {
  bool any = false;
  for (const DocumentEntry& entry : tables.value.entries) any = any || entry.value.type == Type::table;
  if (!any && !tables.value.entries.empty()) return false;
  for (const DocumentEntry& entry : tables.value.entries)
    if (entry.value.type != Type::table)
      r.refuse(entry.at, fmt::format("[table] holds tables that are used by name, as [table.gas]; {} = {} is none",
                                     entry.key, entry.value.describe()));
  return true;
}

bool read_component(SceneReading& r, const DocumentEntry& entry) {
  const std::string& name = entry.key;
  // A misspelt [effects] or [run], not a component.
  const auto table_meant =
      entry.value.find("kind") ? std::nullopt : nearest(name, {"effects", "sequence", "run", "operation", "branch"});
  if (table_meant) {
    r.refuse(entry.at,
             fmt::format("unknown table [{}] — did you mean [{}]? A component needs its \"kind\"", name, *table_meant));
    return false;
  }
  const Kind* kind = read_kind(entry.value, r.kinds, fmt::format("component \"{}\"", name), entry.at, r.messages);
  if (!kind) return false;
  DocumentValue table = entry.value;
  table.at = entry.at;
  // In TOML every key belongs to the table header above it: the most common error with `line`.
  for (const DocumentEntry& inner : entry.value.entries)
    if (is_top_key(inner)) {
      r.refuse(inner.at,
               fmt::format("{} \"{}\": \"{}\" stands in the table [{}]; move it above the first table of the file",
                           kind->name, name, inner.key, name));
      if (inner.key == "line") r.misplaced_line = &inner;
    }
  table.entries.erase(std::remove_if(table.entries.begin(), table.entries.end(), is_top_key), table.entries.end());
  const DocumentEntry* on = entry.value.find("on");
  std::vector<std::string> read_elsewhere = {"kind"};
  if (on || kind->placement == Placement::inline_one) read_elsewhere.push_back("on");
  const std::string what = fmt::format("{} \"{}\"", kind->name, name);
  if (const DocumentEntry* orders = entry.value.find("orders")) {
    read_orders(r, what, name, orders->value);
    read_elsewhere.push_back("orders");
  }
  Section section = read_section(table, *kind, name, what, r.messages, read_elsewhere, r.allowed);
  if (on) read_on(r, section, on->value);
  r.index[name] = r.scene.components.size();
  r.scene.components.push_back(std::move(section));
  return true;
}

}  // namespace

void read_components(SceneReading& r) {
  for (const DocumentEntry& entry : r.document.entries) {
    Deadline::check();
    if (entry.key == "title" || entry.key == "description") {
      if (entry.value.type != Type::text)
        r.refuse(entry.value.at, fmt::format("{} = {}; must be a text in quotes", entry.key, entry.value.describe()));
      if (entry.key == "title") r.scene.title = entry.value.text;
      continue;
    }
    if (std::count(reserved_names().begin(), reserved_names().end(), entry.key)) continue;
    if (entry.key == "table" && is_table_of_tables(entry.value) && tables_are_tables(r, entry)) continue;
    const bool good_name = !entry.key.empty() &&
                           entry.key.find_first_not_of(
                               "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
    if (entry.value.type != Type::table) {
      refuse_top_key(r, entry);
    } else if (!good_name) {
      r.refuse(entry.at,
               fmt::format("component name {}: only letters, digits, _ and - are allowed", in_quotes(entry.key)));
    } else if (read_component(r, entry)) {
      continue;
    }
    r.unreadable.insert(entry.key);
  }
}

}  // namespace kurbel
