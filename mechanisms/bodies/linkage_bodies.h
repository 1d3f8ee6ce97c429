// linkage_bodies.h — any linkage as Simbody's bodies, and how it is drawn.
#pragma once

#include <memory>

#include "mechanisms/linkage/linkage.h"
#include "mechanisms/linkages/mechanism_bodies.h"

namespace kurbel {

// Joints: the driving link's bearing, its next point, all others of the sketch, places on slides.
LinkageDrawing drawing_of(const LinkageData& data);

// Bodies: the driving link, then the others as a tree along the joints, slides first. For data without faults.
std::unique_ptr<MechanismBodies> make_bodies(const LinkageData& data);

}  // namespace kurbel
