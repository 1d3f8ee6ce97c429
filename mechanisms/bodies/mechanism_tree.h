// mechanism_tree.h — any mechanism's description as Simbody's bodies, the source of its first extraction.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

// What bodies are made of.
struct BodiesOf {
  std::string kind;  // "four-bar", for messages
  std::function<PlanarLinkage(long double phi)> linkage;
  double place = 0;  // φ at which the shapes of the links are read off: no dead position or change point [rad]
  int turns = 1;     // of the crank until the links come back, of one without change points
};

// Throws std::invalid_argument where a link has inertia and no mass.
std::unique_ptr<MechanismBodies> make_bodies(const BodiesOf& of);

}  // namespace kurbel
