// own_mechanism.h — a mechanism whose motion its user wrote, as data like those of kurbel's own.
#pragma once

#include <kurbel/elements.h>

#include <memory>
#include <string>
#include <vector>

#include "mechanisms/reduced/mechanism_data.h"

namespace kurbel {

struct Scene;

struct OwnMechanismData {
  std::string kind;
  double number = 0;           // of the kind, in the order of their coming: with the values it tells one from another
  std::vector<double> values;  // of its parameters
  MechanismMotion motion;
  double gravity = 0;    // [m/s²]
  double elevation = 0;  // of +x above the horizontal [rad]
};

std::vector<double> values_of(const OwnMechanismData& data);
LinkageDrawing drawing_of(const OwnMechanismData& data);
std::vector<PlanePoint> places_of(const OwnMechanismData& data, double phi);
std::unique_ptr<MechanismBodies> own_bodies(const OwnMechanismData& data);
PlanarLinkage linkage_of(const OwnMechanismData& data, long double phi);

// Throws std::invalid_argument where reactions are asked of a mechanism of this sort: `wanted` by its name, or, where that is
// empty, as the scene has no other.
void refuse_forces_of_own(const Scene& scene, const std::string& wanted);

}  // namespace kurbel
