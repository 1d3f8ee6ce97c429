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

// What is not given is as the scene says.
struct RunChoices {
  std::optional<std::string> effects = {};  // as `--effects`: "none", "all", "elasticity:main_coupling,gravity"
  std::optional<std::string> method = {};   // "auto", "dop853", …
  std::optional<double> accuracy = {};      // of every figure over its scale, 1e-12 … 0.1
  std::optional<double> until = {};         // [s], > 0
  bool errors = true;                       // measured by further runs
  bool plots = true;                        // follow what the page draws
  // Behind a short run: what the rigid machine would have told, and which effects that are off would move a key figure.
  bool trials = false;
  // A test's record (a CSV file) laid over it, as by `--measured`; what is left between them is told as figures:
  // "residual_rms.torque.main_coupling". Empty: none.
  std::string measured = {};
  std::vector<std::string> map = {};     // columns to channels, "T1=torque.main_coupling"
  std::string shift = {};                // added to its times, "0.2 s"; "fit": found
  std::vector<std::string> offset = {};  // what a column reads too high, "T1=5 N*m"; "T1=fit", "fit": found
  std::string from_state = {};           // SavedState::text(): goes on from there; empty: from the scene's start
  Watcher watcher = {};                  // interrupts, and is told the progress
};

// An event of a run: a clutch stuck, a load's piece ended, the sequence went on.
struct RunEvent {
  double t = 0;           // [s]
  std::string component;  // where: "clutch"; empty: the machine as a whole
  std::string what;       // in words: "sticks"
};

// One simulation and what it yielded. A value: copies share it.
class Run {
 public:
  explicit Run(std::shared_ptr<const RunParts> parts) : parts_(std::move(parts)) {}  // for kurbel itself
  bool complete() const;                                                             // it came to its end …
  std::string diagnosis() const;         // … or when, where and why not, and what to try
  const FigureValues& figures() const;   // in SI, each with its measured error; of an incomplete run none is sure
  const Trajectory& trajectory() const;  // empty of a multibody run
  std::vector<RunEvent> events() const;  // in their order
  double measured_accuracy() const;      // largest error of a figure over its scale, a plain number
  double processor_seconds() const;      // of all runs, those for the errors included [s]
  const Study& study() const;            // conclusion, page, JSON, tables

 private:
  std::shared_ptr<const RunParts> parts_;
};

// Simulates a machine from its start to its end. Throws BadScene where the machine cannot be compiled or started,
// std::invalid_argument for choices that are none. A run that cannot go on, or is interrupted, is returned incomplete.
Run run(const Machine& machine, const RunChoices& choices = {});

}  // namespace kurbel
