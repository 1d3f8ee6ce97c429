// kinds.cpp — gathers the components of the drive.
#include "drivetrain/kinds.h"

#include "drivetrain/shared/kinds.h"

namespace kurbel {

std::vector<Kind> drivetrain_kinds() {
  std::vector<Kind> all;
  for (std::vector<Kind> (*family)() :
       {inertia_kinds, coupling_kinds, flexible_kinds, clutch_kinds, belt_kinds, fluid_kinds, gearbox_kinds,
        gear_mesh_kinds, planetary_kinds, induction_kinds, dc_kinds, engine_kinds, fluid_motor_kinds, motor_kinds,
        governor_kinds, source_kinds, load_kinds, bearing_kinds, translation_kinds})
    for (Kind& kind : family()) all.push_back(std::move(kind));
  return all;
}

}  // namespace kurbel
