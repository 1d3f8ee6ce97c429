// forces.h — kinetostatics of a scene's slider-crank over a cycle: reactions, balancing torque, friction, balancing.
//
// First problem: the crank turns at a given speed; what forces does that need? Second problem: the machine runs as its
// torques drive it, with the scene's effects, and the forces follow from the motion that it keeps.   (theory 9)
#pragma once

#include <atomic>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "mechanisms/reduced/newton_euler.h"
#include "mechanisms/slider_crank/slider_crank_forces.h"
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
  std::string mechanism;        // empty: the first slider-crank
  // Of the second problem's machine; default: the scene's, with the joints' friction where they have any.
  std::optional<Effects> effects = {};
  bool simulate = true;       // the second problem, too
  bool rigid_behind = false;  // and that of the rigid machine, for a page's curves
  // Further angles of the first problem that are looked at [rad], chosen when its loads are known.
  std::function<std::vector<double>(const PrescribedCycle&)> also = {};
  Watch watch = {};
};

// Which loads of a mechanism act, as an operating sequence has them: a bit each, in the order of its element's parts.
using ActingLoads = std::uint64_t;
inline constexpr ActingLoads all_loads = ~ActingLoads{0};
inline constexpr std::size_t most_loads = 64;

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

struct CyclePosition {
  CrankState state;
  double position = 0, velocity = 0;  // of the slider [m, m/s]
  double rod_angle = 0;               // β [rad]
  SliderCrankForces forces;
  PowerFlow power;
  ActingLoads loads = all_loads;
};

// Order k of the crank's turn: amplitude and phase of A cos(k φ − phase).
struct ForceHarmonic {
  int order = 0;
  double amplitude = 0, phase = 0;
  double error = 0;  // of the amplitude
};
inline constexpr int highest_order = 8;

// A figure of the cycle with where it is reached.
struct Peak {
  double value = 0;
  double phi = 0;               // [rad]
  std::optional<double> error;  // theory 9.13
  double scale = 0;             // of the forces or moments that it is the sum of: what it is rounded by
  bool unbounded = false;       // it grows without bound; the value is that a thousandth of the way beside the place
  double told() const { return unbounded ? HUGE_VAL : value; }
};

struct CycleWork {
  std::string name;
  std::string kind;     // driving, useful, harmful, weight
  double work = 0;      // done on the mechanism [J]
  double turnover = 0;  // ∫|dA|: what goes to and fro [J]
  double error = 0;     // [J]
};

// One of the two problems over one cycle.
struct ForceCycle {
  std::string label;                                           // "prescribed", "simulated"
  std::string description;                                     // for people
  double cycle = 0;                                            // [rad]
  double mean_speed = 0, least_speed = 0, greatest_speed = 0;  // of the crank [rad/s]
  double first_speed = 0, last_speed = 0;  // of the crank at the cycle's begin and end in time [rad/s]
  double closure = 0;                      // speed at the end − at the begin, over the mean: steady motion has none
  std::vector<CyclePosition> positions;    // 720 of a turn, evenly, both ends, whatever is asked for
  std::vector<CyclePosition> rows;         // those asked for, both ends
  std::vector<CyclePosition> curve;        // positions, both sides of every load edge, and the peaks
  Peak reaction[joint_count];              // [N]
  Peak torque, shaking_force, shaking_moment;
  CyclePosition at_torque_peak;
  int both_edges = 0;  // positions where both edges bear
  std::vector<ForceHarmonic> shaking_x, shaking_y, shaking_couple, torque_orders;
  double torque_mean = 0, torque_mean_error = 0;  // [N·m]
  double mean_speed_error = 0, speed_error = 0;   // the latter of the least and the greatest [rad/s]
  double closure_error = 0;
  std::vector<CycleWork> work;                  // by account: crank, loads, weight, friction of each joint
  double kinetic_change = 0, kinetic_most = 0;  // of the mechanism over the cycle, greatest [J]
  double kinetic_error = 0;                     // of the change, as that of a work [J]
  double input = 0, useful = 0, harmful = 0;    // work that goes in, comes out usefully, is lost [J], ≥ 0
  double spent = 0;                             // input less what the motion stores [J]
  std::optional<double> efficiency;             // useful/spent, where works beyond their errors make one: 0 … 1
  double work_error = 0, efficiency_error = 0;  // of input, useful, harmful work [J]; of the efficiency
  std::string no_efficiency;                    // else why
  double power_residual = 0;                    // largest
  double friction_residual = 0;                 // largest, of the friction laws
  std::optional<double> machine_residual;       // of the torque, from the compiled machine's own, over the largest
  int most_iterations = 0;
};

struct LinkageCycle;  // linkage_cycle.h

struct Counterweight {
  std::string name;
  double moment = 0;                // mass · radius opposite to the pin [kg·m]; < 0: on the pin's side
  double reciprocating_share = 0;   // of the first order's reciprocating mass that it balances
  double peak_force = 0;            // of the shaking force that remains [N]
  double first_x = 0, first_y = 0;  // its first order along and across the stroke [N]
  double peak_bearing = 0;          // reaction of the main bearing [N]
  double peak_force_error = 0, first_x_error = 0, first_y_error = 0, peak_bearing_error = 0;
  std::vector<Force2> shaking;  // over the turn, as the positions of the first problem
};

struct Forces {
  std::string title, scene_file, scene_text, mechanism;
  SpeedUnit speed_unit;
  SliderCrankData data;
  SliderCrankJoints joints;
  double rotating_moment = 0;     // of crank and the rod's share in the crank pin, towards the pin [kg·m]
  double reciprocating_mass = 0;  // of slider and the rod's share in the slider pin [kg]
  std::optional<ForceCycle> prescribed, simulated;
  std::optional<ForceCycle> rigid;            // the second problem of an elastic machine without elasticity, for plots
  bool elastic = false;                       // the second problem's machine is
  std::shared_ptr<const LinkageCycle> links;  // of the problem in front, joints without friction: motion and inertia
  std::vector<CyclePosition> also;            // of the first problem, at the further angles that were asked for
  std::vector<Counterweight> counterweights;  // the first: as it is
  UnboundedReactions unbounded;
  std::vector<std::string> notes;
  bool complete = true;
  std::string diagnosis;
};

// Throws SceneError where the scene makes no machine; std::invalid_argument where it has no mechanism or options
// are senseless, or the mechanism is of another kind; std::runtime_error with the position where the joints jam.
Forces find_forces(const Scene& scene, const ForcesOptions& options);

// Orders 0 … highest of values given evenly over `turns` turns, both ends (trapezium rule, exact for smooth functions).
std::vector<ForceHarmonic> harmonics(const std::vector<double>& values, int turns, double* mean = nullptr);
// The same with what half of the values make otherwise, and rounding of `scale`, as their error. An even number of
// cells.
std::vector<ForceHarmonic> measured_harmonics(const std::vector<double>& values, int turns, double scale);

}  // namespace kurbel
