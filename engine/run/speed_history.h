// speed_history.h — when was the reduction link's speed outside a band for the last time? Of a band that only the end
// of the run tells.
//
// The last time below a level x is, for every x, in one of those stretches whose minimum no later stretch goes below:
// ever higher minima towards the end, kept as a stack. The same for maxima. Steady motion takes its own stretches off
// again, so that memory grows with run-up and drift, by a few stretches a cycle at most, not with the length of the
// run. Each stretch is the solver's own dense output over one step, as the polynomial through nine of Chebyshev's
// points.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/run/run.h"
#include "engine/run/sources.h"

namespace kurbel {

// Driving, useful, harmful work, that of weights, by Account [J].
using Works = std::array<double, 4>;

class BandHistory {
 public:
  static constexpr std::size_t points = 9;
  // A smooth stretch of the curve; values at centre − cos(k π/8) half-widths.
  struct Stretch {
    double begin = 0, end = 0;  // [s]
    std::array<double, points> value{};
    double lowest = 0, lowest_at = 0, highest = 0, highest_at = 0;
    // Works from the start of the run on, summed up by their kind, at every other of the points [J].
    std::array<Works, points / 2 + 1> work{};
    double at(double t) const;
    Works work_at(double t) const;
    double time(std::size_t point) const;
    void find_extremes();
    void remember(Tape& tape) { tape(begin, end, value, lowest, lowest_at, highest, highest_at, work); }
  };

  void add(const Stretch& stretch);
  // What followed in time.
  void append(const BandHistory& later);
  void clear();
  bool empty() const { return low_.empty(); }
  double end() const { return low_.back().end; }
  double last() const { return low_.back().value.back(); }
  std::size_t size() const { return low_.size() + high_.size(); }
  void remember(Tape& tape) { tape(low_, high_); }
  // The curve stays within [low, high] from here on; nothing: it never was outside. Where it jumps in, the time of the
  // jump; end() where it ends outside.
  std::optional<double> last_outside(double low, double high) const;
  // Of those that are kept, the stretch with this time in it, as that of every entry found above; null: none.
  const Stretch* stretch_at(double t) const;

 private:
  std::vector<Stretch> low_, high_;  // ever higher minima, ever lower maxima
};

// Follows the reduction link: its speed while something drives and after that, and its angle at equal times.
class SpeedRecorder final : public Observer {
 public:
  explicit SpeedRecorder(double until) : until_(until) {}
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override { tape(on_, driven_, coasting_, off_since_, works_off_, angles_); }

  // Up to the time at which the last driving source went off for good; all of the run where none did.
  const BandHistory& driven() const { return driven_.empty() ? coasting_ : driven_; }
  const BandHistory& coasting() const { return coasting_; }
  // Nothing: something drives to the end, or nothing ever drove.
  std::optional<double> off_since() const { return driven_.empty() ? std::nullopt : off_since_; }
  // Up to a time at which a band was entered for good, or to off_since(); none at another one, or without an audit.
  std::optional<Works> works_at(double t) const;
  // Angles with turns counted [rad] at multiples of interval() from the start on; only of machines without a cycle.
  const std::vector<double>& angles() const { return angles_; }
  double interval() const { return until_ / grid; }

 private:
  static constexpr int grid = 512;
  bool is_driven(StepView& view) const;
  BandHistory::Stretch stretch_of(StepView& view) const;
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
};

}  // namespace kurbel
