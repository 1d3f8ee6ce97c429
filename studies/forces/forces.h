// forces.h — kinetostatics of a scene's mechanism over a cycle: joint reactions, friction, balancing torque, shaking
// force and moment, inertia forces and motion of every link, its shares in I_r and kinetic energy.
//
// First problem: the crank turns at a given speed; the forces needed for it are computed. Second problem: the machine
// moves as its torques drive it, with the scene's effects; the forces follow from its steady motion.   (theory 9)
// Signs and axes: newton_euler.h. Every figure has an error (theory 9.13): the difference to a search at half the
// resolution, rounding, and, if the motion is simulated, the difference to a run with 30 × looser tolerance.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/rigid/rigid_machine.h"
#include "engine/scene/scene.h"
#include "mechanisms/joints/reaction_table.h"
#include "mechanisms/linkages/slider_crank.h"
#include "mechanisms/reduced/newton_euler.h"
#include "studies/findings/scene_study.h"
#include "studies/findings/watch.h"

namespace kurbel {

// The first problem, for options that request further positions.
struct PrescribedCycle {
  double length = 0, speed = 0;            // of the crank [rad], [rad/s]
  std::vector<double> edges;               // angles of jumps or kinks of forces [rad]
  std::function<double(double phi)> load;  // on the output [N] or [N·m]
};

struct ForcesOptions {
  int positions = 12;           // per turn in tables, ≥ 4
  std::optional<double> speed;  // of the crank in the first problem [rad/s], ≠ 0; default: start speed, else rated
  std::string mechanism;        // empty: the first
  // For the machine of the second problem; default: the scene's, with friction of joints that have any.
  std::optional<Effects> effects = {};
  // Of a crank that rocks: over these angles; default: rocking_range.
  std::optional<AngleRange> range = {};
  bool simulate = true;       // solve the second problem, too; not of a crank that rocks
  bool rigid_behind = false;  // also for the rigid machine, for curves on the page
  // Further angles for the first problem [rad], chosen when its loads are known.
  std::function<std::vector<double>(const PrescribedCycle&)> also = {};
  Watch watch = {};
};

// Loads of a mechanism that act in the current step of the sequence, in the order of its element's parts; empty: all.
using ActingLoads = std::vector<bool>;

// Powers that enter the mechanism [W].
struct PowerFlow {
  double crank = 0;  // M ω
  double load = 0;   // Σ F v
  double weight = 0;
  double kinetic_rate = 0;  // dT/dt
  double friction = 0;      // lost in the joints, ≥ 0
  double residual = 0;      // of crank + load + weight − friction = dT/dt, relative to the largest power of the cycle
  double nothing = 0;       // smaller powers are rounding errors of the cycle's largest [W]

  // 1 − loss/Σ(input powers, including released kinetic energy); empty if there is no input.
  std::optional<double> efficiency() const;
};

struct PositionForces {
  LinkageForces forces;
  PowerFlow power;
  ActingLoads loads = {};
};

// Order k per crank turn: amplitude and phase of A cos(k φ − phase).
struct ForceHarmonic {
  double order = 0;  // of a cycle of two turns also half ones
  Estimate amplitude;
  double phase = 0;
};
inline constexpr int highest_order = 8;

// A figure of the cycle and its angle; for its error see theory 9.13.
struct Peak : Estimate {
  double phi = 0;          // [rad]
  double scale = 0;        // of the forces or moments that it is the sum of, for its rounding error
  bool unbounded = false;  // unbounded; the value is taken a thousandth of the path beside that angle
  double reported() const { return unbounded ? HUGE_VAL : value; }
};

struct NamedPeak {
  std::string name;   // "crank pin: crank on coupler"
  std::string unit;   // SI
  std::string means;  // its name in the dictionary
  Peak peak;
  std::string joint = {}, between = {};  // of a reaction: "crank pin", "crank on coupler"
};

struct CycleWork {
  std::string name;
  std::string kind;     // driving, useful, harmful, weight
  Estimate work = {};   // done on the mechanism [J]
  double turnover = 0;  // ∫|dA|: energy exchanged [J]
};

// One link over the cycle.
struct LinkOfCycle {
  std::string name;
  Peak omega, alpha;                     // [rad/s], [rad/s²]
  Peak inertia_force, inertia_couple;    // |−m a_S| [N], −I ε [N·m]
  Estimate reduced_inertia;              // its part of I_r, mean over the angle [kg·m²]
  Estimate inertia_share;                // of the mean I_r
  Estimate least_share, greatest_share;  // of I_r at one position
  Estimate energy;                       // its kinetic energy, mean over the time [J]
  Estimate energy_share;                 // of the mechanism's
};

// Results of either problem for one cycle.
struct ForceCycle {
  std::string label;                                 // "prescribed", "simulated"
  std::string description;                           // for people
  double begin = 0, cycle = 0;                       // where the cycle or range begins, and its length [rad]
  bool repeats = true;                               // else a range of a crank that rocks: it has no orders
  Estimate mean_speed, least_speed, greatest_speed;  // of the crank; the mean over the time [rad/s]
  bool assumed_speed = false;                        // neither requested nor from the scene
  Estimate closure;                                  // speed at the end − at the begin, over the mean: 0 if steady
  std::vector<PositionForces> positions;             // 720 per turn, equidistant, both ends, always
  std::vector<PositionForces> rows;                  // the requested ones, both ends
  std::vector<PositionForces> curve;                 // positions, both sides of every load edge, and the peaks
  PositionForces at_torque_peak;
  std::vector<NamedPeak> reactions;  // for each joint; for a slide its normal force, then its moment
  Peak torque, shaking_force, shaking_moment;
  std::vector<LinkOfCycle> links;
  std::vector<ForceHarmonic> shaking_x, shaking_y, shaking_couple, torque_orders;
  Estimate torque_mean;                    // over the angle [N·m]
  std::vector<CycleWork> work;             // by account: loads, weight, the balancing torque, friction of each joint
  Estimate kinetic_change;                 // of the mechanism over the cycle [J]
  double kinetic_most = 0;                 // its kinetic energy, greatest [J]
  Estimate input, useful, harmful;         // input, useful output, loss of work [J], ≥ 0
  double spent = 0;                        // input minus the increase of stored energy [J]
  std::optional<Estimate> efficiency;      // useful/spent, if the works exceed their errors: 0 … 1
  std::string no_efficiency;               // otherwise the reason
  int both_edges = 0;                      // positions where some slide has contact at both edges
  double power_residual = 0;               // largest residual of the power balance
  double equation_residual = 0;            // largest residual of the links' equilibrium
  double friction_residual = 0;            // largest residual of the friction laws
  std::optional<double> machine_residual;  // of the torque against the compiled machine's, over the largest

  // "in a cycle", of a crank that rocks "over the range".
  std::string_view in_it() const { return repeats ? "in a cycle" : "over the range"; }
  // Peak of the force in a joint.
  const Peak& reaction(std::size_t joint) const;
  Peak& reaction(std::size_t joint) { return const_cast<Peak&>(std::as_const(*this).reaction(joint)); }
  // Adds to every error `times` the difference to the other cycle; peaks are compared by magnitude.
  void widen_to(const ForceCycle& other, double times);
  // Removes the errors of everything that depends on the loads, and with `of_motion` on the motion that they cause.
  void drop_errors(bool of_motion);
};

struct Counterweight {
  std::string name;
  double moment = 0;               // mass · radius opposite to the pin [kg·m]; < 0: on the pin's side
  double reciprocating_share = 0;  // balanced share of the reciprocating mass in first order
  Estimate peak_force;             // of the remaining shaking force [N]
  Estimate first_x, first_y;       // its first order along and across the stroke [N]
  Estimate peak_bearing;           // reaction of the main bearing [N]
  std::vector<Force2> shaking;     // over the turn, as the positions of the first problem
};

// For a slider-crank: its unbalanced masses and possible counterweights.
struct Balancing {
  SliderCrankData data;
  double rotating_moment = 0;                 // of crank and the rod's share at the crank pin, towards the pin [kg·m]
  double reciprocating_mass = 0;              // of slider and the rod's share at the slider pin [kg]
  std::vector<Counterweight> counterweights;  // the first: the existing one
};

// Which friction it is in a pin over the cycle (oil_film.h).
struct PinFilm {
  std::string joint;
  Estimate film, parameter;             // smallest over the cycle: h_min [m], λ
  double phi = 0, load = 0, speed = 0;  // where: angle [rad], |R| [N], sliding speed [m/s]
  double boundary = 0, mixed = 0;       // shares of the cycle's positions; the rest is fluid
  bool dry = false;
  std::string words() const;  // "boundary, mixed, fluid"
};

struct Forces : SceneStudy {
  std::string mechanism, kind;
  bool rocks = false;         // the output is an angle
  bool over_a_range = false;  // the crank rocks
  bool elastic = false;       // the machine of the second problem is elastic
  MechanismJoints joints;
  bool friction = false;  // joints have friction, and it is on
  std::optional<ForceCycle> prescribed, simulated;
  std::optional<ForceCycle> rigid;     // the second problem without elasticity, for plots
  std::vector<PinFilm> films;          // in the cycle of front(), of pins with data of their oil
  std::vector<PositionForces> also;    // first problem, at the further angles requested
  std::optional<Balancing> balancing;  // of a slider-crank, at the speed of the first problem
  UnboundedReactions unbounded;
  std::vector<std::string> outside_data;  // extrapolation of tables; it has no error
  std::vector<std::string> about;         // its structure, its output's travel

  // The solved problems, the first one first; the last one is the machine's own motion, if there is one.
  std::vector<const ForceCycle*> problems() const;
  const ForceCycle& front() const { return simulated ? *simulated : *prescribed; }
};

// Throws SceneError if no machine can be made; std::invalid_argument if there is no mechanism or options are invalid;
// std::runtime_error with the position if the joints jam.
Forces find_forces(const Scene& scene, const ForcesOptions& options);

// Orders up to the highest, of two turns half orders, too, of equidistant values over `turns` turns, both ends (trapezoidal rule,
// exact for smooth functions).
std::vector<ForceHarmonic> harmonics(const std::vector<double>& values, int turns, double* mean = nullptr);
// The same with errors: difference to half of the values, and rounding of `scale`. The number of cells must be even.
std::vector<ForceHarmonic> measured_harmonics(const std::vector<double>& values, int turns, double scale);

}  // namespace kurbel
