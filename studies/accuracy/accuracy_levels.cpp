// accuracy_levels.cpp — levels of modelling of a scene, and their references by two methods.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "studies/run/compare.h"
#include "studies/accuracy/accuracy_work.h"

namespace kurbel {
namespace {

void add_level(AccuracyWork& work, const std::string& name, const Effects& effects) {
  work.levels.push_back({.told = {.name = name}, .model = compile(work.scene, effects), .tables = {}, .reference = {}});
}

// What a run with these effects says of a machine's strain; empty where it fails.
std::map<std::string, double> peaks(const AccuracyWork& work, const Effects& effects) {
  std::map<std::string, double> found;
  const Result r = simulate(work.scene, effects, "", work.simulate_options("auto", 1e-6));
  if (!r.complete) return found;
  for (const Figure& f : r.figures)
    if (f.what == QuantityKind::peak_torque || f.what == QuantityKind::delta ||
        f.what == QuantityKind::cycle_fluctuation)
      found[f.name] = f.value;
  return found;
}

// The one elastic element that alone comes nearest to the full model's peaks.
void add_lean(AccuracyWork& work, const Effects& full, const Model& model) {
  const std::map<std::string, double> wanted = peaks(work, full);
  std::set<std::string> candidates;
  for (const ElasticJoint& e : model.elastic) candidates.insert(model.network.joints[at(e.joint)].component);
  constexpr std::size_t most_candidates = 8;
  if (candidates.size() > most_candidates) {
    work.omit("elastic lean", fmt::format("{} elastic elements are too many to try each alone", candidates.size()));
    return;
  }
  double nearest = HUGE_VAL;
  std::string best;
  Effects lean;
  for (const std::string& component : candidates) {
    Effects one = full;
    one.all_elastic = false;
    one.elastic = {component.substr(0, component.find('.'))};
    if (work.interrupted()) return;
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
    if (difference < nearest) nearest = difference, best = one.elastic.front(), lean = one;
  }
  if (best.empty()) return work.omit("elastic lean", "no single elastic element makes a model that runs");
  add_level(work, "elastic: " + best, lean);
}

// Independent of each other: other variables (angle against time), another table, or another family.
std::vector<std::string> reference_methods(const LevelAtWork& level) {
  std::vector<std::string> methods;
  if (level.tables) methods.push_back("work");
  for (const char* method : {"dop853", "verner6", "esdirk5"}) methods.push_back(method);
  return methods;
}

void make_reference(AccuracyWork& work, LevelAtWork& level) {
  ModelLevel& told = level.told;
  told.effects = level.model->effects.describe();
  told.coordinates = level.model->free_shafts + level.model->twist_count();
  if (!is_elastic(*level.model)) {
    if (const std::string why = WorkTables::refusal(level.model); !why.empty())
      work.omit(told.name + ", work equation", why);
    else
      level.tables = std::make_shared<WorkTables>(level.model);
  }
  std::vector<Result> found;
  for (const std::string& method : reference_methods(level)) {
    if (found.size() == 2 || work.interrupted()) break;
    work.progress(fmt::format("reference of {} by {}", told.name, method), 0);
    SimulateOptions o = work.simulate_options(method, reference_tolerance);
    o.budget = work.options.time / 4;
    Result r = simulate(level.model, told.name, o);
    work.log(fmt::format("reference of {} by {}: {:.3g} s{}", told.name, method, r.statistics.cpu_seconds,
                         r.complete ? "" : "; " + r.diagnosis));
    if (!r.complete) {
      work.last_diagnosis = r.diagnosis;
      work.omit(fmt::format("{}, reference by {}", told.name, method), r.diagnosis);
      continue;
    }
    (found.empty() ? told.first : told.second) = method;
    found.push_back(std::move(r));
  }
  if (found.size() < 2) {
    level.reference.complete = false;
    work.omit(told.name, "no two methods give a reference that can be trusted");
    return;
  }
  told.tolerance = reference_tolerance;
  told.agreement = std::max(trajectory_difference(*found[1].trajectory, *found[0].trajectory), reference_tolerance);
  for (Figure& f : found[0].figures) {
    const Figure* other = found[1].find(f.name);
    f.error = (other ? std::abs(f.value - other->value) : not_known) + f.resolution;
  }
  level.reference = std::move(found[0]);
  const std::string link = link_of(*level.model);
  if (const Figure* f = level.reference.find(QuantityKind::final_angle, link)) level.end_angle = f->value;
  if (const Figure* f = level.reference.find(QuantityKind::final_speed, link)) level.end_speed = f->value;
  work.log(fmt::format("{}: {} and {} agree to {:.1e}", told.name, told.first, told.second, told.agreement));
}

}  // namespace

void choose_levels(AccuracyWork& work) {
  add_level(work, "rigid", {});
  Effects full = work.scene.effects;
  if (full.describe() == "none") full.all_elastic = true;
  const auto model = compile(work.scene, full);
  if (!is_elastic(*model) && (full.joint_clearance || full.flexible_rod))
    work.omit("joint clearance and flexible rod", "the levels are those of ideal joints and a rigid rod");
  if (!is_elastic(*model) && !full.joint_friction) {
    work.omit("elastic", "the scene has no coupling or shaft with a stiffness");
    return;
  }
  const std::string name = !is_elastic(*model) ? "joint friction" : "elastic";
  if (model->elastic.size() > 1)
    add_lean(work, full, *model);
  else if (is_elastic(*model))
    work.omit("elastic lean", "one elastic element only: the lean model is the full one");
  work.levels.push_back({.told = {.name = name}, .model = model, .tables = {}, .reference = {}});
}

void make_references(AccuracyWork& work) {
  for (LevelAtWork& level : work.levels) make_reference(work, level);
  std::erase_if(work.levels, [](const LevelAtWork& level) { return !level.reference.complete; });
}

}  // namespace kurbel
