// run.h — integrates a model from its start to its end: steps, events, and whoever watches.
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

// What the loop remembers from one event to the next.
struct LoopMemory {
  struct Recent {
    double time = 0;
    std::vector<std::size_t> fired;
    bool operator==(const Recent&) const = default;
  };
  bool implicit = false;                  // "auto" was at its implicit method
  double last_event = -1, last_jam = -1;  // [s]
  int events_here = 0, jams_here = 0;     // at one instant
  double shortened = 0, last_step = 0;    // [s]
  std::deque<Recent> recent;              // events, where they may find no rest
  int held_needed = 200;                  // explicit steps that stability holds before implicit ones are tried
  bool operator==(const LoopMemory&) const = default;
};

// Where a run can go on, here or in another process: the state, what the audit has integrated so far, the loop's memory
// and the observers'. Whoever goes on starts the stepper anew, so that all who do take the same steps, to the last bit.
struct Checkpoint {
  State state;
  std::vector<double> integrals;  // as the equations order them; empty without an audit
  LoopMemory loop;
  std::vector<std::vector<double>> observers;  // in their order; empty: whoever goes on observes from here on only
  bool operator==(const Checkpoint&) const = default;
};

// A state to begin at; the equations' modes must belong to it.
struct RunStart {
  double t = 0;
  std::vector<double> y;
};

// Integrated along with the equations, whose states come first: sensitivities.
class RunExtension : public OdeSystem {
 public:
  virtual ErrorControl error_control(double tolerance) const = 0;
  // Just before and just after the modes change at an event.
  virtual void before_event(double t, std::span<const double> y, const std::vector<std::size_t>& fired) = 0;
  virtual void after_event(double t, std::span<double> y) = 0;
};

struct RunOptions {
  double tolerance = 1e-8;           // local, over the scale of each state
  std::string method = "auto";       // auto or one that method_named() knows
  double until = 1;                  // [s]
  double budget = 300;               // processor time [s]
  std::int64_t most_flow_calls = 0;  // 0: no limit; a search that tries states far off sets one
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(double fraction)> progress;
  std::shared_ptr<WorkTables> work_tables = nullptr;  // of the model, where runs share them; null: made when needed
  // Begins here rather than where the scene says.
  std::optional<RunStart> from = {};
  const Checkpoint* checkpoint = nullptr;  // or goes on there
  // Its end must be one to go on from, observers' memory included: "auto" takes no method over the angle.
  bool to_go_on = false;
  // Ends where this falls through zero (of order one), located exactly; it must not begin at zero.
  std::function<double(double t, std::span<const double> y)> stop = {};
  RunExtension* extension = nullptr;
  double accuracy = 0;  // that the tolerance was made from, for advice in words; 0: the scene's
  // To confirm another run: "auto" chooses among methods that the usual choice does not take, and steps end at other
  // angles where angles hold them.
  bool elsewhere = false;
};

struct RunStatistics {
  StepperStatistics stepper;
  std::int64_t events = 0;
  double smallest_step = 0;  // of those that no event, edge or end cut short [s]; 0: none
  double cpu_seconds = 0;
  std::string method;                // what ran
  std::string reason;                // and why
  std::vector<LimitedSteps> limits;  // what kept the steps short, ranked; where a study asks
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
  // The state at a time within the step; valid until the next call.
  std::span<const double> at(double time);
  double at(double time, std::size_t state);
  const Snapshot& snapshot(double time) { return equations_.snapshot(time, at(time)); }
  Equations& equations() { return equations_; }
  // The step is the first one after the start, an event or an edge: what was seen at its begin before may have jumped.
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
  // At the start; also where a run goes on, after the memory of what was before.
  virtual void begin(double /*t*/, std::span<const double> /*y*/, Equations&) {}
  virtual void step(StepView& view) = 0;
  // Passes all that further steps build on, for a checkpoint.
  virtual void remember(Tape&) {}
};

struct RunOutcome {
  bool complete = false;
  bool stopped = false;   // at the zero of RunOptions::stop
  std::string diagnosis;  // of an incomplete run: when, where, why, what happened last, what to try
  double t = 0;
  std::vector<double> state;
  std::vector<Event> events;
  std::vector<std::string> regularised;  // what lost its events because they found no rest
  std::vector<std::string> held;         // what stands at the end: by whom, and what is missing to move on
  RunStatistics statistics;
  StepLimits limits;
  Checkpoint checkpoint;  // at the end, of a run that is complete
};

// Never throws for a run that fails on its way: the outcome says so and keeps what was computed.
// Throws std::invalid_argument for an unknown method, for the work equation where it does not apply, and for a checkpoint
// whose observers were others.
RunOutcome integrate(Equations& equations, const RunOptions& options, const std::vector<Observer*>& observers);

}  // namespace kurbel
