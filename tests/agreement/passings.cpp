// passings.cpp — multiples of an angle or of a time, found within the steps.
#include "tests/agreement/passings.h"

#include <algorithm>
#include <cmath>

#include "engine/numerics/index.h"
#include "engine/numerics/roots.h"

namespace kurbel::agreement {

double difference(const Passing& a, const Passing& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.state.size(); ++i) most = std::max(most, std::abs(a.state[i] - b.state[i]));
  return most;
}

double Passings::place(double t, std::span<const double> y, Equations& equations) const {
  return of_ == Of::time ? t : equations.angle_with_turns(at(equations.model().reduction_angle), y);
}

void Passings::begin(double t, std::span<const double> y, Equations& equations) {
  const Model& m = equations.model();
  last_ = std::floor(place(t, y, equations) / base_);
  scale_ = equations.error_control(1).scale;
  looked_at_.clear();
  for (std::size_t j = 0; j < m.elastic.size(); ++j)
    if (!m.elastic[j].slips && !m.elastic[j].springless)
      looked_at_.push_back(equations.twist_index(static_cast<int>(j)));
  for (std::size_t s = 0; s < m.free_shafts; ++s) looked_at_.push_back(equations.speed_index(static_cast<int>(s)));
}

void Passings::take(double t, std::span<const double> y, Equations& equations) {
  const Model& m = equations.model();
  Passing p;
  p.t = t;
  p.angle = equations.angle_with_turns(at(m.reduction_angle), y);
  const Snapshot& s = equations.snapshot(t, y);
  p.speed = m.gain_of_node[at(m.reduction_node)] * s.now.speed[m.shaft_of_node[at(m.reduction_node)]];
  for (const std::size_t i : looked_at_) p.state.push_back(y[i] / scale_[i]);
  if (energies_) p.kinetic_energy = equations.kinetic_energy(t, y);
  list_.push_back(std::move(p));
}

// Forwards or backwards; a step may pass several.
void Passings::step(StepView& view) {
  Equations& equations = view.equations();
  const auto place_at = [&](double t) { return place(t, view.at(t), equations) / base_; };
  const double t0 = view.t_previous(), t1 = view.t();
  const double end = place_at(t1);
  while (std::floor(end) != last_) {
    const bool forwards = end > last_;
    const double multiple = forwards ? last_ + 1 : last_;
    const auto beyond = [&](double t) { return place_at(t) - multiple; };
    const double b0 = beyond(t0), b1 = beyond(t1);
    const double t = (b0 < 0) != (b1 < 0) ? find_root(beyond, t0, b0, t1, b1) : t1;
    const std::span<const double> now = view.at(t);
    take(t, std::vector<double>(now.begin(), now.end()), equations);
    last_ += forwards ? 1 : -1;
  }
}

}  // namespace kurbel::agreement
