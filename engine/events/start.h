// start.h — initial states of a machine: angles, twists in equilibrium with the loads, and all modes.
//
//   unloaded motion ──▶ given speeds and the speeds of gear members ──▶ modes of pieces and of the sequence
//                   ──▶ twists in equilibrium ──▶ consistent modes of contacts
#pragma once

#include <span>
#include <vector>

#include "engine/equations/flow.h"
#include "engine/events/contacts.h"
#include "engine/events/switching.h"

namespace kurbel {

class Start {
 public:
  // Changes the modes of this flow through its contacts and its switching.
  Start(Flow& flow, Contacts& contacts, Switching& switching)
      : flow_(flow), contacts_(contacts), switching_(switching), model_(flow.model()) {}

  // The start given by a scene. Throws SceneError with the location in the scene if it is impossible.
  std::vector<double> at(double t, const StartSettings& settings);
  // Start with an angle of the reduction link and these twists and speeds of the free shafts; the other angles follow.
  std::vector<double> with(double t, double link_angle, std::span<const double> twists, std::span<const double> speeds);
  // Start of the rigid machine, for integrators without events: clutches locked, directions by the speeds.
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
    std::vector<double> kept;   // acceleration at constant speed of the reduction link [rad/s²]
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

// Torques of the network's joints in equilibrium with the needs of the nodes [N·m], summed from the leaves of the whole
// tree to a root that takes the remainder (a prescribed motion, if any). Running gears count as lossless. Closed loops
// share the torque by the compliances of their springs and the locked-in `twist` (per elastic joint). A joint takes `share`
// times its torque from a (theory 5.11, 7.10). Throws std::runtime_error if a gear has three free shafts or a loop no spring.
std::vector<double> balanced_joints(const Model& model, std::vector<double> need, std::span<const double> twist,
                                    std::span<const double> share);

}  // namespace kurbel
