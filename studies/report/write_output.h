// write_output.h — writes a study's output as one result set: JSON, page, tables, plots.
#pragma once

#include <filesystem>
#include <string>

#include "studies/findings/output.h"
#include "studies/report/render.h"
#include "studies/tables/table_files.h"

namespace kurbel {

struct WriteOptions {
  bool plots = false;              // also the report's plots for gnuplot, into plots/
  bool interrupted = false;        // by the user: complete results are not replaced
  std::string made_by = "kurbel";  // for the manifest: the command
  Letterhead head = {};            // of the page
  TableFormats formats = {};       // of the tables
};

// Writes summary.json, report.html and the tables as one result set (result_set.h) into the folder; incomplete or
// interrupted results into FOLDER.incomplete beside it. Returns the folder written. Throws std::runtime_error if it
// could not be written; then nothing has changed.
std::filesystem::path write_output(const StudyOutput& output, const std::filesystem::path& folder,
                                   const WriteOptions& options = {});

}  // namespace kurbel
