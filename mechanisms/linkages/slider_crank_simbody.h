// slider_crank_simbody.h — the slider-crank's bodies.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mechanisms/linkages/mechanism_bodies.h"
#include "mechanisms/linkages/slider_crank_geometry.h"

namespace kurbel {

std::vector<double> values_of(const SliderCrankData& data);  // all of them
LinkageDrawing drawing_of(const SliderCrankData& data);
std::optional<CrankArc> arc_of(const SliderCrankData& data);  // of a crank that rocks

// Bodies: crank, rod. Joints: crank axis, crank pin, slider pin. Throws std::invalid_argument for data outside its
// domain.
std::unique_ptr<MechanismBodies> make_bodies(const SliderCrankData& data);

}  // namespace kurbel
