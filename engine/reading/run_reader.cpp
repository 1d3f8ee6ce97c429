// run_reader.cpp — [run], with its start and its output, [operation], and [[figure]].
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/reading/scene_reading.h"
#include "engine/reading/section_reader.h"
#include "engine/values/quantity_reader.h"

namespace kurbel {
namespace {

using Type = DocumentValue::Type;

void read_output(SceneReading& r, const DocumentValue& value) {
  if (value.type != Type::list)
    return r.refuse(value.at, fmt::format("[run]: output = {}; must be a list of component names, e.g. [\"motor\"]",
                                          value.describe()));
  for (const DocumentValue& item : value.items) {
    if (r.unreadable.count(item.text)) continue;
    if (!r.find(item.text)) {
      r.refuse(item.at, r.explains() ? fmt::format("[run]: output: {} is no component{}; allowed: {}", item.describe(),
                                                   suggestion(item.text, r.component_names()),
                                                   shortened_list(r.component_names()))
                                     : fmt::format("[run]: output: {} is no component", item.describe()));
      continue;
    }
    r.scene.run.output.push_back(item.text);
  }
}

void read_component_start(SceneReading& r, const DocumentEntry& entry) {
  ComponentStart start{.at = entry.at};
  const Kind& kind = *r.find(entry.key)->kind;
  const bool elastic = kind.elastic;
  for (const DocumentEntry& e : entry.value.entries) {
    double number = 0;
    const std::string what = fmt::format("start: {}.{}", entry.key, e.key);
    if (e.key == "angle" && !elastic) {
      if (read_quantity(e.value, "rad", any_number, what, r.messages, number)) start.angle = number;
    } else if (e.key == "speed" && !elastic) {
      if (read_quantity(e.value, "rad/s", any_number, what, r.messages, number)) start.speed = number;
    } else if (e.key == "twist" && elastic) {
      if (read_quantity(e.value, "rad", any_number, what, r.messages, number)) start.twist = number;
    } else {
      r.refuse(e.at, fmt::format("start: {}: unknown key {}; a {} has {}", entry.key, in_quotes(e.key), kind.name,
                                 elastic ? "a \"twist\" alone" : "\"angle\" and \"speed\""));
    }
  }
  r.scene.run.start.components[entry.key] = start;
}

// A mechanism whose slider or rocker is named like a shaft; null if this was not meant.
const char* output_named(SceneReading& r, const std::string& name) {
  for (const char* output : {".slider", ".rocker"})
    if (name.ends_with(output) && r.find(name.substr(0, name.size() - 7))) return output + 1;
  return nullptr;
}

// For a reciprocating output the start has a position, a velocity and a stroke; for the crank an angle and a speed.
void check_start_on_output(SceneReading& r, const DocumentValue& start, const char* output) {
  const OutputStart& given = r.output_start;
  if (!output) {
    for (const DocumentEntry* entry : {given.position, given.velocity, given.towards})
      if (entry)
        r.refuse(entry->at, fmt::format("start: \"{}\" belongs to the output of a mechanism: on = \"NAME.slider\" or "
                                        "\"NAME.rocker\"; of a shaft give angle and speed",
                                        entry->key));
    return;
  }
  for (const char* key : {"angle", "speed"})
    if (const DocumentEntry* entry = start.find(key))
      r.refuse(entry->at, fmt::format("start: \"{}\" belongs to a shaft: a {} goes to and fro; give its position, and "
                                      "velocity and towards where they count, or name the crank: on = {}",
                                      key, output, in_quotes(r.scene.run.start.on)));
  if (!given.position)
    r.refuse(given.on->value.at,
             fmt::format("start: on = {}: \"position\" is missing; give e.g. position = {}", given.on->value.describe(),
                         std::string_view(output) == "rocker" ? "\"30 deg\"" : "\"430 mm\", from the crank's axis"));
}

// "position", "velocity" and "towards", unless a component has this name: stored until its mechanism is known.
bool is_of_output(SceneReading& r, const DocumentEntry& entry) {
  const std::pair<const char*, const DocumentEntry * OutputStart::*> keys[] = {
      {"position", &OutputStart::position}, {"velocity", &OutputStart::velocity}, {"towards", &OutputStart::towards}};
  for (const auto& [key, member] : keys)
    if (entry.key == key && !r.find(entry.key)) {
      r.output_start.*member = &entry;
      return true;
    }
  return false;
}

// Whether it names a shaft, or the output of a mechanism, which is stored.
const char* read_start_on(SceneReading& r, const DocumentEntry& entry) {
  std::string& on = r.scene.run.start.on;
  on = entry.value.text;
  if (const char* output = output_named(r, on)) {
    r.output_start.on = &entry;
    on = on.substr(0, on.rfind('.'));
    return output;
  }
  if (!r.find(on) && !r.unreadable.count(on))
    r.refuse(entry.value.at, fmt::format("start: on = {} is no component{}; allowed: {}", entry.value.describe(),
                                         suggestion(on, r.component_names()), shortened_list(r.component_names())));
  return nullptr;
}

void read_start(SceneReading& r, const DocumentValue& value) {
  StartSettings& start = r.scene.run.start;
  start.at = value.at;
  if (value.type == Type::text) {
    start.equilibrium = value.text == "equilibrium";
    if (!start.equilibrium && value.text != "rest")
      r.refuse(value.at,
               fmt::format(
                   "[run]: start = {}; must be \"rest\", \"equilibrium\" or a table such as {{ speed = \"300 rpm\" }}",
                   value.describe()));
    return;
  }
  if (value.type != Type::table)
    return r.refuse(
        value.at,
        fmt::format("[run]: start = {}; must be \"rest\", \"equilibrium\" or a table such as {{ speed = \"300 rpm\" }}",
                    value.describe()));
  const char* output = nullptr;
  for (const DocumentEntry& entry : value.entries) {
    if (is_of_output(r, entry)) continue;
    if (entry.key == "speed") {
      read_quantity(entry.value, "rad/s", any_number, "start: speed", r.messages, start.speed);
    } else if (entry.key == "angle") {
      read_quantity(entry.value, "rad", any_number, "start: angle", r.messages, start.angle);
    } else if (entry.key == "equilibrium") {
      if (entry.value.type != Type::flag)
        r.refuse(entry.value.at, fmt::format("start: equilibrium = {}; must be true or false", entry.value.describe()));
      start.equilibrium = entry.value.flag;
    } else if (entry.key == "on") {
      output = read_start_on(r, entry);
    } else if (r.find(entry.key) && entry.value.type == Type::table) {
      read_component_start(r, entry);
    } else if (r.find(entry.key)) {
      r.refuse(entry.value.at,
               fmt::format("start: {} = {}; must be a table such as {}", entry.key, entry.value.describe(),
                           r.find(entry.key)->kind->elastic ? "{ twist = \"0.5 deg\" }" : "{ speed = \"300 rpm\" }"));
    } else if (!r.unreadable.count(entry.key) && !r.explains()) {
      r.refuse(entry.at, fmt::format("start: unknown key {}", in_quotes(entry.key)));
    } else if (!r.unreadable.count(entry.key)) {
      std::vector<std::string> allowed = {"speed", "angle", "equilibrium", "on", "position", "velocity", "towards"};
      for (const std::string& name : r.component_names()) allowed.push_back(name);
      r.refuse(entry.at, fmt::format("start: unknown key {}{}; allowed: {}", in_quotes(entry.key),
                                     suggestion(entry.key, allowed), shortened_list(allowed, "and")));
    }
  }
  check_start_on_output(r, value, output);
}

}  // namespace

void read_run(SceneReading& r) {
  static const Kind run_kind{.name = "run", .keys = run_keys()};
  DocumentValue empty;
  empty.at = {1, 1};
  const DocumentEntry* run = r.document.find("run");
  if (run && run->value.type != Type::table)
    return r.refuse(run->at,
                    fmt::format("run = {}; must be a table, e.g. run = {{ until = \"3 s\" }}", run->value.describe()));
  DocumentValue table = run ? run->value : empty;
  if (run) table.at = run->at;
  const Section section = read_section(table, run_kind, "run", "[run]", r.messages, {"start", "output"});
  r.scene.run.until = section.number("until");
  r.scene.run.accuracy = section.number("accuracy");
  r.scene.run.method = section.text("method");
  r.scene.run.model = section.text("model");
  r.scene.run.method_at = section.where("method");
  r.scene.run.model_at = section.where("model");
  r.scene.run.samples = static_cast<int>(section.number("samples"));
  r.scene.run.budget = section.number("budget");
  if (section.valid) try {
      check_method(r.scene.run.method, r.scene.run.model);
    } catch (const std::invalid_argument& does_not_fit) {
      r.refuse(section.where("method"), fmt::format("[run]: {}", does_not_fit.what()));
    }
  // Points into the document, which lives as long as the reading: the start of an output is evaluated later.
  if (const DocumentEntry* start = run ? run->value.find("start") : nullptr) read_start(r, start->value);
  if (const DocumentEntry* output = table.find("output")) read_output(r, output->value);
}

namespace {

// "6", "2 mains", "6 output - 6 mains": terms of a number, 1 unless given, and what it multiplies, the output unless named.
bool parse_harmonic(std::string_view text, Operation::Harmonic& harmonic) {
  std::size_t i = 0;
  const auto skip = [&] { i = std::min(text.find_first_not_of(' ', i), text.size()); };
  for (bool first = true; skip(), i < text.size(); first = false) {
    double sign = 1, number = 1;
    if (text[i] == '+' || text[i] == '-')
      sign = text[i++] == '-' ? -1 : 1, skip();
    else if (!first)
      return false;
    const auto [end, fault] = std::from_chars(text.data() + i, text.data() + text.size(), number);
    const bool given = fault == std::errc{};
    if (given) i = static_cast<std::size_t>(end - text.data()), skip();
    const std::size_t begin = i;
    while (i < text.size() && text[i] >= 'a' && text[i] <= 'z') ++i;
    const std::string_view name = text.substr(begin, i - begin);
    if ((name.empty() && !given) || !(number > 0 && number <= 1e4)) return false;
    if (!name.empty() && name != "output" && name != "mains") return false;
    (name == "mains" ? harmonic.mains : harmonic.output) += sign * number;
  }
  return harmonic.output != 0 || harmonic.mains != 0;
}

void read_converter(SceneReading& r, const DocumentValue& value) {
  if (value.type != Type::list)
    return r.refuse(value.at, fmt::format("[operation]: converter = {}; must be a list of harmonics, e.g. [\"6\", "
                                          "\"6 output - 6 mains\"]",
                                          value.describe()));
  for (const DocumentValue& item : value.items) {
    Operation::Harmonic harmonic{.text = item.text};
    if (item.type == Type::integer || item.type == Type::number)
      harmonic = {fmt::format("{:g}", item.number), item.number, 0};
    else if (item.type != Type::text || !parse_harmonic(item.text, harmonic))
      harmonic.output = harmonic.mains = 0;
    if (!(harmonic.output != 0 || harmonic.mains != 0) || !std::isfinite(harmonic.output))
      r.refuse(item.at,
               fmt::format("[operation]: converter: {} is no harmonic; write multiples of its output and of the "
                           "mains, e.g. \"6\", \"2 mains\", \"6 output - 6 mains\"",
                           item.describe()));
    r.scene.operation.converter.push_back(std::move(harmonic));
  }
}

void check_component(SceneReading& r, const Section& section, const char* key, std::string& name) {
  if (!section.given(key)) return;
  name = section.text(key);
  if (!r.find(name) && !r.unreadable.count(name))
    r.refuse(section.where(key),
             fmt::format("[operation]: {} = \"{}\" is no component{}; allowed: {}", key, name,
                         suggestion(name, r.component_names()), shortened_list(r.component_names())));
}

// The frequencies needed for the harmonics of a converter must be known.
void check_converter(SceneReading& r, Location at) {
  const Operation& o = r.scene.operation;
  const Section* motor = o.motor.empty() ? nullptr : r.find(o.motor);
  const bool known = motor && motor->kind->name == "induction motor";
  if (o.converter.empty()) {
    if (!o.motor.empty() || o.pole_pairs)
      r.refuse(at, "[operation]: \"motor\" and \"pole_pairs\" belong to \"converter\", the list of its harmonics");
    return;
  }
  if (o.motor.empty()) return r.refuse(at, "[operation]: \"motor\" is missing: which one does the converter feed?");
  if (!motor) return;
  if (!o.pole_pairs && !known)
    r.refuse(at, fmt::format("[operation]: \"pole_pairs\" is missing: those of \"{}\"", o.motor));
  for (const Operation::Harmonic& harmonic : o.converter)
    if (harmonic.mains != 0 && !o.mains)
      return r.refuse(at,
                      fmt::format("[operation]: \"mains\" is missing, of which converter: \"{}\" speaks; write e.g. "
                                  "mains = \"50 Hz\"",
                                  harmonic.text));
}

}  // namespace

void read_operation(SceneReading& r) {
  static const Kind kind{.name = "operation", .keys = operation_keys()};
  const DocumentEntry* entry = r.document.find("operation");
  if (!entry) return;
  if (entry->value.type != Type::table)
    return r.refuse(entry->at,
                    fmt::format("operation = {}; must be a table, e.g. operation = {{ speeds = [\"1340 rpm\", "
                                "\"1640 rpm\"] }}",
                                entry->value.describe()));
  DocumentValue table = entry->value;
  table.at = entry->at;
  const Section section = read_section(table, kind, "operation", "[operation]", r.messages, {"converter"});
  Operation& o = r.scene.operation;
  o.margin = section.number("margin");
  if (section.has("speeds")) o.speeds = section["speeds"].numbers;
  if (section.has("mains")) o.mains = section.number("mains");
  if (section.has("pole_pairs")) o.pole_pairs = static_cast<int>(section.number("pole_pairs"));
  check_component(r, section, "on", o.on);
  check_component(r, section, "motor", o.motor);
  if (const DocumentEntry* converter = table.find("converter")) read_converter(r, converter->value);
  if (!section.valid) return;
  if (o.speeds.size() > 2 || (o.speeds.size() == 2 && !(o.speeds[0] < o.speeds[1])))
    r.refuse(section.where("speeds"), "[operation]: speeds: give one speed, or the slowest and the fastest");
  check_converter(r, section.at);
}

#ifndef KURBEL_FMI_RUNTIME  // an exported component gives its outputs alone
void read_figures(SceneReading& r) {
  static const Kind kind{.name = "figure", .keys = figure_keys()};
  const DocumentEntry* entry = r.document.find("figure");
  if (!entry) return;
  if (entry->value.type != Type::list)
    return r.refuse(entry->at, "a figure is written [[figure]], with channel = \"torque.main_coupling\"");
  for (const DocumentValue& table : entry->value.items) {
    if (table.type != Type::table) {
      r.refuse(table.at, fmt::format("figure: {}; must be a table", table.describe()));
      continue;
    }
    const Section section = read_section(table, kind, "", "[[figure]]", r.messages);
    if (!section.valid) continue;
    const bool level = section.given("level"), step = section.given("step");
    FigureRequest asked{section.text("functional"),
                        section.text("channel"),
                        level ? section.text("level") : "",
                        section.text("window"),
                        step ? static_cast<int>(section.number("step")) : 0,
                        table.at};
    if (level != (asked.functional == "time above"))
      r.refuse(table.at, level ? "[[figure]]: \"level\" belongs to functional = \"time above\""
                               : "[[figure]]: \"level\" is missing: above what? e.g. level = \"40 kN*m\"");
    if (step && section.given("window")) r.refuse(table.at, "[[figure]]: \"window\" and \"step\" both given; keep one");
    if (step && static_cast<std::size_t>(asked.step) > r.scene.sequence.steps.size())
      r.refuse(section.where("step"), fmt::format("[[figure]]: step = {}; the [sequence] has {} steps", asked.step,
                                                  r.scene.sequence.steps.size()));
    r.scene.figures.push_back(std::move(asked));
  }
}
#endif

}  // namespace kurbel
