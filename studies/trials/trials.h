// trials.h — effects that have data in the scene and are off: one run each with it on, at the run's own settings, says
// which of them would move a key figure, and by how much; and of an elastic run what the rigid machine would have told.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/figure_changes.h"
#include "studies/run/compare.h"
#include "studies/trials/off_effects.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {

// Of a key figure. `full` is the run's value, `without` that of the trial.
struct TrialChange {
  FigureChange change;
  double relative = 0;                  // with its sign: (with it − run)/|run|; of peaks of the magnitudes
  std::optional<double> error_on = {};  // of the trial's value
  bool gone = false;                    // the trial has no such figure: no run-up to its end, no swing
};

struct Trial : VariantRun {
  OffEffect effect;
  std::vector<TrialChange> changes = {};  // of all key figures, the surely greatest first; what is gone before
};

struct NotTried {
  std::string effect, words, because;
};

struct Trials {
  std::optional<Trial> rigid = {};  // of an elastic run: the same machine without elasticity, with traces to draw
  std::vector<Trial> tried;
  std::vector<NotTried> not_tried;
};

inline constexpr double longest_run = 5;  // of which trials are made: processor time, those for its errors included [s]

// Processor time that all trials of a run may take together [s]: four times the run's, within 1 … 10 s.
double allowance(const Result& run);

// Of the run's model, with the options that made the run. Key figures by their names. Nothing of a run that did not come
// to its end. An interrupt ends the trials; what was not tried then says so.
Trials try_effects(const Result& run, const std::vector<std::string>& key_figures, const SimulateOptions& options,
                   bool rigid = false);  // the rigid machine before all others

// A study and the trials of it; of two models compared those of the second.
template <class Study>
struct WithTrials {
  Study study;
  Trials trials;
};
WithTrials<Result> with_trials(Result run, const SimulateOptions& options);  // and with the rigid machine
WithTrials<Comparison> with_trials(Comparison comparison, const SimulateOptions& options);

}  // namespace kurbel
