// write_output.h — what a study hands out, written as one result set: JSON, page, tables, plots.
#pragma once

#include <filesystem>
#include <string>

#include "studies/findings/output.h"
#include "studies/report/render.h"
#include "studies/tables/table_files.h"

namespace kurbel {

struct WriteOptions {
  bool plots = false;              // the report's plots for gnuplot too, into plots/
  bool interrupted = false;        // by the user: not to replace what is complete
  std::string made_by = "kurbel";  // for the manifest: the command
  Letterhead head = {};            // of the page
  TableFormats formats = {};       // of the tables
};

// Writes summary.json, report.html and the tables as one result set (result_set.h): into the folder, but what is
// incomplete or was interrupted beside it, into FOLDER.incomplete. Returns where it is. Throws std::runtime_error where
// it could not be written; then all is as it was.
std::filesystem::path write_output(const StudyOutput& output, const std::filesystem::path& folder,
                                   const WriteOptions& options = {});

}  // namespace kurbel
