// compile_steps.h — the steps of compile.cpp, a file each, in their order, and what passes from one to the next.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/scene/messages.h"

namespace kurbel {

// A machine on its way from the network to the model.
struct Compilation {
  explicit Compilation(const std::string& file) : messages(file) {}
  Model model;
  Messages messages;

  Network& net() { return model.network; }
  // Where a component's table stands; where the line stands, for what is wrong with the machine as a whole.
  Location place_of(const std::string& component) const;
  Location place_of_line() const;
  void refuse(const std::string& component, const std::string& text) { messages.add(place_of(component), text); }
};

// --- merging.cpp: which nodes hang together, and how fast each turns ---

// Nodes that hang together rigidly, each with its speed relative to the first of them.
struct Merging {
  std::vector<int> group;
  std::vector<double> gain;  // ω_node / ω_first
  int groups = 0;
};

// Relations that a walk goes through, in their usual motion: to every member, or to those only that turn in it (not to
// a gearbox's housing).
enum class Through { none, turning, all };

// Walks the joints that `is_rigid` admits, and the relations in their usual motion where they are asked for.
Merging merge(const Network& network, const std::function<bool(const Network::Joint&)>& is_rigid,
              Through relations = Through::none);
// Nodes that are one shaft under the effects that are on.
Merging merge_shafts(const Network& network);

// Throws SceneError unless the shafts hang together, in a size that can be compiled.
void check_shafts(Compilation& c);
// The link that all speeds, torques and inertias are told for, and the speed of every node over its.
void choose_reduction_link(Compilation& c);
void find_node_ratios(Compilation& c);

// --- loops.cpp: what closes loops of shafts ---

// The machine's usual motion, all turning together: the speed of every node over that of the first. Throws SceneError
// where loops are closed at ratios that clash, so that nothing can turn.
std::vector<double> usual_motion(Compilation& c);
// Loops that are rigid under the effects that are on: their ratios fit (clutches that count as locked among them), and
// what they share is determined.
void check_rigid_loops(Compilation& c, const Merging& merging);

// --- switching.cpp: the network under the effects that are on ---

void switch_connections(Compilation& c);
void settle_relative_damping(Compilation& c);
void switch_effects(Compilation& c);
// Nodes that are rigidly tied to a shaft whose speed is prescribed as nothing: to the frame.
std::vector<char> standing_nodes(const Network& network);

// --- shafts.cpp: the coordinates ---

void make_shafts(Compilation& c);
void make_elastic_joints(Compilation& c);
// Throws SceneError where the motion of a shaft is undefined.
void check_inertias(Compilation& c);

// --- scales.cpp: how large speeds, torques and twists are ---

void find_scales(Compilation& c);

// --- placement.cpp: elements into their pools, and the places that they ask for ---

void track_angles(Compilation& c);
void place_elements(Compilation& c);
void list_torque_joints(Compilation& c);
void list_motors(Model& model);

}  // namespace kurbel
