// ties.h — constraints of the present modes and their torques: stuck contacts, relations of gears with losses, contacts
// regularised because their events chattered.
//
//     stuck contact            a row G ω = 0; its torque is the multiplier λ              (constraints.h)
//     gear in motion           a row; the part L = slope λ + offset of its λ is lost
//     regularised contact      λ = limit · tanh(v/v₀): it creeps
//
// Torques and holds belong to the last evaluated state and carry no memory.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/elements/element_pool.h"
#include "engine/equations/constraints.h"
#include "engine/equations/contact.h"

namespace kurbel {

class Ties {
 public:
  // Both must outlive it; after a change of modes call make_rows() before any evaluation.
  Ties(const Model& model, const Modes& modes);

  bool any() const { return !contacts_.empty() || !model_.relations.empty(); }
  const std::vector<Contact>& contacts() const { return contacts_; }
  const std::vector<int>& lossy() const { return lossy_; }  // relations with losses
  std::size_t contact_of_loss(int relation) const { return contact_of_loss_[static_cast<std::size_t>(relation)]; }

  // --- rows ---
  // Makes the constraint rows of the present modes, and finds the shafts tied to the frame.
  void make_rows();
  bool makes_a_row(std::size_t contact) const;
  const std::vector<std::size_t>& contacts_in_rows() const { return row_contact_; }
  // G ω = 0: of relations, then of stuck contacts.
  const std::vector<ConstraintRow>& rows() const { return rows_; }
  // Some rows are redundant, by the last solution: they share by capacity.
  bool repeats() const { return tied_ && constraints_.repeats(); }
  bool shares() const { return row_contact_.size() > 1 && repeats(); }  // some of these may be contacts
  bool stands(std::size_t shaft) const { return still_[shaft]; }        // tied to the frame
  bool is_coupled(std::size_t shaft) const { return coupled_[shaft]; }  // its row of the Jacobian mixes with others
  // Makes tied speeds exactly consistent, with the least change of kinetic energy.
  void project(std::span<const double> inertia, std::span<double> speed);
  // Effective inertia for a torque of the contact, with all other ties [kg·m²].
  double effective_inertia(const Contact& contact, std::span<const double> inertia);

  // --- the stages of an evaluation ---
  // Adds torques that depend on the state only: constant parts of losses, and regularised contacts.
  void add_known(const Instant& now, double* torque);
  // Accelerations of the free shafts from inertia and torque, and the transmitted torques.
  void accelerate(double t, std::span<const double> torque, std::span<const double> inertia, double* alpha);
  // Adds the torques of contacts and relations to the shafts and connections, and their losses to the work.
  void publish(const Instant& now, Sums& sums);
  // Rows of tied shafts in the Jacobian: ∂α = W ∂(M − I α), W = mobility. To be called before the division by the inertia,
  // which is omitted for these rows.
  void mix_rows(const Instant& now, std::span<const double> inertia, std::span<double> values);

  // --- ranges of torque without slip ---
  // Finds the range of every contact at this state.
  void find_holds(const Instant& now);
  // Range of λ of a stuck contact [N·m].
  Hold limits(std::size_t contact) const;
  // Positive while the flank given by the mode is in contact; of order one.
  double flank_margin(std::size_t relation) const;
  // Weight of its share in redundant rows: its limit in this direction, 0: the larger one [N·m].
  double capacity(std::size_t contact, int way) const;
  const std::vector<Hold>& shaft_hold() const { return shaft_hold_; }
  const std::vector<Hold>& element_hold() const { return element_hold_; }

  // --- transmitted torques of the last evaluation ---
  double torque(std::size_t contact) const { return contact_torque_[contact]; }    // λ [N·m]
  const std::vector<double>& relation_torque() const { return relation_torque_; }  // per relation: λ [N·m]
  const std::vector<double>& relation_loss() const { return relation_loss_; }      // per relation: L [N·m]
  struct Torques {
    std::vector<double> contact, relation, loss;
  };
  Torques torques() const { return {contact_torque_, relation_torque_, relation_loss_}; }
  void set_torques(const Torques& known);
  void forget_torques();

  // The gear whose losses prevented the last solution for the accelerations; −1: none.
  int relation_that_locks() const;
  // Throws std::runtime_error with tie, time and reason if the ties are violated.
  void refuse_broken(double t) const;

  static constexpr double creep = 1e-4;         // v₀ of regularised contacts, over the speed scale: ¾ of the torque
  static constexpr double most_capacity = 1e3;  // of the torque scale: counts as unlimited
  static constexpr double least_capacity = 1e-12;  // of the torque scale, where several share

 private:
  void list_still_shafts(const std::vector<ConstraintRow>& rows);
  void write_relation_rows();
  void solve(std::span<const double> torque, std::span<const double> inertia);
  double weight(std::size_t contact, double capacity) const;
  double regularised_torque(std::size_t contact, const Instant& now, double* slope = nullptr) const;
  void publish_contact(std::size_t contact, const Instant& now, Sums& sums) const;
  void publish_relation(std::size_t relation, const Instant& now, Sums& sums);
  void add_regularised_slopes(const Instant& now, std::span<double> values) const;
  const std::string& name_of_row(std::size_t row) const;

  const Model& model_;
  const Modes& modes_;
  std::vector<Contact> contacts_;
  std::vector<int> lossy_;
  std::vector<std::size_t> contact_of_loss_;  // per relation
  std::vector<char> coupled_;                 // per shaft

  // by the modes
  Constraints constraints_;
  std::vector<ConstraintRow> rows_;       // of relations, then of stuck contacts
  std::vector<std::size_t> row_contact_;  // contact of each row after those of relations
  std::vector<char> still_;               // per shaft
  bool tied_ = false;                     // more ties than single shafts at standstill
  bool smooth_ = false;                   // some contact is regularised
  const Instant* now_ = nullptr;          // of this evaluation

  // of the last evaluated state
  std::vector<double> contact_torque_, relation_torque_, relation_loss_, multiplier_, all_alpha_, capacity_;
  std::vector<Hold> shaft_hold_, element_hold_, slip_hold_;
};

}  // namespace kurbel
