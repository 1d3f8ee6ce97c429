// modes.h — the drive in the frequency domain: modes, critical speeds, forced response, limits, a torque's spectrum.
//
// The machine is linearised at its steady motion (engine/linear), with everything that the scene's effects do.
//   K v = ω² M v;   (λ² M + λ C + K) v = 0;   critical where r Ω = ω_n (Campbell)
// A mechanism's inertia enters by its mean; where it varies by ε in a mode, y″ + ω²(1 − ε cos νt) y = 0 is unstable in
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
  Moment at = {};                    // as the machine is then; default: when all is switched, or kept_moment.h's
  std::optional<double> angle = {};  // holds the link there instead of averaging over the cycle [rad]
  double slowest = 0, fastest = 0;   // range of speeds [rad/s]; 0, 0: up to 1.25 times the speed
  double orders = 0;                 // highest order; 0: 12, or what reaches the second mode, up to 24
  double barred_factor = 1;          // a joint without limits: barred where its swing exceeds this times its
                                     // mean or rated torque (barred_ranges.h)
  std::string torque = {};           // channel to simulate: "main_coupling"; empty: none
  int spot_checks = 0;               // speeds of the range at which the nonlinear cycle is held against the response
  std::vector<double> spots = {};    // and those [rad/s]
  bool misfires = true;              // where shafts' stresses are judged: the same as one cylinder does not fire
  bool response_alone = false;       // of a case beside the one that is judged
  bool modes_alone = false;          // natural frequencies and damping, and nothing else
  bool start = true;                 // else no steady motion is sought, and all turns as geared
  Watch watch = {};
};

// A swing of the system with coefficients that change within the round.
struct PeriodicSwing {
  std::complex<double> exponent;  // s [1/s]
  double error = 0;               // [1/s]
  bool branch_by_mean = false;    // Im s is known but for multiples of 2π/T; told is what is nearest to the mean's
  double ratio() const { return -exponent.real() / std::abs(exponent); }
};

struct Mode {
  int number = 0;         // natural frequencies from 1 on, ascending; behind them those of internal states, likewise
  double omega = 0;       // ω_n of K v = ω_n² M v, undamped [rad/s]; of one of internal states, |λ|
  Eigen::VectorXd shape;  // per coordinate, M-orthonormal
  EnergyShares shares;
  std::complex<double> lambda;  // of the damped mode that grows out of it; 0 where none was found
  double ratio = 1;             // ζ; 1: does not swing
  double error = 0;             // of ω [rad/s]
  double lambda_error = 0;      // of λ [1/s]
  EnergyParts energy = {};      // of the damped mode
  bool of_own_states = false;   // grows out of no undamped mode: windings, controllers, slopes of motors
  // Of ω with the link held at angles of the cycle; equal where nothing changes with the angle.
  double least = 0, greatest = 0;
  // Of the periodic system, where coefficients or contacts change within the round: what the mean leaves out is the
  // difference to λ. Two where the mode is locked to the round: both swing in step with it, and fade apart.
  std::vector<PeriodicSwing> periodic = {};
  // Nothing of it is left after a round: a ring-down shows what holds at the angle where it starts, somewhere between
  // `least` and `greatest`; the exponent's frequency is the mean over the round.
  bool fades_within_round = false;
  bool only_of_mean = false;  // no swing of the periodic system is in its place: contacts within the round take it away
  double magnitude() const { return lambda.imag() > 0 ? std::abs(lambda) : omega; }  // |λ| [rad/s]
};

// A joint whose law changes its piece within the round of the steady motion: backlash that opens, a stop that is met.
struct Rattle {
  std::size_t joint = 0;
  int changes = 0;  // in a round
  double stiffness = 0;  // of the linear spring that does most nearly the same: ⟨τ θ⟩/⟨θ²⟩ over the round [N·m/rad]
  double linear = 0;          // at the mean twist [N·m/rad]
  std::vector<double> omega;  // undamped frequencies with it, ascending [rad/s]
};

// The linear response at one speed beside the nonlinear cycle whose mean speed is held there (held_cycle.h).
struct SpotCheck {
  double speed = 0;                  // of the reduction link [rad/s]
  std::optional<double> share = {};  // of what its joint may bear; none: the speed was asked for
  std::size_t joint = 0;             // that is looked at: of that share, or with the largest swing
  SpeedResponse linear = {};
  std::optional<SpeedResponse> cycle = {};  // none: it was not found
  std::string why = {};                     // in words, then
  double cycle_order = 1;                   // of its first harmonic
  double acceleration = 0;                  // that the holding torques stand for [rad/s²]
  bool stable = true;                       // with its mean speed held
  double difference(std::size_t j) const { return linear.joints[j].peak - cycle->joints[j].peak; }  // [N·m]
  double error(std::size_t j) const { return 1e-5 * std::abs(cycle->joints[j].peak); }  // of 4096 samples of a round
};

struct CriticalSpeed {
  double speed = 0;  // of the reduction link, where the order meets the mode [rad/s]
  int mode = 0;
  double order = 0;
  std::size_t harmonic = 0;
  // Where this order swings most near it: damping, and torques that follow the speed, take the two apart. None: it has
  // no peak there.
  std::optional<double> peak = {};
  std::size_t joint = 0;                                    // in which the order is largest, reduced to the link
  double amplitude = 0;                                     // of this order alone there, at `severest` [N·m]
  double mean = 0;                                          // of that joint's torque, there
  double severest() const { return peak.value_or(speed); }  // [rad/s]
  double share = 0;  // of what that joint may bear (barred_ranges.h): how severe it is
};

struct ParametricZone {
  int mode = 0;
  std::size_t harmonic = 0;
  double centre = 0;      // 2 ω/r [rad/s]
  double variation = 0;   // ε
  double half_width = 0;  // relative; 0: damping keeps it closed
};

struct ModesStudy;
// The drive as something of it has failed, or is otherwise: a [[case]] of the scene.
struct ModesCase {
  std::string name;
  std::vector<std::string> settings;
  std::shared_ptr<const ModesStudy> study = {};  // over the same speeds; null: not assessed
  std::string why = {};                          // then
};

struct ModesStudy {
  std::string title, scene_file, scene_text;
  LinearDrive drive;
  UndampedModes undamped;
  std::vector<Mode> modes;                            // by number; without the rigid ones
  std::vector<DampedMode> damped;                     // all that were found
  std::vector<std::string> shaft_names, joint_names;  // of the shafts that may move, of all elastic joints
  std::string link;                                   // reduction link
  SpeedUnit speed_unit;
  Excitations excitations;
  double slowest = 0, fastest = 0, highest_order = 0;
  std::vector<CriticalSpeed> critical;  // by speed
  std::vector<CriticalSpeed> not_kept;  // those at which the machine does not stay by itself
  Margins margins;
  std::vector<ParametricZone> zones;
  SpeedResponse here;                  // at the operating point
  std::optional<SpeedResponse> cycle;  // what the joints really do there, from the full equations
  double cycle_order = 1;              // of its first harmonic
  std::string orbit;                   // what the scene's own start leads to, in words
  bool start_unknown = false;          // it led to nothing within a fifth of the budget
  std::vector<Rattle> rattles;
  bool keeps_its_speed = true;        // nothing grows at the operating point
  std::vector<SpeedResponse> sweep;   // over the range
  std::vector<SpeedResponse> rigid;   // some of its speeds, with joints that do not twist; none where that says nothing
  std::vector<LimitedJoint> limited;  // per joint: what it may bear
  std::vector<BarredRange> barred;
  std::vector<SpotCheck> spots;  // by speed
  std::vector<Verdict> verdicts;
  ShaftStresses stresses;  // where they are judged
  std::optional<TorqueHistory> history;
  std::vector<ModesCase> cases;
  std::vector<std::string> outside_data;  // what the motion takes from beyond the ends of tables
  std::vector<std::string> notes;
  bool complete = true;
  std::string diagnosis;
  std::optional<double> rests_at;  // the link's angle about which it swings at rest [rad]
};

// Where none are asked for: the scene's, with all elasticity where it has none.
Effects effects_of_modes(const Scene& scene);

// Natural frequencies wait for no start: first come those at the scene's state or at its rated speed; the steady motion, to
// which the search gives a fifth of the scene's budget at most, refines them and what depends on it. Where the budget is
// spent, what is known by then is the answer, not `complete`.
// Throws SceneError where the scene makes no machine; std::invalid_argument where nothing is elastic or options are
// senseless; std::runtime_error where modes cannot be found; OutOfTime where none are found within the budget.
ModesStudy find_modes(const Scene& scene, const Effects& effects, const ModesOptions& options);

// The same drive at the speeds of `normal`, as one cylinder after the other does not fire (cases.cpp); none where one
// misfires already, or where there is but one. What cannot misfire is said in `notes`.
std::vector<Firing> find_misfires(const Scene& scene, const Effects& effects, const ModesOptions& options,
                                  const ModesStudy& normal, std::vector<std::string>& notes);

// The cases of a scene that are asked for by their names, {"none"}: none; empty: all. `effects`: else those of each. Throws
// std::invalid_argument for a name that none has.
struct Inquiry;
std::vector<ModesCase> find_cases(const Inquiry& inquiry, const std::vector<std::string>& names,
                                  const std::optional<Effects>& effects, const ModesOptions& options,
                                  const ModesStudy& normal);

// Of its joints that are shafts, as all cylinders fire.
ShaftStresses stresses_of_sweep(const ModesStudy& study);

// How many of its modes are natural frequencies of the drive; those of internal states stand behind them.
std::size_t natural_modes(const ModesStudy& study);

// Amplitudes of a mode at the shafts that may move.
Eigen::VectorXd shaft_shape(const ModesStudy& study, const Mode& mode);

// Relative half width of the first-order zone around ν = 2ω; 0 where damping ζ closes it (ε ≤ 4ζ).
double parametric_half_width(double variation, double damping_ratio);

// Chapters of its findings.
namespace modes_chapter {
inline constexpr const char *limits = "Limits (theory 12.9)", *modes = "Modes (theory 12.2, 12.3)",
                            *margins = "Critical speeds and margins (theory 12.6, 12.17)",
                            *forced = "Forced response (theory 12.7)", *cases = "Cases",
                            *stresses = "Stresses of shafts (theory 12.14, 12.16)", *history = "Simulated torque";
}  // namespace modes_chapter

// Files: mode_shapes.csv, and forced_response.csv where a range of speeds was swept. The study must outlive the findings.
Findings findings_of(const ModesStudy& study);

}  // namespace kurbel
