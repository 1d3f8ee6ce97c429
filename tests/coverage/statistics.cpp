// statistics.cpp — shares, resampled bounds, quantiles.
#include "tests/coverage/statistics.h"

#include <algorithm>
#include <cmath>

#include "tests/coverage/variant_text.h"

namespace kurbel::coverage {
namespace {

struct Tally {
  long covered = 0, judged = 0;
};

constexpr int resamplings = 2000;
constexpr double one_sided = 0.05;

double lower_bound(const std::vector<Tally>& runs) {
  if (runs.empty()) return 0;
  Dice dice(20260101);
  std::vector<double> shares;
  for (int k = 0; k < resamplings; ++k) {
    Tally sum;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Tally& drawn = runs[dice.index(runs.size())];
      sum.covered += drawn.covered;
      sum.judged += drawn.judged;
    }
    shares.push_back(static_cast<double>(sum.covered) / static_cast<double>(sum.judged));
  }
  std::sort(shares.begin(), shares.end());
  return shares[static_cast<std::size_t>(one_sided * resamplings)];
}

}  // namespace

Share share_of(const std::vector<MeasuredVariant>& variants, const OfRun& run, const OfFigure& figure,
               const VerdictOf& verdict) {
  std::vector<Tally> runs;
  Share share;
  for (const MeasuredVariant& v : variants) {
    if (!v.whole || !run(v)) continue;
    Tally tally;
    for (const JudgedFigure& f : v.figures) {
      if (!figure(f)) continue;
      tally.covered += verdict(f) == Verdict::covered;
      tally.judged += verdict(f) == Verdict::covered || verdict(f) == Verdict::missed;
    }
    if (tally.judged == 0) continue;
    runs.push_back(tally);
    share.covered += tally.covered;
    share.judged += tally.judged;
  }
  share.runs = static_cast<long>(runs.size());
  share.lower = lower_bound(runs);
  return share;
}

std::vector<double> ratios_of(const std::vector<MeasuredVariant>& variants) {
  std::vector<double> ratios;
  for (const MeasuredVariant& v : variants)
    for (const JudgedFigure& f : v.figures) {
      if (!every_figure(f) || (f.verdict != Verdict::covered && f.verdict != Verdict::missed)) continue;
      const double least = std::max(f.error(), f.uncertainty);
      if (least > 0) ratios.push_back(f.stated / least);
    }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

double quantile(const std::vector<double>& ascending, double q) {
  if (ascending.empty()) return 0;
  const double place = q * static_cast<double>(ascending.size() - 1);
  return ascending[static_cast<std::size_t>(std::lround(place))];
}

double Miss::factor() const { return figure->stated > 0 ? figure->error() / figure->stated : HUGE_VAL; }

std::vector<Miss> misses_of(const std::vector<MeasuredVariant>& variants) {
  std::vector<Miss> misses;
  for (const MeasuredVariant& v : variants)
    for (const JudgedFigure& f : v.figures)
      if (every_figure(f) && f.verdict == Verdict::missed) misses.push_back({&v, &f});
  std::stable_sort(misses.begin(), misses.end(), [](const Miss& a, const Miss& b) { return a.factor() > b.factor(); });
  return misses;
}

}  // namespace kurbel::coverage
