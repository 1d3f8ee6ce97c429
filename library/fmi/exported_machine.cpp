// exported_machine.cpp — an exported machine as JSON, and back.
#include "library/fmi/exported_machine.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace kurbel {

using Json = nlohmann::json;

// Limits that there are none of have no number in JSON.
static void to_json(Json& json, const ExportedInput& input) {
  json = {{"what", static_cast<int>(input.what)},
          {"of", input.of},
          {"name", input.name},
          {"start", input.start},
          {"whole", input.whole}};
  if (input.low > -std::numeric_limits<double>::infinity()) json["low"] = input.low;
  if (input.high < std::numeric_limits<double>::infinity()) json["high"] = input.high;
}
static void from_json(const Json& json, ExportedInput& input) {
  const int what = json.at("what").get<int>();
  if (what < 0 || what > static_cast<int>(ExportedInput::What::speed))
    throw std::invalid_argument("an input of no kind");
  input.what = static_cast<ExportedInput::What>(what);
  json.at("of").get_to(input.of);
  json.at("name").get_to(input.name);
  json.at("start").get_to(input.start);
  json.at("whole").get_to(input.whole);
  input.low = json.value("low", input.low);
  input.high = json.value("high", input.high);
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ExportedParameter, path, unit, doc, start, tunable)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TableBook::Page, kind, of, numbers)

namespace {

// [line, column, end's line, end's column, type, value]
Json json_of(const DocumentValue& value) {
  using Type = DocumentValue::Type;
  Json held;
  if (value.type == Type::flag) held = value.flag;
  if (value.type == Type::integer) held = value.integer;
  if (value.type == Type::number) held = value.number;
  if (value.type == Type::text) held = value.text;
  if (value.type == Type::list) {
    held = Json::array();
    for (const DocumentValue& item : value.items) held.push_back(json_of(item));
  }
  if (value.type == Type::table) {
    held = Json::array();
    for (const DocumentEntry& entry : value.entries)
      held.push_back({entry.key, entry.at.line, entry.at.column, json_of(entry.value)});
  }
  return {value.at.line, value.at.column, value.end.line, value.end.column, static_cast<int>(value.type), held};
}

DocumentValue document_of(const Json& json) {
  using Type = DocumentValue::Type;
  DocumentValue value;
  value.at = {json.at(0).get<int>(), json.at(1).get<int>()};
  value.end = {json.at(2).get<int>(), json.at(3).get<int>()};
  const int type = json.at(4).get<int>();
  if (type < 0 || type > static_cast<int>(Type::other)) throw std::invalid_argument("a value of no type");
  value.type = static_cast<Type>(type);
  const Json& held = json.at(5);
  if (value.type == Type::flag) held.get_to(value.flag);
  if (value.type == Type::integer) value.number = static_cast<double>(held.get_to(value.integer));
  if (value.type == Type::number) held.get_to(value.number);
  if (value.type == Type::text) held.get_to(value.text);
  if (value.type == Type::list)
    for (const Json& item : held) value.items.push_back(document_of(item));
  if (value.type == Type::table)
    for (const Json& entry : held)
      value.entries.push_back(
          {entry.at(0).get<std::string>(), {entry.at(1).get<int>(), entry.at(2).get<int>()}, document_of(entry.at(3))});
  return value;
}

const char* const kind = "kurbel exported machine 1";

// All but the document.
template <class Machine, class Take>
void each_member(Machine& m, const Take& take) {
  take("name", m.name), take("title", m.title), take("token", m.token), take("version", m.version);
  take("file", m.file), take("effects", m.effects);
  take("model_exchange", m.model_exchange), take("co_simulation", m.co_simulation);
  take("inputs", m.inputs), take("parameters", m.parameters), take("outputs", m.outputs), take("peaks", m.peaks);
  take("tables", m.tables.pages);
}

}  // namespace

std::string ExportedInput::target() const {
  if (what == What::command) return of;
  std::string name = (what == What::torque ? "torque on " : "speed of ") + of;
  std::replace(name.begin(), name.end(), '.', ' ');  // behind a point stands a part of a component
  return name;
}

std::string ExportedMachine::text() const {
  Json json{{"kind", kind}, {"document", json_of(document)}};
  each_member(*this, [&](const char* key, const auto& member) { json[key] = member; });
  return json.dump() + "\n";
}

ExportedMachine ExportedMachine::from_text(const std::string& text) {
  ExportedMachine m;
  try {
    const Json json = Json::parse(text);
    if (json.at("kind") != kind) throw std::invalid_argument("is no exported machine that this run-time can read");
    each_member(m, [&](const char* key, auto& member) { json.at(key).get_to(member); });
    m.document = document_of(json.at("document"));
  } catch (const Json::exception& error) {
    throw std::invalid_argument(std::string("cannot be read as an exported machine: ") + error.what());
  }
  return m;
}

}  // namespace kurbel
