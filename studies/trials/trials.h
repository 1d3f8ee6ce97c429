// trials.h — effects that have data in the scene but are off: one run with each, at the run's own settings, shows
// which of them would change a key figure, and by how much; for an elastic run also the result of the rigid machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/findings/figure_changes.h"
#include "studies/findings/result.h"
#include "studies/run/compare.h"
#include "studies/run/simulate.h"
#include "studies/trials/off_effects.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {

// Change of a key figure. `full` is the run's value, `without` that of the trial.
struct TrialChange {
  FigureChange change;
  double relative = 0;                  // signed: (with effect − run)/|run|; for peaks by magnitudes
  std::optional<double> error_on = {};  // of the trial's value
  bool gone = false;                    // the trial has no such figure: run-up without end, no vibration
};

struct Trial : VariantRun {
  OffEffect effect;
  std::vector<TrialChange> changes = {};  // of all key figures, largest certain change first; missing figures before
};

struct NotTried {
  std::string effect, words, because;
};

struct Trials {
  std::optional<Trial> rigid = {};  // for an elastic run: the same machine without elasticity, with traces for plots
  std::vector<Trial> tried;
  std::vector<NotTried> not_tried;
};

inline constexpr double longest_run = 5;  // for runs with trials: processor time including their errors [s]

// Processor time for all trials of a run together [s]: four times the run's, within 1 … 10 s.
double allowance(const Result& run);

// Trials for the run's model, with the options of the run. Key figures by name. Empty for an incomplete run. An
// interruption ends the trials and is given as the reason for those not tried.
Trials try_effects(const Result& run, const std::vector<std::string>& key_figures, const SimulateOptions& options,
                   bool rigid = false);  // `rigid`: the rigid machine before all others

// A study and its trials; for two models compared those of the second.
template <class Study>
struct WithTrials {
  Study study;
  Trials trials;
};
WithTrials<Result> with_trials(Result run, const SimulateOptions& options);  // including the rigid machine
WithTrials<Comparison> with_trials(Comparison comparison, const SimulateOptions& options);

// Remedies are computed before they are reported: the machine with that value meets the limit, and with one worse by
// 1 % it does not.
// For every exceeded verdict of a complete run with a remedy by a key of the scene, in descending order of excess:
// the value is sought by runs without errors, all within the processor time of the run, and stored in
// `remedies_tried`. Otherwise the remedy remains an estimate. An interruption ends the search.
void try_remedies(Result& run, const SimulateOptions& options);

}  // namespace kurbel
