// forces.h — kinetostatics of a scene's slider-crank over a cycle: reactions, balancing torque, friction, balancing.
//
// First problem: the crank turns at a given speed; what forces does that need? Second problem: the machine runs as its
// torques drive it, with the scene's effects, and the forces follow from the motion that it keeps.   (theory 9)
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
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

struct CyclePosition {
  CrankState state;
  double position = 0, velocity = 0;  // of the slider [m, m/s]
  double rod_angle = 0;               // β [rad]
  SliderCrankForces forces;
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

// What either problem tells of one cycle of any mechanism.
struct CycleOfForces {
  std::string label;                                 // "prescribed", "simulated"
  std::string description;                           // for people
  double cycle = 0;                                  // [rad]
  Estimate mean_speed, least_speed, greatest_speed;  // of the crank; the mean over the time [rad/s]
  Estimate closure;                                  // speed at the end − at the begin, over the mean: 0 if steady
  Peak torque, shaking_force, shaking_moment;
  std::vector<ForceHarmonic> shaking_x, shaking_y, shaking_couple, torque_orders;
  Estimate torque_mean;                    // over the angle [N·m]
  std::vector<CycleWork> work;             // by account: loads, weight, the balancing torque, friction of each joint
  Estimate kinetic_change;                 // of the mechanism over the cycle [J]
  double power_residual = 0;               // largest, of the powers' balance at a position
  std::optional<double> machine_residual;  // of the torque, from the compiled machine's own, over the largest

  // Every error by `times` the difference to the other one; peaks are compared by magnitude.
  void widen_to(const CycleOfForces& other, double times);
  // Of what hangs on the loads, and of all else that hangs on how they move the machine.
  void drop_errors(bool of_motion);
};
void widen_peak(Peak& peak, const Peak& other, double times);

// One of the two problems of a slider-crank.
struct ForceCycle : CycleOfForces {
  double first_speed = 0, last_speed = 0;  // of the crank at the cycle's begin and end in time [rad/s]
  std::vector<CyclePosition> positions;    // 720 of a turn, evenly, both ends, whatever is asked for
  std::vector<CyclePosition> rows;         // those asked for, both ends
  std::vector<CyclePosition> curve;        // positions, both sides of every load edge, and the peaks
  Peak reaction[joint_count];              // [N]
  CyclePosition at_torque_peak;
  int both_edges = 0;                  // positions where both edges bear
  double kinetic_most = 0;             // of the mechanism, greatest [J]
  Estimate input, useful, harmful;     // work that goes in, comes out usefully, is lost [J], ≥ 0
  double spent = 0;                    // input less what the motion stores [J]
  std::optional<Estimate> efficiency;  // useful/spent, where works beyond their errors make one: 0 … 1
  std::string no_efficiency;           // else why
  double friction_residual = 0;        // largest, of the friction laws
  int most_iterations = 0;

  void widen_to(const ForceCycle& other, double times);
  void drop_errors(bool of_motion);
};

struct LinkageCycle;  // linkage_cycle.h

struct Counterweight {
  std::string name;
  double moment = 0;               // mass · radius opposite to the pin [kg·m]; < 0: on the pin's side
  double reciprocating_share = 0;  // of the first order's reciprocating mass that it balances
  Estimate peak_force;             // of the shaking force that remains [N]
  Estimate first_x, first_y;       // its first order along and across the stroke [N]
  Estimate peak_bearing;           // reaction of the main bearing [N]
  std::vector<Force2> shaking;     // over the turn, as the positions of the first problem
};

// What a study of forces is about, of whichever mechanism.
struct AboutForces {
  std::string title, scene_file, scene_text, mechanism;
  SpeedUnit speed_unit;
  bool elastic = false;  // the second problem's machine is
  UnboundedReactions unbounded;
  std::vector<std::string> outside_data;  // what is taken from beyond the ends of tables; that has no error
  std::vector<std::string> notes;
  bool complete = true;
  std::string diagnosis;
};
template <class Cycle, class Position>
struct StudyOfForces : AboutForces {
  std::optional<Cycle> prescribed, simulated;
  std::optional<Cycle> rigid;  // the second problem of an elastic machine without elasticity, for plots
  std::vector<Position> also;  // of the first problem, at the further angles that were asked for
};

struct Forces : StudyOfForces<ForceCycle, CyclePosition> {
  SliderCrankData data;
  SliderCrankJoints joints;
  double rotating_moment = 0;                 // of crank and the rod's share in the crank pin, towards the pin [kg·m]
  double reciprocating_mass = 0;              // of slider and the rod's share in the slider pin [kg]
  std::shared_ptr<const LinkageCycle> links;  // of the problem in front, joints without friction: motion and inertia
  std::vector<Counterweight> counterweights;  // the first: as it is
};

// A problem under loads from outside of their data. Of a table that another problem left, too, that is told once, however far
// either went.
template <class Cycle>
void tell_outside_data(AboutForces& about, const std::vector<std::string>& sentences, Cycle& cycle, bool simulated) {
  if (sentences.empty()) return;
  const auto table = [](const std::string& told) { return told.substr(0, told.find(", and the motion goes to")); };
  for (const std::string& sentence : sentences)
    if (std::none_of(about.outside_data.begin(), about.outside_data.end(),
                     [&](const std::string& told) { return table(told) == table(sentence); }))
      about.outside_data.push_back(sentence);
  cycle.drop_errors(simulated);
}

// Of a study of forces: the problems that were solved, the first of them first; the last one is the machine's own motion,
// where there is one.
template <class Study>
auto problems_of(const Study& f) {
  std::vector<decltype(&*f.prescribed)> problems;
  for (const auto* problem : {&f.prescribed, &f.simulated})
    if (*problem) problems.push_back(&**problem);
  return problems;
}
template <class Study>
const auto& front_of(const Study& f) {
  return f.simulated ? *f.simulated : *f.prescribed;
}

// Throws SceneError where the scene makes no machine; std::invalid_argument where it has no mechanism or options
// are senseless, or the mechanism is of another kind; std::runtime_error with the position where the joints jam.
Forces find_forces(const Scene& scene, const ForcesOptions& options);

// Orders 0 … highest of values given evenly over `turns` turns, both ends (trapezium rule, exact for smooth functions).
std::vector<ForceHarmonic> harmonics(const std::vector<double>& values, int turns, double* mean = nullptr);
// The same with what half of the values make otherwise, and rounding of `scale`, as their error. An even number of
// cells.
std::vector<ForceHarmonic> measured_harmonics(const std::vector<double>& values, int turns, double scale);

}  // namespace kurbel
