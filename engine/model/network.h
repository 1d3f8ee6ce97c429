// network.h — the machine before merging: every shaft end a node, every connection a joint, every element on its node.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <type_traits>
#include <typeindex>
#include <vector>

#include "engine/elements/connection_pool.h"
#include "engine/elements/shaft_pool.h"

namespace kurbel {

// The pools of a model, one per type of element, made when its first element comes.
class PoolSet {
 public:
  template <class Pool>
  Pool& of() {
    std::unique_ptr<ElementPool>*& known = by_type_[std::type_index(typeid(Pool))];
    if (!known) {
      pools_.push_back(std::make_unique<std::unique_ptr<ElementPool>>(std::make_unique<Pool>()));
      known = pools_.back().get();
    }
    return static_cast<Pool&>(**known);
  }
  std::vector<std::unique_ptr<ElementPool>> release();

 private:
  std::map<std::type_index, std::unique_ptr<ElementPool>*> by_type_;
  std::vector<std::unique_ptr<std::unique_ptr<ElementPool>>> pools_;  // in the order of first use
};

struct Effects;

// Lists what an element says about its own states.
template <class E>
std::vector<OwnState> own_states_of(const E& element) {
  std::vector<OwnState> states;
  if constexpr (HasStates<E>)
    for (int k = 0; k < E::states; ++k) states.push_back(element.state(k));
  return states;
}

// A connection between two shafts, waiting to be placed into its pool: elastic, or slipping.
class ConnectionMaker {
 public:
  virtual ~ConnectionMaker() = default;
  virtual void settle(double inertia) = 0;
  virtual double stiffness() const = 0;
  virtual double damping() const = 0;
  virtual double twist_at(double torque) const = 0;
  virtual double torque(double twist, double rate) const = 0;
  // dτ/dt from θ̇ and θ̈, where the torque hangs on the twist alone.
  virtual bool knows_torque_rate() const { return true; }
  virtual double torque_rate(double twist, double rate, double acceleration) const = 0;
  virtual bool slips() const { return false; }       // no spring: a clutch, never merged by effects
  virtual bool springless() const { return false; }  // no spring and no sticking: a viscous film; never merged, either
  virtual double capacity() const { return 0; }      // of one that slips [N·m]
  virtual bool has_modes() const { return false; }
  virtual bool commanded() const { return false; }
  virtual bool uses_angle() const { return false; }
  // Unloaded at an angle of a: the twist, and ratio · ω_b/ω_a.
  virtual double rest_twist(double /*turn*/) const { return 0; }
  virtual double rest_ratio(double /*turn*/) const { return 1; }
  virtual std::vector<OwnState> own_states() const { return {}; }
  // The element with these effects on; null where they change nothing.
  virtual std::shared_ptr<ConnectionMaker> with(const Effects&) const { return nullptr; }
  virtual std::string describe() const { return {}; }  // for people: the law it follows
  virtual void place(PoolSet& pools, const ConnectionPorts& ports, const ConnectionExtras& extras) const = 0;
};

// From an element that is final, or from a specification that becomes one when the inertias are known (`settled`).
template <class E, class Specification = E>
class ConnectionMakerOf final : public ConnectionMaker {
 public:
  explicit ConnectionMakerOf(Specification given) : given_(std::move(given)) {
    if constexpr (std::is_same_v<E, Specification>) element_ = given_;
  }
  void settle(double inertia) override {
    if constexpr (!std::is_same_v<E, Specification>) element_ = given_.settled(inertia);
  }
  double stiffness() const override {
    if constexpr (Slipping<E> || Springless<E>)
      return 0;
    else
      return element_.stiffness_at_rest();
  }
  double damping() const override {
    if constexpr (Slipping<E> || HasStates<E>)
      return 0;
    else
      return element_.torque(moving(Twist<double>{}, Dual<1>(0.0), Dual<1>::input(0.0, 0))).d[0];
  }
  double twist_at(double torque) const override {
    if constexpr (Slipping<E> || Springless<E>)
      return 0;
    else
      return element_.twist_at(torque);
  }
  double torque(double twist, double rate) const override {
    if constexpr (Slipping<E> || HasStates<E>) {
      return 0;
    } else {
      Twist<double> x{twist, rate};
      if constexpr (Guarded<E>) x.mode = element_.first_mode(x);
      return element_.torque(x);
    }
  }
  bool knows_torque_rate() const override {
    return !Slipping<E> && !HasStates<E> && !UsesAngle<E> && !UsesSpeeds<E> && !Commanded<E>;
  }
  double torque_rate(double twist, double rate, double acceleration) const override {
    if constexpr (Slipping<E> || HasStates<E>) {
      return 0;
    } else {
      Dual<1> angle(twist), speed(rate);
      angle.d[0] = rate;
      speed.d[0] = acceleration;
      return element_.torque(moving(Twist<double>{twist, rate}, angle, speed)).d[0];
    }
  }
  bool slips() const override { return Slipping<E>; }
  bool springless() const override { return Springless<E>; }
  double capacity() const override {
    if constexpr (Slipping<E>)
      return element_.capacity();
    else
      return 0;
  }
  bool has_modes() const override { return Guarded<E>; }
  bool commanded() const override { return Commanded<E>; }
  bool uses_angle() const override { return UsesAngle<E>; }
  double rest_twist([[maybe_unused]] double turn) const override {
    if constexpr (requires { element_.rest_twist(turn); }) return element_.rest_twist(turn);
    return 0;
  }
  double rest_ratio([[maybe_unused]] double turn) const override {
    if constexpr (requires { element_.rest_ratio(turn); }) return element_.rest_ratio(turn);
    return 1;
  }
  std::vector<OwnState> own_states() const override { return own_states_of(element_); }
  std::shared_ptr<ConnectionMaker> with(const Effects& effects) const override {
    if constexpr (requires { given_.with(effects); })
      return given_.with(effects);
    else
      return nullptr;
  }
  std::string describe() const override {
    if constexpr (requires { element_.describe(); })
      return element_.describe();
    else
      return {};
  }
  void place(PoolSet& pools, const ConnectionPorts& ports, const ConnectionExtras& extras) const override {
    pools.of<ConnectionPool<E>>().place(element_, ports, extras);
  }

 private:
  Twist<Dual<1>> moving(const Twist<double>& x, Dual<1> angle, Dual<1> rate) const {
    Twist<Dual<1>> y{angle, rate};
    if constexpr (Guarded<E>) y.mode = element_.first_mode(x);
    return y;
  }

  Specification given_;
  E element_;
};

// An element on a shaft, waiting to be placed. Mechanisms have makers of their own.
class ShaftElementMaker {
 public:
  virtual ~ShaftElementMaker() = default;
  virtual bool uses_angle() const { return false; }
  virtual bool directional() const { return false; }
  virtual Rated rated() const { return {}; }
  virtual Account account() const = 0;
  virtual double mean_inertia() const { return 0; }   // of a mechanism, on its own shaft
  virtual double least_inertia() const { return 0; }  // over a turn
  virtual double cycle() const { return 0; }          // angle of one cycle of a mechanism [rad]
  // I_r and I_r′ of a mechanism at an angle of its own (phase added) [rad], on its own shaft [kg·m²], [kg·m²/rad].
  struct InertiaAt {
    double value = 0, slope = 0;
  };
  virtual InertiaAt inertia_at(double /*angle*/) const { return {}; }
  // Its torque repeats after this angle of its own shaft [rad].
  virtual double angle_period() const { return 2 * std::numbers::pi; }
  // What its torque depends on besides the angle; a maker that does not say counts as depending on everything.
  virtual bool uses_time() const { return true; }
  virtual bool uses_speed() const { return true; }
  // Time after which its law repeats [s]; 0: none.
  virtual double time_period() const { return 0; }
  // A law over time without a period holds still from here on [s].
  virtual double settled_from() const { return -HUGE_VAL; }
  virtual int mode_count() const { return 1; }
  virtual bool commanded() const { return false; }
  virtual bool opens_at_zero() const { return false; }  // told 0 it is off
  virtual bool reversible() const { return false; }     // may be told less than 0
  virtual std::vector<OwnState> own_states() const { return {}; }
  // The element with these effects on; null where they change nothing.
  virtual std::shared_ptr<ShaftElementMaker> with(const Effects&) const { return nullptr; }
  virtual std::string describe() const { return {}; }  // for people: where its numbers come from
  // Work accounts beyond the element's own ("press.load"); the pool uses the indices that follow.
  virtual std::vector<std::pair<std::string, Account>> further_accounts() const { return {}; }
  virtual void place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel& label) const = 0;
};

template <class E>
class ShaftElementMakerOf final : public ShaftElementMaker {
 public:
  explicit ShaftElementMakerOf(E element) : element_(std::move(element)) {}
  bool uses_angle() const override { return UsesAngle<E>; }
  bool directional() const override { return Directional<E>; }
  Rated rated() const override { return element_.rated(); }
  bool uses_time() const override { return Timed<E> || depends_on_time(element_); }
  bool uses_speed() const override { return depends_on_speed(element_); }
  double angle_period() const override {
    if constexpr (requires { element_.angle_period(); })
      return element_.angle_period();
    else
      return 2 * std::numbers::pi;
  }
  Account account() const override {
    if constexpr (requires { element_.work_account; })
      return element_.work_account;
    else
      return E::account;
  }
  double time_period() const override {
    if constexpr (requires { element_.time_period(); }) return element_.time_period();
    return 0;
  }
  double settled_from() const override {
    if constexpr (requires { element_.settled_from(); }) return element_.settled_from();
    return -HUGE_VAL;
  }
  bool commanded() const override { return Commanded<E>; }
  bool opens_at_zero() const override {
    if constexpr (requires { element_.opens_at_zero(); }) return element_.opens_at_zero();
    return false;
  }
  bool reversible() const override { return Reversible<E>; }
  std::vector<OwnState> own_states() const override { return own_states_of(element_); }
  std::shared_ptr<ShaftElementMaker> with(const Effects& effects) const override {
    if constexpr (requires { element_.with(effects); })
      return element_.with(effects);
    else
      return nullptr;
  }
  std::string describe() const override {
    if constexpr (requires { element_.describe(); })
      return element_.describe();
    else
      return {};
  }
  void place(PoolSet& pools, const ShaftPorts& ports, const ShaftElementLabel& label) const override {
    pools.of<ShaftPool<E>>().place(element_, ports, label);
  }

 private:
  E element_;
};

// A speed that is given as a function of time.
struct PrescribedSpeed {
  std::vector<double> time, speed;                 // straight between the points; constant before and after [s, rad/s]
  double amplitude = 0, frequency = 0, phase = 0;  // + amplitude sin(2π f t + phase) [rad/s, Hz, rad]
  // The piece in force is a mode: within a step the law goes on smoothly beyond its end.
  int piece(double t) const;
  double value(double t, int piece) const;
  double slope(double t, int piece) const;  // dω/dt
  double next_edge(double t) const;
  bool is_nothing() const;
};

// What a gear loses: a torque L on its driving side against its motion, proportional to the torque λ that it takes up
// there, L = slope λ + offset, by the sense of motion and the sign of λ. At standstill anything between holds.
struct GearLoss {
  struct Line {
    double slope = 0, offset = 0;  // 1, [N·m]
  };
  Line forwards_driving, forwards_driven;    // moving forwards with λ > 0 (power flows a → b), λ < 0
  Line backwards_driven, backwards_driving;  // moving backwards with λ > 0, λ < 0
  const Line& line(int direction, int sign) const {
    if (direction > 0) return sign > 0 ? forwards_driving : forwards_driven;
    return sign > 0 ? backwards_driven : backwards_driving;
  }
};

class Network {
 public:
  struct Node {
    std::string component, label;
    double inertia = 0;  // [kg·m²]
    int prescribed = -1;
  };
  // φ_a = ratio φ_b, plus the twist where the joint is elastic.
  struct Joint {
    int a = 0, b = 0;
    double ratio = 1;
    std::string component;
    std::shared_ptr<ConnectionMaker> element = nullptr;  // null: always rigid
    bool elastic = false;                                // by the effects that are on
    std::string label = {};                              // tells several joints of a component apart
  };
  struct ShaftElement {
    int node = 0;
    std::string component;
    std::shared_ptr<ShaftElementMaker> element;
    Window window;
    double phase = 0;
    int account = -1;  // of the work it does, once compiled
  };
  // A relation between the speeds of two or three shafts that holds at run time: ω₀ + gain₁ ω₁ + gain₂ ω₂ = 0.
  // Planetary gear, differential, gear in a housing that moves, gear with losses. The torque λ that it takes from
  // node 0 comes out at the others, −gain λ.
  struct Relation {
    std::array<int, 3> node{-1, -1, -1};
    std::array<double, 3> gain{1, 0, 0};
    std::array<double, 3> usual{1, 1, 0};  // speeds in the usual motion of the machine; they obey the relation
    std::string component;
    bool lossy = false;
    GearLoss loss = {};
    std::string words = {};         // for people: its law of losses
    std::size_t joints_before = 0;  // its place among the joints, where it becomes one
    int members() const { return node[2] >= 0 ? 3 : 2; }
  };
  struct Ports {
    int in = -1, out = -1;
    std::map<std::string, int> others = {};  // further shafts, by name
  };

  int add_node(const std::string& component, const std::string& label, double inertia);
  void join(int a, int b, double ratio, const std::string& component);
  void relate(Relation relation) {
    relation.joints_before = joints.size();
    relations.push_back(std::move(relation));
  }
  template <class E>
  void connect(int a, int b, double ratio, const std::string& component, E element, const std::string& label = {}) {
    if constexpr (requires { typename E::Element; }) {
      joints.push_back({a, b, ratio, component,
                        std::make_shared<ConnectionMakerOf<typename E::Element, E>>(std::move(element)), false, label});
    } else {
      joints.push_back(
          {a, b, ratio, component, std::make_shared<ConnectionMakerOf<E>>(std::move(element)), false, label});
    }
  }
  template <class E>
  void put(int node, const std::string& component, E element, Window window = {}) {
    put_made(node, component, std::make_shared<ShaftElementMakerOf<E>>(std::move(element)), window, 0);
  }
  void put_made(int node, const std::string& component, std::shared_ptr<ShaftElementMaker> maker, Window window,
                double phase);
  void prescribe(int node, PrescribedSpeed speed);

  std::vector<Node> nodes;
  std::vector<Joint> joints;
  std::vector<Relation> relations;
  std::vector<ShaftElement> elements;
  std::vector<PrescribedSpeed> prescribed;
  std::map<std::string, Ports> ports;   // of each component
  std::vector<std::string> components;  // canonical order
};

}  // namespace kurbel
