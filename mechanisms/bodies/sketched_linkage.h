// sketched_linkage.h — a linkage that is described by a sketch as bodies and joints at one angle of its driving link, and how it is drawn.
#pragma once

#include <string>
#include <vector>

#include "mechanisms/linkage/linkage.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

// Bodies: the driving link first, the output last. For data without faults.
PlanarLinkage linkage_of(const LinkageData& data, long double phi);

// The driving link's bearing, its next point, all others of the sketch, places on slides.
LinkageDrawing drawing_of(const LinkageData& data);
// In the order of the drawing.
std::vector<PlanePoint> places_of(const LinkageData& data, double phi);

}  // namespace kurbel
