// sweep.h — every row of a design computed, in threads, and written by one writer; what is there already is not computed
// again. Knows no machine: what a row yields, a function of it says.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "studies/experiments/design.h"
#include "studies/findings/watch.h"
#include "studies/sweep/store.h"

namespace kurbel {

struct SweepJob {
  const Design* design = nullptr;
  std::size_t shard = 1, shards = 1;          // rows with row mod shards = shard − 1
  int jobs = 1;                               // threads
  std::function<Evaluator()> evaluator = {};  // one for each thread
  Watch watch = {};
};

// Which rows: "3/64". Throws std::invalid_argument, told under the option's name.
void read_shard(const std::string& option, const std::string& text, SweepJob& job);
// Of a design and what its rows yield; meta: what else makes two sweeps one.
SweepIdentity identity_of(const Design& design, std::vector<SweptFigure> figures, const std::string& shard,
                          std::map<std::string, std::string> meta);
std::string joined_lines(const std::vector<std::string>& texts);

struct SweepEnd {
  std::size_t rows = 0;      // of this shard
  std::size_t there = 0;     // before it began
  std::size_t computed = 0;  // and written
  std::size_t failed = 0;    // of those
  double seconds = 0;        // by the clock
  bool complete() const { return there + computed == rows; }
};

// Batches are committed four times a second. An interrupt ends it with what is done.
SweepEnd run_sweep(const SweepJob& job, SweepStore& store);

}  // namespace kurbel
