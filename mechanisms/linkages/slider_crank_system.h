// slider_crank_system.h — the slider-crank as Simbody bodies, for extraction and multibody run (C++17 island).
//
//   ground ─Pin(q₀ = φ)→ crank ─Pin(q₁ = β − φ)→ rod with the slider's mass at its end ─PointInPlane→ y = e
//
// The slider only translates and its pin is the rod's end, so its mass may ride there: one constraint closes the loop,
// the cheapest of the closures that were measured. The closure's determinant is l cos β.
#pragma once

#include "mechanisms/linkages/planar_system.h"
#include "mechanisms/linkages/slider_crank_geometry.h"

namespace kurbel {

struct SliderCrankSystem : PlanarSystem {
  explicit SliderCrankSystem(const SliderCrankData& data,
                             double shaft_inertia = 0);  // extra inertia on the crank's axis [kg·m²]

  SliderCrankData data;
  SimTK::MobilizedBody::Pin crank, rod;
};

}  // namespace kurbel
