// trials.cpp — the effects that are off, one run each.
#include "studies/trials/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <stdexcept>

namespace kurbel {
namespace {

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// One effect to be put on, as the machine with it.
struct Candidate {
  EffectUnit effect;
  Effects effects;
};

bool is_on(const Effects& effects, const EffectUnit& unit) {
  for (const EffectFlag& flag : effect_flags())
    if (unit.name == flag.name) return effects.*(flag.flag);
  return effects.all_elastic || std::any_of(effects.elastic.begin(), effects.elastic.end(),
                                            [&](const std::string& name) { return unit.name == "elasticity:" + name; });
}

std::vector<Candidate> candidates_of(const Scene& scene, const Effects& effects) {
  std::vector<Candidate> list;
  Candidate elastic{{"elasticity", ""}, effects};
  std::vector<std::string> names;
  for (const EffectUnit& unit : effect_units(scene)) {
    if (is_on(effects, unit)) continue;
    if (unit.name.starts_with("elasticity:")) {
      names.push_back(unit.name.substr(std::string("elasticity:").size()));
      elastic.effects.elastic.push_back(names.back());
      continue;
    }
    Candidate one{unit, effects};
    for (const EffectFlag& flag : effect_flags())
      if (unit.name == flag.name) one.effects.*(flag.flag) = true;
    list.push_back(std::move(one));
  }
  if (!names.empty()) {
    elastic.effect.words = "elasticity of " + shortened_list(names, "and");
    list.insert(list.begin(), std::move(elastic));
  }
  return list;
}

Trial try_one(const Scene& scene, const Candidate& candidate, const Result& run, const SimulateOptions& options) {
  Trial trial{.effect = candidate.effect};
  try {
    const Result with = simulate(scene, candidate.effects, "with " + candidate.effect.words, options);
    if (with.complete)
      trial.changes = changes_between(with, run);
    else
      trial.failed = with.diagnosis;
  } catch (const SceneError& impossible) {
    trial.failed = impossible.messages.front().text;
  } catch (const std::runtime_error& impossible) {
    trial.failed = impossible.what();
  }
  return trial;
}

}  // namespace

const FigureChange* Trial::move(double least) const {
  const auto moved = std::find_if(changes.begin(), changes.end(), [&](const FigureChange& c) {
    return c.told() && !c.from_nothing && c.sure() >= least;
  });
  if (moved != changes.end()) return &*moved;
  const auto arisen = std::find_if(changes.begin(), changes.end(),
                                   [&](const FigureChange& c) { return c.told() && c.sure() >= least; });
  return arisen == changes.end() ? nullptr : &*arisen;
}

Trials try_what_is_off(const Scene& scene, const Effects& effects, const Result& run, SimulateOptions options,
                       const TrialLimits& limits) {
  Trials trials;
  if (!run.complete || scene.run.model != "reduced") return trials;
  const std::vector<Candidate> candidates = candidates_of(scene, effects);
  options.traces = options.keep_state = false;
  options.watch.log = {};
  options.budget = std::min(limits.run, options.budget.value_or(limits.run));
  const double begin = processor_time();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (options.watch.stopped()) break;
    const std::string& words = candidates[k].effect.words;
    if (run.statistics.cpu_seconds > limits.run) {
      trials.left_out.push_back(fmt::format("{}: the run takes {:.2g} s of processor time, more than {:g} s", words,
                                            run.statistics.cpu_seconds, limits.run));
      continue;
    }
    if (const double spent = processor_time() - begin; spent > limits.all) {
      trials.left_out.push_back(
          fmt::format("{}: trials have taken {:.2g} s of processor time, more than {:g} s", words, spent, limits.all));
      continue;
    }
    options.watch.at("trial with " + words, static_cast<double>(k) / static_cast<double>(candidates.size()));
    trials.tried.push_back(try_one(scene, candidates[k], run, options));
  }
  return trials;
}

}  // namespace kurbel
