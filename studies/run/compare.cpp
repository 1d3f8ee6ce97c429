// compare.cpp — differences, amplification factors, and a sentence that says what they mean.
#include "studies/run/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/scene/units.h"
#include "studies/findings/figure_changes.h"
#include "studies/findings/figure_text.h"
#include "studies/run/run_findings.h"

namespace kurbel {
namespace {

void add_rows(Comparison& c) {
  for (const Figure& f : c.b.figures) {
    if (!is_told(f, c.b)) continue;
    ComparisonRow row{f.name, f.unit, {}, {}, f.value, f.error, 0, {}, f.what, f.of};
    if (const Figure* other = c.a.find(f.name); other && is_told(*other, c.a)) {
      row.a = other->value;
      row.a_error = other->error;
      row.difference = f.value - other->value;
      // Over what is zero but for its error there is no ratio.
      if (std::isfinite(f.value) && std::abs(other->value) > floor_of(*other, c.a)) row.ratio = f.value / other->value;
    }
    c.rows.push_back(std::move(row));
  }
  for (const ComparisonRow& row : c.rows) {
    if (row.what != QuantityKind::peak_torque || !row.ratio) continue;
    const Name name = Name::make(QuantityKind::amplification, row.of);
    ComparisonRow factor{name.text, "", {}, {}, std::abs(*row.ratio), {}, 0, {}, name.what, name.of};
    if (row.a_error && row.b_error)
      factor.b_error = std::abs(*row.ratio) * (*row.a_error / std::abs(*row.a) + *row.b_error / std::abs(*row.b));
    c.amplification.push_back(std::move(factor));
  }
}

// Torques that joints transmit just after the start, whatever the trajectory's output is restricted to.
std::map<std::string, double> torques_at_start(const Result& result) {
  Equations equations(result.model, false);
  const std::vector<double> y = equations.start(0);
  const Snapshot& s = equations.snapshot(0, y);
  std::map<std::string, double> torques;
  for (const TorqueJoint& joint : result.model->torque_joints) torques[joint.component] = s.joint_torque[joint.joint];
  return torques;
}

// Loads that come all at once: stiffening never brings the elastic peak down to the rigid one (theory 5.15).
void note_sudden_loads(Comparison& c) {
  if (c.b.model && !c.b.model->has_springs()) return;  // nothing swings
  std::vector<std::string> sudden;
  const std::map<std::string, double> rigid_torques = torques_at_start(c.a), elastic_torques = torques_at_start(c.b);
  for (const ComparisonRow& row : c.amplification) {
    const std::string& joint = row.of;
    const auto rigid = rigid_torques.find(joint), elastic = elastic_torques.find(joint);
    const Figure* peak = c.a.find(QuantityKind::peak_torque, joint);
    if (rigid == rigid_torques.end() || elastic == elastic_torques.end() || !peak) continue;
    if (std::abs(rigid->second - elastic->second) > 0.05 * std::abs(peak->value))
      sudden.push_back(fmt::format("at the start {} jumps from {} to {}", joint, with_unit(elastic->second, "N*m", 4),
                                   with_unit(rigid->second, "N*m", 4)));
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
                    "): however stiff the drive, after a step its peak torque tends not to the rigid one but to as "
                    "much as twice it, the less it is damped; the motion does converge");
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
  const auto worst = std::max_element(c.amplification.begin(), c.amplification.end(),
                                      [](const ComparisonRow& x, const ComparisonRow& y) {
                                        return std::abs(std::log(*x.b)) < std::abs(std::log(*y.b));
                                      });
  if (worst != c.amplification.end() && *worst->b > 0) {
    const std::string& joint = worst->of;
    const Figure* peak = c.b.find(QuantityKind::peak_torque, joint);
    c.conclusion = fmt::format("The {} model's peak torque in {} is {}, {:.3g} × the {} model's", c.b.label, joint,
                               with_error(std::abs(peak->value), peak->error, "N*m"), *worst->b, c.a.label);
  }
  for (const ComparisonRow& row : c.rows) {
    const bool repeats = row.what == QuantityKind::delta;
    if (!row.ratio || !(repeats || row.what == QuantityKind::cycle_fluctuation)) continue;
    const char* what = repeats ? "δ" : "the fluctuation in the last cycle, which is not steady,";
    c.conclusion += (c.conclusion.empty() ? "" : "; ") +
                    (*row.ratio > 2 ? fmt::format("{} is {:.3g} × as great", what, *row.ratio)
                                    : fmt::format("{} changes by {:+.2g} %", what, 100 * (*row.ratio - 1)));
  }
  if (c.conclusion.empty()) c.conclusion = "The two models have no coupling's torque and no cycle in common to compare";
  c.conclusion += fmt::format("; the {} model costs {:.3g} × the time.", c.b.label,
                              c.b.statistics.cpu_seconds / std::max(c.a.statistics.cpu_seconds, 1e-9));
  for (const Result* r : {&c.a, &c.b})
    if (r->unconfirmed())
      c.conclusion += fmt::format(" NOT confirmed, {} model: {}.", r->label, r->accuracy_in_words());
}

}  // namespace

Comparison compare(const Scene& scene, const Effects& a, const std::string& label_a, const Effects& b,
                   const std::string& label_b, const SimulateOptions& options) {
  Comparison c;
  c.title = scene.heading();
  c.a = simulate(scene, a, label_a, options);
  c.b = simulate(scene, b, label_b, options);
  add_rows(c);
  if (c.a.trajectory && c.b.trajectory) note_sudden_loads(c);
  conclude(c);
  return c;
}

}  // namespace kurbel
