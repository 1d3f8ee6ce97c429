// read_scene.cpp — the parts of a scene's file in the order in which one needs the other; all errors at once.
#include "engine/reading/read_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/model/model.h"
#include "engine/reading/scene_reading.h"
#include "engine/reading/sequence_reader.h"
#include "engine/scene/units.h"
#include "engine/values/dense_tables.h"

namespace kurbel {

std::vector<std::string> SceneReading::component_names() const {
  std::vector<std::string> names;
  for (const Section& section : scene.components) names.push_back(section.name);
  return names;
}

const Section* SceneReading::find(const std::string& name) const {
  const auto found = index.find(name);
  return found == index.end() ? nullptr : &scene.components[found->second];
}

bool SceneReading::explains() const {
  constexpr std::size_t most_explained = 200;
  return messages.all().size() < most_explained;
}

std::string SceneReading::no_component(const std::string& name, const std::vector<std::string>& names) const {
  if (!explains()) return fmt::format("component {} has no table", in_quotes(name));
  const bool bare =
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
  return fmt::format("component {} has no table{}{}; tables here: {}", in_quotes(name),
                     bare && name.size() < 40 ? fmt::format(" [{}]", name) : "", suggestion(name, names),
                     names.empty() ? "none" : shortened_list(names, "and"));
}

namespace {

void read_sequence_table(SceneReading& r) {
  const DocumentEntry* sequence = r.document.find("sequence");
  if (!sequence) return;
  const auto is_component = [&](const std::string& name) { return r.find(name) != nullptr; };
  r.scene.sequence = read_sequence(sequence->value, r.component_names(), is_component, r.messages);
}

// Takes over the unit of a speed that stands before those seen so far. A frequency has the unit of one, too: by a key
// that is of a speed it is none.
void see_speed(const DocumentEntry& entry, Location& first, SpeedUnit& unit) {
  UnitError error;
  const std::string& text = entry.value.text;
  const std::optional<Quantity> given = parse_quantity(text, error);
  if (!given || (first.line > 0 && first < entry.value.at)) return;
  const Dimension speed = parse_unit("rad/s", error)->dimension;
  const bool is_one = given->dimension == speed || entry.key.find("speed") != std::string::npos;
  if (!is_one || wanted_as(*given, speed).dimension != speed) return;
  const std::size_t begin = std::min(text.find_first_not_of(' ', given->unit_at), text.size());
  const std::string name = text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
  unit = {name, wanted_as(*parse_unit(name, error), speed).factor};
  first = entry.value.at;
}

void find_speed_unit(const DocumentValue& table, Location& first, SpeedUnit& unit) {
  for (const DocumentEntry& entry : table.entries) {
    if (entry.value.type == DocumentValue::Type::text) see_speed(entry, first, unit);
    find_speed_unit(entry.value, first, unit);
    for (const DocumentValue& item : entry.value.items) find_speed_unit(item, first, unit);
  }
}

// What building finds wrong with the parameters of a component is said together with what reading found; a file
// without errors is built later, once.
void try_components(SceneReading& r) {
  for (const Section& section : r.scene.components) {
    Network scratch;
    if (section.valid) build_component(section, scratch, r.messages);
  }
}

Scene parse(DocumentValue document, const std::string& text, const std::string& file, const std::vector<Kind>& kinds,
            DataFiles allowed, bool with_cases) {
  SceneReading r{.kinds = kinds, .messages = Messages(file), .allowed = allowed, .document = std::move(document)};
  r.scene.file = file;
  r.scene.text = text;
  prepare_document(r);
  read_components(r);
  read_lines(r);
  check_connections(r);
  put_in_canonical_order(r);
  read_effects(r);
  read_sequence_table(r);
  read_run(r);
  read_operation(r);
#ifndef KURBEL_FMI_RUNTIME
  read_figures(r);
#endif
  if (!r.messages.empty()) try_components(r);
  r.messages.throw_if_any();
  place_by_output(r);
  r.messages.throw_if_any();
  if (with_cases) read_cases(r);
  r.messages.throw_if_any();
  Location first;
  find_speed_unit(r.document, first, r.scene.speed_unit);
  return with_fewer_points(std::move(r.scene));
}

}  // namespace

Scene scene_from(DocumentValue document, const std::string& text, const std::string& file,
                 const std::vector<Kind>& kinds, DataFiles allowed) {
  return parse(std::move(document), text, file, kinds, allowed, false);
}

Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Kind>& kinds, DataFiles allowed) {
  return parse(parse_toml(text, file), text, file, kinds, allowed, true);
}

Scene parse_scene(const SettledText& settled, const std::vector<Kind>& kinds, DataFiles allowed, bool with_cases) {
  try {
    Scene scene =
        parse(parse_toml(settled.text(), settled.file()), settled.text(), settled.file(), kinds, allowed, with_cases);
    scene.settings = settled.settings();
    return scene;
  } catch (const SceneError& error) {
    throw settled.placed(error);
  }
}

Scene read_scene(const std::string& path, const std::vector<Kind>& kinds, DataFiles allowed) {
  return parse_scene(read_text_file(path, max_scene_bytes), path, kinds, allowed);
}

}  // namespace kurbel
