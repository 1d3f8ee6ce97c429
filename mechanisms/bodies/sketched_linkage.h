// sketched_linkage.h — bodies, joints and drawing of a linkage given by a sketch, at one angle of its driving link.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mechanisms/linkage/linkage.h"
#include "mechanisms/linkage/travel.h"
#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/loops/planar_linkage.h"

namespace kurbel {

// Bodies: the driving link first, the output last. The data must be without faults.
PlanarLinkage linkage_of(const LinkageData& data, long double phi);
// Index of the body of a link of the sketch; the frame stays the frame.
int body_of(const PlanarLinkage& bodies, const Linkage& linkage, int link);

// Order: the driving link's bearing, its next point, the other points of the sketch, points on slides.
LinkageDrawing drawing_of(const LinkageData& data);
// The points in the order of the drawing.
std::vector<PlanePoint> places_of(const LinkageData& data, double phi);

// A travel within the linkage: the same bodies without mass, with the travel as their output.
PlanarLinkage linkage_of(const LinkageTravelData& data, long double phi);
LinkageDrawing drawing_of(const LinkageTravelData& data);
// Where the output stands still [m] or [rad], of a path 0: over a cycle it moves by no more than rounding of the linkage's
// size, or of a radian. Empty: it moves.
std::optional<long double> stands_at(const LinkageData& data);
std::optional<long double> stands_at(const LinkageTravelData& data);
// Its samples contain the travel by Simbody's positions, velocities and accelerations; all other members are 0.
std::unique_ptr<MechanismBodies> own_bodies(const LinkageTravelData& data);

}  // namespace kurbel
