// cycle_of.cpp — the shortest multiple of a turn that is a period of every element.
#include "engine/model/cycle_of.h"

#include <algorithm>
#include <cmath>

#include "engine/numerics/angles.h"
#include "engine/numerics/index.h"

namespace kurbel {
namespace {

constexpr int most_periods = 1000;   // of the first law within a common period
constexpr double same_ratio = 1e-9;  // by which a ratio of periods may miss a fraction

bool meets(double multiple, double period) {
  const double ratio = multiple / period;
  return std::round(ratio) >= 1 && std::abs(ratio - std::round(ratio)) <= same_ratio * ratio;
}

}  // namespace

CommonPeriod common_period(const std::vector<double>& periods) {
  const double first = periods.front();
  for (int k = 1; k <= most_periods; ++k)
    if (std::all_of(periods.begin(), periods.end(), [&](double p) { return meets(k * first, p); }))
      return {k * first, 0};
  CommonPeriod none{0, periods.size() - 1};
  for (std::size_t i = 0; i < periods.size(); ++i) {
    bool ever = false;
    for (int k = 1; k <= most_periods && !ever; ++k) ever = meets(k * first, periods[i]);
    if (!ever) none.odd = i;
  }
  return none;
}

// The shortest multiple of a turn after which every element and joint that depends on an angle is back.
CyclePeriod cycle_of(const Model& m) {
  std::vector<double> period;
  for (const Network::ShaftElement& e : m.network.elements)
    if (e.element->is.uses_angle && e.element->angle_period > 0)
      period.push_back(e.element->angle_period / m.scale_ratio[at(e.node)]);
  for (const ElasticJoint& e : m.elastic) {
    const Network::Joint& joint = m.network.joints[at(e.joint)];
    if (joint.element->is.uses_angle) period.push_back(turn / m.scale_ratio[at(joint.a)]);
  }
  const double of_laws = period.empty() ? 0 : common_period(period).value;
  period.insert(period.begin(), turn);
  if (const CommonPeriod common = common_period(period); common.value > 0) return {common.value, true, of_laws};
  return {meets(m.cycle, turn) ? m.cycle : turn, false, of_laws};
}

}  // namespace kurbel
