// operating_points.h — balance of the mean torques of drive and loads over a cycle, and the start of a machine.
//
//     M̄(ω) = (1/Φ) ∮ M(φ, ω) dφ at constant ω;  operating points M̄_d(ω) = M̄_c(ω), stable where dM̄_d/dω < dM̄_c/dω
//                                                                                                 (theory 4.15)
// Losses that depend on transmitted loads (gears, joints, bearings) are included in the torques at φ and ω, from the
// machine's equations of motion: M̄_c is the drive torque that keeps the mean speed, so that no mean acceleration passes
// through the losses.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/estimate.h"
#include "engine/events/equations.h"
#include "engine/rigid/rigid_machine.h"

namespace kurbel {

// Mean torques over a cycle at constant speed, reduced to the link; M_c is positive if it brakes.
struct MeanTorques {
  double omega = 0;            // of the link [rad/s]
  double drive = 0, load = 0;  // M̄_d, M̄_c [N·m]
  double turnover = 0;         // mean of Σ|M| over all drives and loads, the reference for rounding [N·m]
  double net() const { return drive - load; }
};

// The effects of the rigid machine including load-dependent losses.
Effects rigid_with_losses(const Effects& effects);
// The same machine with these losses, and with a torque at every drive, equally strong on the link, that keeps its speed.
struct LossyMachine {
  std::shared_ptr<const Model> model = {};  // null: the effects include no such losses
  std::shared_ptr<double> holding = {};     // on the link, in the direction of its angle; 0 unless set [N·m]
};
LossyMachine machine_with_losses(const Network& network, const Scene& scene, const Effects& effects);

// Gauss–Legendre integration between the load edges.
class MeanCharacteristic {
 public:
  // direction: ±1, of the link's rotation; finer: factor on the number of intervals.
  MeanCharacteristic(RigidMachine& machine, int direction, int finer = 1, LossyMachine lossy = {});
  // |omega| > 0. NaN if the machine jams, or has states besides angle and speed.
  MeanTorques at(double omega);

 private:
  MeanTorques with_losses(double omega, double holding);
  void add_static(MeanTorques& mean, std::size_t interval);
  void add_moving(MeanTorques& mean, std::size_t interval);

  RigidMachine& machine_;
  LossyMachine lossy_;
  std::unique_ptr<Equations> moving_;  // with losses
  double holding_ = 0, slope_ = 1;     // at the last speed: the torque that keeps it, ∂net/∂holding
  int direction_;
  std::vector<double> begin_, width_;  // intervals of the cycle without edges inside [rad]
};

// Errors: by twice as many intervals; none beyond the end of a table.
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
  double balance_error = 0;  // of the net torque if speed has no influence, or at its greatest [N·m]
  bool uses_speed = true;
  // Losses or states of the machine are omitted: an estimate without error, not used for verdicts.
  bool estimate = false;
  void become_estimate();  // drops its errors
  int direction = 1;
  SpeedUnit speed_unit;
  std::string brakes;  // that are on, and among the loads

  // The fastest stable one; null if there is none.
  const OperatingPoint* working_point() const;
  // Greatest over required mean torque at the working point; 1: no reserve.
  Estimate margin(const OperatingPoint& point) const { return strongest / point.torque; }
  // Why there is no working point: stall (with the deficit of the drive) or runaway. Empty if there is one, and for
  // an estimate.
  std::string why_none(const std::string& link) const;
};

// Scans the speeds up to 1.25 × the rated one, and further while the drive is stronger.
OperatingDiagram operating_diagram(RigidMachine& machine, int direction, const LossyMachine& lossy = {});

// A source or a load is switched at some time.
bool is_switched(const Network& network);

struct StartRun {
  bool reached = false;
  Estimate time;             // from rest to the target; error: difference with 100 × looser steps [s]
  std::vector<double> t, w;  // the link's speed during the start [s, rad/s]
  std::string why;           // why it was not reached
  bool falls_short = false;  // it was simulated to the end, and did not reach it
};
// A machine without elasticity, from rest at the scene's start angle until a node (−1: the link) turns at `target` [rad/s].
StartRun start_from_rest(const std::shared_ptr<const Model>& rigid, double target, double limit,
                         const std::atomic<bool>* interrupted = nullptr, int node = -1, bool with_error = true);

// Start times over the ratio of a gearbox, from simulation.
struct RatioSearch {
  std::string gearbox;
  double present = 0, best = 0;            // ratio of the gearbox
  double present_time = 0, best_time = 0;  // [s]; present_time 0: never reached
  std::vector<double> ratio, time;         // tried ratios, ascending, and their times
  bool at_bound = false;                   // the best ratio may lie beyond those tried
};
// For every gearbox of the scene: until its driven shaft has the speed that corresponds to `target` of the link in
// the given scene. Ratios from an eighth to eight times the present one; empty if there is no gearbox or no ratio
// allows a start.
std::vector<RatioSearch> fastest_ratios(const Scene& scene, const Effects& effects, double target, double limit,
                                        const std::atomic<bool>* interrupted = nullptr);

}  // namespace kurbel
