// kinds.h — the components of the drive as a scene may name them, each with its table of keys.
#pragma once

#include <vector>

#include "engine/keys.h"

namespace kurbel {

std::vector<Kind> drivetrain_kinds();  // all of these:

std::vector<Kind> inertia_kinds();
std::vector<Kind> clutch_kinds();
std::vector<Kind> bearing_kinds();
std::vector<Kind> coupling_kinds();
std::vector<Kind> flexible_kinds();
std::vector<Kind> belt_kinds();
std::vector<Kind> fluid_kinds();
std::vector<Kind> gearbox_kinds();
std::vector<Kind> planetary_kinds();
std::vector<Kind> gear_mesh_kinds();
std::vector<Kind> motor_kinds();
std::vector<Kind> induction_kinds();
std::vector<Kind> dc_kinds();
std::vector<Kind> engine_kinds();
std::vector<Kind> fluid_motor_kinds();
std::vector<Kind> governor_kinds();
std::vector<Kind> source_kinds();
std::vector<Kind> load_kinds();

}  // namespace kurbel
