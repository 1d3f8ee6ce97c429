// joint_torques.h — torques of the joints within merged shafts, computed by d'Alembert's principle.
//
// The two nodes of a rigid joint are one shaft, and the torque of the joint does not appear in the equations of motion. It is
// the torque that the nodes on the side away from the shaft's reference need in addition to their own torques:
//     need = J ε − Σ τ of the elements − torques of elastic joints and relations;
//     a joint passes the need of its child to its parent, times the ratio, from the leaves to the root.
// At the root the need is zero, unless its motion is prescribed: it is then the reaction there. Any other remainder means
// that the two free bodies of a cut joint disagree (open()). Rigid loops share the torque by the given stiffnesses
// (load_paths.h).
#pragma once

#include <span>
#include <vector>

#include "engine/model/model.h"
#include "engine/numerics/load_paths.h"

namespace kurbel {

class JointTorques {
 public:
  explicit JointTorques(const Model& model);

  struct Given {
    const double* alpha = nullptr;              // per shaft [rad/s²]
    const double* element_torque = nullptr;     // per element, on its own node [N·m]
    const double* element_inertia = nullptr;    // per element: its variable inertia [kg·m²]
    const double* connection_torque = nullptr;  // per elastic joint: τ, on b [N·m]
    const double* turning_torque = nullptr;     // per elastic joint: on a in addition to −τ [N·m] (theory 8.1)
    const double* relation_torque = nullptr;    // per relation: λ, taken from its first node [N·m]
    const double* relation_loss = nullptr;      // per relation: the lost part of it [N·m]
  };
  // A shaft at standstill: the opposing elements on it hold the remaining torque in proportion to their capacities.
  struct Held {
    int shaft = 0;
    double rest = 0;  // remaining torque held by them [N·m]
  };
  // Holds per shaft and per element; used only for held shafts.
  void find(const Given& given, std::span<const Held> held, const Hold* shaft_hold, const Hold* element_hold);

  const std::vector<double>& torque() const { return torque_; }  // per joint of the network [N·m]
  // Per node: the needed external torque; with prescribed motion the reaction [N·m].
  const std::vector<double>& balance() const { return balance_; }
  const std::vector<double>& hold_torque() const { return hold_torque_; }  // per element, on its own node [N·m]

  // Of the last find(): the free shaft with the largest remainder at its root, relative to the torques on the shaft. The
  // torque of any joint within it differs by this amount between its two sides.
  struct Open {
    double part = 0;  // 0 … 1
    int shaft = -1;
  };
  Open open(const Given& given) const;

 private:
  struct NodeInertia {  // J ε = inertia · gain · α of its shaft
    double inertia_gain;
    int shaft;
  };
  struct ElementPlace {
    int node, shaft;
    double gain;
  };
  void list_trees();
  void list_places();
  void lock_in_twists_of_the_start();
  void add_inertia_and_elements(const Given& given);
  void add_connections(const Given& given);
  void add_held(const Held& held, const Hold& shaft_hold, const Hold* element_hold);
  void eliminate_leaves();
  void bear_reactions();

  const Model* model_;
  std::vector<LoadStep> steps_;  // of the trees within the merged shafts, leaves first; links are joints
  LoadLoops loops_;
  std::vector<NodeInertia> nodes_;
  std::vector<ElementPlace> elements_;
  std::vector<double> torque_, balance_, hold_torque_;
  bool holds_ = false;  // hold_torque_ is not all zero
};

}  // namespace kurbel
