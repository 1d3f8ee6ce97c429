// compare.cpp — differences, amplification factors, and a sentence on their meaning.
#include "studies/run/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "engine/scene/units.h"
#include "mechanisms/deforming/deforming_mechanism.h"
#include "studies/findings/figure_changes.h"
#include "studies/findings/figure_text.h"
#include "studies/run/run_findings.h"

namespace kurbel {
namespace {

constexpr double stands_within_the_cycle = 2;  // of a fluctuation: ω_min ≤ 0 from there on

void add_rows(Comparison& c) {
  for (const Figure& f : c.b.figures) {
    if (!is_reported(f, c.b)) continue;
    ComparisonRow row{f.name, f.unit, {}, f, 0, {}, f.what, f.of};
    if (const Figure* other = c.a.find(f.name); other && is_reported(*other, c.a)) {
      row.a = *other;
      row.difference = f.value - other->value;
      // No ratio if the denominator is within its error of zero.
      if (std::isfinite(f.value) && std::abs(other->value) > floor_of(*other, c.a)) row.ratio = f.value / other->value;
    }
    c.rows.push_back(std::move(row));
  }
  for (const ComparisonRow& row : c.rows) {
    if (row.what != quantities::peak_torque || !row.ratio) continue;
    const Name name = Name::make(quantities::amplification, row.of);
    c.amplification.push_back({name.text, "", {}, abs(*row.b / *row.a), 0, {}, name.what, name.of});
  }
}

// Torques of joints just after the start, independent of the trajectory's selected channels.
std::map<std::string, double> torques_at_start(const Result& result) {
  Equations equations(result.model, false);
  const std::vector<double> y = equations.start(0);
  const Snapshot& s = equations.snapshot(0, y);
  std::map<std::string, double> torques;
  for (const TorqueJoint& joint : result.model->torque_joints) torques[joint.component] = joint.torque(s.joint_torque);
  return torques;
}

// Suddenly applied loads: even for large stiffness the elastic peak exceeds the rigid one (theory 5.15).
void note_sudden_loads(Comparison& c) {
  if (c.b.model && !is_elastic(*c.b.model)) return;  // nothing vibrates
  if (c.a.model && is_elastic(*c.a.model)) return;   // both do
  std::vector<std::string> sudden;
  const std::map<std::string, double> rigid_torques = torques_at_start(c.a), elastic_torques = torques_at_start(c.b);
  for (const ComparisonRow& row : c.amplification) {
    const std::string& joint = row.of;
    const auto rigid = rigid_torques.find(joint), elastic = elastic_torques.find(joint);
    const Figure* peak = c.a.find(quantities::peak_torque, joint);
    if (rigid == rigid_torques.end() || elastic == elastic_torques.end() || !peak) continue;
    const auto text = [&](double torque) {
      return with_unit(without_rounding({torque, {}}, peak->value).value, "N*m", 4);
    };
    if (std::abs(rigid->second - elastic->second) > 0.05 * std::abs(peak->value))
      sudden.push_back(
          fmt::format("at the start {} jumps from {} to {}", joint, text(elastic->second), text(rigid->second)));
  }
  const auto edges = std::count_if(c.b.events.begin(), c.b.events.end(), [](const Event& e) {
    return e.kind == EventKind::load_edge || e.kind == EventKind::window;
  });
  if (edges > 0)
    sudden.push_back(fmt::format("{} load edge{} or switching{}", edges, edges > 1 ? "s" : "", edges > 1 ? "s" : ""));
  if (sudden.empty()) return;
  std::string text = "sudden loads (";
  for (std::size_t i = 0; i < sudden.size() && i < 3; ++i) text += (i ? "; " : "") + sudden[i];
  c.notes.push_back(text +
                    "): even in a very stiff drive the peak torque after a step exceeds the rigid one, by up to a "
                    "factor of two without damping; the motion itself converges to the rigid one");
}

// Amplifications without those of the vibration in which the run begins, which are noted.
std::vector<ComparisonRow> peaks_of_motion(Comparison& c) {
  std::vector<ComparisonRow> rows;
  std::string first;
  std::size_t others = 0;
  for (const ComparisonRow& row : c.amplification) {
    const Figure* peak = c.b.find(quantities::peak_torque, row.of);
    const std::string words = peak ? words_of_start(c.b, *peak) : "";
    if (words.empty())
      rows.push_back(row);
    else if (first.empty())
      first = fmt::format("{} reaches {}{}", row.of, short_text(peak->value, peak->unit), words);
    else
      ++others;
  }
  if (!first.empty())
    c.notes.push_back(
        fmt::format("the run begins in no steady motion: the torque in {}{}. Such a peak belongs to no motion of the "
                    "machine and is not compared",
                    first, others > 0 ? fmt::format("; likewise in {} more", others) : ""));
  return rows;
}

// "; both with joint friction": effects common to both beyond the bare machine.
std::string shared(const Comparison& c) {
  const std::string none = "none";
  if (c.in_both == none) return "";
  if (c.in_both.starts_with(none + ", ")) return "; both" + c.in_both.substr(none.size() + 1);
  return "; both with " + c.in_both;
}

void conclude(Comparison& c) {
  if (!c.a.complete || !c.b.complete) {
    c.conclusion = fmt::format("A model did not run to the end: {}", c.a.complete ? c.b.diagnosis : c.a.diagnosis);
    return;
  }
  if (c.a.effects == c.b.effects) {
    c.conclusion = c.a.effects == "none"
                       ? "Both models are the same rigid machine: the scene has no effect to switch on"
                       : "Both models are the same: " + c.a.effects;
    c.conclusion += ".";
    return;
  }
  const std::vector<ComparisonRow> peaks = peaks_of_motion(c);
  const auto worst = std::max_element(peaks.begin(), peaks.end(), [](const ComparisonRow& x, const ComparisonRow& y) {
    return std::abs(std::log(x.b->value)) < std::abs(std::log(y.b->value));
  });
  if (worst != peaks.end() && worst->b->value > 0) {
    const std::string& joint = worst->of;
    const Figure* peak = c.b.find(quantities::peak_torque, joint);
    const double ratio = worst->b->value;
    c.conclusion =
        fmt::format("The {} model's peak torque in {} is {}, {} the {} model's", c.b.label, joint,
                    with_unit(std::abs(peak->value), "N*m", 4),
                    std::abs(ratio - 1) < 0.005 ? "within 0.5 % of" : fmt::format("{:.3g} ×", ratio), c.a.label);
  }
  for (const ComparisonRow& row : c.rows) {
    const bool repeats = row.what == quantities::delta;
    if (!row.ratio || !(repeats || row.what == quantities::cycle_fluctuation)) continue;
    if (row.b->value >= stands_within_the_cycle) continue;
    const char* what = repeats ? "δ" : "the fluctuation in the last cycle, which is not steady,";
    c.conclusion += (c.conclusion.empty() ? "" : "; ") +
                    (*row.ratio > 2 ? fmt::format("{} is {:.3g} × that of the {} model", what, *row.ratio, c.a.label)
                                    : fmt::format("{} changes by {:+.2g} %", what, 100 * (*row.ratio - 1)));
  }
  if (c.conclusion.empty()) c.conclusion = "The two models have no coupling's torque and no cycle in common to compare";
  const double time = c.b.statistics.cpu_seconds / std::max(c.a.statistics.cpu_seconds, 1e-9);
  c.conclusion += time < alike_in_time && time > 1 / alike_in_time
                      ? fmt::format("; the {} model costs about the same time{}.", c.b.label, shared(c))
                      : fmt::format("; the {} model costs {:.2g} × the time{}.", c.b.label, time, shared(c));
}

}  // namespace

bool is_elastic(const Model& model) {
  return (model.effects.flexible_rod && further_coordinates(model) > 0) ||
         std::any_of(model.elastic.begin(), model.elastic.end(),
                     [](const ElasticJoint& e) { return !e.slips && !e.springless; });
}

Effects rigid_twin(const Model& elastic) {
  Effects rigid = without_elasticity(elastic.effects);
  rigid.lags_rigid = std::any_of(elastic.internal_states.begin(), elastic.internal_states.end(),
                                 [](const PlacedInternalState& own) { return own.state.lags; });
  return rigid;
}

ModelPair models_to_compare(const Scene& scene, const std::optional<Effects>& effects,
                            const std::optional<Effects>& against) {
  const auto elastic = [&](const Effects& e) { return is_elastic(*compile(scene, e)); };
  ModelPair pair;
  pair.b = effects.value_or(scene.effects);
  // Without other requests, elasticity is compared.
  if (!effects && (against ? pair.b.describe() == "none" : !elastic(pair.b))) {
    Effects all = pair.b;
    all.all_elastic = true;
    if (elastic(all)) pair.b = all;
  }
  const auto b_model = compile(scene, pair.b);
  const Effects rigid = rigid_twin(*b_model);
  pair.a = against ? *against : is_elastic(*b_model) ? rigid : bare_machine(pair.b);
  const std::string a = pair.a.describe(), b = pair.b.describe();
  if (a == b && (effects || against))
    throw std::invalid_argument(
        fmt::format("both models have the same effects ({}); choose others with --effects and --against", b));
  const bool of_scene = !effects || b == scene.effects.describe();
  if (a == b)
    pair.label_a = "rigid", pair.label_b = "same";
  else if (is_elastic(*b_model) && (a == rigid.describe() || a == without_elasticity(pair.b).describe()))
    pair.label_a = "rigid", pair.label_b = "elastic";
  else if (a == bare_machine(pair.a).describe())
    pair.label_a = "bare", pair.label_b = of_scene ? "full" : "second";
  else
    pair.label_a = "first", pair.label_b = "second";
  return pair;
}

Comparison compare(const Scene& scene, const ModelPair& models, const SimulateOptions& options) {
  Comparison c;
  c.title = scene.heading();
  SimulateOptions timed = options;
  timed.timed = true;
  c.a = simulate(scene, models.a, models.label_a, timed);
  c.b = simulate(scene, models.b, models.label_b, timed);
  const Effects both = in_both(models.a, models.b);
  c.in_both = both.describe(), c.lag_in_both = both.torque_lag && both.lags_rigid;
  add_rows(c);
  if (c.a.trajectory && c.b.trajectory) note_sudden_loads(c);
  conclude(c);
  return c;
}

}  // namespace kurbel
