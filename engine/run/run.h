// run.h — integrates a model from its start to its end: steps, events, observers.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/events/equations.h"
#include "engine/run/step_limits.h"
#include "engine/run/tape.h"
#include "engine/steppers/stepper.h"

namespace kurbel {

class WorkTables;

// Memory of the loop from one event to the next.
struct LoopMemory {
  struct Recent {
    double time = 0;
    std::vector<std::size_t> fired;
    bool operator==(const Recent&) const = default;
  };
  bool implicit = false;                  // "auto" was using its implicit method
  double last_event = -1, last_jam = -1;  // [s]
  int events_here = 0, jams_here = 0;     // at one instant
  double shortened = 0, last_step = 0;    // [s]
  std::deque<Recent> recent;              // events, to detect chattering
  int held_needed = 20;                   // explicit steps limited by stability before implicit ones are tried
  int held = 0;                           // of them so far
  double explicit_step = 0;               // length at which stability held them [s]
  int implicit_steps = 0;                 // since implicit ones are tried, …
  double implicit_since = 0;              // … from there on, the last few of them …
  double window_begin = 0;                // … from there on [s]
  bool operator==(const LoopMemory&) const = default;
};

// Data for the continuation of a run, here or in another process: the state, integrals of the audit, memory of the loop and
// of the observers. Every continuation restarts the stepper, so that all take the same steps, to the last bit.
struct Checkpoint {
  State state;
  std::vector<double> integrals;  // in the order of the equations; empty without an audit
  LoopMemory loop;
  std::vector<std::vector<double>> observers;  // in their order; empty: the continuation observes only from here
  bool operator==(const Checkpoint&) const = default;
};

// Initial state; the equations must have its modes.
struct RunStart {
  double t = 0;
  std::vector<double> y;
};

// System integrated together with the equations, whose states come first: sensitivities.
class RunExtension : public OdeSystem {
 public:
  virtual ErrorControl error_control(double tolerance) const = 0;
  // Just before and just after the modes change at an event.
  virtual void before_event(double t, std::span<const double> y, const std::vector<std::size_t>& fired) = 0;
  virtual void after_event(double t, std::span<double> y) = 0;
};

struct RunOptions {
  double tolerance = 1e-8;           // local, over the scale of each state
  std::string method = "auto";       // auto or a name of method_named()
  double until = 1;                  // [s]
  double budget = 300;               // processor time [s]
  std::int64_t most_flow_calls = 0;  // limit; 0: none; set by searches with arbitrary states
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(double fraction)> progress;
  std::shared_ptr<WorkTables> work_tables = nullptr;  // of the model, shared by runs; null: made if needed
  // Initial state instead of the start of the scene.
  std::optional<RunStart> from = {};
  const Checkpoint* checkpoint = nullptr;  // or continuation from there
  // The end must allow a continuation, with the memory of observers: "auto" takes no method over the angle.
  bool to_go_on = false;
  // The run ends where this falls through zero (of order one), located exactly; it must not start at zero.
  std::function<double(double t, std::span<const double> y)> stop = {};
  RunExtension* extension = nullptr;
  double accuracy = 0;  // from which the tolerance follows, for advice; 0: that of the scene
  // To confirm another run: "auto" chooses among methods that the usual choice does not use, and steps limited by angles
  // end at other angles.
  bool elsewhere = false;
};

struct RunStatistics {
  StepperStatistics stepper;
  std::int64_t events = 0, knots = 0;  // knots: points between the pieces of a law, passed without an event
  double smallest_step = 0;            // of those not shortened by an event, edge or end [s]; 0: none
  double cpu_seconds = 0;
  std::string method;                // methods used
  std::string reason;                // reason of the choice
  std::vector<LimitedSteps> limits;  // causes of short steps, ranked; only if a study needs them
};

// The state of a run just after an accepted step, for observers. Between t_previous and t the solution is smooth.
class StepView {
 public:
  explicit StepView(Equations& equations, std::size_t size = 0)
      : equations_(equations), size_(size > 0 ? size : equations.size()) {}
  void watch(Stepper& stepper) { stepper_ = &stepper; }
  double t_previous() const { return stepper_->t_previous(); }
  double t() const { return stepper_->t(); }
  std::span<const double> y() const { return stepper_->y(); }
  std::span<const double> y_previous() const { return stepper_->y_previous(); }
  std::span<const double> ydot() const { return stepper_->ydot(); }
  std::span<const double> ydot_previous() const { return stepper_->ydot_previous(); }
  // The state at a time within the step; valid until the next call.
  std::span<const double> at(double time);
  double at(double time, std::size_t state);
  const Snapshot& snapshot(double time) { return equations_.snapshot(time, at(time)); }
  Equations& equations() { return equations_; }
  // The step is the first after the start, an event or an edge: values at its begin may differ from those seen before.
  bool begins_anew() const { return anew_; }
  void set_anew(bool anew) { anew_ = anew; }

 private:
  Equations& equations_;
  std::size_t size_;
  bool anew_ = true;
  Stepper* stepper_ = nullptr;
  std::vector<double> scratch_;
};

class Observer {
 public:
  virtual ~Observer() = default;
  // At the start; also at a continuation, after the memory was restored.
  virtual void begin(double /*t*/, std::span<const double> /*y*/, Equations&) {}
  virtual void step(StepView& view) = 0;
  // Passes all members that later steps depend on, for a checkpoint.
  virtual void remember(Tape&) {}
};

struct RunOutcome {
  bool complete = false;
  bool stopped = false;   // at the zero of RunOptions::stop
  std::string diagnosis;  // of an incomplete run: time, state, reason, last events, remedy
  double t = 0;
  std::vector<double> state;
  std::vector<Event> events;
  std::vector<std::string> regularised;  // elements that lost their events because of chattering
  std::vector<std::string> held;         // held contacts at the end, with the torque missing to move them
  RunStatistics statistics;
  StepLimits limits;
  Checkpoint checkpoint;  // at the end of a complete run
};

// Does not throw if the run fails: the outcome states it and has the results up to there.
// Throws std::invalid_argument for an unknown method, for the work equation if it does not apply, and for a checkpoint
// with other observers.
RunOutcome integrate(Equations& equations, const RunOptions& options, const std::vector<Observer*>& observers);

}  // namespace kurbel
