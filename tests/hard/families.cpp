// families.cpp — the list of families.
#include "tests/hard/families.h"

#include <iterator>

namespace kurbel::hard {

const std::vector<HardCase>& all_cases() {
  static const std::vector<HardCase> cases = [] {
    std::vector<HardCase> all;
    for (const auto family :
         {dead_centre_cases, change_point_cases, stiffness_cases, rigid_limit_cases, long_run_cases, backlash_cases,
          stick_slip_cases, blow_cases, motor_cases, resonance_cases, time_scale_cases, event_cases, extreme_cases,
          clearance_and_rod_cases, jam_cases, loop_cases, formula_cases, swing_cases}) {
      std::vector<HardCase> some = family();
      all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
    }
    return all;
  }();
  return cases;
}

}  // namespace kurbel::hard
