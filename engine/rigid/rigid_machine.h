// rigid_machine.h — the rigid machine: inertia and torques as functions of angle and speed of its reduction link.
//
//     I_r(φ) ε + ½ I_r′ ω² = M(φ, ω) = Σ shares,   M = M_d − M_c (theory 2.1, 2.2, 2.4)
// All is reduced to the model's reduction link (the first mechanism's crank, else the line's first shaft).
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/events/equations.h"
#include "engine/model/cycle_of.h"
#include "engine/model/model.h"

namespace kurbel {

// All effects off, clutches locked: the machine of one coordinate. Not the rigid machine that is compared with an elastic
// one: that has friction and losses (without_elasticity in engine/scene/effects.h).
Effects rigid_effects();

// A range of the reduction link's angle [rad].
struct AngleRange {
  double from = 0, to = 0;
  bool holds(double phi) const { return from <= phi && phi <= to; }
  // The i-th of so many equal steps; the middle of −φ … φ is 0 without rounding.
  double place(int i, int of) const {
    const double phi = from + (to - from) * i / of;
    return std::abs(phi) < 1e-13 * std::abs(from) ? 0 : phi;
  }
};

class RigidMachine {
 public:
  // Compiles the scene with elasticity off. Throws SceneError if it is not a machine; std::invalid_argument if it has no
  // free coordinate (a prescribed speed).
  explicit RigidMachine(const Scene& scene);
  // From a rigid model; throws std::invalid_argument also if some elasticity is on.
  explicit RigidMachine(std::shared_ptr<const Model> model);
  // The machine over a range, as that of a crank that rocks and never turns fully: it stands for the cycle, and nothing
  // repeats. Without a range such a crank is refused (std::invalid_argument).
  RigidMachine(std::shared_ptr<const Model> model, const std::optional<AngleRange>& range);

  const Model& model() const { return *model_; }
  // Angle of one cycle of the link [rad]: 2π; 4π with a four-stroke load; n · 2π with gears between the link and other
  // elements that depend on an angle; 2π for machines without a mechanism.
  double cycle() const { return cycle_; }
  double begin() const { return begin_; }  // of the range [rad]; 0 of a cycle
  bool has_range() const { return has_range_; }
  // False if no multiple of 2π up to 24 turns is a period of all elements: the machine is not periodic.
  bool periodic() const { return periodic_; }
  // Some torque depends on time (sources over time, windows): angle and speed are then not sufficient, and torques are those
  // at t = 0. Elements without information count as depending on time.
  bool uses_time() const;
  // Some torque depends on the magnitude of the speed (motors, fans, medium). If none does, M is a function of φ only, for
  // each direction of motion.
  bool uses_speed() const;
  // All piecewise laws change only at angles: edges() is complete. False with tables over speed.
  bool edges_are_of_angle() const;

  // Inertia of all parts with a constant ratio, on the link [kg·m²]: motor, flywheel, gears …
  double constant_inertia() const;
  // I_em: reduced inertia of the executive mechanisms, on the link [kg·m²], and its derivative by the link's angle.
  struct Inertia {
    double value = 0, slope = 0;
  };
  Inertia mechanism_inertia(double phi) const;

  // --- torques ---
  // Selects the piece of every piecewise law for motion through phi with speed omega ≠ 0; at an edge (to 1e-11 rad) the
  // piece ahead. The pieces are kept until the next call.
  void set_modes(double phi, double omega);
  struct At {
    double inertia = 0, slope = 0;  // I_r, I_r′ of the whole machine [kg·m²], [kg·m²/rad]
    double torque = 0;              // M = Σ shares [N·m]
    std::span<const double> share;  // per entry of model().accounts, reduced to the link [N·m]; only if requested
  };
  // With the present modes. Smooth in phi and omega. share is valid until the next call and needs omega ≠ 0.
  At at(double phi, double omega, bool shares = false);
  // All quantities of the machine there at t = 0, with the pieces valid there. Valid until the next call; omega ≠ 0.
  const Snapshot& snapshot(double phi, double omega);

  // Angles within the cycle, [0, cycle()), or the range, at which the law of some torque changes in this direction of the link (±1): load edges, knots
  // of tables over angle or travel, dead centres of opposing loads; ascending, located to 1e-13 rad.
  std::vector<double> edges(int direction);

 private:
  struct Mechanism {
    const AnyShaftElement* element;  // owned by the model
    double ratio, phase;             // own angle = ratio · φ + phase
  };
  class EdgeSearch;
  void look_ahead(double phi, double omega, double distance);
  void fill_state(double phi, double omega);

  std::shared_ptr<const Model> model_;
  Equations equations_;
  double cycle_ = 0, begin_ = 0;
  bool has_range_ = false;
  bool periodic_ = true;
  std::vector<Mechanism> mechanisms_;
  std::vector<double> state_, share_;
};

}  // namespace kurbel
