// shaft_stress.h — a shaft's torsional stress over the speeds, by order and as their sum, against what it may be.
//
//     τ_r = |T_r|/W_p,   τ_a = (T_max − T_min)/(2 W_p),   W_p = π (D⁴ − d⁴)/(16 D)              (theory 12.14)
// T_r: the amplitude of one order; T_max, T_min: of the sum of all orders over the cycle, with their phases (synthesis).
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/scene/speed_unit.h"
#include "studies/limits/barred_ranges.h"
#include "studies/limits/verdicts.h"
#include "studies/response/forced_response.h"

namespace kurbel {

// How a drive fires, and how it then swings.
struct Firing {
  std::string misfires = {};              // the cylinder that does not fire; empty: all fire
  std::vector<SpeedResponse> sweep = {};  // by speed; those that are not kept are left out of what is said
  std::vector<BarredRange> barred = {};
  double fundamental = 1;  // order of the first harmonic
};

// All that is known of the stresses of a drive's shafts.
struct ShaftStresses {
  std::vector<LimitedJoint> joints = {};
  Firing normal = {};
  std::vector<Firing> misfires = {};
  std::string link = {};  // whose speed it is
  SpeedUnit unit = {};
  bool any() const;
};

// Where one order of a shaft, or the sum of all, is largest: over what is allowed at that speed, where anything is.
struct StressPeak {
  std::size_t joint = 0;
  std::string shaft, misfires;
  double order = 0;           // 0: the sum of all
  double stress = 0;          // [Pa]
  double speed = 0;           // of the link [rad/s]
  double allowed = HUGE_VAL;  // amplitude at that speed, in continuous operation [Pa]
  double use() const { return stress / allowed; }
};

// Joints that are shafts whose stress is judged.
std::vector<std::size_t> judged_shafts(const std::vector<LimitedJoint>& joints);

// Of a joint that is a shaft: τ_a and τ_r at one speed [Pa].
double summed_stress(const LimitedJoint& joint, const JointResponse& response);
double order_stress(const LimitedJoint& joint, Complex order);
// The lesser of the maker's limit and τ_C, at a speed of the link; boundless where neither says anything.
double allowed_amplitude(const LimitedJoint& joint, double speed);

// Per shaft the sum of all orders, then those orders that come to 1 % of it somewhere, the strongest first.
std::vector<StressPeak> stress_peaks(const std::vector<LimitedJoint>& joints, const Firing& firing);

// Of one shaft, among the sums of all orders of several firings: the one that uses most of the limit.
const StressPeak* worst_sum(const std::vector<StressPeak>& peaks, std::size_t joint);

// What UR M68 asks of the whole range of speeds: nothing barred above λ = 0.8, and τ_T where what is barred is passed.
void judge_over_speeds(const std::vector<LimitedJoint>& joints, const std::vector<SpeedResponse>& sweep,
                       std::vector<Verdict>& verdicts);

}  // namespace kurbel
