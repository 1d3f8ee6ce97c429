// mechanism_tree.h — a Simbody model from the description of any mechanism: it confirms the second extraction.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

// Input of make_bodies.
struct BodiesOf {
  std::string kind;  // "four-bar", for messages
  std::function<PlanarLinkage(long double phi)> linkage;
  double place = 0;  // φ at which the shapes of the links are taken: no dead position or change point [rad]
  int turns = 1;     // turns of the crank in a cycle, for mechanisms without change points
  // Further points on bodies whose motion is sampled, in their position at `place`.
  struct Place {
    int body = PlanarLinkage::frame;
    Path at;
  };
  std::vector<Place> tracked = {};
};

// Throws std::invalid_argument where a link has inertia and no mass.
std::unique_ptr<MechanismBodies> make_bodies(const BodiesOf& of);

// Simbody's bodies in order, each with its inboard joint in the tree: indices of the description. A slider modelled as a
// point mass on the body that it is pinned to is not included.
struct BodyInTree {
  int body = 0, joint = 0;
};
std::vector<BodyInTree> tree_of(const BodiesOf& of);

}  // namespace kurbel
