// trials.cpp — repeats the run with one more effect each time, until the time for trials is spent.
#include "studies/trials/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/scene/quantity_place.h"
#include "studies/limits/ratings.h"
#include "studies/run/run_findings.h"
#include "studies/variants/variant_runs.h"

namespace kurbel {
namespace {

constexpr double times_the_run = 4, least_allowance = 1, most_allowance = 10;  // 1, s, s

// Why this run has no trials at all; empty: it has.
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
      : run_(run),
        names_(key_figures),
        none_(why_none(run, options)),
        draws_(options.traces),
        runs_(options, allowance(run)) {}

  // The run's machine without elasticity, before all others.
  void compare_with_rigid() {
    if (!is_elastic(*run_.model) || !none_.empty()) return;
    OffEffect rigid{.name = "rigid", .words = "the rigid machine", .effects = {}};
    try {
      rigid.effects = models_to_compare(run_.model->scene, run_.model->effects).a;
    } catch (const std::exception&) {  // it makes no machine: there is nothing to compare with
      return;
    }
    const auto machine = [&] { return compile(run_.model->scene, rigid.effects); };
    VariantRun run = runs_.run("rigid", machine, draws_);
    if (!runs_.over()) trials_.rigid = judged(std::move(run), std::move(rigid));
  }

  Trials all() {
    for (OffEffect& effect : effects_that_are_off(run_.model->scene, run_.model->effects)) {
      if (!none_.empty() || runs_.over())
        leave(effect, !none_.empty() ? none_ : why_ended());
      else
        try_one(std::move(effect));
    }
    return std::move(trials_);
  }

 private:
  std::string why_ended() const {
    return runs_.stopped() ? "interrupted"
                           : fmt::format("the {:.2g} s of processor time for trials were spent", allowance(run_));
  }
  void leave(const OffEffect& effect, std::string because) {
    trials_.not_tried.push_back({effect.name, effect.words, std::move(because)});
  }

  void try_one(OffEffect effect) {
    const auto machine = [&] { return machine_with(run_.model->scene, run_.model->effects, effect); };
    VariantRun run = runs_.run("trial with " + effect.words, machine);
    if (!run.failed.empty() && runs_.over()) return leave(effect, why_ended());
    trials_.tried.push_back(judged(std::move(run), std::move(effect)));
  }

  Trial judged(VariantRun run, OffEffect effect) const {
    Trial trial{std::move(run), std::move(effect)};
    trial.failed = in_one_line(trial.failed);
    if (trial.failed.empty()) trial.changes = changes_of(run_, trial.result, names_);
    return trial;
  }

  const Result& run_;
  const std::vector<std::string>& names_;
  std::string none_;  // why no trial is made at all; empty: they are
  bool draws_;
  VariantRuns runs_;
  Trials trials_;
};

// Among the run's figures; if none is affected, the speed at its end.
std::vector<std::string> names_of(const std::vector<KeyFigure>& figures, const Result& run) {
  std::vector<std::string> names;
  for (const KeyFigure& figure : figures)
    if (run.find(figure.means)) names.push_back(figure.means);
  if (names.empty())
    if (const Figure* speed = first_of(run, quantities::final_speed)) names.push_back(speed->name);
  return names;
}

constexpr int most_values = 4;
constexpr double worse_by = 0.01;

// Exceeded verdicts with a remedy by a key, in descending order of excess.
std::vector<const Verdict*> to_mend(const std::vector<Verdict>& verdicts) {
  std::vector<const Verdict*> list;
  for (const Verdict& v : verdicts)
    if (v.state() == Compliance::exceeded && v.remedy && !v.remedy->tried) list.push_back(&v);
  std::stable_sort(list.begin(), list.end(),
                   [](const Verdict* a, const Verdict* b) { return a->share() > b->share(); });
  return list;
}

class Search {
 public:
  // All searches share one allowance of time.
  Search(const Result& run, const Verdict& verdict, VariantRuns& runs) : run_(run), verdict_(verdict), runs_(runs) {}

  // Not finite: none was found.
  double value() const {
    Scene scene = run_.model->scene;
    const Setting* setting = quantity_at(scene.components, verdict_.remedy->key);
    if (!setting || !(setting->number > 0)) return nan;
    const double given = setting->number, from = share_of(verdict_);
    double value = verdict_.remedy->value;
    const double worse = value > given ? 1 - worse_by : 1 + worse_by;
    for (int k = 0; k < most_values && !runs_.over(); ++k) {
      const double share = share_with(value);
      if (share <= 1 && share_with(worse * value) > 1) return value;
      const double power = std::log(share / from) / std::log(value / given);
      if (!(power * (value - given) < 0)) return nan;  // it does not get better that way
      value *= std::pow(share, -1 / power);
      value = value > given ? enough(value) : -enough(-value);
    }
    return nan;
  }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  double share_of(const Verdict& v) const { return (v.value + verdict_.known_error()) / v.limit; }

  // A bore stays in proportion to its diameter. NaN: that machine has no such verdict.
  double share_with(double value) const {
    Scene scene = run_.model->scene;
    const std::string& key = verdict_.remedy->key;
    Setting& setting = *quantity_at(scene.components, key);
    if (key.ends_with(".diameter"))
      if (Setting* bore = quantity_at(scene.components, key.substr(0, key.rfind('.')) + ".bore"))
        bore->number *= value / setting.number;
    setting.number = value;
    const VariantRun varied = runs_.run("remedy", scene, run_.model->effects);
    if (varied.failed.empty())
      for (const Verdict& v : judge_ratings(varied.result))
        if (v.component == verdict_.component && v.requirement == verdict_.requirement) return share_of(v);
    return nan;
  }

  const Result& run_;
  const Verdict& verdict_;
  VariantRuns& runs_;
};

}  // namespace

double allowance(const Result& run) {
  return std::clamp(times_the_run * run.cpu_total, least_allowance, most_allowance);
}

Trials try_effects(const Result& run, const std::vector<std::string>& key_figures, const SimulateOptions& options,
                   bool rigid) {
  if (!run.complete || !run.model) return {};
  TrialRuns trials(run, key_figures, options);
  if (rigid) trials.compare_with_rigid();
  return trials.all();
}

WithTrials<Result> with_trials(Result run, const SimulateOptions& options) {
  try_remedies(run, options);
  Trials trials = try_effects(run, names_of(key_figures_of(run), run), options, true);
  return {std::move(run), std::move(trials)};
}

WithTrials<Comparison> with_trials(Comparison comparison, const SimulateOptions& options) {
  try_remedies(comparison.b, options);
  Trials trials = try_effects(comparison.b, names_of(key_figures_of(comparison), comparison.b), options);
  return {std::move(comparison), std::move(trials)};
}

void try_remedies(Result& run, const SimulateOptions& options) {
  if (!run.complete || !run.model || run.model->scene.run.model != "reduced" || !options.go_on_from.empty()) return;
  SimulateOptions without_errors = options;
  without_errors.measure_error = without_errors.keep_state = false;
  VariantRuns runs(without_errors, run.cpu_total);
  const std::vector<Verdict> verdicts = judge_ratings(run);
  for (const Verdict* verdict : to_mend(verdicts))
    if (!runs.over()) run.remedies_tried[name_of_remedy(*verdict)] = Search(run, *verdict, runs).value();
}

}  // namespace kurbel
