// rating_keys.h — ratings that do not influence the motion: allowable heat of slipping components, rim speed, torque and
// duty of a motor, inertia of a flywheel. studies/limits compares the loads with them.
#pragma once

#include <optional>

#include "engine/scene/fields.h"

namespace kurbel {

// Rating of a slipping component by its manufacturer; empty: not stated.
struct HeatRating {
  std::optional<double> engagement;  // allowable heat of one engagement [J]
  std::optional<double> power;       // allowable mean power over a run [W]
};
Fields<HeatRating> heat_rating_fields();

// Rating of a flywheel; empty: not stated.
struct RimRating {
  std::optional<double> radius;   // mean radius of the rim r [m]
  std::optional<double> speed;    // allowable r ω [m/s]
  std::optional<double> density;  // ρ [kg/m³]
  std::optional<double> stress;   // allowable hoop stress of the free thin ring, σ = ρ (r ω)² [Pa]
};
Fields<RimRating> rim_rating_fields();

// The duty for which the rated torque of a motor is stated (IEC 60034-1); empty: not stated.
struct DutyRating {
  enum class Duty { none, continuous, short_time, intermittent };  // —, S1, S2, S3
  Duty duty = Duty::none;
  std::optional<double> time;   // S2: allowable duration of M_N [s]
  std::optional<double> share;  // S3: duty cycle, the part of the time with M_N
};
const Fields<DutyRating>& duty_rating_fields();

struct MotorRating {
  std::optional<double> torque = {};     // M_n, given or from rated power and speed [N·m]
  std::optional<double> breakdown = {};  // M_b of an induction motor, at its supply voltage [N·m]
  DutyRating duty;

  bool states_duty() const { return duty.duty != DutyRating::Duty::none; }
};

// A component declared as a flywheel in the scene.
struct Flywheel {
  double inertia = 0;  // [kg·m²]
};

}  // namespace kurbel
