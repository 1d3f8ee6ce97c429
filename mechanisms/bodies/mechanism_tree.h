// mechanism_tree.h — any mechanism's description as Simbody's bodies, the source of its first extraction.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

// What bodies are made of.
struct BodiesOf {
  std::string kind;  // "four-bar", for messages
  std::function<PlanarLinkage(long double phi)> linkage;
  double place = 0;  // φ at which the shapes of the links are read off: no dead position or change point [rad]
  int turns = 1;     // of the crank until the links come back, of one without change points
  // Places on bodies whose motion is read off besides, as they are at `place`.
  struct Place {
    int body = PlanarLinkage::frame;
    Path at;
  };
  std::vector<Place> tracked = {};
};

// Throws std::invalid_argument where a link has inertia and no mass.
std::unique_ptr<MechanismBodies> make_bodies(const BodiesOf& of);

// Simbody's bodies in their order, each with the joint of the tree that it moves in: indices of the description. A slider that
// rides as a point mass on what it is pinned to is none of them.
struct BodyInTree {
  int body = 0, joint = 0;
};
std::vector<BodyInTree> tree_of(const BodiesOf& of);

}  // namespace kurbel
