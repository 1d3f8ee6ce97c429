// sweep_findings.h — the report of a sweep: response curves, maps, influence on figures, failures, the worst machines.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/speed_unit.h"
#include "engine/scene/units.h"
#include "studies/findings/output.h"
#include "studies/sweep/influence.h"
#include "studies/sweep/limit.h"
#include "studies/sweep/store.h"

namespace kurbel {

// Range of a figure over all rows that have it.
struct Spread {
  SweptFigure figure;
  std::size_t rows = 0;
  double least = HUGE_VAL, mean = 0, greatest = -HUGE_VAL, deviation = 0;
  std::optional<double> error = {};  // the largest; empty: none was measured
};

// Rows that failed, or were not confirmed, with the same reason.
struct Failures {
  std::size_t count = 0;
  SweepRow first;
};

// Statistics over all rows, in one pass without storing them.
struct SweepTally {
  std::size_t rows = 0, done = 0, unconfirmed = 0, failed = 0;
  std::vector<Spread> spreads;               // of each figure
  std::vector<LimitCount> limits;            // as given
  std::vector<Failures> failures;            // the most frequent reason first
  std::vector<std::vector<SweepRow>> worst;  // of each figure, by its limit; without limit the greatest values
  std::vector<std::size_t> pieces;           // the first row of each rows_in_table
};
inline constexpr std::size_t rows_held = 100'000, rows_in_table = 250'000;
SweepTally tally_of(const SweepStore& store, const std::vector<FigureLimit>& limits);

struct SweepStudyResult {
  SweepIdentity identity;
  std::vector<SweepRow> rows;         // all, or a random sample of rows_held: for plots and indices
  SweepTally tally;                   // of all rows
  const SweepStore* store = nullptr;  // read again for rows that are not held
  std::vector<FigureLimit> limits;
  std::vector<FigureInfluence> influences;  // of each figure
  std::string into;                         // file
  bool interrupted = false;
  std::size_t wanted = 0;     // rows of this shard
  SpeedUnit speed_unit = {};  // for people

  // In the scene's unit if it is a speed.
  double reported(double value, const std::string& unit) const {
    return unit == "rad/s" ? speed_unit.of(value) : value;
  }
  std::string reported(const std::string& unit) const { return unit == "rad/s" ? speed_unit.name : pretty_unit(unit); }

  bool holds_all() const { return rows.size() == tally.rows; }
  // Rows from `from` to below `to`, whether they are held or not.
  void each_row(const std::function<void(const SweepRow&)>& visit, std::size_t from = 0,
                std::size_t to = SweepStore::all) const;
};

// Limits as written; influences are computed here. Throws std::invalid_argument for an invalid limit. With more than
// `held` rows the store is read again later: it must outlive the result.
SweepStudyResult study_of(const SweepStore& store, const std::vector<std::string>& limits,
                          std::size_t held = rows_held);

// Sobol sequence shifted by a seed: without a shift (seed 0) its points are not random.
bool is_shifted_sobol(const SweepIdentity& identity);

// "kurbel run press.toml --set …": the command that computes a single row.
std::string line_of(const SweepIdentity& identity, const SweepRow& row);

Findings findings_of(const SweepStudyResult& study);
// Rows from `from` to below `to`: state, parameters, figures with errors, and reasons of failures.
DataTable variants_data(const SweepStudyResult& study, std::size_t from = 0, std::size_t to = SweepStore::all,
                        bool with_diagnosis = false);
// The counts must outlive the table. `unknown`: the key of rows without the figure; `from`: heading of the interval.
Rows limit_table(const std::string& title, const std::vector<LimitCount>& limits, const std::string& unknown,
                 const std::string& from);
// Only in the list of claims: failures, and the share of machines that meets each limit.
Claims share_claims(const std::vector<LimitCount>& limits, std::size_t failed, std::size_t machines);

// Throws std::invalid_argument if a sheet cannot hold this many variants (1 048 575), or the file cannot be written.
void check_xlsx(const std::string& file, std::size_t rows);
// A sheet with one row per variant, and one with the question. Throws as check_xlsx does.
void write_xlsx(const SweepStudyResult& study, const std::string& file);

}  // namespace kurbel
