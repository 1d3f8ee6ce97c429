// summary_tables.h — figures and events of a summary as rows, for a spread sheet and for constants beside a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/rows.h"

namespace kurbel {

struct FigureRow {
  std::string of;  // the model that it belongs to: "rigid"; empty: the only one
  std::string name;
  double value = 0;
  std::string unit;
  std::optional<double> error, at;
  std::string meaning;  // from the dictionary
};

struct EventRow {
  std::string of;
  double time = 0;
  std::string component, from, what;
};

struct SummaryTables {
  std::vector<FigureRow> figures;
  std::vector<EventRow> events;
};

// All that stand in a summary, wherever: what has a name, a value and a unit is a figure, what has a time and a component
// is an event.
SummaryTables summary_tables(const Record& summary);

}  // namespace kurbel
