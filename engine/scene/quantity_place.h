// quantity_place.h — finds a quantity of a scene by its path: "main_coupling.stiffness".
#pragma once

#include <string>
#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

struct QuantityPlace {
  const Setting* setting = nullptr;  // null: the path leads to no given quantity
  const Key* key = nullptr;
};
// The setting of a component's key with one quantity, or of a key in a table within it.
QuantityPlace quantity_place(const std::vector<Section>& sections, const std::string& path);
// The same for changes; null: none.
Setting* quantity_at(std::vector<Section>& sections, const std::string& path);

}  // namespace kurbel
