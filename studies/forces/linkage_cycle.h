// linkage_cycle.h — kinetostatics of any mechanism with ideal joints over a cycle: reactions in every joint, balancing
// torque, shaking force and moment, inertia forces and motion of every link, its shares in I_r and kinetic energy.
//
// Signs and axes: newton_euler.h. Every figure has an error (theory 9.13): what a search at half the resolution finds
// otherwise, rounding, and, where the motion is simulated, the difference to a run with 30 × looser tolerance.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanisms/reduced/mechanism_data.h"
#include "mechanisms/reduced/newton_euler.h"
#include "studies/forces/crank_motion.h"
#include "studies/forces/forces.h"

namespace kurbel {

struct PositionForces {
  LinkageForces forces;
  PowerFlow power;
  ActingLoads loads = {};
};

// Of the crank at a position.
inline const CrankState& state_of(const CyclePosition& p) { return p.state; }
inline const LinkageState& state_of(const PositionForces& p) { return p.forces.state; }

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

struct LinkageCycle : CycleOfForces {
  std::vector<PositionForces> positions;  // 720 of a turn, evenly, both ends, whatever is asked for
  std::vector<PositionForces> rows;       // those asked for, both ends
  std::vector<PositionForces> curve;      // positions, both sides of every load edge, and the peaks
  std::vector<NamedPeak> reactions;       // of each joint; of a slide its normal force, then its moment
  std::vector<LinkOfCycle> links;
  double equation_residual = 0;  // largest, of the links' equilibrium

  void widen_to(const LinkageCycle& other, double times);
  void drop_errors(bool of_motion);
};

// At one angle of the crank; of a mechanism that passes change points, beside them.
PositionForces linkage_position(const MechanismData& data, OutputLoads& loads, double phi, CrankMotion motion);
// Along one motion. Throws std::runtime_error where the mechanism has no finite reactions.
LinkageCycle linkage_cycle(const MechanismData& data, OutputLoads& loads, const MotionAlong& motion);
// Where a mechanism that passes change points has reactions without bound, at this speed of its crank.
UnboundedReactions unbounded_reactions(const MechanismData& data, OutputLoads& loads, double speed);
// Marks the peaks that have none.
void mark_unbounded(const UnboundedReactions& unbounded, LinkageCycle& cycle);
// "saw at 290 rpm: its joints' reactions have no bound at 90° and 270°, 10.4 kN within 0.01 rad of them": how a conclusion
// begins; empty where they are bounded.
std::string begin_unbounded(const std::string& mechanism, const UnboundedReactions& unbounded);

// A scene's mechanism.
struct LinkageStudy : StudyOfForces<LinkageCycle, PositionForces> {
  std::string kind;
  bool rocks = false;  // the output is an angle
};
LinkageStudy find_linkage_forces(const Scene& scene, const ForcesOptions& options);

}  // namespace kurbel
