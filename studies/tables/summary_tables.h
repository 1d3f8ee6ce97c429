// summary_tables.h — figures and events of a summary as rows, for a workbook and for constants beside a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "studies/findings/rows.h"

namespace kurbel {

struct FigureRow : Estimate {
  std::string of;  // its model: "rigid"; empty: the only one
  std::string name, unit;
  std::optional<double> at;
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

// All figures and events in a summary, at any depth: records with name, value and unit are figures, those with time
// and component are events.
SummaryTables summary_tables(const Record& summary);

}  // namespace kurbel
