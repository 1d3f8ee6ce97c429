// accuracy_levels.cpp — the ladder of models of a scene, and their references by two methods.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "studies/accuracy/accuracy_work.h"
#include "studies/effects/effect_units.h"
#include "studies/run/compare.h"

namespace kurbel {
namespace {

// --- which levels there are ---

class Rungs {
 public:
  explicit Rungs(const Scene& scene) : scene_(scene), units_(effect_units(scene)) {
    rungs_.push_back({.name = "rigid", .called = "rigid model", .effects = bare_machine(scene.effects)});
  }

  std::vector<ModelRung> all() {
    for (const bool of_scene : {true, false}) {
      add_flags(of_scene, [](const EffectFlag& f) { return !f.of_elasticity && f.flag != &Effects::multibody; });
      add_elasticity(of_scene);
      add_flags(of_scene, [](const EffectFlag& f) { return f.of_elasticity; });
      add_flags(of_scene, [](const EffectFlag& f) { return f.flag == &Effects::multibody; });
    }
    return std::move(rungs_);
  }

 private:
  template <class Wanted>
  void add_flags(bool of_scene, Wanted wanted) {
    for (const EffectFlag& f : effect_flags()) {
      const bool given =
          std::any_of(units_.begin(), units_.end(), [&](const EffectUnit& unit) { return unit.name == f.name; });
      Effects effects = rungs_.back().effects;
      if (!given || !wanted(f) || scene_.effects.*(f.flag) != of_scene || effects.*(f.flag)) continue;
      effects.*(f.flag) = true;
      rungs_.push_back({.name = fmt::format("with {}", f.words),
                        .called = fmt::format("model with {}", f.words),
                        .effects = effects,
                        .adds = f.flag,
                        .of_scene = of_scene});
    }
  }

  // That of the scene; then the rest of it.
  void add_elasticity(bool of_scene) {
    std::size_t elastic = 0, on = 0;
    for (const EffectUnit& unit : units_)
      if (!unit.component.empty()) ++elastic, on += scene_.effects.is_elastic(unit.component);
    if (of_scene ? on == 0 : on == elastic) return;
    Effects effects = rungs_.back().effects;
    effects.all_elastic = !of_scene || scene_.effects.all_elastic;
    effects.elastic = of_scene ? scene_.effects.elastic : std::vector<std::string>{};
    const std::string name = of_scene || on == 0 ? "elastic" : "all elastic";
    rungs_.push_back({.name = name, .called = name + " model", .effects = effects, .of_scene = of_scene});
  }

  const Scene& scene_;
  std::vector<EffectUnit> units_;
  std::vector<ModelRung> rungs_;
};

// Peak loads of a machine from a run with these effects; empty if it fails.
std::map<std::string, double> peaks(const AccuracyWork& work, const Effects& effects) {
  std::map<std::string, double> found;
  const Result r = simulate(work.scene, effects, "", work.simulate_options("auto", 1e-6));
  if (!r.complete) return found;
  for (const Figure& f : r.figures)
    if (f.what == quantities::peak_torque || f.what == quantities::delta || f.what == quantities::cycle_fluctuation)
      found[f.name] = f.value;
  return found;
}

// The springs of a model, by their components.
std::set<std::string> springs_of(const Model& model) {
  std::set<std::string> names;
  for (const ElasticJoint& e : model.elastic)
    if (!e.slips && !e.springless) names.insert(model.network.joints[at(e.joint)].component);
  return names;
}

// The single elastic element that comes closest to the full model's peaks.
std::optional<ModelRung> lean_rung(AccuracyWork& work, const Effects& full, const Model& model) {
  const std::set<std::string> candidates = springs_of(model);
  constexpr std::size_t most_candidates = 8;
  std::string why;
  if (candidates.size() < 2)
    why = "one elastic element only: the lean model is the full one";
  else if (candidates.size() > most_candidates)
    why = fmt::format("{} elastic elements are too many to try each alone", candidates.size());
  if (!why.empty()) return work.omit("elastic lean", why), std::nullopt;
  const std::map<std::string, double> wanted = peaks(work, full);
  double nearest = HUGE_VAL;
  std::optional<ModelRung> best;
  for (const std::string& component : candidates) {
    Effects one = full;
    one.all_elastic = false;
    one.elastic = {component.substr(0, component.find('.'))};
    if (work.interrupted()) break;
    double difference = 0;
    try {
      const std::map<std::string, double> found = peaks(work, one);
      if (found.empty()) continue;
      for (const auto& [figure, value] : wanted)
        if (const auto f = found.find(figure); f != found.end() && value != 0)
          difference = std::max(difference, std::abs(f->second / value - 1));
    } catch (const SceneError&) {
      continue;
    }
    work.log(fmt::format("elastic in {} alone: peaks off by up to {:.2g}", component, difference));
    if (difference < nearest)
      nearest = difference, best = ModelRung{.name = "elastic: " + one.elastic.front(),
                                             .called = fmt::format("model elastic in {} alone", one.elastic.front()),
                                             .effects = one};
  }
  if (!best) work.omit("elastic lean", "no single elastic element makes a model that runs");
  return best;
}

// --- their references ---

// Independent of each other: other variables (angle against time), another table, or another family.
std::vector<std::string> reference_methods(const LevelAtWork& level) {
  std::vector<std::string> methods;
  if (level.tables) methods.push_back("work");
  for (const char* method : {"dop853", "verner6", "esdirk5"}) methods.push_back(method);
  return methods;
}

// False: no reliable reference, which is reported.
bool make_reference(AccuracyWork& work, LevelAtWork& level) {
  ModelLevel& reported = level.reported;
  reported.effects = level.model->effects.describe();
  reported.coordinates = level.model->free_shafts + level.model->twist_count();
  if (!is_elastic(*level.model)) {
    if (const std::string why = WorkTables::refusal(level.model); !why.empty())
      work.omit(reported.name + ", work equation", why);
    else
      level.tables = std::make_shared<WorkTables>(level.model);
  }
  std::vector<Result> found;
  for (const std::string& method : reference_methods(level)) {
    if (found.size() == 2 || work.interrupted()) break;
    work.progress(fmt::format("reference of {} by {}", reported.name, method), 0);
    SimulateOptions o = work.simulate_options(method, reference_tolerance);
    o.budget = work.options.time / (level.between ? 12 : 4);
    Result r = simulate(level.model, reported.name, o);
    work.log(fmt::format("reference of {} by {}: {:.3g} s{}", reported.name, method, r.statistics.cpu_seconds,
                         r.complete ? "" : "; " + r.diagnosis));
    if (!r.complete) {
      work.last_diagnosis = r.diagnosis;
      work.omit(fmt::format("{}, reference by {}", reported.name, method), r.diagnosis);
      continue;
    }
    (found.empty() ? reported.first : reported.second) = method;
    found.push_back(std::move(r));
  }
  if (found.size() < 2) {
    work.omit(reported.name, "no two methods give a reference that can be trusted");
    return false;
  }
  reported.tolerance = reference_tolerance;
  reported.agreement = std::max(trajectory_difference(*found[1].trajectory, *found[0].trajectory), reference_tolerance);
  for (Figure& f : found[0].figures) {
    const Figure* other = found[1].find(f.name);
    f.error = (other ? std::abs(f.value - other->value) : not_known) + f.resolution;
  }
  level.reference = std::move(found[0]);
  const std::string link = link_of(*level.model);
  if (const Figure* f = level.reference.find(quantities::final_angle, link)) level.end_angle = f->value;
  if (const Figure* f = level.reference.find(quantities::final_speed, link)) level.end_speed = f->value;
  work.log(
      fmt::format("{}: {} and {} agree to {:.1e}", reported.name, reported.first, reported.second, reported.agreement));
  return true;
}

// The level of a model, on top of those before; false: it makes no machine, or no reliable one.
bool add_level(AccuracyWork& work, const ModelRung& rung, bool between) {
  LevelAtWork level{.reported = {.name = rung.name, .called = rung.called},
                    .model = {},
                    .tables = {},
                    .reference = {},
                    .between = between};
  try {
    level.model = compile(work.scene, rung.effects);
  } catch (const SceneError& refusal) {
    work.omit(rung.name, refusal.what());
    return false;
  }
  if (!make_reference(work, level)) return false;
  work.levels.push_back(std::move(level));
  return true;
}

// Removes an effect that an earlier level added without success.
void take_away(const ModelRung& in_vain, const Scene& scene, Effects& effects) {
  if (in_vain.adds) {
    effects.*(in_vain.adds) = false;
  } else {
    effects.all_elastic = scene.effects.all_elastic;
    effects.elastic = scene.effects.elastic;
  }
}

}  // namespace

std::vector<ModelRung> model_rungs(const Scene& scene) { return Rungs(scene).all(); }

// Effects that the scene has on are kept even if a level fails, as it may run with the next effect. Effects that it
// has off are not, and are started only in the first third of the study's time.
void make_levels(AccuracyWork& work) {
  const std::vector<ModelRung> rungs = model_rungs(work.scene);
  const auto own = std::find_if(rungs.begin(), rungs.end(), [](const ModelRung& r) { return !r.of_scene; }) - 1;
  compile(work.scene, own->effects);  // what is wrong with the scene is no omission
  std::vector<ModelRung> in_vain;
  bool lean_is_due = true;
  for (auto r = rungs.begin(); r != rungs.end() && !work.interrupted(); ++r) {
    ModelRung rung = *r;
    if (!rung.of_scene)
      for (const ModelRung& other : in_vain) take_away(other, work.scene, rung.effects);
    if (!rung.of_scene && work.spent() > work.options.time / 3) {
      work.omit(rung.name,
                fmt::format("the levels before took {:.2g} s of the study's {:g} s", work.spent(), work.options.time));
      in_vain.push_back(rung);
      continue;
    }
    const bool elastic = r != rungs.begin() && !rung.adds && std::exchange(lean_is_due, false);  // the first such one
    if (elastic)
      if (const auto lean = lean_rung(work, rung.effects, *compile(work.scene, rung.effects)))
        add_level(work, *lean, false);
    const bool between = r != rungs.begin() && r != own && !elastic;
    if (add_level(work, rung, between)) {
      if (rung.of_scene) work.study.own = work.levels.size() - 1;
    } else if (!rung.of_scene) {
      in_vain.push_back(rung);
    }
  }
  if (lean_is_due) work.omit("elastic", "the scene has no coupling or shaft with a stiffness");
}

}  // namespace kurbel
