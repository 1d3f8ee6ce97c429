// element_pool.h — interface of a pool of elements to the equations: one loop behind one virtual call. Without elements
// there is no pool and no cost. Pools of connections and of shaft elements: connection_pool.h, shaft_pool.h.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/elements/element.h"
#include "engine/elements/event_kind.h"
#include "engine/elements/quantity.h"

namespace kurbel {

// State of the machine at an instant. The equations own the arrays.
struct Instant {
  double t = 0;
  const double* angle = nullptr;     // per tracked angle
  const double* twist = nullptr;     // per elastic connection
  const double* speed = nullptr;     // per shaft
  const int* mode = nullptr;         // per element
  const int* direction = nullptr;    // per shaft
  const char* active = nullptr;      // per element: within its window of time
  const int* slip = nullptr;         // per elastic connection: sign of the slip speed, 0 = stuck
  const double* command = nullptr;   // per command of the operating sequence
  const double* own = nullptr;       // internal states of the elements
  const double* on_since = nullptr;  // per element: time of the last switching on [s]
};

// Sums over the elements at that instant.
struct Sums {
  double* torque = nullptr;             // per shaft: sum of torques
  double* inertia = nullptr;            // per shaft: variable inertias are added to the constant ones
  double* twist_rate = nullptr;         // per elastic connection
  double* connection_torque = nullptr;  // per elastic connection: transmitted torque k θ + c θ̇
  double* spring_torque = nullptr;      // per elastic connection: spring torque k θ; only with work_rate
  double* element_torque = nullptr;     // per shaft element
  double* element_inertia = nullptr;    // per shaft element: its variable inertia
  double* work_rate = nullptr;          // per work account; null: not needed
  double* internal_rate = nullptr;      // per internal state: its derivative
  double* turning_torque = nullptr;     // per elastic connection that uses the angle: additional torque on a
};

// Registers the entries of a sparse Jacobian; column or row −1: not a state.
class JacobianPattern {
 public:
  virtual ~JacobianPattern() = default;
  virtual int entry(int row, int column) = 0;  // slot to add the derivative to
  virtual int angle(int tracked) const = 0;    // state indices
  virtual int twist(int connection) const = 0;
  virtual int speed(int shaft) const = 0;  // −1: prescribed
  virtual int own(int slot) const = 0;     // internal state of an element
  // The rate in this row also depends on the acceleration of a shaft: slot for ∂rate/∂alpha.
  virtual int follower(int row, int shaft) = 0;
};

// All quantities of the machine at one instant. Pointers are valid until the next evaluation.
struct Snapshot {
  Instant now;
  Sums sums;
  const double* alpha;            // per shaft [rad/s²]
  const double* joint_torque;     // per joint of the network: transmitted torque [N·m]
  const double* reaction;         // per node with prescribed motion: the torque for it [N·m]
  const double* relation_torque;  // per relation: torque λ that it takes from its first node [N·m]
  const double* relation_loss;    // per relation: the lost part of it [N·m]
  const double* hold_torque;      // per element: what it holds at standstill, on its own node [N·m]
  const double* node_angle;       // per node, including full turns [rad]
  const double* quadrature;       // null without an audit
};

// One quantity that a run can record.
struct Channel {
  Name name;         // torque.main_coupling
  std::string unit;  // SI
  std::function<double(const Snapshot&)> value;
};

// Torques that depend on the accelerations, added to the sums.
struct Reactions {
  double* torque;          // per shaft [N·m]
  double* slope;           // per shaft: −∂torque/∂alpha, counts as inertia [kg·m²]
  double* element_torque;  // per shaft element
  double* work_rate;       // per work account, or null
};

// Derivative of the transmitted torque τ of a connection by one of its inputs.
struct TorqueSlope {
  enum class By { twist, rate, own, angle, speed_of_a };  // θ, θ̇, state or tracked angle `index`, gain_a ω_a
  int connection = 0;
  By by = By::twist;
  int index = -1;
  double value = 0;
};

struct GuardLabel {
  std::string component, what;  // description of the event
  EventKind kind = EventKind::law;
  std::optional<double> value = {};  // direction of a slip
};

class ElementPool {
 public:
  virtual ~ElementPool() = default;
  virtual void add(const Instant& now, Sums& sums) const = 0;
  virtual void register_jacobian(JacobianPattern& pattern) = 0;
  // Adds ∂(sum of torques − inertia · alpha)/∂(state) to the slots, at the accelerations alpha per shaft.
  virtual void add_jacobian(const Instant& now, const double* alpha, double* slots) const = 0;

  // For all connections that do not stick.
  virtual void add_torque_slopes(const Instant&, std::vector<TorqueSlope>&) const {}

  // Torques that depend on the accelerations alpha per shaft, such as joint friction; the equations solve for both.
  virtual bool reacts() const { return false; }
  // Results of an iteration that are kept from one alpha to the next at the same instant: memory of the caller, one per
  // pool. begin(): a new instant.
  class Memory {
   public:
    virtual ~Memory() = default;
    virtual void begin() = 0;
  };
  virtual std::unique_ptr<Memory> make_memory() const { return nullptr; }
  virtual void add_reactions(const Instant&, const double* /*alpha*/, Reactions&, Memory*) const {}

  // Additional degrees of freedom, coupled to a shaft by inertia: add() gives the shaft the effective inertia and torque,
  // follow() their rates from the acceleration of the shaft (per shaft).
  virtual bool follows() const { return false; }
  virtual void follow(const Instant&, const double* /*alpha*/, double* /*internal_rate*/) const {}
  // Kinetic energy beyond ½ (variable inertia) ω².
  virtual double further_kinetic_energy(const Instant&) const { return 0; }
  // Internal states in equilibrium relative to the shaft, for starts in equilibrium.
  virtual void balance(const Instant&, const double* /*alpha*/, double* /*own*/) const {}

  virtual int guard_count() const { return 0; }
  // All laws of the pool change only at fixed angles of their shaft, in both directions: load edges.
  virtual bool guards_are_of_angle() const { return guard_count() == 0; }
  // Positive while the present modes hold, of order one.
  virtual void guards(const Instant&, double*) const {}
  virtual void fire(const Instant&, int /*guard*/, int* /*mode*/) const {}
  // Names the present mode, or the edge just passed.
  virtual GuardLabel label(int /*guard*/, const Instant&) const { return {}; }
  virtual void first_modes(const Instant&, int* /*mode*/) const {}
  // Updates the modes that depend on the direction of motion after a change.
  virtual void follow_directions(const Instant&, int* /*mode*/) const {}
  // Gives the element of this guard its law without events; false: it has none.
  virtual bool regularise(int /*guard*/, int* /*mode*/) const { return false; }
  virtual void first_states(const Instant&, double* /*own*/) const {}
  // Updates the states of the elements whose `active` has changed.
  virtual void switched(const Instant&, const char* /*before*/, double* /*own*/) const {}
  // Sets the modes of elements that were switched on and repeat their start.
  virtual void start_anew(const Instant&, const char* /*before*/, int* /*mode*/) const {}
  // Ranges of torque at standstill of the opposing elements of each shaft.
  virtual void add_holds(const Instant&, Hold* /*per shaft*/, Hold* /*per element*/) const {}
  // Ranges of torque that the slipping connections transmit without slip.
  virtual void add_slip_holds(const Instant&, Hold* /*per elastic connection*/) const {}
  // Changes of laws at known times.
  virtual double next_edge(double /*t*/) const { return std::numeric_limits<double>::infinity(); }
  virtual void set_timed_modes(double /*t*/, int* /*mode*/, char* /*active*/) const {}
  // Energy stored in the elements.
  virtual double energy(const Instant&) const { return 0; }
  // Kinetic energy of the variable inertias, computed without I_r: a check of the reduction.
  virtual double kinetic_energy_of_bodies(const Instant&) const { return 0; }
  virtual void add_channels(std::vector<Channel>&) const {}
};

}  // namespace kurbel
