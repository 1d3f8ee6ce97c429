// flow.h — equations of motion of a compiled model with fixed modes: right-hand side, Jacobian, outputs.
//
// State: [ angles φ | twists θ | speeds ω | internal states of the elements | quadratures ].
//   φ̇ = gain ω,   θ̇ = gain_a ω_a − gain_b ω_b,   I(φ) ω̇ = Σ torques − ½ I′ ω²        (theory 2.4, 5.2)
// While a contact is stuck (a locked clutch, a held shaft) its speeds are tied: one degree of freedom less, and the
// transmitted torque is solved with the accelerations (ties.h). Stuck or slipping is a mode.
// Twists are separate states: a twist of 1e-4 rad keeps its accuracy after the machine has turned by 1e6 rad.
//
// A Flow consists of a const Model, its modes, and working memory: all results are functions of (t, y, modes).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/equations/jam.h"
#include "engine/equations/joint_torques.h"
#include "engine/equations/reaction_balance.h"
#include "engine/equations/state.h"
#include "engine/equations/ties.h"
#include "engine/model/model.h"
#include "engine/numerics/ode_system.h"

namespace kurbel {

class Flow : public OdeSystem {
 public:
  // With an audit, the work of every account, the squares of the torques and the motor torques are integrated as well.
  Flow(std::shared_ptr<const Model> model, bool audit);
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  // OdeSystem. If no acceleration satisfies the friction at a state, flow() returns NaN rates.
  std::size_t size() const final { return states_ + quadratures_; }
  void flow(double t, std::span<const double> y, std::span<double> ydot) final;
  const SparsityPattern& jacobian_pattern() final;
  void jacobian(double t, std::span<const double> y, std::span<double> values) final;

  const Model& model() const { return *model_; }
  std::shared_ptr<const Model> shared_model() const { return model_; }
  bool audit() const { return quadratures_ > 0; }

  // --- the modes; with (t, y) they are the complete state ---
  const Modes& modes() const { return modes_; }
  // Sets the modes, which must be of this machine, and rebuilds the constraint rows.
  void bind(const Modes& modes);

  // --- indices in y ---
  std::size_t integral_count() const { return quadratures_; }  // of the audit, after the states in y
  std::size_t twist_index(int elastic) const { return twists_begin_ + static_cast<std::size_t>(elastic); }
  std::size_t speed_index(int shaft) const { return speeds_begin_ + static_cast<std::size_t>(shaft); }
  std::size_t work_index(std::size_t account) const { return states_ + account; }
  // ∫τ² dt of the transmitted and of the spring torque of a torque joint.
  std::size_t square_index(std::size_t torque_joint, bool spring) const {
    return states_ + model_->accounts.size() + 2 * torque_joint + (spring ? 1 : 0);
  }
  // ∫M dt and ∫M² dt of a motor's torque.
  std::size_t motor_index(std::size_t motor, bool squared) const {
    return states_ + model_->accounts.size() + 2 * (model_->torque_joints.size() + motor) + (squared ? 1 : 0);
  }
  std::string state_name(std::size_t state) const;
  // Scales of all states: speeds by rated speed, twists by rated torque over stiffness, angles by 1 rad.
  ErrorControl error_control(double tolerance) const;
  double angle_with_turns(std::size_t tracked, std::span<const double> y) const {
    return kurbel::angle_with_turns(modes_, tracked, y);
  }

  // --- outputs ---
  // All quantities of one instant; valid until the next call of any kind.
  const Snapshot& snapshot(double t, std::span<const double> y);
  double kinetic_energy(double t, std::span<const double> y);
  // The same by the bodies of the mechanisms instead of their reduced inertia; slow.
  double kinetic_energy_of_bodies(double t, std::span<const double> y);
  double stored_energy(double t, std::span<const double> y);
  // Σ torques including −½ I′ω² [N·m], and inertia [kg·m²] of a shaft: ω̇ = torque/inertia. Powers per account [W] if
  // work_rate is given.
  struct ShaftBalance {
    double torque = 0, inertia = 0;
  };
  ShaftBalance shaft_balance(std::size_t shaft, double t, std::span<const double> y, double* work_rate = nullptr);
  // ∂φ/∂θ per shaft: rotation of the shafts with the twist of one elastic joint, reduction link at rest.
  std::vector<double> shaft_angles_by_twist(std::size_t elastic) const;
  // Angles of all shafts from the twists, outwards from the leading shafts, whose angles must be set.
  void set_shaft_angles(const double* twists, std::vector<double>& angles) const;

  // Free bodies (theory 5.18) of the last snapshot(): maximum difference of a joint's torque computed from its two sides,
  // relative to the torques on the shaft; and the shaft.
  JointTorques::Open open_bodies() const { return joint_torques_.open(given_torques()); }

  // The last jam: a state at which no acceleration satisfies the friction.
  const std::optional<Jam>& jam() const { return jam_; }
  void forget_jam() { jam_.reset(); }

  // --- for the classes that find modes: contacts, start, switching ---
  // The modes for changes in place; the rows are unchanged until ties().make_rows().
  Modes& changing_modes() {
    kept_ = false;
    return modes_;
  }
  Ties& ties() { return ties_; }
  const Ties& ties() const { return ties_; }
  // The state as input of the elements; valid until the next call.
  Instant instant(double t, std::span<const double> y);
  // The instant of the last look() or evaluate().
  const Instant& now() const { return snapshot_.now; }
  void look(double t, std::span<const double> y);
  // What the last snapshot(), or flow() with reactions, found is kept, and found here again at the same state.
  void evaluate(double t, std::span<const double> y);
  // Results of the last evaluate(): accelerations of all shafts, including prescribed ones; inertias; torques on the shafts
  // without the torques of ties; torques and inertias of the elements.
  const std::vector<double>& accelerations();
  const std::vector<double>& inertia() const { return inertia_; }
  const ReactionBalance& reactions() const { return reactions_; }
  std::span<const double> effective_inertia() const {
    return reactions_.any() ? reactions_.effective_inertia() : std::span<const double>(inertia_);
  }
  const std::vector<double>& free_torque() const { return free_torque_; }
  const std::vector<double>& element_torque() const { return element_torque_; }
  const std::vector<double>& element_inertia() const { return element_inertia_; }
  // Puts additional degrees of freedom at rest relative to their shafts, by the accelerations of the last evaluate().
  void balance_followers(double* own) const;
  bool has_followers() const { return !following_.empty(); }
  std::size_t state_count() const { return states_; }
  std::size_t twists_begin() const { return twists_begin_; }
  std::size_t internal_begin() const { return internal_begin_; }

 private:
  struct ElasticStep {  // over an elastic joint, in order outwards from the reduction link
    int elastic, from, to;
    double by_angle, by_twist;  // φ_to by φ_from and θ
  };
  void list_elastic_tree();
  void look_at(double t, std::span<const double> y, Instant& now);
  void evaluate(double t, std::span<const double> y, double* twist_rate, double* alpha, double* work_rate,
                double* internal_rate = nullptr);
  void keep(double t, std::span<const double> y);
  void settle_reactions(double t, double* alpha);
  void let_follow(double t, const double* alpha, double* internal_rate);
  void find_joint_torques();  // from alpha_, of all shafts
  JointTorques::Given given_torques() const;
  void write_quadratures(double* rate);

  std::shared_ptr<const Model> model_;
  Modes modes_;
  Ties ties_;
  ReactionBalance reactions_;
  JointTorques joint_torques_;
  bool plain_ = false;  // no contact, no relation, no reaction: ω̇ = M/I
  std::size_t twists_begin_, speeds_begin_, internal_begin_, states_, quadratures_ = 0;
  std::vector<int> directional_;  // shafts with elements opposing motion
  std::vector<int> variable_;     // shafts with mechanisms
  std::vector<double> constant_inertia_, inverse_inertia_;
  std::vector<ElasticStep> elastic_steps_;
  std::vector<std::size_t> root_angles_;       // tracked angles from which the others follow, one per elastic tree
  std::vector<const ElementPool*> following_;  // pools with additional degrees of freedom

  // working arrays
  std::vector<double> speed_, torque_, inertia_, free_torque_, twist_rate_, alpha_, internal_rate_, work_rate_;
  std::vector<double> connection_torque_, turning_torque_, spring_torque_, element_torque_, element_inertia_;
  std::vector<double> node_angle_, shaft_angle_, followed_alpha_, command_value_, slot_;
  std::vector<JointTorques::Held> held_shafts_;
  Snapshot snapshot_{};
  std::optional<Jam> jam_;
  bool kept_ = false;  // the working arrays are those of this state
  double kept_t_ = 0;
  std::vector<double> kept_y_;
  SparsityPattern pattern_;  // that of the model, with the empty diagonal of the quadratures appended
};

}  // namespace kurbel
