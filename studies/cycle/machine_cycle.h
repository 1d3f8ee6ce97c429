// machine_cycle.h — one cycle of the rigid machine: torques and inertia as exact piecewise functions of the link's
// angle.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "engine/base/piecewise.h"
#include "engine/rigid/rigid_machine.h"
#include "studies/cycle/mechanism_inertia.h"

namespace kurbel {

// At a constant speed of the reduction link [rad/s]. All over the same breaks, which hold every load edge.
struct MachineCycle {
  double speed = 0;
  Piecewise drive, load;         // M_d, M_c [N·m]: M_c positive when it brakes (theory 2.2)
  std::vector<Piecewise> share;  // per work account, positive when it drives; M_d − M_c is their sum
  MechanismInertia mechanism;    // I_em [kg·m²]
};

// Each function to this part of its largest value; the reduced inertia comes from tables good to 1e-12, whose seams must
// not be taken for corners.
inline constexpr double cycle_sampling = 1e-11;
// Throws std::invalid_argument where the machine has no cycle (nothing repeats).
MachineCycle machine_cycle(RigidMachine& machine, double speed, double sampling = cycle_sampling);

// Load edges of the cycle with its begin and end.
std::vector<double> cycle_edges(RigidMachine& machine);

// The drive cannot keep the machine going; what() says by how much.
struct WeakDrive : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// Where the mean torque over a cycle vanishes at constant speed, and slows a faster machine: the operating speed.
struct OperatingSpeed {
  double speed = 0;            // [rad/s]
  double mean_drive = 0;       // [N·m]
  double slope = 0;            // d(mean M_d − mean M_c)/dω [N·m·s/rad], < 0: stable
  double drive_slope = 0;      // of mean M_d alone
  std::vector<double> others;  // further stable ones [rad/s]
};
// The fastest stable one. Throws std::invalid_argument in words: no torque depends on the speed (then any speed is
// a steady one); nothing limits the speed; as WeakDrive, the drive is too weak, and by how much.
OperatingSpeed operating_speed(RigidMachine& machine);

// Steady motion with torques of angle and speed: the periodic solution of dT/dφ = M(φ, ω), T = ½ I ω² (theory 11.5),
// with more inertia on the link. Found by Newton's method on the return map; spectrally accurate within each piece.
struct SteadyRigidCycle {
  bool found = false;
  bool stalls = false;  // the machine does, from any speed: that there is no cycle is known
  std::string why;      // none was found
  Piecewise speed;      // ω(φ) [rad/s]
  Piecewise drive;      // M_d along it [N·m]
  Extreme fastest, slowest;
  double multiplier = 0;  // of a disturbance of T over a cycle (Floquet); below 1: stable
  double time = 0;        // of a cycle [s]
  double mid_speed() const { return 0.5 * (fastest.value + slowest.value); }
  double delta() const { return (fastest.value - slowest.value) / mid_speed(); }
};
// `more_inertia` is added to the constant inertia [kg·m²]; may be negative while the whole stays positive. `cycle`
// gives the breaks, `near` a speed to begin with. A machine that stalls or has no steady cycle is no error: `why` says
// it.
SteadyRigidCycle steady_rigid_cycle(RigidMachine& machine, const MachineCycle& cycle, double more_inertia, double near);

}  // namespace kurbel
