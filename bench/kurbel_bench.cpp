// kurbel_bench.cpp — what accuracy, effects, size and elements cost, on the reference problems and the example scenes;
// whether the hard cases end right, whether all verbs agree, and whether stated errors cover the true ones.
//
//   kurbel_bench ratios|accuracy|scenes|effects|counts|advice|growth|elements|sweep|hard|agreement|agreement2|coverage|all [--out FOLDER]
//   kurbel_bench hard [--only NAME] [--budget SECONDS] [--out FOLDER]
//   kurbel_bench agreement|agreement2 [--only NAME] [--jobs 2] [--out FOLDER]
//   kurbel_bench coverage [--variants N] [--seed S] [--shard 1/8] [--jobs J] [--minutes M] [--budget SECONDS]
//                         [--dump-ladder FILE.csv] [--print SCENE:SEED] [--out FOLDER]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>

#include "bench/benches.h"
#include "bench/coverage.h"

namespace {

// The program that callgrind runs stands beside this one.
std::string counter_beside(const char* self) {
  return (std::filesystem::path(self).parent_path() / "kurbel_count_evaluations").string();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace kurbel::bench;
  const std::string part = argc > 1 ? argv[1] : "";
  std::string folder = "results/bench", only;  // only: hard cases whose names hold this
  double budget = 1;                           // of each integration of a hard case [s]
  int jobs = 2;                                // scenes at once
  for (int i = 2; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--out") == 0) folder = argv[i + 1];
    if (std::strcmp(argv[i], "--only") == 0) only = argv[i + 1];
    if (std::strcmp(argv[i], "--budget") == 0) budget = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--jobs") == 0) jobs = std::max(1, std::atoi(argv[i + 1]));
  }
  if (!(budget > 0)) {
    std::fprintf(stderr, "kurbel_bench: --budget: give seconds above 0\n");
    return 2;
  }
  const bool all = part == "all";
  bool any = all;
  BenchBook book;
  const auto wants = [&](const char* name) {
    any = any || part == name;
    return all || part == name;
  };
  if (wants("accuracy")) accuracy_of_problems(book);
  if (part == "ratios") {  // a minute: before and after a structural change
    any = true;
    ratios_to_hand_written(book);
    book.tables.push_back(counts_of_single_machines(counter_beside(argv[0])));
  }
  if (wants("scenes")) accuracy_of_scenes(book);
  if (wants("effects")) costs_of_effects(book);
  if (wants("counts")) counts_of_instructions(book, counter_beside(argv[0]));
  if (wants("advice")) advice_on_scenes(book);
  if (wants("growth")) {
    growth_with_size(book);
    costs_of_modes();
  }
  if (wants("elements")) {
    costs_of_elements(book);
    costs_of_mechanisms();
    costs_of_steady_cycles();
  }
  if (part == "sweep") {  // by itself: its times want a quiet machine
    any = true;
    rates_of_sweeps(book, (std::filesystem::absolute(argv[0]).parent_path() / "kurbel").string());
  }
  if (wants("hard")) hard_cases(book, only, budget);
  if (part == "agreement" || part == "agreement2") {  // a minute or two of its own: not among all
    try {
      any = true;
      agreement_of_verbs(book, part == "agreement2" ? 1 : 0, only, jobs, folder);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "kurbel_bench: %s\n", error.what());
      return 2;
    }
  }
  if (part == "coverage") {  // half an hour of its own: not among all
    try {
      any = true;
      const CoverageOptions options = coverage_options(argc, argv);
      coverage_of_errors(book, options, folder);
      if (!options.ladder.empty() || !options.print.empty()) return 0;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "kurbel_bench: %s\n", error.what());
      return 2;
    }
  }
  if (!any) {
    std::fprintf(stderr,
                 "kurbel_bench: give ratios, accuracy, scenes, effects, counts, advice, growth, elements, sweep, hard, "
                 "agreement, "
                 "agreement2, coverage or all\n");
    return 2;
  }
  std::fputs(book.text().c_str(), stdout);
  book.write(folder);
  std::printf("report: %s/report.html\n", folder.c_str());
  return 0;
}
