// sweep_findings.h — the report of a sweep: response curves, maps, what moves a figure, failures, the worst machines.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/findings/output.h"
#include "studies/sweep/influence.h"
#include "studies/sweep/limit.h"
#include "studies/sweep/store.h"

namespace kurbel {

// How far a figure reaches over all rows that have it.
struct Spread {
  SweptFigure figure;
  std::size_t rows = 0;
  double least = HUGE_VAL, mean = 0, greatest = -HUGE_VAL, deviation = 0;
  std::optional<double> error = {};  // the largest; none was measured
};

// Rows that failed, or were not confirmed, for one reason.
struct Failures {
  std::size_t count = 0;
  SweepRow first;
};

// What is counted over all rows in one pass that holds none of them.
struct SweepTally {
  std::size_t rows = 0, done = 0, unconfirmed = 0, failed = 0;
  std::vector<Spread> spreads;               // of each figure
  std::vector<LimitCount> limits;            // as they were given
  std::vector<Failures> failures;            // the most frequent reason first
  std::vector<std::vector<SweepRow>> worst;  // of each figure, by its limit; without one the greatest
  std::vector<std::size_t> pieces;           // the first row of each rows_in_table
};
inline constexpr std::size_t rows_held = 100'000, rows_in_table = 250'000;
SweepTally tally_of(const SweepStore& store, const std::vector<FigureLimit>& limits);

struct SweepStudyResult {
  SweepIdentity identity;
  std::vector<SweepRow> rows;  // all, or of more than rows_held so many, drawn by chance: for pictures and indices
  SweepTally tally;            // of all
  const SweepStore* store = nullptr;  // asked again for rows that are not held
  std::vector<FigureLimit> limits;
  std::vector<FigureInfluence> influences;  // of each figure
  std::string into;                         // file
  bool interrupted = false;
  std::size_t wanted = 0;  // rows of this shard

  bool holds_all() const { return rows.size() == tally.rows; }
  // From `from` on, below `to`, whether they are held or not.
  void each_row(const std::function<void(const SweepRow&)>& visit, std::size_t from = 0,
                std::size_t to = SweepStore::all) const;
};

// Limits as they were written; influences are computed here. Throws std::invalid_argument for one that is none. Of more
// than `held` rows the store is asked again later: it has to live as long.
SweepStudyResult study_of(const SweepStore& store, const std::vector<std::string>& limits,
                          std::size_t held = rows_held);

// Sobol's sequence shifted by a seed: as published (seed 0) its points are chosen, not drawn.
bool is_shifted_sobol(const SweepIdentity& identity);

// "kurbel run press.toml --set …": computes a row alone.
std::string line_of(const SweepIdentity& identity, const SweepRow& row);

Findings findings_of(const SweepStudyResult& study);
// Rows from `from` on, below `to`: state, parameters, figures with their errors, and why a row failed.
DataTable variants_data(const SweepStudyResult& study, std::size_t from = 0, std::size_t to = SweepStore::all,
                        bool with_diagnosis = false);
// The counts must outlive the table. `unknown`: the key of rows without the figure; `from`: heading of the interval.
Rows limit_table(const std::string& title, const std::vector<LimitCount>& limits, const std::string& unknown,
                 const std::string& from);
// In the list of claims alone: what failed, and the share of machines that holds each limit.
Claims share_claims(const std::vector<LimitCount>& limits, std::size_t failed, std::size_t machines);

// Throws std::invalid_argument where a sheet cannot hold so many variants (1 048 575), or no file can be written there.
void check_xlsx(const std::string& file, std::size_t rows);
// A sheet with a row a variant, and one that says what was asked. Throws as check_xlsx does.
void write_xlsx(const SweepStudyResult& study, const std::string& file);

}  // namespace kurbel
