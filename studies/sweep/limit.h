// limit.h — a limit on a figure, and whether a variant meets it: "delta.press <= 0.05", "peak_torque.c1 < 2 kN*m".
#pragma once

#include <string>
#include <vector>

#include "studies/sweep/store.h"

namespace kurbel {

struct FigureLimit {
  std::size_t figure = 0;
  bool from_above = true;  // upper limit
  double value = 0;        // SI
  std::string given = {};
};

// Undecided: the value is within its error of the limit.
enum class Side { holds, undecided, beyond, unknown };
Side side_of(const FigureLimit& limit, const SweepRow& row);

// For people, with ≤ and ≥: "delta.press ≤ 0.05".
std::string limit_in_words(std::string given);

// Throws std::invalid_argument with the reason: no such figure, another unit.
FigureLimit parse_limit(const std::string& text, const std::vector<SweptFigure>& figures);

// 95 % confidence interval of the probability for k successes in n trials (Clopper, Pearson 1934).
struct Interval {
  double low = 0, high = 1;
};
Interval clopper_pearson(std::size_t successes, std::size_t trials, double confidence = 0.95);

// Number of rows by side.
struct LimitCount {
  std::string limit;
  std::size_t holds = 0, undecided = 0, beyond = 0, unknown = 0;
  Interval interval = {};  // 95 %, of the probability that it holds
  std::size_t decided() const { return holds + beyond + undecided; }
  void take_up(Side side);
  // Sets the interval for the number of trials; undecided ones may hold or not: it covers both.
  void end(std::size_t trials);
};

}  // namespace kurbel
