// equations.h — the equations of motion of a compiled model, and the modes that hold between events.
//
// State: [ angles φ | twists θ | speeds ω | the elements' own states | quadratures ].
//   φ̇ = gain ω,   θ̇ = gain_a ω_a − gain_b ω_b,   I(φ) ω̇ = Σ torques − ½ I′ ω²        (theory 2.4, 5.2)
// While a contact is stuck (a locked clutch, a held shaft) its speeds are tied: one degree of freedom less, and the
// torque that it transmits is found with the accelerations (constraints.h). Which contacts are stuck is a mode.
// Twists are states of their own: a twist of 1e-4 rad keeps its digits when the machine has turned 1e6 rad.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/equations/constraints.h"
#include "engine/equations/event.h"
#include "engine/equations/jam.h"
#include "engine/equations/joint_torques.h"
#include "engine/model/model.h"
#include "engine/equations/operating_sequence.h"
#include "engine/equations/state.h"
#include "engine/steppers/stepper.h"

namespace kurbel {

// Two sides that stick together or slip: a shaft against the frame with all that brakes it, the sides of a clutch, a
// gear against its own losses.
struct Contact {
  enum class Kind { frame, connection, loss };
  Kind kind = Kind::frame;
  int index = 0;                  // shaft, elastic joint, relation
  std::vector<ShaftGain> motion;  // speed of slip v = Σ gain ω
  std::vector<ShaftGain> torque;  // what one unit of its torque λ, which opposes v > 0, does to the shafts
  double speed_scale = 1, torque_scale = 1;
  std::string name;
};

class Equations final : public OdeSystem {
 public:
  // With an audit the work of every account and the squares of the torques are integrated along.
  Equations(std::shared_ptr<const Model> model, bool audit);
  Equations(Equations&&) = default;

  // OdeSystem
  std::size_t size() const override { return states_ + quadratures_; }
  void flow(double t, std::span<const double> y, std::span<double> ydot) override;
  const SparsityPattern& jacobian_pattern() override;
  void jacobian(double t, std::span<const double> y, std::span<double> values) override;

  const Model& model() const { return *model_; }
  std::shared_ptr<const Model> shared_model() const { return model_; }
  bool audit() const { return quadratures_ > 0; }
  std::size_t integral_count() const { return quadratures_; }  // of the audit, behind the states in y
  // Scales of all states: speeds by rated speed, twists by rated torque over stiffness, angles by 1 rad.
  ErrorControl error_control(double tolerance) const;
  std::string state_name(std::size_t state) const;

  // State at the start as the scene demands it; sets all modes.
  std::vector<double> start(double t) { return start(t, model_->scene.run.start); }
  std::vector<double> start(double t, const StartSettings& settings);

  // The state with the reduction link at an angle, and these twists and speeds of the free shafts; the other angles
  // follow. Sets all modes anew, turns to none.
  std::vector<double> state_of(double t, double link_angle, std::span<const double> twists,
                               std::span<const double> speeds);
  // ∂φ/∂θ per shaft: how the shafts turn with one elastic joint's twist while the reduction link stands.
  std::vector<double> shaft_angles_by_twist(std::size_t elastic) const;

  // A state of the rigid machine with all modes found anew, for integrators that know no events.
  std::vector<double> modes_from_scratch(double t, double reduction_angle, double reduction_speed);

  // The pieces of laws that hold in this state; senses of motion stay.
  void modes_at(double t, std::span<const double> y);

  // --- the modes, which with (t, y) are the whole state ---
  const Modes& modes() const { return modes_; }
  // From now on it computes with these, which must be of this machine; the rows of what is tied are made anew.
  void bind(const Modes& modes);

  // --- events ---
  std::size_t guard_count() const { return guard_count_; }
  void guards(double t, std::span<const double> y, std::span<double> g);
  // Changes the modes whose guards fired (y may be set exactly onto the event). Appends to `log`.
  void fire(double t, std::span<double> y, const std::vector<std::size_t>& fired, std::vector<Event>& log);
  double next_edge(double t) const;
  void pass_edge(double t, std::span<double> y, std::vector<Event>& log);
  bool at_standstill(std::size_t shaft) const { return modes_.direction[shaft] == 0; }
  // Gives whatever owns these guards a law without events, for good. What changed, in words; empty: nothing can.
  std::string regularise(const std::vector<std::size_t>& guards);
  std::string guard_owner(std::size_t guard) const;
  // Where flow() met states at which no acceleration satisfies the friction, its rates are no numbers, and this is the
  // last of them.
  const std::optional<Jam>& jam() const { return jam_; }
  void forget_jam() { jam_.reset(); }
  // The motion cannot go on: what slips at these guards, or jammed last, comes to rest at once by an impact that takes
  // the least kinetic energy; what springs tie to it keeps its speed, the energy lost is work of the friction
  // concerned. False: nothing there moves.
  bool stop_jam(double t, std::span<double> y, const std::vector<std::size_t>& guards, std::vector<Event>& log);
  // Each contact that holds: by whom, what acts, what is held, and what is missing to move either way.
  std::vector<std::string> held(double t, std::span<const double> y);

  // --- angles ---
  // Angles are kept from 4π · first on (usually 0): a run that confirms another one looks up every law elsewhere.
  void keep_angles_from(double first) { modes_.first_two_turns = first; }
  // Takes whole multiples of two turns out of the angles; true if any changed.
  bool wrap(std::span<double> y);
  bool needs_wrap(std::span<const double> y) const;
  double angle_with_turns(std::size_t tracked, std::span<const double> y) const;

  // --- one shaft ---
  // Σ torques without −½ I′ω² being taken out [N·m], and inertia [kg·m²] of a shaft: ω̇ = torque/inertia. Powers per
  // account [W] where a place for them is given.
  struct ShaftBalance {
    double torque = 0, inertia = 0;
  };
  ShaftBalance shaft_balance(std::size_t shaft, double t, std::span<const double> y, double* work_rate = nullptr);

  // --- outputs ---
  const Snapshot& snapshot(double t, std::span<const double> y);
  double kinetic_energy(double t, std::span<const double> y);
  // The same from the mechanisms' bodies rather than from their reduced inertia; slow.
  double kinetic_energy_of_bodies(double t, std::span<const double> y);
  double stored_energy(double t, std::span<const double> y);
  std::size_t work_index(std::size_t account) const { return states_ + account; }
  // ∫τ² dt of the transmitted and of the spring torque of a torque joint.
  std::size_t square_index(std::size_t torque_joint, bool spring) const {
    return states_ + model_->accounts.size() + 2 * torque_joint + (spring ? 1 : 0);
  }
  std::size_t speed_index(int shaft) const {
    return twists_begin() + model_->twist_count() + static_cast<std::size_t>(shaft);
  }
  std::size_t twist_index(int elastic) const { return twists_begin() + static_cast<std::size_t>(elastic); }

 private:
  struct ElasticStep {  // an elastic joint, walked outwards from the reduction link
    int elastic;
    bool forward;
  };
  std::size_t twists_begin() const { return model_->angle_count(); }
  Instant instant(double t, std::span<const double> y);
  void look_at(double t, std::span<const double> y, Instant& now);
  double prescribed_speed(std::size_t shaft, double t) const;
  double prescribed_acceleration(std::size_t shaft, double t) const;
  void set_timed_modes(double t);
  std::size_t contact_guards_begin() const {
    return guard_count_ - 2 * contacts_.size() - lossy_.size() - (sequence_.any() ? 1 : 0);
  }
  std::size_t own_begin() const { return twists_begin() + model_->twist_count() + model_->free_shafts; }
  void evaluate(double t, std::span<const double> y, double* twist_rate, double* alpha, double* work_rate,
                double* own_rate = nullptr);
  void settle_reactions(double t, double* alpha, double* work_rate);
  void let_follow(double t, const double* alpha, double* own_rate);
  void refuse_impossible_slip(double t, std::span<const double> y);
  void members_follow(std::span<double> y, std::vector<char> given, double t);
  void find_joint_torques(const double* alpha);
  void write_quadratures(double* rate);
  void list_elastic_tree();
  // contacts (equations_contacts.cpp)
  void list_contacts();
  template <class SomeModes>
  static auto& sense_in(SomeModes& modes, const Contact& contact) {
    const auto index = static_cast<std::size_t>(contact.index);
    if (contact.kind == Contact::Kind::frame) return modes.direction[index];
    return contact.kind == Contact::Kind::connection ? modes.slip[index] : modes.loss_direction[index];
  }
  int& sense(std::size_t contact) { return sense_in(modes_, contacts_[contact]); }
  int sense(std::size_t contact) const { return sense_in(modes_, contacts_[contact]); }
  double slip_speed(const Contact& contact, const Instant& now) const;
  void tie_stuck_contacts();
  double capacity(std::size_t contact) const;
  void find_capacities();
  bool makes_a_row(std::size_t contact) const;
  bool follow_what_is_carried();
  void add_known_contact_torques();
  void find_accelerations(double t, std::span<const double> torque, std::span<const double> inertia, double* alpha);
  void refuse_broken_ties(double t) const;
  const std::string& name_of_row(std::size_t row) const;
  int relation_that_locks() const;
  void publish_contacts(double* work_rate);
  void look_at_losses(double t, std::span<const double> y);
  void find_holds();
  Hold limits(std::size_t contact) const;
  double regularised_torque(std::size_t contact, const Instant& now, double* slope = nullptr) const;
  double flank_margin(std::size_t relation) const;
  struct Misfit {
    double size = 0;
    std::size_t contact = 0;  // or relation + contacts_.size()
    int better = 0;
  };
  Misfit worst_misfit(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                      double* total = nullptr);
  void settle_contacts(double t, std::span<double> y, const std::vector<std::size_t>& stopped,
                       const std::vector<std::pair<std::size_t, int>>& forced, std::vector<Event>* log);
  bool try_all_modes(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                     const std::vector<std::size_t>& fixed);
  bool release_otherwise(double t, std::span<const double> y, const std::vector<std::size_t>& among,
                         const std::vector<std::pair<std::size_t, int>>& forced);
  int account_of_friction(const Contact& contact) const;
  std::string holders(const Contact& contact) const;
  void tie_speeds(double t, std::span<double> y);
  std::string sharing(const Contact& contact);
  void log_contacts(double t, const std::vector<std::size_t>& among, const std::vector<int>& before,
                    const std::vector<std::size_t>& always, std::vector<Event>& log);
  void contact_guards(double t, std::span<const double> y, double* g);
  bool is_prescribed(const Contact& contact) const;
  double effective_inertia(const Contact& contact);
  void mix_coupled_rows(std::span<double> values);
  void take_steps(double t, std::span<double> y, std::vector<Event>* log);
  void tell_switched(double t, std::span<double> y, const std::vector<char>& before);

  void settle_modes(double t, std::span<double> y, bool equilibrium);
  void balance_twists(std::span<double> y, double t);
  std::vector<double> balanced_joints(std::vector<double> need) const;
  void set_shaft_angles(const double* twists, std::vector<double>& angles) const;

  std::shared_ptr<const Model> model_;
  std::size_t states_ = 0, quadratures_ = 0, guard_count_ = 0;
  std::vector<std::size_t> guard_begin_;  // per pool
  std::vector<int> directional_;          // shafts that carry elements opposing motion
  std::vector<double> constant_inertia_, inverse_inertia_, inertia_;
  std::vector<int> variable_;
  std::vector<ElasticStep> elastic_steps_;
  std::vector<std::size_t> root_angles_;  // tracked angles that the others follow from, one per elastic tree

  Modes modes_;  // hold between events

  std::vector<Contact> contacts_;  // shafts against the frame first
  Constraints constraints_;
  std::vector<std::size_t> row_contact_;      // contact of each constraint row; relations stand before them
  std::vector<int> lossy_;                    // relations with losses
  std::vector<std::size_t> contact_of_loss_;  // per relation
  std::vector<char> still_;                   // per shaft: tied to the frame
  std::vector<char> coupled_;                 // per shaft: its row mixes with others
  bool tied_ = false;                         // constraints beyond single shafts at standstill
  bool smooth_ = false;                       // some contact is regularised
  std::vector<double> contact_torque_, relation_torque_, multiplier_, all_alpha_;
  std::vector<double> relation_loss_;
  std::vector<double> free_torque_;  // on the shafts, without what contacts and relations transmit
  std::vector<Hold> slip_hold_;

  std::vector<double> command_value_;

  // working arrays
  std::vector<double> speed_, torque_, twist_rate_, alpha_, connection_torque_, spring_torque_, own_rate_;
  std::vector<double> element_torque_, element_inertia_, node_angle_, work_rate_, shaft_angle_;
  std::vector<Hold> shaft_hold_, element_hold_;
  // torques that depend on the accelerations; empty where no element reacts
  std::vector<const ElementPool*> reacting_;
  std::vector<std::unique_ptr<ElementPool::Memory>> reaction_memory_;
  std::vector<double> reaction_alpha_, reaction_torque_, reaction_slope_, reaction_element_;
  std::vector<double> reaction_effective_torque_, reaction_effective_inertia_, reaction_next_;
  // further degrees of freedom of elements; empty where there are none
  std::vector<const ElementPool*> following_;
  std::vector<double> followed_alpha_;
  OperatingSequence sequence_;
  JointTorques joint_torques_;
  std::vector<JointTorques::Held> held_shafts_;
  Snapshot snapshot_{};
  std::optional<Jam> jam_;

  // Jacobian: the model's layout with the quadratures' empty diagonal appended
  SparsityPattern pattern_;
  std::vector<double> slot_;
};

}  // namespace kurbel
