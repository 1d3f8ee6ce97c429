// families.h — every family of hard cases; one file each.
#pragma once

#include <vector>

#include "tests/hard/hard_case.h"

namespace kurbel::hard {

std::vector<HardCase> dead_centre_cases();
std::vector<HardCase> change_point_cases();

// All of them, in this order; made once.
const std::vector<HardCase>& all_cases();

}  // namespace kurbel::hard
