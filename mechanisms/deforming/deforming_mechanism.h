// deforming_mechanism.h — a slider-crank with clearance in joints or a flexible rod as an element: its additional degrees
// of freedom are internal states coupled to the crank by inertia (equations: slider_crank_dynamics.h).
//     (m₁₁ − m₁₂ m₂₂⁻¹ m₂₁) α = Q₁ − m₁₂ m₂₂⁻¹ Q₂        effective inertia and torque on the crank's shaft
//     q̈ = m₂₂⁻¹ (Q₂ − m₂₁ α)                            from its acceleration α
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "mechanisms/deforming/slider_crank_dynamics.h"
#include "mechanisms/reduced/mechanism.h"

namespace kurbel {

// Clearances and flexibility of a slider-crank.
struct Deformation final : DeformingParts {
  std::vector<JointClearance> clearances;
  std::optional<RodFlexibility> flexibility;

  std::shared_ptr<const DeformingParts> under(const Effects& effects) const override;
  ShaftForm form(Mechanism mechanism) const override;
};
// Those of a mechanism; none: empty.
const Deformation& deformation_of(const Mechanism& mechanism);

class DeformingMechanismElement final : public MechanismElement {
 public:
  // Throws std::invalid_argument for data that cannot be combined with clearance or flexibility.
  explicit DeformingMechanismElement(Mechanism mechanism);

  bool deforms() const override { return true; }
  const SliderCrankDynamics& dynamics() const { return *dynamics_; }

  std::string describe() const override;
  ShaftForm form_under(const Effects&) const override { return nullptr; }
  void place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel& label) const override;

 private:
  std::shared_ptr<const SliderCrankDynamics> dynamics_;
};

// The equations of a shaft's element; null: it is no mechanism that deforms.
const SliderCrankDynamics* dynamics_of(const Network::ShaftElement& element);

// Number of degrees of freedom of the mechanisms of a model in addition to their cranks.
std::size_t further_coordinates(const Model& model);

std::string joint_word(const JointClearance& joint);  // "crank_pin", for the names of states and channels

// Modes of each mechanism: sign of the slider's speed (or creeping), piece of each load, mode of each contact.
class DeformingMechanismPool final : public ElementPool {
 public:
  void place(Mechanism mechanism, std::shared_ptr<const SliderCrankDynamics> dynamics, const ShaftPorts& at);

  void add(const Instant& now, Sums& sums) const override;
  bool follows() const override { return true; }
  void follow(const Instant& now, const double* alpha, double* internal_rate) const override;
  void balance(const Instant& now, const double* alpha, double* own) const override;
  double further_kinetic_energy(const Instant& now) const override;
  double kinetic_energy_of_bodies(const Instant& now) const override;
  double energy(const Instant& now) const override;
  void register_jacobian(JacobianPattern& pattern) override;
  void add_jacobian(const Instant& now, const double* alpha, double* slots) const override;
  int guard_count() const override { return static_cast<int>(owners_.size()); }
  void guards(const Instant& now, double* g) const override;
  void fire(const Instant& now, int guard, int* mode) const override;
  GuardLabel label(int guard, const Instant& now) const override;
  void first_modes(const Instant& now, int* mode) const override;
  bool regularise(int guard, int* mode) const override;
  void first_states(const Instant& now, double* own) const override;
  void add_channels(std::vector<Channel>& channels) const override;

  void set_timed_modes(double t, int* mode, char* active) const override;

 private:
  using Motion = SliderCrankMotion<double>;
  using Vector = SliderCrankDynamics::Vector;
  struct Placed {
    Mechanism mechanism;
    std::shared_ptr<const SliderCrankDynamics> dynamics;
    ShaftPorts at;
    bool watches_travel = false;          // some load depends on the direction of travel
    std::vector<int> internal_slot = {};  // per free coordinate except φ, and input: of its acceleration
    std::vector<int> shaft_slot = {};     // per input
    std::vector<int> rate_slot = {}, follower_slot = {};

    std::size_t further() const { return dynamics->free().size() - 1; }
    std::size_t inputs() const { return 2 * dynamics->free().size(); }
    int contact_mode() const { return at.mode + 1 + static_cast<int>(mechanism.loads.size()); }
    int contact_account() const { return at.account + 1 + static_cast<int>(mechanism.loads.size()); }
    int rod_account() const { return contact_account() + (dynamics->clearances().empty() ? 0 : 1); }
  };
  struct GuardOwner {
    enum class Kind { travel, load, contact } kind;
    std::size_t placed;
    std::size_t index;  // of the load or contact
    int which;
  };
  struct Solved {
    double inertia, torque;  // effective, on the crank
    Vector free, by_alpha;   // accelerations of the additional coordinates at α = 0, and their decrease per α
  };
  // Indices of the k-th additional coordinate and of its rate among all internal states.
  static int at_internal(const Placed& p, std::size_t k) { return p.at.own + static_cast<int>(k); }
  static int at_rate(const Placed& p, std::size_t k) { return p.at.own + static_cast<int>(p.further() + k); }
  Vector coordinates(const Placed& p, const Instant& now) const;
  Vector rates(const Placed& p, const Instant& now) const;
  Motion motion(const Placed& p, const Instant& now) const;
  Vector acceleration(const Placed& p, const Snapshot& s) const;
  Vector reactions(const Placed& p, const Snapshot& s) const;
  template <class T>
  SliderState<T> slider(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m, std::size_t load) const;
  // A slider that chatters under loads that depend on its direction of travel creeps: the loads change over between the
  // directions as tanh(v/v₀), v₀ the creep speed, and return to their branches beyond a few v₀.
  static constexpr int creeps = 2;             // instead of ±1 as the direction of travel
  static double creep_speed(const Placed& p);  // [m/s]
  template <class T>
  T force_of(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m, std::size_t load) const;
  template <class T>
  T load_force(const Placed& p, const Instant& now, const SliderCrankMotion<T>& m) const;
  Solved solve(const Placed& p, const Instant& now, const Motion& m) const;
  void add_work(const Placed& p, const Instant& now, const Motion& m, double* work_rate) const;

  std::vector<Placed> placed_;
  std::vector<GuardOwner> owners_;
};

}  // namespace kurbel
