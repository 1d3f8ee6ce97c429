// coverage_bench.cpp — a campaign of random variants in shards; what it found is said by coverage_report.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "bench/coverage.h"
#include "bench/workers.h"
#include "tests/coverage/records.h"

namespace kurbel::bench {
namespace {

using coverage::MeasuredVariant;

constexpr int seconds_a_variant = 150;  // processor time; some ten integrations within their budgets
const char* const end_line = "# whole";

std::string head_line(const CoverageOptions& o) {
  return fmt::format("# campaign of {} variants from seed {}, {:g} s an integration, shard {} of {}", o.variants,
                     o.seed, o.budget, o.shard, o.shards);
}
std::string shard_file(const std::string& folder, std::size_t shard, std::size_t shards) {
  return fmt::format("{}/coverage_{}of{}.csv", folder, shard, shards);
}

bool is_whole(const std::string& path, const CoverageOptions& options) {
  std::ifstream in(path);
  std::string line, last;
  if (!std::getline(in, line) || line != head_line(options)) return false;
  while (std::getline(in, line)) last = line;
  return last == end_line;
}

// What broke on its way leaves a line, too.
std::string lines_of(const TaskEnd& end, const std::string& scene, std::uint64_t seed) {
  if (end.whole) return end.text;
  MeasuredVariant broken;
  broken.scene = scene;
  broken.seed = seed;
  broken.words = end.words;
  return coverage::lines_of(broken);
}

void measure_shard(const CoverageOptions& options, const std::string& path) {
  std::ofstream out(path);
  if (!out) throw std::runtime_error(path + ": cannot be written");
  out << head_line(options) << "\n" << coverage::column_lines();
  const std::size_t first = (options.shard - 1) * options.variants / options.shards,
                    last = options.shard * options.variants / options.shards;
  const auto begin = std::chrono::steady_clock::now();
  std::size_t done = 0;
  run_tasks(
      last - first, options.jobs, seconds_a_variant,
      [&](std::size_t k) {
        const coverage::Variant v = coverage::make_variant(scene_of(first + k), seed_of(options, first + k));
        return coverage::lines_of(coverage::measure(v, {.budget = options.budget}));
      },
      [&](const TaskEnd& end) {
        out << lines_of(end, scene_of(first + end.task), seed_of(options, first + end.task)) << std::flush;
        if (++done % 30 == 0)
          std::fprintf(stderr, "shard %zu: %zu of %zu variants\n", options.shard, done, last - first);
      },
      [&] {
        const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
        return gone.count() < 60 * options.minutes;
      });
  if (done == last - first) out << end_line << "\n";
}

}  // namespace

std::string scene_of(std::size_t variant) { return coverage::scene_names()[variant % coverage::scene_names().size()]; }
std::uint64_t seed_of(const CoverageOptions& options, std::size_t variant) {
  return options.seed + variant / coverage::scene_names().size();
}

CoverageOptions coverage_options(int argc, char** argv) {
  CoverageOptions o;
  for (int i = 2; i + 1 < argc; ++i) {
    const std::string name = argv[i], value = argv[i + 1];
    const auto positive = [&] {
      const double number = std::atof(value.c_str());
      if (!(number > 0)) throw std::invalid_argument(fmt::format("{} {}: must be above 0", name, value));
      return number;
    };
    if (name == "--variants") o.variants = static_cast<std::size_t>(positive());
    if (name == "--seed") o.seed = static_cast<std::uint64_t>(positive());
    if (name == "--jobs") o.jobs = static_cast<int>(positive());
    if (name == "--minutes") o.minutes = positive();
    if (name == "--budget") o.budget = positive();
    if (name == "--dump-ladder") o.ladder = value;
    if (name == "--print") o.print = value;
    if (name == "--shard") {
      char slash = 0;
      std::istringstream in(value);
      in >> o.shard >> slash >> o.shards;
      if (!in || slash != '/' || o.shard < 1 || o.shard > o.shards)
        throw std::invalid_argument(fmt::format("--shard {}: must be such as 1/8", value));
    }
  }
  return o;
}

namespace {

// "crank_press:17"
void print_scene(const std::string& which) {
  const std::size_t colon = which.find(':');
  const auto& names = coverage::scene_names();
  if (colon == std::string::npos || std::find(names.begin(), names.end(), which.substr(0, colon)) == names.end())
    throw std::invalid_argument(fmt::format("--print {}: must be a scene and a seed such as crank_press:17", which));
  const coverage::Variant v =
      coverage::make_variant(which.substr(0, colon), std::strtoull(which.c_str() + colon + 1, nullptr, 10));
  std::fputs(v.text.c_str(), stdout);
}

}  // namespace

void coverage_of_errors(BenchBook& book, const CoverageOptions& options, const std::string& folder) {
  if (!options.print.empty()) return print_scene(options.print);
  if (!options.ladder.empty()) return dump_ladders(options, options.ladder);
  std::filesystem::create_directories(folder);
  const std::string own = shard_file(folder, options.shard, options.shards);
  if (is_whole(own, options)) {
    std::fprintf(stderr, "%s is whole, and kept\n", own.c_str());
  } else {
    measure_shard(options, own);
  }
  std::vector<MeasuredVariant> all;
  std::size_t missing = 0;
  for (std::size_t shard = 1; shard <= options.shards; ++shard) {
    std::ifstream in(shard_file(folder, shard, options.shards));
    missing += !in;
    for (MeasuredVariant& v : coverage::read_lines(in)) all.push_back(std::move(v));
  }
  if (missing > 0) std::fprintf(stderr, "%zu of %zu shards are not measured yet\n", missing, options.shards);
  report_coverage(book, all);
}

}  // namespace kurbel::bench
