// own_mechanism.h — a mechanism with user-defined motion, as data like kurbel's own mechanisms.
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
  double number = 0;           // number of the kind, by registration; identifies it together with values
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

// Throws std::invalid_argument if reactions are requested for a mechanism of this sort: `wanted` by name or, if
// empty, because the scene has no other.
void refuse_forces_of_own(const Scene& scene, const std::string& wanted);

}  // namespace kurbel
