// limit.h — a limit on a figure, and on which side of it a variant lies: "delta.press <= 0.05", "peak_torque.c1 < 2 kN*m".
#pragma once

#include <string>
#include <vector>

#include "studies/sweep/store.h"

namespace kurbel {

struct FigureLimit {
  std::size_t figure = 0;
  bool from_above = true;  // the figure must lie below it
  double value = 0;        // SI
  std::string given = {};
};

// A figure's value within its error of the limit is undecided.
enum class Side { holds, undecided, beyond, unknown };
Side side_of(const FigureLimit& limit, const SweepRow& row);

// Throws std::invalid_argument in words: no such figure, another unit.
FigureLimit parse_limit(const std::string& text, const std::vector<SweptFigure>& figures);

// Of n trials, k successes: the interval that holds the probability with 95 % (Clopper, Pearson 1934).
struct Interval {
  double low = 0, high = 1;
};
Interval clopper_pearson(std::size_t successes, std::size_t trials, double confidence = 0.95);

// Of rows: how many lie on each side.
struct LimitCount {
  std::string limit;
  std::size_t holds = 0, undecided = 0, beyond = 0, unknown = 0;
  Interval interval = {};  // of the chance that it holds: 95 %
  std::size_t decided() const { return holds + beyond + undecided; }
  void take_up(Side side);
  // The interval of so many trials. Who is undecided may hold or not: it covers both.
  void end(std::size_t trials);
};

}  // namespace kurbel
