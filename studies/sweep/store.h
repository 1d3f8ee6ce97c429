// store.h — the file of a sweep: the question, parameters and figures of every row, reasons of failures.
//
//   meta(key, value)                     scene text, version, design, seed …: a complete description of the contents
//   swept(number, path, unit, given)     varied parameters
//   runs(row, state, seconds, diagnosis) state: done, unconfirmed, failed
//   parameters(row, number, value)       in the unit of `swept`
//   figure_names(number, name, unit)
//   figures(row, number, value, error)   SI; error NULL: not measured
//
// Rows are written completely or not at all. Committed rows survive the end of the process and, as far as the disk
// honours flushing, a power failure.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "studies/experiments/parameter.h"
#include "studies/sweep/database.h"
#include "studies/variants/rows.h"

namespace kurbel {

// Identity of a sweep: only sweeps with equal identity may be combined.
struct SweepIdentity {
  std::map<std::string, std::string> meta;  // without the shard
  std::string shard = "1/1";
  std::vector<SweptParameter> parameters;
  std::vector<SweptFigure> figures;
  std::size_t rows = 0;  // of all shards

  // Entry of meta; empty: none.
  std::string reported(const std::string& key) const {
    const auto found = meta.find(key);
    return found == meta.end() ? "" : found->second;
  }
};

class SweepStore {
 public:
  // Creates the file, or continues one. Throws std::invalid_argument if the file holds another sweep (with the
  // difference), or is no sweep.
  SweepStore(const std::filesystem::path& file, const SweepIdentity& identity);
  // Opens an existing file.
  explicit SweepStore(const std::filesystem::path& file);

  const SweepIdentity& identity() const { return identity_; }
  std::vector<bool> rows_there() const;           // by row
  void write(const std::vector<SweepRow>& rows);  // in one transaction: committed when it returns
  std::size_t count() const;                      // of rows that are there
  // Visits rows from `from` to below `to`, in order, one at a time.
  using Visit = std::function<void(SweepRow&& row)>;
  static constexpr std::size_t all = std::numeric_limits<std::size_t>::max() / 2;
  void each(const Visit& visit, std::size_t from = 0, std::size_t to = all) const;
  const std::filesystem::path& file() const { return database_->file(); }

 private:
  void create(const SweepIdentity& identity);
  SweepIdentity read_identity() const;

  std::unique_ptr<Database> database_;
  SweepIdentity identity_;
  std::unique_ptr<Query> put_run_, put_parameter_, put_figure_;
};

// Difference between two sweeps in words, except for shards; empty: none.
std::string difference(const SweepIdentity& there, const SweepIdentity& asked);

// Merges shards of one sweep; no row may have two different results; the file appears under its name when it is
// complete. Returns the number of rows. Throws std::invalid_argument with the reason.
std::size_t merge_sweeps(const std::vector<std::string>& files, const std::filesystem::path& into);

}  // namespace kurbel
