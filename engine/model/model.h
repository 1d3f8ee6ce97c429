// model.h — a machine compiled into its smallest set of coordinates; immutable.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/network.h"
#include "engine/numerics/ode_system.h"
#include "engine/scene/scene.h"

namespace kurbel {

// One coordinate: all nodes that are rigidly joined, reduced to one of them.
struct Shaft {
  int reference = 0;  // node whose speed is the shaft's speed ω
  std::vector<int> nodes;
  double inertia = 0;        // constant part, on the reference node [kg·m²]
  double mean_inertia = 0;   // with the mean of the mechanisms
  bool variable = false;     // has a mechanism
  bool directional = false;  // has an element that opposes motion
  int prescribed = -1;       // index of its prescribed speed; −1: free
  double speed_scale = 1;    // [rad/s]
  double torque_scale = 1;   // [N·m]
};

// An elastic joint of the model. θ = gain_a φ_A − gain_b φ_B over the merged shafts A, B.
struct ElasticJoint {
  int joint = 0;  // in the network
  int shaft_a = 0, shaft_b = 0;
  double gain_a = 1, gain_b = 1;
  double twist_scale = 1e-4;  // [rad]
  bool slips = false;         // a clutch: no spring
  bool springless = false;    // a viscous film: no spring, no sticking
  int loss_account = 0;
};

// Σ gain · ω over shafts.
struct ShaftGain {
  int shaft = 0;
  double gain = 1;
  bool operator==(const ShaftGain&) const = default;
};

// A relation of the network over the merged shafts.
struct ShaftRelation {
  int relation = 0;                // in the network
  std::vector<ShaftGain> motion;   // Σ gain ω = 0
  std::vector<ShaftGain> loss;     // torque on the shafts by a unit of the loss L
  std::vector<ShaftGain> sliding;  // speed that the loss opposes
  GearLoss in_motion = {};         // the law of losses while it moves
  int loss_account = -1;           // −1: none
};

// Torque on a shaft of a gear, as a sum over relations, and joints that replaced relations.
struct GearTorque {
  struct Term {
    int relation = -1, joint = -1;  // one of them; a joint replaces a relation without losses
    double taken = 1, lost = 0;     // factors of λ (of the joint's torque) and of L
  };
  std::string name;  // "gearbox.out"
  int node = 0;
  std::vector<Term> terms;
  double value(const double* joint_torque, const double* relation_torque, const double* relation_loss) const;
};

// An internal state of an element.
struct PlacedInternalState {
  std::string component;
  InternalState state;
};

// A component that the operating sequence switches or sets.
struct CommandTarget {
  std::string component;
  std::vector<int> switched;  // shaft elements that are only on or off
  std::vector<int> opened;    // shaft elements that are off while the command is 0
};

// An angle on which some law depends; full turns are stored separately.
struct TrackedAngle {
  int node = 0, shaft = 0;
  double gain = 1;  // dφ/dt = gain · ω
};

// Reported torque of a joint: its torque or, for a shaft by dimensions, the torque in its middle from those of its parts
// (lobatto_element.h).
struct ReportedTorque {
  std::vector<double> weight = {};  // of the parts in their order; empty: the torque of the joint
  // `own`: index of the joint; for a shaft, of its middle part.
  template <class T>
  T operator()(const T* all, int own) const {
    if (weight.empty()) return all[own];
    const T* const part = all + own - static_cast<std::ptrdiff_t>(weight.size() / 2);
    T sum{};
    for (std::size_t k = 0; k < weight.size(); ++k) sum += weight[k] * part[k];
    return sum;
  }
};

// A coupling, elastic or merged; its torque is a result of every run.
struct TorqueJoint {
  std::string component;
  int joint = 0;
  int elastic = -1;           // index of the elastic joint; −1: merged, torque by d'Alembert
  int first = -1, last = -1;  // elastic joints whose twists add up to that of the component
  double torque_scale = 1;    // [N·m]
  ReportedTorque reported = {};
  double torque(const double* of_joints) const { return reported(of_joints, joint); }  // per joint of the network [N·m]
};

// A motor: the driving elements of a component with a rated torque and speed. Or the drive of a shaft with prescribed speed:
// it has the torque needed for this motion (theory 5.18), and the rated values of the machine.
struct MotorTorque {
  std::string component;
  std::vector<std::size_t> elements;
  int node = 0;                              // node with the motor's speed
  double rated_torque = 0, rated_speed = 0;  // [N·m], [rad/s]
  bool prescribed = false;
  double torque(const Snapshot& s) const;  // [N·m]
};

struct WorkAccount {
  std::string name;
  Account kind;
};

// Positions of the elements' derivatives in the sparse Jacobian of the states (without quadratures).
struct JacobianLayout {
  SparsityPattern pattern;
  std::vector<std::size_t> slot_position;                // per slot: stored entry; one past the end: not a state
  std::vector<std::pair<std::size_t, double>> constant;  // kinematic entries: stored entry, value
  std::vector<int> row_shaft;                            // per stored entry: shaft if the row is of a speed, else −1
  // Shafts whose accelerations are coupled by constraints; all their rows have all their columns.
  struct Coupled {
    std::vector<int> shafts, columns;
    std::vector<std::size_t> position;  // stored entry of [column][shaft]
  };
  std::vector<Coupled> coupled;
  // Rows of internal states that depend on the acceleration of a shaft: row += gain · row of the shaft's speed.
  struct Follower {
    std::size_t slot = 0;                                      // of the gain
    std::vector<std::pair<std::size_t, std::size_t>> entries;  // stored entries: of the speed's row, of its own
  };
  std::vector<Follower> followers;
};

struct Model {
  Scene scene;
  Effects effects;
  Network network;
  std::vector<Shaft> shafts;  // free ones first, prescribed ones last
  std::size_t free_shafts = 0;
  std::vector<int> shaft_of_node;
  std::vector<double> gain_of_node;  // ω_node = gain · ω_shaft
  std::vector<double> node_ratio;    // ω_node / ω_reduction_link in the machine's usual motion, all turning together
  std::vector<double> scale_ratio;   // its magnitude, never 0: 1 for shafts at rest in the usual motion
  std::vector<ElasticJoint> elastic;
  std::vector<TrackedAngle> angles;
  std::vector<ShaftRelation> relations;
  std::vector<GearTorque> gear_torques;
  std::vector<PlacedInternalState> internal_states;
  std::vector<CommandTarget> commands;
  std::vector<int> trigger_angle;  // per step of the sequence: tracked angle that it waits for, −1: none
  std::vector<TorqueJoint> torque_joints;
  std::vector<MotorTorque> motors;
  std::vector<WorkAccount> accounts;
  std::vector<std::unique_ptr<ElementPool>> pools;
  std::vector<Channel> pool_channels;
  std::size_t mode_slots = 0;
  std::vector<std::string> merged;  // merged joints and the reasons, one line each

  int reduction_node = 0;                    // crank of the first mechanism, else the line's first shaft
  int reduction_angle = 0;                   // its tracked angle
  double cycle = 0;                          // angle of one cycle of the reduction link [rad]; 0: none
  int reduction_element = -1;                // first mechanism among the elements
  double speed_scale = 1, torque_scale = 1;  // of the reduction link
  JacobianLayout jacobian;

  std::size_t angle_count() const { return angles.size(); }
  std::size_t twist_count() const { return elastic.size(); }
  std::size_t state_count() const { return angles.size() + elastic.size() + free_shafts + internal_states.size(); }
  // Relations or slipping joints; the work equation and the reduction need a machine without them.
  bool has_contacts() const;
  // Internal states that do not follow a constant motion at once: all except those that only lag.
  bool has_memory() const;
  bool has_continuous_shafts() const;  // elastic ones; for their accuracy see cut_continuous_shafts
  std::string node_label(int node) const;
  // Place among the commands of a component that the sequence sets; −1: none.
  int command_of(const std::string& component) const;
  // Names of all elastic joints for reports: the component, with a number if it has several; the middle joint of a
  // continuous shaft has the name of the shaft.
  std::vector<std::string> joint_names() const;
  // Description: merged joints with reasons, coordinates, their inertias.
  std::string explain() const;
};

// Registers the derivatives of all elements, and sorts them into a compressed-column pattern.
JacobianLayout lay_out_jacobian(const Model& model);

// Builds the network from a scene's components. Throws SceneError with all faults of the components.
Network build_network(const Scene& scene);
// Adds one component; faults of its parameters together are located at the component.
void build_component(const Section& section, Network& network, Messages& messages);

// Compiles a scene with the given effects. Throws SceneError if the equations would be singular.
std::shared_ptr<const Model> compile(const Scene& scene, const Effects& effects);

// Compiles a network made in C++ (benches, library users); the scene contains effects and run settings.
std::shared_ptr<const Model> compile_network(Network network, const Scene& scene, const Effects& effects);

}  // namespace kurbel
