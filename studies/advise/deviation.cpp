// deviation.cpp — change and error of every figure against a tolerance.
#include "studies/advise/deviation.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "studies/steady/cycle_search.h"

namespace kurbel {
namespace {

bool is_compared(const Figure& figure) {
  return figure.scale > 0 &&
         is_one_of(figure.what,
                   {quantities::delta, quantities::mean_speed, quantities::mid_speed, quantities::cycle_max_speed,
                    quantities::cycle_min_speed, quantities::cycle_peak_torque, quantities::cycle_rms_torque,
                    quantities::peak_drive_torque, quantities::mean_drive_torque, quantities::rms_drive_torque});
}

bool is_asked(const Figure& figure, const std::vector<std::string>& figures) {
  const std::string in_cycle = "cycle_";
  const std::string plain = figure.name.starts_with(in_cycle) ? figure.name.substr(in_cycle.size()) : figure.name;
  return figures.empty() || is_asked_for(plain, figures);
}

}  // namespace

Deviation deviation_of(const std::vector<FigureChange>& changes, double tolerance) {
  Deviation found;
  double bound = 0;
  for (const FigureChange& change : changes) {
    if (change.error > tolerance && change.sure() <= tolerance) {
      found.not_judged.push_back(fmt::format("{} (known to {:.2g} %)", change.figure, 100 * change.error));
      continue;
    }
    if (change.relative >= found.deviation) found.deviation = change.relative, found.figure = change.figure;
    bound = std::max(bound, change.relative + change.error);
  }
  found.error = bound - found.deviation;
  found.within = bound <= tolerance;
  return found;
}

VariantRun settled(const Scene& scene, const Effects& effects, const Watch& watch) {
  VariantRun found;
  SteadyOptions options;
  options.start_search = false;
  options.watch.interrupted = watch.interrupted;
  try {
    SteadyCycle cycle = search_cycle(scene, effects, options);
    found.result.figures = std::move(cycle.figures);
    found.result.tolerance = 1e-10;  // of the looser search
    if (!cycle.found) found.failed = cycle.why;
  } catch (const std::invalid_argument& none) {
    found.failed = none.what();
  }
  return found;
}

Deviation settled_deviation(const Result& full, const Result& lean, const std::vector<std::string>& figures,
                            double tolerance) {
  std::vector<std::string> names;
  for (const Figure& f : full.figures)
    if (is_compared(f) && is_asked(f, figures)) names.push_back(f.name);
  if (names.empty()) return {};
  return deviation_of(changes_between(full, lean, names), tolerance);
}

Deviation worse_of(const Deviation& a, const Deviation& b) {
  Deviation worse = b.deviation > a.deviation ? b : a;
  worse.error = std::max(a.deviation + a.error, b.deviation + b.error) - worse.deviation;
  worse.within = a.within && b.within;
  worse.not_judged = a.not_judged;
  worse.not_judged.insert(worse.not_judged.end(), b.not_judged.begin(), b.not_judged.end());
  return worse;
}

}  // namespace kurbel
