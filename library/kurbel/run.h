// run.h — one simulation of a machine: figures confirmed by further runs, and what was recorded.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <kurbel/figures.h>
#include <kurbel/studies.h>

namespace kurbel {

class Machine;
struct RunParts;

// Unset choices are as in the scene.
struct RunChoices {
  std::optional<std::string> effects = {};  // as `--effects`: "none", "all", "elasticity:main_coupling,gravity"
  std::optional<std::string> method = {};   // "auto", "dop853", …
  std::optional<double> accuracy = {};      // of every figure over its scale, 1e-12 … 0.1
  std::optional<double> until = {};         // [s], > 0
  bool no_error = false;                    // skip the further runs that measure errors
  bool page = true;                         // record what the page draws
  // False: after a short run also the result of the rigid machine, and which effects that are off would change a key
  // figure.
  bool no_trials = true;
  // A measured record (a CSV file) to compare with, as by `--measured`; the deviations are figures:
  // "residual_rms.torque.main_coupling". Empty: none.
  std::string measured = {};
  std::vector<std::string> map = {};     // columns to channels, "T1=torque.main_coupling"
  std::string shift = {};                // added to its times, "0.2 s"; "fit": identified
  std::vector<std::string> offset = {};  // offset of a column, subtracted, "T1=5 N*m"; "T1=fit", "fit": identified
  std::string from_state = {};           // SavedState::text() to continue from; empty: the scene's start
  Watcher watcher = {};                  // interrupts, and receives the progress
};

// An event of a run: a clutch sticks, a segment of a load ends, the sequence continues.
struct RunEvent {
  double t = 0;           // [s]
  std::string component;  // where: "clutch"; empty: the machine as a whole
  std::string what;       // in words: "sticks"
};

// One simulation and its results. A value: copies share them.
class Run {
 public:
  explicit Run(std::shared_ptr<const RunParts> parts) : parts_(std::move(parts)) {}  // for kurbel itself
  // Moving copies, too: what was moved from is still that run.
  Run(const Run&) = default;
  Run& operator=(const Run&) = default;  // likewise
  bool complete() const;                 // it reached its end …
  std::string diagnosis() const;         // … or when, where and why not, and what to try
  const FigureValues& figures() const;   // in SI, each with its measured error; not reliable if the run is incomplete
  const Trajectory& trajectory() const;  // empty for a multibody run
  std::vector<RunEvent> events() const;  // in order of time
  double measured_accuracy() const;      // largest error of a figure over its scale, a plain number
  double processor_seconds() const;      // of all runs, including those for the errors [s]
  const Study& study() const;            // conclusion, page, JSON, tables

 private:
  std::shared_ptr<const RunParts> parts_;
};

// Simulates a machine from its start to its end. Throws BadScene if the machine cannot be compiled or started,
// std::invalid_argument for invalid choices. A run that cannot continue or is interrupted is returned incomplete.
Run run(const Machine& machine, const RunChoices& choices = {});

}  // namespace kurbel
