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
  std::optional<std::string> effects = {};  // as --effects: "none", "all", "elasticity:main_coupling,gravity"
  std::optional<std::string> method = {};   // "auto", "dop853", …
  std::optional<double> accuracy = {};      // of every figure over its scale
  std::optional<double> until = {};         // [s]
  bool errors = true;                       // measured by further runs
  bool plots = true;                        // follow what the page draws
  Watcher watcher = {};
};

// Something that happened: a clutch stuck, a load's piece ended, the sequence went on.
struct Happening {
  double t = 0;  // [s]
  std::string component, what;
};

// A value: copies share it.
class Run {
 public:
  explicit Run(std::shared_ptr<const RunParts> parts) : parts_(std::move(parts)) {}
  bool complete() const;
  std::string diagnosis() const;  // of one that broke off: when, where, why, what to try
  const FigureValues& figures() const;
  const Trajectory& trajectory() const;       // empty of a multibody run
  std::vector<Happening> happenings() const;  // in their order
  double measured_accuracy() const;           // largest error over its scale
  double processor_seconds() const;           // of all runs, those for the errors included
  const Study& study() const;                 // conclusion, page, JSON, tables

 private:
  std::shared_ptr<const RunParts> parts_;
};

// Throws BadScene where the machine cannot be compiled or started, std::invalid_argument for choices that are none. A run
// that cannot go on is returned incomplete.
Run run(const Machine& machine, const RunChoices& choices = {});

}  // namespace kurbel
