// sweep_findings.h — the report of a sweep: response curves, maps, what moves a figure, failures, the worst machines.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/output.h"
#include "studies/sweep/influence.h"
#include "studies/sweep/limit.h"
#include "studies/sweep/store.h"

namespace kurbel {

struct SweepStudyResult {
  SweepIdentity identity;
  std::vector<SweepRow> rows;
  std::vector<FigureLimit> limits;
  std::vector<FigureInfluence> influences;  // of each figure
  std::string into;                         // file
  bool interrupted = false;
  std::size_t wanted = 0;  // rows of this shard

  std::size_t count(RowState state) const;
};

// Limits as they were written; influences are computed here. Throws std::invalid_argument for one that is none.
SweepStudyResult study_of(const SweepStore& store, const std::vector<std::string>& limits);

// "kurbel run press.toml --set …": computes a row alone.
std::string line_of(const SweepIdentity& identity, const SweepRow& row);

Findings findings_of(const SweepStudyResult& study);

// A sheet with a row a variant, and one that says what was asked. Throws std::invalid_argument where it cannot be
// written, or where a sheet cannot hold it (1 048 575 rows).
void write_xlsx(const SweepStudyResult& study, const std::string& file);

}  // namespace kurbel
