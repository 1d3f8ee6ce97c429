// effect_study.cpp — one run with all effects, one run without each.
#include "studies/effects/effect_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/scene/units.h"
#include "studies/findings/figure_text.h"
#include "studies/validity/substitutes.h"

namespace kurbel {
namespace {

// The greatest change consistent with the errors.
double largest(const OmittedEffect& l) {
  double most = 0;
  for (const FigureChange& c : l.changes) most = std::max(most, c.relative + c.error);
  return most;
}

// Effects excluded from the full model, and their greatest change.
std::string beyond(const EffectStudy& s) {
  std::string text;
  for (const OmittedEffect& l : s.omitted) {
    if (l.in_place_of.empty()) continue;
    text += fmt::format(" The full model is without {}, which does not go with {}", l.effect.words, l.in_place_of);
    if (!l.failed.empty())
      text += " and does not run: " + l.failed;
    else if (l.changes.empty() || !l.changes.front().reported())
      text += "; in their place it changes no figure compared by more than the runs' errors";
    else
      text += fmt::format("; in their place it changes {} by {}", l.changes.front().figure,
                          with_error({100 * l.changes.front().relative, 100 * l.changes.front().error}, "%", 2));
    text += ".";
  }
  return text;
}

std::string conclusion_of(const EffectStudy& s) {
  if (!s.full.complete) return "The full model did not run to the end: " + s.full.diagnosis;
  std::string text;
  const auto strongest = std::find_if(s.omitted.begin(), s.omitted.end(), [](const OmittedEffect& l) {
    return l.failed.empty() && !l.changes.empty() && l.in_place_of.empty();
  });
  if (strongest == s.omitted.end()) {
    const bool any_ran =
        std::any_of(s.omitted.begin(), s.omitted.end(), [](const OmittedEffect& l) { return l.failed.empty(); });
    return any_ran ? "All figures compared are zero, with and without each effect: the effects cannot be ranked."
                   : "No effect of this scene can be omitted: without any of them it does not run.";
  }
  const FigureChange& most = strongest->changes.front();
  if (!most.reported()) return "No effect changes any figure compared by more than the runs' errors." + beyond(s);
  const std::string off = most.from_nothing ? std::string("within its error")
                                            : with_error({100 * most.relative, 100 * most.error}, "%", 3) + " off";
  // The two values are omitted if four digits do not distinguish them.
  text = most.relative < 1e-2
             ? fmt::format("The strongest effect is {}: without it {} is {}", strongest->effect.words, most.figure, off)
             : fmt::format("The strongest effect is {}: without it {} is {} instead of {}, {}", strongest->effect.words,
                           most.figure, short_text(most.without, most.unit),
                           most.from_nothing ? "zero" : short_text(most.full, most.unit), off);
  std::vector<std::string> idle;
  for (const OmittedEffect& l : s.omitted)
    if (l.failed.empty() && !l.changes.empty() && largest(l) < 1e-3) idle.push_back(l.effect.words);
  if (!idle.empty()) text += fmt::format("; less than 0.1 % in any figure compared: {}", listed(idle, "and"));
  const auto dearest =
      std::max_element(s.omitted.begin(), s.omitted.end(),
                       [](const OmittedEffect& a, const OmittedEffect& b) { return a.time_ratio < b.time_ratio; });
  if (dearest->time_ratio > alike_in_time)
    text += fmt::format("; most time is due to {}, {:.2g} × the time without it", dearest->effect.words,
                        dearest->time_ratio);
  return text + "." + beyond(s);
}

// The figures of the run with the unit against those of the run without.
void compare(OmittedEffect& left, const Result& with, const ModelSize& size) {
  left.changes = changes_between(with, left.result);
  const ModelSize less = size_of(*left.result.model);
  left.saved = {size.states - less.states, size.nonzeros - less.nonzeros, size.guards - less.guards};
  left.events_added = static_cast<long>(with.statistics.events - left.result.statistics.events);
  left.time_ratio = with.statistics.cpu_seconds / std::max(left.result.statistics.cpu_seconds, 1e-9);
}

}  // namespace

OmittedEffect study_in_place_of_others(const Scene& scene, const std::vector<EffectUnit>& units,
                                       const EffectSet& fullest, std::size_t unit, const VariantRuns& runs) {
  const InPlaceOf sets = in_place_of_others(scene, units, fullest, unit);
  const std::string& words = units[unit].words;
  VariantRun with{{}, "it goes with no other effect of this scene, nor alone"};
  if (sets.with[unit]) with = runs.run("with " + words, scene, effects_of(scene, units, sets.with));
  OmittedEffect left{{{}, with.failed}, units[unit]};
  if (with.failed.empty())
    left = {runs.run("without " + words, scene, effects_of(scene, units, sets.without)), units[unit]};
  left.in_place_of = sets.gives_way;
  if (left.failed.empty()) compare(left, with.result, size_of(*with.result.model));
  return left;
}

EffectStudy study_effects(const Scene& scene, const SimulateOptions& options) {
  EffectStudy study;
  study.is_of(scene);
  study.units = effect_units(scene);
  if (study.units.empty())
    throw std::invalid_argument(
        "this scene has parameters for no effect: nothing is elastic, nothing has friction, losses or a gap. Give a "
        "coupling a stiffness, or a gear its efficiency");
  const auto say = [&](const std::string& what, std::size_t done) {
    options.watch.at(what, static_cast<double>(done) / (1.0 + static_cast<double>(study.units.size())));
  };
  const VariantRuns runs = VariantRuns::timed(options);
  const EffectSet on = fullest_set(scene, study.units);
  say("all effects", 0);
  study.full = simulate(scene, effects_of(scene, study.units, on), "full", runs.options());
  study.size = size_of(*study.full.model);
  study.notes = study.full.notes;
  if (!study.full.complete) study.break_off(study.full.diagnosis);
  for (std::size_t k = 0; k < study.units.size() && study.full.complete; ++k) {
    const std::string words = "without " + study.units[k].words;
    say(words, k + 1);
    if (!on[k]) {
      study.omitted.push_back(study_in_place_of_others(scene, study.units, on, k, runs));
      continue;
    }
    OmittedEffect left{runs.run(words, scene, effects_of(scene, study.units, without(on, k))), study.units[k]};
    if (left.failed.empty()) compare(left, study.full, study.size);
    if (left.result.model)
      for (const std::string& note : idle_effects(*left.result.model))
        study.notes.push_back(fmt::format("{}: {}", words, note));
    study.omitted.push_back(std::move(left));
  }
  std::stable_sort(study.omitted.begin(), study.omitted.end(), [](const OmittedEffect& a, const OmittedEffect& b) {
    const auto most = [](const OmittedEffect& l) {
      return !l.failed.empty() ? HUGE_VAL : l.changes.empty() ? 0 : l.changes.front().sure();
    };
    return most(a) > most(b);
  });
  study.conclusion = conclusion_of(study);
  return study;
}

}  // namespace kurbel
