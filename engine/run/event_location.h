// event_location.h — locates the guards that fall through zero within a step; the step is repeated to end on the first
// one.
//
// Guards are functions of (t, y) of order one, positive while their mode holds. They are evaluated at both ends of each
// step; guards that may fall below zero and rise again are found by the cubic through values and slopes.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "engine/run/run.h"

namespace kurbel {

// A guard that is this far below zero (of a scale of one) has fired; one this near above it stands at its root.
inline constexpr double fired_below = -1e-11, at_root = 1e-13;

class EventLocation {
 public:
  // For the guards of the equations, followed by the end of the run.
  EventLocation(Equations& equations, const RunOptions& options, std::size_t states);
  std::size_t guard_count() const { return guard_.size(); }

  // Sets the stepper. A library's method may fail to find a step that ends on an event.
  void watch(Stepper& stepper, bool of_library) { stepper_ = &stepper, of_library_ = of_library; }
  // The stepper begins here.
  void begin(double t, std::span<const double> y);
  // After a step: the fired guards, on which the step now ends; empty for a smooth step. Throws StepFailure.
  std::vector<std::size_t> find();
  // The last guards fired at the begin of the step, which is discarded. take_at_begin() resets it.
  bool at_begin() const { return at_begin_; }
  bool take_at_begin() { return std::exchange(at_begin_, false); }
  // The step is accepted; the next one starts at its end.
  void go_on();

 private:
  struct Below {  // a guard that is negative within the step
    std::size_t guard;
    double t, value;
  };
  void find_guards(double t, std::span<const double> y, std::span<double> g);
  double guard_at(double t, std::size_t which);
  void find_guard_slopes(double t, std::span<const double> y, std::span<const double> ydot, std::span<const double> g,
                         double delta, std::vector<double>& slopes);
  struct Cubic {  // a guard over the step, by its values and slopes at both ends; 0 ≤ x ≤ 1
    double value, slope, b, c;
    double at(double x) const { return value + x * (slope + x * (b + x * c)); }
  };
  Cubic cubic_of(std::size_t guard) const;
  bool add_dips(std::vector<Below>& below);
  std::vector<std::size_t> locate();
  std::vector<std::size_t> fired_at_edge();
  bool try_to_land_on(double t, std::size_t guard);
  void land_on(double t, std::size_t guard);

  Equations& equations_;
  const RunOptions& options_;
  std::size_t states_;
  Stepper* stepper_ = nullptr;
  bool of_library_ = false;
  std::vector<double> guard_, guard_before_, guard_slope_, guard_slope_before_, probe_, work_;
  bool slopes_known_ = false;  // guard_slope_before_ is that of the step's begin
  bool may_dip_;               // some guard may fall below zero and rise again within a step
  bool at_begin_ = false;
};

// Guards that stand at their root here and fall as soon as the motion goes on: what a run finds at the begin of its next
// step, by a step as it takes them.
std::vector<std::size_t> fall_at_once(Equations& equations, double t, std::span<const double> y);

}  // namespace kurbel
