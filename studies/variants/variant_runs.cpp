// variant_runs.cpp — runs one variant after the other, each under the common deadline.
#include "studies/variants/variant_runs.h"

#include <algorithm>
#include <new>
#include <utility>

#include "engine/numerics/deadline.h"
#include "engine/scene/messages.h"

namespace kurbel {

std::optional<Failure> failure_of(const std::function<void()>& compute, const std::atomic<bool>* interrupted,
                                  double seconds) {
  const Deadline deadline(seconds, interrupted);
  try {
    compute();
    return {};
  } catch (const SceneError& error) {
    return Failure{error.what(), error.messages.empty() ? error.what() : error.messages.front().text};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return Failure{error.what(), error.what()};
  }
}

VariantRuns::VariantRuns(SimulateOptions options, double seconds)
    : options_(std::move(options)), end_(processor_time() + seconds) {
  options_.traces = options_.keep_state = false;
}

VariantRuns VariantRuns::timed(SimulateOptions options) {
  options.watch.progress = {};
  options.timed = true;
  return VariantRuns(std::move(options));
}

bool VariantRuns::over() const { return stopped() || processor_time() >= end_; }

VariantRun VariantRuns::run(const std::string& label, const Machine& machine, bool traces) const {
  SimulateOptions options = options_;
  options.traces = traces;
  VariantRun run;
  const auto failure = failure_of([&] { run.result = simulate(machine(), label, options); }, options.watch.interrupted,
                                  std::max(end_ - processor_time(), 1e-3));
  run.failed = failure ? failure->words : run.result.complete ? "" : run.result.diagnosis;
  return run;
}

VariantRun VariantRuns::run(const std::string& label, const Scene& scene, const Effects& effects) const {
  return run(label, [&] { return compile(scene, effects); });
}

}  // namespace kurbel
