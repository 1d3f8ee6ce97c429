// variant_runs.h — variants of a machine, each run at the settings of one run, within one budget; what a variant cannot
// do is its own failure.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "studies/run/simulate.h"

namespace kurbel {

// Why a variant has no figures.
struct Failure {
  std::string words;   // all; of a scene that makes no machine one "file:line:col: text" a line
  std::string reason;  // the first alone, without its place
};
// What `compute` throws is the variant's failure, and no end of the others; nothing: it throws nothing. An interrupt, or
// so much processor time [s], ends it. Throws std::bad_alloc alone.
std::optional<Failure> failure_of(const std::function<void()>& compute, const std::atomic<bool>* interrupted,
                                  double seconds = HUGE_VAL);

// A row of whole runs: its figures with their errors, and all else that a run finds.
struct VariantRun {
  Result result = {};       // without a model where it did not come to run
  std::string failed = {};  // why it did not run to its end; empty: it did
};

class VariantRuns {
 public:
  // With these options, but without traces. `seconds`: processor time that all may take together, in this thread.
  explicit VariantRuns(SimulateOptions options, double seconds = HUGE_VAL);
  // Of which processor times are compared, in silence.
  static VariantRuns timed(SimulateOptions options);

  using Machine = std::function<std::shared_ptr<const Model>()>;  // throws SceneError where there is none
  VariantRun run(const std::string& label, const Machine& machine, bool traces = false) const;
  VariantRun run(const std::string& label, const Scene& scene, const Effects& effects) const;

  const SimulateOptions& options() const { return options_; }
  bool stopped() const { return options_.watch.stopped(); }
  bool over() const;  // stopped, or the time is spent

 private:
  SimulateOptions options_;
  double end_;  // processor time of the thread [s]
};

}  // namespace kurbel
