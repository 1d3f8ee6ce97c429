// scene_changes.h — what differs between two scenes' texts: keys and values, not lines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/document.h"

namespace kurbel {

struct SceneChange {
  std::string path;                 // "main_coupling.stiffness", "sequence.steps[2].after"
  std::optional<std::string> a, b;  // as the files have it, in one line; nothing: it is not there
  Location at_a, at_b;              // of the key's value
};

// In the order of the first scene, then what the second alone has. Two texts of the same quantity ("0.9 MN*m/rad" and
// "900 kN*m/rad"), numbers of the same value and comments are no difference.
std::vector<SceneChange> scene_changes(const DocumentValue& a, const DocumentValue& b);

}  // namespace kurbel
