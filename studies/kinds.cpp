// kinds.cpp — gathers the kinds and prints their keys.
#include "studies/kinds.h"

#include <fmt/format.h>

#include "drivetrain/kinds.h"
#include "engine/scene.h"
#include "engine/units.h"
#include "mechanisms/kinds.h"

namespace kurbel {
namespace {

std::string type_of(const Key& key) {
  switch (key.type) {
    case KeyType::quantity: return key.unit.empty() ? "number" : pretty_unit(key.unit);
    case KeyType::quantities: return fmt::format("list of {}", pretty_unit(key.unit));
    case KeyType::integers: return "list of whole numbers";
    case KeyType::integer: return "whole number";
    case KeyType::flag: return "true or false";
    case KeyType::text: return key.choices.empty() ? "text" : listed(key.choices);
    case KeyType::curve: return fmt::format("table over {} → {}", listed(key.choices), pretty_unit(key.unit));
    case KeyType::sections: return "table(s)";
  }
  return "";
}

std::string domain_of(const Key& key) {
  const bool number = key.type == KeyType::quantity || key.type == KeyType::quantities || key.type == KeyType::integer || key.type == KeyType::integers;
  return number ? key.domain.describe("") : "";
}

std::string rows(const std::vector<Key>& keys) {
  std::string text = "| key | unit or values | default | domain | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : keys)
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, type_of(key),
                        key.required ? "**required**" : key.fallback.empty() ? "—" : fmt::format("`{}`", key.fallback), domain_of(key), key.doc);
  return text;
}

std::string chapter(const Kind& kind, const char* level) {
  std::string text = fmt::format("{} `{}`\n\n{}.", level, kind.name, kind.doc);
  if (kind.elastic) text += " Its elasticity is an effect.";
  if (kind.placement == Placement::inline_two) text += " Two shafts: `.in` and `.out`.";
  text += fmt::format("\n\n{}\n", rows(kind.keys));
  for (const Key& key : kind.keys)
    if (key.nested)
      for (const Kind& nested : *key.nested) text += chapter(nested, "####");
  return text;
}

}  // namespace

const std::vector<Kind>& all_kinds() {
  static const std::vector<Kind> kinds = [] {
    std::vector<Kind> list = drivetrain_kinds();
    for (Kind& kind : mechanism_kinds()) list.push_back(std::move(kind));
    return list;
  }();
  return kinds;
}

std::string keys_in_markdown() {
  std::string text =
      "# Keys of a scene\n\n"
      "Printed by `kurbel keys`, from the same table that the reader uses; a test holds this file against it.\n\n"
      "Quantities are texts with a unit (\"1500 rpm\", \"4 kN*m/rad\", \"12 mm\"); the angle is a dimension of its own. Plain\n"
      "numbers stand only where a value has no unit. A component's table may carry `on = \"component\"` in place of a\n"
      "position in a line. A characteristic (\"table over …\") is written\n"
      "`{ over = \"angle\", unit = [\"deg\", \"N*m\"], points = [[0, 0], [90, 12]] }` or with `file = \"data.csv\"` (two columns,\n"
      "`columns = [1, 2]`), `interpolation = \"linear\"` or `\"smooth\"`, and `period` where it repeats.\n\n"
      "## At the top\n\n"
      "| key | meaning |\n|---|---|\n"
      "| `title`, `description` | texts |\n"
      "| `line` | names of the components in the order of the drive |\n"
      "| `[[branch]]` | `from = \"component\"` (`\"gearbox.out\"`) and `line = [...]` |\n"
      "| `[effects]` | `elasticity = true`, `false` or a list of components |\n\n"
      "## `[run]`\n\n";
  text += rows(run_keys());
  text +=
      "| `output` | list of names | all | | components in trajectory.csv |\n"
      "| `start` | \"rest\", \"equilibrium\" or a table | `\"rest\"` | | see below |\n\n"
      "`start = { speed = \"300 rpm\", angle = \"0 deg\", on = \"motor\", equilibrium = true, press = { speed = \"3 rad/s\" }, "
      "main_coupling = { twist = \"0.1 deg\" } }`: `speed` and `angle` belong to the reduction link (the first mechanism's crank, "
      "else the first shaft of the line) or to the component named by `on`; the rest of the machine follows rigidly unless "
      "components say otherwise. `equilibrium` gives each elastic element the twist that carries the torque which the rigid "
      "machine would transmit there at that moment.\n\n"
      "## Components\n\n";
  for (const Kind& kind : all_kinds()) text += chapter(kind, "###");
  return text;
}

}  // namespace kurbel
