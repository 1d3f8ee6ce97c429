// slider_crank_system.h — the slider-crank as Simbody bodies, for extraction and multibody run (C++17 island).
//
//   ground ─Pin(q₀ = φ)→ crank ─Pin(q₁ = β − φ)→ rod with the slider's mass at its end ─PointInPlane→ y = e
//
// The slider only translates and its pin is the rod's end, so its mass may ride there: one constraint closes the loop,
// the cheapest of the closures that were measured.
#pragma once

#include <Simbody.h>

#include <memory>

#include "mechanisms/simbody_reduction.h"
#include "mechanisms/slider_crank_geometry.h"

namespace kurbel {

struct SliderCrankSystem {
  SliderCrankSystem(const SliderCrankData& data,
                    double shaft_inertia = 0);  // extra inertia on the crank's axis [kg·m²]
  SliderCrankSystem(const SliderCrankSystem&) = delete;
  SliderCrankSystem& operator=(const SliderCrankSystem&) = delete;

  // Ends the construction (forces may be added before) and returns the state that the system starts from.
  SimTK::State realize_topology();

  // Closes the loop at φ and reduces; throws std::runtime_error with the numbers on any branch but cos β > 0.
  // Newton's method starts from the rod angle β of the right branch unless another start is given.
  Reduction reduce_at(SimTK::State& state, double phi) const;
  Reduction reduce_at(SimTK::State& state, double phi, double rod_angle_start) const;

  static constexpr std::size_t crank_point = 0, rod_point = 1, slider_point = 2;  // tracked: centres of mass

  SliderCrankData data;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::MobilizedBody::Pin crank, rod;
  std::unique_ptr<SimbodyReduction> reduction;  // made by realize_topology()
};

}  // namespace kurbel
