// families.h — every family of hard cases; one file each.
#pragma once

#include <vector>

#include "tests/hard/hard_case.h"

namespace kurbel::hard {

std::vector<HardCase> dead_centre_cases();
std::vector<HardCase> change_point_cases();
std::vector<HardCase> stiffness_cases();
std::vector<HardCase> rigid_limit_cases();
std::vector<HardCase> long_run_cases();
std::vector<HardCase> backlash_cases();
std::vector<HardCase> stick_slip_cases();
std::vector<HardCase> blow_cases();
std::vector<HardCase> motor_cases();
std::vector<HardCase> resonance_cases();
std::vector<HardCase> time_scale_cases();
std::vector<HardCase> event_cases();
std::vector<HardCase> extreme_cases();
std::vector<HardCase> clearance_and_rod_cases();
std::vector<HardCase> jam_cases();
std::vector<HardCase> loop_cases();
std::vector<HardCase> formula_cases();
std::vector<HardCase> swing_cases();

// Undamped machines of any length, for the growth of errors.
HardCase free_crank_over(double turns);
HardCase undamped_chain_over(double cycles);

// All of them, in this order; made once.
const std::vector<HardCase>& all_cases();

}  // namespace kurbel::hard
