// any_shaft_element.h — type-erased shaft element of a network: the data that a model needs, computed once from its
// traits.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/elements/any_connection.h"
#include "engine/elements/pool_set.h"
#include "engine/elements/shaft_pool.h"

namespace kurbel {

// Immutable. Mechanisms have their own classes (mechanisms/reduced).
class AnyShaftElement {
 public:
  virtual ~AnyShaftElement() = default;

  // --- data ---
  ShaftTraits is;
  Account account = Account::harmful;  // of its own work
  Rated rated = {};
  bool uses_time = true, uses_speed = true;    // dependence of its torque
  double angle_period = 2 * std::numbers::pi;  // period of its torque over the angle of its own shaft [rad]
  double time_period = 0;                      // period of its law over time [s]; 0: not periodic
  double settled_from = -HUGE_VAL;  // time from which a law without period is constant, or time after switching on [s]
  bool opens_at_zero = false;       // command 0 switches it off
  std::vector<InternalState> internal_states = {};
  int modes = 1;                               // number of mode slots
  double mean_inertia = 0, least_inertia = 0;  // of a mechanism over a turn, on its own shaft [kg·m²]
  double cycle = 0;  // angle of a cycle of a mechanism [rad]; 0: no mechanism, ∞: its crank rocks
  // Work accounts in addition to its own ("press.load"); the pool uses the subsequent indices.
  std::vector<std::pair<std::string, Account>> further_accounts = {};

  // --- laws ---
  // I_r and I_r′ of a mechanism at an angle of its own (phase added) [rad], on its own shaft [kg·m²], [kg·m²/rad].
  struct InertiaAt {
    double value = 0, slope = 0;
  };
  virtual InertiaAt inertia_at(double /*angle*/) const { return {}; }
  virtual std::string describe() const = 0;                // may be empty
  virtual ShaftForm form_under(const Effects&) const = 0;  // null: this one
  virtual void place(PoolSet&, const ShaftPorts&, const ShaftElementLabel&) const = 0;
};

template <class E>
class ShaftElementOf final : public AnyShaftElement {
  static_assert(demand_valid_shaft_element<E>());

 public:
  explicit ShaftElementOf(E element) : element_(std::move(element)) {
    is = E::is;
    if constexpr (E::is.account.has_value())
      account = *E::is.account;
    else
      account = element_.work_account;
    rated = element_.rated();
    uses_time = element_.uses_time();
    uses_speed = element_.uses_speed();
    if constexpr (E::is.uses_angle) angle_period = element_.angle_period();
    if constexpr (E::is.periodic) time_period = element_.time_period();
    if constexpr (E::is.settles) settled_from = element_.settled_from();
    if constexpr (E::is.commanded) opens_at_zero = element_.opens_at_zero();
    internal_states = internal_states_of(element_);
  }
  std::string describe() const override {
    if constexpr (E::is.described)
      return element_.describe();
    else
      return {};
  }
  ShaftForm form_under([[maybe_unused]] const Effects& effects) const override {
    if constexpr (E::is.other_forms)
      return under(element_, effects);
    else
      return nullptr;
  }
  void place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel& label) const override {
    pools.of<ShaftPool<E>>().place(element_, ports, label);
  }

 private:
  E element_;
};

template <class E>
ShaftForm shaft_form(E element) {
  return std::make_shared<ShaftElementOf<E>>(std::move(element));
}

}  // namespace kurbel
