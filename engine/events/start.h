// start.h — the states that a machine begins in: angles, twists in balance with the loads, and all modes.
//
//   unloaded motion ──▶ speeds that are given, members of gears follow ──▶ modes of pieces and of the sequence
//                   ──▶ twists that carry the loads ──▶ contacts that stick or slip as they fit
#pragma once

#include <span>
#include <vector>

#include "engine/equations/flow.h"
#include "engine/events/contacts.h"
#include "engine/events/switching.h"

namespace kurbel {

class Start {
 public:
  // Changes the modes of this flow, with its contacts and its switching.
  Start(Flow& flow, Contacts& contacts, Switching& switching)
      : flow_(flow), contacts_(contacts), switching_(switching), model_(flow.model()) {}

  // As a scene demands it. Throws SceneError at the scene's place where that is impossible.
  std::vector<double> at(double t, const StartSettings& settings);
  // The reduction link at an angle, with these twists and speeds of the free shafts; the other angles follow.
  std::vector<double> with(double t, double link_angle, std::span<const double> twists, std::span<const double> speeds);
  // The rigid machine, for integrators that know no events: clutches locked, senses of motion as they turn.
  std::vector<double> rigid(double t, double link_angle, double link_speed);

 private:
  void settle_modes(double t, std::span<double> y, bool equilibrium);
  void forget_earlier_modes();
  std::vector<std::size_t> senses_of_slip(double t, std::span<const double> y);
  void refuse_impossible_slip(double t, std::span<const double> y);
  void members_follow(std::span<double> y, std::vector<char> given, double t);
  void balance_twists(std::span<double> y, double t);
  std::vector<double> needs_when_balanced(std::span<const double> y, double t, double stored);
  struct Together {             // per node
    std::vector<double> ratio;  // of its speed to the reduction link's
    std::vector<double> kept;   // acceleration while the reduction link keeps its speed [rad/s²]
  };
  Together moving_together(std::span<const double> y) const;
  void turn_together(std::span<const double> before, const Together& then, std::span<double> y) const;
  double turn_of(int joint, std::span<const double> y) const;
  void first_states(double t, std::span<double> y);
  void first_pieces(double t, std::span<const double> y);

  Flow& flow_;
  Contacts& contacts_;
  Switching& switching_;
  const Model& model_;
};

// Torques of the network's joints that give every node what it needs [N·m]: summed from the leaves of the whole tree to
// a root that can take the rest (a prescribed motion, if there is one). A gear that runs counts as one without losses.
// Closed loops share what they pass by the twists of their springs, which gape by what these twists (per elastic joint)
// lock in. A joint takes `share` times from a what it passes on (theory 5.11, 7.10). Throws std::runtime_error where the three shafts of a gear are free, or a loop has no spring.
std::vector<double> balanced_joints(const Model& model, std::vector<double> need, std::span<const double> twist,
                                    std::span<const double> share);

}  // namespace kurbel
