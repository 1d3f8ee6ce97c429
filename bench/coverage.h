// coverage.h — do stated errors cover the true ones? Random variants of all example scenes, judged against references.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/benches.h"
#include "tests/coverage/measure.h"

namespace kurbel::bench {

struct CoverageOptions {
  std::size_t variants = 2640;  // of all scenes together
  std::uint64_t seed = 1;       // of the first variant of each scene
  int jobs = 2;
  double minutes = 1e9;  // no variant is begun later
  double budget = 2;     // processor time of one integration [s]
  std::size_t shard = 1, shards = 1;
  std::string ladder;  // file for the runs of ladders, in place of the campaign
  std::string print;   // "crank_press:17": its text, in place of the campaign
};

// --variants N --seed S --jobs J --minutes M --budget SECONDS --shard 1/8 --dump-ladder FILE --print SCENE:SEED. Throws
// std::invalid_argument in words.
CoverageOptions coverage_options(int argc, char** argv);

// Variant k: its scene and its seed.
std::string scene_of(std::size_t variant);
std::uint64_t seed_of(const CoverageOptions& options, std::size_t variant);

// One line per run and figure, as comma-separated values.
void dump_ladders(const CoverageOptions& options, const std::string& path);

// Measures the shard's variants into FOLDER/coverage_1of8.csv (a whole shard of the same campaign is kept as it is),
// and puts what all shards there say into the book.
void coverage_of_errors(BenchBook& book, const CoverageOptions& options, const std::string& folder);

// Tables, picture and targets of measured variants.
void report_coverage(BenchBook& book, const std::vector<coverage::MeasuredVariant>& variants);

}  // namespace kurbel::bench
