// modes.h — the drive in the frequency domain: modes, critical speeds, forced response, limits, a torque's spectrum.
//
// The machine is linearised at its steady motion (engine/linear), with all effects of the scene.
//   K v = ω² M v;   (λ² M + λ C + K) v = 0;   critical where r Ω = ω_n (Campbell)
// A mechanism's inertia enters by its mean; if it varies by ε in a mode, y″ + ω²(1 − ε cos νt) y = 0 is unstable in
// first order for |ν/2ω − 1| < ½ √(ε²/4 − 4ζ²), ν = r Ω: around the speeds 2 ω/r.       (Mathieu; theory 12.8)
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/linear/cycle_samples.h"
#include "engine/linear/eigen_modes.h"
#include "engine/orbit/moment.h"
#include "engine/scene/scene.h"
#include "studies/findings/output.h"
#include "studies/findings/watch.h"
#include "studies/history/torque_history.h"
#include "studies/limits/barred_ranges.h"
#include "studies/limits/verdicts.h"
#include "studies/margins/margins.h"
#include "studies/response/forced_response.h"
#include "studies/shafts/shaft_stress.h"

namespace kurbel {

struct ModesOptions {
  int count = 20;                    // of modes, rigid motion not counted
  std::optional<double> speed = {};  // of the reduction link [rad/s]; default: that of the steady motion
  Moment at = {};                    // state at that moment; default: after all switching, or default_moment.h's
  std::optional<double> angle = {};  // holds the link at this angle instead of averaging over the cycle [rad]
  double slowest = 0, fastest = 0;   // range of speeds [rad/s]; 0, 0: up to 1.25 times the speed
  double orders = 0;                 // highest order; 0: 12, or what reaches the second mode, up to 24
  double barred_factor = 1;          // a joint without limits: barred if its amplitude exceeds this times its
                                     // mean or rated torque (barred_ranges.h)
  std::string torque = {};           // channel to simulate: "main_coupling"; empty: none
  int spot_checks = 0;               // number of speeds at which the response is compared with the nonlinear cycle
  std::vector<double> spots = {};    // further such speeds [rad/s]
  bool misfires = true;              // if shaft stresses are assessed: also with one cylinder misfiring
  bool response_alone = false;       // for a case other than the assessed one
  bool modes_alone = false;          // natural frequencies and damping only
  bool start = true;                 // false: no steady motion is sought; all shafts turn as geared
  Watch watch = {};
};

// A vibration of the system with coefficients that vary within the period.
struct PeriodicMode {
  std::complex<double> exponent;  // s [1/s]
  double error = 0;               // [1/s]
  bool branch_by_mean = false;    // Im s is known up to multiples of 2π/T; given: nearest to the mean's
  double ratio() const { return -exponent.real() / std::abs(exponent); }
};

struct Mode {
  int number = 0;         // natural frequencies from 1 on, ascending; then modes of internal states, likewise
  double omega = 0;       // ω_n of K v = ω_n² M v, undamped [rad/s]; for a mode of internal states |λ|
  Eigen::VectorXd shape;  // per coordinate, M-orthonormal
  EnergyShares shares;
  std::complex<double> lambda;      // of the corresponding damped mode; 0 if none was found
  double ratio = 1;                 // ζ; 1: does not oscillate
  double error = 0;                 // of ω [rad/s]
  double lambda_error = 0;          // of λ [1/s]
  EnergyParts energy = {};          // of the damped mode
  bool of_internal_states = false;  // has no corresponding undamped mode: windings, controllers, slopes of motors
  // Of ω with the link held at angles of the cycle; equal if nothing depends on the angle.
  double least = 0, greatest = 0;
  // Of the periodic system, if coefficients or contacts change within the period: the difference to λ is the error of
  // averaging. Two if the mode is locked to the period: both oscillate in step with it and decay at different rates.
  std::vector<PeriodicMode> periodic = {};
  // It decays within one period: a measured ring-down shows the frequency at the angle where it starts, between
  // `least` and `greatest`; the exponent's frequency is the mean over the period.
  bool fades_within_cycle = false;
  bool only_of_mean = false;  // no vibration of the periodic system corresponds: contacts within the period remove it
  double magnitude() const { return lambda.imag() > 0 ? std::abs(lambda) : omega; }  // |λ| [rad/s]
};

// A joint whose law changes its piece within the period of the steady motion: opening backlash, contact with a stop.
struct Rattle {
  std::size_t joint = 0;
  int changes = 0;            // per period
  double stiffness = 0;       // of the equivalent linear spring: ⟨τ θ⟩/⟨θ²⟩ over the period [N·m/rad]
  double linear = 0;          // at the mean twist [N·m/rad]
  std::vector<double> omega;  // undamped frequencies with it, ascending [rad/s]
};

// The linear response at one speed and the nonlinear cycle with this mean speed held (held_cycle.h).
struct SpotCheck {
  double speed = 0;                  // of the reduction link [rad/s]
  std::optional<double> share = {};  // load over allowable load; empty: the speed was requested
  std::size_t joint = 0;             // the joint considered: that of `share`, or with the largest amplitude
  SpeedResponse linear = {};
  std::optional<SpeedResponse> cycle = {};  // empty: not found
  std::string why = {};                     // reason, if not found
  double cycle_order = 1;                   // of its first harmonic
  double acceleration = 0;                  // represented by the holding torques [rad/s²]
  bool stable = true;                       // with its mean speed held
  double difference(std::size_t j) const { return linear.joints[j].peak - cycle->joints[j].peak; }  // [N·m]
  double error(std::size_t j) const { return 1e-5 * std::abs(cycle->joints[j].peak); }  // by 4096 samples per period
};

struct CriticalSpeed {
  double speed = 0;  // of the reduction link, where the order coincides with the mode [rad/s]
  int mode = 0;
  double order = 0;
  std::size_t harmonic = 0;
  // Nearby speed of this order's largest amplitude, which damping and speed-dependent torques shift. Empty: it has no
  // peak there.
  std::optional<double> peak = {};
  std::size_t joint = 0;                                    // with the order's largest amplitude, reduced to link
  double amplitude = 0;                                     // of this order alone at `severest` [N·m]
  double mean = 0;                                          // of that joint's torque there
  double severest() const { return peak.value_or(speed); }  // [rad/s]
  double share = 0;  // severity: over the allowable load of that joint (barred_ranges.h)
};

struct ParametricZone {
  int mode = 0;
  std::size_t harmonic = 0;
  double centre = 0;      // 2 ω/r [rad/s]
  double variation = 0;   // ε
  double half_width = 0;  // relative; 0: damping suppresses it
};

struct ModesStudy;
// The drive with a failure or another change: a [[case]] of the scene.
struct ModesCase {
  std::string name;
  std::vector<std::string> settings;
  std::shared_ptr<const ModesStudy> study = {};  // over the same speeds; null: not assessed
  std::string why = {};                          // reason, if not assessed
};

struct ModesStudy : SceneStudy {
  LinearDrive drive;
  UndampedModes undamped;
  std::vector<Mode> modes;                            // by number; without the rigid ones
  std::vector<DampedMode> damped;                     // all that were found
  std::vector<std::string> shaft_names, joint_names;  // of the shafts that may move, of all elastic joints
  std::string link;                                   // reduction link
  Excitations excitations;
  double slowest = 0, fastest = 0, highest_order = 0;
  std::vector<CriticalSpeed> critical;  // by speed
  std::vector<CriticalSpeed> not_kept;  // at which the machine does not remain by itself
  Margins margins;
  std::vector<ParametricZone> zones;
  SpeedResponse here;                             // at the operating point
  std::optional<SpeedResponse> cycle;             // actual torques of the joints there, from the full equations
  double cycle_order = 1;                         // of its first harmonic
  std::string orbit;                              // motion that the scene's own start leads to, in words
  bool start_unknown = false;                     // no motion was found within a fifth of the budget
  bool comes_to_rest = false, runs_away = false;  // that motion: no steady one has limits
  std::vector<Rattle> rattles;
  bool keeps_its_speed = true;        // no deviation grows at the operating point
  std::vector<SpeedResponse> sweep;   // over the range
  std::vector<SpeedResponse> rigid;   // some of its speeds, with rigid joints; empty if that is meaningless
  std::vector<LimitedJoint> limited;  // per joint: allowable loads
  std::vector<BarredRange> barred;
  std::vector<SpotCheck> spots;  // by speed
  std::vector<Verdict> verdicts;
  ShaftStresses stresses;  // if assessed
  std::optional<TorqueHistory> history;
  std::vector<ModesCase> cases;
  std::vector<std::string> outside_data;  // extrapolation of tables in the motion
  std::optional<double> rests_at;         // mean angle of the link if it vibrates about rest [rad]
};

// Default: the scene's effects, with all elasticity if it has none.
Effects effects_of_modes(const Scene& scene);

// Natural frequencies are computed before any start: first those at the scene's state or at its rated speed; the
// steady motion, whose search takes at most a fifth of the scene's budget, refines them and dependent results. When
// the budget is spent, the results so far are returned, not `complete`.
// Throws SceneError if no machine can be made; std::invalid_argument if nothing is elastic or options are invalid;
// std::runtime_error if modes cannot be found; OutOfTime if none are found within the budget.
ModesStudy find_modes(const Scene& scene, const Effects& effects, const ModesOptions& options);

// The same drive at the speeds of `normal`, with one cylinder after the other misfiring (cases.cpp); none if one
// misfires already, or if there is only one. Sources that cannot misfire are listed in `notes`.
std::vector<Firing> find_misfires(const Scene& scene, const Effects& effects, const ModesOptions& options,
                                  const ModesStudy& normal, std::vector<std::string>& notes);

// The cases of a scene with these names, {"none"}: none; empty: all. `effects`: if empty, those of each case. Throws
// std::invalid_argument for an unknown name.
struct Inquiry;
std::vector<ModesCase> find_cases(const Inquiry& inquiry, const std::vector<std::string>& names,
                                  const std::optional<Effects>& effects, const ModesOptions& options,
                                  const ModesStudy& normal);

// Stresses of the joints that are shafts, with all cylinders firing.
ShaftStresses stresses_of_sweep(const ModesStudy& study);

// Frequencies [Hz] and damping ratios of the modes by name: "natural_frequency.1", "damped_frequency.1".
struct Figure;
std::vector<Figure> figures_of(const ModesStudy& study);

// Number of modes that are natural frequencies of the drive; those of internal states follow them.
std::size_t natural_modes(const ModesStudy& study);

// Amplitudes of a mode at the movable shafts.
Eigen::VectorXd shaft_shape(const ModesStudy& study, const Mode& mode);

// Relative half width of the first-order zone around ν = 2ω; 0 if damping ζ suppresses it (ε ≤ 4ζ).
double parametric_half_width(double variation, double damping_ratio);

// Chapter titles of its findings.
namespace modes_chapter {
inline constexpr const char *limits = "Limits (theory 12.9)", *modes = "Modes (theory 12.2, 12.3)",
                            *margins = "Critical speeds and margins (theory 12.6, 12.17)",
                            *forced = "Forced response (theory 12.7)", *cases = "Cases",
                            *stresses = "Stresses of shafts (theory 12.14, 12.16)", *history = "Simulated torque";
}  // namespace modes_chapter

// Files: mode_shapes.csv, and forced_response.csv if a range of speeds was swept. The study must outlive the findings.
Findings findings_of(const ModesStudy& study);

}  // namespace kurbel
