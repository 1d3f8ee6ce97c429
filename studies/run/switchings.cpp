// switchings.cpp — switchings are read from the modes, steps from the laws.
#include "studies/run/switchings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/events/equations.h"
#include "engine/model/model.h"
#include "engine/numerics/index.h"
#include "engine/return_map/periodicity.h"
#include "studies/duty/work_periods.h"

namespace kurbel {
namespace {

constexpr double off = -1e300, rounding = 1e-12;

// From where on a law without period keeps its last value.
double constant_from(const Curve& law) {
  std::size_t k = law.x().size() - 1;
  const auto ends_at = [&](std::size_t piece) {
    const double middle = 0.5 * (law.x()[piece] + law.x()[piece + 1]), last = law.y().back();
    return law.y()[piece] == last && law.end_value(piece) == last &&
           law.value_in(static_cast<int>(piece), middle) == last;
  };
  while (k > 0 && ends_at(k - 1)) --k;
  return law.x()[k];
}

bool drives(const Model& m, std::size_t command) {
  const std::string& component = m.commands[command].component;
  return std::any_of(m.network.elements.begin(), m.network.elements.end(),
                     [&](const Network::ShaftElement& e) {
                       return e.component == component && e.element->account == Account::driving;
                     }) ||
         std::any_of(m.network.prescribed.begin(), m.network.prescribed.end(),
                     [&](const PrescribedSpeed& given) { return given.command == static_cast<int>(command); });
}

const Curve* law_of(const Model& m, const Command& c) {
  return c.law < 0 ? nullptr : &m.scene.sequence.steps[at(c.law)].law;
}

// What a command comes to.
double goal_of(const Model& m, const Command& c) {
  const Curve* law = law_of(m, c);
  return law ? law->y().back() : c.to;
}

// Where one section ends, and the next one begins.
struct Border {
  double t = 0, begin = 0;  // [s]
  bool starts = false;      // a drive, from t to begin
};

// A law of few points is made of steps and ramps, each of which begins another motion; many points are one motion.
constexpr std::size_t few = 8;

void add_edges(const Model& m, double end, std::vector<Border>& borders) {
  const auto next = [&](double t) {
    double edge = HUGE_VAL;
    for (const auto& pool : m.pools) edge = std::min(edge, pool->next_edge(t));
    return edge;
  };
  std::vector<Border> steps;
  for (double t = next(0); t < end && steps.size() <= few; t = next(t)) steps.push_back({t, t});
  if (steps.size() <= few) borders.insert(borders.end(), steps.begin(), steps.end());
}

// Of each piece in which the speed is not constant.
void add_prescribed(const PrescribedSpeed& given, double end, std::vector<Border>& borders) {
  const std::vector<double>& t = given.law.empty() ? given.time : given.law.x();
  const std::vector<double>& speed = given.law.empty() ? given.speed : given.law.y();
  if (given.command >= 0 || given.period() > 0 || t.size() > few) return;
  for (std::size_t k = 0; k + 1 < t.size() && t[k] < end; ++k)
    if (speed[k + 1] != speed[k] || (!given.law.empty() && given.law.end_value(k) != speed[k]))
      borders.push_back({t[k], t[k + 1], std::abs(speed[k + 1]) > std::abs(speed[k])});
}

}  // namespace

void SwitchingRecorder::remember(Tape& tape) {
  tape(all_);
  goes_on_ = tape.reading();
}

void SwitchingRecorder::begin(double t, std::span<const double> /*y*/, Equations& equations) {
  on_since_.assign(equations.model().network.elements.size(), off);
  command_.clear();
  for (const Command& c : equations.modes().command) {
    const double value = c.at(t, equations.model().scene.sequence);
    command_.push_back({.value = value, .to = value});
  }
  look(t, equations, !goes_on_);
}

void SwitchingRecorder::look(double t, const Equations& equations, bool count) {
  const Model& m = equations.model();
  const Modes& modes = equations.modes();
  for (std::size_t e = 0; e < on_since_.size(); ++e) {
    const auto& element = *m.network.elements[e].element;
    const double since = modes.active[e] ? modes.on_since[e] : off;
    if (on_since_[e] != off && since != on_since_[e]) break_off(static_cast<int>(e), t, false);
    if (count && element.is.starts_anew && element.settled_from > 0 && since != off && since != on_since_[e])
      all_.push_back({since, since + element.settled_from, true, static_cast<int>(e)});
    on_since_[e] = since;
  }
  for (std::size_t c = 0; c < command_.size(); ++c) {
    const Command now = modes.command[c], before = std::exchange(command_[c], now);
    const bool comes_to_rest = !before.holds_still() && now.holds_still() && now.value == goal_of(m, before);
    if (now == before || comes_to_rest || (now.law >= 0 && now.law == before.law)) continue;
    const int of = -1 - static_cast<int>(c);
    break_off(of, t, true);
    if (!count) continue;
    const double from = before.at(t, m.scene.sequence), to = goal_of(m, now);
    if (now.holds_still() && to == from) continue;
    const Curve* law = law_of(m, now);
    const double settled = law                 ? (law->period() > 0 ? t : now.from + constant_from(*law))
                           : now.holds_still() ? t
                                               : now.until;
    all_.push_back({t, settled, settled > t && drives(m, c) && (std::abs(to) > std::abs(from) || to * from < 0), of});
  }
}

// What is switched off, or commanded anew, before it is settled.
void SwitchingRecorder::break_off(int of, double t, bool starts) {
  for (Switched& s : all_)
    if (s.of == of && s.settled > t) s.settled = t, s.starts = s.starts && starts;
}

void SwitchingRecorder::step(StepView& view) {
  if (!view.begins_anew()) return;
  const double t = view.t_previous();
  const Equations& equations = view.equations();
  const Model& m = equations.model();
  look(t, equations, !m.scene.sequence.repeat);
  if (!equations.audit()) return;
  for (Switched& s : all_)
    if (!s.work && std::abs(s.settled - t) <= rounding * t)
      s.work = works_by_kind(m, works_done(equations, view.y_previous()));
}

std::optional<std::array<double, 4>> SwitchingRecorder::works_at(double t) const {
  for (const Switched& s : all_)
    if (s.settled == t && s.work) return s.work;
  return {};
}

std::vector<DrivenPart> sections_of(const Model& m, const std::vector<Switched>& switchings, const EventLog& events,
                                    double end) {
  std::vector<Border> borders;
  for (const Switched& s : switchings) borders.push_back({s.t, s.settled, s.starts});
  for (const PrescribedSpeed& given : m.network.prescribed) add_prescribed(given, end, borders);
  for (const Network::ShaftElement& e : m.network.elements)
    if (const double settled = e.element->settled_from; settled > 0 && !e.element->is.starts_anew)
      borders.push_back({settled, settled});
  if (clock_of(m) == 0) add_edges(m, end, borders);  // edges of the clock begin no other motion
  if (!m.scene.sequence.repeat)
    for (const Event& e : events)
      if (e.kind == EventKind::window) borders.push_back({e.t, e.t});
  std::sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) { return a.t < b.t; });
  std::vector<DrivenPart> list{{0, end}};
  for (const Border& border : borders) {
    if (border.t >= end) break;
    const double started = std::max(list.back().started, border.starts ? border.begin : 0);
    list.back().end = border.t;
    list.push_back({std::max(list.back().begin, border.begin), end, started});
  }
  return list;
}

}  // namespace kurbel
