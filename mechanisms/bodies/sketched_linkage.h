// sketched_linkage.h — a linkage that is described by a sketch as bodies and joints at one angle of its driving link, and how it is drawn.
#pragma once

#include <memory>
#include <vector>

#include "mechanisms/linkage/linkage.h"
#include "mechanisms/linkage/travel.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

// Bodies: the driving link first, the output last. For data without faults.
PlanarLinkage linkage_of(const LinkageData& data, long double phi);
// Which of them a link of the sketch is; the frame is itself.
int body_of(const PlanarLinkage& bodies, const Linkage& linkage, int link);

// The driving link's bearing, its next point, all others of the sketch, places on slides.
LinkageDrawing drawing_of(const LinkageData& data);
// In the order of the drawing.
std::vector<PlanePoint> places_of(const LinkageData& data, double phi);

// A travel within the linkage: the same bodies without mass, with the travel as their output.
PlanarLinkage linkage_of(const LinkageTravelData& data, long double phi);
LinkageDrawing drawing_of(const LinkageTravelData& data);
// Its sample has the travel by the positions, velocities and accelerations of Simbody's bodies; all else is 0.
std::unique_ptr<MechanismBodies> own_bodies(const LinkageTravelData& data);

}  // namespace kurbel
