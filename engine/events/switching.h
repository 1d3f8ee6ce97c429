// switching.h — changes at known times and by command: windows of time, laws over time, the operating sequence.
#pragma once

#include <span>
#include <vector>

#include "engine/equations/flow.h"
#include "engine/events/event.h"
#include "engine/events/operating_sequence.h"

namespace kurbel {

class Switching {
 public:
  // Changes the modes of this flow, which must outlive it.
  explicit Switching(Flow& flow) : flow_(flow), sequence_(flow.model()) {}
  bool has_sequence() const { return sequence_.any(); }

  // At a start: no commands are given; the first step is armed or, if due, executed.
  void begin(double t, std::span<double> y);
  // Sets pieces and windows for this time and the present commands.
  void set_timed_modes(double t);
  // Executes the step that is due, and the steps that follow it at once. Commands switch elements on and off; a circuit
  // that opens or closes changes its currents at once.
  void take_steps(double t, std::span<double> y, EventLog* log);
  // Executes all changes due at this time.
  void pass_edge(double t, std::span<double> y, EventLog& log);
  // Time of the next change [s]; infinite: none.
  double next_edge(double t) const;
  // Positive until the armed step's angle or speed is reached; of order one.
  double guard(std::span<const double> y, const double* speed) const {
    return sequence_.guard(flow_.modes(), y, speed);
  }

 private:
  void report_switched(double t, std::span<double> y, const std::vector<char>& before);

  Flow& flow_;
  OperatingSequence sequence_;
};

}  // namespace kurbel
