// summary_tables.cpp — a walk through summary.json.
#include "studies/tables/summary_tables.h"

#include <nlohmann/json.hpp>

#include "studies/dictionary/dictionary.h"

namespace kurbel {
namespace {

using Json = nlohmann::ordered_json;

std::string text_in(const Json& record, const char* key) {
  const auto found = record.find(key);
  return found != record.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<double> number_in(const Json& record, const char* key) {
  const auto found = record.find(key);
  return found != record.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

bool is_figure(const Json& record) {
  return !text_in(record, "name").empty() && number_in(record, "value") && record.contains("unit");
}

bool is_event(const Json& record) { return number_in(record, "t") && record.contains("component"); }

FigureRow figure_row(const Json& record, const std::string& of) {
  FigureRow row{.of = of,
                .name = text_in(record, "name"),
                .value = *number_in(record, "value"),
                .unit = text_in(record, "unit"),
                .error = number_in(record, "error"),
                .at = number_in(record, "at"),
                .meaning = {}};
  if (const Definition* definition = definition_of(row.name)) row.meaning = definition->words;
  return row;
}

void walk(const Json& json, const std::string& of, SummaryTables& into) {
  if (json.is_array()) {
    for (const Json& item : json) walk(item, of, into);
  } else if (json.is_object()) {
    if (is_figure(json)) into.figures.push_back(figure_row(json, of));
    if (is_event(json))
      into.events.push_back(
          {of, *number_in(json, "t"), text_in(json, "component"), text_in(json, "from"), text_in(json, "what")});
    const std::string label = text_in(json, "label");
    for (const auto& [key, value] : json.items()) {
      const bool models = key == "models" && value.is_object();
      if (!models) walk(value, label.empty() ? of : label, into);
      for (auto model = value.begin(); models && model != value.end(); ++model) walk(*model, model.key(), into);
    }
  }
}

}  // namespace

SummaryTables summary_tables(const std::string& json) {
  SummaryTables tables;
  walk(Json::parse(json), "", tables);
  return tables;
}

}  // namespace kurbel
