// quantity_place.h — the one quantity of a scene that a path names: "main_coupling.stiffness".
#pragma once

#include <string>
#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

struct QuantityPlace {
  const Setting* setting = nullptr;  // null: the path leads to none that is given
  const Key* key = nullptr;
};
// The setting of a component's key that holds one quantity, or of one in a table within it.
QuantityPlace quantity_place(const std::vector<Section>& sections, const std::string& path);
// To change it; null: there is none.
Setting* quantity_at(std::vector<Section>& sections, const std::string& path);

}  // namespace kurbel
