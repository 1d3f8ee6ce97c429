// cycle_of.cpp — the shortest multiple of a turn that is a period of every element.
#include "engine/model/cycle_of.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int most_turns = 24;  // of a cycle

}  // namespace

// The shortest multiple of a turn after which every element that depends on an angle is back.
CyclePeriod cycle_of(const Model& m) {
  std::vector<double> period;  // on the link
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.element->is.uses_angle) period.push_back(e.element->angle_period / m.scale_ratio[at(e.node)]);
  const auto repeats = [&](double cycle) {
    return std::all_of(period.begin(), period.end(),
                       [&](double p) { return std::abs(cycle / p - std::round(cycle / p)) < 1e-9; });
  };
  for (int turns = 1; turns <= most_turns; ++turns)
    if (repeats(turns * turn)) return {turns * turn, true};
  return {m.cycle > 0 ? m.cycle : turn, false};
}

}  // namespace kurbel
