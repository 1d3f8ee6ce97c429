// forces.h — kinetostatics of a scene's mechanism over a cycle: reactions in every joint, friction, balancing torque, shaking
// force and moment, inertia forces and motion of every link, its shares in I_r and kinetic energy.
//
// First problem: the crank turns at a given speed; what forces does that need? Second problem: the machine runs as its
// torques drive it, with the scene's effects, and the forces follow from the motion that it keeps.   (theory 9)
// Signs and axes: newton_euler.h. Every figure has an error (theory 9.13): what a search at half the resolution finds
// otherwise, rounding, and, where the motion is simulated, the difference to a run with 30 × looser tolerance.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/scene/scene.h"
#include "mechanisms/joints/reaction_table.h"
#include "mechanisms/linkages/slider_crank.h"
#include "mechanisms/reduced/newton_euler.h"
#include "studies/findings/watch.h"

namespace kurbel {

// The first problem, for those who ask for more of its positions.
struct PrescribedCycle {
  double length = 0, speed = 0;            // of the crank [rad], [rad/s]
  std::vector<double> edges;               // angles where forces jump or bend [rad]
  std::function<double(double phi)> load;  // on the output [N] or [N·m]
};

struct ForcesOptions {
  int positions = 12;           // of a turn that tables show, ≥ 4
  std::optional<double> speed;  // of the crank in the first problem [rad/s], ≠ 0; default: start speed, else rated
  std::string mechanism;        // empty: the first
  // Of the second problem's machine; default: the scene's, with the joints' friction where they have any.
  std::optional<Effects> effects = {};
  bool simulate = true;       // the second problem, too
  bool rigid_behind = false;  // and that of the rigid machine, for a page's curves
  // Further angles of the first problem that are looked at [rad], chosen when its loads are known.
  std::function<std::vector<double>(const PrescribedCycle&)> also = {};
  Watch watch = {};
};

// Which loads of a mechanism act, as an operating sequence has them, in the order of its element's parts; empty: all.
using ActingLoads = std::vector<bool>;

// Powers that enter the mechanism [W].
struct PowerFlow {
  double crank = 0;  // M ω
  double load = 0;   // Σ F v
  double weight = 0;
  double kinetic_rate = 0;  // dT/dt
  double friction = 0;      // lost in the joints, ≥ 0
  double residual = 0;      // of crank + load + weight − friction = dT/dt, relative to the largest power of the cycle
  double nothing = 0;       // powers up to this are rounding beside the cycle's largest [W]

  // 1 − loss/Σ(powers that go in, kinetic energy given up included); empty where nothing goes in.
  std::optional<double> efficiency() const;
};

struct PositionForces {
  LinkageForces forces;
  PowerFlow power;
  ActingLoads loads = {};
};

// Order k of the crank's turn: amplitude and phase of A cos(k φ − phase).
struct ForceHarmonic {
  int order = 0;
  Estimate amplitude;
  double phase = 0;
};
inline constexpr int highest_order = 8;

// A figure of the cycle with where it is reached; its error: theory 9.13.
struct Peak : Estimate {
  double phi = 0;          // [rad]
  double scale = 0;        // of the forces or moments that it is the sum of: what it is rounded by
  bool unbounded = false;  // it grows without bound; the value is that a thousandth of the way beside the place
  double told() const { return unbounded ? HUGE_VAL : value; }
};

struct NamedPeak {
  std::string name;   // "crank pin: crank on coupler"
  std::string unit;   // SI
  std::string means;  // its name in the dictionary
  Peak peak;
};

struct CycleWork {
  std::string name;
  std::string kind;     // driving, useful, harmful, weight
  Estimate work = {};   // done on the mechanism [J]
  double turnover = 0;  // ∫|dA|: what goes to and fro [J]
};

// One link over the cycle.
struct LinkOfCycle {
  std::string name;
  Peak omega, alpha;                     // [rad/s], [rad/s²]
  Peak inertia_force, inertia_couple;    // |−m a_S| [N], −I ε [N·m]
  Estimate reduced_inertia;              // its part of I_r, mean over the angle [kg·m²]
  Estimate inertia_share;                // of the mean I_r
  Estimate least_share, greatest_share;  // of I_r at a position
  Estimate energy;                       // its kinetic energy, mean over the time [J]
  Estimate energy_share;                 // of the mechanism's
};

// What either problem says of one cycle.
struct ForceCycle {
  std::string label;                                 // "prescribed", "simulated"
  std::string description;                           // for people
  double cycle = 0;                                  // [rad]
  Estimate mean_speed, least_speed, greatest_speed;  // of the crank; the mean over the time [rad/s]
  Estimate closure;                                  // speed at the end − at the begin, over the mean: 0 if steady
  std::vector<PositionForces> positions;             // 720 of a turn, evenly, both ends, whatever is asked for
  std::vector<PositionForces> rows;                  // those asked for, both ends
  std::vector<PositionForces> curve;                 // positions, both sides of every load edge, and the peaks
  PositionForces at_torque_peak;
  std::vector<NamedPeak> reactions;  // of each joint; of a slide its normal force, then its moment
  Peak torque, shaking_force, shaking_moment;
  std::vector<LinkOfCycle> links;
  std::vector<ForceHarmonic> shaking_x, shaking_y, shaking_couple, torque_orders;
  Estimate torque_mean;                    // over the angle [N·m]
  std::vector<CycleWork> work;             // by account: loads, weight, the balancing torque, friction of each joint
  Estimate kinetic_change;                 // of the mechanism over the cycle [J]
  double kinetic_most = 0;                 // its kinetic energy, greatest [J]
  Estimate input, useful, harmful;         // work that goes in, comes out usefully, is lost [J], ≥ 0
  double spent = 0;                        // input less what the motion stores [J]
  std::optional<Estimate> efficiency;      // useful/spent, where works beyond their errors make one: 0 … 1
  std::string no_efficiency;               // else why
  int both_edges = 0;                      // positions where both ends of some slide bear
  double power_residual = 0;               // largest, of the powers' balance at a position
  double equation_residual = 0;            // largest, of the links' equilibrium
  double friction_residual = 0;            // largest, of the friction laws
  std::optional<double> machine_residual;  // of the torque, from the compiled machine's own, over the largest

  // Of the n-th joint the force's peak.
  const Peak& reaction(std::size_t joint) const;
  Peak& reaction(std::size_t joint) { return const_cast<Peak&>(std::as_const(*this).reaction(joint)); }
  // Every error by `times` the difference to the other one; peaks are compared by magnitude.
  void widen_to(const ForceCycle& other, double times);
  // Of what depends on the loads, and of all else that depends on how they move the machine.
  void drop_errors(bool of_motion);
};

struct Counterweight {
  std::string name;
  double moment = 0;               // mass · radius opposite to the pin [kg·m]; < 0: on the pin's side
  double reciprocating_share = 0;  // of the first order's reciprocating mass that it balances
  Estimate peak_force;             // of the shaking force that remains [N]
  Estimate first_x, first_y;       // its first order along and across the stroke [N]
  Estimate peak_bearing;           // reaction of the main bearing [N]
  std::vector<Force2> shaking;     // over the turn, as the positions of the first problem
};

// Of a slider-crank: what its masses shake, and what balances them.
struct Balancing {
  SliderCrankData data;
  double rotating_moment = 0;                 // of crank and the rod's share in the crank pin, towards the pin [kg·m]
  double reciprocating_mass = 0;              // of slider and the rod's share in the slider pin [kg]
  std::vector<Counterweight> counterweights;  // the first: as it is
};

struct Forces {
  std::string title, scene_file, scene_text, mechanism, kind;
  SpeedUnit speed_unit;
  bool rocks = false;    // the output is an angle
  bool elastic = false;  // the second problem's machine is
  MechanismJoints joints;
  bool friction = false;  // joints have it, and it counts
  std::optional<ForceCycle> prescribed, simulated;
  std::optional<ForceCycle> rigid;     // the second problem of an elastic machine without elasticity, for plots
  std::vector<PositionForces> also;    // of the first problem, at the further angles that were asked for
  std::optional<Balancing> balancing;  // of a slider-crank, at the first problem's speed
  UnboundedReactions unbounded;
  std::vector<std::string> outside_data;  // what is taken from beyond the ends of tables; that has no error
  std::vector<std::string> notes;
  bool complete = true;
  std::string diagnosis;

  // The problems that were solved, the first of them first; the last one is the machine's own motion, where there is one.
  std::vector<const ForceCycle*> problems() const;
  const ForceCycle& front() const { return simulated ? *simulated : *prescribed; }
};

// Throws SceneError where the scene makes no machine; std::invalid_argument where it has no mechanism, its reactions are
// not determined, or options are senseless; std::runtime_error with the position where the joints jam.
Forces find_forces(const Scene& scene, const ForcesOptions& options);

// Orders 0 … highest of values given evenly over `turns` turns, both ends (trapezium rule, exact for smooth functions).
std::vector<ForceHarmonic> harmonics(const std::vector<double>& values, int turns, double* mean = nullptr);
// The same with what half of the values make otherwise, and rounding of `scale`, as their error. An even number of
// cells.
std::vector<ForceHarmonic> measured_harmonics(const std::vector<double>& values, int turns, double scale);

}  // namespace kurbel
