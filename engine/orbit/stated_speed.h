// stated_speed.h — does a scene state a speed? Otherwise the scale of its speeds follows from torques and inertias, and is
// no quantity of its field.
#pragma once

#include <algorithm>

#include "engine/model/model.h"

namespace kurbel {

// Of an element: its rated speed, or the speeds of its law.
inline bool states_rated_speed(const Model& m) {
  return std::any_of(m.network.elements.begin(), m.network.elements.end(),
                     [](const Network::ShaftElement& e) { return e.element->rated.speed != 0; });
}

// That, or a speed at the start, or a prescribed one.
inline bool states_speed(const Model& m) {
  const StartSettings& start = m.scene.run.start;
  return states_rated_speed(m) || start.speed != 0 ||
         std::any_of(start.components.begin(), start.components.end(),
                     [](const auto& given) { return given.second.speed.value_or(0) != 0; }) ||
         std::any_of(m.network.prescribed.begin(), m.network.prescribed.end(),
                     [](const PrescribedSpeed& given) { return !given.is_nothing(); });
}

}  // namespace kurbel
