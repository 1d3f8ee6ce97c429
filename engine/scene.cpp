// scene.cpp — reads a scene file: its line and branches, its components, its effects and its run.
#include "engine/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "engine/document.h"
#include "engine/section_reader.h"
#include "engine/units.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = {"title", "line", "branch", "effects", "run", "description"};
  return names;
}

// "gearbox.out" → "gearbox".
std::string component_of(const std::string& port) { return port.substr(0, port.find('.')); }

std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const auto near = nearest(word, names);
  return near ? fmt::format(" — did you mean \"{}\"?", *near) : "";
}

class SceneReader {
 public:
  SceneReader(const std::string& text, const std::string& file, const std::vector<Kind>& kinds)
      : kinds_(kinds), messages_(file), document_(parse_toml(text, file)) {
    scene_.file = file;
    scene_.text = text;
  }

  Scene read() {
    read_components();
    read_lines();
    check_connections();
    put_in_canonical_order();
    read_effects();
    read_run();
    messages_.throw_if_any();
    return std::move(scene_);
  }

 private:
  void refuse(Location at, const std::string& text) { messages_.add(at, text); }

  std::vector<std::string> component_names() const {
    std::vector<std::string> names;
    for (const Section& section : scene_.components) names.push_back(section.name);
    return names;
  }
  const Section* find(const std::string& name) const { return scene_.find(name); }

  void read_components() {
    for (const DocumentEntry& entry : document_.entries) {
      if (entry.key == "title" || entry.key == "description") {
        if (entry.value.type != Type::text) refuse(entry.value.at, fmt::format("{} must be a text in quotes", entry.key));
        if (entry.key == "title") scene_.title = entry.value.text;
        continue;
      }
      if (std::count(reserved_names().begin(), reserved_names().end(), entry.key)) continue;
      if (entry.value.type != Type::table) {
        refuse(entry.at, fmt::format("unknown key \"{}\"{}; at the top of a scene stand {} and one table for each component",
                                     entry.key, suggestion(entry.key, reserved_names()), listed(reserved_names(), "and")));
        continue;
      }
      if (entry.key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") != std::string::npos) {
        refuse(entry.at, fmt::format("component name \"{}\": only letters, digits, _ and - are allowed", entry.key));
        continue;
      }
      const std::string name = entry.key;
      const Kind* kind = read_kind(entry.value, kinds_, fmt::format("component \"{}\"", name), entry.at, messages_);
      if (!kind) {
        unreadable_.insert(name);
        continue;
      }
      DocumentValue table = entry.value;
      table.at = entry.at;
      Section section = read_section(table, *kind, name, fmt::format("{} \"{}\"", kind->name, name), messages_, {"on"});
      if (const DocumentEntry* on = entry.value.find("on")) read_on(section, on->value);
      scene_.components.push_back(std::move(section));
    }
  }

  // `on = "flywheel"` is a branch of one component.
  void read_on(const Section& section, const DocumentValue& value) {
    if (section.kind->placement == Placement::inline_two)
      return refuse(value.at, fmt::format("{} \"{}\" has two shafts and stands in a line or branch, not `on` a component",
                                          section.kind->name, section.name));
    if (value.type != Type::text) return refuse(value.at, "on must be the name of a component in quotes");
    scene_.lines.push_back({value.text, {section.name}, value.at, {value.at}});
  }

  void read_lines() {
    const DocumentEntry* line = document_.find("line");
    if (!line) {
      refuse({1, 1}, "\"line\" is missing: the components in the order of the drive, e.g. line = [\"motor\", \"coupling\", \"press\"]");
    } else {
      scene_.lines.insert(scene_.lines.begin(), read_line(line->value, "line", ""));
    }
    const DocumentEntry* branches = document_.find("branch");
    if (!branches) return;
    if (branches->value.type != Type::list) return refuse(branches->at, "branches are written as [[branch]] with `from` and `line`");
    for (const DocumentValue& branch : branches->value.items) read_branch(branch);
  }
  void read_branch(const DocumentValue& branch) {
    for (const DocumentEntry& entry : branch.entries)
      if (entry.key != "from" && entry.key != "line")
        refuse(entry.at, fmt::format("branch: unknown key \"{}\"{}; allowed: \"from\" and \"line\"", entry.key, suggestion(entry.key, {"from", "line"})));
    const DocumentEntry* from = branch.find("from");
    const DocumentEntry* line = branch.find("line");
    if (!from || from->value.type != Type::text || !line)
      return refuse(branch.at, "branch: needs from = \"component\" and line = [\"component\", …]");
    Line read = read_line(line->value, "branch", from->value.text);
    read.at = from->value.at;
    scene_.lines.push_back(std::move(read));
  }
  Line read_line(const DocumentValue& value, const std::string& what, const std::string& from) {
    Line line{.from = from, .at = value.at};
    if (value.type != Type::list || value.items.empty()) {
      refuse(value.at, fmt::format("{} = {}; must be a list of component names, e.g. [\"motor\", \"press\"]", what, value.describe()));
      return line;
    }
    for (const DocumentValue& item : value.items) {
      if (item.type != Type::text) {
        refuse(item.at, fmt::format("{}: {} is no component name in quotes", what, item.describe()));
        continue;
      }
      line.names.push_back(item.text);
      line.name_at.push_back(item.at);
    }
    return line;
  }

  // Every name exists, every component stands in one place, every branch begins somewhere.
  void check_connections() {
    std::map<std::string, Location> placed;
    const std::vector<std::string> names = component_names();
    for (const Line& line : scene_.lines)
      for (std::size_t i = 0; i < line.names.size(); ++i) {
        const std::string& name = line.names[i];
        if (!find(name)) {
          if (!unreadable_.count(name))
            refuse(line.name_at[i], fmt::format("component \"{}\" has no table [{}]{}; tables here: {}", name, name, suggestion(name, names),
                                                names.empty() ? "none" : listed(names, "and")));
          continue;
        }
        if (const auto [first, fresh] = placed.emplace(name, line.name_at[i]); !fresh)
          refuse(line.name_at[i], fmt::format("component \"{}\" is used twice (first at line {}); one component stands in one place", name, first->second.line));
      }
    for (const Line& line : scene_.lines)
      if (!line.from.empty()) check_from(line, names, placed);
    for (const Section& section : scene_.components)
      if (!placed.count(section.name))
        refuse(section.at, fmt::format("{} \"{}\" is not connected; put it into `line` or a [[branch]]{}", section.kind->name, section.name,
                                       section.kind->placement == Placement::inline_two ? "" : ", or say `on = \"component\"`"));
    check_reachable();
  }
  void check_from(const Line& line, const std::vector<std::string>& names, const std::map<std::string, Location>& placed) {
    const std::string component = component_of(line.from);
    const Section* section = find(component);
    if (!section) {
      if (!unreadable_.count(component))
        refuse(line.at, fmt::format("\"{}\" is no component{}; allowed: {}", line.from, suggestion(component, names), listed(names)));
      return;
    }
    if (std::count(line.names.begin(), line.names.end(), component))
      refuse(line.at, fmt::format("component \"{}\" branches from itself", component));
    if (!placed.count(component)) return;  // said elsewhere
    const std::string port = line.from.size() > component.size() ? line.from.substr(component.size() + 1) : "";
    const bool two = section->kind->placement == Placement::inline_two;
    if (two && port != "in" && port != "out")
      refuse(line.at, fmt::format("\"{}\": {} \"{}\" has two shafts; say \"{}.in\" or \"{}.out\"", line.from, section->kind->name, component, component, component));
    if (!two && !port.empty())
      refuse(line.at, fmt::format("\"{}\": {} \"{}\" has one shaft; say \"{}\"", line.from, section->kind->name, component, component));
  }
  // Branches that hang on each other in a ring, without the main line.
  void check_reachable() {
    if (!messages_.empty()) return;
    std::set<std::string> reached(scene_.lines.front().names.begin(), scene_.lines.front().names.end());
    for (bool grown = true; grown;) {
      grown = false;
      for (const Line& line : scene_.lines)
        if (!line.from.empty() && reached.count(component_of(line.from)) && !reached.count(line.names.front())) {
          reached.insert(line.names.begin(), line.names.end());
          grown = true;
        }
    }
    for (const Line& line : scene_.lines)
      if (!line.from.empty() && !reached.count(line.names.front()))
        refuse(line.at, fmt::format("branch from \"{}\" never reaches the main line", line.from));
  }

  // The order of tables in the file must not change a single bit of a result: components are sorted along the main
  // line, then along the branches by their places of departure and names.
  void put_in_canonical_order() {
    if (scene_.lines.empty()) return;
    std::sort(scene_.lines.begin() + 1, scene_.lines.end(), [](const Line& a, const Line& b) {
      return a.from != b.from ? a.from < b.from : a.names < b.names;
    });
    // A branch may begin at a branch: lines follow those they depart from.
    std::vector<Line> ordered = {scene_.lines.front()};
    std::vector<Line> rest(scene_.lines.begin() + 1, scene_.lines.end());
    for (bool grown = true; grown && !rest.empty();) {
      grown = false;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        const bool ready = std::any_of(ordered.begin(), ordered.end(), [&](const Line& l) {
          return std::count(l.names.begin(), l.names.end(), component_of(rest[i].from)) > 0;
        });
        if (!ready) continue;
        ordered.push_back(rest[i]);
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
        grown = true;
        break;
      }
    }
    ordered.insert(ordered.end(), rest.begin(), rest.end());
    scene_.lines = std::move(ordered);
    std::map<std::string, std::size_t> rank;
    for (const Line& line : scene_.lines)
      for (const std::string& name : line.names) rank.emplace(name, rank.size());
    std::stable_sort(scene_.components.begin(), scene_.components.end(),
                     [&](const Section& a, const Section& b) { return rank[a.name] < rank[b.name]; });
  }

  void read_effects() {
    const DocumentEntry* effects = document_.find("effects");
    if (!effects) return;
    if (effects->value.type != Type::table) return refuse(effects->at, "[effects] must be a table");
    for (const DocumentEntry& entry : effects->value.entries) {
      if (entry.key != "elasticity") {
        refuse(entry.at, fmt::format("[effects]: unknown effect \"{}\"{}; allowed: \"elasticity\"", entry.key, suggestion(entry.key, {"elasticity"})));
        continue;
      }
      if (entry.value.type == Type::flag) {
        scene_.effects.all_elastic = entry.value.flag;
      } else if (entry.value.type == Type::list) {
        for (const DocumentValue& item : entry.value.items) add_elastic(item);
      } else {
        refuse(entry.value.at, fmt::format("elasticity = {}; must be true, false or a list of components", entry.value.describe()));
      }
    }
  }
  void add_elastic(const DocumentValue& item) {
    std::vector<std::string> allowed;
    for (const Section& section : scene_.components)
      if (section.kind->elastic) allowed.push_back(section.name);
    if (std::count(allowed.begin(), allowed.end(), item.text)) {
      scene_.effects.elastic.push_back(item.text);
      return;
    }
    if (unreadable_.count(item.text)) return;
    refuse(item.at, fmt::format("elasticity: {} is no elastic component{}; allowed: {}", item.describe(), suggestion(item.text, allowed),
                                allowed.empty() ? "none in this scene" : listed(allowed)));
  }

  void read_run() {
    static const Kind run_kind{.name = "run", .keys = run_keys()};
    DocumentValue empty{.at = {1, 1}};
    const DocumentEntry* run = document_.find("run");
    if (run && run->value.type != Type::table) return refuse(run->at, "[run] must be a table");
    DocumentValue table = run ? run->value : empty;
    if (run) table.at = run->at;
    const Section section = read_section(table, run_kind, "run", "[run]", messages_, {"start", "output"});
    if (!section.sound) return;
    scene_.run.until = section.number("until");
    scene_.run.accuracy = section.number("accuracy");
    scene_.run.method = section.text("method");
    scene_.run.model = section.text("model");
    scene_.run.samples = static_cast<int>(section.number("samples"));
    scene_.run.budget = section.number("budget");
    if (const DocumentEntry* start = table.find("start")) read_start(start->value);
    if (const DocumentEntry* output = table.find("output")) read_output(output->value);
  }
  void read_output(const DocumentValue& value) {
    if (value.type != Type::list) return refuse(value.at, "output must be a list of component names");
    for (const DocumentValue& item : value.items) {
      if (!find(item.text)) {
        refuse(item.at, fmt::format("output: {} is no component{}; allowed: {}", item.describe(), suggestion(item.text, component_names()), listed(component_names())));
        continue;
      }
      scene_.run.output.push_back(item.text);
    }
  }

  void read_start(const DocumentValue& value) {
    StartSettings& start = scene_.run.start;
    start.at = value.at;
    if (value.type == Type::text) {
      start.equilibrium = value.text == "equilibrium";
      if (!start.equilibrium && value.text != "rest")
        refuse(value.at, fmt::format("start = {}; must be \"rest\", \"equilibrium\" or a table such as {{ speed = \"300 rpm\" }}", value.describe()));
      return;
    }
    if (value.type != Type::table) return refuse(value.at, "start must be \"rest\", \"equilibrium\" or a table such as { speed = \"300 rpm\" }");
    for (const DocumentEntry& entry : value.entries) {
      if (entry.key == "speed") {
        read_quantity(entry.value, "rad/s", any_number, "start: speed", messages_, start.speed);
      } else if (entry.key == "angle") {
        read_quantity(entry.value, "rad", any_number, "start: angle", messages_, start.angle);
      } else if (entry.key == "equilibrium") {
        if (entry.value.type != Type::flag) refuse(entry.value.at, "start: equilibrium must be true or false");
        start.equilibrium = entry.value.flag;
      } else if (entry.key == "on") {
        start.on = entry.value.text;
        if (!find(start.on)) refuse(entry.value.at, fmt::format("start: on = {} is no component{}; allowed: {}", entry.value.describe(), suggestion(start.on, component_names()), listed(component_names())));
      } else if (find(entry.key) && entry.value.type == Type::table) {
        read_component_start(entry);
      } else {
        std::vector<std::string> allowed = {"speed", "angle", "equilibrium", "on"};
        for (const std::string& name : component_names()) allowed.push_back(name);
        refuse(entry.at, fmt::format("start: unknown key \"{}\"{}; allowed: {}", entry.key, suggestion(entry.key, allowed), listed(allowed, "and")));
      }
    }
  }
  void read_component_start(const DocumentEntry& entry) {
    ComponentStart start{.at = entry.at};
    const bool elastic = find(entry.key)->kind->elastic;
    for (const DocumentEntry& e : entry.value.entries) {
      double number = 0;
      const std::string what = fmt::format("start: {}.{}", entry.key, e.key);
      if (e.key == "angle" && !elastic) {
        if (read_quantity(e.value, "rad", any_number, what, messages_, number)) start.angle = number;
      } else if (e.key == "speed" && !elastic) {
        if (read_quantity(e.value, "rad/s", any_number, what, messages_, number)) start.speed = number;
      } else if (e.key == "twist" && elastic) {
        if (read_quantity(e.value, "rad", any_number, what, messages_, number)) start.twist = number;
      } else {
        refuse(e.at, fmt::format("{}: allowed here: {}", what, elastic ? "\"twist\"" : "\"angle\" and \"speed\""));
      }
    }
    scene_.run.start.components[entry.key] = start;
  }

  const std::vector<Kind>& kinds_;
  Messages messages_;
  DocumentValue document_;
  Scene scene_;
  std::set<std::string> unreadable_;  // components whose table was refused as a whole
};

}  // namespace

bool Effects::is_elastic(const std::string& component) const {
  return all_elastic || std::count(elastic.begin(), elastic.end(), component) > 0;
}

std::string Effects::describe() const {
  if (all_elastic) return "elasticity";
  if (elastic.empty()) return "none";
  std::string text = "elasticity of ";
  for (std::size_t i = 0; i < elastic.size(); ++i) text += (i ? ", " : "") + elastic[i];
  return text;
}

const Section* Scene::find(const std::string& name) const {
  const auto found = std::find_if(components.begin(), components.end(), [&](const Section& s) { return s.name == name; });
  return found == components.end() ? nullptr : &*found;
}

const std::vector<Key>& run_keys() {
  static const std::vector<Key> keys = {
      {.name = "until", .unit = "s", .fallback = "\"1 s\"", .domain = positive, .doc = "end of the simulated time"},
      {.name = "accuracy", .fallback = "1e-6", .domain = {.low = 1e-12, .high = 0.1},
       .doc = "measured error of every figure over its scale (rated speed, rated torque, 1 rad)"},
      {.name = "method", .type = KeyType::text, .fallback = "\"auto\"", .doc = "integrator",
       .choices = {"auto", "dopri5", "dop853", "esdirk", "bdf", "adams", "RungeKuttaMerson", "RungeKuttaFeldberg", "Verlet", "CPodes"}},
      {.name = "model", .type = KeyType::text, .fallback = "\"reduced\"",
       .doc = "reduced: tables extracted from Simbody; multibody: Simbody's closed loop at every step (rigid, one mechanism)",
       .choices = {"reduced", "multibody"}},
      {.name = "samples", .type = KeyType::integer, .fallback = "1000", .domain = {.low = 2, .high = 1e6}, .doc = "rows of trajectory.csv"},
      {.name = "budget", .unit = "s", .fallback = "\"300 s\"", .domain = positive, .doc = "processor time after which an integration is stopped with a diagnosis"},
  };
  return keys;
}

Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds) {
  return SceneReader(text, file, kinds).read();
}

Scene read_scene(const std::string& path, const std::vector<Kind>& kinds) {
  return parse_scene(read_text_file(path, max_scene_bytes), path, kinds);
}

Effects parse_effects(const std::string& text, const Scene& scene) {
  Effects effects;
  if (text == "none") return effects;
  if (text == "elasticity") {
    effects.all_elastic = true;
    return effects;
  }
  const std::string prefix = "elasticity:";
  if (!text.starts_with(prefix))
    throw std::invalid_argument(fmt::format("--effects {}: allowed: none, elasticity, elasticity:COUPLING,COUPLING", text));
  for (std::size_t begin = prefix.size(); begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    const Section* section = scene.find(name);
    if (!section || !section->kind->elastic) {
      std::vector<std::string> allowed;
      for (const Section& s : scene.components)
        if (s.kind->elastic) allowed.push_back(s.name);
      throw std::invalid_argument(fmt::format("--effects: \"{}\" is no elastic component{}; allowed: {}", name,
                                              suggestion(name, allowed), allowed.empty() ? "none in this scene" : listed(allowed)));
    }
    effects.elastic.push_back(name);
    begin = end + 1;
  }
  return effects;
}

}  // namespace kurbel
