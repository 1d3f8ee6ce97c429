// flow.h — the equations of motion of a compiled model, under modes that hold: right-hand side, Jacobian, outputs.
//
// State: [ angles φ | twists θ | speeds ω | the elements' own states | quadratures ].
//   φ̇ = gain ω,   θ̇ = gain_a ω_a − gain_b ω_b,   I(φ) ω̇ = Σ torques − ½ I′ ω²        (theory 2.4, 5.2)
// While a contact is stuck (a locked clutch, a held shaft) its speeds are tied: one degree of freedom less, and the
// torque that it transmits is found with the accelerations (ties.h). Which contacts are stuck is a mode.
// Twists are states of their own: a twist of 1e-4 rad keeps its digits when the machine has turned 1e6 rad.
//
// A Flow is a const Model, modes that it is bound to, and working memory: every answer is one of (t, y, modes).
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
  // With an audit the work of every account, the squares of the torques, and the motors' torques are integrated along.
  Flow(std::shared_ptr<const Model> model, bool audit);
  Flow(const Flow&) = delete;
  Flow& operator=(const Flow&) = delete;

  // OdeSystem. Where flow() meets states at which no acceleration satisfies the friction, the rates are no numbers.
  std::size_t size() const final { return states_ + quadratures_; }
  void flow(double t, std::span<const double> y, std::span<double> ydot) final;
  const SparsityPattern& jacobian_pattern() final;
  void jacobian(double t, std::span<const double> y, std::span<double> values) final;

  const Model& model() const { return *model_; }
  std::shared_ptr<const Model> shared_model() const { return model_; }
  bool audit() const { return quadratures_ > 0; }

  // --- the modes, which with (t, y) are the whole state ---
  const Modes& modes() const { return modes_; }
  // From now on it computes with these, which must be of this machine. The rows of what is tied are made anew.
  void bind(const Modes& modes);

  // --- where things stand in y ---
  std::size_t integral_count() const { return quadratures_; }  // of the audit, behind the states in y
  std::size_t twist_index(int elastic) const { return twists_begin() + static_cast<std::size_t>(elastic); }
  std::size_t speed_index(int shaft) const {
    return twists_begin() + model_->twist_count() + static_cast<std::size_t>(shaft);
  }
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
  // All that can be asked of one instant; valid until the next question of any kind.
  const Snapshot& snapshot(double t, std::span<const double> y);
  double kinetic_energy(double t, std::span<const double> y);
  // The same from the mechanisms' bodies rather than from their reduced inertia; slow.
  double kinetic_energy_of_bodies(double t, std::span<const double> y);
  double stored_energy(double t, std::span<const double> y);
  // Σ torques without −½ I′ω² being taken out [N·m], and inertia [kg·m²] of a shaft: ω̇ = torque/inertia. Powers per
  // account [W] where a place for them is given.
  struct ShaftBalance {
    double torque = 0, inertia = 0;
  };
  ShaftBalance shaft_balance(std::size_t shaft, double t, std::span<const double> y, double* work_rate = nullptr);
  // ∂φ/∂θ per shaft: how the shafts turn with one elastic joint's twist while the reduction link stands.
  std::vector<double> shaft_angles_by_twist(std::size_t elastic) const;
  // Angles of all shafts from the twists, outwards from the shafts that lead, whose angles must be there.
  void set_shaft_angles(const double* twists, std::vector<double>& angles) const;

  // The free bodies (theory 5.18) of the last snapshot(): how far the torque of a joint by its one side and by its other
  // side part, at most, beside the torques that meet there; and on which shaft.
  JointTorques::Open open_bodies() const { return joint_torques_.open(given_torques()); }

  // The last state at which no acceleration satisfied the friction.
  const std::optional<Jam>& jam() const { return jam_; }
  void forget_jam() { jam_.reset(); }

  // --- for the parts that find modes: contacts, start, switching ---
  // To be changed in place; rows are as before until ties().make_rows().
  Modes& changing_modes() { return modes_; }
  Ties& ties() { return ties_; }
  const Ties& ties() const { return ties_; }
  // Where the machine is, as elements see it; valid until the next one.
  Instant instant(double t, std::span<const double> y);
  // The instant that ties and elements were looked at last, after look() or evaluate().
  const Instant& now() const { return snapshot_.now; }
  void look(double t, std::span<const double> y) { look_at(t, y, snapshot_.now); }
  void evaluate(double t, std::span<const double> y) { evaluate(t, y, twist_rate_.data(), alpha_.data(), nullptr); }
  // Of the last evaluate(): accelerations of all shafts, given ones too; inertias; torques on the shafts without what
  // ties transmit; torques and inertias of the elements.
  const std::vector<double>& accelerations();
  const std::vector<double>& inertia() const { return inertia_; }
  std::span<const double> effective_inertia() const {
    return reactions_.any() ? reactions_.effective_inertia() : std::span<const double>(inertia_);
  }
  const std::vector<double>& free_torque() const { return free_torque_; }
  const std::vector<double>& element_torque() const { return element_torque_; }
  const std::vector<double>& element_inertia() const { return element_inertia_; }
  // Further degrees of freedom at rest relative to their shafts, by the accelerations of the last evaluate().
  void balance_followers(double* own) const;
  bool has_followers() const { return !following_.empty(); }
  std::size_t state_count() const { return states_; }
  std::size_t twists_begin() const { return model_->angle_count(); }
  std::size_t own_begin() const { return twists_begin() + model_->twist_count() + model_->free_shafts; }

 private:
  struct ElasticStep {  // an elastic joint, walked outwards from the reduction link
    int elastic;
    bool forward;
  };
  void list_elastic_tree();
  void look_at(double t, std::span<const double> y, Instant& now);
  void evaluate(double t, std::span<const double> y, double* twist_rate, double* alpha, double* work_rate,
                double* own_rate = nullptr);
  void settle_reactions(double t, double* alpha);
  void let_follow(double t, const double* alpha, double* own_rate);
  void find_joint_torques();  // from alpha_, of all shafts
  JointTorques::Given given_torques() const;
  void write_quadratures(double* rate);

  std::shared_ptr<const Model> model_;
  Modes modes_;
  Ties ties_;
  ReactionBalance reactions_;
  JointTorques joint_torques_;
  bool plain_ = false;  // no contact, no relation, no reaction: ω̇ = M/I
  std::size_t states_ = 0, quadratures_ = 0;
  std::vector<int> directional_;  // shafts that carry elements opposing motion
  std::vector<int> variable_;     // shafts that carry mechanisms
  std::vector<double> constant_inertia_, inverse_inertia_;
  std::vector<ElasticStep> elastic_steps_;
  std::vector<std::size_t> root_angles_;       // tracked angles that the others follow from, one per elastic tree
  std::vector<const ElementPool*> following_;  // pools with further degrees of freedom

  // working arrays
  std::vector<double> speed_, torque_, inertia_, free_torque_, twist_rate_, alpha_, own_rate_, work_rate_;
  std::vector<double> connection_torque_, turning_torque_, spring_torque_, element_torque_, element_inertia_;
  std::vector<double> node_angle_, shaft_angle_, followed_alpha_, command_value_, slot_;
  std::vector<JointTorques::Held> held_shafts_;
  Snapshot snapshot_{};
  std::optional<Jam> jam_;
  SparsityPattern pattern_;  // the model's, with the quadratures' empty diagonal appended
};

}  // namespace kurbel
