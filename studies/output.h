// output.h — what every study hands out: a conclusion, a table for the terminal, JSON, a report, tables as CSV.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "studies/report/report.h"

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

struct WriteOptions {
  bool plots = false;              // the report's plots for gnuplot too, into plots/
  bool interrupted = false;        // by the user: not to replace what is complete
  std::string made_by = "kurbel";  // for the manifest: the command
};

// Writes summary.json, report.html and the CSV files as one result set (result_set.h): into the folder, but what is
// incomplete or was interrupted beside it, into FOLDER.incomplete. Returns where it is. Throws std::runtime_error where
// it could not be written; then all is as it was.
std::filesystem::path write_output(const StudyOutput& output, const std::filesystem::path& folder,
                                   const WriteOptions& options = {});

}  // namespace kurbel
