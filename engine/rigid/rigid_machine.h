// rigid_machine.h — the machine with everything rigid: inertia and torques as functions of its link's angle and speed.
//
//     I_r(φ) ε + ½ I_r′ ω² = M(φ, ω) = Σ shares,   M = M_d − M_c (theory 2.1, 2.2, 2.4)
// All is reduced to the model's reduction link (the first mechanism's crank, else the line's first shaft).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/events/equations.h"
#include "engine/model/cycle_of.h"
#include "engine/model/model.h"

namespace kurbel {

// Everything off, clutches locked: the machine of one coordinate. Not what stands beside an elastic machine as the rigid
// one: that keeps its friction and its losses (without_elasticity in engine/scene/effects.h).
Effects rigid_effects();

class RigidMachine {
 public:
  // Compiles the scene with elasticity off. Throws SceneError where it makes no machine; std::invalid_argument in words
  // where it has no free coordinate (a prescribed speed).
  explicit RigidMachine(const Scene& scene);
  // Of a model that is rigid already; throws std::invalid_argument where some elasticity is on, too.
  explicit RigidMachine(std::shared_ptr<const Model> model);

  const Model& model() const { return *model_; }
  // Angle of one cycle of the link [rad]: 2π; 4π where a four-stroke load says so, n · 2π where gears stand between
  // the link and other elements of an angle; 2π for machines without a mechanism.
  double cycle() const { return cycle_; }
  // False where no multiple of 2π up to 24 turns is a period of every element: then nothing repeats.
  bool periodic() const { return periodic_; }
  // Some torque depends on time (sources over time, windows of action): then angle and speed are not the whole truth.
  // Torques are then those at t = 0. An element that does not say counts as depending on it.
  bool uses_time() const;
  // Some torque depends on the magnitude of the speed (motors, fans, medium). Where none does, M is a function of φ
  // alone for either direction of motion.
  bool uses_speed() const;
  // Every piecewise law changes at angles alone: edges() are all there are. False with tables over speed.
  bool edges_are_of_angle() const;

  // Inertia of everything that turns at a constant ratio, on the link [kg·m²]: motor, flywheel, gears …
  double constant_inertia() const;
  // I_em: reduced inertia of the executive mechanisms, on the link [kg·m²], and its derivative by the link's angle.
  struct Inertia {
    double value = 0, slope = 0;
  };
  Inertia mechanism_inertia(double phi) const;

  // --- torques ---
  // Chooses the piece of every piecewise law for motion through phi with speed omega ≠ 0; at an edge (to 1e-11 rad),
  // the piece that lies ahead. They then hold until the next call.
  void set_modes(double phi, double omega);
  struct At {
    double inertia = 0, slope = 0;  // I_r, I_r′ of the whole machine [kg·m²], [kg·m²/rad]
    double torque = 0;              // M = Σ shares [N·m]
    std::span<const double> share;  // per entry of model().accounts, reduced to the link [N·m]; empty unless asked for
  };
  // With the modes that hold. Smooth in phi and omega. share is valid until the next call and needs omega ≠ 0.
  At at(double phi, double omega, bool shares = false);
  // All of the machine there at t = 0, by the pieces that hold there. Valid until the next call; omega ≠ 0.
  const Snapshot& snapshot(double phi, double omega);

  // Angles within [0, cycle()) where some torque's law changes when the link turns in this direction (±1): load edges,
  // knots of tables over angle or travel, dead centres of loads that oppose; ascending, located to 1e-13 rad.
  std::vector<double> edges(int direction);

 private:
  struct Mechanism {
    const AnyShaftElement* element;  // belongs to the model
    double ratio, phase;             // own angle = ratio · φ + phase
  };
  class EdgeSearch;
  void look_ahead(double phi, double omega, double distance);
  void fill_state(double phi, double omega);

  std::shared_ptr<const Model> model_;
  Equations equations_;
  double cycle_ = 0;
  bool periodic_ = true;
  std::vector<Mechanism> mechanisms_;
  std::vector<double> state_, share_;
};

}  // namespace kurbel
