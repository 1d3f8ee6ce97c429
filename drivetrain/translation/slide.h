// slide.h — a slide moved in a straight line by a shaft: its mass, its direction, the forces on it.
#pragma once

#include <optional>
#include <string>

#include "engine/elements/element.h"
#include "engine/scene/fields.h"

namespace kurbel {

class Network;

struct SlideKeys {
  double mass = 0;         // m [kg]
  double inclination = 0;  // β of the direction of drive above the horizontal [rad]
  double gravity = 0;      // g [m/s²]
  double friction = 0;     // μ of the guide
  double force = 0;        // F₀ [N]
  bool always_backwards = false;
  double viscous = 0, quadratic = 0;  // [N·s/m], [N·s²/m²]
  std::optional<CurveData> table;     // [N]
  Account work = Account::useful;
  double start = 0;  // s at the start [m]
};
Fields<SlideKeys> slide_fields();

// Puts mass and forces on the node whose shaft moves the slide by `per_radian` [m/rad], and adds the channels position,
// velocity, acceleration and force, in m, s and N.
void put_slide(const SlideKeys& slide, const std::string& component, int node, double per_radian, Network& net);

}  // namespace kurbel
