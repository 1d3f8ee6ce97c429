// shaft_stress.h — torsional stress of a shaft over speed, by order and as their sum, against the allowable stress.
//
//     τ_r = |T_r|/W_p,   τ_a = (T_max − T_min)/(2 W_p),   W_p = π (D⁴ − d⁴)/(16 D)              (theory 12.14)
// T_r: amplitude of one order; T_max, T_min: of the sum of all orders over the cycle, with their phases (synthesis).
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/scene/speed_unit.h"
#include "studies/limits/barred_ranges.h"
#include "studies/limits/verdicts.h"
#include "studies/response/forced_response.h"

namespace kurbel {

// Firing condition of a drive, and its response.
struct Firing {
  std::string misfires = {};              // the misfiring cylinder; empty: all fire
  std::vector<SpeedResponse> sweep = {};  // by speed; speeds that are not kept are omitted in the findings
  std::vector<BarredRange> barred = {};
  double fundamental = 1;  // order of the first harmonic
};

// Data for the stresses of a drive's shafts.
struct ShaftStresses {
  std::vector<LimitedJoint> joints = {};
  Firing normal = {};
  std::vector<Firing> misfires = {};
  std::string link = {};  // the shaft of the speed axis
  SpeedUnit unit = {};
  bool any() const;
};

// Maximum of one order of a shaft, or of the sum of all: over the allowable stress at that speed, if there is any.
struct StressPeak {
  std::size_t joint = 0;
  std::string shaft, misfires;
  double order = 0;           // 0: the sum of all
  double stress = 0;          // [Pa]
  double speed = 0;           // of the link [rad/s]
  double allowed = HUGE_VAL;  // allowable amplitude at that speed in continuous operation [Pa]
  double use() const { return stress / allowed; }
};

// Joints that are shafts whose stress is assessed.
std::vector<std::size_t> judged_shafts(const std::vector<LimitedJoint>& joints);

// For a joint that is a shaft: τ_a and τ_r at one speed [Pa].
double summed_stress(const LimitedJoint& joint, const JointResponse& response);
double order_stress(const LimitedJoint& joint, Complex order);
// The smaller of the manufacturer's limit and τ_C, at a speed of the link; infinite without limits.
double allowed_amplitude(const LimitedJoint& joint, double speed);

// Per shaft the sum of all orders, then the orders that reach 1 % of it at some speed, the strongest first.
std::vector<StressPeak> stress_peaks(const std::vector<LimitedJoint>& joints, const Firing& firing);

// For one shaft, among the sums of all orders in several firing conditions: the one with the highest utilisation.
const StressPeak* worst_sum(const std::vector<StressPeak>& peaks, std::size_t joint);

// Requirements of UR M68 on the whole speed range: nothing barred above λ = 0.8, and τ_T in barred ranges that are passed.
void judge_over_speeds(const std::vector<LimitedJoint>& joints, const std::vector<SpeedResponse>& sweep,
                       std::vector<Verdict>& verdicts);

}  // namespace kurbel
