// link_bodies.h — the links of the named mechanisms as bodies of a planar linkage.
#pragma once

#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

// Inertia about its bearing.
PlanarLinkage::Body pivoted(const char* name, const LinkBody& link, const Path& bearing, const Direction& direction);
// Central inertia; `joint`: the point from which its centre of mass is measured.
PlanarLinkage::Body floating(const char* name, const LinkBody& link, const Path& joint, const Direction& direction);
// Adds a slider along x in the frame, pinned to the last body; its weight and its load act in the pin.
void add_slider(PlanarLinkage& to, const char* name, double mass, const char* pin, const Path& at);

}  // namespace kurbel
