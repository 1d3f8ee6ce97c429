// joint_torques.h — what the joints within merged shafts transmit, found back by d'Alembert's principle.
//
// Where a joint is rigid its two nodes are one shaft, and its torque has gone from the equations of motion. It is what
// the nodes on the side away from the shaft's reference need beyond their own torques:
//     need = J ε − Σ τ of the elements − what elastic joints and relations bring;
//     a joint passes the need of its child on to its parent, times the ratio, from the leaves to the root.
// At the root nothing is left, unless its motion is prescribed: that rest is the reaction there. Anything left elsewhere
// means that the two free bodies of a cut joint disagree (open()). Rigid loops share what they
// pass by the stiffnesses that are given (load_paths.h).
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
    const double* turning_torque = nullptr;     // per elastic joint: on a besides −τ [N·m] (theory 8.1)
    const double* relation_torque = nullptr;    // per relation: λ, taken from its first node [N·m]
    const double* relation_loss = nullptr;      // per relation: what of it is lost [N·m]
  };
  // A shaft that stands: the opposing elements on it hold the rest, in proportion to what each can hold.
  struct Held {
    int shaft = 0;
    double rest = 0;  // that they bring [N·m]
  };
  // Holds per shaft and per element; read only where a shaft is held.
  void find(const Given& given, std::span<const Held> held, const Hold* shaft_hold, const Hold* element_hold);

  const std::vector<double>& torque() const { return torque_; }  // per joint of the network [N·m]
  // Per node: what it needs from outside; at a prescribed motion the reaction [N·m].
  const std::vector<double>& balance() const { return balance_; }

  // Of the last find(): the free shaft where most is left at the root, beside the torques that meet on the shaft. By so
  // much the torque of any joint within it differs from one of its sides to the other.
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
  void walk_to_the_roots();
  void bear_reactions();

  const Model* model_;
  std::vector<LoadStep> steps_;  // of the trees within the merged shafts, leaves first; a link is a joint
  LoadLoops loops_;
  std::vector<NodeInertia> nodes_;
  std::vector<ElementPlace> elements_;
  std::vector<double> torque_, balance_;
};

}  // namespace kurbel
