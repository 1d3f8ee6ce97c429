// operating_points.h — where the drive's mean torque meets the loads' over a cycle, and how a machine gets there.
//
//     M̄(ω) = (1/Φ) ∮ M(φ, ω) dφ at constant ω;  operating points M̄_d(ω) = M̄_c(ω), stable where dM̄_d/dω < dM̄_c/dω
//                                                                                                 (theory 4.15)
#pragma once

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/rigid/rigid_machine.h"

namespace kurbel {

// Mean torques over a cycle at a constant speed, reduced to the link; M_c is positive where it brakes.
struct MeanTorques {
  double omega = 0;            // of the link [rad/s]
  double drive = 0, load = 0;  // M̄_d, M̄_c [N·m]
  double net() const { return drive - load; }
};

// Gauss–Legendre between the load edges.
class MeanCharacteristic {
 public:
  // direction: ±1, of the link's rotation; finer: so many times as many intervals.
  MeanCharacteristic(RigidMachine& machine, int direction, int finer = 1);
  MeanTorques at(double omega);  // |omega| > 0

 private:
  RigidMachine& machine_;
  int direction_;
  std::vector<double> begin_, width_;  // intervals of the cycle that no edge divides [rad]
};

struct OperatingPoint {
  MeanTorques mean;
  double drive_slope = 0, load_slope = 0;    // dM̄/d|ω| [N·m·s/rad]
  double speed_error = 0, torque_error = 0;  // against twice as many intervals [rad/s], [N·m]
  bool beyond_data = false;                  // at a speed beyond the end of a table
  bool stable() const { return drive_slope < load_slope; }
};

struct OperatingDiagram {
  std::vector<MeanTorques> curve;  // over |ω|, ascending
  std::vector<OperatingPoint> points;
  MeanTorques strongest;       // where the drive's mean torque is greatest (breakdown; of a shunt motor: at standstill)
  double strongest_error = 0;  // of its torque [N·m]
  bool uses_speed = true;
  int direction = 1;
  SpeedUnit speed_unit;

  // The fastest stable one; null if there is none.
  const OperatingPoint* working_point() const;
  // Greatest over needed mean torque at the working point, 1 = none to spare.
  double margin(const OperatingPoint& point) const { return strongest.drive / point.mean.load; }
  double margin_error(const OperatingPoint& point) const {
    return (strongest_error + std::abs(margin(point)) * point.torque_error) / std::abs(point.mean.load);
  }
  // Why there is no working point: stall (and by how much the drive is too weak) or runaway. Empty where there is one.
  std::string why_none(const std::string& link) const;
};

// Scans the speeds up to 1.25 × the rated one, and on while the drive is still stronger.
OperatingDiagram operating_diagram(RigidMachine& machine, int direction);

// A source or a load goes on or off at a time.
bool is_switched(const Network& network);

struct StartRun {
  bool reached = false;
  double time = 0;           // from rest to the target [s]
  double error = 0;          // against a hundred times looser steps [s]
  std::vector<double> t, w;  // the link's speed on the way [s, rad/s]
  std::string why;           // where it was not reached
};
// A rigid model from rest at the scene's start angle until a node (−1: the link) turns at `target` [rad/s].
StartRun start_from_rest(const std::shared_ptr<const Model>& rigid, double target, double limit,
                         const std::atomic<bool>* interrupted = nullptr, int node = -1, bool with_error = true);

// Ratio of the gearbox between motor and machine with which the machine's shaft starts fastest under constant torques:
//     α = (η i T_m − T_c)/(J + η i² J_m)  is greatest at  i = [T_c + √(T_c² + η T_m² J/J_m)]/(η T_m)
// T_c = 0 and η = 1: i = √(J/J_m). All > 0, load torque ≥ 0, 0 < efficiency ≤ 1; throws std::invalid_argument else.
double fastest_start_ratio(double motor_torque, double motor_inertia, double load_torque, double load_inertia,
                           double efficiency = 1);

// The same for any characteristic: start times over the ratio of a gearbox, by simulation.
struct RatioSearch {
  std::string gearbox;
  double present = 0, best = 0;            // ratio of the gearbox
  double present_time = 0, best_time = 0;  // [s]; present_time 0: never reached
  std::vector<double> ratio, time;         // tried, ascending
  bool at_bound = false;                   // still better ratios lie beyond those tried
};
// For every gearbox of the scene: until its driven shaft has the speed that belongs to `target` of the link as the
// scene is. Tried from an eighth to eight times the present ratio; empty where there is no gearbox or no ratio starts
// it.
std::vector<RatioSearch> fastest_ratios(const Scene& scene, double target, double limit,
                                        const std::atomic<bool>* interrupted = nullptr);

}  // namespace kurbel
