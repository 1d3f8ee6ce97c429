// change_point_cases.cpp — rods barely longer than the crank, links of equal length, offsets at their limit.
#include "tests/hard/families.h"
#include "tests/hard/machines.h"

namespace kurbel::hard {

std::vector<HardCase> change_point_cases() { return {}; }

}  // namespace kurbel::hard
