// rating_keys.h — what a component states that is no part of its motion: heat that what slips may take, speed of a rim,
// torque and duty of a motor, inertia of a flywheel. Ratings are judged in studies/limits.
#pragma once

#include <optional>

#include "engine/scene/fields.h"

namespace kurbel {

// Of what slips, by its maker's data; empty: not stated.
struct HeatRating {
  std::optional<double> engagement;  // of one engagement [J]
  std::optional<double> power;       // mean over a run [W]
};
Fields<HeatRating> heat_rating_fields();

// Of a flywheel; empty: not stated.
struct RimRating {
  std::optional<double> radius;   // mean radius of the rim r [m]
  std::optional<double> speed;    // allowable r ω [m/s]
  std::optional<double> density;  // ρ [kg/m³]
  std::optional<double> stress;   // allowable hoop stress of the free thin ring, σ = ρ (r ω)² [Pa]
};
Fields<RimRating> rim_rating_fields();

// Of a motor: the duty that its rated torque is stated for (IEC 60034-1); empty: not stated.
struct DutyRating {
  enum class Duty { none, continuous, short_time, intermittent };  // —, S1, S2, S3
  Duty duty = Duty::none;
  std::optional<double> time;   // S2: M_N may act so long [s]
  std::optional<double> share;  // S3: of the time, in which M_N may act
};
const Fields<DutyRating>& duty_rating_fields();

struct MotorRating {
  std::optional<double> torque = {};  // M_n, as it is or by the rated power and speed [N·m]
  std::optional<double> breakdown =
      {};  // M_b of an induction motor by its catalogue, at the voltage that it runs on [N·m]
  DutyRating duty;

  bool states_duty() const { return duty.duty != DutyRating::Duty::none; }
};

// A body that the scene calls a flywheel.
struct Flywheel {
  double inertia = 0;  // [kg·m²]
};

}  // namespace kurbel
