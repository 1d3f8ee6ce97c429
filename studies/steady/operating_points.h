// operating_points.h — where the drive's mean torque meets the loads' over a cycle, and how a machine gets there.
//
//     M̄(ω) = (1/Φ) ∮ M(φ, ω) dφ at constant ω;  operating points M̄_d(ω) = M̄_c(ω), stable where dM̄_d/dω < dM̄_c/dω
//                                                                                                 (theory 4.15)
// Losses that depend on what is carried (gears, joints, bearings) belong to the torques at φ and ω: those that the machine's
// own equations of motion have there, with its acceleration.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/events/equations.h"
#include "engine/rigid/rigid_machine.h"

namespace kurbel {

// Mean torques over a cycle at a constant speed, reduced to the link; M_c is positive where it brakes.
struct MeanTorques {
  double omega = 0;            // of the link [rad/s]
  double drive = 0, load = 0;  // M̄_d, M̄_c [N·m]
  double turnover = 0;         // mean of Σ|M| over all that drives or brakes: what rounding is measured by [N·m]
  double net() const { return drive - load; }
};

// The rigid machine with what it loses by its loads.
Effects rigid_with_losses(const Effects& effects);
// Its equations of motion; null where the effects bring no such losses.
std::shared_ptr<const Model> machine_with_losses(const Network& network, const Scene& scene, const Effects& effects);

// Gauss–Legendre between the load edges.
class MeanCharacteristic {
 public:
  // direction: ±1, of the link's rotation; finer: so many times as many intervals; lossy: the same machine with its
  // losses, or null.
  MeanCharacteristic(RigidMachine& machine, int direction, int finer = 1,
                     const std::shared_ptr<const Model>& lossy = nullptr);
  // |omega| > 0. No numbers where the machine jams, or has states besides angle and speed.
  MeanTorques at(double omega);

 private:
  void add_static(MeanTorques& mean, std::size_t interval);
  void add_moving(MeanTorques& mean, std::size_t interval);

  RigidMachine& machine_;
  std::unique_ptr<Equations> moving_;  // with losses
  int direction_;
  std::vector<double> begin_, width_;  // intervals of the cycle that no edge divides [rad]
};

// Errors: against twice as many intervals; none beyond the end of a table.
struct OperatingPoint {
  Estimate speed, torque;                  // of the link, with its sign [rad/s]; M̄_c [N·m]
  double drive_slope = 0, load_slope = 0;  // dM̄/d|ω| [N·m·s/rad]
  bool beyond_data = false;                // at a speed beyond the end of a table
  bool stable() const { return drive_slope < load_slope; }
};

struct OperatingDiagram {
  std::vector<MeanTorques> curve;  // over |ω|, ascending
  std::vector<OperatingPoint> points;
  Estimate strongest;        // the drive's greatest mean torque (breakdown; of a shunt motor: at standstill) [N·m]
  double strongest_at = 0;   // [rad/s]
  double balance_error = 0;  // of the net torque where the speed does not matter, or where it is greatest [N·m]
  bool uses_speed = true;
  // Losses or states of the machine are left out: an estimate, which has no error and decides nothing.
  bool estimate = false;
  void become_estimate();  // its errors go
  int direction = 1;
  SpeedUnit speed_unit;

  // The fastest stable one; null if there is none.
  const OperatingPoint* working_point() const;
  // Greatest over needed mean torque at the working point, 1 = none to spare.
  Estimate margin(const OperatingPoint& point) const { return strongest / point.torque; }
  // Why there is no working point: stall (and by how much the drive is too weak) or runaway. Empty where there is one, and
  // for an estimate.
  std::string why_none(const std::string& link) const;
};

// Scans the speeds up to 1.25 × the rated one, and on while the drive is still stronger.
OperatingDiagram operating_diagram(RigidMachine& machine, int direction,
                                   const std::shared_ptr<const Model>& lossy = nullptr);

// A source or a load goes on or off at a time.
bool is_switched(const Network& network);

struct StartRun {
  bool reached = false;
  Estimate time;             // from rest to the target; error: against a hundred times looser steps [s]
  std::vector<double> t, w;  // the link's speed on the way [s, rad/s]
  std::string why;           // where it was not reached
};
// A machine without elasticity from rest at the scene's start angle until a node (−1: the link) turns at `target` [rad/s].
StartRun start_from_rest(const std::shared_ptr<const Model>& rigid, double target, double limit,
                         const std::atomic<bool>* interrupted = nullptr, int node = -1, bool with_error = true);

// Start times over the ratio of a gearbox, by simulation.
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
std::vector<RatioSearch> fastest_ratios(const Scene& scene, const Effects& effects, double target, double limit,
                                        const std::atomic<bool>* interrupted = nullptr);

}  // namespace kurbel
