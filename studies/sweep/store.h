// store.h — the file that a sweep fills: what was asked, the parameters and figures of every row, why rows failed.
//
//   meta(key, value)                     scene text, version, design, seed …: whoever opens it knows what it holds
//   swept(number, path, unit, given)     what is varied
//   runs(row, state, seconds, diagnosis) state: done, unconfirmed, failed
//   parameters(row, number, value)       in the unit of `swept`
//   figure_names(number, name, unit)
//   figures(row, number, value, error)   SI; error NULL: not measured
//
// A row is there whole or not at all. What was committed survives the end of the process and, as far as the disk keeps
// what it was told to flush, a power cut.
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

// What makes two sweeps one: equal in both, or they are not to be mixed.
struct SweepIdentity {
  std::map<std::string, std::string> meta;  // without the shard
  std::string shard = "1/1";
  std::vector<SweptParameter> parameters;
  std::vector<SweptFigure> figures;
  std::size_t rows = 0;  // of all shards

  // What stands in meta; empty: nothing does.
  std::string told(const std::string& key) const {
    const auto found = meta.find(key);
    return found == meta.end() ? "" : found->second;
  }
};

class SweepStore {
 public:
  // Makes the file, or goes on with one. Throws std::invalid_argument where the file holds another sweep (says what
  // differs), or is none.
  SweepStore(const std::filesystem::path& file, const SweepIdentity& identity);
  // One that is there.
  explicit SweepStore(const std::filesystem::path& file);

  const SweepIdentity& identity() const { return identity_; }
  std::vector<bool> rows_there() const;           // by row
  void write(const std::vector<SweepRow>& rows);  // in one transaction: committed when it returns
  std::size_t count() const;                      // of rows that are there
  // Each row from `from` on, below `to`, in their order: one is held at a time.
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

// In words what differs in two sweeps, shards apart; empty: nothing.
std::string difference(const SweepIdentity& there, const SweepIdentity& asked);

// Shards put together: all of one sweep, no row with two different results; the file appears under its name when it is
// whole. Returns the number of rows. Throws std::invalid_argument in words.
std::size_t merge_sweeps(const std::vector<std::string>& files, const std::filesystem::path& into);

}  // namespace kurbel
