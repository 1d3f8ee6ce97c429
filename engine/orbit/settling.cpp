// settling.cpp — edges of windows, sequences and laws ahead of a state; rates over rated values.
#include "engine/orbit/settling.h"

#include <algorithm>
#include <cmath>

#include "engine/events/operating_sequence.h"
#include "engine/numerics/index.h"
#include "engine/orbit/follow_period.h"

namespace kurbel {
namespace {

constexpr double no_edge = 1e299;

}  // namespace

double switched_until(const Model& m, const Periodicity& period, const State& state) {
  double until = period.settled_from;
  for (std::size_t i = 0; i < m.network.elements.size(); ++i) {
    const Network::ShaftElement& e = m.network.elements[i];
    for (const double edge : {e.window.start, e.window.stop})
      if (edge < no_edge) until = std::max(until, edge);
    const bool repeats = m.scene.sequence.repeat && m.command_of(e.component) >= 0;
    if (e.element->is.starts_anew && !repeats)
      until = std::max(until, state.modes.on_since[i] + e.element->settled_from);
  }
  for (const PrescribedSpeed& given : m.network.prescribed)
    if (!given.time.empty()) until = std::max(until, given.time.back());
  const Sequence& sequence = m.scene.sequence;
  if (sequence.repeat) {
    const SequenceStep& first = sequence.steps.front();
    return first.when == SequenceStep::When::at ? std::max(until, first.value) : until;
  }
  for (const Command& c : state.modes.command)  // a periodic law is part of the periodic motion
    if (!c.holds_still() && !(c.law >= 0 && sequence.steps[at(c.law)].law.period() > 0))
      until = std::max(until, c.until);
  if (state.modes.next_step < sequence.steps.size() && state.modes.armed_time < no_edge)
    until = std::max(until, state.modes.armed_time);
  return until;
}

bool waits_for_angle(const Model& m, const Modes& modes) {
  const Sequence& sequence = m.scene.sequence;
  return modes.next_step < sequence.steps.size() && sequence.steps[modes.next_step].when == SequenceStep::When::angle;
}

bool has_own_period(const Model& m, const Periodicity& period, bool clocked) {
  const bool swings = std::any_of(m.network.prescribed.begin(), m.network.prescribed.end(),
                                  [](const PrescribedSpeed& p) { return p.amplitude != 0; });
  const bool driven = std::any_of(m.network.elements.begin(), m.network.elements.end(),
                                  [](const Network::ShaftElement& e) { return e.element->time_period > 0; });
  const Sequence& sequence = m.scene.sequence;
  return repeats_freely(sequence, clocked) || (!period.angle_matters && !swings && !driven && sequence.every == 0);
}

Pace pace_of(Equations& equations, const State& state) {
  const Model& m = equations.model();
  Pace pace;
  std::vector<double> y = state.y, rate(equations.size());
  y.resize(equations.size(), 0.0);
  equations.bind(state.modes);
  equations.flow(state.t, y, rate);
  for (std::size_t s = 0; s < m.shafts.size(); ++s)
    pace.speed = std::max(pace.speed, std::abs(equations.snapshot(state.t, y).now.speed[s]) / m.shafts[s].speed_scale);
  const auto consider = [&](std::size_t state, double scale) {
    const double here = std::abs(rate[state]) / (scale * m.speed_scale);
    pace.rate = std::isfinite(here) ? std::max(pace.rate, here) : HUGE_VAL;  // no number where joints jam
  };
  for (std::size_t k = 0; k < m.elastic.size(); ++k)
    if (!m.elastic[k].slips && !m.elastic[k].springless)
      consider(equations.twist_index(static_cast<int>(k)), m.elastic[k].twist_scale);
  for (std::size_t s = 0; s < m.free_shafts; ++s)
    consider(equations.speed_index(static_cast<int>(s)), m.shafts[s].speed_scale);
  for (std::size_t k = 0; k < m.internal_states.size(); ++k)
    consider(equations.internal_begin() + k, m.internal_states[k].state.scale);
  return pace;
}

bool sequence_goes_on(const ReturnMap& map, const Eigen::VectorXd& z) {
  constexpr double never = 1e299;
  const Model& m = map.model();
  const Sequence& sequence = m.scene.sequence;
  if (sequence.repeat || sequence.steps.empty()) return false;
  Equations equations(map.shared_model(), false);
  const std::vector<double> y = map.place(equations, z);
  const std::size_t armed = equations.modes().next_step;
  if (armed >= sequence.steps.size()) return false;
  if (equations.modes().armed_time < never || sequence.steps[armed].when == SequenceStep::When::angle) return true;
  const double* speed = equations.snapshot(map.start_time(), y).now.speed;
  if (OperatingSequence(m).guard(equations.modes(), y, speed) <= 0) return true;
  follow_period(map, z, equations, {.tolerance = 1e-9}, {});
  return equations.modes().next_step != armed;
}

}  // namespace kurbel
