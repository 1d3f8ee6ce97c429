// verdicts.h — do the joints hold what they bear? DIN 740-2, and the shear stress of shafts.
//
//     K_A S_t |T_mean| ≤ T_KN                      mean of the steady motion
//     S_t (T_N + S_z T_S) ≤ T_Kmax                 T_N + T_S: largest torque from rest to the steady motion
//     S_t S_f T_W ≤ T_KW,   P_W ≤ P_KW             alternating part of the steady motion
//     K_A |T|/W_p ≤ τ_allowable                    largest torque of the steady motion; without K_A of the run-up
//     a shaft's swinging stress by its maker, Goodman, yield, UR M68: drivetrain/couplings/shaft_rating.h
//                                                                               (theory 12.9, 12.10, 12.14 … 12.16)
#pragma once

#include <string>
#include <vector>

#include "engine/scene/speed_unit.h"
#include "studies/limits/run_up.h"

namespace kurbel {

enum class Compliance { holds, exceeded, undecided };
const char* name_of(Compliance compliance);

// One requirement on one component.
struct Verdict {
  std::string component, requirement;  // "vibratory torque: S_t S_f T_W ≤ T_KW"
  double value = 0, limit = 0;
  std::string unit;
  std::string note;    // where it is exceeded it begins with what would mend it
  double error = 0;    // of the value
  bool bound = false;  // the value is only known to be no more than this
  Compliance state() const;
  bool holds() const { return state() == Compliance::holds; }
};

// Largest steady swing at the speeds below the operating one: what a quick passage stays below.
struct Passing {
  double torque = 0, speed = 0;  // with its sign [N·m], of the link [rad/s]
};

// What is required of a shaft's stress, wherever it is judged.
namespace requirement {
inline constexpr const char* maximum = "maximum torque: S_t (T_N + S_z T_S) ≤ T_Kmax";
inline constexpr const char* vibratory_stress = "vibratory stress: (τ_max − τ_min)/2 ≤ τ_allowable";
inline constexpr const char* fatigue = "fatigue (Goodman): S (K_f τ_a + τ_W |τ_m|/τ_B) ≤ τ_W";
inline constexpr const char* yield = "yield: S |τ| ≤ 0.577 σ_S";
inline constexpr const char* continuous = "UR M68, continuous: (τ_max − τ_min)/2 ≤ τ_C";
inline constexpr const char* upper_range = "UR M68, all of 0.8 < λ ≤ 1.05: (τ_max − τ_min)/2 ≤ τ_C";
inline constexpr const char* passing = "UR M68, passing at λ ≤ 0.8: (τ_max − τ_min)/2 ≤ τ_T";
}  // namespace requirement

// What counts against the endurance limit, and of what it is made.
struct Fatigue {
  Estimate stress;   // [Pa]
  std::string note;  // where it is exceeded it begins with what would mend it
};
Fatigue fatigue_of(const ShaftRating& shaft, const Estimate& amplitude, const Estimate& mean);

// The largest value over its limit, of what is exceeded; 0: nothing is.
double worst_excess(const std::vector<Verdict>& verdicts);

// "1 of 3 ratings EXCEEDED, worst "clutch", heat of an engagement: 132 % of what is allowed, 1320 J of 1000 J; …", with the
// value that would mend it; "all 3 ratings hold, the nearest "belt", …"; empty: nothing is judged. `what`: "rating".
std::string sentence_of(const std::vector<Verdict>& verdicts, const std::string& what);

// Of all joints that have limits. Loads and peaks are of `joints`, in this order; passing is asked where there is no
// run-up, and may be empty.
std::vector<Verdict> judge(const std::vector<LimitedJoint>& joints, const SteadyLoads& loads, const RunUp& run_up,
                           const std::vector<Passing>& passing, const SpeedUnit& speed_unit);

// S_t (T_N + S_z T_S): T_N may act in full or not yet when the peak comes; the error covers both.
Estimate start_torque(const DriveLimits& limits, const Estimate& peak, const Estimate& mean);

}  // namespace kurbel
