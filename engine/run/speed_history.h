// speed_history.h — last time at which the reduction link's speed was outside a band that is known only at the end of the
// run.
//
// The last time below any level x is in a stretch whose minimum is not reached by later stretches: a stack with minima
// increasing towards the end. The same for maxima. In steady motion stretches replace earlier ones, so that the memory
// grows with run-up and drift, by a few stretches per cycle at most, not with the length of the run. Each stretch is the
// dense output of the solver over one step, as the polynomial through nine Chebyshev points. A run that repeats another one
// knows roughly which levels will be requested: steps that stay away from them are kept by their ends.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/events/event.h"
#include "engine/run/run.h"
#include "engine/run/sources.h"

namespace kurbel {

// Driving, useful, harmful work and work of weights, by Account [J].
using Works = std::array<double, 4>;

class BandHistory {
 public:
  static constexpr std::size_t points = 9;
  // A smooth stretch of the curve; values at centre − cos(k π/8) half-widths.
  struct Stretch {
    double begin = 0, end = 0;  // [s]
    std::array<double, points> value{};
    double lowest = 0, lowest_at = 0, highest = 0, highest_at = 0;
    // Works from the start of the run, summed by kind, at every other point [J].
    std::array<Works, points / 2 + 1> work{};
    double at(double t) const;
    Works work_at(double t) const;
    double time(std::size_t point) const;
    void find_extremes();
    void remember(Tape& tape) { tape(begin, end, value, lowest, lowest_at, highest, highest_at, work); }
  };

  void add(const Stretch& stretch);
  // Appends a later history.
  void append(const BandHistory& later);
  void clear();
  bool empty() const { return low_.empty(); }
  double end() const { return low_.back().end; }
  double last() const { return low_.back().value.back(); }
  std::size_t size() const { return low_.size() + high_.size(); }
  void remember(Tape& tape) { tape(low_, high_); }
  // Time from which the curve stays within [low, high]; empty: it was never outside. If it jumps in, the time of the jump;
  // end() if it ends outside.
  std::optional<double> last_outside(double low, double high) const;
  const std::vector<double>& asked() const { return asked_; }  // the levels of all calls of last_outside()
  // The stored stretch that contains this time, such as a result of last_outside(); null: none.
  const Stretch* stretch_at(double t) const;

 private:
  std::vector<Stretch> low_, high_;  // increasing minima, decreasing maxima
  mutable std::vector<double> asked_;
};

// When the reduction link's speed was last above 1 %, 0.1 % and a billionth of its usual one [s].
struct LastSpeeds {
  double hundredth = 0, thousandth = 0, motion = 0;
};

// Rest: the speed stays below 0.1 % of the usual one for good; or, where dry friction ends the motion, the event with which
// it holds. That event is the first hold of the link after its speed was last above 1 %; the speed is below 0.1 % for good
// by then. A constant deceleration takes a ninth of the time between these two for the rest of the way. With α = a + b ω it
// takes at most ln 2/ln(11/2) of that time where friction is the greater part at 0.1 %, b ω ≤ a; else the machine was slow
// before it was stopped. A hold before the last 0.1 % ends an oscillation, and no motion.
// Null: the machine rests when it is slow. The link is held by its own shaft's contact, by losses of a gear of two shafts on
// it, or by a hold elsewhere that ends its motion: from a billionth to zero takes 11e-6/9 of the time between 1 % and 0.1 %
// at most.
inline const Event* rest_of(const EventLog& events, const LastSpeeds& last, const Model& m) {
  constexpr double longest = 0.4066, rounding = 1e-12, at_once = 1.3e-6;  // ln 2/ln 5.5, 11e-6/9
  const int shaft = m.shaft_of_node[static_cast<std::size_t>(m.reduction_node)];
  const double slowing = last.thousandth - last.hundredth;
  const auto on_link = [&](const Event& e) {
    if (e.kind == EventKind::rest)
      return e.component == m.node_label(m.shafts[static_cast<std::size_t>(shaft)].reference);
    return std::any_of(m.network.relations.begin(), m.network.relations.end(), [&](const Network::Relation& r) {
      return r.component == e.component && r.members() == 2 && std::any_of(r.node.begin(), r.node.end(), [&](int node) {
               return node >= 0 && m.shaft_of_node[static_cast<std::size_t>(node)] == shaft;
             });
    });
  };
  const auto ends_motion = [&](double t) {
    return std::abs(t - last.motion) <= at_once * slowing + rounding * last.motion;
  };
  const auto rest = std::find_if(events.begin(), events.end(), [&](const Event& e) {
    return (e.kind == EventKind::held || e.kind == EventKind::rest) && e.t >= (1 - rounding) * last.hundredth &&
           (on_link(e) || ends_motion(e.t));
  });
  const double latest = last.thousandth + longest * slowing + rounding * last.thousandth;
  return rest != events.end() && rest->t >= (1 - rounding) * last.thousandth && rest->t <= latest ? &*rest : nullptr;
}

// Observes the reduction link: its speed while something drives and after that, and its angle at equal intervals.
class SpeedRecorder final : public Observer {
 public:
  // A run that repeats the one of `before`, closely: empty where there is none.
  explicit SpeedRecorder(double until, const SpeedRecorder* before = nullptr) : until_(until) {
    if (before) levels_ = before->asked();
  }
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(on_, driven_, coasting_, off_since_, works_off_, angles_); }

  // Up to the time at which the last driving source was switched off finally; else the whole run.
  const BandHistory& driven() const { return driven_.empty() ? coasting_ : driven_; }
  const BandHistory& coasting() const { return coasting_; }
  // Empty: something drives to the end, or nothing ever drove.
  std::optional<double> off_since() const { return driven_.empty() ? std::nullopt : off_since_; }
  // Works up to a time of final entry into a band, or to off_since(); empty at other times, or without an audit.
  std::optional<Works> works_at(double t) const;
  // Angles including full turns [rad] at multiples of interval() from the start; only for machines without a cycle.
  const std::vector<double>& angles() const { return angles_; }
  std::vector<double> asked() const;
  // All requested levels are near those requested in the run before; else this run is to be repeated without it.
  bool answered() const;
  double interval() const { return until_ / grid; }

 private:
  static constexpr int grid = 512;
  bool is_driven(StepView& view) const;
  BandHistory::Stretch stretch_of(StepView& view) const;
  bool stays_away(StepView& view) const;  // from the levels of the run before
  BandHistory::Stretch ends_of(StepView& view) const;
  double speed_at(StepView& view, double t) const;

  double until_;
  std::size_t shaft_ = 0, angle_ = 0;
  double gain_ = 1;
  bool free_ = true;  // the link's speed is a state, not prescribed
  std::optional<Sources> sources_;
  bool on_ = true;
  BandHistory driven_, coasting_;
  std::optional<double> off_since_;
  bool audited_ = false;
  Works works_off_{};  // up to off_since_
  std::vector<double> angles_;
  std::optional<std::vector<double>> levels_;  // of the run before
};

}  // namespace kurbel
