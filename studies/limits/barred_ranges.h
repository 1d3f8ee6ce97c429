// barred_ranges.h — speed ranges in which the drive must not run continuously.
//
// A joint with limits is barred where its vibration lifts its steady load above any of them except T_KN (theory 12.9):
// nothing is barred where nothing excites, nor where the mean torque, which at speeds that are not held accelerates
// the machine, is beyond a limit by itself. A joint without limits is barred by a rule:
//     T_W > f · max(|T_mean|, T_rated)                                                 (theory 12.12)
// Loads are torques without the factors of a standard; these reduce the limit instead: T_W ≤ T_KW/(S_t S_f).
// A ship's shaft is barred where its stress exceeds τ_C of UR M68, which falls with the speed; around a resonance at
// least from 16 n_c/(18 − λ_c) to (18 − λ_c) n_c/16 (drivetrain/couplings/shaft_rating.h).
// T_rated: the drive's rated torque, reduced to this joint; it does not vanish with the mean. A joint with backlash
// whose torque changes sign, T_W > |T_mean|, hammers: reported separately.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/limits/joint_loads.h"

namespace kurbel {

struct BarredRange {
  enum class By { limit, rule, sign };
  std::size_t joint = 0;
  double from = 0, to = 0;     // [rad/s]
  double limit = 0, peak = 0;  // at the largest excess [N·m]
  std::string reason;          // "vibratory_torque", "1 × rated torque", "torque changes sign", …
  By by = By::limit;
  bool everywhere = false;  // the whole examined range is barred
  double worst = 0;         // speed of the largest excess [rad/s]
};
const char* name_of(BarredRange::By by);

// Steady loads of all joints, in their order, at one speed of the reduction link [rad/s].
struct SpeedLoads {
  double speed = 0;
  std::vector<JointLoad> joints;
};

// `sweep` by ascending speed. Ends of ranges between two of its points are found as roots if `at` gives the loads at
// any speed, otherwise by linear interpolation.
std::vector<BarredRange> barred_ranges(const std::vector<LimitedJoint>& joints, const std::vector<SpeedLoads>& sweep,
                                       double factor,
                                       const std::function<std::vector<JointLoad>(double speed)>& at = {});

// Ranges in which the mean torque alone is beyond the maximum torque or the shear stress: they are not assessed.
std::vector<BarredRange> beyond_by_mean(const std::vector<LimitedJoint>& joints, const std::vector<SpeedLoads>& sweep,
                                        const std::function<std::vector<JointLoad>(double speed)>& at = {});

// Load of a joint over its allowable load at one speed of the link: for the limit with the highest utilisation;
// without limits, for that of the rule.
double share_of_bearable(const LimitedJoint& joint, const JointLoad& load, double speed, double factor);

// The range with the largest excess, those by limits first; null: none.
const BarredRange* worst_of(const std::vector<BarredRange>& ranges);

}  // namespace kurbel
