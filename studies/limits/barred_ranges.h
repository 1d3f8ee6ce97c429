// barred_ranges.h — speeds at which the drive must not run for long.
//
// A joint with limits is barred where its steady load exceeds any of them but T_KN (theory 12.9). One without is barred
// by a rule:
//     T_W > f · max(|T_mean|, T_rated)                                                 (theory 12.12)
// Loads are torques without factors of a standard, which make the limit smaller instead: T_W ≤ T_KW/(S_t S_f).
// A ship's shaft is barred where its stress exceeds τ_C of UR M68, which falls with the speed; around a resonance from
// 16 n_c/(18 − λ_c) to (18 − λ_c) n_c/16 at the least (drivetrain/couplings/shaft_rating.h).
// T_rated: the drive's rated torque, reduced to this joint; it does not vanish with the mean. Where the halves of a joint
// may part and its torque changes sign, T_W > |T_mean|, it hammers: told apart.
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
  double limit = 0, peak = 0;  // where it is exceeded most [N·m]
  std::string reason;          // "vibratory_torque", "1 × rated torque", "torque changes sign", …
  By by = By::limit;
  bool everywhere = false;  // no speed of the range looked at is free of it
  double worst = 0;         // speed where the limit is exceeded most [rad/s]
};
const char* name_of(BarredRange::By by);

// Steady loads of all joints, in their order, at one speed of the reduction link [rad/s].
struct SpeedLoads {
  double speed = 0;
  std::vector<JointLoad> joints;
};

// `sweep` by ascending speed. Ends of ranges lie between two of its points: found by roots where `at` tells the loads
// at any speed, else straight between them.
std::vector<BarredRange> barred_ranges(const std::vector<LimitedJoint>& joints, const std::vector<SpeedLoads>& sweep,
                                       double factor,
                                       const std::function<std::vector<JointLoad>(double speed)>& at = {});

// How much of what it may bear a joint bears at one speed of the link: of the limit that is used most, without limits of
// the rule's.
double share_of_bearable(const LimitedJoint& joint, const JointLoad& load, double speed, double factor);

// The one that exceeds its limit most, those by limits first; null: none.
const BarredRange* worst_of(const std::vector<BarredRange>& ranges);

}  // namespace kurbel
