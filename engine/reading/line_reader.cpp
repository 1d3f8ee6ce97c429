// line_reader.cpp — `line` and the [[branch]]es: names in rows, each with its place.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/reading/scene_reading.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

Line read_line(SceneReading& r, const DocumentValue& value, const std::string& what, const std::string& from) {
  Line line{.from = from, .at = value.at};
  if (value.type != Type::list || value.items.empty()) {
    r.refuse(value.at, fmt::format("{} = {}; must be a list of component names, e.g. [\"motor\", \"press\"]", what,
                                   value.type == Type::list ? "[]" : value.describe()));
    r.lines_sound = false;
    return line;
  }
  for (const DocumentValue& item : value.items) {
    if (item.type != Type::text) {
      r.refuse(item.at, fmt::format("{}: {} is no component name in quotes", what, item.describe()));
      r.lines_sound = false;
      continue;
    }
    line.names.push_back(item.text);
    line.name_at.push_back(item.at);
  }
  return line;
}

// The text of a port, "gearbox.out"; none, with a message, where something else stands there.
std::optional<std::string> read_port(SceneReading& r, const DocumentEntry& entry) {
  if (entry.value.type == Type::text && !entry.value.text.empty()) return entry.value.text;
  r.refuse(entry.value.at, fmt::format("branch: {} = {}; must be the name of a component in quotes", entry.key,
                                       entry.value.describe()));
  return {};
}

void read_branch(SceneReading& r, const DocumentValue& branch) {
  static const std::vector<std::string> keys = {"from", "line", "to"};
  const auto is_key = [&](const DocumentEntry& e) { return std::count(keys.begin(), keys.end(), e.key) > 0; };
  for (const DocumentEntry& entry : branch.entries)
    if (!is_key(entry))
      r.refuse(entry.at, fmt::format("branch: unknown key {}{}; allowed: \"from\", \"line\" and \"to\"",
                                     in_quotes(entry.key), suggestion(entry.key, keys)));
  const DocumentEntry *from = branch.find("from"), *line = branch.find("line"), *to = branch.find("to");
  const bool mistyped = std::any_of(branch.entries.begin(), branch.entries.end(),
                                    [&](const DocumentEntry& e) { return !is_key(e) && nearest(e.key, keys); });
  std::optional<std::string> begin, end;
  if (branch.type != Type::table || ((!from || !line) && !mistyped)) {
    r.refuse(branch.at, fmt::format("branch: {}; needs from = \"component\" and line = [\"component\", …]",
                                    branch.type != Type::table ? branch.describe() + " is no table"
                                    : !from && !line           ? "\"from\" and \"line\" are missing"
                                    : from                     ? "\"line\" is missing"
                                                               : "\"from\" is missing"));
    if (from && from->value.type == Type::text) begin = from->value.text;
  } else {
    if (from) begin = read_port(r, *from);
    if (to) end = read_port(r, *to);
  }
  if (!begin || begin->empty() || !line || (to && !end)) r.lines_sound = false;
  if (!line) return;
  Line read = read_line(r, line->value, "branch: line", begin.value_or(""));
  if (!begin || begin->empty()) return;
  read.at = from->value.at;
  if (end) read.to = *end, read.to_at = to->value.at;
  r.scene.lines.push_back(std::move(read));
}

}  // namespace

void read_lines(SceneReading& r) {
  const DocumentEntry* line = r.document.find("line");
  if (!line) line = r.misplaced_line;
  if (!line) {
    r.lines_sound = false;
    r.scene.lines.insert(r.scene.lines.begin(), Line{});
    r.refuse({1, 1},
             "\"line\" is missing: the components in the order of the drive, e.g. line = [\"motor\", \"coupling\", "
             "\"press\"]");
  } else {
    r.scene.lines.insert(r.scene.lines.begin(), read_line(r, line->value, "line", ""));
  }
  const DocumentEntry* branches = r.document.find("branch");
  if (!branches) return;
  if (branches->value.type != Type::list) {
    r.lines_sound = false;
    return r.refuse(branches->at,
                    "branch is no list of tables; each branch is written as [[branch]] with `from` and `line`");
  }
  for (const DocumentValue& branch : branches->value.items) read_branch(r, branch);
}

}  // namespace kurbel
