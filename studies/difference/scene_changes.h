// scene_changes.h — differences of two scenes' texts: keys and values, not lines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/document.h"

namespace kurbel {

struct SceneChange {
  std::string path;                 // "main_coupling.stiffness", "sequence.steps[2].after"
  std::optional<std::string> a, b;  // as in the files, on one line; empty: not present
  Location at_a, at_b;              // of the key's value
};

// In the order of the first scene, then what only the second has. Different texts of the same quantity ("0.9
// MN*m/rad" and "900 kN*m/rad"), numbers of equal value and comments are not reported.
std::vector<SceneChange> scene_changes(const DocumentValue& a, const DocumentValue& b);

}  // namespace kurbel
