// rainflow.cpp — the rules of ASTM E1049-85, 5.4.4, on a stack of reversals.
#include "studies/history/rainflow.h"

#include <cmath>
#include <deque>

namespace kurbel {
namespace {

std::vector<double> reversals(const std::vector<double>& history, double least) {
  std::vector<double> turns;
  for (const double x : history) {
    const std::size_t n = turns.size();
    if (n >= 2 && (turns[n - 1] - turns[n - 2]) * (x - turns[n - 1]) > 0)
      turns.back() = x;
    else if (n == 0 || std::abs(x - turns.back()) > least)
      turns.push_back(x);
  }
  return turns;
}

LoadCycle cycle(double a, double b, double count) { return {std::abs(a - b), 0.5 * (a + b), count}; }

}  // namespace

std::vector<LoadCycle> rainflow(const std::vector<double>& history, double least) {
  std::vector<LoadCycle> found;
  std::deque<double> points;
  for (const double x : reversals(history, least)) {
    points.push_back(x);
    while (points.size() >= 3) {
      const std::size_t n = points.size();
      const double newest = std::abs(points[n - 1] - points[n - 2]), before = std::abs(points[n - 2] - points[n - 3]);
      if (newest < before) break;
      if (n == 3) {  // Y holds the starting point: half a cycle, and the start moves on
        found.push_back(cycle(points[0], points[1], 0.5));
        points.pop_front();
      } else {  // a full cycle closes within a larger range
        found.push_back(cycle(points[n - 3], points[n - 2], 1));
        points.erase(points.end() - 3, points.end() - 1);
      }
    }
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) found.push_back(cycle(points[i], points[i + 1], 0.5));
  return found;
}

double equivalent_amplitude(const std::vector<LoadCycle>& cycles, double exponent) {
  double largest = 0, sum = 0, count = 0;
  for (const LoadCycle& c : cycles) largest = std::max(largest, c.range);
  if (largest == 0) return 0;
  for (const LoadCycle& c : cycles) {
    sum += c.count * std::pow(c.range / largest, exponent);
    count += c.count;
  }
  return 0.5 * largest * std::pow(sum / count, 1 / exponent);
}

}  // namespace kurbel
