// render_json.cpp — findings for programs: the summary's values, and tables for files.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/find_by.h"
#include "studies/findings/output.h"

namespace kurbel {
namespace {

// A repeated key replaces its earlier value.
void put(Record& summary, const std::string& key, Value value) {
  auto* const said = find_by(summary, &Field::key, key);
  if (said)
    said->value = std::move(value);
  else
    summary.push_back({key, std::move(value)});
}

void report(Record& summary, const Rows& rows) {
  if (!rows.key.empty()) put(summary, rows.key, rows.list());
}
void report(Record& summary, const Sentences& words) {
  if (!words.key.empty()) put(summary, words.key, words.lines);
}
void report(Record& summary, const Field& field) { put(summary, field.key, field.value); }
void report(Record&, const Drawn&) {}

DataCell cell_of(const Value& value) {
  if (const std::string* words = value.as<std::string>()) return *words;
  if (const bool* so = value.as<bool>()) return *so ? 1.0 : 0.0;
  if (const std::int64_t* whole = value.as<std::int64_t>()) return static_cast<double>(*whole);
  const double* const number = value.as<double>();
  return number && std::isfinite(*number) ? *number : std::numeric_limits<double>::quiet_NaN();
}

// The typed claim, in addition to the words of the conclusion.
Record claim_record(const Claim& c) {
  Record record = {{"name", name_of(c.predicate)},
                   {"of", c.of},
                   {"at", c.evidence.at},
                   {"value", c.evidence.value},
                   {"limit", c.evidence.limit},
                   {"error", c.evidence.error},
                   {"unit", c.evidence.unit},
                   {"severity", name_of(c.severity())},
                   {"text", c.text}};
  if (!c.load_case.empty()) record.push_back({"load_case", c.load_case});
  if (c.remedy)
    record.push_back({"remedy", Record{{"key", c.remedy->key},
                                       {"value", c.remedy->value},
                                       {"unit", c.remedy->unit},
                                       {"tried", c.remedy->tried}}});
  return record;
}

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

DataTable Rows::data() const {
  DataTable table;
  std::vector<std::vector<DataCell>> rows(count);
  for (const Column& c : columns)
    if (c.in_file) {
      for (std::size_t i = 0; i < count; ++i) rows[i].push_back(cell_of(c.values[i]));
      table.columns.push_back(*c.in_file);
      table.columns.back().words = count > 0 && std::holds_alternative<std::string>(rows[0].back());
    }
  table.each_row = [rows = std::move(rows)](const std::function<void(DataRow)>& take) {
    for (const std::vector<DataCell>& row : rows) take(row);
  };
  return table;
}

Record summary_of(const Findings& f) {
  Record summary = {{"version", summary_version}};
  if (!f.title.empty()) put(summary, "title", f.title);
  if (!f.scene_file.empty()) put(summary, "scene", f.scene_file);
  if (!f.speed_unit.empty()) put(summary, "speed_unit", f.speed_unit);
  if (f.reports_complete) put(summary, "complete", f.complete);
  if (!f.complete && f.reports_diagnosis) put(summary, "diagnosis", f.diagnosis);
  put(summary, "conclusion", f.conclusion());
  put(summary, "claims", each(f.claims, claim_record));
  for (const Statement& s : f.statements) std::visit([&](const auto& what) { report(summary, what); }, s.what);
  return summary;
}

}  // namespace kurbel
