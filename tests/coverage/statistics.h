// statistics.h — how many stated errors cover, with what certainty: figures of one run err together, so whole runs are
// resampled.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/coverage/measure.h"

namespace kurbel::coverage {

struct Share {
  long covered = 0, judged = 0, runs = 0;
  double lower = 0;  // one-sided 95 % bound of the share, by resampling runs; 0 without any
  double share() const { return judged > 0 ? static_cast<double>(covered) / static_cast<double>(judged) : 0; }
};

using OfRun = std::function<bool(const MeasuredVariant&)>;
using OfFigure = std::function<bool(const JudgedFigure&)>;
using VerdictOf = std::function<Verdict(const JudgedFigure&)>;

inline bool every_run(const MeasuredVariant&) { return true; }
inline bool every_figure(const JudgedFigure& f) { return f.kind == JudgedFigure::Kind::value; }
inline bool every_time(const JudgedFigure& f) { return f.kind == JudgedFigure::Kind::time; }
inline Verdict stated_verdict(const JudgedFigure& f) { return f.verdict; }

// Of the figures that were judged: covered or missed. Times and numbers of impacts are requested by themselves.
Share share_of(const std::vector<MeasuredVariant>& variants, const OfRun& run = every_run,
               const OfFigure& figure = every_figure, const VerdictOf& verdict = stated_verdict);

// Stated over true error of all judged figures, ascending; where the truth hides in its own uncertainty, over that.
std::vector<double> ratios_of(const std::vector<MeasuredVariant>& variants);
double quantile(const std::vector<double>& ascending, double q);

struct Miss {
  const MeasuredVariant* variant = nullptr;
  const JudgedFigure* figure = nullptr;
  double factor() const;  // true over stated error
};
// Worst first.
std::vector<Miss> misses_of(const std::vector<MeasuredVariant>& variants);

}  // namespace kurbel::coverage
