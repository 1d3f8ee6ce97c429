// lines.cpp — reads `line` and the [[branch]]es with locations; checks them against the components, and puts them in
// canonical order.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

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
    r.lines_valid = false;
    return line;
  }
  for (const DocumentValue& item : value.items) {
    if (item.type != Type::text) {
      r.refuse(item.at, fmt::format("{}: {} is no component name in quotes", what, item.describe()));
      r.lines_valid = false;
      continue;
    }
    line.names.push_back(item.text);
    line.name_at.push_back(item.at);
  }
  return line;
}

// The text of a port, "gearbox.out"; empty, with a message, for another value.
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
  if (!begin || begin->empty() || !line || (to && !end)) r.lines_valid = false;
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
    r.lines_valid = false;
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
    r.lines_valid = false;
    return r.refuse(branches->at,
                    "branch is no list of tables; each branch is written as [[branch]] with `from` and `line`");
  }
  for (const DocumentValue& branch : branches->value.items) read_branch(r, branch);
}

namespace {

// "gearbox.out" → "gearbox".
std::string component_of(const std::string& port) { return port.substr(0, port.find('.')); }

// "gearbox.out", where a branch begins or ends: is there such a shaft?
void check_port(SceneReading& r, const std::string& said, Location where, const std::vector<std::string>& names,
                const std::map<std::string, Location>& placed) {
  const std::string component = component_of(said);
  const Section* section = r.find(component);
  if (!section) {
    if (!r.unreadable.count(component)) r.refuse(where, r.no_component(component, names));
    return;
  }
  if (!placed.count(component)) return;  // reported elsewhere
  const std::string port = said.size() > component.size() ? said.substr(component.size() + 1) : "";
  const bool two = section->kind->placement == Placement::inline_two;
  const std::vector<std::string>& more = section->kind->further_shafts;
  if (two && port != "in" && port != "out" && !std::count(more.begin(), more.end(), port)) {
    if (more.empty()) {
      r.refuse(where, fmt::format("{}: {} \"{}\" has two shafts; say \"{}.in\" or \"{}.out\"", in_quotes(said),
                                  section->kind->name, component, component, component));
    } else {
      std::vector<std::string> ports = {component + ".in", component + ".out"};
      for (const std::string& other : more) ports.push_back(component + "." + other);
      r.refuse(where, fmt::format("{}: {} \"{}\" has {} shafts; say {}", in_quotes(said), section->kind->name,
                                  component, ports.size(), listed(ports)));
    }
  }
  if (!two && component.size() != said.size())
    r.refuse(where, fmt::format("{}: {} \"{}\" has one shaft; say \"{}\"", in_quotes(said), section->kind->name,
                                component, component));
}

void check_ends(SceneReading& r, const Line& line, const std::vector<std::string>& names,
                const std::map<std::string, Location>& placed) {
  if (line.from.empty()) return;
  const bool ring = std::count(line.names.begin(), line.names.end(), component_of(line.from)) > 0;  // reported below
  if (!ring) check_port(r, line.from, line.at, names, placed);
  if (line.to.empty()) return;
  if (std::count(line.names.begin(), line.names.end(), component_of(line.to)))
    r.refuse(line.to_at,
             fmt::format("the branch ends at \"{0}\", which it holds itself; end it at a component of another line",
                         component_of(line.to)));
  else
    check_port(r, line.to, line.to_at, names, placed);
  if (line.to == line.from)
    r.refuse(line.to_at, fmt::format("the branch begins and ends at \"{}\"; a loop ends at another shaft", line.to));
}

void report_ring(SceneReading& r, std::size_t first, const std::map<std::string, std::size_t>& line_of) {
  std::vector<std::string> from;
  Location where = r.scene.lines[first].at;
  std::size_t at = first;
  do {
    from.push_back(r.scene.lines[at].from);
    where = std::min(where, r.scene.lines[at].at);
    at = line_of.at(component_of(r.scene.lines[at].from));
  } while (at != first);
  if (from.size() == 1)
    return r.refuse(where,
                    fmt::format("the branch from \"{0}\" holds \"{0}\" itself; begin it at a component of another line",
                                component_of(from.front())));
  r.refuse(where,
           fmt::format(
               "the branches from {} begin at each other in a ring; begin one of them at a component of the main line",
               shortened_list(from, "and")));
}

// Branches that depend on each other in a ring, separate from the main line: one message per ring.
void check_rings(SceneReading& r) {
  std::map<std::string, std::size_t> line_of;
  for (std::size_t i = 0; i < r.scene.lines.size(); ++i)
    for (const std::string& name : r.scene.lines[i].names) line_of.emplace(name, i);
  std::vector<std::size_t> walk(r.scene.lines.size(), 0);  // number of the walk that passed here
  for (std::size_t i = 0; i < r.scene.lines.size(); ++i) {
    std::size_t at = i;
    while (walk[at] == 0) {
      walk[at] = i + 1;
      const auto next = line_of.find(component_of(r.scene.lines[at].from));
      if (r.scene.lines[at].from.empty() || next == line_of.end()) break;
      at = next->second;
      if (walk[at] == i + 1) report_ring(r, at, line_of);
    }
  }
}

}  // namespace

// Checks: every name exists, every component is used once, every branch has a begin.
void check_connections(SceneReading& r) {
  std::map<std::string, Location> placed;
  std::set<std::string> meant;  // by a name mistyped elsewhere
  const std::vector<std::string> names = r.component_names();
  for (const Line& line : r.scene.lines)
    for (std::size_t i = 0; i < line.names.size(); ++i) {
      const std::string& name = line.names[i];
      if (!r.find(name)) {
        if (r.unreadable.count(name)) continue;
        r.refuse(line.name_at[i], r.no_component(name, names));
        if (r.explains())
          if (const auto near = nearest(name, names)) meant.insert(*near);
        continue;
      }
      if (const auto [first, fresh] = placed.emplace(name, line.name_at[i]); !fresh)
        r.refuse(line.name_at[i],
                 fmt::format("component \"{}\" is used twice (first at line {}); one component stands in one place",
                             name, first->second.line));
    }
  for (const Line& line : r.scene.lines) check_ends(r, line, names, placed);
  for (const Section& section : r.scene.components)
    if (r.lines_valid && !placed.count(section.name) && !meant.count(section.name))
      r.refuse(section.at,
               fmt::format(
                   "{} \"{}\" is not connected; put it into `line` or a [[branch]]{}", section.kind->name, section.name,
                   section.kind->placement == Placement::inline_two ? "" : ", or say on = \"component\" in its table"));
  check_rings(r);
}

// The order of tables in the file must not change a single bit of a result: components are sorted along the main
// line, then along the branches by their places of departure and names.
void put_in_canonical_order(SceneReading& r) {
  if (r.scene.lines.empty()) return;
  std::sort(r.scene.lines.begin() + 1, r.scene.lines.end(), [](const Line& a, const Line& b) {
    return std::tie(a.from, a.names, a.to) < std::tie(b.from, b.names, b.to);
  });
  // A branch may begin at a branch: lines follow those they depart from, otherwise in sorted order.
  std::multimap<std::string, std::size_t> waiting;
  for (std::size_t i = 1; i < r.scene.lines.size(); ++i) waiting.emplace(component_of(r.scene.lines[i].from), i);
  std::vector<Line> ordered;
  std::set<std::size_t> ready = {0};
  while (!ready.empty()) {
    const Line& next = r.scene.lines[*ready.begin()];
    ready.erase(ready.begin());
    ordered.push_back(next);
    for (const std::string& name : next.names) {
      const auto [first, last] = waiting.equal_range(name);
      for (auto it = first; it != last; ++it) ready.insert(it->second);
      waiting.erase(first, last);
    }
  }
  r.scene.lines = std::move(ordered);  // missing ones are in a ring or unconnected, and were reported
  std::map<std::string, std::size_t> rank;
  for (const Line& line : r.scene.lines)
    for (const std::string& name : line.names) rank.emplace(name, rank.size() + 1);
  std::stable_sort(r.scene.components.begin(), r.scene.components.end(),
                   [&](const Section& a, const Section& b) { return rank[a.name] < rank[b.name]; });
  for (std::size_t i = 0; i < r.scene.components.size(); ++i) r.index[r.scene.components[i].name] = i;
}

}  // namespace kurbel
