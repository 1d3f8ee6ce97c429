// kinds.h — the kinds of components of the drive by family; each is defined in NAME_kinds.cpp of its folder.
#pragma once

#include <vector>

#include "engine/scene/keys.h"

namespace kurbel {

// drivetrain/couplings
std::vector<Kind> coupling_kinds();
std::vector<Kind> flexible_kinds();
std::vector<Kind> fluid_kinds();
// drivetrain/friction
std::vector<Kind> clutch_kinds();
std::vector<Kind> belt_kinds();
std::vector<Kind> bearing_kinds();
// drivetrain/gears
std::vector<Kind> gearbox_kinds();
std::vector<Kind> gear_mesh_kinds();
std::vector<Kind> planetary_kinds();
// drivetrain/induction
std::vector<Kind> induction_kinds();
// drivetrain/loads
std::vector<Kind> inertia_kinds();
std::vector<Kind> load_kinds();
// drivetrain/motors
std::vector<Kind> dc_kinds();
std::vector<Kind> engine_kinds();
std::vector<Kind> fluid_motor_kinds();
std::vector<Kind> motor_kinds();
std::vector<Kind> governor_kinds();
std::vector<Kind> source_kinds();
// drivetrain/translation
std::vector<Kind> translation_kinds();

}  // namespace kurbel
