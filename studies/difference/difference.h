// difference.h — two machines compared: the differences of their scenes, and the effect on their figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/scene/document.h"
#include "studies/findings/findings.h"
#include "studies/variants/machine.h"

namespace kurbel {

struct SceneChange {
  std::string path;                 // "main_coupling.stiffness", "sequence.steps[2].after"
  std::optional<std::string> a, b;  // as in the files, on one line; empty: not present
  Location at_a, at_b;              // of the key's value
};

// In the order of the first scene, then what only the second has. Different texts of the same quantity ("0.9
// MN*m/rad" and "900 kN*m/rad"), numbers of equal value and comments are not reported.
std::vector<SceneChange> scene_changes(const DocumentValue& a, const DocumentValue& b);

// A figure of both machines, in SI.
struct FigureDifference {
  std::string name, unit;
  std::optional<Estimate> a = {}, b = {};  // empty: that machine has no such figure
  double scale = 0;                        // its usual magnitude
  bool reporting = false;                  // a peak, a speed, a fluctuation: relevant for a headline

  std::optional<Estimate> change() const;  // b − a
  std::optional<double> relative() const;  // b/a − 1; empty if a does not differ from zero
  double weight() const;                   // |b − a| over the greatest of |a|, |b| and scale
  bool differs() const;                    // by more than both errors; if none is known, at all
};

struct MachineDifference {
  std::string of;  // "run", "steady", "modes", "size"
  MachineAnswer a, b;
  std::vector<FigureDifference> figures = {};  // in the order of the first machine, then those of the second only
  std::vector<SceneChange> changes = {};

  bool complete() const { return a.done() && b.done(); }
  const SpeedUnit& speed_unit() const { return a.speed_unit; }
};

// Asks both scenes the same question. Throws SceneError for either, and std::invalid_argument.
MachineDifference difference_between(const MachineQuestion& a, const MachineQuestion& b, const std::string& of);

Findings findings_of(const MachineDifference& difference);

}  // namespace kurbel
