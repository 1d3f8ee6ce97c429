// benches.h — the parts of kurbel_bench, each answering one question, and the book that they write their answers into.
#pragma once

#include <string>
#include <vector>

#include "studies/findings/report.h"

namespace kurbel::bench {

// One solver at one setting on one problem.
struct BenchPoint {
  double setting = 0;  // tolerance or step
  double error = 0, seconds = 0, fastest = 0, slowest = 0;
  long steps = 0;
};

// One solver over its settings.
struct BenchCurve {
  std::string problem;  // "R1"
  std::string solver;   // "kurbel dop853", "hand-written dop853", "Simbody RungeKuttaMerson, point in plane"
  bool peer = false;    // not ours
  std::vector<BenchPoint> points;

  // Least time with an error of at most this; infinite: never reached.
  double time_to(double error) const;
};

struct BenchTarget {
  std::string what, wanted, measured;
  bool met = false;
};

class BenchBook {
 public:
  std::vector<BenchCurve> curves;
  std::vector<BenchTarget> targets;
  std::vector<Table> tables;
  std::vector<Plot> plots;
  std::vector<std::string> conclusions;  // sentences; how many targets are met comes last by itself
  std::vector<ReportSection> sections;   // of the page, as they are; their tables go into the JSON, too

  // Least time of the solvers that the filter takes; infinite: none reaches it.
  template <class Filter>
  double best(const std::string& problem, double error, Filter filter) const;
  void target(const std::string& what, const std::string& wanted, const std::string& measured, bool met) {
    targets.push_back({what, wanted, measured, met});
  }

  std::string text() const;
  std::string json() const;
  Report report() const;
  void write(const std::string& folder) const;  // bench.json, report.html, plots as SVG where gnuplot is installed
};

template <class Filter>
double BenchBook::best(const std::string& problem, double error, Filter filter) const {
  double least = __builtin_huge_val();
  for (const BenchCurve& c : curves)
    if (c.problem == problem && filter(c)) least = c.time_to(error) < least ? c.time_to(error) : least;
  return least;
}

void accuracy_of_problems(BenchBook& book);  // R1, R2b, R2stick, E1 against their references, with the peers
void accuracy_of_scenes(BenchBook& book);    // the example scenes
void growth_with_size(BenchBook& book);      // E2
void costs_of_effects(BenchBook& book);      // switched on, and stiffened
void counts_of_instructions(BenchBook& book, const std::string& counter);  // what is off is free
Table counts_of_single_machines(const std::string& counter);  // right-hand side, Jacobian, step of ten scenes
void ratios_to_hand_written(BenchBook& book);                 // R1, R2b, E1 by dop853 beside the loops by hand, in turn
void advice_on_scenes(BenchBook& book);                       // within 5, 1 and 0.1 %, with what was held out
void costs_of_elements(BenchBook& book);                      // per evaluation, and events a second
void costs_of_mechanisms();  // elements: table against closed form, extraction, multibody
void costs_of_modes();       // growth of the eigenvalue problem
void costs_of_steady_cycles();
// What a sweep costs over bare runs, two threads over two processes, a shell loop over it; `program`: kurbel itself.
void rates_of_sweeps(BenchBook& book, const std::string& program);
// Every verb against the settled run of every scene whose name holds `only`: half 0 steady, reduce, size; half 1 modes,
// forces, advise. Writes FOLDER/agreement.md or agreement_of_vibrations.md, too. Throws std::invalid_argument in words.
void agreement_of_verbs(BenchBook& book, int half, const std::string& only, int jobs, const std::string& folder);
// Families or cases whose names hold `only` ("": all), with at most this much processor time an integration [s];
// heavy ones take what they need.
void hard_cases(BenchBook& book, const std::string& only, double budget);

}  // namespace kurbel::bench
