// work_equation.h — the rigid machine over its angle instead of time: equation of work, time by quadrature.
//
//     d(½ I_r ω²)/dφ = M(φ, ω),   dt = dφ/ω                                                       (theory 2.5)
// Smooth between load edges, which are at known angles. If torques depend only on the angle, the first equation is a
// quadrature, T(φ) = T₀ + ∫M dφ, the same in every cycle: WorkOverAngle. Machines whose torques also depend on the speed
// are integrated by WorkStepper.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "engine/rigid/rigid_machine.h"

namespace kurbel {

// ∫M dφ and I_r(φ) over one cycle in one direction of motion, on panels that end at the load edges. Each panel has the
// functions at 16 Gauss–Legendre nodes and is short enough for an agreement with the machine to 1e-12.
// s = direction · φ increases with the motion; s = 0 at φ = 0.
class WorkOverAngle {
 public:
  // For machines whose torques depend only on the angle. edges: machine.edges(direction).
  WorkOverAngle(RigidMachine& machine, const std::vector<double>& edges, int direction);

  int direction() const { return direction_; }
  double cycle() const { return cycle_; }
  std::size_t panels() const { return panel_.size(); }
  // Work of the torques from s = 0, for any s [J]; over one cycle. Work per cycle below 1e-12 of the torques' turnover is
  // rounding of their tables and counts as zero: such a machine conserves its energy.
  double work(double s) const;
  double work_per_cycle() const { return per_cycle_; }
  double inertia(double s) const;  // I_r [kg·m²]

  struct Motion {
    double t = 0;             // [s]
    double s = 0;             // within a cycle [rad]
    std::int64_t cycles = 0;  // whole cycles before that
    double speed = 0;         // |ω| [rad/s]
    bool stalled = false;     // at rest at s, at time t, before the end
  };
  // Motion from s₀ ≥ 0 with speed ≥ 0 until a time; it ends earlier if the kinetic energy becomes zero. Time is the integral
  // of 1/ω, with s = s* ∓ u² where the speed vanishes; the end is found by Newton's method. Whole cycles of a machine that
  // conserves its energy are one multiplication; else each cycle takes 16 square roots per panel.
  // Throws std::invalid_argument if the start is not finite.
  Motion advance(double s0, double speed, double until) const;

 private:
  static constexpr std::size_t nodes = 16;
  // Near a change point I_r changes within an angle √(2 (l − r)/r): 4.5e-4 rad if the rod is longer than the crank by 10⁻⁷.
  // Panels are bisected until they resolve this; in narrow ones the remaining error may be rounding of the tables.
  static constexpr double narrow = std::numbers::pi / 512;  // [rad]
  using Values = std::array<double, nodes>;
  struct Panel {
    double begin = 0, half = 0;        // half: half its width [rad]
    Values inertia, work;              // at the nodes; work from s = 0
    Values inertia_term, torque_term;  // Legendre coefficients
    double work_begin = 0;
  };
  // A stretch of a panel, regular or with the square root of its distance to rest as variable.
  struct Stretch {
    enum class Rest { none, at_begin, at_end } rest = Rest::none;
    double begin = 0, end = 0;
    double s(double u) const;      // u = −1 … 1
    double ds_du(double u) const;  //
  };
  class Traversal;

  void add_panels(RigidMachine& machine, double begin, double end, double largest_torque);
  void close_cycle();
  const Panel& panel_at(double s) const;
  double work_in(const Panel& panel, double s) const;
  double inertia_in(const Panel& panel, double s) const;

  int direction_ = 1;
  double cycle_ = 0, per_cycle_ = 0, turnover_ = 0;
  std::vector<Panel> panel_;
};

// Tables made once for a model and used by many runs.
class WorkTables {
 public:
  // Throws std::invalid_argument with refusal() if the work equation does not apply.
  explicit WorkTables(std::shared_ptr<const Model> model);
  // The reason why the model cannot be integrated over its angle; empty: it can.
  static std::string refusal(const std::shared_ptr<const Model>& model);

  const RigidMachine& machine() const { return machine_; }
  bool of_angle_alone() const { return of_angle_alone_; }
  // Ascending in s = direction · φ, within [0, cycle).
  const std::vector<double>& edges(int direction);
  // Only if torques depend only on the angle.
  const WorkOverAngle& diagram(int direction);

 private:
  static std::size_t side(int direction) { return direction >= 0 ? 0 : 1; }
  RigidMachine machine_;
  bool of_angle_alone_ = false;
  std::array<std::optional<std::vector<double>>, 2> edges_;
  std::array<std::unique_ptr<WorkOverAngle>, 2> diagram_;
};

}  // namespace kurbel
