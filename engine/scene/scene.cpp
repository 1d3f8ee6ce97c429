// scene.cpp — reads a scene file: its line and branches, its components, its effects and its run.
#include "engine/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "engine/model/build_network.h"
#include "engine/model/network.h"
#include "engine/numerics/deadline.h"
#include "engine/scene/data_files.h"
#include "engine/scene/document.h"
#include "engine/scene/section_reader.h"
#include "engine/scene/sequence_reader.h"
#include "engine/scene/units.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = {"title",   "description", "line", "branch",
                                                 "effects", "sequence",    "run"};
  return names;
}

// "gearbox.out" → "gearbox".
std::string component_of(const std::string& port) { return port.substr(0, port.find('.')); }

bool fits(const std::string& method, const std::string& model) {
  const std::vector<std::string>& methods = methods_of(model);
  return std::count(methods.begin(), methods.end(), method) > 0;
}

std::string method_does_not_fit(const std::string& method, const std::string& model) {
  for (const char* other : {"reduced", "multibody"})
    if (other != model && fits(method, other))
      return fmt::format("method \"{}\" belongs to model = \"{}\"; for model = \"{}\" allowed: {}", method, other,
                         model, listed(methods_of(model)));
  return fmt::format("method {}{}; allowed: {}", in_quotes(method), suggestion(method, methods_of(model)),
                     listed(methods_of(model)));
}

class SceneReader {
 public:
  SceneReader(const std::string& text, const std::string& file, const std::vector<Kind>& kinds, DataFiles allowed)
      : kinds_(kinds), messages_(file), data_files_(allowed), document_(parse_toml(text, file)) {
    scene_.file = file;
    scene_.text = text;
  }

  Scene read() {
    read_components();
    read_lines();
    check_connections();
    put_in_canonical_order();
    read_effects();
    complete_effects();
    read_sequence();
    read_run();
    if (!messages_.empty()) check_parameters();
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
  const Section* find(const std::string& name) const {
    const auto found = index_.find(name);
    return found == index_.end() ? nullptr : &scene_.components[found->second];
  }

  // What building finds wrong with the parameters of a component is said together with what reading found; a file
  // without errors is built later, once.
  void check_parameters() {
    for (const Section& section : scene_.components) {
      Network scratch;
      if (section.sound) build_component(section, scratch, messages_);
    }
  }

  void read_components() {
    for (const DocumentEntry& entry : document_.entries) {
      Deadline::check();
      if (entry.key == "title" || entry.key == "description") {
        if (entry.value.type != Type::text)
          refuse(entry.value.at, fmt::format("{} = {}; must be a text in quotes", entry.key, entry.value.describe()));
        if (entry.key == "title") scene_.title = entry.value.text;
        continue;
      }
      if (std::count(reserved_names().begin(), reserved_names().end(), entry.key)) continue;
      const bool good_name =
          !entry.key.empty() &&
          entry.key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
              std::string::npos;
      if (entry.value.type != Type::table) {
        refuse_top_key(entry);
      } else if (!good_name) {
        refuse(entry.at,
               fmt::format("component name {}: only letters, digits, _ and - are allowed", in_quotes(entry.key)));
      } else if (read_component(entry)) {
        continue;
      }
      unreadable_.insert(entry.key);
    }
  }
  void refuse_top_key(const DocumentEntry& entry) {
    const auto is = [&](const Key& key) { return key.name == entry.key; };
    const bool tables =
        entry.value.type == Type::list && !entry.value.items.empty() && entry.value.items.front().type == Type::table;
    if (tables) {
      refuse(entry.at,
             fmt::format("[[{0}]] is a list of tables; a component is written [{0}], a branch [[branch]]", entry.key));
    } else if (std::any_of(run_keys().begin(), run_keys().end(), is) || entry.key == "start" || entry.key == "output") {
      refuse(entry.at, fmt::format("\"{}\" belongs under [run]", entry.key));
    } else if (entry.key == "elasticity") {
      refuse(entry.at, "\"elasticity\" belongs under [effects]");
    } else {
      refuse(
          entry.at,
          fmt::format("unknown key {}{}; allowed at the top of a scene: {}, and a table for each component",
                      in_quotes(entry.key), suggestion(entry.key, reserved_names()), listed(reserved_names(), "and")));
    }
  }
  static bool is_top_key(const DocumentEntry& entry) { return entry.key == "line" || entry.key == "title"; }
  bool read_component(const DocumentEntry& entry) {
    const std::string& name = entry.key;
    // A slip of the pen in [effects] or [run], and no component at all.
    const auto table_meant =
        entry.value.find("kind") ? std::nullopt : nearest(name, {"effects", "sequence", "run", "branch"});
    if (table_meant) {
      refuse(entry.at,
             fmt::format("unknown table [{}] — did you mean [{}]? A component needs its \"kind\"", name, *table_meant));
      return false;
    }
    const Kind* kind = read_kind(entry.value, kinds_, fmt::format("component \"{}\"", name), entry.at, messages_);
    if (!kind) return false;
    DocumentValue table = entry.value;
    table.at = entry.at;
    // TOML gives every key to the table header above it: the commonest slip with `line`.
    for (const DocumentEntry& inner : entry.value.entries)
      if (is_top_key(inner)) {
        refuse(inner.at,
               fmt::format("{} \"{}\": \"{}\" stands in the table [{}]; move it above the first table of the file",
                           kind->name, name, inner.key, name));
        if (inner.key == "line") misplaced_line_ = &inner;
      }
    table.entries.erase(std::remove_if(table.entries.begin(), table.entries.end(), is_top_key), table.entries.end());
    const DocumentEntry* on = entry.value.find("on");
    std::vector<std::string> read_elsewhere = {"kind"};
    if (on || kind->placement == Placement::inline_one) read_elsewhere.push_back("on");
    Section section = read_section(table, *kind, name, fmt::format("{} \"{}\"", kind->name, name), messages_,
                                   read_elsewhere, data_files_);
    if (on) read_on(section, on->value);
    index_[name] = scene_.components.size();
    scene_.components.push_back(std::move(section));
    return true;
  }

  // `on = "flywheel"` is a branch of one component.
  void read_on(const Section& section, const DocumentValue& value) {
    if (section.kind->placement == Placement::inline_two) {
      lines_sound_ = false;
      return refuse(value.at,
                    fmt::format("{} \"{}\": on = {}; it has two shafts and stands in a `line` or a [[branch]]",
                                section.kind->name, section.name, value.describe()));
    }
    if (value.type != Type::text || value.text.empty()) {
      lines_sound_ = false;
      return refuse(value.at, fmt::format("{} \"{}\": on = {}; must be the name of a component in quotes",
                                          section.kind->name, section.name, value.describe()));
    }
    scene_.lines.push_back({value.text, {section.name}, value.at, {value.at}});
  }

  void read_lines() {
    const DocumentEntry* line = document_.find("line");
    if (!line) line = misplaced_line_;
    if (!line) {
      lines_sound_ = false;
      scene_.lines.insert(scene_.lines.begin(), Line{});
      refuse({1, 1},
             "\"line\" is missing: the components in the order of the drive, e.g. line = [\"motor\", \"coupling\", "
             "\"press\"]");
    } else {
      scene_.lines.insert(scene_.lines.begin(), read_line(line->value, "line", ""));
    }
    const DocumentEntry* branches = document_.find("branch");
    if (!branches) return;
    if (branches->value.type != Type::list) {
      lines_sound_ = false;
      return refuse(branches->at,
                    "branch is no list of tables; each branch is written as [[branch]] with `from` and `line`");
    }
    for (const DocumentValue& branch : branches->value.items) read_branch(branch);
  }
  void read_branch(const DocumentValue& branch) {
    for (const DocumentEntry& entry : branch.entries)
      if (entry.key != "from" && entry.key != "line")
        refuse(entry.at, fmt::format("branch: unknown key {}{}; allowed: \"from\" and \"line\"", in_quotes(entry.key),
                                     suggestion(entry.key, {"from", "line"})));
    const DocumentEntry* from = branch.find("from");
    const DocumentEntry* line = branch.find("line");
    const bool has_from = from && from->value.type == Type::text && !from->value.text.empty();
    const bool mistyped = std::any_of(branch.entries.begin(), branch.entries.end(), [](const DocumentEntry& e) {
      return e.key != "from" && e.key != "line" && nearest(e.key, {"from", "line"});
    });
    if (branch.type != Type::table || ((!from || !line) && !mistyped)) {
      refuse(branch.at, fmt::format("branch: {}; needs from = \"component\" and line = [\"component\", …]",
                                    branch.type != Type::table ? branch.describe() + " is no table"
                                    : !from && !line           ? "\"from\" and \"line\" are missing"
                                    : from                     ? "\"line\" is missing"
                                                               : "\"from\" is missing"));
    } else if (from && !has_from) {
      refuse(from->value.at,
             fmt::format("branch: from = {}; must be the name of a component in quotes", from->value.describe()));
    }
    if (!has_from || !line) lines_sound_ = false;
    if (!line) return;
    Line read = read_line(line->value, "branch: line", has_from ? from->value.text : "");
    if (!has_from) return;
    read.at = from->value.at;
    scene_.lines.push_back(std::move(read));
  }
  Line read_line(const DocumentValue& value, const std::string& what, const std::string& from) {
    Line line{.from = from, .at = value.at};
    if (value.type != Type::list || value.items.empty()) {
      refuse(value.at, fmt::format("{} = {}; must be a list of component names, e.g. [\"motor\", \"press\"]", what,
                                   value.type == Type::list ? "[]" : value.describe()));
      lines_sound_ = false;
      return line;
    }
    for (const DocumentValue& item : value.items) {
      if (item.type != Type::text) {
        refuse(item.at, fmt::format("{}: {} is no component name in quotes", what, item.describe()));
        lines_sound_ = false;
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
    std::set<std::string> meant;  // by a name mistyped elsewhere
    const std::vector<std::string> names = component_names();
    for (const Line& line : scene_.lines)
      for (std::size_t i = 0; i < line.names.size(); ++i) {
        const std::string& name = line.names[i];
        if (!find(name)) {
          if (unreadable_.count(name)) continue;
          refuse(line.name_at[i], no_component(name, names));
          if (explains())
            if (const auto near = nearest(name, names)) meant.insert(*near);
          continue;
        }
        if (const auto [first, fresh] = placed.emplace(name, line.name_at[i]); !fresh)
          refuse(line.name_at[i],
                 fmt::format("component \"{}\" is used twice (first at line {}); one component stands in one place",
                             name, first->second.line));
      }
    for (const Line& line : scene_.lines)
      if (!line.from.empty()) check_from(line, names, placed);
    for (const Section& section : scene_.components)
      if (lines_sound_ && !placed.count(section.name) && !meant.count(section.name))
        refuse(section.at,
               fmt::format(
                   "{} \"{}\" is not connected; put it into `line` or a [[branch]]{}", section.kind->name, section.name,
                   section.kind->placement == Placement::inline_two ? "" : ", or say on = \"component\" in its table"));
    check_rings();
  }
  // Of so many messages only the first are shown: what costs time to explain is left out of the rest.
  bool explains() const {
    constexpr std::size_t most_explained = 200;
    return messages_.all().size() < most_explained;
  }
  std::string no_component(const std::string& name, const std::vector<std::string>& names) const {
    if (!explains()) return fmt::format("component {} has no table", in_quotes(name));
    const bool bare =
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
    return fmt::format("component {} has no table{}{}; tables here: {}", in_quotes(name),
                       bare && name.size() < 40 ? fmt::format(" [{}]", name) : "", suggestion(name, names),
                       names.empty() ? "none" : shortened_list(names, "and"));
  }
  void check_from(const Line& line, const std::vector<std::string>& names,
                  const std::map<std::string, Location>& placed) {
    const std::string component = component_of(line.from);
    const Section* section = find(component);
    if (!section) {
      if (!unreadable_.count(component)) refuse(line.at, no_component(component, names));
      return;
    }
    if (std::count(line.names.begin(), line.names.end(), component)) return;  // a ring; said below
    if (!placed.count(component)) return;                                     // said elsewhere
    const std::string port = line.from.size() > component.size() ? line.from.substr(component.size() + 1) : "";
    const bool two = section->kind->placement == Placement::inline_two;
    const std::vector<std::string>& more = section->kind->further_shafts;
    if (two && port != "in" && port != "out" && !std::count(more.begin(), more.end(), port)) {
      if (more.empty()) {
        refuse(line.at, fmt::format("{}: {} \"{}\" has two shafts; say \"{}.in\" or \"{}.out\"", in_quotes(line.from),
                                    section->kind->name, component, component, component));
      } else {
        std::vector<std::string> ports = {component + ".in", component + ".out"};
        for (const std::string& other : more) ports.push_back(component + "." + other);
        refuse(line.at, fmt::format("{}: {} \"{}\" has {} shafts; say {}", in_quotes(line.from), section->kind->name,
                                    component, ports.size(), listed(ports)));
      }
    }
    if (!two && component.size() != line.from.size())
      refuse(line.at, fmt::format("{}: {} \"{}\" has one shaft; say \"{}\"", in_quotes(line.from), section->kind->name,
                                  component, component));
  }
  // Branches that hang on each other in a ring, apart from the main line: one message a ring.
  void check_rings() {
    std::map<std::string, std::size_t> line_of;
    for (std::size_t i = 0; i < scene_.lines.size(); ++i)
      for (const std::string& name : scene_.lines[i].names) line_of.emplace(name, i);
    std::vector<std::size_t> walk(scene_.lines.size(), 0);  // number of the walk that passed here
    for (std::size_t i = 0; i < scene_.lines.size(); ++i) {
      std::size_t at = i;
      while (walk[at] == 0) {
        walk[at] = i + 1;
        const auto next = line_of.find(component_of(scene_.lines[at].from));
        if (scene_.lines[at].from.empty() || next == line_of.end()) break;
        at = next->second;
        if (walk[at] == i + 1) report_ring(at, line_of);
      }
    }
  }
  void report_ring(std::size_t first, const std::map<std::string, std::size_t>& line_of) {
    std::vector<std::string> from;
    Location where = scene_.lines[first].at;
    std::size_t at = first;
    do {
      from.push_back(scene_.lines[at].from);
      where = std::min(where, scene_.lines[at].at);
      at = line_of.at(component_of(scene_.lines[at].from));
    } while (at != first);
    if (from.size() == 1)
      return refuse(where,
                    fmt::format("the branch from \"{0}\" holds \"{0}\" itself; begin it at a component of another line",
                                component_of(from.front())));
    refuse(where,
           fmt::format(
               "the branches from {} hang on each other in a ring; begin one of them at a component of the main line",
               shortened_list(from, "and")));
  }

  // The order of tables in the file must not change a single bit of a result: components are sorted along the main
  // line, then along the branches by their places of departure and names.
  void put_in_canonical_order() {
    if (scene_.lines.empty()) return;
    std::sort(scene_.lines.begin() + 1, scene_.lines.end(),
              [](const Line& a, const Line& b) { return a.from != b.from ? a.from < b.from : a.names < b.names; });
    // A branch may begin at a branch: lines follow those they depart from, otherwise in sorted order.
    std::multimap<std::string, std::size_t> waiting;
    for (std::size_t i = 1; i < scene_.lines.size(); ++i) waiting.emplace(component_of(scene_.lines[i].from), i);
    std::vector<Line> ordered;
    std::set<std::size_t> ready = {0};
    while (!ready.empty()) {
      const Line& next = scene_.lines[*ready.begin()];
      ready.erase(ready.begin());
      ordered.push_back(next);
      for (const std::string& name : next.names) {
        const auto [first, last] = waiting.equal_range(name);
        for (auto it = first; it != last; ++it) ready.insert(it->second);
        waiting.erase(first, last);
      }
    }
    scene_.lines = std::move(ordered);  // what is missing hangs in a ring or on nothing, and was refused
    std::map<std::string, std::size_t> rank;
    for (const Line& line : scene_.lines)
      for (const std::string& name : line.names) rank.emplace(name, rank.size() + 1);
    std::stable_sort(scene_.components.begin(), scene_.components.end(),
                     [&](const Section& a, const Section& b) { return rank[a.name] < rank[b.name]; });
    for (std::size_t i = 0; i < scene_.components.size(); ++i) index_[scene_.components[i].name] = i;
  }

  void read_effects() {
    const DocumentEntry* effects = document_.find("effects");
    if (!effects) return;
    if (effects->value.type != Type::table)
      return refuse(effects->at, fmt::format("effects = {}; must be a table, e.g. effects = {{ elasticity = true }}",
                                             effects->value.describe()));
    for (const DocumentEntry& entry : effects->value.entries) {
      if (entry.key == "elasticity") {
        read_elasticity(entry);
        continue;
      }
      const auto flags = effect_flags();
      const auto known =
          std::find_if(flags.begin(), flags.end(), [&](const EffectFlag& f) { return entry.key == f.name; });
      if (known == flags.end()) {
        std::vector<std::string> names = {"elasticity"};
        for (const EffectFlag& f : flags) names.emplace_back(f.name);
        refuse(entry.at, fmt::format("[effects]: unknown effect {}{}; allowed: {}", in_quotes(entry.key),
                                     suggestion(entry.key, names), listed(names, "and")));
      } else if (entry.value.type != Type::flag) {
        refuse(entry.value.at,
               fmt::format("[effects]: {} = {}; must be true or false", entry.key, entry.value.describe()));
      } else {
        scene_.effects.*(known->flag) = entry.value.flag;
        said_.insert(entry.key);
        if (entry.value.flag && known->unsaid == EffectFlag::Unsaid::where_given && !has_parameters(scene_, *known) &&
            unreadable_.empty())
          refuse(entry.at, fmt::format("[effects]: {} = true, but no component has parameters for it; give {}, or drop "
                                       "the line",
                                       entry.key, known->parameters));
      }
    }
  }
  void read_elasticity(const DocumentEntry& entry) {
    if (entry.value.type == Type::flag) {
      scene_.effects.all_elastic = entry.value.flag;
    } else if (entry.value.type == Type::list) {
      for (const DocumentValue& item : entry.value.items) add_elastic(item);
    } else {
      refuse(entry.value.at,
             fmt::format("[effects]: elasticity = {}; must be true, false or a list of components{}",
                         entry.value.describe(),
                         entry.value.type == Type::text ? fmt::format(", e.g. [{}]", entry.value.describe()) : ""));
    }
  }
  // What the file does not mention is on where there are parameters for it.
  void complete_effects() {
    for (const EffectFlag& effect : effect_flags())
      if (effect.unsaid == EffectFlag::Unsaid::where_given && !said_.count(effect.name))
        scene_.effects.*(effect.flag) = has_parameters(scene_, effect);
  }
  std::vector<std::string> elastic_names() const {
    std::vector<std::string> names;
    for (const Section& section : scene_.components)
      if (section.kind->elastic) names.push_back(section.name);
    return names;
  }
  void add_elastic(const DocumentValue& item) {
    const Section* section = item.type == Type::text ? find(item.text) : nullptr;
    if (section && section->kind->elastic) {
      scene_.effects.elastic.push_back(item.text);
      return;
    }
    if (unreadable_.count(item.text)) return;
    if (!explains()) return refuse(item.at, fmt::format("[effects]: elasticity: {}", item.describe()));
    const std::vector<std::string> allowed = elastic_names();
    const std::string why = section
                                ? fmt::format("{} is a {}, which is always rigid", item.describe(), section->kind->name)
                                : fmt::format("{} is no component{}", item.describe(), suggestion(item.text, allowed));
    refuse(item.at, fmt::format("[effects]: elasticity: {}; allowed: {}", why,
                                allowed.empty() ? "none in this scene" : shortened_list(allowed)));
  }

  void read_sequence() {
    const DocumentEntry* sequence = document_.find("sequence");
    if (!sequence) return;
    const auto is_component = [&](const std::string& name) { return find(name) != nullptr; };
    scene_.sequence = kurbel::read_sequence(sequence->value, component_names(), is_component, messages_);
  }

  void read_run() {
    static const Kind run_kind{.name = "run", .keys = run_keys()};
    DocumentValue empty;
    empty.at = {1, 1};
    const DocumentEntry* run = document_.find("run");
    if (run && run->value.type != Type::table)
      return refuse(run->at,
                    fmt::format("run = {}; must be a table, e.g. run = {{ until = \"3 s\" }}", run->value.describe()));
    DocumentValue table = run ? run->value : empty;
    if (run) table.at = run->at;
    const Section section = read_section(table, run_kind, "run", "[run]", messages_, {"start", "output"});
    scene_.run.until = section.number("until");
    scene_.run.accuracy = section.number("accuracy");
    scene_.run.method = section.text("method");
    scene_.run.model = section.text("model");
    scene_.run.method_at = section.where("method");
    scene_.run.model_at = section.where("model");
    scene_.run.samples = static_cast<int>(section.number("samples"));
    scene_.run.budget = section.number("budget");
    if (section.sound && !fits(scene_.run.method, scene_.run.model))
      refuse(section.where("method"),
             fmt::format("[run]: {}", method_does_not_fit(scene_.run.method, scene_.run.model)));
    if (const DocumentEntry* start = table.find("start")) read_start(start->value);
    if (const DocumentEntry* output = table.find("output")) read_output(output->value);
  }
  void read_output(const DocumentValue& value) {
    if (value.type != Type::list)
      return refuse(value.at, fmt::format("[run]: output = {}; must be a list of component names, e.g. [\"motor\"]",
                                          value.describe()));
    for (const DocumentValue& item : value.items) {
      if (unreadable_.count(item.text)) continue;
      if (!find(item.text)) {
        refuse(item.at, explains()
                            ? fmt::format("[run]: output: {} is no component{}; allowed: {}", item.describe(),
                                          suggestion(item.text, component_names()), shortened_list(component_names()))
                            : fmt::format("[run]: output: {} is no component", item.describe()));
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
        refuse(value.at,
               fmt::format(
                   "[run]: start = {}; must be \"rest\", \"equilibrium\" or a table such as {{ speed = \"300 rpm\" }}",
                   value.describe()));
      return;
    }
    if (value.type != Type::table)
      return refuse(
          value.at,
          fmt::format(
              "[run]: start = {}; must be \"rest\", \"equilibrium\" or a table such as {{ speed = \"300 rpm\" }}",
              value.describe()));
    for (const DocumentEntry& entry : value.entries) {
      if (entry.key == "speed") {
        read_quantity(entry.value, "rad/s", any_number, "start: speed", messages_, start.speed);
      } else if (entry.key == "angle") {
        read_quantity(entry.value, "rad", any_number, "start: angle", messages_, start.angle);
      } else if (entry.key == "equilibrium") {
        if (entry.value.type != Type::flag)
          refuse(entry.value.at, fmt::format("start: equilibrium = {}; must be true or false", entry.value.describe()));
        start.equilibrium = entry.value.flag;
      } else if (entry.key == "on") {
        start.on = entry.value.text;
        if (!find(start.on) && !unreadable_.count(start.on))
          refuse(entry.value.at,
                 fmt::format("start: on = {} is no component{}; allowed: {}", entry.value.describe(),
                             suggestion(start.on, component_names()), shortened_list(component_names())));
      } else if (find(entry.key) && entry.value.type == Type::table) {
        read_component_start(entry);
      } else if (find(entry.key)) {
        refuse(entry.value.at,
               fmt::format("start: {} = {}; must be a table such as {}", entry.key, entry.value.describe(),
                           find(entry.key)->kind->elastic ? "{ twist = \"0.5 deg\" }" : "{ speed = \"300 rpm\" }"));
      } else if (!unreadable_.count(entry.key) && !explains()) {
        refuse(entry.at, fmt::format("start: unknown key {}", in_quotes(entry.key)));
      } else if (!unreadable_.count(entry.key)) {
        std::vector<std::string> allowed = {"speed", "angle", "equilibrium", "on"};
        for (const std::string& name : component_names()) allowed.push_back(name);
        refuse(entry.at, fmt::format("start: unknown key {}{}; allowed: {}", in_quotes(entry.key),
                                     suggestion(entry.key, allowed), shortened_list(allowed, "and")));
      }
    }
  }
  void read_component_start(const DocumentEntry& entry) {
    ComponentStart start{.at = entry.at};
    const Kind& kind = *find(entry.key)->kind;
    const bool elastic = kind.elastic;
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
        refuse(e.at, fmt::format("start: {}: unknown key {}; a {} has {}", entry.key, in_quotes(e.key), kind.name,
                                 elastic ? "a \"twist\" alone" : "\"angle\" and \"speed\""));
      }
    }
    scene_.run.start.components[entry.key] = start;
  }

  const std::vector<Kind>& kinds_;
  Messages messages_;
  DataFiles data_files_;
  DocumentValue document_;
  Scene scene_;
  std::map<std::string, std::size_t> index_;  // of each component in scene_.components
  std::set<std::string> unreadable_;          // keys and tables that were refused as a whole
  std::set<std::string> said_;                // effects that the file mentions
  const DocumentEntry* misplaced_line_ = nullptr;
  bool lines_sound_ = true;  // false: what is not connected follows from an error that was named
};

}  // namespace

const Section* Scene::find(const std::string& name) const {
  const auto found =
      std::find_if(components.begin(), components.end(), [&](const Section& s) { return s.name == name; });
  return found == components.end() ? nullptr : &*found;
}

const std::vector<std::string>& methods_of(const std::string& model) {
  static const std::vector<std::string> reduced = {"auto",  "work",    "dopri5", "verner6", "dop853", "fehlberg8",
                                                   "adams", "esdirk3", "esdirk", "esdirk5", "bdf"};
  static const std::vector<std::string> multibody = {
      "auto",   "RungeKuttaMerson",   "RungeKuttaFeldberg", "RungeKutta3", "RungeKutta2",
      "Verlet", "SemiExplicitEuler2", "ExplicitEuler",      "CPodes"};
  return model == "multibody" ? multibody : reduced;
}

void check_method(const std::string& method, const std::string& model) {
  if (!fits(method, model)) throw std::invalid_argument(method_does_not_fit(method, model));
}

const std::vector<Key>& run_keys() {
  static const std::vector<Key> keys = {
      {.name = "until", .unit = "s", .fallback = "\"1 s\"", .domain = positive, .doc = "end of the simulated time"},
      {.name = "accuracy",
       .fallback = "1e-6",
       .domain = {.low = 1e-12, .high = 0.1},
       .doc = "measured error of every figure over its scale (rated speed, rated torque, 1 rad)"},
      {.name = "method",
       .type = KeyType::text,
       .fallback = "\"auto\"",
       .doc = "integrator; work: the work equation over the angle (rigid, no torque over time)",
       .choices = {"auto", "work", "dopri5", "verner6", "dop853", "fehlberg8", "adams", "esdirk3", "esdirk", "esdirk5",
                   "bdf", "RungeKuttaMerson", "RungeKuttaFeldberg", "RungeKutta3", "RungeKutta2", "Verlet",
                   "SemiExplicitEuler2", "ExplicitEuler", "CPodes"}},
      {.name = "model",
       .type = KeyType::text,
       .fallback = "\"reduced\"",
       .doc = "reduced: tables extracted from Simbody; multibody: Simbody's closed loop at every step (rigid, one "
              "mechanism)",
       .choices = {"reduced", "multibody"}},
      {.name = "samples",
       .type = KeyType::integer,
       .fallback = "1000",
       .domain = {.low = 2, .high = 1e6},
       .doc = "rows of trajectory.csv"},
      {.name = "budget",
       .unit = "s",
       .fallback = "\"300 s\"",
       .domain = positive,
       .doc = "processor time after which an integration, or a study that is not made of runs, is stopped with a "
              "diagnosis"},
  };
  return keys;
}

Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds, DataFiles allowed) {
  return SceneReader(text, file, kinds, allowed).read();
}
Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds) {
  return parse_scene(text, file, kinds, DataFiles::below_the_scene);
}

Scene read_scene(const std::string& path, const std::vector<Kind>& kinds, DataFiles allowed) {
  return parse_scene(read_text_file(path, max_scene_bytes), path, kinds, allowed);
}
Scene read_scene(const std::string& path, const std::vector<Kind>& kinds) {
  return read_scene(path, kinds, DataFiles::below_the_scene);
}

}  // namespace kurbel
