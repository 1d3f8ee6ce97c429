// summary_tables.cpp — a walk through a summary.
#include "studies/tables/summary_tables.h"

#include <cmath>
#include <cstdint>

#include "engine/base/find_by.h"
#include "studies/dictionary/dictionary.h"

namespace kurbel {
namespace {

const Value* value_of(const Record& record, const char* key) {
  const auto* const found = find_by(record, &Field::key, key);
  return found ? &found->value : nullptr;
}

std::string text_in(const Record& record, const char* key) {
  const Value* value = value_of(record, key);
  const std::string* text = value ? value->as<std::string>() : nullptr;
  return text ? *text : "";
}

// Values that are not finite are unknown.
std::optional<double> number_in(const Record& record, const char* key) {
  const Value* value = value_of(record, key);
  if (!value) return {};
  if (const std::int64_t* whole = value->as<std::int64_t>()) return static_cast<double>(*whole);
  const double* number = value->as<double>();
  return number && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

// A claim also has a severity.
bool is_figure(const Record& record) {
  return !text_in(record, "name").empty() && number_in(record, "value") && value_of(record, "unit") &&
         !value_of(record, "severity");
}

bool is_event(const Record& record) { return number_in(record, "t") && value_of(record, "component"); }

FigureRow figure_row(const Record& record, const std::string& of) {
  FigureRow row{{*number_in(record, "value"), number_in(record, "error")},
                of,
                text_in(record, "name"),
                text_in(record, "unit"),
                number_in(record, "at"),
                {}};
  if (const Definition* definition = definition_of(row.name)) row.meaning = definition->words;
  return row;
}

void walk(const Value& value, const std::string& of, SummaryTables& into);

void walk(const Record& record, const std::string& of, SummaryTables& into) {
  if (is_figure(record)) into.figures.push_back(figure_row(record, of));
  if (is_event(record))
    into.events.push_back(
        {of, *number_in(record, "t"), text_in(record, "component"), text_in(record, "from"), text_in(record, "what")});
  const std::string label = text_in(record, "label");
  for (const auto& [key, value] : record) {
    if (const Record* models = key == "models" ? value.as<Record>() : nullptr)
      for (const Field& model : *models) walk(model.value, model.key, into);
    else
      walk(value, label.empty() ? of : label, into);
  }
}

void walk(const Value& value, const std::string& of, SummaryTables& into) {
  if (const Record* record = value.as<Record>()) walk(*record, of, into);
  if (const List* list = value.as<List>())
    for (const Value& item : *list) walk(item, of, into);
}

}  // namespace

SummaryTables summary_tables(const Record& summary) {
  SummaryTables tables;
  walk(summary, "", tables);
  return tables;
}

}  // namespace kurbel
