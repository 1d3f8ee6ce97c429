// trials.cpp — the run again, with one effect more each time, until the time for trials is up.
#include "studies/trials/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/numerics/deadline.h"
#include "studies/run/run_findings.h"

namespace kurbel {
namespace {

constexpr double times_the_run = 4, least_allowance = 1, most_allowance = 10;  // 1, s, s

// Why no trial of this run is made at all; empty: they are.
std::string why_none(const Result& run, const SimulateOptions& options) {
  if (run.model->scene.run.model != "reduced") return "trials are of the reduced model";
  if (!options.go_on_from.empty()) return "the state that the run goes on from is of the machine without it";
  if (run.cpu_total > longest_run)
    return fmt::format("the run took {:.2g} s of processor time; trials are made of runs of up to {:g} s",
                       run.cpu_total, longest_run);
  return "";
}

std::vector<TrialChange> changes_of(const Result& run, const Result& trial, const std::vector<std::string>& names) {
  std::vector<TrialChange> changes;
  for (const std::string& name : names) {
    const Figure* figure = run.find(name);
    if (figure && !like_in(trial, *figure))
      changes.push_back({.change = {.figure = name, .unit = figure->unit, .full = figure->value}, .gone = true});
  }
  for (FigureChange& change : changes_between(run, trial, names)) {
    if (std::find(names.begin(), names.end(), change.figure) == names.end()) continue;  // a longer name
    const Figure& figure = *run.find(change.figure);
    const bool grows =
        is_peak(figure.what) ? std::abs(change.without) >= std::abs(change.full) : change.without >= change.full;
    const double relative = grows ? change.relative : -change.relative;
    changes.push_back({std::move(change), relative, like_in(trial, figure)->error});
  }
  return changes;
}

std::string in_one_line(const std::string& text) { return text.substr(0, text.find('\n')); }

class TrialRuns {
 public:
  TrialRuns(const Result& run, const std::vector<std::string>& key_figures, const SimulateOptions& options)
      : run_(run), names_(key_figures), options_(options), end_(processor_time() + allowance(run)) {
    options_.keep_state = false;
    draws_ = std::exchange(options_.traces, false);
  }

  // The run's machine without elasticity, before all others.
  void compare_with_rigid() {
    if (!is_elastic(*run_.model) || !why_none(run_, options_).empty()) return;
    try {
      const Effects rigid = models_to_compare(run_.model->scene, run_.model->effects).a;
      trials_.rigid = Trial{.effect = {.name = "rigid", .words = "the rigid machine", .effects = rigid}};
    } catch (const std::exception&) {  // it makes no machine: there is nothing to compare with
      return;
    }
    SimulateOptions options = options_;
    options.traces = draws_;
    run(
        *trials_.rigid, [&] { return compile(run_.model->scene, trials_.rigid->effect.effects); }, options);
    if (stopped() || spent()) trials_.rigid.reset();
  }

  Trials all() {
    for (OffEffect& effect : effects_that_are_off(run_.model->scene, run_.model->effects)) {
      const std::string none = why_none(run_, options_);
      if (!none.empty() || stopped() || spent())
        leave(effect, !none.empty() ? none : why_ended());
      else
        try_one(std::move(effect));
    }
    return std::move(trials_);
  }

 private:
  bool stopped() const { return options_.watch.stopped(); }
  bool spent() const { return processor_time() >= end_; }
  std::string why_ended() const {
    return stopped() ? "interrupted"
                     : fmt::format("the {:.2g} s of processor time for trials were spent", allowance(run_));
  }
  void leave(const OffEffect& effect, std::string because) {
    trials_.not_tried.push_back({effect.name, effect.words, std::move(because)});
  }

  void try_one(OffEffect effect) {
    Trial trial{.effect = std::move(effect)};
    run(
        trial, [&] { return machine_with(run_.model->scene, run_.model->effects, trial.effect); }, options_);
    if (!trial.failed.empty() && (stopped() || spent())) return leave(trial.effect, why_ended());
    trials_.tried.push_back(std::move(trial));
  }

  template <class Machine>
  void run(Trial& trial, const Machine& machine, const SimulateOptions& options) {
    const Deadline deadline(std::max(end_ - processor_time(), 1e-3), options.watch.interrupted);
    try {
      const std::shared_ptr<const Model> model = machine();
      trial.result =
          simulate(model, trial.effect.name == "rigid" ? "rigid" : "trial with " + trial.effect.words, options);
      if (!trial.result.complete) trial.failed = in_one_line(trial.result.diagnosis);
    } catch (const OutOfTime&) {
      trial.failed = why_ended();
    } catch (const std::exception& error) {
      trial.failed = in_one_line(error.what());
    }
    if (trial.failed.empty()) trial.changes = changes_of(run_, trial.result, names_);
  }

  const Result& run_;
  const std::vector<std::string>& names_;
  SimulateOptions options_;
  bool draws_ = false;
  double end_;  // processor time of the process [s]
  Trials trials_;
};

// Of the run's figures; where it is told by none of them, by the speed at its end.
std::vector<std::string> names_of(const std::vector<KeyFigure>& figures, const Result& run) {
  std::vector<std::string> names;
  for (const KeyFigure& figure : figures)
    if (run.find(figure.means)) names.push_back(figure.means);
  if (names.empty())
    if (const Figure* speed = first_of(run, quantities::final_speed)) names.push_back(speed->name);
  return names;
}

}  // namespace

double allowance(const Result& run) {
  return std::clamp(times_the_run * run.cpu_total, least_allowance, most_allowance);
}

Trials try_effects(const Result& run, const std::vector<std::string>& key_figures, const SimulateOptions& options) {
  if (!run.complete || !run.model) return {};
  return TrialRuns(run, key_figures, options).all();
}

WithTrials<Result> with_trials(Result run, const SimulateOptions& options) {
  if (!run.complete || !run.model) return {std::move(run), {}};
  const std::vector<std::string> names = names_of(key_figures_of(run), run);
  TrialRuns trials(run, names, options);
  trials.compare_with_rigid();
  Trials all = trials.all();
  return {std::move(run), std::move(all)};
}

WithTrials<Comparison> with_trials(Comparison comparison, const SimulateOptions& options) {
  Trials trials = try_effects(comparison.b, names_of(key_figures_of(comparison), comparison.b), options);
  return {std::move(comparison), std::move(trials)};
}

}  // namespace kurbel
