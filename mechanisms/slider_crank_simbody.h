// slider_crank_simbody.h — the slider-crank as a multibody system: the source of truth for every reduced function of φ.
#pragma once

#include <memory>

#include "mechanisms/slider_crank_geometry.h"

namespace kurbel {

// One configuration seen from the crank; primes are derivatives by φ, all from Simbody's bodies and constraints.
struct ReducedSample {
  double inertia, inertia_slope, inertia_curvature;  // I_r [kg·m²] (2.1), I_r′, I_r″
  double slider_position;                            // x [m]
  double slider_velocity_ratio;                      // x′ = v/ω [m/rad]
  double slider_acceleration_ratio;                  // x″ [m/rad²]
  double rod_angle_ratio;                            // β′ = ω_rod/ω
  double gravity_torque, gravity_torque_slope;  // of all weights on the crank [N·m], positive when it drives; by φ
  double closure_determinant;  // ∂(closure error)/∂(rod angle) = l cos β [m], > 0 on the right branch
};

// Simbody's model of the mechanism, sampled one configuration at a time. Costs some 20 µs a sample; not thread-safe.
class SliderCrankBodies {
 public:
  // Throws std::invalid_argument for data outside its domain.
  explicit SliderCrankBodies(const SliderCrankData& data);
  ~SliderCrankBodies();
  SliderCrankBodies(SliderCrankBodies&&) noexcept;
  SliderCrankBodies& operator=(SliderCrankBodies&&) noexcept;

  // Any φ. Throws std::runtime_error with the numbers if the loop does not close or closes on the wrong branch (cos β <
  // 0).
  ReducedSample sample(double phi);
  // The same with Newton's method started from a given rod angle β [rad].
  ReducedSample sample(double phi, double rod_angle_start);

  // Summed by Simbody over its moving bodies, without I_r.
  double kinetic_energy(double phi, double omega);  // [J]
  // Of all weights, zero at the height of the crank's axis.
  double potential_energy(double phi);  // [J]

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace kurbel
