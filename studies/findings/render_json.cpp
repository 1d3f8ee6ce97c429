// render_json.cpp — findings for programs: summary.json.
#include <algorithm>
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

// What is said of a key again stands in the place of what was said first.
void put(Record& summary, const std::string& key, Value value) {
  const auto said = std::find_if(summary.begin(), summary.end(), [&](const Field& field) { return field.key == key; });
  if (said == summary.end())
    summary.push_back({key, std::move(value)});
  else
    said->value = std::move(value);
}

void tell(Record& summary, const Rows& rows) {
  if (!rows.key.empty()) put(summary, rows.key, rows.list());
}
void tell(Record& summary, const Sentences& words) {
  if (!words.key.empty()) put(summary, words.key, words.lines);
}
void tell(Record& summary, const Field& field) { put(summary, field.key, field.value); }
void tell(Record&, const Drawn&) {}

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

Record summary_of(const Findings& f) {
  Record summary = {{"version", summary_version}};
  if (!f.title.empty()) put(summary, "title", f.title);
  if (!f.scene_file.empty()) put(summary, "scene", f.scene_file);
  if (!f.speed_unit.empty()) put(summary, "speed_unit", f.speed_unit);
  if (f.tells_complete) put(summary, "complete", f.complete);
  if (!f.complete && f.tells_diagnosis) put(summary, "diagnosis", f.diagnosis);
  put(summary, "conclusion", f.conclusion());
  for (const Statement& s : f.statements) std::visit([&](const auto& what) { tell(summary, what); }, s.what);
  return summary;
}

std::string json_text(const Record& record) {
  // What is no UTF-8 is replaced, and no terminal obeys it.
  return printable_json(json_of(record).dump(2, ' ', false, Json::error_handler_t::replace));
}

std::string StudyOutput::json() const { return json_text(summary); }

}  // namespace kurbel
