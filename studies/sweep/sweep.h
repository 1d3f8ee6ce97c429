// sweep.h — computes the rows of a design in threads, with one writer; existing rows are not computed again.
// Independent of machines: an evaluator computes a row.
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

// Rows of a shard: "3/64". Throws std::invalid_argument under the option's name.
void read_shard(const std::string& text, SweepJob& job);
// Identity from a design and the figures of its rows; meta: other entries of the identity.
SweepIdentity identity_of(const Design& design, std::vector<SweptFigure> figures, const std::string& shard,
                          std::map<std::string, std::string> meta);
std::string joined_lines(const std::vector<std::string>& texts);

struct SweepEnd {
  std::size_t rows = 0;      // of this shard
  std::size_t there = 0;     // before this run
  std::size_t computed = 0;  // computed and written
  std::size_t failed = 0;    // of those
  double seconds = 0;        // elapsed time
  bool complete() const { return there + computed == rows; }
};

// Batches are committed four times a second. On interruption the finished rows are kept.
SweepEnd run_sweep(const SweepJob& job, SweepStore& store);

}  // namespace kurbel
