// load_kinds.h — keys of the loads on a mechanism's output.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "engine/scene/fields.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

// A law, or the keys for one that needs the ends of the output's travel, and its account in the energy balance.
template <class Law>
struct LoadKeys : Law {
  Account account = Account::useful;
};
// The end of travel from which a law is measured, and the rounding width of its edges.
struct EdgeKeys {
  bool from_greatest = true;
  std::optional<double> rounding, rounding_angle;  // [m] or [rad], [rad]
};
struct PressKeys : EdgeKeys {
  double force = 0;                                         // F_n [N]
  double travel = 0, rise = 0, breakthrough = 0, drop = 0;  // [m]
};
// A diagram over the crank angle may be that of a misfiring cylinder.
struct MisfireKeys {
  bool misfire = false;
  std::optional<CurveData> motored;  // its diagram; default: compression, mirrored about the dead centre
};
struct TableKeys : EdgeKeys, MisfireKeys {
  CurveData force;  // [N] or [N·m]
};
struct CompressorKeys : CompressorForce {
  bool from_greatest = true;
  double bore = 0;  // [m]
};

// A cylinder on the slider: pressures in one chamber or both.
struct CylinderKeys : MisfireKeys {
  bool from_greatest = true;
  double bore = 0, rod = 0;         // [m]
  CurveData pressure;               // in the chamber at the working end [Pa]
  std::optional<CurveData> behind;  // in the other chamber [Pa]
  double outside = 0;               // [Pa]
};

namespace load_keys {
using PressLoad = LoadKeys<PressKeys>;
using Constant = LoadKeys<ConstantForce>;
using Opposing = LoadKeys<OpposingForce>;
using Medium = LoadKeys<MediumResistance>;
using Table = LoadKeys<TableKeys>;
using Compressor = LoadKeys<CompressorKeys>;
using Cylinder = LoadKeys<CylinderKeys>;
using LinearMotor = LoadKeys<LinearMotorForce>;
}  // namespace load_keys
using LoadReading =
    std::variant<Reading<load_keys::PressLoad>, Reading<load_keys::Constant>, Reading<load_keys::Opposing>,
                 Reading<load_keys::Medium>, Reading<load_keys::Table>, Reading<load_keys::Compressor>,
                 Reading<load_keys::Cylinder>, Reading<load_keys::LinearMotor>>;

const Tables<LoadReading>& slider_loads();  // on sliding outputs
const Tables<LoadReading>& rocker_loads();  // on rocking outputs

// Adds the loads to the mechanism; its ends of travel must be known. Faults go into the messages.
void put_loads(const std::vector<LoadReading>& loads, Mechanism& mechanism);

}  // namespace kurbel
