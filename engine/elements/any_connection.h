// any_connection.h — type-erased connection of a network: the data that a model needs, computed once from its traits, and
// the laws that are evaluated outside its pool.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/elements/connection_pool.h"
#include "engine/elements/pool_set.h"
#include "engine/numerics/dual.h"

namespace kurbel {

struct SpringRow;

// Immutable; shared by networks that are compiled several times.
class AnyConnection {
 public:
  virtual ~AnyConnection() = default;

  // --- data; a specification has only `is`, the others once it is settled ---
  ConnectionTraits is;
  double stiffness = 0;            // at rest [N·m/rad]; 0 without a spring
  double damping = 0;              // dτ/dθ̇ at rest [N·m·s/rad]; 0 if it slips or has states
  double capacity = 0;             // of a slipping connection [N·m]
  bool knows_torque_rate = false;  // the torque depends only on twist and mode
  std::vector<InternalState> internal_states = {};
  std::shared_ptr<const SpringRow> row = {};  // of coupled springs in a row (coupled_springs.h), else null
  int row_part = 0;                           // index in the row

  // --- laws ---
  virtual double twist_at(double torque, double turn = 0) const = 0;                     // 0 without a spring
  virtual double torque_rate(double twist, double rate, double acceleration) const = 0;  // dτ/dt from θ̇ and θ̈
  virtual double rest_twist(double turn) const = 0;                                      // unloaded at φ_a,
  virtual double rest_ratio(double turn) const = 0;                                      // and i ω_b/ω_a
  virtual double rest_ratio_slope(double turn) const = 0;                                // by φ_a
  virtual double share_of_a(double torque, double turn) const = 0;                       // torque on a over τ, at rest
  virtual std::string describe() const = 0;                                              // may be empty
  virtual ConnectionForm settled(double inertia) const = 0;                              // J_red [kg·m²]
  virtual bool damping_hangs_on_inertia() const = 0;            // of a specification: settled(0) would lack the damping
  virtual ConnectionForm form_under(const Effects&) const = 0;  // null: this one
  virtual void place(PoolSet&, const ConnectionPorts&, const ConnectionExtras&) const = 0;
};

// List of the internal states of an element.
template <class E>
std::vector<InternalState> internal_states_of(const E& element) {
  std::vector<InternalState> states;
  if constexpr (E::is.states > 0)
    for (int k = 0; k < E::is.states; ++k) states.push_back(element.state(k));
  return states;
}

// For a final element, or a specification that becomes one when the inertias are known.
template <class E, class Given = E>
class ConnectionOf final : public AnyConnection {
  static_assert(demand_valid_connection<E>());

 public:
  explicit ConnectionOf(Given given) : given_(std::move(given)) {
    is = E::is;
    if constexpr (is_given) take(given_);
  }
  ConnectionOf(Given given, E settled) : given_(std::move(given)) {
    is = E::is;
    take(std::move(settled));
  }

  double twist_at([[maybe_unused]] double torque, [[maybe_unused]] double turn) const override {
    if constexpr (requires { element_.twist_at(torque, turn); })
      return element_.twist_at(torque, turn);
    else if constexpr (E::is.has_spring())
      return element_.twist_at(torque);
    else
      return 0;
  }
  double torque_rate([[maybe_unused]] double twist, [[maybe_unused]] double rate,
                     [[maybe_unused]] double acceleration) const override {
    if constexpr (Slipping<E> || HasStates<E>) {
      return 0;
    } else {
      Dual<1> angle(twist), speed(rate);
      angle.d[0] = rate;
      speed.d[0] = acceleration;
      return element_.torque(moving(Twist<double>{twist, rate}, angle, speed)).d[0];
    }
  }
  double rest_twist([[maybe_unused]] double turn) const override {
    if constexpr (E::is.turns_unevenly)
      return element_.rest_twist(turn);
    else
      return 0;
  }
  double rest_ratio([[maybe_unused]] double turn) const override {
    if constexpr (E::is.turns_unevenly)
      return element_.rest_ratio(turn);
    else
      return 1;
  }
  double rest_ratio_slope([[maybe_unused]] double turn) const override {
    if constexpr (E::is.turns_unevenly)
      return element_.rest_ratio_slope(turn);
    else
      return 0;
  }
  double share_of_a([[maybe_unused]] double torque, [[maybe_unused]] double turn) const override {
    if constexpr (E::is.uses_angle) {
      if (torque == 0) return rest_ratio(turn);
      Twist<double> x{.angle = rest_twist(turn) + twist_at(torque, turn), .turn = turn};
      if constexpr (Guarded<E>) x.mode = element_.first_mode(x);
      return 1 - element_.turning_torque(x) / torque;
    }
    return 1;
  }
  std::string describe() const override {
    if constexpr (E::is.described)
      return element_.describe();
    else
      return {};
  }
  ConnectionForm settled([[maybe_unused]] double inertia) const override {
    if constexpr (is_given)
      return nullptr;
    else
      return std::make_shared<ConnectionOf>(given_, given_.settled(inertia));
  }
  bool damping_hangs_on_inertia() const override {
    if constexpr (is_given)
      return false;
    else
      return given_.damping_hangs_on_inertia();
  }
  ConnectionForm form_under([[maybe_unused]] const Effects& effects) const override {
    if constexpr (has_other_forms)
      return under(given_, effects);
    else
      return nullptr;
  }
  void place(PoolSet& pools, const ConnectionPorts& ports, const ConnectionExtras& extras) const override {
    pools.of<ConnectionPool<E>>().place(element_, ports, extras);
  }

 private:
  static constexpr bool is_given = std::is_same_v<E, Given>;
  static constexpr bool has_other_forms = [] {
    if constexpr (is_given)
      return E::is.other_forms;
    else
      return demand_valid_specification<Given>() && requires { requires Given::other_forms; };
  }();

  void take(E element) {
    element_ = std::move(element);
    if constexpr (E::is.has_spring()) stiffness = element_.stiffness_at_rest();
    if constexpr (!E::is.slips && E::is.states == 0)
      damping = element_.torque(moving(Twist<double>{}, Dual<1>(0.0), Dual<1>::input(0.0, 0))).d[0];
    if constexpr (E::is.slips) capacity = element_.capacity();
    knows_torque_rate =
        !E::is.slips && E::is.states == 0 && !E::is.uses_angle && !E::is.uses_speeds && !E::is.commanded;
    internal_states = internal_states_of(element_);
  }
  Twist<Dual<1>> moving([[maybe_unused]] const Twist<double>& x, Dual<1> angle, Dual<1> rate) const {
    Twist<Dual<1>> y{angle, rate};
    if constexpr (Guarded<E>) y.mode = element_.first_mode(x);
    return y;
  }

  Given given_;
  E element_;
};

// From an element, or from a specification.
template <class G>
ConnectionForm connection_form(G given) {
  if constexpr (requires { typename G::Element; })
    return std::make_shared<ConnectionOf<typename G::Element, G>>(std::move(given));
  else
    return std::make_shared<ConnectionOf<G>>(std::move(given));
}

}  // namespace kurbel
