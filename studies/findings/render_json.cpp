// render_json.cpp — findings for programs: summary.json.
#include <nlohmann/json.hpp>

#include "engine/scene/printable.h"
#include "studies/findings/output.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Value& value);

Json json_of(const Record& record) {
  Json j = Json::object();
  auto& fields = j.get_ref<Json::object_t&>();
  for (const Field& field : record) {  // no key comes twice, and none is looked for
    const std::pair<const std::string, Json> entry(field.key, json_of(field.value));
    fields.push_back(entry);
  }
  return j;
}

Json json_of(const Value& value) {
  return value.visit([]<class T>(const T& v) -> Json {
    if constexpr (std::is_same_v<T, std::monostate>) {
      return {};
    } else if constexpr (std::is_same_v<T, List>) {
      Json list = Json::array();
      for (const Value& item : v) list.push_back(json_of(item));
      return list;
    } else if constexpr (std::is_same_v<T, Record>) {
      return json_of(v);
    } else {
      return v;
    }
  });
}

void tell(Json& j, const Rows& rows) {
  if (!rows.key.empty()) j[rows.key] = json_of(Value(rows.list()));
}
void tell(Json& j, const Sentences& words) {
  if (!words.key.empty()) j[words.key] = words.lines;
}
void tell(Json& j, const Field& field) { j[field.key] = json_of(field.value); }
void tell(Json&, const Drawn&) {}

}  // namespace

List Rows::list() const {
  List list;
  for (std::size_t i = 0; i < std::min(count, for_programs); ++i) {
    Record row;
    for (const Column& c : columns)
      if (!c.key.empty()) row.push_back({c.key, c.values[i]});
    list.emplace_back(std::move(row));
  }
  return list;
}

std::string summary_json(const Findings& f) {
  Json j = {{"version", summary_version}};
  if (!f.title.empty()) j["title"] = f.title;
  if (!f.scene_file.empty()) j["scene"] = f.scene_file;
  if (!f.speed_unit.empty()) j["speed_unit"] = f.speed_unit;
  if (f.tells_complete) j["complete"] = f.complete;
  if (!f.complete && f.tells_diagnosis) j["diagnosis"] = f.diagnosis;
  j["conclusion"] = f.conclusion();
  for (const Statement& s : f.statements) std::visit([&](const auto& what) { tell(j, what); }, s.what);
  // What is no UTF-8 is replaced, and no terminal obeys it.
  return printable_json(j.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace kurbel
