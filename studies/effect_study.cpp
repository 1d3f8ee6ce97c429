// effect_study.cpp — one run with everything, one run less each effect.
#include "studies/effect_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/units.h"

namespace kurbel {

bool is_telling(const Figure& figure) {
  static const std::vector<std::string> telling = {
      "peak_torque.", "max_speed.",  "min_speed.", "delta.",     "run_up_time", "run_down_time", "steady_speed.",
      "mean_speed.",  "rms_torque.", "work.",      "slip_heat.", "stopping_",   "final_speed.",  "cycle_time."};
  return figure.scale > 0 && std::any_of(telling.begin(), telling.end(),
                                         [&](const std::string& begin) { return figure.name.starts_with(begin); });
}

double floor_of(const Figure& figure, const Result& run) {
  constexpr double rounding = 1e-9;
  return figure.error.value_or(0) + std::max(rounding, run.tolerance) * figure.scale;
}

std::vector<FigureChange> changes_between(const Result& full, const Result& other,
                                          const std::vector<std::string>& wanted) {
  std::vector<FigureChange> changes;
  for (const Figure& figure : full.figures) {
    const bool asked = std::any_of(wanted.begin(), wanted.end(), [&](const std::string& name) {
      return figure.name == name || figure.name.starts_with(name + ".");
    });
    if (wanted.empty() ? !is_telling(figure) : !asked) continue;
    const Figure* same = other.find(figure.name);
    if (!same) continue;
    const double nothing = floor_of(figure, full);
    if (std::abs(figure.value) <= nothing && std::abs(same->value) <= floor_of(*same, other)) continue;  // both zero
    // Of two equal peaks of opposite sign either may be the larger one.
    const bool magnitude = figure.name.starts_with("peak_");
    const double difference =
        magnitude ? std::abs(std::abs(same->value) - std::abs(figure.value)) : std::abs(same->value - figure.value);
    const double size = std::max({std::abs(figure.value), nothing, 1e-300});
    changes.push_back(
        {figure.name, figure.unit, figure.value, same->value, difference / size, std::abs(figure.value) <= nothing});
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const FigureChange& a, const FigureChange& b) { return a.relative > b.relative; });
  return changes;
}

namespace {

std::string conclusion_of(const EffectStudy& s) {
  if (!s.full.complete) return "The full model did not run to the end: " + s.full.diagnosis;
  std::string text;
  const auto strongest = std::find_if(s.left_out.begin(), s.left_out.end(),
                                      [](const LeftOut& l) { return l.refused.empty() && !l.changes.empty(); });
  if (strongest == s.left_out.end()) {
    const bool any_ran =
        std::any_of(s.left_out.begin(), s.left_out.end(), [](const LeftOut& l) { return l.refused.empty(); });
    return any_ran ? "No figure that is compared is other than zero, with or without an effect: nothing to rank by."
                   : "No effect of this scene can be left out: without any of them it does not run.";
  }
  const FigureChange& most = strongest->changes.front();
  if (most.relative == 0) return "No effect changes any figure compared.";
  const int digits = most.relative < 1e-2 ? 7 : 4;  // so that the two differ
  text = fmt::format("Most depends on {}: without it {} is {} instead of {}{}", strongest->effect.words, most.figure,
                     with_unit(most.without, most.unit, digits), with_unit(most.full, most.unit, digits),
                     most.from_nothing ? std::string(", which is zero within its error")
                                       : fmt::format(" ({:.2g} % off)", 100 * most.relative));
  std::vector<std::string> idle;
  for (const LeftOut& l : s.left_out)
    if (l.refused.empty() && !l.changes.empty() && l.changes.front().relative < 1e-3) idle.push_back(l.effect.words);
  if (!idle.empty()) text += fmt::format("; less than 0.1 % in any figure compared: {}", listed(idle, "and"));
  const auto dearest = std::max_element(s.left_out.begin(), s.left_out.end(),
                                        [](const LeftOut& a, const LeftOut& b) { return a.time_ratio < b.time_ratio; });
  if (dearest->time_ratio > 1.05)
    text += fmt::format("; {} costs most, {:.3g} × the time without it", dearest->effect.words, dearest->time_ratio);
  return text + ".";
}

}  // namespace

EffectStudy study_effects(const Scene& scene, const SimulateOptions& options) {
  EffectStudy study;
  study.title = scene.title.empty() ? scene.file : scene.title;
  study.scene_file = scene.file;
  study.scene_text = scene.text;
  study.units = effect_units(scene);
  if (study.units.empty())
    throw std::invalid_argument(
        "this scene has parameters for no effect: nothing is elastic, nothing has friction, losses or a gap. Give a "
        "coupling a stiffness, or a gear its efficiency");
  const auto say = [&](const std::string& what, std::size_t done) {
    if (options.progress)
      options.progress(what, static_cast<double>(done) / (1.0 + static_cast<double>(study.units.size())));
  };
  SimulateOptions quiet = options;
  quiet.progress = {};
  quiet.traces = false;
  EffectSet on(study.units.size(), true);
  say("all effects", 0);
  study.full = simulate(scene, effects_of(scene, study.units, on), "full", quiet);
  study.size = size_of(*study.full.model);
  for (std::size_t k = 0; k < study.units.size() && study.full.complete; ++k) {
    say("without " + study.units[k].words, k + 1);
    LeftOut left{.effect = study.units[k]};
    on[k] = false;
    try {
      left.result = simulate(scene, effects_of(scene, study.units, on), "without " + left.effect.words, quiet);
      if (!left.result.complete) left.refused = left.result.diagnosis;
    } catch (const SceneError& error) {
      left.refused = error.what();
    }
    on[k] = true;
    if (left.refused.empty()) {
      left.changes = changes_between(study.full, left.result);
      const ModelSize less = size_of(*left.result.model);
      left.saved = {study.size.states - less.states, study.size.nonzeros - less.nonzeros,
                    study.size.guards - less.guards};
      left.events_added = static_cast<long>(study.full.statistics.events - left.result.statistics.events);
      left.time_ratio = study.full.statistics.cpu_seconds / std::max(left.result.statistics.cpu_seconds, 1e-9);
    }
    study.left_out.push_back(std::move(left));
  }
  std::stable_sort(study.left_out.begin(), study.left_out.end(), [](const LeftOut& a, const LeftOut& b) {
    const auto most = [](const LeftOut& l) {
      return !l.refused.empty() ? HUGE_VAL : l.changes.empty() ? 0 : l.changes.front().relative;
    };
    return most(a) > most(b);
  });
  study.conclusion = conclusion_of(study);
  return study;
}

}  // namespace kurbel
