// deviation.cpp — change and error of every figure against a tolerance.
#include "studies/advise/deviation.h"

#include <fmt/format.h>

#include <algorithm>

namespace kurbel {

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

}  // namespace kurbel
