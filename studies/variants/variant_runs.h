// variant_runs.h — variants of a machine, each run with the settings of one run, within one budget; the failure of a
// variant does not affect the others.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "studies/run/simulate.h"

namespace kurbel {

// Why a variant has no figures.
struct Failure {
  std::string words;   // complete; for a scene that makes no machine one "file:line:col: text" per line
  std::string reason;  // only the first, without its place
};
// Exceptions of `compute` become the variant's failure and do not end the others; empty: no exception. An
// interruption, or this much processor time [s], ends it. Throws only std::bad_alloc.
std::optional<Failure> failure_of(const std::function<void()>& compute, const std::atomic<bool>* interrupted,
                                  double seconds = HUGE_VAL);

// A variant's complete run: its figures with errors, and all other results.
struct VariantRun {
  Result result = {};       // without a model if the run did not start
  std::string failed = {};  // why it did not reach its end; empty: it did
};

class VariantRuns {
 public:
  // With these options, but without traces. `seconds`: processor time for all together, in this thread.
  explicit VariantRuns(SimulateOptions options, double seconds = HUGE_VAL);
  // For comparing processor times; without progress output.
  static VariantRuns timed(SimulateOptions options);

  using Machine = std::function<std::shared_ptr<const Model>()>;  // throws SceneError if there is none
  VariantRun run(const std::string& label, const Machine& machine, bool traces = false) const;
  VariantRun run(const std::string& label, const Scene& scene, const Effects& effects) const;

  const SimulateOptions& options() const { return options_; }
  bool stopped() const { return options_.watch.stopped(); }
  bool over() const;  // stopped, or out of time

 private:
  SimulateOptions options_;
  double end_;  // processor time of the thread [s]
};

}  // namespace kurbel
