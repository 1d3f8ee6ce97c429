// compile_steps.h — the steps of compile.cpp in order, one file each, and the data passed between them.
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
  // Location of a component's table; location of the line, for faults of the machine as a whole.
  Location place_of(const std::string& component) const;
  Location place_of_line() const;
  void refuse(const std::string& component, const std::string& text) { messages.add(place_of(component), text); }
};

// --- merging.cpp: groups of connected nodes and their speed ratios ---

// Groups of rigidly connected nodes, each node with its speed relative to the first of its group.
struct Merging {
  std::vector<int> group;
  std::vector<double> gain;  // ω_node / ω_first
  int groups = 0;
};

// Relations followed in a search, in their usual motion: to all members, or only to those that turn in it (not to the
// housing of a gearbox).
enum class Through { none, turning, all };

// Groups the nodes connected by joints for which `is_rigid` holds and, if requested, by relations in their usual motion.
Merging merge(const Network& network, const std::function<bool(const Network::Joint&)>& is_rigid,
              Through relations = Through::none);
// Nodes that are one shaft with the present effects.
Merging merge_shafts(const Network& network);

// Throws SceneError unless all shafts are connected and the size can be compiled.
void check_shafts(Compilation& c);
// Chooses the reduction link, to which speeds, torques and inertias refer; finds the speed of every node over its speed.
void choose_reduction_link(Compilation& c);
void find_node_ratios(Compilation& c);

// --- loops.cpp: closed loops of shafts ---

// The machine's usual motion, all turning together: the speed of every node over that of the first. Throws SceneError
// if closed loops have contradictory ratios, so that nothing can turn.
std::vector<double> usual_motion(Compilation& c);
// Checks loops that are rigid with the present effects: their ratios are consistent (clutches counted as locked included),
// and their torques are determined.
void check_rigid_loops(Compilation& c, const Merging& merging);

// --- switching.cpp: the network with the present effects ---

void switch_connections(Compilation& c);
void settle_relative_damping(Compilation& c);
void switch_effects(Compilation& c);
// Nodes rigidly connected to a shaft with the prescribed speed zero, that is, to the frame.
std::vector<char> standing_nodes(const Network& network);

// --- shafts.cpp: the coordinates ---

void make_shafts(Compilation& c);
void make_elastic_joints(Compilation& c);
// Throws SceneError if the motion of a shaft is undefined.
void check_inertias(Compilation& c);

// --- scales.cpp: orders of magnitude of speeds, torques and twists ---

void find_scales(Compilation& c);

// --- placement.cpp: elements into their pools, with the indices that they need ---

void track_angles(Compilation& c);
void place_elements(Compilation& c);
void list_torque_joints(Compilation& c);
void list_motors(Model& model);

}  // namespace kurbel
