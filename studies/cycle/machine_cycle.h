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

// Relative tolerance of each function, over its largest value; the reduced inertia comes from tables accurate to
// 1e-12, whose knots must not be taken for corners.
inline constexpr double cycle_sampling = 1e-11;
// Throws std::invalid_argument if the machine has no cycle (nothing repeats).
MachineCycle machine_cycle(RigidMachine& machine, double speed, double sampling = cycle_sampling);

// Load edges of the cycle, with its begin and end.
std::vector<double> cycle_edges(RigidMachine& machine);

// The drive is too weak for steady motion; what() gives the deficit.
struct WeakDrive : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// The speed at which, held constant, the mean torque over a cycle vanishes and is negative at higher speed.
struct OperatingSpeed {
  double speed = 0;            // [rad/s]
  double mean_drive = 0;       // [N·m]
  double slope = 0;            // d(mean M_d − mean M_c)/dω [N·m·s/rad], < 0: stable
  double drive_slope = 0;      // of mean M_d alone
  std::vector<double> others;  // further stable ones [rad/s]
};
// The fastest stable one. Throws std::invalid_argument with the reason: no torque depends on the speed (then any
// speed is steady); nothing limits the speed; WeakDrive: the drive is too weak, with the deficit.
OperatingSpeed operating_speed(RigidMachine& machine);

}  // namespace kurbel
