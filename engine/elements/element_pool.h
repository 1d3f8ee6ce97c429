// element_pool.h — what a pool of elements is to the equations: one loop behind one virtual call. No element, no pool,
// no cost. Pools of connections and of shaft elements: connection_pool.h, shaft_pool.h.
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

// Where the machine is. Arrays belong to the equations.
struct Instant {
  double t = 0;
  const double* angle = nullptr;     // per tracked angle
  const double* twist = nullptr;     // per elastic connection
  const double* speed = nullptr;     // per shaft
  const int* mode = nullptr;         // per element
  const int* direction = nullptr;    // per shaft
  const char* active = nullptr;      // per element: within its window of time
  const int* slip = nullptr;         // per elastic connection: sense of slip, 0 = stuck
  const double* command = nullptr;   // per command of the operating sequence
  const double* own = nullptr;       // the elements' own states
  const double* on_since = nullptr;  // per element: it went on last [s]
};

// What the elements do to the machine at that instant.
struct Sums {
  double* torque = nullptr;             // per shaft: sum of torques
  double* inertia = nullptr;            // per shaft: variable inertias are added to the constant ones
  double* twist_rate = nullptr;         // per elastic connection
  double* connection_torque = nullptr;  // per elastic connection: transmitted torque k θ + c θ̇
  double* spring_torque = nullptr;      // per elastic connection: spring torque k θ; only when work_rate is wanted
  double* element_torque = nullptr;     // per shaft element
  double* element_inertia = nullptr;    // per shaft element: its variable inertia
  double* work_rate = nullptr;          // per work account, or null where nobody asks
  double* own_rate = nullptr;           // per own state: its derivative
  double* turning_torque = nullptr;     // per elastic connection: further torque on a, of those that use the angle
};

// Registers the places of a sparse Jacobian; a column or row of −1 is a motion that is no state.
class JacobianPattern {
 public:
  virtual ~JacobianPattern() = default;
  virtual int entry(int row, int column) = 0;  // slot to add the derivative to
  virtual int angle(int tracked) const = 0;    // state indices
  virtual int twist(int connection) const = 0;
  virtual int speed(int shaft) const = 0;  // −1: prescribed
  virtual int own(int slot) const = 0;     // an element's own state
  // The rate in this row moves with the acceleration of a shaft, too: slot for ∂rate/∂alpha.
  virtual int follower(int row, int shaft) = 0;
};

// Everything that can be asked of the machine at one instant. Pointers are valid until the next evaluation.
struct Snapshot {
  Instant now;
  Sums sums;
  const double* alpha;            // per shaft [rad/s²]
  const double* joint_torque;     // per joint of the network: torque that it transmits [N·m]
  const double* reaction;         // per node whose motion is prescribed: torque that this takes [N·m]
  const double* relation_torque;  // per relation: torque λ that it takes from its first node [N·m]
  const double* relation_loss;    // per relation: what of it is lost [N·m]
  const double* node_angle;       // per node, turns counted [rad]
  const double* quadrature;       // null without an audit
};

// One quantity that a run can record.
struct Channel {
  Name name;         // torque.main_coupling
  std::string unit;  // SI
  std::function<double(const Snapshot&)> value;
};

// Torques that depend on the accelerations: added to what the elements do without them.
struct Reactions {
  double* torque;          // per shaft [N·m]
  double* slope;           // per shaft: −∂torque/∂alpha, counts as inertia [kg·m²]
  double* element_torque;  // per shaft element
  double* work_rate;       // per work account, or null
};

// How the torque τ that a connection transmits changes with what it reads.
struct TorqueSlope {
  enum class By { twist, rate, own, angle, speed_of_a };  // θ, θ̇, own state `index`, tracked angle `index`, gain_a ω_a
  int connection = 0;
  By by = By::twist;
  int index = -1;
  double value = 0;
};

struct GuardLabel {
  std::string component, what;  // what happens when it fires
  EventKind kind = EventKind::law;
};

class ElementPool {
 public:
  virtual ~ElementPool() = default;
  virtual void add(const Instant& now, Sums& sums) const = 0;
  virtual void register_jacobian(JacobianPattern& pattern) = 0;
  // Adds ∂(sum of torques − inertia · alpha)/∂(state) to the slots, at the accelerations alpha per shaft.
  virtual void add_jacobian(const Instant& now, const double* alpha, double* slots) const = 0;

  // Those of all connections in motion; one that sticks has none.
  virtual void add_torque_slopes(const Instant&, std::vector<TorqueSlope>&) const {}

  // Joint friction and the like: torques at the accelerations alpha per shaft; the equations find both together.
  virtual bool reacts() const { return false; }
  // Where that takes a search, what it found may be kept from one alpha to the next at the same instant: memory of
  // whoever computes, one per pool. begin(): another instant.
  class Memory {
   public:
    virtual ~Memory() = default;
    virtual void begin() = 0;
  };
  virtual std::unique_ptr<Memory> make_memory() const { return nullptr; }
  virtual void add_reactions(const Instant&, const double* /*alpha*/, Reactions&, Memory*) const {}

  // Further degrees of freedom, coupled to a shaft by inertia: add() gives the shaft what is left of inertia and torque
  // when they follow freely, and their own rates come from the acceleration that the shaft then has (per shaft).
  virtual bool follows() const { return false; }
  virtual void follow(const Instant&, const double* /*alpha*/, double* /*own_rate*/) const {}
  // Kinetic energy beyond ½ (variable inertia) ω².
  virtual double further_kinetic_energy(const Instant&) const { return 0; }
  // Own states at rest relative to the shaft under what acts, where the machine starts in equilibrium.
  virtual void balance(const Instant&, const double* /*alpha*/, double* /*own*/) const {}

  virtual int guard_count() const { return 0; }
  // Every law of the pool changes at fixed angles of its shaft alone, for either direction: load edges.
  virtual bool guards_are_of_angle() const { return guard_count() == 0; }
  // Positive while the present modes hold, of order one.
  virtual void guards(const Instant&, double*) const {}
  virtual void fire(const Instant&, int /*guard*/, int* /*mode*/) const {}
  // Names the mode that holds, or the edge that was just passed.
  virtual GuardLabel label(int /*guard*/, const Instant&) const { return {}; }
  virtual void first_modes(const Instant&, int* /*mode*/) const {}
  // Modes that hang on the sense of motion, after that has changed.
  virtual void follow_directions(const Instant&, int* /*mode*/) const {}
  // Gives the element of this guard its law without events; false where it has none.
  virtual bool regularise(int /*guard*/, int* /*mode*/) const { return false; }
  virtual void first_states(const Instant&, double* /*own*/) const {}
  // States of the elements whose `active` is no longer what it was before.
  virtual void switched(const Instant&, const char* /*before*/, double* /*own*/) const {}
  // Modes of those that went on and start anew.
  virtual void start_anew(const Instant&, const char* /*before*/, int* /*mode*/) const {}
  // Torques at standstill: what the opposing elements of each shaft can hold.
  virtual void add_holds(const Instant&, Hold* /*per shaft*/, Hold* /*per element*/) const {}
  // What the slipping connections can carry without slipping, and what they carry while they slip.
  virtual void add_slip_holds(const Instant&, Hold* /*per elastic connection*/) const {}
  // Edges at known times.
  virtual double next_edge(double /*t*/) const { return std::numeric_limits<double>::infinity(); }
  virtual void set_timed_modes(double /*t*/, int* /*mode*/, char* /*active*/) const {}
  // Energy stored in the elements.
  virtual double energy(const Instant&) const { return 0; }
  // Kinetic energy of the variable inertias, found in another way than from I_r: a check of the reduction.
  virtual double kinetic_energy_of_bodies(const Instant&) const { return 0; }
  virtual void add_channels(std::vector<Channel>&) const {}
};

}  // namespace kurbel
