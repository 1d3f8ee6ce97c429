// switchings.h — what divides the driven time of a run: commands with their ramps, starters, windows, steps of laws over time.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/equations/state.h"
#include "engine/run/run.h"
#include "engine/run/tape.h"

namespace kurbel {

// Something changes from `t` on and is constant from `settled` on: a command, a starter.
struct Switched {
  double t = 0, settled = 0;  // [s]
  bool starts = false;        // a drive: its starter works, or its command rises along a ramp or a law
  int of = 0;                 // element, or −1 − command
  std::optional<std::array<double, 4>> work = {};  // by Account, up to `settled` [J]
  void remember(Tape& tape) { tape(t, settled, starts, of, work); }
};

// Commands and starters as they come in a run. Of a sequence that repeats only what works at the start: it divides nothing.
class SwitchingRecorder final : public Observer {
 public:
  void begin(double t, std::span<const double> y, Equations& equations) override;
  void step(StepView& view) override;
  void remember(Tape& tape) override;
  const std::vector<Switched>& switchings() const { return all_; }
  std::optional<std::array<double, 4>> works_at(double t) const;  // of a `settled`

 private:
  void look(double t, const Equations& equations, bool count);
  void break_off(int of, double t, bool starts);
  std::vector<Switched> all_;
  std::vector<Command> command_;  // as they were
  std::vector<double> on_since_;  // per element; −1e300: it is off [s]
  bool goes_on_ = false;
};

// Of the driven time, up to its end.
struct DrivenPart {
  double begin = 0, end = 0;  // [s]
  double started = 0;         // when the last drive to be started by then had been [s]
};
// At least one. The last may begin behind its end: what drives is still being started.
std::vector<DrivenPart> sections_of(const Model& model, const std::vector<Switched>& switchings, const EventLog& events,
                                    double end);

}  // namespace kurbel
