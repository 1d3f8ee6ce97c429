// schema.cpp — from kinds and keys to JSON Schema.
#include "studies/scenes/schema.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/reading/sequence_reader.h"
#include "engine/scene/scene.h"
#include "engine/scene/units.h"
#include "studies/scenes/kinds.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

const char* const number_with_unit = R"(^\s*[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?\s*\S.*$)";
const char* const number_or_percent =
    R"(^\s*[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?(/[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]+)?)?\s*%?\s*$)";

Json reference(const std::string& definition) { return {{"$ref", "#/$defs/" + definition}}; }
Json text() { return {{"type", "string"}}; }
Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

Json table_of(Json properties, const std::vector<std::string>& required = {}) {
  Json table = {{"type", "object"}, {"properties", std::move(properties)}};
  if (!required.empty()) table["required"] = required;
  table["additionalProperties"] = false;
  return table;
}

// A plain number within its domain; limits of texts with a unit are checked by the reader.
void bound(Json& number, const Domain& domain) {
  if (std::isfinite(domain.low)) number[domain.low_open ? "exclusiveMinimum" : "minimum"] = domain.low;
  if (std::isfinite(domain.high)) number[domain.high_open ? "exclusiveMaximum" : "maximum"] = domain.high;
}

// "4 kN*m", or "= 2*M0" of the [constants].
Json given_quantity() {
  return {{"anyOf", {{{"type", "string"}, {"pattern", number_with_unit}}, {{"type", "string"}, {"pattern", "^="}}}}};
}

// { value = "900 kN*m/rad", tolerance = "10 %", distribution = "normal", k = 2 }
Json with_tolerance() {
  const Json given = {{"type", {"string", "number"}}};
  return table_of({{"value", given},
                   {"tolerance", given},
                   {"from", given},
                   {"to", given},
                   {"distribution", {{"enum", {"normal", "uniform", "triangular"}}}},
                   {"k", {{"type", "number"}, {"exclusiveMinimum", 0}}}},
                  {"value"});
}

Json quantity(const std::string& unit, const Domain& domain) {
  if (!unit.empty()) {
    Json given = given_quantity();
    given["anyOf"].push_back(reference("with_tolerance"));
    return given;
  }
  Json number = {{"type", "number"}};
  bound(number, domain);
  return {{"anyOf",
           {number,
            {{"type", "string"}, {"pattern", number_or_percent}},
            {{"type", "string"}, {"pattern", "^="}},
            reference("with_tolerance")}}};
}

// use = "table.gas"
Json used_table() {
  return {{"type", "string"}, {"pattern", "^table\\."}, {"description", "takes its keys from [table.NAME]"}};
}

// { over = "angle", unit = ["deg", "N*m"], points = [[0, 0], [90, 12]] }
Json curve(const Key& key) {
  const Json pair = {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
  const Json points = {{"type", "array"}, {"items", pair}, {"minItems", 2}};
  const Json properties = {
      {"over", {{"enum", key.choices}, {"description", "what the first column is"}}},
      {"unit",
       {{"type", "array"},
        {"items", text()},
        {"minItems", 2},
        {"maxItems", 2},
        {"description",
         fmt::format(
             "units of both columns; the second in the dimension of {}; a file's heading may say them in its place",
             pretty_unit(key.unit))}}},
      {"points", points},
      {"file", {{"type", "string"}, {"description", ".csv or .xlsx file beside the scene, in place of the points"}}},
      {"return_points", points},
      {"return_file", text()},
      {"columns",
       {{"type", "array"},
        {"items", {{"anyOf", {{{"type", "integer"}, {"minimum", 1}}, text()}}}},
        {"minItems", 2},
        {"maxItems", 2},
        {"description", "of the file: by numbers from 1, or by the names of its heading"}}},
      {"sheet", {{"type", "string"}, {"description", "of an .xlsx file; default: the first"}}},
      {"decimal", {{"enum", {",", "."}}, {"description", "of the file's numbers; default: as they show it"}}},
      {"gain", reference("gain")},
      {"offset", reference("correction")},
      {"shift", reference("correction")},
      {"beyond", {{"enum", {"hold", "line", "refuse"}}, {"description", "how it goes on beyond its ends"}}},
      {"interpolation", {{"enum", {"linear", "smooth"}}, {"default", "linear"}}},
      {"period", given_quantity()},
      {"formula", {{"type", "string"}, {"description", "in place of the points; its variable is what it is over"}}},
      {"return_formula", text()},
      {"range", {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"description", "where the formula holds"}}},
      {"with", {{"type", "object"}, {"description", "constants of the formula: p0 = \"1 bar\""}}},
      {"use", used_table()},
  };
  return table_of(properties);
}

Json kind_schema(const Kind& kind, bool kind_required);

Json nested(const Key& key) {
  Json one = Json::array();
  for (const Kind& kind : *key.nested) one.push_back(kind_schema(kind, key.nested->size() > 1));
  const Json table = one.size() == 1 ? one.front() : Json{{"oneOf", one}};
  return {{"anyOf", {table, list_of(table)}}};
}

Json value_schema(const Key& key);

// Its table, or the value of its first key.
Json named(const Kind& kind) { return {{"anyOf", {value_schema(kind.keys.front()), kind_schema(kind, false)}}}; }

std::string description(const Key& key) {
  std::string doc = key.doc;
  if (key.type == KeyType::quantity || key.type == KeyType::quantities) {
    if (!key.unit.empty()) doc += fmt::format(" [{}]", pretty_unit(key.unit));
    if (const std::string domain = key.domain.describe(key.unit == "rad" ? key.unit : ""); domain != "finite")
      doc += ", " + domain;
    if (!key.unit.empty()) doc += fmt::format("; e.g. {}", examples_of(key.unit));
  }
  return doc;
}

Json value_schema(const Key& key) {
  Json schema;
  switch (key.type) {
    case KeyType::quantity:
      schema = quantity(key.unit, key.domain);
      break;
    case KeyType::quantities:
      schema = list_of(quantity(key.unit, key.domain));
      break;
    case KeyType::integer:
    case KeyType::integers:
      schema = {{"type", "integer"}};
      if (std::isfinite(key.domain.low)) schema["minimum"] = std::llround(key.domain.low);
      if (std::isfinite(key.domain.high)) schema["maximum"] = std::llround(key.domain.high);
      if (key.type == KeyType::integers) schema = list_of(schema);
      break;
    case KeyType::flag:
      schema = {{"type", "boolean"}};
      break;
    case KeyType::text:
      schema = key.choices.empty() ? text() : Json{{"enum", key.choices}};
      break;
    case KeyType::curve:
      schema = curve(key);
      break;
    case KeyType::sections:
      schema = nested(key);
      break;
    case KeyType::named:
      schema = {{"type", "object"}, {"additionalProperties", named(key.nested->front())}, {"minProperties", 1}};
      break;
  }
  if ((key.type == KeyType::quantities || key.type == KeyType::integers) && key.fallback != "[]")
    schema["minItems"] = 1;
  schema["description"] = description(key);
  if (!key.fallback.empty()) schema["default"] = Json::parse(key.fallback);
  return schema;
}

Json properties_of(const std::vector<Key>& keys) {
  Json properties = Json::object();
  for (const Key& key : keys) properties[key.name] = value_schema(key);
  return properties;
}

Json kind_schema(const Kind& kind, bool kind_required) {
  Json properties = {{"kind", {{"const", kind.name}, {"description", kind.doc}}}};
  if (kind.placement == Placement::inline_one)
    properties["on"] = {{"type", "string"},
                        {"description", "component on whose shaft this one sits, in place of a position in a line"}};
  properties["use"] = used_table();
  if (kind.placement != Placement::nested) {
    properties["orders"] = list_of({{"type", "number"}, {"exclusiveMinimum", 0}});
    properties["orders"]["description"] = "blades, teeth: orders of its shaft's turn that excite besides";
  }
  properties.update(properties_of(kind.keys));
  std::vector<std::string> required;
  for (const Key& key : kind.keys)
    if (key.required) required.push_back(key.name);
  Json schema = {{"title", kind.name}, {"description", kind.doc}};
  schema.update(table_of(properties, kind_required ? std::vector<std::string>{"kind"} : std::vector<std::string>{}));
  // Required keys may be in the table that is used.
  if (!required.empty()) schema["anyOf"] = {{{"required", required}}, {{"required", {"use"}}}};
  return schema;
}

Json start_schema() {
  Json angle = given_quantity(), speed = given_quantity();
  angle["description"] = "e.g. " + examples_of("rad");
  speed["description"] = "e.g. " + examples_of("rad/s");
  Json table = table_of(
      {{"speed", speed},
       {"angle", angle},
       {"on",
        {{"type", "string"}, {"description", "component that speed and angle belong to; default: the reduction link"}}},
       {"position", text()},
       {"velocity", text()},
       {"towards", {{"enum", {"extended", "folded", "greatest", "least"}}}},
       {"equilibrium",
        {{"type", "boolean"}, {"description", "twists carry the torques that the rigid machine would transmit"}}}});
  table["additionalProperties"] = table_of({{"speed", speed}, {"angle", angle}, {"twist", angle}});
  return {
      {"anyOf", {{{"enum", {"rest", "equilibrium"}}}, table}}, {"default", "rest"}, {"description", "state at time 0"}};
}

Json run_schema() {
  Json properties = properties_of(run_keys());
  properties["output"] = list_of(text());
  properties["output"]["description"] = "components in trajectory.csv; default: all";
  properties["start"] = start_schema();
  return table_of(properties);
}

Json operation_schema() {
  Json properties = properties_of(operation_keys());
  properties["converter"] = list_of({{"anyOf", {text(), {{"type", "number"}}}}});
  properties["converter"]["description"] =
      "harmonics of a frequency converter, of its output and of the mains: \"6\", \"2 mains\", \"6 output - 6 mains\"";
  return table_of(properties);
}

Json sequence_schema() {
  Json step = properties_of(sequence_step_keys());
  step["set"] = {
      {"anyOf", {text(), list_of(text())}},
      {"description", "the components that the step sets; of a mechanism one load of several: \"press.load2\""}};
  Json properties = properties_of(sequence_keys());
  properties["steps"] = list_of(table_of(step, {"set"}));
  return table_of(properties, {"steps"});
}

}  // namespace

std::string scene_schema() {
  Json names = list_of(text());
  names["minItems"] = 1;
  Json line = names;
  line["description"] = "names of the components in the order of the drive";
  Json from = text();
  from["description"] = "component that the branch begins at; of one with two shafts \"gearbox.in\" or \"gearbox.out\"";
  Json elasticity = {{"anyOf", {{{"type", "boolean"}}, list_of(text())}},
                     {"description", "true, false, or the components that are elastic"}};
  Json effects = {{"elasticity", elasticity}};
  for (const EffectFlag& effect : effect_flags())
    effects[effect.name] = {{"type", "boolean"}, {"description", effect.adds}};
  Json to = text();
  to["description"] = "component that the branch ends at, where it closes a loop of shafts";
  const Json branch = table_of({{"from", from}, {"line", names}, {"to", to}}, {"from", "line"});

  Json definitions = Json::object(), kinds = Json::array();
  definitions["with_tolerance"] = with_tolerance();
  definitions["gain"] = quantity("", any_number);
  definitions["correction"] = quantity("m", any_number);  // of a table: of whatever unit, or of none
  definitions["correction"]["anyOf"].push_back({{"type", "number"}});
  for (const Kind& kind : all_kinds()) {
    definitions[kind.name] = kind_schema(kind, true);
    kinds.push_back(reference(kind.name));
  }
  for (Json& kind : kinds) {  // a blank in a $ref is no URI
    std::string target = kind["$ref"];
    for (std::size_t at; (at = target.find(' ')) != std::string::npos;) target.replace(at, 1, "%20");
    kind["$ref"] = target;
  }
  Json settings = names;
  settings["description"] = "what differs, as --set takes it: \"damper.damping=0 N*m*s/rad\"";
  const Json named_tables = {{"type", "object"},
                             {"additionalProperties", {{"type", "object"}}},
                             {"description", "tables that components take by name: use = \"table.gas\""}};
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "kurbel scene"},
                 {"description",
                  "A machine unit for kurbel. Printed by `kurbel schema` from the table of keys that the reader uses."},
                 {"type", "object"},
                 {"properties",
                  {{"title", text()},
                   {"description", text()},
                   {"line", line},
                   {"branch", list_of(branch)},
                   {"constants",
                    {{"type", "object"},
                     {"additionalProperties", {{"anyOf", {{{"type", "number"}}, {{"type", "string"}}}}}},
                     {"description", "names that formulas may use, with their units: p0 = \"1 bar\""}}},
                   {"table", {{"anyOf", {named_tables, {{"oneOf", kinds}}}}}},  // or a component of that name
                   {"effects", table_of(effects)},
                   {"sequence", sequence_schema()},
                   {"run", run_schema()},
                   {"operation", operation_schema()},
                   {"case", list_of(table_of({{"name", text()}, {"set", settings}}, {"name", "set"}))},
                   {"figure", list_of(table_of(properties_of(figure_keys()), {"channel"}))}}},
                 {"required", {"line"}},
                 {"additionalProperties", {{"description", "a component"}, {"oneOf", kinds}}},
                 {"$defs", definitions}};
  return schema.dump(2) + "\n";
}

}  // namespace kurbel
