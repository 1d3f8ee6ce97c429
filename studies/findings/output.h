// output.h — what every study hands out: a conclusion, a table for the terminal, JSON, a report, tables as CSV.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/findings/report.h"

namespace kurbel {

struct CsvFile {
  std::string name;                   // "trajectory.csv"
  std::function<std::string()> text;  // made only when it is written
};

struct StudyOutput {
  std::string conclusion;          // one line
  std::string table;               // for a terminal, ends with a newline; holds the conclusion
  std::string json;                // the same figures for programs
  std::function<Report()> report;  // made only when it is written
  std::vector<CsvFile> csv = {};
  bool complete = true;
  std::string diagnosis = {};    // of a run that failed on its way
  std::string unconfirmed = {};  // why the accuracy asked for is not sure; empty: it is, or none was to be confirmed
};

}  // namespace kurbel
