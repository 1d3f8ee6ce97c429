// verdicts.h — assesses the loads of joints against their limits: DIN 740-2, and the shear stress of shafts.
//
//     K_A S_t |T_mean| ≤ T_KN                      mean of the steady motion
//     S_t (T_N + S_z T_S) ≤ T_Kmax                 T_N + T_S: largest torque from rest to the steady motion
//     S_t S_f T_W ≤ T_KW,   P_W ≤ P_KW             alternating part of the steady motion
//     K_A |T|/W_p ≤ τ_allowable                    largest torque of the steady motion; without K_A of the run-up
//     a shaft's alternating stress by its manufacturer, Goodman, yield, UR M68: drivetrain/couplings/shaft_rating.h
//                                                                               (theory 12.9, 12.10, 12.14 … 12.16)
#pragma once

#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/scene/speed_unit.h"
#include "studies/claims/claim.h"
#include "studies/limits/run_up.h"

namespace kurbel {

// not_assessed: the command does not compute the load case, or knows only a bound that exceeds the limit.
enum class Compliance { holds, exceeded, undecided, not_assessed };
const char* name_of(Compliance compliance);

// Load cases of a verdict: the same limit on the same load case has the same verdict in every command.
namespace load_case {
inline constexpr const char* start = "start";                          // from rest, or the run-up of a run
inline constexpr const char* steady = "steady";                        // the machine's steady motion
inline constexpr const char* passing = "resonance passed";             // below the operating speed
inline constexpr const char* run_down = "run-down";                    // after the last source is switched off
inline constexpr const char* run = "run";                              // the whole simulation
inline constexpr const char* speed_range = "steady, range of speeds";  // held at each speed
// otherwise "after step 2 of the sequence"
}  // namespace load_case

// One requirement on one component, in one load case. With the factors of a standard, value = factor · load.
struct Verdict : Estimate {
  std::string component, requirement;  // "vibratory torque: S_t S_f T_W ≤ T_KW"
  double limit = 0;
  std::string unit;
  std::string note;        // if exceeded, it begins with the remedy
  bool bound = false;      // the value is only an upper bound
  bool gives_way = false;  // it slips at its limit: the required torque is at least the value
  std::string load_case = load_case::run;
  double factor = 1;
  std::string factors = {};           // "S_t = 1.2, S_f = 1.41"
  std::optional<Remedy> remedy = {};  // value of the key from which on it holds
  bool assessed = true;
  std::optional<double> at = {};  // of a run's figure [s]
  double load() const { return value / factor; }
  double known_error() const { return error.value_or(0); }
  double share() const { return value / limit; }
  Compliance state() const;
  bool holds() const { return state() == Compliance::holds; }
};

// Largest steady amplitude below the operating speed: an upper bound for a quick passage.
struct Passing {
  double torque = 0, speed = 0;  // with its sign [N·m], of the link [rad/s]
};

// Requirements on the stress of a shaft, the same everywhere.
namespace requirement {
inline constexpr const char* maximum = "maximum torque: S_t (T_N + S_z T_S) ≤ T_Kmax";
inline constexpr const char* shear = "shear stress: K_A |T|/W_p ≤ τ_allowable";  // K_A in steady motion
inline constexpr const char* vibratory_stress = "vibratory stress: (τ_max − τ_min)/2 ≤ τ_allowable";
inline constexpr const char* fatigue = "fatigue (Goodman): S (K_f τ_a + τ_W |τ_m|/τ_B) ≤ τ_W";
inline constexpr const char* yield = "yield: S |τ| ≤ 0.577 σ_S";
inline constexpr const char* continuous = "UR M68, continuous: (τ_max − τ_min)/2 ≤ τ_C";
inline constexpr const char* upper_range = "UR M68, all of 0.8 < λ ≤ 1.05: (τ_max − τ_min)/2 ≤ τ_C";
inline constexpr const char* passing = "UR M68, passing at λ ≤ 0.8: (τ_max − τ_min)/2 ≤ τ_T";
}  // namespace requirement

// The stress compared with the endurance limit, and its composition.
struct Fatigue {
  Estimate stress;   // [Pa]
  std::string note;  // if exceeded, it begins with the remedy
};
Fatigue fatigue_of(const ShaftRating& shaft, const Estimate& amplitude, const Estimate& mean);

// A limit of a load case that is not computed here; `why`: the command that computes it.
Verdict not_assessed(std::string component, std::string requirement, double limit, std::string unit,
                     const char* load_case, std::string why);

// "1 of 3 ratings EXCEEDED, worst "clutch", heat of an engagement: 132 % of the limit, 1320 J of 1000 J; …", with the
// remedy; "all 3 ratings hold, the nearest "belt", …", and what is not assessed; empty: nothing is assessed.
// `what`: "rating".
std::string sentence_of(const std::vector<Verdict>& verdicts, const std::string& what);

// One claim per verdict; the worst one has the sentence for all, which is in the conclusion.
Claims limit_claims(const std::vector<Verdict>& verdicts, const std::string& what);

// For the sentence that limits hold, beside another that one is exceeded: "with every cylinder firing" begins it.
void hold_under(const std::string& condition, Claims& claims);

// "it holds from diameter = 87.92 mm on, and does not 1 % below"; without trial "by an estimate it holds …". `up_to`:
// "up to" instead of "from … on".
std::string in_words(const Remedy& remedy, bool up_to = false);

// Rounded up to the four displayed digits, to a hundredth of the last one; rounded down for negative values.
double enough(double value);
// "shaft.diameter for shear stress: …": the key under which a run stores a tried remedy.
std::string name_of_remedy(const Verdict& verdict);

// Verdicts of all joints with limits. Loads and peaks belong to `joints`, in this order; passing is used if there is
// no run-up, and may be empty.
std::vector<Verdict> judge(const std::vector<LimitedJoint>& joints, const SteadyLoads& loads, const RunUp& run_up,
                           const std::vector<Passing>& passing, const SpeedUnit& speed_unit);

// S_t (T_N + S_z T_S): T_N may act in full or not yet at the time of the peak; the error covers both.
Estimate start_torque(const DriveLimits& limits, const Estimate& peak, const Estimate& mean);

}  // namespace kurbel
